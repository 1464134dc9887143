//! L-systems: a word whose letters are rewritten by rules, all at once, again and again, and the turtle that
//! draws the last word. With brackets they make plants.
//!
//! | letter | meaning |
//! | --- | --- |
//! | `F`, `G` | a step forward, drawn |
//! | `f` | a step forward, not drawn |
//! | `+`, `-` | turn left, turn right by the angle |
//! | `\|` | turn round |
//! | `[..]` | a branch: behind it the turtle has the place and the direction again that it had before it |
//! | any other of `A` to `Z`, `a` to `z` | nothing: it only rewrites |
//!
//! Every letter, `F`, `G` and `f` among them, may have a rule. Source: P. Prusinkiewicz and A. Lindenmayer,
//! "The Algorithmic Beauty of Plants", 1990, sections 1.2 to 1.6: deterministic, context-free, with brackets.
//! Left out: chance, context, parameters, the third dimension, filled polygons.
//!
//! No word is ever written down, as it grows exponentially. The turtle walks the tree of rewritings: it keeps
//! the rest of one word for each order, and one place and direction for each open bracket.
//!
//! This is no [`super::Generator`]: there each segment is replaced by copies that lead from its start to its
//! end, so that a copy is known from its two ends and pieces may be refined until they are short. Here a
//! letter may stand for anything; where its word leads is known when it has been walked.
//!
//! Formats: directions in `2^-64` of a turn; places with 56 fractional bits, to which a step adds a sine and
//! a cosine without any rounding, as its length is a power of two.

use crate::Error;
use crate::num::formats::{Q56, UQ64};
use crate::num::{Angle, Real, Wide, sin_cos};
use crate::plane::{PathElement, Point2};

/// The most rules of an L-system.
pub const MAX_RULES: usize = 16;

/// The most letters that a walk comes by, all orders together.
pub const MAX_LETTERS: u32 = 1 << 28;

/// What the turtle does at a letter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Command {
    Line,
    Move,
    Left,
    Right,
    Round,
    Open,
    Close,
    Nothing,
}

const fn command(letter: u8) -> Option<Command> {
    Some(match letter {
        b'F' | b'G' => Command::Line,
        b'f' => Command::Move,
        b'+' => Command::Left,
        b'-' => Command::Right,
        b'|' => Command::Round,
        b'[' => Command::Open,
        b']' => Command::Close,
        b'A'..=b'Z' | b'a'..=b'z' => Command::Nothing,
        _ => return None,
    })
}

/// An axiom, rules and an angle. Size: 32 bytes on a 32-bit machine, beside the words, which are lent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LSystem<'a> {
    axiom: &'a [u8],
    rules: &'a [(char, &'a str)],
    /// In turns.
    angle: UQ64,
    heading: UQ64,
}

/// What becomes of a letter or a word.
#[derive(Clone, Copy, Default)]
struct Growth {
    /// Letters walked, those that are rewritten included.
    letters: u32,
    /// Steps, drawn or not.
    steps: u32,
    /// Brackets open at once.
    branches: u32,
}

impl Growth {
    fn of(letter: u8) -> Self {
        let steps = matches!(command(letter), Some(Command::Line | Command::Move)).into();
        Self { letters: 1, steps, branches: 0 }
    }
}

impl<'a> LSystem<'a> {
    /// The system with this axiom, these rules and this angle in degrees; the turtle first looks to the
    /// right.
    ///
    /// Domain: words of the letters in the table above; all angles. A letter without a rule stays what it is;
    /// an empty rule removes its letter.
    ///
    /// # Errors
    /// [`Error::Character`] for a character that is no letter of a word, a bracket that opens or closes none
    /// in its own word, a rule for what is no letter or for a letter that has one; [`Error::Capacity`] for
    /// more than [`MAX_RULES`].
    ///
    /// ```
    /// use attractor::{curve::LSystem, num::Wide};
    /// let rules = [('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")];
    /// let plant = LSystem::new("X", &rules, Wide::lit("22.5"))?.with_heading(Wide::lit("90"));
    /// assert!(plant.path::<5, 10>(5)?.count() > 1000);
    /// assert!(LSystem::new("F[+F", &rules, Wide::ONE).is_err());
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn new(axiom: &'a str, rules: &'a [(char, &'a str)], degrees: Wide) -> Result<Self, Error> {
        check(axiom, "axiom", None)?;
        if rules.len() > MAX_RULES {
            return Err(Error::Capacity { what: "rules", needed: rules.len(), capacity: MAX_RULES });
        }
        for (index, (letter, word)) in rules.iter().enumerate() {
            let refused = |reason| {
                let (what, index) = ("letter of rule", Some(index));
                Error::Character { what, index, position: 1, letter: *letter, reason }
            };
            if !letter.is_ascii_alphabetic() {
                return Err(refused("cannot be rewritten: a rule is for one of A to Z, a to z"));
            }
            if rules.iter().take(index).any(|(other, _)| other == letter) {
                return Err(refused("has a rule already"));
            }
            check(word, "rule", Some(index))?;
        }
        Ok(Self { axiom: axiom.as_bytes(), rules, angle: turns(degrees), heading: 0 })
    }

    /// The same with another first direction, in degrees to the left of the `x` axis: 90 lets plants grow
    /// upwards.
    pub const fn with_heading(self, degrees: Wide) -> Self {
        Self { heading: turns(degrees), ..self }
    }

    /// The word after `order` rewritings, drawn: one stroke for each run of lines.
    ///
    /// Result: the walk begins at `(0, 0)`. Its steps are as long as [`Turtle::step`] says, short enough for
    /// no walk of that many to leave the disc of radius 64; a [`crate::plane::Window`] brings it to a
    /// display. Nothing where the word draws nothing. Error: of each coordinate below `2^-21`, whatever the
    /// word, its length or its angle (tests/l_systems.rs) (`l_systems.rs`:
    /// `every_point_is_within_its_bound`). Cost: the walk ends after [`MAX_LETTERS`] letters at most; stack
    /// and time of this call grow with the rules and the order alone.
    ///
    /// # Errors
    /// [`Error::Capacity`] for more than `ORDERS` rewritings, more than `BRANCHES` brackets open at once, or
    /// more than [`MAX_LETTERS`] letters.
    pub fn path<const ORDERS: usize, const BRANCHES: usize>(
        &self,
        order: u32,
    ) -> Result<Turtle<'a, ORDERS, BRANCHES>, Error> {
        let full = |what, needed: u32, capacity: usize| {
            let needed = usize::try_from(needed).unwrap_or(usize::MAX);
            if needed > capacity { Err(Error::Capacity { what, needed, capacity }) } else { Ok(()) }
        };
        full("orders", order, ORDERS)?;
        let growth = self.growth(order);
        full("letters", growth.letters, MAX_LETTERS as usize)?;
        full("open brackets", growth.branches, BRANCHES)?;
        // the least k with steps 2^-k <= 64: 22 at most
        let bits = 32 - growth.steps.saturating_sub(1).leading_zeros();
        Ok(Turtle {
            system: *self,
            word: self.axiom,
            rests: [&[]; ORDERS],
            waiting: 0,
            order: order as usize,
            branches: [Pose::default(); BRANCHES],
            open: 0,
            here: Pose { at: [0; 2], heading: self.heading },
            steps: growth.steps,
            shortening: bits.saturating_sub(6),
            pen: Pen::Up,
        })
    }

    fn rule(&self, letter: u8) -> Option<&'a [u8]> {
        let (_, word) = self.rules.iter().find(|(other, _)| *other == char::from(letter))?;
        Some(word.as_bytes())
    }

    /// Order by order, from that of the rules' letters alone.
    fn growth(&self, order: u32) -> Growth {
        let mut table = [Growth::default(); MAX_RULES];
        for (growth, (letter, _)) in table.iter_mut().zip(self.rules) {
            *growth = Growth::of(*letter as u8);
        }
        for _ in 0..order {
            let before = table;
            for (growth, (_, word)) in table.iter_mut().zip(self.rules) {
                *growth = self.grown(word.as_bytes(), &before);
                growth.letters = growth.letters.saturating_add(1);
            }
        }
        self.grown(self.axiom, &table)
    }

    fn grown(&self, word: &[u8], table: &[Growth; MAX_RULES]) -> Growth {
        let (mut sum, mut open) = (Growth::default(), 0_u32);
        for letter in word {
            match command(*letter) {
                Some(Command::Open) => open = open.saturating_add(1),
                Some(Command::Close) => open = open.saturating_sub(1),
                _ => {}
            }
            let rule = self.rules.iter().zip(table).find(|((other, _), _)| *other == char::from(*letter));
            let growth = rule.map_or_else(|| Growth::of(*letter), |(_, growth)| *growth);
            sum.letters = sum.letters.saturating_add(growth.letters);
            sum.steps = sum.steps.saturating_add(growth.steps);
            sum.branches = sum.branches.max(open.saturating_add(growth.branches));
        }
        sum
    }
}

/// Whether all is a letter and all brackets have their counterpart.
fn check(word: &str, what: &'static str, index: Option<usize>) -> Result<(), Error> {
    let refused = |position, letter, reason| Error::Character { what, index, position, letter, reason };
    let (mut open, mut outermost) = (0_u32, 0);
    for (position, letter) in (1..).zip(word.chars()) {
        match u8::try_from(letter).ok().and_then(command) {
            Some(Command::Open) => {
                outermost = if open == 0 { position } else { outermost };
                open = open.saturating_add(1);
            }
            Some(Command::Close) => {
                open = open.checked_sub(1).ok_or(refused(position, letter, "closes no bracket"))?;
            }
            Some(_) => {}
            None => {
                let reason = "is none of its letters: A to Z, a to z (F and G draw, f moves), + - | [ ]";
                return Err(refused(position, letter, reason));
            }
        }
    }
    if open > 0 { Err(refused(outermost, '[', "is never closed")) } else { Ok(()) }
}

/// Degrees in turns, rounded to nearest: times `2^13 / 45` from units of `2^-48` to units of `2^-64`.
const fn turns(degrees: Wide) -> UQ64 {
    let (whole, rest) = (degrees.to_bits().div_euclid(45), degrees.to_bits().rem_euclid(45));
    ((whole as u64) << 13).wrapping_add((((rest as u64) << 14) / 45 + 1) >> 1)
}

/// Where the turtle is and where it looks.
#[derive(Debug, Clone, Copy, Default)]
struct Pose {
    at: [Q56; 2],
    /// In turns.
    heading: UQ64,
}

impl Pose {
    /// Rounded to nearest: `|at| < 65`.
    fn point(&self) -> Point2 {
        let [x, y] = self.at.map(|c| Real::from_bits((c.wrapping_add(1 << 31) >> 32) as i32));
        Point2::new(x, y)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pen {
    Up,
    Down,
    /// It has just been put down where a line begins that leads to where the turtle is.
    Put,
}

/// The path of an L-system. Size on a 32-bit machine: 8 bytes for each of `ORDERS` rewritings, 24 for each of
/// `BRANCHES` open brackets, and 88.
#[derive(Debug, Clone)]
pub struct Turtle<'a, const ORDERS: usize, const BRANCHES: usize> {
    system: LSystem<'a>,
    /// What is left of the word at hand, and of those that it stands in: the first `waiting`.
    word: &'a [u8],
    rests: [&'a [u8]; ORDERS],
    waiting: usize,
    order: usize,
    /// Where brackets opened: the first `open`.
    branches: [Pose; BRANCHES],
    open: usize,
    here: Pose,
    steps: u32,
    /// A step is `2^-shortening` long.
    shortening: u32,
    pen: Pen,
}

impl<const ORDERS: usize, const BRANCHES: usize> Turtle<'_, ORDERS, BRANCHES> {
    /// The length of a step: the greatest power of two, 1 at most, with which all steps together are no
    /// longer than 64.
    pub fn step(&self) -> Wide {
        Wide::from_bits(1 << (48 - self.shortening.min(48)))
    }

    /// How many steps the whole walk takes, drawn or not.
    pub const fn steps(&self) -> u32 {
        self.steps
    }

    /// The next letter that is not rewritten; none at the end.
    fn letter(&mut self) -> Option<u8> {
        loop {
            let Some((letter, rest)) = self.word.split_first() else {
                // back to the word that this one stands in
                self.waiting = self.waiting.checked_sub(1)?;
                self.word = self.rests.get(self.waiting)?;
                continue;
            };
            self.word = rest;
            if self.waiting >= self.order {
                return Some(*letter);
            }
            // the constructor has seen to the room
            match (self.system.rule(*letter), self.rests.get_mut(self.waiting)) {
                (Some(word), Some(waiting)) => {
                    *waiting = rest;
                    self.word = word;
                    self.waiting += 1;
                }
                _ => return Some(*letter),
            }
        }
    }

    fn forward(&mut self) {
        // to 32 bits of a turn, rounded
        let heading = (self.here.heading.wrapping_add(1 << 31) >> 32) as u32;
        let (sin, cos) = sin_cos(Angle::from_bits(heading));
        let [x, y] = self.here.at;
        let along = |c: crate::num::Unit| i64::from(c.to_bits()) << (26 - self.shortening.min(26));
        self.here.at = [x.wrapping_add(along(cos)), y.wrapping_add(along(sin))];
    }
}

impl<const ORDERS: usize, const BRANCHES: usize> Iterator for Turtle<'_, ORDERS, BRANCHES> {
    type Item = PathElement;

    fn next(&mut self) -> Option<PathElement> {
        if self.pen == Pen::Put {
            self.pen = Pen::Down;
            return Some(PathElement::LineTo(self.here.point()));
        }
        loop {
            match command(self.letter()?) {
                Some(Command::Line) => {
                    let from = self.here;
                    self.forward();
                    if self.pen == Pen::Down {
                        return Some(PathElement::LineTo(self.here.point()));
                    }
                    self.pen = Pen::Put;
                    return Some(PathElement::MoveTo(from.point()));
                }
                Some(Command::Move) => {
                    self.forward();
                    self.pen = Pen::Up;
                }
                Some(Command::Left) => {
                    self.here.heading = self.here.heading.wrapping_add(self.system.angle);
                }
                Some(Command::Right) => {
                    self.here.heading = self.here.heading.wrapping_sub(self.system.angle);
                }
                Some(Command::Round) => self.here.heading = self.here.heading.wrapping_add(1 << 63),
                Some(Command::Open) => {
                    // the constructor has seen to the room
                    if let Some(pose) = self.branches.get_mut(self.open) {
                        *pose = self.here;
                        self.open += 1;
                    }
                }
                Some(Command::Close) => {
                    self.open = self.open.saturating_sub(1);
                    self.here = self.branches.get(self.open).copied().unwrap_or(self.here);
                    self.pen = Pen::Up;
                }
                Some(Command::Nothing) | None => {}
            }
        }
    }
}

impl<const ORDERS: usize, const BRANCHES: usize> core::iter::FusedIterator for Turtle<'_, ORDERS, BRANCHES> {}
