//! Draws the scenes of a table and prints a line of JSON for each.
//!
//! Arguments: `NAME SIZE` draws this scene alone (its spaces as `+`). The argument `frames` streams the
//! pixels of each scene to a file `NAME-WIDTHxHEIGHT.raw`.

use core::fmt::Write;

use semihosting::fs::File;
use semihosting::println;

use crate::workload::scenes::Scene;
use crate::{Board, arguments, names};

/// The most scenes of a table.
const MOST: usize = 256;

/// Draws those that the image's arguments ask for.
pub fn show(board: &mut Board, table: &[Scene]) {
    let mut stream = false;
    let mut alone = [true; MOST];
    arguments(|i, argument| match i {
        0 => {}
        1 if argument == "frames" => stream = true,
        _ => {
            for (chosen, scene) in alone.iter_mut().zip(table) {
                *chosen &= match i {
                    1 => names(argument, scene.name),
                    _ => size(argument) == Some((scene.size.width, scene.size.height)),
                };
            }
        }
    });
    for scene in table.iter().zip(alone).filter_map(|(scene, chosen)| chosen.then_some(scene)) {
        let (width, height) = (scene.size.width, scene.size.height);
        if stream {
            board.stream(open(scene.name, width, height), scene.bits);
        }
        let counts = board.counts();
        match scene.run(board) {
            Ok(outcome) => println!(
                "{{\"line\":\"scene\",\"name\":\"{}\",\"size\":\"{width}x{height}\",\"crc32\":\"{:08x}\",\"pixels\":{},\"counted\":{counts},\
                 \"instructions\":{},\"stack_bytes\":{},\"ram_bytes\":{}}}",
                scene.name,
                outcome.crc32,
                outcome.pixels,
                outcome.instructions,
                outcome.stack_bytes,
                outcome.ram_bytes,
            ),
            Err(failure) => println!(
                "{{\"line\":\"failure\",\"name\":\"{}\",\"size\":\"{width}x{height}\",\"why\":\"{failure}\"}}",
                scene.name
            ),
        }
        board.stream(None, 0);
    }
}

/// Width and height of `WIDTHxHEIGHT`.
fn size(argument: &str) -> Option<(u32, u32)> {
    let (width, height) = argument.split_once('x')?;
    Some((width.parse().ok()?, height.parse().ok()?))
}

/// The file of a scene's frame.
fn open(name: &str, width: u32, height: u32) -> Option<File> {
    let mut path = Path { bytes: [0; 64], len: 0 };
    write!(path, "{name}-{width}x{height}.raw").ok()?;
    let path = core::ffi::CStr::from_bytes_until_nul(&path.bytes).ok()?;
    File::create(path).ok()
}

struct Path {
    bytes: [u8; 64],
    len: usize,
}

impl core::fmt::Write for Path {
    fn write_str(&mut self, s: &str) -> core::fmt::Result {
        for byte in s.bytes() {
            // the last byte stays 0
            if self.len + 1 >= self.bytes.len() {
                return Err(core::fmt::Error);
            }
            self.bytes[self.len] = if byte == b' ' { b'-' } else { byte };
            self.len += 1;
        }
        Ok(())
    }
}
