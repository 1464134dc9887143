//! A picture out of a PNG file, as the planes that are encoded.
//!
//! Colour becomes `Y = (R + 2G + B)/4`, `Co = (R - B)/2 + 128`, `Cg = (2G - R - B)/4 + 128`, rounded; chroma
//! is
//! halved by the mean of four. What is transparent is laid on a ground.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use attractor::codec::Planes;
use attractor::plane::checked_size;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use png::{BitDepth, ColorType, Decoder, Transformations};

use crate::fail::Fail;

/// Samples of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Still {
    pub(crate) size: Size,
    pub(crate) pixels: Pixels,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Pixels {
    Grey(Vec<u8>),
    Deep(Vec<u16>),
    Colour(Vec<[u8; 3]>),
}

impl Still {
    /// Reads a PNG file; `ground` is what transparent pixels are laid on.
    pub(crate) fn load(path: &Path, ground: Rgb888) -> Result<Self, Fail> {
        let refused = |reason: String| Fail::new(format_args!("{}: {reason}", path.display()));
        let file = File::open(path).map_err(|error| refused(error.to_string()))?;
        let mut decoder = Decoder::new(BufReader::new(file));
        decoder.set_transformations(Transformations::EXPAND);
        let none =
            |error: png::DecodingError| refused(format!("it is no PNG file that can be read: {error}"));
        let mut png = decoder.read_info().map_err(none)?;
        if png.info().is_animated() {
            return Err(refused("an animated PNG; only a single picture is encoded".to_owned()));
        }
        let (width, height) = png.info().size();
        let size = checked_size(Size::new(width, height)).map_err(|error| refused(error.to_string()))?;
        let mut bytes = vec![0; png.output_buffer_size().unwrap_or(0)];
        let info = png.next_frame(&mut bytes).map_err(none)?;
        bytes.truncate(info.buffer_size());
        let over = |sample: u8, alpha: u8, ground: u8| {
            let [sample, alpha, ground] = [sample, alpha, ground].map(u32::from);
            ((sample * alpha + ground * (255 - alpha) + 127) / 255) as u8
        };
        let pixels = match (info.color_type, info.bit_depth) {
            (ColorType::Grayscale, BitDepth::Sixteen) => {
                Pixels::Deep(bytes.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect())
            }
            (_, BitDepth::Sixteen) => {
                return Err(refused(
                    "16 bits a sample; only grey without transparency has so many".to_owned(),
                ));
            }
            (ColorType::Grayscale, _) => Pixels::Grey(bytes),
            (kind, _) => {
                let samples = kind.samples();
                let laid = |p: &[u8]| match p {
                    [grey, alpha] => [ground.r(), ground.g(), ground.b()].map(|g| over(*grey, *alpha, g)),
                    [r, g, b, alpha] => [
                        over(*r, *alpha, ground.r()),
                        over(*g, *alpha, ground.g()),
                        over(*b, *alpha, ground.b()),
                    ],
                    [r, g, b] => [*r, *g, *b],
                    _ => [0; 3],
                };
                Pixels::Colour(bytes.chunks_exact(samples).map(laid).collect())
            }
        };
        Ok(Self { size, pixels }.without_needless_colour())
    }

    fn without_needless_colour(self) -> Self {
        match self.pixels {
            Pixels::Colour(pixels) if pixels.iter().all(|[r, g, b]| r == g && g == b) => {
                Self { size: self.size, pixels: Pixels::Grey(pixels.iter().map(|[r, ..]| *r).collect()) }
            }
            _ => self,
        }
    }

    /// The planes that are encoded, row after row.
    pub(crate) fn planes(&self, halved: bool) -> (Planes, Vec<Vec<u16>>) {
        match &self.pixels {
            Pixels::Grey(pixels) => (Planes::Grey, vec![pixels.iter().map(|p| u16::from(*p)).collect()]),
            Pixels::Deep(pixels) => (Planes::Grey, vec![pixels.clone()]),
            Pixels::Colour(pixels) => {
                let plane = |f: fn([i32; 3]) -> i32| -> Vec<u16> {
                    pixels.iter().map(|p| f(p.map(i32::from)).clamp(0, 255) as u16).collect()
                };
                let luma = plane(|[r, g, b]| (r + 2 * g + b + 2) >> 2);
                let orange = plane(|[r, _, b]| ((r - b + 1) >> 1) + 128);
                let green = plane(|[r, g, b]| ((2 * g - r - b + 2) >> 2) + 128);
                if halved {
                    let small = |plane: &[u16]| self.halved(plane);
                    (Planes::ColourHalved, vec![luma, small(&orange), small(&green)])
                } else {
                    (Planes::Colour, vec![luma, orange, green])
                }
            }
        }
    }

    fn halved(&self, plane: &[u16]) -> Vec<u16> {
        let (width, height) = (self.size.width as usize, self.size.height as usize);
        let at = |x: usize, y: usize| u32::from(plane[y.min(height - 1) * width + x.min(width - 1)]);
        let places = (0..height).step_by(2).flat_map(|y| (0..width).step_by(2).map(move |x| (x, y)));
        places
            .map(|(x, y)| ((at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1) + 2) / 4) as u16)
            .collect()
    }

    /// The largest sample.
    pub(crate) const fn peak(&self) -> u32 {
        if matches!(self.pixels, Pixels::Deep(_)) { 65535 } else { 255 }
    }

    /// How many samples there are, of all channels.
    pub(crate) const fn count(&self) -> usize {
        match &self.pixels {
            Pixels::Grey(pixels) => pixels.len(),
            Pixels::Deep(pixels) => pixels.len(),
            Pixels::Colour(pixels) => 3 * pixels.len(),
        }
    }

    /// The squared differences of all samples from those of a picture of the same kind.
    pub(crate) fn error(&self, other: &Self) -> f64 {
        let square = |a: u32, b: u32| u64::from(a.abs_diff(b)).pow(2);
        let small = |a: &[u8], b: &[u8]| -> u64 {
            a.iter().zip(b).map(|(a, b)| square((*a).into(), (*b).into())).sum()
        };
        let sum = match (&self.pixels, &other.pixels) {
            (Pixels::Grey(a), Pixels::Grey(b)) => small(a, b),
            (Pixels::Colour(a), Pixels::Colour(b)) => small(a.as_flattened(), b.as_flattened()),
            (Pixels::Deep(a), Pixels::Deep(b)) => {
                a.iter().zip(b).map(|(a, b)| square((*a).into(), (*b).into())).sum()
            }
            _ => return f64::INFINITY,
        };
        sum as f64
    }

    /// All samples of all channels, one after the other.
    pub(crate) fn samples(&self) -> Vec<f64> {
        match &self.pixels {
            Pixels::Grey(pixels) => pixels.iter().map(|p| f64::from(*p)).collect(),
            Pixels::Deep(pixels) => pixels.iter().map(|p| f64::from(*p)).collect(),
            Pixels::Colour(pixels) => pixels.iter().flatten().map(|p| f64::from(*p)).collect(),
        }
    }

    /// As a PNG file.
    pub(crate) fn png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.width, self.size.height);
        let (color, depth, data) = match &self.pixels {
            Pixels::Grey(pixels) => (ColorType::Grayscale, BitDepth::Eight, pixels.clone()),
            Pixels::Deep(pixels) => (
                ColorType::Grayscale,
                BitDepth::Sixteen,
                pixels.iter().flat_map(|p| p.to_be_bytes()).collect(),
            ),
            Pixels::Colour(pixels) => (ColorType::Rgb, BitDepth::Eight, pixels.as_flattened().to_vec()),
        };
        encoder.set_color(color);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&data)?;
        writer.finish()?;
        Ok(bytes)
    }
}
