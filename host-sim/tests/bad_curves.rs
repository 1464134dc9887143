//! Bad input for curves, copiers, Julia sets and deep zooms: see `bad_input.rs`.

use std::fs;

use crate::common::{attractor_in, bad, good, text};

const CURVE: &str =
    "kind = \"curve\"\ngenerator = [[0, 0], [1, 0], [1, 1], [2, 1]]\norder = 3\nbase = [[0, 0], [1, 0]]\n";
const TURTLE: &str = "kind = \"curve\"\nturtle = \"F+F--F+F\"\nangle = 60\nadaptive = true\n";
const PLANT: &str = "kind = \"l-system\"\naxiom = \"X\"\nrules = { X = \"F[+X]F[-X]+X\", F = \"FF\" }\nangle = 20\nheading = 90\norder = 4\n";
const ELBOW: &str = "kind = \"random-curve\"\nlaw = \"elbow\"\nbeta = 2\ndeviation = 0.3\nlength = 0.1\n";
const COPIER: &str =
    "kind = \"copier\"\nattractor = \"koch-curve\"\npolyline = [[0, 0], [1, 0]]\norders = [0, 2]\n";
const JULIA: &str = "kind = \"julia-set\"\nc = [0, 1]\npoints = 1000\nmethod = \"plain\"\n";
const DEEP: &str = "kind = \"mandelbrot\"\ncentre = [\"0.0\", \"1.0\"]\nwidth = \"1e-60\"\nmax_dwell = 300\n";

fn refused(scene: &str, from: &str, to: &str, words: &[&str]) {
    assert!(scene.contains(from), "{from}");
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), scene.replacen(from, to, 1)).unwrap();
    for command in [
        &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"][..],
        &["sample", "scene.toml", "--size", "4x4"],
    ] {
        let complaint = bad(directory.path(), command);
        for word in ["attractor: ", "scene.toml"].iter().chain(words) {
            assert!(complaint.contains(word), "no {word:?} in {complaint}");
        }
    }
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1, "something was written");
}

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
    refused(CURVE, "[1, 1]", "[1, 0]", &[":2:", "generator", "segment of the generator is zero"]);
    refused(CURVE, "[1, 1]", "[9, 1]", &["generator[2]", "[9, 1]", "outside"]);
    refused(CURVE, "[1, 0], [1, 1], [2, 1]", "[1.5, 0], [1, 0]", &["generator[0]", "no shorter"]);
    refused(CURVE, "[2, 1]]", "[0, 0]]", &["generator", "is zero"]);
    refused(CURVE, "[[0, 0], [1, 0], [1, 1], [2, 1]]", "[[0, 0], [1, 0]]", &["generator", "at least 3"]);
    for (word, character) in [
        ("F+G", "character 3, 'G' (U+0047)"),
        ("F+F\u{2212}F", "character 4, '\u{2212}' (U+2212)"),
        ("FfF", "character 2, 'f' (U+0066)"),
    ] {
        let letters = "none of its letters: F A B a b + -";
        refused(TURTLE, "F+F--F+F", word, &[":2: turtle = ", word, character, letters, "L-system"]);
    }
    refused(TURTLE, "angle = 60\n", "", &["turtle", "angle"]);
    refused(
        CURVE,
        "generator = [[0, 0], [1, 0], [1, 1], [2, 1]]",
        "curve = \"koch-line\"",
        &["curve", "hilbert"],
    );
}

#[test]
fn words_that_no_turtle_can_walk_are_refused() {
    let letters = "none of its letters: A to Z, a to z (F and G draw, f moves), + - | [ ]";
    let minus = &[":3: rules.X = ", "rule [1]: character 8, '\u{2212}' (U+2212)", letters];
    refused(PLANT, "F[-X]", "F[\u{2212}X]", minus);
    refused(PLANT, "axiom = \"X\"", "axiom = \"X X\"", &[":2: axiom", "character 2, ' ' (U+0020)", letters]);
    refused(PLANT, "F[+X]F", "F[+XF", &["rules.X", "character 2, '[' (U+005B), is never closed"]);
    refused(PLANT, "F[+X]F", "F[+X]]F", &["rules.X", "character 6, ']' (U+005D), closes no bracket"]);
    refused(PLANT, ", F =", ", FX =", &["rules.FX", "one letter", "A to Z"]);
    refused(PLANT, ", F =", ", \"+\" =", &["rules.+", "'+' (U+002B)", "cannot be rewritten"]);
    refused(PLANT, "angle = 20\n", "", &["angle"]);
    for (order, reason) in
        [("-1", "allowed is 0 to 32"), ("33", "33 orders needed"), ("32", "letters needed")]
    {
        refused(PLANT, "order = 4", &format!("order = {order}"), &[":6: order = ", reason]);
    }
    refused(PLANT, "order = 4", "order = 0", &[":6: order = 0", "no letter that draws"]);
    let nested = "[".repeat(129) + &"]".repeat(129);
    refused(
        PLANT,
        "axiom = \"X\"",
        &format!("axiom = \"X{nested}\""),
        &["order", "open brackets", "room for 128"],
    );
}

#[test]
fn orders_and_bases_beyond_the_room_are_refused() {
    for order in ["-1", "33", "1000000"] {
        refused(CURVE, "order = 3", &format!("order = {order}"), &["order", order, "allowed is 0 to"]);
        refused(COPIER, "[0, 2]", &format!("[0, {order}]"), &["orders[1]", order, "allowed is 0 to"]);
    }
    refused(CURVE, "order = 3\n", "", &["order", "missing"]);
    refused(CURVE, "base = [[0, 0], [1, 0]]", "base = [[0, 0], [0, 0]]", &["base", "zero"]);
    refused(CURVE, "base = [[0, 0], [1, 0]]", "base = [[0, 0]]", &["base", "at least 2"]);
    refused(COPIER, "[[0, 0], [1, 0]]", "[]", &["polyline", "at least 1"]);
    refused(COPIER, "[0, 2]", "[]", &["orders", "1 to 16"]);
    refused(COPIER, "koch-curve", "kock", &["attractor", "kock", "koch-curve"]);
}

#[test]
fn parameters_outside_their_range_are_refused() {
    for beta in ["0.99", "3.01", "-2", "0"] {
        refused(ELBOW, "beta = 2", &format!("beta = {beta}"), &["beta", beta, "between 1 and 3"]);
    }
    refused(ELBOW, "deviation = 0.3", "deviation = -0.3", &["deviation", "-0.3"]);
    refused(ELBOW, "deviation = 0.3", "ratio = 1.3", &["ratio", "elbow", "beta"]);
    refused(ELBOW, "length = 0.1", "length = 0", &["length", "= 0"]);
    refused(ELBOW, "length = 0.1", "parameter = \"1e-9\"", &["parameter", "1e-9", "levels"]);
    refused(ELBOW, "length = 0.1", "coast = \"utopia\"", &["coast", "iceland"]);
    refused(JULIA, "[0, 1]", "[2, 1]", &["c = "]);
    refused(JULIA, "points = 1000", "points = 0", &["points", "allowed is 1"]);
    refused(JULIA, "\"plain\"", "\"cover\"", &["points", "a cover has no points", "plain"]);
}

#[test]
fn digits_of_deep_coordinates_that_no_picture_shows_are_rounded_away() {
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
    refused(DEEP, "1e-60", &format!("1.{}e-110", "3".repeat(9)), &["width = \"1.3", "as small as 1e-100"]);
    for width in ["0", "-1e-30", "-3"] {
        refused(DEEP, "1e-60", width, &["width", width, "above 0"]);
    }
    refused(DEEP, "max_dwell", "equalised = true\ncycle = 9\nmax_dwell", &["cycle", "9"]);
}
