//! Tells the kernel whether the target multiplies 32 by 32 bits to 64 in one instruction, and whether it adds
//! 64 bits with a carry: which is asked of the target, so that no user has to set a feature; and collects
//! what the private files say of themselves for the page `methods` of the documentation.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src");
    println!("cargo::rustc-check-cfg=cfg(no_long_product)");
    println!("cargo::rustc-check-cfg=cfg(no_carry)");
    // Armv6-M and Armv8-M Baseline: Cortex-M0, M0+, M1 and M23
    let target = env::var("TARGET").unwrap_or_default();
    if target.starts_with("thumbv6m") || target.starts_with("thumbv8m.base") {
        println!("cargo::rustc-cfg=no_long_product");
    }
    if target.starts_with("riscv32") {
        println!("cargo::rustc-cfg=no_carry");
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it")).join("methods.md");
    fs::write(out, methods()).expect("cargo's directory can be written");
}

/// The openings of the private files, rooms in the order of their dependence.
fn methods() -> String {
    let src = Path::new(&env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it")).join("src");
    let mut page = String::from(
        "What each file computes, by which formula, from which source and in which format: what the kernels say of themselves.\n",
    );
    for room in
        ["num", "plane", "fif", "ifs", "curve", "escape", "terrain", "patch", "codec", "trace", "draw"]
    {
        writeln!(page, "\n# {room}").expect("a string takes all");
        describe(&src.join(room), room, &mut page);
    }
    page
}

/// The openings of a room's private files and of its sub-rooms.
fn describe(room: &Path, heading: &str, page: &mut String) {
    let read = |path: &Path| fs::read_to_string(path).unwrap_or_default();
    let mods = read(&room.join("mod.rs"));
    let private = |line: &'_ str| {
        let line = line.strip_prefix("pub(crate) ").unwrap_or(line);
        Some(String::from(line.strip_prefix("mod ")?.strip_suffix(';')?))
    };
    for name in mods.lines().filter_map(private) {
        // `#[cfg(test)]` stands above helpers of tests
        if mods.contains(&format!("#[cfg(test)]\nmod {name};")) {
            continue;
        }
        let (sub_room, file) = (room.join(&name), room.join(&name).with_extension("rs"));
        let file = if sub_room.is_dir() { sub_room.join("mod.rs") } else { file };
        let heading = format!("{heading}: {}", name.replace('_', " "));
        writeln!(page, "\n## {heading}\n\n{}", opening(&read(&file))).expect("a string takes all");
        if sub_room.is_dir() {
            describe(&sub_room, &heading, page);
        }
    }
}

/// The paragraphs at the top of a file. Links name what means nothing elsewhere: their words stay.
fn opening(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines().map_while(|line| line.strip_prefix("//!")) {
        let mut rest = line.strip_prefix(' ').unwrap_or(line);
        while let Some((before, (name, after))) =
            rest.split_once("[`").and_then(|(before, link)| Some((before, link.split_once("`]")?)))
        {
            out.push_str(&format!("{before}`{name}`"));
            // what stands in parentheses behind it is where it led
            rest = match after.strip_prefix('(') {
                Some(place) => place.split_once(')').map_or(after, |(_, rest)| rest),
                None => after,
            };
        }
        out.push_str(rest);
        out.push('\n');
    }
    out
}
