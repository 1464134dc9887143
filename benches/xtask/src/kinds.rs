//! Counts the instructions of a kernel's loops by kind: what `budgets.toml` asks for where a kernel loses against floating point.
//!
//! QEMU disassembles and logs every instruction (`-singlestep -d in_asm,exec,nochain`). The image is run once with one run of the
//! loop and once with two; the difference is the loop.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, bail};

use attractor_workload::kernels;

use crate::targets;
use crate::{Options, emulator, images, toolchain};

/// Prints the histogram of each format's loop.
pub(crate) fn run(options: &Options, name: &str) -> Result<bool> {
    // the image is told the row: its arguments cannot hold spaces
    let row = kernels::ALL.iter().position(|kernel| kernel.name == name);
    let Some((index, kernel)) = row.and_then(|row| Some((row.to_string(), kernels::ALL.get(row)?))) else {
        let names: Vec<_> = kernels::ALL.iter().map(|kernel| kernel.name).collect();
        bail!("no kernel {name}; there are {}", names.join(", "));
    };
    for target in targets::choose(&options.targets)?.into_iter().take(1) {
        emulator::find_all(&[target])?;
        let compiler = toolchain::find(target, options.toolchain)?;
        let images = images::build(target, &compiler)?;
        for (format, work) in [("fixed", Some(kernel.fixed)), ("f32", kernel.f32), ("f64", kernel.f64)] {
            if work.is_none() {
                continue;
            }
            let (units, once) = histogram(target, images.path("kernels")?, options, &index, format, 1)?;
            let (_, mut twice) = histogram(target, images.path("kernels")?, options, &index, format, 2)?;
            for (instruction, count) in once {
                *twice.entry(instruction).or_default() -= count;
            }
            print(
                &format!("{name} {format}, instructions a {}", kernel.unit),
                &twice,
                f64::from(units.max(1)),
            );
        }
    }
    Ok(true)
}

/// The units of one run, and how often each mnemonic was executed.
fn histogram(
    target: &targets::Target,
    image: &Path,
    options: &Options,
    index: &str,
    format: &str,
    times: u32,
) -> Result<(u32, BTreeMap<String, i64>)> {
    let log = std::env::temp_dir().join(format!("attractor-{}.log", std::process::id()));
    let machine = target.counting.unwrap_or(target.machine);
    let switches = ["-singlestep", "-d", "in_asm,exec,nochain", "-D", &log.display().to_string()];
    let times = times.to_string();
    let done =
        emulator::run(&machine, image, &[index, format, &times], &switches, Path::new("."), options.limit());
    let text = std::fs::read_to_string(&log).context("QEMU wrote no log");
    // the log is of no use whatever happened
    let _ = std::fs::remove_file(&log);
    let units = done?.trim().parse().context("the image did not say its units")?;
    Ok((units, count(&text?)))
}

/// Reads QEMU's log: `0x00000400:  b580  push {r7, lr}` where an instruction is translated, `Trace 0: 0x7f.. [../00000400/..]` where
/// it is executed.
fn count(log: &str) -> BTreeMap<String, i64> {
    let mut mnemonics = BTreeMap::<u64, String>::new();
    let mut counts = BTreeMap::new();
    for line in log.lines() {
        if let Some(rest) = line.strip_prefix("Trace ") {
            let address = rest.split(['[', ']']).nth(1).and_then(|fields| fields.split('/').nth(1));
            if let Some(address) = address.and_then(|text| u64::from_str_radix(text, 16).ok()) {
                let mnemonic = mnemonics.get(&address).cloned().unwrap_or_else(|| "?".to_owned());
                *counts.entry(mnemonic).or_default() += 1;
            }
        } else if let Some((address, rest)) = line.strip_prefix("0x").and_then(|rest| rest.split_once(':')) {
            let is_code =
                |word: &&str| word.len().is_multiple_of(4) && word.chars().all(|c| c.is_ascii_hexdigit());
            let mnemonic = rest.split_whitespace().find(|word| !is_code(word));
            if let (Ok(address), Some(mnemonic)) = (u64::from_str_radix(address, 16), mnemonic) {
                mnemonics.insert(address, mnemonic.to_owned());
            }
        }
    }
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
        let log = "----------------\nIN: \n0x00000400:  fb01 f002  mul      r0, r1, r2\n\n\
                   Trace 0: 0x7f00 [00000000/00000400/00000110/ff000000] \nTrace 0: 0x7f00 [00000000/00000400/00000110/ff000000] \n";
        assert_eq!(count(log), BTreeMap::from([("mul".to_owned(), 2)]));
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
