//! Koch's curve as an attractor, each quarter in a colour.
//!
//! Written by `attractor export --gallery koch-curve`.

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
    map(["0.333333333", "0", "0", "0.333333333"], ["0", "0"]),
    map(["0.166666667", "-0.288675135", "0.288675135", "0.166666667"], ["0.3333333", "0"]),
    map(["0.166666667", "0.288675135", "-0.288675135", "0.166666667"], ["0.5", "0.2886751"]),
    map(["0.333333333", "0", "0", "0.333333333"], ["0.6666667", "0"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 4] = [
    Unit::lit("0.25"),
    Unit::lit("0.25"),
    Unit::lit("0.25"),
    Unit::lit("0.25"),
];

/// The system.
///
/// # Errors
/// [`Error::Capacity`] where there are more than `N` maps.
pub fn system<const N: usize>() -> Result<Ifs<N>, Error> {
    Ifs::<N>::new(&MAPS, &PROBABILITIES)
}

/// How many points are drawn; none: 4 a pixel.
pub const POINTS: Option<u32> = None;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// The same by its name.
pub const NAMED: Named = Named::Ocean;

/// What decides the colour of a point.
pub const SHADING: Shading = Shading::Maps;
