//! Figure 2: the intervals of `L_1`, `L_1 o L_2`, ... one below the other, closing in on the evaluation point.

use std::convert::Infallible;
use std::ops::Range;

use attractor::draw::Level;
use attractor::num::Real;
use attractor::picture::Point2;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::chart::{Chart, MARK};
use super::function::Fixed;
use crate::color::{Depth, ground, solid};
use crate::palette::Named;

/// The intervals of ever longer compositions; empty for an ordinary chart.
#[derive(Debug)]
pub(super) struct Nested {
    /// Ends in the unit abscissa.
    intervals: Vec<(Real, Real)>,
    /// The image of the median knot under the whole composition: the evaluation point.
    point: Real,
    /// Rows of a bar and of the gap below it.
    bar: u32,
    gap: u32,
}

impl Nested {
    /// The intervals of the first 0, 1, 2 ... maps of the address.
    pub(super) fn new(fif: &Fixed, address: &[usize], size: Size) -> Self {
        if address.is_empty() {
            return Self { intervals: Vec::new(), point: Real::ZERO, bar: 0, gap: 0 };
        }
        let composed = |maps: usize| fif.composite(address.iter().copied().take(maps)).interval();
        let intervals: Vec<_> = (0..=address.len()).map(composed).collect();
        let median = address.iter().copied().chain([fif.maps() / 2]);
        let point = fif.composite(median).interval().0;
        // bars take two fifths of the display
        let pitch = (size.height * 2 / 5 / intervals.len() as u32).max(2);
        let gap = (pitch / 3).max(1);
        Self { intervals, point, bar: pitch - gap, gap }
    }

    /// How many rows the bars take, the gap above them included.
    pub(super) fn height(&self) -> u32 {
        (self.bar + self.gap) * self.intervals.len() as u32
    }

    /// The columns of the last interval, one at least.
    pub(super) fn focus(&self, chart: &Chart<'_>) -> Option<Range<i32>> {
        let (from, to) = self.intervals.last()?;
        let column = |u: Real| chart.pixel(Point2::new(u, Real::ZERO)).x;
        Some(column(*from)..column(*to).max(column(*from) + 1))
    }

    /// Draws the bars and marks the evaluation point on the curve.
    pub(super) fn draw<D>(&self, chart: &Chart<'_>, target: &mut D)
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        if self.intervals.is_empty() {
            return;
        }
        let column = |u: Real| chart.pixel(Point2::new(u, Real::ZERO)).x;
        let top = chart.corner.y + chart.window.size().height as i32 + self.gap as i32;
        let last = self.intervals.len() - 1;
        let full = (column(Real::ZERO), column(Real::ONE) + 1);
        for (level, (from, to)) in self.intervals.iter().enumerate() {
            let y = top + (level as u32 * (self.bar + self.gap)) as i32;
            let fill = |left: i32, right: i32, color: D::Color, target: &mut D| {
                let size = Size::new((right - left).max(1) as u32, self.bar);
                let Ok(()) = target.fill_solid(&Rectangle::new(Point::new(left, y), size), color);
            };
            let lane = ground::<D::Color>(Named::Ocean.at(Level(6_000)));
            fill(full.0, full.1, solid(lane), target);
            let share = Level::ratio(level as u32 + 2, last as u32 + 2);
            let right = if *to == Real::ONE { full.1 } else { column(*to) };
            let rgb = if level == last { MARK } else { Named::Ocean.at(share) };
            fill(column(*from), right, solid(rgb), target);
        }
        chart.mark(Point2::new(self.point, chart.value(self.point)), target);
    }
}
