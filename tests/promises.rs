//! Every promise of the table holds, and everything that promises an error is in the table or names the test that measures it.

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

/// A documented error bound without a measurement is a claim: each `Error:` of a public item stands in the table, or its own file has a
/// test of it, or it names the file in tests/ that measures it.
#[test]
fn every_stated_error_is_measured() {
    let table = accuracy::table();
    let core = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/src");
    let mut files = vec![core];
    let (mut stated, mut unmeasured) = (0, Vec::new());
    while let Some(path) = files.pop() {
        if path.is_dir() {
            files.extend(std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let has_tests = text.contains("#[cfg(test)]");
        let (mut promises, mut named) = (false, None);
        for line in text.lines().map(str::trim) {
            if line.starts_with("///") {
                promises |= line.contains("Error: ");
                // "(tests/NAME.rs)" after the promise
                if promises && let Some((_, rest)) = line.split_once("(tests/") {
                    named = rest.split_once(')').map(|(name, _)| name.to_owned());
                }
            } else if line.starts_with("pub ") && promises {
                let words = line.split(|c: char| !c.is_alphanumeric() && c != '_');
                let name = words
                    .skip_while(|w| !["fn", "struct", "mean", "slope"].contains(w))
                    .find(|w| !["fn", "struct"].contains(w))
                    .unwrap_or("")
                    .to_owned();
                stated += 1;
                let here = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
                let there = named.take().and_then(|file| std::fs::read_to_string(here.join(file)).ok());
                let measured = there.is_some_and(|test| test.contains(&name));
                if !measured
                    && !has_tests
                    && !table.iter().any(|r| r.kernel.split([':', ' ']).any(|w| w == name))
                {
                    unmeasured.push(format!("{name} in {}", path.display()));
                }
                promises = false;
            } else if !line.starts_with("#[") {
                (promises, named) = (false, None);
            }
        }
    }
    assert!(stated > 10 && unmeasured.is_empty(), "{stated} stated, not measured: {unmeasured:#?}");
}
