//! The tapered cylinder: `F = x^2 + y^2 - (1 + (S - 1) z)^2`, `0 < z < 1`, with base and cap. `S` = 1 is the
//! cylinder, `S` = 0 the cone.
//!
//! A ray is cut to `0 <= z <= 1` first: there is no other nappe then. What is left of it is inside where
//! `a s^2 + 2 b s + c < 0`, `s` from where `x^2 + y^2 + (1 + (S - 1) z)^2` is least. Where `a` is below 0,
//! that is outside the roots, and the slab leaves one of the two sides. A ray nearly along the axis has an
//! `a` and a `b` close to 0, one close to the tip a `b` and a `c`: where they are that small, all powers of
//! two go out of them before 25 fractional bits are kept.
//!
//! Faces: 0 is the side, 1 the base at `z = 0`, 2 the cap at `z = 1`. Texture coordinates: on the side
//! `u = atan2(y, x) / 2 pi`, `v = z`; on the cap `u = (1 + x) / 2`, on the base `u = (1 - x) / 2`, on both
//! `v = (1 + y) / 2`.

use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape, corners};
use super::slab::{Part, over, slowness};
use super::sphere::{PI, radial, turns};
use crate::Error;
use crate::num::formats::{Q25, Q28, Q31, Q56};
use crate::num::{Near, Real, Unit, Vec3, Wide, atan2, product, rough_sqrt};

/// The generic tapered cylinder: a base of radius 1 at `z` = 0, a cap of radius `S` at `z` = 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TaperedCylinder {
    /// `S - 1`.
    taper: Q28,
}

/// The number of the side.
const SIDE: u8 = 0;

impl TaperedCylinder {
    /// The cylinder.
    pub const CYLINDER: Self = Self { taper: 0 };
    /// The cone.
    pub const CONE: Self = Self { taper: -(1 << 28) };

    /// With a cap of this radius, the text's `S`: 0 to 1.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for another radius.
    pub fn new(cap: Real) -> Result<Self, Error> {
        if !(Real::ZERO..=Real::ONE).contains(&cap) {
            let (min, max) = (Wide::ZERO, Wide::ONE);
            return Err(Error::OutOfRange { what: "cap", index: None, value: cap.into(), min, max });
        }
        Ok(Self { taper: (cap - Real::ONE).to_bits() << 4 })
    }

    /// The radius at a height, with 28 fractional bits.
    #[inline(always)]
    fn radius(self, z: Q28) -> Q28 {
        (1 << 28) + (product(self.taper, z) >> 28) as i32
    }

    /// Cuts a part of a ray, within the slab, to what is inside the side's cone; false for nothing.
    #[inline(always)]
    fn side(self, o: [Q28; 3], [dx, dy, dz]: [Q28; 3], part: &mut Part) -> bool {
        let (e, de) = (self.radius(o[2]), (product(self.taper, dz) >> 28) as i32);
        let (level, steep) = (product(dx, dx) + product(dy, dy), product(de, de));
        // where x^2 + y^2 + e^2 is least: at the axis of a cylinder, at the tip of a cone
        let towards = -((product(o[0], dx) + product(o[1], dy) + product(e, de)) >> 30) as i32;
        let start = over(towards, slowness(((level + steep) >> 30) as i32)).clamp(part.begin.0, part.end.0);
        let [x, y, z] =
            [(o[0], dx), (o[1], dy), (o[2], dz)].map(|(o, d)| i64::from(o) + (product(d, start) >> 28));
        if x.abs().max(y.abs()) >= 4 << 28 {
            return false;
        }
        let (x, y) = (x as i32, y as i32);
        let e = self.radius(z as i32);
        // 56 fractional bits: below 8, 16 and 32
        let a = level - steep;
        let b = product(x, dx) + product(y, dy) - product(e, de);
        let c = product(x, x) + product(y, y) - product(e, e);
        let roots = if are_ordinary(a, b, c) { plain_roots(a, b, c) } else { scaled_roots(a, b, c) };
        let (far, near, is_convex) = match roots {
            Roots::None(is_inside) => return is_inside,
            Roots::Two { far, near, is_convex } => (far, near, is_convex),
        };
        let [far, near] = [far, near].map(|s| match s {
            i32::MIN | i32::MAX => s,
            s => s.saturating_add(start),
        });
        // an `a` of nearly 0 may have either sign: that of the far root goes with it
        let (first, second) = if far < near { (far, near) } else { (near, far) };
        if is_convex {
            part.from(first, SIDE);
            part.until(second, SIDE);
        } else if part.begin.0 < first {
            part.until(first, SIDE);
        } else {
            part.from(second, SIDE);
        }
        true
    }
}

/// The roots of `a s^2 + 2 b s + c`, and whether it is below 0 between them or outside; where there are none,
/// whether it is below 0 everywhere.
enum Roots {
    None(bool),
    Two { far: Q28, near: Q28, is_convex: bool },
}

/// Whether `a` is from 1/8 to 8, `b` and `c` are below 2 and `c` is at least 1/64 in size.
#[inline(always)]
fn are_ordinary(a: Q56, b: Q56, c: Q56) -> bool {
    let [a, b, c] = [a, b, c].map(|v| (v >> 32) as i32);
    let [b, c] = [b, c].map(|v| v ^ (v >> 31));
    (a >> 2 | b | c) >> 25 == 0 && a >= 1 << 21 && c >= 1 << 18
}

/// The roots of ordinary coefficients: as such they have all bits that it takes.
#[inline(always)]
fn plain_roots(a: Q56, b: Q56, c: Q56) -> Roots {
    let [a, b, c]: [Q28; 3] = [a, b, c].map(|v| (v >> 28) as i32);
    let discriminant = product(b, b) - product(a, c);
    if discriminant <= 0 {
        return Roots::None(false);
    }
    let (root, slowness) = (rough_sqrt(discriminant as u64) as i32, slowness(a));
    let [far, near] = [-root, root].map(|root| over(root - b, slowness));
    Roots::Two { far, near, is_convex: true }
}

/// The roots of any coefficients.
#[cold]
#[inline(never)]
fn scaled_roots(a: Q56, b: Q56, c: Q56) -> Roots {
    // 4^m a, 2^(m + q) b, 4^q c are below 16 and have 25 fractional bits then
    let places = |v: i64| (v ^ (v >> 63)).leading_zeros().saturating_sub(4);
    // v 2^up / 2^31, by words: a 64-bit shift by a variable takes three times as long
    let word = |v: i64, up: u32| {
        let (high, low) = if up & 32 == 0 { ((v >> 32) as u32, v as u32) } else { (v as u32, 0) };
        (high << (up & 31) << 1 | low >> (!up & 31)) as i32
    };
    let (most, far_up, near_up) = (places(b), places(a) & !1, places(c) & !1);
    let m = (far_up >> 1).min(most);
    let q = (near_up >> 1).min(most - m);
    // for the roots all that a and c have
    let [far_under, near_over] = [word(a, far_up), word(c, near_up)];
    let (a, b, c) = (word(a, 2 * m), word(b, m + q), word(c, 2 * q));
    let discriminant = product(b, b) - product(a, c);
    if discriminant <= 0 || (a | b) == 0 {
        return Roots::None(if a == 0 { c < 0 } else { a < 0 });
    }
    let root = rough_sqrt(discriminant as u64) as i32;
    // the sum that does not cancel out; the other root is c over it
    let sum: Q25 = if b > 0 { -b - root } else { root - b };
    let (up, far_up, near_up) = ((m + q) as i32, far_up as i32, near_up as i32);
    let (far, near) = (quotient(sum, far_under, far_up - up), quotient(near_over, sum, up - near_up));
    Roots::Two { far, near, is_convex: far_under >= 0 }
}

/// `2^up v / d` for words of one format, 28 fractional bits, saturated.
#[inline(always)]
fn quotient(v: Q25, d: Q25, up: i32) -> Q28 {
    let (mantissa, zeros): (Q31, u32) = slowness(d);
    let signed = if d < 0 { v.wrapping_neg() } else { v };
    let up = up + zeros as i32;
    // v mantissa 2^up / 2^34
    let near = over(signed, (mantissa, up.clamp(0, 31) as u32));
    if up < 0 {
        near >> (-up).min(31)
    } else if up > 31 {
        let (up, sign) = ((up - 31).min(31), near >> 31);
        if near >> (31 - up) == sign { near << up } else { sign ^ i32::MAX }
    } else {
        near
    }
}

impl TaperedCylinder {
    pub(super) const BOUNDS: Option<[Vec3<Near>; 2]> = Some(corners([-1, -1, 0], [1, 1, 1]));
    /// The root of 5/4.
    pub(super) const RADIUS: Option<Near> = Some(Near::lit("1.118034"));
    pub(super) const ERROR: Near = Near::from_bits(32);
}

impl Shape for TaperedCylinder {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Self::BOUNDS
    }

    fn radius(&self) -> Option<Near> {
        Self::RADIUS
    }

    fn faces(&self) -> u8 {
        3
    }

    fn error(&self) -> Near {
        Self::ERROR
    }

    /// Error: on the surface within `2^-23` (`rays_meet_the_tapered_cylinder_where_they_should`). Cost:
    /// kernel `tapered cylinder`.
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
        let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
        let mut part = Part::ALL;
        let slowness = slowness(d[2]);
        let (base, cap) = if d[2] < 0 {
            (over(o[2], slowness), over(o[2].wrapping_sub(1 << 28), slowness))
        } else {
            (over(-o[2], slowness), over((1_i32 << 28).wrapping_sub(o[2]), slowness))
        };
        if d[2] < 0 {
            part.from(cap, 2);
            part.until(base, 1);
        } else {
            part.from(base, 1);
            part.until(cap, 2);
        }
        if part.begin.0 < part.end.0 && self.side(o, d, &mut part) {
            part.hand_over(from, found);
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let [x, y, z] = [place.x, place.y, place.z].map(|c| i64::from(c.to_bits()));
        let radius = (1 << 24) + ((i64::from(self.taper) * z) >> 28);
        // 48 fractional bits; x^2 + y^2 is at most 32768
        let side = (x * x).saturating_add(y * y).saturating_sub(radius.saturating_mul(radius));
        Wide::from_bits(side.max(-z << 24).max((z - (1 << 24)) << 24))
    }

    fn is_clear_of(&self, place: Vec3) -> bool {
        // the greatest slope of the function is 2 times the distance from the axis, near the surface
        self.value(place) > Wide::ONE >> 10
    }

    fn normal(&self, place: Vec3<Near>, face: u8) -> Vec3<Near> {
        let one = Near::ONE;
        match face {
            1 => Vec3::new(Near::ZERO, Near::ZERO, -one),
            // the tip of a cone has no direction of its own
            SIDE if !(place.x == 0 && place.y == 0) => {
                let [x, y] = radial(place.x.to_bits(), place.y.to_bits());
                let near = |c: Unit| Near::from_bits(c.to_bits() >> 2);
                Vec3::new(near(x), near(y), -Near::from_bits(self.taper))
            }
            _ => Vec3::new(Near::ZERO, Near::ZERO, one),
        }
    }

    fn chart(&self, place: Vec3<Real>, face: u8) -> Chart {
        let (x, y) = (place.x, place.y);
        if face == SIDE {
            let [cos, sin] = radial(x.to_bits(), y.to_bits());
            let turned = |c: Real| Real::from_bits((product(c.to_bits(), PI) >> 28) as i32);
            let slope = |c: Unit| Real::from_bits((product(c.to_bits(), self.taper) >> 34) as i32);
            return Chart {
                u: turns(atan2(y.to_bits(), x.to_bits())),
                v: place.z,
                along_u: Vec3::new(turned(-y), turned(x), Real::ZERO),
                along_v: Vec3::new(slope(cos), slope(sin), Real::ONE),
            };
        }
        let (r, two) = if face == 1 { (-x, Real::ONE * -2) } else { (x, Real::ONE * 2) };
        let half = |c: Real| (c >> 1) + Real::ONE / 2;
        Chart {
            u: half(r),
            v: half(y),
            along_u: Vec3::new(two, Real::ZERO, Real::ZERO),
            along_v: Vec3::new(Real::ZERO, Real::ONE * 2, Real::ZERO),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::judge::{Seen, V, convex, crossings, vector};
    use super::*;

    const CAPS: [f64; 5] = [0.0, 1.0, 0.5, 0.03125, 0.99];

    /// The part of a ray inside, with all planes and the side moved outwards by `offset`.
    fn part(cap: f64, o: V, d: V, offset: f64) -> Option<[f64; 2]> {
        let (mut begin, mut end) = if d[2] == 0.0 {
            if o[2] < -offset || o[2] > 1.0 + offset {
                return None;
            }
            (f64::NEG_INFINITY, f64::INFINITY)
        } else {
            let [a, b] = [-offset, 1.0 + offset].map(|z| (z - o[2]) / d[2]);
            (a.min(b), a.max(b))
        };
        let k = cap - 1.0;
        let (e, de) = (1.0 + offset + k * o[2], k * d[2]);
        // a grown cone's tip is above the cap
        let a = d[0] * d[0] + d[1] * d[1] - de * de;
        let b = o[0] * d[0] + o[1] * d[1] - e * de;
        let c = o[0] * o[0] + o[1] * o[1] - e * e;
        let discriminant = if k == 0.0 {
            // one square less to cancel
            a * e * e - (o[0] * d[1] - o[1] * d[0]).powi(2)
        } else {
            b * b - a * c
        };
        if a.abs() < 1e-300 && b.abs() < 1e-300 {
            return (c < 0.0 && begin < end).then_some([begin, end]);
        }
        if discriminant <= 0.0 {
            return (a < 0.0 && begin < end).then_some([begin, end]);
        }
        let sum = if b > 0.0 { -b - discriminant.sqrt() } else { discriminant.sqrt() - b };
        let (far, near) = (sum / a, c / sum);
        let (first, second) = (far.min(near), far.max(near));
        if a >= 0.0 {
            (begin, end) = (begin.max(first), end.min(second));
        } else {
            // of the two nappes the one in the slab
            let inside = |z: f64| e + de * z > 0.0;
            if first.is_finite() && begin < first && inside(0.5 * (begin.max(-1e3) + first.min(end))) {
                end = end.min(first);
            } else {
                begin = begin.max(second);
            }
        }
        (begin < end).then_some([begin, end])
    }

    fn judged(cap: f64, count: usize) -> Seen {
        convex(
            &TaperedCylinder::new(Real::from_num(cap)).unwrap(),
            count,
            |o, d, offset| part(cap, o, d, offset),
            |[x, y, z]| [x.hypot(y) - (1.0 + (cap - 1.0) * z), -z, z - 1.0],
        )
    }

    #[test]
    fn rays_meet_the_tapered_cylinder_where_they_should() {
        // every crossing that `cross` hands over is judged
        for cap in CAPS {
            let seen = judged(Real::from_num(cap).to_num(), 10_000);
            assert!(seen.judged > 9_000 && seen.met > 4_000, "{cap} {seen:?}");
            let least = if cap == 0.0 { [1000, 500, 0] } else { [1000, 500, 5] };
            assert!((0..3).all(|face| seen.faces[face] >= least[face]), "{cap} {seen:?}");
            assert!(seen.off > 2_f64.powi(-28) && seen.off < 2_f64.powi(-23), "{cap} {seen:?}");
        }
    }

    /// `cargo test -p attractor --lib -- --ignored rays_meet_the_tapered_cylinder`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_rays_meet_the_tapered_cylinder_where_they_should() {
        for cap in CAPS {
            let seen = judged(Real::from_num(cap).to_num(), 200_000);
            assert!(seen.judged > 190_000 && seen.off < 2_f64.powi(-23), "{cap} {seen:?}");
        }
    }

    /// Along the axis and at right angles to it, inside and out, and over the tip: never the other nappe.
    #[test]
    fn rays_along_and_across_the_axis_meet_the_tapered_cylinder() {
        const ONE: i32 = 1 << 28;
        let met = |shape: TaperedCylinder, o: [i32; 3], d: [i32; 3], from: i32| {
            let ray = NearRay { origin: vector(o), direction: vector(d) };
            let all = crossings(&shape, &ray, Near::from_bits(from));
            // to a few units
            all.iter().map(|c| ((c.s.to_bits() + 8) & !15, c.enters, c.face)).collect::<std::vec::Vec<_>>()
        };
        let (cylinder, cone) = (TaperedCylinder::CYLINDER, TaperedCylinder::CONE);
        let (all, half) = (i32::MIN, ONE / 2);
        // down the axis, and off it
        for x in [0, half, -ONE + 4] {
            assert_eq!(
                met(cylinder, [x, 0, 2 * ONE], [0, 0, -ONE], all),
                [(ONE, true, 2), (2 * ONE, false, 1)]
            );
        }
        assert_eq!(met(cone, [0, 0, 2 * ONE], [0, 0, -ONE], all)[1], (2 * ONE, false, 1));
        assert_eq!(
            met(cone, [half, 0, -ONE], [0, 0, ONE], all).iter().map(|c| c.2).collect::<std::vec::Vec<_>>(),
            [1, 0]
        );
        // outside, beside it
        assert_eq!(met(cylinder, [ONE + 4, 0, 2 * ONE], [0, 0, -ONE], all), []);
        // across, above and below: nothing; inside the slab the side
        for (z, count) in [(ONE + 4, 0), (-4, 0), (3 * ONE / 2, 0), (ONE / 4, 2)] {
            for shape in [cylinder, cone] {
                assert_eq!(met(shape, [-2 * ONE, 0, z], [ONE, 0, 0], all).len(), count, "{z}");
            }
        }
        // from inside one exit, away from it none
        assert_eq!(met(cylinder, [0, 0, half], [ONE, 0, 0], 0).len(), 1);
        assert_eq!(met(cylinder, [2 * ONE, 0, half], [ONE, 0, 0], 0), []);
        // through the tip's other nappe, which would be met at z = 3/2
        assert_eq!(met(cone, [-2 * ONE, 0, 3 * ONE / 2], [ONE, 0, 0], all), []);
    }

    #[test]
    fn a_cap_is_refused_outside_zero_to_one() {
        let bad = |bits: i32| TaperedCylinder::new(Real::from_bits(bits)).is_err();
        assert_eq!([bad(-1), bad(0), bad(1 << 24), bad((1 << 24) + 1)], [true, false, false, true]);
        assert_eq!(TaperedCylinder::new(Real::ONE), Ok(TaperedCylinder::CYLINDER));
        assert_eq!(TaperedCylinder::new(Real::ZERO), Ok(TaperedCylinder::CONE));
    }
}
