//! The picture of a world as a field of linear light, row by row.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::super::camera::Camera;
use super::super::environment::between;
use super::super::material::Material;
use super::super::ray::Ray;
use super::super::sampling::{Filter, Pattern, Sampling};
use super::super::screen::{Screen, narrow};
use super::super::surface::Surface;
use super::super::surroundings::Surroundings;
use super::bounce::Depth;
use super::scene::{Interpenetration, World};
use super::search::{NONE, Start};
use crate::Error;
use crate::num::{Lumen, Rgb, Unit, Wide};
use crate::plane::{Field, LinearRgb, along, checked_size};

/// The most lamps of a world.
const LAMPS: usize = 64;

/// A world seen by a camera: a [`Field`] of [`LinearRgb`].
///
/// `EVENTS` is how many crossings of a ray there is room for, `RAYS` how many rays may wait: two more than
/// the depth. Both are on the stack while a ray is followed: 16 bytes a crossing, about 80 a ray.
#[derive(Debug, Clone)]
pub struct WorldCaster<
    'a,
    L,
    M,
    S,
    const EVENTS: usize = 32,
    const RAYS: usize = 7,
    const COMPOUNDS: bool = true,
> {
    world: World<'a, L, M, COMPOUNDS>,
    surroundings: S,
    camera: Camera,
    size: Size,
    screen: Screen,
    pattern: Pattern,
    depth: Depth,
    /// What is known at the eye.
    start: Start,
}

impl<
    'a,
    L: Surface,
    M: Material,
    S: Surroundings,
    const EVENTS: usize,
    const RAYS: usize,
    const COMPOUNDS: bool,
> WorldCaster<'a, L, M, S, EVENTS, RAYS, COMPOUNDS>
{
    /// A picture of `size` pixels with one sample each, with as many bounces as there is room for.
    ///
    /// # Errors
    /// [`Error::Capacity`] if a ray may cross the world's leaves more often than `EVENTS` times, for less
    /// room than for two rays, or for more than 64 lamps, each of which a ray looks for at every hit;
    /// [`Error::OutOfRange`] for a size of 0 or above [`crate::plane::MAX_SIDE`], or where the view is so
    /// wide that a ray's direction leaves ±4.
    pub fn new(
        world: World<'a, L, M, COMPOUNDS>,
        surroundings: S,
        camera: Camera,
        size: Size,
    ) -> Result<Self, Error> {
        let needed = world.most_crossings();
        if needed as usize > EVENTS {
            return Err(Error::Capacity {
                what: "crossings of a ray with the world",
                needed: needed as usize,
                capacity: EVENTS,
            });
        }
        if RAYS < 2 {
            return Err(Error::Capacity { what: "rays at a time", needed: 2, capacity: RAYS });
        }
        let needed = world.lamps.len();
        if needed > LAMPS {
            return Err(Error::Capacity { what: "lamps of a world", needed, capacity: LAMPS });
        }
        let size = checked_size(size)?;
        let screen = Screen::new(&camera, size, 0)?;
        let states = world.states(camera.eye);
        let start = Start { cone: screen.footprint, states, departed: None, left: NONE };
        let depth = Depth(RAYS.saturating_sub(2).min(255) as u8);
        Ok(Self { world, surroundings, camera, size, screen, pattern: Pattern::CENTRE, depth, start })
    }

    /// With these samples a pixel.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 8 samples a side, or none, or a filter outside its ranges, or so
    /// wide that a ray's direction leaves ±4 (pictures of a few pixels).
    pub fn with_sampling(mut self, sampling: Sampling, filter: Filter) -> Result<Self, Error> {
        self.pattern = Pattern::new(sampling, filter)?;
        self.screen = Screen::new(&self.camera, self.size, filter.margin())?;
        let parts = self.pattern.parts_a_side();
        let bits = self.screen.footprint.to_bits().checked_div(parts as i32).unwrap_or(1);
        self.start.cone = Unit::from_bits(bits.max(1));
        Ok(self)
    }

    /// With rays that are mirrored or bent up to `depth` times: 0 shows no reflections but that of the
    /// surroundings.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a depth without room for its rays, above `RAYS - 2`.
    pub fn with_depth(mut self, depth: u8) -> Result<Self, Error> {
        let most = Wide::from_num(RAYS.saturating_sub(2).min(255) as u8);
        between("depth of bounces", None, Wide::from_num(depth), Wide::ZERO, most)?;
        self.depth = Depth(depth);
        Ok(self)
    }

    /// Two transparent objects of equal priority that a ray of the picture finds in one place, if any does:
    /// they should not interpenetrate, or have priorities. Casts all rays.
    pub fn interpenetration(&self) -> Option<Interpenetration> {
        let mut found = None;
        if let (Some((other, _)), Some(one)) = self.world.within(self.start.states.inside) {
            return Some(Interpenetration { objects: [one, other], place: self.camera.eye });
        }
        for y in 0..self.size.height {
            for x in 0..self.size.width {
                let direction = self.screen.direction(x, y);
                // what lies wholly inside another is not seen: it is looked for along the ray itself
                let overlap = self.world.overlap::<EVENTS>(&self.ray(direction.map(narrow)), &self.start);
                if overlap.is_some() {
                    return overlap;
                }
                self.pixel(x, y, direction, &mut |shared| {
                    found.get_or_insert(shared);
                });
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// The camera's ray in a direction, 28 fractional bits.
    #[inline]
    fn ray(&self, direction: [i32; 3]) -> Ray {
        let eye = [self.camera.eye.x, self.camera.eye.y, self.camera.eye.z].map(|c| c.to_bits());
        Ray::from_bits(eye, direction).paced()
    }

    /// The light of one ray, cut off at white.
    #[inline]
    fn sample(&self, direction: [i32; 3], shared: &mut impl FnMut(Interpenetration)) -> Rgb {
        let (ray, start) = (self.ray(direction), &self.start);
        let light = self.world.light::<EVENTS, RAYS>(ray, start, self.depth, &self.surroundings, shared);
        Rgb::new(light.r.min(Lumen::ONE), light.g.min(Lumen::ONE), light.b.min(Lumen::ONE))
    }

    #[inline]
    fn pixel(
        &self,
        x: u32,
        y: u32,
        direction: [i64; 3],
        shared: &mut impl FnMut(Interpenetration),
    ) -> LinearRgb {
        if self.pattern.is_centre() {
            return self.sample(direction.map(narrow), shared).into();
        }
        // 16 + 30 fractional bits: weights add up to 1
        let mut sum = [1_i64 << 29; 3];
        for (dx, dy, weight) in self.pattern.samples(x, y) {
            let light = self.sample(self.screen.offset(direction, dx, dy), shared);
            for (sum, part) in sum.iter_mut().zip([light.r, light.g, light.b]) {
                *sum += i64::from(part.to_bits()) * i64::from(weight);
            }
        }
        let [r, g, b] = sum.map(|sum| Lumen::from_bits((sum >> 30).clamp(0, 1 << 16) as u32));
        Rgb::new(r, g, b).into()
    }
}

impl<L: Surface, M: Material, S: Surroundings, const EVENTS: usize, const RAYS: usize, const COMPOUNDS: bool>
    Field for WorldCaster<'_, L, M, S, EVENTS, RAYS, COMPOUNDS>
{
    type Value = LinearRgb;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> LinearRgb {
        self.pixel(x, y, self.screen.direction(x, y), &mut |_| {})
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = LinearRgb> {
        // what lies outside the picture has no pixels
        let (y, width) = (y.min(self.size.height.saturating_sub(1)), self.size.width);
        let x = x.start.min(width)..x.end.min(width);
        let directions =
            Directions { screen: &self.screen, direction: self.screen.direction(x.start, y), columns: x };
        along(directions, move |(x, direction)| self.pixel(x, y, direction, &mut |_| {}))
    }
}

/// The columns of a row, each with the direction through the centre of its pixel.
struct Directions<'b> {
    screen: &'b Screen,
    columns: Range<u32>,
    direction: [i64; 3],
}

impl Iterator for Directions<'_> {
    type Item = (u32, [i64; 3]);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let pixel = (self.columns.next()?, self.direction);
        self.direction = self.screen.stepped(self.direction, 1);
        Some(pixel)
    }

    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        let skipped = n.min(self.columns.len()) as u32;
        self.columns.start += skipped;
        self.direction = self.screen.stepped(self.direction, skipped);
        self.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.columns.size_hint()
    }
}

impl ExactSizeIterator for Directions<'_> {}
impl FusedIterator for Directions<'_> {}
