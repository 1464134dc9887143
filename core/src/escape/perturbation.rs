//! Dwell by perturbation: one orbit in wide numbers, and for each pixel its small distance from it.
//!
//! With `Z' = Z^2 + C` the reference, `z = Z + d` and `c = C + g`: `d' = (2 Z + d) d + g`. Source: K. I. Martin, "Superfractalthing maths", 2013. When `|z| <= |d|`, or at
//! the end of the reference, the orbit is rebased: `d <- z`, and the reference starts again at `Z = 0` (Zhuoran, "Another solution to perturbation
//! glitches", 2021). Nothing cancels then, and no pixel needs another reference. From its first point [`Jumps`] lead on.
//!
//! Format: reference points and distances are blocks, two 30-bit mantissas with one exponent. A step rounds the distance 3 times by `2^-30` of its
//! size, and so does a jump, whatever its length: after `s` steps and jumps a pixel is shown as if it were moved by less than `4 s 2^-30` of its distance
//! from the centre (`a_pixel_is_moved_by_less_than_the_bound`). Whether `|z| > 2` is decided on 30 bits: at `c = -2` alone, where an orbit follows the circle
//! itself, a dwell is that of a circle wider by `2^-29`. Against arbitrary precision: tests/deep_zoom.rs.
//!
//! An orbit that is rebased to the same distance as before goes round for ever: its dwell is `Num` (R. P. Brent, 1980, as in [`super::dwell`]).

use super::Complex;
use super::block::Block;
use super::escape_time::Ending;
use super::jumps::{Builder, Jumps};
use crate::Error;
use crate::num::Limbs;

/// A point of a reference orbit, 12 bytes. Lend an array of [`OrbitPoint::default`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OrbitPoint(Block);

impl Default for OrbitPoint {
    fn default() -> Self {
        Self(Block::<i32>::ZERO)
    }
}

/// A reference orbit: `0, C, C^2 + C, ...` up to its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reference<'a> {
    points: &'a [OrbitPoint],
    jumps: Jumps,
}

impl<'a> Reference<'a> {
    /// Follows the orbit of 0 until it exceeds 2 or fills `buffer`. `reach`: the exponent of 2 that the distances of pixels from `c` are below.
    ///
    /// # Errors
    /// [`Error::BufferLength`] unless there are `max` points.
    pub(super) fn new<const LIMBS: usize>(
        c: &Complex<Limbs<LIMBS>>,
        max: u32,
        reach: i32,
        buffer: &'a mut [OrbitPoint],
    ) -> Result<Self, Error> {
        let needed = (max as usize).max(2);
        if buffer.len() < needed {
            return Err(Error::BufferLength { given: buffer.len(), needed });
        }
        let mut length = 0;
        let mut builder = Builder::new(reach);
        let (mut x, mut y) = (Limbs::ZERO, Limbs::ZERO);
        for slot in buffer.iter_mut().take(needed) {
            let point = block(&x, &y);
            *slot = OrbitPoint(point.short());
            length += 1;
            if slot.0.is_beyond_two() {
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
        Ok(Self { points: points.get(..length).unwrap_or(points), jumps: builder.finish() })
    }

    /// How many points there are.
    pub(super) const fn len(&self) -> usize {
        self.points.len()
    }

    /// The end of the orbit of 0 under `z^2 + C + g`; none after `max` iterations. The derivative is by `g`, if it is asked for.
    pub(super) fn ending<const DERIVATIVE: bool>(&self, g: Block, max: u32) -> Option<Ending> {
        let mut walk = Walk::new(self, g);
        let (mut saved, mut rebased, mut window) = (Block::<i32>::ZERO, 0_u32, 1_u32);
        while walk.steps < max {
            match walk.step::<DERIVATIVE>() {
                Event::Beyond if walk.steps <= max => {
                    let c = self.points.get(1).map_or(g, |p| p.0.plus(g));
                    let gain = Block::<i32>::ONE;
                    return Some(Ending {
                        steps: walk.steps - 1,
                        z: walk.z,
                        c,
                        derivative: walk.derivative,
                        gain,
                    });
                }
                Event::Rebased if walk.z == saved => return None,
                Event::Rebased => {
                    rebased += 1;
                    if rebased == window {
                        (saved, window) = (walk.z, window.saturating_mul(2));
                    }
                }
                Event::Beyond | Event::Plain => {}
            }
        }
        None
    }

    /// The length of the cycle that an orbit inside is drawn to after `max` steps; 0 if none of at most `longest` shows.
    ///
    /// Near a small copy of the set all cycles pass by the same places; where an orbit comes nearest to 0 it tells them apart.
    pub(super) fn period(&self, g: Block, max: u32, longest: u32) -> u32 {
        let mut walk = Walk::new(self, g);
        while walk.steps < max {
            walk.step::<false>();
        }
        let mut nearest = walk.z;
        let until = walk.steps.saturating_add(longest);
        while walk.steps < until {
            walk.step::<false>();
            if walk.z.is_less(nearest) {
                nearest = walk.z;
            }
        }
        let mut passed = None;
        let until = walk.steps.saturating_add(2 * longest);
        while walk.steps < until {
            walk.step::<false>();
            // within 2^-20 of its size
            let off = Block { re: -nearest.re, im: -nearest.im, ..nearest }.plus(walk.z);
            if off.above() <= nearest.reached() - 20 {
                match passed {
                    None => passed = Some(walk.steps),
                    Some(before) => return walk.steps - before,
                }
            }
        }
        0
    }
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
struct Walk<'a> {
    reference: &'a Reference<'a>,
    /// From the next point on.
    points: core::slice::Iter<'a, OrbitPoint>,
    /// `Z`, `d`, `g`, `z` and `z'`.
    at: Block,
    distance: Block,
    g: Block,
    z: Block,
    derivative: Block,
    /// Steps from 0.
    steps: u32,
    at_start: bool,
}

impl<'a> Walk<'a> {
    fn new(reference: &'a Reference<'a>, g: Block) -> Self {
        const ZERO: Block = Block::<i32>::ZERO;
        let points = [].iter();
        let mut walk = Self {
            reference,
            points,
            at: ZERO,
            distance: ZERO,
            g,
            z: ZERO,
            derivative: ZERO,
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
    fn advance(&mut self) -> Block {
        // the reference is longer than an orbit that is not rebased
        self.points.next().map_or(Block::<i32>::ZERO, |p| p.0)
    }

    /// One step, or from the first point a jump.
    #[inline(always)]
    fn step<const DERIVATIVE: bool>(&mut self) -> Event {
        if DERIVATIVE {
            self.derivative = self.z.times(self.derivative).doubled().plus(Block::<i32>::ONE);
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
                self.points = self.reference.points.get(jump.to as usize..).unwrap_or(&[]).iter();
            }
        }
        self.at = self.advance();
        self.z = self.at.plus(self.distance);
        if self.z.is_beyond_two() {
            Event::Beyond
        } else if self.points.as_slice().is_empty() || !self.distance.is_less(self.z) {
            self.rebase();
            Event::Rebased
        } else {
            Event::Plain
        }
    }
}

/// The nearest block to a wide number.
fn block<const LIMBS: usize>(x: &Limbs<LIMBS>, y: &Limbs<LIMBS>) -> Block<i64> {
    let (a, b) = (x.magnitude(), y.magnitude());
    let Some(highest) = a.highest_bit().max(b.highest_bit()) else { return Block::<i64>::ZERO };
    let part = |v: &Limbs<LIMBS>, negative: bool| {
        // 64 bits
        let low = highest.checked_sub(32).map_or(0, |position| v.window(position));
        let bits = (i128::from(v.window(highest)) << 32) | i128::from(low);
        if negative { -bits } else { bits }
    };
    Block::<i64>::new(
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

    type Number = Limbs<8>;

    /// `z` after so many steps from 0 in 252 bits.
    fn exact(c: &Complex<Number>, steps: u32) -> (Number, Number) {
        let (mut x, mut y) = (Number::ZERO, Number::ZERO);
        for _ in 0..steps {
            let (xx, yy, xy) = (x.times(&x), y.times(&y), x.times(&y));
            (x, y) = (xx.minus(&yy).plus(&c.re), xy.plus(&xy).plus(&c.im));
        }
        (x, y)
    }

    fn log2(b: Block) -> f64 {
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
            let half_pitch = view.half_pitch_block();
            let corner = Block::<i32>::new(
                12 * i64::from(half_pitch.re),
                12 * i64::from(half_pitch.re),
                half_pitch.exponent,
            );
            let reference = Reference::new(view.centre(), max, corner.above(), &mut orbit).unwrap();
            let (mut outside, mut fewest) = (0, f64::MAX);
            for (column, row) in (0..12).flat_map(|row| (0..12).map(move |column| (column, row))) {
                let (across, up) = view.steps(column, row);
                let part = |steps: i32| i64::from(steps) * i64::from(half_pitch.re);
                let g = Block::<i32>::new(part(across), part(up), half_pitch.exponent);
                let Some(ending) = reference.ending::<true>(g, max) else { continue };
                // how many roundings there were
                let (mut walk, mut walked) = (Walk::new(&reference, g), 0.0);
                while walk.steps <= ending.steps {
                    walk.step::<false>();
                    walked += 1.0;
                }
                let (x, y) = exact(&view.point(column, row), ending.steps + 1);
                let z = block(&x, &y).short();
                let off = Block { re: -z.re, im: -z.im, ..z }.plus(ending.z);
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
}
