//! What was measured, as tables and as JSON.

use std::collections::BTreeMap;

use anyhow::Result;
use comfy_table::{CellAlignment, Row, Table, presets};
use serde::Serialize;

use crate::lines::{KernelLine, SceneLine};
use crate::targets::Target;

/// Everything.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) targets: Vec<Measured>,
    /// What is wrong.
    pub(crate) problems: Vec<String>,
    /// What is worth knowing, and wrong only for `--check`.
    pub(crate) warnings: Vec<String>,
}

/// One target.
#[derive(Debug)]
pub(crate) struct Measured {
    pub(crate) target: &'static Target,
    /// Release of the compiler.
    pub(crate) release: String,
    pub(crate) scenes: Vec<SceneRow>,
    pub(crate) kernels: Vec<KernelRow>,
    pub(crate) flash: Vec<FlashRow>,
    /// Instructions of a unit by kind, for kernels of which that was asked.
    pub(crate) kinds: BTreeMap<String, BTreeMap<&'static str, f64>>,
    /// Whether it was asked for a scene that is too large for it.
    pub(crate) refused: bool,
    pub(crate) problems: Vec<String>,
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct SceneRow {
    pub(crate) name: String,
    pub(crate) size: String,
    pub(crate) target: &'static str,
    pub(crate) crc32: String,
    pub(crate) crc32_host: String,
    pub(crate) instructions: Option<u64>,
    pub(crate) stack_bytes: u64,
    pub(crate) ram_bytes: u64,
    pub(crate) pixels: u64,
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct KernelRow {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) fixed: Option<f64>,
    pub(crate) f32: Option<f64>,
    pub(crate) f64: Option<f64>,
    /// Fixed point on the host, where valgrind counts it.
    pub(crate) host: Option<f64>,
    pub(crate) checksum: String,
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct FlashRow {
    pub(crate) name: String,
    /// Code, constants and initial values, without the vector table.
    pub(crate) bytes: u64,
    pub(crate) data: u64,
    pub(crate) bss: u64,
    /// A bound on what it takes from its entry on, where there is one.
    pub(crate) stack: Option<u64>,
}

impl SceneRow {
    pub(crate) fn new(target: &Target, line: SceneLine) -> Self {
        Self {
            name: line.name,
            size: line.size,
            target: target.triple,
            crc32: line.crc32,
            crc32_host: String::new(),
            instructions: line.counted.then_some(line.instructions),
            stack_bytes: line.stack_bytes,
            ram_bytes: line.ram_bytes,
            pixels: line.pixels,
        }
    }

    /// Name and size: a scene is drawn in several sizes.
    pub(crate) fn key(&self) -> String {
        format!("{} {}", self.name, self.size)
    }
}

impl KernelRow {
    pub(crate) fn new(line: KernelLine) -> Self {
        let counted = |count: Option<f64>| count.filter(|_| line.counted);
        Self {
            name: line.name,
            unit: line.unit,
            fixed: counted(Some(line.fixed.per_unit())),
            f32: counted(line.f32.map(|count| count.per_unit())),
            f64: counted(line.f64.map(|count| count.per_unit())),
            host: None,
            checksum: line.fixed.checksum,
        }
    }
}

impl Measured {
    pub(crate) const fn new(target: &'static Target, release: String) -> Self {
        Self {
            target,
            release,
            scenes: Vec::new(),
            kernels: Vec::new(),
            flash: Vec::new(),
            kinds: BTreeMap::new(),
            refused: false,
            problems: Vec::new(),
        }
    }
}

/// The JSON: kernels and flash are the first target's, the others' stand under `also`.
#[derive(Serialize)]
struct Json<'a> {
    scenes: Vec<&'a SceneRow>,
    kernels: &'a [KernelRow],
    flash: &'a [FlashRow],
    also: Vec<Also<'a>>,
    problems: &'a [String],
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Also<'a> {
    target: &'static str,
    kernels: &'a [KernelRow],
    flash: &'a [FlashRow],
}

impl Report {
    /// Whether nothing is wrong.
    pub(crate) fn verdict(&self) -> bool {
        self.problems.is_empty()
    }

    /// Gathers the targets' own problems.
    pub(crate) fn gather(&mut self) {
        for measured in &mut self.targets {
            self.problems.append(&mut measured.problems);
        }
    }

    pub(crate) fn print_json(&self) -> Result<()> {
        let json = Json {
            scenes: self.targets.iter().flat_map(|measured| &measured.scenes).collect(),
            kernels: self.targets.first().map_or(&[], |measured| &measured.kernels),
            flash: self.targets.first().map_or(&[], |measured| &measured.flash),
            also: self
                .targets
                .iter()
                .skip(1)
                .map(|m| Also { target: m.target.triple, kernels: &m.kernels, flash: &m.flash })
                .collect(),
            problems: &self.problems,
            warnings: &self.warnings,
        };
        println!("{}", serde_json::to_string_pretty(&json)?);
        self.print_findings();
        Ok(())
    }

    pub(crate) fn print_tables(&self) {
        for measured in &self.targets {
            measured.print();
        }
        self.print_findings();
        if self.verdict() {
            println!("Host and {} agree bit for bit; no panic links.", self.names());
        }
    }

    fn names(&self) -> String {
        self.targets.iter().map(|measured| measured.target.triple).collect::<Vec<_>>().join(", ")
    }

    fn print_findings(&self) {
        for warning in &self.warnings {
            eprintln!("warning: {warning}");
        }
        for problem in &self.problems {
            eprintln!("error: {problem}");
        }
    }
}

impl Measured {
    fn print(&self) {
        let machines = match self.target.counting {
            Some(counting) => format!("{}, counted on {}", self.target.machine.name, counting.name),
            None => self.target.machine.name.to_owned(),
        };
        println!("{} ({machines}), rustc {}\n", self.target.triple, self.release);

        let number = |value: Option<u64>| value.map_or_else(|| "-".to_owned(), grouped);
        let mut rows = vec![
            ["scene", "size", "CRC-32", "host", "instructions", "a pixel", "stack", "RAM"].map(str::to_owned),
        ];
        rows.extend(self.scenes.iter().map(|row| {
            let each = row.instructions.map(|n| n as f64 / row.pixels.max(1) as f64);
            [
                row.name.clone(),
                row.size.clone(),
                row.crc32.clone(),
                if row.crc32 == row.crc32_host { "same".to_owned() } else { row.crc32_host.clone() },
                number(row.instructions),
                each.map_or_else(|| "-".to_owned(), |each| format!("{each:.1}")),
                grouped(row.stack_bytes),
                grouped(row.ram_bytes),
            ]
        }));
        print_table(rows, 4);

        let count = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |v| format!("{v:.2}"));
        let mut rows = vec![["kernel", "unit", "fixed", "f32", "f64", "host"].map(str::to_owned)];
        rows.extend(self.kernels.iter().map(|row| {
            let [fixed, f32, f64, host] = [row.fixed, row.f32, row.f64, row.host].map(count);
            [row.name.clone(), row.unit.clone(), fixed, f32, f64, host]
        }));
        print_table(rows, 2);

        let mut rows = vec![["image", "flash", ".data", ".bss", "stack"].map(str::to_owned)];
        rows.extend(self.flash.iter().map(|row| {
            let [bytes, data, bss] = [row.bytes, row.data, row.bss].map(grouped);
            [row.name.clone(), bytes, data, bss, number(row.stack)]
        }));
        print_table(rows, 1);
    }
}

/// Prints rows in columns: the first `left` flush left, the others flush right.
fn print_table<R: Into<Row>>(rows: Vec<R>, left: usize) {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).add_rows(rows);
    for (i, column) in table.column_iter_mut().enumerate() {
        column.set_padding((2, 0));
        column.set_cell_alignment(if i < left { CellAlignment::Left } else { CellAlignment::Right });
    }
    println!("{}\n", table.trim_fmt());
}

/// A number with its digits in groups of three.
pub(crate) fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::grouped;

    #[test]
    fn digits_stand_in_groups_of_three() {
        assert_eq!([0, 999, 1000, 12_189_231].map(grouped), ["0", "999", "1,000", "12,189,231"]);
    }
}
