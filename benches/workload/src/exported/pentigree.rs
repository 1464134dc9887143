//! McWorter's pentigree: six copies around a pentagon's corners.
//!
//! Written by `attractor export --gallery pentigree`.

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
pub static MAPS: [Affine; 6] = [
    map(["0.30901699", "-0.22451399", "0.22451399", "0.30901699"], ["0", "0"]),
    map(["-0.11803399", "-0.36327126", "0.36327126", "-0.11803399"], ["0.309017", "0.224514"]),
    map(["0.30901699", "0.22451399", "-0.22451399", "0.30901699"], ["0.190983", "0.58778524"]),
    map(["-0.11803399", "0.36327126", "-0.36327126", "-0.11803399"], ["0.5", "0.36327124"]),
    map(["0.30901699", "0.22451399", "-0.22451399", "0.30901699"], ["0.381966", "0"]),
    map(["0.30901699", "-0.22451399", "0.22451399", "0.30901699"], ["0.690983", "-0.224514"]),
];

/// One for each map.
#[rustfmt::skip]
pub static PROBABILITIES: [Unit; 6] = [
    Unit::lit("0.166666667"),
    Unit::lit("0.166666667"),
    Unit::lit("0.166666667"),
    Unit::lit("0.166666667"),
    Unit::lit("0.166666667"),
    Unit::lit("0.166666667"),
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
pub const PALETTE: Gradient<13> = gradients::EVEN;

/// The same by its name.
pub const NAMED: Named = Named::Even;

/// What decides the colour of a point.
pub const SHADING: Shading = Shading::Maps;
