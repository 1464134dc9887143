//! `attractor fit`: what it writes is a scene, what it cannot fit it says in one line.

use std::fs;
use std::path::Path;

use crate::common::{attractor_in, bad, good};

const DEM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/data/jacksboro-elevation-m.png");

/// A grey picture of 16 or 8 bits.
fn picture(path: &Path, side: [u32; 2], depth: png::BitDepth, value: impl Fn(u32, u32) -> u16) {
    let file = fs::File::create(path).unwrap();
    let mut encoder = png::Encoder::new(file, side[0], side[1]);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(depth);
    let all = (0..side[1]).flat_map(|y| (0..side[0]).map(move |x| (x, y)));
    let bytes: Vec<u8> = all
        .flat_map(|(x, y)| {
            let bytes = value(x, y).to_be_bytes();
            if depth == png::BitDepth::Sixteen { bytes.to_vec() } else { vec![bytes[1]] }
        })
        .collect();
    encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
}

/// A window of the landscape by each family: the scene is drawn, its numbers are those of the reference, the
/// lattice is nearer than every spline.
#[test]
fn a_fit_is_a_scene_that_is_drawn_and_sampled() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for (family, parameters) in [("lattice", "70"), ("tensor", "89"), ("standard", "97")] {
        let scene = format!("{family}.toml");
        let args = [
            "fit",
            DEM,
            "--model",
            family,
            "--parameters",
            parameters,
            "--window",
            "60,200,33",
            "-o",
            &scene,
        ];
        let printed = good(at, &args);
        let words: Vec<&str> = printed.lines().nth(1).unwrap().split_whitespace().collect();
        let number = |k: usize| words[k].parse::<f64>().unwrap();
        assert_eq!(words[0], family, "{printed}");
        let (psnr, splines) = (number(6), [number(9), number(10), number(11)]);
        assert!(psnr > 20.0, "{printed}");
        assert!(family != "lattice" || splines.iter().all(|spline| psnr > *spline), "{printed}");
        good(at, &["dump", &scene, "-o", "a.png", "--size", "60x60"]);
        good(at, &["export", &scene]);
        let (mut lines, mut worst) = (0, 0.0_f64);
        for line in good(at, &["sample", &scene, "--points", "300"]).lines().skip(1) {
            let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
            worst = worst.max((cells[2] - cells[3]).abs());
            lines += 1;
        }
        assert!(lines > 60 && worst < 1e-6, "{lines} {worst}");
    }
    let args = ["fit", DEM, "--bytes", "130", "--window", "0,0,33", "-o", "coarse.toml"];
    assert!(good(at, &args).contains("lattice"));
}

#[test]
fn what_cannot_be_fitted_is_said_in_one_line_and_nothing_is_written() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let sixteen = png::BitDepth::Sixteen;
    picture(&at.join("flat.png"), [33, 33], sixteen, |_, _| 700);
    picture(&at.join("tiny.png"), [2, 2], sixteen, |x, y| (x + y) as u16);
    picture(&at.join("void.png"), [33, 33], sixteen, |x, y| if x == 7 { 1 << 15 } else { (x * y) as u16 });
    picture(&at.join("low.png"), [33, 33], png::BitDepth::Eight, |x, y| (x * x + y) as u16 / 8);
    let cases: [(&[&str], &str); 18] = [
        (&["flat.png", "--parameters", "70"], "flat"),
        (&["tiny.png", "--parameters", "4"], "2 samples a side holds no"),
        (&["void.png", "--parameters", "70"], "33 samples of the window are missing"),
        (&["none.png", "--parameters", "70"], "none.png"),
        (&[DEM, "--parameters", "70"], "no square"),
        (&[DEM, "--parameters", "70", "--window", "300,0,129"], "reaches beyond"),
        (&[DEM, "--parameters", "70", "--window", "18446744073709551615,0,33"], "reaches beyond"),
        (&[DEM, "--parameters", "70", "--window", "0,0,18446744073709551615"], "reaches beyond"),
        (&[DEM, "--parameters", "70", "--window", "0,0,0"], "0 samples a side"),
        (&[DEM, "--parameters", "2000", "--window", "0,0,33"], "more than the 1089 samples"),
        (&[DEM, "--parameters", "30", "--window", "0,0,33"], "the smallest lattice"),
        (&[DEM, "--bytes", "30", "--window", "0,0,33"], "--bytes 30"),
        (&[DEM, "--parameters", "70", "--window", "0,0"], "a window is row,col,side"),
        (&[DEM, "--parameters", "70", "--model", "cubic", "--window", "0,0,33"], "cubic"),
        (&[DEM, "--parameters", "70", "--window", "-1,0,33"], "a window is row,col,side"),
        (&[DEM, "--parameters", "-70", "--window", "0,0,33"], "-70"),
        (&[DEM, "--parameters", "70", "--bytes", "300", "--window", "0,0,33"], "cannot be used with"),
        (&[DEM, "--window", "0,0,33"], "<--parameters <N>|--bytes <B>>"),
    ];
    for (args, reason) in cases {
        let args = [&["fit"], args, &["-o", "out.toml"]].concat();
        let complaint = bad(at, &args);
        assert!(complaint.contains(reason), "{args:?}: {complaint}");
        assert!(!at.join("out.toml").exists());
    }
    good(at, &["fit", "void.png", "--parameters", "70", "--voids", "fill", "-o", "out.toml"]);
    let low = attractor_in(at, &["fit", "low.png", "--parameters", "70", "-o", "low.toml"]);
    assert!(String::from_utf8_lossy(&low.stderr).contains("terraces") && low.status.success());
}

/// Samples on which no start can improve: `a (x) a` with `a = (-1, 2, 0, -2, 1)` is at right angles to all
/// products of what parabolas and Takagi's curves have at quarters, so that the best heights are level, and
/// maps do not matter.
#[test]
fn a_fit_that_does_not_improve_writes_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    const A: [i32; 5] = [-1, 2, 0, -2, 1];
    let height = |x: u32, y: u32| (3000 + 100 * A[x as usize] * A[y as usize]) as u16;
    picture(&at.join("crossed.png"), [5, 5], png::BitDepth::Sixteen, height);
    let args = ["fit", "crossed.png", "--model", "tensor", "--parameters", "17", "-o", "out.toml"];
    let output = attractor_in(at, &args);
    assert_eq!(output.status.code(), Some(2));
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert!(complaint.contains("the fit does not improve") && complaint.lines().count() == 1, "{complaint}");
    assert!(output.stdout.is_empty() && !at.join("out.toml").exists());
    // one sample moved, and it does
    picture(&at.join("moved.png"), [5, 5], png::BitDepth::Sixteen, |x, y| {
        height(x, y) + u16::from(x + y == 3) * 90
    });
    good(at, &["fit", "moved.png", "--model", "tensor", "--parameters", "17", "-o", "out.toml"]);
}

/// A plane is where every start is already, but for what heights beyond the samples are drawn by.
#[test]
fn a_plane_is_fitted_by_where_one_starts() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    picture(&at.join("tilt.png"), [33, 33], png::BitDepth::Sixteen, |x, _| (1000 + 20 * x) as u16);
    picture(&at.join("ramp.png"), [33, 33], png::BitDepth::Sixteen, |x, y| (x + 33 * y) as u16);
    let psnr = |printed: &str| -> f64 {
        printed.lines().nth(1).unwrap().split_whitespace().nth(6).unwrap().parse().unwrap()
    };
    for name in ["tilt.png", "ramp.png"] {
        let printed = good(at, &["fit", name, "--parameters", "142", "-o", "out.toml"]);
        assert!(psnr(&printed) > 90.0, "{printed}");
        good(at, &["dump", "out.toml", "-o", "out.png", "--size", "60x60"]);
    }
    let tensor = ["fit", "tilt.png", "--model", "tensor", "--parameters", "200", "-o", "exact.toml"];
    let printed = good(at, &tensor);
    assert!(psnr(&printed) == f64::INFINITY, "{printed}");
    good(at, &["dump", "exact.toml", "-o", "exact.png", "--size", "60x60"]);
}

/// Samples without any order: beside them the heights of a lattice leave what is drawn.
#[test]
fn a_fit_that_cannot_be_drawn_is_not_written() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let noise = |x: u32, y: u32| {
        let hash = (x * 374_761 + y * 66_826 + 1).wrapping_mul(0x9e37_79b9).rotate_left(13);
        (hash.wrapping_mul(0x85eb_ca6b) >> 17) as u16
    };
    picture(&at.join("noise.png"), [33, 33], png::BitDepth::Sixteen, noise);
    let args = ["fit", "noise.png", "--parameters", "142", "-o", "out.toml"];
    let said = bad(at, &args);
    assert!(
        said.contains("no scene that can be drawn, and is not written: out.toml:")
            && said.contains("heights = "),
        "{said}"
    );
    assert!(said.contains("must lie between") && !at.join("out.toml").exists(), "{said}");
}

/// Scenes of curves and surfaces that are none.
#[test]
fn control_points_that_make_nothing_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let curve = "kind = \"patch-curve\"\ncontrol_points = ";
    let surface = "kind = \"patch-surface\"\nmodel = \"tensor\"\n";
    let camera = "[camera]\neye = [-2, -3, 2]\nlook_at = [0, 0, 0]\n";
    let numbers = "numbers = [1, \"-0.25\", 1, \"-0.25\", 1, \"-0.25\", 1, \"-0.25\"]\n";
    let nine = "heights = [0, 0, 0, 0, 1, 0, 0, 0, 0]\n";
    let cases = [
        (format!("{curve}[]\ncurve = \"bezier\"\n"), "0 control points given"),
        (format!("{curve}[[0, 0]]\ncurve = \"bezier\"\n"), "1 control points given"),
        (format!("{curve}[[0, 0], [1, 0]]\ncurve = \"takagi\"\n"), "3 expected"),
        (format!("{curve}[[0, 0], [1, 0]]\n"), "missing"),
        (format!("{curve}[[0, 0], [1, 1], [2, 0]]\nmaps = [[2, -1], [0.5, 0]]\n"), "not a contraction"),
        (format!("{curve}[[0, 0], [1, 1], [2, 0]]\ncurve = \"takagi\"\nlevels = 40\n"), "levels"),
        (format!("{surface}numbers = [1]\n{nine}{camera}"), "8 expected"),
        (format!("{surface}numbers = [2, -1, 2, -1, 1, 0, 1, 0]\n{nine}{camera}"), "not a contraction"),
        (format!("{surface}{numbers}heights = [0]\n{camera}"), "9 expected"),
        (format!("{surface}{numbers}cells = 0\n{nine}{camera}"), "cells"),
        (format!("{surface}{numbers}heights = [0, 0, 0, 0, 120, 0, 0, 0, 0]\n{camera}"), "height [4]"),
        (format!("{surface}{numbers}{nine}height = 0\n{camera}"), "heights"),
    ];
    for (text, reason) in cases {
        fs::write(at.join("scene.toml"), &text).unwrap();
        let complaint = bad(at, &["dump", "scene.toml", "-o", "x.png"]);
        assert!(complaint.contains(reason), "{text}: {complaint}");
    }
}
