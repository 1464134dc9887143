//! In these rooms imports go one way: no file reaches, over any way, a file that reaches it.
//!
//! Read from the text: `crate::`, `super::` and `self::` paths, in groups or not, and `mod name;`, by which a
//! module reaches its parts. A module's own tests may use what they like.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A module of a crate: its path below the root.
type Module = Vec<String>;

const ROOMS: [&str; 4] = ["core/src", "host-sim/src", "host-sim/gallery/src", "benches/workload/src"];

/// The modules of a crate with their code, without comments and tests.
fn modules(root: &Path) -> BTreeMap<Module, String> {
    let (mut found, mut left) = (BTreeMap::new(), vec![root.to_path_buf()]);
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.insert(module(path.strip_prefix(root).unwrap()), code(&fs::read_to_string(&path).unwrap()));
        }
    }
    found
}

fn module(file: &Path) -> Module {
    let names = file.with_extension("");
    let mut names: Module = names.iter().map(|name| name.to_str().unwrap().to_owned()).collect();
    if names.last().is_some_and(|last| last == "mod" || last == "lib" || last == "main") {
        names.pop();
    }
    names
}

fn code(text: &str) -> String {
    let end = text.find("#[cfg(test)]\nmod tests").or(text.find("#[cfg(test)]\npub(crate) mod tests"));
    // what a derive of serde is told in a string is written down only to be read back
    let told = |line: &str| line.contains("\"crate::serial::");
    let text = text[..end.unwrap_or(text.len())].lines();
    let lines = text.filter(|line| !line.trim_start().starts_with("//") && !told(line));
    lines.map(|line| format!("{line}\n")).collect()
}

/// The paths at the beginning of a text: one, or those of a group.
fn paths(text: &str) -> Vec<Module> {
    let text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        let (mut depth, mut start, mut all) = (0, 0, Vec::new());
        for (at, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                ',' | '}' if depth == 0 => {
                    all.extend(paths(&group[start..at]));
                    start = at + 1;
                    if c == '}' {
                        break;
                    }
                }
                _ => {}
            }
        }
        return all;
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let (name, rest) = text.split_at(end);
    match rest.strip_prefix("::") {
        _ if name.is_empty() => vec![Vec::new()],
        None => vec![vec![name.to_owned()]],
        Some(rest) => paths(rest).into_iter().map(|path| [vec![name.to_owned()], path].concat()).collect(),
    }
}

/// The modules that a module names.
fn named(here: &Module, code: &str, all: &BTreeMap<Module, String>) -> BTreeSet<Module> {
    let mut found = BTreeSet::new();
    for start in ["crate::", "super::", "self::"] {
        for (at, _) in code.match_indices(start) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || "_:$".contains(c)) {
                continue;
            }
            for mut path in paths(&code[at..]) {
                let mut base = if path.remove(0) == "crate" { Vec::new() } else { here.clone() };
                if start == "super::" {
                    base.pop();
                }
                for name in path {
                    if name == "super" {
                        base.pop();
                        continue;
                    }
                    let below = [base.clone(), vec![name]].concat();
                    if !all.contains_key(&below) {
                        break;
                    }
                    base = below;
                }
                found.insert(base);
            }
        }
    }
    let parts = code.lines().filter_map(|line| line.trim().split_once("mod ")?.1.strip_suffix(';'));
    found.extend(parts.map(|part| [here.clone(), vec![part.to_owned()]].concat()));
    // the root holds no code, it only says what the crate is made of
    found.retain(|module| module != here && !module.is_empty() && all.contains_key(module));
    found
}

/// What is left when all modules are taken away that reach, or are reached by, no others: those of cycles,
/// and what lies between.
fn knots(all: &BTreeMap<Module, String>) -> Vec<String> {
    let mut edges: BTreeMap<&Module, BTreeSet<Module>> =
        all.iter().map(|(here, code)| (here, named(here, code, all))).collect();
    loop {
        let reached: BTreeSet<Module> = edges.values().flatten().cloned().collect();
        let count = edges.len();
        edges.retain(|here, names| !names.is_empty() && reached.contains(*here));
        let left: BTreeSet<Module> = edges.keys().map(|here| (*here).clone()).collect();
        edges.values_mut().for_each(|names| names.retain(|name| left.contains(name)));
        if edges.len() == count {
            let show = |module: &Module| format!("{}.rs", module.join("/"));
            let line = |(here, names): (&&Module, &BTreeSet<Module>)| {
                format!("{} -> {}", show(here), names.iter().map(show).collect::<Vec<_>>().join(", "))
            };
            return edges.iter().map(line).collect();
        }
    }
}

#[test]
fn imports_go_one_way() {
    for room in ROOMS {
        let root: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", room].iter().collect();
        let all = modules(&root);
        assert!(all.len() > 15, "{room}: {} files", all.len());
        let knots = knots(&all);
        assert!(knots.is_empty(), "{room}: in a circle {knots:#?}");
    }
}

#[test]
fn a_circle_is_found_and_a_ladder_is_none() {
    let crate_of = |files: &[(&str, &str)]| -> BTreeMap<Module, String> {
        files.iter().map(|(file, text)| (module(Path::new(file)), code(text))).collect()
    };
    let ladder = [
        ("main.rs", "mod a;\nmod b;\nfn main() {}\n"),
        ("a/mod.rs", "mod low;\npub use low::Low;\nuse crate::b::{self, B};\n"),
        (
            "a/low.rs",
            "// use super::A;\npub struct Low;\n#[cfg(test)]\nmod tests {\n    use super::super::A;\n}\n",
        ),
        ("b.rs", "use std::fmt;\npub struct B;\n"),
    ];
    assert_eq!(knots(&crate_of(&ladder)), [""; 0]);
    for upward in ["use super::A;\n", "use crate::{b, a::{A}};\n", "fn f() -> crate::a::A {}\n"] {
        let mut circle = ladder;
        circle[2].1 = upward;
        let found = knots(&crate_of(&circle));
        assert_eq!(found, ["a.rs -> a/low.rs", "a/low.rs -> a.rs"], "{upward}");
    }
}
