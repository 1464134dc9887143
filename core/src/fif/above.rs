//! A function and its slope above one cell, and from a cell to the parts that the maps make of it.
//!
//! `f(x0)' = s f(x0) + p(0)`, `f(x1)' = s f(x1) + p(1)`; the lift `e = (f(x0) + f(x1)) / 2 - mean` of the
//! chord's middle is `s e` and the lift of `p`; variances by [`super::variance`]. Formats: 55 fractional
//! bits.

use super::function::Fif;
use super::map::Map;
use super::polynomial::{Polynomial, part_of, twice_high};
use super::value::ONE_UQ63;
use super::variance::Variance;
use crate::Error;
use crate::num::nth;

/// No walk is deeper.
const DEEPEST: usize = 16;

/// A function and its slope above one cell, on the way from the whole domain to a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Above<const D: usize> {
    pub(super) value: Variance<D>,
    pub(super) slope: Variance<D>,
    pub(super) lift: i64,
    /// The values at both ends.
    pub(super) ends: [i64; 2],
    /// The interval, 63 fractional bits.
    start: u64,
    pub(super) width: u64,
    pub(super) index: usize,
}

/// `(p(0) + p(1)) / 2 - mean of p`.
fn lift<const D: usize>(p: &Polynomial<D>) -> i64 {
    let terms = (1_u32..).zip(p.powers).map(|(k, c)| nth(c, 2 * (k + 1)).wrapping_mul(i64::from(k - 1)));
    terms.fold(0, i64::wrapping_add)
}

impl<const D: usize> Above<D> {
    const ZERO: Self = Self {
        value: Variance::ZERO,
        slope: Variance::ZERO,
        lift: 0,
        ends: [0; 2],
        start: 0,
        width: ONE_UQ63,
        index: 0,
    };

    pub(super) fn whole<const N: usize>(fif: &Fif<N, D>, slope: &Fif<N, D>) -> Self {
        let middle = (fif.first >> 1).wrapping_add(fif.last >> 1);
        let (value, slope) = (Variance::of(fif), Variance::of(slope));
        let (lift, ends) = (middle.wrapping_sub(fif.mean()), [fif.first, fif.last]);
        Self { value, slope, lift, ends, ..Self::ZERO }
    }

    /// Above the part that a map makes, among `count` cells of this level.
    pub(super) fn part(&self, map: &Map<D>, slope: &Map<D>, (j, count): (usize, usize)) -> Self {
        let (p, r) = (map.q.part(self.start, self.width), slope.q.part(self.start, self.width));
        let rise = p.powers.iter().fold(0, |sum: i64, c| sum.wrapping_add(*c));
        let [first, last] = self.ends.map(|y| twice_high(y, map.scaling).wrapping_add(p.constant));
        Self {
            value: self.value.part(map.scaling, &p),
            slope: self.slope.part(slope.scaling, &r),
            lift: twice_high(self.lift, map.scaling).wrapping_add(lift(&p)),
            ends: [first, last.wrapping_add(rise)],
            start: map.start.wrapping_add(part_of(self.start, map.width)),
            width: if self.width == ONE_UQ63 { map.width } else { part_of(self.width, map.width) },
            index: j * count + self.index,
        }
    }
}

/// Shows every cell down to level `depth`, with its level, in no order but that a level's index says which.
///
/// # Errors
/// Those of the slope.
pub(super) fn walk<const N: usize, const D: usize>(
    fif: &Fif<N, D>,
    depth: u32,
    mut show: impl FnMut(u32, &Above<D>),
) -> Result<(), Error> {
    let slopes: Fif<N, D> = fif.slopes()?;
    // depth first: of every level the cell that is being divided
    let mut path = [(Above::ZERO, 0); DEEPEST + 1];
    let whole = Above::whole(fif, &slopes);
    path[0] = (whole, 0);
    show(0, &whole);
    // the cells of this level
    let (mut level, mut count, maps) = (0, 1_usize, fif.maps.len());
    // as many steps as cells, and as many back
    while let Some((above, next)) = path.get_mut(level) {
        let j = *next;
        *next += 1;
        match (fif.maps.get(j), slopes.maps.get(j)) {
            (Some(map), Some(slope)) if (level as u32) < depth.min(DEEPEST as u32) => {
                let part = above.part(map, slope, (j, count));
                (level, count) = (level + 1, count.saturating_mul(maps));
                show(level as u32, &part);
                if let Some(below) = path.get_mut(level) {
                    *below = (part, 0);
                }
            }
            _ => match level.checked_sub(1) {
                Some(above) => (level, count) = (above, count.checked_div(maps).unwrap_or(1)),
                None => break,
            },
        }
    }
    Ok(())
}
