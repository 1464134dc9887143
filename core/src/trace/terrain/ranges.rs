//! Bounds of the heights of squares of cells, in lent memory: a plane, and how far heights lie from it.
//!
//! A side of a node has four times as many cells as one of its parts, and the coarsest level has at most
//! 16 x 16 nodes. A plane follows a slope, from which the ground strays by little: most nodes that a ray
//! comes near are passed by for certain. The bounds of a cell are those of the Bezier points of its patch
//! less the plane, which are rigorous; those of a node are those of its parts' corners, and how far heights
//! lie from theirs. Levels stand one behind the other, cells first.
//!
//! Source: J. T. Kajiya, T. L. Kay, "Rendering complex scenes", 1986 (slabs); for the fit, a plane by least
//! squares over a regular grid.
//!
//! Format: 16 bits a number, in units of the terrain's own, a power of two; none is below `2^-18`, so that a
//! unit is more than what arithmetic along a ray adds.

use crate::num::formats::{Q14, Q24};
use crate::num::{Real, product_u};
use crate::terrain::{Heights, InnerGeometry, Patch, differences};

/// Bounds of the heights above a square: `corner + along_u s + along_v t`, and at most `off` more or less,
/// for `s` and `t` from its corner on, in cells;
/// for a cell also an eighth of `max(|h_ss|, |h_tt|) + |h_st|`: at most 7.5 times the greatest height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HeightRange {
    corner: i16,
    along_u: i16,
    along_v: i16,
    off: i16,
    bend: u16,
}

/// How far a piece of a ray is over a plane at both ends, and how far heights lie from that.
#[derive(Debug, Clone, Copy)]
pub(super) struct Doubt {
    ends: [Q14; 2],
    off: Q14,
}

impl Doubt {
    /// On which side the ray begins, if that is certain, and the piece between two parameters as far as it is
    /// not.
    #[inline(always)]
    pub(super) fn narrowed(&self, [t, out]: [Q24; 2]) -> (Option<bool>, [Q24; 2]) {
        let Self { ends: [a, b], off } = *self;
        // as if it came from above
        let (first, last) = if a < b { (-a, -b) } else { (a, b) };
        let whole = first.abs_diff(last);
        // to 16 bits, so that 16 more fit: a part is 3 units too small at most, or 2 too large
        let shift = 16_u32.saturating_sub(whole.leading_zeros());
        let part = |way: i32| {
            let way = (way.max(0) as u32).min(whole) >> shift;
            (way << 16).checked_div(whole >> shift).unwrap_or(0)
        };
        let begin = part(first.saturating_sub(off)).saturating_sub(2);
        let end = part(first.saturating_add(off)) + 4;
        let time = out.wrapping_sub(t) as u32;
        let after = |part: u32| t.wrapping_add((product_u(time, part) >> 16) as i32);
        ((first > off).then_some(a > 0), [after(begin), if end < 1 << 16 { after(end) } else { out }])
    }
}

/// From one level to the next a side has so many times as many cells: `2^STEP`.
pub(super) const STEP: u32 = 2;
/// How many parts a node has along a side.
pub(super) const PARTS: u32 = 1 << STEP;
/// The coarsest level has at most so many nodes along a side.
const WIDEST: u32 = 16;
/// Levels of the most cells, 2^16 along a side.
pub(super) const LEVELS: usize = 7;
/// Heights in units have so many bits.
const BITS: u32 = 13;
/// The least unit, 24 fractional bits as a power of two: 2^-18.
const LEAST: u32 = 6;

impl HeightRange {
    /// Above (`true`) or below all heights, for both ends of a piece of a ray: `s` and `t` with 14 fractional
    /// bits, and the height in units with as many. In case of doubt how far both ends are over
    /// the plane, and how far that is from heights.
    #[inline(always)]
    pub(super) fn side(&self, ends: [[Q14; 3]; 2]) -> Result<bool, Doubt> {
        let [corner, along_u, along_v] = [self.corner, self.along_u, self.along_v].map(i32::from);
        // a plane stays below 2^17 units, and a square is left by less than its own width
        let over = |[s, t, z]: [Q14; 3]| {
            z.wrapping_sub(corner << 14)
                .wrapping_sub(along_u.wrapping_mul(s))
                .wrapping_sub(along_v.wrapping_mul(t))
        };
        let ([a, b], off) = (ends.map(over), i32::from(self.off) << 14);
        if a.min(b) > off {
            Ok(true)
        } else if a.max(b) < -off {
            Ok(false)
        } else {
            Err(Doubt { ends: [a, b], off })
        }
    }

    /// An eighth of how much the patch of a cell bends, 24 fractional bits, saturated.
    #[inline(always)]
    pub(super) fn bend(&self, unit: u32) -> u32 {
        let bend = u32::from(self.bend);
        if bend.leading_zeros() < unit { u32::MAX } else { bend << (unit & 31) }
    }

    /// The plane of these slopes for a square of `2^level` cells a side in the middle of all heights, which
    /// are given less the plane with 14 fractional bits.
    fn round(along: [i64; 2], level: u32, [low, high]: [i64; 2], loose: u32) -> Self {
        let middle = (low + high) >> 1;
        let corner = middle >> 14;
        let off = ((high - (corner << 14)).max((corner << 14) - low) + (1 << 14) - 1) >> 14;
        // what places may be off by, and what arithmetic along a ray adds
        let slack = ((along[0].abs() + along[1].abs()) >> loose) + 1;
        let word = |c: i64| c.clamp(i64::from(i16::MIN), i64::from(i16::MAX)) as i16;
        let [along_u, along_v] = along.map(|c| word(c >> level));
        Self { corner: word(corner), along_u, along_v, off: word(off + slack), bend: 0 }
    }

    /// The plane above a place, both with 14 fractional bits.
    fn plane(&self, s: i64, t: i64) -> i64 {
        (i64::from(self.corner) << 14) + i64::from(self.along_u) * s + i64::from(self.along_v) * t
    }
}

/// Slopes over `2^level` cells that are whole numbers a cell and leave room for all sums; else none, which
/// bounds as well.
fn slopes(along: [i64; 2], level: u32) -> [i64; 2] {
    let along = along.map(|c| c >> level << level);
    if along[0].abs() + along[1].abs() < 1 << (BITS + 1) { along } else { [0; 2] }
}

/// How many nodes a level has along an axis.
pub(super) const fn nodes(cells: u32, level: u32) -> u32 {
    ((cells - 1) >> level) + 1
}

/// The coarsest level.
pub(super) const fn top(columns: u32, rows: u32) -> u32 {
    let cells = if columns > rows { columns } else { rows };
    let mut level = 0;
    while nodes(cells, level) > WIDEST {
        level += STEP;
    }
    level
}

/// How many bounds there are, for so many columns and rows of cells.
pub(super) const fn count(columns: u32, rows: u32) -> usize {
    let (mut sum, mut level) = (0, 0);
    while level <= top(columns, rows) {
        sum += nodes(columns, level) as usize * nodes(rows, level) as usize;
        level += STEP;
    }
    sum
}

/// Where the levels begin.
pub(super) fn begins(columns: u32, rows: u32) -> [u32; LEVELS] {
    let (mut sum, mut level) = (0_u32, 0);
    [(); LEVELS].map(|()| {
        let begin = sum;
        sum = sum.wrapping_add(nodes(columns, level).wrapping_mul(nodes(rows, level)));
        level += STEP;
        begin
    })
}

/// The unit of these heights, as a power of two of `2^-24`.
pub(super) fn unit([low, high]: [Q24; 2]) -> u32 {
    let most = low.unsigned_abs().max(high.unsigned_abs());
    (32 - most.leading_zeros()).saturating_sub(BITS).max(LEAST)
}

/// The least and the greatest height of all patches.
///
/// # Errors
/// The height of a patch beyond ±64.
pub(super) fn whole(heights: &Heights<'_>, inner: InnerGeometry) -> Result<[Q24; 2], Real> {
    let (columns, rows) = (heights.columns() - 1, heights.rows() - 1);
    let [mut low, mut high] = [i32::MAX, i32::MIN];
    for row in 0..rows {
        for column in 0..columns {
            let [least, most] = inner.patch(heights, column, row).range().map(Real::to_bits);
            (low, high) = (low.min(least), high.max(most));
        }
    }
    let limit = 64 << 24;
    match [low, high].into_iter().find(|h| h.unsigned_abs() >= limit) {
        Some(height) => Err(Real::from_bits(height)),
        None => Ok([low, high]),
    }
}

/// Fills in the bounds of all levels in this unit. Places inside a square are known to `2^-loose` of it.
pub(super) fn fill(
    heights: &Heights<'_>,
    inner: InnerGeometry,
    (unit, loose): (u32, u32),
    ranges: &mut [HeightRange],
) {
    let (columns, rows) = (heights.columns() - 1, heights.rows() - 1);
    let mut places = ranges.iter_mut();
    for row in 0..rows {
        for (column, place) in (0..columns).zip(&mut places) {
            *place = cell(&inner.patch(heights, column, row), (unit, loose));
        }
    }
    let begins = begins(columns, rows).map(|begin| begin as usize);
    let levels = (STEP..=top(columns, rows)).step_by(STEP as usize);
    for (level, (from, to)) in levels.zip(begins.into_iter().zip(begins.into_iter().skip(1))) {
        let (across, down) = (nodes(columns, level - STEP), nodes(rows, level - STEP));
        let (below, own) = ranges.split_at_mut_checked(to).unwrap_or_default();
        let below = below.get(from..).unwrap_or_default();
        let mut own = own.iter_mut();
        for j in 0..nodes(rows, level) {
            for (i, place) in (0..nodes(columns, level)).zip(&mut own) {
                let (i, j) = (PARTS * i, PARTS * j);
                let (wide, high) = (PARTS.min(across - i), PARTS.min(down - j));
                let part = |k: u32, l: u32| {
                    below.get(((j + l) * across + i + k) as usize).copied().unwrap_or_default()
                };
                *place = node([wide, high], level, part, loose);
            }
        }
    }
}

/// The bounds of a patch.
fn cell(patch: &Patch, (unit, loose): (u32, u32)) -> HeightRange {
    // 14 fractional bits of a unit, which is one of 2^6 at least
    let points = patch.points().map(|row| row.map(|h| ((i64::from(h) << 14) >> unit) as i32));
    let [[a, _, _, b], .., [c, _, _, d]] = points;
    let along = slopes([b - a + d - c, c - a + d - b].map(|twice| i64::from(twice >> 15)), 0);
    let [along_u, along_v] = along.map(|c| (c << 14) as i32);
    // three times what is over the plane: below 2^31
    let (mut low, mut high) = (i32::MAX, i32::MIN);
    for (row, t) in points.iter().zip(0..) {
        for (height, s) in row.iter().zip(0..) {
            let over = 3 * height - along_u * s - along_v * t;
            (low, high) = (low.min(over), high.max(over));
        }
    }
    let range = HeightRange::round(along, 0, [low / 3 - 1, high / 3 + 1].map(i64::from), loose);
    // second derivatives are 6, 9 and 6 times the differences, which are known to a sixteenth of a unit and
    // below 4 times 2^13
    let [ss, st, tt] = differences(&points).map(|c| (c >> 10) + 1);
    let bend = ((6 * ss.max(tt) + 9 * st) >> 7) + 1;
    HeightRange { bend: u16::try_from(bend).unwrap_or(u16::MAX), ..range }
}

/// The bounds of a node of so many parts along both axes.
fn node(
    [wide, high]: [u32; 2],
    level: u32,
    part: impl Fn(u32, u32) -> HeightRange,
    loose: u32,
) -> HeightRange {
    let parts = || (0..high).flat_map(|l| (0..wide).map(move |k| (k, l)));
    let side = 1_i64 << (14 + level - STEP);
    // least squares over the middles of the parts
    let (mut along_u, mut along_v) = (0, 0);
    for (k, l) in parts() {
        let middle = part(k, l).plane(side >> 1, side >> 1) >> 14;
        along_u += (2 * i64::from(k) + 1 - i64::from(wide)) * middle;
        along_v += (2 * i64::from(l) + 1 - i64::from(high)) * middle;
    }
    let fit = |sum: i64, n: u32, m: u32| {
        let (n, m) = (i64::from(n), i64::from(m));
        (6 * i64::from(PARTS) * sum).checked_div(m * n * (n * n - 1)).unwrap_or(0)
    };
    let along = slopes([fit(along_u, wide, high), fit(along_v, high, wide)], level);
    let (mut least, mut most) = (i64::MAX, i64::MIN);
    for (k, l) in parts() {
        let part = part(k, l);
        let off = i64::from(part.off) << 14;
        for (right, up) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let [s, t] = [k + right, l + up].map(|c| i64::from(c) << (14 - STEP));
            let over =
                part.plane(i64::from(right) * side, i64::from(up) * side) - along[0] * s - along[1] * t;
            (least, most) = (least.min(over - off), most.max(over + off));
        }
    }
    HeightRange::round(along, level, [least, most], loose)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Unit;
    use std::vec::Vec;

    /// No height of a patch lies farther from the plane of its cell, or of any node above it, than is said;
    /// some lie nearly as far.
    #[test]
    fn heights_are_within_the_bounds_of_their_cell_and_of_all_nodes_above() {
        let mut word = 5_u64;
        let mut random = || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word >> 11) as f64 / 2.0_f64.powi(53)
        };
        let geometries = [InnerGeometry::Bilinear, InnerGeometry::Ferguson, InnerGeometry::BSpline];
        // columns and rows that nodes do not go into evenly as well, flat land, and steps of 40
        for (columns, rows, rough, tilt) in [(67, 23, 0.3, 0.05), (21, 5, 20.0, 0.0), (18, 18, 1e-6, 0.02)] {
            let heights: Vec<Real> = (0..rows * columns)
                .map(|k| Real::from_num(rough * (2.0 * random() - 1.0) + tilt * f64::from(k % columns)))
                .collect();
            let heights = Heights::new(columns, rows, &heights).unwrap();
            let (across, down) = (columns - 1, rows - 1);
            for inner in geometries {
                let unit = unit(whole(&heights, inner).unwrap());
                let mut ranges = std::vec![HeightRange::default(); count(across, down)];
                fill(&heights, inner, (unit, 10), &mut ranges);
                let begins = begins(across, down);
                let mut farthest = Vec::new();
                for level in (0..=top(across, down)).step_by(STEP as usize) {
                    let mut most = 0.0_f64;
                    for (row, column) in (0..down).flat_map(|row| (0..across).map(move |c| (row, c))) {
                        let patch = inner.patch(&heights, column, row);
                        let (i, j) = (column >> level, row >> level);
                        let begin = begins[(level / STEP) as usize];
                        let range = ranges[(begin + j * nodes(across, level) + i) as usize];
                        for (s, t) in (0..=4).flat_map(|s| (0..=4).map(move |t| (s, t))) {
                            let part = |c: i64| Unit::from_bits((c << 28) as i32);
                            let height = i64::from(patch.height(part(s), part(t)).to_bits()) << 14 >> unit;
                            let from = |c: u32, node: u32, part: i64| {
                                (i64::from(c - (node << level)) << 14) + (part << 12)
                            };
                            let over = height - range.plane(from(column, i, s), from(row, j, t));
                            let part = over.abs() as f64 / (i64::from(range.off) << 14) as f64;
                            assert!(part <= 1.0, "{inner:?} {level} {column} {row} {s} {t}: {part}");
                            most = most.max(part);
                        }
                    }
                    farthest.push(most);
                }
                std::println!("{columns} x {rows} {inner:?}: parts of the bounds by levels {farthest:?}");
                // nearly flat patches are bounded by what arithmetic adds
                assert!(rough < 1e-3 || farthest.iter().all(|most| *most > 0.5), "{farthest:?}");
            }
        }
    }

    /// What is said of how much a patch bends bounds `(h(a) - 2 h(m) + h(b)) / 2` for any way across it, and
    /// is that where a patch bends in one way alone: along an axis, or by its twist. Summits along both axes
    /// have their greatest bends at either end of a patch; chequered land, 47 high and low, bends by more at
    /// its corners than a word says.
    #[test]
    fn a_patch_bends_by_no_more_than_is_said() {
        type Land = fn([i32; 2]) -> i32;
        // heights in twentieths, and the part of the bound that each inner geometry comes to at least
        let lands: [(Land, [f64; 3]); 6] = [
            (|[i, j]| (6 * j + i).pow(2) * 7 % 31 - 15, [0.6, 0.4, 0.4]),
            (|[i, _]| i * i, [0.0, 0.98, 0.98]),
            (|[_, j]| j * j, [0.0, 0.98, 0.98]),
            (|[i, j]| i * j, [0.98, 0.2, 0.98]),
            (|[i, j]| if (i, j) == (2, 3) { 20 } else { 0 }, [0.98, 0.3, 0.4]),
            (|[i, j]| if (i + j) % 2 > 0 { 940 } else { -940 }, [0.98, 0.3, 0.4]),
        ];
        let geometries = [InnerGeometry::Bilinear, InnerGeometry::Ferguson, InnerGeometry::BSpline];
        let mut saturated = 0;
        for (number, (land, least)) in lands.into_iter().enumerate() {
            let heights: Vec<Real> =
                (0..36).map(|k: i32| Real::from_num(f64::from(land([k % 6, k / 6])) / 20.0)).collect();
            let heights = Heights::new(6, 6, &heights).unwrap();
            for (inner, least) in geometries.into_iter().zip(least) {
                let unit = unit(whole(&heights, inner).unwrap());
                let mut ranges = std::vec![HeightRange::default(); count(5, 5)];
                fill(&heights, inner, (unit, 10), &mut ranges);
                let mut nearest = 0.0_f64;
                for (row, column) in (0..5_u32).flat_map(|row| (0..5).map(move |column| (row, column))) {
                    let patch = inner.patch(&heights, column, row);
                    let eighth = f64::from(ranges[(5 * row + column) as usize].bend(unit));
                    saturated += u32::from(eighth == f64::from(u32::MAX));
                    let at = |s: i32, t: i32| {
                        f64::from(patch.height(Unit::from_bits(s << 27), Unit::from_bits(t << 27)).to_bits())
                    };
                    for k in 0..9_i32.pow(4) {
                        let [s, t, u, v] = [0, 1, 2, 3].map(|place| k / 9_i32.pow(place) % 9);
                        if (s + u) % 2 > 0 || (t + v) % 2 > 0 {
                            continue;
                        }
                        let middle = at((s + u) / 2, (t + v) / 2);
                        let sagitta = (at(s, t) - 2.0 * middle + at(u, v)).abs() / 2.0;
                        let way = f64::from((u - s).pow(2) + (v - t).pow(2)) / 64.0;
                        assert!(
                            sagitta <= eighth * way + 16.0,
                            "{number} {inner:?} {column} {row}: {sagitta} above {}",
                            eighth * way
                        );
                        if way > 0.2 {
                            nearest = nearest.max(sagitta / (eighth * way));
                        }
                    }
                }
                std::println!("{number} {inner:?}: {nearest:.3} of the bound");
                assert!(nearest >= least, "{number} {inner:?} {nearest}");
            }
        }
        assert!(saturated >= 4, "{saturated}");
    }
}
