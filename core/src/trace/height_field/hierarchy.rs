//! The hierarchy of boxes around a height field `h(x, y) = f(x) g(y)`, which walks go through and height
//! fields are made of.
//!
//! The cells of the two pyramids span it without being stored as pairs: the node `(p, q)` has the box over
//! the interval of `f`'s cell `p` and that of `g`'s cell `q`, and its parts are the pairs of their parts,
//! `N M` a node. Nodes of a pyramid are numbered level by level: the parts of node `q` are `n q + 1` to
//! `n q + n`. Two walks find the first leaf that a ray meets, [`super::halves`] where nodes have two equal
//! parts along each axis, [`super::parts`] elsewhere.
//!
//! Formats: lengths 24 fractional bits, places inside a node 31.

use crate::Error;
use crate::fif::{Cell, Pyramid};
use crate::num::Wide;

/// The boxes of a height field, down to the depth of the shallower pyramid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hierarchy<'a> {
    pub(crate) x: Profile<'a>,
    pub(crate) y: Profile<'a>,
    pub(crate) depth: u32,
    /// The first node of the deepest level along x.
    pub(crate) leaves: u32,
    /// Bounds of all heights, 24 fractional bits.
    pub(crate) heights: (i32, i32),
}

/// One factor of the height: its pyramid and its domain with 24 fractional bits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Profile<'a> {
    pub(crate) cells: &'a [Cell],
    pub(crate) starts: &'a [u32],
    pub(crate) origin: i32,
    pub(crate) width: i32,
}

/// A leaf as a walk finds it: its nodes along x and y, the ray's part above it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Leaf {
    pub(crate) nodes: (u32, u32),
    pub(crate) span: (i32, i32),
}

impl<'a> Profile<'a> {
    #[inline(never)]
    pub(crate) fn new(name: &'static str, pyramid: &Pyramid<'a>) -> Result<Self, Error> {
        let (x0, width) = pyramid.domain_bits();
        let end = x0.saturating_add_unsigned(width);
        // below 64, so that the width fits
        let limit = 64 << 48;
        if x0 < -limit || end >= limit {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            let value = Wide::from_bits(if end >= limit { end } else { x0 });
            return Err(Error::OutOfRange { what: name, index: None, value, min, max });
        }
        let origin = (x0 >> 24) as i32;
        Ok(Self {
            cells: pyramid.all(),
            starts: pyramid.starts(),
            origin,
            width: ((end >> 24) as i32) - origin,
        })
    }

    /// Whether a node has two equal parts, the ordinary case, for which [`super::halves`] has a walk of its
    /// own.
    pub(crate) fn is_halved(&self) -> bool {
        self.starts == [0, 1 << 30]
    }

    /// Level of a node and its index there.
    pub(crate) fn level_and_index(&self, node: u32) -> (u32, u32) {
        let (mut level, mut first, mut count) = (0, 0_u32, 1_u32);
        while node >= first.saturating_add(count) && level < Pyramid::MAX_DEPTH {
            first += count;
            count = count.saturating_mul(self.starts.len() as u32);
            level += 1;
        }
        (level, node.saturating_sub(first))
    }
}

impl Hierarchy<'_> {
    /// The box of the whole surface, 24 fractional bits: both ends along x, y and z.
    pub(crate) fn extent(&self) -> [[i32; 2]; 3] {
        let ends = |profile: &Profile<'_>| [profile.origin, profile.origin + profile.width];
        [ends(&self.x), ends(&self.y), [self.heights.0, self.heights.1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_has_its_place_in_its_level() {
        let profile = Profile { cells: &[], starts: &[0, 1 << 29, 1 << 30], origin: 0, width: 1 << 24 };
        let places = [0, 1, 3, 4, 12, 13, 39].map(|node| profile.level_and_index(node));
        assert_eq!(places, [(0, 0), (1, 0), (1, 2), (2, 0), (2, 8), (3, 0), (3, 26)]);
    }

    #[test]
    fn a_box_is_as_long_as_its_profiles_and_as_high_as_its_heights() {
        let profile = |origin, width| Profile { cells: &[], starts: &[0], origin, width };
        let hierarchy =
            Hierarchy { x: profile(-5, 7), y: profile(3, 11), depth: 0, leaves: 0, heights: (-2, 13) };
        assert_eq!(hierarchy.extent(), [[-5, 2], [3, 14], [-2, 13]]);
    }

    /// The deepest level has a last node, and a number beyond it ends the search all the same.
    #[test]
    fn levels_end_with_the_deepest() {
        let profile = |starts| Profile { cells: &[], starts, origin: 0, width: 1 << 24 };
        assert_eq!(profile(&[0, 1 << 30]).level_and_index((1 << 16) - 1 + 5), (16, 5));
        assert_eq!(profile(&[0]).level_and_index(40), (16, 24));
        assert_eq!(profile(&[]).level_and_index(7), (16, 6));
    }
}
