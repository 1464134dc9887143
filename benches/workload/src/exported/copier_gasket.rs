//! The copier set to orders 0 to 6: a letter F becomes the Sierpinski gasket.
//!
//! Written by `attractor export --gallery copier-gasket`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::ifs::{Affine, Ifs};
use attractor::num::{Real, Unit};
use attractor::plane::Point2;
use attractor_gallery::Named;

const fn map([a, b, c, d]: [&str; 4], [e, f]: [&str; 2]) -> Affine {
    let linear = [Unit::lit(a), Unit::lit(b), Unit::lit(c), Unit::lit(d)];
    Affine::new(linear, [Real::lit(e), Real::lit(f)])
}

/// `x' = a x + b y + e`, `y' = c x + d y + f`.
#[rustfmt::skip]
pub static MAPS: [Affine; 3] = [
    map(["0.5", "0", "0", "0.5"], ["0", "0"]),
    map(["0.5", "0", "0", "0.5"], ["0.5", "0"]),
    map(["0.5", "0", "0", "0.5"], ["0.25", "0.5"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 3] = [
    Unit::lit("0.333333333"),
    Unit::lit("0.333333333"),
    Unit::lit("0.333333333"),
];

/// The system.
///
/// # Errors
/// [`Error::Capacity`] where there are more than `N` maps.
pub fn system<const N: usize>() -> Result<Ifs<N>, Error> {
    Ifs::<N>::new(&MAPS, &PROBABILITIES)
}

/// What is copied.
#[rustfmt::skip]
pub static POLYLINE: [Point2; 11] = [
    Point2::lit("0.2", "0"),
    Point2::lit("0.2", "1"),
    Point2::lit("0.8", "1"),
    Point2::lit("0.8", "0.8"),
    Point2::lit("0.4", "0.8"),
    Point2::lit("0.4", "0.6"),
    Point2::lit("0.65", "0.6"),
    Point2::lit("0.65", "0.4"),
    Point2::lit("0.4", "0.4"),
    Point2::lit("0.4", "0"),
    Point2::lit("0.2", "0"),
];

/// How often, a picture each.
pub const ORDERS: [u32; 7] = [0, 1, 2, 3, 4, 5, 6];

/// The highest of them: the least `DEPTH` of a copier.
pub const DEPTH: usize = 6;

/// Where its colours come from.
pub const PALETTE: Gradient<13> = gradients::EVEN;

/// The same by its name.
pub const NAMED: Named = Named::Even;
