//! Boxes that meet a Julia set, each decided by itself: nothing is drawn on a grid first, and boxes of every
//! size are treated alike.
//!
//! The square around the whole set is divided by four as long as its parts may meet the set; boxes of 1/64 to
//! 1/512 of the square of side 4 are counted, on eight positions for each size, over which `log N` is
//! averaged. A box counts when one of its 16 squares may meet the set.

use attractor::escape::JuliaSet;
use attractor::num::Complex;
use attractor::num::Wide;

/// Positions of the grid of boxes for each size.
const POSITIONS: i64 = 8;
/// Numbers of boxes across, as powers of the fourth root of 2.
const SIZES: std::ops::RangeInclusive<i32> = 24..=36;
/// `sqrt(1/2)`, rounded up.
const HALF_DIAGONAL: Wide = Wide::lit("0.70711");

/// The sizes in words.
pub(crate) const RANGE: &str = "boxes of 1/64 to 1/512 of a square of side 4, 13 sizes, 8 positions each";

/// `(log(1 / size), log N)` for all sizes, the largest boxes first.
pub(crate) fn counts(set: &JuliaSet) -> Vec<(f64, f64)> {
    SIZES
        .map(|quarter_octaves| {
            let across = (f64::from(quarter_octaves) / 4.0).exp2();
            let side = Wide::from_num(4.0 / across);
            let shift = |k: i64| side * (2 * k + 1) / (2 * POSITIONS);
            let logs = (0..POSITIONS).map(|k| {
                let middle = Complex::new(shift(k), shift(3 * k % POSITIONS));
                (boxes(set, middle, side, quarter_octaves as u32 / 4 + 1) as f64).max(1.0).ln()
            });
            (across.ln(), logs.sum::<f64>() / POSITIONS as f64)
        })
        .collect()
}

/// The boxes of this side that meet the set among `2^levels` by `2^levels` round a point.
fn boxes(set: &JuliaSet, middle: Complex<Wide>, side: Wide, levels: u32) -> u64 {
    let mut count = 0;
    let mut stack = vec![(middle, levels)];
    while let Some((middle, level)) = stack.pop() {
        if level == 0 {
            count += u64::from(set.sixteenths(middle, side) > 0);
            continue;
        }
        let whole = side * (1_i64 << level);
        if set.may_meet(middle, whole * HALF_DIAGONAL) {
            let d = whole / 4;
            for (x, y) in [(-d, -d), (d, -d), (-d, d), (d, d)] {
                stack.push((Complex::new(middle.re + x, middle.im + y), level - 1));
            }
        }
    }
    count
}
