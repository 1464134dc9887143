//! The outline of Douady's rabbit by plain backward iteration, a coin flip a point.
//!
//! Written by `attractor export --gallery rabbit-outline`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::escape::JuliaSet;
use attractor::num::{Complex, Wide};
use attractor_gallery::{Method, Named};

/// The constant of the set.
pub const C: Complex<Wide> = Complex::lit("-0.123", "0.745");

/// The set.
///
/// # Errors
/// None: those of [`JuliaSet::new`] do not occur with this constant.
pub fn set() -> Result<JuliaSet, Error> {
    JuliaSet::new(C)
}

/// How many points are drawn; none: 8 a pixel. Their density takes a `u16` for each pixel of lent memory.
pub const POINTS: Option<u32> = Some(400000);

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::DUSK;

/// The same by its name.
pub const NAMED: Named = Named::Dusk;

/// How it is found.
pub const METHOD: Method = Method::Plain;
