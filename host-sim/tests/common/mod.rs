//! Runs the command, decodes what it wrote.
#![allow(dead_code, reason = "each test file uses its part")]

use std::path::Path;
use std::process::{Command, Output};

/// Runs `attractor` with these arguments in this directory.
pub(crate) fn attractor_in(directory: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_attractor"))
        .args(args)
        .current_dir(directory)
        .output()
        .expect("the command can be started")
}

/// Its standard output, when it succeeds and has nothing to complain about.
pub(crate) fn good(directory: &Path, args: &[&str]) -> String {
    let output = attractor_in(directory, args);
    assert_eq!(text(&output.stderr), "", "{args:?}");
    assert_eq!(output.status.code(), Some(0), "{args:?}");
    text(&output.stdout)
}

/// Its complaint: one line on standard error, exit code 2, nothing on standard output.
pub(crate) fn bad(directory: &Path, args: &[&str]) -> String {
    let output = attractor_in(directory, args);
    let complaint = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {complaint}");
    assert_eq!(text(&output.stdout), "", "{args:?}");
    assert!(complaint.ends_with('\n') && complaint.lines().count() == 1, "{args:?}: {complaint}");
    complaint
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("text")
}

/// A decoded file: width, height, colour type, bits a sample, rows of packed samples.
pub(crate) struct Png {
    pub(crate) size: (u32, u32),
    pub(crate) color: png::ColorType,
    pub(crate) depth: png::BitDepth,
    pub(crate) data: Vec<u8>,
}

pub(crate) fn decode(path: &Path) -> Png {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("the file is there"));
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().expect("a PNG file");
    let mut data = vec![0; reader.output_buffer_size().expect("it fits")];
    let info = reader.next_frame(&mut data).expect("a whole picture");
    data.truncate(info.buffer_size());
    Png { size: (info.width, info.height), color: info.color_type, depth: info.bit_depth, data }
}
