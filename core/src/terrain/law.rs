//! The law of displacement of a surface: how far a midpoint lies from the mean of its neighbours.
//!
//! A cell at level `k` has sides of `2^-k` knots. Halving it displaces the middle of each edge by `o_k R` and
//! the centre by `o_k (R_1 + R_2)`, with the offsets `o_k = o 2^(-H k)`: `o` says how rough the surface is,
//! the similarity exponent `H` how much of that is left at small scales. `H` = 1 is the text's
//! `o (t_2 - t_1) R`.
//!
//! Creases belong to the rule: lines that were born early stay visible. The mean square of the second
//! difference across lines born at a step of 64 is 3.7 times that across lines born last for `H` = 1, and 1.6
//! times for `H` = 0.7 (`the_creases_of_the_rule_are_as_published`, 12 surfaces).
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980 ("adding the result":
//! the centre is the mean of the midpoints of both midlines, and both displacements are added); M. F.
//! Barnsley et al., "The Science of Fractal Images", 1988, section 1.4.3.
//!
//! Formats: heights 24 fractional bits, offsets and deviates 28; one rounding a midpoint.

use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Deviate, Real, Unit, Wide, checked_offset, decay, offsets, product, product_u};

/// How often a cell between four knots can be halved: coordinates have 16 fractional bits.
pub const LEVELS: u32 = 16;

/// More than the largest deviate, 28 fractional bits.
const LARGEST: i64 = 888_000_000;

/// How rough a surface is. Size: 64 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Law {
    offsets: [Q28; LEVELS as usize],
}

impl Law {
    /// The law of an offset `o` and a similarity exponent `H`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an offset outside `0 .. 2` or an exponent outside `0 ..= 1`.
    pub fn new(offset: Unit, similarity: Unit) -> Result<Self, Error> {
        if similarity < Unit::ZERO || similarity > Unit::ONE {
            return Err(Error::OutOfRange {
                what: "similarity exponent",
                index: None,
                value: Wide::from(similarity),
                min: Wide::ZERO,
                max: Wide::ONE,
            });
        }
        let decay = decay(Real::from_bits(similarity.to_bits() >> 5));
        Ok(Self { offsets: offsets(checked_offset(offset)?, decay) })
    }

    /// The offset at a level; 0 from level 16 on.
    pub fn offset(&self, level: u32) -> Unit {
        Unit::from_bits(self.at(level).saturating_mul(4))
    }

    /// That of the level above the first, `o 2^H`: what a surface was displaced by of which the knots are the
    /// midpoints. 28 fractional bits, saturated.
    pub(super) fn above(&self) -> Q28 {
        let [first, second, ..] = self.offsets;
        let above = product(first, first).checked_div(i64::from(second).max(1)).unwrap_or(0);
        above.min(i64::from(i32::MAX)) as i32
    }

    /// Those of all levels.
    #[inline(always)]
    pub(super) fn offsets(&self) -> &[Q28; LEVELS as usize] {
        &self.offsets
    }

    #[inline(always)]
    pub(super) fn at(&self, level: u32) -> Q28 {
        self.offsets.get(level as usize).copied().unwrap_or(0)
    }

    /// How far heights inside a cell at one level can lie outside those of its corners, down to another
    /// level, as an upper bound (`the_reach_of_a_law_is_an_upper_bound`).
    ///
    /// No surface is higher than that of four corners at 0 whose displacements are all the largest one `R`,
    /// and that one is known: a level adds `o_k R (a + b + a b)`, where `a` and `b` are how far a place is
    /// from the edges of the level's cells, 1 in the middle. Since `2 a b <= a^2 + b^2` it is highest where
    /// `a = b`, and at the next level `a` is `2 min(a, 1 - a)`. The maximum over all `a` is taken over
    /// intervals of 1/128.
    pub fn reach(&self, from: u32, to: u32) -> Wide {
        const COUNT: u32 = 128;
        let to = to.min(LEVELS);
        // 20 fractional bits, rounded up: below 2^28
        let mut highest = [0_u32; COUNT as usize];
        for level in (from..to).rev() {
            let (offset, below) = (self.at(level).unsigned_abs(), highest);
            for (i, height) in (0..COUNT).zip(&mut highest) {
                // 2 a + a^2 at the end of the interval, 14 fractional bits
                let end = i + 1;
                let own = (product_u(offset, end * (end + 2 * COUNT)) >> 22) as u32 + 1;
                let first = 2 * i.min(COUNT - 1 - i);
                let at = |k: u32| below.get(k as usize).copied().unwrap_or(0);
                *height = own + at(first).max(at(first + 1));
            }
        }
        let sum = i64::from(highest.into_iter().fold(0, u32::max));
        // below 2^28 times 2^29.8; a unit of a height a level for rounding
        Wide::from_bits(sum * LARGEST + (i64::from(to.saturating_sub(from)) << 25))
    }
}

/// The middle of an edge: `(a + b) / 2 + o R`, to the nearest, halves upwards.
#[inline(always)]
pub(super) fn edge(a: Q24, b: Q24, offset: Q28, r: Deviate) -> Q24 {
    // heights are below 2^30 in magnitude, the product is below 2^59
    let twice = i64::from(a.wrapping_add(b).wrapping_add(1)) << 31;
    (twice.wrapping_add(product(offset, r.to_bits())) >> 32) as i32
}

/// The centre, from the middles of the four edges: `(s + n + w + e) / 4 + o (R_1 + R_2)`.
#[inline(always)]
pub(super) fn centre([s, n, w, e]: [Q24; 4], offset: Q28, [r_1, r_2]: [Deviate; 2]) -> Q24 {
    // each half below 2^31, with the half unit that rounds; R_1 + R_2 below 2^31
    let half = |a: i32, b: i32| i64::from(a.wrapping_add(b).wrapping_add(1));
    let sum = (half(s, n) + half(w, e)) << 30;
    let both = r_1.to_bits().wrapping_add(r_2.to_bits());
    (sum.wrapping_add(product(offset, both)) >> 32) as i32
}
