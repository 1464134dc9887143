//! `kind = "patch-surface"`: heights over a square, refined by a patch, a product of curves or a lattice.

use std::convert::Infallible;

use attractor::Error;
use attractor::num::{Near, Real, Rgb, Vec3};
use attractor::patch::{Scheme as Refining, Sheet};
use attractor::trace::world::Lamp;
use attractor_gallery::{PatchSurfacePicture, Watch};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::motion::Motion;
use super::orbit::Orbit;
use super::request::Request;
use super::standpoint::{Eye, Standpoint, camera, vector};
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::reconstruction::family::Family;
use crate::reconstruction::scheme::Scheme;
use crate::reconstruction::table::Table;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    model: Family,
    cells: Option<Spanned<u32>>,
    numbers: Spanned<Vec<Num>>,
    heights: Spanned<Vec<Num>>,
    height: Option<Num>,
    camera: Spanned<Eye>,
    light: Option<Light>,
    samples: Option<Spanned<u8>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Light {
    direction: Spanned<[Num; 3]>,
}

/// A surface ready to be drawn.
#[derive(Debug)]
pub(crate) struct PatchSurfaceScene {
    pub(crate) family: Family,
    pub(crate) numbers: Vec<Near>,
    pub(crate) heights: Vec<Real>,
    pub(crate) cells: u32,
    /// How high 1 is, where the square is from -1 to 1.
    pub(crate) height: Real,
    scheme: Scheme,
    pub(crate) view: Standpoint,
    orbit: Option<Orbit>,
    pub(crate) sun: Vec3,
    pub(crate) samples: u8,
    place: Place,
}

impl PatchSurfaceScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let list = |all: &Spanned<Vec<Num>>, key: &str| -> Result<Vec<Real>, Fail> {
            all.get_ref().iter().enumerate().map(|(k, n)| source.fixed(n, &format!("{key}[{k}]"))).collect()
        };
        let numbers = file.numbers.get_ref().iter().enumerate();
        let numbers = numbers.map(|(k, n)| source.fixed::<Near>(n, &format!("numbers[{k}]")));
        let numbers: Vec<Near> = numbers.collect::<Result<_, Fail>>()?;
        let heights = list(&file.heights, "heights")?;
        let family = file.model;
        let scheme = Scheme::new(family, &numbers)
            .map_err(|error| source.fail(file.numbers.span(), "numbers", error))?;
        let cells = file.cells.as_ref().map_or(1, |cells| *cells.get_ref());
        scheme.check(&heights, cells).map_err(|error| match (&error, &file.cells) {
            (Error::OutOfRange { what: "cells along a side", .. }, Some(cells)) => {
                source.fail(cells.span(), "cells", error)
            }
            _ => source.fail(file.heights.span(), "heights", error),
        })?;
        let height = match &file.height {
            Some(height) => source.fixed(height, "height")?,
            None => Real::ONE / 2,
        };
        let (_, view, orbit) = camera(source, &file.camera)?;
        let sun = match &file.light {
            Some(light) => vector(source, &light.direction, "light.direction")?,
            None => Vec3::new(Real::from_num(-3), Real::from_num(-1), Real::from_num(4)),
        };
        Lamp::distant(sun, Rgb::WHITE).map_err(|error| {
            let span = file.light.as_ref().map_or(0..0, |light| light.direction.span());
            source.fail(span, "light.direction", error)
        })?;
        let samples = file.samples.as_ref().map_or(1, |samples| *samples.get_ref());
        if let Some(given) = file.samples.as_ref().filter(|samples| !(1..=8).contains(samples.get_ref())) {
            return Err(source.fail(given.span(), "samples", "allowed is 1 to 8"));
        }
        let place = source.place(file.heights.span(), "heights");
        let scene =
            Self { family, numbers, heights, cells, height, scheme, view, orbit, sun, samples, place };
        scene.with(&mut Check).map_err(|error| source.fail(file.heights.span(), "heights", error))?;
        Ok(scene)
    }

    /// Hands the picture to somebody who takes one of any scheme.
    fn with(&self, show: &mut impl Show) -> Result<(), Error> {
        match &self.scheme {
            Scheme::Standard(scheme) => show.show(&self.picture(&**scheme)?),
            Scheme::Tensor(scheme) => show.show(&self.picture(&**scheme)?),
            Scheme::Lattice(scheme) => show.show(&self.picture(&**scheme)?),
        }
    }

    fn picture<'a, S: Refining<J>, const J: usize>(
        &'a self,
        scheme: &'a S,
    ) -> Result<PatchSurfacePicture<'a, S, J>, Error> {
        let sheet = Sheet::new(scheme, &self.heights, self.cells)?;
        let Self { height, view, sun, samples, .. } = *self;
        Ok(PatchSurfacePicture { sheet, height, view, sun, samples })
    }

    /// Moves the camera round what it looks at; the message says why not.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        let Some(orbit) = &self.orbit else {
            return Err(Fail::new("the camera moves about only where z is up"));
        };
        let orbit = orbit.after(motion, size);
        let [x, y, z] = orbit.eye().map(Real::saturating_from_num);
        self.view.eye = Vec3::new(x, y, z);
        self.orbit = Some(orbit);
        Ok(())
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self) -> Option<String> {
        self.orbit.as_ref().map(Orbit::place)
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        self.with(&mut Draw { request, target, watch })
            .map_err(|error| self.place.fail_at(request.size, error))
    }

    /// `x,y,height,reference` on a grid of about so many points.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let side = f64::from(points).sqrt();
        let levels = (0..8).take_while(|levels| f64::from(self.cells << levels) < side).last().unwrap_or(0);
        let table = self.scheme.tabulated(&self.heights, self.cells, levels).map_err(Fail::new)?;
        let numbers: Vec<f64> = self.numbers.iter().map(|n| n.to_num()).collect();
        let exact_weights = Table::new(self.family, &numbers, levels, false);
        let (width, step) = self.family.cell();
        let across = self.family.side(self.cells as usize);
        out.write_record(["x", "y", "height", "reference"])?;
        let last = (self.cells << levels) as usize;
        for (k, height) in table.iter().enumerate() {
            let place = [k / (last + 1), k % (last + 1)];
            let [ci, cj] = place.map(|place| (place >> levels).min(self.cells as usize - 1));
            let weights = exact_weights.weights(place[0] - (ci << levels), place[1] - (cj << levels));
            let own = |k: usize| {
                self.heights[(ci * step + k / width) * across + cj * step + k % width].to_num::<f64>()
            };
            let reference: f64 = weights.iter().enumerate().map(|(k, weight)| weight * own(k)).sum();
            let [x, y] = place.map(|place| (place as f64 / last as f64).to_string());
            out.write_record([x, y, exact(*height), format!("{reference:?}")])?;
        }
        Ok(())
    }
}

/// What is done with a picture, whatever its scheme.
trait Show {
    fn show<S: Refining<J>, const J: usize>(
        &mut self,
        picture: &PatchSurfacePicture<'_, S, J>,
    ) -> Result<(), Error>;
}

/// Whether there is one.
struct Check;

impl Show for Check {
    fn show<S: Refining<J>, const J: usize>(
        &mut self,
        picture: &PatchSurfacePicture<'_, S, J>,
    ) -> Result<(), Error> {
        picture.surface(Size::new(8, 8)).map(drop)
    }
}

struct Draw<'a, 'b, D> {
    request: &'a Request,
    target: &'a mut D,
    watch: Watch<'b, D>,
}

impl<D> Show for Draw<'_, '_, D>
where
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    fn show<S: Refining<J>, const J: usize>(
        &mut self,
        picture: &PatchSurfacePicture<'_, S, J>,
    ) -> Result<(), Error> {
        let Request { size, seed, .. } = *self.request;
        picture.draw((size, seed as u32), self.target, &mut *self.watch)
    }
}
