//! Whole pictures, drawn as firmware would draw them.
//!
//! To add one: write a function that builds its objects, [claims](Stage::claim) their RAM and [shows](Stage::show) them, and add a line to
//! [`ALL`]. The function takes the size from the stage, so that one function serves several lines.

use attractor::num::{Angle, sin_cos};
use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};
use embedded_graphics::primitives::Rectangle;

use crate::Machine;
use crate::sink::{Colour, Failure, Outcome, Stage};

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Scene {
    /// What is drawn.
    pub name: &'static str,
    /// Width and height in pixels.
    pub size: Size,
    /// Bits of a pixel: 1 or 16.
    pub bits: u8,
    /// Whether it is small enough for a machine with 16 KiB of RAM.
    pub small: bool,
    /// Builds and shows it.
    pub show: fn(&mut Stage<'_>) -> Result<(), Failure>,
}

impl Scene {
    const fn colour(name: &'static str, show: fn(&mut Stage<'_>) -> Result<(), Failure>) -> Self {
        Self { name, size: Size::new(240, 240), bits: 16, small: true, show }
    }

    const fn mono(name: &'static str, show: fn(&mut Stage<'_>) -> Result<(), Failure>) -> Self {
        Self { name, size: Size::new(128, 64), bits: 1, small: true, show }
    }

    /// Builds, shows and measures the scene.
    ///
    /// # Errors
    /// What the kernel or the machine refuses.
    pub fn run(&self, machine: &mut dyn Machine) -> Result<Outcome, Failure> {
        let mut stage = Stage::new(machine, self.size);
        (self.show)(&mut stage)?;
        Ok(stage.outcome())
    }
}

/// The table. The first rows are the floor: a picture that computes nothing.
pub static ALL: &[Scene] = &[
    Scene::colour("blank", blank::<Rgb565>),
    Scene::mono("blank", blank::<BinaryColor>),
    Scene::colour("waves", waves::<Rgb565>),
    Scene::mono("waves", waves::<BinaryColor>),
];

fn blank<C: Colour>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let blank = Waves::<C> { size: stage.size(), tone: |_, _| C::from(BinaryColor::Off) };
    stage.show(&blank, size_of_val(&blank))
}

fn waves<C: Colour>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let waves = Waves {
        size: stage.size(),
        tone: |x, y| {
            let (sin, _) = sin_cos(Angle::from_bits(x.wrapping_mul(x) << 20));
            let (_, cos) = sin_cos(Angle::from_bits(y.wrapping_mul(y) << 20));
            C::from(BinaryColor::from(sin.to_bits() ^ cos.to_bits() < 0))
        },
    };
    stage.show(&waves, size_of_val(&waves))
}

/// A colour for each pixel, row by row.
struct Waves<C> {
    size: Size,
    tone: fn(u32, u32) -> C,
}

impl<C: Colour> Drawable for Waves<C> {
    type Color = C;
    type Output = ();

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        for y in 0..self.size.height {
            let row = Rectangle::new(Point::new(0, y as i32), Size::new(self.size.width, 1));
            target.fill_contiguous(&row, (0..self.size.width).map(|x| (self.tone)(x, y)))?;
        }
        Ok(())
    }
}
