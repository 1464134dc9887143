//! Cantor's set, FfF, along 36 rays.
//!
//! Written by `attractor export --gallery cantor`.

use attractor::Error;
use attractor::curve::LSystem;
use attractor::draw::{Gradient, gradients};
use attractor::num::Wide;
use attractor_gallery::{Named, Pencil};

/// What is rewritten.
pub const AXIOM: &str = "A";

/// By what each letter is replaced.
#[rustfmt::skip]
pub static RULES: [(char, &str); 5] = [
    ('A', "BBBBBB"),
    ('B', "CCCCCC"),
    ('C', "[F]+"),
    ('F', "FfF"),
    ('f', "fff"),
];

/// Of a turn, in degrees.
pub const ANGLE: Wide = Wide::lit("10");

/// Where the turtle heads first, in degrees.
pub const HEADING: Wide = Wide::lit("0");

/// The system.
///
/// # Errors
/// None: those of [`LSystem::new`] do not occur with these words.
pub fn system() -> Result<LSystem<'static>, Error> {
    Ok(LSystem::new(AXIOM, &RULES, ANGLE)?.with_heading(HEADING))
}

/// How often it is rewritten: the least `ORDERS` of a path.
pub const ORDER: u32 = 6;

/// How many brackets are open at once: the least `BRANCHES` of a path.
pub const BRANCHES: usize = 1;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Ocean, closed: false };
