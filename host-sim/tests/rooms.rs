//! The pictures of core's rooms, which its documentation shows: drawn by the command, kept in `core/docs` as files for the
//! README, and as text for rustdoc, which keeps no files.

use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::common::{decode, good};

/// Room, scene, colour and size, and what to say to those who cannot see it.
const ROOMS: [(&str, &str, &str, &str, &str); 6] = [
    ("fif", "sunspots", "mono", "160x120", "309 years of sunspots, interpolated"),
    ("ifs", "fern", "rgb565", "128x128", "Barnsley's fern"),
    ("curve", "cesaro-square", "mono", "160x160", "Cesaro's curve inside a square"),
    ("escape", "mandelbrot", "rgb565", "160x128", "the Mandelbrot set"),
    ("trace", "figure-6-gg", "gray4", "160x160", "a fractal surface as a mirror, under a chequered sky"),
    ("draw", "julia", "mono", "160x120", "a filled-in Julia set in dithered greys"),
];

/// Changed on purpose? `ATTRACTOR_BLESS=1 cargo test -p attractor-sim --test suite rooms`, and look at `core/docs`.
#[test]
fn the_documentation_shows_what_the_command_draws() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/docs");
    for (room, scene, color, size, says) in ROOMS {
        let directory = tempfile::tempdir().unwrap();
        let printed = good(directory.path(), &["dump", scene, "--size", size, "--color", color]);
        let drawn = directory.path().join(printed.trim());
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
