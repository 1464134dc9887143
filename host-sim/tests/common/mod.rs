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

/// What the command says of bad input, case by case: a text that stands in `snapshots/`.
#[derive(Default)]
pub(crate) struct Said(String);

impl std::fmt::Display for Said {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl Said {
    /// Of a scene file that is good but for one thing.
    pub(crate) fn change(&mut self, good: &str, from: &str, to: &str) {
        assert!(good.contains(from), "{from}");
        let kind = good.split('"').nth(1).unwrap_or("");
        let shown = |text: &str| text.replace('\n', "\\n");
        let complaint = complaint(good.replacen(from, to, 1).as_bytes());
        self.case(&format!("{kind}: {} -> {}", shown(from), shown(to)), &complaint);
    }

    /// Of a scene file.
    pub(crate) fn scene(&mut self, scene: &[u8]) {
        self.case(&quoted(scene), &complaint(scene));
    }

    /// Of a command.
    pub(crate) fn command(&mut self, directory: &Path, args: &[&str]) {
        self.case(&format!("$ attractor {}", args.join(" ")), &bad(directory, args));
    }

    /// Of anything; nothing where it does not complain.
    pub(crate) fn case(&mut self, what: &str, complaint: &str) {
        for line in [what, "\n"].into_iter().chain(complaint.lines().flat_map(|line| ["    ", line, "\n"])) {
            self.0.push_str(line);
        }
    }
}

/// A text on one line, of a long one the beginning.
fn quoted(text: &[u8]) -> String {
    let shown: String = text.iter().take(200).flat_map(|byte| byte.escape_ascii()).map(char::from).collect();
    let shown = shown.replace("\\\"", "\"");
    if text.len() > 200 { format!("{}... {} bytes", &shown[..80], text.len()) } else { shown }
}

/// What the command says of a scene file that it neither draws nor samples.
fn complaint(scene: &[u8]) -> String {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("scene.toml"), scene).expect("it can be written");
    let [drawn, sampled] = [
        &["dump", "scene.toml", "-o", "out.png", "--size", "16x16"][..],
        &["sample", "scene.toml", "--size", "4x4"],
    ]
    .map(|command| bad(directory.path(), command));
    for complaint in [&drawn, &sampled] {
        assert!(complaint.starts_with("attractor: scene.toml"), "{complaint}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).expect("it is there").count(), 1, "something was written");
    if drawn == sampled { drawn } else { drawn + &sampled }
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
