//! What iterators and decoders take on a 32-bit machine, checked where they are compiled: the sizes that
//! core's documentation states.

use core::iter::Copied;
use core::slice::Iter;

use attractor::codec::{Stream, Sweeps};
use attractor::curve::{Elbow, Generator, LSystem, OneVariable, Refined, Subdivision, Turtle, TwoVariable};
use attractor::ifs::{CopiedPath, CopiedPoints, Ifs};
use attractor::plane::Density;

/// Order 12 of the Koch curve and depth 12 of a copier may take so much.
const MOST: usize = 600;

/// Bytes of a stream in flash.
type Bytes<'a> = Copied<Iter<'a, u8>>;

const _: () = {
    assert!(size_of::<Stream<'_, u8, Bytes<'_>>>() <= 3770);
    assert!(size_of::<Sweeps<'_, u8, Bytes<'_>>>() <= 512);
    assert!(size_of::<Refined<'_, 4, 12>>() <= MOST && size_of::<Refined<'_, 4, 12>>() == 32 * 12 + 72);
    assert!(size_of::<CopiedPath<'_, 4, 12>>() <= MOST && size_of::<CopiedPath<'_, 4, 12>>() == 40 * 12 + 72);
    assert!(size_of::<CopiedPoints<'_, 4, 12>>() == size_of::<CopiedPath<'_, 4, 12>>());
    assert!(size_of::<Subdivision<'_, Elbow, 16>>() == 12 * 16 + 88);
    assert!(size_of::<Elbow>() == 136 && size_of::<OneVariable>() == 12 && size_of::<TwoVariable>() == 12);
    assert!(size_of::<Generator<4>>() == 64 * 4 + 16 && size_of::<Generator<9>>() == 64 * 9 + 16);
    assert!(size_of::<LSystem<'_>>() == 32 && size_of::<Turtle<'_, 12, 12>>() == 8 * 12 + 24 * 12 + 88);
    // the second without a long product, the third without a carry
    assert!(matches!(size_of::<Ifs<4>>(), 296 | 328 | 168));
    assert!(296 == 65 * 4 + 36 && 328 == 73 * 4 + 36 && 168 == 33 * 4 + 36);
    assert!(size_of::<Density<'_, u16>>() == 88 && size_of::<Density<'_, u8>>() == 88);
};
