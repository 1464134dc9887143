//! A curve by control points.

use attractor::Error;
use attractor::patch::ProjectedCurve;
use attractor::plane::{Point2, Window};
use embedded_graphics::geometry::Size;

use crate::page::{Display, Extent, Watch, inner, paper};
use crate::pencil::Pencil;

/// A curve by control points ready to be drawn.
#[derive(Debug)]
pub struct PatchCurvePicture<'a, const M: usize> {
    /// The curve.
    pub curve: &'a ProjectedCurve<2, M>,
    /// Its control points.
    pub points: [Point2; M],
    /// How many binary digits a parameter has.
    pub levels: u32,
    /// How it is coloured.
    pub pencil: Pencil,
}

impl<const M: usize> PatchCurvePicture<'_, M> {
    /// Draws it.
    ///
    /// # Errors
    /// Those of [`ProjectedCurve::polyline`] and [`Window::fit`].
    pub fn draw<D: Display>(&self, size: Size, target: &mut D, watch: Watch<'_, D>) -> Result<(), Error> {
        let path = || self.curve.polyline(self.points, self.levels);
        let (extent, area) = (Extent::of(path()?)?, inner(size, 2));
        let window = Window::fit(extent.room(), area.size)?;
        paper(size, target);
        self.pencil.line(path()?, extent.points, (window, area.top_left), target, watch);
        Ok(())
    }
}
