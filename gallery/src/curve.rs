//! A polyline each of whose segments is replaced by a generator, again and again.

use attractor::Error;
use attractor::curve::{Generator, Refined};
use attractor::picture::{Point2, Window};
use embedded_graphics::geometry::Size;

use crate::area::Area;
use crate::page::{Display, Extent, Watch, inner, paper, pitch};
use crate::pencil::Pencil;

/// Without an order the shape at least is found: with as many points.
const SHAPE: u64 = 1 << 12;

/// A curve ready to be drawn: at most `S` segments a generator, at most `DEPTH` refinements.
#[derive(Debug)]
pub struct CurvePicture<'a, const S: usize, const DEPTH: usize> {
    /// What replaces a segment.
    pub generator: &'a Generator<S>,
    /// What is refined.
    pub base: &'a [Point2],
    /// How often; none: down to the length of a pixel.
    pub order: Option<u32>,
    /// Whether what it encloses has a ground.
    pub filled: bool,
    /// How it is coloured.
    pub pencil: Pencil,
}

impl<'a, const S: usize, const DEPTH: usize> CurvePicture<'a, S, DEPTH> {
    fn measured(
        &self,
        path: Refined<'a, S, DEPTH>,
        size: Size,
    ) -> Result<(Refined<'a, S, DEPTH>, u32, Window), Error> {
        let extent = Extent::of(path.clone())?;
        Ok((path, extent.points, Window::fit(extent.room(), inner(size, 2).size)?))
    }

    /// The path on a display of this size, how many points it has, and the window that shows it.
    ///
    /// # Errors
    /// Those of [`Generator::refined`] and [`Window::fit`].
    pub fn path(&self, size: Size) -> Result<(Refined<'a, S, DEPTH>, u32, Window), Error> {
        let points = |order: u32| {
            (self.generator.len() as u64).saturating_pow(order).saturating_mul(self.base.len().max(1) as u64)
        };
        let order = self.order.unwrap_or_else(|| (0..6).rev().find(|k| points(*k) <= SHAPE).unwrap_or(0));
        let path = self.measured(self.generator.refined(self.base, order)?, size)?;
        match self.order {
            Some(_) => Ok(path),
            None => self.measured(self.generator.refined_to(self.base, pitch(&path.2))?, size),
        }
    }

    /// Draws it. `turns` is needed where it is filled: [`crate::ground_words`].
    ///
    /// # Errors
    /// As [`CurvePicture::path`]; [`Error::BufferLength`] with the words needed.
    pub fn draw<D: Display>(
        &self,
        size: Size,
        target: &mut D,
        turns: &mut [u32],
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let (path, points, window) = self.path(size)?;
        let corner = inner(size, 2).top_left;
        if self.filled {
            let area = Area::of(path.clone(), &window, (size, corner), turns)?;
            if !self.pencil.area(&area, target, watch) {
                return Ok(());
            }
        } else {
            paper(size, target);
        }
        self.pencil.line(path, points, (window, corner), target, watch);
        Ok(())
    }
}
