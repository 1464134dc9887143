//! A fault of the compiler for RV32 that no picture has to show: LLVM 22.1 (rustc 1.95) makes nothing of the
//! upper word where a function multiplies twice, in 64 bits, by one constant whose upper word is `-2^k`, `k`
//! at least 2. For instance `a * -0x3_2434_5678 ^ b * -0x3_2434_5678` for two `i64`, whose upper word is
//! `-4`.
//!
//! Shifts behind a product are drawn into such constants, so that no source shows them. The compiler's last
//! intermediate form of an image does: it is looked through for them.

use std::path::Path;
use std::time::SystemTime;

use anyhow::{Context, Result};

/// The functions of the image at `executable` that multiply more than once by such a constant, each with it.
pub(crate) fn lost(executable: &Path) -> Result<Vec<String>> {
    let name = executable.file_name().and_then(|name| name.to_str()).context("an image has a name")?;
    let deps = executable.with_file_name("deps");
    let mut newest: Option<(SystemTime, std::path::PathBuf)> = None;
    for entry in deps.read_dir().with_context(|| format!("{} cannot be read", deps.display()))? {
        let path = entry?.path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).and_then(|stem| stem.rsplit_once('-'));
        if path.extension().is_some_and(|end| end == "ll") && stem.is_some_and(|(stem, _)| stem == name) {
            let written = path.metadata()?.modified()?;
            if newest.as_ref().is_none_or(|(before, _)| *before < written) {
                newest = Some((written, path));
            }
        }
    }
    let (_, path) = newest.with_context(|| format!("{} has no {name}-*.ll", deps.display()))?;
    let text = std::fs::read(&path).with_context(|| format!("{} cannot be read", path.display()))?;
    Ok(in_text(&String::from_utf8_lossy(&text)))
}

fn in_text(text: &str) -> Vec<String> {
    let (mut found, mut function, mut seen) = (Vec::new(), "", Vec::new());
    for line in text.lines() {
        if line.starts_with("define ") {
            function =
                line.split_once('@').and_then(|(_, rest)| rest.split_once('(')).map_or("", |(name, _)| name);
            seen.clear();
        } else if let Some(constant) = factor(line).filter(|constant| is_lost(*constant)) {
            let fault = format!("{function} by {constant}");
            if seen.contains(&constant) && !found.contains(&fault) {
                found.push(fault);
            }
            seen.push(constant);
        }
    }
    found
}

/// The constant of `%a = mul [nsw] [nuw] i64 %b, CONSTANT`.
fn factor(line: &str) -> Option<i64> {
    let (_, product) = line.split_once(" = mul ")?;
    let (_, operands) = product.split_once("i64 ")?;
    let (_, constant) = operands.split_once(", ")?;
    constant.split(',').next()?.trim().parse().ok()
}

/// Whether the upper word is `-2^k`, `k` at least 2.
fn is_lost(constant: i64) -> bool {
    let size = ((constant >> 32) as i32).unsigned_abs();
    constant < 0 && size >= 4 && size.is_power_of_two()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_products_by_such_a_constant_are_found_in_one_function() {
        let line = |constant: &str| format!("  %1 = mul nsw i64 %0, {constant}, !dbg !7\n");
        let text = |first: &str, second: &str, between: &str| {
            format!("define i64 @f(i64 %0) {{\n{}{between}{}}}\n", line(first), line(second))
        };
        let such = "-13493037704";
        assert_eq!(in_text(&text(such, such, "")), ["f by -13493037704"]);
        // once in each of two functions; two different ones; a register
        assert!(in_text(&text(such, such, "}\ndefine i64 @g(i64 %0) {\n")).is_empty());
        assert!(in_text(&text(such, "-13493037703", "")).is_empty());
        assert!(in_text(&text("%2", "%2", "")).is_empty());
    }

    /// By hand from what the compiler makes of them.
    #[test]
    fn the_constants_are_those_with_an_upper_word_of_minus_a_power_of_two() {
        let lost = [-17_179_869_177, -1_099_511_615_431, -34_359_738_269, -1_125_899_906_842_623];
        let kept = [-12_884_901_888, -8_589_934_493, -4_294_967_291, -5, 17_179_869_177, 1_099_511_627_779];
        assert!(lost.iter().all(|constant| is_lost(*constant)));
        assert!(!kept.iter().any(|constant| is_lost(*constant)));
    }
}
