//! A lattice as a height field in one colour scale: matt, shiny or a mirror of its surroundings.

use attractor::Error;
use attractor::draw::Palette;
use attractor::num::Vec3;
use attractor::patch::{Mask, Sheet, SlopeMoments};
use attractor::plane::Tone;
use attractor::trace::{
    Camera, Environment, Filter, FilteredPatch, Finish, Light, PatchCaster, PatchSurface, Quality, Sampling,
};
use embedded_graphics::geometry::Size;

use crate::page::{Display, Watch, draw_field};
use crate::patch_surface::Standpoint;

/// The deepest level that core goes down to.
const DEEPEST: u32 = 12;

/// A lattice over the unit square ready to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct LatticePicture<'a, P> {
    /// The mask and the heights, which are as they are.
    pub sheet: Sheet<'a, Mask, 16>,
    /// The camera.
    pub view: Standpoint,
    /// What it is made of.
    pub material: Finish,
    /// What surrounds it.
    pub environment: Environment,
    /// Towards the light, if it is not the ordinary one.
    pub light: Option<Vec3>,
    /// Samples a side of a pixel.
    pub samples: u8,
    /// How fine the normals of a pixel are integrated, if they are.
    pub quality: Option<Quality>,
    /// Its colours.
    pub palette: P,
}

impl<P: Copy> LatticePicture<'_, P> {
    /// The picture by samples; `seed` is that of the samples.
    ///
    /// # Errors
    /// Those of [`PatchSurface::new`], of the camera and [`PatchCaster`].
    pub fn caster(&self, size: Size, seed: u32) -> Result<PatchCaster<'_, Mask, 16>, Error> {
        let (side, cells) = (size.width.max(size.height), self.sheet.cells());
        // parts as small as a sample
        let wanted = side.saturating_mul(self.samples.into());
        let depth = (0..DEEPEST).find(|depth| cells << depth >= wanted).unwrap_or(DEEPEST);
        let Standpoint { eye, look_at, up, field_of_view } = self.view;
        let camera = Camera::new(eye, look_at, up, field_of_view)?;
        let sampling = match self.samples {
            1 => Sampling::Centre,
            n => Sampling::Jittered { n, seed },
        };
        let caster = PatchCaster::new(PatchSurface::new(self.sheet, depth)?, camera, size)?
            .with_finish(self.material)?
            .with_environment(self.environment)?
            .with_sampling(sampling, Filter::Box)?;
        Ok(match self.light {
            Some(light) => caster.with_light(Light::new(light)?),
            None => caster,
        })
    }

    /// Draws it; `seed` is that of the samples.
    ///
    /// # Errors
    /// Those of [`LatticePicture::caster`]; where normals are integrated, those of [`SlopeMoments::new`].
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u32),
        mask: &Mask,
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> Result<(), Error>
    where
        P: Palette<Tone>,
    {
        let caster = self.caster(size, seed)?;
        match self.quality {
            None => draw_field(&caster, self.palette, target, watch),
            Some(quality) => {
                let moments = SlopeMoments::new(mask)?;
                draw_field(&FilteredPatch::new(caster, &moments, quality), self.palette, target, watch)
            }
        };
        Ok(())
    }
}
