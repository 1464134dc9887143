//! Bad input for curves, copiers, Julia sets and deep zooms: see `bad_input.rs`.

use std::fs;

use insta::assert_snapshot;

use crate::common::{Said, attractor_in, good, text};

const CURVE: &str =
    "kind = \"curve\"\ngenerator = [[0, 0], [1, 0], [1, 1], [2, 1]]\norder = 3\nbase = [[0, 0], [1, 0]]\n";
const TURTLE: &str = "kind = \"curve\"\nturtle = \"F+F--F+F\"\nangle = 60\nadaptive = true\n";
const PLANT: &str = "kind = \"l-system\"\naxiom = \"X\"\nrules = { X = \"F[+X]F[-X]+X\", F = \"FF\" }\nangle = 20\nheading = 90\norder = 4\n";
const ELBOW: &str = "kind = \"random-curve\"\nlaw = \"elbow\"\nbeta = 2\ndeviation = 0.3\nlength = 0.1\n";
const COPIER: &str =
    "kind = \"copier\"\nattractor = \"koch-curve\"\npolyline = [[0, 0], [1, 0]]\norders = [0, 2]\n";
const JULIA: &str = "kind = \"julia-set\"\nc = [0, 1]\npoints = 1000\nmethod = \"plain\"\n";
const DEEP: &str = "kind = \"mandelbrot\"\ncentre = [\"0.0\", \"1.0\"]\nwidth = \"1e-60\"\nmax_dwell = 300\n";

fn good_but_for_notes(directory: &std::path::Path, args: &[&str]) -> String {
    let output = attractor_in(directory, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}");
    text(&output.stdout)
}

#[test]
fn the_good_files_are_good() {
    for scene in [CURVE, TURTLE, PLANT, ELBOW, COPIER, JULIA, DEEP] {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
        good(directory.path(), &["sample", "scene.toml", "--size", "4x4"]);
    }
}

#[test]
fn generators_that_refine_nothing_are_refused() {
    let mut said = Said::default();
    said.change(CURVE, "[1, 1]", "[1, 0]");
    said.change(CURVE, "[1, 1]", "[9, 1]");
    said.change(CURVE, "[1, 0], [1, 1], [2, 1]", "[1.5, 0], [1, 0]");
    said.change(CURVE, "[2, 1]]", "[0, 0]]");
    said.change(CURVE, "[[0, 0], [1, 0], [1, 1], [2, 1]]", "[[0, 0], [1, 0]]");
    for word in ["F+G", "F+F\u{2212}F", "FfF"] {
        said.change(TURTLE, "F+F--F+F", word);
    }
    said.change(TURTLE, "angle = 60\n", "");
    said.change(CURVE, "generator = [[0, 0], [1, 0], [1, 1], [2, 1]]", "curve = \"koch-line\"");
    assert_snapshot!(said);
}

#[test]
fn words_that_no_turtle_can_walk_are_refused() {
    let mut said = Said::default();
    said.change(PLANT, "F[-X]", "F[\u{2212}X]");
    said.change(PLANT, "axiom = \"X\"", "axiom = \"X X\"");
    said.change(PLANT, "F[+X]F", "F[+XF");
    said.change(PLANT, "F[+X]F", "F[+X]]F");
    said.change(PLANT, ", F =", ", FX =");
    said.change(PLANT, ", F =", ", \"+\" =");
    said.change(PLANT, "angle = 20\n", "");
    for order in ["-1", "33", "32"] {
        said.change(PLANT, "order = 4", &format!("order = {order}"));
    }
    said.change(PLANT, "order = 4", "order = 0");
    let nested = "[".repeat(129) + &"]".repeat(129);
    said.change(PLANT, "axiom = \"X\"", &format!("axiom = \"X{nested}\""));
    assert_snapshot!(said);
}

#[test]
fn orders_and_bases_beyond_the_room_are_refused() {
    let mut said = Said::default();
    for order in ["-1", "33", "1000000"] {
        said.change(CURVE, "order = 3", &format!("order = {order}"));
        said.change(COPIER, "[0, 2]", &format!("[0, {order}]"));
    }
    // the middle of the one square is a place, no line
    for curve in ["hilbert", "peano"] {
        let good = format!("kind = \"curve\"\ncurve = \"{curve}\"\norder = 1\n");
        said.change(&good, "order = 1", "order = 0");
    }
    said.change(CURVE, "order = 3\n", "");
    said.change(CURVE, "base = [[0, 0], [1, 0]]", "base = [[0, 0], [0, 0]]");
    said.change(CURVE, "base = [[0, 0], [1, 0]]", "base = [[0, 0]]");
    said.change(COPIER, "[[0, 0], [1, 0]]", "[]");
    said.change(COPIER, "[0, 2]", "[]");
    said.change(COPIER, "koch-curve", "kock");
    assert_snapshot!(said);
}

#[test]
fn parameters_outside_their_range_are_refused() {
    let mut said = Said::default();
    for beta in ["0.99", "3.01", "-2", "0"] {
        said.change(ELBOW, "beta = 2", &format!("beta = {beta}"));
    }
    said.change(ELBOW, "deviation = 0.3", "deviation = -0.3");
    said.change(ELBOW, "deviation = 0.3", "ratio = 1.3");
    said.change(ELBOW, "length = 0.1", "length = 0");
    said.change(ELBOW, "length = 0.1", "parameter = \"1e-9\"");
    said.change(ELBOW, "length = 0.1", "coast = \"utopia\"");
    said.change(JULIA, "[0, 1]", "[2, 1]");
    said.change(JULIA, "points = 1000", "points = 0");
    said.change(JULIA, "\"plain\"", "\"cover\"");
    assert_snapshot!(said);
}

#[test]
fn digits_of_deep_coordinates_that_no_picture_shows_are_rounded_away() {
    let mut said = Said::default();
    // the same picture as with 114 digits, to the last one of which it is rounded up
    let short = format!("-1.{}{}", "6".repeat(113), "7");
    let long = format!("-1.{}", "6".repeat(500));
    let mut pictures = Vec::new();
    for (centre, note) in [
        (&short, String::new()),
        (&long, {
            let quoted = &long[..59];
            let reason = "rounded to 114 decimal places: no picture shows the difference";
            format!("attractor: scene.toml:2: centre[0] = \"{quoted}...: {reason}\n")
        }),
    ] {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), DEEP.replace("0.0", centre)).unwrap();
        let output =
            attractor_in(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), note));
        let samples = good_but_for_notes(directory.path(), &["sample", "scene.toml", "--size", "4x4"]);
        pictures.push((fs::read(directory.path().join("out.png")).unwrap(), samples));
    }
    assert!(pictures[0] == pictures[1]);
    // a view that 32 bits may show on a smaller display
    let directory = tempfile::tempdir().unwrap();
    let shallow = DEEP.replace("0.0", &long).replace("1e-60", "1e-7");
    fs::write(directory.path().join("scene.toml"), shallow).unwrap();
    for size in ["16x16", "400x400"] {
        good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", size]);
    }
    // no width is rounded into what is allowed
    said.change(DEEP, "1e-60", &format!("1.{}e-110", "3".repeat(9)));
    for width in ["0", "-1e-30", "-3"] {
        said.change(DEEP, "1e-60", width);
    }
    said.change(DEEP, "max_dwell", "equalised = true\ncycle = 9\nmax_dwell");
    assert_snapshot!(said);
}
