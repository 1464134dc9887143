//! The graph of a function as a path.

use core::iter::FusedIterator;

use super::function::Fif;
use crate::num::Real;
use crate::plane::{PathElement, Point2};

/// A path through equally spaced points of the graph; `x` is the unit abscissa in `[0, 1]`.
///
/// ```
/// use attractor::draw::Stroke;
/// use attractor::fif::{Fif, Knot};
/// use attractor::num::Scaling;
/// use attractor::plane::{Bounds2, Point2, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// const KNOTS: [Knot; 3] = [Knot::lit("0", "0"), Knot::lit("1", "1"), Knot::lit("2", "0")];
/// let tent = Fif::<2, 1>::interpolating(&KNOTS, &[Scaling::ZERO; 2])?;
/// let bounds = Bounds2 { min: Point2::lit("0", "0"), max: Point2::lit("1", "1") };
/// let window = Window::stretch(bounds, Size::new(7, 4))?;
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// let _ = Stroke::new(tent.graph(2), window, BinaryColor::On).draw(&mut display);
/// assert_eq!(display.affected_area().size, window.size());
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Graph<'a, const N: usize, const D: usize> {
    fif: &'a Fif<N, D>,
    next: u32,
    last: u32,
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The path through the points over `i / segments` of the domain, `i = 0 ... segments`. Between them a
    /// rough function reaches further: how far says [`Fif::oscillation`]. Cost: one evaluation a point.
    pub fn graph(&self, segments: u32) -> Graph<'_, N, D> {
        Graph { fif: self, next: 0, last: segments.clamp(1, u32::MAX - 1) }
    }
}

impl<const N: usize, const D: usize> Iterator for Graph<'_, N, D> {
    type Item = PathElement;

    fn next(&mut self) -> Option<PathElement> {
        if self.next > self.last {
            return None;
        }
        let (u, y) = self.fif.at_fraction(self.next, self.last);
        let point = Point2::new(Real::from_bits((u >> 39) as i32), y);
        let step = if self.next == 0 { PathElement::MoveTo(point) } else { PathElement::LineTo(point) };
        self.next += 1;
        Some(step)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.last + 1).saturating_sub(self.next) as usize;
        (left, Some(left))
    }
}

impl<const N: usize, const D: usize> ExactSizeIterator for Graph<'_, N, D> {}
impl<const N: usize, const D: usize> FusedIterator for Graph<'_, N, D> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::{Scaling, Wide};

    fn tent() -> Fif<2, 1> {
        let knots = [(1, 0), (2, 1), (3, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        Fif::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap()
    }

    /// The straight tent: `y = min(2 u, 2 - 2 u)` at `u = i / n`, rounded to nearest; `x` rounded down.
    #[test]
    fn a_graph_goes_from_end_to_end_in_equal_parts() {
        let f = tent();
        for n in [1, 2, 3, 7, 10, 1000_u32] {
            let mut count = 0_i64;
            for (i, step) in f.graph(n).enumerate() {
                let (i, n) = (i as i64, i64::from(n));
                let point = match step {
                    PathElement::MoveTo(point) if i == 0 => point,
                    PathElement::LineTo(point) if i > 0 => point,
                    other => panic!("{i}: {other:?}"),
                };
                assert_eq!(i64::from(point.x.to_bits()), (i << 24) / n, "{i} / {n}");
                let y = (2 * i).min(2 * (n - i)) << 24;
                assert!((2 * (i64::from(point.y.to_bits()) * n - y)).abs() <= n, "{i} / {n}: {}", point.y);
                count += 1;
            }
            assert_eq!(count, i64::from(n) + 1);
        }
    }

    #[test]
    fn a_graph_knows_how_long_it_is() {
        let f = tent();
        let mut graph = f.graph(3);
        for left in (1..=4).rev() {
            assert_eq!(graph.size_hint(), (left, Some(left)));
            assert!(graph.next().is_some());
        }
        assert!(graph.next().is_none() && graph.next().is_none());
        assert_eq!(graph.len(), 0);
        assert_eq!((f.graph(0).len(), f.graph(u32::MAX).len()), (2, u32::MAX as usize));
    }
}
