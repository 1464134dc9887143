//! Scenes of encoded pictures: what they show, and what they refuse.

use std::fs;
use std::path::Path;

use crate::common::{bad, decode, good};

const STREAMING: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/vectors/version-2/streaming.atfi");
const ITERATED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/vectors/version-2/iterated.atfi");
const COLOUR: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/vectors/version-2/colour.atfi");
const HEIGHTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/vectors/version-2/heights.atfi");

/// Draws a scene with these keys on a display of this size.
fn drawn(directory: &Path, keys: &str, size: &str) -> Vec<u8> {
    fs::write(directory.join("scene.toml"), format!("kind = \"image\"\n{keys}\n")).unwrap();
    good(directory, &["dump", "scene.toml", "--size", size, "--color", "rgb888", "-o", "scene.png"]);
    decode(&directory.join("scene.png")).data
}

/// A file beside the scene shows what `attractor decode` makes of it, each frame after its sweeps, and so
/// does a PNG file of that.
#[test]
fn a_scene_shows_what_the_decoder_makes() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    fs::create_dir(here.join("below")).unwrap();
    for (name, from) in
        [("below/a.atfi", STREAMING), ("b.atfi", ITERATED), ("c.ATFI", COLOUR), ("d.atfi", HEIGHTS)]
    {
        fs::copy(from, here.join(name)).unwrap();
    }
    let decoded = |args: &[&str]| {
        good(here, &[&["decode", "--color", "rgb888", "-o", "decoded.png"], args].concat());
        decode(&here.join("decoded.png"))
    };
    // as large as the display, so that there is no paper
    for (file, size) in [("below/a.atfi", "67x129"), ("c.ATFI", "72x56"), ("d.atfi", "61x65")] {
        let wanted = decoded(&[file]);
        assert!(drawn(here, &format!("file = \"{file}\""), size) == wanted.data, "{file}");
        fs::rename(here.join("decoded.png"), here.join("still.png")).unwrap();
        assert!(drawn(here, "file = \"still.png\"", size) == wanted.data, "{file} as a PNG file");
    }
    // half as large, in the middle of its frame, each after its sweeps
    let frames = drawn(here, "file = \"b.atfi\"\nsweeps = [0, 1, 3]", "117x66");
    for (frame, sweeps) in ["0", "1", "3"].into_iter().enumerate() {
        let wanted = decoded(&["b.atfi", "--scale", "1/2", "--sweeps", sweeps]);
        assert_eq!(wanted.size, (34, 65));
        for (row, pixels) in wanted.data.chunks(3 * 34).enumerate() {
            let from = 3 * (row * 117 + 39 * frame + 2);
            assert!(&frames[from..from + 3 * 34] == pixels, "frame {frame}, row {row}");
        }
    }
    assert!(
        drawn(here, "file = \"b.atfi\"\nsweeps = 3", "67x129") == decoded(&["b.atfi", "--sweeps", "3"]).data
    );
    // a fourth of it is still too large: its middle is shown
    let part = drawn(here, "file = \"b.atfi\"", "9x9");
    let wanted = decoded(&["b.atfi", "--scale", "1/4"]);
    assert_eq!(wanted.size, (17, 33));
    for (row, pixels) in part.chunks(3 * 9).enumerate() {
        assert!(pixels == &wanted.data[3 * ((row + 12) * 17 + 4)..][..3 * 9], "row {row}");
    }
    // colours of elevations
    let samples = good(here, &["sample", "scene.toml", "--points", "2"]);
    assert!(samples.starts_with("x,y,luma,orange,green\n0,0,"), "{samples}");
    let low = drawn(here, "file = \"d.atfi\"\nrange = [65534, 65535]\npalette = \"moss\"", "61x65");
    assert!(low.chunks(3).all(|pixel| *pixel == low[..3]));
    let spread = drawn(here, "file = \"d.atfi\"\nrange = [236, 1076]\npalette = \"moss\"", "61x65");
    assert!(spread.chunks(3).filter(|pixel| **pixel != spread[..3]).count() > 2000);
}

#[test]
fn an_image_that_cannot_be_is_refused_by_file_key_and_value() {
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    for (name, from) in [("a.atfi", STREAMING), ("b.atfi", ITERATED), ("c.atfi", COLOUR)] {
        fs::copy(from, here.join(name)).unwrap();
    }
    let bytes = fs::read(STREAMING).unwrap();
    fs::write(here.join("cut.atfi"), &bytes[..500]).unwrap();
    fs::write(here.join("more.atfi"), [&bytes[..], &[0]].concat()).unwrap();
    let mut damaged = bytes.clone();
    damaged[100] ^= 4;
    fs::write(here.join("damaged.atfi"), &damaged).unwrap();
    fs::write(here.join("text.png"), "no picture").unwrap();
    fs::write(here.join("empty.atfi"), "").unwrap();
    let mut tried = 0;
    for (keys, said) in [
        ("", "scene.toml: file: missing"),
        ("file = \"a.atfi\"\nstream = \"jacksboro\"", "scene.toml:2: file = \"a.atfi\": a stream is named"),
        ("stream = \"mona-lisa\"", "scene.toml:2: stream = \"mona-lisa\": built in are camera-streaming"),
        ("file = \"none.atfi\"", "scene.toml:2: file = \"none.atfi\": "),
        ("file = \"none.png\"", "scene.toml:2: file = \"none.png\": "),
        ("file = \"a.jpeg\"", "scene.toml:2: file = \"a.jpeg\": a picture is an .atfi file or a .png file"),
        ("file = \"text.png\"", "scene.toml:2: file = \"text.png\": "),
        ("file = \"empty.atfi\"", "scene.toml:2: file = \"empty.atfi\": this image ends"),
        ("file = \"cut.atfi\"", "scene.toml:2: file = \"cut.atfi\": this image ends"),
        ("file = \"more.atfi\"", "scene.toml:2: file = \"more.atfi\": "),
        ("file = \"damaged.atfi\"", "scene.toml:2: file = \"damaged.atfi\": this image is damaged"),
        ("file = 7", "scene.toml:2: "),
        ("file = \"a.atfi\"\nsweeps = 1", "scene.toml:3: sweeps = 1: this stream is decoded in one pass"),
        ("file = \"b.atfi\"\nsweeps = \"2\"", "scene.toml:3: sweeps are a whole number, 0 to 8"),
        ("file = \"b.atfi\"\nsweeps = 1.5", "or several that grow: [0, 1, 2, 3, 4]"),
        ("file = \"b.atfi\"\nsweeps = 9", "scene.toml:3: sweeps = 9: allowed is 0 to 8"),
        ("file = \"b.atfi\"\nsweeps = -1", "scene.toml:3: sweeps = -1: allowed is 0 to 8"),
        ("file = \"b.atfi\"\nsweeps = []", "scene.toml:3: sweeps = []: allowed is 0 to 8"),
        ("file = \"b.atfi\"\nsweeps = [1, 1]", "scene.toml:3: sweeps = [1, 1]: allowed is 0 to 8"),
        ("file = \"b.atfi\"\nsweeps = \"all\"", "scene.toml:3: "),
        ("file = \"b.atfi\"\nrange = [9, 9]", "scene.toml:3: range = [9, 9]: allowed is"),
        ("file = \"b.atfi\"\nrange = [0, 256]", "scene.toml:3: range = [0, 256]: allowed is"),
        (
            "file = \"c.atfi\"\npalette = \"moss\"",
            "scene.toml:3: palette = \"moss\": the picture has colours",
        ),
        ("file = \"b.atfi\"\nprofile = \"iterated\"", "scene.toml:3: "),
    ] {
        fs::write(here.join("scene.toml"), format!("kind = \"image\"\n{keys}\n")).unwrap();
        for command in ["dump", "export"] {
            let complaint = bad(here, &[command, "scene.toml"]);
            assert!(complaint.contains(said), "{keys}: {complaint}");
        }
        tried += 1;
    }
    assert_eq!(tried, 24);
    good(here, &["decode", "a.atfi", "-o", "still.png"]);
    fs::write(here.join("scene.toml"), "kind = \"image\"\nfile = \"still.png\"\nsweeps = 1\n").unwrap();
    assert!(bad(here, &["dump", "scene.toml"]).contains("sweeps = 1: a PNG file has none"));
    fs::write(here.join("scene.toml"), "kind = \"image\"\nfile = \"still.png\"\n").unwrap();
    assert!(bad(here, &["export", "scene.toml"]).contains("`attractor encode` makes a stream"));
    assert!(bad(here, &["dimension", "scene.toml"]).contains("an image is not measured"));
    // a file without an end is read for a moment only
    #[cfg(unix)]
    assert!(bad(here, &["decode", "/dev/zero", "-o", "zero.png"]).contains("longer than 67108864 bytes"));
}
