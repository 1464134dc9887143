//! A square's samples as a decoder rounds them, and what a change of one level makes of their error.
//!
//! The format rounds three times: a column's term to 4 fractional bits, a wave to 7, a sample to none. At an
//! error of about one grey level that is a tenth of it, and it is known: it is not noise to be put up with.
//! So all three are done here as in core, in floating point: exact for samples of 8 bits. Of samples of 16
//! bits the waves have more bits than a float does; what that makes wrong is a part of a step of rounding.

use attractor::codec::shared::FREQUENCIES;
use pulp::Arch;

use super::cosine::{Coefficients, Cosine};

/// Adding it takes the fraction off.
const WHOLE: f32 = 12_582_912.0;

/// A square, and what a leaf makes of it.
pub(super) struct Rounded<'a> {
    cosine: &'a Cosine,
    /// Logarithm of its side.
    size: u32,
    /// Columns and rows that lie in the picture.
    seen: [usize; 2],
    /// Bits of a sample.
    bits: u32,
    /// In `2^-8`.
    step: u32,
    truth: Vec<f32>,
    /// What is drawn besides the waves, in `2^-7`.
    still: Vec<f32>,
    /// Of the mean, how many steps.
    mean: i32,
    /// The waves in `2^-7` before they are rounded, and the sums down each column of frequencies.
    waves: Vec<f32>,
    sums: Vec<i32>,
    /// What the processor can do.
    arch: Arch,
}

/// What a change adds: so much down the rows, times so much across.
pub(super) struct Wave<'a> {
    down: [f32; 32],
    across: &'a [f32],
}

const ONES: [f32; 32] = [1.0; 32];

impl<'a> Rounded<'a> {
    /// A square of whole samples that `truth` holds, with nothing drawn yet but 0.
    pub(super) fn new(
        cosine: &'a Cosine,
        (size, bits, step): (u32, u32, u32),
        seen: [u32; 2],
        truth: &[f32],
    ) -> Self {
        let n = 1 << size;
        let seen = seen.map(|seen| seen.min(n) as usize);
        let n = n as usize;
        let blank = vec![0.0; n * n];
        let (truth, sums) = (truth[..n * n].to_vec(), vec![0; n * n.min(FREQUENCIES)]);
        let (still, waves, arch) = (blank.clone(), blank, Arch::new());
        Self { cosine, size, seen, bits, step, truth, still, mean: 0, waves, sums, arch }
    }

    pub(super) const fn size(&self) -> u32 {
        self.size
    }

    /// Draws what the neighbours let expect and so many steps of a mean, in `2^-7`.
    pub(super) fn fill(&mut self, expected: i32, mean: i32) {
        let base = expected + self.moved(mean);
        self.still.fill(base as f32);
        self.mean = mean;
    }

    /// Draws a domain: so many eighths of a copy at full contrast, in `2^-7`.
    pub(super) fn copy(&mut self, copied: &[i32], eighths: i32) {
        for (still, copied) in self.still.iter_mut().zip(copied) {
            *still += (eighths * copied / 8) as f32;
        }
    }

    /// A mean of so many steps, in `2^-7`.
    fn moved(&self, mean: i32) -> i32 {
        let moved = (i64::from(mean) * i64::from(self.step) + (1 << self.size)) >> (1 + self.size);
        moved.clamp(-(1 << 25), 1 << 25) as i32
    }

    /// A column's term out of its sum.
    fn term(&self, sum: i32, column: u8) -> i32 {
        let k = 17 + self.size;
        let most = 1 << (5 + self.bits);
        let term = ((i64::from(sum) * i64::from(self.step) + (1 << (k - 1))) >> k) as i32;
        let term = term.clamp(-most, most - 1);
        if column > 0 { term } else { ((i64::from(term) * 11585 + (1 << 13)) >> 14) as i32 }
    }

    /// What so many steps more at a place of the scan add: of the mean at the first.
    pub(super) fn wave(&self, place: u8, by: i32) -> Wave<'a> {
        let n = 1 << self.size;
        if place == 0 {
            let more = self.moved(self.mean + by) - self.moved(self.mean);
            return Wave { down: [more as f32; 32], across: &ONES };
        }
        let (row, column) = (place >> 4, place & 15);
        let mut down = [0.0; 32];
        let sums = self.sums[n * usize::from(column)..].iter();
        for ((down, sum), c) in down.iter_mut().zip(sums).zip(self.cosine.down(self.size, row)) {
            *down = (self.term(sum.wrapping_add(by * c), column) - self.term(*sum, column)) as f32;
        }
        Wave { down, across: self.cosine.across(self.size, column) }
    }

    /// Squared error, once a wave is added.
    pub(super) fn error(&self, wave: &Wave<'_>) -> f32 {
        match self.size {
            2 => self.arch.dispatch(
                #[inline(always)]
                || self.error_of::<4>(wave),
            ),
            3 => self.arch.dispatch(
                #[inline(always)]
                || self.error_of::<8>(wave),
            ),
            4 => self.arch.dispatch(
                #[inline(always)]
                || self.error_of::<16>(wave),
            ),
            _ => self.arch.dispatch(
                #[inline(always)]
                || self.error_of::<32>(wave),
            ),
        }
    }

    /// The same in a square of `N` a side: a sum for each column.
    #[inline(always)]
    fn error_of<const N: usize>(&self, wave: &Wave<'_>) -> f32 {
        let [columns, rows] = self.seen;
        let peak = ((1 << self.bits) - 1) as f32;
        let Some(across) = wave.across.first_chunk::<N>() else { return 0.0 };
        let [truth, still, waves] =
            [&self.truth, &self.still, &self.waves].map(|square| rows_of::<N>(square));
        let mut sums = [0.0_f32; N];
        for (((truth, still), waves), down) in truth.zip(still).zip(waves).zip(&wave.down).take(rows) {
            for j in 0..N {
                let wave = (waves[j] + down * across[j] + WHOLE) - WHOLE;
                // halves up: a number of 7 fractional bits and a half is never between two samples
                let sample = ((wave + still[j] + 0.5) * (1.0 / 128.0) + WHOLE) - WHOLE;
                let off = truth[j] - sample.clamp(0.0, peak);
                sums[j] += off * off;
            }
        }
        sums[..columns].iter().sum()
    }

    /// Makes the change.
    pub(super) fn add(&mut self, place: u8, by: i32) {
        let n = 1 << self.size;
        let Wave { down, across } = self.wave(place, by);
        if place == 0 {
            self.still.iter_mut().for_each(|still| *still += down[0]);
            self.mean += by;
            return;
        }
        for (row, down) in self.waves.chunks_exact_mut(n).zip(down) {
            for (wave, across) in row.iter_mut().zip(across) {
                *wave += down * across;
            }
        }
        let sums = self.sums[n * usize::from(place & 15)..].iter_mut();
        for (sum, c) in sums.zip(self.cosine.down(self.size, place >> 4)) {
            *sum = sum.wrapping_add(by * c);
        }
    }

    /// What is left of the truth before samples are rounded, by frequency.
    pub(super) fn left(&self, into: &mut Coefficients) {
        let drawn = self.still.iter().zip(&self.waves).map(|(still, wave)| (still + wave) * (1.0 / 128.0));
        let rest: Vec<f32> = self.truth.iter().zip(drawn).map(|(truth, drawn)| truth - drawn).collect();
        self.cosine.forward(self.size, &rest, into);
    }
}

/// Rows of `N`.
#[inline(always)]
pub(super) fn rows_of<const N: usize>(square: &[f32]) -> impl Iterator<Item = &[f32; N]> {
    square.chunks_exact(N).filter_map(|row| row.first_chunk())
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use attractor::codec::shared::{Leaf, Plane, scan};
    use attractor::codec::{Header, Planes, Profile, Step};
    use embedded_graphics::geometry::Size;

    use super::*;

    #[test]
    fn samples_are_rounded_as_the_decoder_rounds_them() {
        let (cosine, mut random, mut tried) = (Cosine::new(), 1_u64, 0);
        let mut below = move |most: u64| {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (random >> 33) % most
        };
        for turn in 0..400_u32 {
            let size = 2 + turn % 4;
            let header = Header {
                version: Header::VERSION,
                size: Size::new(1 + below(40) as u32, 1 + below(40) as u32),
                profile: Profile::Streaming,
                planes: Planes::Grey,
                deep: false,
                step: Step::from_bits(0x300 + below(0x700) as u16).unwrap(),
                reach: 8,
                chroma: 0,
                payload: 0,
            };
            let shape = header.shapes(0)[0];
            let mut memory = vec![0_u8; Plane::<u8>::samples(&shape)];
            let mut rest = Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells();
            let mut plane = Plane::new(shape, &mut rest);
            plane.begin(0, 0);
            let mut leaf = Leaf { mean: below(9) as i32 - 4, ..Leaf::default() };
            let seen = [shape.width, shape.height];
            let truth: [f32; 1024] = std::array::from_fn(|_| below(256) as f32);
            let mut rounded = Rounded::new(&cosine, (size, 8, shape.step), seen, &truth);
            rounded.fill(plane.expected(0, 0, size), leaf.mean - 1);
            rounded.add(0, 1);
            for _ in 0..below(7) {
                let place = scan(size)[1 + below(scan(size).len() as u64 - 1) as usize];
                let by = below(5) as i32 - 2;
                leaf.levels.set(place, leaf.levels.get(place) + by);
                // what a change will make of the error is what it is once the change is made
                let error = rounded.error(&rounded.wave(place, by));
                rounded.add(place, by);
                assert_eq!(rounded.error(&rounded.wave(0, 0)), error, "{size} {place}");
            }
            assert!(plane.draw(&leaf, 0, 0, size));
            let (wide, n) = (shape.width as usize, 1 << size);
            let mut error = 0.0;
            for (i, row) in plane.picture().chunks(wide).enumerate().take(n.min(shape.height as usize)) {
                for (j, sample) in row.iter().enumerate().take(n) {
                    error += (truth[i * n + j] - f32::from(sample.get())).powi(2);
                    tried += 1;
                }
            }
            assert_eq!(rounded.error(&rounded.wave(0, 0)), error, "{size} {leaf:?}");
        }
        assert!(tried > 40_000, "{tried}");
    }
}
