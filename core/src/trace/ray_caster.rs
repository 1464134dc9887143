//! The picture of a height field as a field of tones, row by row.
//!
//! The direction of a row's rays is carried along the row by addition, with 32 bits more than a ray uses.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::Camera;
use super::environment::Environment;
use super::halves::Cone;
use super::height_field::HeightField;
use super::material::{Answer, Light, Material};
use super::outline::Outline;
use super::ray::{Footprint, Ray};
use super::sampling::{Filter, Pattern, Sampling};
use super::statistics::{Statistics, Uncounted};
use crate::Error;
use crate::num::{Unit, Vec3, Wide, nth, unit};
use crate::plane::{Field, Tone, along, checked_size};

/// Half a unit of a ray's direction, 60 fractional bits.
const HALF: i64 = 1 << 31;

/// A height field seen by a camera: a [`Field`] of [`Tone`]s.
///
/// ```
/// use attractor::fif::{Cell, Fif, Knot, Pyramid};
/// use attractor::num::{Real, Scaling, Vec3, Wide};
/// use attractor::plane::Field;
/// use attractor::trace::{Camera, HeightField, Material, RayCaster};
/// use embedded_graphics_core::geometry::Size;
///
/// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let slope = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.5); 2])?;
/// let f = slope.integral::<2>(Wide::ZERO)?;
/// let mut memory = [Cell::ZERO; Pyramid::cells(2, 6)];
/// let pyramid = Pyramid::new(&f, 6, &mut memory)?;
/// let surface = HeightField::new(&pyramid, &pyramid)?;
/// let at = |x: f32, y: f32, z: f32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
/// let camera = Camera::new(at(-3.0, -2.0, 5.0), at(1.0, 1.0, 1.0), at(0.0, 0.0, 1.0), Real::from_num(40))?;
/// let picture = RayCaster::new(surface, camera, Size::new(64, 64))?.with_material(Material::Mirror)?;
/// assert_eq!(picture.row(32, 0..64).count(), 64);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct RayCaster<'a> {
    surface: HeightField<'a>,
    camera: Camera,
    size: Size,
    material: Material,
    light: Light,
    environment: Environment,
    pattern: Pattern,
    /// Direction through the centre of the top left pixel, and half a unit of what a ray uses; steps to the right and downwards: 60 fractional bits.
    corner: [i64; 3],
    right: [i64; 3],
    down: [i64; 3],
    /// Width of a sample's cone a unit of `t`.
    footprint: Footprint,
    /// The same for one sample.
    cone: Cone,
    outline: Outline,
}

impl<'a> RayCaster<'a> {
    /// A picture of `size` pixels with one sample each, diffuse, lit from the upper left front, under [`Environment::SKY`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size of 0 or above [`crate::plane::MAX_SIDE`], or where the view is so wide that a ray's direction leaves ±4.
    pub fn new(surface: HeightField<'a>, camera: Camera, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let (cols, rows) = (i64::from(size.width), i64::from(size.height));
        in_reach(&camera, cols, rows, 0)?;
        // one pixel: 2 k / rows, with 28 + 30 + 2 = 60 fractional bits for a direction cosine of 30
        let step =
            |cosine: Unit| nth((i64::from(camera.tangent) * i64::from(cosine.to_bits())) << 3, size.height);
        let components = |v: Vec3<Unit>| [v.x, v.y, v.z];
        let right = components(camera.right).map(step);
        let down = components(camera.up).map(|c| -step(c));
        let mut corner = components(camera.forward).map(|c| (i64::from(c.to_bits()) << 30) + HALF);
        for ((c, r), d) in corner.iter_mut().zip(right).zip(down) {
            *c -= (r * (cols - 1) + d * (rows - 1)) / 2;
        }
        // 2 k / rows with 30 fractional bits
        let footprint = nth(i64::from(camera.tangent) << 3, size.height).min(i64::from(i32::MAX));
        let footprint = Footprint::new(Unit::from_bits(footprint as i32));
        Ok(Self {
            surface,
            camera,
            size,
            material: Material::DIFFUSE,
            light: Light::ORDINARY,
            environment: Environment::SKY,
            pattern: Pattern::CENTRE,
            corner,
            right,
            down,
            footprint,
            cone: surface.cone(footprint),
            outline: Outline::new(surface.extent(), &camera, size.width, size.height),
        })
    }

    /// With this material.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a part outside `[0, 1]`.
    pub fn with_material(mut self, material: Material) -> Result<Self, Error> {
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
    /// [`Error::OutOfRange`] for more than 8 samples a side, or none, or a filter outside its ranges, or so wide that a ray's direction leaves ±4
    /// (pictures of a few pixels).
    pub fn with_sampling(mut self, sampling: Sampling, filter: Filter) -> Result<Self, Error> {
        self.pattern = Pattern::new(sampling, filter)?;
        let (cols, rows) = (i64::from(self.size.width), i64::from(self.size.height));
        in_reach(&self.camera, cols, rows, filter.margin())?;
        self.cone = self.surface.cone(self.footprint.part(self.pattern.parts_a_side()));
        Ok(self)
    }

    /// What the intersections of a whole picture cost: casts all its rays.
    pub fn statistics(&self) -> Statistics {
        let mut statistics = Statistics::default();
        for y in 0..self.size.height {
            for x in 0..self.size.width {
                for (dx, dy, _) in self.pattern.samples(x, y) {
                    let direction = self.offset(self.direction(x, y), dx, dy);
                    let ray = Ray::from_bits(self.eye(), direction);
                    let _ =
                        self.surface.intersect_counted(&ray, self.cone.footprint.per_t(), &mut statistics);
                }
            }
        }
        statistics
    }

    /// The leaf that the ray through the centre of a pixel meets; none outside the picture.
    pub fn hit(&self, x: u32, y: u32) -> Option<super::Hit> {
        if x >= self.size.width || y >= self.size.height {
            return None;
        }
        let ray = Ray::from_bits(self.eye(), self.direction(x, y).map(narrow));
        self.surface.intersect(&ray, self.cone.footprint.per_t())
    }

    fn eye(&self) -> [i32; 3] {
        [self.camera.eye.x, self.camera.eye.y, self.camera.eye.z].map(|c| c.to_bits())
    }

    /// The direction through the centre of pixel `(x, y)`, 60 fractional bits.
    fn direction(&self, x: u32, y: u32) -> [i64; 3] {
        let mut direction = self.corner;
        for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
            *c += r * i64::from(x) + d * i64::from(y);
        }
        direction
    }

    /// The direction moved by an offset in pixels (24 fractional bits), 28 fractional bits.
    #[inline]
    fn offset(&self, mut direction: [i64; 3], dx: i32, dy: i32) -> [i32; 3] {
        if (dx, dy) != (0, 0) {
            for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
                // a step has at most 62 bits, an offset is at most 2 pixels
                *c = c.wrapping_add((r >> 24) * i64::from(dx)).wrapping_add((d >> 24) * i64::from(dy));
            }
        }
        direction.map(narrow)
    }

    /// The tone of one ray.
    #[inline]
    fn tone(&self, direction: [i32; 3], visible: bool) -> Unit {
        let leaf = if visible {
            self.surface.leaf(&Ray::from_bits(self.eye(), direction), &self.cone, &mut Uncounted)
        } else {
            None
        };
        let towards = match leaf {
            None => direction,
            Some(leaf) => {
                match self.material.answer(unit(self.surface.normal(&leaf)), direction, &self.light) {
                    Answer::Tone(tone) => return tone,
                    Answer::Towards(mirrored) => mirrored,
                }
            }
        };
        self.environment.towards(towards)
    }

    #[inline]
    fn pixel(&self, x: u32, y: u32, direction: [i64; 3], visible: bool) -> Tone {
        let tone = if self.pattern.is_centre() {
            self.tone(direction.map(narrow), visible).to_bits() as u32
        } else {
            let mut sum = 0_i64;
            for (dx, dy, weight) in self.pattern.samples(x, y) {
                sum += i64::from(self.tone(self.offset(direction, dx, dy), visible).to_bits())
                    * i64::from(weight);
            }
            (sum >> 30).clamp(0, 1 << 30) as u32
        };
        // times 65535 / 2^30, rounded
        Tone::from_bits(((tone - (tone >> 16) + (1 << 13)) >> 14) as u16)
    }
}

/// Checks that directions stay inside ±4 on a picture with `margin` pixels around it: `|w| + k (cols / rows |r| + |u|) < 4`.
fn in_reach(camera: &Camera, cols: i64, rows: i64, margin: i64) -> Result<(), Error> {
    let sides = cols + rows + 4 * margin;
    let reach = (i64::from(camera.tangent) * sides).checked_div(rows).unwrap_or(i64::MAX);
    if reach >= 3 << 28 {
        return Err(Error::OutOfRange {
            what: "tangent of half the view, width plus height",
            index: None,
            value: Wide::from_bits(reach.saturating_mul(1 << 20)),
            min: Wide::ZERO,
            max: Wide::from_num(3),
        });
    }
    Ok(())
}

#[inline]
fn narrow(direction: i64) -> i32 {
    (direction >> 32) as i32
}

impl Field for RayCaster<'_> {
    type Value = Tone;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Tone {
        let visible = self.outline.columns(y, self.size.width).contains(&x);
        self.pixel(x, y, self.direction(x, y), visible)
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Tone> {
        // what lies outside the picture has no pixels
        let (y, width) = (y.min(self.size.height.saturating_sub(1)), self.size.width);
        let x = x.start.min(width)..x.end.min(width);
        let visible = self.outline.columns(y, width);
        let directions = Directions { caster: self, direction: self.direction(x.start, y), columns: x };
        along(directions, move |(x, direction)| self.pixel(x, y, direction, visible.contains(&x)))
    }
}

/// The columns of a row, each with the direction through the centre of its pixel.
struct Directions<'a, 'b> {
    caster: &'b RayCaster<'a>,
    columns: Range<u32>,
    direction: [i64; 3],
}

impl Iterator for Directions<'_, '_> {
    type Item = (u32, [i64; 3]);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let pixel = (self.columns.next()?, self.direction);
        for (c, r) in self.direction.iter_mut().zip(self.caster.right) {
            *c += r;
        }
        Some(pixel)
    }

    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        let skipped = n.min(self.columns.len()) as u32;
        self.columns.start += skipped;
        for (c, r) in self.direction.iter_mut().zip(self.caster.right) {
            *c += r * i64::from(skipped);
        }
        self.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.columns.size_hint()
    }
}

impl ExactSizeIterator for Directions<'_, '_> {}
impl FusedIterator for Directions<'_, '_> {}
