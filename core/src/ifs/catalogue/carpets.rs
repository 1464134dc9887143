//! Copies of the whole, smaller and not turned: gaskets, carpets, dusts.

use super::attractor::{Attractor, equal};
use crate::ifs::affine::Affine;

/// Scaled by `1/2`, its corner moved to `(e, f)` quarters.
const fn half(e: i32, f: i32) -> Affine {
    Affine::from_ratios([2, 0, 0, 2, e, f], 4)
}

/// Scaled by `1/3`, its corner moved to `(e, f)` thirds.
const fn third(e: i32, f: i32) -> Affine {
    Affine::from_ratios([1, 0, 0, 1, e, f], 3)
}

/// The Sierpinski gasket on the triangle `(0, 0) (1, 0) (1/2, 1)`.
pub const SIERPINSKI_GASKET: Attractor = Attractor {
    name: "sierpinski-gasket",
    title: "Sierpinski gasket",
    source: "W. Sierpinski, 1915; corners as in M. F. Barnsley, Fractals Everywhere, table 3.8.1, scaled to 1",
    maps: &[half(0, 0), half(2, 0), half(1, 2)],
    probabilities: &equal::<3>(),
};

/// The Sierpinski carpet on the unit square.
pub const SIERPINSKI_CARPET: Attractor = Attractor {
    name: "sierpinski-carpet",
    title: "Sierpinski carpet",
    source: "W. Sierpinski, 1916: the square without its middle ninth",
    maps: &[
        third(0, 0),
        third(1, 0),
        third(2, 0),
        third(0, 1),
        third(2, 1),
        third(0, 2),
        third(1, 2),
        third(2, 2),
    ],
    probabilities: &equal::<8>(),
};

/// The Vicsek box on the unit square.
pub const VICSEK_BOX: Attractor = Attractor {
    name: "vicsek-box",
    title: "Vicsek box",
    source: "T. Vicsek, Fractal models for diffusion controlled aggregation, 1983: the corners and the middle of nine squares",
    maps: &[third(0, 0), third(2, 0), third(1, 1), third(0, 2), third(2, 2)],
    probabilities: &equal::<5>(),
};

/// The product of two middle-third Cantor sets, on the unit square.
pub const CANTOR_DUST: Attractor = Attractor {
    name: "cantor-dust",
    title: "Cantor dust",
    source: "G. Cantor, 1883, the middle-third set times itself: the corners of nine squares",
    maps: &[third(0, 0), third(2, 0), third(0, 2), third(2, 2)],
    probabilities: &equal::<4>(),
};
