//! A world, and the light that a ray brings from it.
//!
//! `I = I_amb + I_diff + I_spec + I_refl + I_tran`: the last two are the same sum again, for the mirrored and
//! the refracted ray.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined"; course unit V, section 5.9.

use crate::camera::{Camera, Ray};
use crate::vector::{Vector, along, dot, normalised};
use crate::world::light::{Colour, Light};
use crate::world::material::Material;
use crate::world::medium::{Interpenetration, Policy, index, medium};
use crate::world::pattern::Point;
use crate::world::refraction::{mirrored, reflectance, refracted};
use crate::world::shape::{Cone, Crossing, Part};
use crate::world::surroundings::Surroundings;
use crate::world::walk::{Change, FARTHEST, Leaf, Object, Start, TOGETHER, Walk, counts, leaf_crossings};

/// A ray of less weight is not cast.
const LIGHTEST: f64 = 1.0 / 256.0;

/// A world, and from where it is seen.
#[derive(Debug)]
pub struct World {
    /// The shapes.
    pub leaves: Vec<Leaf>,
    /// What they make up.
    pub objects: Vec<Object>,
    /// What that is made of.
    pub materials: Vec<Material>,
    /// The lights.
    pub lights: Vec<Light>,
    /// What is around it.
    pub surroundings: Surroundings,
    /// The point of view.
    pub camera: Camera,
    /// The highest level of a ray that is cast; 0: the camera's rays alone.
    pub depth: usize,
    /// Whether transparent objects may interpenetrate.
    pub policy: Policy,
    /// N where a picture takes N x N samples a pixel: divides the footprint.
    pub samples_per_axis: usize,
}

/// A ray on its way.
struct Path {
    start: Start,
    level: usize,
    /// How much of its light reaches the eye.
    weight: Colour,
}

/// A seen change, and the media before and behind it.
type Seen = (Change, [Option<usize>; 2]);

impl World {
    /// The linear light of a pixel (column, row): for each of `samples`, `(dx, dy, weight)` with the offset
    /// in pixels from the pixel's centre, weight times its light, cut off at 1.
    ///
    /// # Errors
    /// When a ray finds that transparent objects interpenetrate, and they may not.
    pub fn pixel(
        &self,
        cols: usize,
        rows: usize,
        pixel: (usize, usize),
        samples: &[(f64, f64, f64)],
    ) -> Result<Colour, Interpenetration> {
        let growth = self.camera.footprint(rows, self.samples_per_axis);
        let mut sum = [0.0; 3];
        for &(dx, dy, weight) in samples {
            let ray = self.camera.ray(cols, rows, pixel, (dx, dy));
            let light = self.light_along(&ray, growth)?;
            sum = along(sum, weight, light.map(|c| c.min(1.0)));
        }
        Ok(sum)
    }

    /// The pixels of a picture, row by row from the top.
    ///
    /// # Errors
    /// As of [`World::pixel`].
    ///
    /// # Panics
    /// When the weights do not add up to 1 within 1e-9.
    pub fn picture(
        &self,
        cols: usize,
        rows: usize,
        samples: &[(f64, f64, f64)],
    ) -> Result<Vec<Colour>, Interpenetration> {
        let total: f64 = samples.iter().map(|sample| sample.2).sum();
        assert!((total - 1.0).abs() < 1e-9, "the weights add up to {total}");
        let pixels = (0..rows).flat_map(|j| (0..cols).map(move |i| (i, j)));
        pixels.map(|pixel| self.pixel(cols, rows, pixel, samples)).collect()
    }

    /// The light that a ray of the camera brings, not cut off; its cone grows by `growth`.
    ///
    /// # Errors
    /// As of [`World::pixel`].
    pub fn light_along(&self, ray: &Ray, growth: f64) -> Result<Colour, Interpenetration> {
        let states = self.states_at(ray.origin);
        let start = Start { ray: *ray, cone: Cone { width: 0.0, growth }, states, departed: None };
        self.light(&Path { start, level: 0, weight: [1.0; 3] })
    }

    /// Whether a point is inside of each leaf; it is outside of all that are open.
    pub fn states_at(&self, p: Vector) -> Vec<bool> {
        let inside =
            |leaf: &Leaf| !leaf.shape.is_open() && leaf.shape.value(leaf.placing.generic_point(p)) < 0.0;
        self.leaves.iter().map(inside).collect()
    }

    /// Every crossing of every leaf along a ray that counts, by growing `t`: object, leaf and crossing.
    pub fn crossings(&self, ray: &Ray) -> Vec<(usize, usize, Crossing)> {
        let mut all = Vec::new();
        for (number, object) in self.objects.iter().enumerate() {
            for leaf in object.program.leaves() {
                let crossings = leaf_crossings(&self.leaves[leaf], ray, Cone::THIN).into_iter();
                let counted = crossings.filter(|crossing| counts(ray, crossing, 0.0..FARTHEST));
                all.extend(counted.map(|crossing| (number, leaf, crossing)));
            }
        }
        all.sort_by(|a, b| a.2.t.total_cmp(&b.2.t));
        all
    }

    /// The first change of an object along a ray from the eye, seen or not: object, leaf, part and `t`.
    pub fn first_change(&self, ray: &Ray) -> Option<(usize, usize, Part, f64)> {
        let states = self.states_at(ray.origin);
        let start = Start { ray: *ray, cone: Cone::THIN, states, departed: None };
        let change = Walk::new(&self.leaves, &self.objects, &start, FARTHEST).next()?;
        Some((change.object, change.leaf, change.part, change.t))
    }

    /// The point at `t` of a ray on a part of a leaf.
    pub fn point(&self, ray: &Ray, t: f64, leaf: usize, part: Part, width: f64) -> Point {
        let Leaf { shape, placing, .. } = &self.leaves[leaf];
        let generic = placing.generic_ray(ray).at(t);
        let frame = shape.frame(generic, part);
        let outward = normalised(placing.normal(frame.normal));
        let normal = if dot(outward, ray.direction) > 0.0 { outward.map(|c| -c) } else { outward };
        Point {
            position: ray.at(t),
            generic,
            uv: frame.uv,
            normal,
            p_u: placing.tangent(frame.p_u),
            p_v: placing.tangent(frame.p_v),
            leaf,
            part,
            width,
        }
    }

    /// Whether the normal of a point of a ray that goes along `d` is the outward one.
    fn is_outward(&self, point: &Point, d: Vector) -> bool {
        let leaf = &self.leaves[point.leaf];
        let normal = leaf.shape.frame(point.generic, point.part).normal;
        dot(leaf.placing.normal(normal), d) <= 0.0
    }

    /// The material of a face of a leaf.
    fn material(&self, object: usize, leaf: usize, part: Part) -> &Material {
        let faces = &self.leaves[leaf].materials;
        let number = faces.get(part.face()).or(faces.last()).copied();
        &self.materials[number.unwrap_or(self.objects[object].material)]
    }

    /// The next change that is seen: one of an opaque object, or behind which there is another medium.
    fn next_seen(&self, walk: &mut Walk<'_>, from: &mut f64) -> Result<Option<Seen>, Interpenetration> {
        while let Some(change) = walk.next() {
            let at = |states: &[bool]| medium(&self.objects, &self.materials, states);
            let (before, equal) = at(&change.before);
            self.refuse(change.t - *from, before, equal)?;
            *from = change.t;
            let behind = at(&walk.states).0;
            let transparent = self.materials[self.objects[change.object].material].index.is_some();
            if !transparent || before != behind {
                return Ok(Some((change, [before, behind])));
            }
        }
        let (best, equal) = medium(&self.objects, &self.materials, &walk.states);
        self.refuse(f64::INFINITY, best, equal)?;
        Ok(None)
    }

    /// Fails where two media of equal priority fill a piece of a ray that is longer than a point.
    fn refuse(&self, length: f64, a: Option<usize>, b: Option<usize>) -> Result<(), Interpenetration> {
        match (self.policy, a, b) {
            (Policy::Refuse, Some(a), Some(b)) if length > TOGETHER => Err(Interpenetration(b, a)),
            _ => Ok(()),
        }
    }

    /// The light that a ray brings.
    fn light(&self, path: &Path) -> Result<Colour, Interpenetration> {
        let mut walk = Walk::new(&self.leaves, &self.objects, &path.start, FARTHEST);
        match self.next_seen(&mut walk, &mut 0.0)? {
            Some(seen) => self.shaded(path, &seen, &walk.states),
            None => {
                Ok(self.surroundings.colour(normalised(path.start.ray.direction), path.start.cone.growth))
            }
        }
    }

    /// The light from a point that a ray has met.
    fn shaded(
        &self,
        path: &Path,
        (change, media): &Seen,
        behind: &[bool],
    ) -> Result<Colour, Interpenetration> {
        let Start { ray, cone, .. } = &path.start;
        let d = normalised(ray.direction);
        let point = self.point(ray, change.t, change.leaf, change.part, cone.at(change.t));
        let material = self.material(change.object, change.leaf, change.part);
        let pigment = material.pigment.at(&point);
        let surface = point.normal;
        let normal = match &material.bump {
            Some(bump) => point.bumped(bump.at(&point), self.is_outward(&point, d)),
            None => surface,
        };
        let frame = point.frame(normal, material.frame.as_ref().map_or(0.0, |frame| frame.at(&point)));
        let mut sum = pigment.map(|c| material.ambient * c);
        let v = d.map(|c| -c);
        let leave = |direction: Vector, states: &[bool]| Start {
            ray: Ray { origin: point.position, direction },
            cone: Cone { width: point.width, growth: cone.growth },
            states: states.to_vec(),
            departed: Some(change.leaf),
        };

        for light in &self.lights {
            let (l, distance) = light.seen_from(point.position);
            let lambert = dot(normal, l);
            if lambert <= 0.0 || dot(surface, l) <= 0.0 {
                continue;
            }
            let passed = self.passed(&leave(l, &change.before), distance.min(FARTHEST))?;
            let specular = material.specular.answer(frame, v, l);
            for k in 0..3 {
                let here = light.colour()[k] * passed[k];
                sum[k] += here * (material.diffuse * pigment[k] * lambert + specular[k]);
            }
        }

        let mut reflect = material.reflect;
        // A bump that the ray meets from behind mirrors and bends nothing.
        let met = if dot(normal, d) < 0.0 { normal } else { surface };
        if material.index.is_some() {
            let transmit = material.passes();
            let [index_before, index_behind] =
                media.map(|medium| index(&self.objects, &self.materials, medium));
            let eta = index_before / index_behind;
            // Neither does one that would bend the ray back to its side.
            let bent = refracted(d, met, eta);
            let back = bent.is_some_and(|t| dot(t, surface) >= 0.0);
            let facing = if back { surface } else { met };
            let bent = refracted(d, facing, eta);
            let share = match bent {
                None => 1.0,
                Some(t) if material.fresnel => reflectance(eta, -dot(d, facing), -dot(t, facing)),
                Some(_) => 0.0,
            };
            reflect = along(reflect, share, transmit);
            if let Some(t) = bent {
                let weight = transmit.map(|c| (1.0 - share) * c);
                sum = along(sum, 1.0, self.spawned(path, weight, leave(t, behind))?);
            }
        }
        let m = mirrored(d, met);
        let m = if dot(m, surface) < 0.0 { mirrored(m, surface) } else { m };
        Ok(along(sum, 1.0, self.spawned(path, reflect, leave(m, &change.before))?))
    }

    /// `weight` times the light of a ray that another one spawns.
    fn spawned(&self, parent: &Path, weight: Colour, start: Start) -> Result<Colour, Interpenetration> {
        if weight == [0.0; 3] {
            return Ok(weight);
        }
        let start = Start { ray: Ray { direction: normalised(start.ray.direction), ..start.ray }, ..start };
        let total = [0, 1, 2].map(|k| parent.weight[k] * weight[k]);
        let light = if parent.level >= self.depth || total.iter().all(|&c| c < LIGHTEST) {
            self.surroundings.colour(start.ray.direction, start.cone.growth)
        } else {
            self.light(&Path { start, level: parent.level + 1, weight: total })?
        };
        Ok([0, 1, 2].map(|k| weight[k] * light[k]))
    }

    /// How much of a light passes along a ray towards it.
    fn passed(&self, start: &Start, distance: f64) -> Result<Colour, Interpenetration> {
        let mut walk = Walk::new(&self.leaves, &self.objects, start, distance);
        let (mut passed, mut from) = ([1.0; 3], 0.0);
        while passed != [0.0; 3] {
            let Some((change, _)) = self.next_seen(&mut walk, &mut from)? else { break };
            let through = self.material(change.object, change.leaf, change.part).passes();
            passed = [0, 1, 2].map(|k| passed[k] * through[k]);
        }
        Ok(passed)
    }
}
