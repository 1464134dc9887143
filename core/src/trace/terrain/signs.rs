//! Where a polynomial changes its sign, in order, from its Bernstein coefficients.
//!
//! Where all coefficients are on one side, so is the polynomial. Else the interval is halved (de Casteljau),
//! down to where the coefficients lie on a line: there the line tells. Halves that wait stand on a bounded
//! stack. Signs that follow each other alternate, also where an interval begins with another sign than the one
//! before ended with: no change is lost between two cells.
//!
//! Source: J. M. Lane, R. F. Riesenfeld, "Bounds on a polynomial", 1981.
//!
//! Formats: coefficients 24 fractional bits, places 30.

use core::ops::ControlFlow;

use crate::num::formats::{Q24, Q30};

/// How often an interval is halved at most.
const DEPTH: usize = 12;
/// Coefficients whose second differences are together no greater than this lie on a line.
const FLAT: u32 = 1 << 5;

/// On which side a ray was last; none before it is known.
pub(super) type Above = Option<bool>;

/// Tells `changed` where the sign becomes another than `above`, and which.
pub(super) fn signs<const N: usize>(
    coefficients: [Q24; N],
    above: &mut Above,
    mut changed: impl FnMut(Q30, bool) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let mut stack = [[0; N]; DEPTH];
    let (mut part, mut from, mut level) = (coefficients, 0_i32, 0_usize);
    loop {
        let negative = part.iter().filter(|c| **c < 0).count();
        let width = (1 << 30) >> level;
        let mut side = |at: Q30, is_above: bool| {
            let other = above.replace(is_above).is_some_and(|before| before != is_above);
            if other { changed(at, is_above) } else { ControlFlow::Continue(()) }
        };
        if negative == 0 || negative == N {
            side(from, negative == 0)?;
        } else if level == DEPTH || is_flat(&part) {
            let ends = [part.first(), part.last()].map(|c| c.copied().unwrap_or(0));
            side(from, ends[0] >= 0)?;
            if (ends[0] >= 0) != (ends[1] >= 0) {
                side(from + zero_between(ends, width), ends[1] >= 0)?;
            }
        } else {
            let (left, right) = halves(part);
            if let Some(place) = stack.get_mut(level) {
                *place = right;
            }
            (part, level) = (left, level + 1);
            continue;
        }
        // the next half that waits: behind this part, as wide as the binary zeros of where it begins say
        from += width;
        if from >= 1 << 30 {
            return ControlFlow::Continue(());
        }
        level = 30 - from.trailing_zeros() as usize;
        part = level.checked_sub(1).and_then(|above| stack.get(above)).copied().unwrap_or([0; N]);
    }
}

/// Both halves of a polynomial.
#[inline(always)]
fn halves<const N: usize>(mut c: [Q24; N]) -> ([Q24; N], [Q24; N]) {
    let mut left = [0; N];
    for (k, place) in left.iter_mut().enumerate() {
        *place = c.first().copied().unwrap_or(0);
        // what remains are the points behind: in the end the right half
        for i in 0..N.saturating_sub(k + 1) {
            if let (Some(a), Some(b)) = (c.get(i).copied(), c.get(i + 1).copied())
                && let Some(place) = c.get_mut(i)
            {
                *place = (a & b).wrapping_add((a ^ b) >> 1);
            }
        }
    }
    (left, c)
}

/// Whether the coefficients lie on a line.
#[inline(always)]
fn is_flat<const N: usize>(c: &[Q24; N]) -> bool {
    let bent = c.windows(3).map(|w| match w {
        [a, b, c] => (i64::from(*a) - 2 * i64::from(*b) + i64::from(*c)).unsigned_abs(),
        _ => 0,
    });
    bent.sum::<u64>() <= u64::from(FLAT)
}

/// Where the line between two values of different signs is 0, as a part of `width`.
#[inline(always)]
fn zero_between([a, b]: [Q24; 2], width: Q30) -> Q30 {
    let (a, b) = (a.unsigned_abs(), b.unsigned_abs());
    // both to 15 bits, so that 16 more fit
    let shift = 17_u32.saturating_sub((a | b).leading_zeros());
    let (a, b) = (a >> shift, b >> shift);
    let part = (a << 16).checked_div(a + b).unwrap_or(0);
    ((i64::from(width) * i64::from(part)) >> 16) as i32
}
