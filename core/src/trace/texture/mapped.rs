//! Texture coordinates of another scale, turned, moved: `U = a_u s + b_u t + c_u`, `V = a_v s + b_v t + c_v`.
//!
//! What looks at `(U, V)` also asks how the point moves with them; by the chain rule
//! `(P_U, P_V) = (P_s, P_t) M^-1`, `M` the matrix of `a` and `b`.
//!
//! Source: the course unit V, section 5.8.1.
//!
//! Format: all 24 fractional bits.

use super::super::surface::{Chart, SurfacePoint};
use super::field::Texture;
use crate::Error;
use crate::num::{Real, Rgb, Vec3, product, quotient};

/// A texture, or whatever else looks at texture coordinates, by other coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mapped<T> {
    texture: T,
    rows: [[Real; 3]; 2],
    /// `M^-1`.
    inverse: [[Real; 2]; 2],
}

impl<T> Mapped<T> {
    /// By the coordinates `[a_u, b_u, c_u]` and `[a_v, b_v, c_v]`.
    ///
    /// # Errors
    /// [`Error::Degenerate`] when both are the same coordinate: `a_u b_v = b_u a_v`.
    pub fn new(texture: T, rows: [[Real; 3]; 2]) -> Result<Self, Error> {
        let [[a, b, _], [c, d, _]] = rows;
        // 48 fractional bits
        let determinant = product(a.to_bits(), d.to_bits()).saturating_sub(product(b.to_bits(), c.to_bits()));
        if determinant == 0 {
            return Err(Error::Degenerate { what: "determinant of texture coordinates" });
        }
        let over = |cofactor: i64| {
            let magnitude = quotient(cofactor, 48, determinant.unsigned_abs());
            let signed = if determinant < 0 { magnitude.saturating_neg() } else { magnitude };
            Real::from_bits(signed.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        };
        let [a, b, c, d] = [a, b, c, d].map(|entry| i64::from(entry.to_bits()));
        Ok(Self { texture, rows, inverse: [[over(d), over(-b)], [over(-c), over(a)]] })
    }

    /// Repeated so many times along `u` and `v`: a whole number, so that it closes round a shape.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for 0.
    pub fn repeated(texture: T, across: i8, up: i8) -> Result<Self, Error> {
        let times = |n: i8| Real::from_bits(i32::from(n) << 24);
        Self::new(texture, [[times(across), Real::ZERO, Real::ZERO], [Real::ZERO, times(up), Real::ZERO]])
    }

    /// What is mapped.
    pub const fn inner(&self) -> &T {
        &self.texture
    }

    /// `[a_u, b_u, c_u]` and `[a_v, b_v, c_v]`.
    pub const fn rows(&self) -> &[[Real; 3]; 2] {
        &self.rows
    }

    /// A point by the other coordinates: saturated. Error: below `2^-23` in a coordinate
    /// (`other_coordinates_are_the_affine_ones_and_their_tangents_follow`).
    pub fn point(&self, point: &SurfacePoint) -> SurfacePoint {
        let chart = &point.chart;
        let coordinate = |[a, b, c]: [Real; 3]| {
            let sum = (product(a.to_bits(), chart.u.to_bits()) >> 24)
                + (product(b.to_bits(), chart.v.to_bits()) >> 24)
                + i64::from(c.to_bits());
            Real::from_bits(sum.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        };
        let combined = |s: Real, t: Real| {
            let component = |p: Real, q: Real| {
                let sum =
                    (product(s.to_bits(), p.to_bits()) >> 24) + (product(t.to_bits(), q.to_bits()) >> 24);
                Real::from_bits(sum.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
            };
            let (p, q) = (chart.along_u, chart.along_v);
            Vec3::new(component(p.x, q.x), component(p.y, q.y), component(p.z, q.z))
        };
        let [[a, b], [c, d]] = self.inverse;
        let chart = Chart {
            u: coordinate(self.rows[0]),
            v: coordinate(self.rows[1]),
            along_u: combined(a, c),
            along_v: combined(b, d),
        };
        SurfacePoint { chart, ..*point }
    }
}

impl<T: Texture> Texture for Mapped<T> {
    fn is_charted(&self) -> bool {
        true
    }

    fn at(&self, point: &SurfacePoint) -> Rgb {
        self.texture.at(&self.point(point))
    }
}

#[cfg(test)]
mod tests {
    use super::super::image::{Image, Lookup, Texels};
    use super::super::testing::charted;
    use super::*;

    #[test]
    fn other_coordinates_are_the_affine_ones_and_their_tangents_follow() {
        let rows = [[2.0, -0.5, 0.25], [0.75, 3.0, -1.5]];
        let mapped = Mapped::new(Rgb::WHITE, rows.map(|row| row.map(Real::from_num))).unwrap();
        assert_eq!(mapped.inner(), &Rgb::WHITE);
        let determinant = 2.0 * 3.0 + 0.5 * 0.75;
        let mut worst: f64 = 0.0;
        for n in 0..500_i32 {
            let (s, t) =
                (Real::from_bits(n.wrapping_mul(48_271) >> 2), Real::from_bits(n.wrapping_mul(-69_621) >> 2));
            let point = mapped.point(&charted(s, t));
            let (s, t) = (s.to_num::<f64>(), t.to_num::<f64>());
            for (got, [a, b, c]) in [point.chart.u, point.chart.v].into_iter().zip(rows) {
                worst = worst.max((got.to_num::<f64>() - (a * s + b * t + c)).abs());
            }
            let tangents =
                [point.chart.along_u.x, point.chart.along_u.y, point.chart.along_v.x, point.chart.along_v.y];
            for (got, exact) in tangents.into_iter().zip([3.0, -0.75, 0.5, 2.0]) {
                assert!((got.to_num::<f64>() - exact / determinant).abs() < 1e-6);
            }
        }
        assert!(worst > 2_f64.powi(-25) && worst < 2_f64.powi(-23), "{worst:e}");
        let singular = rows.map(|_| [Real::ONE; 3]);
        assert!(Mapped::new(Rgb::WHITE, singular).is_err() && Mapped::repeated(Rgb::WHITE, 0, 3).is_err());
    }

    /// Texture scanning goes from texels to the surface and paints what each covers, inverse scanning from
    /// places of the surface to texels: both make one picture.
    #[test]
    fn texture_scanning_and_inverse_scanning_agree() {
        const SIDE: usize = 64;
        let bytes: std::vec::Vec<u8> = (0..6 * 4).map(|i| 40 + 9 * i).collect();
        let image = Image::new(Texels::Linear, 6, 4, &bytes).unwrap().with_lookup(Lookup::Nearest);
        // U = 0.8 s + 0.3 t + 0.05, V = -0.2 s + 0.9 t + 0.15
        let [[a, b, c], [d, e, f]] = [[0.8, 0.3, 0.05], [-0.2, 0.9, 0.15]];
        let mapped = Mapped::new(image, [[a, b, c], [d, e, f]].map(|row| row.map(Real::from_num))).unwrap();
        // inverse: the texel at the middle of each place
        let middle = |k: usize| (k as f64 + 0.5) / SIDE as f64;
        let inverse =
            |i: usize, j: usize| mapped.at(&charted(Real::from_num(middle(i)), Real::from_num(middle(j))));
        // scanning: each texel, its neighbours round the seams too, as a parallelogram of the surface
        let determinant = a * e - b * d;
        let (mut painted, mut same) = (0, 0);
        for (row, column) in (-8..12).flat_map(|row| (-12..18).map(move |column| (row, column))) {
            let corner = |x: i32, y: i32| {
                let (u, v) = (f64::from(column + x) / 6.0 - c, 1.0 - f64::from(row + y) / 4.0 - f);
                ((e * u - b * v) / determinant, (a * v - d * u) / determinant)
            };
            let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            for (i, j) in (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| (i, j))) {
                let turns = (0..4).map(|k| {
                    let ((x, y), (z, w)) = (corners[k], corners[(k + 1) % 4]);
                    (z - x) * (middle(j) - y) - (w - y) * (middle(i) - x)
                });
                let turns: std::vec::Vec<f64> = turns.collect();
                if turns.iter().all(|t| *t < -1e-6) || turns.iter().all(|t| *t > 1e-6) {
                    painted += 1;
                    let texel = bytes[(row.rem_euclid(4) * 6 + column.rem_euclid(6)) as usize];
                    same += usize::from(
                        (inverse(i, j).g.to_num::<f64>() - f64::from(texel) / 255.0).abs() < 1e-4,
                    );
                }
            }
        }
        assert!(painted == same && painted > SIDE * SIDE - 40, "{same} of {painted}");
    }

    #[test]
    fn a_whole_number_of_images_closes_round_a_shape() {
        let bytes = [0, 50, 100, 150, 200, 250];
        let image = Image::new(Texels::Linear, 6, 1, &bytes).unwrap();
        for times in [1, 3, -5] {
            let mapped = Mapped::repeated(image, times, 1).unwrap();
            for n in 0..50 {
                let u = Real::from_bits(n * 330_000);
                let [here, once_round] = [u, u + Real::ONE].map(|u| mapped.at(&charted(u, Real::ZERO)));
                assert_eq!(here, once_round, "{times} {n}");
            }
        }
    }
}
