//! A world: leaves, objects made of them, materials and lamps; and which media there are at a place.

use super::super::material::{Material, Medium};
use super::super::surface::Surface;
use super::lamp::Lamp;
use super::object::{LEAVES, Object};
use super::states::{States, bit};
use crate::Error;
use crate::num::{Rgb, Vec3, Wide};

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
/// the origin along an axis is not seen. A world whose type says that it has no `COMPOUNDS` takes no code for
/// them.
#[derive(Debug, Clone, Copy)]
pub struct World<'a, L, M, const COMPOUNDS: bool = true> {
    leaves: &'a [Leaf<'a, L>],
    pub(super) objects: &'a [Object<'a>],
    materials: &'a [M],
    pub(super) lamps: &'a [Lamp],
    /// The transparent objects, a bit each, and their leaves.
    media: u64,
    clear: u64,
    /// The other objects that have a face which lets light pass.
    panes: u64,
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
        Self::checked(leaves, objects, materials)
    }
}

impl<'a, L: Surface, M: Material> World<'a, L, M, false> {
    /// A world without lamps whose objects have a leaf each.
    ///
    /// # Errors
    /// As [`World::new`], and [`Error::Unsupported`] for a compound.
    pub fn of_leaves(
        leaves: &'a [Leaf<'a, L>],
        objects: &'a [Object<'a>],
        materials: &'a [M],
    ) -> Result<Self, Error> {
        if objects.iter().any(|object| object.only().is_none()) {
            return Err(Error::Unsupported {
                what: "compound in a world of leaves",
                allowed: "objects of one leaf",
            });
        }
        Self::checked(leaves, objects, materials)
    }
}

impl<'a, L: Surface, M: Material, const COMPOUNDS: bool> World<'a, L, M, COMPOUNDS> {
    fn checked(
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
            let bit = bit(leaf);
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
        let mut world = Self { leaves, objects, materials, lamps: &[], media: 0, clear: 0, panes: 0 };
        // an object has a leaf of its own, of 64
        for (number, object) in (0..).zip(objects).filter(|_| M::MAY_BE_CLEAR) {
            if world.medium(number).is_some() {
                world.media |= bit(number);
                world.clear = object.leaves().fold(world.clear, |all, leaf| all | bit(leaf));
            } else if object.leaves().any(|leaf| world.lets_pass(leaf)) {
                world.panes |= bit(number);
            }
        }
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

    /// Whether light goes through any face of a leaf.
    fn lets_pass(&self, leaf: u8) -> bool {
        let numbers = self.leaf(leaf).map_or([].as_slice(), |leaf| leaf.materials);
        let mut materials = numbers.iter().filter_map(|number| self.materials.get(usize::from(*number)));
        materials.any(|material| material.passes() != Rgb::BLACK)
    }

    /// What is inside an object: the medium of the first material of its first leaf.
    fn medium(&self, object: u8) -> Option<Medium> {
        let leaf = self.leaf(self.objects.get(usize::from(object))?.leaves().next()?)?;
        self.material(leaf, 0)?.medium()
    }

    /// The states of all leaves at a place: what of closed leaves it is inside.
    pub(super) fn states(&self, place: Vec3) -> States {
        States { inside: self.refreshed(0, u64::MAX, place), unknown: 0 }
    }

    /// `states` with those of the leaves in `which` as the inside-outside functions have it.
    fn refreshed(&self, mut states: u64, which: u64, place: Vec3) -> u64 {
        for (number, leaf) in self.leaves.iter().enumerate() {
            let bit = bit(number as u8);
            if which & bit > 0 && leaf.surface.is_closed() {
                let inside = leaf.surface.extent().holds(place) && leaf.surface.value(place) <= Wide::ZERO;
                states = if inside { states | bit } else { states & !bit };
            }
        }
        states
    }

    /// Whether a place with these states is inside any leaf of a transparent object: elsewhere is no medium.
    #[inline(always)]
    pub(super) fn is_clear(&self, states: u64) -> bool {
        M::MAY_BE_CLEAR && states & self.clear != 0
    }

    /// The medium at a place with these states, and whether another object of the same priority shares it.
    #[inline(always)]
    pub(super) fn within(&self, states: u64) -> (Within, Option<u8>) {
        if self.is_clear(states) { self.medium_of(states) } else { (None, None) }
    }

    #[inline(never)]
    fn medium_of(&self, states: u64) -> (Within, Option<u8>) {
        let (mut within, mut shared): (Within, _) = (None, None);
        let mut rest = self.media();
        while rest != 0 {
            let number = rest.trailing_zeros() as u8;
            rest &= rest.wrapping_sub(1);
            let Some(object) = self.objects.get(usize::from(number)) else { break };
            if !object.is_inside(states) {
                continue;
            }
            let Some(medium) = self.medium(number) else { continue };
            match within {
                Some((_, top)) if top.priority > medium.priority => {}
                Some((other, top)) => {
                    shared = if top.priority == medium.priority { Some(other) } else { None };
                    within = Some((number, medium));
                }
                None => within = Some((number, medium)),
            }
        }
        (within, shared)
    }

    /// The transparent objects, a bit each.
    #[inline(always)]
    pub(super) fn media(&self) -> u64 {
        if M::MAY_BE_CLEAR { self.media } else { 0 }
    }

    /// The objects without a medium that have a face which lets light pass, a bit each.
    #[inline(always)]
    pub(super) fn panes(&self) -> u64 {
        if M::MAY_BE_CLEAR { self.panes } else { 0 }
    }

    /// States of a place that are all known where there are media, as these depend on all. Others are looked
    /// up when a ray needs them.
    #[inline]
    pub(super) fn states_at(&self, inside: u64, unknown: u64, place: Vec3) -> States {
        let states = States { inside, unknown };
        if self.media() != 0 && unknown != 0 { self.known(states, unknown, place) } else { states }
    }

    /// States with those of the leaves in `which` looked up.
    #[cold]
    #[inline(never)]
    pub(super) fn known(&self, states: States, which: u64, place: Vec3) -> States {
        let which = which & states.unknown;
        States { inside: self.refreshed(states.inside, which, place), unknown: states.unknown & !which }
    }
}
