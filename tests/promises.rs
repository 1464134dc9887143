//! Every promise of the table holds; every `Error:` of core's documentation names the test or the row that
//! measures it; every `Cost:` in Cortex-M4 instructions is what was counted.
//!
//! The convention: after `Error:` a doc comment names a test in backticks, `a_root_is_exact`, which must
//! exist, be a test and mention the item; or a row of the table of accuracy: (row `num::sin_cos`). A number
//! of "Cortex-M4 instructions" is followed by (kernel `NAME`), a row of benches/cortex-m/counts.toml, and so
//! is each number that stands beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use attractor_tests::accuracy;

#[test]
fn every_kernel_keeps_its_bound() {
    let table = accuracy::table();
    for row in &table {
        println!(
            "{:44} {:8} {:7} {:10.3e} {:10.3e} {:10.3e}",
            row.kernel, row.format, row.inputs, row.max_error, row.rms, row.bound
        );
    }
    let broken: Vec<_> = table.iter().filter(|r| !r.holds()).map(|r| r.kernel).collect();
    assert!(table.len() > 20 && broken.is_empty(), "{broken:?}");
}

/// What a doc comment says, and of which item.
struct Documented {
    place: String,
    item: String,
    text: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every Rust file below a directory, by path.
fn files(directory: &str) -> BTreeMap<PathBuf, String> {
    let mut found = BTreeMap::new();
    let mut left = vec![root().join(directory)];
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.insert(path.clone(), std::fs::read_to_string(&path).unwrap());
        }
    }
    found
}

/// The doc comments of core, private items included: a promise is a promise.
fn documented() -> Vec<Documented> {
    let mut all = Vec::new();
    for (path, text) in files("core/src") {
        let mut comment = String::new();
        for (number, line) in text.lines().map(str::trim).enumerate() {
            if let Some(words) = line.strip_prefix("///") {
                comment += words;
            } else if !line.starts_with("#[") && !comment.is_empty() {
                let place = format!("{}:{}", path.display(), number + 1);
                let words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
                let keywords = [
                    "pub", "crate", "super", "in", "const", "fn", "struct", "enum", "type", "static",
                    "trait", "",
                ];
                let item = words.into_iter().find(|w| !keywords.contains(w)).unwrap_or_default().to_owned();
                all.push(Documented { place, item, text: std::mem::take(&mut comment) });
            }
        }
    }
    all
}

/// What stands in backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// The body of each test of the project, by its name.
fn tests() -> BTreeMap<String, String> {
    let mut bodies = BTreeMap::new();
    for (_, text) in files("core/src").into_iter().chain(files("tests")).chain(files("host-sim/tests")) {
        let mut rest = text.as_str();
        while let Some((_, after)) = rest.split_once("#[test]") {
            rest = after;
            let Some((_, from_name)) = after.split_once("fn ") else { continue };
            let name = from_name.split(['(', '<']).next().unwrap_or_default();
            // up to the next test: helpers below it are read with it
            let body = from_name.split("#[test]").next().unwrap_or_default();
            bodies.insert(name.to_owned(), body.to_owned());
        }
    }
    bodies
}

#[test]
fn every_stated_error_names_the_test_that_measures_it() {
    let (tests, table) = (tests(), accuracy::table());
    assert!(tests.len() > 300, "only {} tests found", tests.len());
    let (mut stated, mut unmeasured) = (0, Vec::new());
    for Documented { place, item, text } in documented() {
        // "Error of a tone: " would pass by the rule
        let spelled = text.match_indices("Error ").any(|(at, _)| {
            let sentence = text[at + "Error ".len()..].split(['.', '`']).next().unwrap_or_default();
            sentence.starts_with(char::is_alphabetic) && sentence.contains(": ")
        });
        assert!(!spelled && !text.contains("Error. "), "{item} at {place}: spell it `Error: `");
        let Some((_, promise)) = text.split_once("Error: ") else { continue };
        stated += 1;
        let measured = quoted(promise).any(|name| {
            tests.get(name).is_some_and(|body| mentions(body, &item))
                || table.iter().any(|row| row.kernel == name)
        });
        if !measured {
            unmeasured.push(format!("{item} at {place}: {}", promise.chars().take(90).collect::<String>()));
        }
    }
    assert!(stated > 40 && unmeasured.is_empty(), "{} of {stated}: {unmeasured:#?}", unmeasured.len());
}

fn mentions(body: &str, item: &str) -> bool {
    body.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == item)
}

/// A number as documentation writes it: 298, 12.7 thousand, 1.2 million; and half a unit of its last digit.
fn number(words: &str) -> Option<(f64, f64)> {
    let mut words = words.split_whitespace().rev();
    let mut last = words.next()?;
    let mut factor = 1.0;
    if let Some(scale) =
        [("thousand", 1e3), ("million", 1e6)].into_iter().find_map(|(w, f)| (w == last).then_some(f))
    {
        (factor, last) = (scale, words.next()?);
    }
    let decimals = last.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    Some((last.parse::<f64>().ok()? * factor, 0.5 * 10_f64.powi(-decimals) * factor))
}

#[test]
fn every_stated_cost_is_what_was_counted() {
    let counts = std::fs::read_to_string(root().join("benches/cortex-m/counts.toml")).unwrap();
    let release = std::fs::read_to_string(root().join("rust-toolchain.toml")).unwrap();
    let release = release.split('"').nth(1).unwrap();
    let table = format!("[thumbv7em-none-eabihf.\"{release}\".kernels]");
    let (_, rows) = counts.split_once(&table).expect("counts of the first target");
    let rows = rows.split("\n[").next().unwrap();
    let counted = |kernel: &str| {
        let row = rows.lines().find_map(|line| line.strip_prefix(&format!("\"{kernel}\" = {{ fixed = ")))?;
        row.split([',', ' ']).next()?.parse::<f64>().ok()
    };
    const UNIT: &str = " Cortex-M4 instructions";
    const KERNEL: &str = " (kernel `";
    let (mut stated, mut stale) = (0, Vec::new());
    for Documented { place, item, text } in documented() {
        for (at, _) in text.match_indices(UNIT) {
            if !text[at + UNIT.len()..].starts_with(KERNEL) {
                stale.push(format!("{item} at {place}: no kernel behind `{}`", &text[..at + UNIT.len()]));
            }
        }
        // numbers whose unit was said before name their kernel too: 45.6 (kernel `gosper`)
        for (at, _) in text.match_indices(KERNEL) {
            stated += 1;
            let before = text[..at].strip_suffix(UNIT).unwrap_or(&text[..at]);
            let (said, half_unit) = number(before).unwrap_or_default();
            let kernel = text[at + KERNEL.len()..].split('`').next().unwrap_or_default();
            // growth of up to 3 % needs no blessing
            match counted(kernel) {
                Some(count) if (said - count).abs() <= half_unit.max(0.03 * count) => {}
                count => stale.push(format!("{item} at {place}: {said}, kernel `{kernel}` {count:?}")),
            }
        }
    }
    assert!(stated > 40 && stale.is_empty(), "{} of {stated}: {stale:#?}", stale.len());
}
