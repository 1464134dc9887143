//! The inverse cosine transform of a block, in integers: the same bits everywhere.
//!
//! A block of `n x n`, drawn `m x m` (`m = n` but for a scaled picture), has levels `L(v, u)`, `v` down and
//! `u`
//! across, both below 16, and the step `q`:
//!
//! `x(i, j) = 2/n q sum_v sum_u k_v k_u L(v, u) cos((2i+1) v pi / 2m) cos((2j+1) u pi / 2m)`,
//! `k_0 = 1/sqrt 2`, else 1; frequencies of `m` and above are left out. In three steps:
//!
//! 1. `t(i, u) = sum_v c_v L(v, u)`, exact: `c` has 14 fractional bits, `|L| <= 8191`, 32 bits hold the sum;
//! 2. `T(i, u) = t q 2/n k_u`, rounded to 4 fractional bits, of 14 bits for samples of 8 bits, else of 24;
//! 3. `x(i, j) = sum_u c_u T(i, u)`, exact, for samples of 8 bits in 32, rounded to 7 fractional bits.
//!
//! To nearest, halves upwards. Rows `i` and `m-1-i`, and columns likewise, have the same products but for
//! signs.
//! Source: N. Ahmed, T. Natarajan, K. R. Rao, "Discrete cosine transform", 1974.

use super::levels::{Levels, STRIDE};
use super::sample::Sample;

/// `round(2^14 cos(pi k / 256))` for `k` from 0 to 128.
const QUARTER: [u16; 129] = [
    16384, 16383, 16379, 16373, 16364, 16353, 16340, 16324, 16305, 16284, 16261, 16235, 16207, 16176, 16143,
    16107, 16069, 16029, 15986, 15941, 15893, 15843, 15791, 15736, 15679, 15619, 15557, 15493, 15426, 15357,
    15286, 15213, 15137, 15059, 14978, 14896, 14811, 14724, 14635, 14543, 14449, 14354, 14256, 14155, 14053,
    13949, 13842, 13733, 13623, 13510, 13395, 13279, 13160, 13039, 12916, 12792, 12665, 12537, 12406, 12274,
    12140, 12004, 11866, 11727, 11585, 11442, 11297, 11151, 11003, 10853, 10702, 10549, 10394, 10238, 10080,
    9921, 9760, 9598, 9434, 9269, 9102, 8935, 8765, 8595, 8423, 8250, 8076, 7900, 7723, 7545, 7366, 7186,
    7005, 6823, 6639, 6455, 6270, 6084, 5897, 5708, 5520, 5330, 5139, 4948, 4756, 4563, 4370, 4176, 3981,
    3786, 3590, 3393, 3196, 2999, 2801, 2603, 2404, 2205, 2006, 1806, 1606, 1406, 1205, 1005, 804, 603, 402,
    201, 0,
];

/// `round(2^14 cos(pi k / 256))` for a whole turn.
const COSINE: [i16; 512] = {
    let mut table = [0; 512];
    let mut k = 0;
    while k < 512 {
        let folded = if k < 256 { k } else { 512 - k };
        table[k] = if folded <= 128 { QUARTER[folded] as i16 } else { -(QUARTER[256 - folded] as i16) };
        k += 1;
    }
    table
};
/// `round(2^14 / sqrt 2)`.
const ROOT_HALF: i32 = 11585;

#[inline]
fn cosine(phase: u32) -> i32 {
    i32::from(COSINE[(phase & 511) as usize])
}

/// A frequency of a row of a block, and of the row that mirrors it.
pub(super) type Term = [i32; 2];

/// A block's transform.
#[derive(Debug)]
pub(super) struct Inverse<'a> {
    levels: &'a Levels,
    /// What makes 4 fractional bits, above 32 others, of a sum: the step's 8 bits and the block's size.
    factor: i64,
    /// Phase of half a pixel for frequency 1.
    half: u32,
    /// How many frequencies there are at most.
    columns: usize,
    rows: usize,
}

impl<'a> Inverse<'a> {
    /// Of a block of `2^size` pixels a side, drawn with `2^drawn`.
    #[inline(never)]
    pub(super) fn new(levels: &'a Levels, step: u32, size: u32, drawn: u32) -> Self {
        let drawn = drawn.min(7);
        let drawn_of = |frequencies: u32| frequencies.min(1 << drawn) as usize;
        Self {
            levels,
            factor: i64::from(step) << (15 - size.min(5)),
            half: 128 >> drawn,
            columns: drawn_of(32 - levels.columns.leading_zeros()),
            rows: drawn_of(levels.rows),
        }
    }

    /// Whether four terms are all.
    pub(super) const fn is_narrow(&self) -> bool {
        self.columns <= 4
    }

    /// Row `i` and the one that mirrors it, into as many terms as [`pixels`] takes.
    #[inline(never)]
    pub(super) fn rows<S: Sample>(&self, i: u32, pair: &mut [Term]) {
        let turn = self.turn(i);
        let columns = self.levels.levels.chunks_exact(STRIDE).skip(1);
        let mut there = self.levels.columns;
        for (terms, column) in pair.iter_mut().zip(columns).take(self.columns) {
            *terms = [0; 2];
            if there & 1 == 1 {
                let (mut even, mut odd, mut phase, mut c) = (0_i32, 0_i32, 0, ROOT_HALF);
                let mut levels = column.iter().take(self.rows).map(|level| i32::from(*level));
                while let Some(level) = levels.next() {
                    even += c * level;
                    phase += turn;
                    let Some(level) = levels.next() else { break };
                    odd += cosine(phase) * level;
                    phase += turn;
                    c = cosine(phase);
                }
                *terms = [self.term::<S>(even + odd), self.term::<S>(even - odd)];
            }
            there >>= 1;
        }
        if let [first, ..] = pair {
            *first = first.map(|term| ((i64::from(term) * i64::from(ROOT_HALF) + (1 << 13)) >> 14) as i32);
        }
    }

    /// The upper word of a product of which 64 bits are kept, rounded.
    #[inline]
    fn term<S: Sample>(&self, sum: i32) -> i32 {
        S::term((i64::from(sum).wrapping_mul(self.factor).wrapping_add(1 << 31) >> 32) as i32)
    }

    /// Those of a row's frequencies that [`Inverse::rows`] has written.
    #[inline]
    pub(super) fn terms<'p>(&self, pair: &'p [Term]) -> &'p [Term] {
        pair.get(..self.columns).unwrap_or(&[])
    }

    /// [`pixels`] where it is seldom asked for.
    #[inline(never)]
    pub(super) fn pixels_apart<S: Sample>(&self, pair: &[Term], j: u32) -> [i32; 4] {
        pixels::<S>(self.terms(pair), self.turn(j))
    }

    /// The phase of frequency 1 in column `j`.
    #[inline]
    pub(super) const fn turn(&self, j: u32) -> u32 {
        (2 * j + 1) * self.half
    }
}

/// The pixels of a row and the one that mirrors it, where frequency 1 has a phase and at the place that
/// mirrors that, with 7 fractional bits: upper left, upper right, lower left, lower right.
///
/// Error: where no term is cut off, below `1/256 + (columns + 1)/32 + A/16384` of a sample, `columns`
/// those of `u` and `A = 2/n q sum |L|`: `a_transform_keeps_the_bound_of_its_arithmetic`. (A term is
/// rounded to `1/32`, the first twice, each cosine to `2^-15`, the sum to `1/256`.)
#[inline]
pub(super) fn pixels<S: Sample>(terms: &[Term], turn: u32) -> [i32; 4] {
    // half a unit of the result
    let (mut even, mut odd) = ([S::Sum::from(1 << 10); 2], [S::Sum::from(0); 2]);
    let (mut phase, mut p) = (0, 1 << 14);
    let mut terms = terms.iter();
    // four at a time, as many as there are: a compiler that unrolls it further pays more than it gains
    while let Some([a, b]) = terms.next() {
        even = [even[0] + S::product(p, *a), even[1] + S::product(p, *b)];
        phase += turn;
        let Some([a, b]) = terms.next() else { break };
        let q = cosine(phase);
        odd = [odd[0] + S::product(q, *a), odd[1] + S::product(q, *b)];
        phase += turn;
        let Some([a, b]) = terms.next() else { break };
        let q = cosine(phase);
        even = [even[0] + S::product(q, *a), even[1] + S::product(q, *b)];
        phase += turn;
        let Some([a, b]) = terms.next() else { break };
        let q = cosine(phase);
        odd = [odd[0] + S::product(q, *a), odd[1] + S::product(q, *b)];
        phase += turn;
        p = cosine(phase);
    }
    let ([e, f], [o, p]) = (even, odd);
    [e + o, e - o, f + p, f - p].map(|sum| (sum.into() >> 11) as i32)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::levels::{FREQUENCIES, LARGEST};
    use super::*;

    #[test]
    fn a_transform_keeps_the_bound_of_its_arithmetic() {
        let (small, deep) = (worst::<u8>(500.0), worst::<u16>(60_000.0));
        std::println!("{small:.3} and {deep:.3} of the bound");
        assert!(small > 0.3 && deep > 0.3, "{small} {deep}");
    }

    /// The greatest error over its bound, below which each is.
    fn worst<S: Sample>(most: f64) -> f64 {
        let (mut worst, mut state, mut tried) = (0.0_f64, 1_u64, 0);
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % below
        };
        for round in 0..240_u32 {
            let size = 2 + round % 4;
            let n = 1_usize << size;
            let mut levels = Levels::default();
            let step = 16 + random(1 << (5 + round % 9)) as u32;
            let q = f64::from(step) / 256.0;
            let (mut sum, mut exact, mut columns) = (0.0, std::vec![0.0; n * n], 0);
            for _ in 0..1 + random(12) {
                let (v, u) = (random(n.min(16) as u64) as usize, random(n.min(16) as u64) as usize);
                let place = (v << 4 | u) as u8;
                let level = random(1 << (1 + round % 7)) as i32 - (1 << (round % 7));
                let next = sum + 2.0 / n as f64 * q * f64::from(level.abs());
                if place == 0 || levels.get(place) != 0 || next > most {
                    continue;
                }
                levels.set(place, level);
                (sum, columns) = (next, columns.max(u + 1));
                let k = |w: usize| if w == 0 { 0.5_f64.sqrt() } else { 1.0 };
                for (at, value) in exact.iter_mut().enumerate() {
                    let wave =
                        |w: usize, i: usize| k(w) * (PI * ((2 * i + 1) * w) as f64 / (2 * n) as f64).cos();
                    *value += 2.0 / n as f64 * q * f64::from(level) * wave(v, at / n) * wave(u, at % n);
                }
            }
            let bound = 1.0 / 256.0 + (columns + 1) as f64 / 32.0 + sum / 16384.0;
            let inverse = Inverse::new(&levels, step, size, size);
            let mut pair = [[0; 2]; FREQUENCIES];
            for i in 0..n / 2 {
                inverse.rows::<S>(i as u32, &mut pair);
                for j in 0..n / 2 {
                    let four = pixels::<S>(inverse.terms(&pair), inverse.turn(j as u32));
                    let (below, right) = (n - 1 - i, n - 1 - j);
                    for ((i, j), got) in
                        [(i, j), (i, right), (below, j), (below, right)].into_iter().zip(four)
                    {
                        let off = (f64::from(got) / 128.0 - exact[i * n + j]).abs();
                        assert!(off < bound, "{n} ({i}, {j}): {off}, allowed {bound}");
                        worst = worst.max(off / bound);
                        tried += 1;
                    }
                }
            }
        }
        assert!(tried > 50_000, "{tried}");
        worst
    }

    #[test]
    fn the_greatest_levels_stay_within_32_bits() {
        for negative in [0, 1, 2] {
            let mut levels = Levels::default();
            for place in 1..=255_u8 {
                let sign = if negative == 2 { place.count_ones() % 2 } else { negative };
                levels.set(place, if sign == 1 { -9999 } else { 9999 });
            }
            assert_eq!(levels.get(17).abs(), LARGEST);
            let inverse = Inverse::new(&levels, (511 << 23) >> 4, 2, 5);
            let mut pair = [[0; 2]; FREQUENCIES];
            for i in 0..16 {
                inverse.rows::<u8>(i, &mut pair);
                assert!(pair.as_flattened().iter().all(|term| (-8192..8192).contains(term)));
                (0..16).for_each(|j| {
                    inverse.pixels_apart::<u8>(&pair, j);
                });
                inverse.rows::<u16>(i, &mut pair);
                (0..16).for_each(|j| {
                    inverse.pixels_apart::<u16>(&pair, j);
                });
            }
        }
    }
}
