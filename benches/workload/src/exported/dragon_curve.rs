//! The dragon curve of order 10 by the rewriting letters X and Y.
//!
//! Written by `attractor export --gallery dragon-curve`.

use attractor::Error;
use attractor::curve::LSystem;
use attractor::draw::{Gradient, gradients};
use attractor::num::Wide;
use attractor_gallery::{Named, Pencil};

/// What is rewritten.
pub const AXIOM: &str = "FX";

/// By what each letter is replaced.
#[rustfmt::skip]
pub static RULES: [(char, &str); 2] = [
    ('X', "X+YF+"),
    ('Y', "-FX-Y"),
];

/// Of a turn, in degrees.
pub const ANGLE: Wide = Wide::lit("90");

/// Where the turtle heads first, in degrees.
pub const HEADING: Wide = Wide::lit("90");

/// The system.
///
/// # Errors
/// None: those of [`LSystem::new`] do not occur with these words.
pub fn system() -> Result<LSystem<'static>, Error> {
    Ok(LSystem::new(AXIOM, &RULES, ANGLE)?.with_heading(HEADING))
}

/// How often it is rewritten: the least `ORDERS` of a path.
pub const ORDER: u32 = 10;

/// How many brackets are open at once: the least `BRANCHES` of a path.
pub const BRANCHES: usize = 0;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::FIRE;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Fire, closed: false };
