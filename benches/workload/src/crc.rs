//! CRC-32 (polynomial `0x04C11DB7`, reflected, as in zlib and PNG), four bits at a time: a table of 64 bytes.

const TABLE: [u32; 16] = {
    let mut table = [0; 16];
    let mut i = 0;
    while i < 16 {
        let mut r = i as u32;
        let mut bit = 0;
        while bit < 4 {
            r = if r & 1 == 1 { (r >> 1) ^ 0xedb8_8320 } else { r >> 1 };
            bit += 1;
        }
        table[i] = r;
        i += 1;
    }
    table
};

/// A checksum over a stream of bytes.
#[derive(Debug, Clone, Copy)]
pub struct Crc32(u32);

impl Default for Crc32 {
    fn default() -> Self {
        Self(u32::MAX)
    }
}

impl Crc32 {
    /// Takes in one byte.
    pub fn byte(&mut self, byte: u8) {
        let mut r = self.0 ^ u32::from(byte);
        for _ in 0..2 {
            r = (r >> 4) ^ TABLE[(r & 15) as usize];
        }
        self.0 = r;
    }

    /// Takes in a word, least significant byte first.
    pub fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.byte(byte);
        }
    }

    /// The checksum of everything so far.
    pub const fn value(self) -> u32 {
        !self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_of_the_standard_comes_out() {
        let mut crc = Crc32::default();
        for byte in *b"123456789" {
            crc.byte(byte);
        }
        assert_eq!(crc.value(), 0xcbf4_3926);
    }
}
