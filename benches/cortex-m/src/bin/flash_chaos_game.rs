//! Flash taken by the chaos game, the fern and the drawing of points.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::Dots;
use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::plane::Window;
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

fn draw() -> Result<(), attractor::Error> {
    let fern = BARNSLEY_FERN.ifs::<4>()?;
    let window = Window::fit(fern.bounds(), Wire::<Rgb565>::SIZE)?;
    let points = fern.seeded_chaos_game(bb(1)).take(bb(1000));
    let Ok(_) = Dots::new(points, window, Rgb565::WHITE).draw(&mut Wire::new());
    Ok(())
}
