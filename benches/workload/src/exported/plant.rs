//! A plant with branches: The Algorithmic Beauty of Plants, figure 1.24 f.
//!
//! Written by `attractor export --gallery plant`.

use attractor::Error;
use attractor::curve::LSystem;
use attractor::draw::{Gradient, gradients};
use attractor::num::Wide;
use attractor_gallery::{Named, Pencil};

/// What is rewritten.
pub const AXIOM: &str = "X";

/// By what each letter is replaced.
#[rustfmt::skip]
pub static RULES: [(char, &str); 2] = [
    ('F', "FF"),
    ('X', "F-[[X]+X]+F[+FX]-X"),
];

/// Of a turn, in degrees.
pub const ANGLE: Wide = Wide::lit("22.5");

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
pub const ORDER: u32 = 5;

/// How many brackets are open at once: the least `BRANCHES` of a path.
pub const BRANCHES: usize = 10;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: false };
