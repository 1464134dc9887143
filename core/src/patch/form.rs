//! Quadratic forms of the heights of a cell: variances over it, by the law of total variance.
//!
//! A quantity that is `p . y(x)` for control heights `p` has over a cell the mean `p . m` and the variance `p
//! V p`. If over the part `d` it has the weights `r T_d y`, `V` is the mean of the variances over the `n`
//! parts and the variance of their means: `V = (r^2 / n) sum_d T_d V T_d^T + (1 / n) sum_d u_d u_d^T`, `u_d =
//! r T_d m - m`. Iteration from 0 on tends to it from below.
//!
//! `V` knows nothing of a level, and for slopes nothing of a plane: so it is a form of what heights differ by
//! from one of them, or from the plane through three of them, 15 or 13 exact numbers. (If it were one of 16
//! heights, a round would make four times as much of the unit that rounding adds to a level.)
//!
//! Proof that it converges: `X -> (r^2 / n) sum T_d X T_d^T` takes positive forms to positive ones. If `k`
//! rounds take the identity of 13 or 15 numbers to a form whose rows have magnitudes of sum 1/2 at most, they
//! take any form to half as much at most, and what is still to come is no more than what the last `k` rounds
//! have added. Formats: on the way 44 fractional bits, in a form 28.

use super::columns::{BASE, Column, halved, image, rounded};
use crate::num::formats::{Q24, Q28, Q44};
use crate::num::{Real, product};

/// What a form leaves out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Free {
    /// A level: heights count as what they differ by from one.
    Level,
    /// A plane: from the plane through three.
    Plane,
}

/// A matrix of weights.
pub(super) type Square = [Column; 16];

/// The heights `(2, 1)` and `(1, 2)`, which a plane goes through.
const NEXT: [usize; 2] = [9, 6];

/// So many rounds must halve a form, and so often do they until what is still to come is below `2^-30`.
const MOST_ROUNDS: u32 = 64;
const HALVINGS: u32 = 64;
const SMALL: u64 = 1 << 14;
/// Beyond it weights leave their format: `2^13`.
const LARGE: u64 = 1 << 57;

impl Free {
    fn is_taken(self, place: usize) -> bool {
        place != BASE && (self == Self::Level || !NEXT.contains(&place))
    }

    /// Where a height lies from the first of the three.
    fn place(place: usize) -> [i64; 2] {
        [place >> 2, place & 3].map(|c| c as i64 - 1)
    }

    /// The weights left out are what makes a level, or a plane, count for nothing.
    fn close(self, column: &mut Column) {
        let (mut sum, mut moments) = (0_i64, [0_i64; 2]);
        for (place, weight) in column.iter().enumerate().filter(|(place, _)| self.is_taken(*place)) {
            sum = sum.wrapping_add(*weight);
            for (moment, along) in moments.iter_mut().zip(Self::place(place)) {
                *moment = moment.wrapping_add(along.wrapping_mul(*weight));
            }
        }
        if self == Self::Plane {
            for (place, moment) in NEXT.into_iter().zip(moments) {
                if let Some(weight) = column.get_mut(place) {
                    *weight = moment.wrapping_neg();
                }
                sum = sum.wrapping_sub(moment);
            }
        }
        column[BASE] = sum.wrapping_neg();
    }

    fn closed(self, mut square: Square) -> Square {
        for _ in 0..2 {
            square = transposed(&square);
            square.iter_mut().for_each(|row| self.close(row));
        }
        square
    }

    /// The identity of the numbers that count.
    fn identity(self) -> Square {
        let mut square = [[0; 16]; 16];
        for (place, row) in square.iter_mut().enumerate() {
            if let Some(entry) = row.get_mut(place).filter(|_| self.is_taken(place)) {
                *entry = 1 << 44;
            }
        }
        self.closed(square)
    }

    /// The greatest sum of magnitudes in a row, of what counts.
    fn size(self, square: &Square) -> u64 {
        let taken = |place: &usize| self.is_taken(*place);
        let row = |row: &Column| {
            let entries = row.iter().enumerate().filter(|(place, _)| taken(place));
            entries.fold(0_u64, |sum, (_, entry)| sum.saturating_add(entry.unsigned_abs()))
        };
        square.iter().enumerate().filter(|(place, _)| taken(place)).map(|(_, of)| row(of)).max().unwrap_or(0)
    }

    /// What heights differ by from the level or the plane.
    fn differences(self, heights: &[Q24; 16]) -> impl Iterator<Item = i64> {
        let base = i64::from(heights[BASE]);
        let rises = NEXT.map(|next| heights.get(next).map_or(0, |height| i64::from(*height) - base));
        let all = heights.iter().enumerate().filter(move |(place, _)| self.is_taken(*place));
        all.map(move |(place, height)| {
            let [along, across] = Self::place(place);
            let level = i64::from(*height) - base;
            match self {
                Self::Level => level,
                Self::Plane => level - along * rises[0] - across * rises[1],
            }
        })
    }
}

fn transposed(square: &Square) -> Square {
    let mut to = [[0; 16]; 16];
    for (i, row) in square.iter().enumerate() {
        for (entry, to) in row.iter().zip(&mut to) {
            if let Some(place) = to.get_mut(i) {
                *place = *entry;
            }
        }
    }
    to
}

/// `(u v^T + v u^T) / 2`, each entry rounded down.
pub(super) fn dyad(u: &Column, v: &Column) -> Square {
    let entry = |a: i64, b: i64| i128::from(a) * i128::from(b);
    let mut square = [[0; 16]; 16];
    for ((row, a), b) in square.iter_mut().zip(u).zip(v) {
        for ((to, c), d) in row.iter_mut().zip(v).zip(u) {
            *to = ((entry(*a, *c) + entry(*b, *d)) >> 45) as i64;
        }
    }
    square
}

/// `a x + b`, `x` 1, 1/2 or -1 ... whatever `with` makes of two entries.
pub(super) fn combined(a: &Square, b: &Square, with: impl Fn(Q44, Q44) -> Q44) -> Square {
    let mut to = *a;
    for (row, other) in to.iter_mut().zip(b) {
        for (entry, other) in row.iter_mut().zip(other) {
            *entry = with(*entry, *other);
        }
    }
    to
}

/// The law of a mask's variances over some of the parts of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Law<'a> {
    mask: &'a [[Q28; 5]; 5],
    parts: &'a [[usize; 2]],
    free: Free,
    /// `n / r^2`.
    over: usize,
    /// So many rounds halve any form.
    rounds: u32,
}

impl<'a> Law<'a> {
    /// That of heights, with `r` = 1, or of slopes, with `r` = 2, over 2 or 4 parts; none where 64 rounds do
    /// not halve the identity: then it does not converge, or very slowly.
    pub(super) fn new(mask: &'a [[Q28; 5]; 5], parts: &'a [[usize; 2]], free: Free) -> Option<Self> {
        let over = if free == Free::Level { parts.len() } else { 1 };
        let mut law = Self { mask, parts, free, over, rounds: 0 };
        let mut square = free.identity();
        while law.rounds < MOST_ROUNDS {
            square = law.round(&square);
            law.rounds += 1;
            match free.size(&square) {
                // a unit for what rounding adds
                0..0x7ff_ffff_0000 => return Some(law),
                LARGE.. => return None,
                _ => {}
            }
        }
        None
    }

    /// `(r^2 / n) sum_d T_d X T_d^T`.
    fn round(&self, square: &Square) -> Square {
        let mut sum = [[0_i64; 16]; 16];
        for part in self.parts {
            let half = transposed(&square.map(|row| image(self.mask, *part, &row)));
            for (to, row) in sum.iter_mut().zip(&half) {
                for (sum, entry) in to.iter_mut().zip(image(self.mask, *part, row)) {
                    *sum = sum.wrapping_add(entry);
                }
            }
        }
        self.free.closed(sum.map(|row| row.map(|entry| halved(entry, self.over))))
    }

    /// `V` for the variance of the means over the parts, whose own mean is `(1 / n) sum_d u_d v_d^T`; none
    /// where weights leave their format.
    ///
    /// Error: an entry is less by `2^-30` at most, and a unit of `2^-28` off
    /// (`variances_solve_their_equations`).
    pub(super) fn variance(&self, means: impl Iterator<Item = [Column; 2]>) -> Option<Square> {
        let mut seed = [[0; 16]; 16];
        for [u, v] in means {
            seed = combined(&seed, &dyad(&u, &v), i64::wrapping_add);
        }
        let seed = self.free.closed(seed.map(|row| row.map(|sum| halved(sum, self.parts.len()))));
        let mut square = seed;
        for _ in 0..HALVINGS {
            let before = square;
            for _ in 0..self.rounds {
                square = combined(&self.round(&square), &seed, i64::wrapping_add);
            }
            if self.free.size(&square) >= LARGE {
                return None;
            }
            if self.free.size(&combined(&square, &before, i64::wrapping_sub)) <= SMALL {
                return Some(square);
            }
        }
        None
    }
}

/// A quadratic form of the heights of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Form {
    free: Free,
    /// Row after row up to the diagonal, beside which entries count twice.
    entries: [Q28; 120],
}

/// Differences of heights below `2^27` times entries of `2^31`, 15 of them, stay below `2^62`.
const BITS: u32 = 27;

impl Form {
    /// Of the entries that count; none where one leaves the format.
    pub(super) fn new(free: Free, square: &Square) -> Option<Self> {
        let mut entries = [0; 120];
        let mut to = entries.iter_mut();
        for (i, row) in square.iter().enumerate().filter(|(i, _)| free.is_taken(*i)) {
            for (j, entry) in row.iter().enumerate().filter(|(j, _)| *j <= i && free.is_taken(*j)) {
                let twice = if i == j { *entry } else { entry.wrapping_mul(2) };
                *to.next()? = i32::try_from(rounded(twice)).ok()?;
            }
        }
        Some(Self { free, entries })
    }

    /// What it makes of some heights: 48 fractional bits, exact where they differ by less than 8.
    pub(super) fn of(&self, heights: &[Real; 16]) -> i128 {
        let heights = heights.map(Real::to_bits);
        let most = self.free.differences(&heights).fold(0, |most, z| most | z.unsigned_abs());
        let shift = (u64::BITS - most.leading_zeros()).saturating_sub(BITS);
        let mut z = [0_i32; 16];
        for (to, z) in z.iter_mut().zip(self.free.differences(&heights)) {
            *to = (z >> shift) as i32;
        }
        let (mut sum, mut entries) = (0_i128, self.entries.iter());
        let count = if self.free == Free::Level { 15 } else { 13 };
        for (i, own) in z.iter().enumerate().take(count) {
            let row = z.iter().take(i + 1).zip(&mut entries);
            let row = row.fold(0_i64, |row, (z, entry)| row.wrapping_add(product(*z, *entry)));
            sum += i128::from(row) * i128::from(*own);
        }
        (sum >> 28) << (2 * shift)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::columns::{CELL, ONE, SIDES};
    use super::super::seeded::words;
    use super::*;

    /// What rounds end with is what one more round leaves, of masks of all kinds; and forms of the identity
    /// are sums of squares, exactly.
    #[test]
    fn variances_solve_their_equations() {
        let mut word = words(67);
        let (mut tried, mut refused) = (0, 0);
        while tried < 30 {
            let cubic = [1, 4, 6, 4, 1];
            let mut entries = cubic.map(|a| cubic.map(|b| ((a * b) << 22) + word(26)));
            for class in 0..4_usize {
                let of = |k: &usize| k / 5 % 2 == class / 2 && k % 5 % 2 == class % 2;
                let sum: i32 = (0..25).filter(of).map(|k| entries[k / 5][k % 5]).sum();
                entries[2 - class / 2][2 - class % 2] += (1 << 28) - sum;
            }
            for (parts, free) in
                [(&CELL[..], Free::Level), (&SIDES[tried % 4][..], Free::Level), (&CELL[..], Free::Plane)]
            {
                let Some(law) = Law::new(&entries, parts, free) else {
                    refused += 1;
                    continue;
                };
                let mean = core::array::from_fn::<i64, 16, _>(|k| i64::from(word(20)) << (k % 4 * 7));
                let Some(square) = law.variance([[mean, mean]; 2].into_iter()) else {
                    refused += 1;
                    continue;
                };
                let seed = free
                    .closed(combined(&dyad(&mean, &mean), &[[0; 16]; 16], |a, _| halved(2 * a, parts.len())));
                let again = combined(&law.round(&square), &seed, i64::wrapping_add);
                let off = combined(&again, &square, i64::wrapping_sub);
                // one of many rounds that add `2^-30` at most
                assert!(free.size(&off) <= SMALL, "{} {free:?}", free.size(&off));
                assert!(law.rounds > 1 && free.size(&square) > SMALL);
            }
            tried += 1;
        }
        assert!(refused < 45, "{refused}");
        for (free, numbers) in [(Free::Level, 15), (Free::Plane, 13)] {
            let form = Form::new(free, &free.identity().map(|row| row.map(|entry| entry / 2))).unwrap();
            let heights = core::array::from_fn::<Q24, 16, _>(|_| word(26));
            let differences: std::vec::Vec<i64> = free.differences(&heights).collect();
            assert_eq!(differences.len(), numbers);
            let squares: i128 = differences.iter().map(|z| i128::from(*z) * i128::from(*z)).sum();
            assert!(differences.iter().all(|z| z.abs() < 1 << BITS) || free == Free::Plane);
            let got = form.of(&heights.map(Real::from_bits));
            let shift = if differences.iter().all(|z| z.abs() < 1 << BITS) { 0 } else { 40 };
            assert!((got - squares / 2).abs() <= 1 << shift, "{got} {squares}");
        }
        // a plane is nothing, however steep
        let plane: [Real; 16] =
            core::array::from_fn(|k| Real::from_num(20 * (k as i32 / 4) - 9 * (k as i32 % 4)));
        let form = Form::new(Free::Plane, &Free::Plane.identity()).unwrap();
        assert_eq!((form.of(&plane), Free::Level.size(&Free::Level.identity())), (0, ONE.unsigned_abs()));
    }
}
