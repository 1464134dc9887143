//! Every built-in scene on every display; the pictures themselves are held to goldens.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::common::{decode, good};
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

/// Changed on purpose? `ATTRACTOR_BLESS=1 cargo test -p attractor-sim --test suite pictures`, look at the pictures, and say so in the CHANGELOG.
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
