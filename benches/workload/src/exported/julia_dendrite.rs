//! The Julia set of c = i, every pixel that it meets: a dendrite.
//!
//! Written by `attractor export --gallery julia-dendrite`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::escape::JuliaSet;
use attractor::num::{Complex, Wide};
use attractor_gallery::{Method, Named};

/// The constant of the set.
pub const C: Complex<Wide> = Complex::lit("0", "1");

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
pub const PALETTE: Gradient<13> = gradients::EVEN;

/// The same by its name.
pub const NAMED: Named = Named::Even;

/// How it is found.
pub const METHOD: Method = Method::Cover;
