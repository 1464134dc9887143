//! Fixed-point numbers as wide as it takes: the coordinates of deep zooms, where 128 bits do not tell two
//! pixels apart.
//!
//! A number is an array of `LIMBS` words of 32 bits ("limbs"), least first, in two's complement: 4 bits
//! before the point, the sign among them, and `32 LIMBS - 4` behind it. So it lies in `-8 .. 8`, and
//! `Limbs<2>` has the bits of a Q60, `Limbs<4>` those of a Q124. There are few operations, those that an
//! orbit of `z^2 + c` and a grid of pixels need. Sums wrap: who uses the numbers knows their range.
//!
//! A product is summed column by column: all products of two limbs that are worth the same power of two, then
//! the next column with the carry (P. G. Comba, "Exponentiation cryptosystems on the IBM PC", 1990). The
//! columns that cannot reach the result are left out.

use super::formats::Wide;

/// A number in `-8 .. 8` with `32 LIMBS - 4` fractional bits. At least 2 limbs are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Limbs<const LIMBS: usize> {
    limbs: [u32; LIMBS],
}

/// Bits before the point, the sign among them.
const WHOLE: u32 = 4;

impl<const LIMBS: usize> Default for Limbs<LIMBS> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<const LIMBS: usize> Limbs<LIMBS> {
    /// 0.
    pub const ZERO: Self = Self { limbs: [0; LIMBS] };
    /// Bits behind the point.
    pub const FRACTION: u32 = 32 * LIMBS as u32 - WHOLE;

    /// The number with these limbs, least first, two's complement.
    pub const fn from_limbs(limbs: [u32; LIMBS]) -> Self {
        Self { limbs }
    }

    /// The limbs, least first.
    pub const fn limbs(&self) -> &[u32; LIMBS] {
        &self.limbs
    }

    /// The same number; bits that do not fit behind are cut off. None beyond `-8 .. 8`.
    pub fn from_wide(v: Wide) -> Option<Self> {
        // 48 fractional bits to 60
        let bits = v.to_bits();
        if !(-(8 << 48)..8 << 48).contains(&bits) {
            return None;
        }
        let bits = bits << 12;
        let mut number = Self::ZERO;
        for (limb, word) in number.limbs.iter_mut().rev().zip([(bits >> 32) as u32, bits as u32]) {
            *limb = word;
        }
        Some(number)
    }

    /// The number towards minus infinity rounded to 48 fractional bits.
    pub fn to_wide(&self) -> Wide {
        Wide::from_bits(self.top64() >> 12)
    }

    /// The number towards minus infinity rounded to 60 fractional bits.
    pub fn top64(&self) -> i64 {
        let word = |k: usize| LIMBS.checked_sub(k).and_then(|k| self.limbs.get(k)).copied().unwrap_or(0);
        ((u64::from(word(1)) << 32) | u64::from(word(2))) as i64
    }

    /// The number towards minus infinity rounded to 124 fractional bits.
    pub fn top128(&self) -> i128 {
        let word = |k: usize| LIMBS.checked_sub(k).and_then(|k| self.limbs.get(k)).copied().unwrap_or(0);
        (i128::from(self.top64()) << 64) | i128::from((u64::from(word(3)) << 32) | u64::from(word(4)))
    }

    /// Whether the number is below 0.
    #[inline]
    pub fn is_negative(&self) -> bool {
        self.limbs.last().is_some_and(|top| (*top as i32) < 0)
    }

    /// `self + other`, wrapped.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        let mut carry = 0_u64;
        for (a, b) in self.limbs.iter_mut().zip(&other.limbs) {
            carry += u64::from(*a) + u64::from(*b);
            *a = carry as u32;
            carry >>= 32;
        }
        self
    }

    /// `-self`, wrapped.
    #[must_use]
    pub fn negated(mut self) -> Self {
        let mut carry = 1_u64;
        for a in &mut self.limbs {
            carry += u64::from(!*a);
            *a = carry as u32;
            carry >>= 32;
        }
        self
    }

    /// `self - other`, wrapped.
    #[must_use]
    pub fn minus(self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// `|self|`, as an unsigned number.
    #[must_use]
    pub fn magnitude(self) -> Self {
        if self.is_negative() { self.negated() } else { self }
    }

    /// `self * other`, wrapped. Error: below 2 units, towards 0 (`four_limbs_calculate_as_128_bits_do`).
    /// Cost: about `LIMBS (LIMBS + 4) / 2` products of 32 bits.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (self.magnitude(), other.magnitude());
        let mut product = Self::ZERO;
        // the columns from LIMBS - 2 on; a column is worth 32 more bits than the one before
        let mut sum = Accumulator::default();
        let mut below = 0_u32; // the word of the column before
        for column in LIMBS.saturating_sub(2)..2 * LIMBS {
            let first = (column + 1).saturating_sub(LIMBS);
            let last = column.min(LIMBS.saturating_sub(1));
            let left = a.limbs.get(first..=last).unwrap_or(&[]);
            let right = b.limbs.get(column - last..=column - first).unwrap_or(&[]);
            for (x, y) in left.iter().zip(right.iter().rev()) {
                sum.add(u64::from(*x) * u64::from(*y));
            }
            let word = sum.shift();
            // a product has 8 bits before the point, of which 4 stay: a limb takes 28 bits of one column and
            // the highest 4 of the column below
            if let Some(limb) = column.checked_sub(LIMBS).and_then(|k| product.limbs.get_mut(k)) {
                *limb = (word << WHOLE) | (below >> (32 - WHOLE));
            }
            below = word;
        }
        if self.is_negative() != other.is_negative() { product.negated() } else { product }
    }

    /// `self * factor`, wrapped.
    #[must_use]
    pub fn times_small(self, factor: i32) -> Self {
        let mut carry = 0_u64;
        let mut product = self.magnitude();
        for a in &mut product.limbs {
            carry += u64::from(*a) * u64::from(factor.unsigned_abs());
            *a = carry as u32;
            carry >>= 32;
        }
        if self.is_negative() != (factor < 0) { product.negated() } else { product }
    }

    /// The quotient of the unsigned number by `divisor` (0 counts as 1), and the remainder in units.
    #[must_use]
    pub fn divided(mut self, divisor: u32) -> (Self, u32) {
        let divisor = u64::from(divisor.max(1));
        let mut rest = 0_u64;
        for a in self.limbs.iter_mut().rev() {
            let dividend = (rest << 32) | u64::from(*a);
            *a = dividend.checked_div(divisor).unwrap_or(0) as u32;
            rest = dividend.checked_rem(divisor).unwrap_or(0);
        }
        (self, rest as u32)
    }

    /// Plus `units` of the last place, wrapped.
    #[must_use]
    pub fn plus_units(mut self, units: i64) -> Self {
        let mut carry = i128::from(units);
        for a in &mut self.limbs {
            carry += i128::from(*a);
            *a = carry as u32;
            carry >>= 32;
        }
        self
    }

    /// Plus a whole number, wrapped.
    #[must_use]
    pub(crate) fn plus_whole(mut self, whole: u32) -> Self {
        if let Some(top) = self.limbs.last_mut() {
            *top = top.wrapping_add(whole << (32 - WHOLE));
        }
        self
    }

    /// The position of the highest bit of the unsigned number, counted from the last place; none for 0.
    pub(crate) fn highest_bit(&self) -> Option<u32> {
        let index = self.limbs.iter().rposition(|limb| *limb != 0)?;
        let limb = self.limbs.get(index)?;
        Some(32 * index as u32 + 31 - limb.leading_zeros())
    }

    /// 32 bits of the unsigned number: those from `position` downwards, zeros behind the last place.
    pub(crate) fn window(&self, position: u32) -> u32 {
        let (index, bit) = ((position >> 5) as usize, position & 31);
        let word = |k: usize| u64::from(self.limbs.get(k).copied().unwrap_or(0));
        let below = index.checked_sub(1).map_or(0, word);
        (((word(index) << 32) | below) >> (bit + 1)) as u32
    }
}

/// 96 bits.
#[derive(Default)]
struct Accumulator {
    low: u64,
    high: u32,
}

impl Accumulator {
    #[inline(always)]
    fn add(&mut self, product: u64) {
        let (low, carry) = self.low.overflowing_add(product);
        self.low = low;
        self.high = self.high.wrapping_add(u32::from(carry));
    }

    /// Takes the lowest word away.
    #[inline(always)]
    fn shift(&mut self) -> u32 {
        let word = self.low as u32;
        self.low = (self.low >> 32) | (u64::from(self.high) << 32);
        self.high = 0;
        word
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> impl Iterator<Item = i128> {
        (0..300_i128).map(|k| {
            let word = k.wrapping_mul(0x2360_ed05_1fc6_5da4_4385_df64_9fcc_f645);
            word >> (2 + (k * 7) % 120)
        })
    }

    fn four(bits: i128) -> Limbs<4> {
        Limbs::from_limbs([0, 32, 64, 96].map(|s| (bits >> s) as u32))
    }

    #[test]
    fn four_limbs_calculate_as_128_bits_do() {
        let (mut worst, mut low) = (0, 0.0_f64);
        for a in samples() {
            assert_eq!((four(a).top128(), four(a).top64()), (a, (a >> 64) as i64));
            assert_eq!(four(a).negated().top128(), -a);
            for b in samples().step_by(3) {
                assert_eq!(four(a).plus(&four(b)).top128(), a.wrapping_add(b));
                assert_eq!(four(a).minus(&four(b)).top128(), a.wrapping_sub(b));
                // 62 fractional bits each: the product is exact and has 124
                let (x, y) = (a >> 66, b >> 66);
                let product = four(x << 62).times(&four(y << 62)).top128();
                let exact = x * y;
                worst = worst.max((product - exact).abs());
                // all 128 bits: what is missing towards 0, from the 256 of the magnitudes
                let (p, q) = (a.unsigned_abs(), b.unsigned_abs());
                let word = |v: u128, k: u32| (v >> (64 * k)) as u64;
                let part = |i: u32, j: u32| u128::from(word(p, i)) * u128::from(word(q, j));
                let (middle, carry) = part(0, 1).overflowing_add(part(1, 0));
                let (bottom, again) = part(0, 0).overflowing_add(middle << 64);
                let top = part(1, 1) + (middle >> 64) + (u128::from(carry) << 64) + u128::from(again);
                // 124 fractional bits each: a unit is 2^124 of the product's
                let (units, rest) = (top << 4 | bottom >> 124, bottom & ((1 << 124) - 1));
                if units >> 127 == 0 {
                    let got = four(a).times(&four(b)).magnitude().top128().unsigned_abs();
                    assert!(got <= units, "{a} {b}");
                    low = low.max((units - got) as f64 + rest as f64 / 2_f64.powi(124));
                }
            }
            let (quotient, rest) = four(a.abs()).divided(1001);
            assert_eq!((quotient.top128(), i128::from(rest)), (a.abs() / 1001, a.abs() % 1001));
            assert_eq!(four(a >> 20).times_small(-77_777).top128(), (a >> 20) * -77_777);
            assert_eq!(four(a).plus_units(-5).top128(), a.wrapping_sub(5));
        }
        assert!(worst <= 1, "{worst}");
        assert!((0.9..2.0).contains(&low), "{low}");
    }

    #[test]
    fn many_limbs_square_a_sum_consistently() {
        // (a + b)^2 = a^2 + 2 a b + b^2 within a few units
        let number = |seed: u32| {
            let mut word = seed;
            let mut n = Limbs::<12>::from_limbs(core::array::from_fn(|_| {
                word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                word
            }));
            n = n.divided(16).0;
            if seed & 1 == 1 { n.negated() } else { n }
        };
        for seed in 0..100 {
            let (a, b) = (number(seed), number(seed * 31 + 7));
            let sum = a.plus(&b);
            let ab = a.times(&b);
            let parts = a.times(&a).plus(&ab).plus(&ab).plus(&b.times(&b));
            let off = sum.times(&sum).minus(&parts).magnitude();
            assert!(off.highest_bit().is_none_or(|bit| bit < 4), "{off:?}");
        }
    }

    #[test]
    fn wide_numbers_come_and_go() {
        for v in [0.0, 1.5, -1.75, 7.999, -8.0, 1e-9, -1e-9] {
            let wide = Wide::from_num(v);
            assert_eq!(Limbs::<2>::from_wide(wide).unwrap().to_wide(), wide);
            assert_eq!(Limbs::<7>::from_wide(wide).unwrap().to_wide(), wide);
        }
        assert!(Limbs::<4>::from_wide(Wide::from_num(8)).is_none());
        let one = Limbs::<3>::from_wide(Wide::ONE).unwrap();
        assert_eq!(one.highest_bit(), Some(Limbs::<3>::FRACTION));
        assert_eq!(one.window(Limbs::<3>::FRACTION), 1 << 31);
        assert_eq!(one.window(Limbs::<3>::FRACTION + 3), 1 << 28);
        assert_eq!(one.plus_units(1).window(31), 1);
        assert_eq!(one.plus_units(1).window(3), 1 << 28);
    }

    /// Limbs of 1: whatever is cut off is seen. `Limbs<2>` against 128 bits: a product loses less than 2
    /// units towards 0.
    #[test]
    fn two_limbs_calculate_as_64_bits_do() {
        let two = |bits: i64| Limbs::<2>::from_limbs([bits as u32, (bits >> 32) as u32]);
        let mut worst = 0.0_f64;
        for a in samples().map(|a| (a >> 64) as i64) {
            assert_eq!((two(a).top64(), two(a).to_wide()), (a, Wide::from_bits(a >> 12)));
            assert_eq!(two(a).is_negative(), a < 0);
            for b in samples().step_by(7).map(|b| (b >> 64) as i64) {
                let exact = i128::from(a) * i128::from(b);
                let got = i128::from(two(a).times(&two(b)).top64());
                if (exact >> 60) == i128::from((exact >> 60) as i64) {
                    let lost = exact.abs() - (got.abs() << 60);
                    assert!(
                        (0..2 << 60).contains(&lost) && (got == 0 || (got < 0) == (exact < 0)),
                        "{a} {b}"
                    );
                    worst = worst.max(lost as f64 / 2_f64.powi(60));
                }
                let small = b as i32;
                assert_eq!(two(a).times_small(small).top64(), a.wrapping_mul(i64::from(small)));
                assert_eq!(two(a).plus_units(b).top64(), a.wrapping_add(b));
            }
            assert_eq!(two(a).plus_whole(3).top64(), a.wrapping_add(3 << 60));
            let bits = a as u64;
            assert_eq!(two(a).highest_bit(), bits.checked_ilog2());
            for position in [0, 1, 30, 31, 32, 33, 62, 63] {
                let want = if position > 31 { bits >> (position - 31) } else { bits << (31 - position) };
                assert_eq!(two(a).window(position), want as u32, "{a} {position}");
            }
        }
        assert!((0.9..2.0).contains(&worst), "{worst}");
        assert_eq!(two(5).divided(0), (two(5), 0));
    }
}
