//! The inside of a set filled in, not computed: what a closed curve of inner pixels surrounds is inside.
//!
//! A pixel of the inside costs all of its `Num` iterations, one of the outside only a few. So of the inside
//! only the edge is computed; deep views in wide words gain most.
//!
//! The complement of the set is connected (A. Douady, J. H. Hubbard, 1982): nothing outer lies in a hole.
//! Where a row meets an inner pixel that is not known yet, the edge of its component is followed with a hand
//! on the wall (boundary tracing: I. Pitas, "Digital Image Processing Algorithms", 1993, section 7.2), and
//! every run of pixels between two edges becomes inner. The pixels of the outside are computed as ever. A
//! curve is made of pixels: an outer filament that slips in between two of them is lost.
//!
//! ### Why the order of the pixels changes nothing
//! A pixel is settled when all to its left in its row are known. Whatever surrounds it has an edge among
//! those, was met there, and filled the pixel with the rest. So the first inner pixel behind a settled one
//! lies in no hole and has the outer edge of its component to its left; the walls along that edge lie in no
//! hole either. Hence every component is traced once, from outside, and a run from wall to wall crosses its
//! holes, of which nothing is known yet.

use core::cell::Cell;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::value::Dwell;
use crate::plane::{Field, checked_size};

/// Any picture of dwells whose inside is filled in as its rows are drawn, with two lent bits a pixel.
///
/// Rows, parts of rows and pixels may be asked for in any order and show the same picture
/// (`any_order_shows_the_same_picture`). What is asked for settles the pixels to its left in its row, which
/// are computed once if they lie outside. It pays where an inner pixel costs `Num` iterations, as in
/// [`DeepMandelbrot`](crate::escape::DeepMandelbrot). Cost of a pixel of 64 x 64 at 1000 iterations, plain
/// and filled: a copy of the set in 64 bits 13947 Cortex-M4 instructions (kernel `plain copy 64`) and 5955
/// (kernel `filled copy 64`); one at 1e-101 by perturbation 28537 (kernel `plain copy 1e-101`) and 9247
/// (kernel `filled copy 1e-101`). It does not pay where cycles end the loop and the two largest parts are
/// known: the whole set takes 241 (kernel `plain home`) and 372 (kernel `filled home`), a filled Julia set
/// 233 (kernel `plain rabbit`) and 333 (kernel `filled rabbit`), a view between seahorses 2730 (kernel
/// `plain seahorses`) and 2895 (kernel `filled seahorses`).
///
/// Error: what inner pixels surround, and only that, is taken for inside (`any_order_shows_the_same_picture`,
/// `a_pixel_right_of_a_hole_fills_no_outside`). Of the 57,600 pixels of a picture at 1000 iterations none
/// differ from the plain picture for the whole set and for three Julia sets, 15 at the valley of seahorses
/// 0.05 wide, 6 between them 0.0065 wide, 4 for a copy of period 3 (`filling_changes_few_pixels` prints
/// them).
///
/// ```
/// use attractor::escape::{Filled, Mandelbrot, View};
/// use attractor::plane::Field;
/// use embedded_graphics_core::geometry::Size;
/// let picture = Mandelbrot::new(View::home(Size::new(24, 20))?, 1000)?;
/// let mut bits = [0; Filled::<Mandelbrot>::bytes(Size::new(24, 20))];
/// let filled = Filled::new(picture, &mut bits)?;
/// assert!(filled.at(10, 10).is_inside());
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Filled<'a, P> {
    picture: P,
    states: &'a [Cell<u8>],
    /// What an inner pixel holds, once one is known.
    inner: Cell<Dwell>,
}

/// Two bits: what is known of a pixel. Inside: inner, or surrounded by inner pixels; outside: neither.
const UNKNOWN: u8 = 0;
const INSIDE: u8 = 1;
const OUTSIDE: u8 = 2;

impl<P> Filled<'_, P> {
    /// How many bytes a picture takes: the length of the memory to lend.
    pub const fn bytes(size: Size) -> usize {
        (size.width as usize).saturating_mul(size.height as usize).div_ceil(4)
    }
}

/// Where one stands, and looks: 0 up, 1 right, 2 down, 3 left.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Walker {
    x: u32,
    y: u32,
    ahead: u8,
}

impl Walker {
    /// The pixel next to this one; beyond the picture where the coordinates wrap or are too large.
    const fn next(self, direction: u8) -> (u32, u32) {
        match direction & 3 {
            0 => (self.x, self.y.wrapping_sub(1)),
            1 => (self.x.wrapping_add(1), self.y),
            2 => (self.x, self.y.wrapping_add(1)),
            _ => (self.x.wrapping_sub(1), self.y),
        }
    }
}

impl<'a, P: Field<Value = Dwell>> Filled<'a, P> {
    /// Nothing is known yet.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `bits` is shorter than [`Filled::bytes`], [`Error::OutOfRange`] for a size
    /// that [`checked_size`] refuses.
    pub fn new(picture: P, bits: &'a mut [u8]) -> Result<Self, Error> {
        let needed = Self::bytes(checked_size(picture.size())?);
        let (what, given) = ("bytes of known pixels", bits.len());
        let bits = bits.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        bits.fill(0);
        let inner = Cell::new(Dwell { count: 0, max: 0 });
        Ok(Self { picture, states: Cell::from_mut(bits).as_slice_of_cells(), inner })
    }

    /// The picture that is filled.
    pub const fn picture(&self) -> &P {
        &self.picture
    }

    /// Settles what is left of a pixel, from the last pixel on that is known.
    fn settle(&self, x: u32, y: u32) {
        let known = |x: &u32| self.state(*x, y) != UNKNOWN;
        let first = (0..x).rev().find(known).map_or(0, |x| x + 1);
        for x in first..x {
            // what is surrounded was filled with the inner pixel before it
            if self.state(x, y) == UNKNOWN {
                self.found(x, y, self.picture.at(x, y));
            }
        }
    }

    /// Remembers a pixel behind settled ones; with the first one of a component all of it is known.
    fn found(&self, x: u32, y: u32, dwell: Dwell) -> Dwell {
        self.remember(x, y, dwell);
        if dwell.is_inside() {
            self.fill(x, y);
        }
        dwell
    }

    fn remember(&self, x: u32, y: u32, dwell: Dwell) {
        if dwell.is_inside() {
            self.inner.set(dwell);
        }
        self.set(x, y, if dwell.is_inside() { INSIDE } else { OUTSIDE });
    }

    /// Whether a pixel is inside; beyond the picture nothing is.
    fn is_inside(&self, (x, y): (u32, u32)) -> bool {
        let Size { width, height } = self.picture.size();
        if x >= width || y >= height {
            return false;
        }
        match self.state(x, y) {
            UNKNOWN => {
                let dwell = self.picture.at(x, y);
                self.remember(x, y, dwell);
                dwell.is_inside()
            }
            state => state == INSIDE,
        }
    }

    /// Fills the component of an inner pixel with its outer edge to the left.
    fn fill(&self, x: u32, y: u32) {
        // the hand on the wall to the left
        let start = Walker { x, y, ahead: 0 };
        // at most 2^28 pixels, seen from four sides: the walk ends, also where a picture changes its mind
        let Size { width, height } = self.picture.size();
        let places = width.saturating_mul(height).saturating_mul(4);
        // once round to see the wall, and once more to fill from it
        for fills in [false, true] {
            let mut walker = start;
            for _ in 0..places {
                if fills && walker.ahead == 0 {
                    self.fill_run(walker);
                }
                let left = walker.ahead.wrapping_add(3) & 3;
                if self.is_inside(walker.next(left)) {
                    (walker.x, walker.y) = walker.next(left);
                    walker.ahead = left;
                } else if self.is_inside(walker.next(walker.ahead)) {
                    (walker.x, walker.y) = walker.next(walker.ahead);
                } else {
                    walker.ahead = (walker.ahead + 1) & 3;
                }
                if walker == start {
                    break;
                }
            }
        }
    }

    /// From a place with the wall to its left as far as the wall to its right.
    fn fill_run(&self, walker: Walker) {
        for x in walker.x..self.picture.size().width {
            match self.state(x, walker.y) {
                OUTSIDE => break,
                INSIDE => {}
                _ => self.set(x, walker.y, INSIDE),
            }
        }
    }

    fn state(&self, x: u32, y: u32) -> u8 {
        let index = y as usize * self.picture.size().width as usize + x as usize;
        self.states.get(index >> 2).map_or(UNKNOWN, |byte| byte.get() >> (2 * (index & 3)) & 3)
    }

    fn set(&self, x: u32, y: u32, state: u8) {
        let index = y as usize * self.picture.size().width as usize + x as usize;
        if let Some(byte) = self.states.get(index >> 2) {
            let shift = 2 * (index & 3);
            byte.set(byte.get() & !(3 << shift) | state << shift);
        }
    }
}

impl<P: Field<Value = Dwell>> Field for Filled<'_, P> {
    type Value = Dwell;

    fn size(&self) -> Size {
        self.picture.size()
    }

    fn at(&self, x: u32, y: u32) -> Dwell {
        // beyond the picture is the nearest pixel
        let Size { width, height } = self.picture.size();
        let (x, y) = (x.min(width.saturating_sub(1)), y.min(height.saturating_sub(1)));
        self.settle(x, y);
        if self.state(x, y) == INSIDE { self.inner.get() } else { self.found(x, y, self.picture.at(x, y)) }
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Dwell> {
        // what lies outside the picture has no pixels
        let Size { width, height } = self.picture.size();
        let y = y.min(height.saturating_sub(1));
        let columns = x.start.min(width)..x.end.min(width);
        let row = self.picture.row(y, columns.clone());
        FilledRow { filled: self, row, behind: 0, y, columns, settled: false }
    }
}

/// The dwells of a row, from left to right.
struct FilledRow<'a, P, R> {
    filled: &'a Filled<'a, P>,
    row: R,
    /// How many pixels the plain row is behind.
    behind: usize,
    y: u32,
    columns: Range<u32>,
    /// Whether the pixel before the next one is known.
    settled: bool,
}

impl<P: Field<Value = Dwell>, R: Iterator<Item = Dwell>> Iterator for FilledRow<'_, P, R> {
    type Item = Dwell;

    #[inline]
    fn next(&mut self) -> Option<Dwell> {
        let x = self.columns.next()?;
        if !core::mem::replace(&mut self.settled, true) {
            self.filled.settle(x, self.y);
        }
        if self.filled.state(x, self.y) == INSIDE {
            self.behind += 1;
            return Some(self.filled.inner.get());
        }
        let dwell = self.row.nth(core::mem::take(&mut self.behind))?;
        Some(self.filled.found(x, self.y, dwell))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Dwell> {
        let skipped = n.min(self.columns.len());
        self.behind += skipped;
        self.columns.start += skipped as u32;
        self.settled &= skipped == 0;
        self.next()
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.columns.size_hint()
    }
}

impl<P: Field<Value = Dwell>, R: Iterator<Item = Dwell>> ExactSizeIterator for FilledRow<'_, P, R> {}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::{Julia, Mandelbrot, View};
    use crate::num::Complex;
    use crate::num::Wide;
    use crate::plane::from_fn;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};
    use std::vec;

    /// Counts how often a pixel inside and outside is computed.
    struct Counted<P> {
        picture: P,
        inside: Cell<u32>,
        outside: Cell<u32>,
    }

    impl<P: Field<Value = Dwell>> Field for Counted<P> {
        type Value = Dwell;

        fn size(&self) -> Size {
            self.picture.size()
        }

        fn at(&self, x: u32, y: u32) -> Dwell {
            let dwell = self.picture.at(x, y);
            let counter = if dwell.is_inside() { &self.inside } else { &self.outside };
            counter.set(counter.get() + 1);
            dwell
        }
    }

    /// Pixels that differ from the plain picture; computed inside and outside; pixels inside and outside.
    fn compare<P: Field<Value = Dwell> + Copy>(picture: P) -> (u32, [u32; 2], [u32; 2]) {
        let size = picture.size();
        let counted = Counted { picture, inside: Cell::new(0), outside: Cell::new(0) };
        let mut bits = vec![0; Filled::<P>::bytes(size)];
        let filled = Filled::new(counted, &mut bits).unwrap();
        let (mut differ, mut inside) = (0, 0);
        for y in 0..size.height {
            for (a, b) in filled.row(y, 0..size.width).zip(picture.row(y, 0..size.width)) {
                differ += u32::from(a != b);
                inside += u32::from(b.is_inside());
            }
        }
        let computed = [filled.picture.inside.get(), filled.picture.outside.get()];
        (differ, computed, [inside, size.width * size.height - inside])
    }

    #[test]
    fn filling_changes_few_pixels() {
        let point = |re: f64, im: f64| Complex::new(Wide::from_num(re), Wide::from_num(im));
        let size = Size::new(240, 240);
        let view = |re, im, width| View::new(point(re, im), Wide::from_num(width), size).unwrap();
        let set = |view| compare(Mandelbrot::new(view, 1000).unwrap());
        let julia = |re, im| compare(Julia::new(view(0.0, 0.0, 3.0), point(re, im), 1000).unwrap());
        for (name, (differ, computed, pixels), share) in [
            ("home", set(View::home(size).unwrap()), 5),
            ("valley", set(view(-0.75, 0.1, 0.05)), 3),
            ("seahorses", set(view(-0.7453, 0.1127, 0.0065)), 1),
            ("a copy", set(view(-1.7549, 0.0, 0.04)), 5),
            ("rabbit", julia(-0.123, 0.745), 4),
            ("basilica", julia(-1.0, 0.0), 5),
            ("near a cauliflower", julia(0.25, 0.0), 8),
        ] {
            let [[in_computed, out_computed], [inside, outside]] = [computed, pixels];
            std::println!(
                "{name}: {differ} of 57600 differ; computed {in_computed} of {inside} inside, {out_computed} for {outside} outside"
            );
            assert!(differ * 2000 <= 57_600, "{name}: {differ}");
            assert!(inside > 1000 && in_computed * share <= inside, "{name}: {in_computed} of {inside}");
            // what was beside an edge is computed twice
            assert!(4 * out_computed < 5 * outside, "{name}: {out_computed} for {outside}");
        }
    }

    #[test]
    fn a_pixel_right_of_a_hole_fills_no_outside() {
        let point = Complex::new(Wide::from_num(-0.7453), Wide::from_num(0.1127));
        let view = View::new(point, Wide::from_num(0.0065), Size::new(120, 120)).unwrap();
        let picture = Mandelbrot::new(view, 200).unwrap();
        let mut bits = vec![0; Filled::<Mandelbrot>::bytes(picture.size())];
        let filled = Filled::new(picture, &mut bits).unwrap();
        filled.at(39, 28);
        let differ = |y| filled.row(y, 0..120).zip(picture.row(y, 0..120)).filter(|(a, b)| a != b).count();
        // what islands of the set surround
        assert_eq!((0..120).map(differ).sum::<usize>(), 42);
    }

    /// Rings of inner pixels in each other's holes, one of them open, and crumbs between them.
    struct Rings;

    impl Field for Rings {
        type Value = Dwell;

        fn size(&self) -> Size {
            Size::new(41, 37)
        }

        fn at(&self, x: u32, y: u32) -> Dwell {
            let (right, down) = (x.abs_diff(20), y.abs_diff(18));
            let ring = right.max(down);
            let inner = ring % 4 == 2 && !(ring == 14 && y == 18 && x < 20) || (x + 40 * y) % 97 == 5;
            Dwell { count: if inner { 9 } else { ring % 9 }, max: 9 }
        }
    }

    /// The picture with what inner pixels surround, by a flood of the outside from beyond the edges, through
    /// corners too.
    fn flooded<P: Field<Value = Dwell>>(picture: &P) -> vec::Vec<vec::Vec<Dwell>> {
        let Size { width, height } = picture.size();
        let mut want: vec::Vec<vec::Vec<_>> =
            (0..height).map(|y| picture.row(y, 0..width).collect()).collect();
        let inner = want.iter().flatten().copied().find(|dwell| dwell.is_inside());
        let mut outside = vec![vec![false; width as usize + 2]; height as usize + 2];
        let mut reached = vec![(0, 0)];
        while let Some((x, y)) = reached.pop() {
            for (x, y) in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
                let beyond = |v: i32, side| v == -1 || v == side as i32;
                if !(-1..=width as i32).contains(&x) || !(-1..=height as i32).contains(&y) {
                    continue;
                }
                let place = &mut outside[(y + 1) as usize][(x + 1) as usize];
                let open = beyond(x, width) || beyond(y, height) || !want[y as usize][x as usize].is_inside();
                if open && !core::mem::replace(place, true) {
                    reached.push((x, y));
                }
            }
        }
        for (y, row) in want.iter_mut().enumerate() {
            for (x, dwell) in row.iter_mut().enumerate() {
                if !outside[y + 1][x + 1] {
                    *dwell = inner.unwrap();
                }
            }
        }
        want
    }

    /// Asks for rows, parts of rows and pixels in random orders. How many pixels of the right picture differ
    /// from the plain one.
    fn in_random_order<P: Field<Value = Dwell>>(picture: &P, seeds: Range<u64>) -> usize {
        let Size { width, height } = picture.size();
        let want = flooded(picture);
        for seed in seeds {
            let mut rng = Xoshiro128PlusPlus::seed_from_u64(seed);
            let mut below = |n: u32| rng.next_u32() % n;
            let mut bits = vec![0; Filled::<P>::bytes(picture.size())];
            let filled = Filled::new(picture, &mut bits).unwrap();
            // at last the rows from the top: nothing was left wrong
            let last = (0..height).map(|y| (y, 1));
            let mut random = vec![];
            random.resize_with(2 * height as usize, || (below(height), below(4)));
            for (y, kind) in random.into_iter().chain(last) {
                let (a, b) = (below(width), below(width));
                let want = &want[y as usize];
                let part = a.min(b)..a.max(b) + 1;
                let wanted = &want[part.start as usize..part.end as usize];
                let told = std::format!("seed {seed}, {part:?} of {y}");
                match kind {
                    0 => assert_eq!(filled.at(a, y), want[a as usize], "{told}"),
                    1 => assert!(filled.row(y, 0..width).eq(want.iter().copied()), "{told}"),
                    2 => assert!(filled.row(y, part).eq(wanted.iter().copied()), "{told}"),
                    _ => {
                        let every_fifth = wanted.iter().copied().step_by(5);
                        assert!(filled.row(y, part).step_by(5).eq(every_fifth), "{told}");
                    }
                }
            }
        }
        let differ =
            |y: u32| picture.row(y, 0..width).zip(&want[y as usize]).filter(|(a, b)| a != *b).count();
        (0..height).map(differ).sum()
    }

    #[test]
    fn any_order_shows_the_same_picture() {
        let view = |re: f64, im: f64, width: f64| {
            let centre = Complex::new(Wide::from_num(re), Wide::from_num(im));
            View::new(centre, Wide::from_num(width), Size::new(97, 83)).unwrap()
        };
        for (re, im, width) in [
            (-0.75, 0.0, 2.5),
            (-0.7453, 0.1127, 0.0065),
            (-0.7463, 0.1102, 0.005),
            (-0.75, 0.1, 0.05),
            (-1.7549, 0.0, 0.04),
            (-0.1592, 1.0338, 0.02),
        ] {
            let picture = Mandelbrot::new(view(re, im, width), 200).unwrap();
            let differ = in_random_order(&picture, 0..12);
            std::println!("{re} {im} {width}: {differ} surrounded");
            assert!(differ <= 50, "{re} {im} {width}: {differ}");
        }
        let c = Complex::new(Wide::from_num(-0.123), Wide::from_num(0.745));
        let rabbit = Julia::new(view(0.0, 0.0, 3.0), c, 200).unwrap();
        assert_eq!(in_random_order(&rabbit, 0..12), 0);
        // what is surrounded is inside, whoever asks first
        let lost = in_random_order(&Rings, 0..300);
        assert!(lost > 400, "{lost}");
    }

    #[test]
    fn any_size_and_only_the_right_buffer_will_do() {
        for (w, h) in [(1, 1), (1, 500), (16384, 7), (7, 4096), (97, 61)] {
            let picture = Mandelbrot::new(View::home(Size::new(w, h)).unwrap(), 20).unwrap();
            let mut bits = vec![0; Filled::<Mandelbrot>::bytes(picture.size())];
            let filled = Filled::new(picture, &mut bits).unwrap();
            let inside = (0..h).flat_map(|y| filled.row(y, 0..w)).filter(|dwell| dwell.is_inside());
            let plain = (0..h).flat_map(|y| picture.row(y, 0..w)).filter(|dwell| dwell.is_inside());
            assert_eq!(inside.count(), plain.count());
            // a longer buffer will do
            bits.push(0);
            assert!(Filled::new(picture, &mut bits).is_ok());
            bits.truncate(bits.len() - 2);
            let error = Filled::new(picture, &mut bits).err();
            let (what, given) = ("bytes of known pixels", bits.len());
            assert_eq!(error, Some(Error::BufferLength { what, given, needed: given + 1 }));
        }
    }

    #[test]
    fn beyond_the_picture_is_the_nearest_pixel_at_no_cost() {
        let view = View::home(Size::new(9, 7)).unwrap();
        let picture = Mandelbrot::new(view, 50).unwrap();
        let looked = Cell::new(0);
        let field = from_fn(view.size(), |x, y| {
            looked.set(looked.get() + 1);
            picture.dwell_at(view.point(x, y))
        });
        let mut bits = [0; Filled::<Mandelbrot>::bytes(Size::new(9, 7))];
        let filled = Filled::new(field, &mut bits).unwrap();
        assert_eq!(filled.at(u32::MAX, 3), filled.at(8, 3));
        assert_eq!(filled.at(4, u32::MAX), filled.at(4, 6));
        assert_eq!(filled.row(2, 5..u32::MAX).count(), 4);
        assert!(looked.get() < 3 * 63, "{} pixels", looked.get());
    }

    /// A walk along the edge of what is different each time has no way back, and ends.
    #[test]
    fn a_picture_that_changes_its_mind_is_filled_in_a_bounded_time() {
        for seed in 0..3000_u64 {
            let rng = core::cell::RefCell::new(Xoshiro128PlusPlus::seed_from_u64(seed));
            let field = from_fn(Size::new(6, 6), |_, _| Dwell {
                count: 8 - (rng.borrow_mut().next_u32() & 1),
                max: 8,
            });
            let mut bits = [0; 9];
            let filled = Filled::new(field, &mut bits).unwrap();
            for k in 0..100 {
                filled.at(k * 5 % 6, k * 7 / 6 % 6);
            }
        }
    }

    #[test]
    fn sizes_that_no_picture_has_are_refused() {
        for (width, height) in [(0, 1), (1, 0), (1 << 16, 1 << 16), (u32::MAX, u32::MAX)] {
            let field = from_fn(Size::new(width, height), |_, _| Dwell { count: 1, max: 1 });
            assert!(matches!(Filled::new(field, &mut []), Err(Error::OutOfRange { .. })));
        }
    }
}
