//! `attractor export`: a scene as a Rust module, for firmware that has no TOML.
//!
//! Constants, and functions that build core's objects of them, whose bits are those that the command draws
//! with. With `--gallery` also what `attractor-gallery` needs to draw the picture on the command's page.

mod curve;
mod escape;
mod function;
mod image;
mod module;
mod palette;
mod patch;
mod surface;
mod system;
mod terrain;
mod texture;
mod world;

use std::io::Write as _;
use std::path::Path;

use crate::builtin;
use crate::cli::Export;
use crate::fail::Fail;
use crate::output::{self, Directory};
use crate::scene::image::Shown;
use crate::scene::{self, Kind, Scene};

use module::Module;
pub(crate) use module::comment;

/// Prints the module of one scene, or writes those of all built-in ones.
pub(crate) fn run(args: &Export) -> Result<(), Fail> {
    if let Some(name) = &args.scene {
        if let Some(output) = &args.output {
            let reason = "a directory is for --all; one scene goes to standard output";
            return Err(Fail::new(format_args!("--output {}: {reason}", output.display())));
        }
        let scene = scene::load(name)?;
        if let Some(reason) = refusal(&scene) {
            return Err(Fail::new(format_args!("{}: {reason}", scene.name)));
        }
        let text = source(&scene, args.gallery);
        std::io::stdout().lock().write_all(text.as_bytes())?;
        return Ok(());
    }
    let output = args.output.as_deref().unwrap_or(Path::new("."));
    let mut index = format!(
        "//! The built-in scenes.\n//!\n//! Written by `attractor export --all{}`.\n\n",
        flag(args.gallery)
    );
    let mut files = Vec::new();
    for (name, _) in builtin::SCENES {
        let scene = scene::load(name)?;
        if refusal(&scene).is_none() {
            files.push((identifier(name), source(&scene, args.gallery)));
        }
    }
    files.sort();
    index.extend(files.iter().map(|(name, _)| format!("pub mod {name};\n")));
    files.push(("mod".to_owned(), index));
    let _into = Directory::ready(output, output)?;
    let mut out = std::io::stdout().lock();
    for (name, text) in files {
        let path = output.join(name + ".rs");
        output::check(&path)?;
        output::write(&path, text.as_bytes())?;
        writeln!(out, "{}", path.display())?;
    }
    Ok(())
}

/// Why there is no module of a scene.
fn refusal(scene: &Scene) -> Option<&'static str> {
    match &scene.kind {
        Kind::Terrain(scene) if scene.picture().knots.len() > terrain::MOST => {
            Some("an elevation model has too many knots for a module: a window takes a part")
        }
        Kind::Image(scene) if matches!(scene.shown, Shown::Still(_)) => {
            Some("a PNG file is no constant for firmware: `attractor encode` makes a stream of it")
        }
        _ => None,
    }
}

/// The name of a built-in scene as that of a module.
fn identifier(name: &str) -> String {
    name.replace('-', "_")
}

fn flag(gallery: bool) -> &'static str {
    if gallery { " --gallery" } else { "" }
}

/// The module of a scene.
fn source(scene: &Scene, gallery: bool) -> String {
    let (title, name) = (comment(&scene.title), comment(&scene.name).replace('`', "'"));
    let mut module = Module::default();
    match &scene.kind {
        Kind::FifCurve(scene) => function::graph(scene, &mut module, gallery),
        Kind::FifSurface(scene) => surface::surface(scene, &mut module, gallery),
        Kind::Curve(scene) => curve::refined(scene, &mut module, gallery),
        Kind::RandomCurve(scene) => curve::random(scene, &mut module, gallery),
        Kind::LSystem(scene) => curve::words(scene, &mut module, gallery),
        Kind::Ifs(scene) => system::attractor(scene, &mut module, gallery),
        Kind::Copier(scene) => system::copies(scene, &mut module, gallery),
        Kind::Mandelbrot(scene) => escape::mandelbrot(scene, &mut module),
        Kind::Julia(scene) => escape::julia(scene, &mut module),
        Kind::JuliaSet(scene) => escape::julia_set(scene, &mut module, gallery),
        Kind::PatchCurve(scene) => patch::curve(scene, &mut module, gallery),
        Kind::PatchSurface(scene) => patch::surface(scene, &mut module, gallery),
        Kind::Texture(scene) => texture::slice(scene, &mut module),
        Kind::Image(scene) => image::image(scene, &mut module, gallery),
        Kind::Terrain(scene) => terrain::terrain(scene, &mut module, gallery),
        Kind::World(scene) => world::world(scene, &mut module),
    }
    module
        .finished(&format!("//! {title}.\n//!\n//! Written by `attractor export{} {name}`.\n", flag(gallery)))
}
