//! Figures that are known by their table of numbers only: those that came with Fractint.

use super::attractor::{Attractor, over};
use crate::ifs::affine::Affine;

/// A coral.
pub const CORAL: Attractor = Attractor {
    name: "coral",
    title: "Coral",
    source: "The Stone Soup Group, Fractint, file fractint.ifs, entry coral",
    maps: &[
        Affine::from_millionths([307_692, -531_469, -461_538, -293_706, 5_401_953, 8_655_175]),
        Affine::from_millionths([307_692, -76_923, 153_846, -447_552, -1_295_248, 4_152_990]),
        Affine::from_millionths([0, 545_455, 692_308, -195_804, -4_893_637, 7_269_794]),
    ],
    probabilities: &over([40, 15, 45], 100),
};

/// A crystal.
pub const CRYSTAL: Attractor = Attractor {
    name: "crystal",
    title: "Crystal",
    source: "The Stone Soup Group, Fractint, file fractint.ifs, entry crystal",
    maps: &[
        Affine::from_millionths([696_970, -481_061, -393_939, -662_879, 2_147_003, 10_310_288]),
        Affine::from_millionths([90_909, -443_182, 515_152, -94_697, 4_286_558, 2_925_762]),
    ],
    probabilities: &over([747_826, 252_174], 1_000_000),
};

/// A dragon of spirals.
pub const DRAGON: Attractor = Attractor {
    name: "dragon",
    title: "Dragon",
    source: "The Stone Soup Group, Fractint, file fractint.ifs, entry dragon",
    maps: &[
        Affine::from_millionths([824_074, 281_482, -212_346, 864_198, -1_882_290, -110_607]),
        Affine::from_millionths([88_272, 520_988, -463_889, -377_778, 785_360, 8_095_795]),
    ],
    probabilities: &over([787_473, 212_527], 1_000_000),
};

/// A spiral of spirals.
pub const SPIRAL: Attractor = Attractor {
    name: "spiral",
    title: "Spiral",
    source: "The Stone Soup Group, Fractint, file fractint.ifs, entry spiral",
    maps: &[
        Affine::from_millionths([787_879, -424_242, 242_424, 859_848, 1_758_647, 1_408_065]),
        Affine::from_millionths([-121_212, 257_576, 151_515, 53_030, -6_721_654, 1_377_236]),
        Affine::from_millionths([181_818, -136_364, 90_909, 181_818, 6_086_107, 1_568_035]),
    ],
    probabilities: &over([895_652, 52_174, 52_174], 1_000_000),
};
