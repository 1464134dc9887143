//! Other codecs by their commands, at a rate: libjpeg with optimised tables, and WebP -m6 (Debian's
//! libjpeg-turbo-progs and webp).
//!
//! The two neighbouring qualities between whose bytes a rate lies are looked for by halving; what is measured
//! at them is interpolated over the logarithm of the bytes.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::grey::{Grey, Likeness};

/// Bytes and decoded samples of a quality.
type Encode = fn(&Grey, &Path, u32) -> Result<(usize, Vec<u8>)>;

/// A codec.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Peer {
    /// Its command, which may not be there.
    tool: &'static str,
    encode: Encode,
}

pub(crate) const PEERS: [Peer; 2] =
    [Peer { tool: "cjpeg", encode: jpeg }, Peer { tool: "cwebp", encode: webp }];

impl Peer {
    pub(crate) fn is_there(self) -> bool {
        which::which(self.tool).is_ok()
    }

    /// At so many bytes; none where the coarsest quality takes more, or the finest less.
    pub(crate) fn at(self, grey: &Grey, scratch: &Path, bytes: f64) -> Result<Option<Likeness>> {
        let (mut below, mut above) = (0, 100);
        let size = |quality| Ok::<_, anyhow::Error>((self.encode)(grey, scratch, quality)?.0 as f64);
        if size(below)? > bytes || size(above)? < bytes {
            return Ok(None);
        }
        while above - below > 1 {
            let middle = u32::midpoint(below, above);
            *(if size(middle)? > bytes { &mut above } else { &mut below }) = middle;
        }
        let measure = |quality| {
            let (bytes, samples) = (self.encode)(grey, scratch, quality)?;
            Ok::<_, anyhow::Error>(((bytes as f64).ln(), grey.likeness(&samples)))
        };
        let ((a, coarse), (b, fine)) = (measure(below)?, measure(above)?);
        let share = (bytes.ln() - a) / (b - a).max(1e-12);
        let between = |a: f64, b: f64| a + share * (b - a);
        Ok(Some(Likeness {
            psnr: between(coarse.psnr, fine.psnr),
            ms_ssim: between(coarse.ms_ssim, fine.ms_ssim),
        }))
    }
}

/// What a command writes to its standard output.
pub(crate) fn tool(command: &mut Command) -> Result<Vec<u8>> {
    let output = command.output().with_context(|| format!("{:?} is not there", command.get_program()))?;
    if !output.status.success() {
        bail!("{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(output.stdout)
}

fn jpeg(grey: &Grey, scratch: &Path, quality: u32) -> Result<(usize, Vec<u8>)> {
    let (from, to) = (scratch.join("in.pgm"), scratch.join("out.jpg"));
    fs::write(&from, grey.pgm())?;
    tool(
        Command::new("cjpeg")
            .args(["-optimize", "-grayscale", "-quality", &quality.to_string(), "-outfile"])
            .arg(&to)
            .arg(&from),
    )?;
    let decoded = tool(Command::new("djpeg").args(["-grayscale", "-pnm"]).arg(&to))?;
    let start = decoded.len().checked_sub(grey.samples.len()).context("djpeg wrote too little")?;
    Ok((fs::metadata(&to)?.len() as usize, decoded[start..].to_vec()))
}

fn webp(grey: &Grey, scratch: &Path, quality: u32) -> Result<(usize, Vec<u8>)> {
    let (from, to, back) = (scratch.join("in.pgm"), scratch.join("out.webp"), scratch.join("out.ppm"));
    fs::write(&from, grey.pgm())?;
    tool(
        Command::new("cwebp")
            .args(["-quiet", "-m", "6", "-q", &quality.to_string()])
            .arg(&from)
            .arg("-o")
            .arg(&to),
    )?;
    tool(Command::new("dwebp").arg("-quiet").arg(&to).args(["-ppm", "-o"]).arg(&back))?;
    let decoded = fs::read(&back)?;
    let start = decoded.len().checked_sub(3 * grey.samples.len()).context("dwebp wrote too little")?;
    Ok((fs::metadata(&to)?.len() as usize, decoded[start..].chunks_exact(3).map(|p| p[1]).collect()))
}
