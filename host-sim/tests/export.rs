//! `attractor export`: what it writes is a module that firmware compiles, with the bits that the command draws with.

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
