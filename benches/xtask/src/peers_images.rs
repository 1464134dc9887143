//! `cargo xtask peers-images IMAGE...`: the image codec beside libjpeg with optimised tables and WebP -m6;
//! what each of its parts is worth; how many sweeps it takes, and what twice the size is worth.
//!
//! PSNR and MS-SSIM at 0.25, 0.5 and 1 bit a pixel or at other rates, container included, of pictures made
//! grey. What one pass
//! in a window of 64 rows costs: bytes of profile streaming, interpolated between two rates, at the PSNR that
//! profile iterated, whose domains lie anywhere, has at 0.25 bits. A peer that is not installed is left out.
//! The attractor command must have been built: `benches/peers/images` does that, and fetches photographs.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use clap::Args;

use crate::grey::{Grey, Likeness};
use crate::peer::PEERS;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// PNG files, grey or colour, or JPEG files
    #[arg(value_name = "IMAGE", required = true)]
    images: Vec<PathBuf>,
    /// Instead: without domains, transform, division of squares or adaptive models, each alone
    #[arg(long)]
    ablation: bool,
    /// Instead: what each sweep brings, and twice the size against the nearest pixel
    #[arg(long)]
    decoding: bool,
    /// Bits a pixel
    #[arg(long, value_name = "X", default_values = ["0.25", "0.5", "1"])]
    rate: Vec<f64>,
}

/// The command, where it may write, and what it encodes.
struct Own<'a> {
    attractor: &'a Path,
    scratch: &'a Path,
    image: &'a Path,
}

/// What the command says of an encoding.
#[derive(Debug, Clone, Copy)]
struct Said {
    bytes: f64,
    like: Likeness,
}

pub(crate) fn run(options: &Options) -> Result<bool> {
    let attractor = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/release/attractor");
    if !attractor.exists() {
        bail!("build the command first: cargo build --release -p attractor-sim");
    }
    let scratch = std::env::temp_dir().join(format!("attractor-peers-{}", std::process::id()));
    fs::create_dir_all(&scratch)?;
    let tables = match options {
        Options { ablation: true, .. } => {
            "image | bits a pixel | all | without domains | without transform | \
            without split | maps alone | bytes that adaptive models save"
        }
        Options { decoding: true, .. } => {
            "image | sweeps 1 to 6 | twice the size | nearest pixel | cubic | not encoded: nearest pixel | cubic"
        }
        _ => {
            "image | bits a pixel | streaming | iterated | `--effort fast` | libjpeg, optimised | WebP -m6 | \
            streaming over libjpeg | bytes of the window"
        }
    };
    println!("| {tables} |");
    println!("|{}", " --- |".repeat(tables.split('|').count()));
    for image in &options.images {
        let name = image.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let grey = Grey::load(image).with_context(|| image.display().to_string())?;
        let own = scratch.join("in.png");
        match &grey {
            Some(grey) => grey.write(&own)?,
            None => fs::copy(image, &own).map(|_| ())?,
        }
        let own = Own { attractor: &attractor, scratch: &scratch, image: &own };
        match (&grey, options) {
            (_, Options { ablation: true, .. }) => ablation(&own, &name, &options.rate)?,
            (Some(grey), Options { decoding: true, .. }) => decoding(&own, &name, grey)?,
            (Some(grey), _) => peers(&own, &name, grey, &options.rate)?,
            (None, _) => println!("| {name} | 16 bits: no peer |"),
        }
    }
    fs::remove_dir_all(&scratch)?;
    Ok(true)
}

fn shown(like: Option<Likeness>) -> String {
    like.map_or_else(|| "-".to_owned(), |like| format!("{:.2} dB, {:.4}", like.psnr, like.ms_ssim))
}

fn peers(own: &Own<'_>, name: &str, grey: &Grey, rates: &[f64]) -> Result<()> {
    for &rate in rates {
        let target = ["--bpp", &rate.to_string()];
        let streaming = own.encode(target, &[])?;
        let iterated = own.encode(target, &["--profile", "iterated"])?;
        let fast = own.encode(target, &["--effort", "fast"])?;
        let bytes = rate * grey.samples.len() as f64 / 8.0;
        let mut likes = Vec::new();
        for peer in PEERS {
            likes.push(if peer.is_there() { peer.at(grey, own.scratch, bytes)? } else { None });
        }
        let over = match (streaming, likes[0]) {
            (Some(own), Some(peer)) => format!("{:+.2} dB", own.like.psnr - peer.psnr),
            _ => "-".to_owned(),
        };
        let window = match (streaming, iterated) {
            (Some(streaming), Some(iterated)) if rate < 0.3 => {
                let more = own.encode(["--bpp", &(1.06 * rate).to_string()], &[])?;
                more.map_or_else(|| "-".to_owned(), |more| window(streaming, more, iterated))
            }
            _ => String::new(),
        };
        let cells: Vec<String> = [streaming, iterated, fast]
            .into_iter()
            .map(|said| said.map(|said| said.like))
            .chain(likes)
            .map(shown)
            .collect();
        println!("| {name} | {rate} | {} | {over} | {window} |", cells.join(" | "));
    }
    Ok(())
}

/// By how many bytes one pass in a window has more at equal PSNR, of two of its encodings.
fn window(less: Said, more: Said, global: Said) -> String {
    let slope = (more.bytes / less.bytes).ln() / (more.like.psnr - less.like.psnr).max(1e-3);
    let bytes = less.bytes.ln() + slope * (global.like.psnr - less.like.psnr);
    format!("{:+.1} %", 100.0 * ((bytes - global.bytes.ln()).exp() - 1.0))
}

fn ablation(own: &Own<'_>, name: &str, rates: &[f64]) -> Result<()> {
    for &rate in rates {
        let target = ["--bpp", &rate.to_string()];
        let mut cells = Vec::new();
        let parts: [&[&str]; 5] = [
            &[],
            &["--without", "domains"],
            &["--without", "transform"],
            &["--without", "split"],
            &["--profile", "pure"],
        ];
        let mut saved = String::new();
        for part in parts {
            let said = own.encode(target, part)?;
            cells.push(shown(said.map(|said| said.like)));
            if part.is_empty() {
                saved = own.coder()?;
            }
        }
        println!("| {name} | {rate} | {} | {saved} |", cells.join(" | "));
    }
    Ok(())
}

fn decoding(own: &Own<'_>, name: &str, grey: &Grey) -> Result<()> {
    own.encode(["--bpp", "0.25"], &["--profile", "iterated"])?;
    let mut sweeps = Vec::new();
    for count in 1..=6 {
        let decoded = own.decode(&["--sweeps", &count.to_string()])?;
        sweeps.push(format!("{:.2}", grey.likeness(&decoded.samples).psnr));
    }
    let half = grey.halved();
    half.write(own.image)?;
    own.encode(["--bpp", "0.5"], &[])?;
    let (one, two) = (own.decode(&[])?, own.decode(&["--scale", "2"])?);
    let whole = grey.part(2 * half.width, 2 * half.height);
    let others = [two, one.nearest(), one.cubic(), half.nearest(), half.cubic()];
    let like = others.map(|other| format!("{:.2} dB", whole.likeness(&other.samples).psnr));
    println!("| {name} | {} | {} |", sweeps.join(" / "), like.join(" | "));
    Ok(())
}

impl Own<'_> {
    /// Encodes to a target; none where it is out of reach.
    fn encode(&self, target: [&str; 2], extra: &[&str]) -> Result<Option<Said>> {
        let output = Command::new(self.attractor)
            .arg("encode")
            .arg(self.image)
            .arg("-o")
            .arg(self.scratch.join("own.atfi"))
            .args(target)
            .args(extra)
            .output()?;
        // out of reach is said on standard error
        if !output.status.success() {
            bail!("{}", String::from_utf8_lossy(&output.stderr))
        }
        if !output.stderr.is_empty() {
            return Ok(None);
        }
        // FILE: N bytes, X bits a pixel, PSNR P dB, MS-SSIM M
        let text = String::from_utf8(output.stdout)?;
        let like = Likeness {
            psnr: number(text.split("PSNR ").nth(1))?,
            ms_ssim: number(text.split("MS-SSIM ").nth(1)).unwrap_or(f64::NAN),
        };
        Ok(Some(Said { bytes: number(text.rsplit(": ").next())?, like }))
    }

    /// What is left of the payload by the models' learning.
    fn coder(&self) -> Result<String> {
        let output =
            Command::new(self.attractor).arg("inspect").arg(self.scratch.join("own.atfi")).output()?;
        // without adaptive models: N bytes of payload instead of M
        let text = String::from_utf8(output.stdout)?;
        let without: f64 = number(text.split("without adaptive models: ").nth(1))?;
        let with: f64 = number(text.split("of payload instead of ").nth(1))?;
        Ok(format!("{:.0} %", 100.0 * (1.0 - with / without)))
    }

    fn decode(&self, extra: &[&str]) -> Result<Grey> {
        let (from, to) = (self.scratch.join("own.atfi"), self.scratch.join("own.png"));
        let output =
            Command::new(self.attractor).arg("decode").arg(from).arg("-o").arg(&to).args(extra).output()?;
        if !output.status.success() {
            bail!("{}", String::from_utf8_lossy(&output.stderr))
        }
        Grey::load(&to)?.context("16 bits")
    }
}

/// The number that a text begins with.
fn number(text: Option<&str>) -> Result<f64> {
    let text = text.and_then(|rest| rest.split([' ', ',', '\n']).next()).context("a number is missing")?;
    Ok(text.parse()?)
}
