//! The light that comes along a ray: what it meets, and what it is mirrored and bent to, without recursion.
//!
//! A hit may ask for two more rays. They wait in a bounded list, each with how much of it is seen; one is
//! taken out, and two are put in at a deeper level: two more wait than there
//! are levels, and never more.

use heapless::Vec;

use super::super::material::{Lit, Material, Medium, Response};
use super::super::ray::Ray;
use super::super::snell::{mirrored, refracted};
use super::super::surface::{Crossing, Surface, SurfacePoint};
use super::super::surroundings::Surroundings;
use super::scene::{Interpenetration, Leaf, World};
use super::search::{Met, Start};
use crate::num::{Lumen, Real, Rgb, Unit, Vec3, product, reciprocal};

/// Below this weight a ray is not cast: `1/256`.
const FAINT: Lumen = Lumen::from_bits(1 << 8);

/// A ray that waits for its turn.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    ray: Ray,
    start: Start,
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

/// The quotient of two indices of refraction, which are between 0.1 and 10.
fn over(a: Real, b: Real) -> Real {
    // `1 / b` is mantissa / 2^shift
    let (mantissa, shift) = reciprocal(b.to_bits().unsigned_abs());
    Real::from_bits((((product(a.to_bits(), mantissa as i32) >> (shift - 25)) + 1) >> 1) as i32)
}

/// Whether a place is not beyond the end of the world.
fn lies_in_the_world(place: Vec3) -> bool {
    [place.x, place.y, place.z].into_iter().all(|c| c.to_bits().unsigned_abs() < 64 << 24)
}

impl<L: Surface, M: Material, const COMPOUNDS: bool> World<'_, L, M, COMPOUNDS> {
    /// The light that comes along a ray of the camera, not cut off. What shares a place with what it must not
    /// share it with is told to `shared`.
    pub(super) fn light<const E: usize, const R: usize>(
        &self,
        mut ray: Ray,
        start: &Start,
        depth: Depth,
        surroundings: &impl Surroundings,
        shared: &mut impl FnMut(Interpenetration),
    ) -> Rgb {
        let mut waiting = Vec::<Waiting, R>::new();
        let mut light = Rgb::BLACK;
        // the first ray stays where it is
        let (mut spawned, mut weight, mut width, mut level) = (None, Rgb::WHITE, 0, 0_u8);
        loop {
            let (ray_now, start) = (&ray, spawned.as_ref().unwrap_or(start));
            let direction = ray_now.unit_direction();
            let weighted = |light: Rgb| if level == 0 { light } else { weight.through(light) };
            let is_cast = level <= depth.0 && weight.brightest() >= FAINT;
            let met = if is_cast { self.met::<E>(ray_now, start) } else { None };
            let is_seen = met.as_ref().is_some_and(|met| {
                let Some((leaf, material, crossing)) = self.hit(met) else { return false };
                let mut point = leaf.surface.point(ray_now, start.cone, crossing, material.is_charted());
                if !lies_in_the_world(point.position) {
                    return false;
                }
                if point.normal.dot(direction) > 0 {
                    (point.normal, point.inward) = (negated(point.normal), true);
                }
                let grown = (i64::from(crossing.t.to_bits()) * i64::from(start.cone.to_bits())) >> 30;
                point.width = Real::from_bits(i32::try_from(grown + i64::from(width)).unwrap_or(i32::MAX));
                let point = &point;
                let states =
                    [met.before, met.behind].map(|all| self.states_at(all, met.unknown, point.position));
                let [before, behind] = states;
                if let (true, (Some((other, _)), Some(one))) = (M::MAY_BE_CLEAR, self.within(behind.inside)) {
                    shared(Interpenetration { objects: [one, other], place: point.position });
                }
                let stay = Start { states: before, departed: Some(met.event.leaf), ..*start };
                let response = self.response::<E>(point, material, direction, &stay);
                light = light.plus(weighted(response.light));
                if response.reflected != Rgb::BLACK || response.refracted != Rgb::BLACK {
                    let states_inside = [before.inside, behind.inside];
                    let parts = self.bounced(point, material, direction, &response, states_inside);
                    for (part, states) in parts.into_iter().zip(states) {
                        let Some((direction, part)) = part else { continue };
                        let weight = weight.through(part);
                        if weight != Rgb::BLACK {
                            let (ray, start) =
                                (Ray::unit(point.position, direction), Start { states, ..stay });
                            let (width, level) = (point.width.to_bits(), level.saturating_add(1));
                            // there is room: `WorldCaster::with_depth` sees to it
                            let _ = waiting.push(Waiting { ray, start, weight, width, level });
                        }
                    }
                }
                true
            });
            if !is_seen {
                light = light.plus(weighted(surroundings.light(direction, start.cone)));
            }
            let Some(next) = waiting.pop() else { return light };
            (ray, spawned, weight, width, level) =
                (next.ray, Some(next.start), next.weight, next.width, next.level);
        }
    }

    /// What is hit: the leaf, its material, and where.
    fn hit<'m>(&self, met: &'m Met) -> Option<(&Leaf<'_, L>, &M, &'m Crossing)> {
        let leaf = self.leaf(met.event.leaf)?;
        let crossing = &met.event.crossing;
        Some((leaf, self.material(leaf, crossing.face)?, crossing))
    }

    /// What a point answers to the lamps that reach it.
    fn response<const E: usize>(
        &self,
        point: &SurfacePoint,
        material: &M,
        direction: Vec3<Unit>,
        stay: &Start,
    ) -> Response {
        let normal = material.normal(point);
        let lights = self.lamps.iter().filter_map(|lamp| {
            let (towards, distance) = lamp.seen_from(point.position)?;
            if point.normal.dot(towards) <= 0 || normal.dot(towards) <= 0 {
                return None;
            }
            let passed = self.passed::<E>(&Ray::unit(point.position, towards), stay, distance);
            if passed == Rgb::BLACK {
                None
            } else if passed == Rgb::WHITE {
                Some(Lit { towards, light: lamp.light() })
            } else {
                Some(Lit { towards, light: lamp.light().through(passed) })
            }
        });
        material.respond(point, direction, lights)
    }

    /// The mirrored and the refracted ray of a hit: direction, and how much of each is seen. The states are
    /// those before and behind it.
    fn bounced(
        &self,
        point: &SurfacePoint,
        material: &M,
        direction: Vec3<Unit>,
        response: &Response,
        [before, behind]: [u64; 2],
    ) -> [Option<(Vec3<Unit>, Rgb)>; 2] {
        let mut reflected = response.reflected;
        let mut bent = None;
        let mut normal = material.normal(point);
        if normal.dot(direction) >= 0 {
            // a bump that is looked at from behind
            normal = point.normal;
        }
        if M::MAY_BE_CLEAR && response.refracted != Rgb::BLACK {
            let [from, to] = [before, behind].map(|states| self.within(states).0);
            let index = |medium: Option<(u8, Medium)>| medium.map_or(Real::ONE, |(_, medium)| medium.index);
            let eta = over(index(from), index(to));
            let (mut facing, mut way) = (normal, refracted(direction, normal, eta));
            if way.is_some_and(|way| way.direction.dot(point.normal) >= 0) {
                (facing, way) = (point.normal, refracted(direction, point.normal, eta));
            }
            let fresnel = from.or(to).is_some_and(|(_, medium)| medium.fresnel);
            let share = match &way {
                None => Unit::ONE,
                Some(way) if fresnel => way.reflectance(negated(facing).dot(direction), eta),
                Some(_) => Unit::ZERO,
            };
            reflected = reflected.plus(response.refracted.scaled(share));
            bent = way.map(|way| (way.direction, response.refracted.scaled(Unit::ONE - share)));
        }
        let mirror = if reflected == Rgb::BLACK {
            None
        } else {
            let mut way = mirrored(direction, normal);
            if way.dot(point.normal) < 0 {
                way = mirrored(way, point.normal);
            }
            Some((way, reflected))
        };
        [mirror, bent]
    }
}
