//! Numbers: the formats of the project and the arithmetic that `fixed` does not have.
//!
#![doc = include_str!("../../docs/num.md")]
//!
//! A spiral of the Mandelbrot set, `1.2e-6` wide: on the left at the points that [`Real`] has, `2^-24` apart,
//! on the right at those of [`Wide`], which has `2^24` steps between two of them.
//!
//! | type | format | resolution | used for |
//! | --- | --- | --- | --- |
//! | [`Real`] | I8F24 | 6e-8 | coordinates, heights, distances |
//! | [`Unit`] | I2F30 | 9e-10 | direction cosines, weights, matrix entries |
//! | [`Near`] | I4F28 | 4e-9 | places near a shape, in its own coordinates |
//! | [`Lumen`] | U16F16 | 2e-5 | light: red, green, blue |
//! | [`Scaling`] | I1F31 | 5e-10 | contraction factors, strictly inside (-1, 1) |
//! | [`Wide`] | I16F48 | 4e-15 | abscissae and descriptions: what a scene says before it is compiled |
//! | [`Limbs`] | 4 bits and as many 32-bit limbs as it takes | 2^-(32 n - 4) | coordinates of deep zooms |
//!
//! Ranges are checked in constructors; after that no operation of a kernel can wrap visibly.
//!
//! # Numbers
//!
//! All formats but [`Limbs`] are types of the crate [`fixed`], which is re-exported: `attractor::fixed`.
//! There are four ways to a number.
//!
//! **A constant: `lit`.** The decimal is read at compile time and rounded to nearest; one that is no number,
//! or does not fit, does not compile.
//!
//! ```
//! use attractor::num::Complex;
//! use attractor::fif::Knot;
//! use attractor::num::{Real, Scaling, Vec3, Wide};
//! use attractor::plane::Point2;
//!
//! const WIDTH: Wide = Wide::lit("0.0065");
//! const SLOPE: Scaling = Scaling::lit("-0.85");
//! const SEAHORSE: Complex<Wide> = Complex::lit("-0.7453", "0.1127");
//! const KNOTS: [Knot; 3] = [Knot::lit("0", "0"), Knot::lit("0.5", "1"), Knot::lit("1", "0")];
//! const EYE: Vec3 = Vec3::lit("-4", "-3", "5");
//! const TIP: Point2 = Point2::lit("0.5", "0.8660254");
//! // in the middle of an expression: a block that is evaluated at compile time
//! let quarter = const { Real::lit("0.25") };
//! assert_eq!((quarter * 4, SEAHORSE.re < WIDTH, KNOTS[1].y, EYE.z), (Real::ONE, true, Wide::ONE, Real::lit("5")));
//! # let _ = (SLOPE, TIP);
//! ```
//!
//! ```compile_fail,E0080
//! # use attractor::num::Real;
//! const TOO_LARGE: Real = Real::lit("128");
//! # let _ = TOO_LARGE;
//! ```
//!
//! Outside a `const` the same call reads its text at run time: it may panic, and one such call costs 6 KB of
//! flash on a Cortex-M4, 11 KB with a panic handler that prints (`opt-level = 3`, fat LTO). The other three
//! ways need no text.
//!
//! **A whole number or a ratio:** `Real::from_num(3)`, `Real::from_num(1) / 3`; coefficients by
//! [`Affine::from_thousandths`](crate::ifs::Affine::from_thousandths). `from_num` panics for a number that
//! does not fit; `saturating_from_num` and `checked_from_num` do not.
//!
//! **Bits:** `Unit::from_bits(1 << 29)` is a half. What `attractor export` writes, and what a file or a link
//! carries.
//!
//! **A float:** `Real::from_num(x)` for `x: f32` works, and on a processor without an FPU costs what
//! converting takes. On the host it is convenient; the examples in this documentation use it where the number
//! does not matter.

mod affine3;
mod alias;
mod atan;
mod complex;
mod decimal;
mod exponential;
pub(crate) mod formats;
mod limbs;
mod logarithm;
mod product;
mod quantiles;
mod quotient;
mod random_field;
mod random_function;
mod rgb;
mod root;
mod roughness;
mod trig;
mod vector;
mod wide;
mod zeros;

pub use affine3::Affine3;
pub use alias::Alias;
pub use atan::atan2;
pub use complex::Complex;
pub use decimal::limbs_for;
pub use exponential::exp_minus;
pub(crate) use exponential::exp2_minus;
pub use formats::{Lumen, Near, Real, Scaling, Unit, Wide};
pub use limbs::Limbs;
pub use logarithm::log2;
pub(crate) use product::{
    complex_product_added, product, product_shifted, product_u, product_within, square_u,
};
pub(crate) use product::{high, high_of_double, high_of_square, high_rounded, high_u, rounded_down};
pub use quantiles::Deviate;
pub(crate) use quantiles::magnitudes;
pub(crate) use quotient::{nth, quotient, ratio};
pub use random_field::{Coordinate, RandomField};
pub(crate) use random_function::mixed;
pub use random_function::{Parameter, RandomFunction};
pub use rgb::Rgb;
pub use root::{reciprocal, reciprocal_sqrt, sqrt};
pub(crate) use root::{reciprocal_of, reciprocal_sqrt_of, reciprocal_sqrt_of_long};
pub(crate) use root::{root_and_reciprocal, root_of_word, rough_sqrt, sqrt_short};
pub(crate) use roughness::{checked_offset, decay, offsets};
pub use trig::{Angle, sin_cos};
pub use vector::Vec3;
pub(crate) use vector::{square, unit};
pub use wide::{Reciprocal, mul_high, mul_high_u, round_shift, scale31};
pub(crate) use wide::{mul_high_short, real_from, scaled};
pub(crate) use zeros::even_zeros;
