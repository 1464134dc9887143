//! The functions of `attractor::num`.

use attractor::num::{self, Angle};

use super::watch::{Tally, Watch};
use crate::float::{self, fold};
use crate::inputs::{mixed, table};

table! {
    /// Words of every magnitude.
    WORDS: u32, i => (mixed(i) >> 32) as u32 >> (i % 31) | 1
}
table!(WORDS_F32: f32, i => WORDS[i] as f32);
table!(WORDS_F64: f64, i => WORDS[i] as f64);

table! {
    /// Double words of every magnitude.
    SQUARES: u64, i => mixed(i) >> (i % 63) | 1
}
table!(SQUARES_F32: f32, i => SQUARES[i] as f32);
table!(SQUARES_F64: f64, i => SQUARES[i] as f64);

table! {
    /// Angles all round.
    ANGLES: u32, i => mixed(i) as u32
}
table!(ANGLES_F32: f32, i => (ANGLES[i] >> 8) as f32 / 16_777_216.0);
table!(ANGLES_F64: f64, i => ANGLES[i] as f64 / 4_294_967_296.0);

#[inline(never)]
pub(super) fn identity_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS, |v| v)
}

#[inline(never)]
pub(super) fn identity_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS_F32, f32::to_bits)
}

#[inline(never)]
pub(super) fn identity_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS_F64, fold)
}

#[inline(never)]
pub(super) fn reciprocal_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS, |v| {
        let (mantissa, shift) = num::reciprocal(v);
        mantissa ^ shift
    })
}

#[inline(never)]
pub(super) fn reciprocal_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS_F32, |v| (1.0 / v).to_bits())
}

#[inline(never)]
pub(super) fn reciprocal_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&WORDS_F64, |v| fold(1.0 / v))
}

#[inline(never)]
pub(super) fn reciprocal_sqrt_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES, |v| {
        let (mantissa, shift) = num::reciprocal_sqrt(v);
        mantissa ^ shift
    })
}

#[inline(never)]
pub(super) fn reciprocal_sqrt_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F32, |v| (1.0 / float::sqrt(v)).to_bits())
}

#[inline(never)]
pub(super) fn reciprocal_sqrt_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F64, |v| fold(1.0 / libm::sqrt(v)))
}

#[inline(never)]
pub(super) fn sqrt_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES, num::sqrt)
}

#[inline(never)]
pub(super) fn sqrt_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F32, |v| float::sqrt(v).to_bits())
}

#[inline(never)]
pub(super) fn sqrt_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F64, |v| fold(libm::sqrt(v)))
}

#[inline(never)]
pub(super) fn sin_cos_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&ANGLES, |v| {
        let (sin, cos) = num::sin_cos(Angle::from_bits(v));
        (sin.to_bits() ^ cos.to_bits().rotate_left(16)) as u32
    })
}

/// The same reduction and the same series as in fixed point.
#[inline(never)]
pub(super) fn sin_cos_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&ANGLES_F32, |turns| {
        let quarter = float::mul_add(turns, 4.0, 0.5) as i32;
        let x = float::mul_add(quarter as f32, -0.25, turns) * core::f32::consts::TAU;
        let square = x * x;
        let mut s = 1.0 / 362_880.0;
        for c in [-1.0 / 5_040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0] {
            s = float::mul_add(s, square, c);
        }
        s *= x;
        let mut c = -1.0 / 3_628_800.0;
        for k in [1.0 / 40_320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0] {
            c = float::mul_add(c, square, k);
        }
        let (sin, cos) = match quarter & 3 {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        };
        sin.to_bits() ^ cos.to_bits().rotate_left(16)
    })
}

#[inline(never)]
pub(super) fn sin_cos_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&ANGLES_F64, |turns| {
        let quarter = (turns * 4.0 + 0.5) as i32;
        let x = (turns - f64::from(quarter) * 0.25) * core::f64::consts::TAU;
        let square = x * x;
        let mut s = 1.0 / 362_880.0;
        for c in [-1.0 / 5_040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0] {
            s = s * square + c;
        }
        s *= x;
        let mut c = -1.0 / 3_628_800.0;
        for k in [1.0 / 40_320.0, -1.0 / 720.0, 1.0 / 24.0, -0.5, 1.0] {
            c = c * square + k;
        }
        let (sin, cos) = match quarter & 3 {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        };
        fold(sin) ^ fold(cos).rotate_left(16)
    })
}

table! {
    /// The components of vectors all round: two neighbours make one.
    COMPONENTS: i32, i => (mixed(i) >> 32) as i32 >> (i % 13)
}
table!(COMPONENTS_F32: f32, i => COMPONENTS[i] as f32);
table!(COMPONENTS_F64: f64, i => COMPONENTS[i] as f64);

/// The angles of the vectors that neighbours make.
#[inline(always)]
fn vectors<T: Copy>(watch: &mut Watch<'_>, inputs: &[T], mut angle: impl FnMut(T, T) -> u32) -> Tally {
    let mut before = inputs[0];
    watch.over(inputs, |v| angle(core::mem::replace(&mut before, v), v))
}

#[inline(never)]
pub(super) fn atan2_fixed(watch: &mut Watch<'_>) -> Tally {
    vectors(watch, &COMPONENTS, |y, x| num::atan2(y, x).to_bits())
}

#[inline(never)]
pub(super) fn atan2_f32(watch: &mut Watch<'_>) -> Tally {
    vectors(watch, &COMPONENTS_F32, |y, x| libm::atan2f(y, x).to_bits())
}

#[inline(never)]
pub(super) fn atan2_f64(watch: &mut Watch<'_>) -> Tally {
    vectors(watch, &COMPONENTS_F64, |y, x| fold(libm::atan2(y, x)))
}

#[inline(never)]
pub(super) fn log2_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES, num::log2)
}

#[inline(never)]
pub(super) fn log2_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F32, |v| libm::log2f(v).to_bits())
}

#[inline(never)]
pub(super) fn log2_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&SQUARES_F64, |v| fold(libm::log2(v)))
}

table! {
    /// Exponents from 0 to 16, 24 fractional bits.
    EXPONENTS: i32, i => (mixed(i) >> 36) as i32
}
table!(EXPONENTS_F32: f32, i => EXPONENTS[i] as f32 / 16_777_216.0);
table!(EXPONENTS_F64: f64, i => EXPONENTS[i] as f64 / 16_777_216.0);

#[inline(never)]
pub(super) fn exp_minus_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&EXPONENTS, |v| num::exp_minus(num::Real::from_bits(v)).to_bits() as u32)
}

#[inline(never)]
pub(super) fn exp_minus_f32(watch: &mut Watch<'_>) -> Tally {
    watch.over(&EXPONENTS_F32, |v| libm::expf(-v).to_bits())
}

#[inline(never)]
pub(super) fn exp_minus_f64(watch: &mut Watch<'_>) -> Tally {
    watch.over(&EXPONENTS_F64, |v| fold(libm::exp(-v)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loops_in_floating_point_compute_what_fixed_point_does() {
        // each table of inputs holds the same numbers, so that one probe a function is enough
        for i in [0, 17, 101, 255] {
            assert!((f64::from(WORDS_F32[i]) / WORDS_F64[i] - 1.0).abs() < 1e-6);
            assert!((f64::from(SQUARES_F32[i]) / SQUARES_F64[i] - 1.0).abs() < 1e-6);
            assert!((f64::from(ANGLES_F32[i]) - ANGLES_F64[i]).abs() < 1e-6);
            let (mantissa, shift) = num::reciprocal(WORDS[i]);
            assert!((f64::from(mantissa) / (1_u64 << shift) as f64 * WORDS_F64[i] - 1.0).abs() < 1e-8);
            assert!(
                (f64::from(num::log2(SQUARES[i])) / 16_777_216.0 - libm::log2(SQUARES_F64[i])).abs() < 1e-6
            );
            assert!((f64::from(COMPONENTS_F32[i]) / COMPONENTS_F64[i] - 1.0).abs() < 1e-6);
            let power = num::exp_minus(num::Real::from_bits(EXPONENTS[i])).to_num::<f64>();
            assert!((power - libm::exp(-EXPONENTS_F64[i])).abs() < 1e-8);
            assert!((f64::from(EXPONENTS_F32[i]) - EXPONENTS_F64[i]).abs() < 1e-5);
            assert!((f64::from(num::sqrt(SQUARES[i])) - libm::sqrt(SQUARES_F64[i])).abs() <= 1.0);
        }
    }
}
