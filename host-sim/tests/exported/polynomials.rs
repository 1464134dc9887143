//! A parabola on the left, integrated twice.
//!
//! Written by `attractor export polynomials`.

use attractor::Error;
use attractor::draw::Grey;
use attractor::fif::Fif;
use attractor::num::{Scaling, Wide};

/// The ends of the intervals.
#[rustfmt::skip]
pub static ABSCISSAE: [Wide; 3] = [
    Wide::lit("0"),
    Wide::lit("1"),
    Wide::lit("2"),
];

/// One for each interval: coefficients in x, constant first.
#[rustfmt::skip]
pub static POLYNOMIALS: [&[Wide]; 2] = [
    &[Wide::lit("0"), Wide::lit("0"), Wide::lit("0.25")],
    &[Wide::lit("1"), Wide::lit("-0.5")],
];

/// One for each interval.
#[rustfmt::skip]
pub static VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.5"),
    Scaling::lit("-0.3"),
];

/// Its maps: the least `N`.
pub const MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const DEGREE: usize = 4;

/// The function through the knots, integrated 2 times.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn function<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    let f = Fif::<N, D>::from_polynomials(&ABSCISSAE, &VERTICAL_SCALINGS, &POLYNOMIALS)?;
    let f = f.integral::<D>(Wide::ZERO)?;
    f.integral::<D>(Wide::ZERO)
}

/// The maps whose intervals are shown below the graph, by index from 0, the outermost first.
pub const ADDRESS: [usize; 2] = [1, 0];

/// Where its colours come from.
pub const PALETTE: Grey = Grey;
