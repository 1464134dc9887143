//! Bad input of terrain: one line that names file, key and value, exit code 2, nothing half-written; and what
//! is told of elevations that are not quite good.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;

use crate::common::{Said, attractor_in, good};

const TERRAIN: &str = "kind = \"terrain\"
knots = [[0, 0.5], [0.25, -0.5]]
offset = 0.25
levels = 3
[camera]
eye = [0, -3, 2]
look_at = [0, 0, 0]
";

#[test]
fn the_good_terrain_is_good_at_the_ends_of_its_ranges() {
    let directory = tempfile::tempdir().unwrap();
    for (from, to) in [
        ("", ""),
        ("levels = 3", "levels = 0"),
        ("levels = 3", "levels = 3\nseed = 18446744073709551615\norigin = [-32768, 32766]"),
        ("levels = 3", "levels = 3\nseed = 2147483648\nsurface = 4294967295\norigin = [32766, -32768]"),
        ("levels = 3", "levels = 3\nover = [[-63, 63], [-1, 1]]"),
        ("offset = 0.25", "offset = 0\nsimilarity = 0"),
    ] {
        fs::write(directory.path().join("scene.toml"), TERRAIN.replace(from, to)).unwrap();
        good(directory.path(), &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
    }
    let sample = good(directory.path(), &["sample", "scene.toml", "--points", "9"]);
    assert!(sample.starts_with("u,v,height\n0,0,0\n"), "{sample}");
}

#[test]
fn terrain_that_cannot_be_is_refused() {
    let mut said = Said::default();
    for knots in
        ["[[0, 1]]", "[[0], [1]]", "[[0, 1], [2]]", "[[0, 1], [2, 64]]", "[[0, 1], [2, \"high\"]]", "[]"]
    {
        said.change(TERRAIN, "[[0, 0.5], [0.25, -0.5]]", knots);
    }
    said.change(TERRAIN, "knots = [[0, 0.5], [0.25, -0.5]]\n", "");
    said.change(TERRAIN, "offset = 0.25", "offset = 2");
    said.change(TERRAIN, "offset = 0.25", "offset = -0.1");
    said.change(TERRAIN, "offset = 0.25", "offset = 1.9\nsimilarity = 0");
    said.change(TERRAIN, "offset = 0.25", "similarity = 1.1");
    said.change(TERRAIN, "levels = 3", "levels = 17");
    said.change(TERRAIN, "levels = 3", "levels = 13");
    said.change(TERRAIN, "levels = 3", "levels = -1");
    said.change(TERRAIN, "levels = 3", "levels = 3\nseed = 18446744073709551616");
    said.change(TERRAIN, "levels = 3", "levels = 3\norigin = [32767, 0]");
    said.change(TERRAIN, "levels = 3", "levels = 3\nover = [[-1, 65], [-1, 1]]");
    said.change(TERRAIN, "levels = 3", "levels = 3\nover = [[1, 1], [-1, 1]]");
    said.change(TERRAIN, "levels = 3", "levels = 3\ninner = \"cubic\"");
    said.change(TERRAIN, "levels = 3", "levels = 3\nsamples = 0");
    said.change(TERRAIN, "levels = 3", "levels = 3\ncontrast = [90, 90]");
    said.change(TERRAIN, "levels = 3", "levels = 3\ncontrast = [0, 256]");
    said.change(TERRAIN, "levels = 3", "levels = 3\nhaze = 1.5");
    said.change(TERRAIN, "levels = 3", "levels = 3\nmesh = \"lattice\"");
    said.change(TERRAIN, "[camera]", "[near]\neye = [0, 0, 1]\nlength = 0.1\n[camera]");
    said.change(TERRAIN, "[camera]", "[sun]\ntowards = [0, 0, 0]\n[camera]");
    said.change(TERRAIN, "[camera]", "[ground]\nsnow = \"white\"\n[camera]");
    said.change(TERRAIN, "[camera]\neye = [0, -3, 2]\nlook_at = [0, 0, 0]\n", "");
    assert_snapshot!(said);
}

/// A grey PNG file.
fn picture(path: &Path, (columns, rows): (u32, u32), depth: png::BitDepth, values: &[u16]) {
    let mut encoder = png::Encoder::new(fs::File::create(path).unwrap(), columns, rows);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(depth);
    let bytes: Vec<u8> = match depth {
        png::BitDepth::Sixteen => values.iter().flat_map(|value| value.to_be_bytes()).collect(),
        _ => values.iter().map(|value| *value as u8).collect(),
    };
    encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
}

const ELEVATED: &str = "kind = \"terrain\"
levels = 1
[elevation]
png = \"land.png\"
step = 0.001
[camera]
eye = [0, -3, 2]
look_at = [0, 0, 0]
";

/// Every file with what the command says of it, and whether it draws it all the same.
#[test]
fn elevations_are_read_whole_or_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    let (sixteen, eight) = (png::BitDepth::Sixteen, png::BitDepth::Eight);
    let hill = |x: u32, y: u32| 300 + 40 * (x * (15 - x) + y * (15 - y)) as u16 % 977;
    let land: Vec<u16> = (0..256).map(|k| hill(k % 16, k / 16)).collect();
    let mut holed = land.clone();
    holed[37] = 0;
    let mut said = String::new();
    let mut tell = |what: &str, scene: &str, drawn: bool| {
        fs::write(here.join("scene.toml"), scene).unwrap();
        let _ = fs::remove_file(here.join("out.png"));
        let output = attractor_in(here, &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"]);
        assert_eq!(output.status.code(), Some(if drawn { 0 } else { 2 }), "{what}");
        assert_eq!(here.join("out.png").exists(), drawn, "{what}");
        said += &format!("{what}: {}\n", String::from_utf8_lossy(&output.stderr).trim_end());
    };
    picture(&here.join("land.png"), (16, 16), sixteen, &land);
    tell("16 bits", ELEVATED, true);
    tell("a window", &ELEVATED.replace("step", "window = [3, 4, 2, 2]\nstep"), true);
    tell("a window outside", &ELEVATED.replace("step", "window = [15, 4, 2, 2]\nstep"), false);
    tell("a window too small", &ELEVATED.replace("step", "window = [3, 4, 1, 2]\nstep"), false);
    tell("a step too large", &ELEVATED.replace("0.001", "1"), false);
    picture(&here.join("land.png"), (16, 16), eight, &land.iter().map(|v| v / 8).collect::<Vec<_>>());
    tell("8 bits", ELEVATED, true);
    picture(&here.join("land.png"), (16, 16), sixteen, &[700; 256]);
    tell("flat", ELEVATED, true);
    picture(&here.join("land.png"), (2, 2), sixteen, &[1, 2, 3, 5]);
    tell("2 x 2", ELEVATED, true);
    picture(&here.join("land.png"), (2, 1), sixteen, &[1, 2]);
    tell("2 x 1", ELEVATED, false);
    picture(&here.join("land.png"), (16, 16), sixteen, &holed);
    tell("a void", &ELEVATED.replace("step", "void = 0\nstep"), false);
    tell("a void filled", &ELEVATED.replace("step", "void = 0\nvoids = \"fill\"\nstep"), true);
    picture(&here.join("land.png"), (2, 2), sixteen, &[0; 4]);
    tell("all void", &ELEVATED.replace("step", "void = 0\nvoids = \"fill\"\nstep"), false);
    fs::write(here.join("land.png"), "no picture").unwrap();
    tell("no picture", ELEVATED, false);
    tell("no file", &ELEVATED.replace("land.png", "sea.png"), false);
    assert_snapshot!(said);
}
