//! Compounds as types: the union, the intersection and the difference of two surfaces.
//!
//! `Difference<Difference<Placed<Sphere>, Placed<Sphere>>, Placed<TaperedCylinder>>` is the text's bowl. A
//! compound is a surface like any other; the compiler sees through it, and no program is interpreted. A
//! compound as data is an [`Object`](super::Object).
//!
//! Source: the course unit V, section 5.10.

use core::ops::ControlFlow;

use heapless::Vec;

use super::super::ray::Ray;
use super::super::surface::{Crossing, Extent, SAME, Surface, SurfacePoint};
use crate::num::{Real, Unit, Vec3, Wide};

/// What is in one of two surfaces or in both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Union<A, B>(pub A, pub B);

/// What is in both of two surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Intersection<A, B>(pub A, pub B);

/// What is in the first of two surfaces and not in the second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Difference<A, B>(pub A, pub B);

/// The most crossings of a part that a compound has room for.
const CROSSINGS: usize = 16;

/// A part's crossings, and whether the ray begins inside it.
struct Part {
    crossings: Vec<Crossing, CROSSINGS>,
    starts_inside: bool,
}

#[inline(never)]
fn part<S: Surface>(surface: &S, ray: &Ray, cone: Unit) -> Part {
    let mut crossings = Vec::new();
    surface.cross(ray, cone, &mut |crossing| match crossings.push(crossing) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    });
    let starts_inside = match crossings.first() {
        Some(first) => !first.enters,
        None => {
            let [x, y, z] = ray.origin.map(Real::from_bits);
            surface.value(Vec3::new(x, y, z)) < Wide::ZERO
        }
    };
    Part { crossings, starts_inside }
}

/// Goes along two lists of crossings and hands over those at which `inside` of the two states changes.
fn merged(
    parts: [Part; 2],
    first_faces: u8,
    inside: impl Fn(bool, bool) -> bool,
    found: &mut impl FnMut(Crossing) -> ControlFlow<()>,
) {
    let [a, b] = parts;
    let mut states = [a.starts_inside, b.starts_inside];
    let lists = [a.crossings.as_slice(), b.crossings.as_slice()];
    let mut at = [0_usize; 2];
    let next = |at: [usize; 2]| {
        let t = |k: usize| lists.get(k).and_then(|list| list.get(*at.get(k)?)).map(|c| c.t.to_bits());
        match (t(0), t(1)) {
            (Some(a), Some(b)) => Some(if a <= b { (0, a) } else { (1, b) }),
            (Some(a), None) => Some((0, a)),
            (None, Some(b)) => Some((1, b)),
            (None, None) => None,
        }
    };
    while let Some((_, t)) = next(at) {
        let [a, b] = states;
        let before = inside(a, b);
        let mut last = None;
        // all at one parameter take effect together
        while let Some((part, at_t)) = next(at).filter(|(_, other)| *other <= t.saturating_add(SAME)) {
            let [a, b] = states;
            let was = inside(a, b);
            let place = at.get_mut(part);
            let crossing = place.as_ref().and_then(|at| lists.get(part)?.get(**at));
            if let (Some(crossing), Some(state)) = (crossing, states.get_mut(part)) {
                *state = crossing.enters;
                let [a, b] = states;
                if inside(a, b) != was {
                    let face =
                        if part == 0 { crossing.face } else { first_faces.saturating_add(crossing.face) };
                    let memo = [crossing.memo[0] << 1 | part as u32, crossing.memo[1]];
                    last = Some(Crossing { t: Real::from_bits(at_t), enters: !was, face, memo });
                }
            }
            if let Some(at) = place {
                *at += 1;
            }
        }
        let [a, b] = states;
        if inside(a, b) != before && last.is_some_and(|last| found(last).is_break()) {
            return;
        }
    }
}

macro_rules! compound {
    ($name:ident, $inside:expr, $extent:expr, $value:expr) => {
        impl<A: Surface, B: Surface> Surface for $name<A, B> {
            fn extent(&self) -> Extent {
                let extent: fn(Extent, Extent) -> Extent = $extent;
                extent(self.0.extent(), self.1.extent())
            }

            fn is_closed(&self) -> bool {
                true
            }

            fn most_crossings(&self) -> u32 {
                self.0.most_crossings().saturating_add(self.1.most_crossings())
            }

            fn faces(&self) -> u8 {
                self.0.faces().saturating_add(self.1.faces())
            }

            fn error(&self) -> Real {
                self.0.error().max(self.1.error())
            }

            fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
                if self.extent().is_met(&ray.axes()) {
                    let parts = [part(&self.0, ray, cone), part(&self.1, ray, cone)];
                    merged(parts, self.0.faces(), $inside, found);
                }
            }

            fn value(&self, place: Vec3) -> Wide {
                let value: fn(Wide, Wide) -> Wide = $value;
                value(self.0.value(place), self.1.value(place))
            }

            fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
                let [path, rest] = crossing.memo;
                let mut own = Crossing { memo: [path >> 1, rest], ..*crossing };
                let mut point = if path & 1 == 0 {
                    self.0.point(ray, cone, &own, charted)
                } else {
                    own.face = crossing.face.saturating_sub(self.0.faces());
                    self.1.point(ray, cone, &own, charted)
                };
                point.face = crossing.face;
                point
            }
        }
    };
}

compound!(Union, |a, b| a || b, |a, b| a.hull(b), |a, b| a.min(b));
compound!(Intersection, |a, b| a && b, |a, b| a.overlap(b), |a, b| a.max(b));
compound!(Difference, |a, b| a && !b, |a, _| a, |a, b| a.max(b.saturating_neg()));
