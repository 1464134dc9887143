//! What is asked for, so many bytes at most or so many decibels at least, and how near a stream comes to it.

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    Bytes(f64),
    Decibels(f64),
}

/// A stream and what it is worth.
#[derive(Clone, Debug)]
pub(crate) struct Encoded {
    pub(crate) bytes: Vec<u8>,
    pub(crate) psnr: f64,
    pub(crate) step: u16,
}

impl Target {
    /// How far an encoding of so many bytes and decibels is on the wrong side: above 0 if the step is too
    /// fine.
    pub(super) fn miss(self, bytes: f64, psnr: f64) -> f64 {
        match self {
            Self::Bytes(target) => (bytes / target).ln(),
            Self::Decibels(decibels) => (psnr - decibels) * 0.12,
        }
    }

    /// The same of a whole one.
    pub(super) fn missed(self, encoded: &Encoded) -> f64 {
        self.miss(encoded.bytes.len() as f64, encoded.psnr)
    }

    /// Whether it is met: a part of the bytes or more, and not above them; within 0.05 dB and not below.
    pub(super) fn is_met(self, encoded: &Encoded, part: f64) -> bool {
        match self {
            Self::Bytes(bytes) => {
                let length = encoded.bytes.len() as f64;
                length <= bytes && (length >= bytes * part || length + 1.0 > bytes)
            }
            Self::Decibels(decibels) => (0.0..0.05).contains(&(encoded.psnr - decibels)),
        }
    }

    /// Whether decibels are so near that nothing is tried between two steps: of bytes each counts.
    pub(super) fn is_near(self, encoded: &Encoded) -> bool {
        matches!(self, Self::Decibels(decibels) if (0.0..0.2).contains(&(encoded.psnr - decibels)))
    }

    /// Whether an encoding is allowed at all.
    pub(super) fn allows(self, encoded: &Encoded) -> bool {
        match self {
            Self::Bytes(bytes) => encoded.bytes.len() as f64 <= bytes,
            Self::Decibels(decibels) => encoded.psnr >= decibels,
        }
    }

    /// Of those that are allowed and within 1 per cent the one of most decibels, or of least bytes; else the
    /// nearest that is allowed, or the nearest of all.
    pub(super) fn best(self, tried: &[Encoded]) -> Option<&Encoded> {
        let off = |e: &Encoded| self.missed(e).abs();
        let worth = |e: &Encoded| match self {
            Self::Bytes(_) => e.psnr,
            Self::Decibels(_) => -(e.bytes.len() as f64),
        };
        let allowed = || tried.iter().filter(|e| self.allows(e));
        let closest = |a: &&Encoded, b: &&Encoded| off(a).total_cmp(&off(b));
        let best = allowed().filter(|e| off(e) < 0.01).max_by(|a, b| worth(a).total_cmp(&worth(b)));
        best.or_else(|| allowed().min_by(closest)).or_else(|| tried.iter().min_by(closest))
    }
}
