//! Flash taken by the picture of a sphere on a plane: colours, a lamp, shadows and a reflection.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::{Picture, Srgb};
use attractor::num::{Affine3, Lumen, Real, Rgb, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Environment, Extent};
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    semihosting::process::exit(i32::from(draw().is_err()))
}

attractor::surfaces! {
    /// What this world is made of.
    enum Thing {
        Sphere(Placed<Sphere>),
        Plane(Placed<Plane>),
    }
}

fn draw() -> Result<(), attractor::Error> {
    let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let plane = Placed::new(Plane, &Affine3::translate(bb(at(0, 0, -1))))?;
    let sphere = Placed::new(Sphere, &Affine3::translate(bb(at(0, 0, 0))))?;
    let leaves = [
        Leaf { surface: Thing::Sphere(sphere), materials: &[0] },
        Leaf { surface: Thing::Plane(plane), materials: &[1] },
    ];
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let mut memory = [Extent::NOTHING; 2];
    let [one, other] = &mut memory;
    let objects = [
        Object::new(&[Op::Leaf(0)], surface, core::slice::from_mut(one))?,
        Object::new(&[Op::Leaf(1)], surface, core::slice::from_mut(other))?,
    ];
    const ORANGE: Rgb = Rgb::new(Lumen::lit("1"), Lumen::lit("0.4"), Lumen::lit("0.05"));
    const GREY: Rgb = Rgb::grey(Lumen::lit("0.4"));
    let shiny = Mixture::matt(ORANGE).with_highlight(Rgb::WHITE, Phong { shininess: 40 });
    let mirrored = Mixture::matt(GREY).with_highlight(Rgb::BLACK, Phong { shininess: 1 });
    let materials = [shiny, mirrored.with_reflection(bb(GREY))];
    let lamps = [Lamp::distant(bb(at(1, -2, 3)), Rgb::WHITE)?];
    let world = World::new(&leaves, &objects, &materials)?.with_lamps(&lamps);
    let camera = Camera::new(bb(at(3, -4, 2)), bb(at(0, 0, 0)), at(0, 0, 1), bb(Real::from_num(32)))?;
    let caster = WorldCaster::<_, _, _, 4, 4>::new(world, Environment::SKY, camera, Wire::<Rgb565>::SIZE)?;
    let picture = Picture::<_, _, Rgb565>::new(caster, Srgb);
    let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut Wire::new());
    Ok(())
}
