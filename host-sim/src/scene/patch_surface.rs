//! `kind = "patch-surface"`: heights over a square, refined by a patch, a product of curves or a lattice.

use std::convert::Infallible;
use std::ops::Range;

use attractor::Error;
use attractor::num::{Near, Real, Rgb, Vec3};
use attractor::patch::{Mask, Scheme as Refining, Sheet, SlopeMoments};
use attractor::trace::world::Lamp;
use attractor::trace::{Environment, Filter, FilteredPatch, Finish, Quality, Sampling};
use attractor_gallery::{LatticePicture, PatchSurfacePicture, Watch};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::environment::{Around, Board, Sky, Surroundings};
use super::finish::{self, Filtering, Made, Mirrors};
use super::motion::Motion;
use super::orbit::Orbit;
use super::pixels;
use super::request::Request;
use super::standpoint::{Eye, Standpoint, camera, vector};
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
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
    material: Option<Spanned<finish::Named>>,
    #[serde(rename = "torrance-sparrow")]
    torrance_sparrow: Option<Spanned<Mirrors>>,
    environment: Option<Spanned<Around>>,
    gradient: Option<Spanned<Sky>>,
    checkerboard: Option<Spanned<Board>>,
    filter: Option<Spanned<Filtering>>,
    palette: Option<Spanned<Named>>,
    samples: Option<Spanned<u8>>,
}

/// How a lattice looks that has a material.
#[derive(Debug)]
pub(crate) struct Look {
    pub(crate) material: Finish,
    pub(crate) environment: Environment,
    /// Towards the light, if it is not the ordinary one.
    pub(crate) light: Option<Vec3>,
    pub(crate) quality: Option<Quality>,
    pub(crate) palette: Named,
}

impl File {
    /// A key that only a surface with a material understands.
    fn of_a_material(&self) -> Option<(Range<usize>, &'static str)> {
        let Self { torrance_sparrow, environment, gradient, checkerboard, filter, palette, .. } = self;
        let keys = [
            (torrance_sparrow.as_ref().map(Spanned::span), "torrance-sparrow"),
            (environment.as_ref().map(Spanned::span), "environment"),
            (gradient.as_ref().map(Spanned::span), "gradient"),
            (checkerboard.as_ref().map(Spanned::span), "checkerboard"),
            (filter.as_ref().map(Spanned::span), "filter"),
            (palette.as_ref().map(Spanned::span), "palette"),
        ];
        keys.into_iter().find_map(|(span, key)| Some((span?, key)))
    }

    /// How it looks, if it has a material.
    fn look(self, source: &Source, light: Option<Vec3>, scheme: &Scheme) -> Result<Option<Look>, Fail> {
        let Some(named) = &self.material else {
            return match self.of_a_material() {
                Some((span, key)) => Err(source.fail(span, key, "there is no material")),
                None => Ok(None),
            };
        };
        let Scheme::Lattice(mask) = scheme else {
            return Err(source.fail(named.span(), "material", "allowed is that of a lattice"));
        };
        if let Some(height) = &self.height {
            let reason = "heights of a surface with a material are as they are, over the unit square";
            return Err(source.fail(height.span(), "height", reason));
        }
        let quality = match &self.filter {
            None => None,
            Some(filter) => {
                // normals are integrated where slopes have moments
                SlopeMoments::new(mask).map_err(|error| source.fail(filter.span(), "filter", error))?;
                Some(filter.get_ref().quality())
            }
        };
        let made = Made { named: Some(*named.get_ref()), torrance_sparrow: self.torrance_sparrow };
        let (gradient, checkerboard) = (self.gradient, self.checkerboard);
        let environment =
            Surroundings { named: self.environment.map(Spanned::into_inner), gradient, checkerboard };
        Ok(Some(Look {
            material: made.compile(source)?,
            environment: environment.compile(source)?,
            light,
            quality,
            palette: self.palette.map_or(Named::Dusk, Spanned::into_inner),
        }))
    }
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
    /// In tones, over the unit square.
    pub(crate) look: Option<Look>,
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
        let light = match &file.light {
            Some(light) => Some(vector(source, &light.direction, "light.direction")?),
            None => None,
        };
        let sun = match light {
            Some(light) => light,
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
        let (place, span) = (source.place(file.heights.span(), "heights"), file.heights.span());
        let look = file.look(source, light, &scheme)?;
        let scene =
            Self { family, numbers, heights, cells, height, scheme, view, orbit, sun, samples, look, place };
        let checked = match scene.lattice() {
            Some(lattice) => lattice.and_then(|(picture, _)| picture.caster(Size::new(8, 8), 1).map(drop)),
            None => scene.with(&mut Check),
        };
        checked.map_err(|error| source.fail(span, "heights", error))?;
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

    /// The picture of a lattice with a material.
    fn lattice(&self) -> Option<Result<(LatticePicture<'_, Named>, &Mask), Error>> {
        let (Some(look), Scheme::Lattice(mask)) = (&self.look, &self.scheme) else { return None };
        let Look { material, environment, light, quality, palette } = *look;
        let Self { view, samples, .. } = *self;
        let picture = |sheet| {
            let picture =
                LatticePicture { sheet, view, material, environment, light, samples, quality, palette };
            (picture, &**mask)
        };
        Some(Sheet::new(&**mask, &self.heights, self.cells).map(picture))
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
        let drawn = match self.lattice() {
            Some(lattice) => lattice.and_then(|(picture, mask)| {
                picture.draw((request.size, request.seed as u32), mask, target, watch)
            }),
            None => self.with(&mut Draw { request, target, watch }),
        };
        drawn.map_err(|error| self.place.fail_at(request.size, error))
    }

    /// The tone of every pixel of a lattice with a material, by its samples, by the ray through its centre
    /// alone, and filtered, if it is.
    pub(super) fn pixels(&self, request: &Request, out: &mut Csv) -> Result<(), Fail> {
        let Some(lattice) = self.lattice() else {
            return Err(Fail::new(
                "--pixels: this patch-surface has no material, only a lattice with one is asked for that",
            ));
        };
        let (size, fail) = (request.size, |error| self.place.fail_at(request.size, error));
        let (picture, mask) = lattice.map_err(fail)?;
        let caster = picture.caster(size, request.seed as u32).map_err(fail)?;
        let one = caster.clone().with_sampling(Sampling::Centre, Filter::Box).map_err(fail)?;
        let Some(quality) = picture.quality else {
            return pixels::write(size, [&caster, &one], None::<&FilteredPatch<'_>>, out);
        };
        let moments = SlopeMoments::new(mask).map_err(fail)?;
        let filtered = FilteredPatch::new(caster.clone(), &moments, quality);
        pixels::write(size, [&caster, &one], Some(&filtered), out)
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
