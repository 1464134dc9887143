//! `attractor dimension` and `attractor spectrum`: measured beside theory, and what cannot be measured.

mod common;

use std::fs;
use std::path::Path;

use common::{bad, good};

/// The numbers behind a word of the output.
fn value(text: &str, word: &str) -> Option<f64> {
    let line = text.lines().find(|line| line.starts_with(word))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

fn measured(directory: &Path, args: &[&str], word: &str) -> (f64, f64) {
    let text = good(directory, args);
    println!("{text}");
    assert!(text.contains("fit range") && text.contains(" +- "), "{text}");
    (value(&text, word).unwrap(), value(&text, "theory").unwrap())
}

#[test]
fn dimensions_of_attractors_are_within_3_hundredths_of_theory() {
    let log = |n: f64, r: f64| n.ln() / r.ln();
    for (args, exact) in [
        (&["koch-curve"][..], log(4.0, 3.0)),
        (&["sierpinski"], log(3.0, 2.0)),
        (&["sierpinski-carpet"], log(8.0, 3.0)),
        (&["heighway-dragon", "--boundary"], 1.523_627),
    ] {
        let args: Vec<&str> = ["dimension"].iter().chain(args).copied().collect();
        let (got, theory) = measured(Path::new("."), &args, "dimension");
        assert!((theory - exact).abs() < 1e-4, "{args:?}: {theory}");
        assert!((got - exact).abs() < 0.03, "{args:?}: {got} against {exact}");
    }
}

/// Name, knots, scalings.
const FUNCTIONS: [(&str, &str, &[f64]); 5] = [
    ("rough", "[[0, 0], [1, 1], [2, 0]]", &[0.85, -0.85]),
    ("takagi", "[[0, 0], [1, 1], [2, 0]]", &[0.6, 0.6]),
    ("thirds", "[[0, 0], [1, 0.6], [2, -0.3], [3, 0.5]]", &[0.5, -0.7, 0.4]),
    ("quarters", "[[0, 0.3], [0.25, -0.7], [0.5, 1.1], [0.75, 0.2], [1, -0.4]]", &[0.7, -0.3, 0.55, 0.1]),
    ("line", "[[0, 0], [1, 1], [2, 0]]", &[0.3, 0.25]),
];

fn with_function(name: &str, knots: &str, scalings: &[f64], check: impl Fn(&Path, &str)) {
    let directory = tempfile::tempdir().unwrap();
    let file = format!("{name}.toml");
    let text = format!("kind = \"fif-curve\"\nknots = {knots}\nvertical_scaling = {scalings:?}\n");
    fs::write(directory.path().join(&file), text).unwrap();
    check(directory.path(), &file);
}

#[test]
fn dimensions_of_graphs_are_within_3_hundredths_of_theory() {
    for (name, knots, scalings) in FUNCTIONS {
        let sum: f64 = scalings.iter().map(|a| a.abs()).sum();
        let exact = (1.0 + sum.ln() / (scalings.len() as f64).ln()).max(1.0);
        with_function(name, knots, scalings, |directory, file| {
            let (got, theory) = measured(directory, &["dimension", file], "dimension");
            assert!((theory - exact).abs() < 1e-4, "{name}: {theory}");
            assert!((got - exact).abs() < 0.03, "{name}: {got} against {exact}");
        });
    }
}

#[test]
fn spectral_exponents_of_graphs_are_within_15_hundredths_of_theory() {
    for (name, knots, scalings) in &FUNCTIONS[..4] {
        let square: f64 = scalings.iter().map(|a| a * a).sum();
        let exact = 2.0 - square.ln() / (scalings.len() as f64).ln();
        with_function(name, knots, scalings, |directory, file| {
            let (got, theory) = measured(directory, &["spectrum", file], "beta");
            assert!((theory - exact).abs() < 1e-3, "{name}: {theory}");
            assert!((got - exact).abs() < 0.15, "{name}: {got} against {exact}");
        });
    }
}

#[test]
fn scenes_without_theory_are_measured_all_the_same() {
    for args in [["dimension", "fern"], ["dimension", "sunspots"], ["spectrum", "sunspots"]] {
        let text = good(Path::new("."), &args);
        println!("{text}");
        let word = if args[0] == "dimension" { "dimension" } else { "beta" };
        assert!(value(&text, word).is_some_and(|v| (0.5..4.0).contains(&v)), "{text}");
        assert!(text.contains("theory"));
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let here = Path::new(".");
    for (args, words) in [
        (
            &["dimension", "mandelbrot"][..],
            &["mandelbrot", "kind = mandelbrot", "only of ifs and fif-curve"][..],
        ),
        (&["dimension", "figure-6-ff"], &["fif-surface"]),
        (&["spectrum", "julia"], &["kind = julia", "only of fif-curve"]),
        (&["spectrum", "fern"], &["kind = ifs"]),
        (&["dimension", "figure-1-f", "--boundary"], &["--boundary", "figure-1-f"]),
        (&["dimension", "nothing-at-all"], &["nothing-at-all"]),
        (&["dimension"], &["SCENE"]),
    ] {
        let complaint = bad(here, args);
        assert!(words.iter().all(|w| complaint.contains(w)), "{complaint}");
    }
    let directory = tempfile::tempdir().unwrap();
    for (text, words) in [
        ("kind = \"ifs\"\nmaps = [[0.5, 0, 0, 0.5, 1, 0, 1.0]]\n", "point"),
        (
            "kind = \"ifs\"\nmaps = [[0.995, 0, 0, 0.995, 0, 0, 0.5], [0.995, 0, 0, 0.995, 0.1, 0, 0.5]]\n",
            "overlap",
        ),
    ] {
        fs::write(directory.path().join("scene.toml"), text).unwrap();
        let complaint = bad(directory.path(), &["dimension", "scene.toml"]);
        assert!(complaint.contains(words) && complaint.contains("scene.toml"), "{complaint}");
    }
    with_function("flat", "[[0, 1], [1, 1], [2, 1]]", &[0.5, 0.5], |directory, file| {
        assert!(bad(directory, &["dimension", file]).contains("flat"));
        assert!(bad(directory, &["spectrum", file]).contains("flat"));
    });
}
