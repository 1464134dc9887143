//! `attractor dump`: scenes as PNG files.

use std::cell::Cell;
use std::collections::HashSet;
use std::io::{IsTerminal as _, Write as _};
use std::path::PathBuf;

use embedded_graphics_simulator::SimulatorDisplay;
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

use crate::builtin;
use crate::canvas;
use crate::cli::{Dump, Look, MAX_PIXELS};
use crate::color::{Depth, with_depth};
use crate::fail::{Fail, shortened};
use crate::output::{self, Directory};
use crate::scene::{self, Request, Scene};

/// Where files go unless said otherwise.
const DIRECTORY: &str = "out";
/// Pictures that are drawn side by side before the first of them is written: so many that a slow one keeps
/// the other processors waiting for little, but of no more pixels than the largest one, as they wait in
/// memory.
const TOGETHER: u64 = 32;
/// Of the progress bar, for a picture.
const STEPS: u64 = 1000;

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
    let goal = goal(args, &scenes)?;
    let bar = ProgressBar::new(scenes.len() as u64 * STEPS);
    // not a terminal: indicatif stays silent
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos:>5.dim} {msg}") {
        bar.set_style(style.progress_chars("=> "));
    }
    let mut out = std::io::stdout().lock();
    let together = (MAX_PIXELS / pixels.max(1)).clamp(1, TOGETHER) as usize;
    for (group, scenes) in scenes.chunks(together).enumerate() {
        let pictures: Vec<_> = scenes.par_iter().map(|scene| picture(scene, look, &bar)).collect();
        // those before one that fails are kept
        for (i, bytes) in pictures.into_iter().enumerate() {
            let bytes = bytes?;
            let path = match &goal {
                Goal::StandardOutput => {
                    bar.suspend(|| out.write_all(&bytes))?;
                    continue;
                }
                Goal::Device(path) => {
                    output::write(path, &bytes)?;
                    continue;
                }
                Goal::Files { paths, .. } => paths.get(group * together + i),
            };
            let Some(path) = path else { continue };
            output::write(path, &bytes)?;
            match bar.suspend(|| writeln!(out, "{}", path.display())).map_err(Fail::from) {
                // the files are wanted all the same
                Ok(()) | Err(Fail::ClosedPipe) => {}
                Err(fail) => return Err(fail),
            }
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// The PNG file of a scene, and how far it is on the bar of all.
fn picture(scene: &Scene, look: &Look, bar: &ProgressBar) -> Result<Vec<u8>, Fail> {
    bar.set_message(scene.name.clone());
    let shown = Cell::new(0);
    let show = |steps: u64| bar.inc(steps.saturating_sub(shown.replace(steps.max(shown.get()))));
    let progress = |done: u32, all: u32| show(STEPS * u64::from(done) / u64::from(all.max(1)));
    let bytes = with_depth!(look.color, drawn, scene, look, &progress)?;
    show(STEPS);
    Ok(bytes)
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

/// Where pictures go.
enum Goal {
    /// One for each scene.
    Files { paths: Vec<PathBuf>, _into: Directory },
    /// A device or a pipe.
    Device(PathBuf),
    /// Of one scene.
    StandardOutput,
}

/// Decides it before anything is drawn; makes the directory.
fn goal(args: &Dump, scenes: &[Scene]) -> Result<Goal, Fail> {
    let output = args.output.clone().unwrap_or_else(|| PathBuf::from(DIRECTORY));
    let shown = output.display();
    let fail = |reason: &str| Err(Fail::new(format_args!("--output {shown}: {reason}")));
    let one_only = format!("{} scenes go into a directory, not into one file", scenes.len());
    let there = std::fs::metadata(&output).ok();
    let is_directory = there.as_ref().map(std::fs::Metadata::is_dir);
    if output.as_os_str() == "-" {
        return match scenes.len() {
            1 if std::io::stdout().is_terminal() => fail("standard output is a terminal, which shows no PNG"),
            1 => Ok(Goal::StandardOutput),
            _ => fail(&one_only),
        };
    }
    if there.is_some_and(|there| !there.is_dir() && !there.is_file()) {
        return if scenes.len() == 1 { Ok(Goal::Device(output)) } else { fail(&one_only) };
    }
    match (output.extension(), is_directory) {
        // whoever writes a slash means a directory
        _ if output.as_os_str().as_encoded_bytes().ends_with(b"/") => {}
        (_, Some(true)) => {}
        (Some(png), _) if png.eq_ignore_ascii_case("png") => {
            if scenes.len() != 1 {
                return fail(&one_only);
            }
            let directory = Directory::ready(output::parent(&output), &output)?;
            output::check(&output)?;
            return Ok(Goal::Files { paths: vec![output], _into: directory });
        }
        (_, Some(false)) => return fail(&format!("it is a file; {}", output::PNG)),
        (Some(_), None) => {
            return fail(&format!("{}; a new directory is {shown}/ with a slash", output::PNG));
        }
        (None, None) => {}
    }
    let mut seen = HashSet::new();
    if let Some(twice) = scenes.iter().find(|scene| !seen.insert(scene.name.as_str())) {
        let reason = "two scenes would go into the same file";
        return Err(Fail::new(format_args!("SCENE = {}: {reason}", shortened(&twice.name))));
    }
    let paths: Vec<PathBuf> = scenes.iter().map(|scene| output.join(format!("{}.png", scene.name))).collect();
    let directory = Directory::ready(&output, &output)?;
    paths.iter().try_for_each(|path| output::check(path))?;
    Ok(Goal::Files { paths, _into: directory })
}
