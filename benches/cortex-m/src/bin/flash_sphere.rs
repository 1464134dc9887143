//! Flash taken by the picture of a sphere on a plane: colours, a lamp, shadows and a reflection.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::{Picture, Srgb};
use attractor::num::{Affine3, Lumen, Real, Rgb, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere};
use attractor::trace::world::{Lamp, Leaf, Object, World, WorldCaster};
use attractor::trace::{Camera, Sky};
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
    const SPHERE: Placed<Sphere> = match Placed::sphere(&Affine3::IDENTITY) {
        Ok(sphere) => sphere,
        Err(_) => panic!("no such place"),
    };
    const PLANE: Placed<Plane> = match Placed::plane(&Affine3::translate(Vec3::lit("0", "0", "-1"))) {
        Ok(plane) => plane,
        Err(_) => panic!("no such place"),
    };
    static LEAVES: [Leaf<'static, Thing>; 2] = [
        Leaf { surface: Thing::Sphere(SPHERE), materials: &[0] },
        Leaf { surface: Thing::Plane(PLANE), materials: &[1] },
    ];
    let leaves = bb(&LEAVES);
    let objects = [0, 1].map(|number: u8| Object::leaf(number, &leaves[usize::from(number)].surface));
    const ORANGE: Rgb = Rgb::new(Lumen::lit("1"), Lumen::lit("0.4"), Lumen::lit("0.05"));
    const SKY: Sky = Sky {
        zenith: Rgb::new(Lumen::lit("0.1"), Lumen::lit("0.3"), Lumen::lit("0.8")),
        horizon: Rgb::grey(Lumen::lit("0.8")),
        nadir: Rgb::grey(Lumen::lit("0.2")),
    };
    const GREY: Rgb = Rgb::grey(Lumen::lit("0.4"));
    let shiny = Mixture::matt(ORANGE).with_highlight(Rgb::WHITE, Phong { shininess: 40 });
    let mirrored = Mixture::matt(GREY).with_highlight(Rgb::BLACK, Phong { shininess: 1 });
    let materials = [shiny, mirrored.with_reflection(bb(GREY))];
    let lamps = [Lamp::distant(bb(at(1, -2, 3)), Rgb::WHITE)?];
    let world = World::of_leaves(leaves, &objects, &materials)?.with_lamps(&lamps);
    let camera = Camera::new(bb(at(3, -4, 2)), bb(at(0, 0, 0)), at(0, 0, 1), bb(Real::from_num(32)))?;
    let caster = WorldCaster::<_, _, _, 4, 4, false>::new(world, SKY, camera, Wire::<Rgb565>::SIZE)?;
    let picture = Picture::<_, _, Rgb565>::new(caster, Srgb);
    let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut Wire::new());
    Ok(())
}
