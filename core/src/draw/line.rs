//! A straight line of pixels, clipped to a box without moving a pixel: what is seen of a path does not depend
//! on where the window ends.
//!
//! The line is Bresenham's (J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM
//! Systems Journal 4, 1965). Its pixels are a set that does not depend on the direction: each is the nearest
//! to the line across its longer side, and of two equally near ones the lower or the right one, to which the
//! edge between them belongs in a window too.
//!
//! Along the longer direction, `n` steps, pixel `k` lies `m(k) = floor((2 k d + h) / (2 n))` pixels aside,
//! `d` steps in all; `h` is `n` where the line goes down or right aside, else `n - 1`. A box allows a range
//! of `k` for each direction; `m` grows with `k`, so both are intervals:
//!
//! - `m(k) >= a` where `k >= ceil((2 a n - h) / (2 d))`,
//! - `m(k) <= b` where `k < ceil((2 (b + 1) n - h) / (2 d))`.
//!
//! The walk starts at the first `k` of the intersection with the remainder that Bresenham's loop would hold
//! there. Coordinates may have 48 bits; the products need 128, once for a line that the box cuts, never for
//! one inside or beside it.

use embedded_graphics_core::geometry::Point;

use crate::draw::clip::Spans;

/// The pixels of a line inside a box, in order.
#[derive(Debug, Clone)]
pub(super) struct Line {
    at: Point,
    /// Along the longer direction, and aside when the remainder overflows.
    along: Point,
    aside: Point,
    left: u32,
    /// `(2 k d + h) mod 2 n`.
    remainder: i64,
    twice_d: i64,
    twice_n: i64,
}

impl Line {
    /// No pixel.
    pub(super) const EMPTY: Self = Self {
        at: Point::zero(),
        along: Point::zero(),
        aside: Point::zero(),
        left: 0,
        remainder: 0,
        twice_d: 0,
        twice_n: 0,
    };

    /// The pixels from `from` to `to`, without the first `skip` of them, as far as they lie inside `window`,
    /// whose coordinates fit 32 bits.
    pub(super) fn new(from: (i64, i64), to: (i64, i64), skip: i64, window: &Spans) -> Self {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let steep = dy.abs() > dx.abs();
        // in the coordinates (along, aside), mirrored so that both grow
        let turn = |(x, y): (i64, i64)| if steep { (y, x) } else { (x, y) };
        let (n, d) = turn((dx, dy));
        let (start_along, start_aside) = turn(from);
        let (columns, rows) = window;
        let (box_along, box_aside) = if steep { (rows, columns) } else { (columns, rows) };
        // the box as distances from the start, both ends included
        let distances = |span: &core::ops::Range<i64>, start: i64, backwards: bool| {
            let (low, high) = (span.start - start, span.end - 1 - start);
            if backwards { (-high, -low) } else { (low, high) }
        };
        let (first, last) = distances(box_along, start_along, n < 0);
        let (low, high) = distances(box_aside, start_aside, d < 0);
        let (backwards, sideways) = (n < 0, d < 0);
        let (n, d) = (n.abs(), d.abs());
        let half = n - i64::from(sideways);

        let (mut first, mut last) = (first.max(skip), last.min(n));
        if low > d || high < 0 || first > last {
            return Self::EMPTY;
        }
        if low > 0 {
            first = first.max(crossing(low, n, d, half));
        }
        if high < d {
            last = last.min(crossing(high + 1, n, d, half) - 1);
        }
        if first > last {
            return Self::EMPTY;
        }
        let (m, remainder) = beside(first, n, d, half);
        let signed = |value: i64, negative: bool| if negative { -value } else { value };
        let (x, y) = turn((start_along + signed(first, backwards), start_aside + signed(m, sideways)));
        let (along, aside) = (signed(1, backwards) as i32, signed(1, sideways) as i32);
        Self {
            at: Point::new(x as i32, y as i32),
            along: if steep { Point::new(0, along) } else { Point::new(along, 0) },
            aside: if steep { Point::new(aside, 0) } else { Point::new(0, aside) },
            left: u32::try_from(last - first + 1).unwrap_or(u32::MAX),
            remainder,
            twice_d: 2 * d,
            twice_n: 2 * n,
        }
    }
}

/// The first `k` with `m(k) >= a`, for `1 <= a <= d <= n`: `ceil((2 a n - h) / (2 d))`.
fn crossing(a: i64, n: i64, d: i64, half: i64) -> i64 {
    let numerator = i128::from(2 * a) * i128::from(n) - i128::from(half) + i128::from(2 * d) - 1;
    numerator.checked_div(i128::from(2 * d)).map_or(0, |k| k as i64)
}

/// `m(k)` and its remainder.
fn beside(k: i64, n: i64, d: i64, half: i64) -> (i64, i64) {
    if k == 0 {
        return (0, half); // below 2 n, or the line is a single pixel
    }
    let numerator = i128::from(2 * k) * i128::from(d) + i128::from(half);
    match numerator.checked_div(i128::from(2 * n)) {
        Some(m) => (m as i64, (numerator - m * i128::from(2 * n)) as i64),
        None => (0, 0),
    }
}

impl Iterator for Line {
    type Item = Point;

    #[inline]
    fn next(&mut self) -> Option<Point> {
        self.left = self.left.checked_sub(1)?;
        let at = self.at;
        if self.left > 0 {
            let mut next = Point::new(at.x + self.along.x, at.y + self.along.y);
            self.remainder += self.twice_d;
            if self.remainder >= self.twice_n {
                self.remainder -= self.twice_n;
                next = Point::new(next.x + self.aside.x, next.y + self.aside.y);
            }
            self.at = next;
        }
        Some(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    extern crate std;
    use std::vec::Vec;

    const ALL: Spans = (i32::MIN as i64..1 << 31, i32::MIN as i64..1 << 31);

    fn inside(window: &Spans, p: &Point) -> bool {
        window.0.contains(&i64::from(p.x)) && window.1.contains(&i64::from(p.y))
    }

    /// A small generator: the tests of drawing need no better one.
    fn random(state: &mut u64) -> i64 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 33) as i64
    }

    #[test]
    fn a_line_has_no_gap_and_both_ends() {
        for (to, expected) in [((3, 1), 4), ((-5, 5), 6), ((0, -4), 5), ((0, 0), 1), ((2, 9), 10)] {
            let line: Vec<_> = Line::new((0, 0), to, 0, &ALL).collect();
            assert_eq!(line.len(), expected);
            assert_eq!(line.first(), Some(&Point::zero()));
            assert_eq!(line.last(), Some(&Point::new(to.0 as i32, to.1 as i32)));
            for pair in line.windows(2) {
                let [a, b] = pair else { continue };
                assert_eq!((b.x - a.x).abs().max((b.y - a.y).abs()), 1);
            }
        }
    }

    /// From the definition: along the longer side one pixel a step, aside the nearest to the exact rational,
    /// `floor(exact + 1/2)`.
    fn nearest(from: (i64, i64), to: (i64, i64)) -> Vec<Point> {
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let steps = dx.abs().max(dy.abs());
        let along = |start: i64, difference: i64, k: i64| {
            // start + difference k / steps + 1/2, over 2 steps
            let (numerator, whole) = (2 * (start * steps + difference * k) + steps, 2 * steps);
            if whole == 0 { start } else { numerator.div_euclid(whole) }
        };
        (0..=steps).map(|k| Point::new(along(from.0, dx, k) as i32, along(from.1, dy, k) as i32)).collect()
    }

    #[test]
    fn every_pixel_is_the_nearest_to_the_line() {
        let mut state = 7;
        let mut point = || (random(&mut state) % 201 - 100, random(&mut state) % 201 - 100);
        for _ in 0..2000 {
            let (from, to) = (point(), point());
            let line: Vec<_> = Line::new(from, to, 0, &ALL).collect();
            assert_eq!(line, nearest(from, to), "{from:?} {to:?}");
        }
    }

    #[test]
    fn a_line_and_its_reverse_are_the_same_pixels() {
        const SIDE: i64 = 12;
        let points = || (0..SIDE * SIDE).map(|i| (i % SIDE, i / SIDE));
        let mut ties = 0;
        for from in points() {
            for to in points() {
                let line: Vec<_> = Line::new(from, to, 0, &ALL).collect();
                assert_eq!(line, nearest(from, to), "{from:?} {to:?}");
                let mut back: Vec<_> = Line::new(to, from, 0, &ALL).collect();
                back.reverse();
                assert_eq!(line, back, "{from:?} {to:?}");
                let (n, d) = ((to.0 - from.0).abs(), (to.1 - from.1).abs());
                let (n, d) = (n.max(d), n.min(d));
                ties += u32::from((0..n).any(|k| (2 * k * d) % (2 * n) == n));
            }
        }
        // a third of the lines has two nearest pixels somewhere
        assert!(ties > 5_000, "{ties}");
    }

    #[test]
    fn clipping_moves_no_pixel() {
        let window: Spans = (0..20, 0..13);
        let (mut state, mut seen) = (1, 0);
        for _ in 0..20_000 {
            let mut point = || (random(&mut state) % 90 - 35, random(&mut state) % 90 - 35);
            let (from, to) = (point(), point());
            for skip in [0, 1] {
                let expected: Vec<_> =
                    Line::new(from, to, skip, &ALL).filter(|p| inside(&window, p)).collect();
                let clipped: Vec<_> = Line::new(from, to, skip, &window).collect();
                seen += clipped.len();
                assert_eq!(clipped, expected, "{from:?} {to:?}");
            }
        }
        assert!(seen > 100_000);
    }

    #[test]
    fn lines_of_2_to_the_47_pixels_are_clipped_exactly() {
        let window: Spans = (0..64, 0..64);
        let far = 1_i64 << 47;
        // through the diagonal of the window, from end to end of the raster
        let line: Vec<_> = Line::new((-far, -far), (far, far), 0, &window).collect();
        assert!(line.iter().eq((0..64).map(|i| Point::new(i, i)).collect::<Vec<_>>().iter()));
        // slope 1/2 through (0, 0) and (63, 31)
        let line: Vec<_> = Line::new((-far, -far / 2), (far, far / 2), 0, &window).collect();
        assert_eq!(line.len(), 64);
        assert_eq!(line.last(), Some(&Point::new(63, 32)));
        assert_eq!(Line::new((-far, 64), (far, 64), 0, &window).count(), 0);
        assert_eq!(Line::new((5, far), (5, -far), 0, &window).count(), 64);
    }
}
