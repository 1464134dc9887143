//! A surface by control points: heights over a square, matt, under a sun and a sky.

use attractor::Error;
use attractor::draw::Srgb;
use attractor::num::{Affine3, Lumen, Real, Rgb, Unit, Vec3};
use attractor::patch::{Scheme, Sheet};
use attractor::trace::material::Mixture;
use attractor::trace::solid::Moved;
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, PatchSurface, Sampling, Sky};
use embedded_graphics::geometry::Size;

use crate::page::{Display, Watch, draw_field};

/// The deepest level that core goes down to.
const DEEPEST: u32 = 12;

/// Of the square.
const COLOR: Rgb = color("0.69", "0.62", "0.52");

/// How much of its colour it shows in the shade, and how much in the light.
const PARTS: (Unit, Unit) = (Unit::lit("0.12"), Unit::lit("0.88"));

const SKY: Sky = Sky {
    zenith: color("0.02", "0.03", "0.07"),
    horizon: color("0.21", "0.26", "0.34"),
    nadir: color("0.05", "0.05", "0.04"),
};

const fn color(r: &str, g: &str, b: &str) -> Rgb {
    Rgb::new(Lumen::lit(r), Lumen::lit(g), Lumen::lit(b))
}

/// Where a camera stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Standpoint {
    /// Where the eye is.
    pub eye: Vec3,
    /// What it looks at.
    pub look_at: Vec3,
    /// What is up.
    pub up: Vec3,
    /// The vertical angle of view, degrees.
    pub field_of_view: Real,
}

/// A surface by control points ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct PatchSurfacePicture<'a, S, const J: usize> {
    /// What refines the heights, and the heights.
    pub sheet: Sheet<'a, S, J>,
    /// How high 1 is, where the square is from -1 to 1.
    pub height: Real,
    /// The camera.
    pub view: Standpoint,
    /// Towards the sun.
    pub sun: Vec3,
    /// Samples a side of a pixel.
    pub samples: u8,
}

impl<S: Scheme<J>, const J: usize> PatchSurfacePicture<'_, S, J> {
    /// The surface with parts as small as a pixel where its square fills the display, from -1 to 1.
    ///
    /// # Errors
    /// Those of [`PatchSurface::new`] and [`Moved::new`].
    pub fn surface(&self, size: Size) -> Result<Moved<PatchSurface<'_, S, J>>, Error> {
        let (side, cells) = (size.width.max(size.height), self.sheet.cells());
        let parts = |depth: &u32| S::BASE.saturating_pow(*depth).saturating_mul(cells);
        let depth = (0..DEEPEST).find(|depth| parts(depth) >= side).unwrap_or(DEEPEST);
        let two = Real::ONE * 2;
        let map = Affine3::scale(Vec3::new(two, two, self.height)).then(&Affine3::translate(Vec3::new(
            -Real::ONE,
            -Real::ONE,
            Real::ZERO,
        )));
        Moved::new(PatchSurface::new(self.sheet, depth)?, &map)
    }

    /// Draws it; `seed` is that of the samples.
    ///
    /// # Errors
    /// Those of [`PatchSurfacePicture::surface`], of the camera and the lamp.
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u32),
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let leaves = [Leaf { surface: self.surface(size)?, materials: &[0] }];
        let mut boxes = [Extent::NOTHING; Object::extents(1)];
        let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
        let objects = [Object::new(&[Op::Leaf(0)], surface, &mut boxes)?];
        let materials = [Mixture::matt(COLOR).with_parts(PARTS.0, PARTS.1)?];
        let lamps = [Lamp::distant(self.sun, Rgb::WHITE)?];
        let world = World::new(&leaves, &objects, &materials)?.with_lamps(&lamps);
        let sampling = match self.samples {
            1 => Sampling::Centre,
            n => Sampling::Jittered { n, seed },
        };
        let Standpoint { eye, look_at, up, field_of_view } = self.view;
        let camera = Camera::new(eye, look_at, up, field_of_view)?;
        let caster = WorldCaster::<_, _, _, 16, 3>::new(world, SKY, camera, size)?
            .with_sampling(sampling, Filter::Box)?
            .with_depth(1)?;
        draw_field(&caster, Srgb, target, watch);
        Ok(())
    }
}
