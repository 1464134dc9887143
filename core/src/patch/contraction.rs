//! The proof that an address has a point: products of the maps shrink what lies between two points.
//!
//! Two points of the barycentric space differ by a vector whose coordinates add up to 0. Such vectors with
//! `|v|_1 <= 2` are the mixtures of `e_i - e_j`, so that the norm of a matrix on them is
//! `max_ij |T e_i - T e_j|_1 / 2` (R. L. Dobrushin, 1956, "ergodic coefficient"), a finite maximum that
//! integers decide. The text has no such test: its sentences "contractive operator" and "attractor" need one.
//! Where every product of `d` maps has a norm of at most `rho < 1`,
//!
//! - `T_s1 T_s2 ...` converges, at least by `rho` every `d` levels;
//! - every point `phi` has `|phi - c_0|_1 <= r`, `r = max_w |T_w c_0 - c_0|_1 / (1 - rho)`, and
//!   `|phi|_1 <= max_w |T_w c_0|_1 + rho r`, `|w| = d`;
//! - `k d` levels leave an error of at most `rho^k r / 2` times the difference of the greatest and the least
//!   control point.
//!
//! Formats: 28 fractional bits in 64; norms and radii are rounded up, with what the rounding of products adds.

use super::barycentric::{Barycentric, ONE, wide};
use crate::Error;
use crate::num::formats::Q28;
use crate::num::{Near, Real, Wide, product, ratio};

/// The longest products that are tried, and how many of one length.
const DEEPEST: usize = 6;
const MOST_PRODUCTS: usize = 4096;

/// A half, and what rounding a norm upwards adds. Deeper products are not looked at where those of a depth have
/// such norms and weights are proven to add up to no more than 5/2 in magnitude: then
/// those of a product of two curves are below 8.
const AMPLE_SUM: i64 = 5 << 27;
const HALF: i64 = (1 << 27) + (1 << 10);

/// The greatest norm that proves something, `1 - 2^-10`: one nearer to 1 would take millions of levels.
const MOST_NORM: i64 = (1 << 28) - (1 << 18);

/// How fast the maps of a curve or a surface contract, and how far their weights reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Contraction {
    depth: u32,
    /// 28 fractional bits.
    norm: i64,
    radius: i64,
    /// The most that `|phi|_1` is.
    sum: i64,
    /// The most that `|T_w e_k|_1` is, `w` any word.
    reach: i64,
}

/// All products of up to `depth` maps of a system.
struct Products<const J: usize> {
    /// The greatest norm of those of `depth` maps, and of shorter ones.
    norm: i64,
    shorter: i64,
    /// The greatest `|T_w c_0 - c_0|_1` and `|T_w c_0|_1` of those of `depth` maps.
    displacement: i64,
    sum: i64,
}

type Matrix<const J: usize> = [[Q28; J]; J];

/// `W T`, each entry rounded to nearest; none where an entry leaves the format.
fn times<const J: usize>(w: &Matrix<J>, t: &Matrix<J>) -> Option<Matrix<J>> {
    let mut result = [[0; J]; J];
    for (row, from) in result.iter_mut().zip(w) {
        let mut sums = [1_i64 << 27; J];
        for (entry, other) in from.iter().zip(t) {
            for (sum, entry2) in sums.iter_mut().zip(other) {
                *sum = sum.checked_add(product(*entry, *entry2))?;
            }
        }
        for (entry, sum) in row.iter_mut().zip(sums) {
            *entry = i32::try_from(sum >> 28).ok()?;
        }
    }
    Some(result)
}

/// `max_ij |W e_i - W e_j|_1 / 2`, rounded up, for entries that are known to `error` units.
fn norm<const J: usize>(w: &Matrix<J>, error: i64) -> i64 {
    let mut most = 0_i64;
    for i in 0..J {
        for j in 0..i {
            let apart = |row: &[Q28; J]| match (row.get(i), row.get(j)) {
                (Some(a), Some(b)) => i64::from(a.abs_diff(*b)),
                _ => 0,
            };
            most = most.max(w.iter().map(apart).sum());
        }
    }
    (most >> 1).saturating_add(1).saturating_add(error.saturating_mul(J as i64))
}

/// `|W c - c|_1` and `|W c|_1`, rounded up.
fn displacement<const J: usize>(w: &Matrix<J>, c: &[Near; J], error: i64, size: i64) -> [i64; 2] {
    // an entry's error times the weights' size, and a unit for rounding
    let off = (J as i64).saturating_mul(1 + (error.saturating_mul(size) >> 28) + 1);
    let mut sums = [off; 2];
    for (row, own) in w.iter().zip(c) {
        let mut image = 1_i64 << 27;
        for (entry, weight) in row.iter().zip(c) {
            image = image.saturating_add(product(*entry, weight.to_bits()));
        }
        let image = image >> 28;
        for (sum, from) in sums.iter_mut().zip([own.to_bits().into(), 0]) {
            *sum = sum.saturating_add(image.saturating_sub(from).saturating_abs());
        }
    }
    sums
}

/// The greatest `|T e_k|_1` of some maps.
fn column_norm<const J: usize>(maps: &[Barycentric<J>]) -> i64 {
    let column = |map: &Barycentric<J>, k: usize| -> i64 {
        map.rows().iter().filter_map(|row| row.get(k)).map(|entry| i64::from(entry.unsigned_abs())).sum()
    };
    maps.iter().flat_map(|map| (0..J).map(move |k| column(map, k))).max().unwrap_or(0)
}

/// Upwards: `a b` of numbers that are not negative, 28 fractional bits, saturated.
fn above(a: i64, b: i64) -> i64 {
    let exact = i128::from(a) * i128::from(b);
    i64::try_from((exact >> 28).saturating_add(1)).unwrap_or(i64::MAX)
}

impl<const J: usize> Products<J> {
    /// Every word of `depth` maps, depth first; none where a product leaves the format.
    fn of(maps: &[Barycentric<J>], c: &[Near; J], size: i64, depth: usize) -> Option<Self> {
        let column = column_norm(maps);
        // what an entry of a product of so many maps is wrong by: e' = e |T|_1 + 1/2
        let mut errors = [0_i64; DEEPEST];
        for k in 1..DEEPEST {
            let before = errors.get(k.wrapping_sub(1)).copied().unwrap_or(0);
            if let Some(error) = errors.get_mut(k) {
                *error = above(before, column).saturating_add(1);
            }
        }
        let mut found = Self { norm: 0, shorter: ONE.into(), displacement: 0, sum: 0 };
        let mut stack = [[[0; J]; J]; DEEPEST];
        let mut word = [0_usize; DEEPEST];
        let mut level = 0_usize;
        loop {
            let next = word.get_mut(level)?;
            let Some(map) = maps.get(*next) else {
                // all maps tried here: back to the level above
                *next = 0;
                match level.checked_sub(1) {
                    Some(above) => level = above,
                    None => return Some(found),
                }
                *word.get_mut(level)? += 1;
                continue;
            };
            let product = match level.checked_sub(1).and_then(|above| stack.get(above)) {
                Some(before) => times(before, map.rows())?,
                None => *map.rows(),
            };
            let error = errors.get(level).copied().unwrap_or(i64::MAX);
            let norm = norm(&product, error);
            if level + 1 == depth {
                found.norm = found.norm.max(norm);
                let [displacement, sum] = displacement(&product, c, error, size);
                found.displacement = found.displacement.max(displacement);
                found.sum = found.sum.max(sum);
                *next += 1;
            } else {
                found.shorter = found.shorter.max(norm);
                *stack.get_mut(level)? = product;
                level += 1;
            }
        }
    }
}

impl Contraction {
    /// Nothing proven yet.
    pub(super) const NONE: Self = Self { depth: 0, norm: 0, radius: 0, sum: 0, reach: 0 };

    /// The proof for some maps and the point `c_0` that the first one fixes.
    ///
    /// # Errors
    /// [`Error::NotContractive`] if no depth up to 6 at which there are at most 4,096 products proves it;
    /// [`Error::OutOfRange`] if weights are not proven to stay below 8 in sum, as the formats ask.
    #[inline(never)]
    pub(super) fn prove<const J: usize>(maps: &[Barycentric<J>], c: &[Near; J]) -> Result<Self, Error> {
        let size: i64 = c.iter().map(|weight| i64::from(weight.to_bits().unsigned_abs())).sum();
        let mut proven = None;
        for depth in 1..=DEEPEST {
            let products = maps.len().checked_pow(depth as u32);
            if products.is_none_or(|count| count > MOST_PRODUCTS) {
                break;
            }
            let Some(products) = Products::of(maps, c, size, depth) else { break };
            if products.norm <= MOST_NORM {
                let better = Self::from_products(depth as u32, &products, size);
                // a deeper proof may show that weights stay nearer
                if proven.is_none_or(|other: Self| better.sum < other.sum) {
                    proven = Some(better);
                }
                if products.norm <= HALF && better.sum <= AMPLE_SUM {
                    break;
                }
            }
        }
        proven.ok_or(Error::NotContractive { map: 0 })?.within_formats()
    }

    fn from_products<const J: usize>(depth: u32, products: &Products<J>, size: i64) -> Self {
        let left = i64::from(ONE).saturating_sub(products.norm).max(1);
        let quotient = ratio(products.displacement.unsigned_abs(), 28, left.unsigned_abs());
        let radius = i64::try_from(quotient).unwrap_or(i64::MAX).saturating_add(1);
        // phi = T_w c + T_w (phi' - c)
        let sum = products.sum.saturating_add(above(products.norm, radius));
        let radius = radius.min(sum.saturating_add(size));
        // T_w e_k = T_w c + T_w (e_k - c): a point, and what its norm leaves of a vector of at most 1 + |c|
        let between = above(products.shorter, size.saturating_add(ONE.into()));
        Self { depth, norm: products.norm, radius, sum, reach: sum.saturating_add(between) }
    }

    /// The proof for the tensor product of two systems: `x (x) y - x' (x) y' = (x - x') (x) y + x' (x) (y - y')`.
    ///
    /// # Errors
    /// As [`Contraction::prove`].
    pub(super) fn times(&self, other: &Self) -> Result<Self, Error> {
        let (a, b) = (self, other);
        let radius = above(a.radius, b.sum).saturating_add(above(a.sum, b.radius));
        let depth = if a.depth == b.depth { a.depth } else { a.depth * b.depth };
        let (norm, sum) = (a.norm.max(b.norm), above(a.sum, b.sum));
        let radius = radius.min(sum.saturating_add(above(a.sum, b.sum)));
        Self { depth, norm, radius, sum, reach: above(a.reach, b.reach) }.within_formats()
    }

    fn within_formats(self) -> Result<Self, Error> {
        if self.sum >= 8 << 28 {
            let (what, value) = ("sum of the magnitudes of weights", wide(self.sum));
            return Err(Error::OutOfRange { what, index: None, value, min: Wide::ZERO, max: Wide::lit("8") });
        }
        Ok(self)
    }

    /// The depth `d` at which every product has a norm of at most [`Contraction::norm`].
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// The greatest norm of a product of `depth` maps on vectors that add up to 0, rounded up; below 1.
    pub fn norm(&self) -> Near {
        Near::from_bits(self.norm as i32)
    }

    /// How far any point lies from `c_0` at most, `|phi - c_0|_1`; below 16.
    pub fn radius(&self) -> Wide {
        wide(self.radius)
    }

    /// The most that a control point can be, if no corner's is beyond `most`: so much that no product with
    /// them leaves its format.
    pub(super) fn allows(&self, magnitude: i64) -> bool {
        // 24 fractional bits
        above(self.reach, magnitude) < 1 << 31
    }

    /// The greatest control point that is allowed.
    pub(super) fn most(&self) -> Wide {
        let most = ratio(1 << 31, 28, self.reach.unsigned_abs());
        Wide::from_bits(i64::try_from(most).unwrap_or(i64::MAX).saturating_mul(1 << 24))
    }

    /// How far points of the part with these control points can be from the image of `c_0`, 24 fractional
    /// bits, rounded up: `r / 2` times the difference of the greatest and the least.
    #[inline(always)]
    pub(super) fn half_width(&self, spread: u32) -> u32 {
        // radius < 2^32, spread < 2^32
        let product = (self.radius as u64).wrapping_mul(spread.into());
        u32::try_from(product >> 29).unwrap_or(u32::MAX).saturating_add(1)
    }

    /// How many levels leave an error below `2^-24` for control points that differ by at most `spread`.
    pub fn levels(&self, spread: Real) -> u32 {
        let mut off = i128::from(self.half_width(spread.to_bits().unsigned_abs())) << 28;
        let mut levels = 0_u32;
        // a norm of at most 1 - 2^-10 ends it after 40,000 rounds
        while off >= 1 << 28 && levels < 1 << 20 {
            off = (off * i128::from(self.norm)) >> 28;
            levels += self.depth;
        }
        levels
    }
}
