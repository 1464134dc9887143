//! `kind = "fif-surface"`: the height field `f(x) g(y)` under a ray caster, figure 6.

use std::convert::Infallible;

use attractor::fif::{Cell, Factor, Pyramid, Sum, Sums, Surface};
use attractor::num::Vec3;
use attractor::trace::{
    Camera, Environment, Filter, FilteredCaster, Finish, HeightField, Light, Quality, RayCaster, Sampling,
};
use attractor_gallery::{Watch, depth_for, draw_field, filtered_depth, surface_depth};
use attractor_reference as reference;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::environment::{Around, Board, Sky, Surroundings};
use super::fif_curve::abscissa;
use super::finish::{self, Filtering, Made, Mirrors};
use super::function::{DEGREE, Description, Function, MAPS};
use super::motion::Motion;
use super::orbit::{Orbit, carried};
use super::pixels;
use super::request::Request;
use super::standpoint::{Eye, Standpoint, camera, vector};
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    f: Spanned<Description>,
    g: Spanned<Description>,
    camera: Spanned<Eye>,
    light: Option<Spanned<Lamp>>,
    material: Option<finish::Named>,
    #[serde(rename = "torrance-sparrow")]
    torrance_sparrow: Option<Spanned<Mirrors>>,
    environment: Option<Around>,
    gradient: Option<Spanned<Sky>>,
    checkerboard: Option<Spanned<Board>>,
    samples: Option<Spanned<u8>>,
    filter: Option<Filtering>,
    depth: Option<Spanned<u32>>,
    palette: Option<Named>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Lamp {
    direction: Spanned<[Num; 3]>,
}

/// A factor of the height, and where its file says how rough it is.
#[derive(Debug)]
pub(crate) struct Profile {
    pub(crate) function: Function,
    scalings: Place,
}

impl Profile {
    fn load(source: &Source, given: &Description, prefix: &str) -> Result<Self, Fail> {
        let scalings = source.place(given.vertical_scaling.span(), &format!("{prefix}vertical_scaling"));
        Ok(Self { function: given.compile(source, prefix)?, scalings })
    }

    /// A complaint about how rough it is.
    pub(crate) fn fail(&self, reason: impl std::fmt::Display) -> Fail {
        self.scalings.fail(reason)
    }
}

/// A surface ready to be drawn.
#[derive(Debug)]
pub(crate) struct FifSurface {
    pub(crate) f: Profile,
    pub(crate) g: Profile,
    camera: Camera,
    pub(crate) standpoint: Standpoint,
    /// Where the camera stands.
    eye: Place,
    orbit: Option<Orbit>,
    /// Towards it.
    pub(crate) light: Option<Vec3>,
    /// Whether it was moved.
    is_lit_anew: bool,
    pub(crate) material: Finish,
    pub(crate) environment: Environment,
    /// A side.
    pub(crate) samples: u8,
    /// Of normals that are integrated.
    pub(crate) filter: Option<Quality>,
    pub(crate) depth: Option<u32>,
    pub(crate) palette: Named,
}

impl FifSurface {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let material = Made { named: file.material, torrance_sparrow: file.torrance_sparrow };
        let (gradient, checkerboard) = (file.gradient, file.checkerboard);
        let environment = Surroundings { named: file.environment, gradient, checkerboard };
        let light = file.light.map(|light| {
            let direction = &light.get_ref().direction;
            let towards = vector(source, direction, "light.direction")?;
            // the kernel says which directions it takes
            Light::new(towards)
                .map(|_| towards)
                .map_err(|error| source.fail(direction.span(), "light.direction", error))
        });
        for (key, function) in [("f.knots", &file.f), ("g.knots", &file.g)] {
            let knots = &function.get_ref().knots;
            if knots.get_ref().len() == 2 {
                let reason = "a surface is cut into ever smaller parts: it takes two maps at least, that is three knots";
                return Err(source.fail(knots.span(), key, reason));
            }
        }
        let samples = match file.samples {
            Some(samples) if !(1..=8).contains(samples.get_ref()) => {
                return Err(source.fail(samples.span(), "samples", "allowed is 1 to 8 a side"));
            }
            samples => samples.map_or(1, Spanned::into_inner),
        };
        let (camera, standpoint, orbit) = camera(source, &file.camera)?;
        let scene = Self {
            f: Profile::load(source, file.f.get_ref(), "f.")?,
            g: Profile::load(source, file.g.get_ref(), "g.")?,
            camera,
            standpoint,
            eye: source.place(file.camera.get_ref().eye.span(), "camera.eye"),
            orbit,
            light: light.transpose()?,
            is_lit_anew: false,
            material: material.compile(source)?,
            environment: environment.compile(source)?,
            samples,
            filter: file.filter.as_ref().map(Filtering::quality),
            depth: file.depth.as_ref().map(|depth| *depth.get_ref()),
            palette: file.palette.unwrap_or(Named::Dusk),
        };
        if let Some(depth) = file.depth {
            let most = depth_for(scene.maps(), u32::MAX);
            if !(1..=most).contains(depth.get_ref()) {
                return Err(source.fail(depth.span(), "depth", format!("allowed is 1 to {most}")));
            }
        }
        // ranges of the surface are checked now, not in the middle of a picture
        scene.with_surface(1, |_, _| Ok(()))?;
        Ok(scene)
    }

    fn maps(&self) -> usize {
        self.f.function.fixed.maps().max(self.g.function.fixed.maps())
    }

    /// How deep the pyramids are for a display whose longer side has so many pixels.
    pub(crate) fn depth_of_pyramids(&self, side: u32) -> u32 {
        let maps = [self.f.function.fixed.maps(), self.g.function.fixed.maps()];
        surface_depth(maps, self.depth, side)
    }

    /// Builds the pyramids down to cells finer than a pixel, and the running sums where pixels are filtered.
    fn with_surface<T>(
        &self,
        side: u32,
        use_it: impl FnOnce(HeightField<'_>, Option<[Sums<'_>; 2]>) -> Result<T, Fail>,
    ) -> Result<T, Fail> {
        let (f, g) = (&self.f.function.fixed, &self.g.function.fixed);
        let depth = self.depth_of_pyramids(side);
        let cells = |maps: usize| vec![Cell::ZERO; Pyramid::cells(maps, depth)];
        let (mut a, mut b) = (cells(f.maps()), cells(g.maps()));
        let x = Pyramid::new(f, depth, &mut a).map_err(|error| self.f.scalings.fail(error))?;
        let y = Pyramid::new(g, depth, &mut b).map_err(|error| self.g.scalings.fail(error))?;
        let surface = HeightField::new(&x, &y).map_err(|error| self.f.scalings.fail(error))?;
        if self.filter.is_none() {
            return use_it(surface, None);
        }
        let depth = filtered_depth([f.maps(), g.maps()], self.depth, side);
        let places = |maps: usize| vec![Sum::ZERO; Sums::places(maps, depth)];
        let (mut a, mut b) = (places(f.maps()), places(g.maps()));
        let x = Sums::new(f, depth, &mut a).map_err(|error| self.f.scalings.fail(error))?;
        let y = Sums::new(g, depth, &mut b).map_err(|error| self.g.scalings.fail(error))?;
        use_it(surface, Some([x, y]))
    }

    fn caster<'a>(
        &self,
        surface: HeightField<'a>,
        size: Size,
        seed: u64,
    ) -> Result<RayCaster<'a>, attractor::Error> {
        let sampling = match self.samples {
            1 => Sampling::Centre,
            n => Sampling::Jittered { n, seed: seed as u32 },
        };
        let mut caster = RayCaster::new(surface, self.camera, size)?
            .with_finish(self.material)?
            .with_environment(self.environment)?
            .with_sampling(sampling, Filter::Box)?;
        if let Some(light) = self.light {
            caster = caster.with_light(Light::new(light)?);
        }
        Ok(caster)
    }

    /// Moves the camera round what it looks at, or the light; the message says why not.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        if let Motion::Light { right, up } = motion {
            if self.material == Finish::Mirror {
                return Err(Fail::new("a mirror shows its surroundings, no light"));
            }
            // that of a caster to which none is given
            let light = self.light.unwrap_or(Vec3::lit("-1", "-2", "3"));
            self.light = Some(carried(light, Vec3::default(), [right, up], size));
            self.is_lit_anew = true;
            return Ok(());
        }
        let Some(orbit) = &self.orbit else {
            return Err(Fail::new("the camera moves about only where z is up"));
        };
        let orbit = orbit.after(motion, size);
        self.camera = orbit.camera()?;
        self.orbit = Some(orbit);
        Ok(())
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self) -> Option<String> {
        let light = self.light.filter(|_| self.is_lit_anew);
        let light = light.map(|Vec3 { x, y, z }| format!("[light]\ndirection = [{x}, {y}, {z}]\n"));
        let camera = self.orbit.as_ref().map(Orbit::place);
        (camera.is_some() || light.is_some()).then(|| camera.unwrap_or_default() + &light.unwrap_or_default())
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        self.with_surface(request.size.width.max(request.size.height), |surface, sums| {
            let fail = |error| self.eye.fail_at(request.size, error);
            let caster = self.caster(surface, request.size, request.seed).map_err(fail)?;
            match self.filtered(&caster, sums).map_err(fail)? {
                None => draw_field(&caster, self.palette, target, watch),
                Some(filtered) => draw_field(&filtered, self.palette, target, watch),
            };
            Ok(())
        })
    }

    fn filtered<'a>(
        &self,
        caster: &RayCaster<'a>,
        sums: Option<[Sums<'a>; 2]>,
    ) -> Result<Option<FilteredCaster<'a>>, attractor::Error> {
        let (Some([x, y]), Some(quality)) = (sums, self.filter) else { return Ok(None) };
        FilteredCaster::new(caster.clone(), &x, &y, quality).map(Some)
    }

    /// The tone of every pixel, by its samples, by the ray through its centre alone, and filtered, if it is.
    pub(super) fn pixels(&self, request: &Request, out: &mut Csv) -> Result<(), Fail> {
        self.with_surface(request.size.width.max(request.size.height), |surface, sums| {
            let fail = |error| self.eye.fail_at(request.size, error);
            let caster = self.caster(surface, request.size, request.seed).map_err(fail)?;
            let one = caster.clone().with_sampling(Sampling::Centre, Filter::Box).map_err(fail)?;
            let filtered = self.filtered(&caster, sums).map_err(fail)?;
            pixels::write(request.size, [&caster, &one], filtered.as_ref(), out)
        })
    }

    /// Height and normal on a square grid of about `points` points, corners included.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let factor = |profile: &Profile| {
            Factor::<MAPS, DEGREE>::new(&profile.function.fixed)
                .map(Box::new)
                .map_err(|error| profile.scalings.fail(error))
        };
        let (f, g) = (factor(&self.f)?, factor(&self.g)?);
        let exact_factor = |profile: &Profile| {
            reference::Factor::new(profile.function.reference.clone())
                .map_err(|error| profile.scalings.fail(error))
        };
        let exactly = reference::Surface { x: exact_factor(&self.f)?, y: exact_factor(&self.g)? };
        let surface = Surface::new(&f, &g);
        out.write_record([
            "x",
            "y",
            "height",
            "nx",
            "ny",
            "nz",
            "height_reference",
            "nx_reference",
            "ny_reference",
            "nz_reference",
        ])?;
        let root = points.isqrt();
        let side = if root * root < points { root + 1 } else { root };
        let ((x0, x1), (y0, y1)) = (self.f.function.fixed.domain(), self.g.function.fixed.domain());
        for j in 0..side {
            let y = abscissa(y0, y1, j, side);
            for i in 0..side {
                let x = abscissa(x0, x1, i, side);
                let (u, v) = (x.to_num(), y.to_num());
                // no negative zeros
                let [nx, ny, nz] = exactly.normal(u, v).map(|n| n + 0.0);
                let n = surface.normal(x, y);
                let fixed =
                    [exact(x), exact(y), exact(surface.height(x, y)), exact(n.x), exact(n.y), exact(n.z)];
                let reference = [exactly.height(u, v), nx, ny, nz].map(|v| format!("{v:?}"));
                out.write_record(fixed.iter().chain(&reference))?;
            }
        }
        Ok(())
    }
}
