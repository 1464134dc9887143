//! What follows from the maps of a function: its values at the ends, the range of all its values, the length
//! of its longest address.
//!
//! A map is summed up without its polynomial, so that the rest is there once for all degrees.

use super::map::Map;
use super::polynomial::twice_high;
use super::value::{FRACTION_Q55, ONE_UQ63, wide};
use crate::Error;
use crate::num::{quotient, ratio};

/// `2^7` with 55 fractional bits: the values of a function stay below it.
const LIMIT: i64 = 1 << (FRACTION_Q55 + 7);

/// The magnitudes of a map's coefficients add up to less than `2^8`.
const COEFFICIENTS: i64 = i64::MAX;

/// What a map makes of ranges and of its fixed points.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Image {
    /// 63 fractional bits.
    scaling: i64,
    width: u64,
    /// Ends of the range of its polynomial, its values at the ends, the sum of its coefficients' magnitudes:
    /// 55 fractional bits.
    low: i64,
    high: i64,
    first: i64,
    last: i64,
    norm: i64,
}

impl Image {
    #[inline(never)]
    pub(super) fn of<const D: usize>(map: &Map<D>) -> Self {
        let (low, high) = map.q.range();
        Self {
            scaling: map.scaling,
            width: map.width,
            low,
            high,
            first: map.q.constant,
            last: map.q.powers.iter().fold(map.q.constant, |sum, c| sum.wrapping_add(*c)),
            norm: map.q.norm(),
        }
    }

    /// The range of the map's image of a range, both with 16 fractional bits, outward.
    #[inline(never)]
    fn of_range(&self, min: i64, max: i64) -> (i64, i64) {
        let (a, b) = (twice_high(min << 4, self.scaling), twice_high(max << 4, self.scaling));
        let low = ((a.min(b) - 2) >> 4) + (self.low >> COARSE);
        (low, ((a.max(b) + 2 + 15) >> 4) + (self.high >> COARSE) + 1)
    }

    /// Where the map's fixed point lies if its polynomial is `q` there: `q / (1 - scaling)`.
    fn fixed_point(&self, q: i64) -> i64 {
        quotient(q, 63, ONE_UQ63.wrapping_sub(self.scaling as u64))
    }
}

/// What follows from the maps.
#[derive(Default)]
pub(super) struct Bounds {
    /// `y_0` and `y_N`, 55 fractional bits.
    pub(super) first: i64,
    pub(super) last: i64,
    /// Rigorous bounds of the values, 55 fractional bits.
    pub(super) range: (i64, i64),
    /// No address is longer.
    pub(super) levels: u32,
}

impl Bounds {
    /// Checks coefficients and range. Walks of a function whose polynomials are curved end with the scalings.
    #[inline(never)]
    pub(super) fn of(images: &[Image], curved: bool) -> Result<Self, Error> {
        let mut bounds = Self::default();
        let (mut widest, mut steepest, mut largest) = (0, 0, 0);
        for (index, image) in images.iter().enumerate() {
            if image.norm == COEFFICIENTS {
                return Err(too_large(index));
            }
            widest = image.width.max(widest);
            steepest = image.scaling.unsigned_abs().max(steepest);
            largest = image.low.unsigned_abs().max(image.high.unsigned_abs()).max(largest);
        }
        bounds.first = images.first().map_or(0, |image| image.fixed_point(image.first));
        bounds.last = images.last().map_or(0, |image| image.fixed_point(image.last));
        bounds.range = hull(images, largest, steepest);
        let (low, high) = bounds.range;
        let extreme = if low.unsigned_abs() >= LIMIT as u64 { low } else { high };
        if extreme.unsigned_abs() >= LIMIT as u64 {
            return Err(limit("range of the function", None, extreme, LIMIT));
        }
        bounds.levels = levels(if curved { ONE_UQ63 } else { widest }, steepest);
        Ok(bounds)
    }
}

/// What is wrong with coefficients that leave the format.
pub(super) fn too_large(index: usize) -> Error {
    limit("sum of the coefficients of map", Some(index), COEFFICIENTS, COEFFICIENTS)
}

#[cold]
#[inline(never)]
fn limit(what: &'static str, index: Option<usize>, got: i64, allowed: i64) -> Error {
    Error::OutOfRange { what, index, value: wide(got), min: wide(-allowed), max: wide(allowed) }
}

/// The range is found with 16 fractional bits, because the first root may be large.
const COARSE: u32 = FRACTION_Q55 - 16;

/// Bounds of the attractor in `y`: iterates the hull of the images, outward, from a root that contains it.
#[inline(never)]
fn hull(images: &[Image], largest: u64, steepest: u64) -> (i64, i64) {
    // |f| <= max |q| / (1 - max |alpha|)
    let rest = (ONE_UQ63 - steepest) >> 32; // at least 1: scalings have 31 bits, or come from a contraction of such
    let root = ratio((largest >> COARSE) + 2, 31, rest.max(1)).min(1 << 56) as i64;
    let (mut min, mut max) = (-root, root);
    for _ in 0..4096 {
        let (mut low, mut high) = (i64::MAX, i64::MIN);
        for image in images {
            let (below, above) = image.of_range(min, max);
            (low, high) = (low.min(below), high.max(above));
        }
        let settled = low <= min && high >= max;
        (min, max) = (min.max(low), max.min(high));
        if settled {
            break;
        }
    }
    (min.saturating_mul(1 << COARSE), max.saturating_mul(1 << COARSE))
}

/// No walk takes more maps: an evaluation lasts at most 2 ms on a desktop. Every address has settled its
/// value by then where all scalings are below 0.9991, or all intervals narrower than 0.9986 of the domain.
pub(super) const LEVELS: u32 = 1 << 15;

/// After how many maps an address has settled the value: the product of the horizontal factors is below
/// `2^-63` or that of the scalings below `2^-40`. `r^k <= e^(-k (1 - r))`.
fn levels(widest: u64, steepest: u64) -> u32 {
    let steps = |nepers: u64, r: u64| {
        let k = ratio(nepers, 63, ONE_UQ63.saturating_sub(r));
        k.min(u64::from(u32::MAX) - 1) as u32 + 1
    };
    // 63 ln 2 = 43.67, 40 ln 2 = 27.73
    steps(44, widest).min(steps(28, steepest)).min(LEVELS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::polynomial::Polynomial;
    use crate::num::Reciprocal;

    fn image(scaling: i32, constant: i64, power: i64) -> Image {
        Image::of(&Map {
            scaling: i64::from(scaling) << 32,
            q: Polynomial { constant, powers: [power] },
            start: 0,
            width: ONE_UQ63,
            per_width: Reciprocal::of(ONE_UQ63),
        })
    }

    /// Against integers with 79 fractional bits.
    #[test]
    fn an_image_of_a_range_is_outward_by_less_than_three_units() {
        for i in 0..3000_i64 {
            let scaling = (i as i32).wrapping_mul(0x2545_f491) | 1;
            let (min, max) = (-(i * i * 977 % (1 << 23)), i * 7919 % (1 << 23));
            let (min, max) = if i % 3 == 0 { (-max, -min) } else { (min, max) };
            let (min, max) = (min.min(max), min.max(max));
            for (constant, power) in
                [(0, 0), (i << 39, -(i << 40)), (i * 0x1234_5678_9abc, 1 - i), (-i << 39, 1 << 39)]
            {
                let image = image(scaling, constant, power);
                let scaled = [min, max].map(|y| i128::from(y) * i128::from(image.scaling));
                let ends = [constant, constant + power].map(|q| i128::from(q) << 24);
                let least = scaled[0].min(scaled[1]) + ends[0].min(ends[1]);
                let most = scaled[0].max(scaled[1]) + ends[0].max(ends[1]);
                let (low, high) = image.of_range(min, max);
                let [low, high] = [low, high].map(|end| i128::from(end) << 63);
                assert!(low <= least && most <= high, "{scaling} [{min}, {max}] {constant} {power}");
                assert!(least - low < 3 << 63 && high - most < 3 << 63, "{scaling} [{min}, {max}]");
            }
        }
    }

    /// `alpha f + q` at a fixed point: constants have the range of their one value.
    #[test]
    fn a_hull_holds_the_fixed_points_of_its_maps_and_hardly_more() {
        for (scaling, constant) in [(0.5, 1.0), (-0.75, 3.0), (0.96875, -1.5), (0.999, 0.0625)] {
            let scaling = (scaling * 2_f64.powi(31)) as i32;
            let image = image(scaling, (constant * 2_f64.powi(55)) as i64, 0);
            let alpha = f64::from(scaling) / 2_f64.powi(31);
            let exact = constant / (1.0 - alpha);
            let bounds = Bounds::of(&[image], false).unwrap();
            let [low, high] = [bounds.range.0, bounds.range.1].map(|end| end as f64 / 2_f64.powi(55));
            assert!(low <= exact && exact <= high, "{alpha}: {exact} outside [{low}, {high}]");
            assert!(high - low < 2_f64.powi(-8) / (1.0 - alpha.abs()), "{alpha}: [{low}, {high}]");
            assert!((bounds.first as f64 / 2_f64.powi(55) - exact).abs() < 1e-12, "{alpha}");
        }
    }

    #[test]
    fn levels_settle_the_value() {
        for (width, scaling) in [(0.5, 0.9), (0.9, 0.5), (0.99, 0.99), (0.998, 0.999_99), (0.3, 0.999)] {
            let bits = |v: f64| (v * ONE_UQ63 as f64) as u64;
            let levels = f64::from(levels(bits(width), bits(scaling)));
            let settled =
                |levels: f64| levels * -f64::log2(width) >= 63.0 || levels * -f64::log2(scaling) >= 40.0;
            assert!(settled(levels) && levels * (1.0 - f64::max(width, scaling)) < 46.0, "{width} {scaling}");
        }
        assert_eq!(levels(ONE_UQ63 - 1, ONE_UQ63 - 1), LEVELS);
    }

    /// The range of a function ends below 128, the sum of a map's coefficients below 256.
    #[test]
    fn limits_are_where_the_format_ends() {
        let what = |maps: &[Image]| match Bounds::of(maps, false) {
            Ok(_) => None,
            Err(Error::OutOfRange { what, .. }) => Some(what),
            Err(other) => panic!("{other:?}"),
        };
        let one = |constant: i64, power: i64| image(0, constant << 39, power << 39);
        let ends = 1 << 16;
        for sign in [1, -1] {
            // outward by two units of 2^-16
            assert_eq!(what(&[one(sign * (128 * ends - 3), 0)]), None);
            assert_eq!(what(&[one(sign * 128 * ends, 0)]), Some("range of the function"));
            assert_eq!(what(&[one(sign * 100 * ends, sign * -155 * ends)]), None);
            assert_eq!(
                what(&[one(sign * 101 * ends, sign * -155 * ends)]),
                Some("sum of the coefficients of map")
            );
        }
    }

    /// Against the ends that iterating the hull in rationals tends to: `low = min(alpha_j end) + low_j`,
    /// outward by what 16 fractional bits lose.
    #[test]
    fn a_hull_is_outward_by_three_units_over_one_less_the_scaling() {
        for k in 0..300_i32 {
            let scalings = [k.wrapping_mul(0x2545_f491), k.wrapping_mul(0x6c07_8965) >> (k % 4)];
            let maps = [
                image(scalings[0], i64::from(k) << 45, i64::from(k % 11) << 52),
                image(scalings[1], -(i64::from(k % 7) << 52), i64::from(k) << 40),
            ];
            let Ok(bounds) = Bounds::of(&maps, false) else { continue };
            let (mut low, mut high) = (0.0_f64, 0.0_f64);
            let real = |v: i64| v as f64 / 2_f64.powi(55);
            for _ in 0..200_000 {
                let images = maps.map(|m| {
                    let alpha = m.scaling as f64 / 2_f64.powi(63);
                    let (a, b) = (alpha * low, alpha * high);
                    (a.min(b) + real(m.low), a.max(b) + real(m.high))
                });
                let next = (images[0].0.min(images[1].0), images[0].1.max(images[1].1));
                if next == (low, high) {
                    break;
                }
                (low, high) = next;
            }
            let steepest =
                maps.iter().map(|m| m.scaling.unsigned_abs() as f64 / 2_f64.powi(63)).fold(0.0, f64::max);
            let slack = 3.0 * 2_f64.powi(-16) / (1.0 - steepest) + 1e-9;
            let (got_low, got_high) = (real(bounds.range.0), real(bounds.range.1));
            assert!(got_low <= low + 1e-9 && got_low >= low - slack, "{k}: {got_low} against {low}, {slack}");
            assert!(
                got_high >= high - 1e-9 && got_high <= high + slack,
                "{k}: {got_high} against {high}, {slack}"
            );
        }
    }

    /// `44 / (1 - a)` maps or `28 / (1 - alpha)`, and one: for the widest and the steepest, wherever they
    /// stand.
    #[test]
    fn levels_count_the_widest_and_the_steepest_map() {
        assert_eq!((levels(ONE_UQ63 / 2, ONE_UQ63 - 1), levels(ONE_UQ63 - 1, ONE_UQ63 / 2)), (89, 57));
        assert_eq!((levels(ONE_UQ63 / 4 * 3, ONE_UQ63 - 1), levels(ONE_UQ63 / 2, ONE_UQ63 / 2)), (177, 57));
        let wide = |width: u64, scaling: i32| Image { width, ..image(scaling, 0, 0) };
        let (a, b) = (wide(ONE_UQ63 / 4 * 3, i32::MAX - (1 << 29)), wide(ONE_UQ63 / 4, 1 << 20));
        for maps in [[a, b], [b, a]] {
            // a scaling just below 3/4
            assert_eq!(Bounds::of(&maps, false).unwrap().levels, 28 * 4);
        }
    }
}
