//! The picture of a height field as a field of tones, row by row.
//!
//! The direction of a row's rays is carried along the row by addition, with 32 bits more than a ray uses.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::camera::Camera;
use super::environment::Environment;
use super::finish::{Finish, Highlight, Light, Shade};
use super::height_field::field::{HeightField, Hit};
use super::height_field::halves::Pencil;
use super::height_field::outline::Outline;
use super::height_field::statistics::{Statistics, Uncounted};
use super::ray::Footprint;
use super::sampling::{Filter, Pattern, Sampling};
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
/// use attractor::trace::{Camera, HeightField, Finish, RayCaster};
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
/// let picture = RayCaster::new(surface, camera, Size::new(64, 64))?.with_finish(Finish::Mirror)?;
/// assert_eq!(picture.row(32, 0..64).count(), 64);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct RayCaster<'a> {
    pub(super) surface: HeightField<'a>,
    /// Of half the view, 28 fractional bits.
    tangent: i32,
    pub(super) size: Size,
    pub(super) material: Finish,
    highlight: Highlight,
    pub(super) light: Light,
    pub(super) environment: Environment,
    pattern: Pattern,
    /// Direction through the centre of the top left pixel, and half a unit of what a ray uses; steps to the
    /// right and downwards: 60 fractional bits.
    corner: [i64; 3],
    pub(super) right: [i64; 3],
    pub(super) down: [i64; 3],
    /// Width of a pixel's cone a unit of `t`.
    pub(super) footprint: Footprint,
    /// The rays from the eye, as wide as a sample's cone.
    pub(super) rays: Pencil,
    pub(super) outline: Outline,
}

impl<'a> RayCaster<'a> {
    /// A picture of `size` pixels with one sample each, diffuse, lit from the upper left front, under
    /// [`Environment::SKY`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size of 0 or above [`crate::plane::MAX_SIDE`], or where the view is so
    /// wide that a ray's direction leaves ±4.
    pub fn new(surface: HeightField<'a>, camera: Camera, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let (cols, rows) = (i64::from(size.width), i64::from(size.height));
        in_reach(camera.tangent, cols, rows, 0)?;
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
        let eye = [camera.eye.x, camera.eye.y, camera.eye.z].map(|c| c.to_bits());
        Ok(Self {
            surface,
            tangent: camera.tangent,
            size,
            material: Finish::DIFFUSE,
            highlight: Finish::DIFFUSE.highlight(),
            light: Light::ORDINARY,
            environment: Environment::SKY,
            pattern: Pattern::CENTRE,
            corner,
            right,
            down,
            footprint,
            rays: surface.pencil(eye, footprint),
            outline: Outline::new(surface.extent(), &camera, size.width, size.height),
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
        let (cols, rows) = (i64::from(self.size.width), i64::from(self.size.height));
        in_reach(self.tangent, cols, rows, filter.margin())?;
        let footprint = self.footprint.part(self.pattern.parts_a_side());
        self.rays = self.surface.pencil(self.rays.origin, footprint);
        Ok(self)
    }

    /// What the intersections of a whole picture cost: casts all its rays.
    pub fn statistics(&self) -> Statistics {
        let mut statistics = Statistics::default();
        for y in 0..self.size.height {
            for x in 0..self.size.width {
                for (dx, dy, _) in self.pattern.samples(x, y) {
                    let direction = self.offset(self.direction(x, y), dx, dy);
                    let _ = self.surface.leaf(&self.rays, &direction, &mut statistics);
                }
            }
        }
        statistics
    }

    /// The leaf that the ray through the centre of a pixel meets; none outside the picture.
    pub fn hit(&self, x: u32, y: u32) -> Option<Hit> {
        if x >= self.size.width || y >= self.size.height {
            return None;
        }
        self.surface.first_hit(&self.rays, &self.direction(x, y).map(narrow), &mut Uncounted)
    }

    /// The direction through the centre of pixel `(x, y)`, 60 fractional bits.
    pub(super) fn direction(&self, x: u32, y: u32) -> [i64; 3] {
        let mut direction = self.corner;
        for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
            *c += r * i64::from(x) + d * i64::from(y);
        }
        direction
    }

    /// The directions through the centres of pixels of row `y`, carried along by addition.
    #[inline(always)]
    pub(super) fn directions(&self, columns: Range<u32>, y: u32) -> Directions<'a, '_> {
        Directions { caster: self, direction: self.direction(columns.start, y), columns }
    }

    /// The direction moved by an offset in pixels (24 fractional bits), 28 fractional bits.
    pub(super) fn offset(&self, mut direction: [i64; 3], dx: i32, dy: i32) -> [i32; 3] {
        if (dx, dy) != (0, 0) {
            for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
                // a step has at most 62 bits, an offset is at most 2 pixels
                *c = c.wrapping_add((r >> 24) * i64::from(dx)).wrapping_add((d >> 24) * i64::from(dy));
            }
        }
        direction.map(narrow)
    }

    /// The tone of a ray in the direction `(x, y, z)`, which are handed over in registers.
    #[inline(always)]
    fn tone(&self, [x, y, z]: [i32; 3], visible: bool) -> Unit {
        if visible { self.cast(x, y, z) } else { self.beyond(x, y, z) }
    }

    #[inline(never)]
    fn cast(&self, x: i32, y: i32, z: i32) -> Unit {
        let direction = [x, y, z];
        let [x, y, z] = match self.surface.leaf(&self.rays, &direction, &mut Uncounted) {
            None => direction,
            Some(leaf) => {
                match self.material.shade(
                    unit(self.surface.normal(&leaf)),
                    direction,
                    &self.light,
                    self.highlight,
                ) {
                    Shade::Tone(tone) => return tone,
                    Shade::Reflection(mirrored) => mirrored,
                }
            }
        };
        self.beyond(x, y, z)
    }

    /// The tone of the environment.
    #[inline(never)]
    fn beyond(&self, x: i32, y: i32, z: i32) -> Unit {
        self.environment.towards([x, y, z])
    }

    /// The tone of pixel `(x, y)`, by way of the direction through its centre.
    #[inline(always)]
    fn pixel(&self, x: u32, y: u32, direction: [i32; 3], visible: bool) -> Tone {
        let tone =
            if self.pattern.is_centre() { self.tone(direction, visible) } else { self.mean(x, y, visible) };
        rounded(tone.to_bits() as u32)
    }

    /// The tone of a pixel's samples, before it is rounded.
    #[inline(never)]
    pub(super) fn samples(&self, x: u32, y: u32) -> Unit {
        let direction = self.direction(x, y).map(narrow);
        if self.pattern.is_centre() { self.tone(direction, true) } else { self.mean(x, y, true) }
    }

    /// The tone of the environment through a pixel that shows nothing else: of its samples where it has
    /// edges.
    pub(super) fn surroundings(&self, x: u32, y: u32) -> Unit {
        if matches!(self.environment, Environment::Checkerboard { .. }) && !self.pattern.is_centre() {
            return self.mean(x, y, false);
        }
        let [x, y, z] = self.direction(x, y).map(narrow);
        self.beyond(x, y, z)
    }

    /// The weighted mean of the tones of a pixel's samples.
    #[inline(never)]
    fn mean(&self, x: u32, y: u32, visible: bool) -> Unit {
        let (direction, mut sum) = (self.direction(x, y), 0_i64);
        for (dx, dy, weight) in self.pattern.samples(x, y) {
            let tone = self.tone(self.offset(direction, dx, dy), visible);
            sum += i64::from(tone.to_bits()) * i64::from(weight);
        }
        Unit::from_bits((sum >> 30).clamp(0, 1 << 30) as i32)
    }
}

/// A tone with 30 fractional bits, at most 1, as a part of 65535: the nearest, or the other within `2^-14` of
/// a half.
#[inline(always)]
pub(super) fn rounded(tone: u32) -> Tone {
    // times 65535 / 2^30
    Tone::from_bits(((tone - (tone >> 16) + (1 << 13)) >> 14) as u16)
}

/// Checks that directions stay inside ±4 on a picture with `margin` pixels around it:
/// `|w| + k (cols / rows |r| + |u|) < 4`.
fn in_reach(tangent: i32, cols: i64, rows: i64, margin: i64) -> Result<(), Error> {
    let sides = cols + rows + 4 * margin;
    let reach = (i64::from(tangent) * sides).checked_div(rows).unwrap_or(i64::MAX);
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
pub(super) fn narrow(direction: i64) -> i32 {
    (direction >> 32) as i32
}

impl Field for RayCaster<'_> {
    type Value = Tone;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Tone {
        let visible = self.outline.columns(y, self.size.width).contains(&x);
        self.pixel(x, y, self.direction(x, y).map(narrow), visible)
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Tone> {
        // what lies outside the picture has no pixels
        let (y, width) = (y.min(self.size.height.saturating_sub(1)), self.size.width);
        let x = x.start.min(width)..x.end.min(width);
        let visible = self.outline.columns(y, width);
        let seen = visible.len() as u32;
        along(self.directions(x, y), move |(x, direction)| {
            self.pixel(x, y, direction, x.wrapping_sub(visible.start) < seen)
        })
    }
}

/// The columns of a row, each with the direction through the centre of its pixel.
pub(super) struct Directions<'a, 'b> {
    caster: &'b RayCaster<'a>,
    columns: Range<u32>,
    direction: [i64; 3],
}

impl Iterator for Directions<'_, '_> {
    type Item = (u32, [i32; 3]);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        let pixel = (self.columns.next()?, self.direction.map(narrow));
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

#[cfg(test)]
mod tests {
    use super::super::exact::with_polygon;
    use super::super::ray::Ray;
    use super::*;
    use crate::num::Real;
    use std::vec::Vec;

    fn camera(degrees: i32) -> Camera {
        let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        Camera::new(at(-3, -2, 5), at(1, 1, 1), at(0, 0, 1), Real::from_num(degrees)).unwrap()
    }

    fn with_surface<R>(then: impl FnOnce(HeightField<'_>) -> R) -> R {
        let tent = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| (Wide::from_num(x), Wide::from_num(y)));
        with_polygon(&tent, 4, |f| then(HeightField::new(f, f).unwrap()))
    }

    /// Against fractions: `w + (2 (i + 1/2 + dx) - cols) / rows k r + (rows - 2 (j + 1/2 + dy)) / rows k u`,
    /// to nearest.
    #[test]
    fn the_ray_of_a_sample_is_the_nearest_to_its_definition() {
        let bits = |v: Vec3<Unit>| [v.x, v.y, v.z].map(|c| i128::from(c.to_bits()));
        let (mut worst, mut tried) = (0, 0);
        for (size, degrees) in [((7, 5), 40), ((64, 48), 70), ((1, 1), 1), ((96, 16), 12), ((1, 33), 90)] {
            let camera = camera(degrees);
            let (cols, rows) = (i128::from(size.0), i128::from(size.1));
            let caster = with_surface(|surface| {
                let caster = RayCaster::new(surface, camera, Size::new(size.0, size.1)).unwrap();
                let mut directions = Vec::new();
                for (y, x) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (y, x))) {
                    for (dx, dy) in
                        [(0, 0), (1 << 23, -(1 << 23)), (-33_333_333, 12_345_678), (0, 1 << 23), (77_777, 0)]
                    {
                        directions.push((x, y, dx, dy, caster.offset(caster.direction(x, y), dx, dy)));
                    }
                }
                directions
            });
            let (w, r, u, k) =
                (bits(camera.forward), bits(camera.right), bits(camera.up), i128::from(camera.tangent));
            for (x, y, dx, dy, got) in caster {
                // in half pixels with 24 fractional bits
                let half = |n: u32, d: i32| ((2 * i128::from(n) + 1) << 24) + 2 * i128::from(d);
                let (a, b) = (half(x, dx) - (cols << 24), (rows << 24) - half(y, dy));
                let under = rows << 54;
                for i in 0..3 {
                    let exact = ((w[i] * rows) << 52) + a * k * r[i] + b * k * u[i];
                    // in thousandths of a unit
                    worst = worst.max(((i128::from(got[i]) * under - exact).abs() * 1000) / under);
                    tried += 1;
                }
            }
        }
        assert!((490..=510).contains(&worst) && tried > 10_000, "{worst} of {tried}");
    }

    #[test]
    fn a_tone_is_the_nearest_part_of_65535() {
        let mut beyond = 0;
        for tone in (0..=1 << 30).step_by(997).chain([
            1,
            (1 << 13) - 1,
            1 << 13,
            (1 << 13) + 1,
            (1 << 30) - 1,
            1 << 30,
        ]) {
            let off = (i64::from(rounded(tone).to_bits()) << 30) - i64::from(tone) * 65535;
            assert!((-(1 << 29)..=(1 << 29) + (1 << 16)).contains(&off), "{tone}: {off}");
            beyond += u32::from(off > 1 << 29);
        }
        assert!(beyond > 0);
    }

    /// The cone of a pixel is `2 k / rows` wide, that of one of `n` samples a side an `n`-th of it, and
    /// below 2.
    #[test]
    fn a_footprint_is_the_width_of_a_pixel_or_of_a_part() {
        with_surface(|surface| {
            for (size, degrees, n) in [((7, 5), 40, 3), ((64, 48), 70, 8), ((2, 1), 1, 1), ((1, 2), 110, 2)] {
                let camera = camera(degrees);
                let caster = RayCaster::new(surface, camera, Size::new(size.0, size.1)).unwrap();
                let width = (i64::from(camera.tangent) << 3) / i64::from(size.1);
                assert_eq!(i64::from(caster.footprint.per_t().to_bits()), width);
                assert_eq!(caster.rays.footprint, caster.footprint);
                let sampled = caster.with_sampling(Sampling::Grid(n), Filter::Box).unwrap();
                assert_eq!(i64::from(sampled.rays.footprint.per_t().to_bits()), width / i64::from(n));
            }
            // 2 tan(55 degrees) is beyond the format
            let caster = RayCaster::new(surface, camera(110), Size::new(1, 1)).unwrap();
            assert_eq!(caster.footprint.per_t(), Unit::MAX);
        });
    }

    /// `k (cols + rows + 4 margin) / rows` below 3.
    #[test]
    fn a_view_is_refused_from_where_its_rays_could_leave_their_format() {
        let fits = |tangent, cols, rows, margin| {
            let refused = in_reach(tangent, cols, rows, margin);
            assert!(match &refused {
                Ok(()) => true,
                // reported with 48 fractional bits
                Err(Error::OutOfRange { value, .. }) =>
                    value.to_bits() >> 20 == i64::from(tangent) * (cols + rows + 4 * margin) / rows,
                Err(_) => false,
            });
            refused.is_ok()
        };
        let limit = 3 << 27;
        assert_eq!([fits(limit - 1, 5, 5, 0), fits(limit, 5, 5, 0)], [true, false]);
        // rounded down: 5/4 of these are 3 less a 2^-28 and a half, and 3 and more
        assert_eq!([fits(644_245_094, 1, 4, 0), fits(644_245_095, 1, 4, 0)], [true, false]);
        // 3/2 of half as much, and one pixel of margin on all sides
        assert_eq!([fits((1 << 28) - 1, 20, 12, 1), fits(1 << 28, 20, 12, 1)], [true, false]);
        assert_eq!([fits((1 << 27) - 1, 5, 1, 0), fits(1 << 27, 5, 1, 0)], [true, false]);
        let at = |filter| {
            with_surface(|surface| {
                let caster = RayCaster::new(surface, camera(90), Size::new(5, 3)).unwrap();
                caster.with_sampling(Sampling::Grid(2), filter).is_ok()
            })
        };
        // 8/3 of a tangent of 1; with a margin of one pixel 12/3
        let wide = Filter::Gaussian { deviation: Real::ONE, width: Real::from_num(2) };
        assert_eq!([at(Filter::Box), at(wide)], [true, false]);
    }

    /// Each pixel by itself, a row from any column on, and skipping, show the same.
    #[test]
    fn a_row_is_the_row_of_its_pixels() {
        for size in [Size::new(24, 20), Size::new(40, 8), Size::new(24, 60)] {
            a_row_is_the_row_of_its_pixels_at(size);
        }
    }

    fn a_row_is_the_row_of_its_pixels_at(size: Size) {
        let (cols, rows) = (size.width, size.height);
        with_surface(|surface| {
            for sampling in [Sampling::Centre, Sampling::Jittered { n: 2, seed: 5 }] {
                let caster = RayCaster::new(surface, camera(40), size).unwrap();
                let caster = caster.with_sampling(sampling, Filter::Box).unwrap();
                let mut tones = [0; 2];
                for y in 0..size.height {
                    let row: Vec<_> = caster.row(y, 0..size.width).collect();
                    assert_eq!(row.len(), cols as usize);
                    let visible = caster.outline.columns(y, size.width);
                    for (x, tone) in (0..).zip(&row) {
                        let pixel = |visible| caster.pixel(x, y, caster.direction(x, y).map(narrow), visible);
                        assert_eq!((*tone, *tone), (pixel(visible.contains(&x)), pixel(true)), "{x} {y}");
                        tones[usize::from(caster.hit(x, y).is_some())] += 1;
                    }
                    assert!(caster.row(y, 5..20).eq(row[5..20].iter().copied()));
                    let mut skipping = caster.row(y, 3..20);
                    assert_eq!([skipping.nth(4), skipping.next()], [Some(row[7]), Some(row[8])]);
                    assert_eq!((skipping.size_hint(), skipping.nth(99)), ((11, Some(11)), None));
                    let mut skipping = caster.row(y, 3..20);
                    assert_eq!((skipping.nth(usize::MAX), skipping.next()), (None, None));
                }
                assert!(tones.iter().all(|n| *n > 8), "{tones:?}");
                assert_eq!(
                    (caster.row(0, cols..99).count(), caster.row(99, 20..99).count()),
                    (0, cols as usize - 20)
                );
                assert!(caster.row(99, 0..cols).eq(caster.row(rows - 1, 0..cols)));
            }
        });
    }

    /// What is seen has the tone that material, light and surroundings give it; what is not, that of its
    /// direction.
    #[test]
    fn a_tone_is_that_of_the_leaf_or_of_the_surroundings() {
        with_surface(|surface| {
            let plain = Unit::from_num(0.25);
            let caster = RayCaster::new(surface, camera(40), Size::new(24, 20)).unwrap();
            let sky = caster.clone();
            let caster = caster.with_environment(Environment::Plain(plain)).unwrap();
            let light = Light::new(Vec3::new(Real::ZERO, Real::ZERO, Real::ONE)).unwrap();
            let mirror = caster.clone().with_finish(Finish::Mirror).unwrap();
            let lit = caster.clone().with_light(light);
            let (mut met, mut statistics) = (0, Statistics::default());
            for (x, y) in (0..20).flat_map(|y| (0..24).map(move |x| (x, y))) {
                let direction = caster.direction(x, y).map(narrow);
                let eye = camera(40).eye;
                let ray = Ray::from_bits([eye.x, eye.y, eye.z].map(Real::to_bits), direction);
                let hit = surface.intersect_counted(&ray, caster.footprint.per_t(), &mut statistics);
                assert_eq!(hit, caster.hit(x, y));
                assert_eq!((mirror.tone(direction, true), caster.tone(direction, false)), (plain, plain));
                assert_eq!(sky.tone(direction, false), Environment::SKY.towards(direction));
                let Some(hit) = hit else {
                    assert_eq!(lit.tone(direction, true), plain);
                    continue;
                };
                met += 1;
                // lit from straight above: n_z, an eighth of it ambient
                let n = hit.normal().normalised().unwrap();
                let exact = 0.125 + 0.875 * n.z.to_num::<f64>();
                assert!(
                    (lit.tone(direction, true).to_num::<f64>() - exact).abs() < 2_f64.powi(-27),
                    "{x} {y}"
                );
            }
            assert!(met > 50 && caster.statistics() == statistics && statistics.rays == 480, "{met}");
            // a row of pixels of one tone, whatever the samples
            for (sampling, rays) in [(Sampling::Grid(3), 9), (Sampling::Jittered { n: 8, seed: 1 }, 64)] {
                let filter = Filter::Gaussian { deviation: Real::ONE, width: Real::from_num(3) };
                let many = mirror.clone().with_sampling(sampling, filter).unwrap();
                assert!(many.row(10, 0..24).all(|tone| (16383..=16384).contains(&tone.to_bits())));
                assert_eq!(many.statistics().rays, 480 * rays);
            }
            let white = mirror.with_environment(Environment::Plain(Unit::ONE)).unwrap();
            let white = white.with_sampling(Sampling::Grid(7), Filter::Box).unwrap();
            assert!(white.row(10, 0..24).all(|tone| tone == Tone::from_bits(65535)));
        });
    }

    /// A pixel is the sum of its samples' tones by their weights, rounded once.
    #[test]
    fn a_pixel_is_the_weighted_sum_of_its_samples() {
        with_surface(|surface| {
            let filter = Filter::Gaussian { deviation: Real::ONE, width: Real::from_num(2) };
            let caster = RayCaster::new(surface, camera(40), Size::new(24, 20)).unwrap();
            let caster = caster.with_sampling(Sampling::Jittered { n: 3, seed: 2 }, filter).unwrap();
            let mut mixed = 0;
            for (x, y) in (0..20).flat_map(|y| (0..24).map(move |x| (x, y))) {
                let (mut sum, mut tones) = (0_i128, Vec::new());
                for (dx, dy, weight) in caster.pattern.samples(x, y) {
                    let tone = caster.tone(caster.offset(caster.direction(x, y), dx, dy), true).to_bits();
                    sum += i128::from(tone) * i128::from(weight);
                    tones.push(tone);
                }
                assert_eq!(caster.row(y, x..x + 1).next(), Some(rounded((sum >> 30) as u32)), "{x} {y}");
                mixed += u32::from(tones.iter().max().unwrap() - tones.iter().min().unwrap() > 1 << 26);
            }
            assert!(mixed > 20, "{mixed}");
        });
    }

    /// Where the surface fills the view, no pixel beyond the picture is asked for.
    #[test]
    fn there_is_no_hit_beyond_the_picture() {
        with_surface(|surface| {
            let at =
                |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
            let camera = Camera::new(at(-3, -2, 5), at(1, 1, 0), at(0, 0, 1), Real::from_num(2)).unwrap();
            let caster = RayCaster::new(surface, camera, Size::new(24, 20)).unwrap();
            assert!(caster.hit(23, 19).is_some() && caster.hit(0, 0).is_some());
            assert!(
                caster.hit(24, 7).is_none() && caster.hit(7, 20).is_none() && caster.hit(99, 99).is_none()
            );
        });
    }
}
