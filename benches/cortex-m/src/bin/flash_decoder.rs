//! Flash taken by the decoder of images in one pass, and its stream on a display.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::codec::{Luma, open};
use attractor::draw::{Grey, Picture};
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

static FLAT: &[u8] = include_bytes!("../../../../tests/vectors/version-2/flat-8.atfi");

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

fn draw() -> Result<(), attractor::Error> {
    let mut memory = [0_u8; 13_760];
    let mut stream = open(bb(FLAT).iter().copied())?.stream(0, &mut memory)?;
    while let Some(band) = stream.next_band()? {
        let picture = Picture::<_, _, Rgb565>::new(Luma(band), Grey);
        let Ok(()) = Image::new(&picture, Point::new(0, band.top() as i32)).draw(&mut Wire::new());
    }
    Ok(())
}
