//! Pictures that a world's file names: PNG files as texels in the order in which core looks at them.

use std::io::BufReader;

use attractor::Error;
use attractor::trace::texture::{Image, Texels};
use png::{ColorType, Decoder, Transformations};
use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

/// A picture with its coarser levels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    pub(crate) size: (u32, u32),
    pub(crate) bytes: Vec<u8>,
}

impl Picture {
    /// The picture in a file, relative to the scene.
    pub(super) fn load(source: &Source, file: &Spanned<String>, key: &str) -> Result<Self, Fail> {
        let refused = |reason: String| source.fail(file.span(), key, reason);
        let path =
            source.beside(file.get_ref()).ok_or_else(|| refused("no such picture is built in".to_owned()))?;
        let reader = std::fs::File::open(&path).map_err(|error| refused(error.to_string()))?;
        let mut decoder = Decoder::new(BufReader::new(reader));
        decoder.set_transformations(Transformations::normalize_to_color8());
        let none =
            |error: png::DecodingError| refused(format!("it is no PNG file that can be read: {error}"));
        let mut png = decoder.read_info().map_err(none)?;
        let (columns, rows) = png.info().size();
        // the kernel says how large an image may be: before there is memory for it
        if let Err(error @ Error::OutOfRange { .. }) = Image::new(Texels::Rgb888, columns, rows, &[]) {
            return Err(refused(error.to_string()));
        }
        let mut samples = vec![0; png.output_buffer_size().unwrap_or(0)];
        let info = png.next_frame(&mut samples).map_err(none)?;
        samples.truncate(info.buffer_size());
        let pixel = |samples: &[u8]| match (info.color_type, samples) {
            (ColorType::Grayscale | ColorType::GrayscaleAlpha, [grey, ..]) => [*grey; 3],
            (_, [r, g, b, ..]) => [*r, *g, *b],
            _ => [0; 3],
        };
        let mut bytes: Vec<u8> = samples.chunks(info.color_type.samples()).flat_map(pixel).collect();
        let levels = Image::levels_of(columns, rows);
        bytes.resize(Image::length(Texels::Rgb888, columns, rows, levels), 0);
        Image::write_levels(Texels::Rgb888, columns, rows, &mut bytes)
            .map_err(|error| refused(error.to_string()))?;
        Ok(Self { size: (columns, rows), bytes })
    }

    /// As core has it.
    pub(crate) fn image(&self) -> Result<Image<'_>, Error> {
        Image::new(Texels::Rgb888, self.size.0, self.size.1, &self.bytes)
    }
}
