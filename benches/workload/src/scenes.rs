//! Whole pictures, drawn as firmware would draw them.
//!
//! To add one: write a function that builds its objects, [claims](crate::sink::Stage::claim) their RAM and
//! [shows](crate::sink::Stage::show) them, and add a line to `own::ROWS`. The function takes the size from
//! the stage, so that one function serves several lines. A built-in scene of the command is a line of
//! `built_in::PAIRS`, `WORLDS` or `IN_MONO`.

use crate::built_in::{IMAGES, IN_MONO, PAIRS, WORLDS as BUILT_IN_WORLDS};
use crate::machine::SMALL;
use crate::own::{self, ROWS};

pub use crate::scene::Scene;

/// The target's own scenes and the built-in scenes of the command; in an image for Armv6-M those that it can
/// draw.
pub static ALL: &[Scene] = &{
    let mut all = [ROWS[0]; count(ROWS.len() + BUILT_IN.len())];
    let (mut i, mut kept) = (0, 0);
    while kept < all.len() {
        if fits(i) {
            all[kept] = row(i);
            kept += 1;
        }
        i += 1;
    }
    all
};

/// Worlds and textures, which have an image of their own; none on Armv6-M.
pub static WORLDS: &[Scene] = if SMALL {
    &[]
} else {
    const PARTS: [&[Scene]; 3] = [own::WORLDS, BUILT_IN_WORLDS.as_flattened(), IN_MONO];
    &joined::<{ PARTS[0].len() + PARTS[1].len() + PARTS[2].len() }>(PARTS)
};

/// Encoded pictures, which have an image of their own; none on Armv6-M.
pub static CODED: &[Scene] = if SMALL { &[] } else { IMAGES.as_flattened() };

/// All tables, each with the image that draws it.
pub static TABLES: [(&str, &[Scene]); 3] = [("scenes", ALL), ("worlds", WORLDS), ("images", CODED)];

/// A mirror whose pyramid is larger than the RAM of any of the targets: each must refuse it.
pub static TOO_LARGE: Scene = own::TOO_LARGE;

const BUILT_IN: &[Scene] = PAIRS.as_flattened();

const fn row(i: usize) -> Scene {
    if i < ROWS.len() { ROWS[i] } else { BUILT_IN[i - ROWS.len()] }
}

const fn joined<const N: usize>(parts: [&[Scene]; 3]) -> [Scene; N] {
    let (mut all, mut k, mut part) = ([parts[0][0]; N], 0, 0);
    while part < parts.len() {
        let mut i = 0;
        while i < parts[part].len() {
            all[k] = parts[part][i];
            (k, i) = (k + 1, i + 1);
        }
        part += 1;
    }
    all
}

const fn fits(i: usize) -> bool {
    row(i).small || !SMALL
}

const fn count(rows: usize) -> usize {
    let (mut i, mut kept) = (0, 0);
    while i < rows {
        kept += fits(i) as usize;
        i += 1;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Blind, Machine};
    use crate::sink::Failure;

    /// With as much RAM as the largest target.
    struct Board;

    impl Machine for Board {
        fn instructions(&mut self) -> u32 {
            0
        }

        fn ram_free(&mut self) -> usize {
            128 << 10
        }
    }

    #[test]
    fn a_scene_too_large_for_a_board_is_refused_there_and_drawn_here() {
        let cells = 16 * ((1 << 14) - 1);
        let refused = TOO_LARGE.run(&mut Board).unwrap_err();
        assert!(matches!(refused, Failure::Ram { needed, .. } if needed > cells), "{refused}");
        assert!(TOO_LARGE.run(&mut Blind).unwrap().ram_bytes > cells);
    }
}
