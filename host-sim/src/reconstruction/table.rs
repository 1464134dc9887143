//! The weights of every place of a cell, and their derivatives: all cells share them.
//!
//! `phi(digit, rest) = T_digit phi(rest)` and `d phi = T d phi + dT phi`: exact at every dyadic place, by as
//! many products as there are places.

use super::family::{Change, Family, Maps};

/// Weights at `(2^levels + 1)^2` places.
pub(crate) struct Table {
    /// Places along a side, the end included.
    pub(crate) side: usize,
    /// Weights a place.
    pub(crate) width: usize,
    weights: Vec<f64>,
    /// Number by number.
    slopes: Vec<f64>,
    numbers: usize,
}

impl Table {
    /// With derivatives, if they are asked for.
    pub(crate) fn new(family: Family, numbers: &[f64], levels: u32, with_slopes: bool) -> Self {
        let maps = family.maps(numbers);
        let changes = family.changes(numbers);
        let corners = family.corners(&maps, &changes);
        let changes = if with_slopes { changes } else { Vec::new() };
        let width = maps[0].nrows();
        let count = changes.len();
        let weights = corners.iter().flat_map(|(weights, _)| weights.iter().copied()).collect();
        let slopes =
            corners.iter().flat_map(|(_, slopes)| slopes.iter().take(count).flatten().copied()).collect();
        let mut table = Self { side: 2, width, weights, slopes, numbers: count };
        let rows = sparse(&maps);
        for _ in 0..levels {
            table = table.finer(&rows, &changes);
        }
        table
    }

    pub(crate) fn weights(&self, i: usize, j: usize) -> &[f64] {
        let place = i * self.side + j;
        &self.weights[place * self.width..(place + 1) * self.width]
    }

    /// The derivatives by every number, one after the other.
    pub(crate) fn slopes(&self, i: usize, j: usize) -> &[f64] {
        let (place, length) = (i * self.side + j, self.width * self.numbers);
        &self.slopes[place * length..(place + 1) * length]
    }

    fn finer(&self, maps: &[Vec<Vec<(usize, f64)>>; 4], changes: &[Vec<Change>]) -> Self {
        let (parts, width) = (self.side - 1, self.width);
        let side = 2 * parts + 1;
        let mut weights = Vec::with_capacity(side * side * width);
        let mut slopes = Vec::with_capacity(side * side * width * self.numbers);
        for i in 0..side {
            for j in 0..side {
                let [di, dj] = [i, j].map(|k| usize::from(k >= parts && k > 0));
                let (map, own) = (2 * di + dj, (i - di * parts, j - dj * parts));
                let old = self.weights(own.0, own.1);
                let image = |of: &[f64]| {
                    maps[map]
                        .iter()
                        .map(|row| row.iter().map(|(k, t)| t * of[*k]).sum())
                        .collect::<Vec<f64>>()
                };
                weights.extend(image(old));
                let old_slopes = self.slopes(own.0, own.1);
                for (changes, old_slope) in changes.iter().zip(old_slopes.chunks(width)) {
                    let mut slope = image(old_slope);
                    for (of, row, column, by) in changes {
                        if *of == map {
                            slope[*row] += by * old[*column];
                        }
                    }
                    slopes.extend(slope);
                }
            }
        }
        Self { side, width, weights, slopes, numbers: self.numbers }
    }
}

/// The entries of each row that are not 0.
fn sparse(maps: &Maps) -> [Vec<Vec<(usize, f64)>>; 4] {
    maps.each_ref().map(|map| {
        (0..map.nrows())
            .map(|row| (0..map.ncols()).map(|k| (k, map[(row, k)])).filter(|(_, t)| *t != 0.0).collect())
            .collect()
    })
}
