//! The crossings of a ray with the leaves of a world, in the order in which the ray meets them.
//!
//! Each event sets or clears the state of its leaf; one that changes nothing is none. That is why a ray that
//! leaves a surface does not meet it again: its own crossing, on whichever side of 0 its parameter was
//! rounded to, sets what is set already.

use heapless::Vec;

use super::super::surface::{Crossing, SAME};
use super::states::bit;

/// A ray crosses a leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Event {
    pub(super) crossing: Crossing,
    pub(super) leaf: u8,
    pub(super) object: u8,
}

impl Event {
    /// 24 fractional bits.
    #[inline]
    pub(super) fn t(&self) -> i32 {
        self.crossing.t.to_bits()
    }

    /// The states of all leaves behind it.
    #[inline]
    pub(super) fn behind(&self, states: u64) -> u64 {
        let bit = bit(self.leaf);
        if self.crossing.enters { states | bit } else { states & !bit }
    }
}

/// The events of a ray, sorted by parameter, those at equal parameters in the order in which they came.
#[derive(Debug)]
pub(super) struct Events<const N: usize>(Vec<Event, N>);

impl<const N: usize> Events<N> {
    pub(super) const fn new() -> Self {
        Self(Vec::new())
    }

    /// How many there are.
    #[inline]
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// All of them.
    #[inline]
    pub(super) fn all(&self) -> &[Event] {
        &self.0
    }

    /// Puts an event into its place among those from `begin` on. A caster has room for all: it asks the
    /// surfaces how many there can be.
    #[inline]
    pub(super) fn insert(&mut self, begin: usize, event: Event) {
        let mut at = self.0.len();
        if self.0.push(event).is_err() {
            return;
        }
        while at > begin {
            match self.0.get_mut(at - 1..=at) {
                Some([other, own]) if other.t() > event.t() => (*own, *other) = (*other, event),
                _ => break,
            }
            at -= 1;
        }
    }

    /// Forgets what lies beyond `t`.
    #[inline]
    pub(super) fn cut(&mut self, t: i32) {
        while self.0.last().is_some_and(|last| last.t() > t) {
            self.0.pop();
        }
    }

    /// The events from the one at `start` on that have its parameter.
    #[inline]
    pub(super) fn together(&self, start: usize) -> &[Event] {
        let rest = self.0.get(start..).unwrap_or(&[]);
        let end = rest.first().map_or(0, |first| first.t().saturating_add(SAME));
        let count = rest.iter().take_while(|event| event.t() <= end).count();
        rest.get(..count).unwrap_or(&[])
    }

    /// The events of an object from the one at `start` on that have the parameter of its first.
    #[inline]
    pub(super) fn of(&self, object: u8, start: usize) -> impl Iterator<Item = &Event> + Clone {
        let own = self.0.get(start..).unwrap_or(&[]).iter().filter(move |event| event.object == object);
        let end = own.clone().next().map_or(0, |first| first.t().saturating_add(SAME));
        own.take_while(move |event| event.t() <= end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Real;

    fn event(t: i32, leaf: u8) -> Event {
        let crossing = Crossing { t: Real::from_bits(t), enters: leaf & 1 == 0, ..Crossing::default() };
        Event { crossing, leaf, object: 0 }
    }

    #[test]
    fn events_are_sorted_and_those_at_one_parameter_stay_in_order() {
        let mut events = Events::<8>::new();
        for (t, leaf) in [(500, 0), (100, 1), (500, 2), (0, 3), (100 + SAME, 4), (101 + SAME, 5)] {
            events.insert(0, event(t, leaf));
        }
        let leaves = |start| events.together(start).iter().map(|e| e.leaf).collect::<std::vec::Vec<_>>();
        assert_eq!((leaves(0), leaves(1), leaves(3)), (std::vec![3], std::vec![1, 4], std::vec![5]));
        assert_eq!((leaves(4), leaves(6)), (std::vec![0, 2], std::vec![]));
        // another object's in between is none of them
        events.insert(0, Event { object: 1, ..event(110, 6) });
        let of = |object, start| events.of(object, start).map(|e| e.leaf).collect::<std::vec::Vec<_>>();
        assert_eq!(
            (of(0, 1), of(1, 1), of(1, 0), of(0, 3)),
            (std::vec![1, 4], std::vec![6], std::vec![6], std::vec![4, 5])
        );
        assert_eq!((of(2, 0), of(0, 9)), (std::vec![], std::vec![]));
        events.cut(100);
        assert_eq!(events.together(0).len() + events.together(1).len(), 2);
        for k in 0..20 {
            events.insert(0, event(k, 1));
        }
        // what has no room is left out, and nothing is lost of what was there
        assert_eq!(events.0.len(), 8);
        events.cut(-1);
        assert!(events.together(0).is_empty());
    }

    #[test]
    fn a_crossing_sets_or_clears_and_does_so_once() {
        let (enters, leaves) = (event(0, 2), event(0, 3));
        assert_eq!((enters.behind(0), enters.behind(4)), (4, 4));
        assert_eq!((leaves.behind(8), leaves.behind(0), leaves.behind(12)), (0, 0, 4));
    }
}
