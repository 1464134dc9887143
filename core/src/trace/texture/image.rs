//! A picture on a surface: an array of texels in flash.
//!
//! A place of the picture is asked for by `u`, to the right, and `v`, upwards, each from 0 to 1; row 0 is the
//! uppermost. From pixel to texel is the order of the text's inverse scanning: a pixel's area is brought to
//! texture space, and the mean over it is taken. All three ways to look are the mean over a box:
//! - nearest: the texel at the place;
//! - bilinear: the mean over a box as large as a texel, which is bilinear interpolation;
//! - by area: the mean over a box as large as the ray's footprint, its cone's width over `|P_u|` and `|P_v|`.
//!   An image that has coarser levels behind it, each half as large as the one before, is looked up in the
//!   level where the box is less than two texels wide: at most 4 times 4 of them, however far away the
//!   surface is.
//!
//! Source: the course unit V, section 5.8.1; L. Williams, "Pyramidal parametrics", 1983, for the levels.
//!
//! Format: places in texels of level 0 with 16 fractional bits; light 16. Bytes are codes of the sRGB curve.

use super::super::surface::SurfacePoint;
use super::field::Texture;
use crate::Error;
use crate::num::{Lumen, Real, Rgb, Vec3, Wide, reciprocal, reciprocal_sqrt_of, square};

/// What the bytes of a texel are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Texels {
    /// One byte, a grey.
    Grey,
    /// One byte, a height or another number: linear, 255 is 1.
    Linear,
    /// Three bytes: red, green, blue.
    Rgb888,
    /// Two bytes, the lower one first: 5 bits red, 6 green, 5 blue.
    Rgb565,
}

/// How an image is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Lookup {
    /// The texel at the place.
    Nearest,
    /// Bilinear interpolation.
    Bilinear,
    /// The mean over the ray's footprint.
    Area,
}

/// What is beyond an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Beyond {
    /// The image again.
    Repeat,
    /// Its edge.
    Edge,
}

/// An image in lent memory. Size: 48 bytes on a 32-bit machine at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Image<'a> {
    bytes: &'a [u8],
    texels: Texels,
    columns: u32,
    rows: u32,
    levels: u32,
    lookup: Lookup,
    beyond: [Beyond; 2],
}

/// Texels of one axis that a box covers, and how much of the box each has, 16 fractional bits.
type Shares = [(u32, u32); 4];

impl<'a> Image<'a> {
    /// The most texels a side.
    pub const MAX_SIDE: u32 = 1 << 13;

    /// An image of `columns` times `rows` texels, row by row from the top, with as many of its coarser levels
    /// behind it as there are bytes: see [`Image::length`]. It is looked at by area and repeated.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a side of 0 or above [`Image::MAX_SIDE`], [`Error::LengthMismatch`] for a
    /// length that is not that of any number of levels.
    pub fn new(texels: Texels, columns: u32, rows: u32, bytes: &'a [u8]) -> Result<Self, Error> {
        for (what, side) in [("columns of the image", columns), ("rows of the image", rows)] {
            if side == 0 || side > Self::MAX_SIDE {
                let value = Wide::saturating_from_num(side);
                let max = Wide::saturating_from_num(Self::MAX_SIDE);
                return Err(Error::OutOfRange { what, index: None, value, min: Wide::ONE, max });
            }
        }
        let length = |levels| Self::length(texels, columns, rows, levels);
        let Some(levels) = (1..=Self::levels_of(columns, rows)).find(|k| length(*k) == bytes.len()) else {
            let (given, expected) = (bytes.len(), length(1));
            return Err(Error::LengthMismatch { what: "bytes of the image", given, expected });
        };
        let beyond = [Beyond::Repeat; 2];
        Ok(Self { bytes, texels, columns, rows, levels, lookup: Lookup::Area, beyond })
    }

    /// The same, looked at in another way.
    #[must_use]
    pub const fn with_lookup(self, lookup: Lookup) -> Self {
        Self { lookup, ..self }
    }

    /// The same with something else beyond its sides, and above and below it.
    #[must_use]
    pub const fn with_beyond(self, across: Beyond, up: Beyond) -> Self {
        Self { beyond: [across, up], ..self }
    }

    /// Columns and rows.
    pub const fn size(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }

    /// How many levels there are down to a single texel.
    pub fn levels_of(columns: u32, rows: u32) -> u32 {
        33 - columns.max(rows).max(1).saturating_sub(1).leading_zeros()
    }

    /// How many bytes an image with so many levels has.
    pub fn length(texels: Texels, columns: u32, rows: u32, levels: u32) -> usize {
        let texel_count: u64 = (0..levels.min(32)).map(|k| side(columns, k) * side(rows, k)).sum();
        usize::try_from(texel_count * texels.bytes() as u64).unwrap_or(usize::MAX)
    }

    /// Writes the coarser levels behind level 0: each texel is the mean of up to four of the level before, in
    /// linear light. For the host, or for a buffer that is filled once.
    ///
    /// # Errors
    /// As [`Image::new`].
    pub fn write_levels(texels: Texels, columns: u32, rows: u32, bytes: &mut [u8]) -> Result<(), Error> {
        let levels = Image::new(texels, columns, rows, bytes)?.levels;
        let stride = texels.bytes();
        for k in 1..levels {
            let (before, start) =
                (Self::length(texels, columns, rows, k - 1), Self::length(texels, columns, rows, k));
            let (fine, coarse) = bytes.split_at_mut_checked(start).unwrap_or_default();
            let fine = fine.get(before..).unwrap_or_default();
            let [wide, high] = [side(columns, k - 1), side(rows, k - 1)];
            for (index, texel) in (0..side(columns, k) * side(rows, k)).zip(coarse.chunks_exact_mut(stride)) {
                let width = side(columns, k).max(1);
                let (i, j) =
                    (2 * index.checked_rem(width).unwrap_or(0), 2 * index.checked_div(width).unwrap_or(0));
                let (mut sum, mut count) = ([0_u32; 3], 0_u32);
                for (i, j) in [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)] {
                    if i < wide && j < high {
                        let light = texels.light(fine, (j * wide + i) as usize);
                        sum = core::array::from_fn(|c| sum.get(c).unwrap_or(&0) + light.get(c).unwrap_or(&0));
                        count += 1;
                    }
                }
                texels.write(sum.map(|c| (c + count / 2).checked_div(count).unwrap_or(0)), texel);
            }
        }
        Ok(())
    }

    /// The mean over a box round `(u, v)` that is `across` wide and `up` high, all in parts of the image.
    ///
    /// Domain: all; a box is at most as large as the image, and without coarser levels at most two texels
    /// wide. Error: below `2^-14` where the box is 1 to 2 texels wide and high
    /// (`the_mean_over_a_box_is_the_exact_one`); coarser levels have been rounded to bytes. Cost: at most 16
    /// texels.
    pub fn mean(&self, u: Real, v: Real, across: Real, up: Real) -> Rgb {
        let wide = [texels_of(across, self.columns), texels_of(up, self.rows)];
        let wide = wide.map(|width| width.max(1 << 16));
        let wanted = (wide[0].max(wide[1]) >> 16).max(1);
        let level = (31 - wanted.leading_zeros()).min(self.levels - 1);
        let columns = shares(u, self.columns, wide[0], level, self.beyond[0]);
        let down = Real::ONE.saturating_sub(v);
        let rows = shares(down, self.rows, wide[1], level, self.beyond[1]);
        let start = Self::length(self.texels, self.columns, self.rows, level);
        let bytes = self.bytes.get(start..).unwrap_or_default();
        let row = side(self.columns, level);
        let mut sum = [0_u64; 3];
        for (j, high) in rows.into_iter().filter(|share| share.1 > 0) {
            for (i, wide) in columns.into_iter().filter(|share| share.1 > 0) {
                let light = self.texels.light(bytes, (u64::from(j) * row) as usize + i as usize);
                let part = u64::from(high) * u64::from(wide);
                for (sum, light) in sum.iter_mut().zip(light) {
                    *sum += part * u64::from(light);
                }
            }
        }
        // parts have 32 fractional bits, and add up to 1
        let [r, g, b] = sum.map(|c| Lumen::from_bits(((c + (1 << 31)) >> 32) as u32));
        Rgb::new(r, g, b)
    }

    /// The texel at a place.
    pub fn nearest(&self, u: Real, v: Real) -> Rgb {
        let index = |c: Real, count: u32, beyond| (place(c, count, beyond) >> 16).min(count - 1);
        let i = index(u, self.columns, self.beyond[0]);
        // the lower edge of a texel is its own: `1 - v` is rounded down from above
        let down = Real::ONE.saturating_sub(v).saturating_sub(Real::DELTA);
        let j = index(down, self.rows, self.beyond[1]);
        let [r, g, b] = self.texels.light(self.bytes, (j * self.columns + i) as usize).map(Lumen::from_bits);
        Rgb::new(r, g, b)
    }
}

impl Texture for Image<'_> {
    fn is_charted(&self) -> bool {
        true
    }

    fn at(&self, point: &SurfacePoint) -> Rgb {
        let chart = &point.chart;
        match self.lookup {
            Lookup::Nearest => self.nearest(chart.u, chart.v),
            Lookup::Bilinear => self.mean(chart.u, chart.v, Real::ZERO, Real::ZERO),
            Lookup::Area => {
                let [across, up] = [chart.along_u, chart.along_v].map(|along| footprint(point.width, along));
                self.mean(chart.u, chart.v, across, up)
            }
        }
    }
}

/// The part of a texture coordinate's unit that a ray covers: its width over the length of `P_u` or `P_v`; 1
/// where it is more.
pub(super) fn footprint(width: Real, along: Vec3) -> Real {
    let (mantissa, half) = reciprocal_sqrt_of(square([along.x, along.y, along.z].map(Real::to_bits)));
    let width = u64::from(width.to_bits().unsigned_abs());
    // over a length in the same format: 31 + half fractional bits, to 24
    let part = (width * u64::from(mantissa.unsigned_abs())) >> (7 + (half & 31));
    Real::from_bits(part.min(1 << 24) as i32)
}

/// How many texels a side of a level has.
fn side(count: u32, level: u32) -> u64 {
    let level = level & 31;
    (u64::from(count) + (1 << level) - 1) >> level
}

/// A part of the image in texels, at most all of them.
fn texels_of(part: Real, count: u32) -> u32 {
    let part = part.clamp(Real::ZERO, Real::ONE).to_bits().unsigned_abs();
    ((u64::from(part) * u64::from(count)) >> 8) as u32
}

/// A place in texels, within the image.
fn place(coordinate: Real, count: u32, beyond: Beyond) -> u32 {
    let part = match beyond {
        Beyond::Repeat => coordinate.to_bits() as u32 & 0xff_ffff,
        Beyond::Edge => coordinate.clamp(Real::ZERO, Real::ONE).to_bits().unsigned_abs(),
    };
    ((u64::from(part) * u64::from(count)) >> 8) as u32
}

/// The texels that a box covers: at most four, since it is less than two wide, and of those at an edge of the
/// image one may be a part only.
fn shares(middle: Real, count: u32, width: u32, level: u32, beyond: Beyond) -> Shares {
    let (whole, level) = (count << 16, level & 15);
    let texel = 1_u32 << (16 + level);
    let width = width.max(texel).min(2 * texel - 1).min(whole);
    let middle = place(middle, count, beyond);
    let mut from = match beyond {
        Beyond::Repeat if middle < width / 2 => middle + whole - width / 2,
        Beyond::Repeat => middle - width / 2,
        Beyond::Edge => middle.max(width / 2).min(whole - width + width / 2) - width / 2,
    };
    from = if from >= whole { from - whole } else { from };
    let (mantissa, shift) = reciprocal(width);
    let (mut shares, mut left, mut rest) = ([(0, 0); 4], width, 1_u32 << 16);
    for (index, (texel_index, share)) in shares.iter_mut().enumerate() {
        *texel_index = from >> (16 + level);
        let end = ((*texel_index + 1) << (16 + level)).min(whole);
        let covered = left.min(end - from);
        left -= covered;
        // the last one takes what is left
        let exact = ((u64::from(covered) * u64::from(mantissa)) >> (shift - 16)) as u32;
        *share = if left == 0 || index == 3 { rest } else { exact.min(rest) };
        rest -= *share;
        from = if end == whole { 0 } else { end };
    }
    shares
}

impl Texels {
    /// How many bytes a texel has.
    pub const fn bytes(self) -> usize {
        match self {
            Self::Grey | Self::Linear => 1,
            Self::Rgb565 => 2,
            Self::Rgb888 => 3,
        }
    }

    /// The light of a texel, 16 fractional bits; none beyond the bytes.
    fn light(self, bytes: &[u8], index: usize) -> [u32; 3] {
        let byte = |k: usize| {
            bytes.get(index.wrapping_mul(self.bytes()).wrapping_add(k)).copied().unwrap_or_default()
        };
        match self {
            Self::Grey => [decoded(byte(0)); 3],
            Self::Linear => [u32::from(byte(0)) * 257 + u32::from(byte(0) >> 7); 3],
            Self::Rgb888 => [decoded(byte(0)), decoded(byte(1)), decoded(byte(2))],
            Self::Rgb565 => {
                let [low, high] = [byte(0), byte(1)];
                let (r, g, b) = (high >> 3, (high & 7) << 3 | low >> 5, low & 31);
                [decoded(r << 3 | r >> 2), decoded(g << 2 | g >> 4), decoded(b << 3 | b >> 2)]
            }
        }
    }

    /// The texel of the nearest codes.
    fn write(self, light: [u32; 3], texel: &mut [u8]) {
        let [r, g, b] = light;
        let codes = match self {
            Self::Grey => [encoded(g, 8), 0, 0],
            Self::Linear => [((g * 255 + (1 << 15)) >> 16) as u8, 0, 0],
            Self::Rgb888 => [encoded(r, 8), encoded(g, 8), encoded(b, 8)],
            Self::Rgb565 => {
                let (r, g, b) = (encoded(r, 5), encoded(g, 6), encoded(b, 5));
                [g << 5 | b, r << 3 | g >> 3, 0]
            }
        };
        for (byte, code) in texel.iter_mut().zip(codes) {
            *byte = code;
        }
    }
}

/// The light of a code, 16 fractional bits.
fn decoded(code: u8) -> u32 {
    let light = u32::from(LIGHT.get(usize::from(code)).copied().unwrap_or(u16::MAX));
    light + (light >> 15)
}

/// The code of so many bits with the nearest light.
fn encoded(light: u32, bits: u32) -> u8 {
    let codes = 0..1_u32 << (bits & 15).min(8);
    // all bits again below the last one, as a display does
    let code = |c: u32| (c << (8 - bits) | c >> (2 * bits - 8)) as u8;
    codes.min_by_key(|c| decoded(code(*c)).abs_diff(light)).unwrap_or(0) as u8
}

/// `65535 L(code / 255)` of the sRGB curve (IEC 61966-2-1), to the nearest.
static LIGHT: [u16; 256] = [
    0, 20, 40, 60, 80, 99, 119, 139, 159, 179, 199, 219, 241, 264, 288, 313, 340, 367, 396, 427, 458, 491,
    526, 562, 599, 637, 677, 718, 761, 805, 851, 898, 947, 997, 1048, 1101, 1156, 1212, 1270, 1330, 1391,
    1453, 1517, 1583, 1651, 1720, 1790, 1863, 1937, 2013, 2090, 2170, 2250, 2333, 2418, 2504, 2592, 2681,
    2773, 2866, 2961, 3058, 3157, 3258, 3360, 3464, 3570, 3678, 3788, 3900, 4014, 4129, 4247, 4366, 4488,
    4611, 4736, 4864, 4993, 5124, 5257, 5392, 5530, 5669, 5810, 5953, 6099, 6246, 6395, 6547, 6700, 6856,
    7014, 7174, 7335, 7500, 7666, 7834, 8004, 8177, 8352, 8528, 8708, 8889, 9072, 9258, 9445, 9635, 9828,
    10022, 10219, 10417, 10619, 10822, 11028, 11235, 11446, 11658, 11873, 12090, 12309, 12530, 12754, 12980,
    13209, 13440, 13673, 13909, 14146, 14387, 14629, 14874, 15122, 15371, 15623, 15878, 16135, 16394, 16656,
    16920, 17187, 17456, 17727, 18001, 18277, 18556, 18837, 19121, 19407, 19696, 19987, 20281, 20577, 20876,
    21177, 21481, 21787, 22096, 22407, 22721, 23038, 23357, 23678, 24002, 24329, 24658, 24990, 25325, 25662,
    26001, 26344, 26688, 27036, 27386, 27739, 28094, 28452, 28813, 29176, 29542, 29911, 30282, 30656, 31033,
    31412, 31794, 32179, 32567, 32957, 33350, 33745, 34143, 34544, 34948, 35355, 35764, 36176, 36591, 37008,
    37429, 37852, 38278, 38706, 39138, 39572, 40009, 40449, 40891, 41337, 41785, 42236, 42690, 43147, 43606,
    44069, 44534, 45002, 45473, 45947, 46423, 46903, 47385, 47871, 48359, 48850, 49344, 49841, 50341, 50844,
    51349, 51858, 52369, 52884, 53401, 53921, 54445, 54971, 55500, 56032, 56567, 57105, 57646, 58190, 58737,
    59287, 59840, 60396, 60955, 61517, 62082, 62650, 63221, 63795, 64372, 64952, 65535,
];

#[cfg(test)]
mod tests {
    use super::super::testing::charted;
    use super::*;
    use std::vec::Vec;

    #[test]
    fn the_light_of_a_code_is_that_of_the_curve() {
        for code in 0..=255_u8 {
            let v = f64::from(code) / 255.0;
            let light = if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
            assert!((f64::from(decoded(code)) - light * 65536.0).abs() <= 1.0, "{code}");
            assert_eq!(encoded(decoded(code), 8), code);
        }
        assert_eq!((decoded(0), decoded(255)), (0, 1 << 16));
    }

    /// Linear bytes, to tell positions apart.
    fn bytes(columns: u32, rows: u32) -> Vec<u8> {
        (0..columns * rows).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect()
    }

    /// Against the sum over all texels in floating point, the image repeated.
    #[test]
    fn the_mean_over_a_box_is_the_exact_one() {
        let (columns, rows) = (7_u32, 5_u32);
        let bytes = bytes(columns, rows);
        let image = Image::new(Texels::Linear, columns, rows, &bytes).unwrap();
        let cover = |middle: f64, width: f64, count: u32, i: u32| -> f64 {
            (-2..3)
                .map(|turn| {
                    let (low, high) = (f64::from(i) + f64::from(turn * count as i32), 1.0);
                    ((middle + width / 2.0).min(low + high) - (middle - width / 2.0).max(low)).max(0.0)
                        / width
                })
                .sum()
        };
        let mut worst: f64 = 0.0;
        for n in 0..3000_u32 {
            let [u, v] = [n.wrapping_mul(0x9e37_79b9), n.wrapping_mul(0x85eb_ca6b)]
                .map(|c| Real::from_bits(c as i32 >> 4));
            let [wide, high] = [1.0 + f64::from(n % 17) / 17.5, 1.0 + f64::from(n % 23) / 23.5];
            let part = |width: f64, count: u32| Real::from_num(width / f64::from(count));
            let got = image.mean(u, v, part(wide, columns), part(high, rows)).g.to_num::<f64>();
            let (x, y) =
                (u.to_num::<f64>().rem_euclid(1.0) * 7.0, (1.0 - v.to_num::<f64>()).rem_euclid(1.0) * 5.0);
            let mut exact = 0.0;
            for j in 0..rows {
                for i in 0..columns {
                    let share = cover(x, wide, columns, i) * cover(y, high, rows, j);
                    exact += share * f64::from(bytes[(j * columns + i) as usize]) / 255.0;
                }
            }
            worst = worst.max((got - exact).abs());
        }
        assert!(worst > 2_f64.powi(-18) && worst < 2_f64.powi(-14), "{worst:e}");
    }

    #[test]
    fn the_nearest_texel_and_bilinear_interpolation_agree_at_the_middles() {
        let bytes = bytes(6, 4);
        for beyond in [Beyond::Repeat, Beyond::Edge] {
            let image = Image::new(Texels::Linear, 6, 4, &bytes).unwrap().with_beyond(beyond, beyond);
            for (i, j) in (0..4).flat_map(|j| (0..6).map(move |i| (i, j))) {
                let middle = |k: u32, count: u32| Real::from_num((f64::from(k) + 0.5) / f64::from(count));
                let point = charted(middle(i, 6), middle(3 - j, 4));
                let texel = f64::from(bytes[(j * 6 + i) as usize]) / 255.0;
                for lookup in [Lookup::Nearest, Lookup::Bilinear, Lookup::Area] {
                    let got = image.with_lookup(lookup).at(&point).r.to_num::<f64>();
                    assert!((got - texel).abs() < 1e-4, "{i} {j} {lookup:?}: {got} {texel}");
                }
            }
        }
        // beyond an edge: the other side, or the edge again
        let at = |beyond, u: f64| {
            let image = Image::new(Texels::Linear, 6, 4, &bytes).unwrap().with_beyond(beyond, Beyond::Repeat);
            image.mean(Real::from_num(u), Real::from_num(0.125), Real::ZERO, Real::ZERO).g.to_num::<f64>()
                * 255.0
        };
        let [first, last] = [18, 23].map(|i: usize| f64::from(bytes[i]));
        assert!((at(Beyond::Repeat, 0.0) - (first + last) / 2.0).abs() < 0.02);
        assert!((at(Beyond::Edge, -3.0) - first).abs() < 0.02 && (at(Beyond::Edge, 1.0) - last).abs() < 0.02);
    }

    /// A footprint as large as the image shows its mean, one of a quarter the mean of that quarter.
    #[test]
    fn coarser_levels_are_means_and_a_far_surface_shows_them() {
        for (columns, rows) in [(8_u32, 8_u32), (13, 6), (1, 5), (1, 1)] {
            let levels = Image::levels_of(columns, rows);
            let length = Image::length(Texels::Linear, columns, rows, levels);
            let mut chain = bytes(columns, rows);
            let mean = chain.iter().map(|b| f64::from(*b)).sum::<f64>() / f64::from(columns * rows) / 255.0;
            chain.resize(length, 0);
            Image::write_levels(Texels::Linear, columns, rows, &mut chain).unwrap();
            let image = Image::new(Texels::Linear, columns, rows, &chain).unwrap();
            assert_eq!(image.size(), [columns, rows]);
            let far = SurfacePoint {
                width: Real::from_num(1.5),
                ..charted(Real::from_num(0.3), Real::from_num(0.6))
            };
            let got = image.at(&far).g.to_num::<f64>();
            // of 13 columns the last texel of each level is narrower than it counts
            let off = if columns == 13 { 0.06 } else { 0.02 };
            assert!((got - mean).abs() < off, "{columns} {rows}: {got} {mean}");
            if columns == 8 {
                let quarter = image.mean(
                    Real::from_num(0.25),
                    Real::from_num(0.75),
                    Real::from_num(0.5),
                    Real::from_num(0.5),
                );
                let exact: f64 =
                    (0..16).map(|i| f64::from(chain[i / 4 * 8 + i % 4])).sum::<f64>() / 16.0 / 255.0;
                assert!((quarter.g.to_num::<f64>() - exact).abs() < 0.01, "{quarter:?} {exact}");
            }
        }
        // a constant is one at every width
        for texels in [Texels::Grey, Texels::Rgb888, Texels::Rgb565] {
            let mut chain = std::vec![0x77; Image::length(texels, 5, 9, 1)];
            chain.resize(Image::length(texels, 5, 9, Image::levels_of(5, 9)), 0);
            Image::write_levels(texels, 5, 9, &mut chain).unwrap();
            let image = Image::new(texels, 5, 9, &chain).unwrap();
            let near = image.nearest(Real::from_num(0.1), Real::from_num(0.1));
            for n in 0..200 {
                let width = Real::from_num(f64::from(n) / 199.0);
                assert_eq!(
                    image.mean(Real::from_num(0.37), Real::from_num(-0.9), width, width),
                    near,
                    "{texels:?} {n}"
                );
            }
        }
    }

    #[test]
    fn the_footprint_is_the_width_over_the_length_of_the_tangent() {
        for (width, along) in
            [(0.01, [3.0, 4.0, 0.0]), (0.5, [0.001, 0.0, 0.0]), (0.25, [0.0, 0.0, -100.0]), (1.0, [0.0; 3])]
        {
            let [x, y, z] = along.map(Real::from_num);
            let length = along.iter().map(|c| c * c).sum::<f64>().sqrt();
            let got = footprint(Real::from_num(width), Vec3::new(x, y, z)).to_num::<f64>();
            assert!((got - (width / length).min(1.0)).abs() < 1e-6, "{width} {along:?}: {got}");
        }
    }

    #[test]
    fn images_without_size_or_with_another_length_are_refused() {
        let bytes = [0; 3 * 35];
        let refused = |columns, rows, length: usize| {
            Image::new(Texels::Rgb888, columns, rows, &bytes[..length]).unwrap_err()
        };
        assert!(matches!(refused(0, 5, 0), Error::OutOfRange { what: "columns of the image", .. }));
        assert!(matches!(
            refused(3, Image::MAX_SIDE + 1, 9),
            Error::OutOfRange { what: "rows of the image", .. }
        ));
        assert!(matches!(refused(5, 4, 59), Error::LengthMismatch { given: 59, expected: 60, .. }));
        // 5 x 4, 3 x 2, 2 x 1, 1 x 1
        let levels =
            |length: usize| Image::new(Texels::Rgb888, 5, 4, &bytes[..3 * length]).map(|image| image.levels);
        assert_eq!([20, 26, 28, 29].map(levels), [Ok(1), Ok(2), Ok(3), Ok(4)]);
        assert!(levels(30).is_err());
        assert_eq!([1, 2, 3, 4, 5, 8, 9].map(|n| Image::levels_of(n, 1)), [1, 2, 3, 3, 4, 4, 5]);
    }
}
