//! Self-similar curves from `(0, 0)` to `(1, 0)`, and the tile that two dragons make.

use super::attractor::{Attractor, equal};
use crate::ifs::affine::Affine;

/// Coefficients with eight decimals.
const fn e8(coefficients: [i32; 6]) -> Affine {
    Affine::from_ratios(coefficients, 100_000_000)
}

/// `sqrt(3) / 6`, with eight decimals.
const ROOT_3_6: i32 = 28_867_513;

/// The Koch curve over the segment from `(0, 0)` to `(1, 0)`: turns of 60, -120 and 60 degrees.
pub const KOCH_CURVE: Attractor = Attractor {
    name: "koch-curve",
    title: "Koch curve",
    source: "H. von Koch, Sur une courbe continue sans tangente, 1904",
    maps: &[
        Affine::from_ratios([1, 0, 0, 1, 0, 0], 3),
        e8([16_666_667, -ROOT_3_6, ROOT_3_6, 16_666_667, 33_333_333, 0]),
        e8([16_666_667, ROOT_3_6, -ROOT_3_6, 16_666_667, 50_000_000, ROOT_3_6]),
        Affine::from_ratios([1, 0, 0, 1, 2, 0], 3),
    ],
    probabilities: &equal::<4>(),
};

/// Heighway's dragon: `z (1 + i) / 2` and `1 - z (1 - i) / 2`.
pub const HEIGHWAY_DRAGON: Attractor = Attractor {
    name: "heighway-dragon",
    title: "Heighway dragon",
    source: "C. Davis and D. E. Knuth, Number representations and dragon curves, 1970",
    maps: &[
        Affine::from_thousandths([500, -500, 500, 500, 0, 0]),
        Affine::from_thousandths([-500, -500, 500, -500, 1000, 0]),
    ],
    probabilities: &equal::<2>(),
};

/// Levy's C curve: `z (1 + i) / 2` and `(1 + i) / 2 + z (1 - i) / 2`.
pub const LEVY_C_CURVE: Attractor = Attractor {
    name: "levy-c-curve",
    title: "Levy C curve",
    source: "P. Levy, Les courbes planes ou gauches et les surfaces composees de parties semblables au tout, 1938",
    maps: &[
        Affine::from_thousandths([500, -500, 500, 500, 0, 0]),
        Affine::from_thousandths([500, 500, -500, 500, 500, 500]),
    ],
    probabilities: &equal::<2>(),
};

/// The terdragon: three segments of length `1/sqrt(3)`, turns of 120 and -120 degrees.
pub const TERDRAGON: Attractor = Attractor {
    name: "terdragon",
    title: "Terdragon",
    source: "C. Davis and D. E. Knuth, Number representations and dragon curves, 1970",
    maps: &[
        e8([50_000_000, ROOT_3_6, -ROOT_3_6, 50_000_000, 0, 0]),
        e8([0, -57_735_027, 57_735_027, 0, 50_000_000, -ROOT_3_6]),
        e8([50_000_000, ROOT_3_6, -ROOT_3_6, 50_000_000, 50_000_000, ROOT_3_6]),
    ],
    probabilities: &equal::<3>(),
};

/// The twindragon: the fractions `0.d1 d2 d3 ..` in base `i - 1` with digits 0 and 1, `z / (i - 1)` and
/// `(z + 1) / (i - 1)`. Its area is 1.
pub const TWINDRAGON: Attractor = Attractor {
    name: "twindragon",
    title: "Twindragon",
    source: "D. E. Knuth, The Art of Computer Programming, volume 2, section 4.1: fractions in base i - 1",
    maps: &[
        Affine::from_thousandths([-500, 500, -500, -500, 0, 0]),
        Affine::from_thousandths([-500, 500, -500, -500, -500, -500]),
    ],
    probabilities: &equal::<2>(),
};

/// McWorter's pentigree: six segments of length `(3 - sqrt(5)) / 2` in the directions 36, 108, -36, -108, -36
/// and 36 degrees.
pub const PENTIGREE: Attractor = Attractor {
    name: "pentigree",
    title: "McWorter's pentigree",
    source: "W. A. McWorter, Byte, 1987; construction in L. Riddle, Classic Iterated Function Systems",
    maps: &[
        e8([30_901_699, -22_451_399, 22_451_399, 30_901_699, 0, 0]),
        e8([-11_803_399, -36_327_126, 36_327_126, -11_803_399, 30_901_699, 22_451_399]),
        e8([30_901_699, 22_451_399, -22_451_399, 30_901_699, 19_098_301, 58_778_525]),
        e8([-11_803_399, 36_327_126, -36_327_126, -11_803_399, 50_000_000, 36_327_126]),
        e8([30_901_699, 22_451_399, -22_451_399, 30_901_699, 38_196_601, 0]),
        e8([30_901_699, -22_451_399, 22_451_399, 30_901_699, 69_098_301, -22_451_399]),
    ],
    probabilities: &equal::<6>(),
};
