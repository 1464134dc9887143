//! Dragon (Fractint's collection).
//!
//! Written by `attractor export --gallery dragon`.

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
pub static MAPS: [Affine; 2] = [
    map(["0.824074", "0.281482", "-0.212346", "0.864198"], ["-1.88229", "-0.110607"]),
    map(["0.088272", "0.520988", "-0.463889", "-0.377778"], ["0.78536", "8.095795"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 2] = [
    Unit::lit("0.787473"),
    Unit::lit("0.212527"),
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
