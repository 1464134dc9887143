//! Where a surface takes its random numbers from: a random field, or one with seams.

use crate::num::{Coordinate, Deviate, RandomField};

/// Random numbers at the points of a lattice. They must depend on nothing but the point.
pub trait Randomness {
    /// Two numbers: the first displaces the middle of an edge along `u`, the second that of one along `v`,
    /// both together a centre.
    fn at(&self, u: Coordinate, v: Coordinate) -> [Deviate; 2];
}

impl Randomness for RandomField {
    #[inline(always)]
    fn at(&self, u: Coordinate, v: Coordinate) -> [Deviate; 2] {
        RandomField::at(*self, u, v)
    }
}
