//! Flash taken by the decoder of images by sweeps, and its picture on a display; the stack of all it calls.
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

static ITERATED: &[u8] = include_bytes!("../../../../tests/vectors/version-2/iterated.atfi");

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

fn draw() -> Result<(), attractor::Error> {
    let mut memory = [0_u8; 10_240];
    // where it is returned to: moved, it would be on the stack twice
    let mut sweeps = open(bb(ITERATED).iter().copied())?.sweeps(bb(0), &mut memory);
    let sweeps = sweeps.as_mut().map_err(|error| *error)?;
    sweeps.sweep()?;
    sweeps.finish()?;
    let picture = Picture::<_, _, Rgb565>::new(Luma(sweeps.picture()), Grey);
    let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut Wire::new());
    Ok(())
}
