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
    /// Whether no step of this picture is finer.
    pub(crate) finest: bool,
}

/// What decibels without any error count as, and more than there are with one.
pub(super) const LOSSLESS: f64 = 200.0;
/// So many decibels more are worth bytes that are left.
const MORE: f64 = 0.1;

impl Target {
    /// How far an encoding of so many bytes and decibels is on the wrong side: above 0 if the step is too
    /// fine.
    pub(super) fn miss(self, bytes: f64, psnr: f64) -> f64 {
        match self {
            Self::Bytes(target) => (bytes / target).ln(),
            Self::Decibels(decibels) => (psnr.min(LOSSLESS) - decibels) * 0.12,
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

    /// Of bytes: of those that are allowed and within 1 per cent the one of most decibels, or one of fewer
    /// bytes that is clearly better; else the smallest of all. Of decibels: the smallest that is allowed, or
    /// else the one of most decibels.
    pub(super) fn best(self, tried: &[Encoded]) -> Option<&Encoded> {
        let allowed = || tried.iter().filter(|e| self.allows(e));
        let smaller = |a: &&Encoded, b: &&Encoded| b.bytes.len().cmp(&a.bytes.len());
        let better = |a: &&Encoded, b: &&Encoded| a.psnr.total_cmp(&b.psnr).then_with(|| smaller(a, b));
        let small = |a: &&Encoded, b: &&Encoded| smaller(a, b).then_with(|| a.psnr.total_cmp(&b.psnr));
        match self {
            Self::Bytes(_) => {
                let full = allowed().filter(|e| self.missed(e) > -0.01).max_by(better);
                let best = allowed().max_by(better);
                let best = best.filter(|best| full.is_none_or(|full| best.psnr > full.psnr + MORE));
                best.or(full).or_else(|| tried.iter().max_by(small))
            }
            Self::Decibels(_) => allowed().max_by(small).or_else(|| tried.iter().max_by(better)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_is_what_is_asked_for_and_not_what_comes_near_it() {
        let of = |target: Target, tried: &[(usize, f64)]| {
            let tried: Vec<_> = tried
                .iter()
                .map(|(length, psnr)| Encoded {
                    bytes: vec![0; *length],
                    psnr: *psnr,
                    step: 0,
                    finest: false,
                })
                .collect();
            target.best(&tried).map(|best| (best.bytes.len(), best.psnr)).unwrap()
        };
        let bytes = Target::Bytes(1000.0);
        assert_eq!(of(bytes, &[(995, 40.0), (998, 40.1), (1001, 41.0), (980, 40.15)]), (998, 40.1));
        assert_eq!(of(bytes, &[(900, 29.0), (500, 88.0), (520, 88.0), (1001, 99.0)]), (500, 88.0));
        assert_eq!(of(bytes, &[(995, 29.0), (500, 88.0), (22, f64::INFINITY)]), (22, f64::INFINITY));
        assert_eq!(of(bytes, &[(1200, 40.0), (1100, 39.0)]), (1100, 39.0));
        let decibels = Target::Decibels(40.0);
        assert_eq!(of(decibels, &[(500, 40.01), (510, 40.0), (400, 39.9), (600, 41.0)]), (500, 40.01));
        assert_eq!(of(decibels, &[(500, 40.01), (63, 80.0), (55, f64::INFINITY)]), (55, f64::INFINITY));
        assert_eq!(of(decibels, &[(500, 39.0), (900, 20.0), (300, 38.0)]), (500, 39.0));
        // no error at all is no end of it
        assert!(decibels.miss(1.0, f64::INFINITY).is_finite());
    }
}
