//! The Julia set itself: covered, or as a cloud of points found by backward iteration.

use attractor::Error;
use attractor::draw::Level;
use attractor::escape::{BackwardIteration, JuliaCover, JuliaSet, View};
use attractor::num::Complex;
use attractor::num::{Real, Wide};
use attractor::plane::{PathElement, Point2, Window};
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};

use crate::density;
use crate::ink::ground;
use crate::named::Named;
use crate::page::{Display, Extent, MAX_POINTS, PAPER, Watch, draw_field, inner, pitch};

/// Points that show how large the set is.
const SCOUTS: usize = 1 << 14;
/// How the set is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Method {
    /// Backward iteration, a coin flip a point.
    Plain,
    /// Every pixel that it meets; nothing has to be stored.
    Cover,
}

/// A Julia set ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct JuliaSetPicture {
    /// Which.
    pub set: JuliaSet,
    /// How it is found.
    pub method: Method,
    /// How many points; none: 8 a pixel.
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
        let extent = Extent::of(scouts.map(PathElement::MoveTo))?;
        // the set is its own image under z -> -z; a scout may stop short of the farthest point
        let most = |a: Real, b: Real| a.abs().max(b.abs()).saturating_add(Real::lit("0.01"));
        let mut bounds = extent.bounds;
        let reach = Point2::new(most(bounds.min.x, bounds.max.x), most(bounds.min.y, bounds.max.y));
        (bounds.min, bounds.max) = (Point2::new(-reach.x, -reach.y), reach);
        Window::fit(bounds, inner(size, 2).size)
    }

    /// A random walk on the set.
    pub fn walk(&self, seed: u64) -> BackwardIteration<Xoshiro128PlusPlus> {
        self.set.seeded_backward_iteration(seed)
    }

    /// The set in every pixel of a display, with the margin that the window leaves: the view, and what is in
    /// it.
    ///
    /// # Errors
    /// As [`JuliaSetPicture::window`].
    pub fn cover(&self, size: Size) -> Result<(View, JuliaCover), Error> {
        let pitch = pitch(&self.window(size)?);
        // 24 fractional bits: half a pitch has 25, so that each pixel is the negative of another
        let width = Wide::from_num(pitch) * Wide::from_num(size.width.min(1 << 14));
        let view = View::new(Complex::default(), width, size)?;
        Ok((view, JuliaCover::new(view, self.set)?))
    }

    /// Draws it. `counts` has a number for each pixel within the margin for a plain walk; a cover needs none.
    ///
    /// # Errors
    /// As [`JuliaSetPicture::window`]; [`Error::BufferLength`] with the numbers needed.
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u64),
        target: &mut D,
        counts: &mut [u16],
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let paper = ground::<D::Color>(PAPER);
        match self.method {
            Method::Cover => {
                let (_, cover) = self.cover(size)?;
                // where dots would be scattered, a pixel is lit for a quarter of its sixteenths: what only
                // touches it would make lines thick
                let coarse = paper == Rgb888::BLACK;
                let color = |sixteenths: u8| match sixteenths {
                    0 => paper,
                    1..4 if coarse => paper,
                    _ if coarse => Rgb888::WHITE,
                    n => self.palette.at(Level::from_bits(16_383 + 3072 * u16::from(n.min(16)))),
                };
                draw_field(cover, color, target, watch);
                Ok(())
            }
            Method::Plain => {
                let window = self.window(size)?;
                let pixels = size.width.saturating_mul(size.height).saturating_mul(8);
                let most = self.points.unwrap_or(pixels.clamp(1, MAX_POINTS));
                let margin = inner(size, 2).top_left.x.unsigned_abs();
                let color = |hits| density::color(self.palette, paper, hits);
                density::counted(
                    self.walk(seed).take(most as usize),
                    window,
                    (size, margin),
                    counts,
                    |framed| {
                        draw_field(&framed, color, target, watch);
                    },
                )
            }
        }
    }
}
