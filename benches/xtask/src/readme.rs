//! `cargo xtask readme`: the tables of README.md that say how large and how fast, from `counts.toml`.
//!
//! Which rows, in which order and under which names: `benches/cortex-m/readme.toml`. They stand between two
//! comments in README.md, and a test fails while they are not what the counts say.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use serde::Deserialize;

use crate::gate::{self, Counts, Figure};
use crate::report::grouped;
use crate::targets;

/// The rows, in their order.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    work: Vec<Work>,
    picture: Vec<Picture>,
    room: Vec<Room>,
    small: Vec<Small>,
}

/// Kernels: fixed point and single precision on each target.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Work {
    text: String,
    kernels: Vec<String>,
}

/// A whole picture on each target: a scene, or a kernel whose unit is a picture.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Picture {
    text: String,
    scene: Option<String>,
    kernel: Option<String>,
}

/// Bytes on the first target.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Room {
    text: String,
    scene: String,
    image: String,
}

/// Scenes on the smallest target.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Small {
    text: String,
    scenes: Vec<String>,
}

const BEGIN: &str = "<!-- counts: `cargo xtask readme` writes what stands from here -->\n";
const END: &str = "<!-- to here -->";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../README.md")
}

/// Writes the tables into README.md.
pub(crate) fn run() -> Result<bool> {
    let text = std::fs::read_to_string(path()).context("README.md cannot be read")?;
    std::fs::write(path(), with_tables(&text)?).context("README.md cannot be written")?;
    Ok(true)
}

/// README.md with its tables as the counts have them.
fn with_tables(readme: &str) -> Result<String> {
    let (before, rest) = readme.split_once(BEGIN).with_context(|| format!("README.md has no {BEGIN}"))?;
    let (_, after) = rest.split_once(END).with_context(|| format!("README.md has no {END}"))?;
    Ok(format!("{before}{BEGIN}\n{}\n{END}{after}", tables()?))
}

/// What `counts.toml` has for the targets by the pinned compiler.
struct Counted(Vec<BTreeMap<String, BTreeMap<String, Figure>>>);

impl Counted {
    fn new() -> Result<Self> {
        let mut counts: Counts = gate::read("counts.toml")?;
        let pinned = std::fs::read_to_string(path().with_file_name("rust-toolchain.toml"))?;
        let mut tables = Vec::new();
        for target in targets::ALL {
            let mut releases = counts.remove(target.triple).unwrap_or_default();
            releases.retain(|release, _| pinned.contains(&format!("{release:?}")));
            let table = releases.into_values().next();
            tables.push(table.with_context(|| format!("no counts for {}", target.triple))?);
        }
        Ok(Self(tables))
    }

    /// A figure of a target; of a kernel that of this format.
    fn figure(&self, target: usize, kind: &str, name: &str, format: &str) -> Option<f64> {
        match self.0.get(target)?.get(kind)?.get(name)? {
            Figure::One(value) => Some(*value),
            Figure::Each(each) => each.get(format).copied(),
        }
    }

    /// A figure that must be there.
    fn bytes(&self, target: usize, kind: &str, name: &str) -> Result<u64> {
        let figure = self.figure(target, kind, name, "").map(|bytes| bytes as u64);
        figure.with_context(|| format!("counts.toml has no {kind} of {name}"))
    }
}

fn tables() -> Result<String> {
    let (counted, rows): (Counted, Rows) = (Counted::new()?, gate::read("readme.toml")?);
    let mut text = String::from(
        "| work | Cortex-M4; f32 | Cortex-M0; soft f32 | RV32IMAC; soft f32 |\n| --- | --- | --- | --- |\n",
    );
    for row in &rows.work {
        write!(text, "| {} |", row.text)?;
        for target in 0..targets::ALL.len() {
            cell_of(&mut text, &work(&counted, target, &row.kernels))?;
        }
        let first = &row.kernels[0];
        ensure!(counted.figure(0, "kernels", first, "fixed").is_some(), "counts.toml has no kernel {first}");
        text.push('\n');
    }
    text.push_str("\n| picture | Cortex-M4 | Cortex-M0 | RV32IMAC |\n| --- | --- | --- | --- |\n");
    for row in &rows.picture {
        write!(text, "| {} |", row.text)?;
        let (kind, name) = match (&row.scene, &row.kernel) {
            (Some(scene), _) => ("scenes", scene),
            (_, kernel) => ("kernels", kernel.as_ref().with_context(|| row.text.clone())?),
        };
        ensure!(counted.figure(0, kind, name, "fixed").is_some(), "counts.toml has no {kind} {name}");
        for target in 0..targets::ALL.len() {
            let cell = counted.figure(target, kind, name, "fixed").map(millions).unwrap_or_default();
            cell_of(&mut text, &cell)?;
        }
        text.push('\n');
    }
    text.push_str(
        "\n| picture, on a Cortex-M4 | RAM of the scene | stack of drawing | flash of an image that draws nothing else; its \
         stack, set-up included |\n| --- | --- | --- | --- |\n",
    );
    for Room { text: name, scene, image } in &rows.room {
        let [ram, stack] = [counted.bytes(0, "ram", scene)?, counted.bytes(0, "stack", scene)?].map(grouped);
        let flash = grouped(counted.bytes(0, "flash", image)?);
        let all = grouped(counted.bytes(0, "image-stack", image)?);
        writeln!(text, "| {name} | {ram} bytes | {stack} bytes | {flash} bytes; {all} bytes |")?;
    }
    text.push_str(
        "\n| picture, on a Cortex-M0, 128 x 64 in one bit | RAM of the scene | stack of drawing | instructions |\n\
         | --- | --- | --- | --- |\n",
    );
    let small = targets::ALL.iter().position(|target| target.small).context("no small target")?;
    for Small { text: name, scenes } in &rows.small {
        let range = |kind: &str| -> Result<(u64, u64)> {
            let figures: Result<Vec<_>> =
                scenes.iter().map(|scene| counted.bytes(small, kind, scene)).collect();
            let figures = figures?;
            Ok((figures.iter().copied().min().unwrap_or(0), figures.iter().copied().max().unwrap_or(0)))
        };
        let bytes = |(least, most): (u64, u64)| match least == most {
            true => format!("{} bytes", grouped(most)),
            false => format!("{} to {} bytes", grouped(least), grouped(most)),
        };
        let (least, most) = range("scenes")?;
        let counts = match least == most {
            true => millions(most as f64),
            false => format!("{} to {}", millions(least as f64), millions(most as f64)),
        };
        writeln!(text, "| {name} | {} | {} | {counts} |", bytes(range("ram")?), bytes(range("stack")?))?;
    }
    Ok(text)
}

fn cell_of(text: &mut String, cell: &str) -> Result<()> {
    match cell {
        "" => text.push_str(" |"),
        cell => write!(text, " {cell} |")?,
    }
    Ok(())
}

/// `fixed, fixed; f32, f32` of some kernels on one target; what was not measured there is left out.
fn work(counted: &Counted, target: usize, kernels: &[String]) -> String {
    let of = |format: &str| -> Vec<String> {
        let each = kernels.iter().map(|name| counted.figure(target, "kernels", name, format).map(units));
        match each.clone().all(|cell| cell.is_none()) {
            true => Vec::new(),
            false => each.map(|cell| cell.unwrap_or_else(|| "-".to_owned())).collect(),
        }
    };
    let (fixed, single) = (of("fixed"), of("f32"));
    let formats: Vec<_> = [fixed, single].iter().filter(|f| !f.is_empty()).map(|f| f.join(", ")).collect();
    formats.join("; ")
}

/// Instructions a unit: a digit after the point where it is an inner loop.
fn units(instructions: f64) -> String {
    if instructions < 30.0 { format!("{instructions:.1}") } else { grouped(instructions.round() as u64) }
}

/// Instructions a picture.
fn millions(instructions: f64) -> String {
    let millions = instructions / 1e6;
    if millions < 100.0 { format!("{millions:.1} M") } else { format!("{millions:.0} M") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_readme_says_what_is_counted() {
        let readme = std::fs::read_to_string(path()).unwrap();
        let stale = "README.md is not what counts.toml says: cargo xtask readme";
        assert!(with_tables(&readme).unwrap() == readme, "{stale}");
    }

    #[test]
    fn figures_are_short() {
        assert_eq!(
            (units(13.03), units(151_000.4), millions(11_480_000.0)),
            ("13.0".into(), "151,000".into(), "11.5 M".into())
        );
    }
}
