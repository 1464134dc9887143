//! How rough a random shape is: by which offsets midpoints are displaced, level by level.
//!
//! The standard deviation of the displacement is `o 2^(-H k)` at level `k`, `o` the offset and `H` the
//! similarity exponent; the power spectrum of a curve then falls as `1/f^beta`, `beta = 2 H + 1`. Source:
//! L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980 (`H` = 1); M. F. Barnsley et
//! al., "The Science of Fractal Images", 1988, section 1.4.3.
//!
//! Format: offsets 28 fractional bits, powers of two 30.

use super::exponential::exp_minus;
use super::formats::{Q28, Real, UQ28, UQ30, Unit, Wide};
use super::root::sqrt;
use crate::Error;

/// An offset, unless it is negative.
pub(crate) fn checked_offset(offset: Unit) -> Result<UQ28, Error> {
    if offset < Unit::ZERO {
        return Err(Error::OutOfRange {
            what: "offset",
            index: None,
            value: Wide::from(offset),
            min: Wide::ZERO,
            max: Wide::from(Unit::MAX),
        });
    }
    Ok(offset.to_bits().unsigned_abs() >> 2)
}

/// `2^-x`, 30 fractional bits, for `x` in `0 ..= 2`: by how much the variance falls a level, `x = 2 H`.
pub(crate) fn decay(x: Real) -> UQ30 {
    // ln 2 with 31 fractional bits
    const LN_2: i64 = 0x58b9_0bfc;
    let exponent = (i64::from(x.to_bits()) * LN_2 + (1 << 30)) >> 31;
    exp_minus(Real::from_bits(exponent as i32)).to_bits().unsigned_abs()
}

/// The offsets of all levels, when the variance falls by `decay` each. Level `k` is low by at most `2 k`
/// units and high by at most one, beside what the root adds.
pub(crate) fn offsets<const LEVELS: usize>(offset: UQ28, decay: UQ30) -> [Q28; LEVELS] {
    let mut amplitude = u64::from(offset) << 30; // 58 fractional bits
    // 2^-H with 31 fractional bits
    let factor = u64::from(sqrt(u64::from(decay) << 32));
    [(); LEVELS].map(|()| {
        let offset = ((amplitude + (1 << 29)) >> 30) as i32;
        amplitude = (amplitude >> 31) * factor;
        offset
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Offsets from 0 on; those of level `k` are `o 2^(-H k)` within `1 + 2 k` units of `2^-28` and what the
    /// root adds.
    #[test]
    fn offsets_fall_by_a_power_of_two_a_level() {
        let checked = [-1, 0, i32::MAX].map(|o| checked_offset(Unit::from_bits(o)).ok());
        assert_eq!(checked, [None, Some(0), Some((1 << 29) - 1)]);
        let mut worst = 0.0_f64;
        for h in [0.0, 0.125, 0.5, 0.7, 1.0] {
            for offset in [1, 1 << 20, 1 << 28, (1 << 29) - 1] {
                let all: [Q28; 16] = offsets(offset, decay(Real::from_num(2.0 * h)));
                for (k, got) in all.into_iter().enumerate() {
                    let exact = f64::from(offset) * (-h * k as f64).exp2();
                    worst = worst.max(
                        (f64::from(got) - exact).abs() / (1.0 + 2.0 * k as f64 + exact * 2.0_f64.powi(-26)),
                    );
                }
            }
        }
        assert!((0.3..1.0).contains(&worst), "{worst}");
    }
}
