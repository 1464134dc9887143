//! The proof that an address has a point: products of the maps shrink what lies between two points.
//!
//! Two points of the barycentric space differ by a vector whose coordinates add up to 0. Such vectors with
//! `|v|_1 <= 2` are the mixtures of `e_i - e_j`, so that the norm of a matrix on them is
//! `max_ij |T e_i - T e_j|_1 / 2` (R. L. Dobrushin, 1956, "ergodic coefficient"), a finite maximum that
//! integers decide. The text has no such test: its words "contractive operator" and "attractor" need one.
//!
//! A word `w` of digits stands for the product `T_w`. Every address begins with a word of a finite list: from
//! the empty word on, each is lengthened by all digits until its product has a norm of at most `rho < 1`.
//! Where that comes to an end, with no word longer than `d`,
//!
//! - `T_s1 T_s2 ...` converges, at least by `rho` every `d` levels;
//! - every point `phi` has `|phi - c|_1 <= r`, `r = max_w |T_w c - c|_1 / (1 - |T_w|)`: the points no further
//!   from `c` are mapped among themselves by every word of the list, whose norm is `|T_w|`. So `|phi|_1` is
//!   at most `|c|_1 + r`, and `max_w |T_w c|_1 + rho r`. Any `c` will do: the mean of the ends or the corners
//!   tells most;
//! - `k d` levels leave an error of at most `rho^k r` times the difference of the greatest and the least
//!   control point.
//!
//! Words of unequal length prove with hundreds of products what all words of one length do not with
//! thousands: in a rough surface a few corners contract slowly. So with `r` too: a word that moves `c` little
//! may have a norm near to 1, and words are lengthened until the `r` of each is what is asked for.
//!
//! Formats: 28 fractional bits in 64; norms and radii are rounded up, with what the rounding of products
//! adds.

use super::barycentric::{Barycentric, ONE, wide};
use crate::Error;
use crate::num::formats::Q28;
use crate::num::{Near, Real, Wide, product, ratio};

/// The longest words, and how many products are tried for one norm.
const DEEPEST: usize = 12;
const MOST_PRODUCTS: usize = 4096;

/// The norms and the radii that are tried, 28 fractional bits, norms with what rounding upwards adds: small
/// ones tell most about where points are. A norm nearer to 1 than the last would take millions of levels; of
/// the radii the last is what the formats bear, as `|c|_1` is 1 or little more.
const ATTEMPTS: [(i64, i64); 4] = [
    ((1 << 26) + (1 << 15), 32 << 28),
    ((1 << 27) + (1 << 15), 32 << 28),
    ((3 << 26) + (1 << 15), 32 << 28),
    ((1 << 28) - (1 << 18), 27 << 27),
];

/// What an entry of a product is wrong by at most. Each factor adds half a unit, which the factors behind it
/// make `|T_v|_1` times as much, and that is at most [`Contraction::reach`] for any word `v`: 12 factors stay
/// within this bound if `reach` is at most a sixth of it, which is checked in the end. (Of words of `k`
/// digits this follows from what is known of shorter ones.)
const ERROR: i64 = 1 << 10;
const MOST_REACH: i64 = (2 * ERROR / DEEPEST as i64) << 28;

/// Weights of magnitudes below 15 in sum, which add up to 1, are below 8 each.
const MOST_SUM: i64 = 15 << 28;

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

/// The words of a proof.
struct Words {
    /// The length of the longest.
    depth: usize,
    /// The greatest norm of their products.
    norm: i64,
    /// Of their beginnings `v`, the empty one too: the greatest `|T_v e_k - c|_1` and `|T_v e_k|_1`.
    apart: i64,
    column: i64,
    /// The greatest `|T_w c - c|_1 / (1 - |T_w|)` and `|T_w c|_1`.
    radius: i64,
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

/// The mean of some points.
pub(super) fn mean<const J: usize, const K: usize>(points: [[Q28; J]; K]) -> [Near; J] {
    let mut mean = [Near::ZERO; J];
    for (k, place) in mean.iter_mut().enumerate() {
        let sum: i64 = points.iter().filter_map(|point| point.get(k)).map(|weight| i64::from(*weight)).sum();
        *place = Near::from_bits((sum.checked_div(K as i64).unwrap_or(0)) as i32);
    }
    mean
}

/// `max_ij |W e_i - W e_j|_1 / 2`, rounded up.
fn norm<const J: usize>(w: &Matrix<J>) -> i64 {
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
    (most >> 1).saturating_add(1).saturating_add(ERROR.saturating_mul(J as i64))
}

/// `|W c - c|_1` and `|W c|_1`, rounded up.
fn displacement<const J: usize>(w: &Matrix<J>, c: &[Near; J], size: i64) -> [i64; 2] {
    // an entry's error times the weights' size, and a unit for rounding
    let off = (J as i64).saturating_mul(1 + (ERROR.saturating_mul(size) >> 28) + 1);
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

/// `max_k |W e_k - c|_1` and `max_k |W e_k|_1`, rounded up.
fn columns<const J: usize>(w: &Matrix<J>, c: &[Near; J]) -> [i64; 2] {
    let mut most = [0; 2];
    for k in 0..J {
        let mut sums = [(J as i64).saturating_mul(ERROR); 2];
        for (row, own) in w.iter().zip(c) {
            let entry = row.get(k).copied().map_or(0, i64::from);
            for (sum, from) in sums.iter_mut().zip([i64::from(own.to_bits()), 0]) {
                *sum = sum.saturating_add(entry.saturating_sub(from).saturating_abs());
            }
        }
        for (most, sum) in most.iter_mut().zip(sums) {
            *most = sum.max(*most);
        }
    }
    most
}

/// Upwards: `a b` of numbers that are not negative, 28 fractional bits, saturated.
fn above(a: i64, b: i64) -> i64 {
    let exact = i128::from(a) * i128::from(b);
    i64::try_from((exact >> 28).saturating_add(1)).unwrap_or(i64::MAX)
}

/// `displacement / (1 - norm)`, rounded up.
fn radius(displacement: i64, norm: i64) -> i64 {
    let left = i64::from(ONE).saturating_sub(norm).max(1);
    let quotient = ratio(displacement.unsigned_abs(), 28, left.unsigned_abs());
    i64::try_from(quotient).unwrap_or(i64::MAX).saturating_add(1)
}

impl Words {
    /// Words whose products have a norm and a radius of at most so much, depth first; none where they are too
    /// many or too long, or where a product leaves the format.
    fn of<const J: usize>(
        maps: &[Barycentric<J>],
        (c, size): (&[Near; J], i64),
        (most_norm, most_radius): (i64, i64),
    ) -> Option<Self> {
        let [apart, column] = columns(Barycentric::IDENTITY.rows(), c);
        let mut found = Self { depth: 0, norm: 0, apart, column, radius: 0, sum: 0 };
        let mut stack = [[[0; J]; J]; DEEPEST];
        let mut word = [0_usize; DEEPEST];
        let (mut level, mut products) = (0_usize, 0_usize);
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
            products += 1;
            if products > MOST_PRODUCTS {
                return None;
            }
            let product = match level.checked_sub(1).and_then(|above| stack.get(above)) {
                Some(before) => times(before, map.rows())?,
                None => *map.rows(),
            };
            let norm = norm(&product);
            let near = (norm <= most_norm).then(|| displacement(&product, c, size));
            let near = near.map(|[displacement, sum]| (radius(displacement, norm), sum));
            if let Some((radius, sum)) = near.filter(|(radius, _)| *radius <= most_radius) {
                found.depth = found.depth.max(level + 1);
                found.norm = found.norm.max(norm);
                found.radius = found.radius.max(radius);
                found.sum = found.sum.max(sum);
                *next += 1;
            } else {
                let [apart, column] = columns(&product, c);
                found.apart = found.apart.max(apart);
                found.column = found.column.max(column);
                *stack.get_mut(level)? = product;
                level += 1;
                word.get(level)?;
            }
        }
    }
}

impl Contraction {
    /// Nothing proven yet.
    pub(super) const NONE: Self = Self { depth: 0, norm: 0, radius: 0, sum: 0, reach: 0 };

    /// The proof for some maps; `c` is a point in the midst of others.
    ///
    /// # Errors
    /// [`Error::NotContractive`] if words of up to 12 digits, and at most 4,096 products, prove nothing;
    /// [`Error::OutOfRange`] if weights are not proven to stay below 15 in sum, as the formats ask.
    #[inline(never)]
    pub(super) fn prove<const J: usize>(maps: &[Barycentric<J>], c: &[Near; J]) -> Result<Self, Error> {
        let size: i64 = c.iter().map(|weight| i64::from(weight.to_bits().unsigned_abs())).sum();
        let mut error = Error::NotContractive { map: 0 };
        for most in ATTEMPTS {
            let proof = Words::of(maps, (c, size), most).map(|words| Self::from_words(&words, size));
            match proof.filter(|proof| proof.reach <= MOST_REACH).map(Self::within_formats) {
                Some(Ok(proof)) => return Ok(proof),
                Some(Err(beyond)) => error = beyond,
                None => {}
            }
        }
        Err(error)
    }

    fn from_words(words: &Words, size: i64) -> Self {
        // phi = T_w c + T_w (phi' - c)
        let sum = words.sum.saturating_add(above(words.norm, words.radius));
        let sum = sum.min(size.saturating_add(words.radius));
        let radius = words.radius.min(sum.saturating_add(size));
        // any word is some of the list and a beginning v of one: T_v e_k is no further from c than `apart`,
        // nor, by what the radius says, is what the words before make of it; T_w p = T_w c + T_w (p - c)
        let apart = words.apart.max(words.radius);
        let reach = words.column.max(words.sum.saturating_add(above(words.norm, apart)));
        Self { depth: words.depth as u32, norm: words.norm, radius, sum, reach }
    }

    /// The proof for the tensor product of two systems:
    /// `x (x) y - x' (x) y' = (x - x') (x) y + x' (x) (y - y')`.
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
        if self.sum >= MOST_SUM {
            let (what, value) = ("sum of the magnitudes of weights", wide(self.sum));
            return Err(Error::OutOfRange {
                what,
                index: None,
                value,
                min: Wide::ZERO,
                max: const { Wide::lit("15") },
            });
        }
        Ok(self)
    }

    /// The longest of the words with which every address begins, whose products have a norm of at most
    /// [`Contraction::norm`].
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// The greatest norm of the product of such a word on vectors that add up to 0, rounded up; below 1.
    pub fn norm(&self) -> Near {
        Near::from_bits(self.norm as i32)
    }

    /// How far any point lies from the mean `c` of the ends or the corners at most, `|phi - c|_1`; below 32.
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

    /// The least `g` with `2^g` above what weights of any word can be in sum, a part in 256 to spare: how
    /// many bits heights need above their own.
    pub(super) const fn headroom(&self) -> u32 {
        let most = self.reach.saturating_add(self.reach >> 8).unsigned_abs();
        (u64::BITS - most.leading_zeros()).saturating_sub(28)
    }

    /// How far points of the part with these control points can be from the mean of its corners, 24
    /// fractional bits, rounded up: `r / 2` times the difference of the greatest and the least.
    #[inline(always)]
    pub(super) fn half_width(&self, spread: u32) -> u32 {
        // radius < 2^33: a quarter of it times 2^32 fits
        let quarter = ((self.radius as u64) >> 2).saturating_add(1);
        u32::try_from(quarter.saturating_mul(spread.into()) >> 27).unwrap_or(u32::MAX).saturating_add(1)
    }

    /// How many levels leave an error below `2^-24` for control points that differ by at most `spread`.
    pub fn levels(&self, spread: Real) -> u32 {
        // between two points: twice the radius
        let mut off = i128::from(self.half_width(spread.to_bits().unsigned_abs())) << 29;
        let mut levels = 0_u32;
        // a norm of at most 1 - 2^-10 ends it after 40,000 rounds
        while off >= 1 << 28 && levels < 1 << 20 {
            off = (off * i128::from(self.norm)) >> 28;
            levels += self.depth;
        }
        levels
    }
}
