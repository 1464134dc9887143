//! `cargo xtask target`: builds the images of `benches/cortex-m`, runs them in QEMU, compares every checksum
//! with the host's, and holds counts and sizes against the committed tables. See
//! `benches/cortex-m/README.md`. `cargo xtask exhaust`: every input of the elementary functions.

mod count;
mod drivers;
mod elf;
mod emulator;
mod exhaust;
mod fuzz_codec;
mod gate;
mod grey;
mod host;
mod images;
mod kinds;
mod lines;
mod measure;
mod multiplications;
mod peer;
mod peers_images;
/// PSNR and MS-SSIM as the command has them.
#[path = "../../../host-sim/src/encode/quality.rs"]
mod quality;
mod readme;
mod report;
mod stack;
mod targets;
mod toolchain;
mod valgrind;

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use anyhow::Result;
use clap::{Args, Parser, Subcommand, ValueEnum};

#[derive(Debug, Parser)]
#[command(name = "cargo xtask", about = "Tasks of the project that need more than cargo", version)]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Build, run, compare and count on the emulated target
    Target(Options),
    /// Count the instructions of some kernels and scenes, and nothing else
    Count(count::Options),
    /// Try every input of the elementary functions
    Exhaust(exhaust::Options),
    /// Decode small streams, mutated and forged
    FuzzCodec(fuzz_codec::Options),
    /// The image codec beside libjpeg and WebP, and what each of its parts is worth
    PeersImages(peers_images::Options),
    /// Write what counts.toml has into README.md
    Readme,
    /// Compile the examples of display drivers for a Cortex-M4
    Drivers,
}

/// What `cargo xtask target` is asked.
#[derive(Debug, Args)]
struct Options {
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
    /// Run on this target only (may be given several times); the first one's kernels and sizes head the
    /// report [default: all]
    #[arg(long = "target", value_name = "TARGET", value_parser = targets::names())]
    targets: Vec<String>,
    /// Fail also when a figure is over budget, or grew by more than 3 % against benches/cortex-m/counts.toml
    #[arg(long, conflicts_with = "bless")]
    check: bool,
    /// Rewrite benches/cortex-m/counts.toml with what was measured
    #[arg(long)]
    bless: bool,
    /// Which compiler to use
    #[arg(long, value_enum, default_value_t = Prefer::Auto)]
    toolchain: Prefer,
    /// Stop an image after so many seconds and report it as a failure
    #[arg(long, value_name = "SECONDS", default_value_t = 120)]
    timeout: u64,
    /// Write each scene, as it was drawn on the first target, to this directory as a PPM picture
    #[arg(long, value_name = "DIR")]
    frames: Option<PathBuf>,
    /// Count the instructions of this kernel's loops by kind, and do nothing else
    #[arg(long, value_name = "KERNEL", conflicts_with_all = ["json", "check", "bless", "frames"])]
    kinds: Option<String>,
}

impl Options {
    fn limit(&self) -> Duration {
        Duration::from_secs(self.timeout)
    }
}

/// Which compiler builds the images.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Prefer {
    /// rustup's if it has the target or can fetch it, else Debian's
    Auto,
    /// rustup's toolchain and its prebuilt `core`
    Rustup,
    /// Debian's rustc-web with -Zbuild-std
    Web,
}

fn main() -> ExitCode {
    let done = match Cli::parse().task {
        Task::Target(options) => match &options.kinds {
            Some(kernel) => kinds::run(&options, kernel),
            None => target(&options),
        },
        Task::Count(options) => count::run(&options),
        Task::Exhaust(options) => exhaust::run(&options),
        Task::FuzzCodec(options) => fuzz_codec::run(&options),
        Task::PeersImages(options) => peers_images::run(&options),
        Task::Readme => readme::run(),
        Task::Drivers => drivers::run(),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs everything; false where something was found wrong.
fn target(options: &Options) -> Result<bool> {
    let chosen = targets::choose(&options.targets)?;
    emulator::find_all(&chosen)?;
    let slower = if options.bless { gate::slower()? } else { Vec::new() };
    let mut report = report::Report::default();
    for (i, target) in chosen.iter().enumerate() {
        let compiler = toolchain::find(target, options.toolchain)?;
        eprintln!("{}: {compiler}", target.triple);
        let frames = options.frames.as_deref().filter(|_| i == 0);
        report.targets.push(measure::measure(
            target,
            &compiler,
            options.limit(),
            frames,
            if target.triple == targets::ALL[0].triple { &slower } else { &[] },
        )?);
    }
    host::compare(&mut report);
    if let Err(error) = valgrind::count(&mut report) {
        eprintln!("no counts on the host: {error:#}");
    }
    if options.bless {
        gate::bless(&report)?;
        readme::run()?;
    }
    gate::check(&mut report, options.check || options.bless)?;
    if options.json {
        report.print_json()?
    } else {
        report.print_tables()
    }
    Ok(report.verdict())
}
