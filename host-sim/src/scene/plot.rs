//! A path on paper: margins, the ground of a closed path, a line whose colour changes along it.

use std::convert::Infallible;

use attractor::draw::{Level, Stroke};
use attractor::num::Real;
use attractor::picture::{Bounds2, Point2, Step, Window};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::prelude::Drawable;
use embedded_graphics::primitives::Rectangle;

use super::area::Area;
use super::chart::PAPER;
use super::{Watch, draw_field};
use crate::cli::MAX_POINTS;
use crate::color::{Depth, ground, solid};
use crate::fail::Fail;
use crate::palette::Named;

/// Colours along a path.
const HUES: u32 = 64;

/// The box round a path and the number of its points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub(super) bounds: Bounds2,
    pub(super) points: u32,
}

impl Extent {
    /// Walks the path once.
    pub(super) fn of(steps: impl Iterator<Item = Step>) -> Result<Self, Fail> {
        let corner = |limit| Point2::new(limit, limit);
        let mut bounds = Bounds2 { min: corner(Real::MAX), max: corner(Real::MIN) };
        let mut points = 0;
        for step in steps {
            let (Step::MoveTo(p) | Step::LineTo(p)) = step;
            bounds.min = Point2::new(bounds.min.x.min(p.x), bounds.min.y.min(p.y));
            bounds.max = Point2::new(bounds.max.x.max(p.x), bounds.max.y.max(p.y));
            points += 1;
            if points > MAX_POINTS {
                return Err(Fail::new(format_args!("the curve has more than {MAX_POINTS} points")));
            }
        }
        Ok(Self { bounds, points })
    }

    /// Both boxes in one.
    pub(super) fn with(self, other: Self) -> Self {
        let ((a, b), (c, d)) = ((self.bounds.min, self.bounds.max), (other.bounds.min, other.bounds.max));
        let min = Point2::new(a.x.min(c.x), a.y.min(c.y));
        let max = Point2::new(b.x.max(d.x), b.y.max(d.y));
        Self { bounds: Bounds2 { min, max }, points: self.points.saturating_add(other.points) }
    }

    /// The box, half a unit to each side where it has no extent.
    pub(super) fn room(&self) -> Bounds2 {
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

/// The display without its margin.
pub(super) fn inner(size: Size) -> Rectangle {
    let side = size.width.min(size.height);
    let margin = if side < 32 { 0 } else { (side / 24).max(2) };
    let inner = Size::new(size.width - 2 * margin, size.height - 2 * margin);
    Rectangle::new(Point::new(margin as i32, margin as i32), inner)
}

/// The side of a pixel of a window.
pub(super) fn pitch(window: &Window) -> Real {
    let (bounds, size) = (window.bounds(), window.size());
    let over = |min: Real, max: Real, pixels: u32| {
        (i64::from(max.to_bits()) - i64::from(min.to_bits())) / i64::from(pixels)
    };
    let across = over(bounds.min.x, bounds.max.x, size.width);
    let up = over(bounds.min.y, bounds.max.y, size.height);
    // a window that is stretched has two
    Real::from_bits(across.min(up).clamp(1, i64::from(i32::MAX)) as i32)
}

/// How a path is coloured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pencil {
    pub(super) palette: Named,
    /// Whether the last colour is the first again.
    pub(super) closed: bool,
}

impl Pencil {
    /// Empty paper.
    pub(super) fn paper<D>(size: Size, target: &mut D)
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let paper = solid(ground::<D::Color>(PAPER));
        let Ok(()) = target.fill_solid(&Rectangle::new(Point::zero(), size), paper);
    }

    /// Paper, with what the path encloses in the dark colours of the palette.
    pub(super) fn area<D>(&self, area: Area, target: &mut D, watch: Watch<'_, D>) -> bool
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let paper = ground::<D::Color>(PAPER);
        let color =
            |level: Option<Level>| level.map_or(paper, |level| self.palette.at(Level(8_000 + level.0 / 4)));
        draw_field(area, color, target, watch)
    }

    /// The line, in one pass; whether it was finished.
    pub(super) fn line<D>(
        &self,
        steps: impl Iterator<Item = Step>,
        points: u32,
        (window, corner): (Window, Point),
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> bool
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let portion = points.div_ceil(HUES).max(1);
        let mut part: Vec<Step> = Vec::new();
        let mut steps = steps.peekable();
        for hue in 0..HUES {
            // from the last point of the part before
            let pen = part.last().map(|(Step::MoveTo(p) | Step::LineTo(p))| Step::MoveTo(*p));
            part.clear();
            part.extend(pen);
            part.extend(steps.by_ref().take(portion as usize));
            let color = solid::<D::Color>(self.palette.at(self.hue(hue)));
            let Ok(_) = Stroke::new(part.iter().copied(), window, color).at(corner).draw(target);
            if !watch(target, hue + 1, HUES) {
                return false;
            }
            if steps.peek().is_none() {
                break;
            }
        }
        true
    }

    /// Without the darkest third, which is left to the paper.
    fn hue(&self, hue: u32) -> Level {
        let last = HUES - 1;
        let place = if self.closed { (2 * hue).min(2 * (last - hue)) } else { hue };
        Level(23_000 + Level::ratio(place, last).0 / 8 * 5)
    }
}
