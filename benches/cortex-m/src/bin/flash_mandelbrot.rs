//! Flash taken by the Mandelbrot set, a palette and the drawing of fields.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::{CourseUnit, Picture};
use attractor::escape::{Mandelbrot, View};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

fn draw() -> Result<(), attractor::Error> {
    let centre = Complex::new(bb(Wide::ZERO), bb(Wide::ZERO));
    let view = View::new(centre, bb(Wide::ONE), Wire::<Rgb565>::SIZE)?;
    let picture = Picture::<_, _, Rgb565>::new(Mandelbrot::new(view, bb(100))?, CourseUnit);
    let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut Wire::new());
    Ok(())
}
