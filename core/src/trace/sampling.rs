//! Where in a pixel rays are cast, and what each counts (eq. 52-53).

use super::environment::between;
use crate::Error;
use crate::num::{Real, Unit, Wide, exp_minus, nth, quotient};

/// How many samples a pixel gets, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Sampling {
    /// One ray through the centre.
    Centre,
    /// `n x n` rays through the centres of equal parts, `n` from 1 to 8.
    Grid(u8),
    /// `n x n` rays, each at random in its part; the same for the same seed and pixel.
    Jittered {
        /// Parts a side, 1 to 8.
        n: u8,
        /// Selects one of 2^32 patterns.
        seed: u32,
    },
}

/// The weight `w(u, v)` of the samples of a pixel; its sum is 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Filter {
    /// Equal weights over the pixel.
    Box,
    /// Weights fall off with the distance `r` of a part's centre from the pixel's,
    /// `e^(-r^2 / (2 deviation^2))`, over an area `width` pixels wide.
    Gaussian {
        /// Standard deviation in pixels, 1/8 to 4.
        deviation: Real,
        /// Side of the area in pixels, 1 to 4.
        width: Real,
    },
}

impl Filter {
    /// Within how many pixels of the pixel samples lie, rounded up.
    pub(crate) fn margin(self) -> i64 {
        match self {
            Self::Box => 0,
            // half of what is beyond the pixel's own width
            Self::Gaussian { width, .. } => i64::from(((width - Real::ONE) / 2).ceil().to_num::<i32>()),
        }
    }
}

/// Most parts a side.
const MOST: usize = 8;

/// Samples and weights, ready for use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Pattern {
    /// Place of a part's centre from the pixel's centre, in pixels, 24 fractional bits, and weight of its row
    /// or column, 30 bits.
    parts: [(i32, i32); MOST],
    /// Parts a side.
    count: u8,
    /// Side of a part in pixels, 24 fractional bits.
    side: i32,
    seed: Option<u32>,
}

impl Pattern {
    /// One sample in the centre: [`Sampling::Centre`] with [`Filter::Box`].
    pub(crate) const CENTRE: Self = {
        let mut parts = [(0, 0); MOST];
        parts[0] = (0, Unit::ONE.to_bits());
        Self { parts, count: 1, side: Real::ONE.to_bits(), seed: None }
    };

    pub(crate) fn new(sampling: Sampling, filter: Filter) -> Result<Self, Error> {
        let (n, seed) = match sampling {
            Sampling::Centre => (1, None),
            Sampling::Grid(n) => (n, None),
            Sampling::Jittered { n, seed } => (n, Some(seed)),
        };
        between("samples a side", None, Wide::from_num(n), Wide::ONE, Wide::from_num(MOST as u8))?;
        let width = match filter {
            Filter::Box => Real::ONE,
            Filter::Gaussian { deviation, width } => {
                between(
                    "deviation of the filter",
                    None,
                    deviation.into(),
                    Wide::ONE >> 3,
                    Wide::from_num(4),
                )?;
                between("width of the filter", None, width.into(), Wide::ONE, Wide::from_num(4))?;
                width
            }
        };
        let (count, width) = (i64::from(n), i64::from(width.to_bits()));
        let mut parts = [(0, 0); MOST];
        let mut sum = 0;
        for (i, part) in (0..count).zip(&mut parts) {
            let place = nth(width * (2 * i + 1 - count), 2 * u32::from(n));
            let weight = match filter {
                Filter::Box => Unit::ONE,
                Filter::Gaussian { deviation, .. } => {
                    // (place / deviation)^2 / 2: a place is at most 7/4, so that it is at most 14^2 / 2 = 98
                    let ratio = quotient(place, 24, u64::from(deviation.to_bits().unsigned_abs()));
                    exp_minus(Real::from_bits(((ratio * ratio) >> 25) as i32))
                }
            };
            sum += u64::from(weight.to_bits().unsigned_abs());
            *part = (place as i32, weight.to_bits());
        }
        for (_, weight) in &mut parts {
            *weight = quotient(i64::from(*weight), 30, sum) as i32;
        }
        Ok(Self { parts, count: n, side: nth(width, n.into()) as i32, seed })
    }

    /// Parts a side.
    pub(crate) fn parts_a_side(&self) -> u32 {
        self.count.into()
    }

    /// Whether the only sample is the pixel's centre.
    #[inline]
    pub(crate) fn is_centre(&self) -> bool {
        self.count == 1 && self.seed.is_none()
    }

    /// The samples of pixel `(x, y)`: offsets from its centre in pixels (24 fractional bits, y downwards) and
    /// weights (30 bits).
    #[inline]
    pub(crate) fn samples(&self, x: u32, y: u32) -> impl Iterator<Item = (i32, i32, i32)> + '_ {
        let mut state = self.seed.map(|seed| hash(seed ^ hash(x.wrapping_add(hash(y)))));
        let parts = || self.parts.iter().take(self.count.into());
        parts().flat_map(move |row| parts().map(move |column| (row, column))).map(move |(row, column)| {
            let weight = ((i64::from(row.1) * i64::from(column.1)) >> 30) as i32;
            let (mut dx, mut dy) = (column.0, row.0);
            if let Some(state) = &mut state {
                *state = hash(state.wrapping_add(0x9e37_79b9));
                let jitter = |bits: u32| (((i64::from(bits) - 0x8000) * i64::from(self.side)) >> 16) as i32;
                dx += jitter(*state >> 16);
                dy += jitter(*state & 0xffff);
            }
            (dx, dy, weight)
        })
    }
}

/// A 32-bit finaliser with full avalanche (after M. D. Hoang's and C. Wellons' search for low bias).
const fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_one_and_offsets_stay_in_their_area() {
        let gaussian = Filter::Gaussian { deviation: Real::from_num(0.5), width: Real::from_num(2) };
        for (sampling, filter, reach) in [
            (Sampling::Centre, Filter::Box, 0.0),
            (Sampling::Grid(4), Filter::Box, 0.375),
            (Sampling::Jittered { n: 8, seed: 7 }, Filter::Box, 0.5),
            (Sampling::Jittered { n: 5, seed: 7 }, gaussian, 1.0),
        ] {
            let pattern = Pattern::new(sampling, filter).unwrap();
            for (x, y) in [(0, 0), (3, 200), (16000, 1)] {
                let samples: std::vec::Vec<_> = pattern.samples(x, y).collect();
                let sum: i64 = samples.iter().map(|s| i64::from(s.2)).sum();
                assert!((sum - (1 << 30)).abs() < 256, "{sum}");
                let offset = |v: i32| f64::from(v) / f64::from(1 << 24);
                assert!(samples.iter().all(|s| offset(s.0).abs() <= reach && offset(s.1).abs() <= reach));
            }
        }
    }

    #[test]
    fn the_centre_is_the_ordinary_pattern() {
        assert_eq!(Pattern::new(Sampling::Centre, Filter::Box), Ok(Pattern::CENTRE));
    }

    #[test]
    fn jitter_is_a_function_of_the_pixel_alone() {
        let pattern = Pattern::new(Sampling::Jittered { n: 4, seed: 1 }, Filter::Box).unwrap();
        let at = |x, y| pattern.samples(x, y).collect::<std::vec::Vec<_>>();
        assert_eq!(at(5, 9), at(5, 9));
        assert_ne!(at(5, 9), at(9, 5));
    }

    /// Places and weights of a Gaussian filter against its formula.
    #[test]
    fn a_gaussian_weighs_its_places() {
        for (n, deviation, width) in [(8, 0.125, 4.0), (5, 0.5, 2.0), (4, 4.0, 1.0), (3, 1.25, 3.5)] {
            let filter =
                Filter::Gaussian { deviation: Real::from_num(deviation), width: Real::from_num(width) };
            let pattern = Pattern::new(Sampling::Grid(n), filter).unwrap();
            let place = |i: u8| (f64::from(i) + 0.5) / f64::from(n) * width - width / 2.0;
            let weight = |i: u8| (-(place(i) / deviation).powi(2) / 2.0).exp();
            let sum: f64 = (0..n).map(weight).sum();
            let samples: std::vec::Vec<_> = pattern.samples(0, 0).collect();
            for (row, column, sample) in (0..n * n).zip(&samples).map(|(i, sample)| (i / n, i % n, sample)) {
                let [dx, dy] = [sample.0, sample.1].map(|v| f64::from(v) / 2_f64.powi(24));
                assert!(
                    (dx - place(column)).abs() < 2_f64.powi(-24) && (dy - place(row)).abs() < 2_f64.powi(-24)
                );
                let exact = weight(row) * weight(column) / sum / sum;
                let got = f64::from(sample.2) / 2_f64.powi(30);
                assert!((got - exact).abs() < 2_f64.powi(-25), "{n} {row} {column}: {got} {exact}");
            }
        }
    }

    #[test]
    fn a_margin_is_what_a_filter_needs_beyond_the_pixel() {
        let margin =
            |width: f64| Filter::Gaussian { deviation: Real::ONE, width: Real::from_num(width) }.margin();
        assert_eq!([1.0, 1.5, 2.0, 3.0, 3.5, 4.0].map(margin), [0, 1, 1, 1, 2, 2]);
        assert_eq!(Filter::Box.margin(), 0);
    }

    /// Both axes are jittered on their own, over the whole area; one sample that moves is not the centre.
    #[test]
    fn jitter_fills_its_area() {
        let pattern = Pattern::new(Sampling::Jittered { n: 1, seed: 3 }, Filter::Box).unwrap();
        assert!(!pattern.is_centre() && Pattern::CENTRE.is_centre());
        let mut quarters = [0; 4];
        let mut extremes = [[0_i32; 2]; 2];
        for x in 0..2000 {
            for (dx, dy, _) in pattern.samples(x, 5) {
                quarters[usize::from(dx < 0) * 2 + usize::from(dy < 0)] += 1;
                for (extreme, v) in extremes.iter_mut().zip([dx, dy]) {
                    *extreme = [extreme[0].min(v), extreme[1].max(v)];
                }
            }
        }
        assert!(quarters.iter().all(|n| (400..600).contains(n)), "{quarters:?}");
        let side = 1 << 23;
        assert!(
            extremes.iter().all(|[low, high]| *low >= -side
                && *low < -side + (side >> 6)
                && *high < side
                && *high > side - (side >> 6)),
            "{extremes:?}"
        );
    }

    /// Places are `width (2 i + 1 - n) / 2 n`, towards 0; equal weights are `1 / n`, downwards.
    #[test]
    fn places_and_equal_weights_are_exact_quotients() {
        for n in 1..=8_i64 {
            for width in [Real::ONE, Real::from_num(4), Real::from_bits(33_333_333)] {
                let filter = Filter::Gaussian { deviation: Real::ONE, width };
                for (filter, width) in [(Filter::Box, 1 << 24), (filter, i64::from(width.to_bits()))] {
                    let pattern = Pattern::new(Sampling::Grid(n as u8), filter).unwrap();
                    assert_eq!((pattern.parts_a_side(), pattern.side), (n as u32, (width / n) as i32));
                    for (i, (place, weight)) in (0..).zip(pattern.parts).take(n as usize) {
                        assert_eq!(i64::from(place), width * (2 * i + 1 - n) / (2 * n), "{n} {i}");
                        assert!(filter != Filter::Box || i64::from(weight) == (1 << 30) / n, "{n} {i}");
                    }
                }
            }
        }
        let centre = [Sampling::Grid(1), Sampling::Centre, Sampling::Grid(2)]
            .map(|sampling| Pattern::new(sampling, Filter::Box).unwrap().is_centre());
        assert_eq!(centre, [true, true, false]);
    }

    #[test]
    fn samples_and_filters_are_refused_outside_their_ranges() {
        let fits = |sampling, filter| Pattern::new(sampling, filter).is_ok();
        let samples = [0, 1, 8, 9].map(|n| fits(Sampling::Grid(n), Filter::Box));
        assert_eq!(samples, [false, true, true, false]);
        let gaussian = |deviation: i32, width: i32| {
            let (deviation, width) = (Real::from_bits(deviation), Real::from_bits(width));
            fits(Sampling::Jittered { n: 2, seed: 0 }, Filter::Gaussian { deviation, width })
        };
        let (least, one, four) = (1 << 21, 1 << 24, 4 << 24);
        let deviations = [least - 1, least, four, four + 1].map(|d| gaussian(d, one));
        let widths = [one - 1, one, four, four + 1].map(|w| gaussian(one, w));
        assert_eq!((deviations, widths), ([false, true, true, false], [false, true, true, false]));
    }

    /// Every bit of the result changes with about half of the words when one bit of the word changes.
    #[test]
    fn a_hash_mixes_every_bit_into_every_other() {
        let words = || (0..4000_u32).map(|i| i.wrapping_mul(0x9e37_79b9));
        let mut worst = 0_i32;
        for bit in 0..32 {
            let mut changed = [0_i32; 32];
            for word in words() {
                let difference = hash(word) ^ hash(word ^ 1 << bit);
                for (k, count) in changed.iter_mut().enumerate() {
                    *count += (difference >> k & 1) as i32;
                }
            }
            worst = changed.iter().fold(worst, |w, count| w.max((count - 2000).abs()));
        }
        // 3.9 standard deviations of 31.6 are to be expected among 1024 counts
        assert!((60..190).contains(&worst), "{worst}");
    }

    /// What is random in a pixel has nothing to do with its neighbours, with the seed beside it or with its
    /// next sample.
    #[test]
    fn neighbouring_samples_are_independent() {
        let pattern = |seed| Pattern::new(Sampling::Jittered { n: 2, seed }, Filter::Box).unwrap();
        let offsets =
            |seed, x, y| pattern(seed).samples(x, y).map(|s| [s.0, s.1]).collect::<std::vec::Vec<_>>();
        // products of deviations from the parts' centres, in parts of the side
        let mut sums = [0.0_f64; 6];
        let count = 3000;
        for i in 0..count {
            let (x, y) = (i % 60, i / 60);
            let centre =
                |s: usize, k: usize| if (if k == 0 { s % 2 } else { s / 2 }) == 0 { -0.25 } else { 0.25 };
            let off = |samples: &[[i32; 2]], s: usize, k: usize| {
                (f64::from(samples[s][k]) / 16_777_216.0 - centre(s, k)) / 0.5
            };
            let here = offsets(7, x, y);
            let pairs = [
                (off(&here, 0, 0), off(&here, 0, 1)),
                (off(&here, 0, 0), off(&here, 1, 0)),
                (off(&here, 1, 1), off(&here, 2, 1)),
                (off(&here, 0, 0), off(&offsets(7, x + 1, y), 0, 0)),
                (off(&here, 0, 0), off(&offsets(7, x, y + 1), 0, 0)),
                (off(&here, 0, 0), off(&offsets(8, x, y), 0, 0)),
            ];
            for (sum, (a, b)) in sums.iter_mut().zip(pairs) {
                assert!(a.abs() <= 0.5 && b.abs() <= 0.5, "{a} {b}");
                *sum += 12.0 * a * b;
            }
        }
        // a correlation's standard deviation is 1 / sqrt(3000)
        let worst = sums.iter().fold(0.0_f64, |w, s| w.max(s.abs() / f64::from(count)));
        assert!(worst > 0.0 && worst < 4.0 / f64::from(count).sqrt(), "{sums:?}");
    }

    /// Against values of the published function, worked out beside it.
    #[test]
    fn a_hash_is_the_published_one() {
        let words = [0, 1, 2, u32::MAX, 1 << 31, 0x1234_5678];
        assert_eq!(words.map(hash), [0, 0x6889_90c0, 0xd113_2181, 0x6768_824a, 0xcc4b_4124, 0xf5e7_1c96]);
    }

    /// The samples of a pixel follow from seed and place alone: one word a sample, its halves from -1/2 to
    /// 1/2 of a part.
    #[test]
    fn jitter_is_the_halves_of_one_word_a_sample() {
        for (n, seed, x, y) in
            [(1, 0, 0_u32, 0), (2, 7, 5, 9), (3, u32::MAX, 16_000, 1), (8, 12_345, 2, 16_383)]
        {
            let pattern = Pattern::new(Sampling::Jittered { n, seed }, Filter::Box).unwrap();
            let mut word = hash(seed ^ hash(x.wrapping_add(hash(y))));
            let side = i64::from((1 << 24) / i32::from(n));
            let mut parts = (0..n).flat_map(|row| (0..n).map(move |column| [column, row]));
            for (dx, dy, _) in pattern.samples(x, y) {
                word = hash(word.wrapping_add(0x9e37_79b9));
                let part = parts.next().unwrap();
                for (k, (got, half)) in [(dx, word >> 16), (dy, word & 0xffff)].into_iter().enumerate() {
                    let centre = (i64::from(2 * part[k]) + 1 - i64::from(n)) * (1 << 24) / (2 * i64::from(n));
                    let exact = (i64::from(half) - (1 << 15)) * side;
                    assert_eq!(i64::from(got), centre + exact.div_euclid(1 << 16), "{n} {seed} {x} {y}");
                }
            }
            assert!(parts.next().is_none());
        }
    }
}
