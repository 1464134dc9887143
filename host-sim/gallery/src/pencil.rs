//! A path on paper: the ground of a closed path, a line whose colour changes along it.

use core::cell::{Cell, RefCell};
use core::iter::Peekable;

use attractor::draw::{Level, Stroke};
use attractor::picture::{Point2, Step, Window};
use embedded_graphics::geometry::Point;
use embedded_graphics::prelude::Drawable;

use crate::area::Area;
use crate::ink::{ground, solid};
use crate::named::Named;
use crate::page::{Display, PAPER, Watch, draw_field};

/// Colours along a path.
const HUES: u32 = 64;

/// How a path is coloured.
#[derive(Debug, Clone, Copy)]
pub struct Pencil {
    /// Whose colours it goes through.
    pub palette: Named,
    /// Whether the last colour is the first again.
    pub closed: bool,
}

/// So many steps of a path that all portions draw from, after the point where the one before ended.
#[derive(Clone)]
struct Portion<'a, I: Iterator> {
    steps: &'a RefCell<Peekable<I>>,
    last: &'a Cell<Option<Point2>>,
    pen: Option<Point2>,
    left: u32,
}

impl<I: Iterator<Item = Step>> Iterator for Portion<'_, I> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        if let Some(pen) = self.pen.take() {
            return Some(Step::MoveTo(pen));
        }
        self.left = self.left.checked_sub(1)?;
        // nobody else draws meanwhile
        let step = self.steps.try_borrow_mut().ok()?.next()?;
        let (Step::MoveTo(p) | Step::LineTo(p)) = step;
        self.last.set(Some(p));
        Some(step)
    }
}

impl Pencil {
    /// Paper, with what the path encloses in the dark colours of the palette.
    pub(crate) fn area<D: Display>(&self, area: &Area<'_>, target: &mut D, watch: Watch<'_, D>) -> bool {
        let paper = ground::<D::Color>(PAPER);
        let color =
            |level: Option<Level>| level.map_or(paper, |level| self.palette.at(Level(8_000 + level.0 / 4)));
        draw_field(area, color, target, watch)
    }

    /// The line of a path of so many points, in one pass; whether it was finished.
    pub(crate) fn line<D: Display>(
        &self,
        steps: impl Iterator<Item = Step> + Clone,
        points: u32,
        (window, corner): (Window, Point),
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> bool {
        let portion = points.div_ceil(HUES).max(1);
        let steps = RefCell::new(steps.peekable());
        let last = Cell::new(None);
        for hue in 0..HUES {
            let part = Portion { steps: &steps, last: &last, pen: last.get(), left: portion };
            let color = solid::<D::Color>(self.palette.at(self.hue(hue)));
            let Ok(_) = Stroke::new(part, window, color).at(corner).draw(target);
            if !watch(target, hue + 1, HUES) {
                return false;
            }
            if steps.borrow_mut().peek().is_none() {
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
