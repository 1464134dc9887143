//! Spiral (Fractint's collection).
//!
//! Written by `attractor export --gallery spiral`.

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
pub static MAPS: [Affine; 3] = [
    map(["0.787879", "-0.424242", "0.242424", "0.859848"], ["1.758647", "1.408065"]),
    map(["-0.121212", "0.257576", "0.151515", "0.05303"], ["-6.721654", "1.377236"]),
    map(["0.181818", "-0.136364", "0.090909", "0.181818"], ["6.086107", "1.568035"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 3] = [
    Unit::lit("0.895652"),
    Unit::lit("0.052174"),
    Unit::lit("0.052174"),
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
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// The same by its name.
pub const NAMED: Named = Named::Ocean;

/// What decides the colour of a point.
pub const SHADING: Shading = Shading::Density;
