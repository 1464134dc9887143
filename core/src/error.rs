//! What a constructor refuses: what was wrong, where, which value, what is allowed.

use core::fmt;

use crate::num::Wide;

/// Why a description was refused. Kernels themselves cannot fail: everything is checked once, here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Error {
    /// Fewer items than the object needs.
    TooFew {
        /// What there is too little of.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many it takes at least.
        at_least: usize,
    },
    /// More items than a capacity fixed at compile time.
    Capacity {
        /// What there is too much of.
        what: &'static str,
        /// How many the object needs.
        needed: usize,
        /// How many fit.
        capacity: usize,
    },
    /// Two lists that belong together differ in length.
    LengthMismatch {
        /// What is short or long.
        what: &'static str,
        /// Its length.
        given: usize,
        /// The length it must have.
        expected: usize,
    },
    /// A buffer lent by the caller has the wrong length.
    BufferLength {
        /// Its length.
        given: usize,
        /// The length it must have at least.
        needed: usize,
    },
    /// The knots do not increase.
    KnotsNotIncreasing {
        /// Index of the first knot that is not to the right of its predecessor.
        index: usize,
    },
    /// A value outside the range that its format or its meaning allows.
    OutOfRange {
        /// What it is.
        what: &'static str,
        /// Its index, for one of a list.
        index: Option<usize>,
        /// The value, saturated to the format of this field.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        value: Wide,
        /// The least value allowed.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        min: Wide,
        /// The greatest value allowed.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        max: Wide,
    },
    /// A map moves some pair of points no closer together.
    NotContractive {
        /// Index of the map.
        map: usize,
    },
    /// The probabilities of an iterated function system do not add up to 1.
    Probabilities {
        /// Their sum.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        sum: Wide,
    },
    /// Neighbouring maps disagree at a knot (joining condition).
    NotJoined {
        /// Index of the knot.
        knot: usize,
    },
    /// The function has no derivative of its own kind: a map is steeper than it is narrow, `|alpha_j| >= a_j`.
    NotDifferentiable {
        /// Index of the map.
        map: usize,
    },
    /// A text that cannot be read.
    Malformed {
        /// What it should be.
        what: &'static str,
        /// Position of the first byte that does not belong.
        position: usize,
    },
    /// A direction or an extent is zero.
    Degenerate {
        /// What is.
        what: &'static str,
    },
    /// A character of a word that does not belong there.
    Character {
        /// What word.
        what: &'static str,
        /// Its index, for one of a list.
        index: Option<usize>,
        /// The place of the character; the first is 1.
        position: usize,
        /// The character.
        letter: char,
        /// What is wrong with it and what is allowed.
        reason: &'static str,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::TooFew { what, given, at_least } => {
                write!(f, "{given} {what} given, at least {at_least} needed")
            }
            Self::Capacity { what, needed, capacity } => {
                write!(f, "{needed} {what} needed, there is room for {capacity}")
            }
            Self::LengthMismatch { what, given, expected } => {
                write!(f, "{given} {what} given, {expected} expected")
            }
            Self::BufferLength { given, needed } => {
                write!(f, "the buffer has {given} elements, {needed} are needed")
            }
            Self::KnotsNotIncreasing { index } => {
                write!(f, "knot {index} is not to the right of knot {}", index.saturating_sub(1))
            }
            Self::OutOfRange { what, index, value, min, max } => {
                match index {
                    Some(index) => write!(f, "{what} [{index}] is ")?,
                    None => write!(f, "{what} is ")?,
                }
                // the ends of the format stand for everything beyond
                if value == Wide::MAX {
                    f.write_str("32768 or more")?;
                } else if value == Wide::MIN {
                    f.write_str("-32768 or less")?;
                } else {
                    write!(f, "{value}")?;
                }
                write!(f, ", it must lie between {min} and {max}")
            }
            Self::NotContractive { map } => write!(f, "map {map} is not a contraction"),
            Self::Probabilities { sum } => write!(f, "the probabilities add up to {sum}, not to 1"),
            Self::NotJoined { knot } => write!(f, "the maps on both sides of knot {knot} disagree there"),
            Self::NotDifferentiable { map } => write!(
                f,
                "map {map} has a vertical scaling no smaller than its horizontal one: no derivative exists"
            ),
            Self::Malformed { what, position } => write!(f, "this is no {what}: look at byte {position}"),
            Self::Degenerate { what } => write!(f, "{what} is zero"),
            Self::Character { what, index, position, letter, reason } => {
                match index {
                    Some(index) => write!(f, "{what} [{index}]")?,
                    None => f.write_str(what)?,
                }
                write!(f, ": character {position}, {letter:?} (U+{:04X}), {reason}", u32::from(letter))
            }
        }
    }
}

impl core::error::Error for Error {}
