//! Grey pictures of 8 bits, out of PNG or JPEG files, and how alike two of them are.

use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::peer::tool;
use crate::quality::{decibels, ms_ssim};

/// A picture.
#[derive(Debug)]
pub(crate) struct Grey {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) samples: Vec<u8>,
}

/// How alike two are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Likeness {
    pub(crate) psnr: f64,
    pub(crate) ms_ssim: f64,
}

impl Grey {
    /// Out of a file; colour becomes `(R + 2G + B) / 4`. None of 16 bits.
    pub(crate) fn load(path: &Path) -> Result<Option<Self>> {
        if path.extension().is_some_and(|extension| extension == "jpg") {
            let pgm = tool(Command::new("djpeg").args(["-grayscale", "-pnm"]).arg(path))?;
            return Self::of_pgm(&pgm).map(Some);
        }
        let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path)?));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info()?;
        let mut bytes = vec![0; reader.output_buffer_size().context("too large")?];
        let info = reader.next_frame(&mut bytes)?;
        if info.bit_depth == png::BitDepth::Sixteen {
            return Ok(None);
        }
        let samples = match info.color_type {
            png::ColorType::Grayscale => bytes,
            png::ColorType::Rgb => {
                let luma = |p: &[u8]| (u32::from(p[0]) + 2 * u32::from(p[1]) + u32::from(p[2]) + 2) >> 2;
                bytes.chunks_exact(3).map(|p| luma(p) as u8).collect()
            }
            other => bail!("{}: {other:?} is neither grey nor colour without alpha", path.display()),
        };
        Ok(Some(Self { width: info.width as usize, height: info.height as usize, samples }))
    }

    /// Out of what djpeg writes.
    fn of_pgm(pgm: &[u8]) -> Result<Self> {
        let mut fields = pgm.splitn(4, |byte| byte.is_ascii_whitespace());
        let mut number = || {
            let text = fields.next().and_then(|field| std::str::from_utf8(field).ok());
            text.context("no PGM file")
        };
        let (_, width, height) = (number()?, number()?.parse::<usize>()?, number()?.parse::<usize>()?);
        let start = pgm.len().checked_sub(width * height).context("a short PGM file")?;
        Ok(Self { width, height, samples: pgm[start..].to_vec() })
    }

    pub(crate) fn pgm(&self) -> Vec<u8> {
        let head = format!("P5\n{} {}\n255\n", self.width, self.height);
        [head.as_bytes(), &self.samples].concat()
    }

    pub(crate) fn write(&self, path: &Path) -> Result<()> {
        let mut encoder = png::Encoder::new(fs::File::create(path)?, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header()?.write_image_data(&self.samples)?;
        Ok(())
    }

    /// How alike samples of a picture of the same size are.
    pub(crate) fn likeness(&self, other: &[u8]) -> Likeness {
        let numbers = |samples: &[u8]| samples.iter().map(|v| f64::from(*v)).collect::<Vec<_>>();
        let (a, b) = (numbers(&self.samples), numbers(other));
        let error = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
        let psnr = decibels(error, a.len(), 255);
        let alike = ms_ssim(a, b, self.width as u32, 1, 255);
        Likeness { psnr, ms_ssim: alike.unwrap_or(f64::NAN) }
    }

    /// Half as large, each sample the mean of four; an odd last row or column is left out.
    pub(crate) fn halved(&self) -> Self {
        let (width, height) = (self.width / 2, self.height / 2);
        let at = |x: usize, y: usize| u32::from(self.samples[y * self.width + x]);
        let mean = |i: usize| {
            let (x, y) = (2 * (i % width), 2 * (i / width));
            ((at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1) + 2) / 4) as u8
        };
        Self { width, height, samples: (0..width * height).map(mean).collect() }
    }

    /// Its first columns and rows.
    pub(crate) fn part(&self, width: usize, height: usize) -> Self {
        let rows = self.samples.chunks_exact(self.width).take(height);
        Self { width, height, samples: rows.flat_map(|row| row[..width].to_vec()).collect() }
    }

    /// Twice as wide and high by the cubic of R. G. Keys, 1981, whose samples are those of an edge beyond it.
    pub(crate) fn cubic(&self) -> Self {
        let (width, height) = (self.width, self.height);
        // a quarter of a sample before and behind each
        let weights = [-9.0, 111.0, 29.0, -3.0].map(|weight| weight / 128.0);
        let along = |samples: &[f64], n: usize, step: usize, first: usize, k: usize| {
            let (centre, side) = (k as isize / 2, if k.is_multiple_of(2) { -1 } else { 1 });
            let at = |off: isize| (centre + side * off).clamp(0, n as isize - 1) as usize;
            let terms =
                weights.iter().zip(-1..).map(|(weight, off)| weight * samples[first + step * at(off)]);
            terms.sum::<f64>()
        };
        let samples: Vec<f64> = self.samples.iter().map(|sample| f64::from(*sample)).collect();
        let wide: Vec<f64> = (0..2 * width * height)
            .map(|i| along(&samples, width, 1, i / (2 * width) * width, i % (2 * width)))
            .collect();
        let high = (0..4 * width * height)
            .map(|i| along(&wide, height, 2 * width, i % (2 * width), i / (2 * width)));
        Self {
            width: 2 * width,
            height: 2 * height,
            samples: high.map(|v| (v + 0.5).clamp(0.0, 255.0) as u8).collect(),
        }
    }

    /// Each sample twice as wide and high.
    pub(crate) fn nearest(&self) -> Self {
        let (width, height) = (2 * self.width, 2 * self.height);
        let at = |i: usize| self.samples[i / width / 2 * self.width + i % width / 2];
        Self { width, height, samples: (0..width * height).map(at).collect() }
    }
}
