//! The picture of a surface by control points as a field of tones, row by row: a height field that need not
//! be a product, seen as [`RayCaster`](super::RayCaster) sees one that is.
//!
//! The surface lies over the unit square, its heights as they are. What a pixel shows is what
//! CONTRIBUTING.md says of the picture of a height field, with the parts of a [`PatchSurface`] for cells.

use core::ops::ControlFlow;

use embedded_graphics_core::geometry::Size;

use super::camera::Camera;
use super::environment::Environment;
use super::finish::{Finish, Highlight, Light, Shade};
use super::patch_surface::{PatchSurface, Struck};
use super::ray::Ray;
use super::ray_caster::rounded;
use super::sampling::{Filter, Pattern, Sampling};
use super::screen::Screen;
use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Unit, unit};
use crate::patch::Scheme;
use crate::plane::{Field, Tone, checked_size};

/// A surface by control points seen by a camera: a [`Field`] of [`Tone`]s.
#[derive(Debug, Clone)]
pub struct PatchCaster<'a, S, const J: usize> {
    pub(super) surface: PatchSurface<'a, S, J>,
    camera: Camera,
    size: Size,
    pub(super) screen: Screen,
    pub(super) material: Finish,
    highlight: Highlight,
    pub(super) light: Light,
    pub(super) environment: Environment,
    pattern: Pattern,
    /// How wide a sample's cone is at 1.
    cone: Unit,
}

impl<'a, S: Scheme<J>, const J: usize> PatchCaster<'a, S, J> {
    /// A picture of `size` pixels with one sample each, diffuse, lit from the upper left front, under
    /// [`Environment::SKY`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size of 0 or above [`crate::plane::MAX_SIDE`], or where the view is so
    /// wide that a ray's direction leaves ±4.
    pub fn new(surface: PatchSurface<'a, S, J>, camera: Camera, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let screen = Screen::new(&camera, size, 0)?;
        Ok(Self {
            surface,
            camera,
            size,
            cone: screen.footprint,
            screen,
            material: Finish::DIFFUSE,
            highlight: Finish::DIFFUSE.highlight(),
            light: Light::ORDINARY,
            environment: Environment::SKY,
            pattern: Pattern::CENTRE,
        })
    }

    /// With this material.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a part outside `[0, 1]`, or a roughness outside 1/32 to 1.
    #[inline(always)]
    pub fn with_finish(mut self, material: Finish) -> Result<Self, Error> {
        // of the finish as it is given: of a constant one the compiler knows which it is
        self.highlight = material.highlight();
        self.material = material.checked()?;
        Ok(self)
    }

    /// With this light.
    #[must_use]
    pub fn with_light(mut self, light: Light) -> Self {
        self.light = light;
        self
    }

    /// With these surroundings.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a tone outside `[0, 1]`, a scale or a fade outside their ranges.
    pub fn with_environment(mut self, environment: Environment) -> Result<Self, Error> {
        self.environment = environment.checked()?;
        Ok(self)
    }

    /// With these samples a pixel.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more than 8 samples a side, or none, or a filter outside its ranges, or so
    /// wide that a ray's direction leaves ±4 (pictures of a few pixels).
    pub fn with_sampling(mut self, sampling: Sampling, filter: Filter) -> Result<Self, Error> {
        self.pattern = Pattern::new(sampling, filter)?;
        self.screen = Screen::new(&self.camera, self.size, filter.margin())?;
        let cone = self.screen.footprint.to_bits().checked_div(self.pattern.parts_a_side() as i32);
        self.cone = Unit::from_bits(cone.unwrap_or(1).max(1));
        Ok(self)
    }

    /// Where the eye is, 24 fractional bits.
    pub(super) fn eye(&self) -> [Q24; 3] {
        [self.camera.eye.x, self.camera.eye.y, self.camera.eye.z].map(|c| c.to_bits())
    }

    /// The leaf that a ray meets first, of a cone that is so wide at 1.
    pub(super) fn first_hit(&self, direction: [Q28; 3], cone: Unit) -> Option<Struck<J>> {
        let mut found = None;
        self.surface.strike(&Ray::from_bits(self.eye(), direction), cone, &mut |struck| {
            found = Some(struck);
            ControlFlow::Break(())
        });
        found
    }

    /// The tone of a ray.
    #[inline(never)]
    fn tone(&self, direction: [Q28; 3]) -> Unit {
        let Some(hit) = self.first_hit(direction, self.cone) else {
            return self.environment.towards(direction);
        };
        match self.material.shade(
            unit(self.surface.normal(hit.level, &hit.heights)),
            direction,
            &self.light,
            self.highlight,
        ) {
            Shade::Tone(tone) => tone,
            Shade::Reflection(mirrored) => self.environment.towards(mirrored),
        }
    }

    /// The weighted mean of the tones of a pixel's samples.
    pub(super) fn samples(&self, x: u32, y: u32) -> Unit {
        self.mean(x, y, |direction| self.tone(direction))
    }

    /// The same of the surroundings alone.
    pub(super) fn surroundings(&self, x: u32, y: u32) -> Unit {
        self.mean(x, y, |direction| self.environment.towards(direction))
    }

    fn mean(&self, x: u32, y: u32, tone: impl Fn([Q28; 3]) -> Unit) -> Unit {
        let (direction, mut sum) = (self.screen.direction(x, y), 0_i64);
        for (dx, dy, weight) in self.pattern.samples(x, y) {
            let tone = tone(self.screen.offset(direction, dx, dy));
            sum = sum.wrapping_add(i64::from(tone.to_bits()) * i64::from(weight));
        }
        Unit::from_bits((sum >> 30).clamp(0, 1 << 30) as i32)
    }
}

impl<S: Scheme<J>, const J: usize> Field for PatchCaster<'_, S, J> {
    type Value = Tone;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Tone {
        rounded(self.samples(x, y).to_bits().unsigned_abs())
    }
}
