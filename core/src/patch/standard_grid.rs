//! The standard grid: two times two maps of three times three control points, and its 72 numbers.
//!
//! Of its 5 x 5 points those with even coordinates are the control points, `r_(2i,2j) = e_ij`. The others:
//!
//! - boundary points `u_1, u_3, v_1, v_3`, with 2 free numbers each: `r_(k,0)`, `r_(k,4)` on both sides,
//!   `r_(0,k)`, `r_(4,k)`;
//! - joining points `r_12, r_32, r_21, r_23`, with 8 each, which make the curves through the middle: `f`
//!   along `s` at `t = 1/2` by the first two, `g` along `t` at `s = 1/2`;
//! - diagonal points `r_11, r_13, r_31, r_33`, with 8 each: `d(s) = (s, s)`, `e(s) = (s, 1 - s)`.
//!
//! `2 4 + 8 4 + 8 4 = 72`. Source: Tosan, Guerin, Baskurt, section 4.2.

use super::barycentric::unit;
use super::grid::Patch;
use crate::Error;
use crate::num::{Near, Wide};

/// Where the joining and the diagonal points are in the 5 x 5 grid, in the order of their numbers.
const INNER: [[usize; 2]; 8] = [[1, 2], [3, 2], [2, 1], [2, 3], [1, 1], [1, 3], [3, 1], [3, 3]];

impl Patch<2, 3, 9> {
    /// How many numbers a standard grid has.
    pub const NUMBERS: usize = 72;

    /// The patch with these numbers.
    ///
    /// `u_1, u_3, v_1, v_3`: the first and the third weight; then of each inner point
    /// `12, 32, 21, 23, 11, 13, 31, 33` its weights in order but for the fifth, that of the middle control
    /// point. What is left out is what is left of 1. Any numbers join.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a weight that is left and does not fit, and as
    /// [`Patch::from_grid`](Self::from_grid).
    pub fn standard(numbers: &[Near; 72]) -> Result<Self, Error> {
        let mut grid = [[Near::ZERO; 9]; 25];
        let mut put = |[k, l]: [usize; 2], point: [Near; 9]| {
            if let Some(place) = grid.get_mut(5 * k + l) {
                *place = point;
            }
        };
        for i in 0..3 {
            for j in 0..3 {
                put([2 * i, 2 * j], unit(3 * i + j));
            }
        }
        let (boundary, inner) = numbers.split_at(8);
        for ((pair, along_s), k) in boundary.chunks_exact(2).zip([true, true, false, false]).zip([1, 3, 1, 3])
        {
            let [first, third] = pair else { continue };
            let second = rest(pair)?;
            for side in 0..2 {
                let mut point = [Near::ZERO; 9];
                for (a, weight) in [*first, second, *third].into_iter().enumerate() {
                    let place = if along_s { 3 * a + 2 * side } else { 6 * side + a };
                    if let Some(to) = point.get_mut(place) {
                        *to = weight;
                    }
                }
                put(if along_s { [k, 4 * side] } else { [4 * side, k] }, point);
            }
        }
        for (given, place) in inner.chunks_exact(8).zip(INNER) {
            let (before, after) = given.split_at(4);
            let mut point = [Near::ZERO; 9];
            let weights = before.iter().copied().chain([rest(given)?]).chain(after.iter().copied());
            for (to, weight) in point.iter_mut().zip(weights) {
                *to = weight;
            }
            put(place, point);
        }
        Self::from_grid(&grid)
    }
}

/// What is left of 1.
fn rest(weights: &[Near]) -> Result<Near, Error> {
    let rest = weights.iter().fold(Wide::ONE, |rest, weight| rest - Wide::from(*weight));
    rest.checked_to_num().ok_or(Error::OutOfRange {
        what: "weight that is left of 1",
        index: None,
        value: rest,
        min: Wide::lit("-8"),
        max: Wide::lit("8"),
    })
}

#[cfg(test)]
mod tests {
    use super::super::address::{Address, Pair};
    use super::super::barycentric::{Barycentric, completed};
    use super::super::seeded::words;
    use super::super::standard_step::{is_standard, standard_weights};
    use super::*;

    /// What knows the maps gives the bits of what does not.
    #[test]
    fn a_known_map_gives_the_same_weights() {
        let mut word = words(5);
        let mut tried = 0;
        for _ in 0..40 {
            let numbers = [(); 72].map(|()| Near::from_bits(word(25) + (1 << 25)));
            let patch = Patch::standard(&numbers).unwrap();
            let maps = [0, 1].map(|i| [0, 1].map(|j| *patch.map(i, j).unwrap()));
            assert!(is_standard(&maps));
            for place in 0..16 {
                let mut weights = completed([(); 9].map(|()| word(28)));
                let [i, j] = [place >> 2, place & 3];
                let pair = Pair::of([i, j].map(|index| Address::<2>::of(index, 2).unwrap()));
                let got = standard_weights(&maps, &pair, weights);
                let digit = |index: u32, level: u32| (index >> level & 1) as usize;
                for level in 2 - pair.levels..2 {
                    weights = maps[digit(i, level)][digit(j, level)].image(&weights);
                }
                assert_eq!(got, weights);
                tried += 1;
            }
        }
        assert_eq!(tried, 640);
        assert!(!is_standard(&[[Barycentric::<9>::IDENTITY; 2]; 2]));
        assert!(!is_standard(&[[Barycentric::<4>::IDENTITY; 2]; 2]));
    }
}
