//! A world: leaves, objects made of them, materials and lamps; and what a ray meets first in it.
//!
//! The crossings of a ray with all leaves stand in one list, sorted; a bit for each leaf tells whether the ray
//! is inside it, and the first event at which the function of an object changes is the hit. No interval lists,
//! no recursion. What the bits are behind the hit tells which media a refracted ray is in.

use core::ops::ControlFlow;

use super::super::material::{Material, Medium};
use super::super::ray::Ray;
use super::super::surface::{SAME, Surface};
use super::events::{Event, Events};
use super::lamp::Lamp;
use super::object::{LEAVES, Object};
use crate::Error;
use crate::num::{Real, Rgb, Unit, Vec3, Wide};

/// A surface of a world and the numbers of its materials, one a face; where there are fewer, the last one is
/// that of the others.
#[derive(Debug, Clone, Copy)]
pub struct Leaf<'a, L> {
    /// What rays cross.
    pub surface: L,
    /// The number of the material of each face.
    pub materials: &'a [u8],
}

/// Leaves, objects, materials and lamps.
///
/// All memory is lent; a world is small and can be copied. At most 64 leaves; what lies farther than 64 from
/// the origin along an axis is not seen.
#[derive(Debug, Clone, Copy)]
pub struct World<'a, L, M> {
    leaves: &'a [Leaf<'a, L>],
    objects: &'a [Object<'a>],
    materials: &'a [M],
    pub(super) lamps: &'a [Lamp],
    /// Whether any object is transparent.
    has_media: bool,
}

/// Two transparent objects of equal priority that share a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Interpenetration {
    /// Their numbers.
    pub objects: [u8; 2],
    /// Where a ray found it.
    pub place: Vec3,
}

/// A ray on its way: what is known of it where it starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cast {
    pub(super) ray: Ray,
    pub(super) cone: Unit,
    /// The state of each leaf at its start.
    pub(super) states: u64,
    /// The leaf from which it starts, if any.
    pub(super) departed: Option<u8>,
}

/// What a ray meets first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met {
    pub(super) event: Event,
    /// The states before and behind it.
    pub(super) before: u64,
    pub(super) behind: u64,
    /// Leaves whose state was not followed, as the ray misses the objects of which they are parts.
    unfollowed: u64,
}

/// The medium of a place: the object, and what is in it.
type Within = Option<(u8, Medium)>;

impl<'a, L: Surface, M: Material> World<'a, L, M> {
    /// A world without lamps.
    ///
    /// # Errors
    /// [`Error::TooFew`] without objects, [`Error::Capacity`] for more than 64 leaves,
    /// [`Error::OutOfRange`] for a leaf that belongs to two objects or a material that is not there,
    /// [`Error::LengthMismatch`] for a leaf of no object or without a material.
    pub fn new(
        leaves: &'a [Leaf<'a, L>],
        objects: &'a [Object<'a>],
        materials: &'a [M],
    ) -> Result<Self, Error> {
        if leaves.len() > LEAVES {
            return Err(Error::Capacity {
                what: "leaves of a world",
                needed: leaves.len(),
                capacity: LEAVES,
            });
        }
        if objects.is_empty() {
            return Err(Error::TooFew { what: "objects of a world", given: 0, at_least: 1 });
        }
        let mut used = 0_u64;
        for leaf in objects.iter().flat_map(Object::leaves) {
            let bit = 1_u64 << (leaf & 63);
            if usize::from(leaf) >= leaves.len() || used & bit > 0 {
                let max = Wide::from_num(leaves.len().saturating_sub(1) as u8);
                let (value, min) = (Wide::from_num(leaf), Wide::ZERO);
                return Err(Error::OutOfRange {
                    what: "leaf, of one object each",
                    index: None,
                    value,
                    min,
                    max,
                });
            }
            used |= bit;
        }
        if used.count_ones() as usize != leaves.len() {
            let given = used.count_ones() as usize;
            return Err(Error::LengthMismatch {
                what: "leaves that objects use",
                given,
                expected: leaves.len(),
            });
        }
        for (index, leaf) in leaves.iter().enumerate() {
            if leaf.materials.is_empty() {
                return Err(Error::LengthMismatch { what: "materials of a leaf", given: 0, expected: 1 });
            }
            for material in leaf.materials {
                if usize::from(*material) >= materials.len() {
                    return Err(Error::OutOfRange {
                        what: "material of a leaf",
                        index: Some(index),
                        value: Wide::from_num(*material),
                        min: Wide::ZERO,
                        max: Wide::from_num(materials.len().saturating_sub(1).min(255) as u8),
                    });
                }
            }
        }
        let mut world = Self { leaves, objects, materials, lamps: &[], has_media: false };
        world.has_media = (0..objects.len()).any(|object| world.medium(object as u8).is_some());
        Ok(world)
    }

    /// With these lamps.
    #[must_use]
    pub fn with_lamps(mut self, lamps: &'a [Lamp]) -> Self {
        self.lamps = lamps;
        self
    }

    /// How many crossings a ray can have, all leaves together: what a caster needs room for.
    pub fn most_crossings(&self) -> u32 {
        self.leaves.iter().fold(0, |sum, leaf| sum.saturating_add(leaf.surface.most_crossings()))
    }

    /// Its leaves.
    pub(super) fn leaf(&self, number: u8) -> Option<&'a Leaf<'a, L>> {
        self.leaves.get(usize::from(number))
    }

    /// The material of a face of a leaf.
    pub(super) fn material(&self, leaf: &Leaf<'a, L>, face: u8) -> Option<&'a M> {
        let number = leaf.materials.get(usize::from(face)).or(leaf.materials.last())?;
        self.materials.get(usize::from(*number))
    }

    /// What is inside an object: the medium of the first material of its first leaf.
    fn medium(&self, object: u8) -> Option<Medium> {
        let leaf = self.leaf(self.objects.get(usize::from(object))?.leaves().next()?)?;
        self.material(leaf, 0)?.medium()
    }

    /// The states of all leaves at a place: what of closed leaves it is inside.
    pub(super) fn states(&self, place: Vec3) -> u64 {
        self.refreshed(0, u64::MAX, place)
    }

    /// `states` with those of the leaves in `which` as the inside-outside functions have it.
    fn refreshed(&self, mut states: u64, which: u64, place: Vec3) -> u64 {
        for (number, leaf) in self.leaves.iter().enumerate() {
            let bit = 1_u64 << (number & 63);
            if which & bit > 0 && leaf.surface.is_closed() {
                let inside = leaf.surface.extent().holds(place) && leaf.surface.value(place) <= Wide::ZERO;
                states = if inside { states | bit } else { states & !bit };
            }
        }
        states
    }

    /// The medium at a place with these states, and whether another object of the same priority shares it.
    pub(super) fn within(&self, states: u64) -> (Within, Option<u8>) {
        let (mut within, mut shared): (Within, _) = (None, None);
        if self.has_media {
            for (number, object) in self.objects.iter().enumerate() {
                let Some(medium) = self.medium(number as u8).filter(|_| object.is_inside(states)) else {
                    continue;
                };
                match within {
                    Some((_, top)) if top.priority > medium.priority => {}
                    Some((other, top)) => {
                        shared = if top.priority == medium.priority { Some(other) } else { None };
                        within = Some((number as u8, medium));
                    }
                    None => within = Some((number as u8, medium)),
                }
            }
        }
        (within, shared)
    }

    /// The crossings of a ray with an object up to `limit`; answers which leaves were not tried. On which side
    /// of an open surface a ray starts that does not come from it, its first crossing tells: `states`.
    #[inline]
    fn cross<const E: usize>(
        &self,
        number: u8,
        cast: &Cast,
        limit: i32,
        events: &mut Events<E>,
        states: &mut u64,
    ) -> u64 {
        let mut untried = 0;
        let Some(object) = self.objects.get(usize::from(number)) else { return 0 };
        let alone = object.only().is_some() && !(self.has_media && self.medium(number).is_some());
        object.tried(&cast.ray, |number_of_leaf, tried| {
            let bit = 1_u64 << (number_of_leaf & 63);
            let Some(leaf) = self.leaf(number_of_leaf).filter(|_| tried) else {
                untried |= bit;
                return;
            };
            // near where the ray starts may be the very point from which it starts
            let departs = cast.departed == Some(number_of_leaf);
            let own = if departs { leaf.surface.error() } else { -Real::DELTA };
            let mut undecided = !departs && !leaf.surface.is_closed();
            leaf.surface.cross(&cast.ray, cast.cone, &mut |crossing| {
                if crossing.t.to_bits() > limit {
                    return ControlFlow::Break(());
                }
                let event = Event { crossing, leaf: number_of_leaf, object: number };
                if crossing.t <= own {
                    return ControlFlow::Continue(());
                }
                if undecided {
                    *states = if crossing.enters { *states & !bit } else { *states | bit };
                    undecided = false;
                }
                if !alone {
                    events.insert(event);
                } else if event.behind(*states) != *states {
                    // the first change of the only leaf is the object's, and nothing is seen through it
                    events.insert(event);
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            });
        });
        untried
    }

    /// The first seen change of an object, from the event at `start` with these states on, and the event from
    /// which to go on.
    ///
    /// Of several objects that change at one parameter each is met in turn, in the order of naming: with the
    /// states behind the hit the same events tell of the next, as an event that has taken effect changes
    /// nothing any more.
    fn change<const E: usize>(&self, events: &Events<E>, start: usize, states: u64) -> Option<(Met, usize)> {
        let (mut at, mut before) = (start, states);
        loop {
            let group = events.together(at);
            if group.is_empty() {
                return None;
            }
            let mut from = 0;
            while let Some(number) = group.iter().map(|event| event.object).filter(|o| *o >= from).min() {
                let behind = events.of(number, at).fold(before, |states, event| event.behind(states));
                let object = self.objects.get(usize::from(number))?;
                if object.is_inside(before) != object.is_inside(behind) {
                    let changed = |leaf: &u8| (before ^ behind) >> (leaf & 63) & 1 > 0;
                    let last = object.leaves().filter(changed).last()?;
                    let event = events.of(number, at).filter(|event| event.leaf == last).last();
                    let met = Met { event: *event?, before, behind, unfollowed: 0 };
                    if self.is_seen(&met) {
                        return Some((met, at));
                    }
                }
                (before, from) = (behind, number.saturating_add(1));
            }
            at += group.len();
        }
    }

    /// Whether the medium changes at a hit, or what is hit is opaque.
    fn is_seen(&self, met: &Met) -> bool {
        if !self.has_media || self.medium(met.event.object).is_none() {
            return true;
        }
        let object = |states| self.within(states).0.map(|(object, _)| object);
        object(met.before) != object(met.behind)
    }

    /// What a ray meets first.
    #[inline(never)]
    pub(super) fn met<const E: usize>(&self, cast: &Cast) -> Option<Met> {
        let mut events = Events::<E>::new();
        let (mut first, mut limit, mut unfollowed, mut states) = (None, i32::MAX, 0, cast.states);
        for number in 0..self.objects.len() as u8 {
            unfollowed |= self.cross(number, cast, limit, &mut events, &mut states);
            first = self.change(&events, 0, states).map(|(met, _)| met);
            if let Some(met) = &first {
                // what comes later changes nothing before: not what is at its parameter, nor what is at theirs
                limit = met.event.t().saturating_add(2 * SAME);
                events.cut(limit);
            }
        }
        first.map(|met: Met| Met { unfollowed, ..met })
    }

    /// The states before and behind a hit at its place: those of leaves that were not followed are looked up.
    pub(super) fn states_at(&self, met: &Met, place: Vec3) -> (u64, u64) {
        if met.unfollowed == 0 {
            return (met.before, met.behind);
        }
        let looked_up = self.refreshed(met.before, met.unfollowed, place) & met.unfollowed;
        let with = |states: u64| states & !met.unfollowed | looked_up;
        (with(met.before), with(met.behind))
    }

    /// The first place along a ray that two transparent objects of equal priority share, and which they are;
    /// whether anything opaque stands before it or not.
    pub(super) fn overlap<const E: usize>(&self, cast: &Cast) -> Option<Interpenetration> {
        let (mut events, mut states, mut at) = (Events::<E>::new(), cast.states, 0);
        for number in 0..self.objects.len() as u8 {
            if self.medium(number).is_some() {
                self.cross(number, cast, i32::MAX, &mut events, &mut states);
            }
        }
        loop {
            let group = events.together(at);
            let first = group.first()?;
            states = group.iter().fold(states, |states, event| event.behind(states));
            if let (Some((other, _)), Some(one)) = self.within(states) {
                let place = cast.ray.at(first.crossing.t);
                return Some(Interpenetration { objects: [one, other], place });
            }
            at += group.len();
        }
    }

    /// How much light comes along a ray from beyond `limit`: what the things on the way let pass.
    #[inline(never)]
    pub(super) fn passed<const E: usize>(&self, cast: &Cast, limit: i32) -> Rgb {
        let (mut events, mut states) = (Events::<E>::new(), cast.states);
        for number in 0..self.objects.len() as u8 {
            if self.medium(number).is_none() {
                // what is opaque needs no more than to be met
                let mut own = Events::<E>::new();
                self.cross(number, cast, limit, &mut own, &mut states);
                if self.change(&own, 0, states).is_some() {
                    return Rgb::BLACK;
                }
            } else {
                self.cross(number, cast, limit, &mut events, &mut states);
            }
        }
        let (mut light, mut at) = (Rgb::WHITE, 0);
        while let Some((met, next)) = self.change(&events, at, states) {
            let leaf = self.leaf(met.event.leaf);
            let material = leaf.and_then(|leaf| self.material(leaf, met.event.crossing.face));
            light = light.through(material.map_or(Rgb::BLACK, Material::passes));
            (states, at) = (met.behind, next);
        }
        light
    }
}
