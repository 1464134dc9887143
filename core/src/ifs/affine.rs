//! Affine maps of the plane, the building blocks of an iterated function system: how one acts on a point,
//! composes with another, and how much it contracts.
//!
//! `x' = a x + b y + e`, `y' = c x + d y + f`, in the order `[a, b, c, d, e, f]` of the textbooks' tables.
//! Source: M. F. Barnsley, "Fractals Everywhere", 1988, section 3.8 ("IFS code"); the course unit's copier,
//! section 5.3.
//!
//! A map brings all points closer together when the larger singular value of its linear part is below 1. It
//! is decided without a root: the singular values `s1 >= s2` obey `s1^2 + s2^2 = T = a^2 + b^2 + c^2 + d^2`
//! and `s1 s2 = |D|`, `D = a d - b c`; so `(1 - s1^2) (1 - s2^2) = 1 - T + D^2`, which is positive exactly
//! when both are below 1 or both above, and `|D| < 1` rules out the latter. As a number,
//! `s1 = (|(a + d, b - c)| + |(a - d, b + c)|) / 2`: half the lengths of the conformal and of the
//! anticonformal part.

use crate::num::formats::{Q54, Q60, UQ60};
use crate::num::{Real, Unit, Wide, mul_high_u, product, quotient, sqrt};
use crate::plane::Point2;

/// 1, with 30 fractional bits as in [`Unit`].
const ONE_Q30: i64 = 1 << 30;
const ONE_UQ60: UQ60 = 1 << 60;

/// An affine map of the plane: the linear part in [`Unit`], the translation in [`Real`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Affine {
    /// `x` to `x'`.
    pub a: Unit,
    /// `y` to `x'`.
    pub b: Unit,
    /// `x` to `y'`.
    pub c: Unit,
    /// `y` to `y'`.
    pub d: Unit,
    /// Translation to the right.
    pub e: Real,
    /// Translation upwards.
    pub f: Real,
}

impl Affine {
    /// The map with the given coefficients, in the order of the tables.
    pub const fn new(linear: [Unit; 4], translation: [Real; 2]) -> Self {
        let ([a, b, c, d], [e, f]) = (linear, translation);
        Self { a, b, c, d, e, f }
    }

    /// The map whose coefficients `[a, b, c, d, e, f]` are these numbers over a common denominator; for
    /// constants.
    ///
    /// Domain: the denominator positive (less counts as 1); coefficients saturate at the ends of their
    /// formats, 2 and 128. Error: half a unit in the last place, `2^-31` in `a b c d` and `2^-25` in `e f`
    /// (`ratios_become_the_nearest_coefficients`).
    pub const fn from_ratios(numerators: [i32; 6], denominator: i32) -> Self {
        let [a, b, c, d, e, f] = numerators;
        Self {
            a: Unit::from_bits(ratio(a, denominator, 30)),
            b: Unit::from_bits(ratio(b, denominator, 30)),
            c: Unit::from_bits(ratio(c, denominator, 30)),
            d: Unit::from_bits(ratio(d, denominator, 30)),
            e: Real::from_bits(ratio(e, denominator, 24)),
            f: Real::from_bits(ratio(f, denominator, 24)),
        }
    }

    /// [`Affine::from_ratios`] in thousandths: `from_thousandths([850, 40, -40, 850, 0, 1600])` is the fern's
    /// second map.
    pub const fn from_thousandths(coefficients: [i32; 6]) -> Self {
        Self::from_ratios(coefficients, 1_000)
    }

    /// [`Affine::from_ratios`] in millionths.
    pub const fn from_millionths(coefficients: [i32; 6]) -> Self {
        Self::from_ratios(coefficients, 1_000_000)
    }

    /// The image of a point.
    ///
    /// Domain: all; a result outside [`Real`] saturates. Error: half a unit in the last place of each
    /// coordinate, from one rounding (`a_map_is_applied_with_one_rounding`). Cost: 4 multiplications.
    pub fn apply(&self, p: Point2) -> Point2 {
        let row = |l: Unit, m: Unit, t: Real| {
            // The sum leaves 64 bits only for l = m = -2, x = y = -128: saturating costs one unit of 2^-54
            // there.
            let sum = product_q54(l, p.x).saturating_add(product_q54(m, p.y)).saturating_add(translated(t));
            Real::from_bits((sum >> 30).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
        };
        Point2::new(row(self.a, self.b, self.e), row(self.c, self.d, self.f))
    }

    /// The map that applies `first`, then `self`: `self o first`.
    ///
    /// Domain: all; coefficients saturate. Error: half a unit in the last place of each
    /// (`a_composition_is_rounded_once_to_the_nearest`). Cost: 12 multiplications.
    pub fn after(&self, first: &Self) -> Self {
        let entry = |l: Unit, m: Unit, p: Unit, q: Unit| {
            // beyond 63 bits only for -2 throughout, where the entry saturates anyhow
            let sum = (product_q60(l, p) + (1 << 29)).saturating_add(product_q60(m, q));
            Unit::from_bits((sum >> 30).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
        };
        let Point2 { x: e, y: f } = self.apply(Point2::new(first.e, first.f));
        Self {
            a: entry(self.a, self.b, first.a, first.c),
            b: entry(self.a, self.b, first.b, first.d),
            c: entry(self.c, self.d, first.a, first.c),
            d: entry(self.c, self.d, first.b, first.d),
            e,
            f,
        }
    }

    /// `a d - b c`: the factor of areas, negative when the map turns left into right. Error: below
    /// `2^-48`, downwards (`a_determinant_is_rounded_down`).
    pub fn determinant(&self) -> Wide {
        let [a, b, c, d] = self.linear().map(i128::from);
        Wide::from_bits(((a * d - b * c) >> 12) as i64)
    }

    /// Whether the map brings any two points closer together: its largest singular value is below 1. Exact.
    pub fn is_contraction(&self) -> bool {
        if !self.is_small() {
            return false;
        }
        // T - 1 < D^2; T <= 4 with 60 fractional bits
        let determinant = self.area();
        let squares: u64 = self.linear().iter().map(|l| l.unsigned_abs() * l.unsigned_abs()).sum();
        determinant < ONE_UQ60
            && match squares.checked_sub(ONE_UQ60) {
                None => true,
                Some(excess) => {
                    // D^2 has 120: rounded up to 60
                    let whole = mul_high_u(determinant << 2, determinant << 2);
                    let rest = determinant.wrapping_mul(determinant) << 4;
                    excess < whole + u64::from(rest != 0)
                }
            }
    }

    /// An upper bound of the largest singular value: distances shrink at least by this factor.
    ///
    /// Domain: all; saturates at the end of the format, 2. Error: above the exact value by less than `2^-29`,
    /// never below (`the_contraction_factor_bounds_the_largest_singular_value`). Cost: two square roots.
    pub fn contraction_factor(&self) -> Unit {
        if !self.is_small() {
            return Unit::MAX;
        }
        let [a, b, c, d] = self.linear();
        // sums of two are at most 2^31, of two squares 2^63
        let conformal = hypotenuse(a + d, b - c);
        let anticonformal = hypotenuse(a - d, b + c);
        let half = (conformal + anticonformal + 1) >> 1;
        Unit::from_bits(half.min(i32::MAX as u64) as i32)
    }

    /// The point that the map leaves where it is: every contraction has one.
    ///
    /// Domain: coefficients `a b c d` of at most 1. None outside it, when there is no such point or more than
    /// one, and when it lies outside [`Real`]. Error: half a unit in the last place
    /// (`a_fixed_point_stays_where_it_is`). Cost: 6 multiplications, two divisions.
    pub fn fixed_point(&self) -> Option<Point2> {
        if !self.is_small() {
            return None;
        }
        // (1 - a) x - b y = e, -c x + (1 - d) y = f; 60 fractional bits below, 54 above the line, both less
        // than 2^63
        let [a, b, c, d] = self.linear();
        let (e, f) = (i64::from(self.e.to_bits()), i64::from(self.f.to_bits()));
        let (p, q) = (ONE_Q30 - a, ONE_Q30 - d);
        let determinant = p * q - b * c;
        let coordinate = |numerator: i64| {
            let signed = if determinant < 0 { -numerator } else { numerator };
            // 25 fractional bits towards zero: halved away from zero, that is the nearest with 24
            let twice = quotient(signed, 31, determinant.unsigned_abs());
            let bits = twice / 2 + twice % 2;
            Some(Real::from_bits(i32::try_from(bits).ok()?))
        };
        Some(Point2::new(coordinate(q * e + b * f)?, coordinate(c * e + p * f)?))
    }

    /// `a b c d` in words that have room for their sums and products: 30 fractional bits.
    fn linear(&self) -> [i64; 4] {
        [self.a, self.b, self.c, self.d].map(|l| i64::from(l.to_bits()))
    }

    /// Whether no coefficient of the linear part exceeds 1, as in every contraction.
    fn is_small(&self) -> bool {
        [self.a, self.b, self.c, self.d].iter().all(|l| l.unsigned_abs() <= Unit::ONE.unsigned_abs())
    }

    /// `|D|`, for coefficients of at most 1.
    pub(super) fn area(&self) -> UQ60 {
        let [a, b, c, d] = self.linear();
        a.wrapping_mul(d).wrapping_sub(b.wrapping_mul(c)).unsigned_abs()
    }
}

/// A coefficient times a coordinate.
#[inline(always)]
pub(super) fn product_q54(l: Unit, x: Real) -> Q54 {
    product(l.to_bits(), x.to_bits())
}

/// A product of two coefficients, at most `2^62` units.
fn product_q60(l: Unit, m: Unit) -> Q60 {
    product(l.to_bits(), m.to_bits())
}

/// A translation, and the half unit that rounds the sum to 24 fractional bits.
#[inline(always)]
pub(super) const fn translated(t: Real) -> Q54 {
    ((t.to_bits() as i64) << 30) + (1 << 29)
}

/// `sqrt(x^2 + y^2)` rounded up, for `|x|, |y| <= 2^31`.
#[inline(never)]
pub(super) fn hypotenuse(x: i64, y: i64) -> u64 {
    let square = x.unsigned_abs() * x.unsigned_abs() + y.unsigned_abs() * y.unsigned_abs();
    let root = u64::from(sqrt(square));
    root + u64::from(root * root < square)
}

/// `numerator / denominator` with `fraction` fractional bits, rounded to nearest, saturated.
pub(super) const fn ratio(numerator: i32, denominator: i32, fraction: u32) -> i32 {
    let denominator = if denominator < 1 { 1 } else { denominator as i64 };
    let half = if numerator < 0 { -(denominator / 2) } else { denominator / 2 };
    match (((numerator as i64) << fraction) + half).checked_div(denominator) {
        Some(quotient) if quotient > i32::MAX as i64 => i32::MAX,
        Some(quotient) if quotient < i32::MIN as i64 => i32::MIN,
        Some(quotient) => quotient as i32,
        None => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    fn random_maps(seed: u64) -> impl Iterator<Item = Affine> {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(seed);
        core::iter::from_fn(move || {
            // entries up to 1, sometimes exactly at the ends, translations up to 64
            let shift = rng.next_u32() % 4;
            let mut unit = || match rng.next_u32() % 16 {
                0 => Unit::ONE,
                1 => -Unit::ONE,
                2 => Unit::ZERO,
                _ => Unit::from_bits((rng.next_u32() as i32 >> 1) >> shift),
            };
            let linear = [unit(), unit(), unit(), unit()];
            let translation = [rng.next_u32(), rng.next_u32()].map(|w| Real::from_bits(w as i32 >> 1));
            Some(Affine::new(linear, translation))
        })
    }

    fn f64s(map: &Affine) -> [f64; 6] {
        let [a, b, c, d] = [map.a, map.b, map.c, map.d].map(|l| l.to_num::<f64>());
        [a, b, c, d, map.e.to_num(), map.f.to_num()]
    }

    /// By the eigenvalues of the Gram matrix, unlike the code under test.
    fn largest_singular_value([a, b, c, d, ..]: [f64; 6]) -> f64 {
        let (p, q, r) = (a * a + c * c, a * b + c * d, b * b + d * d);
        ((p + r + ((p - r).powi(2) + 4.0 * q * q).sqrt()) / 2.0).sqrt()
    }

    #[test]
    fn a_map_is_applied_with_one_rounding() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(1);
        let mut worst: f64 = 0.0;
        for map in random_maps(2).take(100_000) {
            let [x, y] = [rng.next_u32(), rng.next_u32()].map(|w| Real::from_bits(w as i32 >> 1));
            let image = map.apply(Point2::new(x, y));
            let [a, b, c, d, e, f] = f64s(&map);
            let (x, y) = (x.to_num::<f64>(), y.to_num::<f64>());
            for (got, want) in [(image.x, a * x + b * y + e), (image.y, c * x + d * y + f)] {
                let want = want.clamp(-128.0, Real::MAX.to_num());
                worst = worst.max((got.to_num::<f64>() - want).abs());
            }
        }
        let half = 0.5 / 16_777_216.0;
        assert!(worst > 0.99 * half && worst < 1.000_01 * half, "{worst:e}");
    }

    #[test]
    fn the_largest_coefficients_saturate() {
        let low = Affine::new([Unit::MIN; 4], [Real::MIN; 2]);
        let corner = Point2::new(Real::MIN, Real::MIN);
        assert_eq!(low.apply(corner), Point2::new(Real::MAX, Real::MAX));
        assert_eq!(low.apply(Point2::new(Real::MAX, Real::MAX)), corner);
        assert!(!low.is_contraction());
        assert_eq!(low.contraction_factor(), Unit::MAX);
        assert_eq!(Affine::from_ratios([3, -3, 1, 0, 129, -129], 0).a, Unit::MAX);
    }

    #[test]
    fn a_contraction_is_one_whose_largest_singular_value_is_below_1() {
        let (mut yes, mut no) = (0, 0);
        for map in random_maps(3).take(200_000) {
            let s = largest_singular_value(f64s(&map));
            if (s - 1.0).abs() > 1e-12 {
                assert_eq!(map.is_contraction(), s < 1.0, "{map:?} {s}");
                *if s < 1.0 { &mut yes } else { &mut no } += 1;
            }
        }
        assert!(yes > 10_000 && no > 10_000, "{yes} {no}");
        // one unit in the last place decides
        let scaled =
            |bits| Affine { a: Unit::from_bits(bits), d: Unit::from_bits(bits), ..Affine::default() };
        assert!(scaled((1 << 30) - 1).is_contraction());
        assert!(!scaled(1 << 30).is_contraction());
        assert!(!scaled(-(1 << 30)).is_contraction());
        assert!(!Affine::from_thousandths([1000, 0, 0, 0, 0, 0]).is_contraction());
    }

    #[test]
    fn the_contraction_factor_bounds_the_largest_singular_value() {
        let mut worst: f64 = 0.0;
        for map in random_maps(4).take(200_000) {
            let s = largest_singular_value(f64s(&map));
            let excess = map.contraction_factor().to_num::<f64>() - s;
            // the f64 value itself is good to 1e-15, and to 1e-8 where the two singular values meet
            assert!(excess > -1e-12 || s >= 2.0, "{map:?} {excess:e}");
            worst = worst.max(excess);
        }
        assert!(worst > 2_f64.powi(-30) && worst < 2_f64.powi(-29), "{worst:e}");
    }

    #[test]
    fn a_fixed_point_stays_where_it_is() {
        let mut found = 0;
        for map in random_maps(5).take(100_000).filter(Affine::is_contraction) {
            let Some(p) = map.fixed_point() else { continue };
            let [a, b, c, d, e, f] = f64s(&map);
            let det = (1.0 - a) * (1.0 - d) - b * c;
            let exact = [((1.0 - d) * e + b * f) / det, (c * e + (1.0 - a) * f) / det];
            for (got, want) in [p.x, p.y].iter().zip(exact) {
                assert!((got.to_num::<f64>() - want).abs() <= 0.500_1 / 16_777_216.0, "{map:?}");
            }
            let q = map.apply(p);
            assert!(q.x.abs_diff(p.x) <= Real::DELTA && q.y.abs_diff(p.y) <= Real::DELTA, "{map:?}");
            found += 1;
        }
        assert!(found > 10_000, "{found}");
        let translation = Affine::from_thousandths([1000, 0, 0, 1000, 1, 0]);
        assert_eq!(translation.fixed_point(), None);
    }

    #[test]
    fn a_composition_applies_one_map_after_the_other() {
        let p = Point2::new(Real::from_num(0.7), Real::from_num(-1.3));
        let (first, second) = (
            Affine::from_thousandths([200, -260, 230, 220, 0, 1600]),
            Affine::from_thousandths([-150, 280, 260, 240, 0, 440]),
        );
        let (twice, once) = (second.apply(first.apply(p)), second.after(&first).apply(p));
        assert!(twice.x.abs_diff(once.x) <= 2 * Real::DELTA && twice.y.abs_diff(once.y) <= 2 * Real::DELTA);
        let exact = first.determinant().to_num::<f64>();
        assert!((exact - (0.2 * 0.22 + 0.26 * 0.23)).abs() < 1e-8, "{exact}");
    }

    #[test]
    fn a_composition_is_rounded_once_to_the_nearest() {
        let maps = || random_maps(6).zip(random_maps(7)).take(20_000);
        for (second, first) in maps() {
            let both = second.after(&first);
            let [a, b, c, d] = second.linear().map(i128::from);
            let [p, q, r, s] = first.linear().map(i128::from);
            let exact = [a * p + b * r, a * q + b * s, c * p + d * r, c * q + d * s];
            for (got, exact) in both.linear().into_iter().zip(exact) {
                let nearest = ((exact + (1 << 29)) >> 30).clamp(i32::MIN.into(), i32::MAX.into());
                assert_eq!(i128::from(got), nearest, "{second:?} {first:?}");
            }
        }
    }

    #[test]
    fn ratios_become_the_nearest_coefficients() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(8);
        let (mut close, mut ends) = (0, 0);
        for _ in 0..100_000 {
            let denominator = (rng.next_u32() >> (1 + rng.next_u32() % 31)).max(1) as i32;
            let numerators = [(); 6].map(|()| rng.next_u32() as i32 >> (rng.next_u32() % 31));
            let map = Affine::from_ratios(numerators, denominator);
            let linear = map.linear().map(|l| (l, 30));
            let got = linear.into_iter().chain([map.e, map.f].map(|t| (t.to_bits().into(), 24)));
            for ((got, fraction), numerator) in got.zip(numerators) {
                let (got, d) = (i128::from(got), i128::from(denominator));
                let exact = i128::from(numerator) << fraction;
                // half a unit, but for what the format cannot hold
                let twice = 2 * (got * d - exact);
                let [low, high] = [i32::MIN, i32::MAX].map(i128::from);
                let saturates = (twice < 0 && got == high) || (twice > 0 && got == low);
                assert!(twice.abs() <= d || saturates, "{numerator} / {denominator}: {got}");
                close += u32::from(twice.abs() * 4 > d && !saturates);
                ends += u32::from(saturates);
            }
        }
        assert!(close > 10_000 && ends > 10_000, "{close} {ends}");
    }

    #[test]
    fn a_determinant_is_rounded_down() {
        let mut most = 0;
        for map in random_maps(9).take(20_000) {
            let [a, b, c, d] = map.linear().map(i128::from);
            let low = a * d - b * c - (i128::from(map.determinant().to_bits()) << 12);
            assert!((0..1 << 12).contains(&low), "{map:?}: {low}");
            most = most.max(low);
        }
        assert!(most > 4000, "{most}");
    }

    #[test]
    fn a_similarity_just_below_1_is_a_contraction() {
        let mut close = 0;
        for k in 1..40_000_i64 {
            // a^2 + b^2 as near to 1 as b allows
            let a = (k * 536_870_909) & ((1 << 30) - 1);
            let b = ((1 << 60) - a * a).isqrt();
            for (b, below) in [(b, a * a + b * b < 1 << 60), (b + 1, false)] {
                let [a, b, c] = [a, b, -b].map(|v| Unit::from_bits(v as i32));
                assert_eq!(Affine::new([a, b, c, a], [Real::ZERO; 2]).is_contraction(), below, "{a} {b}");
            }
            close += u32::from(a * a + b * b > (1 << 60) - (1 << 30));
        }
        assert!(close > 300, "{close}");
    }

    #[test]
    fn constants_read_like_the_tables() {
        const FROND: Affine = Affine::from_thousandths([850, 40, -40, 850, 0, 1600]);
        assert_eq!(FROND, Affine::from_millionths([850_000, 40_000, -40_000, 850_000, 0, 1_600_000]));
        assert_eq!(FROND.b, Unit::from_num(0.04));
        assert_eq!(FROND.f, Real::from_num(1.6));
        assert_eq!(Affine::from_ratios([1, -1, 0, 0, 2, 0], 3).b, Unit::from_num(-1.0 / 3.0));
    }

    #[test]
    fn a_hypotenuse_is_the_root_rounded_up() {
        for k in 0..4000_i64 {
            let (x, y) = (
                (k.wrapping_mul(0x2545_f491_4f6c) % (1 << 31)) >> (k % 30),
                (k.wrapping_mul(0x1f12_3bb5_159a) % (1 << 31)) >> (k % 7),
            );
            for (x, y) in [(x, y), (-x, y), (y, y), (3 * k, 4 * k), (1 << 31, -(1 << 31) + k)] {
                let square = i128::from(x) * i128::from(x) + i128::from(y) * i128::from(y);
                let root = i128::from(hypotenuse(x, y));
                assert!(
                    root * root >= square && (root == 0 || (root - 1) * (root - 1) < square),
                    "{x} {y}: {root}"
                );
            }
        }
    }

    /// Against integers: half a unit, ties upwards.
    #[test]
    fn an_image_is_the_nearest_point() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(41);
        for map in random_maps(40).take(50_000) {
            let p = Point2::new(
                Real::from_bits(rng.next_u32() as i32 >> 1),
                Real::from_bits(rng.next_u32() as i32 >> 1),
            );
            let [x, y] = [p.x, p.y].map(|z| i128::from(z.to_bits()));
            let [a, b, c, d] = map.linear().map(i128::from);
            let [e, f] = [map.e, map.f].map(|t| i128::from(t.to_bits()) << 30);
            let nearest = |v: i128| ((v + (1 << 29)) >> 30).clamp(i32::MIN.into(), i32::MAX.into());
            let image = map.apply(p);
            let got = [image.x, image.y].map(|z| i128::from(z.to_bits()));
            assert_eq!(got, [nearest(a * x + b * y + e), nearest(c * x + d * y + f)], "{map:?} {p:?}");
        }
    }

    /// Against integers: `|p det - numerator| <= det / 2`, in the place of a floating-point quotient.
    #[test]
    fn a_fixed_point_is_the_nearest_number() {
        let (mut most, mut turned) = (0.0_f64, 0);
        for map in random_maps(42).take(20_000) {
            let Some(p) = map.fixed_point() else { continue };
            let [a, b, c, d] = map.linear().map(i128::from);
            let [e, f] = [map.e, map.f].map(|t| i128::from(t.to_bits()));
            let (one, det) = (1_i128 << 30, ((1 << 30) - a) * ((1 << 30) - d) - b * c);
            for (got, numerator) in [(p.x, (one - d) * e + b * f), (p.y, c * e + (one - a) * f)] {
                let off = (i128::from(got.to_bits()) * det - (numerator << 30)).abs();
                assert!(2 * off <= det.abs(), "{map:?}");
                most = most.max(off as f64 / det.abs() as f64);
                turned += u32::from(det < 0);
            }
        }
        assert!(most > 0.49 && turned > 100, "{most} {turned}");
    }

    /// Coefficients above 1 are no contraction's; the factor ends at the end of its format.
    #[test]
    fn large_coefficients_are_left_out() {
        let ones = Affine::new([Unit::ONE; 4], [Real::ZERO; 2]);
        assert_eq!((ones.contraction_factor(), ones.is_contraction()), (Unit::MAX, false));
        for large in [Unit::ONE + Unit::DELTA, -Unit::ONE - Unit::DELTA, Unit::MAX, Unit::MIN] {
            let map = Affine { b: large, ..Affine::default() };
            assert_eq!(
                (map.contraction_factor(), map.is_contraction(), map.fixed_point()),
                (Unit::MAX, false, None)
            );
        }
        let end = Affine { a: -Unit::ONE, ..Affine::default() };
        assert_eq!(end.fixed_point(), Some(Point2::default()));
        assert!(end.contraction_factor().abs_diff(Unit::ONE) <= Unit::DELTA.unsigned_abs());
    }
}
