//! The page that everything is drawn on, and what it is drawn with.

use core::convert::Infallible;

use attractor::Error;
use attractor::draw::{Ink, Palette, Picture, RowCursor, hex};
use attractor::num::Real;
use attractor::plane::{Bounds2, Field, PathElement, Point2, Window};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::primitives::Rectangle;

use crate::ink::{ground, solid};

/// The ground of every page.
pub const PAPER: Rgb888 = hex(0x0b0e1a);

/// The most points of a path or of a chaos game.
pub const MAX_POINTS: u32 = 1 << 24;

/// A display that cannot fail, of any colour that core has an ink for.
pub trait Display: DrawTarget<Error = Infallible, Color: Ink> {}

impl<D: DrawTarget<Error = Infallible, Color: Ink>> Display for D {}

/// Called after each portion with the display, the portions done and those in all; `false` stops the drawing.
pub type Watch<'a, D> = &'a mut dyn FnMut(&mut D, u32, u32) -> bool;

/// Draws a field row by row; whether it was finished.
pub fn draw_field<F, P, D>(field: F, palette: P, target: &mut D, watch: Watch<'_, D>) -> bool
where
    F: Field,
    P: Palette<F::Value>,
    D: Display,
{
    let rows = field.size().height;
    let picture = Picture::<F, P, D::Color>::new(field, palette);
    let mut cursor = RowCursor::new();
    loop {
        match cursor.draw_next(&picture, target) {
            Ok(true) => {
                if !watch(target, cursor.row(), rows) {
                    return false;
                }
            }
            Ok(false) => return true,
            Err(impossible) => match impossible {},
        }
    }
}

/// Empty paper.
pub(crate) fn paper<D: Display>(size: Size, target: &mut D) {
    let paper = solid(ground::<D::Color>(PAPER));
    let Ok(()) = target.fill_solid(&Rectangle::new(Point::zero(), size), paper);
}

/// The display without a margin of a twenty-fourth of the shorter side, at least of `least` pixels; the
/// smallest displays have none.
pub(crate) fn inner(size: Size, least: u32) -> Rectangle {
    let side = size.width.min(size.height);
    let margin = if side < 32 { 0 } else { (side / 24).max(least) };
    let inner = Size::new(size.width - 2 * margin, size.height - 2 * margin);
    Rectangle::new(Point::new(margin as i32, margin as i32), inner)
}

/// The side of a pixel of a window.
pub(crate) fn pitch(window: &Window) -> Real {
    let (bounds, size) = (window.bounds(), window.size());
    let over = |min: Real, max: Real, pixels: u32| {
        (i64::from(max.to_bits()) - i64::from(min.to_bits())) / i64::from(pixels)
    };
    let across = over(bounds.min.x, bounds.max.x, size.width);
    let up = over(bounds.min.y, bounds.max.y, size.height);
    // a window that is stretched has two
    Real::from_bits(across.min(up).clamp(1, i64::from(i32::MAX)) as i32)
}

/// The box round a path and the number of its points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) bounds: Bounds2,
    pub(crate) points: u32,
}

impl Extent {
    /// Walks the path once.
    pub(crate) fn of(steps: impl Iterator<Item = PathElement>) -> Result<Self, Error> {
        let corner = |limit| Point2::new(limit, limit);
        let mut bounds = Bounds2 { min: corner(Real::MAX), max: corner(Real::MIN) };
        let mut points = 0;
        for step in steps {
            let (PathElement::MoveTo(p) | PathElement::LineTo(p)) = step;
            bounds.min = Point2::new(bounds.min.x.min(p.x), bounds.min.y.min(p.y));
            bounds.max = Point2::new(bounds.max.x.max(p.x), bounds.max.y.max(p.y));
            points += 1;
            if points > MAX_POINTS {
                let (needed, capacity) = (points as usize, MAX_POINTS as usize);
                return Err(Error::Capacity { what: "points of the curve", needed, capacity });
            }
        }
        Ok(Self { bounds, points })
    }

    /// Both boxes in one.
    pub(crate) fn with(self, other: Self) -> Self {
        let ((a, b), (c, d)) = ((self.bounds.min, self.bounds.max), (other.bounds.min, other.bounds.max));
        let min = Point2::new(a.x.min(c.x), a.y.min(c.y));
        let max = Point2::new(b.x.max(d.x), b.y.max(d.y));
        Self { bounds: Bounds2 { min, max }, points: self.points.saturating_add(other.points) }
    }

    /// The box, half a unit to each side where it has no extent.
    pub(crate) fn room(&self) -> Bounds2 {
        let widened = |min: Real, max: Real| {
            const HALF: Real = Real::lit("0.5");
            if max.saturating_sub(min) < Real::DELTA * 16 {
                (min.saturating_sub(HALF), max.saturating_add(HALF))
            } else {
                (min, max)
            }
        };
        let (x, y) =
            (widened(self.bounds.min.x, self.bounds.max.x), widened(self.bounds.min.y, self.bounds.max.y));
        Bounds2 { min: Point2::new(x.0, y.0), max: Point2::new(x.1, y.1) }
    }
}
