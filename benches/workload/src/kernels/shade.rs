//! The normals of the surface `G x G`, how it answers light, and where it bends it.

use core::hint::black_box;

use attractor::num::{Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{
    Lit, Material as _, Mixture, Phong, Sight, Specular, Tabulated, TorranceSparrow,
};
use attractor::trace::{Chart, Environment, Finish, Light, SurfacePoint, refracted_direction};

use super::trace::with_hits;
use super::watch::{Tally, Watch};
use crate::exported::brdf_spheres;
use crate::float::Float;
use crate::rivals::{self, Sun};

fn mixed_up<T: Into<i64>>(parts: [T; 3]) -> u32 {
    parts.into_iter().fold(0, |sum: u32, part| sum.rotate_left(5) ^ part.into() as u32)
}

fn bits(v: Vec3<Unit>) -> u32 {
    mixed_up([v.x.to_bits(), v.y.to_bits(), v.z.to_bits()])
}

#[inline(never)]
pub(super) fn normals(watch: &mut Watch<'_>) -> Tally {
    with_hits(|hits| watch.over(hits, |(hit, _, _)| hit.normal().normalised().map_or(0, bits)))
}

#[inline(never)]
pub(super) fn normals_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    with_hits(|hits| {
        let cells = hits.map(|(_, f, g)| {
            let (f, g) = (rivals::Cell::<F>::new(&f), rivals::Cell::<F>::new(&g));
            [f.slope, f.mean, g.slope, g.mean]
        });
        watch.over(&cells, |cells| folded(rivals::normal(cells)))
    })
}

fn folded<F: Float>(v: rivals::Vector<F>) -> u32 {
    v.into_iter().fold(0, |sum: u32, v| sum.rotate_left(5) ^ v.fold())
}

#[inline(always)]
fn shaded(watch: &mut Watch<'_>, material: Finish) -> Tally {
    let Ok(light) = Light::new(Vec3::new(Real::NEG_ONE, Real::from_num(-2), Real::from_num(3))) else {
        return Tally::default();
    };
    let Some(d) = Vec3::new(Real::from_num(5), Real::from_num(4), Real::from_num(-5)).normalised() else {
        return Tally::default();
    };
    with_hits(|hits| {
        let normals = hits.map(|(hit, _, _)| hit.normal().normalised().unwrap_or(d));
        let (material, light, sky) = black_box((material, light, Environment::SKY));
        watch.over(&normals, |n| material.tone(n, d, &light, &sky).to_bits() as u32)
    })
}

#[inline(never)]
pub(super) fn mirror(watch: &mut Watch<'_>) -> Tally {
    shaded(watch, Finish::Mirror)
}

#[inline(never)]
pub(super) fn phong(watch: &mut Watch<'_>) -> Tally {
    shaded(watch, Finish::PHONG)
}

/// The same normals seen along the same direction, handed to `tone`.
fn shaded_float<F: Float>(
    watch: &mut Watch<'_>,
    tone: impl Fn(rivals::Vector<F>, rivals::Vector<F>) -> F,
) -> Tally {
    let d = rivals::unit([5.0, 4.0, -5.0]).map(F::of);
    with_hits(|hits| {
        let float = |v: Real| F::of(v.to_num::<f64>());
        let normals = hits
            .map(|(_, f, g)| rivals::normal([float(f.slope), float(f.mean), float(g.slope), float(g.mean)]));
        watch.over(&normals, |n| tone(n, d).fold())
    })
}

#[inline(never)]
pub(super) fn mirror_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    shaded_float::<F>(watch, rivals::mirror)
}

#[inline(never)]
pub(super) fn phong_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let (sun, shininess) = black_box((Sun::new(), 32));
    shaded_float::<F>(watch, |n, d| rivals::phong(n, d, &sun, shininess))
}

/// From air into water.
const ETA: f64 = 0.75;

#[inline(never)]
pub(super) fn refraction(watch: &mut Watch<'_>) -> Tally {
    let Some(d) = Vec3::new(Real::from_num(5), Real::from_num(4), Real::from_num(-5)).normalised() else {
        return Tally::default();
    };
    with_hits(|hits| {
        // every ray has a direction of its own
        let pairs = hits.map(|(hit, _, _)| (d, hit.normal().normalised().unwrap_or(d)));
        let eta = black_box(Real::from_num(ETA));
        watch.over(&pairs, |(d, n)| refracted_direction(d, n, eta).map_or(0, bits))
    })
}

#[inline(never)]
pub(super) fn refraction_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let d = rivals::unit([5.0, 4.0, -5.0]).map(F::of);
    with_hits(|hits| {
        let float = |v: Real| F::of(v.to_num::<f64>());
        let pairs = hits.map(|(_, f, g)| {
            (d, rivals::normal([float(f.slope), float(f.mean), float(g.slope), float(g.mean)]))
        });
        let eta = black_box(F::of(ETA));
        watch.over(&pairs, |(d, n)| rivals::refracted(d, n, eta).map_or(0, folded))
    })
}

/// A pigment and a light.
const COLORS: [[f32; 3]; 2] = [[0.75, 0.5, 0.25], [1.0, 0.875, 0.75]];

/// One light, matt and with a highlight, as materials of a world have it.
#[inline(never)]
pub(super) fn phong_rgb(watch: &mut Watch<'_>) -> Tally {
    let vector = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let (d, towards) = (vector(5, 4, -5).normalised(), vector(-1, -2, 3).normalised());
    let (Some(d), Some(towards)) = (d, towards) else { return Tally::default() };
    let [pigment, light] = COLORS.map(|c| {
        let [r, g, b] = c.map(Lumen::from_num);
        Rgb::new(r, g, b)
    });
    let grey = Rgb::grey(Lumen::from_num(0.375));
    let Ok(matt) = Mixture::matt(pigment).with_parts(Unit::from_num(0.125), Unit::from_num(0.5)) else {
        return Tally::default();
    };
    with_hits(|hits| {
        // every ray has a direction of its own
        let pairs = hits.map(|(hit, _, _)| (d, hit.normal().normalised().unwrap_or(d)));
        let material = matt.with_highlight(grey, Phong { shininess: 32 });
        answers(watch, &pairs, black_box(&material), black_box(Lit { towards, light }))
    })
}

/// What a material answers to one light, along these directions at these normals: a loop for itself.
#[inline(never)]
fn answers(
    watch: &mut Watch<'_>,
    pairs: &[(Vec3<Unit>, Vec3<Unit>)],
    material: &Mixture<Rgb, Phong>,
    lit: Lit,
) -> Tally {
    let blank = SurfacePoint {
        position: Vec3::default(),
        place: Vec3::default(),
        normal: Vec3::default(),
        chart: Chart::default(),
        face: 0,
        inward: false,
        width: Real::ZERO,
    };
    watch.over(pairs, |(d, n)| {
        let point = SurfacePoint { normal: n, ..blank };
        let light = material.respond(&point, d, core::iter::once(lit)).light;
        mixed_up([light.r, light.g, light.b].map(Lumen::to_bits))
    })
}

/// The highlight of a model by one light.
#[inline(always)]
fn highlight(watch: &mut Watch<'_>, model: impl Specular) -> Tally {
    let vector = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let (d, towards) = (vector(5, 4, -5).normalised(), vector(-1, -2, 3).normalised());
    let (Some(d), Some(towards)) = (d, towards) else { return Tally::default() };
    with_hits(|hits| {
        let sights = hits.map(|(hit, _, _)| {
            let normal = hit.normal().normalised().unwrap_or(d);
            // along x, at right angles to the normal
            let across = Vec3::new(normal.z, Unit::ZERO, normal.x.saturating_neg());
            Sight { normal, direction: d, tangent: across }
        });
        let (model, towards) = black_box((&model, towards));
        watch.over(&sights, |sight| model.part(&sight, towards).to_bits())
    })
}

#[inline(never)]
pub(super) fn torrance_sparrow(watch: &mut Watch<'_>) -> Tally {
    let model = TorranceSparrow::new(Unit::from_num(0.5), Unit::ONE);
    model.map_or(Tally::default(), |model| highlight(watch, model))
}

#[inline(never)]
pub(super) fn tabulated(watch: &mut Watch<'_>) -> Tally {
    let model = Tabulated::new(&brdf_spheres::SLOPES_0, Unit::ONE);
    model.map_or(Tally::default(), |model| highlight(watch, model))
}

#[inline(never)]
pub(super) fn phong_rgb_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let d = rivals::unit([5.0, 4.0, -5.0]).map(F::of);
    let (sun, shininess) = black_box((Sun::new(), 32));
    let colors = black_box(COLORS.map(|c| c.map(|c| F::of(c.into()))));
    with_hits(|hits| {
        let float = |v: Real| F::of(v.to_num::<f64>());
        let pairs = hits.map(|(_, f, g)| {
            (d, rivals::normal([float(f.slope), float(f.mean), float(g.slope), float(g.mean)]))
        });
        watch.over(&pairs, |(d, n)| folded(rivals::phong_rgb(n, d, &sun, colors, shininess)))
    })
}
