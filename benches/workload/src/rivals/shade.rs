//! The answer of a surface to light: core's materials and sky in floating point.

use super::vector::{Vector, dot, unit};
use crate::float::Float;

/// The unit normal `(-f' g, -f g', 1)` of a height field `f(x) g(y)`.
#[inline(always)]
pub(crate) fn normal<F: Float>([df, f, dg, g]: [F; 4]) -> Vector<F> {
    let (x, y) = (-df * g, -f * dg);
    let scale = F::of(1.0) / x.fused(x, y.fused(y, F::of(1.0))).root();
    [x * scale, y * scale, scale]
}

/// The tone of a sky that brightens towards the zenith above a dark ground, in the direction of a unit
/// vector.
#[inline(always)]
pub(crate) fn sky<F: Float>(z: F) -> F {
    // from 1/2 at the horizon to 1 straight up and to 1/8 straight down
    z.fused(if z < F::of(0.0) { F::of(0.375) } else { F::of(0.5) }, F::of(0.5))
}

/// `d - 2 (d . n) n`.
#[inline(always)]
fn mirrored<F: Float>(n: Vector<F>, d: Vector<F>) -> Vector<F> {
    let twice = dot(n, d) * F::of(-2.0);
    [0, 1, 2].map(|i: usize| twice.fused(n[i], d[i]))
}

/// What a mirror with unit normal `n` shows of the sky, seen along the unit direction `d`.
#[inline(always)]
pub(crate) fn mirror<F: Float>(n: Vector<F>, d: Vector<F>) -> F {
    sky(mirrored(n, d)[2])
}

/// A light infinitely far away.
pub(crate) struct Sun<F>(Vector<F>);

impl<F: Float> Sun<F> {
    /// The ray caster's: from the upper left front.
    pub(crate) fn new() -> Self {
        Self(unit([-1.0, -2.0, 3.0]).map(F::of))
    }
}

/// Core's `Finish::PHONG`: an eighth ambient, half matt, a highlight of 3/8 with exponent 32.
#[inline(always)]
pub(crate) fn phong<F: Float>(n: Vector<F>, d: Vector<F>, sun: &Sun<F>, shininess: u16) -> F {
    let clamp = |v: F| v.most(F::of(0.0)).least(F::of(1.0));
    let lit = dot(n, sun.0);
    let lit = clamp(if dot(n, d) > F::of(0.0) { -lit } else { lit });
    let (mut highlight, mut square, mut rest) = (F::of(1.0), clamp(dot(mirrored(n, d), sun.0)), shininess);
    while rest > 0 {
        if rest & 1 == 1 {
            highlight = highlight * square;
        }
        square = square * square;
        rest >>= 1;
    }
    clamp(F::of(0.375).fused(highlight, F::of(0.5).fused(lit, F::of(0.125))))
}

/// Where light along `d` goes on behind a boundary with the normal `n` against it.
#[inline(always)]
pub(crate) fn refracted<F: Float>(d: Vector<F>, n: Vector<F>, eta: F) -> Option<Vector<F>> {
    let along = dot(d, n);
    let inside = [0, 1, 2].map(|i: usize| (-along).fused(n[i], d[i]) * eta);
    let rest = F::of(1.0) - dot(inside, inside);
    if rest < F::of(0.0) {
        return None;
    }
    let cos = -rest.root();
    Some([0, 1, 2].map(|i: usize| cos.fused(n[i], inside[i])))
}

/// [`phong`]'s highlight and matt part in red, green and blue, of a pigment under one light.
#[inline(always)]
pub(crate) fn phong_rgb<F: Float>(
    n: Vector<F>,
    d: Vector<F>,
    sun: &Sun<F>,
    [pigment, light]: [Vector<F>; 2],
    shininess: u16,
) -> Vector<F> {
    let lit = dot(n, sun.0).most(F::of(0.0)) * F::of(0.5);
    let (mut highlight, mut square, mut rest) =
        (F::of(0.375), dot(mirrored(n, d), sun.0).most(F::of(0.0)), shininess);
    while rest > 0 {
        if rest & 1 == 1 {
            highlight = highlight * square;
        }
        square = square * square;
        rest >>= 1;
    }
    [0, 1, 2].map(|i: usize| {
        let matt = light[i].fused(lit, F::of(0.125));
        pigment[i].fused(matt, light[i] * highlight)
    })
}
