//! The invariant disc: a disc that every map of a system sends into itself, so that the attractor and each
//! orbit lie in it.
//!
//! It is found when a system is built, and is what proves that no later computation leaves its format.
//!
//! With `s_i` a bound of the contraction of `w_i`, `|w_i(p) - z| <= s_i |p - z| + |w_i(z) - z|`; so the disc
//! about `z` with `r = max_i |w_i(z) - z| / (1 - s_i)` is invariant. A small one is wanted. `r` is a convex
//! function of `z`, and going towards the fixed point of the map that decides lowers that map's share in
//! proportion: steps of `1/2, 1/3, 1/4 ..` settle near the least radius, as in M. Badoiu and K. L. Clarkson,
//! "Smaller core-sets for balls", 2003.
//!
//! Rounding: maps round each coordinate by half a unit, which moves a point by less than one unit; one unit
//! is added to `|w_i(z) - z|`.

use super::affine::{Affine, hypotenuse};
use crate::Error;
use crate::num::formats::Q24;
use crate::num::{Real, Unit, Wide, nth, ratio};
use crate::plane::Point2;

/// How far from the axes an invariant disc may reach: half the range of [`Real`], in its units.
pub(super) const REACH: i64 = 64 << 24;

/// How often the centre is moved.
const STEPS: u32 = 32;

/// A disc of the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Disc {
    /// Its centre.
    pub centre: Point2,
    /// Its radius.
    pub radius: Real,
}

impl Disc {
    /// How far the disc reaches from the axes, in each direction, with 24 fractional bits.
    pub(super) fn reach(&self) -> [i64; 2] {
        [self.centre.x, self.centre.y]
            .map(|z| i64::from(z.to_bits()).abs() + i64::from(self.radius.to_bits()))
    }

    /// Whether `p` lies in the disc, widened by 256 units, which its maps keep as well: no rounding counts.
    pub(super) fn holds(&self, p: Point2) -> bool {
        let square = |a: i64| a.unsigned_abs().saturating_mul(a.unsigned_abs());
        let away = |z: Real, p: Real| square(i64::from(p.to_bits()) - i64::from(z.to_bits()));
        let distance = away(self.centre.x, p.x).saturating_add(away(self.centre.y, p.y));
        distance <= square(i64::from(self.radius.to_bits()) + 256)
    }
}

/// Contractions, and a bound of the contraction factor of each.
pub(super) struct Contractions<'a> {
    pub(super) maps: &'a [Affine],
    pub(super) factors: &'a [Unit],
}

impl Contractions<'_> {
    /// An invariant disc that reaches no farther than 64 from the axes. Cost: 33 square roots for each map,
    /// and a division where it may decide.
    #[inline(never)]
    pub(super) fn invariant_disc(&self) -> Result<Disc, Error> {
        let mut sum = [0_i64; 2];
        for (index, map) in self.maps.iter().enumerate() {
            let p = fixed_point(map, index)?;
            sum = [sum[0] + i64::from(p.x.to_bits()), sum[1] + i64::from(p.y.to_bits())];
        }
        // at most 256 maps
        let mut centre = sum.map(|s| nth(s, self.maps.len() as u32) as i32);
        let (mut best, mut worst) = self.radius_about(centre);
        let mut best_centre = centre;
        let mut best_worst = worst;
        for step in 0..STEPS {
            let Some(map) = self.maps.get(worst) else { break };
            let p = fixed_point(map, worst)?;
            for (z, target) in centre.iter_mut().zip([p.x, p.y]) {
                *z += nth(i64::from(target.to_bits()) - i64::from(*z), step + 2) as i32;
            }
            let radius;
            (radius, worst) = self.radius_about(centre);
            if radius < best {
                (best, best_centre, best_worst) = (radius, centre, worst);
            }
        }
        let [x, y] = best_centre;
        let reach = i64::from(x.abs().max(y.abs())) + best;
        if reach > REACH {
            return Err(out_of_range("reach of the invariant disc", best_worst, reach));
        }
        // reach <= 2^30: both fit
        let centre = Point2::new(Real::from_bits(x), Real::from_bits(y));
        Ok(Disc { centre, radius: Real::from_bits(best as i32) })
    }

    /// The radius of the least invariant disc about `z` that the estimate gives, rounded up, and the map that
    /// decides it.
    #[inline(never)]
    fn radius_about(&self, [x, y]: [Q24; 2]) -> (i64, usize) {
        let mut worst = (0, 0);
        for (index, (map, factor)) in self.maps.iter().zip(self.factors).enumerate() {
            let to_right = moved(map.a, map.b, map.e, [x, y], x);
            let upwards = moved(map.c, map.d, map.f, [x, y], y);
            let distance = hypotenuse(to_right, upwards) + 1;
            // factors are at most 1; distance < 2^33
            let gap = (1_u32 << 30).saturating_sub(factor.to_bits().unsigned_abs());
            // most maps do not have the largest radius: a product tells, and spares the division
            if distance << 30 >= (worst.0 as u64).saturating_mul(gap.into()) {
                worst = (ratio(distance, 30, gap.into()).min(1 << 62) as i64 + 1, index);
            }
        }
        worst
    }
}

/// How far a row of a map moves a coordinate `z` of the point `(x, y)`, rounded up.
#[inline(never)]
fn moved(l: Unit, m: Unit, t: Real, [x, y]: [Q24; 2], z: Q24) -> i64 {
    // coefficients are below 1 and |z| <= 64, |t| <= 128: below 2^62
    let exact = i64::from(l.to_bits()) * i64::from(x)
        + i64::from(m.to_bits()) * i64::from(y)
        + ((i64::from(t.to_bits()) - i64::from(z)) << 30);
    // beyond 2^31 the radius is too large anyhow
    ((exact.abs() >> 30) + 1).min(1 << 31)
}

fn fixed_point(map: &Affine, index: usize) -> Result<Point2, Error> {
    let far = |p: Point2| {
        let [x, y] = [p.x, p.y].map(|z| i64::from(z.to_bits()).abs());
        x.max(y)
    };
    match map.fixed_point() {
        Some(p) if far(p) <= REACH => Ok(p),
        other => Err(out_of_range("fixed point of the map", index, other.map_or(i64::MAX, far))),
    }
}

fn out_of_range(what: &'static str, index: usize, bits: i64) -> Error {
    let value = Wide::from_bits(bits.saturating_mul(1 << 24));
    let max = Wide::from_bits(REACH << 24);
    Error::OutOfRange { what, index: Some(index), value, min: -max, max }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    #[test]
    fn an_invariant_disc_is_sent_into_itself() {
        for attractor in catalogue::ALL {
            let factors: heapless::Vec<_, 8> =
                attractor.maps.iter().map(Affine::contraction_factor).collect();
            let disc = Contractions { maps: attractor.maps, factors: &factors }.invariant_disc().unwrap();
            let r = disc.radius.to_num::<f64>();
            let z = [disc.centre.x.to_num::<f64>(), disc.centre.y.to_num::<f64>()];
            for map in attractor.maps {
                for k in 0..360 {
                    let angle = f64::from(k).to_radians();
                    let on_the_rim = Point2::new(
                        Real::from_num(z[0] + r * angle.cos()),
                        Real::from_num(z[1] + r * angle.sin()),
                    );
                    let q = map.apply(on_the_rim);
                    let far = (q.x.to_num::<f64>() - z[0]).hypot(q.y.to_num::<f64>() - z[1]);
                    assert!(far <= r, "{}: {far} > {r}", attractor.name);
                }
            }
        }
    }

    /// `gap r >= |w(z) - z| + 1` in exact integers: half a unit of rounding in each coordinate moves a point
    /// by less than one unit.
    #[test]
    fn an_invariant_disc_leaves_a_unit_for_rounding() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(12);
        let (mut checked, mut closest, mut decided) = (0, i128::MAX, 0);
        for _ in 0..3000 {
            // from 2^-6 to 1, translations from a few units to 8
            let (linear, wide) = (rng.next_u32() % 7, rng.next_u32() % 26);
            let mut signed = |below: u32| rng.next_u32() as i32 >> (31 - below);
            let maps = [(); 3].map(|()| {
                let entries = [(); 4].map(|()| Unit::from_bits(signed(30 - linear)));
                Affine::new(entries, [(); 2].map(|()| Real::from_bits(signed(1 + wide))))
            });
            if !maps.iter().all(Affine::is_contraction) {
                continue;
            }
            let factors = [0, 1, 2].map(|i: usize| maps[i].contraction_factor());
            let Ok(disc) = (Contractions { maps: &maps, factors: &factors }).invariant_disc() else {
                continue;
            };
            checked += 1;
            let [x, y] = [disc.centre.x, disc.centre.y].map(|z| i128::from(z.to_bits()));
            let mut nearest = i128::MAX;
            for (map, factor) in maps.iter().zip(factors) {
                let bits = |u: Unit| i128::from(u.to_bits());
                let gap = (1 << 30) - bits(factor);
                // 54 fractional bits
                let moved = |l: Unit, m: Unit, t: Real, z: i128| {
                    bits(l) * x + bits(m) * y + ((i128::from(t.to_bits()) - z) << 30)
                };
                let (right, up) = (moved(map.a, map.b, map.e, x), moved(map.c, map.d, map.f, y));
                let room = gap * i128::from(disc.radius.to_bits()) - (1 << 30);
                assert!(room >= 0 && room * room >= right * right + up * up, "{maps:?}");
                let spare = room - (right * right + up * up).isqrt();
                // of which up to a unit is what the division is rounded up by
                nearest = nearest.min(spare - gap);
                closest = closest.min(spare);
            }
            // two coordinates and a root rounded up, and as much as a unit of the radius
            decided += u32::from(nearest <= 3 << 30);
        }
        assert!(checked > 1000 && decided == checked, "{decided} of {checked}");
        assert!(closest < 1 << 28, "{closest}");
    }

    #[test]
    fn a_square_lies_in_its_circumscribed_disc() {
        let square =
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[e, f]| Affine::from_ratios([1, 0, 0, 1, e, f], 2));
        let disc =
            Contractions { maps: &square, factors: &[Unit::from_num(0.5); 4] }.invariant_disc().unwrap();
        let radius = disc.radius.to_num::<f64>();
        assert!(radius >= 0.5_f64.sqrt() && radius < 0.72, "{radius}");
    }

    #[test]
    fn the_range_ends_at_64_to_a_few_units() {
        let disc = |units: i32| {
            let e = Real::from_bits((32 << 24) + units);
            let map = Affine { a: Unit::from_num(0.5), e, ..Affine::default() };
            Contractions { maps: &[map], factors: &[map.contraction_factor()] }.invariant_disc()
        };
        let what = |units| match disc(units) {
            Err(Error::OutOfRange { what, .. }) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(what(1), "fixed point of the map");
        assert_eq!(what(0), "reach of the invariant disc");
        let [reach, _] = disc(-16).unwrap().reach();
        assert!((REACH - 32..=REACH).contains(&reach), "{reach}");
    }

    #[test]
    fn a_disc_that_leaves_the_range_is_refused() {
        let refused = |maps: &[Affine; 2], factor: Unit| {
            Contractions { maps, factors: &[factor; 2] }.invariant_disc().unwrap_err()
        };
        let far = Affine::from_thousandths([500, 0, 0, 500, 40_000, 0]);
        let near = Affine::from_thousandths([500, 0, 0, 500, 0, 0]);
        let error = refused(&[near, far], Unit::from_num(0.5));
        assert!(matches!(error, Error::OutOfRange { index: Some(1), .. }), "{error}");
        let slow = Affine::from_thousandths([999, 0, 0, 999, 0, 10]);
        let slow_too = Affine::from_thousandths([999, 0, 0, 999, 0, -100]);
        let error = refused(&[slow, slow_too], slow.contraction_factor());
        assert!(matches!(error, Error::OutOfRange { .. }), "{error}");
    }

    /// Points on the axes through the centre and on the diagonal, to the unit.
    #[test]
    fn a_disc_holds_what_is_no_farther_than_its_radius_and_256_units() {
        let at = |x: i32, y: i32| Point2::new(Real::from_bits(x), Real::from_bits(y));
        let disc = Disc { centre: at(1000, -77), radius: Real::from_bits(3000 - 256) };
        for (x, y) in [(3000, 0), (-3000, 0), (0, 3000), (0, -3000), (1800, 2400), (-2400, -1800)] {
            assert!(disc.holds(at(1000 + x, -77 + y)), "{x} {y}");
            assert!(!disc.holds(at(1000 + x + x.signum(), -77 + y + y.signum())), "{x} {y}");
        }
        assert_eq!(disc.reach(), [3744, 2821]);
        let far = Disc { centre: at(i32::MIN, i32::MIN), radius: Real::from_bits(5) };
        assert!(!far.holds(at(i32::MAX, i32::MAX)));
    }

    /// `|a x + b y + e - x|` rounded up: above the exact one by a unit at most.
    #[test]
    fn a_coordinate_is_moved_by_no_more_than_it_says() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(30);
        for k in 0..20_000 {
            let mut signed = |bits: u32| rng.next_u32() as i32 >> (32 - bits);
            let ([l, m], [x, y], t) =
                ([(); 2].map(|()| signed(31)), [(); 2].map(|()| signed(30)), signed(1 + k % 30));
            let exact = i128::from(l) * i128::from(x) + i128::from(m) * i128::from(y);
            let exact = (exact + ((i128::from(t) - i128::from(x)) << 30)).abs();
            let got =
                i128::from(moved(Unit::from_bits(l), Unit::from_bits(m), Real::from_bits(t), [x, y], x));
            let above = (got << 30) - exact;
            assert!((0..=1 << 30).contains(&above) || got == 1 << 31, "{l} {m} {t} {x} {y}: {above}");
        }
    }

    /// A map to one point: its disc is a few units wide, and the point may lie at 64, the disc not beyond.
    #[test]
    fn a_disc_may_reach_64_and_no_unit_more() {
        let disc = |e: i64| {
            let map = Affine { e: Real::from_bits(e as i32), ..Affine::default() };
            Contractions { maps: &[map], factors: &[Unit::ZERO] }.invariant_disc()
        };
        let mut reached = 0;
        for e in REACH - 16..=REACH + 1 {
            match disc(e) {
                Ok(disc) => reached = reached.max(disc.reach()[0]),
                Err(Error::OutOfRange { what, index, value, .. }) => {
                    let (expected, least) = if e > REACH {
                        ("fixed point of the map", e)
                    } else {
                        ("reach of the invariant disc", REACH + 1)
                    };
                    assert_eq!((what, index), (expected, Some(0)), "{e}");
                    assert!((least..least + 4).contains(&(value.to_bits() >> 24)), "{e}: {value}");
                }
                Err(other) => panic!("{other:?}"),
            }
        }
        assert_eq!(reached, REACH);
    }
}
