//! `attractor dump`: scenes as PNG files.

use std::collections::HashMap;
use std::io::Write as _;
use std::path::PathBuf;

use embedded_graphics_simulator::SimulatorDisplay;
use indicatif::{ProgressBar, ProgressStyle};

use crate::builtin;
use crate::canvas;
use crate::cli::{Dump, Look, MAX_PIXELS};
use crate::color::{Depth, with_depth};
use crate::fail::Fail;
use crate::output;
use crate::scene::{self, Request, Scene};

/// Where files go unless said otherwise.
const DIRECTORY: &str = "out";

/// Draws the scenes named, or all built-in ones, and prints the path of each file.
pub(crate) fn run(args: &Dump) -> Result<(), Fail> {
    let look = &args.look;
    let pixels = u64::from(look.size.width) * u64::from(look.size.height) * u64::from(look.scale).pow(2);
    if pixels > MAX_PIXELS {
        return Err(Fail::new(format_args!(
            "--scale {}: {pixels} pixels, allowed is {MAX_PIXELS}",
            look.scale
        )));
    }
    let mut names: Vec<&str> = args.scenes.iter().map(String::as_str).collect();
    if args.all || names.is_empty() {
        names.extend(
            builtin::SCENES
                .iter()
                .map(|(name, _)| *name)
                .filter(|name| !args.scenes.iter().any(|s| s == name)),
        );
    }
    // every scene is read before the first is drawn
    let scenes = names.iter().map(|name| scene::load(name)).collect::<Result<Vec<_>, _>>()?;
    let paths = paths(args, &scenes)?;
    let bar = ProgressBar::new(scenes.len() as u64 * 1000);
    // not a terminal: indicatif stays silent
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos:>5.dim} {msg}") {
        bar.set_style(style.progress_chars("=> "));
    }
    let mut out = std::io::stdout().lock();
    for (scene, path) in scenes.iter().zip(&paths) {
        bar.set_message(scene.name.clone());
        let start = bar.position();
        let progress =
            |done: u32, all: u32| bar.set_position(start + 1000 * u64::from(done) / u64::from(all.max(1)));
        let bytes = with_depth!(look.color, drawn, scene, look, &progress)?;
        bar.set_position(start + 1000);
        output::write(path, &bytes)?;
        match bar.suspend(|| writeln!(out, "{}", path.display())).map_err(Fail::from) {
            // the files are wanted all the same
            Ok(()) | Err(Fail::ClosedPipe) => {}
            Err(fail) => return Err(fail),
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// The PNG file of a scene on a display of colour `C`.
fn drawn<C: Depth>(scene: &Scene, look: &Look, progress: &dyn Fn(u32, u32)) -> Result<Vec<u8>, Fail> {
    let mut display = SimulatorDisplay::<C>::new(look.size);
    let request = Request { size: look.size, seed: look.seed };
    scene.draw(&request, &mut display, &mut |_, done, all| {
        progress(done, all);
        true
    })?;
    canvas::png(&display, look.scale).map_err(|error| Fail::new(format_args!("{}: {error}", scene.name)))
}

/// Where each scene goes; makes the directory.
fn paths(args: &Dump, scenes: &[Scene]) -> Result<Vec<PathBuf>, Fail> {
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from(DIRECTORY));
    let is_file = output.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) && !output.is_dir();
    if is_file {
        if scenes.len() == 1 {
            return Ok(vec![output]);
        }
        let reason = format!("{} scenes go into a directory, not into one file", scenes.len());
        return Err(Fail::new(format_args!("--output {}: {reason}", output.display())));
    }
    let mut seen = HashMap::new();
    for scene in scenes {
        if seen.insert(scene.name.as_str(), ()).is_some() {
            return Err(Fail::new(format_args!(
                "SCENE = {}: two scenes would go into the same file",
                scene.name
            )));
        }
    }
    output::make_directory(&output)?;
    Ok(scenes.iter().map(|scene| output.join(format!("{}.png", scene.name))).collect())
}
