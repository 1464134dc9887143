//! What the features `serde` and `defmt` promise: every public value and description, or a reason why not.

use std::format;
use std::fs;
use std::path::{Path, PathBuf};
use std::string::String;
use std::vec::Vec;

/// Why a type is neither written nor read.
const NOT_SERDE: [(&str, &[&str]); 6] = [
    (
        "made from values that are written, by a constructor that keeps only what it computes from them",
        &[
            "Fif",
            "Dyadic",
            "Compiled",
            "Composite",
            "Factor",
            "Camera",
            "HeightMoments",
            "SlopeMoments",
            "Light",
            "Ray",
            "Generator",
            "JuliaCover",
            "Affine3",
            "HalfSpace",
            "Torus",
            "Polygon",
            "TaperedCylinder",
            "Superellipsoid",
            "Lamp",
            "Anisotropic",
            "TorranceSparrow",
            "Clear",
            "Mixture",
            "Spline",
            "Barycentric",
            "Address",
            "Contraction",
            "ProjectedCurve",
            "Tensor",
            "Patch",
            "Mask",
            "Law",
        ],
    ),
    (
        "what a stream says, which is the written form",
        &[
            "Header",
            "Shape",
            "Place",
            "Leaf",
            "Levels",
            "Setting",
            "Opened",
            "Model",
            "Bytes",
            "Edge",
            "Luma",
            "Unsettled",
        ],
    ),
    (
        "things, materials and textures of a world: made of what is written, or of functions",
        &[
            "Placed",
            "Moved",
            "Implicit",
            "Union",
            "Intersection",
            "Difference",
            "Sky",
            "Tiles",
            "Mapped",
            "Marble",
            "Mottle",
            "Texels",
            "Lookup",
            "Beyond",
            "Turbulence",
            "Checker",
            "Bumpy",
            "Rough",
            "Facets",
            "Slice",
            "Wood",
            "Framed",
            "Hazy",
            "Landscape",
            "WorldCaster",
        ],
    ),
    ("the same, with a seed", &["Elbow", "LineToLine", "OneVariable", "TwoVariable"]),
    ("a step on the way to a value", &["Reciprocal", "Alias", "Ending", "OrbitPoint"]),
    ("walks along something else, or a function", &["BackwardIteration", "Walk", "FromFn"]),
];

/// Why a type is not logged.
const NOT_DEFMT: [(&str, &[&str]); 5] = [
    (
        "as large as a program, or made of what is logged",
        &[
            "Dyadic",
            "Compiled",
            "Composite",
            "Factor",
            "JuliaCover",
            "Barycentric",
            "ProjectedCurve",
            "Tensor",
            "Patch",
        ],
    ),
    ("a step on the way to a value", &["Ending", "OrbitPoint"]),
    (
        "what a stream says, and what reads it",
        &[
            "Shape",
            "Place",
            "Leaf",
            "Levels",
            "Setting",
            "Opened",
            "Model",
            "Bytes",
            "Edge",
            "Luma",
            "Unsettled",
        ],
    ),
    (
        "things, materials and textures of a world: made of what is logged, or of functions",
        &[
            "Placed",
            "Moved",
            "Polygon",
            "Implicit",
            "Union",
            "Intersection",
            "Difference",
            "Mixture",
            "Mapped",
            "Marble",
            "Mottle",
            "Checker",
            "Bumpy",
            "Slice",
            "Spline",
            "Framed",
            "Hazy",
            "Landscape",
            "WorldCaster",
        ],
    ),
    ("walks along something else, or a function", &["BackwardIteration", "Walk", "FromFn"]),
];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// Each public type with its attributes. Left out: what borrows, which is neither value nor description, and
/// all of `draw` but its levels: palettes, packings and drawings are code or constants.
fn public_types() -> Vec<(String, String)> {
    let mut paths = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut paths);
    let mut types = Vec::new();
    for path in paths {
        if path.parent().is_some_and(|room| room.ends_with("draw")) && !path.ends_with("level.rs") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let mut attributes = String::new();
        for line in text.lines() {
            let declared = line.strip_prefix("pub struct ").or(line.strip_prefix("pub enum "));
            if let Some(declared) = declared {
                let end = declared.find(|c: char| !c.is_alphanumeric()).unwrap();
                if !declared.contains("'a") {
                    types.push((String::from(&declared[..end]), std::mem::take(&mut attributes)));
                }
            }
            if line.is_empty() || line.starts_with('}') {
                attributes.clear();
            } else if !line.starts_with("///") {
                attributes.push_str(line);
            }
        }
    }
    types
}

fn check(promise: &str, elsewhere: &str, exceptions: &[(&str, &[&str])]) {
    let excused: Vec<&str> = exceptions.iter().flat_map(|(_, names)| names.iter().copied()).collect();
    let types = public_types();
    assert!(types.len() > 60, "{} types: the scan is blind", types.len());
    for (name, attributes) in &types {
        let listed = elsewhere.contains(&format!("::{name};"))
            || elsewhere.contains(&format!("::{name}<"))
            || elsewhere.contains(&format!(" for {name}<"));
        let kept = attributes.contains(promise) || listed;
        let excused = excused.contains(&name.as_str());
        assert!(kept || excused, "{name}: no {promise} and no reason why not");
        assert!(!(kept && excused), "{name}: {promise}, and a reason why not");
    }
    for name in excused {
        assert!(types.iter().any(|(found, _)| found == name), "{name} is excused and does not exist");
    }
}

#[test]
fn every_public_value_and_description_is_written_and_read() {
    check("serde::Serialize", include_str!("serial.rs"), &NOT_SERDE);
}

#[test]
fn every_public_value_and_description_is_logged() {
    check("defmt::Format", include_str!("format.rs"), &NOT_DEFMT);
}

#[cfg(feature = "defmt")]
#[test]
fn numbers_of_any_format_are_logged() {
    fn logged<T: defmt::Format>() {}
    logged::<crate::num::Complex<crate::num::Wide>>();
    logged::<crate::num::Vec3>();
    logged::<crate::ifs::Ifs<4>>();
    logged::<crate::escape::Smooth<crate::escape::Mandelbrot>>();
    logged::<crate::Error>();
}
