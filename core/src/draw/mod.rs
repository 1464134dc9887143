//! From values to pixels: points, paths and fields on any `embedded-graphics` display.
//!
#![doc = include_str!("../../docs/draw.md")]
//!
//! | picture | drawn by | how |
//! | --- | --- | --- |
//! | points | [`Dots`], [`ColoredDots`] | `draw_iter` |
//! | path | [`Stroke`] | clipped, then `draw_iter` |
//! | field | [`Picture`] | one `fill_contiguous` a row, no buffer |
//! | field, for a driver of one's own | [`Strips`] | a lent line buffer: colours, big-endian bytes, packed bits |
//!
//! Colour has two halves. A [`Palette`] turns a value into a display-independent colour, [`Ink`] turns that colour into what one display
//! can show at one position: the nearest colour, or ordered dithering where there are few levels. Both are open: a closure is a
//! palette, and a colour type of your own becomes usable with one `impl Ink`.
//!
//! ```
//! use attractor::draw::{Grey, Picture};
//! use attractor::picture::Field;
//! use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
//!
//! /// Dark on the left, bright on the right.
//! struct Wedge;
//!
//! impl Field for Wedge {
//!     type Value = u8;
//!     type Row<'a> = core::iter::Map<core::ops::Range<u32>, fn(u32) -> u8>;
//!     fn size(&self) -> Size {
//!         Size::new(8, 4)
//!     }
//!     fn row(&self, _y: u32, x: core::ops::Range<u32>) -> Self::Row<'_> {
//!         x.map(|x| (x * 36) as u8)
//!     }
//! }
//!
//! let mut display = MockDisplay::<BinaryColor>::new();
//! let picture = Picture::new(Wedge, Grey);
//! Image::new(&picture, Point::zero()).draw(&mut display)?;
//! display.assert_pattern(&[
//!     "..#.####",
//!     "...#.#.#",
//!     "..#.#.##",
//!     "...#.#.#",
//! ]);
//! # Ok::<(), core::convert::Infallible>(())
//! ```

mod clip;
mod cursor;
mod cycle;
mod equalised;
mod gradient;
pub mod gradients;
mod image;
mod ink;
mod level;
mod line;
mod packing;
mod palette;
mod path;
mod points;
mod rows;
#[cfg(test)]
mod testing;

pub use cursor::RowCursor;
pub use cycle::{Cycled, Ramp};
pub use equalised::Equalised;
pub use gradient::Gradient;
pub use image::{Colors, Picture};
pub use ink::{Ink, bayer, dithered, luma};
pub use level::{Level, Leveled};
pub use packing::{BigEndian, Lines, LsbPages, MsbRows, Packing};
pub use palette::{CourseUnit, Grey, Inside, Lifted, Palette, hex};
pub use path::Stroke;
pub use points::{ColoredDots, Dots};
pub use rows::Strips;
