//! The `attractor` command: fractals of the fixed-point kernel as PNG files, as CSV, or in a window.
//!
//! Bad input is one line on standard error and exit code 2; a reader that closes the pipe is no error.

mod accuracy;
mod boxes;
mod brdf;
mod builtin;
mod canvas;
mod cli;
mod color;
mod cover;
mod decode;
mod dimension;
mod dump;
mod encode;
mod export;
mod fail;
mod fit;
mod inspect;
mod lines;
mod list;
mod number;
mod output;
mod palette;
mod reconstruction;
mod sample;
mod scene;
mod slopes;
mod source;
mod spectrum;
mod still;
mod table;
mod theory;
mod window;

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Parser;

use cli::{Cli, Command};
use fail::Fail;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return cli::explain(&error),
    };
    let done = match &cli.command {
        None | Some(Command::List) => list::run(),
        Some(Command::Dump(args)) => dump::run(args),
        Some(Command::Sample(args)) => sample::run(args),
        Some(Command::Export(args)) => export::run(args),
        Some(Command::Brdf(args)) => brdf::run(args),
        Some(Command::Encode(args)) => encode::run(args),
        Some(Command::Decode(args)) => decode::run(args),
        Some(Command::Inspect(args)) => inspect::run(args),
        Some(Command::Accuracy(args)) => accuracy::run(args),
        Some(Command::Dimension(args)) => dimension::run(args),
        Some(Command::Spectrum(args)) => spectrum::run(args),
        Some(Command::Fit(args)) => reconstruction::run(args, scene::check),
        Some(Command::Window(args)) => window::run(args),
    };
    let done = done.and_then(|()| Ok(io::stdout().flush()?));
    match done {
        Ok(()) | Err(Fail::ClosedPipe) => ExitCode::SUCCESS,
        Err(Fail::Message(message)) => {
            fail::say(&message);
            ExitCode::from(2)
        }
    }
}
