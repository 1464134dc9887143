//! Counts the instructions of a kernel's loops by kind: what `budgets.toml` asks for where a kernel loses
//! against floating point.
//!
//! QEMU disassembles and logs every block of instructions without a branch (`-d in_asm,exec,nochain`). The
//! image is run once with one run of the loop and once with two; the difference is the loop.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use attractor_workload::kernels;

use crate::targets;
use crate::{Options, emulator, images, toolchain};

/// QEMU writes some 20 bytes an instruction: longer loops are not logged.
const LONGEST: u64 = 20_000_000;

/// Prints the histogram of each format's loop.
pub(crate) fn run(options: &Options, name: &str) -> Result<bool> {
    let Some(kernel) = kernels::ALL.iter().find(|kernel| kernel.name == name) else {
        let names: Vec<_> = kernels::ALL.iter().map(|kernel| kernel.name).collect();
        bail!("no kernel {name}; there are {}", names.join(", "));
    };
    for target in targets::choose(&options.targets)?.into_iter().take(1) {
        emulator::find_all(&[target])?;
        let compiler = toolchain::find(target, options.toolchain)?;
        let image = &images::one(target, &compiler, "kernels")?;
        for (format, work) in [("fixed", Some(kernel.fixed)), ("f32", kernel.f32), ("f64", kernel.f64)] {
            if work.is_none() {
                continue;
            }
            match (Loop { target, image, limit: options.limit(), name, format }).mnemonics()? {
                Ok((counts, units)) => {
                    print(&format!("{name} {format}, instructions a {}", kernel.unit), &counts, units);
                }
                Err(instructions) => println!(
                    "{name} {format}: {instructions} instructions are too many to log, at most {LONGEST}"
                ),
            }
        }
    }
    Ok(true)
}

/// The instructions of a unit of a kernel's fixed-point loop, by kind; none where there are too many to log.
pub(crate) fn of_fixed(
    target: &targets::Target,
    image: &Path,
    limit: Duration,
    name: &str,
) -> Result<Option<BTreeMap<&'static str, f64>>> {
    let counted = Loop { target, image, limit, name, format: "fixed" }.mnemonics()?;
    Ok(counted.ok().map(|(counts, units)| {
        let mut kinds = BTreeMap::new();
        for (mnemonic, count) in counts.iter().filter(|(_, count)| **count > 0) {
            *kinds.entry(kind(mnemonic)).or_default() += *count as f64 / units;
        }
        kinds
    }))
}

/// One loop of the image.
pub(crate) struct Loop<'a> {
    pub(crate) target: &'a targets::Target,
    pub(crate) image: &'a Path,
    pub(crate) limit: Duration,
    pub(crate) name: &'a str,
    pub(crate) format: &'a str,
}

/// How often each mnemonic was executed.
type Mnemonics = BTreeMap<String, i64>;

impl Loop<'_> {
    /// What one run executes, and its units; else the instructions that are too many.
    fn mnemonics(&self) -> Result<Result<(Mnemonics, f64), u64>> {
        let (units, instructions) = self.run(1, &[])?;
        if instructions > LONGEST {
            return Ok(Err(instructions));
        }
        let once = self.histogram(1)?;
        let mut twice = self.histogram(2)?;
        for (mnemonic, count) in once {
            *twice.entry(mnemonic).or_default() -= count;
        }
        Ok(Ok((twice, units.max(1) as f64)))
    }

    /// The units of one of `times` runs, and the instructions of all.
    pub(crate) fn run(&self, times: u32, switches: &[&str]) -> Result<(u64, u64)> {
        let machine = self.target.counting.unwrap_or(self.target.machine);
        let arguments = [&images::argument(self.name), self.format, &times.to_string()];
        let said = emulator::run(&machine, self.image, &arguments, switches, Path::new("."), self.limit)?;
        let numbers = said.trim().split_once(' ').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        numbers.with_context(|| format!("the image said {said:?} instead of its units and instructions"))
    }

    /// How often each mnemonic was executed.
    fn histogram(&self, times: u32) -> Result<Mnemonics> {
        let log = std::env::temp_dir().join(format!("attractor-{}.log", std::process::id()));
        let switches = ["-d", "in_asm,exec,nochain", "-D", &log.display().to_string()];
        let done = self.run(times, &switches);
        let text = std::fs::read_to_string(&log).context("QEMU wrote no log");
        // the log is of no use whatever happened
        let _ = std::fs::remove_file(&log);
        done?;
        Ok(count(&text?))
    }
}

/// Reads QEMU's log: `IN:` and lines like `0x00000400:  b580  push {r7, lr}` where a block is translated,
/// `Trace 0: 0x7f.. [..]` where it is executed; the number tells the blocks apart.
fn count(log: &str) -> BTreeMap<String, i64> {
    let mut counts = BTreeMap::new();
    let mut finish = |(mnemonics, times): (Vec<&str>, i64)| {
        for mnemonic in mnemonics {
            *counts.entry(mnemonic.to_owned()).or_default() += times;
        }
    };
    let mut blocks = HashMap::<&str, (Vec<&str>, i64)>::new();
    let mut translated = Vec::new();
    for line in log.lines() {
        if let Some(rest) = line.strip_prefix("Trace ") {
            let block = rest.split_whitespace().nth(1).unwrap_or_default();
            // a number that comes again with a translation before it belongs to another block
            if !translated.is_empty() {
                if let Some(replaced) = blocks.insert(block, (std::mem::take(&mut translated), 0)) {
                    finish(replaced);
                }
            }
            blocks.entry(block).or_default().1 += 1;
        } else if line.starts_with("IN:") {
            translated.clear();
        } else if let Some((_, rest)) = line.strip_prefix("0x").and_then(|rest| rest.split_once(':')) {
            let is_code =
                |word: &&str| word.len().is_multiple_of(4) && word.chars().all(|c| c.is_ascii_hexdigit());
            translated.extend(rest.split_whitespace().find(|word| !is_code(word)));
        }
    }
    blocks.into_values().for_each(finish);
    counts
}

/// The kind of an instruction.
fn kind(mnemonic: &str) -> &'static str {
    let starts = |prefixes: &[&str]| prefixes.iter().any(|prefix| mnemonic.starts_with(prefix));
    let base = mnemonic.split('.').next().unwrap_or(mnemonic);
    if starts(&["vldr", "vldm", "vpop", "ldr", "ldm", "pop", "lw", "lh", "lb", "c.lw"]) {
        "load"
    } else if starts(&["vstr", "vstm", "vpush", "str", "stm", "push", "sw", "sh", "sb", "c.sw"]) {
        "store"
    } else if mnemonic.starts_with('v') {
        "floating point"
    } else if starts(&["mul", "mla", "mls", "smul", "umul", "smla", "umla", "smm", "uma", "smuad", "smlsd"]) {
        "multiply"
    } else if starts(&["sdiv", "udiv", "div", "rem"]) {
        "divide"
    } else if matches!(
        base,
        "b" | "bl" | "bx" | "blx" | "cbz" | "cbnz" | "tbb" | "tbh" | "j" | "jal" | "jalr" | "ret"
    ) || base.len() == 3 && base.starts_with('b') && !matches!(base, "bic" | "bfi" | "bfc")
        || base.starts_with("it") && base.len() <= 5
        || starts(&["beq", "bne", "blt", "bge", "beqz", "bnez"])
    {
        "branch"
    } else if starts(&["lsl", "lsr", "asr", "ror", "sll", "srl", "sra", "sbfx", "ubfx", "bfi"]) {
        "shift"
    } else {
        "other"
    }
}

fn print(title: &str, counts: &BTreeMap<String, i64>, units: f64) {
    let mut kinds = BTreeMap::<&str, (i64, Vec<(i64, &str)>)>::new();
    for (mnemonic, count) in counts.iter().filter(|(_, count)| **count > 0) {
        let entry = kinds.entry(kind(mnemonic)).or_default();
        entry.0 += count;
        entry.1.push((*count, mnemonic));
    }
    let total: i64 = kinds.values().map(|(count, _)| count).sum();
    println!("{title}: {:.2}", total as f64 / units);
    for (kind, (count, mut mnemonics)) in kinds {
        mnemonics.sort_unstable_by(|a, b| b.cmp(a));
        let detail: Vec<_> = mnemonics
            .iter()
            .take(8)
            .map(|(n, mnemonic)| format!("{mnemonic} {:.2}", *n as f64 / units))
            .collect();
        println!("  {kind:<15} {:>8.2}  {}", count as f64 / units, detail.join(", "));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_is_counted_by_mnemonic() {
        let log = "----------------\nIN: \n0x00000400:  fb01 f002  mul      r0, r1, r2\n0x00000404:  4770       bx       lr\n\n\
                   Trace 0: 0x7f00 [00000000/00000400/00000110/ff000000] \nTrace 0: 0x7f00 [00000000/00000400/00000110/ff000000] \n\
                   IN: \n0x00000500:  b580  push     {r7, lr}\n\nTrace 0: 0x7f00 [00000000/00000500/00000110/ff000000] \n";
        let expected = [("bx", 2), ("mul", 2), ("push", 1)].map(|(name, count)| (name.to_owned(), count));
        assert_eq!(count(log), BTreeMap::from(expected));
    }

    #[test]
    fn instructions_fall_into_their_kinds() {
        let cases =
            [("smull", "multiply"), ("bne.w", "branch"), ("bic", "other"), ("vmla.f32", "floating point")];
        for (mnemonic, expected) in
            cases.into_iter().chain([("vldr", "load"), ("push", "store"), ("ittt", "branch")])
        {
            assert_eq!(kind(mnemonic), expected, "{mnemonic}");
        }
    }
}
