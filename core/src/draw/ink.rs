//! Ink: from a display-independent colour to what a display can show at a pixel, the nearest colour or a
//! dither of few.

use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

use super::palette::Palette;
use super::srgb::{encoded, luminance};

/// A colour that a display can show.
///
/// Displays with 5 bits a channel or more get the nearest colour. Black-and-white and 4 or 16 greys get
/// ordered dithering (B. E. Bayer, "An optimum method for two-level rendition of continuous-tone pictures",
/// ICC 1973) with an 8 x 8 matrix: [`dithered`]. Grey is the luma of ITU-R BT.601, as in embedded-graphics:
/// [`luma`]; [`Luminance`](crate::draw::Luminance) makes one bit give off the right light. The decision
/// depends on the colour and on the pixel's position in its picture alone, so that parts drawn at different
/// times fit together.
///
/// # The colours of a driver
///
/// A colour of your own becomes usable with one `impl Ink`. The colour of another crate, as
/// `epd_waveshare::color::TriColor`, takes a wrapper, since neither it nor `Ink` is yours, and
/// `color_converted` of embedded-graphics, which takes the wrapper off:
///
/// ```
/// use attractor::draw::{Gradient, Ink, Picture, dithered, hex, luma};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, pixelcolor::{PixelColor, Rgb888, RgbColor}, prelude::*};
/// # mod driver {
/// #     use embedded_graphics::{pixelcolor::{PixelColor, raw::RawU2}, prelude::*};
/// #     #[derive(Clone, Copy, PartialEq, Debug)]
/// #     pub enum TriColor { Black, White, Chromatic }
/// #     impl PixelColor for TriColor { type Raw = RawU2; }
/// #     pub struct Display(pub Vec<TriColor>);
/// #     impl OriginDimensions for Display { fn size(&self) -> Size { Size::new(8, 2) } }
/// #     impl DrawTarget for Display {
/// #         type Color = TriColor;
/// #         type Error = core::convert::Infallible;
/// #         fn draw_iter<I: IntoIterator<Item = Pixel<TriColor>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
/// #             pixels.into_iter().for_each(|Pixel(at, color)| self.0[(at.y * 8 + at.x) as usize] = color);
/// #             Ok(())
/// #         }
/// #     }
/// # }
/// use driver::TriColor; // Black, White, Chromatic
/// # use driver::Display;
///
/// #[derive(Clone, Copy, PartialEq, Debug)]
/// struct Paper(TriColor);
///
/// impl PixelColor for Paper {
///     type Raw = <TriColor as PixelColor>::Raw;
/// }
///
/// impl From<Paper> for TriColor {
///     fn from(Paper(color): Paper) -> Self {
///         color
///     }
/// }
///
/// impl Ink for Paper {
///     fn ink(rgb: Rgb888, at: Point) -> Self {
///         Self(if rgb.r() > 128 && rgb.g() < 64 {
///             TriColor::Chromatic
///         } else if dithered(luma(rgb), 1, at) == 0 {
///             TriColor::Black
///         } else {
///             TriColor::White
///         })
///     }
/// }
///
/// let wedge = from_fn(Size::new(8, 2), |x, _y| x as u8 * 36);
/// let palette = Gradient::evenly([hex(0x000000), hex(0xff0000), hex(0xffffff)]);
/// let picture = Picture::new(wedge, palette);
/// # let mut display = Display(vec![TriColor::Black; 16]);
/// Image::new(&picture, Point::zero()).draw(&mut display.color_converted::<Paper>())?;
/// # let letters: String = display.0.iter().map(|color| match color {
/// #     TriColor::Black => '.', TriColor::White => '#', TriColor::Chromatic => 'r',
/// # }).collect();
/// // . black, # white, r red
/// assert_eq!(letters, "..rrr###..rrr#.#");
/// # Ok::<(), core::convert::Infallible>(())
/// ```
pub trait Ink: PixelColor {
    /// The closest this colour comes to `rgb` at the position `at`, counted from the top left of the picture.
    fn ink(rgb: Rgb888, at: Point) -> Self;

    /// The same for palettes that ask for it by [`Palette::is_dithered`]: true to the light of the colours,
    /// and dithered wherever there are fewer than 256 levels.
    ///
    /// Over every square of 8 x 8 pixels the mean of each channel is that of `rgb` within 1/128 of a level of
    /// the display (`the_mean_of_a_dithered_square_is_the_colour`). Greys have the luminance of ITU-R BT.709,
    /// computed in linear light and encoded; of dots of one bit, which nothing encodes, as many are lit as
    /// there is light. A colour type that does not say otherwise is inked as ever.
    #[inline]
    fn dithered_ink(rgb: Rgb888, at: Point) -> Self {
        Self::ink(rgb, at)
    }
}

/// The colour of a value at a pixel, by the one ink or the other.
#[inline(always)]
pub(super) fn shown<V, P: Palette<V>, C: Ink>(palette: &P, value: V, at: Point) -> C {
    inked(palette.is_dithered(), palette.rgb(value), at)
}

#[inline(always)]
pub(super) fn inked<C: Ink>(is_dithered: bool, rgb: Rgb888, at: Point) -> C {
    if is_dithered { C::dithered_ink(rgb, at) } else { C::ink(rgb, at) }
}

/// The luma of ITU-R BT.601, `0.299 R + 0.587 G + 0.114 B`, in 8 bits: how bright an encoded colour looks,
/// not how much light it gives off.
#[inline]
pub fn luma(rgb: Rgb888) -> u8 {
    let sum = u32::from(rgb.r()) * 77 + u32::from(rgb.g()) * 150 + u32::from(rgb.b()) * 29;
    ((sum + 128) >> 8) as u8
}

/// The 8 x 8 matrix, row by row: the bits of `x ^ y` and `y`, interleaved from the lowest down.
const BAYER: [u8; 64] = {
    let mut matrix = [0; 64];
    let mut i = 0_usize;
    while i < 64 {
        let (x, y) = (i as u8 & 7, i as u8 >> 3);
        let mut value = 0;
        let mut bit = 0;
        while bit < 3 {
            value = value << 2 | (((x ^ y) >> bit) & 1) << 1 | ((y >> bit) & 1);
            bit += 1;
        }
        matrix[i] = value;
        i += 1;
    }
    matrix
};

/// The threshold of Bayer's matrix at a position: each of `0..=63` once in every square of 8 x 8 pixels.
#[inline]
pub const fn bayer(at: Point) -> u8 {
    // & 7 is the remainder for negative coordinates too; the index is at most 63
    BAYER[(((at.y & 7) << 3) | (at.x & 7)) as usize & 63]
}

/// `value` (`0..=255`) as one of the levels `0..=max`, by ordered dithering.
///
/// Over every square of 8 x 8 pixels the mean of the levels is `max * value / 255` within 1/128 of a level
/// (`the_density_of_the_dots_is_the_grey`); 0 and 255 are pure.
#[inline]
pub const fn dithered(value: u8, max: u8, at: Point) -> u8 {
    let scaled = value as u32 * max as u32;
    let (level, rest) = (scaled / 255, scaled % 255);
    // of 64 positions, round(64 rest / 255) show the level above
    let dots = (rest * 64 + 127) / 255;
    level as u8 + ((bayer(at) as u32) < dots) as u8
}

/// The code of the grey that gives off as much light as a colour.
#[inline]
fn grey_of(rgb: Rgb888) -> u8 {
    encoded(luminance(rgb))
}

impl Ink for BinaryColor {
    #[inline]
    fn ink(rgb: Rgb888, at: Point) -> Self {
        if dithered(luma(rgb), 1, at) == 0 { Self::Off } else { Self::On }
    }

    #[inline]
    fn dithered_ink(rgb: Rgb888, at: Point) -> Self {
        // of 64 positions, round(64 luminance)
        let dots = (u32::from(luminance(rgb)) * 64 + 32_767) / 65_535;
        if u32::from(bayer(at)) < dots { Self::On } else { Self::Off }
    }
}

impl Ink for Gray2 {
    #[inline]
    fn ink(rgb: Rgb888, at: Point) -> Self {
        Self::new(dithered(luma(rgb), 3, at))
    }

    #[inline]
    fn dithered_ink(rgb: Rgb888, at: Point) -> Self {
        Self::new(dithered(grey_of(rgb), 3, at))
    }
}

impl Ink for Gray4 {
    #[inline]
    fn ink(rgb: Rgb888, at: Point) -> Self {
        Self::new(dithered(luma(rgb), 15, at))
    }

    #[inline]
    fn dithered_ink(rgb: Rgb888, at: Point) -> Self {
        Self::new(dithered(grey_of(rgb), 15, at))
    }
}

impl Ink for Gray8 {
    #[inline]
    fn ink(rgb: Rgb888, _at: Point) -> Self {
        Self::new(luma(rgb))
    }

    #[inline]
    fn dithered_ink(rgb: Rgb888, _at: Point) -> Self {
        Self::new(grey_of(rgb))
    }
}

macro_rules! nearest {
    ($($color:ty),*) => {$(
        impl Ink for $color {
            #[inline]
            fn ink(rgb: Rgb888, _at: Point) -> Self {
                rgb.into()
            }

            #[inline]
            fn dithered_ink(rgb: Rgb888, at: Point) -> Self {
                let [r, g, b] = [(rgb.r(), Self::MAX_R), (rgb.g(), Self::MAX_G), (rgb.b(), Self::MAX_B)]
                    .map(|(value, max)| dithered(value, max, at));
                Self::new(r, g, b)
            }
        }
    )*};
}

nearest!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics_core::pixelcolor::GrayColor;

    fn grey(value: u8) -> Rgb888 {
        Rgb888::new(value, value, value)
    }

    fn square() -> impl Iterator<Item = Point> {
        (0..64).map(|i| Point::new(i & 7, i >> 3) + Point::new(-13, 5))
    }

    #[test]
    fn the_matrix_is_bayers() {
        let row = |y| core::array::from_fn::<u8, 8, _>(|x| bayer(Point::new(x as i32, y)));
        assert_eq!(row(0), [0, 32, 8, 40, 2, 34, 10, 42]);
        assert_eq!(row(1), [48, 16, 56, 24, 50, 18, 58, 26]);
        assert_eq!(row(-1), [63, 31, 55, 23, 61, 29, 53, 21]);
        assert_eq!(square().fold(0_u64, |seen, at| seen | 1 << bayer(at)), u64::MAX);
    }

    #[test]
    fn the_density_of_the_dots_is_the_grey() {
        for value in 0..=u8::MAX {
            let mean =
                |level: fn(Rgb888, Point) -> u32| square().map(|at| level(grey(value), at)).sum::<u32>();
            let binary = mean(|rgb, at| u32::from(BinaryColor::ink(rgb, at).is_on()));
            let gray2 = mean(|rgb, at| u32::from(Gray2::ink(rgb, at).luma()));
            let gray4 = mean(|rgb, at| u32::from(Gray4::ink(rgb, at).luma()));
            for (sum, max) in [(binary, 1), (gray2, 3), (gray4, 15)] {
                // |sum / 64 - max value / 255| <= 1 / 128
                let difference = (sum * 255).abs_diff(64 * max * u32::from(value));
                assert!(2 * difference <= 255, "{value}: {sum} of {max}");
            }
        }
        assert!(
            square().all(|at| BinaryColor::ink(grey(255), at).is_on() && Gray4::ink(grey(0), at).luma() == 0)
        );
    }

    /// The sum over a square of what an ink shows of a colour.
    fn sum<C: Ink>(rgb: Rgb888, part: fn(C) -> u8) -> u32 {
        square().map(|at| u32::from(part(C::dithered_ink(rgb, at)))).sum()
    }

    /// All channels of all colour types, each with a value of its own.
    #[test]
    fn the_mean_of_a_dithered_square_is_the_colour() {
        let mut worst = 0;
        macro_rules! all {
            ($($color:ty),*) => {$(
                for value in 0..=u8::MAX {
                    let rgb = Rgb888::new(value, value.wrapping_mul(7), 255 - value);
                    let parts = [
                        (sum(rgb, |c: $color| c.r()), <$color>::MAX_R, rgb.r()),
                        (sum(rgb, |c: $color| c.g()), <$color>::MAX_G, rgb.g()),
                        (sum(rgb, |c: $color| c.b()), <$color>::MAX_B, rgb.b()),
                    ];
                    for (sum, max, value) in parts {
                        // |sum / 64 - max value / 255| <= 1 / 128
                        let difference = (sum * 255).abs_diff(64 * u32::from(max) * u32::from(value));
                        assert!(2 * difference <= 255, "{rgb:?}: {sum} of {max}");
                        worst = worst.max(difference);
                    }
                }
            )*};
        }
        all!(Rgb555, Bgr555, Rgb565, Bgr565, Rgb666, Bgr666, Rgb888, Bgr888);
        assert!(worst > 120, "{worst}");
    }

    /// Against IEC 61966-2-1 and ITU-R BT.709 in double precision.
    #[test]
    fn dithered_greys_and_dots_give_off_the_light_of_the_colour() {
        let decoded = |code: u8| {
            let v = f64::from(code) / 255.0;
            if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        };
        let channel = || (0..=255_u8).step_by(15);
        let cube = channel().flat_map(|r| channel().flat_map(move |g| channel().map(move |b| (r, g, b))));
        let [mut dots, mut two, mut four, mut eight] = [0.0_f64; 4];
        for (r, g, b) in cube {
            let rgb = Rgb888::new(r, g, b);
            let light = 0.2126 * decoded(r) + 0.7152 * decoded(g) + 0.0722 * decoded(b);
            let code =
                if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
            let off = |sum: u32, max: f64, exact: f64| (f64::from(sum) / 64.0 - max * exact).abs();
            dots = dots.max(off(sum(rgb, |c: BinaryColor| u8::from(c.is_on())), 1.0, light));
            two = two.max(off(sum(rgb, |c: Gray2| c.luma()), 3.0, code));
            four = four.max(off(sum(rgb, |c: Gray4| c.luma()), 15.0, code));
            eight = eight.max(off(sum(rgb, |c: Gray8| c.luma()), 255.0, code));
        }
        // half a dot of 64; of greys half a code of 255 as well
        assert!(dots > 0.0077 && dots < 0.5 / 64.0 + 5e-5, "{dots}");
        assert!(two > 0.012 && two < 0.5 / 64.0 + 1.51 / 255.0, "{two}");
        assert!(four > 0.03 && four < 0.5 / 64.0 + 7.51 / 255.0, "{four}");
        assert!(eight > 0.49 && eight < 0.51, "{eight}");
    }

    #[test]
    fn only_palettes_that_ask_for_it_are_dithered_everywhere() {
        use crate::draw::{Dithered, Grey, Inverted, Luminance, Picture, Srgb};
        use crate::plane::{LinearRgb, from_fn};
        use embedded_graphics_core::geometry::Size;

        let asks = |palette: &dyn Palette<u8>| palette.is_dithered();
        assert!(asks(&Dithered(Grey)) && asks(&&Dithered(Grey)) && !asks(&Inverted(Dithered(Grey))));
        assert!(!asks(&Grey) && !asks(&Luminance(Grey)) && !asks(&|_: u8| Rgb888::BLACK));
        // by value, by reference, by a choice at run time, row by row and pixel by pixel
        let flat = from_fn(Size::new(16, 16), |_, _| LinearRgb::new(9000, 20, 777));
        fn drawn<P: Palette<LinearRgb>>(
            flat: impl crate::plane::Field<Value = LinearRgb>,
            palette: P,
        ) -> [u64; 2] {
            let picture = Picture::<_, _, Rgb565>::new(flat, palette);
            let hash = |sum: u64, color: Rgb565| {
                sum * 31 % 1_000_003
                    + u64::from(color.r())
                    + u64::from(color.g()) * 64
                    + u64::from(color.b()) * 4096
            };
            let row = picture.colors(5, 0..16).unwrap().fold(0, hash);
            let mut strided = 0;
            for x in 0..16 {
                strided = hash(strided, picture.colors(5, 0..16).unwrap().nth(x).unwrap());
            }
            [row, strided]
        }
        let by_value = drawn(flat, Srgb);
        assert_eq!(by_value[0], by_value[1]);
        let choice: &dyn Palette<LinearRgb> = &Srgb;
        assert_eq!([drawn(flat, Dithered(&Srgb)), drawn(flat, choice)], [by_value; 2]);
        assert_ne!(drawn(flat, |value: LinearRgb| Srgb.rgb(value)), by_value);
    }

    #[test]
    fn every_channel_is_rounded_to_the_nearest() {
        for value in 0..=u8::MAX {
            let nearest = |max: u32| ((u32::from(value) * max * 2 + 255) / 510) as u8;
            let (five, six) = (nearest(31), nearest(63));
            let at = Point::zero();
            assert_eq!(Rgb565::ink(grey(value), at), Rgb565::new(five, six, five), "{value}");
            assert_eq!(Bgr565::ink(grey(value), at), Bgr565::new(five, six, five));
            assert_eq!(Rgb555::ink(grey(value), at), Rgb555::new(five, five, five));
            assert_eq!(Bgr555::ink(grey(value), at), Bgr555::new(five, five, five));
            assert_eq!(Rgb666::ink(grey(value), at), Rgb666::new(six, six, six));
            assert_eq!(Bgr666::ink(grey(value), at), Bgr666::new(six, six, six));
            assert_eq!(Gray8::ink(grey(value), at), Gray8::new(value));
        }
        let rgb = Rgb888::new(1, 2, 3);
        assert_eq!(Rgb888::ink(rgb, Point::zero()), rgb);
        assert_eq!(Bgr888::ink(rgb, Point::zero()), Bgr888::new(1, 2, 3));
    }

    /// What a crate with a driver for seven-colour paper would define.
    #[derive(Clone, Copy, PartialEq, Debug)]
    enum Seven {
        Black,
        White,
        Green,
        Blue,
        Red,
        Yellow,
        Orange,
    }

    impl PixelColor for Seven {
        type Raw = ();
    }

    /// The wrapper: the nearest ink of the seven after moving each channel by the matrix.
    #[derive(Clone, Copy, PartialEq, Debug)]
    struct Nearest(Seven);

    impl PixelColor for Nearest {
        type Raw = ();
    }

    impl From<Nearest> for Seven {
        fn from(Nearest(color): Nearest) -> Self {
            color
        }
    }

    impl Ink for Nearest {
        fn ink(rgb: Rgb888, at: Point) -> Self {
            const INKS: [(Seven, Rgb888); 7] = [
                (Seven::Black, Rgb888::BLACK),
                (Seven::White, Rgb888::WHITE),
                (Seven::Green, Rgb888::GREEN),
                (Seven::Blue, Rgb888::BLUE),
                (Seven::Red, Rgb888::RED),
                (Seven::Yellow, Rgb888::YELLOW),
                (Seven::Orange, Rgb888::new(255, 128, 0)),
            ];
            let moved = |channel: u8| i32::from(channel) + 2 * i32::from(bayer(at)) - 63;
            let away = |ink: Rgb888| {
                let square = |a: u8, b: u8| (moved(a) - i32::from(b)).pow(2);
                square(rgb.r(), ink.r()) + square(rgb.g(), ink.g()) + square(rgb.b(), ink.b())
            };
            let nearest = INKS.iter().min_by_key(|(_, ink)| away(*ink));
            Self(nearest.map_or(Seven::White, |(color, _)| *color))
        }
    }

    #[test]
    fn the_colours_of_a_driver_are_wrapped_and_converted() {
        use crate::draw::testing::Frame;
        use crate::draw::{Picture, hex};
        use crate::plane::from_fn;
        use embedded_graphics::draw_target::DrawTargetExt;
        use embedded_graphics_core::geometry::Size;
        use embedded_graphics_core::image::ImageDrawable;

        let inks = [0xff8000, 0xffff00, 0xff0000, 0x0000ff, 0x00ff00, 0xffffff, 0x000000, 0x808080];
        let bands = from_fn(Size::new(8, 64), |_, y| inks[y as usize / 8]);
        let mut paper = Frame::new(Size::new(8, 64), Seven::Black);
        let picture = Picture::new(bands, hex);
        picture.draw(&mut paper.color_converted::<Nearest>()).unwrap();
        let pure =
            [Seven::Orange, Seven::Yellow, Seven::Red, Seven::Blue, Seven::Green, Seven::White, Seven::Black];
        for (band, color) in paper.colors.chunks(64).zip(pure) {
            assert!(band.iter().filter(|ink| **ink == color).count() >= 60, "{color:?}");
        }
        // grey is black and white in equal parts, with a few coloured dots between
        let grey = paper.colors.chunks(64).nth(7).unwrap();
        let of = |color| grey.iter().filter(|ink| **ink == color).count();
        assert!(of(Seven::Black) > 16 && of(Seven::White) > 16, "{grey:?}");
    }

    #[test]
    fn an_outsider_adds_a_colour_with_two_inks() {
        #[derive(Clone, Copy, PartialEq, Debug)]
        enum Paper {
            White,
            Black,
            Red,
        }
        impl PixelColor for Paper {
            type Raw = ();
        }
        impl Ink for Paper {
            fn ink(rgb: Rgb888, at: Point) -> Self {
                match (rgb.r().saturating_sub(rgb.g()) > 99, dithered(luma(rgb), 1, at)) {
                    (true, _) => Self::Red,
                    (false, 0) => Self::Black,
                    (false, _) => Self::White,
                }
            }
        }
        assert_eq!(square().filter(|&at| Paper::ink(grey(64), at) == Paper::White).count(), 16);
        assert_eq!(square().filter(|&at| Paper::ink(grey(64), at) == Paper::Black).count(), 48);
        assert_eq!(Paper::ink(Rgb888::RED, Point::zero()), Paper::Red);
    }
}
