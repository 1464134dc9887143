//! The three kinds of picture, each lazy and without a buffer, and the windows through which a display looks at the plane.
//!
//! - *points*: an `Iterator<Item = Point2>` (chaos game, sampled attractors);
//! - *path*: an `Iterator<Item = Step>` of move-to and line-to (graphs of functions, Koch curves);
//! - *field*: a [`Field`], one value a pixel, delivered row by row (dwell, ray caster).
//!
//! A path:
//!
#![doc = include_str!("../docs/curve.md")]
//! A field:
//!
#![doc = include_str!("../docs/escape.md")]

use core::ops::Range;

use embedded_graphics_core::geometry::{Point, Size};

use crate::Error;
use crate::num::{Real, Wide, nth, ratio};

/// A point of the plane; `y` points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point2 {
    /// To the right.
    pub x: Real,
    /// Upwards.
    pub y: Real,
}

impl Point2 {
    /// The point `(x, y)`.
    pub const fn new(x: Real, y: Real) -> Self {
        Self { x, y }
    }

    /// The point `(x, y)` from decimal literals, for constants: `const TIP: Point2 = Point2::lit("0.5", "0.866")`.
    ///
    /// Text that is no number, or does not fit, is an error at compile time. Call it in a `const` or in `const { }` only: see
    /// [Numbers](crate::num#numbers).
    pub const fn lit(x: &str, y: &str) -> Self {
        Self::new(Real::lit(x), Real::lit(y))
    }
}

/// One step of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Step {
    /// Lift the pen and start here.
    MoveTo(Point2),
    /// Draw a straight line to here.
    LineTo(Point2),
}

/// An axis-parallel box in the plane, both corners included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds2 {
    /// Lower left corner.
    pub min: Point2,
    /// Upper right corner.
    pub max: Point2,
}

/// A value for each pixel, row by row.
pub trait Field {
    /// What a pixel holds. A number, never a colour: colour enters in [`crate::draw`].
    type Value: Copy;
    /// The values of one row. `nth` must not evaluate what it skips: drivers skip what they clip.
    type Row<'a>: Iterator<Item = Self::Value>
    where
        Self: 'a;

    /// Width and height in pixels.
    fn size(&self) -> Size;

    /// The values at row `y` (0 at the top) of the columns `x`. Both must lie inside [`Field::size`]; the iterator yields exactly `x.len()` values.
    fn row(&self, y: u32, x: Range<u32>) -> Self::Row<'_>;
}

impl<F: Field> Field for &F {
    type Value = F::Value;
    type Row<'a>
        = F::Row<'a>
    where
        Self: 'a;

    fn size(&self) -> Size {
        (**self).size()
    }

    fn row(&self, y: u32, x: Range<u32>) -> Self::Row<'_> {
        (**self).row(y, x)
    }
}

/// The largest number of pixels a side: coordinates of pixels stay far inside 32 bits.
pub const MAX_SIDE: u32 = 1 << 14;

/// Checks a picture's size: each side from 1 to [`MAX_SIDE`].
///
/// # Errors
/// [`Error::OutOfRange`] that names the side.
pub fn checked_size(size: Size) -> Result<Size, Error> {
    for (what, side) in [("width", size.width), ("height", size.height)] {
        if side == 0 || side > MAX_SIDE {
            return Err(Error::OutOfRange {
                what,
                index: None,
                value: Wide::saturating_from_num(side),
                min: Wide::ONE,
                max: Wide::from_num(MAX_SIDE as i16),
            });
        }
    }
    Ok(size)
}

/// A rectangle of the plane and the pixels that show it (seeds' world window and viewport).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::WindowNumbers", into = "crate::serial::WindowNumbers")
)]
pub struct Window {
    bounds: Bounds2,
    size: Size,
    /// Pixels a unit in each direction: 32-bit mantissa and right shift.
    x: (u32, u32),
    y: (u32, u32),
}

impl Window {
    /// Shows `bounds` on all of `size`, stretched if the aspect ratios differ (graphs of functions).
    ///
    /// # Errors
    /// [`Error::Degenerate`] for an empty box, [`Error::OutOfRange`] for a size of 0 or above [`MAX_SIDE`].
    pub fn stretch(bounds: Bounds2, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        let width = extent(bounds.min.x, bounds.max.x);
        let height = extent(bounds.min.y, bounds.max.y);
        if width <= 0 || height <= 0 {
            return Err(Error::Degenerate { what: "area of the window" });
        }
        Ok(Self { bounds, size, x: pixels_a_unit(size.width, width), y: pixels_a_unit(size.height, height) })
    }

    /// Shows all of `bounds`, centred, with square pixels: the shorter direction is widened, so that a line or a point may be shown.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a box that ends before it begins, [`Error::OutOfRange`] for a size of 0 or above [`MAX_SIDE`].
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
        let from = |start: Real, end: Real| end.to_bits().wrapping_sub(start.to_bits()) as u32;
        let (right, down) = (from(min.x, p.x), from(p.y, max.y));
        if right > from(min.x, max.x) || down > from(min.y, max.y) {
            return None;
        }
        let column = scaled(right, self.x).min(self.size.width - 1);
        let row = scaled(down, self.y).min(self.size.height - 1);
        Some(Point::new(column as i32, row as i32))
    }

    /// For each direction the pixels a unit as 32-bit mantissa and the right shift of the product's high word; none where a unit of the format is a
    /// pixel or wider, or where a point below the window could get an index inside it modulo `2^32`.
    pub(crate) fn scales(&self) -> Option<[(u32, u32); 2]> {
        let (x_shift, y_shift) = (self.x.1.checked_sub(32)?, self.y.1.checked_sub(32)?);
        // the row 2^32 units below the upper edge, and one more
        let rows = u64::from(self.y.0 >> (y_shift & 31)) + 2;
        (rows * u64::from(self.size.width) < 1 << 32).then_some([(self.x.0, x_shift), (self.y.0, y_shift)])
    }

    /// Column and row of `p` in the raster continued over the whole plane: inside the window as [`Window::pixel`], below 2^47 everywhere.
    pub fn raster(&self, p: Point2) -> (i64, i64) {
        let bits = |r: Real| i64::from(r.to_bits());
        let (min, max) = (self.bounds.min, self.bounds.max);
        let width = bits(max.x) - bits(min.x);
        let height = bits(max.y) - bits(min.y);
        (
            continued(bits(p.x) - bits(min.x), width, self.x, self.size.width),
            continued(bits(max.y) - bits(p.y), height, self.y, self.size.height),
        )
    }
}

/// The pixel at a signed distance from the first pixel's edge; the far edge itself belongs to the last pixel.
fn continued(distance: i64, extent: i64, (mantissa, shift): (u32, u32), pixels: u32) -> i64 {
    // |distance| < 2^32
    let product = distance.unsigned_abs().wrapping_mul(u64::from(mantissa));
    let shift = shift & 63;
    if distance < 0 {
        // floor of a negative quotient
        -(((product.wrapping_sub(1) >> shift) as i64).wrapping_add(1))
    } else if distance <= extent {
        ((product >> shift) as i64).min(i64::from(pixels) - 1)
    } else {
        ((product >> shift) as i64).max(i64::from(pixels))
    }
}

fn extent(low: Real, high: Real) -> i64 {
    i64::from(high.to_bits()) - i64::from(low.to_bits())
}

#[inline(never)]
fn saturate(bits: i64) -> Real {
    Real::from_bits(bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

/// `pixels / extent` as mantissa and right shift, rounded down, with the mantissa in the upper half of 32 bits.
fn pixels_a_unit(pixels: u32, extent: i64) -> (u32, u32) {
    // extent < 2^32 and pixels <= 2^14: the quotient with 46 fractional bits has at most 61 bits.
    let quotient = ratio(pixels.into(), 46, extent.max(1) as u64);
    let excess = 32_u32.saturating_sub(quotient.leading_zeros());
    ((quotient >> excess) as u32, 46 - excess)
}

/// `distance mantissa / 2^shift`, below `2^15`, for a shift from 17 to 46: by the high word alone, as a 64-bit shift by a variable takes 7 instructions.
#[inline]
fn scaled(distance: u32, (mantissa, shift): (u32, u32)) -> u32 {
    // below 2^15 where the shift is below 32, as then the mantissa has 32 bits
    let distance = distance << (32_u32.saturating_sub(shift) & 31);
    ((u64::from(distance) * u64::from(mantissa)) >> 32) as u32 >> (shift.saturating_sub(32) & 31)
}
