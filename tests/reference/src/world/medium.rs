//! What fills the space at a point: which of the transparent objects that a ray is in counts.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Media; course unit V, section 5.9.1.

use crate::world::material::Material;
use crate::world::walk::Object;

/// Whether transparent objects of equal priority may interpenetrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Policy {
    /// A ray that finds two of them at one point is an error.
    Refuse,
    /// The last named counts.
    Priority,
}

/// Two transparent objects of equal priority at one point, by their numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Interpenetration(pub usize, pub usize);

/// The object that is the medium where the leaves have the given states: of those inside, the one of the
/// highest priority, of equal ones the last; and the one before it, if that has the same priority.
pub(crate) fn medium(
    objects: &[Object],
    materials: &[Material],
    states: &[bool],
) -> (Option<usize>, Option<usize>) {
    let priority = |object: usize| materials[objects[object].material].priority;
    let (mut best, mut equal) = (None, None);
    for (number, object) in objects.iter().enumerate() {
        if materials[object.material].index.is_none() || !object.program.inside(states) {
            continue;
        }
        match best {
            Some(other) if priority(number) < priority(other) => {}
            Some(other) if priority(number) == priority(other) => (best, equal) = (Some(number), Some(other)),
            _ => (best, equal) = (Some(number), None),
        }
    }
    (best, equal)
}

/// The index of refraction of a medium; that of air is 1.
pub(crate) fn index(objects: &[Object], materials: &[Material], medium: Option<usize>) -> f64 {
    medium.and_then(|object| materials[objects[object].material].index).unwrap_or(1.0)
}
