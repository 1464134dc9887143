//! Flash taken by a fractal interpolation function and the drawing of its graph.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::Stroke;
use attractor::fif::{Fif, Knot};
use attractor::num::{Real, Scaling, Wide};
use attractor::picture::{Bounds2, Point2, Window};
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

fn draw() -> Result<(), attractor::Error> {
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let f = Fif::<2, 1>::interpolating(&bb(knots), &bb([Scaling::from_bits(1 << 30); 2]))?;
    let (low, high) = f.range();
    let at = |x, y| Point2::new(Real::from_bits(x), y);
    let window = Window::stretch(Bounds2 { min: at(0, low), max: at(1 << 24, high) }, Wire::<Rgb565>::SIZE)?;
    let Ok(_) = Stroke::new(f.graph(bb(240)), window, Rgb565::WHITE).draw(&mut Wire::new());
    Ok(())
}
