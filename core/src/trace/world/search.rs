//! What a ray meets first in a world, and how much light passes along it.
//!
//! The crossings of a ray with the leaves of an object stand in a list, sorted; a bit for each leaf tells
//! whether the ray is inside it, and the first event at which the function of the object changes is its hit.
//! What is opaque is looked at one object after the other, and none needs what is farther than the hit so
//! far; the transparent ones share a list, as what is seen of one depends on the media of all. No interval
//! lists, no recursion. What the bits are behind the hit tells which media a refracted ray is in.

use core::ops::ControlFlow;

use super::super::material::Material;
use super::super::ray::Ray;
use super::super::surface::{Crossing, SAME, Surface};
use super::events::{Event, Events};
use super::object::{Object, is_left};
use super::scene::{Interpenetration, World};
use super::states::{States, bit, has};
use crate::num::{Rgb, Unit};

/// What is known of a ray where it starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub(super) cone: Unit,
    pub(super) states: States,
    /// The leaf from which it starts, if any.
    pub(super) departed: Option<u8>,
    /// The object that is that leaf alone, where the ray leaves it for good, or [`NONE`].
    pub(super) left: u32,
}

/// The number of no object.
pub(super) const NONE: u32 = u32::MAX;

/// What a ray meets first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met {
    pub(super) event: Event,
    /// The states before and behind it.
    pub(super) before: u64,
    pub(super) behind: u64,
    /// Leaves whose state was not followed, as the ray misses the objects of which they are parts.
    pub(super) unknown: u64,
}

impl Met {
    /// Whether this is met, and not the other: at one parameter it is what is named first.
    #[inline]
    fn precedes(&self, other: &Self) -> bool {
        let (event, other) = (&self.event, &other.event);
        if event.t().abs_diff(other.t()) <= SAME.unsigned_abs() {
            event.object < other.object
        } else {
            event.t() < other.t()
        }
    }

    /// Whether an event of another object has taken effect before this.
    #[inline]
    fn follows(&self, other: &Event) -> bool {
        let event = &self.event;
        let margin = if other.object < event.object { SAME } else { -SAME };
        other.object != event.object && other.t() <= event.t().saturating_add(margin)
    }
}

/// A ray on its way through the leaves.
struct Search<'r, const E: usize> {
    ray: &'r Ray,
    start: &'r Start,
    events: Events<E>,
    states: States,
    /// Leaves that were not crossed.
    untried: u64,
    /// What is farther is of no use.
    limit: i32,
    /// From which event on they are sorted.
    begin: usize,
    leaf: u8,
    object: u8,
    /// Whether the ray starts inside the leaf, and whether the first crossing is to tell.
    is_inside: bool,
    is_undecided: bool,
    /// The first change that was found so far, and the states at the ray's start as they were known then.
    found: Option<Met>,
    base: u64,
}

impl<'r, const E: usize> Search<'r, E> {
    fn new(ray: &'r Ray, start: &'r Start, limit: i32) -> Self {
        Self {
            ray,
            start,
            events: Events::new(),
            states: start.states,
            untried: 0,
            limit,
            begin: 0,
            leaf: 0,
            object: 0,
            is_inside: false,
            is_undecided: false,
            found: None,
            base: 0,
        }
    }

    /// Keeps a change, if it is the first so far.
    #[inline]
    fn keep(&mut self, met: Met) {
        if self.found.as_ref().is_none_or(|other| met.precedes(other)) {
            // what comes later changes nothing before: not what is at its parameter, nor what is at theirs
            self.limit = met.event.t().saturating_add(2 * SAME);
            (self.found, self.base) = (Some(met), self.states.inside);
        }
    }

    /// Takes a crossing of the leaf.
    #[inline]
    fn take(&mut self, crossing: Crossing) -> ControlFlow<()> {
        if self.is_undecided {
            (self.is_inside, self.is_undecided) = (!crossing.enters, false);
        }
        if crossing.t.to_bits() > self.limit {
            return ControlFlow::Break(());
        }
        self.events.insert(self.begin, Event { crossing, leaf: self.leaf, object: self.object });
        ControlFlow::Continue(())
    }
}

impl<L: Surface, M: Material, const COMPOUNDS: bool> World<'_, L, M, COMPOUNDS> {
    /// Puts the crossings of a ray with a leaf into the search's list. Answers whether any part of the ray is
    /// inside. On which side of an open surface a ray starts that does not come from it, its first crossing
    /// tells.
    #[inline(never)]
    fn cross<const E: usize>(&self, search: &mut Search<'_, E>, number: u8) -> bool {
        let Some(leaf) = self.leaf(number) else { return false };
        let surface = &leaf.surface;
        search.leaf = number;
        search.is_inside = has(search.states.inside, number);
        if search.start.departed == Some(number) {
            if is_left(surface)[usize::from(search.is_inside)] {
                return search.is_inside;
            }
            search.is_undecided = false;
        } else {
            search.is_undecided = has(search.states.unknown, number) || !surface.is_closed();
        }
        let (was_undecided, count) = (search.is_undecided, search.events.len());
        surface.cross(search.ray, search.start.cone, &mut |crossing| search.take(crossing));
        if was_undecided {
            self.decide(search);
        }
        search.is_inside || search.events.len() > count
    }

    /// Keeps on which side of the leaf the ray starts.
    #[cold]
    #[inline(never)]
    fn decide<const E: usize>(&self, search: &mut Search<'_, E>) {
        let bit = bit(search.leaf);
        // without compounds all leaves are followed
        if COMPOUNDS && search.is_undecided {
            search.states = self.known(search.states, bit, search.ray.origin());
            search.is_inside = has(search.states.inside, search.leaf);
        }
        let States { inside, unknown } = search.states;
        let inside = if search.is_inside { inside | bit } else { inside & !bit };
        search.states = States { inside, unknown: unknown & !bit };
    }

    /// A start from a leaf, of an object, with these states.
    #[inline]
    pub(super) fn departure(&self, [leaf, object]: [u8; 2], states: States, cone: Unit) -> Start {
        let whole = self.objects.get(usize::from(object));
        let is_left = whole.is_some_and(|whole| whole.is_left_by(leaf, states.inside));
        Start { cone, states, departed: Some(leaf), left: if is_left { object.into() } else { NONE } }
    }

    /// Whether a ray cannot meet an object: it leaves it for good, or certainly passes it by. Of the leaves
    /// of the latter nothing is known.
    #[inline(always)]
    fn is_missed(
        &self,
        number: u32,
        object: &Object<'_>,
        ray: &Ray,
        start: &Start,
        untried: &mut u64,
    ) -> bool {
        if start.left == number {
            return true;
        }
        let is_passed_by = object.ball.is_passed_by(ray);
        if COMPOUNDS && is_passed_by {
            *untried |= object.others;
        }
        is_passed_by
    }

    /// The objects that a ray may meet, a bit each.
    #[inline(never)]
    fn near(&self, ray: &Ray, start: &Start, untried: &mut u64) -> u64 {
        let mut near = 0;
        for (number, object) in (0..).zip(self.objects) {
            if !self.is_missed(number, object, ray, start, untried) {
                near |= bit(number as u8);
            }
        }
        near
    }

    /// The objects of a set, with their numbers.
    #[inline(always)]
    fn among(&self, set: u64) -> impl Iterator<Item = (u8, &Object<'_>)> {
        let mut rest = set;
        core::iter::from_fn(move || {
            let number = rest.trailing_zeros() as u8;
            rest &= rest.wrapping_sub(1);
            Some((number, self.objects.get(usize::from(number))?))
        })
    }

    /// Crosses all leaves of a transparent object. Answers whether there is anything new.
    #[inline(never)]
    fn cross_all<const E: usize>(&self, search: &mut Search<'_, E>, number: u8, object: &Object<'_>) -> bool {
        let count = search.events.len();
        search.object = number;
        if let Some(leaf) = object.only() {
            self.cross(search, leaf);
        } else if COMPOUNDS {
            search.untried |= object.tried(search.ray, |leaf| self.cross(search, leaf));
        }
        search.events.len() > count
    }

    /// Looks for the first change of an opaque object.
    #[inline(never)]
    fn first<const E: usize>(&self, search: &mut Search<'_, E>, number: u8, object: &Object<'_>) {
        if let Some(leaf) = object.only() {
            let Search { ray, start, states, limit, .. } = *search;
            if let Some(met) = self.change_of([leaf, number], ray, start, states, limit) {
                search.keep(met);
            }
            return;
        }
        // a world without compounds has no code of them
        if !COMPOUNDS {
            return;
        }
        (search.begin, search.object) = (search.events.len(), number);
        if let Some((leaf, others)) = object.carved() {
            if !self.cross(search, leaf) {
                search.untried |= object.others;
                return;
            }
            // a crossing out of what it is outside of already is that from which it starts
            let mut own = search.events.all().iter().skip(search.begin);
            let first = own.find(|event| event.crossing.enters).filter(|_| !search.is_inside);
            if let Some(event) = first.copied() {
                // where it comes in it is outside all that is taken away
                let place = search.ray.at(event.crossing.t);
                let is_clear = |leaf| self.leaf(leaf).is_some_and(|leaf| leaf.surface.is_clear_of(place));
                if others.clone().all(is_clear) {
                    let before = search.states.inside & !object.others;
                    return search.keep(Met { event, before, behind: event.behind(before), unknown: 0 });
                }
            }
            for leaf in others {
                self.cross(search, leaf);
            }
        } else {
            search.untried |= object.tried(search.ray, |leaf| self.cross(search, leaf));
        }
        let (events, mut from, mut before) = (&search.events, search.begin, search.states.inside);
        let was = object.is_inside(before);
        loop {
            let group = events.together(from);
            let Some(last) = group.last() else { return };
            let behind = group.iter().fold(before, |states, event| event.behind(states));
            if object.is_inside(behind) != was {
                let leaf = object.last_of(before ^ behind);
                let event = *group.iter().rev().find(|event| Some(event.leaf) == leaf).unwrap_or(last);
                return search.keep(Met { event, before, behind, unknown: 0 });
            }
            (from, before) = (from + group.len(), behind);
        }
    }

    /// The first seen change of an object, from the event at `start` with these states on, and the
    /// event from which to go on.
    ///
    /// Of several objects that change at one parameter each is met in turn, in the order of naming: with the
    /// states behind the hit the same events tell of the next, as an event that has taken effect changes
    /// nothing any more.
    fn change<const E: usize>(&self, events: &Events<E>, start: usize, states: u64) -> Option<(Met, usize)> {
        let (mut at, mut before) = (start, states);
        loop {
            let group = events.together(at);
            if let [event] = group {
                // mostly one alone
                let behind = event.behind(before);
                let object = self.objects.get(usize::from(event.object))?;
                if object.is_inside(before) != object.is_inside(behind) {
                    let met = Met { event: *event, before, behind, unknown: 0 };
                    if self.is_seen(&met) {
                        return Some((met, at));
                    }
                }
                (before, at) = (behind, at + 1);
                continue;
            }
            if group.is_empty() {
                return None;
            }
            let mut from = 0;
            while let Some(number) = group.iter().map(|event| event.object).filter(|o| *o >= from).min() {
                let behind = events.of(number, at).fold(before, |states, event| event.behind(states));
                let object = self.objects.get(usize::from(number))?;
                if object.is_inside(before) != object.is_inside(behind) {
                    let last = object.last_of(before ^ behind)?;
                    let event = events.of(number, at).filter(|event| event.leaf == last).last();
                    let met = Met { event: *event?, before, behind, unknown: 0 };
                    if self.is_seen(&met) {
                        return Some((met, at));
                    }
                }
                (before, from) = (behind, number.saturating_add(1));
            }
            at += group.len();
        }
    }

    /// Whether a hit is seen: of a transparent object that at which the medium changes.
    fn is_seen(&self, met: &Met) -> bool {
        // what comes from no medium, or leads to none
        if !self.is_clear(met.before)
            || !self.is_clear(met.behind)
            || self.panes() & bit(met.event.object) != 0
        {
            return true;
        }
        let object = |states| self.within(states).0.map(|(object, _)| object);
        object(met.before) != object(met.behind)
    }

    /// The first change of an opaque leaf that is an object of its own, up to `limit`: nothing has to be
    /// sorted.
    #[inline(never)]
    fn change_of(
        &self,
        [number, object]: [u8; 2],
        ray: &Ray,
        start: &Start,
        States { inside, unknown }: States,
        limit: i32,
    ) -> Option<Met> {
        let surface = &self.leaf(number)?.surface;
        let mut is_inside = has(inside, number);
        let mut is_undecided =
            start.departed != Some(number) && (has(unknown, number) || !surface.is_closed());
        let mut first = None;
        surface.cross(ray, start.cone, &mut |crossing| {
            if is_undecided {
                (is_inside, is_undecided) = (!crossing.enters, false);
            }
            if crossing.t.to_bits() > limit {
                return ControlFlow::Break(());
            }
            // a crossing into what the ray is in already is that from which it starts
            if crossing.enters == is_inside {
                return ControlFlow::Continue(());
            }
            first = Some(crossing);
            ControlFlow::Break(())
        });
        let (crossing, bit) = (first?, bit(number));
        let (before, behind) =
            if is_inside { (inside | bit, inside & !bit) } else { (inside & !bit, inside | bit) };
        let event = Event { crossing, leaf: number, object };
        Some(Met { event, before, behind, unknown: 0 })
    }

    /// What a ray meets first.
    #[inline(never)]
    pub(super) fn met<const E: usize>(&self, ray: &Ray, start: &Start) -> Option<Met> {
        if let [object] = self.objects
            && let Some(leaf) = object.only()
            && self.media() == 0
        {
            let is_missed = self.is_missed(0, object, ray, start, &mut 0);
            return if is_missed {
                None
            } else {
                self.change_of([leaf, 0], ray, start, start.states, i32::MAX)
            };
        }
        let mut search = Search::<E>::new(ray, start, i32::MAX);
        if M::MAY_BE_CLEAR {
            let near = self.near(ray, start, &mut search.untried);
            for (number, object) in self.among(near & self.media()) {
                if self.cross_all(&mut search, number, object) {
                    search.found = None;
                    if let Some((met, _)) = self.change(&search.events, 0, search.states.inside) {
                        search.keep(met);
                        search.events.cut(search.limit);
                    }
                }
            }
            for (number, object) in self.among(near & !self.media()) {
                self.first(&mut search, number, object);
            }
        } else {
            for (number, object) in (0..).zip(self.objects) {
                if !self.is_missed(number, object, ray, start, &mut search.untried) {
                    self.first(&mut search, number as u8, object);
                }
            }
        }
        let mut met = search.found?;
        // the others as they are there, and what was found out since
        let others = search.events.all().iter().filter(|event| met.follows(event));
        let found_out = search.states.inside ^ search.base;
        let states = others.fold(met.before ^ found_out, |states, event| event.behind(states));
        met.behind ^= met.before ^ states;
        (met.before, met.unknown) = (states, search.untried);
        Some(met)
    }

    /// The first place along a ray that two transparent objects of equal priority share, and which they are;
    /// whether anything opaque stands before it or not.
    pub(super) fn overlap<const E: usize>(&self, ray: &Ray, start: &Start) -> Option<Interpenetration> {
        let mut search = Search::<E>::new(ray, start, i32::MAX);
        let near = self.near(ray, start, &mut search.untried);
        for (number, object) in self.among(near & self.media()) {
            self.cross_all(&mut search, number, object);
        }
        let (mut states, mut at) = (search.states.inside, 0);
        loop {
            let group = search.events.together(at);
            let first = group.first()?;
            states = group.iter().fold(states, |states, event| event.behind(states));
            if let (Some((other, _)), Some(one)) = self.within(states) {
                let place = ray.at(first.crossing.t);
                return Some(Interpenetration { objects: [one, other], place });
            }
            at += group.len();
        }
    }

    /// How much light comes along a ray from beyond `limit`: what the things on the way let pass.
    pub(super) fn passed<const E: usize>(&self, ray: &Ray, start: &Start, limit: i32) -> Rgb {
        let mut untried = 0;
        if M::MAY_BE_CLEAR {
            let near = self.near(ray, start, &mut untried);
            // what is opaque all over needs no more than to be met
            let clear = near & (self.media() | self.panes());
            for (number, object) in self.among(near & !clear) {
                if self.is_met::<E>(ray, start, limit, number, object) {
                    return Rgb::BLACK;
                }
            }
            if clear == 0 { Rgb::WHITE } else { self.let_through::<E>(ray, start, limit, clear) }
        } else {
            for (number, object) in (0..).zip(self.objects) {
                let is_missed = self.is_missed(number, object, ray, start, &mut untried);
                if !is_missed && self.is_met::<E>(ray, start, limit, number as u8, object) {
                    return Rgb::BLACK;
                }
            }
            Rgb::WHITE
        }
    }

    /// Whether a ray meets an opaque object up to `limit`.
    #[inline(never)]
    fn is_met<const E: usize>(
        &self,
        ray: &Ray,
        start: &Start,
        limit: i32,
        number: u8,
        object: &Object<'_>,
    ) -> bool {
        if let Some(leaf) = object.only() {
            return self.change_of([leaf, number], ray, start, start.states, limit).is_some();
        }
        let mut search = Search::<E>::new(ray, start, limit);
        self.first(&mut search, number, object);
        search.found.is_some()
    }

    /// How much light these objects let pass.
    #[inline(never)]
    fn let_through<const E: usize>(&self, ray: &Ray, start: &Start, limit: i32, clear: u64) -> Rgb {
        let mut search = Search::<E>::new(ray, start, limit);
        for (number, object) in self.among(clear) {
            self.cross_all(&mut search, number, object);
        }
        let (mut light, mut at, mut states) = (Rgb::WHITE, 0, search.states.inside);
        while let Some((met, next)) = self.change(&search.events, at, states) {
            let leaf = self.leaf(met.event.leaf);
            let material = leaf.and_then(|leaf| self.material(leaf, met.event.crossing.face));
            light = light.through(material.map_or(Rgb::BLACK, Material::passes));
            (states, at) = (met.behind, next);
        }
        light
    }
}
