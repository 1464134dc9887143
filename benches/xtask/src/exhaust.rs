//! `cargo xtask exhaust`: all `2^32` inputs of the elementary functions, and the committed table of what was
//! found.
//!
//! `--check` takes a stride instead of all inputs. It holds each promise, finds no error above the table's,
//! and the table's worst input must still give the table's error to the last digit: so a kernel cannot change
//! without its row being measured again.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use attractor_reference::Elementary;
use attractor_tests::exhaust::{ALL, Sweep};
use clap::Args;
use serde::{Deserialize, Serialize};

/// What `cargo xtask exhaust` is asked.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Only these functions [default: all]
    #[arg(value_name = "FUNCTION", value_parser = clap::builder::PossibleValuesParser::new(ALL.map(|s| s.name)))]
    functions: Vec<String>,
    /// Every so manieth input; 1 is all of them
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    stride: u32,
    /// Fail when a row of tests/exhaust.toml is not what the kernel does now
    #[arg(long, conflicts_with = "bless")]
    check: bool,
    /// Write tests/exhaust.toml; all inputs only
    #[arg(long, conflicts_with = "stride")]
    bless: bool,
}

/// A row of the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    function: String,
    inputs: String,
    /// The word at which the error is largest, the first of several.
    worst_input: u32,
    /// The magnitude of the error there.
    error: f64,
    /// What the documentation promises.
    promised: f64,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(default)]
    row: Vec<Row>,
}

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/exhaust.toml")
}

/// Sweeps; false where something was found wrong.
pub(crate) fn run(options: &Options) -> Result<bool> {
    let truth = Elementary::new();
    let chosen =
        ALL.iter().filter(|s| options.functions.is_empty() || options.functions.iter().any(|f| f == s.name));
    let mut table = Table::default();
    if options.check || options.bless && !options.functions.is_empty() {
        let text = std::fs::read_to_string(path()).context("tests/exhaust.toml cannot be read")?;
        table = toml::from_str(&text).context("tests/exhaust.toml")?;
    }
    let mut good = true;
    println!("{:28} {:>12} {:>12} {:>10}", "function", "worst input", "error", "promised");
    for sweep in chosen {
        let start = Instant::now();
        let found = worst(sweep, &truth, options.stride);
        println!(
            "{:28} {:#012x} {:12.5e} {:10.2e}   {:.0} s",
            found.function,
            found.worst_input,
            found.error,
            found.promised,
            start.elapsed().as_secs_f64()
        );
        let mut complain = |problem: String| {
            eprintln!("{}: {problem}", sweep.name);
            good = false;
        };
        if found.error > sweep.bound {
            complain(format!("the error is above the promised {:e}", sweep.bound));
        }
        let row = table.row.iter_mut().find(|row| row.function == sweep.name);
        if options.check {
            match row {
                None => complain("no row in tests/exhaust.toml".to_owned()),
                Some(row) => {
                    let again = (sweep.error)(&truth, row.worst_input);
                    if (again, sweep.bound) != (row.error, row.promised) || found.error > row.error {
                        complain(
                            "tests/exhaust.toml is of another kernel: cargo xtask exhaust --bless".to_owned(),
                        );
                    }
                }
            }
        } else if let Some(row) = row {
            *row = found;
        } else {
            table.row.push(found);
        }
    }
    if options.bless {
        ensure!(good, "nothing was written");
        let text = toml::to_string(&table).context("a table")?;
        let head = "# The largest error over all 2^32 inputs; written by `cargo xtask exhaust --bless`.\n\n";
        std::fs::write(path(), format!("{head}{text}")).context("tests/exhaust.toml cannot be written")?;
    }
    Ok(good)
}

/// The worst of the inputs, on all processors.
fn worst(sweep: &Sweep, truth: &Elementary, stride: u32) -> Row {
    const CHUNKS: u32 = 1 << 12;
    const LENGTH: u32 = 1 << 20;
    let next = AtomicU32::new(0);
    let work = || {
        let mut worst = (0.0, 0);
        loop {
            let chunk = next.fetch_add(1, Ordering::Relaxed);
            if chunk >= CHUNKS {
                return worst;
            }
            let first = chunk * LENGTH;
            // a multiple of the stride, wherever the chunk begins
            let skip = (stride - first % stride) % stride;
            for offset in (skip..LENGTH).step_by(stride as usize) {
                let word = first + offset;
                let error = (sweep.error)(truth, word);
                if error > worst.0 {
                    worst = (error, word);
                }
            }
        }
    };
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let found = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..processors).map(|_| scope.spawn(work)).collect();
        workers.into_iter().map(|w| w.join().expect("a sweep does not panic")).collect::<Vec<_>>()
    });
    // the largest error; of equal ones the first input
    let (error, worst_input) =
        found.into_iter().max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).unwrap_or_default();
    Row {
        function: sweep.name.to_owned(),
        inputs: sweep.inputs.to_owned(),
        worst_input,
        error,
        promised: sweep.bound,
    }
}
