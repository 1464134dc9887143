//! Every 32-bit input of the elementary functions against a truth that is better by `2^-30`: no sample can
//! miss the worst one.
//!
//! A function of 64 bits is asked for three families of `2^32` inputs: the word `h` as such, `h 2^32`, and
//! `h 2^32 + 2^32 - 1`. The kernels use the upper 32 significant bits at most, so the latter two hold, for
//! each that a kernel can see, the least and the greatest number behind them.
//!
//! The angle of a vector hangs on the quotient of its components alone, and on their signs: it is asked for
//! every `y` beside an `x` with as many bits as there are and beside one whose reciprocal is rounded most.

use attractor::num::{self, Angle, Real};
use attractor_reference::Elementary;

use crate::accuracy::two_to;

/// A function and its errors.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// The kernel.
    pub name: &'static str,
    /// What is swept.
    pub inputs: &'static str,
    /// The bound that its documentation promises.
    pub bound: f64,
    /// The magnitude of the error at one input; of the largest, where a word stands for several.
    pub error: fn(&Elementary, u32) -> f64,
}

/// All of them.
pub const ALL: [Sweep; 9] = [
    Sweep {
        name: "sin_cos",
        inputs: "every angle, the worse of sine and cosine",
        bound: 1.0 / (1_u64 << 28) as f64,
        error: sin_cos,
    },
    Sweep { name: "exp_minus", inputs: "every Real", bound: 1.0 / (1_u64 << 29) as f64, error: exp_minus },
    Sweep {
        name: "atan2",
        inputs: "every y with x = 2^31 - 1 and with x = -2^30 - 1, in turns",
        bound: 5.0 / (1_u64 << 32) as f64,
        error: atan2,
    },
    Sweep { name: "log2", inputs: "every h", bound: 1.0 / (1_u64 << 24) as f64, error: log2_low },
    Sweep {
        name: "log2 of 64 bits",
        inputs: "h 2^32 and h 2^32 + 2^32 - 1 for every h",
        bound: 1.0 / (1_u64 << 24) as f64,
        error: log2_high,
    },
    Sweep {
        name: "reciprocal",
        inputs: "every d, relative",
        bound: 1.0 / (1_u64 << 29) as f64,
        error: reciprocal,
    },
    Sweep {
        name: "reciprocal_sqrt",
        inputs: "every h, relative",
        bound: 1.0 / (1_u64 << 29) as f64,
        error: reciprocal_sqrt_low,
    },
    Sweep {
        name: "reciprocal_sqrt of 64 bits",
        inputs: "h 2^32 and h 2^32 + 2^32 - 1 for every h, relative",
        bound: 1.0 / (1_u64 << 29) as f64,
        error: reciprocal_sqrt_high,
    },
    Sweep {
        name: "sqrt",
        inputs: "h, h 2^32 and h 2^32 + 2^32 - 1 for every h, in units",
        bound: 0.0,
        error: sqrt,
    },
];

/// The least and the greatest number of 64 bits that begin with this word.
fn ends(h: u32) -> [u64; 2] {
    [u64::from(h) << 32, u64::from(h) << 32 | 0xffff_ffff]
}

fn sin_cos(truth: &Elementary, word: u32) -> f64 {
    let (sin, cos) = num::sin_cos(Angle::from_bits(word));
    let (s, c) = truth.above_sin_cos((sin.to_num(), cos.to_num()), word);
    s.abs().max(c.abs())
}

fn exp_minus(truth: &Elementary, word: u32) -> f64 {
    let x = Real::from_bits(word as i32);
    // less than 0 counts as 0
    truth.above_exp_minus(num::exp_minus(x).to_num(), x.to_bits().max(0).unsigned_abs()).abs()
}

/// In turns.
fn atan2(truth: &Elementary, word: u32) -> f64 {
    let y = word as i32;
    let off = |x: i32| truth.above_turn(num::atan2(y, x).to_num(), y, x).abs();
    off(i32::MAX).max(off(-(1 << 30) - 1))
}

fn log2(truth: &Elementary, v: u64) -> f64 {
    // 0 counts as 1
    truth.above_log2(f64::from(num::log2(v)) / two_to(24), v.max(1)).abs()
}

fn log2_low(truth: &Elementary, word: u32) -> f64 {
    log2(truth, word.into())
}

fn log2_high(truth: &Elementary, word: u32) -> f64 {
    ends(word).into_iter().map(|v| log2(truth, v)).fold(0.0, f64::max)
}

fn reciprocal(_: &Elementary, word: u32) -> f64 {
    let (mantissa, shift) = num::reciprocal(word);
    // 0 counts as 1; the product is exact, below 2^63
    let product = u64::from(mantissa) * u64::from(word.max(1));
    product.abs_diff(1 << shift) as f64 / two_to(shift as i32)
}

fn reciprocal_sqrt(v: u64) -> f64 {
    let (mantissa, shift) = num::reciprocal_sqrt(v);
    // (1 + e)^2 = m^2 v / 2^(2 shift): an exact product of at most 126 bits
    let square = u128::from(u64::from(mantissa) * u64::from(mantissa)) * u128::from(v.max(1));
    let one = 1_u128 << (2 * shift);
    let excess = square.abs_diff(one) as f64 / one as f64;
    let signed = if square < one { -excess } else { excess };
    (signed / (1.0 + (1.0 + signed).sqrt())).abs()
}

fn reciprocal_sqrt_low(_: &Elementary, word: u32) -> f64 {
    reciprocal_sqrt(word.into())
}

fn reciprocal_sqrt_high(_: &Elementary, word: u32) -> f64 {
    ends(word).into_iter().map(reciprocal_sqrt).fold(0.0, f64::max)
}

fn sqrt(_: &Elementary, word: u32) -> f64 {
    let [least, greatest] = ends(word);
    let off = |v: u64| u64::from(num::sqrt(v)).abs_diff(v.isqrt());
    off(word.into()).max(off(least)).max(off(greatest)) as f64
}
