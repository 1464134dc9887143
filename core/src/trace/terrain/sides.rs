//! On which side of a patch a ray is, piece by piece, and where it changes sides.
//!
//! Over a piece of the ray the height above the patch is a function `g` with a bound `m` of its second
//! derivative. Between two ends `a` and `b` it lies within `m / 8` of the straight line, and its slope within
//! `m / 2` of that line's: where both ends are farther off than `m / 8` it has one sign, and where they
//! differ by more than `m / 2` it is monotone. Elsewhere the piece is halved, which divides `m` by 4. In a
//! monotone piece the change of sides is found by secants. Signs that follow each other alternate, also where
//! a piece begins with another sign than the one before ended with: no change is lost between two cells.
//!
//! Source: D. Kalra, A. H. Barr, "Guaranteed ray intersections with implicit surfaces", 1989 (bounds of a
//! function and of its slope along a ray).
//!
//! Formats: heights 24 fractional bits, places 30.

use core::ops::ControlFlow;

use crate::num::formats::{Q24, Q30};
use crate::num::product_u;

/// How often a piece is halved at most.
const DEPTH: u32 = 12;
/// What is no farther from a line is one: 2^-20, some units more than what heights are known to.
const FLAT: u32 = 1 << 4;
/// Where a height above the patch counts as 0.
const NEAR: u32 = 1 << 6;
/// How often a place is improved at most.
const STEPS: u32 = 16;
const WHOLE: Q30 = 1 << 30;

/// On which side a ray was last; none before it is known.
pub(super) type Above = Option<bool>;

/// Tells `changed` where the sign of `over` becomes another than `above`, and which, for a bound of an eighth
/// of its second derivative over the whole piece.
#[inline(always)]
pub(super) fn sides(
    over: impl Fn(Q30) -> Q24,
    mut eighth: u32,
    above: &mut Above,
    changed: &mut impl FnMut(Q30, bool) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut side = |at: Q30, is_above: bool| {
        let other = above.replace(is_above).is_some_and(|before| before != is_above);
        if other { changed(at, is_above) } else { ControlFlow::Continue(()) }
    };
    let (mut from, mut level) = (0, 0);
    let mut a = over(0);
    loop {
        let to = from + (WHOLE >> level);
        let b = over(to);
        let alike = (a ^ b) >= 0;
        let is_clear = alike && a.unsigned_abs().min(b.unsigned_abs()) > eighth;
        if !is_clear && eighth > FLAT && a.abs_diff(b) >> 2 <= eighth && level < DEPTH {
            (level, eighth) = (level + 1, (eighth >> 2) + 1);
            continue;
        }
        side(from, a >= 0)?;
        if !alike {
            side(zero(&over, [from, to], [a, b], (eighth, level)), b >= 0)?;
        }
        if to >= WHOLE {
            return ControlFlow::Continue(());
        }
        // the next piece: as wide as the binary zeros of where it begins say, and its bound as it was
        let next = 30 - to.trailing_zeros();
        eighth = eighth.saturating_mul(1 << (2 * (level - next)));
        (a, from, level) = (b, to, next);
    }
}

/// Where a function that has different signs at both ends of a piece is 0: on secants, as long as their roots
/// stay between places of different signs. Between and beyond two places a function is off its secant by at
/// most half its second derivative times the ways from both.
#[inline(always)]
fn zero(
    over: &impl Fn(Q30) -> Q24,
    [mut from, mut to]: [Q30; 2],
    [a, b]: [Q24; 2],
    (eighth, level): (u32, u32),
) -> Q30 {
    let (mut last, mut before) =
        if a.unsigned_abs() < b.unsigned_abs() { ((from, a), (to, b)) } else { ((to, b), (from, a)) };
    for _ in 0..STEPS {
        let root = Some(secant(last, before)).filter(|at| i64::from(from) < *at && *at < i64::from(to));
        let at = root.map_or(from + ((to - from) >> 1), |root| root as i32);
        // parts of the piece, 30 fractional bits
        let [p, q] = [last, before].map(|(place, _)| at.abs_diff(place) << level);
        let bent = product_u((product_u(p, q) >> 30) as u32, eighth) >> 28;
        // and what the secant's root is rounded by
        let rounded = (last.1.unsigned_abs() >> 14) + (last.1.abs_diff(before.1) >> 14);
        if root.is_some() && bent + u64::from(rounded) <= u64::from(NEAR) {
            return at;
        }
        let here = over(at);
        if here.unsigned_abs() <= NEAR {
            return at;
        }
        if (here ^ a) < 0 {
            to = at;
        } else {
            from = at;
        }
        (last, before) = ((at, here), last);
    }
    last.0
}

/// Where the line through two values is 0, wherever that is.
#[inline(always)]
fn secant((last, h): (Q30, Q24), (before, g): (Q30, Q24)) -> i64 {
    let (part, whole) = (h.unsigned_abs(), h.abs_diff(g));
    // both to 16 bits, so that 16 more fit
    let shift = 16_u32.saturating_sub((part | whole).leading_zeros());
    let ratio = ((part >> shift) << 16).checked_div(whole >> shift).unwrap_or(0);
    let way = (i64::from(before.wrapping_sub(last)) * i64::from(ratio)) >> 16;
    let is_there = (h ^ g) < 0 || part > g.unsigned_abs();
    i64::from(last) + if is_there { way } else { -way }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Cubics of three known roots, near to each other or far, with the exact bound of their second
    /// derivative: the changes of sides are these roots, in order.
    #[test]
    fn the_changes_of_sides_of_a_cubic_are_its_roots() {
        let (mut word, mut met, mut farthest) = (3_u64, [0; 4], 0);
        let mut uniform = || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word >> 11) as f64 / 2.0_f64.powi(53)
        };
        for k in 0..3000 {
            let mut roots = [(); 3].map(|()| uniform() * 1.6 - 0.3);
            if k % 3 == 0 {
                roots[1] = roots[0] + 0.002 + 0.03 * uniform();
            }
            roots.sort_by(f64::total_cmp);
            let height = [0.5, -4.0, 30.0][k % 3];
            let [a, b, c] = roots;
            let exact = |x: f64| height * (x - a) * (x - b) * (x - c);
            let over = |at: Q30| (exact(f64::from(at) / 2.0_f64.powi(30)) * 2.0_f64.powi(24)).round() as i32;
            // linear: greatest at one of the ends
            let second = |x: f64| (height * (6.0 * x - 2.0 * (a + b + c))).abs();
            let eighth = (second(0.0).max(second(1.0)) * 2.0_f64.powi(21)).ceil() as u32;
            // what is between two roots must be higher than what heights are known to
            let between = |p: f64, q: f64| {
                (0..64).fold(0.0_f64, |most, k| most.max(exact(p + (q - p) * f64::from(k) / 63.0).abs()))
            };
            let inside: Vec<f64> = roots.into_iter().filter(|root| *root > 0.0 && *root < 1.0).collect();
            let is_sure = inside.windows(2).all(|pair| between(pair[0], pair[1]) > 1e-5)
                && [0.0, 1.0].iter().all(|end| exact(*end).abs() > 1e-4);
            if !is_sure {
                continue;
            }
            let (mut above, mut found) = (None, Vec::new());
            let _ = sides(over, eighth, &mut above, &mut |at, is_above| {
                found.push((at, is_above));
                ControlFlow::Continue(())
            });
            assert_eq!(found.len(), inside.len(), "{roots:?} {found:?}");
            assert_eq!(above, Some(exact(1.0) > 0.0));
            for ((at, is_above), root) in found.iter().zip(&inside) {
                let x = f64::from(*at) / 2.0_f64.powi(30);
                assert!((x - root).abs() < 0.02 && *is_above == (exact(root + 1e-4) > 0.0), "{x} {roots:?}");
                farthest = farthest.max(over(*at).unsigned_abs());
            }
            met[inside.len()] += 1;
        }
        // NEAR, and the rounding of what is not looked at again
        std::println!("{met:?} by roots, heights there {farthest}");
        assert!(met.iter().all(|count| *count > 100) && farthest > 16 && farthest < 80, "{met:?} {farthest}");
    }

    /// A piece that begins on the other side than the one before ended has changed sides at its begin.
    #[test]
    fn sides_alternate_across_pieces() {
        let mut above = Some(true);
        let mut found = Vec::new();
        for heights in [[-500, -600], [300, -300]] {
            let over =
                |at: Q30| heights[0] + ((i64::from(heights[1] - heights[0]) * i64::from(at)) >> 30) as i32;
            let _ = sides(over, 0, &mut above, &mut |at, is_above| {
                found.push((at, is_above));
                ControlFlow::Continue(())
            });
        }
        assert_eq!(found, [(0, false), (0, true), (1 << 29, false)]);
        assert_eq!(above, Some(false));
    }
}
