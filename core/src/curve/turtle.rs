//! Generators as turtle words, the shortest way to write one down: `F+F--F+F` at 60 degrees is the Koch
//! curve's.
//!
//! | letter | meaning |
//! | --- | --- |
//! | `F`, `A` | a step forward: a copy of the curve |
//! | `B` | a copy walked from its end to its start |
//! | `a` | a copy on the other side |
//! | `b` | a copy on the other side, walked from its end |
//! | `+`, `-` | turn left, turn right by the angle |
//!
//! The word is one refinement; where it ends, `(1, 0)` lies, so that neither its first direction nor its size
//! matters. All steps have length 1. Source: P. Prusinkiewicz and A. Lindenmayer, "The Algorithmic Beauty of
//! Plants", 1990, section 1.4.1 ("edge rewriting"); course unit V, section 5.1.2. Left out: `f`, which moves
//! without drawing, brackets, and letters that only rewrite: those are for [`super::LSystem`].

use super::generator::{Generator, Orientation};
use crate::Error;
use crate::num::formats::UQ32;
use crate::num::{Angle, sin_cos};

/// What a letter asks for.
#[derive(Clone, Copy)]
enum Command {
    Step(Orientation),
    Turn(bool),
}

fn command(letter: u8) -> Option<Command> {
    Some(match letter {
        b'F' | b'A' => Command::Step(Orientation::Plain),
        b'B' => Command::Step(Orientation::Reversed),
        b'a' => Command::Step(Orientation::Mirrored),
        b'b' => Command::Step(Orientation::MirroredReversed),
        b'+' => Command::Turn(true),
        b'-' => Command::Turn(false),
        _ => return None,
    })
}

/// A part of a turn, rounded to nearest: `turn_over(6)` is 60 degrees. 0 counts as 1, a whole turn, which
/// is 0.
pub const fn turn_over(parts: u32) -> Angle {
    let parts = if parts == 0 { 1 } else { parts as u64 };
    match ((1_u64 << 32) + parts / 2).checked_div(parts) {
        Some(bits) => Angle::from_bits(bits as u32),
        None => Angle::from_bits(0),
    }
}

impl<const S: usize> Generator<S> {
    /// The generator that a turtle draws.
    ///
    /// Domain: see the table above; angles in turns. Error: of each vertex below `2^-26` for up to nine steps
    /// and turns, from the sines (`curves.rs`: `every_vertex_is_within_its_bound`).
    ///
    /// # Errors
    /// As [`Generator::polyline`]; [`Error::Character`] for a letter that is not in the table.
    ///
    /// ```
    /// use attractor::curve::{Generator, turn_over};
    /// let koch = Generator::<4>::turtle("F+F--F+F", turn_over(6))?;
    /// assert!((koch.contraction_factor() * 3).abs_diff(attractor::num::Unit::ONE) < 1e-7);
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn turtle(word: &str, angle: Angle) -> Result<Self, Error> {
        let is_unknown = |letter: &char| u8::try_from(*letter).ok().and_then(command).is_none();
        if let Some((position, letter)) = (1..).zip(word.chars()).find(|(_, letter)| is_unknown(letter)) {
            return Err(Error::Character {
                what: "turtle word",
                index: None,
                position,
                letter,
                reason: "is none of its letters: F A B a b + - (f, brackets and letters that only rewrite: in an L-system)",
            });
        }
        let steps = || {
            word.bytes().filter_map(command).filter_map(|c| match c {
                Command::Step(orientation) => Some(orientation),
                Command::Turn(_) => None,
            })
        };
        // fewer than 2^16 steps are summed, or the vertices are never looked at
        let segments = steps().count();
        Self::build(
            segments,
            Vertices { word: word.as_bytes(), angle, heading: 0, at: Some([0, 0]) },
            steps(),
        )
    }
}

/// The points where the turtle rests, the start first; 30 fractional bits.
#[derive(Clone)]
struct Vertices<'a> {
    word: &'a [u8],
    angle: Angle,
    /// In turns.
    heading: UQ32,
    at: Option<[i64; 2]>,
}

impl Iterator for Vertices<'_> {
    type Item = [i64; 2];

    fn next(&mut self) -> Option<[i64; 2]> {
        let here = self.at?;
        self.at = None;
        while let [letter, rest @ ..] = self.word {
            self.word = rest;
            match command(*letter) {
                Some(Command::Turn(left)) => {
                    let turn = self.angle.to_bits();
                    let turn = if left { turn } else { turn.wrapping_neg() };
                    self.heading = self.heading.wrapping_add(turn);
                }
                Some(Command::Step(_)) => {
                    let (sin, cos) = sin_cos(Angle::from_bits(self.heading));
                    let [x, y] = here;
                    self.at = Some([x + i64::from(cos.to_bits()), y + i64::from(sin.to_bits())]);
                    break;
                }
                None => {}
            }
        }
        Some(here)
    }
}
