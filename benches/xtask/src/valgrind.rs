//! Instructions of the fixed-point loops on this host, where valgrind is installed: the column `host` of the
//! kernels.
//!
//! `benches/workload/examples/loops.rs`, built in release, runs under callgrind once for all kernels;
//! callgrind writes what it counted at each of the program's marks. The figures are the same on every run of
//! a binary, but belong to this machine's compiler and architecture: they are shown, not gated.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};
use serde_json::Value;

use attractor_workload::Blind;
use attractor_workload::kernels::{self, Watch};

use crate::emulator;
use crate::report::Report;

/// More repetitions in the second run of a loop.
const MORE: u32 = 20;
/// How callgrind introduces a part.
const MARK: &str = "desc: Trigger: --dump-before=loops::mark";

/// Fills in the column `host`; without valgrind it stays empty.
pub(crate) fn count(report: &mut Report) -> Result<()> {
    if !emulator::has("valgrind") {
        return Ok(());
    }
    let counts = measure(&build()?)?;
    for (kernel, count) in kernels::ALL.iter().zip(counts) {
        let units = (kernel.fixed)(&mut Watch::new(&mut Blind, 1)).units.max(1);
        let each = count as f64 / f64::from(MORE) / f64::from(units);
        for measured in &mut report.targets {
            if let Some(row) = measured.kernels.iter_mut().find(|row| row.name == kernel.name) {
                row.host = Some((each * 100.0).round() / 100.0);
            }
        }
    }
    Ok(())
}

fn build() -> Result<PathBuf> {
    let output = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")))
        .args(["build", "--release", "--package", "attractor-workload", "--example", "loops"])
        .arg("--message-format=json-render-diagnostics")
        .stdin(Stdio::null())
        .output()
        .context("cargo cannot be started")?;
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    let messages = lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let built = messages.filter_map(|message| message["executable"].as_str().map(PathBuf::from)).next_back();
    built.with_context(|| {
        format!("the loops for valgrind do not build:\n{}", String::from_utf8_lossy(&output.stderr))
    })
}

/// Instructions of `MORE` runs of each kernel's loop.
fn measure(program: &Path) -> Result<Vec<u64>> {
    let out = std::env::temp_dir().join(format!("attractor-{}.callgrind", std::process::id()));
    let ran = Command::new("valgrind")
        .args(["--tool=callgrind", "--combine-dumps=yes", "--dump-before=loops::mark"])
        .arg(format!("--callgrind-out-file={}", out.display()))
        .arg(program)
        .arg(MORE.to_string())
        .stdin(Stdio::null())
        .output()
        .context("valgrind cannot be started");
    let text = std::fs::read_to_string(&out);
    // nothing of it is of use afterwards, and there may be none
    let _ = std::fs::remove_file(&out);
    let ran = ran?;
    if !ran.status.success() {
        bail!("valgrind failed:\n{}", String::from_utf8_lossy(&ran.stderr));
    }
    differences(&text.context("valgrind wrote nothing")?)
}

/// What the second run of each loop took more than the first, from the parts that callgrind wrote.
fn differences(text: &str) -> Result<Vec<u64>> {
    let mut parts = Vec::new();
    let mut lines = text.lines();
    while lines.any(|line| line == MARK) {
        let summary = lines.find_map(|line| line.strip_prefix("summary: "));
        let count: u64 = summary.and_then(|n| n.trim().parse().ok()).context("a part without a summary")?;
        parts.push(count);
    }
    // before the first mark the program only starts
    let runs = parts.get(1..).unwrap_or(&[]);
    if runs.len() != 2 * kernels::ALL.len() {
        bail!("callgrind wrote {} parts, not two for each of {} kernels", runs.len(), kernels::ALL.len());
    }
    Ok(runs.chunks_exact(2).map(|runs| runs[1].saturating_sub(runs[0])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_is_the_difference_of_its_two_parts() {
        let part = |count: usize| format!("{MARK}\nevents: Ir\nsummary: {count}\nfn=(1)\ntotals: {count}\n");
        let mut text =
            String::from("desc: Trigger: --dump-before=_IO_unsave_markers\nsummary: 9\n") + &part(5);
        for i in 0..kernels::ALL.len() {
            text += &(part(100 + i) + &part(300 + 2 * i));
        }
        let counts = differences(&text).unwrap();
        assert_eq!((counts[0], counts[1], counts.len()), (200, 201, kernels::ALL.len()));
        assert!(differences(&part(5)).is_err());
    }
}
