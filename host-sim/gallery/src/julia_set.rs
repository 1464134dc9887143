//! The Julia set itself, a cloud of points found by backward iteration.

use attractor::Error;
use attractor::escape::JuliaSet;
use attractor::num::Real;
use attractor::picture::{Point2, Step, Window};
use embedded_graphics::geometry::Size;

use crate::density;
use crate::ink::ground;
use crate::named::Named;
use crate::page::{Display, Extent, MAX_POINTS, PAPER, Watch, draw_field, inner, pitch};

/// Points that show how large the set is.
const SCOUTS: usize = 1 << 14;
/// How often the pruned method goes on from a cell of the size of a pixel.
const HITS: u8 = 12;
/// The grid covers the square of side 4; finer than this it would only be larger.
const CELLS: i64 = 1 << 12;

/// How points are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Method {
    /// A coin flip a point.
    Plain,
    /// The tree of all preimages without its crowded branches.
    Pruned,
}

/// A Julia set ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct JuliaSetPicture {
    /// Which.
    pub set: JuliaSet,
    /// How its points are found.
    pub method: Method,
    /// How many; none: 8 a pixel.
    pub points: Option<u32>,
    /// How they are coloured.
    pub palette: Named,
}

impl JuliaSetPicture {
    /// What a display of this size shows.
    ///
    /// # Errors
    /// Those of [`Window::fit`].
    pub fn window(&self, size: Size) -> Result<Window, Error> {
        let scouts = self.set.seeded_backward_iteration(1).take(SCOUTS);
        let extent = Extent::of(scouts.map(Step::MoveTo))?;
        // the set is its own image under z -> -z; a scout may stop short of the farthest point
        let most = |a: Real, b: Real| a.abs().max(b.abs()).saturating_add(Real::lit("0.01"));
        let mut bounds = extent.bounds;
        let reach = Point2::new(most(bounds.min.x, bounds.max.x), most(bounds.min.y, bounds.max.y));
        (bounds.min, bounds.max) = (Point2::new(-reach.x, -reach.y), reach);
        Window::fit(bounds, inner(size, 2).size)
    }

    /// Cells a side of the grid by which the pruned method counts; 0 for the plain one.
    pub fn grid(&self, window: &Window) -> usize {
        match self.method {
            Method::Plain => 0,
            Method::Pruned => {
                ((4 << 24) / i64::from(pitch(window).to_bits().max(1))).clamp(1, CELLS) as usize
            }
        }
    }

    /// The points, in a window, no more than `most`, handed to `use_them`. `hits` has [`JuliaSetPicture::grid`] squared elements.
    ///
    /// # Errors
    /// [`Error::BufferLength`] with the elements needed, and what `use_them` says.
    pub fn found<R>(
        &self,
        (window, seed, most): (&Window, u64, u32),
        hits: &mut [u8],
        use_them: impl FnOnce(&mut dyn Iterator<Item = Point2>) -> R,
    ) -> Result<R, Error> {
        let most = most as usize;
        match self.method {
            Method::Plain => Ok(use_them(&mut self.set.seeded_backward_iteration(seed).take(most))),
            Method::Pruned => {
                let side = self.grid(window);
                let (given, needed) = (hits.len(), side * side);
                let hits =
                    hits.get_mut(..needed).ok_or(Error::BufferLength { what: "cells", given, needed })?;
                Ok(use_them(&mut self.set.pruned_iteration(side, HITS, hits)?.take(most)))
            }
        }
    }

    /// Draws it. `counts` has a number for each pixel of the display, `hits` as for [`JuliaSetPicture::found`].
    ///
    /// # Errors
    /// As [`JuliaSetPicture::window`] and [`JuliaSetPicture::found`].
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u64),
        target: &mut D,
        (counts, hits): (&mut [u16], &mut [u8]),
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let window = self.window(size)?;
        let pixels = size.width.saturating_mul(size.height).saturating_mul(8);
        let most = self.points.unwrap_or(pixels.clamp(1, MAX_POINTS));
        let margin = inner(size, 2).top_left.x.unsigned_abs();
        let paper = ground::<D::Color>(PAPER);
        let color = |hits| density::color(self.palette, paper, hits);
        self.found((&window, seed, most), hits, |points| {
            density::counted(points, window, (size, margin), counts, |framed| {
                draw_field(&framed, color, target, watch);
            })
        })?
    }
}
