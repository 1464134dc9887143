//! The light that comes along a ray: what it meets, and what it is mirrored and bent to, without recursion.
//!
//! A hit may ask for two more rays. They wait in a bounded list, each with how much of it is seen; one is
//! taken out, and two are put in at a deeper level: two more wait than there
//! are levels, and never more.

use heapless::Vec;

use super::super::material::{Lit, Material, Response};
use super::super::ray::Ray;
use super::super::snell::{mirrored, refracted};
use super::super::surface::{Surface, SurfacePoint};
use super::super::surroundings::Surroundings;
use super::scene::{Cast, Interpenetration, Met, World};
use crate::num::{Lumen, Real, Rgb, Unit, Vec3, quotient, unit};

/// Below this weight a ray is not cast: `1/256`.
const FAINT: Lumen = Lumen::from_bits(1 << 8);

/// A ray that waits for its turn.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    cast: Cast,
    /// How much of what it brings is seen.
    weight: Rgb,
    /// How wide its cone is where it starts, 24 fractional bits.
    width: i32,
    level: u8,
}

/// How far rays are followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Depth(pub(super) u8);

fn negated(v: Vec3<Unit>) -> Vec3<Unit> {
    Vec3::new(v.x.saturating_neg(), v.y.saturating_neg(), v.z.saturating_neg())
}

/// A ray from a place in a unit direction.
fn from(place: Vec3, direction: Vec3<Unit>) -> Ray {
    let origin = [place.x, place.y, place.z].map(|c| c.to_bits().clamp(1 - (64 << 24), 64 << 24));
    Ray::from_bits(origin, [direction.x, direction.y, direction.z].map(|c| c.to_bits() >> 2))
}

impl<L: Surface, M: Material> World<'_, L, M> {
    /// The light that comes along a ray of the camera, not cut off. What shares a place with what it must not
    /// share it with is told to `shared`.
    pub(super) fn light<const E: usize, const R: usize>(
        &self,
        cast: Cast,
        depth: Depth,
        surroundings: &impl Surroundings,
        shared: &mut impl FnMut(Interpenetration),
    ) -> Rgb {
        let mut waiting = Vec::<Waiting, R>::new();
        let mut light = Rgb::BLACK;
        let mut next = Some(Waiting { cast, weight: Rgb::WHITE, width: 0, level: 0 });
        while let Some(Waiting { cast, weight, width, level }) = next {
            let direction = unit(cast.ray.direction);
            let met =
                if level <= depth.0 && weight.brightest() >= FAINT { self.met::<E>(&cast) } else { None };
            let seen = met.and_then(|met| Some((met, self.seen(&cast, &met, direction, width)?)));
            if let Some((met, (point, material))) = seen {
                let (before, behind) = self.states_at(&met, point.position);
                if let (Some((other, _)), Some(one)) = self.within(behind) {
                    shared(Interpenetration { objects: [one, other], place: point.position });
                }
                let stay = Cast { states: before, departed: Some(met.event.leaf), ..cast };
                let response = self.response::<E>(&point, material, direction, stay);
                light = light.plus(weight.through(response.light));
                let bounced = self.bounced(&point, material, direction, &response, (before, behind));
                for (direction, states, part) in bounced.into_iter().flatten() {
                    let weight = weight.through(part);
                    if weight != Rgb::BLACK {
                        let cast = Cast { ray: from(point.position, direction), states, ..stay };
                        let width = point.width.to_bits();
                        // there is room: `WorldCaster::with_depth` sees to it
                        let _ = waiting.push(Waiting { cast, weight, width, level: level.saturating_add(1) });
                    }
                }
            } else {
                light = light.plus(weight.through(surroundings.light(direction, cast.cone)));
            }
            next = waiting.pop();
        }
        light
    }

    /// The point of a hit and its material; none beyond the end of the world.
    fn seen(&self, cast: &Cast, met: &Met, direction: Vec3<Unit>, width: i32) -> Option<(SurfacePoint, &M)> {
        let leaf = self.leaf(met.event.leaf)?;
        let crossing = &met.event.crossing;
        let material = self.material(leaf, crossing.face)?;
        let mut point = leaf.surface.point(&cast.ray, cast.cone, crossing, material.is_charted());
        let beyond = |c: Real| c.to_bits().unsigned_abs() > 64 << 24;
        if beyond(point.position.x) || beyond(point.position.y) || beyond(point.position.z) {
            return None;
        }
        if point.normal.dot(direction) > 0 {
            point.normal = negated(point.normal);
        }
        let grown = (i64::from(crossing.t.to_bits()) * i64::from(cast.cone.to_bits())) >> 30;
        point.width = Real::from_bits(i32::try_from(grown + i64::from(width)).unwrap_or(i32::MAX));
        Some((point, material))
    }

    /// What a point answers to the lamps that reach it.
    fn response<const E: usize>(
        &self,
        point: &SurfacePoint,
        material: &M,
        direction: Vec3<Unit>,
        stay: Cast,
    ) -> Response {
        let normal = material.normal(point);
        let lights = self.lamps.iter().filter_map(|lamp| {
            let (towards, distance) = lamp.seen_from(point.position)?;
            if point.normal.dot(towards) <= 0 || normal.dot(towards) <= 0 {
                return None;
            }
            let cast = Cast { ray: from(point.position, towards), ..stay };
            let passed = self.passed::<E>(&cast, distance);
            if passed == Rgb::BLACK {
                None
            } else {
                Some(Lit { towards, light: lamp.light().through(passed) })
            }
        });
        material.respond(point, direction, lights)
    }

    /// The mirrored and the refracted ray of a hit: direction, states, and how much of each is seen.
    fn bounced(
        &self,
        point: &SurfacePoint,
        material: &M,
        direction: Vec3<Unit>,
        response: &Response,
        (before, behind): (u64, u64),
    ) -> [Option<(Vec3<Unit>, u64, Rgb)>; 2] {
        let mut reflected = response.reflected;
        let mut bent = None;
        let mut normal = material.normal(point);
        if normal.dot(direction) >= 0 {
            // a bump that is looked at from behind
            normal = point.normal;
        }
        if response.refracted != Rgb::BLACK {
            let medium = |states| self.within(states).0;
            let index = |states| medium(states).map_or(Real::ONE, |(_, medium)| medium.index).to_bits();
            // indices are between 0.1 and 10: the quotient fits
            let behind_it = u64::from(index(behind).unsigned_abs());
            let eta = Real::from_bits(quotient(index(before).into(), 24, behind_it) as i32);
            let mut way = refracted(direction, normal, eta);
            if way.is_some_and(|way| way.direction.dot(point.normal) >= 0) {
                way = refracted(direction, point.normal, eta);
            }
            let fresnel = medium(before).or(medium(behind)).is_some_and(|(_, medium)| medium.fresnel);
            let share = match &way {
                None => Unit::ONE,
                Some(way) if fresnel => way.reflectance(negated(normal).dot(direction), eta),
                Some(_) => Unit::ZERO,
            };
            reflected = reflected.plus(response.refracted.scaled(share));
            bent = way.map(|way| (way.direction, behind, response.refracted.scaled(Unit::ONE - share)));
        }
        let mirror = if reflected == Rgb::BLACK {
            None
        } else {
            let mut way = mirrored(direction, normal);
            if way.dot(point.normal) < 0 {
                way = mirrored(way, point.normal);
            }
            Some((way, before, reflected))
        };
        [mirror, bent]
    }
}
