//! The graph of a function as measurements see it: ordinates of the fixed-point kernel, and what theory says.

use attractor::num::Wide;

use super::function::{Fixed, Function};
use super::law::Law;
use crate::fail::Fail;
use crate::theory::{Theory, graph_dimension, graph_spectrum};

/// Halvings of an interval of a random function.
const LEVELS: u32 = 14;
/// Logarithm of the number of equal steps along the whole of a function.
const STEPS: u32 = 20;

/// Graphs of one dimension and spectrum.
pub(crate) struct Graph<'a> {
    functions: Functions<'a>,
    pub(crate) dimension: Theory,
    pub(crate) spectrum: Option<Theory>,
}

enum Functions<'a> {
    One(&'a Fixed),
    Many(Vec<Vec<f64>>),
}

impl<'a> Graph<'a> {
    pub(super) fn of_function(function: &'a Function) -> Self {
        let reference = &function.reference;
        let x: Vec<f64> = reference.knots().iter().map(|k| k.0).collect();
        let (first, last) = (x.first().copied().unwrap_or(0.0), x.last().copied().unwrap_or(1.0));
        let widths = x.windows(2).map(|pair| (pair[1] - pair[0]) / (last - first));
        let maps: Vec<(f64, f64)> = reference.maps.iter().map(|m| m.vertical_scaling).zip(widths).collect();
        Self {
            functions: Functions::One(&function.fixed),
            dimension: graph_dimension(&maps),
            spectrum: graph_spectrum(&maps),
        }
    }

    pub(super) fn of_law(law: &Law) -> Result<Self, Fail> {
        let ordinates = |curve: Vec<(f64, f64)>| curve.into_iter().map(|p| p.1).collect();
        let spectrum = law.spectrum();
        let beta = spectrum.as_ref().map_or(3.0, |t| t.value);
        Ok(Self {
            functions: Functions::Many(law.curves(LEVELS)?.into_iter().map(ordinates).collect()),
            dimension: Theory::new((5.0 - beta) / 2.0, "(5 - beta) / 2"),
            spectrum,
        })
    }

    /// Ordinates at equal distances, `2^k + 1` of each function: `most` at most in all, or as many as there
    /// are.
    pub(crate) fn ordinates(&self, most: u32) -> Vec<Vec<f64>> {
        match &self.functions {
            Functions::One(fixed) => {
                let n = 1_u64 << most.min(STEPS);
                vec![(0..=n).map(|i| ordinate(fixed, i, n)).collect()]
            }
            Functions::Many(curves) => curves.clone(),
        }
    }

    /// How many functions are measured together.
    pub(crate) fn count(&self) -> usize {
        match &self.functions {
            Functions::One(_) => 1,
            Functions::Many(curves) => curves.len(),
        }
    }
}

/// The ordinate at `i / n` of the domain.
fn ordinate(fixed: &Fixed, i: u64, n: u64) -> f64 {
    let (from, to) = fixed.domain();
    let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
    let n = i128::from(n.max(1));
    let offset = (2 * width * i128::from(i) + n).div_euclid(2 * n);
    fixed.at(Wide::from_bits((i128::from(from.to_bits()) + offset) as i64)).to_num()
}
