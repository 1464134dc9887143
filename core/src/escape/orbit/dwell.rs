//! The dwell of an orbit in 32-bit words: how many times `d <- d^2 + c` may be applied before `|d|` exceeds
//! 2, at most `Num` times. This is the inner loop of every picture of the Mandelbrot set and of Julia sets
//! that is not deep.
//!
//! Source: course unit V, "The Mandelbrot set", section 5.4.3, read as its own definition says:
//! `dwell = min(iterations until |d_k| > 2, Num)`, so that a start beyond 2 has dwell 0. Format: I3F29 in
//! 32-bit words, every product rounded once.
//!
//! ### Why nothing that wrapped can be mistaken for a point of the disc
//! An I3F29 holds `[-4, 4)`, and a step from `|d| <= 2` with `|c| <= 2` reaches 6. A component that leaves
//! the format comes back 8 away: from `4 <= |v| < 6` it lands strictly beyond 2, so that the next test sees
//! an escape, as it should. Only `|v| = 6` would land on 2, the edge of the disc (`c = 2`: `2 -> 6`, stored
//! as -2; `c = -2`: `2i -> -6`, stored as 2). Hence:
//!
//! - the loop steps only from `high(x x) + high(y y) < NEAR`. The sum of the high words is low by less than 2
//!   units of `2^-26`, so that `|d|^2 < 4 - 2^-7`. Then `|d^2 + c| < 6 - 2^-7`, and rounding, below `2^-25`,
//!   does not reach 6;
//! - every other point takes the slow path, [`careful`], with exact 64-bit products and sums that do not
//!   wrap.
//!
//! The sum itself does not wrap either: `high(x x) <= 2^30`, so that it is at most `2^31` in an unsigned
//! word.
//!
//! ### Why stopping at a repeated point changes nothing
//! The next stored point is a function of the stored point alone. When one comes back, the loop runs for ever
//! through points that have all passed the test: the dwell is `Num`. The loop compares with a saved point
//! once every 8 iterations and moves the saved point at doubling distances (R. P. Brent, "An improved Monte
//! Carlo factorization algorithm", 1980).

use crate::num::formats::{Q26, Q29, UQ26, UQ58};
use crate::num::{high_of_double, high_of_square, product};

/// A stored point: real and imaginary part.
pub(crate) type Point29 = (Q29, Q29);

/// How many fractional bits the parts of a stored point have.
pub(crate) const FRACTION_Q29: u32 = 29;
/// `|d|^2` from which on the slow path decides: `4 - 2^-6`. (An immediate operand on Cortex-M; anything from
/// 3 to `4 - 2^-24` would do.)
const NEAR: UQ26 = 0x0ff0_0000;
/// The square of 2.
pub(super) const FOUR: UQ58 = 1 << (2 + 2 * FRACTION_Q29);

/// How a step rounds its products.
pub(crate) trait Rounding {
    /// `z^2 + c`, wrapped, for `|z| < 2`.
    fn step(z: Point29, c: Point29) -> Point29;

    /// The next point of the orbit that [`dwell`] follows, where both are within 2.
    #[inline(always)]
    fn next(z: Point29, c: Point29) -> Point29 {
        // near the edge the loop takes the step of `careful`: that of `Fine`, as nothing leaves the format
        // here
        if is_near(z) { Fine::step(z, c) } else { Self::step(z, c) }
    }
}

/// 29 fractional bits: the whole 64-bit product is used. Error: of a step below `2^-29` in each part
/// (`a_step_is_within_its_bound`).
pub(crate) struct Fine;

/// 26 fractional bits: only the high words are used. Error: of a step below `2^-26` in the
/// real, `2^-27` in the imaginary part (`a_step_is_within_its_bound`).
pub(crate) struct Coarse;

impl Rounding for Fine {
    #[inline(always)]
    fn step((x, y): Point29, (cx, cy): Point29) -> Point29 {
        let real = product(x.wrapping_sub(y), x.wrapping_add(y));
        let cross = product(x, y);
        // (product >> 29) + c as two additions of a shifted register each
        let re = cx.wrapping_add(high_word(real) << 3).wrapping_add(((real as u32) >> 29) as i32);
        let im = cy.wrapping_add(high_word(cross) << 4).wrapping_add(((cross as u32) >> 28) as i32);
        (re, im)
    }
}

impl Rounding for Coarse {
    #[inline(always)]
    fn step((x, y): Point29, (cx, cy): Point29) -> Point29 {
        // x^2 - y^2 from the sum that the test has just made: one instruction
        let real = norm((x, y)).wrapping_sub(high_of_square(y).wrapping_mul(2));
        // to nearest, which costs nothing (SMMULR)
        let cross = high_of_double(x, y);
        (cx.wrapping_add(real << 3), cy.wrapping_add(cross << 3))
    }
}

/// The dwell of the orbit that starts at `z`.
///
/// Domain: `|c| <= 2` unless `|z| > 2`. Result: iterations, `0..=max`.
#[inline(never)]
pub(crate) fn dwell<S: Rounding>(z: Point29, c: Point29, max: u32) -> u32 {
    let mut z = z;
    let mut saved = z;
    // iterations still allowed, and blocks of 8 until the saved point moves
    let mut left = max;
    let mut window = 2;
    loop {
        let blocks = window.min(left >> 3);
        let mut unfinished = blocks;
        let mut steps = 0; // of the last block, 8 when it was finished
        while unfinished > 0 {
            steps = block::<S>(&mut z, c);
            if steps < 8 {
                break;
            }
            unfinished -= 1;
            if z.0 == saved.0 && z.1 == saved.1 {
                return max;
            }
        }
        left -= 8 * (blocks - unfinished);
        if unfinished > 0 {
            left -= steps;
        } else if left >= 8 {
            saved = z;
            window *= 2;
            continue;
        } else {
            while left > 0 && !is_near(z) {
                z = S::step(z, c);
                left -= 1;
            }
        }
        // here the point is near the edge or beyond it, or the iterations are used up
        if left == 0 {
            return max;
        }
        match careful(z, c) {
            Careful::Beyond => return max - left,
            Careful::LeavesFormat => return max - left + 1,
            Careful::Stays(next) => {
                z = next;
                left -= 1;
            }
        }
    }
}

/// Up to 8 steps, as long as the point is well inside the disc; how many were taken.
#[inline(always)]
fn block<S: Rounding>(z: &mut Point29, c: Point29) -> u32 {
    for done in 0..8 {
        if is_near(*z) {
            return done;
        }
        *z = S::step(*z, c);
    }
    8
}

#[inline(always)]
fn is_near(z: Point29) -> bool {
    norm(z) as u32 >= NEAR
}

/// `|z|^2`, at most `2^30 + 2^30` units if read as unsigned; low by less than 2 of them.
#[inline(always)]
fn norm((x, y): Point29) -> Q26 {
    high_of_square(x).wrapping_add(high_of_square(y))
}

/// What becomes of a point near the edge of the disc.
enum Careful {
    /// It is beyond 2 itself.
    Beyond,
    /// It is not, but the next one is, by far.
    LeavesFormat,
    /// The next point.
    Stays(Point29),
}

/// The exact test, then one step that cannot wrap.
fn careful(z: Point29, c: Point29) -> Careful {
    if is_beyond(z) {
        return Careful::Beyond;
    }
    let (x, y) = (i64::from(z.0), i64::from(z.1));
    // |x|, |y| <= 2^30: every product is at most 2^61
    let re = (((x - y) * (x + y)) >> 29) + i64::from(c.0);
    let im = ((x * y) >> 28) + i64::from(c.1);
    match (i32::try_from(re), i32::try_from(im)) {
        (Ok(re), Ok(im)) => Careful::Stays((re, im)),
        _ => Careful::LeavesFormat,
    }
}

/// Whether `|z| > 2`, exactly.
#[inline]
pub(crate) fn is_beyond((x, y): Point29) -> bool {
    let square = |v: i32| product(v, v) as u64; // at most 2^62
    square(x) + square(y) > FOUR
}

#[inline(always)]
fn high_word(product: i64) -> i32 {
    (product >> 32) as i32
}

#[cfg(test)]
pub(crate) mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// The same rounding in integers that hold every intermediate value, one test a step, no shortcut: every
    /// point up to the first beyond 2.
    pub(crate) fn orbit(z: Point29, c: Point29, coarse: bool) -> impl Iterator<Item = [i128; 2]> {
        let step = move |&[x, y]: &[i128; 2]| {
            if x * x + y * y > 1 << 60 {
                return None;
            }
            let sum = ((x * x) >> 32) + ((y * y) >> 32);
            let (re, im) = if coarse && sum < i128::from(NEAR) {
                ((((x * x) >> 32) - ((y * y) >> 32)) << 3, ((2 * x * y + (1 << 31)) >> 32) << 3)
            } else {
                (((x - y) * (x + y)) >> 29, (x * y) >> 28)
            };
            Some([re + i128::from(c.0), im + i128::from(c.1)])
        };
        core::iter::successors(Some([i128::from(z.0), i128::from(z.1)]), step)
    }

    fn model(z: Point29, c: Point29, max: u32, coarse: bool) -> u32 {
        // with the point that it starts from and the one beyond 2
        (orbit(z, c, coarse).take(max as usize + 1).count() - 1) as u32
    }

    fn agrees(z: Point29, c: Point29, max: u32) -> u32 {
        let fine = dwell::<Fine>(z, c, max);
        assert_eq!(fine, model(z, c, max, false), "fine, {z:?} {c:?} {max}");
        assert_eq!(dwell::<Coarse>(z, c, max), model(z, c, max, true), "coarse, {z:?} {c:?} {max}");
        fine
    }

    /// Points within a few units of `|z| = 2`, all around.
    fn edge(angles: u32, reach: i32) -> Vec<Point29> {
        let mut points = Vec::new();
        for k in 0..angles {
            let (sin, cos) = (f64::from(k) / f64::from(angles) * core::f64::consts::TAU).sin_cos();
            let (x, y) = ((cos * 2_f64.powi(30)).round() as i32, (sin * 2_f64.powi(30)).round() as i32);
            for dx in -reach..=reach {
                points.extend((-reach..=reach).map(|dy| (x + dx, y + dy)));
            }
        }
        points
    }

    #[test]
    fn a_step_is_within_its_bound() {
        let mut worst = [[0_i128; 2]; 2];
        let mut word = 1_u64;
        for _ in 0..200_000 {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            // up to 1.4 in absolute value
            let z = ((word >> 32) as i32 >> 2, (word >> 16) as i32 >> 2);
            let [x, y] = [z.0, z.1].map(i128::from);
            let exact = [x * x - y * y, 2 * x * y];
            for (worst, (re, im)) in worst.iter_mut().zip([Fine::step(z, (0, 0)), Coarse::step(z, (0, 0))]) {
                for (worst, (got, exact)) in worst.iter_mut().zip([re, im].into_iter().zip(exact)) {
                    *worst = (*worst).max(((i128::from(got) << FRACTION_Q29) - exact).abs());
                }
            }
        }
        // with 58 fractional bits
        for (worst, bound) in worst.as_flattened().iter().zip([1 << 29, 1 << 29, 1_i128 << 32, 1 << 31]) {
            assert!(bound / 4 < *worst && *worst <= bound, "{worst} of {bound}");
        }
    }

    #[test]
    fn nothing_that_wraps_is_taken_for_a_point_of_the_disc() {
        let constants: Vec<Point29> = edge(40, 1).into_iter().filter(|c| !is_beyond(*c)).collect();
        let mut dwells = [0_u32; 6];
        for z in edge(400, 3) {
            for c in &constants {
                for max in [1, 5] {
                    let d = agrees(z, *c, max);
                    dwells[d as usize] += 1;
                }
            }
        }
        assert!([0, 1, 2, 5].iter().all(|d| dwells[*d] > 100), "too few of a kind: {dwells:?}");
    }

    #[test]
    fn the_edge_is_exact_where_a_circle_meets_an_axis() {
        const TWO: i32 = 1 << 30;
        // (2 - k)^2 + y^2 = 4 at y = sqrt(4 k): a window around it
        for k in 0..200 {
            let y0 = (f64::from(k) * 2_f64.powi(31)).sqrt() as i32;
            for y in (y0 - 60).max(0)..y0 + 60 {
                for z in [(TWO - k, y), (k - TWO, -y), (y, TWO - k), (-y, k - TWO)] {
                    agrees(z, z, 1);
                    if !is_beyond(z) {
                        agrees(z, z, 40);
                    }
                    agrees(z, (TWO, 0), 3);
                    agrees(z, (-TWO, 0), 40);
                    agrees(z, (0, TWO), 3);
                }
            }
        }
        // exactly 6 = 2 wrapped
        for z in [(0, TWO), (0, -TWO)] {
            assert_eq!(agrees(z, (-TWO, 0), 9), 1);
            assert_eq!(agrees(z, (TWO, 0), 9), 2);
        }
        assert_eq!(agrees((TWO, 0), (TWO, 0), 9), 1);
        assert_eq!(agrees((-TWO, 0), (TWO, 0), 9), 1);
        assert_eq!(agrees((-TWO, 0), (-TWO, 0), 1000), 1000);
    }

    #[test]
    fn every_limit_gives_the_smaller_of_dwell_and_limit() {
        for i in -20..=20 {
            let c = (i << 25, (i * 37 % 40) << 25);
            if is_beyond(c) {
                continue;
            }
            let whole = model(c, c, 100, false);
            for max in 1..100 {
                assert_eq!(agrees(c, c, max), whole.min(max));
            }
        }
    }

    #[test]
    fn a_cycle_ends_the_loop_with_the_result_of_the_whole_loop() {
        // a grid over the whole disc, with points of periods 1 to about 30 and with slow ones
        for i in -128..=128 {
            for j in 0..=128 {
                let c = (i << 23, j << 23);
                if !is_beyond(c) {
                    agrees(c, c, 700);
                }
            }
        }
        // parabolic: 1/4 needs 23000 iterations to come to rest
        let quarter = (1 << 27, 0);
        assert_eq!(agrees(quarter, quarter, 1 << 16), 1 << 16);
    }
}
