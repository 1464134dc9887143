//! Where light goes at a boundary: mirrored, or bent by Snell's law; and how much of it either way.
//!
//! With the unit direction `d`, the unit normal `n` against it and `eta` the index before the boundary over
//! that behind it, `w = eta (d - (d . n) n)` is what of the refracted direction lies in the boundary, and
//! `w - sqrt(1 - w^2) n` the direction. If `w` is longer than 1 there is none: total internal reflection.
//!
//! Formats: directions 30 fractional bits, `eta` 24.
//!
//! Source: the course unit V, section 5.9.1, as corrected: `sin t / c_2 = sin i / c_1`.

use core::num::NonZeroU32;

use crate::num::formats::{Q30, Q58};
use crate::num::{
    Real, Unit, Vec3, high, product, product_u, reciprocal_of, rough_sqrt, rounded_down, sqrt, square,
};

/// Where refracted light goes, and which share of it is reflected instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Refracted {
    pub(super) direction: Vec3<Unit>,
    /// The cosine of the angle to the normal behind the boundary.
    cos: Unit,
}

fn bits(v: Vec3<Unit>) -> [i32; 3] {
    [v.x, v.y, v.z].map(Unit::to_bits)
}

fn vector([x, y, z]: [i32; 3]) -> Vec3<Unit> {
    Vec3::new(Unit::from_bits(x), Unit::from_bits(y), Unit::from_bits(z))
}

/// `d - 2 (d . n) n` for unit vectors: a unit vector.
///
/// Error: below `2^-28` in each component (`a_mirrored_ray_is_within_two_to_the_minus_28`).
#[inline]
pub(super) fn mirrored(d: Vec3<Unit>, n: Vec3<Unit>) -> Vec3<Unit> {
    let along = d.dot(n).to_bits();
    let part = |d: Unit, n: Unit| d.to_bits().wrapping_sub(rounded_down::<29>(product(along, n.to_bits())));
    vector([part(d.x, n.x), part(d.y, n.y), part(d.z, n.z)])
}

/// The direction in which light along `d` goes on behind a boundary with the normal `n` against it, `eta` the
/// index of refraction before it over that behind it; none where light is reflected totally.
///
/// Domain: unit vectors with `d . n <= 0`, `eta` from 0.01 to 100. Error: below `2^-22` in each component,
/// for an `eta` above 10 `2^-21`, away from the critical angle
/// (`a_refracted_ray_is_within_two_to_the_minus_22`). Cost: 21 multiplications (kernel row `refraction`).
#[inline]
pub fn refracted_direction(d: Vec3<Unit>, n: Vec3<Unit>, eta: Real) -> Option<Vec3<Unit>> {
    refracted(d, n, eta).map(|refracted| refracted.direction)
}

/// The same, and what tells which share of the light is reflected.
#[inline]
pub(super) fn refracted(d: Vec3<Unit>, n: Vec3<Unit>, eta: Real) -> Option<Refracted> {
    if eta >= 2 {
        return far_bent(d, n, eta);
    }
    // w^2 = eta^2 (1 - (d . n)^2): where eta is no larger, what is lost there is not missed
    let (along, eta): (Q30, Q30) = (d.dot(n).to_bits(), eta.to_bits() << 6);
    let (d, n) = (bits(d), bits(n));
    let aside: Q30 = (1 << 30) - rounded_down::<30>(product(along, along));
    let rest: Q58 = (1 << 58) - product_u(aside.max(0) as u32, high(eta, eta) as u32) as i64;
    if rest < 0 {
        return None;
    }
    // the root is too small by half a unit on average, and by one straight on
    let cos: Q30 = ((rough_sqrt(rest as u64) + 1) << 1) as i32;
    // the direction is eta d + f n, f below 2
    let f = rounded_down::<30>(product(eta, along)).wrapping_add(cos).wrapping_neg();
    let part = |d: i32, n: i32| rounded_down::<30>(product(eta, d).wrapping_add(product(f, n)));
    let direction = vector([part(d[0], n[0]), part(d[1], n[1]), part(d[2], n[2])]);
    Some(Refracted { direction, cos: Unit::from_bits(cos) })
}

/// The same for an `eta` of 2 and more, from a denser medium into a much thinner one.
#[cold]
#[inline(never)]
fn far_bent(d: Vec3<Unit>, n: Vec3<Unit>, eta: Real) -> Option<Refracted> {
    let (along, eta) = (d.dot(n).to_bits(), eta.to_bits());
    let (d, n) = (bits(d), bits(n));
    let (mut inside, mut far) = ([0; 3], 0);
    for ((w, d), n) in inside.iter_mut().zip(d).zip(n) {
        // what of a unit vector lies in the boundary is no longer than 1
        let tangential = d.wrapping_sub((product(along, n) >> 30) as i32);
        let bent = product(eta, tangential);
        *w = (bent >> 24) as i32;
        // what leaves 32 bits there
        far |= (((bent >> 32) as i32).wrapping_add(1 << 23) as u32) >> 24;
    }
    if far != 0 {
        return None;
    }
    let rest = (1_u64 << 60).checked_sub(square(inside))?;
    let cos = sqrt(rest) as i32;
    for (w, n) in inside.iter_mut().zip(n) {
        *w = w.wrapping_sub((product(cos, n) >> 30) as i32);
    }
    Some(Refracted { direction: vector(inside), cos: Unit::from_bits(cos) })
}

impl Refracted {
    /// Fresnel's reflectance of unpolarised light that met the boundary under the cosine `cos`.
    ///
    /// Error: below `2^-14` (`the_reflectance_is_fresnels`).
    pub(super) fn reflectance(&self, cos: Unit, eta: Real) -> Unit {
        // 28 fractional bits, beyond an index of 4 as many as fit: the sum of two is a word
        let places = if eta < 4 { 2 } else { 6 };
        let unit = |c: Unit| c.clamp(Unit::ZERO, Unit::ONE).to_bits() as u32;
        let bent = |c: u32| (product_u(eta.to_bits().unsigned_abs(), c) >> (24 + places)) as u32;
        let (i, t) = (unit(cos), unit(self.cos));
        // (a - b)^2 / (a + b)^2, 30 fractional bits; all is reflected where both vanish
        let share = |a: u32, b: u32| {
            let Some(sum) = NonZeroU32::new(a + b) else { return 1 << 30 };
            let (mantissa, zeros) = reciprocal_of(sum);
            let part = product_u(a.abs_diff(b), mantissa as u32);
            // part 2^zeros / 2^32, by words
            let part = ((part >> 32) as u32) << (zeros & 31) | ((part as u32) >> 1) >> ((zeros & 31) ^ 31);
            (product_u(part, part) >> 30) as u32
        };
        Unit::from_bits(((share(bent(i), t >> places) + share(i >> places, bent(t))) / 2) as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Unit vectors and normals against them, some nearly parallel or at right angles.
    fn pairs() -> Vec<(Vec3<Unit>, Vec3<Unit>)> {
        let mut word = 1_u64;
        let mut random = || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            Real::from_bits((word >> 34) as i32 - (1 << 29))
        };
        let mut all = Vec::new();
        for k in 0..6000 {
            let v = Vec3::new(random(), random(), random());
            let mut other = Vec3::new(random(), random(), random());
            let shift = k % 20;
            if k % 3 == 0 {
                other = Vec3::new(-v.x + (other.x >> shift), -v.y + (other.y >> shift), -v.z);
            }
            let (Some(d), Some(n)) = (v.normalised(), other.normalised()) else { continue };
            let n = if d.dot(n) > 0 { Vec3::new(-n.x, -n.y, -n.z) } else { n };
            all.push((d, n));
        }
        all
    }

    fn floats(v: Vec3<Unit>) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num())
    }

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn a_mirrored_ray_is_within_two_to_the_minus_28() {
        let mut worst = 0.0_f64;
        for (d, n) in pairs() {
            let (df, nf) = (floats(d), floats(n));
            for (k, c) in floats(mirrored(d, n)).into_iter().enumerate() {
                worst = worst.max((c - (df[k] - 2.0 * dot(df, nf) * nf[k])).abs());
            }
        }
        assert!(worst < 2_f64.powi(-28) && worst > 2_f64.powi(-31), "2^{}", worst.log2());
    }

    #[test]
    fn a_refracted_ray_is_within_two_to_the_minus_22() {
        let (mut worst, mut total, mut tried) = (0.0_f64, 0, 0);
        for eta in [0.01, 0.1, 0.66, 0.75, 1.0, 1.333, 1.5, 2.4, 10.0, 100.0] {
            let eta = Real::from_num(eta);
            let e = eta.to_num::<f64>();
            for (d, n) in pairs() {
                let (df, nf) = (floats(d), floats(n));
                let along = dot(df, nf);
                let w: Vec<f64> = (0..3).map(|k| e * (df[k] - along * nf[k])).collect();
                let rest = 1.0 - w.iter().map(|w| w * w).sum::<f64>();
                if rest.abs() < 0.01 {
                    continue;
                }
                let got = refracted_direction(d, n, eta);
                assert_eq!(got.is_some(), rest > 0.0, "{eta} {along} {rest}");
                total += u32::from(got.is_none());
                if let Some(got) = got {
                    for (k, c) in floats(got).into_iter().enumerate() {
                        let off = (c - (w[k] - rest.sqrt() * nf[k])).abs();
                        worst = worst.max(if e > 10.0 { off / 2.0 } else { off });
                        tried += 1;
                    }
                }
            }
        }
        assert!(
            worst < 2_f64.powi(-22) && total > 5000 && tried > 50_000,
            "2^{} {total} {tried}",
            worst.log2()
        );
        assert!(worst > 2_f64.powi(-27), "2^{}", worst.log2());
    }

    #[test]
    fn light_at_right_angles_goes_straight_on_and_equal_media_bend_nothing() {
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        let up = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
        for eta in [1, 2, 50] {
            assert_eq!(refracted_direction(down, up, Real::from_num(eta)), Some(down));
        }
        for (d, n) in pairs().into_iter().filter(|(d, n)| d.dot(*n) < -0.1) {
            let got = refracted(d, n, Real::ONE).unwrap().direction;
            for (a, b) in floats(got).into_iter().zip(floats(d)) {
                assert!((a - b).abs() < 2_f64.powi(-25));
            }
        }
    }

    #[test]
    fn the_reflectance_is_fresnels() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        for eta in [0.1, 0.5, 0.75, 1.0, 1.333, 2.0, 10.0] {
            let eta = Real::from_num(eta);
            let e = eta.to_num::<f64>();
            for (d, n) in pairs() {
                let i = -dot(floats(d), floats(n));
                let t2 = 1.0 - e * e * (1.0 - i * i);
                let Some(got) = refracted(d, n, eta) else { continue };
                if t2 < 0.01 || i < 0.01 {
                    continue;
                }
                let t = t2.sqrt();
                let exact =
                    ((e * i - t) / (e * i + t)).powi(2) / 2.0 + ((i - e * t) / (i + e * t)).powi(2) / 2.0;
                let off = (got.reflectance(Unit::from_num(i), eta).to_num::<f64>() - exact).abs();
                worst = worst.max(off);
                tried += 1;
            }
        }
        assert!(worst < 2_f64.powi(-14) && worst > 2_f64.powi(-28) && tried > 10_000, "2^{}", worst.log2());
    }
}
