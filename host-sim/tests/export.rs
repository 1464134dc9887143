//! `attractor export`: what it writes is a module that firmware compiles, with the bits that the command draws with.

use std::fs;
use std::path::Path;

use crate::common::{bad, good};
use attractor::ifs::catalogue::BARNSLEY_FERN;

/// The module that the target is built with; `benches/workload/tests/built_in.rs` holds its picture to the command's.
const SUNSPOTS: &str = include_str!("../../benches/workload/src/built_in/sunspots.rs");

#[test]
fn the_module_of_the_target_is_what_the_command_writes() {
    assert_eq!(good(Path::new("."), &["export", "sunspots"]), SUNSPOTS);
}

#[test]
fn maps_are_exported_bit_for_bit() {
    for scene in ["fern", "copier-fern"] {
        let text = good(Path::new("."), &["export", scene]);
        for map in BARNSLEY_FERN.maps {
            let [a, b, c, d] = [map.a, map.b, map.c, map.d].map(|l| l.to_bits());
            let line =
                format!("    map([{a}, {b}, {c}, {d}], [{}, {}]),\n", map.e.to_bits(), map.f.to_bits());
            assert!(text.contains(&line), "{line}{text}");
        }
        assert_eq!(text.matches("Unit::from_bits(75161928)").count(), 2, "{text}");
    }
}

#[test]
fn an_integrated_function_says_so() {
    let text = good(Path::new("."), &["export", "figure-3-g"]);
    assert!(text.contains("Fif::<2, 1>::interpolating") && text.contains("integrated 1 times"), "{text}");
    assert!(
        text.contains(&format!("Scaling::from_bits({})", attractor::num::Scaling::lit("0.85").to_bits()))
    );
}

/// Nothing of a scene file's title or name becomes code: all that is not a comment is what the scene without
/// them gives.
#[test]
fn titles_and_names_of_files_stay_comments() {
    let directory = tempfile::tempdir().unwrap();
    let scene = "kind = \"fif-curve\"\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\n";
    let code = |file: &str, title: &str| {
        fs::write(directory.path().join(file), format!("title = \"{title}\"\n{scene}")).unwrap();
        let module = good(directory.path(), &["export", file]);
        let comment = |line: &&str| line.starts_with("//!");
        assert!(!module.contains(['\r', '\u{1b}', '\u{202e}', '\u{2066}']), "{module:?}");
        assert_eq!(module.lines().take_while(comment).count(), 3, "{module}");
        module.lines().skip_while(comment).map(|line| format!("{line}\n")).collect::<String>()
    };
    let plain = code("plain.toml", "Plain");
    for title in ["One\\npub fn injected() {}\\n", "a\\rb", "\\u001b[2J\\u202e}\\u2066 \\u2028 \\t", ""] {
        assert_eq!(code("plain.toml", title), plain, "{title}");
    }
    for file in ["one\npub fn injected() {}\n.toml", "a`b\u{202e}.toml", "c\rd.toml"] {
        assert_eq!(code(file, "Plain"), plain, "{file:?}");
    }
}

#[test]
fn scenes_of_a_few_numbers_are_not_exported() {
    for (scene, kind) in
        [("mandelbrot", "mandelbrot"), ("figure-6-ff", "fif-surface"), ("elbow", "random-curve")]
    {
        let complaint = bad(Path::new("."), &["export", scene]);
        assert!(
            complaint.contains(kind) && complaint.contains("only of fif-curve, ifs and copier"),
            "{complaint}"
        );
    }
    assert!(bad(Path::new("."), &["export", "no-such-scene"]).contains("no-such-scene"));
}
