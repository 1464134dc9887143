//! Barnsley's fern (Fractals Everywhere, table 3.8.3).
//!
//! Written by `attractor export --gallery fern`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::ifs::{Affine, Ifs};
use attractor::num::{Real, Unit};
use attractor_gallery::{Named, Shading};

const fn map([a, b, c, d]: [&str; 4], [e, f]: [&str; 2]) -> Affine {
    let linear = [Unit::lit(a), Unit::lit(b), Unit::lit(c), Unit::lit(d)];
    Affine::new(linear, [Real::lit(e), Real::lit(f)])
}

/// `x' = a x + b y + e`, `y' = c x + d y + f`.
#[rustfmt::skip]
pub static MAPS: [Affine; 4] = [
    map(["0", "0", "0", "0.16"], ["0", "0"]),
    map(["0.85", "0.04", "-0.04", "0.85"], ["0", "1.6"]),
    map(["0.2", "-0.26", "0.23", "0.22"], ["0", "1.6"]),
    map(["-0.15", "0.28", "0.26", "0.24"], ["0", "0.44"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 4] = [
    Unit::lit("0.01"),
    Unit::lit("0.85"),
    Unit::lit("0.07"),
    Unit::lit("0.07"),
];

/// The system.
///
/// # Errors
/// [`Error::Capacity`] where there are more than `N` maps.
pub fn system<const N: usize>() -> Result<Ifs<N>, Error> {
    Ifs::<N>::new(&MAPS, &PROBABILITIES)
}

/// How many points are drawn; none: 16 a pixel. Their density takes a `u16` for each pixel of lent memory.
pub const POINTS: Option<u32> = None;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// The same by its name.
pub const NAMED: Named = Named::Moss;

/// What decides the colour of a point.
pub const SHADING: Shading = Shading::Density;
