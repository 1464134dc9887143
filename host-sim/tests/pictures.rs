//! Every built-in scene on every display; the pictures themselves are held to goldens.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{attractor_in, bad, decode, good};
use png::{BitDepth, ColorType};

const GOLDENS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/goldens.txt");

#[test]
fn every_scene_is_drawn_in_every_colour_depth() {
    for (color, kind, depth) in [
        ("rgb565", ColorType::Rgb, BitDepth::Eight),
        ("rgb888", ColorType::Rgb, BitDepth::Eight),
        ("gray8", ColorType::Grayscale, BitDepth::Eight),
        ("gray4", ColorType::Grayscale, BitDepth::Four),
        ("gray2", ColorType::Grayscale, BitDepth::Two),
        ("mono", ColorType::Grayscale, BitDepth::One),
    ] {
        let directory = tempfile::tempdir().unwrap();
        let args = ["dump", "--all", "-o", "here", "--size", "75x50", "--color", color, "--scale", "2"];
        let printed = good(directory.path(), &args);
        assert!(printed.lines().count() >= 20);
        for file in printed.lines() {
            let png = decode(&directory.path().join(file));
            assert_eq!((png.size, png.color, png.depth), ((150, 100), kind, depth), "{file}");
            let first = png.data[0];
            assert!(png.data.iter().any(|byte| *byte != first), "{file} shows nothing in {color}");
        }
        assert_eq!(fs::read_dir(directory.path().join("here")).unwrap().count(), printed.lines().count());
    }
}

#[test]
fn the_smallest_and_the_oddest_displays_work() {
    for size in ["1x1", "1x200", "64x8", "3x5", "31x33"] {
        let directory = tempfile::tempdir().unwrap();
        let printed = good(directory.path(), &["dump", "--size", size]);
        let side: Vec<u32> = size.split('x').map(|n| n.parse().unwrap()).collect();
        for file in printed.lines() {
            assert_eq!(decode(&directory.path().join(file)).size, (side[0], side[1]), "{file}");
        }
    }
}

/// Changed on purpose? `ATTRACTOR_BLESS=1 cargo test -p attractor-sim --test suite pictures`, look at the
/// pictures, and say so in the CHANGELOG.
#[test]
fn pictures_are_the_same_to_the_last_bit() {
    let mut now = BTreeMap::new();
    for (color, size) in [("rgb565", "240x240"), ("mono", "128x64")] {
        let directory = tempfile::tempdir().unwrap();
        for file in good(directory.path(), &["dump", "--all", "--size", size, "--color", color]).lines() {
            let scene = Path::new(file).file_stem().unwrap().to_string_lossy().into_owned();
            let crc = crc32fast::hash(&display_bytes(&directory.path().join(file)));
            now.insert(format!("{scene} {color} {size}"), format!("{crc:08x}"));
        }
    }
    let text: String = now.iter().map(|(key, crc)| format!("{key} {crc}\n")).collect();
    if std::env::var_os("ATTRACTOR_BLESS").is_some() {
        fs::write(GOLDENS, format!("# scene, colour, size, CRC-32 of the display's bytes (big-endian pixels, rows of packed bits)\n{text}")).unwrap();
        return;
    }
    let goldens = fs::read_to_string(GOLDENS).unwrap();
    let goldens: String = goldens.lines().filter(|l| !l.starts_with('#')).map(|l| format!("{l}\n")).collect();
    let different: Vec<_> = text.lines().filter(|line| !goldens.lines().any(|g| g == *line)).collect();
    assert!(different.is_empty(), "not as in goldens.txt: {different:#?}");
    assert_eq!(text.lines().count(), goldens.lines().count(), "goldens.txt has scenes that are gone");
}

/// A complete scene of each kind stands in `host-sim/README.md`.
#[test]
fn the_examples_of_the_readme_are_drawn_and_sampled() {
    const README: &str = include_str!("../README.md");
    let examples = README.split("```toml\n").skip(1).map(|example| example.split("```").next().unwrap());
    let directory = tempfile::tempdir().unwrap();
    let mut kinds = Vec::new();
    for example in examples {
        fs::write(directory.path().join("scene.toml"), example).unwrap();
        good(directory.path(), &["dump", "scene.toml", "-o", "a.png", "--size", "64x64"]);
        let png = decode(&directory.path().join("a.png"));
        assert!(png.data.chunks(3).any(|pixel| pixel != &png.data[..3]), "shows nothing: {example}");
        good(directory.path(), &["sample", "scene.toml", "--points", "9", "--size", "4x4"]);
        kinds.push(example.lines().next().unwrap().trim_start_matches("kind = ").trim_matches('"'));
    }
    // all kinds that the command knows, one example each
    fs::write(directory.path().join("scene.toml"), "title = \"no kind\"\n").unwrap();
    let complaint = bad(directory.path(), &["dump", "scene.toml"]);
    let known = complaint.trim_end().split("allowed is ").nth(1).unwrap();
    let mut known: Vec<&str> = known.split(", ").collect();
    kinds.sort_unstable();
    known.sort_unstable();
    assert_eq!(kinds, known);
}

/// Those of the README are what its first command writes; compression may differ.
#[test]
fn pictures_of_the_readme_are_what_dump_draws() {
    const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs");
    let files = fs::read_dir(DOCS).unwrap().map(|entry| entry.unwrap().path());
    let pictures: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "png")).collect();
    let scenes: Vec<_> = pictures.iter().map(|path| path.file_stem().unwrap().to_str().unwrap()).collect();
    assert!(scenes.len() >= 9);
    let directory = tempfile::tempdir().unwrap();
    // those of a display of one bit are told by their names
    let (small, large): (Vec<&str>, Vec<&str>) =
        scenes.iter().copied().partition(|scene| scene.ends_with("-one-bit"));
    assert!(small.len() >= 3);
    good(directory.path(), &[&["dump"], &large[..], &["-o", "out"]].concat());
    for name in small {
        let (scene, file) = (name.trim_end_matches("-one-bit"), format!("out/{name}.png"));
        let look = ["--size", "128x64", "--color", "mono", "--scale", "2"];
        good(directory.path(), &[&["dump", scene, "-o", &file][..], &look].concat());
    }
    for (path, scene) in pictures.iter().zip(&scenes) {
        let (kept, drawn) = (decode(path), decode(&directory.path().join(format!("out/{scene}.png"))));
        assert!((kept.size, kept.color, kept.depth) == (drawn.size, drawn.color, drawn.depth), "{scene}");
        assert!(kept.data == drawn.data, "{scene}: look at it, and copy it to docs/");
    }
}

/// What a driver would send: Rgb565 big-endian, mono packed with the leftmost pixel highest.
fn display_bytes(path: &Path) -> Vec<u8> {
    let png = decode(path);
    if png.color == ColorType::Grayscale {
        return png.data;
    }
    let word = |p: &[u8]| u16::from(p[0] >> 3) << 11 | u16::from(p[1] >> 2) << 5 | u16::from(p[2] >> 3);
    png.data.chunks(3).flat_map(|p| word(p).to_be_bytes()).collect()
}

#[test]
fn another_seed_makes_another_walk_and_the_same_seed_the_same_file() {
    let directory = tempfile::tempdir().unwrap();
    let mut files = Vec::new();
    for (seed, file) in [("7", "a.png"), ("7", "b.png"), ("8", "c.png")] {
        let args = ["dump", "sierpinski", "--seed", seed, "-o", file, "--size", "64x64"];
        assert_eq!(good(directory.path(), &args), format!("{file}\n"));
        files.push(fs::read(directory.path().join(file)).unwrap());
    }
    assert!(files[0] == files[1] && files[0] != files[2]);
}

#[test]
fn directories_are_made_and_a_slash_means_one() {
    let directory = tempfile::tempdir().unwrap();
    let dump =
        |output: &str| good(directory.path(), &["dump", "koch-curve", "-o", output, "--size", "16x16"]);
    for (output, file) in [
        ("nowhere/at/all/a.png", "nowhere/at/all/a.png"),
        ("deep/directory", "deep/directory/koch-curve.png"),
        ("x.jpg/", "x.jpg/koch-curve.png"),
        ("x.jpg", "x.jpg/koch-curve.png"),
        ("b.PNG", "b.PNG"),
    ] {
        assert_eq!(dump(output), format!("{file}\n"));
        decode(&directory.path().join(file));
    }
}

#[test]
fn one_picture_goes_to_standard_output_as_png() {
    let directory = tempfile::tempdir().unwrap();
    let output = attractor_in(directory.path(), &["dump", "koch-curve", "-o", "-", "--size", "16x16"]);
    assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 0);
    good(directory.path(), &["dump", "koch-curve", "-o", "a.png", "--size", "16x16"]);
    assert!(output.stdout == fs::read(directory.path().join("a.png")).unwrap());
    #[cfg(unix)]
    {
        // a device is written to, not replaced
        let again =
            attractor_in(directory.path(), &["dump", "koch-curve", "-o", "/dev/stdout", "--size", "16x16"]);
        assert!(again.stdout == output.stdout);
        assert_eq!(good(directory.path(), &["dump", "koch-curve", "-o", "/dev/null", "--size", "16x16"]), "");
    }
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_keeps_its_permissions_and_its_links() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let directory = tempfile::tempdir().unwrap();
    let at = |file: &str| directory.path().join(file);
    for mode in [0o600, 0o640, 0o666, 0o755] {
        fs::write(at("real.png"), "old").unwrap();
        fs::set_permissions(at("real.png"), fs::Permissions::from_mode(mode)).unwrap();
        good(directory.path(), &["dump", "koch-curve", "-o", "real.png", "--size", "16x16"]);
        decode(&at("real.png"));
        assert_eq!(fs::metadata(at("real.png")).unwrap().permissions().mode() & 0o7777, mode);
    }
    symlink("real.png", at("link.png")).unwrap();
    good(directory.path(), &["dump", "koch-curve", "-o", "link.png", "--size", "8x8"]);
    assert!(fs::symlink_metadata(at("link.png")).unwrap().is_symlink());
    assert_eq!(decode(&at("real.png")).size, (8, 8));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2);
}

#[cfg(unix)]
#[test]
fn a_file_gets_ordinary_permissions_and_replaces_the_one_before() {
    use std::os::unix::fs::PermissionsExt as _;
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("plain"), "").unwrap();
    fs::write(directory.path().join("a.png"), "old").unwrap();
    good(directory.path(), &["dump", "koch-curve", "-o", "a.png", "--size", "16x16"]);
    let mode = |file: &str| fs::metadata(directory.path().join(file)).unwrap().permissions().mode();
    assert_eq!(mode("a.png"), mode("plain"));
    decode(&directory.path().join("a.png"));
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 2);
}

/// Maps that hardly contract add up what bounds are rounded by; none of that is seen.
#[test]
fn a_constant_is_a_line_whatever_its_scalings() {
    let directory = tempfile::tempdir().unwrap();
    let drawn = |scaling: &str| {
        let scene = format!(
            "kind = \"fif-curve\"\nknots = [[0, 5], [1, 5], [2, 5]]\nvertical_scaling = [{scaling}, {scaling}]\n"
        );
        fs::write(directory.path().join("scene.toml"), scene).unwrap();
        good(directory.path(), &["dump", "scene.toml", "-o", "out.png"]);
        decode(&directory.path().join("out.png"))
    };
    for scaling in ["0", "0.5", "-0.5", "0.9", "-0.9", "0.99", "0.9999"] {
        let picture = drawn(scaling);
        // beside the middle, where a knot is marked: paper, the line, which is brightest, the ground below it
        let pixel = |y: usize| &picture.data[3 * (240 * y + 150)..][..3];
        let rows: Vec<usize> = (0..240).filter(|y| pixel(*y)[1] > 150).collect();
        assert!(
            (1..=2).contains(&rows.len()) && rows.iter().all(|y| y.abs_diff(120) < 3),
            "{scaling}: {rows:?}"
        );
    }
}
