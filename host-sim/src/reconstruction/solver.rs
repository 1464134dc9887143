//! Levenberg-Marquardt on all numbers and heights at once.
//!
//! The error `sum |Q_ij - F(i, j)|^2` is a polynomial of the parameters, with exact derivatives ([`Table`])
//! in place of the text's finite differences. A step solves `(J'J + mu diag(J'J)) x = J'r`; one that does not
//! lessen the error, whose maps are not proven to contract or whose heights are too great, is refused, and
//! `mu` grows. Each sample depends on the heights of its own cell only: `J'J` is summed from rows of a few
//! dozen entries, never from `J`.
//!
//! Why no ready solver: those of `levenberg-marquardt` and `argmin` end where a trial step has no value, and
//! ask for `J` as a whole. The linear algebra is that of `nalgebra`.
//!
//! Source: D. W. Marquardt, 1963; Tosan, Guerin, Baskurt, section 6.2.

use nalgebra::{DMatrix, DVector};

use super::family::Family;
use super::scheme::Scheme;
use super::table::Table;

/// Samples on a square grid, row after row.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    /// Along a side.
    pub(crate) side: usize,
    pub(crate) values: Vec<f64>,
}

impl Samples {
    /// The peak signal to noise ratio of something else, in decibels; the peak is the range of these.
    /// Infinite without an error.
    pub(crate) fn psnr(&self, squared_error: f64) -> f64 {
        let range = self.range();
        10.0 * (range * range * self.values.len() as f64 / squared_error).log10()
    }

    /// The greatest value less the least.
    pub(crate) fn range(&self) -> f64 {
        let least = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        self.values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
    }
}

/// What is fitted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Model {
    pub(crate) family: Family,
    /// Cells along a side.
    pub(crate) cells: usize,
    /// A cell has `2^levels` samples along a side.
    pub(crate) levels: u32,
    /// As [`Family::tether`] says.
    pub(crate) tether: f64,
}

/// A surface of a model.
#[derive(Debug, Clone)]
pub(crate) struct Fitted {
    pub(crate) numbers: Vec<f64>,
    pub(crate) heights: Vec<f64>,
    /// The sum of squares.
    pub(crate) error: f64,
    pub(crate) steps: u32,
}

/// The middle of the samples, which are in `[0, 1]`.
const MIDDLE: f64 = 0.5;

impl Model {
    /// For each sample: the places of its heights, its weights and its derivatives by numbers.
    fn for_each(
        &self,
        table: &Table,
        heights: &[f64],
        mut take: impl FnMut(usize, &[usize], &[f64], &[f64]),
    ) {
        let (side, step) = self.family.cell();
        let across = self.family.side(self.cells);
        let parts = table.side - 1;
        let samples = self.cells * parts + 1;
        let mut places = vec![0; table.width];
        let mut slopes = Vec::new();
        for x in 0..samples {
            for y in 0..samples {
                let [ci, cj] = [x, y].map(|k| (k / parts).min(self.cells - 1));
                for (k, place) in places.iter_mut().enumerate() {
                    *place = (ci * step + k / side) * across + cj * step + k % side;
                }
                let (i, j) = (x - ci * parts, y - cj * parts);
                slopes.clear();
                slopes.extend(table.slopes(i, j).chunks(table.width).map(|slope| {
                    slope.iter().zip(&places).map(|(w, place)| w * heights[*place]).sum::<f64>()
                }));
                take(x * samples + y, &places, table.weights(i, j), &slopes);
            }
        }
    }

    fn squared_error(&self, samples: &Samples, numbers: &[f64], heights: &[f64]) -> f64 {
        let table = Table::new(self.family, numbers, self.levels, false);
        let mut sum = 0.0;
        self.for_each(&table, heights, |sample, places, weights, _| {
            let value: f64 = weights.iter().zip(places).map(|(w, place)| w * heights[*place]).sum();
            sum += (samples.values[sample] - value).powi(2);
        });
        sum
    }

    /// Whether core takes it for a surface.
    pub(crate) fn is_one(&self, numbers: &[f64], heights: &[f64]) -> bool {
        Scheme::is_one(self.family, numbers, heights, self.cells)
    }

    /// `J'J` and `J'r`: heights first, then numbers if their derivatives are in the table.
    fn normal_equations(
        &self,
        samples: &Samples,
        table: &Table,
        heights: &[f64],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let count = self.family.side(self.cells).pow(2);
        let numbers = table.slopes(0, 0).len() / table.width;
        let mut matrix = DMatrix::zeros(count + numbers, count + numbers);
        let mut right = DVector::zeros(count + numbers);
        let mut row = Vec::new();
        self.for_each(table, heights, |sample, places, weights, slopes| {
            let value: f64 = weights.iter().zip(places).map(|(w, place)| w * heights[*place]).sum();
            let rest = samples.values[sample] - value;
            row.clear();
            row.extend(places.iter().copied().zip(weights.iter().copied()));
            row.extend((count..).zip(slopes.iter().copied()));
            for (n, (i, a)) in row.iter().enumerate() {
                right[*i] += a * rest;
                let column = &mut matrix.as_mut_slice()[i * (count + numbers)..(i + 1) * (count + numbers)];
                for (j, b) in &row[..=n] {
                    column[*j] += a * b;
                }
            }
        });
        matrix.fill_lower_triangle_with_upper_triangle();
        (matrix, right)
    }

    /// The best heights for some numbers: linear least squares.
    fn heights(&self, samples: &Samples, numbers: &[f64]) -> Option<Vec<f64>> {
        let table = Table::new(self.family, numbers, self.levels, false);
        let count = self.family.side(self.cells).pow(2);
        let zeros = vec![0.0; count];
        let (mut matrix, mut right) = self.normal_equations(samples, &table, &zeros);
        let (floor, tether) = (1e-12 * matrix.diagonal().max(), self.tether);
        for k in 0..count {
            matrix[(k, k)] += floor + tether;
            right[k] += tether * MIDDLE;
        }
        Some(matrix.cholesky()?.solve(&right).as_slice().to_vec())
    }

    /// The surface that is nearest to the samples, from some numbers on. `progress` is told the error after
    /// each step that was taken.
    pub(crate) fn fit(
        &self,
        samples: &Samples,
        start: &[f64],
        most_steps: u32,
        mut progress: impl FnMut(u32, f64),
    ) -> Option<Fitted> {
        let heights = self.heights(samples, start)?;
        let error = self.squared_error(samples, start, &heights);
        let mut best = Fitted { numbers: start.to_vec(), heights, error, steps: 0 };
        if !error.is_finite() {
            return None;
        }
        progress(0, error);
        let mut damping = 1e-3;
        // how strongly numbers are drawn to those of the start, where maps are known to contract
        let mut pull = self.family.pull();
        let (mut idle, tether) = (0, self.tether);
        while best.steps < most_steps {
            let table = Table::new(self.family, &best.numbers, self.levels, true);
            let (matrix, right) = self.normal_equations(samples, &table, &best.heights);
            let floor = 1e-9 * matrix.diagonal().max();
            let count = best.heights.len();
            let away = |numbers: &[f64]| numbers.iter().zip(start).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            let mut taken = None;
            for _ in 0..12 {
                let (mut damped, mut right) = (matrix.clone(), right.clone());
                for k in 0..damped.nrows() {
                    damped[(k, k)] += damping * (matrix[(k, k)] + floor);
                }
                for (k, height) in best.heights.iter().enumerate() {
                    damped[(k, k)] += tether;
                    right[k] -= tether * (height - MIDDLE);
                }
                for (k, (number, from)) in best.numbers.iter().zip(start).enumerate() {
                    damped[(count + k, count + k)] += pull;
                    right[count + k] -= pull * (number - from);
                }
                let Some(solver) = damped.cholesky() else {
                    damping *= 4.0;
                    continue;
                };
                let step = solver.solve(&right);
                let moved = |old: &[f64], from: usize| -> Vec<f64> {
                    old.iter().zip(step.iter().skip(from)).map(|(a, b)| a + b).collect()
                };
                let (heights, numbers) = (moved(&best.heights, 0), moved(&best.numbers, count));
                let error = self.squared_error(samples, &numbers, &heights);
                let cost = |error: f64, numbers: &[f64], heights: &[f64]| {
                    let apart: f64 = heights.iter().map(|height| (height - MIDDLE).powi(2)).sum();
                    error + pull * away(numbers) + tether * apart
                };
                // false for an error that is no number, too
                let before = cost(best.error, &best.numbers, &best.heights);
                let better = cost(error, &numbers, &heights) < before;
                if better && self.is_one(&numbers, &heights) {
                    taken = Some(Fitted { numbers, heights, error, steps: best.steps + 1 });
                    damping = (damping / 5.0_f64).max(1e-12);
                    break;
                }
                damping *= 4.0;
            }
            let Some(next) = taken else { break };
            let gain = (best.error - next.error).abs() / best.error;
            best = next;
            progress(best.steps, best.error);
            idle = if gain < 1e-5 { idle + 1 } else { 0 };
            if idle > 2 || best.error < 1e-18 * samples.values.len() as f64 {
                break;
            }
            if gain < 1e-2 {
                pull /= 10.0;
            }
        }
        Some(best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takagi's function at a dyadic place.
    fn takagi(x: f64) -> f64 {
        (0..40)
            .map(|n| x * f64::powi(2.0, n))
            .zip(0..)
            .map(|(y, n)| (y - y.round()).abs() / f64::powi(2.0, n))
            .sum()
    }

    fn samples(side: usize, value: impl Fn(f64, f64) -> f64) -> Samples {
        let place = |k: usize| k as f64 / (side - 1) as f64;
        let values = (0..side * side).map(|k| value(place(k / side), place(k % side))).collect();
        Samples { side, values }
    }

    /// The text's patch and the product of curves find a product of Takagi curves exactly, within 30 steps.
    #[test]
    fn a_product_of_takagi_curves_is_found_exactly() {
        let samples = samples(33, |x, y| 2.25 * takagi(x) * takagi(y));
        for family in [Family::Standard, Family::Tensor] {
            let model = Model { family, cells: 1, levels: 5, tether: family.tether() };
            let mut errors = Vec::new();
            let fitted = model.fit(&samples, &family.starts()[0], 30, |_, error| errors.push(error)).unwrap();
            let reached = samples.psnr(fitted.error);
            assert!(
                reached > 120.0 && model.is_one(&fitted.numbers, &fitted.heights),
                "{family:?}: {reached}"
            );
            assert!(samples.psnr(errors[0]) < 40.0 && errors.len() as u32 == fitted.steps + 1);
        }
    }

    /// The derivatives are those of the surface: a step of a millionth changes it by as much as they say.
    #[test]
    fn derivatives_are_those_of_differences() {
        for family in [Family::Standard, Family::Tensor, Family::Lattice] {
            let numbers = &family.starts()[0];
            let (table, count) = (Table::new(family, numbers, 2, true), family.numbers());
            let (mut most, mut greatest) = (0.0_f64, 0.0_f64);
            for p in 0..count {
                let moved = |by: f64| {
                    let mut numbers = numbers.clone();
                    numbers[p] += by;
                    Table::new(family, &numbers, 2, false)
                };
                let (less, more) = (moved(-1e-5), moved(1e-5));
                for (i, j) in (0..25).map(|k| (k / 5, k % 5)) {
                    let slopes = &table.slopes(i, j)[p * table.width..(p + 1) * table.width];
                    for ((slope, a), b) in slopes.iter().zip(less.weights(i, j)).zip(more.weights(i, j)) {
                        most = most.max((slope - (b - a) / 2e-5).abs());
                        greatest = greatest.max(slope.abs());
                    }
                }
            }
            assert!(most < 1e-6 && greatest > 0.5, "{family:?}: {most} {greatest}");
        }
    }

    /// A lattice comes nearer and nearer than the cubic spline that it starts from, but for what its tether
    /// takes. No step raises the cost, which proves a bound of all heights; it is a weak one, as the tether
    /// is: what the tether is for is seen beside a fit without it.
    #[test]
    fn a_fit_comes_nearer() {
        let hills =
            samples(33, |x, y| (7.0 * x).sin() * (5.0 * y + x).cos() / 2.0 + (23.0 * x * y).sin() / 9.0);
        let (family, start) = (Family::Lattice, &Family::Lattice.starts()[0]);
        let model = Model { family, cells: 4, levels: 3, tether: family.tether() };
        let mut errors = Vec::new();
        let fitted = model.fit(&hills, start, 20, |_, error| errors.push(error)).unwrap();
        assert!(errors.len() > 3 && fitted.error < 0.3 * errors[0], "{errors:?}");
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0] * 1.01), "{errors:?}");
        let away = |heights: &[f64]| heights.iter().map(|height| (height - MIDDLE).powi(2)).sum::<f64>();
        let cost = |fitted: &Fitted| fitted.error + model.tether * away(&fitted.heights);
        let before = model.fit(&hills, start, 0, |_, _| ()).unwrap();
        assert!(cost(&fitted) < cost(&before));
        // so that `tether (height - middle)^2` is at most what the cost was, less the error that is left
        let largest = |heights: &[f64]| heights.iter().map(|h| (h - MIDDLE).abs()).fold(0.0, f64::max);
        let bound = ((cost(&before) - fitted.error) / model.tether).sqrt();
        assert!(largest(&fitted.heights) <= bound, "{bound}");
        let free = Model { tether: 0.0, ..model }.fit(&hills, start, 20, |_, _| ()).unwrap();
        let [tied, free] = [&fitted, &free].map(|fitted| largest(&fitted.heights));
        assert!(tied > 2.0 && free > 3.0 * tied, "{tied} {free}, at most {bound}");
    }
}
