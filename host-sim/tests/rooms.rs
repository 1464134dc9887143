//! The pictures of core's rooms, which its documentation shows: drawn by the command, kept in `core/docs` as
//! files for the README, and as text for rustdoc, which keeps no files.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::common::{decode, good};

/// Room, scene, colour and size, and what to say to those who cannot see it.
const ROOMS: [(&str, &str, &str, &str, &str); 9] = [
    (NUM, "num.toml", "rgb565", "160x128", "a spiral of squares on the left, with all its arms on the right"),
    ("fif", "sunspots", "mono", "160x120", "309 years of sunspots, interpolated"),
    ("ifs", "fern", "rgb565", "128x128", "Barnsley's fern"),
    ("curve", "cesaro-square", "mono", "160x160", "Cesaro's curve inside a square"),
    ("escape", "mandelbrot", "rgb565", "160x128", "the Mandelbrot set"),
    ("terrain", "mountain-ferguson", "gray4", "160x128", "a mountain of 1,024 patches over a plain"),
    (
        "patch",
        "patch-rock",
        "gray4",
        "160x120",
        "a surface by nine control points with sharp edges, as rock has them",
    ),
    ("trace", "figure-6-gg", "gray4", "160x160", "a fractal surface as a mirror, under a chequered sky"),
    ("draw", "julia", "mono", "160x120", "a filled-in Julia set in dithered greys"),
];

/// `num` is drawn twice: on the left on the grid of `Real`, each of whose points is a square of 8 x 8 pixels.
const NUM: &str = "num";
const NUMBERS: &str = "kind = \"mandelbrot\"
centre = [\"-0.7756837308406829833984375\", \"0.1364674270153045654296875\"]
width = \"0.0000011920928955078125\"
max_dwell = 600
palette = \"fire\"
cycle = 60
";

/// The file in which a room's picture is drawn.
fn draw(directory: &Path, scene: &str, color: &str, size: &str, scale: &str) -> PathBuf {
    let options = ["--size", size, "--color", color, "--scale", scale];
    directory.join(good(directory, &[&["dump", scene], &options[..]].concat()).trim())
}

/// Two drawings of the same size and colour, the left half of one and the right half of the other.
fn halves(directory: &Path) -> PathBuf {
    let scene = directory.join("num.toml");
    fs::write(&scene, NUMBERS).unwrap();
    let draw = |size: &str, scale: &str| decode(&draw(directory, "num.toml", "rgb565", size, scale));
    let [coarse, mut fine] = [draw("20x16", "8"), draw("160x128", "1")];
    assert_eq!((coarse.size, coarse.color), (fine.size, png::ColorType::Rgb));
    let (width, height) = fine.size;
    let a_row = 3 * width as usize;
    for (fine, coarse) in fine.data.chunks_exact_mut(a_row).zip(coarse.data.chunks_exact(a_row)) {
        fine[..a_row / 2].copy_from_slice(&coarse[..a_row / 2]);
    }
    let joined = directory.join("joined.png");
    let mut encoder = png::Encoder::new(fs::File::create(&joined).unwrap(), width, height);
    encoder.set_color(fine.color);
    encoder.set_compression(png::Compression::High);
    encoder.write_header().unwrap().write_image_data(&fine.data).unwrap();
    joined
}

/// Changed on purpose? `ATTRACTOR_BLESS=1 cargo test -p attractor-sim --test suite rooms`, and look at
/// `core/docs`.
#[test]
fn the_documentation_shows_what_the_command_draws() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/docs");
    for (room, scene, color, size, says) in ROOMS {
        let directory = tempfile::tempdir().unwrap();
        let drawn = match room {
            NUM => halves(directory.path()),
            _ => draw(directory.path(), scene, color, size, "1"),
        };
        let (kept, text) = (docs.join(format!("{room}.png")), docs.join(format!("{room}.md")));
        if std::env::var_os("ATTRACTOR_BLESS").is_some() {
            fs::copy(&drawn, &kept).unwrap();
            let bytes = STANDARD.encode(fs::read(&kept).unwrap());
            fs::write(&text, format!("![{says}](data:image/png;base64,{bytes})\n")).unwrap();
        }
        let (drawn, shown) = (decode(&drawn), decode(&kept));
        assert!(drawn.size == shown.size && drawn.data == shown.data, "{room}.png is not what {scene} draws");
        // a page loads as fast as one without a picture
        let bytes = fs::read(&kept).unwrap();
        assert!(bytes.len() < 12_000, "{room}.png takes {} bytes", bytes.len());
        let embedded = format!("![{says}](data:image/png;base64,{})\n", STANDARD.encode(bytes));
        assert_eq!(fs::read_to_string(text).unwrap(), embedded, "{room}.md does not hold {room}.png");
    }
}
