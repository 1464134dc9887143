//! The cycle that an orbit is drawn to, proven by a disc that comes back inside itself.
//!
//! It colours the inside of the set by periods, and ends the orbits of deep pictures that would never escape.
//!
//! If `p` steps of `z^2 + c` carry a disc into its own interior, that disc holds one point of a cycle of `p`
//! points, or of a divisor, that attracts all of it (H. A. Schwarz's lemma; C. J. Earle and R. S. Hamilton,
//! 1970). No other cycle of `z^2 + c` attracts, and this one draws in the orbit of 0 (P. Fatou, 1919): it
//! never escapes. A disc of radius `r` around `z` comes to lie within `r (2 |z| + r)` of `z^2 + c`, and what
//! rounding moved the point by is added.
//!
//! So a period that is found is right for the very `c` that the orbit was computed with, whatever its
//! rounding: by which point the disc lies and how large it is are guesses, that it comes back is proven. That
//! none is found proves nothing.
//!
//! The disc lies around the point of the orbit that is nearest to 0: near a small copy of the set all cycles
//! pass by the same places, and only there are they told apart.

use crate::escape::orbit::block_float::{BlockFloat, Number};
use crate::escape::orbit::upper::Upper;
use crate::escape::value::MAX_PERIOD;
use crate::num::high_u;

/// Steps before the first look.
const FIRST: u32 = 16;
/// An orbit is followed for so many steps, however few a picture takes for the dwell.
const LEAST: u32 = 1 << 12;
/// Steps before the last look: an orbit that is not drawn in by then is left without a period.
const LAST: u32 = 1 << 16;
/// The periods that a look tries add up to no more. Points that come ever nearer are few: each is a best
/// approximation.
const TRIED: u32 = 1 << 11;

/// The square of a modulus, or what else can be compared in its stead.
pub(crate) trait Size: Copy {
    /// Whether the modulus is less.
    fn is_below(self, other: Self) -> bool;
    /// A mantissa and an exponent of 2 that the square of the modulus reaches.
    fn reached(self) -> (u32, i32);
}

impl Size for BlockFloat {
    #[inline]
    fn is_below(self, other: Self) -> bool {
        self.is_less(other)
    }

    #[inline]
    fn reached(self) -> (u32, i32) {
        let (square, exponent) = self.square();
        ((square >> 32) as u32, exponent.saturating_add(32))
    }
}

/// An orbit that can be followed twice.
pub(crate) trait Path: Clone {
    /// How large a point is, or a difference of two.
    type Size: Size;
    /// How far the point is from 0.
    fn size(&self) -> Self::Size;
    /// How far it is from another.
    fn apart(&self, other: &Self) -> Self::Size;
    /// Takes `steps` or a few more; false once it has escaped.
    fn run(&mut self, steps: u32) -> bool;
    /// The next point, of one that has not escaped; false once it has.
    fn next(&mut self) -> bool;
    fn z(&self) -> BlockFloat;
    /// The difference to another point.
    fn off(&self, other: &Self) -> BlockFloat;
    /// How far the point is at most from the one that the steps are computed for.
    fn blur(&self) -> Upper;
    /// How far the next point is at most from where `z^2 + c` leads.
    fn step_error(&self) -> Upper;
}

/// The period of the cycle that an orbit is drawn to; none if it escapes, or none of at most [`MAX_PERIOD`]
/// points shows within about `limit` steps.
///
/// Looks after 16, 32, 64, ... steps. Cost: `limit` steps, at least [`LEAST`] and at most [`LAST`], and what
/// [`look`] takes each of at most 13 times: below 2 [`LAST`], whatever the orbit
/// (`a_period_takes_a_bounded_number_of_steps`).
pub(crate) fn period<P: Path>(mut path: P, limit: u32) -> Option<u32> {
    let limit = limit.clamp(LEAST, LAST);
    let (mut taken, mut until) = (0, FIRST);
    loop {
        if !path.run(until - taken) {
            return None;
        }
        if let Some(period) = look(&path, until.min(MAX_PERIOD)) {
            return Some(period);
        }
        if until == limit {
            return None;
        }
        (taken, until) = (until, until.saturating_mul(2).min(limit));
    }
}

/// The period of the attracting cycle of at most `longest` points that an orbit has come near to.
///
/// Cost: `2 longest` steps, and twice the period for each point that comes nearer than all before it: at most
/// `2 longest + 2 TRIED`.
pub(crate) fn look<P: Path>(path: &P, longest: u32) -> Option<u32> {
    let (mut nearest, mut on) = (path.clone(), path.clone());
    let mut least = path.size();
    for _ in 0..longest {
        if !on.next() {
            return None;
        }
        if on.size().is_below(least) {
            (nearest, least) = (on.clone(), on.size());
        }
    }
    // the points that come nearer than all before them
    let mut on = nearest.clone();
    let mut least: Option<P::Size> = None;
    let mut tried = 0;
    for period in 1..=longest {
        if !on.next() {
            return None;
        }
        let off = on.apart(&nearest);
        if least.is_none_or(|least| off.is_below(least)) {
            least = Some(off);
            tried += period;
            if tried > TRIED {
                return None;
            }
            let found = radius(&nearest, period).and_then(|radius| returns(&nearest, period, radius));
            if found.is_some() {
                return found;
            }
        }
    }
    None
}

/// The radius of a disc that may come back inside itself: with `m` the derivative of the steps,
/// `2 / (1 - |m|)` times as far as the point moves, or twice that.
fn radius<P: Path>(start: &P, period: u32) -> Option<Upper> {
    if repels(start, period) {
        return None;
    }
    let mut on = start.clone();
    let (mut multiplier, mut error) = (Upper::power(0), None);
    for _ in 0..period {
        let twice = Upper::of(on.z()).plus(on.blur()).scaled(1);
        let step = on.step_error();
        multiplier = multiplier.times(twice);
        error = Some(error.map_or(step, |error: Upper| error.times(twice).plus(step)));
        if !on.next() {
            return None;
        }
    }
    Some(moved(&on, start).plus(error?).scaled(multiplier.twice_over_rest()?))
}

/// Whether the steps, by a bound of their derivative from below, draw nothing in: most candidates do not, and
/// this is known at a tenth of the cost of a bound from above.
fn repels<P: Path>(start: &P, period: u32) -> bool {
    let mut on = start.clone();
    // the square of the derivative; the mantissa at least 2^31
    let (mut mantissa, mut exponent) = (1_u32 << 31, -31_i32);
    for _ in 0..period {
        let (size, scale) = on.size().reached();
        let product = high_u(mantissa, size);
        let places = product.leading_zeros();
        if product == 0 || !on.next() {
            return false;
        }
        mantissa = product << places;
        // twice the modulus: 4 in the square
        exponent = exponent.saturating_add(scale).saturating_add(34 - places as i32);
    }
    exponent >= -31
}

/// The period of the cycle in a disc of this radius, if it comes back inside itself after so many steps.
fn returns<P: Path>(start: &P, period: u32, radius: Upper) -> Option<u32> {
    let mut on = start.clone();
    let mut reach = radius;
    for step in 1..=period {
        let twice = Upper::of(on.z()).plus(on.blur()).scaled(1);
        reach = reach.times(twice.plus(reach)).plus(on.step_error());
        if !on.next() || reach > Upper::power(0) {
            return None;
        }
        if period.checked_rem(step) == Some(0) {
            let moved = moved(&on, start);
            if moved.plus(reach) < radius {
                return Some(step);
            }
            // a cycle that is shorter comes back to the disc earlier; a distance is known within a half
            if radius.plus(reach).plus(on.blur()).plus(start.blur()).scaled(1) > moved {
                return None;
            }
        }
    }
    None
}

/// How far a point is at most from another.
fn moved<P: Path>(point: &P, start: &P) -> Upper {
    Upper::of(point.off(start)).plus(point.blur()).plus(start.blur())
}

#[cfg(test)]
mod tests {
    extern crate std;
    use core::cell::Cell;

    use super::*;
    use crate::escape::orbit::wide_dwell::{WideOrbit, dwell};

    /// Counts what is asked of an orbit.
    #[derive(Clone)]
    struct Counted<'a, P>(P, &'a Cell<u32>);

    impl<P: Path> Path for Counted<'_, P> {
        type Size = P::Size;
        fn run(&mut self, steps: u32) -> bool {
            self.1.set(self.1.get() + steps);
            self.0.run(steps)
        }
        fn next(&mut self) -> bool {
            self.1.set(self.1.get() + 1);
            self.0.next()
        }
        fn size(&self) -> P::Size {
            self.0.size()
        }
        fn apart(&self, other: &Self) -> P::Size {
            self.0.apart(&other.0)
        }
        fn z(&self) -> BlockFloat {
            self.0.z()
        }
        fn off(&self, other: &Self) -> BlockFloat {
            self.0.off(&other.0)
        }
        fn blur(&self) -> Upper {
            self.0.blur()
        }
        fn step_error(&self) -> Upper {
            self.0.step_error()
        }
    }

    fn word((re, im): (f64, f64)) -> (i64, i64) {
        let unit = |v: f64| (v * 2_f64.powi(60)) as i64;
        (unit(re), unit(im))
    }

    /// Period and steps.
    fn found(c: (f64, f64), limit: u32) -> (Option<u32>, u32) {
        let (c, steps) = (word(c), Cell::new(0));
        (period(Counted(WideOrbit { z: c, c }, &steps), limit), steps.get())
    }

    /// Roots of periods 1 to 5, where orbits look periodic for long, and preperiodic points.
    const EDGES: [(f64, f64); 9] = [
        (0.25, 0.0),
        (-0.75, 0.0),
        (-1.25, 0.0),
        (-1.75, 0.0),
        (-0.125, 0.649_519_052_838_329),
        (0.379_513_588_015_923_8, 0.334_932_305_597_498),
        (0.0, 1.0),
        (-2.0, 0.0),
        (-0.101_096_363_845_622, 0.956_286_510_809_142),
    ];

    #[test]
    fn an_orbit_that_escapes_has_no_period_however_late() {
        let (mut escaped, mut latest, mut periods) = (0, 0, 0);
        for (re, im) in EDGES {
            for size in [1e-3, 1e-5, 1e-6, 1e-7] {
                for k in 0..8 {
                    let turn = f64::from(k) * core::f64::consts::FRAC_PI_4;
                    let c = (re + size * turn.cos(), im + size * turn.sin());
                    let (period, _) = found(c, LAST);
                    let (x, y) = word(c);
                    let wide = (i128::from(x) << 64, i128::from(y) << 64);
                    let exact = dwell(wide, wide, 1 << 19);
                    if exact < 1 << 19 {
                        assert_eq!(period, None, "{c:?} escapes after {exact}");
                        (escaped, latest) = (escaped + 1, latest.max(exact));
                    } else {
                        periods += u32::from(period.is_some());
                    }
                }
            }
        }
        std::println!("{escaped} escape, the last after {latest}; {periods} have a period");
        assert!(escaped > 100 && latest > 100_000 && periods > 30, "{escaped} {latest} {periods}");
    }

    #[test]
    fn a_period_takes_a_bounded_number_of_steps() {
        let mut most = 0;
        for (re, im) in EDGES {
            for k in 0..20 {
                let c = (re - f64::from(k * k) * 1e-4, im + f64::from(k) * 1e-4);
                most = most.max(found(c, u32::MAX).1);
            }
        }
        std::println!("at most {most} steps");
        assert!(most > LAST && most < 2 * LAST, "{most}");
        // the centre of a component is known at the first look
        assert_eq!(found((-1.0, 0.0), LAST), (Some(2), 16 + 16 + 2 + 2 * (1 + 2)));
        // one that comes ever nearer to where it was, which no orbit does
        for limit in [0, LEAST + 1, LAST - 1, u32::MAX] {
            let steps = Cell::new(0);
            assert_eq!(period(Counted(Nearing(0), &steps), limit), None);
            let least = limit.clamp(LEAST, LAST) + 6 * TRIED;
            assert!(steps.get() > least && steps.get() < 2 * LAST, "{} steps", steps.get());
        }
    }

    /// A point whose distance from itself so many steps ago is the smaller the more there were.
    #[derive(Clone)]
    struct Nearing(u32);

    impl Path for Nearing {
        type Size = BlockFloat;

        fn size(&self) -> BlockFloat {
            self.z()
        }
        fn apart(&self, other: &Self) -> BlockFloat {
            self.off(other)
        }
        fn run(&mut self, steps: u32) -> bool {
            self.0 += steps;
            true
        }
        fn next(&mut self) -> bool {
            self.run(1)
        }
        fn z(&self) -> BlockFloat {
            // too far from 0 to attract
            BlockFloat::<i32>::new(1, 0, -1)
        }
        fn off(&self, other: &Self) -> BlockFloat {
            BlockFloat::<i32>::new(i64::from(1000 - self.0.abs_diff(other.0)), 0, -20)
        }
        fn blur(&self) -> Upper {
            Upper::power(-60)
        }
        fn step_error(&self) -> Upper {
            Upper::power(-60)
        }
    }

    #[test]
    fn periods_of_known_centres() {
        // -1.3107... is of period 4, -1.9854... of 5
        for (c, expected) in [
            ((0.1, 0.0), 1),
            ((-1.1, 0.05), 2),
            ((-1.754_877_666_246_693, 0.0), 3),
            ((-1.310_702_641_336_833, 0.0), 4),
            ((-1.985_424_253_054_205, 0.0), 5),
            ((-0.122_561_166_876_654, 0.744_861_766_619_744), 3),
        ] {
            assert_eq!(found(c, LEAST).0, Some(expected), "{c:?}");
        }
    }
}
