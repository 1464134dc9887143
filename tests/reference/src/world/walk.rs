//! A ray's way through the leaves and objects of a world: where the Boolean function of an object changes.
//!
//! Every leaf is inside or outside at each point of the way. A crossing that enters sets its state, one
//! that leaves clears it, one that changes nothing is none. So the surface that a ray leaves, which it
//! crosses once more at a `t` near 0, needs no exception and no least distance. Crossings of one object whose
//! `t` differ by no more than [`TOGETHER`] take effect together; of several objects that change at the same
//! `t` each is met in turn, in the order of naming, the later ones by the ray that goes on from there.
//!
//! An open leaf has no inside of its own to begin with. On which side of it a ray starts is what its first
//! crossing says; only the leaf that the ray leaves keeps the state that the ray carries.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Leaves and objects, Crossings, Hit; course
//! unit V, section 5.10.3.

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::compound::Program;
use crate::world::placing::Placing;
use crate::world::shape::{Cone, Crossing, Part, Shape};
use core::ops::Range;

/// Crossings this near in `t` are at the same place.
pub const TOGETHER: f64 = 1e-6;
/// What is farther away is not seen.
pub const FARTHEST: f64 = 128.0;
/// What is farther from the origin along an axis is not seen.
pub const OUTERMOST: f64 = 64.0;

/// A shape in its place.
#[derive(Debug)]
pub struct Leaf {
    /// The shape.
    pub shape: Box<dyn Shape>,
    /// Where it stands.
    pub placing: Placing,
    /// The material of each face, as a number in the world's list; the last is also that of all further
    /// faces. Empty: the material of its object.
    pub materials: Vec<usize>,
}

/// A Boolean function of leaves, none of which belongs to another object.
#[derive(Debug)]
pub struct Object {
    /// The function.
    pub program: Program,
    /// Its material, as a number in the world's list: what it is filled with, and the surface of those of its
    /// leaves that name none.
    pub material: usize,
}

/// What a ray brings along.
#[derive(Debug, Clone)]
pub(crate) struct Start {
    pub(crate) ray: Ray,
    pub(crate) cone: Cone,
    /// The state of every leaf.
    pub(crate) states: Vec<bool>,
    /// The leaf that the ray leaves.
    pub(crate) departed: Option<usize>,
}

/// A change of an object.
#[derive(Debug, Clone)]
pub(crate) struct Change {
    pub(crate) t: f64,
    pub(crate) object: usize,
    /// The leaf whose crossing changed it.
    pub(crate) leaf: usize,
    pub(crate) part: Part,
    /// The states of all leaves before it.
    pub(crate) before: Vec<bool>,
}

/// The way of a ray.
#[derive(Debug)]
pub(crate) struct Walk<'a> {
    objects: &'a [Object],
    /// The crossings of each object that are still ahead, the nearest last.
    ahead: Vec<Vec<(usize, Crossing)>>,
    /// The states behind the last change.
    pub(crate) states: Vec<bool>,
}

impl<'a> Walk<'a> {
    /// The way from `start` up to `t = end`.
    pub(crate) fn new(leaves: &[Leaf], objects: &'a [Object], start: &Start, end: f64) -> Self {
        let mut states = start.states.clone();
        let mut ahead = Vec::with_capacity(objects.len());
        for object in objects {
            let mut crossings = Vec::new();
            for index in object.program.leaves() {
                let leaf = &leaves[index];
                let all = leaf_crossings(leaf, &start.ray, start.cone);
                let counted = all.into_iter().filter(|c| counts(&start.ray, c, -TOGETHER..end));
                let first = crossings.len();
                crossings.extend(counted.map(|crossing| (index, crossing)));
                if leaf.shape.is_open() && start.departed != Some(index) {
                    // By growing t, as the shape gives them.
                    let side = crossings.get(first).map(|(_, crossing)| !crossing.enters);
                    states[index] = side.unwrap_or(states[index]);
                }
            }
            crossings.sort_by(|a, b| b.1.t.total_cmp(&a.1.t));
            ahead.push(crossings);
        }
        Walk { objects, ahead, states }
    }

    /// The next change of any object.
    pub(crate) fn next(&mut self) -> Option<Change> {
        loop {
            let next = |object: &Vec<(usize, Crossing)>| object.last().map(|(_, crossing)| crossing.t);
            let nearest = self.ahead.iter().filter_map(next).reduce(f64::min)?;
            let meets =
                |object: &Vec<(usize, Crossing)>| next(object).is_some_and(|t| t <= nearest + TOGETHER);
            let object = self.ahead.iter().position(meets)?;
            if let Some(change) = self.together(object) {
                return Some(change);
            }
        }
    }

    /// Takes the next crossings of an object that are at the same `t`.
    fn together(&mut self, object: usize) -> Option<Change> {
        let ahead = &mut self.ahead[object];
        let limit = ahead.last()?.1.t + TOGETHER;
        let program = &self.objects[object].program;
        let before = self.states.clone();
        let mut taken = Vec::new();
        while let Some((leaf, crossing)) = ahead.pop_if(|(_, crossing)| crossing.t <= limit) {
            self.states[leaf] = crossing.enters;
            taken.push((leaf, crossing));
        }
        if program.inside(&before) == program.inside(&self.states) {
            return None;
        }
        // The last leaf that is in another state now, in the order of the program.
        let leaf = program.leaves().filter(|&leaf| before[leaf] != self.states[leaf]).last()?;
        let (_, crossing) = taken.into_iter().rev().find(|taken| taken.0 == leaf)?;
        Some(Change { t: crossing.t, object, leaf, part: crossing.part, before })
    }
}

/// Whether a crossing counts: it has a `t` in the given range and lies in the world.
pub(crate) fn counts(ray: &Ray, crossing: &Crossing, range: Range<f64>) -> bool {
    range.contains(&crossing.t) && ray.at(crossing.t).iter().all(|c| c.abs() <= OUTERMOST)
}

/// The crossings of a leaf in its place. Widths are compared in the world: by how long the map makes 1 along
/// x or along y, whichever is longer.
pub(crate) fn leaf_crossings(leaf: &Leaf, ray: &Ray, cone: Cone) -> Vec<Crossing> {
    let length = |axis: Vector| libm::sqrt(leaf.placing.tangent(axis).iter().map(|c| c * c).sum());
    let scale = length([1.0, 0.0, 0.0]).max(length([0.0, 1.0, 0.0]));
    let cone = Cone { width: cone.width / scale, growth: cone.growth / scale };
    leaf.shape.crossings(&leaf.placing.generic_ray(ray), cone)
}
