//! A display without pixels: it takes what is drawn into a CRC-32.
//!
//! The clock runs while a picture is computed and while its colours are stored into a small buffer, as a
//! driver would; it stands still while the buffer goes into the checksum. What the storing costs is measured
//! afterwards with the same calls of the same length and a constant colour, and taken off.
//!
//! The checksum covers the sequence of calls: position, width and colours of each run of pixels, in the order
//! of drawing.

use core::convert::Infallible;
use core::fmt;
use core::hint::black_box;
use core::marker::PhantomData;

use crc::Digest;
use embedded_graphics::Drawable;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, OriginDimensions, Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, IntoStorage, PixelColor};
use embedded_graphics::primitives::{PointsIter, Rectangle};

use crate::checksum::CRC_32;
use crate::machine::Machine;

/// Pixels between two stops of the clock.
const BUFFER: usize = 320;

/// Why a scene was not drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// The kernel refused its description.
    Refused(attractor::Error),
    /// The machine is too small.
    Ram {
        /// Bytes that the scene takes.
        needed: usize,
        /// Bytes that are free.
        free: usize,
    },
}

impl From<attractor::Error> for Failure {
    fn from(error: attractor::Error) -> Self {
        Self::Refused(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(error) => write!(f, "{error}"),
            Self::Ram { needed, free } => {
                write!(f, "the scene needs {needed} bytes of RAM, this machine has {free} free")
            }
        }
    }
}

/// What is known of a picture that was drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Outcome {
    /// Checksum of everything drawn.
    pub crc32: u32,
    /// Pixels drawn.
    pub pixels: u64,
    /// Instructions of the kernel alone.
    pub instructions: u64,
    /// The deepest the stack went while drawing.
    pub stack_bytes: u32,
    /// What the scene object takes.
    pub ram_bytes: usize,
}

/// A colour that the sink takes: `BinaryColor`, the greys, the colours of 16 bits.
pub trait Colour: PixelColor + IntoStorage<Storage: Into<u16>> + From<BinaryColor> {}

impl<C: PixelColor + IntoStorage<Storage: Into<u16>> + From<BinaryColor>> Colour for C {}

/// Where a scene is built and shown.
pub struct Stage<'m> {
    machine: &'m mut dyn Machine,
    size: Size,
    outcome: Outcome,
}

impl fmt::Debug for Stage<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stage")
            .field("size", &self.size)
            .field("outcome", &self.outcome)
            .finish_non_exhaustive()
    }
}

impl<'m> Stage<'m> {
    /// A stage of `size` pixels.
    pub fn new(machine: &'m mut dyn Machine, size: Size) -> Self {
        Self { machine, size, outcome: Outcome::default() }
    }

    /// Width and height of the picture.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// What is known after [`Stage::show`].
    pub const fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// Asks for `bytes` of RAM before the object that takes them is built.
    ///
    /// # Errors
    /// [`Failure::Ram`] when the machine has less; a quarter of what is free, 8 KiB at most, is left to the
    /// stack.
    pub fn claim(&mut self, bytes: usize) -> Result<(), Failure> {
        let free = self.machine.ram_free();
        let free = free - (free / 4).min(8 << 10);
        if bytes > free {
            return Err(Failure::Ram { needed: bytes, free });
        }
        self.outcome.ram_bytes = bytes;
        Ok(())
    }

    /// Draws and measures. `ram_bytes` counts the scene objects: `size_of_val` of the drawable and of all
    /// that it borrows.
    ///
    /// # Errors
    /// [`Failure::Ram`], as [`Stage::claim`].
    pub fn show<D>(&mut self, drawable: &D, ram_bytes: usize) -> Result<(), Failure>
    where
        D: Drawable,
        D::Color: Colour,
    {
        self.draw::<D::Color>(ram_bytes, |sink| {
            let Ok(_) = drawable.draw(sink);
            Ok(())
        })
    }

    /// Measures what `draw` does, for pictures that borrow memory while they are drawn. What was
    /// [claimed](Stage::claim) before is not asked for again.
    ///
    /// # Errors
    /// What `draw` says; [`Failure::Ram`], as [`Stage::claim`].
    pub fn draw<C: Colour>(
        &mut self,
        ram_bytes: usize,
        draw: impl FnOnce(&mut Sink<'_, C>) -> Result<(), attractor::Error>,
    ) -> Result<(), Failure> {
        // what was claimed before is built already, and no longer free
        self.claim(ram_bytes.saturating_sub(self.outcome.ram_bytes))?;
        let mut sink = Sink::<C>::new(&mut *self.machine, self.size, true);
        sink.machine.paint_stack();
        sink.resume();
        draw(&mut sink)?;
        sink.pause();
        let stack_bytes = sink.machine.stack_used();
        let (crc, spent, calls) = (sink.crc, sink.spent, sink.calls);
        let mut empty = Sink::<C>::new(&mut *self.machine, self.size, false);
        empty.repeat(calls);
        let floor = empty.spent;
        self.outcome = Outcome {
            crc32: crc.finalize(),
            pixels: calls.row_pixels + calls.points,
            instructions: spent.saturating_sub(floor),
            stack_bytes,
            ram_bytes,
        };
        Ok(())
    }
}

/// How often the sink was called, and for how many pixels.
#[derive(Debug, Clone, Copy, Default)]
struct Calls {
    rows: u64,
    row_pixels: u64,
    batches: u64,
    points: u64,
}

/// The display. Its size is the scene's, its colour any that fits in 16 bits.
pub struct Sink<'m, C> {
    machine: &'m mut dyn Machine,
    size: Size,
    crc: Digest<'static, u32>,
    calls: Calls,
    spent: u64,
    since: u32,
    /// Whether the machine shall see the pixels as well.
    tell: bool,
    buffer: [u16; BUFFER],
    colour: PhantomData<C>,
}

impl<C> fmt::Debug for Sink<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sink").field("size", &self.size).field("calls", &self.calls).finish_non_exhaustive()
    }
}

impl<'m, C: Colour> Sink<'m, C> {
    fn new(machine: &'m mut dyn Machine, size: Size, tell: bool) -> Self {
        Self {
            machine,
            size,
            crc: CRC_32.digest(),
            calls: Calls::default(),
            spent: 0,
            since: 0,
            tell,
            buffer: [0; BUFFER],
            colour: PhantomData,
        }
    }

    #[inline(never)]
    fn resume(&mut self) {
        self.since = self.machine.instructions();
    }

    #[inline(never)]
    fn pause(&mut self) {
        let now = self.machine.instructions();
        self.spent += u64::from(now.wrapping_sub(self.since));
    }

    /// Takes the first `count` colours of the buffer in, the pixels of `area` from `offset` on.
    #[inline(never)]
    fn take_in(&mut self, area: Rectangle, offset: usize, count: usize) {
        self.pause();
        for word in [area.top_left.x as u32, area.top_left.y as u32, area.size.width] {
            self.crc.update(&word.to_le_bytes());
        }
        let pixels = self.buffer.get(..count).unwrap_or(&[]);
        for value in pixels {
            self.crc.update(&value.to_le_bytes());
        }
        if self.tell {
            self.machine.pixels(area, offset, pixels);
        }
        self.resume();
    }

    /// Takes `count` points in: column, row and colour of each.
    #[inline(never)]
    fn take_in_points(&mut self, count: usize) {
        self.pause();
        for point in self.buffer.get(..3 * count).unwrap_or(&[]).chunks_exact(3) {
            for value in point {
                self.crc.update(&value.to_le_bytes());
            }
            if let ([x, y, value], true) = (point, self.tell) {
                let area = Rectangle::new(Point::new(i32::from(*x), i32::from(*y)), Size::new(1, 1));
                self.machine.pixels(area, 0, core::slice::from_ref(value));
            }
        }
        self.resume();
    }

    /// The same calls as `calls`, of the mean length, with nothing to compute.
    fn repeat(&mut self, calls: Calls) {
        let colour = black_box(C::from(BinaryColor::Off));
        self.resume();
        if let Some(length) = calls.row_pixels.checked_div(calls.rows) {
            let width = u64::from(self.size.width).min(length);
            let height = length.checked_div(width).unwrap_or(0);
            let area = Rectangle::new(Point::zero(), Size::new(width as u32, height as u32));
            for _ in 0..calls.rows {
                let Ok(()) = self.fill_contiguous(&area, core::iter::repeat_with(|| black_box(colour)));
            }
        }
        if let Some(length) = calls.points.checked_div(calls.batches) {
            for _ in 0..calls.batches {
                let points = (0..length).map(|_| Pixel(black_box(Point::zero()), black_box(colour)));
                let Ok(()) = self.draw_iter(points);
            }
        }
        self.pause();
    }
}

impl<C> OriginDimensions for Sink<'_, C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: Colour> DrawTarget for Sink<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let mut count = 0;
        self.calls.batches += 1;
        for Pixel(point, colour) in pixels {
            let (x, y) = (point.x as u32, point.y as u32);
            if x >= self.size.width || y >= self.size.height {
                continue;
            }
            if let Some([column, row, value]) = self.buffer.get_mut(3 * count..3 * count + 3) {
                (*column, *row, *value) = (x as u16, y as u16, colour.into_storage().into());
            }
            count += 1;
            if count == BUFFER / 3 {
                self.calls.points += count as u64;
                self.take_in_points(count);
                count = 0;
            }
        }
        self.calls.points += count as u64;
        self.take_in_points(count);
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        let visible = area.intersection(&self.bounding_box());
        if visible != *area {
            return self.draw_iter(area.points().zip(colours).map(|(p, c)| Pixel(p, c)));
        }
        let mut colours = colours.into_iter();
        let total = area.size.width as usize * area.size.height as usize;
        let mut offset = 0;
        self.calls.rows += 1;
        self.calls.row_pixels += total as u64;
        while offset < total {
            let chunk = BUFFER.min(total - offset);
            let mut count = 0;
            for (slot, colour) in self.buffer.iter_mut().take(chunk).zip(colours.by_ref()) {
                *slot = colour.into_storage().into();
                count += 1;
            }
            self.take_in(*area, offset, count);
            if count < chunk {
                break;
            }
            offset += chunk;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Blind;
    use embedded_graphics::prelude::*;
    use embedded_graphics::primitives::{Line, PrimitiveStyle};

    struct Half;

    impl Machine for Half {
        fn instructions(&mut self) -> u32 {
            0
        }
        fn ram_free(&mut self) -> usize {
            1000
        }
    }

    #[test]
    fn a_scene_that_does_not_fit_is_refused_with_the_bytes_it_needs() {
        let mut half = Half;
        let mut stage = Stage::new(&mut half, Size::new(8, 8));
        assert_eq!(stage.claim(750), Ok(()));
        let refused = stage.claim(751);
        assert_eq!(refused, Err(Failure::Ram { needed: 751, free: 750 }));
        assert!(std::format!("{}", refused.unwrap_err()).contains("751 bytes"));
    }

    #[test]
    fn one_pixel_more_or_elsewhere_changes_the_checksum() {
        let sum = |to: Point| {
            let mut blind = Blind;
            let mut stage = Stage::new(&mut blind, Size::new(32, 32));
            let style = PrimitiveStyle::with_stroke(BinaryColor::On, 1);
            stage.show(&Line::new(Point::zero(), to).into_styled(style), 0).unwrap();
            (stage.outcome().pixels, stage.outcome().crc32)
        };
        let (pixels, crc) = sum(Point::new(9, 3));
        assert_eq!(pixels, 10);
        assert_ne!(crc, sum(Point::new(10, 3)).1);
        assert_ne!(crc, sum(Point::new(9, 4)).1);
        assert_eq!(crc, sum(Point::new(9, 3)).1);
    }
}
