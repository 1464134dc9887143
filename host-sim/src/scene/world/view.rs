//! A world ready to be drawn.

use std::convert::Infallible;
use std::io::Write;

use attractor_gallery::Watch;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;

use super::super::motion::Motion;
use super::super::orbit::Orbit;
use super::super::request::Request;
use super::file::Description;
use crate::color::Depth;
use crate::fail::Fail;
use crate::source::Source;

/// A world, and where it is seen from.
#[derive(Debug)]
pub(crate) struct WorldScene {
    pub(crate) world: Description,
}

impl WorldScene {
    pub(in crate::scene) fn load(source: &Source) -> Result<Self, Fail> {
        Ok(Self { world: Description::load(source)? })
    }

    /// Moves the camera round what it looks at; the message says why not.
    pub(in crate::scene) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        let Some(orbit) = &self.world.orbit else {
            return Err(Fail::new("the camera moves about only where z is up"));
        };
        let orbit = orbit.after(motion, size);
        self.world.camera = orbit.camera()?;
        self.world.orbit = Some(orbit);
        Ok(())
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(in crate::scene) fn place(&self) -> Option<String> {
        self.world.orbit.as_ref().map(Orbit::place)
    }

    pub(in crate::scene) fn draw<D>(&self, _: &Request, _: &mut D, _: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        Err(Fail::new("not yet"))
    }

    pub(in crate::scene) fn sample(&self, _: &Request, _: &mut dyn Write) -> Result<(), Fail> {
        Err(Fail::new("not yet"))
    }
}
