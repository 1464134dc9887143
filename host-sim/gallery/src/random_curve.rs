//! A curve through knots whose midpoints a law displaces at random.

use attractor::Error;
use attractor::curve::{Displacement, Stop, Subdivision};
use attractor::num::Parameter;
use attractor::plane::{PathElement, Point2, Window};
use embedded_graphics::geometry::Size;

use crate::area::Area;
use crate::page::{Display, Extent, Watch, inner, paper, pitch};
use crate::pencil::Pencil;

/// A random curve ready to be drawn, with at most `LEVELS` halvings between two knots.
#[derive(Debug)]
pub struct RandomCurvePicture<'a, L, const LEVELS: usize> {
    /// The law.
    pub law: &'a L,
    /// Whether it is the graph of a function, which is stretched over the display.
    pub graph: bool,
    /// The knots.
    pub knots: &'a [Point2],
    /// None: down to the length of a pixel.
    pub stop: Option<Stop>,
    /// Whether what it encloses has a ground, or what lies below it.
    pub filled: bool,
    /// How it is coloured.
    pub pencil: Pencil,
}

type Curve<'a, L, const LEVELS: usize> = Subdivision<'a, L, LEVELS>;

impl<'a, L: Displacement + Clone, const LEVELS: usize> RandomCurvePicture<'a, L, LEVELS> {
    fn walk(&self, stop: Stop) -> Result<Curve<'a, L, LEVELS>, Error> {
        Subdivision::new(self.law, self.knots, stop)
    }

    /// What it then takes, and the window that shows it. The path is walked, not kept: it takes more room
    /// than what is known of it.
    #[inline(never)]
    fn measured(&self, stop: Stop, size: Size) -> Result<(Stop, Extent, Window), Error> {
        let extent = Extent::of(self.walk(stop)?)?;
        let (room, size) = (extent.room(), inner(size, 2).size);
        let window = if self.graph { Window::stretch(room, size) } else { Window::fit(room, size) };
        Ok((stop, extent, window?))
    }

    fn resolved(&self, size: Size) -> Result<(Stop, Extent, Window), Error> {
        if let Some(stop) = self.stop {
            return self.measured(stop, size);
        }
        let (_, _, window) = self.measured(Stop::Parameter(Parameter::from_bits(1 << 24)), size)?;
        self.measured(Stop::Length(pitch(&window)), size)
    }

    /// The path on a display of this size.
    ///
    /// # Errors
    /// Those of [`Subdivision::new`] and [`Window::fit`].
    pub fn path(&self, size: Size) -> Result<Curve<'a, L, LEVELS>, Error> {
        self.walk(self.resolved(size)?.0)
    }

    /// Draws it. `turns` is needed where it is filled: [`crate::ground_words`].
    ///
    /// # Errors
    /// As [`RandomCurvePicture::path`]; [`Error::BufferLength`] with the words needed.
    pub fn draw<D: Display>(
        &self,
        size: Size,
        target: &mut D,
        turns: &mut [u32],
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let (stop, extent, window) = self.resolved(size)?;
        let corner = inner(size, 2).top_left;
        if self.filled {
            // what is open is closed below: the ground under a graph
            let (min, max) = (extent.bounds.min, extent.bounds.max);
            let below = [max.x, min.x].map(|x| PathElement::LineTo(Point2::new(x, min.y)));
            let below = below.into_iter().chain(self.knots.first().map(|p| PathElement::LineTo(*p)));
            let below = below.filter(|_| !self.pencil.closed);
            let area = Area::of(self.walk(stop)?.chain(below), &window, (size, corner), turns)?;
            if !self.pencil.area(&area, target, watch) {
                return Ok(());
            }
        } else {
            paper(size, target);
        }
        self.pencil.line(self.walk(stop)?, extent.points, (window, corner), target, watch);
        Ok(())
    }
}
