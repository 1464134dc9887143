//! A polyline each of whose segments is replaced by a generator, again and again.

use attractor::Error;
use attractor::curve::{Generator, Refined};
use attractor::num::Real;
use attractor::plane::{Point2, Window};
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

/// How far a curve is refined.
#[derive(Debug, Clone, Copy)]
enum Limit {
    Order(u32),
    Length(Real),
}

impl<'a, const S: usize, const DEPTH: usize> CurvePicture<'a, S, DEPTH> {
    fn walk(&self, limit: Limit) -> Result<Refined<'a, S, DEPTH>, Error> {
        match limit {
            Limit::Order(order) => self.generator.refined(self.base, order),
            Limit::Length(length) => self.generator.refined_to(self.base, length),
        }
    }

    /// How many points it then has, and the window that shows it. The path is walked, not kept: it takes more
    /// room than what is known of it.
    #[inline(never)]
    fn measured(&self, limit: Limit, size: Size) -> Result<(Limit, u32, Window), Error> {
        let extent = Extent::of(self.walk(limit)?)?;
        Ok((limit, extent.points, Window::fit(extent.room(), inner(size, 2).size)?))
    }

    fn resolved(&self, size: Size) -> Result<(Limit, u32, Window), Error> {
        if let Some(order) = self.order {
            return self.measured(Limit::Order(order), size);
        }
        let points = |order: u32| {
            (self.generator.len() as u64).saturating_pow(order).saturating_mul(self.base.len().max(1) as u64)
        };
        let shape = (0..6).rev().find(|k| points(*k) <= SHAPE).unwrap_or(0);
        let (_, _, window) = self.measured(Limit::Order(shape), size)?;
        self.measured(Limit::Length(pitch(&window)), size)
    }

    /// The path on a display of this size.
    ///
    /// # Errors
    /// Those of [`Generator::refined`] and [`Window::fit`].
    pub fn path(&self, size: Size) -> Result<Refined<'a, S, DEPTH>, Error> {
        self.walk(self.resolved(size)?.0)
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
        let (limit, points, window) = self.resolved(size)?;
        let corner = inner(size, 2).top_left;
        if self.filled {
            let area = Area::of(self.walk(limit)?, &window, (size, corner), turns)?;
            if !self.pencil.area(&area, target, watch) {
                return Ok(());
            }
        } else {
            paper(size, target);
        }
        self.pencil.line(self.walk(limit)?, points, (window, corner), target, watch);
        Ok(())
    }
}
