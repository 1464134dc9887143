//! Bad input for curves, copiers, Julia sets and deep zooms: see `bad_input.rs`.

use std::fs;

use crate::common::{bad, good};

const CURVE: &str =
    "kind = \"curve\"\ngenerator = [[0, 0], [1, 0], [1, 1], [2, 1]]\norder = 3\nbase = [[0, 0], [1, 0]]\n";
const TURTLE: &str = "kind = \"curve\"\nturtle = \"F+F--F+F\"\nangle = 60\nadaptive = true\n";
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

#[test]
fn the_good_files_are_good() {
    for scene in [CURVE, TURTLE, ELBOW, COPIER, JULIA, DEEP] {
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
    refused(TURTLE, "F+F--F+F", "F+G", &["turtle", "F+G"]);
    refused(TURTLE, "angle = 60\n", "", &["turtle", "angle"]);
    refused(
        CURVE,
        "generator = [[0, 0], [1, 0], [1, 1], [2, 1]]",
        "curve = \"koch-line\"",
        &["curve", "hilbert"],
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
fn deep_coordinates_are_told_how_many_digits_fit() {
    let long = format!("0.{}", "3".repeat(500));
    refused(DEEP, "0.0", &long, &["centre[0]", "500 decimal places", "room for 114"]);
    for width in ["0", "-1e-30", "-3"] {
        refused(DEEP, "1e-60", width, &["width", width, "above 0"]);
    }
    refused(DEEP, "max_dwell", "equalised = true\ncycle = 9\nmax_dwell", &["cycle", "9"]);
}
