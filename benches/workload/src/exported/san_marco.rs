//! The Julia set of c = -3/4, every pixel that it meets: San Marco.
//!
//! Written by `attractor export --gallery san-marco`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::escape::JuliaSet;
use attractor::num::{Complex, Wide};
use attractor_gallery::{Method, Named};

/// The constant of the set.
pub const C: Complex<Wide> = Complex::lit("-0.75", "0");

/// The set.
///
/// # Errors
/// None: those of [`JuliaSet::new`] do not occur with this constant.
pub fn set() -> Result<JuliaSet, Error> {
    JuliaSet::new(C)
}

/// Every pixel is covered for itself: there are no points.
pub const POINTS: Option<u32> = None;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// The same by its name.
pub const NAMED: Named = Named::Ocean;

/// How it is found.
pub const METHOD: Method = Method::Cover;
