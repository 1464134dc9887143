//! The surface where a user's function is 0, inside where it is below.
//!
//! The function says how fast it changes at most: `|F(p) - F(q)| <= L |p - q|`. So a ray may step by
//! `|F| / L` without passing a zero. Near the surface these steps become short; none is taken shorter than a
//! 1024th of the ray's way through the box, which bounds their number by 1024 and is how thin a part may be
//! to be left out. Where the sign has changed, bisection finds the crossing.
//!
//! Source: Hart, "Sphere Tracing", The Visual Computer 12, 1996; Kalra, Barr, "Guaranteed Ray Intersections
//! with Implicit Surfaces", SIGGRAPH 1989.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::Error;
use crate::num::formats::{Q28, Q30};
use crate::num::{
    Near, Real, Vec3, Wide, atan2, product, reciprocal_of, reciprocal_sqrt_of, scaled, sqrt, square,
};

/// A function of space. Closures `Fn(Vec3<Near>) -> Near` are functions.
pub trait Function {
    /// Its value at a place of the box, or `2^-10` beyond it where no gradient is given, below 0 inside. It
    /// must not wrap there.
    fn value(&self, place: Vec3<Near>) -> Near;

    /// Its gradient, of any length: by differences over `2^-9`.
    fn gradient(&self, place: Vec3<Near>) -> Vec3<Near> {
        let step = Near::ONE >> 10;
        let difference = |x: Near, y: Near, z: Near| {
            let ahead =
                Vec3::new(place.x.saturating_add(x), place.y.saturating_add(y), place.z.saturating_add(z));
            let behind =
                Vec3::new(place.x.saturating_sub(x), place.y.saturating_sub(y), place.z.saturating_sub(z));
            self.value(ahead).saturating_sub(self.value(behind))
        };
        let (zero, differences) = (Near::ZERO, difference);
        Vec3::new(differences(step, zero, zero), differences(zero, step, zero), differences(zero, zero, step))
    }
}

impl<F: Fn(Vec3<Near>) -> Near> Function for F {
    fn value(&self, place: Vec3<Near>) -> Near {
        self(place)
    }
}

/// The surface where a [`Function`] is 0.
///
/// ```
/// use attractor::num::{Near, Real, Vec3};
/// use attractor::trace::solid::{Implicit, Shape};
///
/// // a paraboloid, cut at z = 1 by its box
/// let bowl = |p: Vec3<Near>| p.x * p.x + p.y * p.y - p.z;
/// let bounds = [Vec3::new(-1, -1, 0), Vec3::new(1, 1, 1)].map(|v| Vec3::new(v.x, v.y, v.z));
/// let near = |v: Vec3<i32>| Vec3::new(Near::from_num(v.x), Near::from_num(v.y), Near::from_num(v.z));
/// let bowl = Implicit::new(bowl, bounds.map(near), Real::from_num(3))?;
/// assert!(bowl.value(Vec3::Z) < 0);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Implicit<F> {
    function: F,
    bounds: [Vec3<Near>; 2],
    steepness: Real,
}

/// The most crossings that are told.
const MOST: u32 = 16;

fn words(v: Vec3<Near>) -> [Q28; 3] {
    [v.x, v.y, v.z].map(Near::to_bits)
}

impl<F: Function> Implicit<F> {
    /// The surface inside a box, which cuts it: outside the box nothing is inside. `steepness` is `L`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a steepness below 1/256; for a box that leaves ±2, or whose ends are the
    /// wrong way round, with the index of the axis.
    pub fn new(function: F, bounds: [Vec3<Near>; 2], steepness: Real) -> Result<Self, Error> {
        let least = Real::ONE >> 8;
        if steepness < least {
            let [value, min, max] = [steepness, least, Real::MAX].map(Wide::from);
            return Err(Error::OutOfRange { what: "steepness", index: None, value, min, max });
        }
        let [low, high] = bounds.map(|v| [v.x, v.y, v.z]);
        let two = Near::from_bits(2 << 28);
        for (index, (low, high)) in low.into_iter().zip(high).enumerate() {
            if !(-two..=two).contains(&low) || !(low..=two).contains(&high) {
                let (what, max) = ("box", Wide::from(two));
                let (value, min) =
                    if !(-two..=two).contains(&low) { (low.into(), -max) } else { (high.into(), low.into()) };
                return Err(Error::OutOfRange { what, index: Some(index), value, min, max });
            }
        }
        Ok(Self { function, bounds, steepness })
    }

    /// Where the ray is in the box.
    fn span(&self, origin: [Q28; 3], direction: [Q28; 3]) -> Option<[Q28; 2]> {
        let [low, high] = self.bounds.map(words);
        let (mut start, mut end) = (i64::from(i32::MIN), i64::from(i32::MAX));
        for k in 0..3 {
            let (o, d) = (origin[k], direction[k]);
            let (first, last) = if d < 0 { (high[k], low[k]) } else { (low[k], high[k]) };
            // a component of 0 counts as one unit
            let (mantissa, zeros) =
                reciprocal_of(NonZeroU32::new(d.unsigned_abs()).unwrap_or(NonZeroU32::MIN));
            let after = |end: Q28| {
                let way = end.saturating_sub(o);
                product(if d < 0 { way.saturating_neg() } else { way }, mantissa) >> (34 - zeros.max(3))
            };
            start = start.max(after(first));
            end = end.min(after(last));
        }
        (start < end).then_some([start as i32, end as i32])
    }
}

impl<F: Function> Shape for Implicit<F> {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Some(self.bounds)
    }

    /// More are not told.
    fn most_crossings(&self) -> u32 {
        MOST
    }

    /// Error: as said, for a function that is exact (`a_ball_is_met_where_it_is`).
    fn error(&self) -> Near {
        Near::DELTA * 32
    }

    /// What is thinner along the ray than a 1024th of its way through the box may be left out. Cost: 1024
    /// values at most, and 24 a crossing.
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let (origin, direction) = (words(ray.origin), words(ray.direction));
        let Some([start, end]) = self.span(origin, direction) else { return };
        let start = start.max(from.to_bits());
        if start >= end {
            return;
        }
        let coordinate = |k: usize, s: Q28| {
            let way = (product(s, direction[k]) + (1 << 27)) >> 28;
            Near::from_bits((i64::from(origin[k]) + way).clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        };
        let value = |s: Q28| {
            let place = Vec3::new(coordinate(0, s), coordinate(1, s), coordinate(2, s));
            self.function.value(place).to_bits()
        };
        // L |d|, rounded up: 24 + 28 fractional bits, then 20
        let length = sqrt(square(direction)).saturating_add(1);
        let rate =
            ((u64::from(self.steepness.to_bits().unsigned_abs()) * u64::from(length)) >> 32) as u32 + 1;
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(rate).unwrap_or(NonZeroU32::MIN));
        let least = ((i64::from(end) - i64::from(start)) >> 10) + 1;

        let (mut s, mut outside, mut count) = (start, true, 0);
        let mut here = value(s);
        // a ray that starts within the box may start inside: then it only leaves
        if from.to_bits() >= start && here < 0 {
            outside = false;
            count = 1;
        }
        let tell = |s: Q28, enters: bool| NearCrossing { s: Near::from_bits(s), enters, face: 0 };
        let mut before = s;
        loop {
            if (here < 0) == outside {
                let mut bracket = [before, s];
                for _ in 0..24 {
                    let middle = ((i64::from(bracket[0]) + i64::from(bracket[1])) >> 1) as i32;
                    bracket[usize::from((value(middle) < 0) == outside)] = middle;
                }
                count += 1;
                if found(tell(bracket[1], outside)).is_break() || count == MOST {
                    return;
                }
                outside = !outside;
            }
            if s >= end {
                break;
            }
            before = s;
            let free = product(here.saturating_abs(), mantissa) >> (42 - zeros);
            s = (i64::from(s) + free.max(least)).min(end.into()) as i32;
            here = value(s);
        }
        if !outside {
            let _ = found(tell(end, false));
        }
    }

    /// Outside the box it is above 0.
    fn value(&self, place: Vec3) -> Wide {
        let near = |c: Real| Near::saturating_from_num(c);
        let place = Vec3::new(near(place.x), near(place.y), near(place.z));
        // the function is asked inside the box alone
        let [low, high] = self.bounds;
        let held = |c: Near, low: Near, high: Near| c.max(low).min(high);
        let held = Vec3::new(
            held(place.x, low.x, high.x),
            held(place.y, low.y, high.y),
            held(place.z, low.z, high.z),
        );
        let value = Wide::from(self.function.value(held));
        if held == place { value } else { value.max(Wide::DELTA) }
    }

    /// The gradient, its greatest component brought to at least 1/2; upwards where it vanishes.
    fn normal(&self, place: Vec3<Near>, _: u8) -> Vec3<Near> {
        let gradient = words(self.function.gradient(place));
        let greatest = gradient.iter().fold(0, |all, c| all | c.unsigned_abs());
        if greatest == 0 {
            return Vec3::new(Near::ZERO, Near::ZERO, Near::ONE);
        }
        let places = greatest.leading_zeros().saturating_sub(4);
        let [x, y, z] = gradient.map(|c| Near::from_bits(c << places));
        Vec3::new(x, y, z)
    }

    /// Longitude and latitude, as on a sphere: `u` is the angle round the z axis from the x axis in turns,
    /// `v` the height of the angle from the south (0) to the north (1).
    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let [x, y, z] = [place.x, place.y, place.z].map(Real::to_bits);
        let across = square([x, y, 0]);
        let root = reciprocal_sqrt_of(across);
        let rho = sqrt(across).min(i32::MAX as u32) as i32;
        // pi, 28 fractional bits
        let in_half_turns = |c: i64| {
            let c = c.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
            Real::from_bits((product(c, 0x3243_f6a8) >> 28).clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        };
        let inwards = |c: Q30| in_half_turns(-product(z, scaled(c, root)) >> 30);
        Chart {
            u: Real::from_bits((atan2(y, x).to_bits() >> 8) as i32),
            v: Real::from_bits((atan2(z, rho).to_bits() as i32 >> 7) + (1 << 23)),
            along_u: Vec3::new(in_half_turns(-2 * i64::from(y)), in_half_turns(2 * i64::from(x)), Real::ZERO),
            along_v: Vec3::new(inwards(x), inwards(y), in_half_turns(rho.into())),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::vec::Vec;

    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    fn near(v: [f64; 3]) -> Vec3<Near> {
        let [x, y, z] = v.map(Near::from_num);
        Vec3::new(x, y, z)
    }

    const BOX: [Vec3<Near>; 2] = {
        let (low, high) = (Near::lit("-1.25"), Near::lit("1.25"));
        [Vec3::new(low, low, low), Vec3::new(high, high, high)]
    };

    fn ball() -> Implicit<impl Function> {
        let value = |p: Vec3<Near>| p.x * p.x + p.y * p.y + p.z * p.z - Near::ONE;
        // 2 |p| at a corner
        Implicit::new(value, BOX, Real::lit("4.34")).unwrap()
    }

    fn crossings(shape: &impl Shape, ray: &NearRay, from: Near) -> Vec<NearCrossing> {
        let mut found = Vec::new();
        shape.cross(ray, from, &mut |crossing| {
            found.push(crossing);
            ControlFlow::Continue(())
        });
        found
    }

    #[test]
    fn a_ball_is_met_where_it_is() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(11);
        let mut random = || f64::from(rng.next_u32()) / 2_f64.powi(31) - 1.0;
        let (mut hits, mut misses, mut unsure, mut worst) = (0, 0, 0, 0.0_f64);
        let shape = ball();
        for _ in 0..3_000 {
            let d = [(); 3].map(|()| random());
            let greatest = d.iter().fold(0.0_f64, |g, c| g.max(c.abs()));
            let ray = NearRay {
                origin: near([(); 3].map(|()| random() * 1.2)),
                direction: near(d.map(|c| c / greatest * 1.3)),
            };
            let [o, d] = [ray.origin, ray.direction].map(|v| [v.x, v.y, v.z].map(|c| c.to_num::<f64>()));
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
            let (square, half) = (dot(d, d), dot(o, d) / dot(d, d));
            let root = half * half - (dot(o, o) - 1.0) / square;
            let found = crossings(&shape, &ray, Near::MIN);
            assert!(found.len().is_multiple_of(2), "{found:?}");
            // a 1024th of the way through the box, at most 4.4
            if (0.0..0.000_005).contains(&root) || root < 0.0 && root > -1e-6 {
                unsure += 1;
            } else if root < 0.0 {
                assert!(found.is_empty(), "{ray:?} {found:?}");
                misses += 1;
            } else {
                let truth = [-half - root.sqrt(), -half + root.sqrt()];
                assert_eq!(found.len(), 2, "{ray:?}");
                for (crossing, truth) in found.iter().zip(truth) {
                    // the derivative along the ray is 2 |d|^2 times the root
                    let off = (crossing.s.to_num::<f64>() - truth).abs() * root.sqrt().min(1.0);
                    worst = worst.max(off);
                }
                assert!(found[0].enters && !found[1].enters);
                let ahead = crossings(&shape, &ray, Near::ZERO);
                if dot(o, o) < 0.999 {
                    assert!(ahead.len() == 1 && !ahead[0].enters, "{ray:?} {ahead:?}");
                }
                hits += 1;
            }
        }
        assert!(hits > 1_000 && misses > 300 && unsure < 20, "{hits} {misses} {unsure}");
        let bound = shape.error().to_num::<f64>();
        assert!(worst > bound / 64.0 && worst < bound, "{worst:e}");
        let place = near([0.6, 0.0, -0.8]);
        let normal = shape.normal(place, 0);
        assert!((normal.x.to_num::<f64>() / normal.z.to_num::<f64>() + 0.75).abs() < 1e-6 && normal.z < 0);
        assert_eq!((shape.value(Vec3::default()), shape.most_crossings()), (-Wide::ONE, MOST));
        assert_eq!((shape.value(Vec3::X), shape.bounds()), (Wide::ZERO, Some(BOX)));
    }

    /// Sheets of which the thinner ones are below a 1024th of the way.
    #[test]
    fn what_is_thin_may_be_left_out_and_what_is_thick_is_not() {
        let sheet = |thickness: f64| {
            let half = Near::from_num(thickness / 2.0);
            Implicit::new(move |p: Vec3<Near>| p.z.abs() - half, BOX, Real::ONE).unwrap()
        };
        let ray = NearRay { origin: near([0.1, 0.2, 2.0]), direction: near([0.0, 0.0, -1.0]) };
        for thickness in [0.1, 0.01, 0.003] {
            let found = crossings(&sheet(thickness), &ray, Near::MIN);
            assert_eq!(found.len(), 2, "{thickness}");
            let width = (found[1].s - found[0].s).to_num::<f64>();
            assert!((width - thickness).abs() < 1e-7, "{thickness} {width}");
        }
        // cut by the box: in at one face, out at the other
        let all = Implicit::new(|_: Vec3<Near>| -Near::ONE, BOX, Real::ONE).unwrap();
        let found = crossings(&all, &ray, Near::MIN);
        assert_eq!(
            found.iter().map(|c| (c.s.to_num::<f64>() * 4.0).round()).collect::<Vec<_>>(),
            [3.0, 13.0]
        );
        // no more than 16 are told
        let sheets = |p: Vec3<Near>| {
            let z = Near::from_bits(p.z.to_bits() << 4 >> 4).to_bits();
            Near::from_bits(((z & 0x7f_ffff) - 0x40_0000).abs() - 0x20_0000)
        };
        let sheets = Implicit::new(sheets, BOX, Real::ONE).unwrap();
        assert_eq!(crossings(&sheets, &ray, Near::MIN).len(), 16);
    }

    #[test]
    fn what_has_no_bound_is_refused() {
        let flat = |p: Vec3<Near>| p.z;
        let with = |bounds, steepness| Implicit::new(flat, bounds, steepness).map(|_| ());
        assert!(matches!(with(BOX, Real::ZERO), Err(Error::OutOfRange { what: "steepness", .. })));
        let [low, high] = BOX;
        assert!(matches!(
            with([high, low], Real::ONE),
            Err(Error::OutOfRange { what: "box", index: Some(0), .. })
        ));
        let far = Vec3::new(high.x, high.y, Near::lit("2.5"));
        let refused = with([low, far], Real::ONE);
        assert!(
            matches!(refused, Err(Error::OutOfRange { index: Some(2), value, .. }) if value == Wide::lit("2.5"))
        );
    }

    #[test]
    fn the_chart_is_that_of_a_sphere() {
        let place = Vec3::new(Real::lit("0.48"), Real::lit("0.64"), Real::lit("0.6"));
        let chart = ball().chart(place, 0);
        let (u, v) = (
            f64::atan2(0.64, 0.48) / core::f64::consts::TAU,
            0.5 + f64::atan2(0.6, 0.8) / core::f64::consts::PI,
        );
        assert!((chart.u.to_num::<f64>() - u).abs() < 2e-7 && (chart.v.to_num::<f64>() - v).abs() < 2e-7);
        let pi = core::f64::consts::PI;
        for (got, exact) in [
            (chart.along_u, [-0.64 * 2.0 * pi, 0.48 * 2.0 * pi, 0.0]),
            (chart.along_v, [-0.6 * 0.6 * pi, -0.6 * 0.8 * pi, 0.8 * pi]),
        ] {
            let got = [got.x, got.y, got.z].map(|c| c.to_num::<f64>());
            assert!((0..3).all(|k| (got[k] - exact[k]).abs() < 1e-6), "{got:?} {exact:?}");
        }
    }

    /// A function is asked in its box, and by the gradient that it does not give itself a 1024th beyond it.
    #[test]
    fn a_function_is_asked_nowhere_else() {
        let value = |p: Vec3<Near>| {
            let beyond = [p.x, p.y, p.z].map(|c| c.abs() - Near::lit("1.25")).into_iter().max();
            assert!(beyond <= Some(Near::ONE / 1024), "{p:?}");
            p.x * p.x + p.y * p.y - p.z
        };
        let shape = Implicit::new(value, BOX, Real::lit("4")).unwrap();
        for (at, inside) in [([5.0, 1.0, 1.0], false), ([0.0, 0.0, 1.0], true), ([-90.0, 70.0, 3.0], false)] {
            let [x, y, z] = at.map(Real::from_num);
            assert_eq!(shape.value(Vec3::new(x, y, z)) < Wide::ZERO, inside, "{at:?}");
        }
        let _ = shape.normal(near([1.25, -1.25, 1.25]), 0);
    }
}
