//! Affine maps of space: what puts a thing, described in coordinates of its own, into a world.
//!
//! A map is `x -> A x + b`; entries have 48 fractional bits, so that one composed of many keeps what they
//! say. Its inverse, which brings rays to the thing, is the adjugate over the determinant, both exact for the
//! matrix rounded to 30 bits: `A^-1 = adj A / det A`.

use super::formats::{Q30, Q48, Real, UQ63, Unit, Wide};
use super::quotient::quotient;
use super::trig::{Angle, sin_cos};
use super::vector::Vec3;
use crate::Error;

/// An affine map of space.
///
/// It holds any numbers; what needs an inverse refuses those that have none.
///
/// ```
/// use attractor::num::{Affine3, Angle, Real, Vec3};
/// # fn main() -> Result<(), attractor::Error> {
/// // twice as high, a quarter of a turn about z, then one to the right
/// let map = Affine3::scale(Vec3::lit("1", "1", "2"))
///     .then(&Affine3::rotate(Vec3::Z, Angle::from_num(0.25))?)
///     .then(&Affine3::translate(Vec3::X));
/// assert_eq!(map.at(Vec3::lit("1", "0", "3")), Vec3::lit("1", "1", "6"));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Affine3 {
    rows: [[Q48; 3]; 3],
    translation: [Q48; 3],
}

/// The linear part of an inverse: `rows 2^exponent`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Inverse {
    /// The greatest magnitude is in `[1/2, 1]`.
    pub(crate) rows: [[Q30; 3]; 3],
    pub(crate) exponent: i32,
}

const ONE: Q48 = 1 << 48;

/// What lies farther than 64 bits is at their end.
const fn saturated(v: i128) -> i64 {
    if v > i64::MAX as i128 {
        i64::MAX
    } else if v < i64::MIN as i128 {
        i64::MIN
    } else {
        v as i64
    }
}

/// The scalar product of numbers with 48 fractional bits, which has 94. Out of line, as products of 128 bits
/// take much code: maps are set up once.
#[inline(never)]
const fn dot(a: &[Q48; 3], b: &[Q48; 3]) -> i128 {
    let (mut sum, mut k) = (0, 0);
    while k < 3 {
        // 126 bits and two more, less the two that are left out
        sum += (a[k] as i128 * b[k] as i128) >> 2;
        k += 1;
    }
    sum
}

/// Three numbers, one after the other.
const fn column(rows: &[[i64; 3]; 3], k: usize) -> [i64; 3] {
    [rows[0][k], rows[1][k], rows[2][k]]
}

/// An entry with 30 fractional bits below `2^length`.
#[inline(never)]
const fn mantissa(v: i64, length: i32) -> i64 {
    if length <= 30 {
        v << (30 - length)
    } else {
        // half a unit more, where it does not leave 64 bits
        ((v >> (length - 31)) + 1) >> 1
    }
}

/// The vector product of numbers below `2^31`.
#[inline(never)]
const fn cross(a: &[i64; 3], b: &[i64; 3]) -> [i64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A cofactor, brought to 62 bits by `shift`, over the determinant: 33 fractional bits.
#[inline(never)]
const fn entry(cofactor: i64, shift: i32, divisor: UQ63) -> i64 {
    quotient(if shift >= 0 { cofactor << shift } else { cofactor >> -shift }, 33, divisor)
}

impl Affine3 {
    /// The map that leaves everything where it is.
    pub const IDENTITY: Self = Self { rows: [[ONE, 0, 0], [0, ONE, 0], [0, 0, ONE]], translation: [0; 3] };

    /// `x -> A x + translation`, `A` by its rows.
    pub const fn matrix(rows: [Vec3<Wide>; 3], translation: Vec3<Wide>) -> Self {
        const fn bits(v: Vec3<Wide>) -> [i64; 3] {
            [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()]
        }
        let [x, y, z] = rows;
        Self { rows: [bits(x), bits(y), bits(z)], translation: bits(translation) }
    }

    /// `x -> x + by`.
    pub const fn translate(by: Vec3) -> Self {
        Self { translation: wide(by), ..Self::IDENTITY }
    }

    /// `x -> (f_x x, f_y y, f_z z)`: from the origin, and mirrored where a factor is below 0.
    pub const fn scale(factors: Vec3) -> Self {
        let [x, y, z] = wide(factors);
        Self { rows: [[x, 0, 0], [0, y, 0], [0, 0, z]], translation: [0; 3] }
    }

    /// The turn by `angle` about an axis through the origin, counter-clockwise when the axis points to the
    /// eye. Error: below `2^-26` in each entry (`a_turn_is_within_two_to_the_minus_26`). Source: Rodrigues'
    /// formula, `cos I + sin [a] + (1 - cos) a a^T`.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for an axis of length 0.
    pub fn rotate(axis: Vec3, angle: Angle) -> Result<Self, Error> {
        let axis = axis.normalised().ok_or(Error::Degenerate { what: "axis of a rotation" })?;
        let (sin, cos) = sin_cos(angle);
        let wide = |v: Unit| i64::from(v.to_bits());
        let (a, sin, cos) = ([wide(axis.x), wide(axis.y), wide(axis.z)], wide(sin), wide(cos));
        // 60 fractional bits, then 48
        let entry = |i: usize, j: usize, turned: i64| -> Q48 {
            let projected = (((1 << 30) - cos) * ((a[i] * a[j]) >> 30)) >> 12;
            let kept = if i == j { cos << 18 } else { 0 };
            kept + projected + ((sin * turned) >> 12)
        };
        let rows = [
            [entry(0, 0, 0), entry(0, 1, -a[2]), entry(0, 2, a[1])],
            [entry(1, 0, a[2]), entry(1, 1, 0), entry(1, 2, -a[0])],
            [entry(2, 0, -a[1]), entry(2, 1, a[0]), entry(2, 2, 0)],
        ];
        Ok(Self { rows, translation: [0; 3] })
    }

    /// First this map, then `next`. Each entry rounded down, and saturated.
    #[must_use]
    pub const fn then(&self, next: &Self) -> Self {
        let (mut map, mut i) = (*next, 0);
        while i < 3 {
            let (row, mut j) = (&next.rows[i], 0);
            while j < 3 {
                map.rows[i][j] = saturated(dot(row, &column(&self.rows, j)) >> 46);
                j += 1;
            }
            map.translation[i] = saturated((dot(row, &self.translation) >> 46) + next.translation[i] as i128);
            i += 1;
        }
        map
    }

    /// Where it takes a place, to nearest, saturated.
    pub const fn at(&self, place: Vec3) -> Vec3 {
        let (place, mut at, mut k) = (wide(place), [0; 3], 0);
        while k < 3 {
            at[k] = saturated((dot(&self.rows[k], &place) >> 46) + self.translation[k] as i128);
            k += 1;
        }
        reals(at)
    }

    /// The linear part's entries and the translation, to nearest, saturated.
    pub(crate) const fn parts(&self) -> ([Vec3; 3], Vec3) {
        let [x, y, z] = self.rows;
        ([reals(x), reals(y), reals(z)], reals(self.translation))
    }

    /// The greatest magnitude of an entry.
    pub(crate) const fn greatest(&self) -> Wide {
        Wide::from_bits(greatest(&self.rows))
    }

    /// The inverse of the linear part. Error: 3/4 of a unit of its 30 bits, for the matrix
    /// whose entries are rounded to 30 bits below the greatest (`an_inverse_is_the_exact_one_rounded`).
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a matrix whose determinant is 0.
    #[inline(never)]
    pub(crate) const fn inverse(&self) -> Result<Inverse, Error> {
        let degenerate = Error::Degenerate { what: "determinant of an affine map" };
        let size = greatest(&self.rows);
        if size == 0 {
            return Err(degenerate);
        }
        // mantissas with 30 fractional bits, the greatest in [1/2, 1]; a = mantissa 2^exponent
        let length = 64 - size.leading_zeros() as i32;
        let (mut a, mut k) = (self.rows, 0);
        while k < 9 {
            a[k / 3][k % 3] = mantissa(a[k / 3][k % 3], length);
            k += 1;
        }
        // products of two: 61 bits; the cofactors of a row, in its own order
        let [x, y, z] = &a;
        let cofactors = [cross(y, z), cross(z, x), cross(x, y)];
        let [first, ..] = &cofactors;
        let determinant = x[0] as i128 * first[0] as i128
            + x[1] as i128 * first[1] as i128
            + x[2] as i128 * first[2] as i128;
        let most = greatest(&cofactors);
        if determinant == 0 || most == 0 {
            return Err(degenerate);
        }
        // the determinant with 63 bits, the greatest cofactor with 62
        let size = determinant.unsigned_abs();
        let places = 65 - size.leading_zeros() as i32;
        let divisor: UQ63 = if places >= 0 { (size >> places) as u64 } else { (size as u64) << -places };
        let shift = most.leading_zeros() as i32 - 2;
        let sign = if determinant < 0 { -1 } else { 1 };
        // 33 fractional bits, the greatest in (1/4, 1]; transposed
        let (mut entries, mut k) = ([[0; 3]; 3], 0);
        while k < 9 {
            entries[k % 3][k / 3] = entry(sign * cofactors[k / 3][k % 3], shift, divisor);
            k += 1;
        }
        let halved = if greatest(&entries) >= (1 << 32) - 2 { 1 } else { 0 };
        let (mut rows, mut k) = ([[0; 3]; 3], 0);
        while k < 9 {
            rows[k / 3][k % 3] = (((entries[k / 3][k % 3] >> (1 + halved)) + 1) >> 1) as i32;
            k += 1;
        }
        // cofactors have 60 fractional bits, the determinant 90
        let exponent = 30 - shift - places - (length - 48) - 1 + halved;
        Ok(Inverse { rows, exponent })
    }
}

#[cfg(test)]
impl Affine3 {
    /// Linear part and translation.
    pub(crate) fn numbers(&self) -> ([[f64; 3]; 3], [f64; 3]) {
        let number = |v: i64| v as f64 / 2_f64.powi(48);
        (self.rows.map(|row| row.map(number)), self.translation.map(number))
    }
}

/// The greatest magnitude, saturated.
const fn greatest(rows: &[[i64; 3]; 3]) -> i64 {
    let (mut most, mut k) = (0, 0);
    while k < 9 {
        let size = rows[k / 3][k % 3].saturating_abs();
        most = if size > most { size } else { most };
        k += 1;
    }
    most
}

const fn wide(v: Vec3) -> [Q48; 3] {
    [(v.x.to_bits() as i64) << 24, (v.y.to_bits() as i64) << 24, (v.z.to_bits() as i64) << 24]
}

/// To nearest, saturated.
const fn real(v: Q48) -> Real {
    let rounded = ((v >> 23) + 1) >> 1;
    Real::from_bits(if rounded > i32::MAX as i64 {
        i32::MAX
    } else if rounded < i32::MIN as i64 {
        i32::MIN
    } else {
        rounded as i32
    })
}

const fn reals([x, y, z]: [Q48; 3]) -> Vec3 {
    Vec3::new(real(x), real(y), real(z))
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    fn numbers(map: &Affine3) -> [[f64; 3]; 3] {
        map.numbers().0
    }

    fn axis(rng: &mut Xoshiro128PlusPlus) -> Vec3 {
        let [x, y, z] = [(); 3].map(|()| Real::from_bits(rng.next_u32() as i32 >> 4));
        Vec3::new(x, y, z)
    }

    #[test]
    fn a_turn_is_within_two_to_the_minus_26() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(3);
        let mut worst: f64 = 0.0;
        for _ in 0..10_000 {
            let (about, angle) = (axis(&mut rng), rng.next_u32());
            let turn = numbers(&Affine3::rotate(about, Angle::from_bits(angle)).unwrap());
            let v = [about.x, about.y, about.z].map(|c| c.to_num::<f64>());
            let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
            let [x, y, z] = v.map(|c| c / length);
            let (s, c) = (f64::from(angle) / 2_f64.powi(32) * core::f64::consts::TAU).sin_cos();
            let k = 1.0 - c;
            let exact = [
                [c + k * x * x, k * x * y - s * z, k * x * z + s * y],
                [k * x * y + s * z, c + k * y * y, k * y * z - s * x],
                [k * x * z - s * y, k * y * z + s * x, c + k * z * z],
            ];
            for (got, exact) in turn.iter().flatten().zip(exact.iter().flatten()) {
                worst = worst.max((got - exact).abs());
            }
        }
        assert!(worst > 2_f64.powi(-29) && worst < 2_f64.powi(-26), "{worst:e}");
        assert_eq!(
            Affine3::rotate(Vec3::default(), Angle::ZERO),
            Err(Error::Degenerate { what: "axis of a rotation" })
        );
    }

    /// The inverse times the matrix is 1, in double precision, for matrices of all sizes and shapes.
    #[test]
    fn an_inverse_is_the_exact_one_rounded() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(4);
        let (mut worst, mut halves): (f64, _) = (0.0, [0; 2]);
        for k in 0..20_000 {
            let mut word = || i64::from(rng.next_u32() as i32) << 23 >> (k % 20);
            // every entry a whole number of the 30 bits that are looked at
            let rows = [[(); 3]; 3].map(|row| row.map(|()| word() >> 25 << 25));
            let mut map = Affine3 { rows, translation: [0; 3] };
            let greatest = map.greatest().to_bits();
            let length = 64 - greatest.leading_zeros();
            map.rows = map.rows.map(|row| row.map(|v| v >> (length - 30).min(40) << (length - 30).min(40)));
            let inverse = map.inverse().unwrap();
            let most = inverse.rows.iter().flatten().map(|v| v.unsigned_abs()).max().unwrap();
            assert!((1 << 29..=1 << 30).contains(&most), "{inverse:?}");
            let (a, scale) = (numbers(&map), 2_f64.powi(inverse.exponent - 30));
            // exact adjugate over determinant
            let minor = |i: usize, j: usize| {
                let (r, s, p, q) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
                a[r][p] * a[s][q] - a[r][q] * a[s][p]
            };
            let determinant: f64 = (0..3).map(|j| a[0][j] * minor(0, j)).sum();
            let size = a.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
            // what double precision itself leaves of a determinant that cancels
            if determinant.abs() < 1e-4 * size.powi(3) {
                continue;
            }
            halves[usize::from(k % 2 == 0)] += 1;
            for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                let exact = minor(j, i) / determinant;
                let got = f64::from(inverse.rows[i][j]);
                worst = worst.max((got - exact / scale).abs());
            }
        }
        assert!(halves[0] > 9_000 && halves[1] > 9_000, "{halves:?}");
        assert!(worst > 0.7 && worst < 0.76, "{worst}");
    }

    #[test]
    fn a_singular_matrix_has_no_inverse() {
        let degenerate = Err(Error::Degenerate { what: "determinant of an affine map" });
        let w = |n: i32| Wide::from_num(n);
        let row = |x, y, z| Vec3::new(w(x), w(y), w(z));
        for rows in [
            [row(0, 0, 0), row(0, 0, 0), row(0, 0, 0)],
            [row(1, 2, 3), row(4, 5, 6), row(7, 8, 9)],
            [row(1, 0, 0), row(0, 1, 0), row(0, 0, 0)],
            [row(5, 0, 0), row(0, 0, 0), row(0, 0, 0)],
        ] {
            assert_eq!(Affine3::matrix(rows, row(1, 2, 3)).inverse(), degenerate);
        }
        let identity = Affine3::IDENTITY.inverse().unwrap();
        let half = 1 << 29;
        assert_eq!(identity, Inverse { rows: [[half, 0, 0], [0, half, 0], [0, 0, half]], exponent: 1 });
        // the ends of the format
        let ends = Affine3 { rows: [[i64::MIN, 0, 0], [0, i64::MAX, 0], [0, 0, i64::MIN]], ..identity_map() };
        assert_eq!(ends.inverse().unwrap().exponent, -14);
    }

    fn identity_map() -> Affine3 {
        Affine3::IDENTITY
    }

    #[test]
    fn maps_are_composed_in_the_order_of_then() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(5);
        for _ in 0..1000 {
            let turn = Affine3::rotate(axis(&mut rng), Angle::from_bits(rng.next_u32())).unwrap();
            let scale = Affine3::scale(axis(&mut rng));
            let shift = Affine3::translate(axis(&mut rng));
            let place = axis(&mut rng);
            let place = Vec3::new(place.x >> 4, place.y >> 4, place.z >> 4);
            let at_once = scale.then(&turn).then(&shift).at(place);
            let steps = shift.at(turn.at(scale.at(place)));
            for (a, b) in [(at_once.x, steps.x), (at_once.y, steps.y), (at_once.z, steps.z)] {
                assert!(a.abs_diff(b).to_bits() <= 3, "{at_once:?} {steps:?}");
            }
        }
        let far = Affine3::scale(Vec3::new(Real::MAX, Real::MAX, Real::MIN));
        let farther = far.then(&far).then(&far).then(&far).then(&far);
        assert_eq!(farther.rows.map(|row| row[0])[0], i64::MAX);
        assert_eq!(farther.at(Vec3::lit("1", "-1", "1")), Vec3::new(Real::MAX, Real::MIN, Real::MIN));
        assert_eq!(farther.parts().0[2].z, Real::MIN);
    }
}
