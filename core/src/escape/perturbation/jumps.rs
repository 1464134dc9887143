//! Jumps: many iterations of a deep pixel at once. At a width of `10^-100` most iterations are jumped over.
//!
//! In a deep view all orbits run close beside the reference for hundreds of steps (see [`super::reference`]).
//! While the distance `d` of a pixel's orbit is small, `|d| << |2 Z|`, the square in its step
//! `d' = 2 Z d + d^2 + g` does not count: all that happens to `d` is that it is multiplied, and `l` steps are
//! one linear map,
//!
//! `d_l = A d_1 + B g`, with `A' = 2 Z A`, `B' = 2 Z B + 1` along the reference.
//!
//! `A` and `B` are the same for all pixels, so the maps are made once, while the reference is computed; a
//! pixel takes the longest one that its distance is small enough for. Orbits are rebased to the start of the
//! reference, so that all maps start at its first point `C`; a few of them, for the sizes that distances have
//! there, are enough. The derivative by `g` takes the same map.
//!
//! Source: Zhuoran, "Another solution to perturbation glitches", 2021 (bivariate linear approximation).
//! Format: products of 62 bits, rounded at the end to as many as distances have. Error of a map: each
//! neglected square is below two units of its step, the last ones matter only, as distances grow; and three
//! roundings.

use crate::escape::orbit::block_float::{BlockFloat, Number};

/// How many maps are kept: with 400 instead of 16 a pixel takes 8 to 14 % fewer steps.
const LEVELS: usize = 16;
/// A factor below `2^FLOOR` is 0: along an orbit that is drawn in it shrinks for ever.
const FLOOR: i32 = -(1 << 24);

/// The map from the first point of the reference to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jump<N> {
    /// `A` and `B`.
    a: N,
    b: N,
    /// The exponent of 2 that the distance at the first point must be below.
    below: i32,
    /// Where it leads: the index of a point.
    pub(crate) to: u32,
}

impl<N: Number> Jump<N> {
    const NONE: Self = Self { a: N::ONE, b: N::ZERO, below: i32::MIN, to: 1 };

    /// `a v + b w`.
    #[inline]
    pub(crate) fn apply(&self, v: N, w: N) -> N {
        self.a.times(v).plus(self.b.times(w))
    }

    /// `a v + b`: of a derivative.
    #[inline]
    pub(crate) fn slope(&self, v: BlockFloat) -> BlockFloat {
        self.a.short().times(v).plus(self.b.short())
    }
}

/// The maps of a reference, the longest last.
#[derive(Debug, Clone)]
pub(crate) struct Jumps<N> {
    maps: [Jump<N>; LEVELS],
    known: usize,
    /// The exponent of 2 that `|g|` must be below.
    reach: i32,
}

impl<N: Number> Jumps<N> {
    /// The longest map for the distance `d` at the first point.
    #[inline]
    pub(crate) fn find(&self, d: N, g: N) -> Option<&Jump<N>> {
        let size = d.above();
        let maps = self.maps.get(..self.known).filter(|_| g.above() <= self.reach)?;
        maps.iter().rev().find(|jump| size <= jump.below)
    }
}

/// Follows a reference as it is computed, and keeps a map wherever the next smaller size of distances needs
/// one.
#[derive(Debug)]
pub(crate) struct Builder<N> {
    jumps: Jumps<N>,
    a: BlockFloat<i64>,
    b: BlockFloat<i64>,
    /// The exponent of 2 below which distances may come as far as this.
    below: i32,
    /// Levels that have their map, of [`LEVELS`].
    level: i32,
    index: u32,
}

impl<N: Number> Builder<N> {
    /// What a square may be of its step, `2^(1 - BITS)`: a half for `A d` and a half for `B g`.
    const NEGLIGIBLE: i32 = -N::BITS;

    /// For pixels whose `|g|` is below `2^reach`.
    pub(crate) const fn new(reach: i32) -> Self {
        Self {
            jumps: Jumps { maps: [Jump::NONE; LEVELS], known: 0, reach },
            a: BlockFloat::<i64>::ONE,
            b: BlockFloat::<i64>::ZERO,
            below: i32::MAX,
            level: 0,
            index: 0,
        }
    }

    /// The next point of the reference.
    pub(crate) fn push(&mut self, z: BlockFloat<i64>) {
        let index = self.index;
        self.index += 1;
        if index == 0 || self.level >= LEVELS as i32 {
            return;
        }
        // the exponent of 2 that a distance must be below at this point, for its square not to count beside
        // `2 Z d`
        let room = z.reached().saturating_add(1 + Self::NEGLIGIBLE);
        let fits = self.b.above().saturating_add(self.jumps.reach) <= room;
        let next = if fits { self.below.min(room.saturating_sub(self.a.above())) } else { i32::MIN };
        let before = self.level;
        while self.level < LEVELS as i32 && next < self.size() {
            self.level += 1;
        }
        // nothing is gained by a jump to the next point
        if self.level > before && index > 2 {
            if let Some(slot) = self.jumps.maps.get_mut(self.jumps.known) {
                *slot = Jump { a: N::nearest(self.a), b: N::nearest(self.b), below: self.below, to: index };
                self.jumps.known += 1;
            }
        }
        self.below = next;
        let twice = z.doubled();
        self.a = twice.times(self.a);
        if self.a.above() < FLOOR {
            self.a = BlockFloat::<i64>::ZERO;
        }
        self.b = twice.times(self.b).plus(BlockFloat::<i64>::ONE);
    }

    /// The size of a distance that the next map must serve: in equal steps from the largest down to that of
    /// the pixels.
    const fn size(&self) -> i32 {
        let span = Self::NEGLIGIBLE - self.jumps.reach;
        Self::NEGLIGIBLE - span * (self.level + 1) / LEVELS as i32
    }

    pub(crate) fn finish(self) -> Jumps<N> {
        self.jumps
    }
}
