//! Figure 2: the intervals of `L_1`, `L_1 o L_2`, ... one below the other, closing in on the evaluation
//! point.

use core::ops::Range;

use attractor::draw::Level;
use attractor::fif::Fif;
use attractor::num::Real;
use attractor::plane::Point2;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use crate::ink::{ground, solid};
use crate::named::Named;
use crate::page::Display;
use crate::plot::{MARK, Plot, value};

/// The longest address that is shown.
const LONGEST: usize = 16;

/// The intervals of ever longer compositions; empty for an ordinary chart.
#[derive(Debug)]
pub(crate) struct Nested {
    /// Ends in the unit abscissa; the first `count` are in use.
    intervals: [(Real, Real); LONGEST + 1],
    count: usize,
    /// The image of the median knot under the whole composition: the evaluation point.
    point: Real,
    /// Rows of a bar and of the gap below it.
    bar: u32,
    gap: u32,
}

impl Nested {
    /// The intervals of the first 0, 1, 2 ... maps of the address.
    pub(crate) fn new<const N: usize, const D: usize>(
        fif: &Fif<N, D>,
        address: &[usize],
        size: Size,
    ) -> Self {
        let mut intervals = [(Real::ZERO, Real::ZERO); LONGEST + 1];
        let count = if address.is_empty() { 0 } else { address.len().min(LONGEST) + 1 };
        for (maps, interval) in intervals.iter_mut().enumerate().take(count) {
            *interval = fif.composite(address.iter().copied().take(maps)).interval();
        }
        let median = address.iter().copied().chain([fif.maps() / 2]);
        let point = fif.composite(median).interval().0;
        // bars take two fifths of the display
        let pitch = (size.height * 2 / 5 / (count as u32).max(1)).max(2);
        let gap = (pitch / 3).max(1);
        Self { intervals, count, point, bar: pitch - gap, gap }
    }

    fn intervals(&self) -> &[(Real, Real)] {
        self.intervals.get(..self.count).unwrap_or_default()
    }

    /// How many rows the bars take, the gap above them included.
    pub(crate) fn height(&self) -> u32 {
        (self.bar + self.gap) * self.count as u32
    }

    /// The columns of the last interval, one at least.
    pub(crate) fn focus(&self, plot: &Plot) -> Option<Range<i32>> {
        let (from, to) = self.intervals().last()?;
        let column = |u: Real| plot.pixel(Point2::new(u, Real::ZERO)).x;
        Some(column(*from)..column(*to).max(column(*from) + 1))
    }

    /// Draws the bars and marks the evaluation point on the curve.
    pub(crate) fn draw<T: Display, const N: usize, const D: usize>(
        &self,
        fif: &Fif<N, D>,
        plot: &Plot,
        target: &mut T,
    ) {
        let Some(last) = self.count.checked_sub(1) else { return };
        let column = |u: Real| plot.pixel(Point2::new(u, Real::ZERO)).x;
        let top = plot.corner.y + plot.window.size().height as i32 + self.gap as i32;
        let full = (column(Real::ZERO), column(Real::ONE) + 1);
        for (level, (from, to)) in self.intervals().iter().enumerate() {
            let y = top + (level as u32 * (self.bar + self.gap)) as i32;
            let fill = |left: i32, right: i32, color: T::Color, target: &mut T| {
                let size = Size::new((right - left).max(1) as u32, self.bar);
                let Ok(()) = target.fill_solid(&Rectangle::new(Point::new(left, y), size), color);
            };
            let lane = ground::<T::Color>(Named::Ocean.at(Level::from_bits(6_000)));
            fill(full.0, full.1, solid(lane), target);
            let share = Level::ratio(level as u32 + 2, last as u32 + 2);
            let right = if *to == Real::ONE { full.1 } else { column(*to) };
            let rgb = if level == last { MARK } else { Named::Ocean.at(share) };
            fill(column(*from), right, solid(rgb), target);
        }
        plot.mark(Point2::new(self.point, value(fif, self.point)), target);
    }
}
