//! A gradient: a palette that is piecewise linear through colours at given levels.
//!
//! The quotient of an interpolation is a product with a reciprocal prepared in the constructor, 32 bits wide.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::level::{Level, Leveled};
use super::palette::Palette;
use crate::Error;

/// A palette that runs through `N` colours.
///
/// Result: between neighbouring stops `(p, c)` and `(q, d)` each channel is `c + (d - c) (x - p) / (q - p)`,
/// rounded; exact at the stops, constant outside the first and the last. Values inside the set are black.
/// Interpolation is in the encoded (sRGB) channels: put enough stops where that matters. Error: 0.51 of a
/// step of a channel (`a_gradient_stays_within_half_a_step_of_the_exact_line`,
/// `the_gradients_of_the_crate_keep_the_same_bound`).
/// Cost: a walk along the stops up to the level, and 4 multiplications.
///
/// ```
/// use attractor::draw::{Gradient, Level, Palette, hex};
///
/// const SUNSET: Gradient<3> = Gradient::evenly([hex(0x2d1e4f), hex(0xd1495b), hex(0xfff3b0)]);
/// assert_eq!(SUNSET.rgb(Level::ZERO), hex(0x2d1e4f));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gradient<const N: usize> {
    stops: [Stop; N],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stop {
    at: u16,
    rgb: Rgb888,
    /// See [`slope`].
    slope: u32,
}

/// `2^32 / distance` to the next stop, rounded down. Where that has 33 bits no level lies between, and any
/// will do.
const fn slope(distance: u32) -> u32 {
    match (1_u64 << 32).checked_div(distance as u64) {
        Some(slope) if distance > 1 => slope as u32,
        _ => 0,
    }
}

impl<const N: usize> Gradient<N> {
    /// Through colours at strictly increasing levels.
    ///
    /// # Errors
    /// [`Error::TooFew`] without a stop, [`Error::NotIncreasing`] where a level is not above the one before
    /// it.
    pub const fn new(colors: [(Level, Rgb888); N]) -> Result<Self, Error> {
        if N == 0 {
            return Err(Error::TooFew { what: "stops of a gradient", given: 0, at_least: 1 });
        }
        let mut stops = [Stop { at: 0, rgb: Rgb888::new(0, 0, 0), slope: 0 }; N];
        let mut i = 0;
        while i < N {
            let (level, rgb) = colors[i];
            let at = level.to_bits();
            let mut distance = 0;
            if i + 1 < N {
                let next = colors[i + 1].0.to_bits();
                if next <= at {
                    return Err(Error::NotIncreasing { what: "stop", index: i + 1 });
                }
                distance = (next - at) as u32;
            }
            stops[i] = Stop { at, rgb, slope: slope(distance) };
            i += 1;
        }
        Ok(Self { stops })
    }

    /// Through colours at equal distances, the first at 0 and the last at 1. `N` from 1 to 256 is checked at
    /// compile time.
    pub const fn evenly(colors: [Rgb888; N]) -> Self {
        const { assert!(N >= 1 && N <= 256, "a gradient has 1 to 256 colours") };
        let mut stops = [Stop { at: 0, rgb: Rgb888::new(0, 0, 0), slope: 0 }; N];
        let mut i = 0;
        while i < N {
            let at = Level::ratio(i as u32, (N - 1) as u32).to_bits();
            let distance = Level::ratio(i as u32 + 1, (N - 1) as u32).to_bits() as u32 - at as u32;
            stops[i] = Stop { at, rgb: colors[i], slope: slope(distance) };
            i += 1;
        }
        Self { stops }
    }

    /// The colour at `level`.
    pub fn at(&self, level: Level) -> Rgb888 {
        let mut below: Option<&Stop> = None;
        for stop in &self.stops {
            if level.to_bits() < stop.at {
                return below.map_or(stop.rgb, |below| below.towards(stop.rgb, level.to_bits()));
            }
            below = Some(stop);
        }
        below.map_or(Rgb888::BLACK, |last| last.rgb)
    }
}

impl Stop {
    fn towards(&self, next: Rgb888, level: u16) -> Rgb888 {
        // below 2^32, since level - at < distance; then 16 fractional bits
        let fraction = (u32::from(level.wrapping_sub(self.at)).wrapping_mul(self.slope) >> 16) as i32;
        let mix = |a: u8, b: u8| {
            let (a, b) = (i32::from(a), i32::from(b));
            (a + (((b - a) * fraction + (1 << 15)) >> 16)) as u8
        };
        let rgb = self.rgb;
        Rgb888::new(mix(rgb.r(), next.r()), mix(rgb.g(), next.g()), mix(rgb.b(), next.b()))
    }
}

impl<V: Leveled, const N: usize> Palette<V> for Gradient<N> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() { Rgb888::BLACK } else { self.at(value.level()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{gradients, hex};

    /// `|channel - exact|` in hundredths of a step, rounded up, at a level between the stops `p` and `q` of
    /// the greys `c` and `d`.
    fn hundredths((p, c): (u16, u8), (q, d): (u16, u8), level: u16, got: u8) -> i64 {
        let (p, q, c, d) = (i64::from(p), i64::from(q), i64::from(c), i64::from(d));
        let exact = c * (q - p) + (d - c) * (i64::from(level) - p);
        ((i64::from(got) * (q - p) - exact).abs() * 100 + q - p - 1) / (q - p)
    }

    /// A gradient of two greys: down in red, up in green and blue.
    fn between(p: u16, q: u16, [c, d]: [u8; 2]) -> Gradient<2> {
        Gradient::new([
            (Level::from_bits(p), Rgb888::new(c, d, d)),
            (Level::from_bits(q), Rgb888::new(d, c, c)),
        ])
        .unwrap()
    }

    #[test]
    fn a_gradient_stays_within_half_a_step_of_the_exact_line() {
        let mut worst = 0;
        let mut check = |p: u16, q: u16, greys: [u8; 2], level: u16| {
            let rgb = between(p, q, greys).at(Level::from_bits(level));
            let [c, d] = greys;
            worst = worst.max(hundredths((p, c), (q, d), level, rgb.r()));
            worst = worst.max(hundredths((p, d), (q, c), level, rgb.g()));
            assert!(worst <= 51, "{p}..{q}, {greys:?} at {level}: {worst}");
        };
        // every level of narrow spans and of some wide ones
        let wide = [4_095, 8_191, 8_192, 21_845, 32_767, 32_769, 46_341, 57_000, 65_521, 65_534, 65_535];
        for span in (1..=600).chain(wide) {
            let p = (u16::MAX - span) / 2;
            for level in p..=p + span {
                check(p, p + span, [0, 255], level);
                check(p, p + span, [3, 240], level);
            }
        }
        // every span, where a channel is about to change: half a step from a whole one
        for span in 1..=u16::MAX {
            for step in [1, 85, 170, 254, 255_u32] {
                let near = (u32::from(span) * (2 * step - 1) / 510) as u16;
                for level in [near.saturating_sub(1), near, near.saturating_add(1).min(span)] {
                    check(0, span, [0, 255], level);
                    check(u16::MAX - span, u16::MAX, [0, 255], u16::MAX - span + level);
                }
            }
        }
        assert_eq!(worst, 51);
    }

    #[test]
    fn the_gradients_of_the_crate_keep_the_same_bound() {
        fn check<const N: usize>(gradient: Gradient<N>) {
            for pair in gradient.stops.windows(2) {
                let [a, b] = pair else { continue };
                for level in a.at..=b.at {
                    let got = gradient.at(Level::from_bits(level)).g();
                    let off = hundredths((a.at, a.rgb.g()), (b.at, b.rgb.g()), level, got);
                    assert!(off <= 51, "{level}: {off}");
                }
            }
        }
        check(gradients::DUSK);
        check(gradients::FIRE);
        check(gradients::OCEAN);
        check(gradients::MOSS);
        check(gradients::EVEN);
        check(gradients::PORCELAIN);
    }

    #[test]
    fn a_gradient_is_exact_at_its_stops_and_constant_beyond() {
        let stops = [(100_u16, 0x10_u8), (101, 0xff), (700, 0x03), (40_000, 0xf0), (65_000, 0)];
        let gradient =
            Gradient::new(stops.map(|(at, grey)| (Level::from_bits(at), Rgb888::new(grey, 0, 255 - grey))))
                .unwrap();
        for (at, grey) in stops {
            assert_eq!(gradient.at(Level::from_bits(at)), Rgb888::new(grey, 0, 255 - grey));
        }
        assert_eq!(gradient.at(Level::ZERO).r(), 0x10);
        assert_eq!(gradient.at(Level::FULL).r(), 0);
    }

    #[test]
    fn stops_must_increase() {
        let stop = |at| (Level::from_bits(at), Rgb888::BLACK);
        let error = Gradient::new([stop(1), stop(5), stop(5)]).unwrap_err();
        assert_eq!(error, Error::NotIncreasing { what: "stop", index: 2 });
        assert_eq!(std::format!("{error}"), "stop 2 is not to the right of stop 1");
        assert!(matches!(Gradient::<0>::new([]), Err(Error::TooFew { .. })));
    }

    #[test]
    fn even_stops_reach_from_0_to_1() {
        let gradient = Gradient::evenly([hex(0), hex(0x0000ff), hex(0xff0000)]);
        assert_eq!(gradient.at(Level::ZERO), hex(0));
        assert_eq!(gradient.at(Level::from_bits(32768)), hex(0x0000ff));
        assert_eq!(gradient.at(Level::FULL), hex(0xff0000));
        assert_eq!(Gradient::evenly([hex(0x123456)]).at(Level::from_bits(9)), hex(0x123456));
    }
}
