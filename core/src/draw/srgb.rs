//! Linear light on displays: the sRGB curve, both ways, and the palette of pictures in colour.
//!
//! A display gives off `L(v)` of its full light for the code `255 v`:
//!
//! ```text
//! L(v) = v / 12.92                      for v <= 0.04045
//!        ((v + 0.055) / 1.055)^2.4      else
//! ```
//!
//! Source: IEC 61966-2-1. Format: light in 65535ths, codes in 255ths. One table of 510 bytes serves both
//! ways, where codes begin; 512 bytes more tell which code to begin with.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::palette::Palette;
use crate::plane::LinearRgb;

/// The least light whose nearest code is 1, 2, ... 255: `65535 L((code - 1/2) / 255)`, rounded up.
const FROM: [u16; 255] = [
    10, 30, 50, 70, 90, 110, 130, 150, 170, 189, 209, 230, 253, 276, 301, 327, 354, 382, 412, 443, 475, 509,
    544, 580, 618, 657, 698, 740, 783, 828, 875, 923, 972, 1023, 1075, 1129, 1185, 1242, 1300, 1360, 1422,
    1486, 1551, 1617, 1685, 1755, 1827, 1900, 1975, 2052, 2130, 2210, 2292, 2376, 2461, 2548, 2637, 2727,
    2820, 2914, 3010, 3108, 3208, 3309, 3412, 3518, 3625, 3734, 3844, 3957, 4072, 4188, 4307, 4427, 4550,
    4674, 4800, 4928, 5059, 5191, 5325, 5461, 5599, 5740, 5882, 6026, 6173, 6321, 6471, 6624, 6778, 6935,
    7094, 7255, 7418, 7583, 7750, 7919, 8091, 8265, 8440, 8618, 8798, 8981, 9165, 9352, 9541, 9732, 9925,
    10121, 10318, 10518, 10720, 10925, 11132, 11341, 11552, 11765, 11981, 12199, 12420, 12643, 12868, 13095,
    13325, 13557, 13791, 14028, 14267, 14508, 14752, 14998, 15247, 15498, 15751, 16007, 16265, 16525, 16788,
    17054, 17321, 17592, 17864, 18139, 18417, 18697, 18980, 19264, 19552, 19842, 20134, 20429, 20727, 21027,
    21329, 21634, 21942, 22252, 22564, 22880, 23197, 23518, 23840, 24166, 24494, 24824, 25158, 25493, 25832,
    26173, 26516, 26862, 27211, 27563, 27917, 28273, 28633, 28995, 29359, 29727, 30097, 30469, 30845, 31223,
    31603, 31987, 32373, 32762, 33153, 33547, 33944, 34344, 34747, 35152, 35560, 35970, 36384, 36800, 37219,
    37640, 38065, 38492, 38922, 39355, 39790, 40229, 40670, 41114, 41561, 42011, 42463, 42918, 43377, 43838,
    44301, 44768, 45238, 45710, 46185, 46663, 47144, 47628, 48115, 48605, 49097, 49593, 50091, 50592, 51096,
    51604, 52114, 52627, 53142, 53661, 54183, 54708, 55235, 55766, 56300, 56836, 57376, 57918, 58464, 59012,
    59564, 60118, 60675, 61236, 61799, 62366, 62935, 63508, 64083, 64662, 65244,
];

/// The lights up to here have a begin each 16, the others each 256: no more than 2 codes begin in between.
const DIM: u16 = 1 << 12;

/// The codes of every 16th light of the dim ones.
static DIM_CODES: [u8; 256] = codes(4);
/// The codes of every 256th light.
static CODES: [u8; 256] = codes(8);

const fn codes(shift: u32) -> [u8; 256] {
    let (mut codes, mut index, mut code) = ([0; 256], 0, 0_usize);
    while index < 256 {
        let light = index << shift;
        while code < FROM.len() && light >= FROM[code] as usize {
            code += 1;
        }
        codes[index] = code as u8;
        index += 1;
    }
    codes
}

/// The code whose light is the nearest as codes go.
#[inline]
pub(super) fn encoded(light: u16) -> u8 {
    let (codes, shift) = if light < DIM { (&DIM_CODES, 4) } else { (&CODES, 8) };
    let mut code = codes[usize::from(light >> shift & 255)];
    // `FROM[code]` is where the next code begins, behind 255 none does
    while FROM.get(usize::from(code)).is_some_and(|begins| light >= *begins) {
        code += 1;
    }
    code
}

/// The light of a code, within 1.4 of 65535 (`a_code_gives_off_the_middle_of_its_light`).
#[inline]
fn light(code: u8) -> u16 {
    let begins = usize::from(code).checked_sub(1).and_then(|before| FROM.get(before));
    match (begins, FROM.get(usize::from(code))) {
        (None, _) => 0,
        (_, None) => u16::MAX,
        (Some(begins), Some(next)) => ((u32::from(*begins) + u32::from(*next) - 1) >> 1) as u16,
    }
}

/// How much light a colour gives off, of 65535: `0.2126 R + 0.7152 G + 0.0722 B` of ITU-R BT.709, the
/// channels decoded.
#[inline]
pub(super) fn luminance(rgb: Rgb888) -> u16 {
    let [r, g, b] = [rgb.r(), rgb.g(), rgb.b()].map(|code| u32::from(light(code)));
    // weights with 16 fractional bits, of sum 2^16
    ((r * 13_933 + g * 46_871 + b * 4_732 + (1 << 15)) >> 16) as u16
}

/// The palette of pictures in colour, whose values are light: [`LinearRgb`].
///
/// A colour display shows the nearest colours by the sRGB curve, dithered where it has fewer than 8 bits a
/// channel; grey ones the luminance of ITU-R BT.709, computed in linear light and encoded again; dots of one
/// bit give off as much light as there is. See [`Ink::dithered_ink`](crate::draw::Ink::dithered_ink).
///
/// Error: none: each channel of the result is the nearest of 255
/// (`every_light_gets_the_nearest_code`). Cost: a look-up a channel, and 1 to 3 comparisons.
///
/// ```
/// use attractor::draw::{Palette, Srgb, hex};
/// use attractor::plane::LinearRgb;
///
/// // a fifth of the light looks half as bright
/// assert_eq!(Srgb.rgb(LinearRgb::new(65535, 13107, 0)), hex(0xff7c00));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Srgb;

impl Palette<LinearRgb> for Srgb {
    #[inline]
    fn rgb(&self, value: LinearRgb) -> Rgb888 {
        Rgb888::new(encoded(value.r), encoded(value.g), encoded(value.b))
    }

    #[inline]
    fn is_dithered(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// IEC 61966-2-1, from a code to light and back.
    fn decoded(code: f64) -> f64 {
        let v = code / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    }

    fn exact(light: u16) -> f64 {
        let l = f64::from(light) / 65535.0;
        255.0 * if l <= 0.003_130_8 { 12.92 * l } else { 1.055 * l.powf(1.0 / 2.4) - 0.055 }
    }

    #[test]
    fn every_light_gets_the_nearest_code() {
        let (mut worst, mut steps) = (0.0_f64, 0);
        for light in 0..=u16::MAX {
            let error = (f64::from(encoded(light)) - exact(light)).abs();
            // no light comes nearer to the middle of two codes than 1e-6: f64 decides
            assert!(error < 0.5 - 1e-6, "{light}: {} for {}", encoded(light), exact(light));
            worst = worst.max(error);
            let looked_up =
                if light < DIM { DIM_CODES[usize::from(light >> 4)] } else { CODES[usize::from(light >> 8)] };
            steps = steps.max(encoded(light) - looked_up);
        }
        assert!(worst > 0.4999 && steps == 2, "{worst} {steps}");
        let rgb = Srgb.rgb(LinearRgb::new(0, u16::MAX, 10));
        assert_eq!(rgb, Rgb888::new(0, 255, 1));
    }

    #[test]
    fn a_code_gives_off_the_middle_of_its_light() {
        let mut worst = 0.0_f64;
        for code in 0..=255 {
            worst = worst.max((f64::from(light(code)) - 65535.0 * decoded(f64::from(code))).abs());
            assert_eq!(encoded(light(code)), code);
        }
        assert!(worst > 0.8 && worst < 1.4, "{worst}");
        assert_eq!((light(0), light(255)), (0, u16::MAX));
    }

    #[test]
    fn luminance_is_a_weighted_sum_of_light() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        let channel = || (0..=255_u8).step_by(17);
        for (r, g, b) in
            channel().flat_map(|r| channel().flat_map(move |g| channel().map(move |b| (r, g, b))))
        {
            let exact = 0.2126 * decoded(r.into()) + 0.7152 * decoded(g.into()) + 0.0722 * decoded(b.into());
            worst = worst.max((f64::from(luminance(Rgb888::new(r, g, b))) - 65535.0 * exact).abs());
            tried += 1;
        }
        assert!(tried == 4096 && worst > 0.5 && worst < 2.5, "{worst} of {tried}");
        assert_eq!((luminance(Rgb888::WHITE), luminance(Rgb888::BLACK)), (u16::MAX, 0));
    }
}
