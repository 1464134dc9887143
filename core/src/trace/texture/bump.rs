//! Bumps: a material whose normal leans as if its surface were uneven.
//!
//! A surface raised by `b(u, v)` along its unit normal `n` has the normal
//!
//! `N' = N + b_u (n x P_v) + b_v (P_u x n)`, `N = P_u x P_v`,
//!
//! as long as `b` is small. Heights go outwards: where `u` and `v` run round the outward normal to the left,
//! as under a map that mirrors, `n` is the unit vector along `N`, which is inward, and what is wanted is
//! `-N + b_u (n x P_v) + b_v (P_u x n)`. So what is mirrored has bumps where its original has them. How much
//! it leans depends on the lengths of `P_u` and `P_v`: everything is divided by both here, which leaves unit
//! tangents and slopes `b_u / |P_u|`, `b_v / |P_v|`.
//!
//! Source: the course unit V, section 5.8.2; J. Blinn, "Simulation of wrinkled surfaces", 1978. The printed
//! cross product of the text has become a sum.
//!
//! Format: slopes 24 fractional bits, vectors 30.

use super::super::material::{Lit, Material, Medium, Response};
use super::super::surface::SurfacePoint;
use super::image::Image;
use super::mapped::Mapped;
use super::turbulence::Turbulence;
use crate::num::{Real, Rgb, Unit, Vec3, mixed, product, reciprocal, reciprocal_sqrt_of, sqrt, square, unit};

/// How a surface is raised.
pub trait Bump {
    /// `[b_u, b_v]`: how the height grows with `u` and with `v`.
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2];
}

/// A material with bumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bumpy<M, B> {
    /// What the surface is made of.
    pub material: M,
    /// How it is raised, outwards.
    pub bump: B,
}

/// The unit normal of a surface raised by a bump, on the side of the point's normal; that one itself where
/// there are no texture coordinates.
///
/// Domain: all; slopes beyond 64 count as 64. Error: below `2^-22` in each component for tangents of lengths
/// from 1/4 on, at an angle of 30 degrees or more, and slopes up to 4
/// (`a_bumpy_normal_is_that_of_the_formula_on_both_sides`).
pub fn bumped_normal(point: &SurfacePoint, [b_u, b_v]: [Real; 2]) -> Vec3<Unit> {
    let tangents = [point.chart.along_u, point.chart.along_v].map(|p| [p.x, p.y, p.z].map(Real::to_bits));
    let [u, v] = tangents.map(unit);
    // what is zero has no direction
    if u.cross(v) == Vec3::default() {
        return point.normal;
    }
    let [slope_u, slope_v] = [(b_u, tangents[0]), (b_v, tangents[1])].map(|(b, along)| {
        let (mantissa, half) = reciprocal_sqrt_of(square(along));
        let slope = product(b.to_bits(), mantissa) >> (7 + (half & 31));
        slope.clamp(-(64 << 24), 64 << 24) as i32
    });
    let flat = u.cross(v);
    let is_turned = flat.dot(point.normal).is_negative();
    let normal = point.normal;
    let n = if is_turned { Vec3::new(-normal.x, -normal.y, -normal.z) } else { normal };
    let is_mirrored = is_turned != point.inward;
    let (first, second) = (n.cross(v), u.cross(n));
    let component = |flat: Unit, first: Unit, second: Unit| {
        let flat = i64::from(flat.to_bits());
        (if is_mirrored { -flat } else { flat })
            + ((product(slope_u, first.to_bits()) + product(slope_v, second.to_bits())) >> 24)
    };
    let sum = [
        component(flat.x, first.x, second.x),
        component(flat.y, first.y, second.y),
        component(flat.z, first.z, second.z),
    ];
    // below 2^38: as many bits as fit 31
    let most = sum.iter().fold(0, |most, c| c.unsigned_abs() | most);
    let shift = (64 - most.leading_zeros()).saturating_sub(31);
    let [x, y, z] = sum.map(|c| (if point.inward { -c } else { c } >> shift) as i32);
    if x | y | z == 0 { point.normal } else { unit([x, y, z]) }
}

impl<M: Material, B: Bump> Bumpy<M, B> {
    fn raised(&self, point: &SurfacePoint) -> SurfacePoint {
        SurfacePoint { normal: bumped_normal(point, self.bump.slopes(point)), ..*point }
    }
}

impl<M: Material, B: Bump> Material for Bumpy<M, B> {
    const MAY_BE_CLEAR: bool = M::MAY_BE_CLEAR;

    fn is_charted(&self) -> bool {
        true
    }

    fn medium(&self) -> Option<Medium> {
        self.material.medium()
    }

    fn passes(&self) -> Rgb {
        self.material.passes()
    }

    fn normal(&self, point: &SurfacePoint) -> Vec3<Unit> {
        self.material.normal(&self.raised(point))
    }

    fn respond(&self, point: &SurfacePoint, view: Vec3<Unit>, lights: impl Iterator<Item = Lit>) -> Response {
        self.material.respond(&self.raised(point), view, lights)
    }
}

/// The same slopes everywhere.
impl Bump for [Real; 2] {
    fn slopes(&self, _: &SurfacePoint) -> [Real; 2] {
        *self
    }
}

/// Bumps by other coordinates: `b_s = b_U a_u + b_V a_v`, `b_t` likewise.
impl<B: Bump> Bump for Mapped<B> {
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2] {
        let [b_u, b_v] = self.inner().slopes(&self.point(point));
        let [[a, b, _], [c, d, _]] = *self.rows();
        let sum = |p: Real, q: Real| {
            let sum =
                (product(b_u.to_bits(), p.to_bits()) >> 24) + (product(b_v.to_bits(), q.to_bits()) >> 24);
            saturated(sum)
        };
        [sum(a, c), sum(b, d)]
    }
}

/// Bumps by a table: the grey of an image as height.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Relief<'a> {
    /// The table; its texels best are [`Texels::Linear`](super::Texels::Linear).
    pub image: Image<'a>,
    /// How high a grey of 1 is.
    pub height: Real,
}

impl Bump for Relief<'_> {
    /// Differences over the distance of two texels of the interpolated table: exact where it is linear.
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2] {
        let (u, v) = (point.chart.u, point.chart.v);
        let at = |u: Real, v: Real| self.image.mean(u, v, Real::ZERO, Real::ZERO).g.to_bits() as i32;
        let [columns, rows] = self.image.size();
        let step = |count: u32| Real::from_bits((1_i32 << 24).checked_div(count as i32).unwrap_or(0));
        let (right, up) = (step(columns), step(rows));
        let slope = |difference: i32, count: u32| {
            // 16 fractional bits, half the number of texels
            saturated((product(difference, self.height.to_bits()) * i64::from(count)) >> 17)
        };
        [
            slope(at(u.saturating_add(right), v) - at(u.saturating_sub(right), v), columns),
            slope(at(u, v.saturating_add(up)) - at(u, v.saturating_sub(up)), rows),
        ]
    }
}

/// Bumps by a procedure: turbulence of the place in the world, as an orange's peel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rough {
    /// The height.
    pub turbulence: Turbulence,
    /// How high 1 is.
    pub height: Real,
}

impl Bump for Rough {
    /// Differences along the tangents, over the ray's width, at least `2^-9`: finer bumps are not seen.
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2] {
        let step = point.width.clamp(Real::from_bits(1 << 14), Real::ONE);
        let (mantissa, shift) = reciprocal(step.to_bits().unsigned_abs());
        [point.chart.along_u, point.chart.along_v].map(|along| {
            let along = [along.x, along.y, along.z].map(Real::to_bits);
            let way = unit(along);
            let at = |sign: i32| {
                let moved = |c: Real, way: Unit| {
                    let step = (product(step.to_bits(), way.to_bits()) >> 30) as i32;
                    c.saturating_add(Real::from_bits(sign * step))
                };
                let p = point.position;
                self.turbulence.at(Vec3::new(moved(p.x, way.x), moved(p.y, way.y), moved(p.z, way.z)))
            };
            let difference = i64::from(at(1).to_bits()) - i64::from(at(-1).to_bits());
            // 24 fractional bits below 2^32 over twice the step, times the length of the tangent
            let rise = ((difference * i64::from(self.height.to_bits())) >> 31).clamp(-(1 << 31), 1 << 31);
            let slope = (rise * i64::from(mantissa)) >> (shift - 24);
            let slope = i64::from(saturated(slope).to_bits());
            saturated((slope * i64::from(sqrt(square(along)))) >> 24)
        })
    }
}

/// Small facets, each tilted at random: cells of texture coordinates with slopes of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Facets {
    /// How many to a unit of `u` and of `v`. Round a shape a whole number has no narrow one.
    pub cells: [Real; 2],
    /// The greatest slope in either direction.
    pub tilt: Unit,
    /// For other facets.
    pub seed: u32,
}

impl Bump for Facets {
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2] {
        let chart = &point.chart;
        let cell = |c: Real, cells: Real| (product(c.to_bits(), cells.to_bits()) >> 48) as u32;
        let [i, j] = [cell(chart.u, self.cells[0]), cell(chart.v, self.cells[1])];
        let hash = mixed(i ^ mixed(j ^ mixed(self.seed ^ 0x9e37_79b9)));
        [(chart.along_u, hash), (chart.along_v, mixed(hash ^ 0x2c1b_3c6d))].map(|(along, hash)| {
            // 31 fractional bits between -1 and 1
            let part = product(hash as i32, self.tilt.to_bits()) >> 31;
            let length = sqrt(square([along.x, along.y, along.z].map(Real::to_bits)));
            saturated((part * i64::from(length)) >> 30)
        })
    }
}

fn saturated(bits: i64) -> Real {
    Real::from_bits(bits.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
}

#[cfg(test)]
mod tests {
    use super::super::image::Texels;
    use super::super::noise::Noise;
    use super::super::testing::{charted, placed};
    use super::*;
    use crate::trace::Chart;
    use crate::trace::material::Mixture;

    fn vector(v: [f64; 3]) -> Vec3 {
        let [x, y, z] = v.map(Real::from_num);
        Vec3::new(x, y, z)
    }

    fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    fn normalised(v: [f64; 3]) -> [f64; 3] {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| c / length)
    }

    fn floats(v: Vec3<Unit>) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num())
    }

    /// `z = b(u, v)` over the plane, `x = 2 u`, `y = 3 v`: its normal is `(-b_u / 2, -b_v / 3, 1)`.
    #[test]
    fn a_constant_slope_leans_against_the_way_up_and_less_where_tangents_are_long() {
        let chart =
            Chart { along_u: vector([2.0, 0.0, 0.0]), along_v: vector([0.0, 3.0, 0.0]), ..Chart::default() };
        let point = SurfacePoint { chart, ..placed([0; 3]) };
        let bumpy = Bumpy { material: Mixture::matt(Rgb::WHITE), bump: [0.5, -0.75].map(Real::from_num) };
        let exact = normalised([-0.25, 0.25, 1.0]);
        for (got, exact) in floats(bumpy.normal(&point)).into_iter().zip(exact) {
            assert!((got - exact).abs() < 1e-7, "{got} {exact}");
        }
        assert!(bumpy.is_charted() && bumpy.medium().is_none() && bumpy.passes() == Rgb::BLACK);
        // twice as large, half as steep
        let chart = Chart { along_u: vector([4.0, 0.0, 0.0]), ..chart };
        let flat = floats(bumpy.normal(&SurfacePoint { chart, ..point }));
        assert!((flat[0] / flat[2] + 0.125).abs() < 1e-7, "{flat:?}");
        // without texture coordinates nothing leans
        assert_eq!(bumpy.normal(&placed([0; 3])), point.normal);
        // what light sees is what `normal` tells
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        let lit = |towards| core::iter::once(Lit { towards, light: Rgb::WHITE });
        let straight = bumpy.respond(&point, down, lit(bumpy.normal(&point))).light;
        assert!(straight.g > bumpy.respond(&point, down, lit(point.normal)).light.g);
    }

    #[test]
    fn a_bumpy_normal_is_that_of_the_formula_on_both_sides() {
        let mut word = 3_u64;
        let mut random = |scale: f64| {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((word >> 33) as f64 / 2_f64.powi(31) * 2.0 - 1.0) * scale
        };
        let (mut worst, mut tried) = (0.0_f64, 0);
        while tried < 2000 {
            let [p, q] = [(); 2].map(|()| [random(3.0), random(3.0), random(3.0)]);
            let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
            let flat = cross(p, q);
            if length(p) < 0.25 || length(q) < 0.25 || length(flat) < 0.5 * length(p) * length(q) {
                continue;
            }
            tried += 1;
            let n = normalised(flat);
            let [b_u, b_v] = [random(4.0) * length(p), random(4.0) * length(q)];
            let (first, second) = (cross(n, q), cross(p, n));
            let raised = |side: f64| {
                normalised(core::array::from_fn(|i| side * flat[i] + b_u * first[i] + b_v * second[i]))
            };
            let chart = Chart { along_u: vector(p), along_v: vector(q), ..Chart::default() };
            // seen from outside and from inside, mirrored and not: there the outward normal is against P_u x
            // P_v
            for (side, inward) in [(1.0, false), (-1.0, true), (-1.0, false), (1.0, true)] {
                let [x, y, z] = n.map(|c| Unit::from_num(side * c));
                let point = SurfacePoint { chart, normal: Vec3::new(x, y, z), inward, ..placed([0; 3]) };
                let got = floats(bumped_normal(&point, [b_u, b_v].map(Real::saturating_from_num)));
                let seen = if inward { -1.0 } else { 1.0 };
                for (got, exact) in got.into_iter().zip(raised(side * seen)) {
                    worst = worst.max((got - seen * exact).abs());
                }
            }
        }
        assert!(worst > 2_f64.powi(-28) && worst < 2_f64.powi(-22), "{worst:e}");
    }

    #[test]
    fn a_table_has_the_slopes_of_its_heights() {
        // a ramp along u, repeated: 16 texels of 1/255 each
        let ramp: std::vec::Vec<u8> = (0..64).map(|i| (i % 16) as u8 * 8).collect();
        let image = Image::new(Texels::Linear, 16, 4, &ramp).unwrap();
        let relief = Relief { image, height: Real::from_num(2) };
        let [b_u, b_v] = relief.slopes(&charted(Real::from_num(0.4), Real::from_num(0.6)));
        let exact = 2.0 * 8.0 * 16.0 / 255.0;
        assert!((b_u.to_num::<f64>() - exact).abs() < 1e-3 && b_v.abs() < 1e-3, "{b_u} {b_v}");
        // three times as often: three times as steep
        let mapped = Mapped::repeated(relief, 3, 1).unwrap();
        let [b_u, _] = mapped.slopes(&charted(Real::from_num(0.4 / 3.0), Real::from_num(0.6)));
        assert!((b_u.to_num::<f64>() - 3.0 * exact).abs() < 3e-3, "{b_u}");
    }

    /// Against differences of the turbulence itself, half as far apart.
    #[test]
    fn a_rough_surface_has_the_slopes_of_its_turbulence() {
        let turbulence = Turbulence::new(Noise::PERLIN, Real::ONE, 2).unwrap();
        let rough = Rough { turbulence, height: Real::from_num(0.5) };
        let (p, q) = ([1.5, 0.0, 2.0], [0.0, -0.5, 0.0]);
        let chart = Chart { along_u: vector(p), along_v: vector(q), ..Chart::default() };
        let mut steep = 0;
        for n in 0..200_i32 {
            let point = SurfacePoint { chart, ..placed([n * 123_457, n * 77_777, n * -99_999]) };
            let at = |way: [f64; 3], step: f64| {
                let place: [f64; 3] =
                    [point.position.x, point.position.y, point.position.z].map(|c| c.to_num());
                turbulence.at(vector(core::array::from_fn(|i| place[i] + step * way[i]))).to_num::<f64>()
            };
            for (got, way) in rough.slopes(&point).into_iter().zip([p, q]) {
                let exact = 0.5 * (at(way, 0.0005) - at(way, -0.0005)) / 0.001;
                assert!((got.to_num::<f64>() - exact).abs() < 0.04, "{n}: {got} {exact}");
                steep += u32::from(exact.abs() > 0.2);
            }
        }
        assert!(steep > 100, "{steep}");
    }

    #[test]
    fn a_facet_has_one_normal_and_its_neighbour_another() {
        let facets = Facets { cells: [10, 20].map(Real::from_num), tilt: Unit::from_num(0.25), seed: 7 };
        let slopes = |u: f64, v: f64| facets.slopes(&charted(Real::from_num(u), Real::from_num(v)));
        let (mut sum, mut most) = (0.0, 0.0_f64);
        for (i, j) in (0..20).flat_map(|j| (0..10).map(move |i| (f64::from(i), f64::from(j)))) {
            let corner = slopes((i + 0.01) / 10.0, (j + 0.01) / 20.0);
            assert_eq!(corner, slopes((i + 0.98) / 10.0, (j + 0.98) / 20.0));
            assert_ne!(corner, slopes((i + 1.02) / 10.0, (j + 0.5) / 20.0));
            let [a, b] = corner.map(|c| c.to_num::<f64>());
            sum += a + b;
            most = most.max(a.abs()).max(b.abs());
        }
        assert!(most < 0.25 && most > 0.24 && (sum / 400.0).abs() < 0.04, "{most} {sum}");
    }
}
