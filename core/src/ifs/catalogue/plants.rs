//! Ferns, a tree, a leaf.

use super::attractor::{Attractor, over};
use crate::ifs::affine::Affine;

/// Barnsley's black spleenwort: stem, the frond without its lowest pair of leaves, the lowest left leaf, the
/// lowest right one.
pub const BARNSLEY_FERN: Attractor = Attractor {
    name: "barnsley-fern",
    title: "Barnsley's fern",
    source: "M. F. Barnsley, Fractals Everywhere, 1988, table 3.8.3",
    maps: &[
        Affine::from_thousandths([0, 0, 0, 160, 0, 0]),
        Affine::from_thousandths([850, 40, -40, 850, 0, 1600]),
        Affine::from_thousandths([200, -260, 230, 220, 0, 1600]),
        Affine::from_thousandths([-150, 280, 260, 240, 0, 440]),
    ],
    probabilities: &over([1, 85, 7, 7], 100),
};

/// A slender fern after *Cyclosorus*.
pub const CYCLOSORUS_FERN: Attractor = Attractor {
    name: "cyclosorus-fern",
    title: "Cyclosorus fern",
    source: "A variant of Barnsley's fern shaped after the Thelypteridaceae; from the tables of fern variants in circulation, author unknown",
    maps: &[
        Affine::from_thousandths([0, 0, 0, 250, 0, -400]),
        Affine::from_thousandths([950, 5, -5, 930, -2, 500]),
        Affine::from_thousandths([35, -200, 160, 40, -90, 20]),
        Affine::from_thousandths([-40, 200, 160, 40, 83, 120]),
    ],
    probabilities: &over([2, 84, 7, 7], 100),
};

/// A broad fern after *Culcita*.
pub const CULCITA_FERN: Attractor = Attractor {
    name: "culcita-fern",
    title: "Culcita fern",
    source: "A variant of Barnsley's fern shaped after Culcita; from the tables of fern variants in circulation, author unknown",
    maps: &[
        Affine::from_thousandths([0, 0, 0, 250, 0, -140]),
        Affine::from_thousandths([850, 20, -20, 830, 0, 1000]),
        Affine::from_thousandths([90, -280, 300, 110, 0, 600]),
        Affine::from_thousandths([-90, 280, 300, 90, 0, 700]),
    ],
    probabilities: &over([2, 84, 7, 7], 100),
};

/// Barnsley's tree: trunk, left and right crown, and a small copy in the fork.
pub const FRACTAL_TREE: Attractor = Attractor {
    name: "fractal-tree",
    title: "Barnsley's tree",
    source: "M. F. Barnsley, Fractals Everywhere, 1988, table 3.8.4",
    maps: &[
        Affine::from_thousandths([0, 0, 0, 500, 0, 0]),
        Affine::from_thousandths([420, -420, 420, 420, 0, 200]),
        Affine::from_thousandths([420, 420, -420, 420, 0, 200]),
        Affine::from_thousandths([100, 0, 0, 100, 0, 200]),
    ],
    probabilities: &over([5, 40, 40, 15], 100),
};

/// A maple leaf: stalk, the right lobe, the left one, the top one.
pub const MAPLE_LEAF: Attractor = Attractor {
    name: "maple-leaf",
    title: "Maple leaf",
    source: "After M. F. Barnsley's collages; table in P. Bourke, Fractals: iterated function systems",
    maps: &[
        Affine::from_thousandths([140, 10, 0, 510, -80, -1310]),
        Affine::from_thousandths([430, 520, -450, 500, 1490, -750]),
        Affine::from_thousandths([450, -490, 470, 470, -1620, -740]),
        Affine::from_thousandths([490, 0, 0, 510, 20, 1620]),
    ],
    probabilities: &over([10, 35, 35, 20], 100),
};
