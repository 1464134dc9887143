//! The cosine transform of a square: its 16 lowest frequencies along each axis.

use std::f64::consts::PI;

use attractor::codec::shared::FREQUENCIES;

/// Coefficients, `16 v + u`.
pub(super) type Coefficients = [f32; FREQUENCIES * FREQUENCIES];

/// Rows of cosines for squares of 4, 8, 16 and 32.
pub(super) struct Cosine {
    /// Of length 1.
    waves: [Vec<f32>; 4],
    /// As the format has them: down the columns of frequencies, with 14 fractional bits, and along the rows,
    /// which `2^11` divides there.
    down: [Vec<i32>; 4],
    across: [Vec<f32>; 4],
}

/// A row of so many frequencies for each of the sizes.
fn rows<T>(mut value: impl FnMut(usize, usize, usize) -> T) -> [Vec<T>; 4] {
    [4, 8, 16, 32].map(|n| {
        let places = (0..n.min(FREQUENCIES)).flat_map(|v| (0..n).map(move |j| (v, j)));
        places.map(|(v, j)| value(n, v, j)).collect()
    })
}

impl Cosine {
    pub(super) fn new() -> Self {
        let cosine = |n: usize, v: usize, j: usize| (PI * ((2 * j + 1) * v) as f64 / (2 * n) as f64).cos();
        let whole = |n: usize, v: usize, j: usize| (16384.0 * cosine(n, v, j)).round() as i32;
        let scale = |n: usize, v: usize| (if v == 0 { 1.0 } else { 2.0 } / n as f64).sqrt();
        Self {
            waves: rows(|n, v, j| (scale(n, v) * cosine(n, v, j)) as f32),
            down: rows(|n, v, j| if v == 0 { 11585 } else { whole(n, v, j) }),
            across: rows(|n, u, j| whole(n, u, j) as f32 / 2048.0),
        }
    }

    /// A frequency down a square of `2^size`, in whole numbers.
    pub(super) fn down(&self, size: u32, frequency: u8) -> &[i32] {
        row(&self.down, size, frequency)
    }

    /// A frequency across it.
    pub(super) fn across(&self, size: u32, frequency: u8) -> &[f32] {
        row(&self.across, size, frequency)
    }

    /// Of a square of `2^size`, row after row.
    pub(super) fn forward(&self, size: u32, square: &[f32], into: &mut Coefficients) {
        match size {
            2 => forward::<4, 4>(&self.waves[0], square, into),
            3 => forward::<8, 8>(&self.waves[1], square, into),
            4 => forward::<16, 16>(&self.waves[2], square, into),
            _ => forward::<32, 16>(&self.waves[3], square, into),
        }
    }
}

/// Of all rows of a size that of a frequency.
fn row<T>(rows: &[Vec<T>; 4], size: u32, frequency: u8) -> &[T] {
    let start = usize::from(frequency) << size;
    &rows[(size - 2) as usize][start..start + (1 << size)]
}

fn forward<const N: usize, const M: usize>(cosines: &[f32], square: &[f32], into: &mut Coefficients) {
    let mut columns = [[0_f32; N]; M];
    for (i, row) in square.chunks_exact(N).enumerate().take(N) {
        for (v, column) in columns.iter_mut().enumerate() {
            let c = cosines[v * N + i];
            for (sum, value) in column.iter_mut().zip(row) {
                *sum += c * value;
            }
        }
    }
    // turned, so that the inner loop runs along frequencies
    let mut turned = [[0_f32; M]; N];
    for (u, row) in cosines.chunks_exact(N).enumerate().take(M) {
        for (turned, c) in turned.iter_mut().zip(row) {
            turned[u] = *c;
        }
    }
    for (column, into) in columns.iter().zip(into.chunks_exact_mut(FREQUENCIES)) {
        let mut sums = [0_f32; M];
        for (value, cosines) in column.iter().zip(&turned) {
            for (sum, c) in sums.iter_mut().zip(cosines) {
                *sum += value * c;
            }
        }
        into[..M].copy_from_slice(&sums);
    }
}
