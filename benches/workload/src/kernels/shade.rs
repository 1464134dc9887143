//! The normals of the surface `G x G`, and how it answers light.

use core::hint::black_box;

use attractor::num::{Real, Unit, Vec3};
use attractor::trace::{Environment, Finish, Light};

use super::trace::with_hits;
use super::watch::{Tally, Watch};
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
