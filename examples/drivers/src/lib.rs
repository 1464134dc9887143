//! Fractals on displays, driver by driver: what to write in firmware, with the drivers as they are published.
//!
//! | file | driver | display | what it shows |
//! | --- | --- | --- | --- |
//! | `src/ssd1306.rs` | `ssd1306` 0.10 | OLED, 128 x 64, I2C, one bit | points: the fern |
//! | `src/mipidsi.rs` | `mipidsi` 0.10 | ST7789, 240 x 240, SPI, 16 bits | a field: the Mandelbrot set, without any framebuffer |
//! | `src/epd_waveshare.rs` | `epd-waveshare` 0.6 | e-paper, 128 x 296, SPI, one bit | a field in dithered greys: a Julia set |
//!
//! Each file is complete: `draw` makes the picture on any display of its colour, `show` takes the bus and the
//! pins of your board, whatever implements `embedded-hal` 1.0. `tests/received.rs` runs them all and compares
//! what the display received over its bus with the simulator's picture; `cargo xtask drivers` compiles them
//! for a Cortex-M4. These versions resolve together with `fixed` 1.29 and `embedded-graphics` 0.8.2.
#![no_std]

pub mod epd_waveshare;
pub mod mipidsi;
pub mod nothing;
pub mod ssd1306;

/// What can go wrong: a description of ours, or the display.
#[derive(Debug)]
pub enum Failure<E> {
    /// A picture that cannot be made.
    Picture(attractor::Error),
    /// A display that does not answer.
    Display(E),
}

impl<E> From<attractor::Error> for Failure<E> {
    fn from(error: attractor::Error) -> Self {
        Self::Picture(error)
    }
}

/// All went well, or what went wrong.
pub type Outcome<E> = Result<(), Failure<E>>;
