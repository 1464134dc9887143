//! Compounds as types: the union, the intersection and the difference of two surfaces.
//!
//! `Difference<Difference<Placed<Sphere>, Placed<Sphere>>, Placed<TaperedCylinder>>` is the text's bowl. A
//! compound is a surface like any other; the compiler sees through it, and no program is interpreted. A
//! compound as data is an [`Object`](super::Object).
//!
//! A part that a ray may cross more than 16 times has no room in it, and a face tells its part apart only
//! among 255: `most_crossings` is `u32::MAX` of such compounds, so that a caster refuses them.
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

/// The most crossings of a ray with a compound of two surfaces; more than any caster has room for where
/// this is more than it has room for itself.
fn most_crossings(a: &impl Surface, b: &impl Surface) -> u32 {
    let [one, other] = [a.most_crossings(), b.most_crossings()];
    let is_told = a.faces().checked_add(b.faces()).is_some();
    if one.max(other) as usize <= CROSSINGS && is_told { one.saturating_add(other) } else { u32::MAX }
}

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
                    last = Some(Crossing { t: Real::from_bits(at_t), enters: !was, face, ..*crossing });
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
                self.0.is_closed() && self.1.is_closed()
            }

            fn most_crossings(&self) -> u32 {
                most_crossings(&self.0, &self.1)
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
                let mut point = match crossing.face.checked_sub(self.0.faces()) {
                    None => self.0.point(ray, cone, crossing, charted),
                    Some(face) => self.1.point(ray, cone, &Crossing { face, ..*crossing }, charted),
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

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::super::solid::{Cube, Placed, Square, TaperedCylinder, Torus};
    use super::*;
    use crate::num::{Affine3, Near};

    fn first(surface: &impl Surface, ray: &Ray) -> (Crossing, SurfacePoint) {
        let mut first = None;
        surface.cross(ray, Unit::ZERO, &mut |crossing| {
            first = Some(crossing);
            ControlFlow::Break(())
        });
        let first = first.unwrap();
        (first, surface.point(ray, Unit::ZERO, &first, true))
    }

    /// What a part says of a crossing is what it says alone, however deep it lies in a compound.
    #[test]
    fn a_point_of_a_compound_is_the_one_of_its_part() {
        let cone = Placed::new(TaperedCylinder::CONE, &Affine3::IDENTITY).unwrap();
        let aside = Affine3::translate(Vec3::lit("10", "0", "0"));
        let cube = Placed::new(Cube, &aside).unwrap();
        let (mut met, mut behind) = (0, 0);
        for k in 0..40 {
            let height = Real::from_num(f64::from(k) * 0.02 + 0.05);
            let from = [Vec3::new(Real::from_num(-3), Real::from_num(0.1), height)];
            for origin in from {
                let ray = Ray::new(origin, Vec3::lit("1", "0", "0"));
                let (crossing, alone) = first(&cone, &ray);
                behind += crossing.memo[0] >> 31;
                let deep = Difference(Union(Union(cone, cube), cube), cube);
                let others = [
                    first(&Union(cone, cube), &ray),
                    first(&Union(Union(cone, cube), cube), &ray),
                    first(&deep, &ray),
                ];
                for (other, point) in others {
                    assert_eq!((other.t, other.face, point), (crossing.t, crossing.face, alone));
                    met += 1;
                }
                let (other, point) = first(&Union(cube, Union(cube, cone)), &ray);
                assert_eq!((other.face, point.place), (crossing.face + 12, alone.place));
                assert_eq!((point.normal, point.chart), (alone.normal, alone.chart));
            }
        }
        assert!(met == 120 && behind > 10, "{met} {behind}");
    }

    #[test]
    fn a_compound_without_room_for_its_parts_says_so() {
        let torus = Placed::new(Torus::new(Near::ONE / 4).unwrap(), &Affine3::IDENTITY).unwrap();
        let four = Union(Union(torus, torus), Union(torus, torus));
        assert_eq!((four.most_crossings(), Union(four, torus).most_crossings()), (16, 20));
        assert_eq!(Difference(torus, Union(four, torus)).most_crossings(), u32::MAX);
        let square = Placed::new(Square, &Affine3::IDENTITY).unwrap();
        assert!(four.is_closed() && !Union(square, torus).is_closed() && !Union(torus, square).is_closed());
    }
}
