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
//! 2. `T(i, u) = t q 2/n k_u`, for samples of 8 bits rounded to 3 fractional bits and cut off at 1024,
//!    else to 4 and at `2^19`;
//! 3. `x(i, j) = sum_u c_u T(i, u)`, exact, for samples of 8 bits in 32, rounded to 7 fractional bits.
//!
//! To nearest, halves upwards. Rows `i` and `m-1-i`, and columns likewise, have the same products but for
//! signs.
//! Source: N. Ahmed, T. Natarajan, K. R. Rao, "Discrete cosine transform", 1974.

use super::sample::Sample;

/// Frequencies along each axis.
pub const FREQUENCIES: usize = 16;
/// Where `T` is cut off: sums of eight terms stay below `2^30`, what 16 bits make of it below `2^31`.
const MOST_8: i64 = (1 << 13) - 1;
const MOST_16: i64 = 1 << 23;
/// The largest level.
pub const LARGEST: i32 = 8191;

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

/// What a block's coefficients are.
#[derive(Debug, Clone)]
pub struct Levels {
    levels: [i16; FREQUENCIES * FREQUENCIES],
    /// One more than the greatest `u` and `v` of a level that was set.
    columns: u32,
    rows: u32,
}

impl Default for Levels {
    fn default() -> Self {
        Self { levels: [0; 256], columns: 0, rows: 0 }
    }
}

impl Levels {
    /// Whether all are 0.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.columns == 0
    }

    /// Sets the level at `v`, `u`, a nibble each, cut off at [`LARGEST`].
    #[inline]
    pub fn set(&mut self, place: u8, level: i32) {
        if let Some(slot) = self.levels.get_mut(usize::from(place)) {
            *slot = level.clamp(-LARGEST, LARGEST) as i16;
            self.columns = self.columns.max((u32::from(place) & 15) + 1);
            self.rows = self.rows.max((u32::from(place) >> 4) + 1);
        }
    }

    /// The level at a place.
    #[inline]
    pub fn get(&self, place: u8) -> i32 {
        self.levels.get(usize::from(place)).map_or(0, |level| i32::from(*level))
    }

    /// How much lies above and to the left.
    #[inline]
    pub fn about(&self, place: u8) -> usize {
        let (v, u) = (place >> 4, place & 15);
        let up = if v > 0 { self.get(place - 16).unsigned_abs() } else { 0 };
        let left = if u > 0 { self.get(place - 1).unsigned_abs() } else { 0 };
        (up + left).min(2) as usize
    }

    /// Makes all 0.
    #[inline]
    pub fn clear(&mut self) {
        for row in self.levels.chunks_exact_mut(FREQUENCIES).take(self.rows as usize) {
            for level in row.iter_mut().take(self.columns as usize) {
                *level = 0;
            }
        }
        (self.columns, self.rows) = (0, 0);
    }
}

/// The frequencies of one row of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    terms: [i32; FREQUENCIES],
}

/// A block's transform.
#[derive(Debug)]
pub(super) struct Inverse<'a> {
    levels: &'a Levels,
    /// With 8 fractional bits.
    step: i64,
    /// What makes 3 or 4 fractional bits of a sum times the step, and where they are cut off.
    shift: u32,
    most: i64,
    /// Phase of half a pixel for frequency 1.
    half: u32,
    columns: u32,
    rows: u32,
}

impl<'a> Inverse<'a> {
    /// Of a block of `2^size` pixels a side, drawn with `2^drawn`.
    #[inline]
    pub(super) fn new<S: Sample>(levels: &'a Levels, step: u32, size: u32, drawn: u32) -> Self {
        let drawn = drawn.min(7);
        let most = 1 << drawn;
        Self {
            levels,
            step: i64::from(step),
            shift: size.min(5) + if S::BITS == 8 { 18 } else { 17 },
            most: if S::BITS == 8 { MOST_8 } else { MOST_16 },
            half: 128 >> drawn,
            columns: levels.columns.min(most),
            rows: levels.rows.min(most),
        }
    }

    /// Row `i` and the one that mirrors it.
    #[inline(never)]
    pub(super) fn rows(&self, i: u32) -> (Row, Row) {
        let columns = self.columns as usize;
        let (mut even, mut odd) = ([0_i32; FREQUENCIES], [0_i32; FREQUENCIES]);
        let turn = (2 * i + 1) * self.half;
        for (v, row) in (0..self.rows).zip(self.levels.levels.chunks_exact(FREQUENCIES)) {
            let c = if v == 0 { ROOT_HALF } else { cosine(v * turn) };
            let sums = if v & 1 == 0 { &mut even } else { &mut odd };
            for (sum, level) in sums.iter_mut().zip(row).take(columns) {
                *sum = sum.wrapping_add(c.wrapping_mul(i32::from(*level)));
            }
        }
        let (mut top, mut bottom) = (even, even);
        for ((top, bottom), odd) in top.iter_mut().zip(&mut bottom).zip(odd).take(columns) {
            (*top, *bottom) = (self.scaled(top.wrapping_add(odd)), self.scaled(bottom.wrapping_sub(odd)));
        }
        for terms in [&mut top, &mut bottom] {
            let [first, ..] = terms;
            *first = ((i64::from(*first) * i64::from(ROOT_HALF) + (1 << 13)) >> 14) as i32;
        }
        (Row { terms: top }, Row { terms: bottom })
    }

    #[inline]
    fn scaled(&self, sum: i32) -> i32 {
        let half_unit = 1 << (self.shift - 1);
        ((i64::from(sum) * self.step + half_unit) >> self.shift).max(-self.most).min(self.most) as i32
    }

    /// The pixels of a row and the one that mirrors it, at `j` and at the place that mirrors that, with 7
    /// fractional bits: upper left, upper right, lower left, lower right.
    #[inline]
    pub(super) fn pixels<S: Sample>(&self, (top, bottom): &(Row, Row), j: u32) -> [i32; 4] {
        let turn = (2 * j + 1) * self.half;
        let terms = top.terms.iter().zip(&bottom.terms).take(self.columns as usize);
        if S::BITS == 8 {
            // half a unit of the result
            let (mut even, mut odd, mut phase) = ([1_i32 << 9; 2], [0_i32; 2], 0);
            for (u, (upper, lower)) in terms.enumerate() {
                let c = cosine(phase);
                let sums = if u & 1 == 0 { &mut even } else { &mut odd };
                sums[0] = sums[0].wrapping_add(c.wrapping_mul(*upper));
                sums[1] = sums[1].wrapping_add(c.wrapping_mul(*lower));
                phase += turn;
            }
            let ([e0, e1], [o0, o1]) = (even, odd);
            let sums = [e0.wrapping_add(o0), e0.wrapping_sub(o0), e1.wrapping_add(o1), e1.wrapping_sub(o1)];
            return sums.map(|sum| sum >> 10);
        }
        let (mut even, mut odd, mut phase) = ([1_i64 << 10; 2], [0_i64; 2], 0);
        for (u, (upper, lower)) in terms.enumerate() {
            let c = i64::from(cosine(phase));
            let sums = if u & 1 == 0 { &mut even } else { &mut odd };
            sums[0] += c * i64::from(*upper);
            sums[1] += c * i64::from(*lower);
            phase += turn;
        }
        let ([e0, e1], [o0, o1]) = (even, odd);
        [e0 + o0, e0 - o0, e1 + o1, e1 - o1].map(|sum| (sum >> 11) as i32)
    }
}
