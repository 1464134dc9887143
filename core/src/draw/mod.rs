//! From values to pixels: points, paths and fields on any `embedded-graphics` display.
//!
#![doc = include_str!("../../docs/draw.md")]
//!
//! | picture | drawn by | how |
//! | --- | --- | --- |
//! | points | [`Dots`], [`ColoredDots`] | `draw_iter`; a portion a tick by [`Dots::draw_once`] |
//! | path | [`Stroke`] | clipped, then `draw_iter` |
//! | field | [`Picture`] | one `fill_contiguous` a row, no buffer; a row a tick by [`RowCursor`] |
//! | field, symmetric in a row | [`Mirrored`] | the same rows, one of each pair computed, in a lent row |
//! | field, for a driver of one's own | [`Strips`] | a lent line buffer: colours, bytes, words, packed bits |
//!
//! Colour has two halves. A [`Palette`] turns a value into a display-independent colour, [`Ink`] turns that
//! colour into what one display can show at one position: the nearest colour, or ordered dithering where
//! there are few levels; a palette may ask for dithering everywhere ([`Dithered`]), and that of pictures in
//! colour, [`Srgb`], does. Both are open: a closure is a palette, and a colour type of your own becomes
//! usable with one `impl Ink`.
//!
//! ```
//! use attractor::draw::{Grey, Picture};
//! use attractor::plane::from_fn;
//! use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
//!
//! // dark on the left, bright on the right
//! let wedge = from_fn(Size::new(8, 4), |x, _y| (x * 36) as u8);
//! let mut display = MockDisplay::<BinaryColor>::new();
//! let picture = Picture::new(wedge, Grey);
//! Image::new(&picture, Point::zero()).draw(&mut display)?;
//! display.assert_pattern(&[
//!     "..#.####",
//!     "...#.#.#",
//!     "..#.#.##",
//!     "...#.#.#",
//! ]);
//! # Ok::<(), core::convert::Infallible>(())
//! ```
//!
//! # On a display
//!
//! | display | colour | palette and packing |
//! | --- | --- | --- |
//! | st7789, ili9341, gc9a01, ssd1351 | `Rgb565`, `Rgb666` | any palette; [`PixelBytes`], [`PixelWords`] |
//! | ssd1306, sh1106 (one bit) | `BinaryColor` | [`Luminance`] for the right brightness, or [`Contrast`]; [`LsbPages`] |
//! | Sharp memory LCD (one bit) | `BinaryColor` | [`Luminance`]; [`MsbRows`] |
//! | e-paper whose `On` is black | `BinaryColor` | [`Inverted`]`(`[`Luminance`]`(..))`; [`MsbRows`] |
//! | e-paper with a driver's own colours | a newtype | [`Ink`] says how |
//! | ssd1322, e-paper with 4 greys | `Gray4`, `Gray2` | any palette; [`MsbRows`] |

mod by_reference;
mod clip;
mod contrast;
mod cursor;
mod cycle;
mod dither;
mod equalised;
mod gradient;
pub mod gradients;
mod image;
mod ink;
mod level;
mod line;
mod mirrored;
mod mono;
mod packing;
mod palette;
mod path;
mod points;
mod rows;
mod srgb;
#[cfg(test)]
mod testing;
#[cfg(any(test, feature = "embedded-graphics"))]
mod transform;
mod ycocg;

pub use contrast::Contrast;
pub use cursor::RowCursor;
pub use cycle::{Cycled, Ramp};
pub use dither::Dithered;
pub use equalised::Equalised;
pub use gradient::Gradient;
pub use image::Picture;
pub use ink::{Ink, bayer, dithered, luma};
pub use level::{Level, Leveled};
pub use mirrored::Mirrored;
pub use mono::{Inverted, Luminance};
pub use packing::{Lines, LsbPages, MsbRows, Packing, PixelBytes, PixelWords};
pub use palette::{Brightened, CourseUnit, Grey, Inside, Palette, hex};
pub use path::Stroke;
pub use points::{ColoredDots, Dots};
pub use rows::Strips;
pub use srgb::Srgb;
pub use ycocg::YCoCg;
