//! A window onto the plane: tells which pixel shows a point, for dots, paths and densities.
//!
//! The mapping is exact, so that the same point has the same pixel on every machine and in whichever portion
//! it is drawn. A pixel costs products with a reciprocal of the window's extent, prepared once, and no
//! division.

use embedded_graphics_core::geometry::{Point, Size};

use super::point::{Bounds2, Point2};
use super::size::checked_size;
use crate::Error;
use crate::num::{Real, nth, product_u, ratio};

/// A rectangle of the plane and the pixels that show it: what textbooks call a world window and its viewport.
///
/// A point belongs to the pixel in column `floor((x - min.x) columns / width)` and row
/// `floor((max.y - y) rows / height)`, exactly: a pixel owns its left and its upper edge, and the last column
/// and row own the window's right and lower edge too (`every_point_is_in_the_pixel_of_the_exact_quotient`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::WindowNumbers", into = "crate::serial::WindowNumbers")
)]
pub struct Window {
    bounds: Bounds2,
    size: Size,
    x: PixelsPerUnit,
    y: PixelsPerUnit,
}

impl Window {
    /// Shows `bounds` on all of `size`, stretched if the aspect ratios differ (graphs of functions).
    ///
    /// # Errors
    /// [`Error::Degenerate`] for an empty box, [`Error::OutOfRange`] for a size of 0 or above
    /// [`MAX_SIDE`](super::MAX_SIDE).
    pub fn stretch(bounds: Bounds2, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let Bounds2 { min, max } = bounds;
        if min.x >= max.x || min.y >= max.y {
            return Err(Error::Degenerate { what: "area of the window" });
        }
        let x = PixelsPerUnit::of(size.width, distance(min.x, max.x));
        let y = PixelsPerUnit::of(size.height, distance(min.y, max.y));
        Ok(Self { bounds, size, x, y })
    }

    /// Shows all of `bounds`, centred, with square pixels: the shorter direction is widened, so that a line
    /// or a point may be shown.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a box that ends before it begins, [`Error::OutOfRange`] for a size of 0 or
    /// above [`MAX_SIDE`](super::MAX_SIDE).
    pub fn fit(bounds: Bounds2, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let axes = [(bounds.min.x, bounds.max.x, size.width), (bounds.min.y, bounds.max.y, size.height)];
        let mut pitch = 1;
        for (low, high, pixels) in axes {
            let extent = extent(low, high);
            if extent < 0 {
                return Err(Error::Degenerate { what: "area of the window" });
            }
            // rounded up
            pitch = pitch.max(nth(extent + i64::from(pixels) - 1, pixels));
        }
        let [(left, right), (bottom, top)] = axes.map(|(low, high, pixels)| {
            let shown = pitch * i64::from(pixels);
            let low = i64::from(low.to_bits()) - (shown - extent(low, high)) / 2;
            (saturate(low), saturate(low + shown))
        });
        Self::stretch(Bounds2 { min: Point2::new(left, bottom), max: Point2::new(right, top) }, size)
    }

    /// The rectangle of the plane that is shown.
    pub const fn bounds(&self) -> Bounds2 {
        self.bounds
    }

    /// The pixels that show it.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// The pixel that shows `p`, none outside the window. Row 0 is at the top.
    #[inline]
    pub fn pixel(&self, p: Point2) -> Option<Point> {
        let Bounds2 { min, max } = self.bounds;
        // modulo 2^32 what lies before the window is farther away than its other end
        let (right, down) = (distance(min.x, p.x), distance(p.y, max.y));
        if right > distance(min.x, max.x) || down > distance(min.y, max.y) {
            return None;
        }
        let column = self.x.pixel(right).min(self.size.width - 1);
        let row = self.y.pixel(down).min(self.size.height - 1);
        Some(Point::new(column as i32, row as i32))
    }

    /// The shortcut of a [`Density`](super::Density): the scales of both directions without their whole part,
    /// which is 0 where each pixel is wider than a unit of the format. None also where a point below the
    /// window would get an index inside it modulo `2^32`: `row width + column` is the index of a pixel, or
    /// beyond them all.
    pub(crate) fn fractions(&self) -> Option<[[u32; 2]; 2]> {
        let ([0, x @ ..], [0, y @ ..]) = (self.x.digits, self.y.digits) else { return None };
        // no point is more than 2^32 units below the upper edge: its row there, and one more
        let [high, _] = y;
        let rows = u64::from(high) + 2;
        (rows * u64::from(self.size.width) < 1 << 32).then_some([x, y])
    }

    /// Column and row of `p` in the raster continued over the whole plane: inside the window as
    /// [`Window::pixel`], below 2^47 everywhere.
    pub fn raster(&self, p: Point2) -> (i64, i64) {
        let Bounds2 { min, max } = self.bounds;
        (
            self.x.continued(extent(min.x, p.x), extent(min.x, max.x), self.size.width),
            self.y.continued(extent(p.y, max.y), extent(min.y, max.y), self.size.height),
        )
    }
}

/// How many pixels a unit of the plane is long in one direction, so that a pixel is a product and no
/// division: `m = ceil(2^64 pixels / extent)`, 64 fractional bits in three digits of 32.
///
/// `floor(d m / 2^64) = floor(d pixels / extent)` for every `d < 2^32`: `d m` exceeds
/// `2^64 d pixels / extent` by less than `d`, that is by less than `2^64 / extent`, the least distance of a
/// quotient from the integer above it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct PixelsPerUnit {
    digits: [u32; 3],
}

impl PixelsPerUnit {
    /// For an extent of at least 1; 0 counts as 1.
    fn of(pixels: u32, extent: u32) -> Self {
        let extent = extent.max(1);
        let whole = pixels.checked_div(extent).unwrap_or(pixels);
        // below the extent
        let rest = pixels - whole * extent;
        let fraction = ratio(u64::from(rest) << 1, 63, extent.into());
        // rounded up: what the quotient leaves of 2^64 rest is below 2^32, so that it is 0 exactly where it
        // is 0 modulo 2^64
        let up = u64::from(fraction.wrapping_mul(extent.into()) != 0);
        let fraction = fraction.wrapping_add(up);
        Self { digits: [whole, (fraction >> 32) as u32, fraction as u32] }
    }

    /// The pixel at a distance within the extent.
    #[inline(always)]
    fn pixel(self, distance: u32) -> u32 {
        let [whole, high, low] = self.digits;
        distance.wrapping_mul(whole).wrapping_add(whole_pixels(distance, [high, low]))
    }

    /// The pixel at any signed distance; the far edge itself belongs to the last pixel.
    fn continued(self, distance: i64, extent: i64, pixels: u32) -> i64 {
        let [whole, high, low] = self.digits;
        // below 2^32
        let d = distance.unsigned_abs() as u32;
        let fraction = pixels_q32(d, [high, low]);
        let pixel = (product_u(d, whole) + (fraction >> 32)) as i64;
        if distance < 0 {
            // the floor of a negative quotient; where it is an integer, the fraction that is left is below
            // 2^-32
            -pixel - i64::from(fraction as u32 != 0)
        } else {
            pixel - i64::from(distance == extent && pixel == i64::from(pixels))
        }
    }
}

/// `distance` times a fraction of two digits: 32 fractional bits in a word of 64, which it does not leave.
#[inline(always)]
fn pixels_q32(distance: u32, [high, low]: [u32; 2]) -> u64 {
    product_u(distance, high) + (product_u(distance, low) >> 32)
}

/// `floor(distance fraction)`.
#[inline(always)]
pub(crate) fn whole_pixels(distance: u32, fraction: [u32; 2]) -> u32 {
    (pixels_q32(distance, fraction) >> 32) as u32
}

fn extent(low: Real, high: Real) -> i64 {
    i64::from(high.to_bits()) - i64::from(low.to_bits())
}

/// How far `end` is from `start`, modulo `2^32`.
#[inline(always)]
pub(crate) fn distance(start: Real, end: Real) -> u32 {
    end.to_bits().wrapping_sub(start.to_bits()) as u32
}

#[inline(never)]
fn saturate(bits: i64) -> Real {
    Real::from_bits(bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::plane::Density;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};
    use std::{vec, vec::Vec};

    /// Where an axis begins, how long it is, how many pixels show it.
    type Axis = (i64, i64, i64);

    fn bits(v: i64) -> Real {
        Real::from_bits(v as i32)
    }

    /// `floor(distance pixels / extent)`, the far edge in the last pixel.
    fn exact(distance: i64, (_, extent, pixels): Axis) -> i64 {
        if distance == extent {
            return pixels - 1;
        }
        (i128::from(distance) * i128::from(pixels)).div_euclid(i128::from(extent)) as i64
    }

    /// Distances on an axis that decide: the edges of all pixels or of as many as 40, a unit before and
    /// behind each, and beyond both ends.
    fn decisive((start, extent, pixels): Axis, rng: &mut Xoshiro128PlusPlus) -> Vec<i64> {
        let mut distances = vec![0, extent, i64::from(i32::MIN) - start, i64::from(i32::MAX) - start];
        let every = pixels / 40 + 1;
        for k in (0..=pixels).filter(|k| k % every == 0 || pixels - k < 3) {
            // the first unit of pixel k
            let edge = (i128::from(k) * i128::from(extent) + i128::from(pixels) - 1) / i128::from(pixels);
            distances.extend((-1..=1).map(|off| edge as i64 + off));
        }
        distances.extend((0..20).map(|_| i64::from(rng.next_u32() as i32) - start));
        distances.retain(|d| (i64::from(i32::MIN)..=i64::from(i32::MAX)).contains(&(start + d)));
        distances
    }

    #[test]
    fn every_point_is_in_the_pixel_of_the_exact_quotient() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(8);
        let unit = 1_i64 << 24;
        let low = i64::from(i32::MIN);
        let mut axes: Vec<Axis> = vec![
            (0, 48 * unit, 64),
            (-unit, 2 * unit, 240),
            (low, (1 << 32) - 1, 16384),
            (low, (1 << 32) - 1, 1),
            (low, (1 << 32) - 2, 3),
            (low + 1, 1 << 31, 16383),
            (-5, 1, 64),
            (7, 1, 16384),
            (0, 64, 64),
            (0, 65, 64),
            (0, 63, 64),
            (-3, 3, 7),
        ];
        for _ in 0..150 {
            let extent = 1.max(i64::from(rng.next_u32() >> (rng.next_u32() % 32)));
            let start = low + (rng.next_u32() as i64 % ((1 << 32) - extent));
            axes.push((start, extent, 1 + i64::from(rng.next_u32() >> (18 + rng.next_u32() % 14))));
        }
        let mut tally = [0_u32; 3];
        for (i, x) in axes.iter().enumerate() {
            // each axis as columns and as rows
            let y = axes[(i * 7 + 3) % axes.len()];
            let (x, y) = if x.2 * y.2 > 1 << 18 { (*x, (y.0, y.1, 1 + y.2 % 9)) } else { (*x, y) };
            for (x, y) in [(x, y), (y, x)] {
                check(x, y, &mut rng, &mut tally);
            }
        }
        assert!(tally.iter().all(|n| *n > 5_000), "{tally:?}");
    }

    /// Every decisive point through window, raster and density.
    fn check(x: Axis, y: Axis, rng: &mut Xoshiro128PlusPlus, tally: &mut [u32; 3]) {
        let bounds = Bounds2 {
            min: Point2::new(bits(x.0), bits(y.0)),
            max: Point2::new(bits(x.0 + x.1), bits(y.0 + y.1)),
        };
        let size = Size::new(x.2 as u32, y.2 as u32);
        let window = Window::stretch(bounds, size).unwrap();
        let mut counts = vec![0_u8; (x.2 * y.2) as usize];
        let mut points = Vec::new();
        // upside down: a coordinate v is at -v - 1
        let (right, down) = (decisive(x, rng), decisive((!(y.0 + y.1), y.1, y.2), rng));
        for k in 0..right.len().max(down.len()) {
            let (right, down) = (right[k % right.len()], down[k % down.len()]);
            points.push((right, down));
            points.push((right, y.1 / 2));
            points.push((x.1 / 2, down));
        }
        for (right, down) in points {
            let point = Point2::new(bits(x.0 + right), bits(y.0 + y.1 - down));
            let (column, row) = (exact(right, x), exact(down, y));
            let inside = (0..=x.1).contains(&right) && (0..=y.1).contains(&down);
            let pixel = inside.then(|| Point::new(column as i32, row as i32));
            let told = std::format!("{x:?} {y:?}: {right} {down}");
            assert_eq!(window.pixel(point), pixel, "{told}");
            assert_eq!(window.raster(point), (column, row), "{told}");
            let mut density = Density::new(window, &mut counts).unwrap();
            density.record(point);
            let hit = density.counts().iter().position(|c| *c > 0);
            assert_eq!(hit, pixel.map(|p| (p.y as usize) * x.2 as usize + p.x as usize), "{told}");
            tally[usize::from(inside)] += 1;
            let on_an_edge = right > 0 && right < x.1 && right * x.2 % x.1 == 0;
            tally[2] += u32::from(inside && on_an_edge);
        }
    }

    #[test]
    fn lattice_points_of_a_wide_window_are_in_their_columns() {
        // 48 units on 64 pixels: a point every 3 units is 4 pixels on
        let at = |x: i32, y: i32| Point2::new(Real::from_num(x), Real::from_num(y));
        let window = Window::stretch(Bounds2 { min: at(0, 0), max: at(48, 48) }, Size::new(64, 64)).unwrap();
        for k in 0..16 {
            let pixel = window.pixel(at(3 * k, 48 - 3 * k));
            assert_eq!(pixel, Some(Point::new(4 * k, 4 * k)));
        }
    }
}
