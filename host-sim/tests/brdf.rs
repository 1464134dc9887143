//! `attractor brdf`: tables of slopes, as materials, as constants and as pictures.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;

use crate::common::{Said, decode, good};

#[test]
fn the_built_in_tables_are_those_that_the_command_writes() {
    let directory = tempfile::tempdir().unwrap();
    for (scene, table) in [("figure-6-gg", "slopes-g-x-g.toml"), ("figure-6-ff", "slopes-f-x-f.toml")] {
        assert_eq!(good(directory.path(), &["brdf", scene, "-o", table]), format!("{table}\n"));
        let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(table);
        let same = fs::read(directory.path().join(table)).unwrap() == fs::read(committed).unwrap();
        assert!(same, "{table}: cd host-sim/data && attractor brdf {scene} -o {table}");
    }
}

#[test]
fn a_part_of_a_surface_is_a_table_constants_and_a_picture() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let part = ["--region", "0,0.5,1,2", "--side", "8", "--reach", "1.5", "--points", "512"];
    let files = ["-o", "part.toml", "-o", "part.rs", "-o", "part.png"];
    let said = good(path, &[&["brdf", "figure-6-gg"], &part[..], &files].concat());
    assert_eq!(said, "part.toml\npart.rs\npart.png\n");
    let table = fs::read_to_string(path.join("part.toml")).unwrap();
    assert!(
        table.starts_with("# The slopes of figure-6-gg above [0, 0.5] x [1, 2]: 8 x 8 squares"),
        "{table}"
    );
    let rust = fs::read_to_string(path.join("part.rs")).unwrap();
    assert!(rust.contains("pub static SLOPES: [u16; 67] = [\n    1, 8, 384,\n"), "{rust}");
    let numbers = |text: &str| -> Vec<u32> {
        text.split(|c: char| !c.is_ascii_digit()).filter_map(|word| word.parse().ok()).collect()
    };
    let weights = table.split_once("weights").unwrap().1;
    let words = rust.split_once("1, 8, 384,").unwrap().1.split_once(']').unwrap().0;
    assert_eq!(numbers(weights), numbers(words));
    // upwards, the brightest where the table has most
    let picture = decode(&path.join("part.png"));
    let side = 8 * 32;
    assert_eq!(picture.size, (side, side));
    let at = |i: u32, j: u32| picture.data[3 * (((7 - j) * 32 + 7) * side + i * 32 + 7) as usize] as u32;
    let brightest = (0..64).max_by_key(|k| (at(k % 8, k / 8), *k)).unwrap();
    let weights = numbers(weights);
    assert_eq!(weights[brightest as usize], 65535);
    assert_eq!(weights.iter().filter(|w| **w == 65535).count(), 2);
    // it is another one than that of the whole, and a material
    let scene = |distribution: &str| {
        format!(
            "kind = \"world\"\n[camera]\neye = [0, -5, 1]\nlook_at = [0, 0, 0]\n[[light]]\ntowards = [-1, -3, 3]\n\
             [[object]]\nshape = \"torus\"\ntube = 0.4\nmaterial = \"m\"\n[material.m]\ndistribution = \"{distribution}\"\n"
        )
    };
    let drawn = |distribution: &str| {
        fs::write(path.join("scene.toml"), scene(distribution)).unwrap();
        good(path, &["sample", "scene.toml", "--size", "12x12"])
    };
    let (part, whole) = (drawn("part.toml"), drawn("g-x-g"));
    assert_ne!(part, whole);
    // as the reference has it
    let mut shiny = 0;
    for line in part.lines().skip(1).chain(whole.lines().skip(1)) {
        let row: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert!((2..5).all(|k| (row[k] - row[k + 3]).abs() < 2e-3), "{line}");
        shiny += usize::from(row[2] > 0.3);
    }
    assert!(shiny > 20, "{shiny}");
}

#[test]
fn what_has_no_slopes_and_tables_that_are_none_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let mut said = Said::default();
    for args in [
        &["brdf", "fern", "-o", "out.toml"][..],
        &["brdf", "figure-7", "-o", "out.toml"],
        &["brdf", "figure-6-gg"],
        &["brdf", "figure-6-gg", "-o", "out.bin"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "-o", "no/such/out.png"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--side", "1"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--side", "129"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--reach", "9"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--region", "1,0,0,1"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--region", "0,3,0,1"],
        &["brdf", "figure-6-gg", "-o", "out.toml", "--palette", "mud"],
    ] {
        said.command(path, args);
        assert_eq!(fs::read_dir(path).unwrap().count(), 0, "{args:?}");
    }
    let world = "kind = \"world\"\n[camera]\neye = [0, -5, 1]\nlook_at = [0, 0, 0]\n[[object]]\nshape = \"sphere\"\n\
                 material = \"m\"\n[material.m]\ndistribution = \"g-x-g\"\n";
    said.change(world, "\"g-x-g\"", "\"h-x-h\"");
    said.change(world, "\"g-x-g\"", "\"none.toml\"");
    said.change(world, "distribution = \"g-x-g\"", "model = \"tabulated\"");
    said.change(world, "\"g-x-g\"", "\"g-x-g\"\nroughness = 0.5");
    said.change(world, "\"g-x-g\"", "\"g-x-g\"\nmodel = \"phong\"");
    said.change(world, "\"g-x-g\"", "\"g-x-g\"\nreflectance = 2");
    let table = "version = 1\nside = 2\nreach = 256\nweights = [[1, 2], [2, 1]]\n";
    fs::write(path.join("scene.toml"), world.replace("g-x-g", "table.toml")).unwrap();
    for (from, to) in [
        ("version = 1", "version = 2"),
        ("side = 2", "side = 3"),
        ("side = 2", "side = 1"),
        ("reach = 256", "reach = 9999"),
        ("[2, 1]]", "[2, 1], [1, 1]]"),
        ("[2, 1]]", "[2, 3]]"),
        ("[[1, 2], [2, 1]]", "[[0, 0], [0, 0]]"),
        ("weights = [[1, 2], [2, 1]]\n", ""),
        ("[2, 1]", "[2, 65536]"),
    ] {
        assert!(table.contains(from), "{from}");
        fs::write(path.join("table.toml"), table.replacen(from, to, 1)).unwrap();
        said.command(path, &["dump", "scene.toml", "-o", "out.png", "--size", "8x8"]);
        assert_eq!(fs::read_dir(path).unwrap().count(), 2, "{to}");
    }
    fs::write(path.join("table.toml"), table).unwrap();
    good(path, &["dump", "scene.toml", "-o", "out.png", "--size", "8x8"]);
    assert_snapshot!(said);
}
