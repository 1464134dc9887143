//! The cosine transform of a square: its 16 lowest frequencies along each axis.

use std::f64::consts::PI;

use attractor::codec::shared::FREQUENCIES;

/// Coefficients, `16 v + u`.
pub(super) type Coefficients = [f32; FREQUENCIES * FREQUENCIES];

/// Rows of cosines for squares of 4, 8, 16 and 32.
pub(super) struct Cosine([Vec<f32>; 4]);

impl Cosine {
    pub(super) fn new() -> Self {
        Self([4, 8, 16, 32].map(|n| {
            let row = |v: usize| {
                let scale = if v == 0 { (1.0 / n as f64).sqrt() } else { (2.0 / n as f64).sqrt() };
                (0..n).map(move |j| (scale * (PI * ((2 * j + 1) * v) as f64 / (2 * n) as f64).cos()) as f32)
            };
            (0..n.min(FREQUENCIES)).flat_map(row).collect()
        }))
    }

    /// A frequency along one axis of a square of `2^size`.
    pub(super) fn wave(&self, size: u32, frequency: u8) -> &[f32] {
        let start = usize::from(frequency) << size;
        &self.0[(size - 2) as usize][start..start + (1 << size)]
    }

    /// Of a square of `2^size`, row after row.
    pub(super) fn forward(&self, size: u32, square: &[f32], into: &mut Coefficients) {
        match size {
            2 => forward::<4, 4>(&self.0[0], square, into),
            3 => forward::<8, 8>(&self.0[1], square, into),
            4 => forward::<16, 16>(&self.0[2], square, into),
            _ => forward::<32, 16>(&self.0[3], square, into),
        }
    }
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
