//! Vectors of three components: positions in [`Real`], directions in [`Unit`], for the set-up of a camera and
//! its light.
//!
//! What is computed for each ray or pixel works on plain words instead, in the kernels.

use super::formats::{Real, Unit};
use super::product::rounded_down;
use super::root::reciprocal_sqrt_of;
use super::wide::scaled;

/// A vector in space; `z` points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vec3<T = Real> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component, upwards.
    pub z: T,
}

impl<T> Vec3<T> {
    /// The vector `(x, y, z)`.
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
}

impl Vec3<Real> {
    /// `(1, 0, 0)`.
    pub const X: Self = Self::new(Real::ONE, Real::ZERO, Real::ZERO);
    /// `(0, 1, 0)`.
    pub const Y: Self = Self::new(Real::ZERO, Real::ONE, Real::ZERO);
    /// `(0, 0, 1)`, upwards.
    pub const Z: Self = Self::new(Real::ZERO, Real::ZERO, Real::ONE);

    /// The vector `(x, y, z)` from decimal literals, for constants:
    /// `const EYE: Vec3 = Vec3::lit("-4", "-3", "5")`.
    ///
    /// Text that is no number, or does not fit, is an error at compile time. Call it in a `const` or in
    /// `const { }` only: see [Numbers](crate::num#numbers).
    pub const fn lit(x: &str, y: &str, z: &str) -> Self {
        Self::new(Real::lit(x), Real::lit(y), Real::lit(z))
    }

    /// The difference `self - other`, saturated.
    pub fn minus(self, other: Self) -> Self {
        Self::new(
            self.x.saturating_sub(other.x),
            self.y.saturating_sub(other.y),
            self.z.saturating_sub(other.z),
        )
    }

    /// The unit vector from here to `other`, however far; none if they are one point. As exact as
    /// [`Vec3::normalised`].
    pub fn towards(self, other: Self) -> Option<Vec3<Unit>> {
        let differences = [(self.x, other.x), (self.y, other.y), (self.z, other.z)]
            .map(|(a, b)| i64::from(b.to_bits()) - i64::from(a.to_bits()));
        // differences have 33 bits: where one does not fit 32, all are halved, and the greatest keeps 30 bits
        let far = differences.iter().any(|d| i32::try_from(*d).is_err());
        let [x, y, z] = differences.map(|d| Real::from_bits((d >> u32::from(far)) as i32));
        Self::new(x, y, z).normalised()
    }

    /// The unit vector in this direction, none for the zero vector. Error: below `2^-28` in each component
    /// (`a_unit_vector_is_within_two_to_the_minus_28`).
    #[inline]
    pub fn normalised(self) -> Option<Vec3<Unit>> {
        let [x, y, z] = [self.x.to_bits(), self.y.to_bits(), self.z.to_bits()];
        if x | y | z == 0 { None } else { Some(unit([x, y, z])) }
    }
}

/// The unit vector in a direction of any format. Error: below `2^-28` in each component
/// (`a_unit_vector_is_within_two_to_the_minus_28`); the zero vector stays one.
#[inline]
pub(crate) fn unit(v: [i32; 3]) -> Vec3<Unit> {
    // the reciprocal of the length is mantissa / 2^(31 + half), and 30 fractional bits are wanted
    let root = reciprocal_sqrt_of(square(v));
    let [x, y, z] = v.map(|c| Unit::from_bits(scaled(c, root)));
    Vec3::new(x, y, z)
}

/// The square of a vector's length, below `2^64`.
#[inline(always)]
pub(crate) fn square(v: [i32; 3]) -> u64 {
    v.iter().fold(0, |sum, c| sum.wrapping_add((i64::from(*c) * i64::from(*c)) as u64))
}

impl Vec3<Unit> {
    /// The scalar product.
    ///
    /// Domain: vectors no longer than 1; that of others wraps.
    pub fn dot(self, other: Self) -> Unit {
        let product = |a: Unit, b: Unit| i64::from(a.to_bits()) * i64::from(b.to_bits());
        let sum = product(self.x, other.x)
            .wrapping_add(product(self.y, other.y))
            .wrapping_add(product(self.z, other.z));
        Unit::from_bits(rounded_down::<30>(sum))
    }

    /// The vector product.
    ///
    /// Domain: vectors no longer than 1; that of others wraps.
    pub fn cross(self, other: Self) -> Self {
        let minor = |a: Unit, b: Unit, c: Unit, d: Unit| {
            let sum = i64::from(a.to_bits()) * i64::from(b.to_bits())
                - i64::from(c.to_bits()) * i64::from(d.to_bits());
            Unit::from_bits((sum >> 30) as i32)
        };
        Self::new(
            minor(self.y, other.z, self.z, other.y),
            minor(self.z, other.x, self.x, other.z),
            minor(self.x, other.y, self.y, other.x),
        )
    }

    /// The unit vector in this direction, none for the zero vector.
    pub fn normalised(self) -> Option<Self> {
        let real = |u: Unit| Real::from_bits(u.to_bits());
        Vec3::<Real>::new(real(self.x), real(self.y), real(self.z)).normalised()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    /// In a random direction of any length, ends of the format and zeros among the components.
    fn vectors() -> impl Iterator<Item = [i32; 3]> {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(31);
        core::iter::from_fn(move || {
            let shift = rng.next_u32() % 31;
            Some([(); 3].map(|()| match rng.next_u32() % 12 {
                0 => 0,
                1 => i32::MIN >> shift,
                2 => i32::MAX >> shift,
                _ => rng.next_u32() as i32 >> shift,
            }))
        })
    }

    #[test]
    fn a_unit_vector_is_within_two_to_the_minus_28() {
        let mut worst: f64 = 0.0;
        for v in vectors().take(30_000) {
            let direction = Vec3::new(v[0], v[1], v[2]);
            let real = |bits| Real::from_bits(bits);
            let unit = Vec3::new(real(direction.x), real(direction.y), real(direction.z)).normalised();
            assert_eq!(unit.is_none(), v == [0; 3]);
            let Some(unit) = unit else { continue };
            let length = v.iter().map(|c| f64::from(*c).powi(2)).sum::<f64>().sqrt();
            for (got, want) in [unit.x, unit.y, unit.z].into_iter().zip(v) {
                worst = worst.max((got.to_num::<f64>() - f64::from(want) / length).abs());
            }
        }
        assert!(worst > 2_f64.powi(-30) && worst < 2_f64.powi(-28), "{worst:e}");
    }

    #[test]
    fn products_are_rounded_down_from_the_exact_ones() {
        let units: std::vec::Vec<_> = vectors().filter(|v| *v != [0; 3]).take(2_000).map(unit).collect();
        for pair in units.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let [[x, y, z], [u, v, w]] = [a, b].map(|v| [v.x, v.y, v.z].map(|c| i128::from(c.to_bits())));
            let bits = |unit: Unit| i128::from(unit.to_bits());
            assert_eq!(bits(a.dot(b)), (x * u + y * v + z * w) >> 30);
            let cross = a.cross(b);
            let exact = [y * w - z * v, z * u - x * w, x * v - y * u].map(|product| product >> 30);
            assert_eq!([cross.x, cross.y, cross.z].map(bits), exact);
        }
    }

    /// Differences that leave 32 bits are halved.
    #[test]
    fn a_direction_to_the_other_end_of_the_format_is_right() {
        for (from, to) in
            [((-127, -100, 5), (127, 120, -9)), ((127, 3, 2), (-127, 3, 1)), ((1, 2, 3), (4, 6, 3))]
        {
            let real = |(x, y, z): (i32, i32, i32)| {
                Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z))
            };
            let e = real(from).towards(real(to)).unwrap();
            let d = [to.0 - from.0, to.1 - from.1, to.2 - from.2].map(f64::from);
            let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
            for (got, c) in [e.x, e.y, e.z].into_iter().zip(d) {
                assert!((got.to_num::<f64>() - c / length).abs() < 2_f64.powi(-27), "{from:?} {to:?}");
            }
        }
    }

    #[test]
    fn a_difference_saturates_and_the_way_to_itself_is_none() {
        let real =
            |v: [i32; 3]| Vec3::new(Real::from_bits(v[0]), Real::from_bits(v[1]), Real::from_bits(v[2]));
        let (a, b) = (real([i32::MAX, -5, 7]), real([-1, i32::MAX, 2]));
        assert_eq!(a.minus(b), real([i32::MAX, i32::MIN, 5]));
        assert_eq!(real([3, 4, 5]).minus(real([1, 1, 1])), real([2, 3, 4]));
        assert_eq!((a.towards(a), real([0; 3]).normalised()), (None, None));
        assert_eq!(Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ZERO).normalised(), None);
        // a single unit is a direction
        let up = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::DELTA).normalised().unwrap();
        assert!(
            up.x == 0 && up.y == 0 && up.z.abs_diff(Unit::ONE) <= 4 * Unit::DELTA.unsigned_abs(),
            "{up:?}"
        );
    }

    /// Modulo 4, as the format is: the exact sum of products, whatever its size.
    #[test]
    fn products_of_vectors_of_any_length_are_those_modulo_the_format() {
        let ends = [Unit::MIN, Unit::MAX, Unit::ONE, Unit::ZERO, -Unit::ONE];
        let vectors = || (0..125).map(|k| Vec3::new(ends[k % 5], ends[k / 5 % 5], ends[k / 25]));
        for (a, b) in vectors().flat_map(|a| vectors().map(move |b| (a, b))) {
            let product = |a: Unit, b: Unit| i128::from(a.to_bits()) * i128::from(b.to_bits());
            let exact = |sum: i128| Unit::from_bits((sum >> 30) as i32);
            assert_eq!(a.dot(b), exact(product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z)));
            assert_eq!(a.cross(b).z, exact(product(a.x, b.y) - product(a.y, b.x)));
        }
    }
}
