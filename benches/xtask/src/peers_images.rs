//! `cargo xtask peers-images IMAGE.png...`: the image codec beside libjpeg with optimised tables and WebP
//! -m6, and
//! what each part of it is worth. Peers: Debian's libjpeg-turbo-progs and webp; one that is not there is left
//! out.
//!
//! PSNR at 0.25, 0.5 and 1 bit a pixel, container included; the peers' quality is swept and their PSNR
//! interpolated over the logarithm of the bytes. MS-SSIM beside our own. What one pass in a window of 64 rows
//! costs: bytes of profile streaming at the PSNR that profile iterated, whose domains lie anywhere, has at
//! 0.25
//! bits. The attractor command must have been built: `cargo build --release -p attractor-sim`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Grey PNG files of 8 bits
    #[arg(value_name = "IMAGE.png", required = true)]
    images: Vec<PathBuf>,
    /// Also without domains, transform or division of squares, each alone; what the adaptive models are
    /// worth,
    /// `attractor inspect` says
    #[arg(long)]
    ablation: bool,
}

const RATES: [f64; 3] = [0.25, 0.5, 1.0];

/// A grey picture.
struct Grey {
    width: usize,
    height: usize,
    samples: Vec<u8>,
}

impl Grey {
    fn psnr(&self, other: &[u8]) -> f64 {
        let square: f64 =
            self.samples.iter().zip(other).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
        10.0 * (255.0_f64.powi(2) * self.samples.len() as f64 / square).log10()
    }

    fn pgm(&self) -> Vec<u8> {
        let head = format!("P5\n{} {}\n255\n", self.width, self.height);
        [head.as_bytes(), &self.samples].concat()
    }
}

pub(crate) fn run(options: &Options) -> Result<bool> {
    let attractor = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/release/attractor");
    if !attractor.exists() {
        bail!("build the command first: cargo build --release -p attractor-sim");
    }
    let scratch = std::env::temp_dir().join(format!("attractor-peers-{}", std::process::id()));
    fs::create_dir_all(&scratch)?;
    println!("PSNR at 0.25 / 0.5 / 1 bit a pixel");
    for image in &options.images {
        println!("{}", image.display());
        let grey = load(image)?;
        let mut lines: Vec<(&str, Vec<&str>)> = vec![
            ("iterated", vec!["--profile", "iterated"]),
            ("streaming", vec![]),
            ("streaming, fast", vec!["--effort", "fast"]),
            ("pure", vec!["--profile", "pure"]),
        ];
        if options.ablation {
            for part in ["domains", "transform", "split"] {
                lines.push((part, vec!["--without", part]));
            }
        }
        for (name, extra) in lines {
            let (mut row, mut alike) = (Vec::new(), Vec::new());
            for rate in RATES {
                let own = own(&attractor, image, &scratch, ["--bpp", &rate.to_string()], &extra);
                let own = own.unwrap_or(Own { bytes: f64::NAN, psnr: f64::NAN, alike: f64::NAN });
                row.push(own.psnr);
                alike.push(format!("{:.4}", own.alike));
            }
            let name =
                if extra.first() == Some(&"--without") { format!("without {name}") } else { name.to_owned() };
            print(&name, &row, &format!("   MS-SSIM {}", alike.join(" / ")));
        }
        let global = own(&attractor, image, &scratch, ["--bpp", "0.25"], &["--profile", "iterated"])?;
        let window = own(&attractor, image, &scratch, ["--psnr", &global.psnr.to_string()], &[])?;
        let more = 100.0 * (window.bytes / global.bytes - 1.0);
        println!("    a window of 64 rows    {more:+.1} % bytes at {:.2} dB", global.psnr);
        for (name, encode) in [("libjpeg, optimised", jpeg as Peer), ("WebP -m6", webp)] {
            match sweep(&grey, &scratch, encode) {
                Ok(row) => print(name, &row, ""),
                Err(error) => println!("    {name:22} skipped: {error:#}"),
            }
        }
    }
    fs::remove_dir_all(&scratch)?;
    Ok(true)
}

fn print(name: &str, row: &[f64], more: &str) {
    let row: Vec<String> = row.iter().map(|psnr| format!("{psnr:6.2}")).collect();
    println!("    {name:22} {}{more}", row.join(" / "));
}

/// What the command says of its own encoding.
struct Own {
    bytes: f64,
    psnr: f64,
    alike: f64,
}

/// Encodes to a target.
fn own(attractor: &Path, image: &Path, scratch: &Path, target: [&str; 2], extra: &[&str]) -> Result<Own> {
    let to = scratch.join("own.atfi");
    let output = Command::new(attractor)
        .arg("encode")
        .arg(image)
        .arg("-o")
        .arg(to)
        .args(target)
        .args(extra)
        .output()?;
    // out of reach is said on standard error
    if !output.stderr.is_empty() {
        bail!("{}", String::from_utf8_lossy(&output.stderr))
    }
    // FILE: N bytes, X bits a pixel, PSNR P dB, MS-SSIM M
    let text = String::from_utf8(output.stdout)?;
    let number = |text: Option<&str>| {
        let text =
            text.and_then(|rest| rest.split([' ', ',', '\n']).next()).context("a number is missing")?;
        Ok::<f64, anyhow::Error>(text.parse()?)
    };
    Ok(Own {
        bytes: number(text.rsplit(": ").next())?,
        psnr: number(text.split("PSNR ").nth(1))?,
        alike: number(text.split("MS-SSIM ").nth(1)).unwrap_or(f64::NAN),
    })
}

/// Bytes and decoded samples at a quality.
type Peer = fn(&Grey, &Path, u32) -> Result<(usize, Vec<u8>)>;

fn tool(command: &mut Command) -> Result<Vec<u8>> {
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
    Ok((fs::metadata(&to)?.len() as usize, decoded[decoded.len() - grey.samples.len()..].to_vec()))
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
    let rgb = &decoded[decoded.len() - 3 * grey.samples.len()..];
    Ok((fs::metadata(&to)?.len() as usize, rgb.chunks_exact(3).map(|p| p[1]).collect()))
}

fn sweep(grey: &Grey, scratch: &Path, encode: Peer) -> Result<Vec<f64>> {
    let mut points = Vec::new();
    for quality in (0..=100).step_by(2) {
        let (bytes, samples) = encode(grey, scratch, quality)?;
        points.push(((bytes as f64).ln(), grey.psnr(&samples)));
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |rate: f64| {
        let wanted = (rate * grey.samples.len() as f64 / 8.0).ln();
        let after = points.iter().position(|point| point.0 >= wanted)?;
        let (a, b) = (points[after.checked_sub(1)?], points[after]);
        Some(a.1 + (b.1 - a.1) * (wanted - a.0) / (b.0 - a.0).max(1e-12))
    };
    Ok(RATES.iter().map(|rate| at(*rate).unwrap_or(f64::NAN)).collect())
}

fn load(path: &Path) -> Result<Grey> {
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path)?)).read_info()?;
    let mut samples = vec![0; reader.output_buffer_size().context("too large")?];
    let info = reader.next_frame(&mut samples)?;
    if (info.color_type, info.bit_depth) != (png::ColorType::Grayscale, png::BitDepth::Eight) {
        bail!("{}: no grey PNG of 8 bits", path.display());
    }
    Ok(Grey { width: info.width as usize, height: info.height as usize, samples })
}
