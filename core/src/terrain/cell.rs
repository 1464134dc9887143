//! A cell of the lattice and its four parts: the step of the subdivision.

use super::law::{Law, centre, edge};
use super::random::Randomness;
use crate::num::Coordinate;
use crate::num::formats::{Q24, Q28};

/// The square between four points of a lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Cell {
    /// Heights at `(u, v)`, east of it, north of it, and opposite.
    pub(crate) corners: [Q24; 4],
    /// 16 fractional bits.
    pub(crate) u: i32,
    pub(crate) v: i32,
}

/// A cell that is halved, by all nine heights.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Halved {
    /// Row by row from south-west.
    heights: [Q24; 9],
    u: i32,
    v: i32,
}

/// The five new heights of a cell that is halved: south, north, west, east, centre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Middles {
    edges: [Q24; 4],
    centre: Q24,
}

impl Cell {
    /// Half the side of a cell at a level below 16.
    #[inline(always)]
    pub(crate) const fn half(level: u32) -> i32 {
        (1 << 15) >> (level & 15)
    }

    /// The new heights when a cell at this level is halved.
    #[inline(always)]
    pub(crate) fn halved(&self, level: u32, law: &Law, random: &impl Randomness) -> Middles {
        self.halved_by(Self::half(level), law.at(level), random)
    }

    /// The same for half its side and the offset of its level.
    #[inline(always)]
    pub(super) fn halved_by(&self, half: i32, offset: Q28, random: &impl Randomness) -> Middles {
        let [a, b, c, d] = self.corners;
        // the last knot is at 32767: nothing wraps
        let at = |du: i32, dv: i32| {
            let (u, v) = (self.u.wrapping_add(du), self.v.wrapping_add(dv));
            random.at(Coordinate::from_bits(u), Coordinate::from_bits(v))
        };
        let (whole, [south, ..], [north, ..]) = (2 * half, at(half, 0), at(half, 2 * half));
        let ([_, west], [_, east]) = (at(0, half), at(whole, half));
        let edges = [
            edge(a, b, offset, south),
            edge(c, d, offset, north),
            edge(a, c, offset, west),
            edge(b, d, offset, east),
        ];
        Middles { edges, centre: centre(edges, offset, at(half, half)) }
    }

    /// All heights when a cell at this level is halved.
    #[inline(always)]
    pub(crate) fn all(&self, level: u32, law: &Law, random: &impl Randomness) -> Halved {
        let ([a, b, c, d], Middles { edges: [s, n, w, e], centre }) =
            (self.corners, self.halved(level, law, random));
        Halved { heights: [a, s, b, w, centre, e, c, n, d], u: self.u, v: self.v }
    }

    /// One of its quarters.
    #[inline(always)]
    pub(crate) fn part(&self, level: u32, middles: &Middles, east: bool, north: bool) -> Self {
        self.part_by(Self::half(level), middles, east, north)
    }

    /// The same for half its side.
    #[inline(always)]
    pub(super) fn part_by(&self, half: i32, middles: &Middles, east: bool, north: bool) -> Self {
        let ([a, b, c, d], [s, n, w, e], m) = (self.corners, middles.edges, middles.centre);
        let corners = match (east, north) {
            (false, false) => [a, s, w, m],
            (true, false) => [s, b, m, e],
            (false, true) => [w, m, c, n],
            (true, true) => [m, e, n, d],
        };
        let moved = |c: i32, far: bool| if far { c.wrapping_add(half) } else { c };
        Self { corners, u: moved(self.u, east), v: moved(self.v, north) }
    }
}

impl Halved {
    /// One of the quarters of a cell at this level.
    #[inline(always)]
    pub(crate) fn quarter(&self, level: u32, [east, north]: [u32; 2]) -> Cell {
        let corners = match self.heights.get((east + 3 * north) as usize..) {
            Some([sw, se, _, nw, ne, ..]) => [*sw, *se, *nw, *ne],
            _ => [0; 4],
        };
        let half = Cell::half(level);
        let moved = |c: i32, far: u32| c.wrapping_add(half.wrapping_mul(far as i32));
        Cell { corners, u: moved(self.u, east), v: moved(self.v, north) }
    }
}
