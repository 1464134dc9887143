//! What follows from the maps of a function: its values at the ends, the range of all its values, the length of its longest address.
//!
//! Loops over slices, out of line: a function of two maps would else have every one of them twice.

use super::function::{Map, twice_high, wide};
use crate::Error;
use crate::num::{FRACTION, ONE, quotient, ratio};

/// `2^7` with 55 fractional bits: the values of a function stay below it.
const LIMIT: i64 = 1 << (FRACTION + 7);

/// The magnitudes of a map's coefficients add up to less than `2^8`.
const COEFFICIENTS: i64 = i64::MAX;

/// What a map makes of the range: a scaling with 63, both ends of the range of its polynomial with 16 fractional bits.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Image {
    scaling: i64,
    low: i64,
    high: i64,
}

/// What follows from the maps.
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
    /// Checks coefficients and range. A single map becomes that of its fixed point. `images` are as many as the maps.
    #[inline(never)]
    pub(super) fn of<const D: usize>(maps: &mut [Map<D>], images: &mut [Image]) -> Result<Self, Error> {
        if let [only] = maps {
            // N = 1: f = alpha f + q at the same abscissa, so f = q / (1 - alpha)
            let rest = less(only.scaling);
            for c in only.q.powers.iter_mut().chain([&mut only.q.constant]) {
                *c = quotient(*c, 63, rest);
            }
            only.scaling = 0;
        }
        let (mut widest, mut steepest) = (0, 0);
        for (index, (map, image)) in maps.iter().zip(images.iter_mut()).enumerate() {
            if map.q.norm() == COEFFICIENTS {
                return Err(limit("coefficients of map", index, COEFFICIENTS, COEFFICIENTS));
            }
            let (low, high) = map.q.range();
            *image = Image { scaling: map.scaling, low: low >> COARSE, high: (high >> COARSE) + 1 };
            widest = map.width.max(widest);
            steepest = map.scaling.unsigned_abs().max(steepest);
        }
        let range = hull(images, steepest);
        for extreme in [range.0, range.1] {
            if extreme.saturating_abs() >= LIMIT {
                return Err(limit("range of the function", 0, extreme, LIMIT));
            }
        }
        let fixed_point = |map: &Map<D>, u: u64| quotient(map.q.at(u), 63, less(map.scaling));
        Ok(Self {
            first: maps.first().map_or(0, |map| fixed_point(map, 0)),
            last: maps.last().map_or(0, |map| fixed_point(map, ONE)),
            range,
            levels: levels(widest, steepest),
        })
    }
}

/// What is wrong with coefficients that leave the format.
pub(super) fn too_large(index: usize) -> Error {
    limit("coefficients of map", index, COEFFICIENTS, COEFFICIENTS)
}

#[cold]
#[inline(never)]
fn limit(what: &'static str, index: usize, got: i64, allowed: i64) -> Error {
    Error::OutOfRange { what, index, value: wide(got), min: wide(-allowed), max: wide(allowed) }
}

/// `1 - scaling`, 63 fractional bits.
fn less(scaling: i64) -> u64 {
    ONE.wrapping_sub(scaling as u64)
}

/// The range is found with 16 fractional bits, because the first root may be large.
const COARSE: u32 = FRACTION - 16;

/// Bounds of the attractor in `y`: iterates the hull of the images, outward, from a root that contains it.
#[inline(never)]
fn hull(images: &[Image], steepest: u64) -> (i64, i64) {
    // |f| <= max |q| / (1 - max |alpha|)
    let mut largest = 0;
    for image in images {
        largest = image.low.unsigned_abs().max(image.high.unsigned_abs()).max(largest);
    }
    let rest = (ONE - steepest) >> 32; // at least 1: scalings have 31 bits, or come from a contraction of such
    let root = ratio(largest + 1, 31, rest.max(1)).min(1 << 56) as i64;
    let (mut min, mut max) = (-root, root);
    for _ in 0..4096 {
        let (mut low, mut high) = (i64::MAX, i64::MIN);
        for image in images {
            let (a, b) = (twice_high(min << 4, image.scaling), twice_high(max << 4, image.scaling));
            low = low.min(((a.min(b) - 2) >> 4) + image.low);
            high = high.max(((a.max(b) + 2 + 15) >> 4) + image.high);
        }
        let settled = low <= min && high >= max;
        (min, max) = (min.max(low), max.min(high));
        if settled {
            break;
        }
    }
    (min.saturating_mul(1 << COARSE), max.saturating_mul(1 << COARSE))
}

/// After how many maps an address has settled the value: the product of the horizontal factors is below `2^-62` or that of the scalings
/// below `2^-40`. `r^k <= e^(-k (1 - r))`.
fn levels(widest: u64, steepest: u64) -> u32 {
    let steps = |nepers: u64, r: u64| {
        let k = ratio(nepers, 63, ONE.saturating_sub(r));
        k.min(u64::from(u32::MAX) - 1) as u32 + 1
    };
    // 62 ln 2 = 42.98, 40 ln 2 = 27.73
    steps(43, widest).min(steps(28, steepest))
}
