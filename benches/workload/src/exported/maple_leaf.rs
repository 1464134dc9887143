//! A maple leaf: stalk and three lobes.
//!
//! Written by `attractor export --gallery maple-leaf`.

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
    map(["0.14", "0.01", "0", "0.51"], ["-0.08", "-1.31"]),
    map(["0.43", "0.52", "-0.45", "0.5"], ["1.49", "-0.75"]),
    map(["0.45", "-0.49", "0.47", "0.47"], ["-1.62", "-0.74"]),
    map(["0.49", "0", "0", "0.51"], ["0.02", "1.62"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 4] = [
    Unit::lit("0.1"),
    Unit::lit("0.35"),
    Unit::lit("0.35"),
    Unit::lit("0.2"),
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
pub const PALETTE: Gradient<9> = gradients::FIRE;

/// The same by its name.
pub const NAMED: Named = Named::Fire;

/// What decides the colour of a point.
pub const SHADING: Shading = Shading::Density;
