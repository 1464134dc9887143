//! A path on paper: the ground of a closed path, a line whose colour changes along it.

use attractor::draw::{Level, Stroke};
use attractor::plane::{PathElement, Window};
use embedded_graphics::geometry::Point;

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

impl Pencil {
    /// Paper, with what the path encloses in the dark colours of the palette.
    pub(crate) fn area<D: Display>(&self, area: &Area<'_>, target: &mut D, watch: Watch<'_, D>) -> bool {
        let paper = ground::<D::Color>(PAPER);
        let color = |level: Option<Level>| {
            level.map_or(paper, |level| self.palette.at(Level::from_bits(8_000 + level.to_bits() / 4)))
        };
        draw_field(area, color, target, watch)
    }

    /// The line of a path of so many points, in one pass; whether it was finished.
    pub(crate) fn line<D: Display>(
        &self,
        steps: impl Iterator<Item = PathElement>,
        points: u32,
        (window, corner): (Window, Point),
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> bool {
        let portion = points.div_ceil(HUES).max(1);
        let mut steps = steps.peekable();
        let mut last = None;
        for hue in 0..HUES {
            // each portion goes on where the one before ended
            let pen = last.map(PathElement::MoveTo);
            let part = steps.by_ref().take(portion as usize).inspect(|step| {
                let (PathElement::MoveTo(p) | PathElement::LineTo(p)) = step;
                last = Some(*p);
            });
            let color = solid::<D::Color>(self.palette.at(self.hue(hue)));
            let stroke = Stroke::new(pen.into_iter().chain(part), window, color).at(corner);
            let Ok(_) = stroke.draw_once(target);
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
        Level::from_bits(23_000 + Level::ratio(place, last).to_bits() / 8 * 5)
    }
}
