//! Gradients that come with the crate.
//!
//! Their stops lie on curves in the Oklab space (B. Ottosson, "A perceptual color space for image
//! processing", 2020), evenly in level. Lightness never falls, so each also reads on a display without
//! colour; [`PORCELAIN`] alone rises and falls, for cycles.

use super::gradient::Gradient;
use super::palette::hex;

/// Night indigo through plum and rose to a pale evening sky: for mirrors and shaded surfaces.
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#05041a,#1b1343,#37236f,#743083,#b43f7f,
/// #e1696b,#fb9d62,#fccb91,#fff3d2)"></div>
pub const DUSK: Gradient<9> = Gradient::evenly([
    hex(0x05041a),
    hex(0x1b1343),
    hex(0x37236f),
    hex(0x743083),
    hex(0xb43f7f),
    hex(0xe1696b),
    hex(0xfb9d62),
    hex(0xfccb91),
    hex(0xfff3d2),
]);

/// Black through ember red and orange to white heat.
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#010000,#290103,#65000a,#9b110f,#d32704,
/// #ea7104,#fea92f,#fcd77f,#fffdd4)"></div>
pub const FIRE: Gradient<9> = Gradient::evenly([
    hex(0x010000),
    hex(0x290103),
    hex(0x65000a),
    hex(0x9b110f),
    hex(0xd32704),
    hex(0xea7104),
    hex(0xfea92f),
    hex(0xfcd77f),
    hex(0xfffdd4),
]);

/// Midnight blue through teal to foam.
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#020417,#07173f,#052f6c,#015188,#0076a1,
/// #079eba,#53c6cb,#9fe6de,#ebfdf9)"></div>
pub const OCEAN: Gradient<9> = Gradient::evenly([
    hex(0x020417),
    hex(0x07173f),
    hex(0x052f6c),
    hex(0x015188),
    hex(0x0076a1),
    hex(0x079eba),
    hex(0x53c6cb),
    hex(0x9fe6de),
    hex(0xebfdf9),
]);

/// Deep green to lit leaves: for ferns and hills.
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#000603,#011d10,#0a381e,#1e562a,#3a782e,
/// #629a2e,#9bbd42,#d1dd79,#fafbcc)"></div>
pub const MOSS: Gradient<9> = Gradient::evenly([
    hex(0x000603),
    hex(0x011d10),
    hex(0x0a381e),
    hex(0x1e562a),
    hex(0x3a782e),
    hex(0x629a2e),
    hex(0x9bbd42),
    hex(0xd1dd79),
    hex(0xfafbcc),
]);

/// Violet, blue, green, yellow in perceptually even steps: equal differences of level look equal, and
/// lightness alone tells them apart.
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#120027,#200946,#2b1d64,#23377d,#04528e,
/// #036b8e,#018490,#009d8e,#13b384,#5cc56e,#97d457,#c8e45b,#f6f367)"></div>
pub const EVEN: Gradient<13> = Gradient::evenly([
    hex(0x120027),
    hex(0x200946),
    hex(0x2b1d64),
    hex(0x23377d),
    hex(0x04528e),
    hex(0x036b8e),
    hex(0x018490),
    hex(0x009d8e),
    hex(0x13b384),
    hex(0x5cc56e),
    hex(0x97d457),
    hex(0xc8e45b),
    hex(0xf6f367),
]);

/// Cobalt, white, amber and back to cobalt: its ends meet, made for [`Cycled`](crate::draw::Cycled).
///
/// <div style="height:1.5em;background:linear-gradient(90deg,#061457,#0f2e7d,#1c49a6,#3b77c4,#63a7df,
/// #aad1eb,#faf7ee,#f3d49f,#e1aa59,#ba753a,#8e472b,#49364a,#061457)"></div>
pub const PORCELAIN: Gradient<13> = Gradient::evenly([
    hex(0x061457),
    hex(0x0f2e7d),
    hex(0x1c49a6),
    hex(0x3b77c4),
    hex(0x63a7df),
    hex(0xaad1eb),
    hex(0xfaf7ee),
    hex(0xf3d49f),
    hex(0xe1aa59),
    hex(0xba753a),
    hex(0x8e472b),
    hex(0x49364a),
    hex(0x061457),
]);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{Level, luma};
    use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

    extern crate std;
    use std::vec::Vec;

    fn rises<const N: usize>(gradient: Gradient<N>) -> bool {
        let lumas: Vec<u8> = (0..=255_u16).map(|i| luma(gradient.at(Level::from_bits(i * 257)))).collect();
        lumas.is_sorted() && lumas.first() < Some(&20) && lumas.last() > Some(&225)
    }

    #[test]
    fn the_gradients_rise_in_lightness() {
        assert!(rises(DUSK) && rises(FIRE) && rises(OCEAN) && rises(MOSS) && rises(EVEN));
    }

    #[test]
    fn the_documentation_shows_each_gradients_own_colours() {
        let colors = |text: &str, mark: &str| -> Vec<std::string::String> {
            text.split(mark).skip(1).map(|rest| rest[..6].into()).collect()
        };
        let gradients = include_str!("gradients.rs").split("\n/// <div style=").skip(1);
        let mut count = 0;
        for gradient in gradients {
            let (shown, after) = gradient.split_once("</div>").unwrap();
            let own = after.split_once("]);").unwrap().0;
            assert_eq!(colors(shown, "#"), colors(own, "hex(0x"));
            count += 1;
        }
        assert_eq!(count, include_str!("gradients.rs").matches("\npub const ").count());
    }

    #[test]
    fn porcelain_closes() {
        assert_eq!(PORCELAIN.at(Level::ZERO), PORCELAIN.at(Level::FULL));
    }

    fn oklab(rgb: Rgb888) -> [f64; 3] {
        let linear = |value: u8| {
            let value = f64::from(value) / 255.0;
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
        };
        let (r, g, b) = (linear(rgb.r()), linear(rgb.g()), linear(rgb.b()));
        let l = (0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b).cbrt();
        let m = (0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b).cbrt();
        let s = (0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b).cbrt();
        [
            0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
        ]
    }

    #[test]
    fn even_steps_look_even() {
        let labs: Vec<_> = (0..=24_u16).map(|i| oklab(EVEN.at(Level::from_bits(i * (65535 / 24))))).collect();
        let steps: Vec<f64> = labs
            .windows(2)
            .map(|pair| pair[0].iter().zip(pair[1]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt())
            .collect();
        let (least, most) = steps.iter().fold((1.0_f64, 0.0_f64), |(a, b), &step| (a.min(step), b.max(step)));
        assert!(least > 0.03 && most < 1.25 * least, "{least} to {most}");
    }
}
