//! A scene of the table: what it is called, how large it is, and what shows it.

use embedded_graphics::geometry::Size;

use crate::machine::Machine;
use crate::sink::{Failure, Outcome, Stage};

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
    pub show: Show,
}

pub(crate) type Show = fn(&mut Stage<'_>) -> Result<(), Failure>;

/// The usual displays.
pub(crate) const COLOUR: Size = Size::new(240, 240);
pub(crate) const MONO: Size = Size::new(128, 64);

pub(crate) const fn colour(name: &'static str, show: Show) -> Scene {
    Scene { name, size: COLOUR, bits: 16, small: true, show }
}

pub(crate) const fn mono(name: &'static str, show: Show) -> Scene {
    Scene { name, size: MONO, bits: 1, small: true, show }
}

/// For machines with more than 16 KiB of RAM.
pub(crate) const fn roomy(scene: Scene) -> Scene {
    Scene { small: false, ..scene }
}

impl Scene {
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
