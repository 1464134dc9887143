//! A half-space `n p <= d` in any direction: what a polyhedron and the edges of a polygon are made of.

use crate::Error;
use crate::num::formats::{Q28, Q30, Q58};
use crate::num::{Near, Real, Unit, Vec3, Wide, product, quotient, sqrt, square, unit};

/// All places `p` with `n p <= d`, `n` of length 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HalfSpace {
    pub(super) normal: [Q30; 3],
    pub(super) distance: Q28,
}

impl HalfSpace {
    /// The half-space `normal p <= distance`; the normal is made 1 long, and the distance with it.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a normal of length 0; [`Error::OutOfRange`] for a plane 4 or more from the
    /// origin.
    pub fn new(normal: Vec3<Wide>, distance: Wide) -> Result<Self, Error> {
        let bits = [normal.x, normal.y, normal.z].map(Wide::to_bits);
        let all = bits.iter().fold(0, |all, c| all | c.unsigned_abs());
        if all == 0 {
            return Err(Error::Degenerate { what: "normal of a plane" });
        }
        // words of 31 bits and a sign: the normal 2^places
        let places = all.leading_zeros() as i32 - 34;
        let words = bits.map(|c| if places < 0 { c >> -places } else { c << places } as i32);
        let length = u64::from(sqrt(square(words)));
        // 28 fractional bits; a normal of 48 fractional bits 2^places
        let d = distance.to_bits();
        let shift = 28 + places;
        let scaled =
            if shift < 0 { quotient(d >> -shift, 0, length) } else { quotient(d, shift as u32, length) };
        if scaled.unsigned_abs() >= 4 << 28 {
            let (min, max) = (Wide::from_num(-4), Wide::from_num(4));
            let value = Wide::from_bits(scaled.saturating_mul(1 << 20));
            return Err(Error::OutOfRange { what: "distance of a plane", index: None, value, min, max });
        }
        let normal = unit(words);
        Ok(Self { normal: [normal.x, normal.y, normal.z].map(Unit::to_bits), distance: scaled as i32 })
    }

    /// The scalar product with the normal: 28 fractional bits for a vector with 28, which is within ±4.
    #[inline(always)]
    pub(super) fn along(&self, v: [Q28; 3]) -> Q28 {
        let sum: Q58 = product(self.normal[0], v[0])
            .wrapping_add(product(self.normal[1], v[1]))
            .wrapping_add(product(self.normal[2], v[2]));
        (sum >> 30) as i32
    }

    /// How far above the plane a place of the world's format is, 48 fractional bits.
    pub(super) fn above(&self, place: Vec3) -> Wide {
        let v = [place.x, place.y, place.z].map(Real::to_bits);
        let sum = product(self.normal[0], v[0]) / 64
            + product(self.normal[1], v[1]) / 64
            + product(self.normal[2], v[2]) / 64;
        Wide::from_bits(sum) - Wide::from(Near::from_bits(self.distance))
    }

    /// The normal as the shape's.
    pub(super) fn outward(&self) -> Vec3<Near> {
        let [x, y, z] = self.normal.map(|c| Near::from_bits(c >> 2));
        Vec3::new(x, y, z)
    }

    /// A right-handed pair of directions in the plane, with the normal: the first horizontal, or along `x`
    /// where the plane is.
    pub(super) fn frame(&self) -> [Vec3<Unit>; 2] {
        let [x, y, z] = self.normal;
        let normal = Vec3::new(Unit::from_bits(x), Unit::from_bits(y), Unit::from_bits(z));
        let across = unit([y.wrapping_neg(), x, 0]);
        let flat = x | y == 0;
        let u = if flat { Vec3::new(Unit::ONE, Unit::ZERO, Unit::ZERO) } else { across };
        [u, normal.cross(u)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::exact::words;
    use super::*;

    #[test]
    fn a_half_space_is_normalised() {
        let mut word = words(23);
        let (mut tried, mut worst): (u32, [f64; 2]) = (0, [0.0; 2]);
        for k in 0..20_000 {
            let mut random = || Wide::from_bits(word() as i64 >> (k % 45));
            let (normal, distance) = (Vec3::new(random(), random(), random()), random());
            let n = [normal.x, normal.y, normal.z].map(|c| c.to_num::<f64>());
            let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
            let d = distance.to_num::<f64>() / length;
            match HalfSpace::new(normal, distance) {
                Ok(got) => {
                    tried += 1;
                    assert!(d.abs() < 4.000_001);
                    worst[1] = worst[1].max((f64::from(got.distance) / 2_f64.powi(28) - d).abs());
                    for (got, c) in got.normal.into_iter().zip(n) {
                        worst[0] = worst[0].max((f64::from(got) / 2_f64.powi(30) - c / length).abs());
                    }
                }
                Err(_) => assert!(d.abs() > 3.999_999, "{d}"),
            }
        }
        assert!(
            tried > 18_000 && worst[0] < 2_f64.powi(-28) && worst[1] < 2_f64.powi(-25),
            "{tried} {worst:?}"
        );
        let zero = Wide::ZERO;
        assert_eq!(
            HalfSpace::new(Vec3::new(zero, zero, zero), Wide::ONE),
            Err(Error::Degenerate { what: "normal of a plane" })
        );
    }

    #[test]
    fn a_frame_is_right_handed() {
        for [x, y, z] in [[0, 0, 1], [0, 0, -1], [1, 0, 0], [3, -4, 0], [1, 2, 3], [-5, 1, -1]] {
            let w = Wide::from_num;
            let plane = HalfSpace::new(Vec3::new(w(x), w(y), w(z)), Wide::ZERO).unwrap();
            let [u, v] = plane.frame();
            let [nx, ny, nz] = plane.normal.map(Unit::from_bits);
            let cross = u.cross(v);
            for (a, b) in [(cross.x, nx), (cross.y, ny), (cross.z, nz)] {
                assert!(a.abs_diff(b) < Unit::from_bits(32).unsigned_abs(), "{x} {y} {z}");
            }
            assert!(
                u.dot(v).abs() < Unit::from_bits(16) && (u.dot(u) - Unit::ONE).abs() < Unit::from_bits(16)
            );
        }
    }
}
