//! A polyline whose segments are replaced by a generator, again and again, as a path: this is what draws the
//! Koch curve and its relatives.
//!
//! The curve of order `n` has exponentially many vertices and none is stored. Its segments are the leaves of
//! a tree: a copy of the curve that starts at `p` and leads along `d` consists of the copies at `p + d v_i`
//! along `d w_i` (see [`Generator`]). The walk through that tree needs no recursion; it keeps the copies on
//! the way down in a stack of `DEPTH` entries. Each vertex is computed from the copy in which it first
//! appears, so that the error grows with the depth of that copy and never with the number of segments, and
//! the vertices of order `n` are among those of order `n + 1`, to the last bit.
//!
//! Formats: `p` has 56 fractional bits, `d` 26, `v` and `w` 30; so `p + d v` needs no shift and no rounding,
//! and its high word is a [`crate::num::Real`]. Only `d w` is rounded, by half of `2^-26`. Source: course
//! unit V, section 5.1.2 (`drawKoch`).

use super::generator::{Generator, Segment, hypotenuse, oriented};
use crate::Error;
use crate::num::formats::{Q26, Q30, Q56, UQ26, UQ30};
use crate::num::{Real, Wide, complex_product_added, product, product_u};
use crate::plane::{PathElement, Point2};

/// Segments of the base are shorter than this.
const LONGEST: u64 = 32;

/// A copy of the whole curve in the place of one segment, whose own segments are refined further.
#[derive(Debug, Clone, Copy, Default)]
struct Replica {
    /// Where its next segment begins, and the half unit that rounds the high word.
    start: [Q56; 2],
    /// From its start to its end.
    vector: [Q26; 2],
    /// The length of that, rounded up.
    length: UQ26,
    /// Its next segment and the one after its last, in [`Generator::segments`].
    next: u8,
    end: u8,
    /// Reversed, mirrored: [`super::Orientation`].
    state: u8,
    /// How often it is refined.
    orders: u8,
}

/// A copy whose segments are drawn as they are.
#[derive(Debug, Clone, Copy, Default)]
struct Drawn {
    /// As in [`Replica`], of its first segment.
    start: [Q56; 2],
    vector: [Q26; 2],
    state: u8,
}

impl Drawn {
    /// `p + d v`, `v` mirrored if the copy is.
    #[inline(always)]
    fn place(&self, [x, y]: [Q30; 2]) -> [Q56; 2] {
        // on the copy's own segment half the products are left
        if cfg!(no_long_product) && y == 0 {
            let ([p, q], [dx, dy]) = (self.start, self.vector);
            return [p.wrapping_add(product(dx, x)), q.wrapping_add(product(dy, x))];
        }
        let y = if self.state & 2 == 0 { y } else { y.wrapping_neg() };
        // the constructor proves |p + d v| < 128 for all copies
        complex_product_added(self.start, self.vector, [x, y])
    }
}

impl Replica {
    #[inline(always)]
    const fn drawn(&self) -> Drawn {
        Drawn { start: self.start, vector: self.vector, state: self.state }
    }

    /// The copy on a segment of the base, shorter than 32.
    fn on<const S: usize>(from: Point2, to: Point2, orders: u8, generator: &Generator<S>) -> Self {
        let along = |a: Real, b: Real| i64::from(b.to_bits()) - i64::from(a.to_bits());
        let (dx, dy) = (along(from.x, to.x), along(from.y, to.y));
        let start = [from.x, from.y].map(|c| (i64::from(c.to_bits()) << 32) + (1 << 31));
        let length = hypotenuse(dx, dy).min(LONGEST << 24) as u32;
        let (next, end) = generator.range(0);
        Self {
            start,
            vector: [(dx << 2) as i32, (dy << 2) as i32],
            length: length.saturating_mul(4),
            next,
            end,
            state: 0,
            orders,
        }
    }

    /// The copy on its next segment. `start` moves on to the one after: `v_{i+1} = v_i + w_i`, so that
    /// nothing is rounded.
    #[inline(always)]
    fn descend<const S: usize>(&mut self, segment: &Segment, length: UQ26, generator: &Generator<S>) -> Self {
        let [x, y] = segment.vector;
        let y = if self.state & 2 == 0 { y } else { y.wrapping_neg() };
        let [p, q] = self.start;
        let [u, v] = complex_product_added([0; 2], self.vector, [x, y]);
        self.start = [p.wrapping_add(u), q.wrapping_add(v)];
        // |w| < 1, so that the vector becomes shorter
        let rounded = |bits: i64| (bits.wrapping_add(1 << 29) >> 30) as i32;
        let state = self.state ^ segment.orientation;
        let (next, end) = generator.range(state);
        let orders = self.orders.wrapping_sub(1);
        Self { start: [p, q], vector: [rounded(u), rounded(v)], length, next, end, state, orders }
    }
}

#[inline(always)]
fn point([x, y]: [Q56; 2]) -> Point2 {
    Point2::new(Real::from_bits((x >> 32) as i32), Real::from_bits((y >> 32) as i32))
}

/// What the pen does next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pen {
    Up,
    Down,
    Done,
}

/// The path of a refined polyline. Size on a 32-bit machine: 32 bytes for each of `DEPTH` orders, and 72.
///
/// ```
/// use attractor::curve::koch;
/// use attractor::draw::Stroke;
/// use attractor::plane::{Bounds2, Point2, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// // the second order of the Koch curve, on a stack for four
/// let curve = koch::GENERATOR.refined::<4>(&koch::SEGMENT, 2)?;
/// assert_eq!(curve.clone().count(), 17);
/// const BOUNDS: Bounds2 = Bounds2 { min: Point2::lit("0", "0"), max: Point2::lit("1", "0.29") };
/// let window = Window::stretch(BOUNDS, Size::new(37, 11))?;
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// Stroke::new(curve, window, BinaryColor::On).draw(&mut display).unwrap();
/// display.assert_pattern(&[
///     "                  #                  ",
///     "                 # #                 ",
///     "                 # #                 ",
///     "            #####   #####            ",
///     "             #          #            ",
///     "             #         #             ",
///     "              #        #             ",
///     "      #       #       #       #      ",
///     "     # #     #         #     # #     ",
///     "     # #     #         #     # #     ",
///     "#####   #####           #####   #####",
/// ]);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Refined<'a, const S: usize, const DEPTH: usize> {
    generator: &'a Generator<S>,
    /// The copy whose segments are drawn as they are, and those that are left of them.
    drawn: Drawn,
    run: core::slice::Iter<'a, Segment>,
    /// What is left of the base, from the point where the current segment ends.
    base: &'a [Point2],
    /// Copies on the way down to it, some of whose segments are refined further; the first `waiting` are in
    /// use.
    stack: [Replica; DEPTH],
    waiting: usize,
    order: u8,
    /// Copies shorter than this are not refined.
    shortest: UQ26,
    /// The length of the longest segment of the generator.
    longest_ratio: UQ30,
    pen: Pen,
}

impl<const S: usize> Generator<S> {
    /// Each segment of `base` refined `order` times.
    ///
    /// Result: `base.len() - 1` curves of `len^order` segments each, joined; a closed base ends with its
    /// first point. Error: below `2^-22` for the curves of the catalogue on a base of length 1 up to order 12
    /// (`curves.rs`: `every_vertex_is_within_its_bound`). Cost of a vertex, in a loop that adds the
    /// coordinates up: 59.2 Cortex-M4 instructions (kernel `koch`) for the Koch curve of order 6, 44.7
    /// (kernel `gosper`) for Gosper's flowsnake, 133 (kernel `dragon`) for the dragon, whose generator has
    /// only two segments.
    ///
    /// # Errors
    /// [`Error::TooFew`] for a base of fewer than two points, [`Error::Degenerate`] when two neighbours
    /// coincide, [`Error::Capacity`] when `order` exceeds `DEPTH` or 255, [`Error::OutOfRange`] for a segment
    /// of length 32 and above, or a curve that could leave the range of [`Real`].
    pub fn refined<'a, const DEPTH: usize>(
        &'a self,
        base: &'a [Point2],
        order: u32,
    ) -> Result<Refined<'a, S, DEPTH>, Error> {
        let capacity = DEPTH.min(255);
        match usize::try_from(order) {
            Ok(levels) if levels <= capacity => Refined::new(self, base, levels, 0),
            other => Err(Error::Capacity { what: "orders", needed: other.unwrap_or(usize::MAX), capacity }),
        }
    }

    /// Each segment of `base` refined until the pieces are shorter than `length`, such as a pixel: each piece
    /// as often as it needs.
    ///
    /// # Errors
    /// As [`Generator::refined`], about the base first; [`Error::Capacity`] when some piece could need more
    /// than `DEPTH` refinements; [`Error::OutOfRange`] for a length of 0 or less.
    pub fn refined_to<'a, const DEPTH: usize>(
        &'a self,
        base: &'a [Point2],
        length: Real,
    ) -> Result<Refined<'a, S, DEPTH>, Error> {
        if length <= Real::ZERO {
            return Err(Error::OutOfRange {
                what: "length of a piece",
                index: None,
                value: Wide::from(length),
                min: Wide::from(Real::DELTA),
                max: Wide::from(Real::MAX),
            });
        }
        // LONGEST ends the refinement anyhow: 32 with 26 fractional bits is 2^31
        let shortest = (u64::from(length.to_bits().unsigned_abs()) << 2).min(LONGEST << 26) as u32;
        // how often the longest piece needs it: 26 fractional bits
        let factor = u64::from(self.contraction_factor().to_bits().unsigned_abs());
        let mut longest = longest_segment(base)? << 2;
        let mut orders = 0;
        let capacity = DEPTH.min(255);
        // as the walk computes it; rounding down lets it end for every factor below 1
        while longest >= u64::from(shortest) {
            longest = (longest * factor) >> 30;
            orders += 1;
            if orders > 100_000 {
                break;
            }
        }
        if orders > capacity {
            return Err(Error::Capacity { what: "orders", needed: orders, capacity });
        }
        Refined::new(self, base, orders, shortest)
    }
}

impl<'a, const S: usize, const DEPTH: usize> Refined<'a, S, DEPTH> {
    fn new(
        generator: &'a Generator<S>,
        base: &'a [Point2],
        order: usize,
        shortest: UQ26,
    ) -> Result<Self, Error> {
        longest_segment(base)?;
        let reach = generator.reach(order as u32);
        for (index, (a, b)) in base.iter().zip(base.iter().skip(1)).enumerate() {
            // length < 2^29, reach saturates
            let around = ((u128::from(length(*a, *b)) * u128::from(reach)) >> 30) as u64;
            let far = u64::from(a.x.to_bits().unsigned_abs().max(a.y.to_bits().unsigned_abs()));
            let needed = far.saturating_add(around).saturating_add(1 << 12);
            if needed >= 128 << 24 {
                return Err(out_of_range("reach of the curve from the segment", index, needed, 128));
            }
        }
        Ok(Self {
            generator,
            base,
            drawn: Drawn::default(),
            run: [].iter(),
            stack: [Replica::default(); DEPTH],
            waiting: 0,
            order: order as u8,
            shortest,
            longest_ratio: generator.contraction_factor().to_bits().unsigned_abs(),
            pen: Pen::Up,
        })
    }

    fn step(&mut self, p: [Q56; 2]) -> PathElement {
        if self.pen == Pen::Down {
            PathElement::LineTo(point(p))
        } else {
            self.pen = Pen::Down;
            PathElement::MoveTo(point(p))
        }
    }

    /// The next step when the run is over. Apart, so that the loop over a run keeps its registers.
    #[inline(never)]
    fn next_run(&mut self) -> Option<PathElement> {
        let adaptive = self.shortest > 0;
        loop {
            let child;
            if let Some(top) = self.waiting.checked_sub(1) {
                let copy = self.stack.get_mut(top)?;
                let segment = self.generator.segments().get(usize::from(copy.next))?;
                copy.next += 1;
                // after its last segment nothing waits for it
                if copy.next >= copy.end {
                    self.waiting = top;
                }
                let mut length = 0;
                if adaptive {
                    length = product_uq26(copy.length, segment.ratio);
                    if length < self.shortest {
                        let place = copy.drawn().place(segment.show_from_start());
                        copy.descend(segment, 0, self.generator);
                        return Some(self.step(place));
                    }
                }
                child = copy.descend(segment, length, self.generator);
            } else {
                child = match self.base {
                    [from, rest @ ..] if !rest.is_empty() => {
                        self.base = rest;
                        let to = rest.first().copied().unwrap_or(*from);
                        Replica::on(*from, to, self.order, self.generator)
                    }
                    [last] if self.pen == Pen::Down && self.generator.marker().is_none() => {
                        self.pen = Pen::Done;
                        return Some(PathElement::LineTo(*last));
                    }
                    _ => return None,
                };
                if self.order == 0 || child.length < self.shortest {
                    let show = oriented(self.generator.marker().unwrap_or([0, 0]), 0);
                    return Some(self.step(child.drawn().place(show)));
                }
            }
            if child.orders <= 1
                || (adaptive && product_uq26(child.length, self.longest_ratio) < self.shortest)
            {
                let segments = self.generator.walk(child.state);
                let (first, rest) = segments.split_first()?;
                self.run = rest.iter();
                self.drawn = child.drawn();
                // a walk begins where the copy does, unless it shows markers
                let from_start = first.show == [0; 2];
                let place = if from_start { child.start } else { self.drawn.place(first.show) };
                return Some(self.step(place));
            }
            // those that wait have different levels below `order`, at most DEPTH
            *self.stack.get_mut(self.waiting)? = child;
            self.waiting += 1;
        }
    }
}

/// The distance of two points, rounded up, or more than the longest segment.
fn length(a: Point2, b: Point2) -> u64 {
    // within what the root takes
    let along = |a: Real, b: Real| i64::from(b.to_bits().abs_diff(a.to_bits()).min(1 << 31));
    hypotenuse(along(a.x, b.x), along(a.y, b.y))
}

/// The length of the base's longest segment, 24 fractional bits: below 32.
fn longest_segment(base: &[Point2]) -> Result<u64, Error> {
    if base.len() < 2 {
        return Err(Error::TooFew { what: "points of the base", given: base.len(), at_least: 2 });
    }
    let mut longest = 0;
    for (index, (a, b)) in base.iter().zip(base.iter().skip(1)).enumerate() {
        let length = length(*a, *b);
        if length == 0 {
            return Err(Error::Degenerate { what: "a segment of the base" });
        }
        if length >= LONGEST << 24 {
            return Err(out_of_range("length of the segment", index, length, LONGEST));
        }
        longest = longest.max(length);
    }
    Ok(longest)
}

#[inline(always)]
fn product_uq26(length: UQ26, ratio: UQ30) -> UQ26 {
    (product_u(length, ratio) >> 30) as u32
}

impl<const S: usize, const DEPTH: usize> Iterator for Refined<'_, S, DEPTH> {
    type Item = PathElement;

    #[inline]
    fn next(&mut self) -> Option<PathElement> {
        match self.run.next() {
            // the first segment of a run is drawn when it is entered
            Some(segment) => Some(PathElement::LineTo(point(self.drawn.place(segment.show)))),
            None => self.next_run(),
        }
    }
}

fn out_of_range(what: &'static str, index: usize, bits: u64, limit: u64) -> Error {
    let wide = |bits: u64| Wide::from_bits(i64::try_from(bits.saturating_mul(1 << 24)).unwrap_or(i64::MAX));
    Error::OutOfRange { what, index: Some(index), value: wide(bits), min: Wide::ZERO, max: wide(limit << 24) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::koch;

    #[test]
    fn order_0_is_the_base_and_order_1_the_generator() {
        let refined = |order| -> std::vec::Vec<PathElement> {
            koch::GENERATOR.refined::<4>(&koch::SEGMENT, order).unwrap().collect()
        };
        let [a, b] = koch::SEGMENT;
        assert_eq!(refined(0), [PathElement::MoveTo(a), PathElement::LineTo(b)]);
        let third =
            |x: i32, y: f64| Point2::new(Real::from_num(f64::from(x) / 6.0 + 1e-9), Real::from_num(y));
        let top = Point2::new(Real::from_num(0.5), Real::from_num(3.0_f64.sqrt() / 6.0 + 3e-8));
        let expected = [a, third(2, 0.0), top, third(4, 0.0), b];
        let points: std::vec::Vec<Point2> = refined(1)
            .into_iter()
            .map(|s| match s {
                PathElement::MoveTo(p) | PathElement::LineTo(p) => p,
            })
            .collect();
        for (got, want) in points.iter().zip(expected) {
            assert!(got.x.abs_diff(want.x) <= 1e-7 && got.y.abs_diff(want.y) <= 1e-7, "{got:?} {want:?}");
        }
        assert_eq!(points.len(), 5);
    }

    #[test]
    fn a_finished_curve_stays_finished() {
        let mut curve = koch::GENERATOR.refined::<3>(&koch::SEGMENT, 3).unwrap();
        assert_eq!(curve.by_ref().count(), 65);
        assert!((0..10).all(|_| curve.next().is_none()));
    }

    #[test]
    fn order_12_of_the_koch_curve_takes_at_most_600_bytes() {
        assert!(size_of::<Refined<'_, 4, 12>>() <= 600, "{}", size_of::<Refined<'_, 4, 12>>());
    }
}
