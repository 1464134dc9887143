//! On which side of a patch a ray is, piece by piece, and where it changes sides.
//!
//! Over a piece of the ray the height above the patch is a function `g` with a bound `m` of its second
//! derivative. Between two ends `a` and `b` it lies within `m / 8` of the straight line, and its slope within
//! `m / 2` of that line's: where both ends are farther off than `m / 8` it has one sign, and where they differ by
//! more than `m / 2` it is monotone. Elsewhere the piece is halved, which divides `m` by 4. In a monotone piece
//! the change of sides is found by secants. Signs that follow each other alternate, also where a piece
//! begins with another sign than the one before ended with: no change is lost between two cells.
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
/// stay between places of different signs. Between and beyond two places a function is off its secant by at most
/// half its second derivative times the ways from both.
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
        let at = Some(secant(last, before)).filter(|at| from < *at && *at < to);
        let at = at.unwrap_or(from + ((to - from) >> 1));
        // parts of the piece, 30 fractional bits
        let [p, q] = [last, before].map(|(place, _)| at.abs_diff(place) << level);
        let bent = product_u((product_u(p, q) >> 30) as u32, eighth) >> 28;
        // and what the secant's root is rounded by
        if bent + u64::from(last.1.abs_diff(before.1) >> 15) <= u64::from(NEAR) {
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

/// Where the line through two values, of which the first is less or of the other sign, is 0.
#[inline(always)]
fn secant((last, h): (Q30, Q24), (before, g): (Q30, Q24)) -> Q30 {
    let (part, whole) = (h.unsigned_abs(), h.abs_diff(g));
    // both to 16 bits, so that 16 more fit
    let shift = 16_u32.saturating_sub((part | whole).leading_zeros());
    let ratio = ((part >> shift) << 16).checked_div(whole >> shift).unwrap_or(0).min(1 << 16);
    let way = (i64::from(before.wrapping_sub(last)) * i64::from(ratio)) >> 16;
    if (h ^ g) < 0 { last.wrapping_add(way as i32) } else { last.wrapping_sub(way as i32) }
}
