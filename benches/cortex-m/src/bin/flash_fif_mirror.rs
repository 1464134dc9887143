//! Flash taken by the picture of a fractal surface that mirrors its surroundings.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::{Picture, gradients};
use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{Real, Scaling, Vec3, Wide};
use attractor::trace::{Camera, Finish, HeightField, RayCaster};
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
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let g = Fif::<2, 1>::interpolating(&bb(knots), &bb([Scaling::from_bits(1 << 30); 2]))?;
    let g = g.integral::<2>(Wide::ZERO)?;
    let mut memory = const { [Cell::ZERO; Pyramid::cells(2, 6)] };
    let pyramid = Pyramid::new(&g, bb(6), &mut memory)?;
    let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let camera = Camera::new(bb(at(-4, -3, 5)), bb(at(1, 1, 0)), at(0, 0, 1), bb(Real::from_num(32)))?;
    let surface = HeightField::new(&pyramid, &pyramid)?;
    let caster = RayCaster::new(surface, camera, Wire::<Rgb565>::SIZE)?.with_finish(Finish::Mirror)?;
    let picture = Picture::<_, _, Rgb565>::new(caster, gradients::DUSK);
    let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut Wire::new());
    Ok(())
}
