//! The graph of a function as a path.

use core::iter::FusedIterator;

use super::Fif;
use crate::num::Real;
use crate::picture::{Point2, Step};

/// A path through equally spaced points of the graph; `x` is the unit abscissa in `[0, 1]`.
#[derive(Debug, Clone)]
pub struct Graph<'a, const N: usize, const D: usize> {
    fif: &'a Fif<N, D>,
    next: u32,
    last: u32,
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The path through the points over `i / segments` of the domain, `i = 0 ... segments`. Between them a rough function reaches further: how far says
    /// [`Fif::oscillation`]. Cost: one evaluation a point.
    pub fn graph(&self, segments: u32) -> Graph<'_, N, D> {
        Graph { fif: self, next: 0, last: segments.clamp(1, u32::MAX - 1) }
    }
}

impl<const N: usize, const D: usize> Iterator for Graph<'_, N, D> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        if self.next > self.last {
            return None;
        }
        let (u, y) = self.fif.at_fraction(self.next, self.last);
        let point = Point2::new(Real::from_bits((u >> 39) as i32), y);
        let step = if self.next == 0 { Step::MoveTo(point) } else { Step::LineTo(point) };
        self.next += 1;
        Some(step)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.last + 1).saturating_sub(self.next) as usize;
        (left, Some(left))
    }
}

impl<const N: usize, const D: usize> ExactSizeIterator for Graph<'_, N, D> {}
impl<const N: usize, const D: usize> FusedIterator for Graph<'_, N, D> {}
