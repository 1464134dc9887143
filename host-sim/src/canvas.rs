//! A simulated display as a PNG file: its own pixels, at its own depth, each as a square of `scale` pixels.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;

use crate::color::Depth;

/// The bytes of a PNG file: colour with 8 bits a channel, greys with as many bits as the display has.
pub(crate) fn png<C: Depth>(
    display: &SimulatorDisplay<C>,
    scale: u32,
) -> Result<Vec<u8>, png::EncodingError> {
    let size = display.size();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size.width * scale, size.height * scale);
    encoder.set_color(if C::GREY_BITS.is_some() { png::ColorType::Grayscale } else { png::ColorType::Rgb });
    encoder.set_depth(match C::GREY_BITS {
        Some(1) => png::BitDepth::One,
        Some(2) => png::BitDepth::Two,
        Some(4) => png::BitDepth::Four,
        _ => png::BitDepth::Eight,
    });
    let mut writer = encoder.write_header()?;
    let mut image = Vec::new();
    for y in 0..size.height as i32 {
        let colors = (0..size.width as i32).map(|x| -> Rgb888 { display.get_pixel(Point::new(x, y)).into() });
        let colors = colors.flat_map(|color| (0..scale).map(move |_| color));
        let row: Vec<u8> = match C::GREY_BITS {
            Some(bits) => packed(colors.map(|grey| grey.r() >> (8 - bits)), bits),
            None => colors.flat_map(|color| [color.r(), color.g(), color.b()]).collect(),
        };
        (0..scale).for_each(|_| image.extend_from_slice(&row));
    }
    writer.write_image_data(&image)?;
    writer.finish()?;
    Ok(bytes)
}

/// Samples of `bits` bits, the leftmost highest; the last byte is filled up with zeros.
fn packed(samples: impl Iterator<Item = u8>, bits: u8) -> Vec<u8> {
    let samples: Vec<u8> = samples.collect();
    let a_byte = usize::from(8 / bits);
    let pack = |group: &[u8]| {
        let byte = group.iter().fold(0_u8, |byte, s| byte.unbounded_shl(u32::from(bits)) | s);
        byte.unbounded_shl(u32::from(bits) * (a_byte - group.len()) as u32)
    };
    samples.chunks(a_byte).map(pack).collect()
}

#[cfg(test)]
mod tests {
    use super::packed;

    #[test]
    fn samples_are_packed_from_the_left() {
        assert_eq!(packed([1, 0, 1, 1, 0, 0, 0, 1, 1].into_iter(), 1), [0b1011_0001, 0b1000_0000]);
        assert_eq!(packed([3, 0, 2].into_iter(), 2), [0b1100_1000]);
        assert_eq!(packed([15, 1, 7].into_iter(), 4), [0xf1, 0x70]);
        assert_eq!(packed([200, 7].into_iter(), 8), [200, 7]);
    }
}
