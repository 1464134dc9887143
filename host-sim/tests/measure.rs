//! `attractor dimension` and `attractor spectrum`: measured beside theory, and what cannot be measured.

use std::fs;
use std::path::Path;

use crate::common::{bad, good};

/// The number behind a word of the output, after the line that names a method.
fn value(text: &str, method: &str, word: &str) -> Option<f64> {
    let from = text.find(&format!("method     {method}:"))?;
    let line = text.get(from..)?.lines().find(|line| line.starts_with(word))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Measured, and theory.
fn measured(directory: &Path, args: &[&str], method: &str, word: &str) -> (f64, f64) {
    let text = good(directory, args);
    println!("{text}");
    assert!(text.contains("fit range") && text.contains(" +- "), "{text}");
    (value(&text, method, word).unwrap(), value(&text, method, "theory").unwrap())
}

fn check(directory: &Path, args: &[&str], method: &str, exact: f64, tolerance: f64) {
    let (got, theory) = measured(directory, args, method, "dimension");
    assert!((theory - exact).abs() < 1e-4, "{args:?}: {theory}");
    assert!((got - exact).abs() < tolerance, "{args:?}: {got} against {exact}");
}

fn log(n: f64, r: f64) -> f64 {
    n.ln() / r.ln()
}

#[test]
fn dimensions_of_attractors_are_within_3_hundredths_of_theory() {
    for (args, method, exact) in [
        (&["koch-curve"][..], "boxes", log(4.0, 3.0)),
        (&["sierpinski"], "boxes", log(3.0, 2.0)),
        (&["copier-gasket"], "boxes", log(3.0, 2.0)),
        (&["sierpinski-carpet"], "boxes", log(8.0, 3.0)),
        (&["heighway-dragon", "--boundary"], "boundary", 1.523_627),
    ] {
        let args: Vec<&str> = ["dimension"].iter().chain(args).copied().collect();
        check(Path::new("."), &args, method, exact, 0.03);
    }
}

#[test]
fn dimensions_of_curves_are_within_3_hundredths_of_theory() {
    for (args, method, exact) in [
        (&["koch-snowflake"][..], "boxes", log(4.0, 3.0)),
        (&["minkowski"], "boxes", 1.5),
        (&["gosper", "--boundary"], "boundary", 2.0 * log(3.0, 7.0)),
    ] {
        let args: Vec<&str> = ["dimension"].iter().chain(args).copied().collect();
        check(Path::new("."), &args, method, exact, 0.03);
    }
    // boxes on the rim: what fills the plane measures low
    let (got, theory) = measured(Path::new("."), &["dimension", "hilbert"], "boxes", "dimension");
    assert!(theory == 2.0 && got > 1.92 && got < 2.0, "{got}");
    // unequal segments, 3/8 and sqrt(5)/8 twice each
    let exact = bisected(|d| 2.0 * 0.375_f64.powf(d) + 2.0 * (5.0_f64.sqrt() / 8.0).powf(d) - 1.0);
    let uneven = "kind = \"curve\"\norder = 2\n\
        generator = [[0, 0], [\"0.375\", 0], [\"0.5\", \"0.25\"], [\"0.625\", 0], [1, 0]]\n";
    with_scene(uneven, |directory, file| check(directory, &["dimension", file], "boxes", exact, 0.03));
}

/// Where a decreasing function is 0 between 1 and 3; 1 where it is not.
fn bisected(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (1.0, 3.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Abscissae, ordinates, scalings; `q` of degree 2 where it is given, coefficients in `x`.
struct Function {
    x: &'static [f64],
    y: &'static [f64],
    scalings: &'static [f64],
    polynomials: &'static str,
}

/// None has its columns among the powers of `sqrt 2`; the first two have equal intervals, the fourth passes
/// `(0, 0) (0.3, 0.6) (1, 0)`.
const FUNCTIONS: [Function; 5] = [
    Function {
        x: &[0.0, 1.0, 2.0, 3.0],
        y: &[0.0, 0.6, -0.3, 0.5],
        scalings: &[0.5, -0.7, 0.4],
        polynomials: "",
    },
    Function {
        x: &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0],
        y: &[0.3, -0.7, 1.1, 0.2, -0.4, 0.0],
        scalings: &[0.7, -0.3, 0.55, 0.1, 0.6],
        polynomials: "",
    },
    Function {
        x: &[0.0, 0.3, 0.5, 1.1],
        y: &[0.0, 1.0, 0.4, 0.9],
        scalings: &[0.6, -0.45, 0.7],
        polynomials: "",
    },
    Function {
        x: &[0.0, 0.3, 1.0],
        y: &[0.0, 0.6, 0.0],
        scalings: &[0.65, -0.75],
        polynomials: "polynomials = [[0, \"1.1\", \"-0.5\"], [\"0.6\", \"-1\", \"0.4\"]]\n",
    },
    Function { x: &[0.0, 0.7, 2.0], y: &[0.0, 1.0, 0.0], scalings: &[0.3, 0.25], polynomials: "" },
];

impl Function {
    /// `alpha_j` and the part `a_j` of the whole.
    fn maps(&self) -> Vec<(f64, f64)> {
        let whole = self.x[self.x.len() - 1] - self.x[0];
        let widths = self.x.windows(2).map(|w| (w[1] - w[0]) / whole);
        self.scalings.iter().copied().zip(widths).collect()
    }

    fn scene(&self) -> String {
        let number = |v: &f64| format!("\"{v}\"");
        let knots: Vec<String> =
            self.x.iter().zip(self.y).map(|(x, y)| format!("[{}, {}]", number(x), number(y))).collect();
        let scalings: Vec<String> = self.scalings.iter().map(number).collect();
        format!(
            "kind = \"fif-curve\"\nknots = [{}]\nvertical_scaling = [{}]\n{}",
            knots.join(", "),
            scalings.join(", "),
            self.polynomials
        )
    }
}

fn with_scene(text: &str, check: impl Fn(&Path, &str)) {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("scene.toml"), text).unwrap();
    check(directory.path(), "scene.toml");
}

#[test]
fn dimensions_of_graphs_are_within_3_hundredths_of_theory() {
    for function in &FUNCTIONS {
        let maps = function.maps();
        let exact =
            bisected(|d| maps.iter().map(|(alpha, a)| alpha.abs() * a.powf(d - 1.0)).sum::<f64>() - 1.0);
        with_scene(&function.scene(), |directory, file| {
            check(directory, &["dimension", file], "variation", exact, 0.03);
        });
    }
}

#[test]
fn spectral_exponents_of_graphs_are_within_15_hundredths_of_theory() {
    for function in &FUNCTIONS[..4] {
        let maps = function.maps();
        let exact = bisected(|beta| {
            1.0 - maps.iter().map(|(alpha, a)| alpha * alpha * a.powf(2.0 - beta)).sum::<f64>()
        });
        with_scene(&function.scene(), |directory, file| {
            let (got, theory) = measured(directory, &["spectrum", file], "periodogram", "beta");
            assert!((theory - exact).abs() < 1e-3, "{theory} {exact}");
            assert!((got - exact).abs() < 0.15, "{got} against {exact}");
        });
    }
}

fn random_curve(keys: &str) -> String {
    format!("kind = \"random-curve\"\nseed = 0\n{keys}")
}

#[test]
fn spectral_exponents_of_random_curves_are_within_15_hundredths_of_the_request() {
    for beta in ["1", "1.5", "2", "2.5", "3"] {
        let request: f64 = beta.parse().unwrap();
        for law in ["elbow\"\ndeviation = 0.2", "elbow\"\ndeviation = 0.01", "line-to-line\"\noffset = 0.5"] {
            let scene = random_curve(&format!("law = \"{law}\nbeta = \"{beta}\"\n"));
            with_scene(&scene, |directory, file| {
                let (got, theory) = measured(directory, &["spectrum", file], "periodogram", "beta");
                assert!(theory == request && (got - request).abs() < 0.15, "{law}: {got} against {request}");
            });
        }
    }
    for scene in ["elbow", "mountain-line", "carpenter-1", "carpenter-2", "coastline"] {
        let (got, theory) = measured(Path::new("."), &["spectrum", scene], "periodogram", "beta");
        assert!((got - theory).abs() < 0.15 && got > 1.9, "{scene}: {got} against {theory}");
    }
}

/// "The fractal dimension for a similarity ratio of 1.3 is then 1.61."
#[test]
fn a_similarity_ratio_of_1_3_gives_dimension_1_61_within_5_hundredths() {
    for seed in [0, 1, 1980] {
        let scene =
            format!("kind = \"random-curve\"\nlaw = \"one-variable\"\nratio = \"1.3\"\nseed = {seed}\n");
        with_scene(&scene, |directory, file| {
            let text = good(directory, &["dimension", file]);
            println!("{text}");
            let carpenter = 2.0_f64.ln() / (2.0_f64 / 1.3).ln();
            assert!((value(&text, "chords", "theory").unwrap() - carpenter).abs() < 1e-3);
            let got = value(&text, "chords", "dimension").unwrap();
            assert!((got - 1.61).abs() < 0.05, "{seed}: {got}");
            // double points: fewer boxes than the parts would fill one by one
            let (boxes, parts) = (value(&text, "boxes", "dimension"), value(&text, "boxes", "theory"));
            assert!((parts.unwrap() - 1.704).abs() < 2e-3);
            assert!(boxes > Some(1.5) && boxes < parts, "{seed}: {boxes:?}");
        });
    }
}

#[test]
fn dimensions_of_random_curves_are_within_5_hundredths_of_theory() {
    for (scene, method) in [
        ("elbow", "chords"),
        ("carpenter-1", "chords"),
        ("carpenter-2", "chords"),
        ("coastline", "chords"),
        ("mountain-line", "variation"),
    ] {
        let (got, theory) = measured(Path::new("."), &["dimension", scene], method, "dimension");
        assert!((got - theory).abs() < 0.05 && theory > 1.05, "{scene}: {got} against {theory}");
    }
    for beta in ["1.5", "2", "2.5"] {
        let scene = random_curve(&format!("law = \"line-to-line\"\nbeta = \"{beta}\"\n"));
        let exact = (5.0 - beta.parse::<f64>().unwrap()) / 2.0;
        with_scene(&scene, |directory, file| {
            check(directory, &["dimension", file], "variation", exact, 0.03);
        });
    }
    // more pieces than can be covered: chords all the same
    with_scene(&random_curve("law = \"elbow\"\nbeta = \"1.5\"\n"), |directory, file| {
        let text = good(directory, &["dimension", file]);
        assert!(text.contains("boxes: left out: it has too many pieces"), "{text}");
        assert!(value(&text, "chords", "dimension").is_some_and(|d| (d - 4.0).abs() < 0.4), "{text}");
    });
}

#[test]
fn julia_sets_are_measured() {
    for (c, exact) in [("0, 0", 1.0), ("-2, 0", 1.0)] {
        with_scene(&format!("kind = \"julia-set\"\nc = [{c}]\n"), |directory, file| {
            check(directory, &["dimension", file], "boxes", exact, 0.01);
        });
    }
}

/// C. T. McMullen, "Hausdorff dimension and conformal dynamics III", 1998, and the segment. It is the same
/// set, whether it is drawn itself or its inside.
#[test]
fn dimensions_of_julia_sets_are_within_two_of_the_errors_that_are_stated() {
    for (kind, c, exact) in [
        ("julia-set", "\"0.25\", 0", 1.0812),
        ("julia-set", "0, 1", 1.2835),
        ("julia", "-1, 0", 1.2683),
        ("julia", "-2, 0", 1.0),
    ] {
        with_scene(&format!("kind = \"{kind}\"\nc = [{c}]\n"), |directory, file| {
            let text = good(directory, &["dimension", file]);
            let line = text.lines().find(|line| line.starts_with("dimension")).unwrap();
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let [got, error] = numbers[..] else { panic!("{line}") };
            println!("{c}: {got} +- {error} against {exact}");
            assert!((got - exact).abs() <= 2.0 * error && error < 0.011, "{c}: {line} against {exact}");
        });
    }
    // C. T. McMullen, "Hausdorff dimension and conformal dynamics III", 1998, and the segment: within two of
    // the errors that are stated
    for (c, exact) in [("\"0.25\", 0", 1.0812), ("0, 1", 1.2835), ("-1, 0", 1.2683), ("-2, 0", 1.0)] {
        with_scene(&format!("kind = \"julia-set\"\nc = [{c}]\n"), |directory, file| {
            let text = good(directory, &["dimension", file]);
            let line = text.lines().find(|line| line.starts_with("dimension")).unwrap();
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let [got, error] = numbers[..] else { panic!("{line}") };
            println!("{c}: {got} +- {error} against {exact}");
            assert!((got - exact).abs() <= 2.0 * error && error < 0.011, "{c}: {line} against {exact}");
        });
    }
    // the same set, whether its points or its inside are drawn
    let rabbit = "c = [\"-0.123\", \"0.745\"]\n";
    let [set, filled] = ["julia-set", "julia"].map(|kind| {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("scene.toml"), format!("kind = \"{kind}\"\n{rabbit}")).unwrap();
        value(&good(directory.path(), &["dimension", "scene.toml"]), "boxes", "dimension").unwrap()
    });
    assert_eq!(set, filled);
    // McMullen: 1.3934
    assert!((set - 1.3934).abs() < 0.01, "{set}");
}

#[test]
fn the_points_of_a_fit_are_listed() {
    let text = good(Path::new("."), &["dimension", "carpenter-1", "--csv"]);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("method,log_inverse_size,log_count"));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let of = |method: &str| rows.iter().filter(|row| row[0] == method).count();
    assert_eq!((of("chords"), of("boxes"), rows.len()), (7, 13, 20));
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    assert!((number(6, 2) - 14.0 * 2.0_f64.ln()).abs() < 1e-9);
    let slope = (number(6, 2) - number(0, 2)) / (number(6, 1) - number(0, 1));
    assert!((slope - 1.61).abs() < 0.05, "{slope}");
    let text = good(Path::new("."), &["spectrum", "elbow", "--csv"]);
    assert!(text.starts_with("log_frequency,log_power\n") && text.lines().count() == 8, "{text}");
}

#[test]
fn scenes_without_theory_are_measured_all_the_same() {
    for args in [["dimension", "fern"], ["dimension", "sunspots"], ["spectrum", "sunspots"]] {
        let text = good(Path::new("."), &args);
        println!("{text}");
        let (method, word) = match args {
            ["spectrum", _] => ("periodogram", "beta"),
            [_, "sunspots"] => ("variation", "dimension"),
            _ => ("boxes", "dimension"),
        };
        assert!(value(&text, method, word).is_some_and(|v| (0.5..4.0).contains(&v)), "{text}");
        assert!(text.contains("theory"));
    }
}

/// Two maps that hardly contract: a segment, by far too many images.
#[test]
fn maps_that_overlap_are_followed_by_orbits() {
    let maps =
        "kind = \"ifs\"\nmaps = [[0.995, 0, 0, 0.995, 0, 0, 0.5], [0.995, 0, 0, 0.995, 0.1, 0, 0.5]]\n";
    with_scene(maps, |directory, file| {
        let text = good(directory, &["dimension", file]);
        let got = value(&text, "boxes", "dimension").unwrap();
        assert!((got - 1.0).abs() < 0.03, "{text}");
        assert!(bad(directory, &["dimension", file, "--boundary"]).contains("boundary cannot be told"));
    });
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let here = Path::new(".");
    for (args, words) in [
        (&["dimension", "mandelbrot"][..], &["mandelbrot", "kind = mandelbrot", "dimension 2"][..]),
        (&["dimension", "figure-6-ff"], &["fif-surface", "fif-curve"]),
        (&["spectrum", "julia"], &["kind = julia", "fif-curve and random-curve"]),
        (&["spectrum", "fern"], &["kind = ifs"]),
        (&["spectrum", "koch-snowflake"], &["kind = curve", "random-curve"]),
        (&["spectrum", "mandelbrot"], &["kind = mandelbrot", "random-curve"]),
        (&["dimension", "figure-1-f", "--boundary"], &["--boundary", "figure-1-f"]),
        (&["dimension", "mountain-line", "--boundary"], &["--boundary", "mountain-line"]),
        (&["dimension", "julia", "--boundary"], &["--boundary", "a Julia set is a boundary"]),
        (&["dimension", "nothing-at-all"], &["nothing-at-all"]),
        (&["dimension"], &["SCENE"]),
    ] {
        let complaint = bad(here, args);
        assert!(words.iter().all(|w| complaint.contains(w)), "{complaint}");
    }
    with_scene("kind = \"ifs\"\nmaps = [[0.5, 0, 0, 0.5, 1, 0, 1.0]]\n", |directory, file| {
        let complaint = bad(directory, &["dimension", file]);
        assert!(complaint.contains("point") && complaint.contains("scene.toml"), "{complaint}");
    });
    let flat = "kind = \"fif-curve\"\nknots = [[0, 1], [1, 1], [2, 1]]\nvertical_scaling = [0.5, 0.5]\n";
    with_scene(flat, |directory, file| {
        assert!(bad(directory, &["dimension", file]).contains("flat"));
        assert!(bad(directory, &["spectrum", file]).contains("flat"));
    });
    with_scene(&random_curve("law = \"one-variable\"\noffset = 0\n"), |directory, file| {
        assert!(bad(directory, &["spectrum", file]).contains("flat"));
    });
}
