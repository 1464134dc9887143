//! `cargo xtask count NAME...`: the instructions of some kernels and scenes, the flash and the stack of some
//! images.
//!
//! Only the image that holds them is built, and only what is asked for is run: the quick look while a kernel
//! is being written. `cargo xtask target` is the whole check.

use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use attractor_workload::{kernels, scenes};
use clap::Args;

use crate::kinds::Loop;
use crate::lines::{self, Line};
use crate::targets::{self, Target};
use crate::{Prefer, elf, emulator, images, stack, toolchain};

/// What `cargo xtask count` is asked.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Parts of the names of kernels, of scenes with their sizes, of flash images: "patch", "bowl 240x240",
    /// "flash mirror"
    #[arg(required = true, value_name = "NAME")]
    names: Vec<String>,
    /// On this target
    #[arg(long, value_name = "TARGET", default_value = targets::ALL[0].triple, value_parser = targets::names())]
    target: String,
    /// Stop an image after so many seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 600)]
    timeout: u64,
}

/// Counts and prints.
pub(crate) fn run(options: &Options) -> Result<bool> {
    let asked = |name: &str| options.names.iter().any(|part| name.contains(part.as_str()));
    let kernels: Vec<_> = kernels::ALL.iter().filter(|kernel| asked(kernel.name)).collect();
    let of = |table: &[scenes::Scene]| -> Vec<_> {
        let sizes =
            table.iter().map(|scene| (scene.name, format!("{}x{}", scene.size.width, scene.size.height)));
        sizes.filter(|(name, size)| asked(&format!("{name} {size}"))).collect()
    };
    let tables = scenes::TABLES.map(|(image, table)| (image, of(table)));
    let flash = images::measuring_flash()?;
    let flash: Vec<_> = flash.iter().filter(|name| asked(&format!("flash {name}"))).collect();
    if kernels.is_empty() && flash.is_empty() && tables.iter().all(|(_, scenes)| scenes.is_empty()) {
        bail!("no kernel, scene or flash image has {} in its name", options.names.join(" or "));
    }
    let limit = Duration::from_secs(options.timeout);
    for target in targets::choose(std::slice::from_ref(&options.target))? {
        emulator::find_all(&[target])?;
        let compiler = toolchain::find(target, Prefer::Auto)?;
        if !kernels.is_empty() {
            let image = &images::one(target, &compiler, "kernels")?;
            for kernel in &kernels {
                let (units, instructions) =
                    Loop { target, image, limit, name: kernel.name, format: "fixed" }.run(1, &[])?;
                let each = instructions as f64 / units.max(1) as f64;
                println!("{:<32} {each:>14.2} instructions a {}", kernel.name, kernel.unit);
            }
        }
        for (image, scenes) in tables.iter().filter(|(_, scenes)| !scenes.is_empty()) {
            let image = images::one(target, &compiler, image)?;
            for (name, size) in scenes {
                scene(target, &image, limit, name, size)?;
            }
        }
        for name in &flash {
            let image = images::flash_of(target, &compiler, name)?;
            let bytes = elf::sizes(&image)?.flash;
            print!("{:<32} {bytes:>14} bytes of flash", format!("flash {name}"));
            match stack::bound(&image) {
                _ if !target.bounded => println!(),
                Ok(stack) => println!(", at most {stack} of stack"),
                Err(error) => println!(", no bound on its stack: {error:#}"),
            }
        }
    }
    Ok(true)
}

fn scene(target: &Target, image: &Path, limit: Duration, name: &str, size: &str) -> Result<()> {
    let machine = target.counting.unwrap_or(target.machine);
    let said = emulator::run(&machine, image, &[&images::argument(name), size], &[], Path::new("."), limit)?;
    let lines = lines::parse(&said).with_context(|| format!("scene {name} {size}"))?;
    for line in lines {
        match line {
            Line::Scene(row) => println!(
                "{:<32} {:>14} instructions, {} bytes, stack {}, CRC {}",
                format!("{name} {size}"),
                row.instructions,
                row.ram_bytes,
                row.stack_bytes,
                row.crc32
            ),
            Line::Failure { why, .. } => println!("{name} {size}: {why}"),
            Line::Kernel(_) | Line::Refusal { .. } | Line::End => {}
        }
    }
    Ok(())
}
