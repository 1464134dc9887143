//! The lines that the images print.

use anyhow::{Context, Result, bail};
use serde::Deserialize;

/// One line.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "line", rename_all = "lowercase")]
pub(crate) enum Line {
    Scene(SceneLine),
    Kernel(KernelLine),
    Failure {
        name: String,
        size: String,
        why: String,
    },
    /// The scene that is too large for the machine: bytes that it needs and has, none where it was drawn all
    /// the same.
    Refusal {
        needed: u64,
        free: u64,
    },
    End,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct SceneLine {
    pub(crate) name: String,
    pub(crate) size: String,
    pub(crate) crc32: String,
    pub(crate) pixels: u64,
    pub(crate) counted: bool,
    pub(crate) instructions: u64,
    pub(crate) stack_bytes: u64,
    pub(crate) ram_bytes: u64,
}

#[derive(Debug, Clone, Deserialize)]
pub(crate) struct KernelLine {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) counted: bool,
    pub(crate) fixed: Count,
    pub(crate) f32: Option<Count>,
    pub(crate) f64: Option<Count>,
}

/// What one loop did.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Count {
    pub(crate) checksum: String,
    pub(crate) units: u32,
    pub(crate) instructions: u32,
}

impl Count {
    /// Instructions a unit, to two digits: what is printed is what is compared.
    pub(crate) fn per_unit(&self) -> f64 {
        (f64::from(self.instructions) / f64::from(self.units.max(1)) * 100.0).round() / 100.0
    }
}

/// The lines of an image's output. Output that does not end with the line `end` is an error: the image
/// stopped half-way.
pub(crate) fn parse(output: &str) -> Result<Vec<Line>> {
    let mut lines = Vec::new();
    for text in output.lines() {
        match serde_json::from_str(text).with_context(|| format!("the image printed {text:?}"))? {
            Line::End => return Ok(lines),
            line => lines.push(line),
        }
    }
    bail!("the image ended early, after {} lines", lines.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn output_without_its_last_line_is_refused() {
        let line = r#"{"line":"failure","name":"a","size":"1x1","why":"b"}"#;
        assert!(parse(line).is_err());
        assert!(parse("{}\n{\"line\":\"end\"}").is_err());
        assert_eq!(parse(&format!("{line}\n{{\"line\":\"end\"}}\n")).unwrap().len(), 1);
    }
}
