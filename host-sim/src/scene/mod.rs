//! Scenes: what a name or a TOML file describes, compiled and ready to be drawn or sampled.

pub(crate) mod coloring;
mod contrast;
pub(crate) mod copier;
pub(crate) mod curve;
mod data;
pub(crate) mod deep;
mod environment;
pub(crate) mod escape;
pub(crate) mod fif_curve;
pub(crate) mod fif_surface;
mod finish;
pub(crate) mod function;
mod graph;
mod halving;
pub(crate) mod ifs;
pub(crate) mod image;
pub(crate) mod julia;
pub(crate) mod julia_set;
mod keys;
pub(crate) mod l_system;
pub(crate) mod law;
pub(crate) mod mandelbrot;
mod motion;
mod orbit;
pub(crate) mod patch_curve;
pub(crate) mod patch_surface;
mod pixels;
mod polyline;
pub(crate) mod random_curve;
mod request;
pub(crate) mod slice;
mod standpoint;
mod system;
pub(crate) mod terrain;
mod trail;
pub(crate) mod world;

use std::convert::Infallible;
use std::io::stdout;
use std::path::Path;

use attractor::escape::JuliaSet;
use attractor_gallery::Watch;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use serde::de::IgnoredAny;
use std::collections::HashMap;
use toml::Spanned;

use crate::builtin;
use crate::color::Depth;
use crate::fail::{Fail, shortened};
use crate::source::Source;
use crate::table::Csv;

pub(crate) use graph::Graph;
pub(crate) use halving::Chords;
pub(crate) use law::Law;
pub(crate) use motion::Motion;
pub(crate) use request::{Question, Request};
pub(crate) use standpoint::Standpoint;
pub(crate) use trail::Trail;

/// What can be measured of a scene.
pub(crate) enum Subject<'a> {
    /// An attractor in the plane.
    Set(&'a attractor::ifs::Ifs<{ attractor::ifs::MAX_MAPS }>),
    /// A path, or points, as dense as one likes.
    Trail(Trail<'a>),
    /// A Julia set.
    Julia(JuliaSet),
    /// The graph of a function.
    Graph(Graph<'a>),
}

/// A scene of any kind.
#[derive(Debug)]
pub(crate) struct Scene {
    /// What its file is called: the name, or the stem of the path.
    pub(crate) name: String,
    /// One line for people.
    pub(crate) title: String,
    pub(crate) kind: Kind,
}

/// A scene of one kind.
#[derive(Debug)]
pub(crate) enum Kind {
    FifCurve(fif_curve::FifCurve),
    FifSurface(Box<fif_surface::FifSurface>),
    Curve(curve::CurveScene),
    RandomCurve(random_curve::RandomCurve),
    LSystem(l_system::LSystemScene),
    Ifs(ifs::IfsScene),
    Copier(copier::CopierScene),
    Mandelbrot(mandelbrot::MandelbrotScene),
    Julia(julia::JuliaScene),
    JuliaSet(julia_set::JuliaSetScene),
    World(Box<world::WorldScene>),
    Texture(Box<slice::SliceScene>),
    Terrain(Box<terrain::TerrainScene>),
    PatchCurve(Box<patch_curve::PatchCurve>),
    PatchSurface(Box<patch_surface::PatchSurfaceScene>),
    Image(Box<image::ImageScene>),
}

/// What the key `kind` may say.
const KINDS: [&str; 16] = [
    "fif-curve",
    "fif-surface",
    "curve",
    "random-curve",
    "l-system",
    "ifs",
    "copier",
    "mandelbrot",
    "julia",
    "julia-set",
    "world",
    "terrain",
    "texture",
    "image",
    "patch-curve",
    "patch-surface",
];

/// The only key that is read before the kind is known.
#[derive(Deserialize)]
struct Head {
    kind: Option<Spanned<String>>,
    title: Option<Spanned<String>>,
    #[serde(flatten)]
    _rest: HashMap<String, IgnoredAny>,
}

/// The built-in scene of this name, or the scene in the file at this path.
pub(crate) fn load(scene: &str) -> Result<Scene, Fail> {
    if let Some(text) = builtin::find(scene) {
        return compile(scene.to_owned(), &Source::built_in(scene, text));
    }
    let path = Path::new(scene);
    let looks_like_a_path = path.components().count() > 1 || path.extension().is_some() || path.exists();
    if !looks_like_a_path {
        let hint = builtin::nearest(scene).map(|name| format!("; did you mean {name}?")).unwrap_or_default();
        return Err(Fail::new(format_args!(
            "SCENE = {}: no such scene is built in and no such file is there{hint} (`attractor list` names all)",
            shortened(scene)
        )));
    }
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    compile(name, &Source::read(path)?)
}

/// Whether a text that is written to this path will be a scene.
pub(crate) fn check(path: &Path, text: &str) -> Result<(), Fail> {
    let source = Source::named(path.display().to_string(), text.to_owned());
    compile(String::new(), &source).map(drop)
}

fn compile(name: String, source: &Source) -> Result<Scene, Fail> {
    let head: Head = source.parse()?;
    let Some(named) = head.kind else {
        let key = if source.is_empty() { "the file is empty: kind" } else { "kind" };
        return Err(source.fail_all(key, format_args!("missing, allowed is {}", KINDS.join(", "))));
    };
    let kind = match named.get_ref().as_str() {
        "fif-curve" => Kind::FifCurve(fif_curve::FifCurve::load(source)?),
        "fif-surface" => Kind::FifSurface(Box::new(fif_surface::FifSurface::load(source)?)),
        "curve" => Kind::Curve(curve::CurveScene::load(source)?),
        "random-curve" => Kind::RandomCurve(random_curve::RandomCurve::load(source)?),
        "l-system" => Kind::LSystem(l_system::LSystemScene::load(source)?),
        "ifs" => Kind::Ifs(ifs::IfsScene::load(source)?),
        "copier" => Kind::Copier(copier::CopierScene::load(source)?),
        "mandelbrot" => Kind::Mandelbrot(mandelbrot::MandelbrotScene::load(source)?),
        "julia" => Kind::Julia(julia::JuliaScene::load(source)?),
        "julia-set" => Kind::JuliaSet(julia_set::JuliaSetScene::load(source)?),
        "world" => Kind::World(Box::new(world::WorldScene::load(source)?)),
        "terrain" => Kind::Terrain(Box::new(terrain::TerrainScene::load(source)?)),
        "patch-curve" => Kind::PatchCurve(Box::new(patch_curve::PatchCurve::load(source)?)),
        "patch-surface" => Kind::PatchSurface(Box::new(patch_surface::PatchSurfaceScene::load(source)?)),
        "texture" => Kind::Texture(Box::new(slice::SliceScene::load(source)?)),
        "image" => Kind::Image(Box::new(image::ImageScene::load(source)?)),
        _ => {
            let reason = format!("allowed is {}", KINDS.join(", "));
            return Err(source.fail(named.span(), "kind", reason));
        }
    };
    let title = head.title.map_or_else(|| name.clone(), Spanned::into_inner);
    Ok(Scene { name, title, kind })
}

impl Scene {
    /// Its kind, as its file says it.
    pub(crate) fn kind(&self) -> &'static str {
        match self.kind {
            Kind::FifCurve(_) => "fif-curve",
            Kind::FifSurface(_) => "fif-surface",
            Kind::Curve(_) => "curve",
            Kind::RandomCurve(_) => "random-curve",
            Kind::LSystem(_) => "l-system",
            Kind::Ifs(_) => "ifs",
            Kind::Copier(_) => "copier",
            Kind::Mandelbrot(_) => "mandelbrot",
            Kind::Julia(_) => "julia",
            Kind::JuliaSet(_) => "julia-set",
            Kind::World(_) => "world",
            Kind::Terrain(_) => "terrain",
            Kind::Texture(_) => "texture",
            Kind::Image(_) => "image",
            Kind::PatchCurve(_) => "patch-curve",
            Kind::PatchSurface(_) => "patch-surface",
        }
    }

    /// What can be measured of it.
    pub(crate) fn subject(&self) -> Result<Subject<'_>, Fail> {
        Ok(match &self.kind {
            Kind::Ifs(scene) => Subject::Set(&scene.ifs),
            Kind::Copier(scene) => Subject::Set(&scene.ifs),
            Kind::Curve(scene) => Subject::Trail(scene.trail()),
            Kind::RandomCurve(scene) => match scene.law() {
                law @ Law::LineToLine(..) => Subject::Graph(Graph::of_law(law)?),
                _ => Subject::Trail(scene.trail()),
            },
            Kind::Julia(scene) => Subject::Julia(scene.set()?),
            Kind::JuliaSet(scene) => Subject::Julia(scene.set()),
            Kind::FifCurve(scene) => Subject::Graph(scene.graph()),
            Kind::FifSurface(_) => {
                return Err(Fail::new("a surface is not measured, only its profiles as fif-curve"));
            }
            Kind::World(_) | Kind::Terrain(_) | Kind::Texture(_) => {
                return Err(Fail::new("a world, a terrain or a texture is not measured"));
            }
            Kind::PatchCurve(_) | Kind::PatchSurface(_) => {
                return Err(Fail::new("curves and surfaces by control points are not measured"));
            }
            Kind::Image(_) => {
                return Err(Fail::new(
                    "an image is not measured; `attractor inspect` says what it is made of",
                ));
            }
            Kind::LSystem(_) => {
                let reason = "an L-system tends to no one set: its picture grows with the order; write it as a curve, a copier or an ifs";
                return Err(Fail::new(reason));
            }
            Kind::Mandelbrot(_) => {
                let reason = "the boundary of the Mandelbrot set has dimension 2 (M. Shishikura, 1998), which boxes of no practical size show";
                return Err(Fail::new(reason));
            }
        })
    }

    /// Moves about on a display of this size; the message says why not.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only a window moves about"))]
    pub(crate) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        let lit = matches!(self.kind, Kind::FifSurface(_) | Kind::World(_) | Kind::Terrain(_));
        let reason = match &mut self.kind {
            _ if matches!(motion, Motion::Light { .. }) && !lit => "there is no light to move",
            Kind::Mandelbrot(scene) => return scene.go(size, motion),
            Kind::Julia(scene) => return scene.go(size, motion),
            Kind::FifSurface(scene) => return scene.go(size, motion),
            Kind::World(scene) => return scene.go(size, motion),
            Kind::Terrain(scene) => return scene.go(size, motion),
            Kind::Texture(scene) => return scene.go(size, motion),
            Kind::PatchSurface(scene) => return scene.go(size, motion),
            _ => "this kind of scene shows all there is",
        };
        Err(Fail::new(format_args!("{}: {reason}", self.name)))
    }

    /// Whether a motion moves all pixels alike.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only a window moves about"))]
    pub(crate) fn is_flat(&self) -> bool {
        matches!(self.kind, Kind::Mandelbrot(_) | Kind::Julia(_))
    }

    /// Where the viewer stands, as lines of a scene file; nothing for a kind in which nobody moves.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only a window moves about"))]
    pub(crate) fn place(&self, size: Size) -> Option<String> {
        match &self.kind {
            Kind::Mandelbrot(scene) => scene.place(size).ok(),
            Kind::Julia(scene) => scene.place(size).ok(),
            Kind::FifSurface(scene) => scene.place(),
            Kind::World(scene) => scene.place(),
            Kind::Terrain(scene) => scene.place(),
            Kind::Texture(scene) => Some(scene.place()),
            Kind::PatchSurface(scene) => scene.place(),
            _ => None,
        }
    }

    /// Draws on all of `request.size`, from the target's origin on.
    pub(crate) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        match &self.kind {
            Kind::FifCurve(scene) => scene.draw(request, target, watch),
            Kind::FifSurface(scene) => scene.draw(request, target, watch),
            Kind::Curve(scene) => scene.draw(request, target, watch),
            Kind::RandomCurve(scene) => scene.draw(request, target, watch),
            Kind::LSystem(scene) => scene.draw(request, target, watch),
            Kind::Ifs(scene) => scene.draw(request, target, watch),
            Kind::Copier(scene) => scene.draw(request, target, watch),
            Kind::Mandelbrot(scene) => scene.draw(request, target, watch),
            Kind::Julia(scene) => scene.draw(request, target, watch),
            Kind::JuliaSet(scene) => scene.draw(request, target, watch),
            Kind::World(scene) => scene.draw(request, target, watch),
            Kind::Terrain(scene) => scene.draw(request, target, watch),
            Kind::Texture(scene) => scene.draw(request, target, watch),
            Kind::Image(scene) => scene.draw(request, target, watch),
            Kind::PatchCurve(scene) => scene.draw(request, target, watch),
            Kind::PatchSurface(scene) => scene.draw(request, target, watch),
        }
    }

    /// Writes the numbers as CSV.
    pub(crate) fn sample(
        &self,
        request: &Request,
        question: Question<'_>,
        points: u32,
        out: &mut Csv,
    ) -> Result<(), Fail> {
        let asks = question.option();
        match (&self.kind, &question) {
            (Kind::FifSurface(scene), Question::Pixels) => return scene.pixels(request, out),
            (Kind::PatchSurface(scene), Question::Pixels) => return scene.pixels(request, out),
            _ => {}
        }
        if !matches!((&self.kind, &question), (Kind::World(_) | Kind::Texture(_), _) | (_, Question::Usual)) {
            let (name, kind) = (&self.name, self.kind());
            let allowed = match question {
                Question::Pixels => "a world, a texture, a fif-surface or a lattice with a material is",
                Question::Places(_) => "a world or a texture is",
                _ => "a world is",
            };
            return Err(Fail::new(format_args!("{asks}: {name} is a {kind}, only {allowed} asked for that")));
        }
        match &self.kind {
            Kind::FifCurve(scene) => scene.sample(points, out),
            Kind::FifSurface(scene) => scene.sample(points, out),
            Kind::Curve(scene) => scene.sample(request, points, out),
            Kind::RandomCurve(scene) => scene.sample(request, points, out),
            Kind::LSystem(scene) => scene.sample(points, out),
            Kind::Ifs(scene) => scene.sample(request, points, out),
            Kind::Copier(scene) => scene.sample(points, out),
            Kind::Mandelbrot(scene) => scene.sample(request, out),
            Kind::Julia(scene) => scene.sample(request, out),
            Kind::JuliaSet(scene) => scene.sample(request, points, out),
            Kind::Terrain(scene) => scene.sample(points, out),
            Kind::World(scene) => world::sample(scene, request, question, points, &mut stdout().lock()),
            Kind::Texture(scene) => scene.sample(request, question, &mut stdout().lock()),
            Kind::PatchCurve(scene) => scene.sample(points, out),
            Kind::Image(scene) => scene.sample(points, out),
            Kind::PatchSurface(scene) => scene.sample(points, out),
        }
    }
}
