//! CRC-32 of IEEE 802.3, the one of PNG and zip: polynomial `0x04C11DB7`, bits reflected, inverted at both
//! ends. Four bits a step, from a table of 16 words.

/// A checksum under way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Crc(u32);

const TABLE: [u32; 16] = {
    let mut table = [0; 16];
    let mut i = 0;
    while i < 16 {
        let mut c = i as u32;
        let mut k = 0;
        while k < 4 {
            c = if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 };
            k += 1;
        }
        table[i] = c;
        i += 1;
    }
    table
};

impl Crc {
    pub(super) const NEW: Self = Self(u32::MAX);

    #[inline(never)]
    pub(super) fn add(&mut self, byte: u8) {
        self.0 ^= u32::from(byte);
        for _ in 0..2 {
            self.0 = self.0 >> 4 ^ TABLE[(self.0 & 15) as usize];
        }
    }

    /// Of the bytes so far.
    pub(super) const fn value(self) -> u32 {
        !self.0
    }
}

/// The CRC-32 of `bytes`.
pub fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = Crc::NEW;
    for byte in bytes {
        crc.add(*byte);
    }
    crc.value()
}
