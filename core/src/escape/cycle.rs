//! The cycle that an orbit is drawn to, found by its multiplier.
//!
//! A point `z` and its `p`-th next one, `z + e`, have a cycle of `p` points near them if Newton's iteration converges from `z`: with `m` and `s` the
//! first and second derivative of the `p` steps, the cycle is about `|e| / |1 - m|` away, and its multiplier within `|s|` times that
//! of `m` (L. V. Kantorovich, "Functional analysis and applied mathematics", 1948). Where it stays below 1 the cycle
//! attracts, and `z^2 + c` has no other one that does (P. Fatou, 1919): the orbit of 0 is drawn to it and never escapes.
//!
//! The test stands on the point of the cycle that is nearest to 0: near a small copy of the set all cycles pass by the same places, and
//! only there are they told apart.

use super::block::{Block, Number};

/// The longest cycle that is looked for.
pub(super) const LONGEST: u32 = 256;
/// Steps before the first look.
const FIRST: u32 = 16;
/// Steps before the last look: an orbit that is not drawn in by then is left without a period.
const LAST: u32 = 1 << 16;

/// An orbit that can be followed twice.
pub(super) trait Path: Clone {
    /// Takes `steps` or a few more; false once it has escaped.
    fn run(&mut self, steps: u32) -> bool;
    /// The next point; false once it has escaped.
    fn next(&mut self) -> bool;
    fn z(&self) -> Block;
    /// The difference to another point.
    fn off(&self, other: &Self) -> Block;
    /// What rounding may make of a difference near this point.
    fn grain(&self) -> Block;
}

/// The period of the cycle that an orbit is drawn to; none if it escapes, or none of at most [`LONGEST`] points shows within about `limit` steps.
///
/// Looks after 16, 32, 64, ... steps. Cost: `limit` steps, at most [`LAST`], and two cycles for each look.
pub(super) fn period<P: Path>(mut path: P, limit: u32) -> Option<u32> {
    let limit = limit.clamp(FIRST, LAST);
    let (mut taken, mut until) = (0, FIRST);
    loop {
        if !path.run(until - taken) {
            return None;
        }
        if let Some(period) = look(&path, until.min(LONGEST)) {
            return Some(period);
        }
        if until == limit {
            return None;
        }
        (taken, until) = (until, until.saturating_mul(2).min(limit));
    }
}

/// The period of the attracting cycle of at most `longest` points that an orbit has come near to.
pub(super) fn look<P: Path>(path: &P, longest: u32) -> Option<u32> {
    let (mut nearest, mut on) = (path.clone(), path.clone());
    for _ in 0..longest {
        if !on.next() {
            return None;
        }
        if on.z().is_less(nearest.z()) {
            nearest = on.clone();
        }
    }
    // the points that come nearer than all before them
    let mut on = nearest.clone();
    let mut least: Option<Block> = None;
    for period in 1..=longest {
        if !on.next() {
            return None;
        }
        let off = on.off(&nearest);
        if least.is_none_or(|least| off.is_less(least)) {
            least = Some(off);
            if let Some(radius) = attracted(&nearest, period) {
                return Some(shortest(&nearest, period, radius));
            }
        }
    }
    None
}

/// `|e|` and `1 - m`, if an attracting cycle of `period` points, or of a divisor, passes near this point.
fn attracted<P: Path>(start: &P, period: u32) -> Option<[Block; 2]> {
    let mut on = start.clone();
    let (mut first, mut second) = (Block::<i32>::ONE, Block::<i32>::ZERO);
    for _ in 0..period {
        let z = on.z();
        second = first.times(first).plus(z.times(second)).doubled();
        first = z.times(first).doubled();
        if !on.next() {
            return None;
        }
    }
    let (off, grain) = (on.off(start), start.grain());
    let off = if off.is_less(grain) { grain } else { off };
    let one = Block::<i32>::ONE;
    let conjugate = Block { im: -first.im, ..first };
    // 2 |s e| / |1 - m| < 1 - |m|, and 2 (1 - |m|) >= 1 - |m|^2; with a factor of 4 to spare for what s changes
    let room = one.plus(first.times(conjugate).negated());
    let rest = one.plus(first.negated());
    let change = second.times(off);
    let change = Block { exponent: change.exponent + 4, ..change };
    (room.re > 0 && change.is_less(room.times(rest))).then_some([off, rest])
}

/// A cycle that is run through several times is the shorter one: its points come back as near as the cycle is.
fn shortest<P: Path>(start: &P, period: u32, [off, rest]: [Block; 2]) -> u32 {
    let mut on = start.clone();
    let near = off.doubled().doubled();
    for shorter in 1..period {
        if !on.next() {
            break;
        }
        if period.checked_rem(shorter) == Some(0) && on.off(start).times(rest).is_less(near) {
            return shorter;
        }
    }
    period
}
