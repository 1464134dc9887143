//! Figure 1, left: f through (0,0) (1,1) (2,0), vertical scalings 1/2 (Takagi's curve).
//!
//! Written by `attractor export --gallery figure-1-f`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::fif::{Fif, Knot};
use attractor::num::Scaling;
use attractor_gallery::Named;

/// Where the graph passes.
#[rustfmt::skip]
pub static KNOTS: [Knot; 3] = [
    Knot::lit("0", "0"),
    Knot::lit("1", "1"),
    Knot::lit("2", "0"),
];

/// One for each interval.
#[rustfmt::skip]
pub static VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.5"),
    Scaling::lit("0.5"),
];

/// Its maps: the least `N`.
pub const MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const DEGREE: usize = 1;

/// The function.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn function<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    Fif::<N, D>::interpolating(&KNOTS, &VERTICAL_SCALINGS)
}

/// The maps whose intervals are shown below the graph, by index from 0, the outermost first.
pub const ADDRESS: [usize; 0] = [];

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// The same by its name.
pub const NAMED: Named = Named::Ocean;
