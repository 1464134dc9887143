//! Holds what was measured against two committed tables.
//!
//! - `counts.toml`, written by `--bless`: what was measured last, for each target and each compiler. Growth
//!   by more than 3 % is a finding.
//! - `budgets.toml`, written by hand: what each figure may be at most, and why a kernel may lose against
//!   floating point.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::{Context, Result};
use serde::Deserialize;

use crate::images;
use crate::report::{KernelRow, Measured, Report, grouped};
use crate::targets;

/// How much a figure may grow, in percent, before it must be blessed.
const TOLERANCE: f64 = 3.0;
/// Soft f64 must be slower by this factor.
const F64_FACTOR: f64 = 20.0;

/// Target, then release of the compiler, then kind of figure, then name.
pub(crate) type Counts = BTreeMap<String, BTreeMap<String, BTreeMap<String, BTreeMap<String, Figure>>>>;

/// One figure, or one for each format.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Figure {
    One(f64),
    Each(BTreeMap<String, f64>),
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Budgets {
    #[serde(default)]
    budget: Vec<Budget>,
    #[serde(default)]
    slower: Vec<Slower>,
}

/// A figure of the first target that must not be exceeded.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Budget {
    of: Of,
    name: String,
    at_most: f64,
    /// Why it is exceeded all the same, for the time being.
    #[serde(default)]
    why: Option<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Of {
    /// Instructions a unit.
    Kernel,
    /// Instructions a picture.
    Scene,
    /// Bytes of an image.
    Flash,
    /// Bytes of a scene's objects.
    Ram,
    /// Bytes of stack that a scene takes.
    Stack,
    /// The most bytes of stack that an image can take, what it lends included.
    ImageStack,
}

/// A kernel that takes more than f32 on the FPU, or more than a twentieth of soft f64, and why.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Slower {
    kernel: String,
    than: Vec<Format>,
    why: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Format {
    F32,
    F64,
}

/// The kernels that `budgets.toml` excuses: `counts.toml` says by kind what they take.
pub(crate) fn slower() -> Result<Vec<String>> {
    let mut names: Vec<String> =
        read::<Budgets>("budgets.toml")?.slower.into_iter().map(|s| s.kernel).collect();
    names.dedup();
    Ok(names)
}

fn path(name: &str) -> PathBuf {
    images::package().join(name)
}

pub(crate) fn read<T: serde::de::DeserializeOwned>(name: &str) -> Result<T> {
    let text = std::fs::read_to_string(path(name))
        .with_context(|| format!("benches/cortex-m/{name} cannot be read"))?;
    toml::from_str(&text).with_context(|| format!("benches/cortex-m/{name}"))
}

/// Compares; findings are problems when `strict`, else warnings.
pub(crate) fn check(report: &mut Report, strict: bool) -> Result<()> {
    report.gather();
    let (counts, budgets): (Counts, Budgets) = (read("counts.toml")?, read("budgets.toml")?);
    let mut findings = Vec::new();
    for measured in &report.targets {
        growth(measured, &counts, &mut findings);
        if measured.target.triple == targets::ALL[0].triple {
            over_budget(measured, &budgets.budget, &mut findings, &mut report.warnings);
            against_floats(&measured.kernels, &budgets.slower, &mut findings, &mut report.warnings);
            let kinds =
                counts.get(measured.target.triple).and_then(|releases| releases.get(&measured.release));
            let kinds = kinds.and_then(|table| table.get(KINDS));
            by_kind(&measured.kernels, &budgets.slower, kinds, &mut findings);
        }
    }
    if strict { &mut report.problems } else { &mut report.warnings }.append(&mut findings);
    Ok(())
}

/// The figures of one target, by kind and name, as the table keeps them.
fn figures(measured: &Measured) -> BTreeMap<String, BTreeMap<String, Figure>> {
    let mut kinds = BTreeMap::<String, BTreeMap<String, Figure>>::new();
    let mut put = |kind: &str, name: String, figure| {
        kinds.entry(kind.to_owned()).or_default().insert(name, figure);
    };
    for row in &measured.scenes {
        if let Some(instructions) = row.instructions {
            put("scenes", row.key(), Figure::One(instructions as f64));
        }
        put("stack", row.key(), Figure::One(row.stack_bytes as f64));
        put("ram", row.key(), Figure::One(row.ram_bytes as f64));
    }
    for row in &measured.kernels {
        let each = [("fixed", row.fixed), ("f32", row.f32), ("f64", row.f64)];
        let each = each.into_iter().filter_map(|(format, v)| Some((format.to_owned(), v?))).collect();
        put("kernels", row.name.clone(), Figure::Each(each));
    }
    for (name, kinds) in &measured.kinds {
        let hundredths = |v: f64| (v * 100.0).round() / 100.0;
        let each = kinds.iter().map(|(kind, count)| ((*kind).to_owned(), hundredths(*count)));
        put(KINDS, name.clone(), Figure::Each(each.collect()));
    }
    for row in &measured.flash {
        put("flash", row.name.clone(), Figure::One(row.bytes as f64));
        if let Some(bytes) = row.stack {
            put("image-stack", row.name.clone(), Figure::One(bytes as f64));
        }
    }
    kinds
}

/// The kind of figure that says what an excused kernel's instructions are; written by `--bless` alone.
const KINDS: &str = "kinds";

/// Every excused kernel that is not too long to be logged has its instructions by kind beside it, and they
/// add up to what it takes.
fn by_kind(
    kernels: &[KernelRow],
    slower: &[Slower],
    kinds: Option<&BTreeMap<String, Figure>>,
    findings: &mut Vec<String>,
) {
    for row in kernels.iter().filter(|row| slower.iter().any(|s| s.kernel == row.name)) {
        let (Some(fixed), Some(kinds)) = (row.fixed, kinds) else { continue };
        match kinds.get(&row.name) {
            Some(Figure::Each(each)) => {
                let sum: f64 = each.values().sum();
                // what reading the counter takes is spread over the units
                if (sum - fixed).abs() > fixed * TOLERANCE / 100.0 + 1.0 {
                    findings.push(format!(
                        "kinds {} of counts.toml add up to {sum:.2}, the kernel takes {fixed:.2}: --bless counts them again",
                        row.name
                    ));
                }
            }
            _ => findings.push(format!("counts.toml does not say by kind what {} takes: --bless", row.name)),
        }
    }
}

/// What counts against growth: a figure, or that of fixed point. Floating point is there for comparison only.
fn gated(figure: &Figure) -> Option<f64> {
    match figure {
        Figure::One(value) => Some(*value),
        Figure::Each(each) => each.get("fixed").copied(),
    }
}

fn growth(measured: &Measured, counts: &Counts, findings: &mut Vec<String>) {
    let triple = measured.target.triple;
    let Some(table) = counts.get(triple).and_then(|releases| releases.get(&measured.release)) else {
        findings.push(format!(
            "counts.toml has no counts for {triple} by rustc {}: look at them, then --bless",
            measured.release
        ));
        return;
    };
    let now = figures(measured);
    for (kind, names) in &now {
        for (name, figure) in names {
            let before = table.get(kind).and_then(|names| names.get(name)).and_then(gated);
            match (before, gated(figure)) {
                (Some(before), Some(now)) if now > before * (1.0 + TOLERANCE / 100.0) + 1e-9 => {
                    let growth = (now / before - 1.0) * 100.0;
                    findings.push(format!(
                        "{kind} {name} on {triple} grew by {growth:.1} %, from {before} to {now}"
                    ));
                }
                (None, Some(now)) => {
                    findings.push(format!(
                        "{kind} {name} on {triple} is new ({now}): --bless puts it into counts.toml"
                    ));
                }
                _ => {}
            }
        }
    }
    for (kind, names) in table.iter().filter(|(kind, _)| *kind != KINDS) {
        for name in names.keys() {
            if !now.get(kind).is_some_and(|names| names.contains_key(name)) {
                findings.push(format!("{kind} {name} of counts.toml was not measured on {triple}"));
            }
        }
    }
}

fn over_budget(
    measured: &Measured,
    budgets: &[Budget],
    findings: &mut Vec<String>,
    warnings: &mut Vec<String>,
) {
    for budget in budgets {
        let name = &budget.name;
        let scene = || measured.scenes.iter().find(|row| row.key() == *name);
        let figure = match budget.of {
            Of::Kernel => measured.kernels.iter().find(|row| row.name == *name).and_then(|row| row.fixed),
            Of::Scene => scene().and_then(|row| row.instructions).map(|n| n as f64),
            Of::Flash => measured.flash.iter().find(|row| row.name == *name).map(|row| row.bytes as f64),
            Of::Ram => scene().map(|row| row.ram_bytes as f64),
            Of::Stack => scene().map(|row| row.stack_bytes as f64),
            Of::ImageStack => {
                let row = measured.flash.iter().find(|row| row.name == *name);
                row.and_then(|row| row.stack).map(|bytes| bytes as f64)
            }
        };
        let what = format!("{:?} {name}", budget.of).to_lowercase();
        match (figure, &budget.why) {
            (None, _) => findings.push(format!("{what} has a budget but was not measured")),
            (Some(figure), Some(why)) if figure > budget.at_most => {
                warnings.push(format!("{what} is over budget: {figure}, at most {} ({why})", budget.at_most));
            }
            (Some(figure), None) if figure > budget.at_most => {
                findings.push(format!("{what} is over budget: {figure}, at most {}", budget.at_most));
            }
            (Some(_), Some(_)) => warnings.push(format!("{what} is within its budget: its excuse can go")),
            _ => {}
        }
    }
}

fn against_floats(
    kernels: &[KernelRow],
    slower: &[Slower],
    findings: &mut Vec<String>,
    warnings: &mut Vec<String>,
) {
    for row in kernels {
        let Some(fixed) = row.fixed else { continue };
        let limits = [
            (Format::F32, row.f32, "f32 on the FPU"),
            (Format::F64, row.f64.map(|v| v / F64_FACTOR), "1/20 of soft f64"),
        ];
        for (format, limit, what) in limits {
            let Some(limit) = limit else { continue };
            let excuse = slower.iter().find(|s| s.kernel == row.name && s.than.contains(&format));
            match excuse {
                None if fixed > limit => findings.push(format!(
                    "kernel {} takes {fixed:.2}, {what} is {limit:.2}: say why in budgets.toml, with the instructions by kind (--kinds)",
                    row.name
                )),
                Some(_) if fixed <= limit => {
                    warnings.push(format!("kernel {} is no slower than {what}: its excuse can go", row.name));
                }
                _ => {}
            }
        }
    }
    for excuse in slower {
        if excuse.why.trim().is_empty() || !kernels.iter().any(|row| row.name == excuse.kernel) {
            findings.push(format!("budgets.toml excuses {} without a reason or without need", excuse.kernel));
        }
    }
}

/// Writes what was measured into `counts.toml`. Other targets and compilers keep their lines.
pub(crate) fn bless(report: &Report) -> Result<()> {
    let mut counts: Counts = if path("counts.toml").exists() { read("counts.toml")? } else { Counts::new() };
    for measured in &report.targets {
        counts
            .entry(measured.target.triple.to_owned())
            .or_default()
            .insert(measured.release.clone(), figures(measured));
    }
    let mut text = String::from(
        "# What the target needed when this was last blessed: `cargo xtask target --bless` writes it, `--check` compares.\n\
         # Instructions a picture, instructions a unit of work, bytes. Comments do not survive: reasons are in budgets.toml.\n",
    );
    for (target, releases) in &counts {
        for (release, kinds) in releases {
            for (kind, names) in kinds {
                write!(text, "\n[{target}.{release:?}.{kind}]\n")?;
                for (name, figure) in names {
                    match figure {
                        Figure::One(value) => writeln!(text, "{name:?} = {value}")?,
                        Figure::Each(each) => {
                            // in this order; kinds in that of the alphabet
                            let formats = ["fixed", "f32", "f64"];
                            let others = each.keys().map(String::as_str).filter(|key| !formats.contains(key));
                            let each: Vec<_> = formats
                                .into_iter()
                                .chain(others)
                                .filter_map(|key| {
                                    each.get(key).map(|value| format!("{} = {value}", key.replace(' ', "-")))
                                })
                                .collect();
                            writeln!(text, "{name:?} = {{ {} }}", each.join(", "))?;
                        }
                    }
                }
            }
        }
    }
    let (table, aside) = (path("counts.toml"), path("counts.toml.new"));
    std::fs::write(&aside, text)?;
    std::fs::rename(&aside, &table)?;
    eprintln!(
        "wrote {} figures to benches/cortex-m/counts.toml",
        grouped(report.targets.iter().map(len).sum())
    );
    Ok(())
}

fn len(measured: &Measured) -> u64 {
    figures(measured).values().map(|names| names.len() as u64).sum()
}
