//! Builds and runs everything on one target.

use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result};
use attractor_workload::scenes::TABLES;

use crate::elf;
use crate::emulator;
use crate::images::{self, Images};
use crate::kinds;
use crate::lines::{self, Line, SceneLine};
use crate::report::{FlashRow, KernelRow, Measured, SceneRow};
use crate::stack;
use crate::targets::{Machine, Target};
use crate::toolchain::Toolchain;

/// Builds the images, runs them and gathers what they say; counts the kernels `by_kind` once more,
/// instruction by instruction. Comparisons come later.
pub(crate) fn measure(
    target: &'static Target,
    toolchain: &Toolchain,
    limit: Duration,
    frames: Option<&Path>,
    by_kind: &[String],
) -> Result<Measured> {
    let images = images::build(target, toolchain)?;
    let mut measured = Measured::new(target, toolchain.release.clone());
    let here = Path::new(".");

    for name in &images.panicking {
        measured.problems.push(format!(
            "image {name} must not panic, but can on {} (benches/cortex-m/README.md says how to find where)",
            target.triple
        ));
    }
    if target.loses {
        for function in images.lost()? {
            measured.problems.push(format!(
                "rustc {} for {} loses products in {function} (benches/xtask/src/multiplications.rs)",
                toolchain.release, target.triple
            ));
        }
    }
    for nopanic in images.nopanic() {
        emulator::run(&target.machine, nopanic, &[], &[], here, limit)?;
    }
    for machine in [Some(target.machine), target.counting].into_iter().flatten() {
        for line in run(&machine, images.path("kernels")?, limit)? {
            measured.take(&machine, line);
        }
        for (table, _) in TABLES {
            for line in run(&machine, images.path(table)?, limit)? {
                measured.take(&machine, line);
            }
        }
    }
    if !measured.refused {
        measured.problems.push(format!("{} did not refuse what is too large for it", target.triple));
    }
    for (name, path) in images.flash() {
        let sizes = elf::sizes(path)?;
        let stack = if target.bounded { Some(stack::bound(path)) } else { None };
        if let Some(Err(error)) = &stack {
            measured
                .problems
                .push(format!("no bound on the stack of {name} on {}: {error:#}", target.triple));
        }
        measured.flash.push(FlashRow {
            name: name.to_owned(),
            bytes: sizes.flash,
            data: sizes.data,
            bss: sizes.bss,
            stack: stack.and_then(Result::ok),
        });
    }
    for name in by_kind {
        if let Some(kinds) = kinds::of_fixed(target, images.path("kernels")?, limit, name)? {
            measured.kinds.insert(name.clone(), kinds);
        }
    }
    if let Some(directory) = frames {
        stream(target, &images, limit, directory)?;
    }
    Ok(measured)
}

fn run(machine: &Machine, image: &Path, limit: Duration) -> Result<Vec<Line>> {
    let output = emulator::run(machine, image, &[], &[], Path::new("."), limit)?;
    let name = image.file_name().unwrap_or_default();
    lines::parse(&output).with_context(|| format!("{} on {}", name.display(), machine.name))
}

impl Measured {
    /// Adds what a line says. The second machine of a target repeats the first one's results and adds counts.
    fn take(&mut self, machine: &Machine, line: Line) {
        let first = machine.name == self.target.machine.name;
        match line {
            Line::End => {}
            Line::Failure { name, size, why } => {
                self.problems.push(format!("scene {name} {size} on {}: {why}", machine.name));
            }
            Line::Refusal { needed, free } => {
                self.refused = true;
                if needed <= free {
                    self.problems.push(format!("{} draws what is larger than its RAM", machine.name));
                }
            }
            Line::Scene(scene) if first => self.scenes.push(SceneRow::new(self.target, scene)),
            Line::Scene(scene) => self.add_scene(machine, &scene),
            Line::Kernel(kernel) if first => self.kernels.push(KernelRow::new(kernel)),
            Line::Kernel(kernel) => {
                let row = self.kernels.iter_mut().find(|row| row.name == kernel.name);
                match row {
                    Some(row) if row.checksum == kernel.fixed.checksum => *row = KernelRow::new(kernel),
                    _ => self.problems.push(format!(
                        "kernel {}: {} computes something else than {}",
                        kernel.name, machine.name, self.target.machine.name
                    )),
                }
            }
        }
    }

    fn add_scene(&mut self, machine: &Machine, scene: &SceneLine) {
        let row = self.scenes.iter_mut().find(|row| row.name == scene.name && row.size == scene.size);
        match row {
            Some(row) if row.crc32 == scene.crc32 => {
                row.instructions = scene.counted.then_some(scene.instructions);
            }
            _ => self.problems.push(format!(
                "scene {} {}: {} draws something else than {}",
                scene.name, scene.size, machine.name, self.target.machine.name
            )),
        }
    }
}

/// Draws every scene once more into files, and turns these into PPM pictures.
fn stream(target: &Target, images: &Images, limit: Duration, directory: &Path) -> Result<()> {
    std::fs::create_dir_all(directory).with_context(|| format!("{} cannot be made", directory.display()))?;
    for (table, _) in TABLES {
        emulator::run(&target.machine, images.path(table)?, &["frames"], &[], directory, limit)?;
    }
    for entry in std::fs::read_dir(directory)? {
        let raw = entry?.path();
        if raw.extension().is_some_and(|extension| extension == "raw") {
            let bytes = std::fs::read(&raw)?;
            let ppm = picture(&raw, &bytes).with_context(|| format!("{} is damaged", raw.display()))?;
            std::fs::write(raw.with_extension("ppm"), ppm)?;
            std::fs::remove_file(&raw)?;
        }
    }
    Ok(())
}

/// A PPM picture from the records of `Board::stream`.
fn picture(path: &Path, bytes: &[u8]) -> Option<Vec<u8>> {
    let (_, size) = path.file_stem()?.to_str()?.rsplit_once('-')?;
    let (width, height) = size.split_once('x')?;
    let (width, height): (usize, usize) = (width.parse().ok()?, height.parse().ok()?);
    let mut pixels = vec![[0_u8; 3]; width * height];
    let mut rest = bytes;
    while !rest.is_empty() {
        let (head, body) = rest.split_at_checked(16)?;
        let word = |i: usize| usize::from(u16::from_le_bytes([head[2 * i], head[2 * i + 1]]));
        let (x, y, columns, bits) = (word(0), word(1), word(2), word(3));
        let (offset, count) = (word(4) | word(5) << 16, word(6));
        let (colours, after) = body.split_at_checked(2 * count)?;
        for (i, colour) in colours.chunks_exact(2).enumerate() {
            let (column, row) = (x + (offset + i) % columns.max(1), y + (offset + i) / columns.max(1));
            let pixel = pixels.get_mut(row * width + column).filter(|_| column < width)?;
            *pixel = rgb(u16::from_le_bytes([colour[0], colour[1]]), bits);
        }
        rest = after;
    }
    let mut ppm = format!("P6 {width} {height} 255\n").into_bytes();
    ppm.extend(pixels.into_iter().flatten());
    Some(ppm)
}

/// A colour of 16 bits (5, 6, 5) or fewer (grey) with 8 bits a channel.
fn rgb(colour: u16, bits: usize) -> [u8; 3] {
    let scale = |value: u16, bits: usize| (u32::from(value) * 255 / ((1 << bits) - 1)) as u8;
    match bits {
        16 => [scale(colour >> 11, 5), scale(colour >> 5 & 63, 6), scale(colour & 31, 5)],
        bits => [scale(colour, bits.clamp(1, 8)); 3],
    }
}
