//! The graph of a function as measurements see it: ordinates of the fixed-point kernel, and what theory needs to know.

use attractor::num::Wide;

use super::function::{Fixed, Function};

/// A function on its domain.
#[derive(Debug)]
pub(crate) struct Graph<'a> {
    fixed: &'a Fixed,
    /// The vertical scalings, if all maps are affine.
    pub(crate) scalings: Option<Vec<f64>>,
    /// How many intervals there are, if all have one width.
    pub(crate) equal_intervals: Option<usize>,
}

impl<'a> Graph<'a> {
    pub(super) fn new(function: &'a Function) -> Self {
        let maps = &function.reference.maps;
        let affine = maps.iter().all(|m| m.q.iter().skip(2).all(|c| *c == 0.0));
        let x: Vec<f64> = function.reference.knots().iter().map(|k| k.0).collect();
        let widths: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mean = widths.iter().sum::<f64>() / widths.len().max(1) as f64;
        let equal = widths.iter().all(|w| (w - mean).abs() < 1e-9 * mean);
        Self {
            fixed: &function.fixed,
            scalings: affine.then(|| maps.iter().map(|m| m.vertical_scaling).collect()),
            equal_intervals: equal.then_some(widths.len()),
        }
    }

    /// The ordinate at `i / n` of the domain.
    pub(crate) fn at(&self, i: u64, n: u64) -> f64 {
        let (from, to) = self.fixed.domain();
        let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
        let n = i128::from(n.max(1));
        let offset = (2 * width * i128::from(i) + n).div_euclid(2 * n);
        self.fixed.at(Wide::from_bits((i128::from(from.to_bits()) + offset) as i64)).to_num()
    }
}
