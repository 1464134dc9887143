//! What a curve looks like at its ends and its joints, from the eigenvalues of its maps.
//!
//! `L_i` is `T_i` on differences of points. Towards the end `c_0` the curve repeats itself under `L_0`: real
//! eigenvalues draw it along a half-tangent, the eigenvector of the greater one; complex ones turn it in a
//! spiral. At a joint the images of both ends meet: `L_0 u_1` and `L_1 u_0` are its half-tangents there.
//!
//! For two maps of three control points: `L_i` is a matrix of two rows, and everything is a root of a
//! quadratic equation. Being on one line, and on which side of a point, are the same for all control points
//! that are not on one line themselves.
//!
//! Source: Tosan, Guerin, Baskurt, section 3.2 and figure 2. Formats: 28 fractional bits in 64.

use super::barycentric::Barycentric;
use super::curve::ProjectedCurve;
use crate::num::formats::Q28;
use crate::num::{Angle, Real, atan2};
use crate::plane::Point2;

/// How a curve comes to one of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum End {
    /// Along a half-tangent: real eigenvalues, the greater of which is positive.
    HalfTangent,
    /// From both sides in turn, along one line: the greater eigenvalue is negative.
    Alternating,
    /// In a spiral: complex eigenvalues.
    Spiral,
    /// Along neither of two lines: eigenvalues of opposite sign and equal magnitude.
    Balanced,
}

/// What a curve does at a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Joint {
    /// Its half-tangents are opposite: it goes on in the same direction.
    Smooth,
    /// Its half-tangents are not on one line.
    Angle,
    /// Its half-tangents are the same: it turns back.
    Cusp,
    /// There are not two half-tangents.
    Rough,
}

/// The aspect of a curve: both ends and the joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aspect {
    /// How it comes to `c_0`, and to the right side of every joint.
    pub first: End,
    /// How it comes to `c_1`, and to the left side of every joint.
    pub last: End,
    /// What it does at joints.
    pub joint: Joint,
}

/// A difference of points, in coordinates `e_1 - e_0` and `e_2 - e_0`, 28 fractional bits.
type Vector = [i64; 2];

/// `L`: a matrix on differences.
struct Linear([[i64; 2]; 2]);

impl Linear {
    fn of(map: &Barycentric<3>) -> Self {
        let [_, one, two] = map.rows();
        let row = |[zero, first, second]: &[Q28; 3]| {
            [i64::from(*first) - i64::from(*zero), i64::from(*second) - i64::from(*zero)]
        };
        Self([row(one), row(two)])
    }

    /// `(L - shift) v`, rounded down; `|v| < 2^33`.
    fn image(&self, v: Vector, shift: i64) -> Vector {
        let [[a, b], [c, d]] = self.0;
        let row = |a: i64, b: i64| {
            ((i128::from(a) * i128::from(v[0]) + i128::from(b) * i128::from(v[1])) >> 28) as i64
        };
        [row(a - shift, b), row(c, d - shift)]
    }

    /// How a difference is drawn to 0, and the half-tangent of a curve that begins there with `v`.
    fn end(&self, v: Vector) -> (End, Option<Vector>) {
        let [[a, b], [c, d]] = self.0;
        let trace = a + d;
        let determinant = i128::from(a) * i128::from(d) - i128::from(b) * i128::from(c);
        // 56 fractional bits, below 2^68
        let discriminant = i128::from(trace) * i128::from(trace) - 4 * determinant;
        let Ok(square) = u128::try_from(discriminant) else { return (End::Spiral, None) };
        let root = square.isqrt() as i64;
        if root > 0 && trace == 0 {
            return (End::Balanced, None);
        }
        if trace < 0 {
            return (End::Alternating, None);
        }
        // L - (lesser eigenvalue) leaves of v what is along the eigenvector of the greater
        let along = self.image(v, (trace - root) >> 1);
        // a v that is an eigenvector of the lesser stays on its line
        let tangent = if size(along) <= 1 << 4 { v } else { along };
        (End::HalfTangent, Some(tangent))
    }
}

fn size(v: Vector) -> u64 {
    v[0].unsigned_abs().max(v[1].unsigned_abs())
}

/// Whether two vectors point the same way, or opposite ways, to within `2^-16` of a radian or so.
fn joint(a: Vector, b: Vector) -> Joint {
    let product = |a: i64, b: i64| i128::from(a) * i128::from(b);
    let cross = product(a[0], b[1]) - product(a[1], b[0]);
    let dot = product(a[0], b[0]) + product(a[1], b[1]);
    if cross.unsigned_abs() > (u128::from(size(a)) * u128::from(size(b))) >> 16 {
        Joint::Angle
    } else if dot < 0 {
        Joint::Smooth
    } else {
        Joint::Cusp
    }
}

impl ProjectedCurve<2, 3> {
    /// The half-tangents at the joint `1/2`, towards 0 and towards 1, with the aspect of both ends.
    fn at_joint(&self) -> ([End; 2], [Option<Vector>; 2]) {
        let [first, last] = self.maps().each_ref().map(Linear::of);
        let [c0, c1] = self.end_weights();
        let from = |a: [Q28; 3], b: [Q28; 3]| -> Vector {
            [i64::from(b[1]) - i64::from(a[1]), i64::from(b[2]) - i64::from(a[2])]
        };
        let ((left, u0), (right, u1)) = (first.end(from(c0, c1)), last.end(from(c1, c0)));
        ([left, right], [u1.map(|u| first.image(u, 0)), u0.map(|u| last.image(u, 0))])
    }

    /// What it looks like at its ends and its joints.
    ///
    /// Error: half-tangents that are aligned to within `2^-16` count as aligned
    /// (`figure_2_has_six_types`).
    pub fn aspect(&self) -> Aspect {
        let ([first, last], tangents) = self.at_joint();
        let joint = match tangents {
            [Some(a), Some(b)] => joint(a, b),
            _ => Joint::Rough,
        };
        Aspect { first, last, joint }
    }

    /// By how much it turns to the left at the joint 1/2 with these control points; none without two
    /// half-tangents.
    pub fn turn(&self, points: &[Point2; 3]) -> Option<Angle> {
        let (_, [Some(back), Some(on)]) = self.at_joint() else { return None };
        let [p, q, r] = points;
        // |v| < 2^33 and |p| < 2^31: sums below 2^67
        let coordinate = |v: Vector, [p, q, r]: [Real; 3]| {
            let along =
                |to: Real, by: i64| (i128::from(to.to_bits()) - i128::from(p.to_bits())) * i128::from(by);
            along(q, v[0]) + along(r, v[1])
        };
        let [[bx, by], [ox, oy]] = [back, on].map(|v| {
            let both = [coordinate(v, [p.x, q.x, r.x]), coordinate(v, [p.y, q.y, r.y])];
            // to 30 bits, the longer exactly
            let bits = 128 - (both[0].unsigned_abs() | both[1].unsigned_abs()).leading_zeros();
            both.map(|c| (c >> bits.saturating_sub(30)) as i32)
        });
        Some(atan2(oy, ox).wrapping_sub(atan2(by.wrapping_neg(), bx.wrapping_neg())))
    }
}
