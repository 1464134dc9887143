//! What a constructor refuses: what was wrong, where, which value, what is allowed.

use core::fmt;

use crate::num::Wide;

/// Why a description was refused. Kernels themselves cannot fail: everything is checked once, here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
        /// What it holds.
        what: &'static str,
        /// Its length.
        given: usize,
        /// The length it must have at least.
        needed: usize,
    },
    /// What must increase does not: knots, stops of a gradient.
    NotIncreasing {
        /// What one of them is.
        what: &'static str,
        /// Index of the first that is not to the right of its predecessor.
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
    /// A column of a matrix with barycentric columns, a class of a mask or an end does not add up to 1.
    NotBarycentric {
        /// Its index.
        column: usize,
        /// Its sum.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        sum: Wide,
    },
    /// The maps of a curve or a patch do not join, or its boundary is not that of its control points.
    Unjoined {
        /// The condition that fails.
        condition: &'static str,
        /// Index of the map, or of the point of the grid along the side.
        map: usize,
        /// The greatest difference of a coordinate.
        #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
        gap: Wide,
    },
    /// Neighbouring maps disagree at a knot (joining condition).
    NotJoined {
        /// Index of the knot.
        knot: usize,
    },
    /// The function has no derivative of its own kind: a map is steeper than it is narrow,
    /// `|alpha_j| >= a_j`.
    NotDifferentiable {
        /// Index of the map.
        map: usize,
    },
    /// A lattice has no moments.
    NoMoments {
        /// Why not.
        why: &'static str,
    },
    /// A text that cannot be read.
    Malformed {
        /// What it should be.
        what: &'static str,
        /// Position of the first byte that does not belong.
        position: usize,
    },
    /// Bytes end before what they are does.
    Ended {
        /// What it is.
        what: &'static str,
        /// How many bytes of the part in question there are.
        position: usize,
    },
    /// Bytes are not those that were written: their checksum is another.
    Checksum {
        /// What they are.
        what: &'static str,
        /// What it says.
        stated: u32,
        /// What it is.
        computed: u32,
    },
    /// A direction or an extent is zero.
    Degenerate {
        /// What is.
        what: &'static str,
    },
    /// A choice that exists, but not here.
    Unsupported {
        /// What was chosen.
        what: &'static str,
        /// What there is to choose from.
        allowed: &'static str,
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
            Self::BufferLength { what, given, needed } => {
                write!(f, "a buffer of {given} {what} lent, {needed} needed")
            }
            Self::NotIncreasing { what, index } => {
                write!(f, "{what} {index} is not to the right of {what} {}", index.saturating_sub(1))
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
            Self::NotBarycentric { column, sum } => write!(f, "column {column} adds up to {sum}, not to 1"),
            Self::Unjoined { condition, map, gap } => {
                write!(f, "{condition} fails at {map}: a coordinate is off by {gap}")
            }
            Self::NotJoined { knot } => write!(f, "the maps on both sides of knot {knot} disagree there"),
            Self::NotDifferentiable { map } => write!(
                f,
                "map {map} has a vertical scaling no smaller than its horizontal one: no derivative exists"
            ),
            Self::NoMoments { why } => write!(f, "this mask has no moments: {why}"),
            Self::Malformed { what, position } => write!(f, "this is no {what}: look at byte {position}"),
            Self::Ended { what, position } => write!(f, "this {what} ends too early: after byte {position}"),
            Self::Checksum { what, stated, computed } => {
                write!(f, "this {what} is damaged: its checksum is {computed:08x}, it says {stated:08x}")
            }
            Self::Degenerate { what } => write!(f, "{what} is zero"),
            Self::Unsupported { what, allowed } => {
                write!(f, "this {what} is not supported; supported: {allowed}")
            }
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

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::Error;
    use crate::num::Wide;

    #[test]
    fn each_message_says_of_what() {
        let value = |v: f32| Wide::from_num(v);
        let out = |index, v| Error::OutOfRange {
            what: "reach",
            index,
            value: v,
            min: value(-0.5),
            max: value(2.0),
        };
        let cases = [
            (Error::TooFew { what: "knots", given: 1, at_least: 2 }, "1 knots given, at least 2 needed"),
            (
                Error::Capacity { what: "powers of x", needed: 3, capacity: 2 },
                "3 powers of x needed, there is room for 2",
            ),
            (
                Error::LengthMismatch { what: "polynomials", given: 2, expected: 1 },
                "2 polynomials given, 1 expected",
            ),
            (
                Error::BufferLength { what: "cells", given: 63, needed: 64 },
                "a buffer of 63 cells lent, 64 needed",
            ),
            (Error::NotIncreasing { what: "stop", index: 2 }, "stop 2 is not to the right of stop 1"),
            (out(Some(3), value(2.5)), "reach [3] is 2.5, it must lie between -0.5 and 2"),
            (out(None, Wide::MAX), "reach is 32768 or more, it must lie between -0.5 and 2"),
            (out(None, Wide::MIN), "reach is -32768 or less, it must lie between -0.5 and 2"),
            (Error::NotContractive { map: 1 }, "map 1 is not a contraction"),
            (Error::Probabilities { sum: value(1.5) }, "the probabilities add up to 1.5, not to 1"),
            (Error::NotBarycentric { column: 2, sum: value(0.75) }, "column 2 adds up to 0.75, not to 1"),
            (
                Error::Unjoined { condition: "T_0 c_1 = T_1 c_0", map: 1, gap: value(0.25) },
                "T_0 c_1 = T_1 c_0 fails at 1: a coordinate is off by 0.25",
            ),
            (Error::NotJoined { knot: 1 }, "the maps on both sides of knot 1 disagree there"),
            (Error::Malformed { what: "number", position: 4 }, "this is no number: look at byte 4"),
            (Error::Ended { what: "image", position: 12 }, "this image ends too early: after byte 12"),
            (
                Error::Checksum { what: "image", stated: 0xcbf4_3926, computed: 7 },
                "this image is damaged: its checksum is 00000007, it says cbf43926",
            ),
            (Error::Degenerate { what: "direction of the light" }, "direction of the light is zero"),
            (
                Error::Unsupported { what: "arithmetic", allowed: "Word26 and Word29" },
                "this arithmetic is not supported; supported: Word26 and Word29",
            ),
        ];
        for (error, text) in cases {
            assert_eq!(error.to_string(), text);
        }
    }
}
