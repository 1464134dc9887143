//! Sine, cosine, exponential and logarithm of every input of a 32-bit kernel, within `2^-60`, and the
//! arctangent within `2^-54`: the truth of `cargo xtask exhaust`.
//!
//! The argument is split in two. What belongs to its upper part stands in a table of double-doubles, made by
//! one recurrence; the lower part is so small that its share, computed in `f64`, is below `2^-8` with an
//! error below `2^-60`. Formulas: `sin(a + b)`, `cos(a + b)`, `e^(a + b)`, `log(a b)`;
//! `ln((n + 1) / n) = 2 artanh(1 / (2 n + 1))`.

use std::f64::consts::{LN_2, PI};

use crate::double_double::DoubleDouble;

/// Entries of the sine's table: a turn in so many parts.
const TURN: u32 = 1 << 16;
/// Entries of the exponential's: `e^(-k / 256)` for `k / 256` up to 128.
const POWERS: u32 = 1 << 15;
/// Entries of the logarithm's: mantissas from 1 to 2.
const MANTISSAS: u32 = 1 << 15;

/// `pi - f64::consts::PI`, which is also the sine of the latter.
const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;

/// A value and how far `near` lies above it: `near - value`.
///
/// The difference is what the kernels' errors are measured by: `near` is exact, and the table's two parts are
/// taken off one after the other.
fn above(near: f64, table: DoubleDouble, rest: f64) -> f64 {
    (near - table.value()) - (table.low() + rest)
}

/// The tables.
#[derive(Debug)]
pub struct Elementary {
    turn: Vec<(DoubleDouble, DoubleDouble)>,
    powers: Vec<DoubleDouble>,
    logarithms: Vec<DoubleDouble>,
}

impl Default for Elementary {
    fn default() -> Self {
        Self::new()
    }
}

impl Elementary {
    /// Computes the tables: a tenth of a second.
    pub fn new() -> Self {
        let pi = DoubleDouble::from(PI) + DoubleDouble::from(PI_LOW);
        let step = pi * DoubleDouble::from(2.0 / f64::from(TURN));
        let (sin, cos) = series(step);
        let mut turn = vec![(DoubleDouble::ZERO, DoubleDouble::ONE)];
        for k in 1..TURN as usize {
            let (s, c) = turn[k - 1];
            turn.push((s * cos + c * sin, c * cos - s * sin));
        }
        let (sinh, cosh) = hyperbolic(DoubleDouble::from(1.0 / 256.0));
        let mut powers = vec![DoubleDouble::ONE];
        for k in 1..POWERS as usize {
            powers.push(powers[k - 1] * (cosh - sinh));
        }
        let mut natural = vec![DoubleDouble::ZERO];
        for k in 0..MANTISSAS {
            let x = DoubleDouble::ONE / DoubleDouble::from(f64::from(2 * (MANTISSAS + k) + 1));
            let square = x * x;
            // x + x^3 / 3 + x^5 / 5 + x^7 / 7, x below 2^-16
            let mut sum = DoubleDouble::ZERO;
            for odd in [7.0, 5.0, 3.0, 1.0] {
                sum = sum * square + DoubleDouble::ONE / DoubleDouble::from(odd);
            }
            natural.push(natural[k as usize] + x * sum * DoubleDouble::from(2.0));
        }
        // the last one is ln 2
        let ln_2 = natural[MANTISSAS as usize];
        let logarithms = natural.iter().map(|v| *v / ln_2).collect();
        Self { turn, powers, logarithms }
    }

    /// How far `near` lies above the sine, and above the cosine, of `angle / 2^32` turns.
    pub fn above_sin_cos(&self, near: (f64, f64), angle: u32) -> (f64, f64) {
        let (sin, cos) = self.turn[(angle >> 16) as usize];
        // below 2^-13
        let b = f64::from(angle & 0xffff) * (2.0 * PI / 4_294_967_296.0);
        let (s, versine) = (libm::sin(b), -2.0 * libm::sin(b / 2.0) * libm::sin(b / 2.0));
        (
            above(near.0, sin, sin.value() * versine + cos.value() * s),
            above(near.1, cos, cos.value() * versine - sin.value() * s),
        )
    }

    /// How far `near` lies above `e^-(x / 2^24)`, for `x` below `2^31`.
    pub fn above_exp_minus(&self, near: f64, x: u32) -> f64 {
        let power = self.powers[(x >> 16) as usize % self.powers.len()];
        let b = f64::from(x & 0xffff) / 16_777_216.0;
        above(near, power, power.value() * libm::expm1(-b))
    }

    /// How far `near`, in turns, lies above the angle of `(x, y)`, the shorter way round.
    pub fn above_turn(&self, near: f64, y: i32, x: i32) -> f64 {
        let off = near - libm::atan2(y.into(), x.into()) / (2.0 * PI);
        off - libm::round(off)
    }

    /// How far `near` lies above `log2(v)`, for `v > 0`.
    pub fn above_log2(&self, near: f64, v: u64) -> f64 {
        let zeros = v.leading_zeros();
        let mantissa = v << zeros;
        let index = (mantissa >> 48) - u64::from(MANTISSAS);
        // v = 2^(63 - zeros) (2^15 + index) / 2^15 (1 + t)
        let t = (mantissa & 0xffff_ffff_ffff) as f64 / (mantissa >> 48 << 48) as f64;
        above(near - f64::from(63 - zeros), self.logarithms[index as usize], libm::log1p(t) / LN_2)
    }
}

/// Sine and cosine by their series, for `x` below `2^-8`.
fn series(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    terms(x, DoubleDouble::from(-1.0))
}

/// Hyperbolic sine and cosine, likewise.
fn hyperbolic(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    terms(x, DoubleDouble::ONE)
}

/// `sum sign^k x^(2k+1) / (2k+1)!` and `sum sign^k x^(2k) / (2k)!`, 18 terms altogether.
fn terms(x: DoubleDouble, sign: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let (mut odd, mut even, mut power) = (DoubleDouble::ZERO, DoubleDouble::ZERO, DoubleDouble::ONE);
    for k in 0..18 {
        if k % 2 == 0 {
            even = even + power;
        } else {
            odd = odd + power;
            power = power * sign;
        }
        power = power * x / DoubleDouble::from(f64::from(k + 1));
    }
    (odd, even)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the tables end with is known from elsewhere: the recurrences have lost nothing on the way.
    #[test]
    fn the_tables_come_back_to_known_numbers() {
        let e = Elementary::new();
        let near = |v: DoubleDouble, high: f64, low: f64| {
            let off = ((v.value() - high) + (v.low() - low)).abs();
            assert!(off < 1e-26, "{off:e} off {high}");
        };
        // a quarter, an eighth, a half turn
        near(e.turn[TURN as usize / 4].0, 1.0, 0.0);
        near(e.turn[TURN as usize / 4].1, 0.0, 0.0);
        near(e.turn[TURN as usize / 2].1, -1.0, 0.0);
        let eighth = e.turn[TURN as usize / 8].0;
        near(eighth * eighth, 0.5, 0.0);
        // e^-1 = 0.36787944117144232159552377016146086744581113103176..., as f64 and rest
        near(e.powers[256], 0.367_879_441_171_442_33, -1.242_875_367_278_836_3e-17);
        // log2(3/2) = 0.58496250072115618145373894394781650875981440769248...
        near(e.logarithms[MANTISSAS as usize / 2], 0.584_962_500_721_156_2, -5.224_490_061_390_109e-18);
        near(e.logarithms[MANTISSAS as usize], 1.0, 0.0);
    }

    #[test]
    fn the_truth_is_that_of_libm_to_f64() {
        let e = Elementary::new();
        for i in 1..10_000_u32 {
            let w = i.wrapping_mul(0x9e37_79b9);
            let x = f64::from(w) / 4_294_967_296.0 * 2.0 * PI;
            let (s, c) = e.above_sin_cos((libm::sin(x), libm::cos(x)), w);
            let x = w >> 1;
            let p = e.above_exp_minus(libm::exp(-f64::from(x) / 16_777_216.0), x);
            let v = (u64::from(w) << 32 | 0x9abc_def1) >> (i % 50);
            let l = e.above_log2(libm::log2(v as f64), v);
            let (y, x) = (w as i32, w.wrapping_mul(0x85eb_ca6b) as i32);
            let turns = std::f64::consts::FRAC_1_PI / 2.0 * libm::atan(f64::from(y) / f64::from(x));
            let turn = e.above_turn(if x < 0 { turns - 0.5 } else { turns }, y, x);
            for (off, most) in [(s, 2e-15), (c, 2e-15), (p, 3e-16), (l, 2e-14), (turn, 3e-16)] {
                assert!(off.abs() < most, "{off:e} at {i}");
            }
        }
    }
}
