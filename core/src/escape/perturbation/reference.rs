//! Dwell by perturbation, where 128 bits do not tell two pixels apart: one orbit in wide numbers, the
//! reference, and for each pixel its small distance from it, for which 30 bits are enough.
//!
//! With `Z' = Z^2 + C` the reference, `z = Z + d` and `c = C + g`: `d' = (2 Z + d) d + g`. Source: K. I.
//! Martin, "Superfractalthing maths", 2013. When `|z| <= |d|`, or at the end of the reference, the orbit is
//! rebased: `d <- z`, and the reference starts again at `Z = 0` (Zhuoran, "Another solution to perturbation
//! glitches", 2021). Nothing cancels then, and no pixel needs another reference. From its first point
//! [`Jumps`] lead on.
//!
//! Format: reference points and distances are blocks, two 30-bit mantissas with one exponent. A step rounds
//! the distance 3 times by `2^-30` of its size, and so does a jump, whatever its length: after `s` steps and
//! jumps a pixel is shown as if it were moved by less than `4 s 2^-30` of its distance from the centre
//! (`a_pixel_is_moved_by_less_than_the_bound`). Whether `|z| > 2` is decided on 30 bits: at `c = -2` alone,
//! where an orbit follows the circle itself, a dwell is that of a circle wider by `2^-27`. Against arbitrary
//! precision: tests/deep_zoom.rs.
//!
//! An orbit that is rebased to the same distance as before goes round for ever: its dwell is `Num` (R. P.
//! Brent, 1980, as in [`crate::escape::orbit::dwell`]). So does one that has come near an attracting cycle
//! ([`crate::escape::orbit::cycle`]): it is looked for after 2048, 4096, ... steps.

use core::slice::Iter;

use crate::Error;
use crate::escape::orbit::block_float::{BlockFloat, Number};
use crate::escape::orbit::cycle::{self, Path};
use crate::escape::orbit::ending::Ending;
use crate::escape::orbit::upper::Upper;
use crate::escape::perturbation::jumps::{Builder, Jumps};
use crate::escape::value::MAX_PERIOD;
use crate::num::Complex;
use crate::num::Limbs;

/// Steps before an orbit is looked at for a cycle: a picture of fewer has nothing to gain.
const FIRST_LOOK: u32 = 1 << 11;

/// A point of a reference orbit, 12 bytes. Lend an array of [`OrbitPoint::default`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OrbitPoint(BlockFloat);

impl Default for OrbitPoint {
    fn default() -> Self {
        Self(BlockFloat::<i32>::ZERO)
    }
}

/// A block that orbit points hold.
pub(crate) trait Stored: Number {
    /// How many points hold one.
    const POINTS: usize;
    fn store(self, slots: &mut [OrbitPoint]);
    fn next(points: &mut Iter<'_, OrbitPoint>) -> Option<Self>;
}

impl Stored for BlockFloat {
    const POINTS: usize = 1;

    fn store(self, slots: &mut [OrbitPoint]) {
        if let [slot] = slots {
            *slot = OrbitPoint(self);
        }
    }

    #[inline(always)]
    fn next(points: &mut Iter<'_, OrbitPoint>) -> Option<Self> {
        points.next().map(|point| point.0)
    }
}

/// High words, then low words.
impl Stored for BlockFloat<i64> {
    const POINTS: usize = 2;

    fn store(self, slots: &mut [OrbitPoint]) {
        if let [high, low] = slots {
            let word = |v: i64| (v >> 32) as i32;
            *high = OrbitPoint(BlockFloat { re: word(self.re), im: word(self.im), exponent: self.exponent });
            *low = OrbitPoint(BlockFloat { re: self.re as i32, im: self.im as i32, exponent: 0 });
        }
    }

    #[inline(always)]
    fn next(points: &mut Iter<'_, OrbitPoint>) -> Option<Self> {
        let (high, low) = (points.next()?.0, points.next()?.0);
        let join = |high: i32, low: i32| (i64::from(high) << 32) | i64::from(low as u32);
        Some(Self { re: join(high.re, low.re), im: join(high.im, low.im), exponent: high.exponent })
    }
}

/// A reference orbit: `0, C, C^2 + C, ...` up to its end.
#[derive(Debug, Clone)]
pub(crate) struct Reference<'a, N> {
    points: &'a [OrbitPoint],
    /// `C`.
    centre: N,
    jumps: Jumps<N>,
}

impl<'a, N: Stored> Reference<'a, N> {
    /// How many points an orbit of `max` steps takes.
    pub(crate) const fn points(max: u32) -> usize {
        let steps = if max < 2 { 2 } else { max as usize };
        steps * N::POINTS
    }

    /// Follows the orbit of 0 until it exceeds 2 or fills `buffer`. `reach`: the exponent of 2 that the
    /// distances of pixels from `c` are below.
    ///
    /// # Errors
    /// [`Error::BufferLength`] unless there are [`Self::points`].
    pub(crate) fn new<const LIMBS: usize>(
        c: &Complex<Limbs<LIMBS>>,
        max: u32,
        reach: i32,
        buffer: &'a mut [OrbitPoint],
    ) -> Result<Self, Error> {
        let needed = Self::points(max);
        if buffer.len() < needed {
            return Err(Error::BufferLength { what: "points of the orbit", given: buffer.len(), needed });
        }
        let mut length = 0;
        let mut builder = Builder::new(reach);
        let (mut x, mut y) = (Limbs::ZERO, Limbs::ZERO);
        for slots in buffer.chunks_exact_mut(N::POINTS.max(1)).take(needed / N::POINTS.max(1)) {
            let point = block(&x, &y);
            N::nearest(point).store(slots);
            length += N::POINTS;
            if point.short().is_beyond_two() {
                break;
            }
            builder.push(point);
            // within 2: squares of at most 4, the sum of at most 8 wraps and comes back
            let (xx, yy) = (x.times(&x), y.times(&y));
            let sum = x.plus(&y);
            let cross = sum.times(&sum).minus(&xx).minus(&yy);
            (x, y) = (xx.minus(&yy).plus(&c.re), cross.plus(&c.im));
        }
        let points: &'a [OrbitPoint] = buffer;
        let points = points.get(..length).unwrap_or(points);
        let centre = N::nearest(block(&c.re, &c.im));
        Ok(Self { points, centre, jumps: builder.finish() })
    }

    /// How many points there are.
    pub(crate) const fn len(&self) -> usize {
        self.points.len() / N::POINTS
    }

    /// The end of the orbit of 0 under `z^2 + C + g`; none after `max` iterations. The derivative is by `g`,
    /// if it is asked for.
    pub(crate) fn ending<const DERIVATIVE: bool>(&self, g: N, max: u32) -> Option<Ending> {
        let mut walk = Walk::new(self, g);
        let (mut saved, mut rebased, mut window) = (N::ZERO, 0_u32, 1_u32);
        let mut until = FIRST_LOOK.min(max);
        loop {
            if walk.steps >= until {
                // an orbit that is near an attracting cycle never escapes
                if until >= max || cycle::look(&walk, MAX_PERIOD).is_some() {
                    return None;
                }
                until = until.saturating_mul(2).min(max);
                continue;
            }
            match walk.step::<DERIVATIVE>() {
                Event::Beyond if walk.steps <= max => {
                    let (z, c) = (walk.z.short(), self.centre.plus(g).short());
                    let gain = BlockFloat::<i32>::ONE;
                    return Some(Ending { steps: walk.steps - 1, z, c, derivative: walk.derivative, gain });
                }
                Event::Rebased if walk.z == saved => return None,
                Event::Rebased => {
                    rebased += 1;
                    if rebased == window {
                        (saved, window) = (walk.z, window.saturating_mul(2));
                    }
                }
                Event::Beyond => return None,
                Event::Plain => {}
            }
        }
    }

    /// The length of the cycle that an orbit inside is drawn to within about `max` steps.
    pub(crate) fn period(&self, g: N, max: u32) -> Option<u32> {
        cycle::period(Walk::new(self, g), max)
    }
}

/// A point on the circle that is wider than 2 by two units of the last place: an orbit that follows the
/// circle from within, near `c = -2`, may be rounded beyond 2 long before it escapes.
#[inline(always)]
fn rounded_circle<N: Number>() -> N {
    N::nearest(BlockFloat::<i64>::new((1 << (N::BITS - 2)) + 1, 0, 3 - N::BITS))
}

/// What a step came to.
enum Event {
    Plain,
    /// `|z| > 2`.
    Beyond,
    /// The orbit goes on from the start of the reference.
    Rebased,
}

/// An orbit on its way along the reference.
#[derive(Debug, Clone)]
struct Walk<'a, N> {
    reference: &'a Reference<'a, N>,
    /// From the next point on.
    points: Iter<'a, OrbitPoint>,
    /// `Z`, `d`, `g`, `z` and `z'`.
    at: N,
    distance: N,
    g: N,
    z: N,
    derivative: BlockFloat,
    /// Steps from 0.
    steps: u32,
    at_start: bool,
}

impl<'a, N: Stored> Walk<'a, N> {
    fn new(reference: &'a Reference<'a, N>, g: N) -> Self {
        let points = [].iter();
        let mut walk = Self {
            reference,
            points,
            at: N::ZERO,
            distance: N::ZERO,
            g,
            z: N::ZERO,
            derivative: BlockFloat::<i32>::ZERO,
            steps: 0,
            at_start: true,
        };
        walk.rebase();
        walk
    }

    /// `d <- z`, and `Z = 0`.
    #[inline(always)]
    fn rebase(&mut self) {
        self.distance = self.z;
        self.points = self.reference.points.iter();
        self.at = self.advance();
        self.at_start = true;
    }

    #[inline(always)]
    fn advance(&mut self) -> N {
        // the reference is longer than an orbit that is not rebased
        N::next(&mut self.points).unwrap_or(N::ZERO)
    }

    /// One step, or from the first point a jump.
    #[inline(always)]
    fn step<const DERIVATIVE: bool>(&mut self) -> Event {
        if DERIVATIVE {
            self.derivative = self.z.short().times(self.derivative).doubled().plus(BlockFloat::<i32>::ONE);
        }
        self.distance = self.at.doubled().plus(self.distance).times(self.distance).plus(self.g);
        self.steps += 1;
        if self.at_start {
            self.at_start = false;
            if let Some(jump) = self.reference.jumps.find(self.distance, self.g) {
                self.distance = jump.apply(self.distance, self.g);
                if DERIVATIVE {
                    self.derivative = jump.slope(self.derivative);
                }
                self.steps += jump.to - 1;
                let next = jump.to as usize * N::POINTS;
                self.points = self.reference.points.get(next..).unwrap_or(&[]).iter();
            }
        }
        self.at = self.advance();
        self.z = self.at.plus(self.distance);
        if self.z.is_beyond_two() && !self.z.is_less(rounded_circle()) {
            Event::Beyond
        } else if self.points.as_slice().is_empty() || !self.distance.is_less(self.z) {
            self.rebase();
            Event::Rebased
        } else {
            Event::Plain
        }
    }
}

impl<N: Stored> Path for Walk<'_, N> {
    type Size = BlockFloat;

    fn size(&self) -> BlockFloat {
        self.z()
    }

    fn apart(&self, other: &Self) -> BlockFloat {
        self.off(other)
    }

    fn run(&mut self, steps: u32) -> bool {
        let until = self.steps.saturating_add(steps);
        while self.steps < until {
            if matches!(self.step::<false>(), Event::Beyond) {
                return false;
            }
        }
        true
    }

    fn next(&mut self) -> bool {
        // no jump: each point counts
        self.at_start = false;
        !matches!(self.step::<false>(), Event::Beyond)
    }

    fn z(&self) -> BlockFloat {
        self.z.short()
    }

    fn off(&self, other: &Self) -> BlockFloat {
        self.z.plus(other.z.negated()).short()
    }

    fn blur(&self) -> Upper {
        // |Z| <= 2 |z|, or the orbit was rebased: the point of the reference is rounded, and the sum
        Upper::of(self.z.short()).scaled(3 - N::BITS)
    }

    fn step_error(&self) -> Upper {
        // with u = 2^(1 - BITS): at most 5 u (|2 Z + d| |d| + |g|) for the distance, 4 u of it when it is
        // rebased as |Z| <= 2 |d|, 4 u (1 + |d|) where the reference ends
        let of = |v: N| Upper::of(v.short());
        let size = of(self.at.doubled()).plus(of(self.distance)).times(of(self.distance)).plus(of(self.g));
        let last = self.points.as_slice().len() <= N::POINTS;
        (if last { size.plus(Upper::power(0)) } else { size }).scaled(5 - N::BITS)
    }
}

/// The nearest block to a wide number.
fn block<const LIMBS: usize>(x: &Limbs<LIMBS>, y: &Limbs<LIMBS>) -> BlockFloat<i64> {
    let (a, b) = (x.magnitude(), y.magnitude());
    let Some(highest) = a.highest_bit().max(b.highest_bit()) else { return BlockFloat::<i64>::ZERO };
    let part = |v: &Limbs<LIMBS>, negative: bool| {
        // 64 bits
        let low = highest.checked_sub(32).map_or(0, |position| v.window(position));
        let bits = (i128::from(v.window(highest)) << 32) | i128::from(low);
        if negative { -bits } else { bits }
    };
    BlockFloat::<i64>::new(
        part(&a, x.is_negative()),
        part(&b, y.is_negative()),
        highest as i32 - 63 - Limbs::<LIMBS>::FRACTION as i32,
    )
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::DeepView;
    use embedded_graphics_core::geometry::Size;

    type Exact = Limbs<8>;

    /// `z` after so many steps from 0 in 252 bits.
    fn exact(c: &Complex<Exact>, steps: u32) -> (Exact, Exact) {
        let (mut x, mut y) = (Exact::ZERO, Exact::ZERO);
        for _ in 0..steps {
            let (xx, yy, xy) = (x.times(&x), y.times(&y), x.times(&y));
            (x, y) = (xx.minus(&yy).plus(&c.re), xy.plus(&xy).plus(&c.im));
        }
        (x, y)
    }

    fn log2(b: BlockFloat) -> f64 {
        f64::from(b.re).hypot(f64::from(b.im)).log2() + f64::from(b.exponent)
    }

    #[test]
    fn a_pixel_is_moved_by_less_than_the_bound() {
        // beside copies of period 245 and 58, and at a spiral
        let mut worst = -1e9_f64;
        for (re, im, max) in [
            (
                "-0.10109636384562216102578544573874555904580300638820556440768887",
                "0.95628651080914150077109605773014301122275521289360319025125885",
                3500,
            ),
            (
                "-1.29635513817303621680830447784551060197279921968606146204176784",
                "0.44185160573519660121284858017442289624023451877396908232414922",
                1200,
            ),
            ("0", "1", 800),
        ] {
            let view = DeepView::<8>::parse(re, im, "3e-60", Size::new(12, 12)).unwrap();
            let mut orbit = std::vec![OrbitPoint::default(); max as usize];
            let reference =
                Reference::<'_, BlockFloat>::new(view.centre(), max, view.reach(), &mut orbit).unwrap();
            let (mut outside, mut fewest) = (0, f64::MAX);
            for (column, row) in (0..12).flat_map(|row| (0..12).map(move |column| (column, row))) {
                let g = view.distance(view.steps(column, row)).short();
                let Some(ending) = reference.ending::<true>(g, max) else { continue };
                // how many roundings there were
                let (mut walk, mut walked) = (Walk::new(&reference, g), 0.0);
                while walk.steps <= ending.steps {
                    walk.step::<false>();
                    walked += 1.0;
                }
                let (x, y) = exact(&view.point(column, row), ending.steps + 1);
                let z = block(&x, &y).short();
                let off = z.negated().plus(ending.z);
                // z itself is rounded to 30 bits, and that is no move
                let off = (log2(off).exp2() - 2.0 * log2(z).exp2() * 2_f64.powi(-30)).max(0.0);
                let moved = off.log2() - log2(ending.derivative);
                let bound = (4.0 * walked * 2_f64.powi(-30)).log2() + log2(g);
                worst = worst.max(moved - bound);
                assert!(moved < bound, "{re}: 2^{moved} of 2^{bound} after {walked}");
                outside += 1;
                fewest = fewest.min(walked / f64::from(ending.steps + 1));
            }
            std::println!("{outside} outside, {fewest:.3} of the iterations");
            assert!(outside > 100 && fewest < 0.5, "{outside} {fewest}");
        }
        std::println!("at most 2^{worst} of the bound");
        assert!(worst > -8.0, "{worst}");
    }

    std::thread_local! {
        static STEPS: std::cell::Cell<u32> = const { std::cell::Cell::new(0) };
    }

    /// A block that counts how often it is compared with the circle: once a step.
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Counted<N>(N);

    impl<N: Number> Number for Counted<N> {
        const BITS: i32 = N::BITS;
        const ZERO: Self = Self(N::ZERO);
        const ONE: Self = Self(N::ONE);
        fn times(self, other: Self) -> Self {
            Self(self.0.times(other.0))
        }
        fn plus(self, other: Self) -> Self {
            Self(self.0.plus(other.0))
        }
        fn negated(self) -> Self {
            Self(self.0.negated())
        }
        fn doubled(self) -> Self {
            Self(self.0.doubled())
        }
        fn is_beyond_two(self) -> bool {
            STEPS.set(STEPS.get() + 1);
            self.0.is_beyond_two()
        }
        fn is_less(self, other: Self) -> bool {
            self.0.is_less(other.0)
        }
        fn above(self) -> i32 {
            self.0.above()
        }
        fn reached(self) -> i32 {
            self.0.reached()
        }
        fn short(self) -> BlockFloat {
            self.0.short()
        }
        fn nearest(long: BlockFloat<i64>) -> Self {
            Self(N::nearest(long))
        }
    }

    impl<N: Stored> Stored for Counted<N> {
        const POINTS: usize = N::POINTS;
        fn store(self, slots: &mut [OrbitPoint]) {
            self.0.store(slots);
        }
        fn next(points: &mut Iter<'_, OrbitPoint>) -> Option<Self> {
            N::next(points).map(Self)
        }
    }

    /// The most steps beyond `max` that a dwell took, and the most that a period took; how many orbits came
    /// to `max` without an end.
    fn most_steps<N: Stored>(view: &DeepView<8>, max: u32, orbit: &mut [OrbitPoint]) -> (u32, u32, u32) {
        let reference = Reference::<'_, Counted<N>>::new(view.centre(), max, view.reach(), orbit).unwrap();
        let (mut beyond, mut period, mut endless) = (0, 0, 0);
        for (column, row) in [(0, 0), (3, 1), (4, 4), (5, 4), (8, 8)] {
            let g = Counted::<N>::nearest(view.distance(view.steps(column, row)));
            STEPS.set(0);
            let ending = reference.ending::<false>(g, max);
            beyond = beyond.max(STEPS.take().saturating_sub(max));
            endless += u32::from(ending.is_none());
            reference.period(g, max);
            period = period.max(STEPS.take());
        }
        (beyond, period, endless)
    }

    /// Where orbits neither escape nor come near a cycle, or late: roots and centres of components,
    /// preperiodic points; near and deep.
    #[test]
    fn perturbation_takes_a_bounded_number_of_steps() {
        let mut orbit = std::vec![OrbitPoint::default(); 2 << 17];
        let (mut beyond, mut period, mut endless) = (0, 0, 0);
        for (re, im) in [
            ("0.25", "0"),
            ("-0.75", "0"),
            ("-1.25", "0"),
            ("-2", "0"),
            ("0", "1"),
            ("-0.1", "0"),
            ("0.379513588015923744", "0.334932305597498"),
            (
                "-0.10109636384562216102578544573874555904580300638820556440768887",
                "0.956286510809141500771096057730143011",
            ),
        ] {
            for width in ["1e-3", "1e-8", "1e-30", "1e-50"] {
                let view = DeepView::<8>::parse(re, im, width, Size::new(9, 9)).unwrap();
                for max in [1, 300, FIRST_LOOK + 1, 1 << 14, 1 << 17] {
                    // the largest is slow
                    if max > 1 << 14 && width != "1e-8" {
                        continue;
                    }
                    for found in [
                        most_steps::<BlockFloat>(&view, max, &mut orbit),
                        most_steps::<BlockFloat<i64>>(&view, max, &mut orbit),
                    ] {
                        (beyond, period) = (beyond.max(found.0), period.max(found.1));
                        endless += found.2;
                        assert!(
                            found.0 < 42_000 && found.1 < 131_072,
                            "{found:?} of {max} at {re}, {im}, {width}"
                        );
                    }
                }
            }
        }
        std::println!("{beyond} steps beyond the limit, {period} for a period; {endless} endless");
        // nothing is asserted of orbits that end at once
        assert!(beyond > 500 && period > 65_536 && endless > 200, "{beyond} {period} {endless}");
    }

    /// A block in 252 bits, as it is.
    fn exact_of(b: BlockFloat<i64>) -> (Exact, Exact) {
        if (b.re, b.im) == (0, 0) {
            return (Exact::ZERO, Exact::ZERO);
        }
        let part = |word: i64| {
            let places = u32::try_from(b.exponent + Exact::FRACTION as i32).unwrap();
            let mut limbs = [0; 8];
            for (i, limb) in (0_u32..).zip(&mut limbs) {
                let above = u128::from(word.unsigned_abs()) << (places % 32);
                *limb = (i.checked_sub(places / 32)).map_or(0, |i| above.unbounded_shr(32 * i) as u32);
            }
            let v = Exact::from_limbs(limbs);
            if word < 0 { v.negated() } else { v }
        };
        (part(b.re), part(b.im))
    }

    /// Follows orbits beside exact ones. Steps taken, and how often a step's error and that of a point double
    /// before they reach the bounds by which cycles are proved.
    fn room<N: Stored>(view: &DeepView<8>, max: u32, wide: fn(N) -> BlockFloat<i64>) -> (u32, [i32; 2]) {
        let mut orbit = std::vec![OrbitPoint::default(); Reference::<'_, N>::points(max)];
        let reference = Reference::<'_, N>::new(view.centre(), max, view.reach(), &mut orbit).unwrap();
        let led = |(x, y): (Exact, Exact), c: (Exact, Exact)| {
            let xy = x.times(&y);
            (x.times(&x).minus(&y.times(&y)).plus(&c.0), xy.plus(&xy).plus(&c.1))
        };
        let centre = (view.centre().re, view.centre().im);
        let mut middle = std::vec![(Exact::ZERO, Exact::ZERO)];
        for k in 1..reference.len() {
            middle.push(led(middle[k - 1], centre));
        }
        let less = |a: (Exact, Exact), b: (Exact, Exact)| block(&a.0.minus(&b.0), &a.1.minus(&b.1)).short();
        let plus = |a: (Exact, Exact), b: (Exact, Exact)| (a.0.plus(&b.0), a.1.plus(&b.1));
        let (mut steps, mut room) = (0, [i32::MAX; 2]);
        let mut note = |off: BlockFloat, bound: Upper, which: usize| {
            if (off.re, off.im) != (0, 0) {
                let size = Upper::of(off);
                assert!(size <= bound, "{which}: {size:?} of {bound:?}");
                let doublings = (0..64).take_while(|k| size.scaled(k + 1) <= bound).count() as i32;
                room[which] = room[which].min(doublings);
            }
        };
        for (column, row) in (0..4).flat_map(|row| (0..4).map(move |column| (column, row))) {
            let g = N::nearest(view.distance(view.steps(column, row)));
            let c = plus(centre, exact_of(wide(g)));
            let mut walk = Walk::new(&reference, g);
            // the point that the steps are computed for: the centre's, not rounded, and the distance
            let point = |walk: &Walk<'_, N>| {
                let left = walk.points.as_slice().len();
                let at = (reference.points.len() - left) / N::POINTS - 1;
                plus(middle[at], exact_of(wide(walk.distance)))
            };
            for _ in 0..max {
                let (before, bound) = (point(&walk), walk.step_error());
                if !walk.next() {
                    break;
                }
                let now = point(&walk);
                note(less(now, led(before, c)), bound, 0);
                note(less(exact_of(wide(walk.z)), now), walk.blur(), 1);
                steps += 1;
            }
        }
        (steps, room)
    }

    #[test]
    fn steps_and_points_are_within_the_bounds_that_prove_cycles() {
        // copies of period 34 and 31, and a spiral from which all orbits escape
        for (re, im, max) in [
            (
                "-0.22815549365396177228498592653253904365159762112307",
                "1.11514250803993715834441655794265638994873014695612",
                700,
            ),
            (
                "-1.29635513817303623958400101894480453808696728365555",
                "0.44185160573519697390918186054989267280045414010086",
                700,
            ),
            ("0", "1", 400),
        ] {
            let view = DeepView::<8>::parse(re, im, "1e-30", Size::new(4, 4)).unwrap();
            let narrow = room::<BlockFloat>(&view, max, |b| BlockFloat {
                re: i64::from(b.re),
                im: i64::from(b.im),
                exponent: b.exponent,
            });
            let wide = room::<BlockFloat<i64>>(&view, max, |b| b);
            std::println!("{re}: 30 bits {narrow:?}, 62 bits {wide:?}");
            for (steps, room) in [narrow, wide] {
                // a bound that were a sixteenth of what it is would be noticed
                assert!(steps > 1000 && room.iter().all(|doublings| *doublings < 4), "{steps} {room:?}");
            }
        }
    }
}
