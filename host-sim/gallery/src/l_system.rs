//! The last word of an L-system, drawn by a turtle.

use attractor::Error;
use attractor::curve::{LSystem, Turtle};
use attractor::plane::Window;
use embedded_graphics::geometry::Size;

use crate::page::{Display, Extent, Watch, inner, paper};
use crate::pencil::Pencil;

/// An L-system ready to be drawn: room for `ORDERS` rewritings and `BRANCHES` open brackets.
#[derive(Debug)]
pub struct LSystemPicture<'a, const ORDERS: usize, const BRANCHES: usize> {
    /// Axiom, rules and angle.
    pub system: LSystem<'a>,
    /// How often it is rewritten.
    pub order: u32,
    /// How it is coloured.
    pub pencil: Pencil,
}

impl<'a, const ORDERS: usize, const BRANCHES: usize> LSystemPicture<'a, ORDERS, BRANCHES> {
    /// What the turtle draws.
    ///
    /// # Errors
    /// Those of [`LSystem::path`].
    pub fn path(&self) -> Result<Turtle<'a, ORDERS, BRANCHES>, Error> {
        self.system.path(self.order)
    }

    /// How many points it has, and the window that shows it. The path is walked, not kept.
    #[inline(never)]
    fn measured(&self, size: Size) -> Result<(u32, Window), Error> {
        let extent = Extent::of(self.path()?)?;
        if extent.points == 0 {
            return Err(Error::Degenerate { what: "the number of lines" });
        }
        Ok((extent.points, Window::fit(extent.room(), inner(size, 2).size)?))
    }

    /// Draws it.
    ///
    /// # Errors
    /// As [`LSystemPicture::path`]; [`Error::Degenerate`] where no line is drawn.
    pub fn draw<D: Display>(&self, size: Size, target: &mut D, watch: Watch<'_, D>) -> Result<(), Error> {
        let (points, window) = self.measured(size)?;
        paper(size, target);
        let corner = inner(size, 2).top_left;
        self.pencil.line(self.path()?, points, (window, corner), target, watch);
        Ok(())
    }
}
