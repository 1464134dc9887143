//! Laws of random curves as measurements see them: 64 curves of each, and what theory says about their
//! halves.
//!
//! A part of length 1 becomes two of random length `r = |1/2 + g|`, alike in distribution. With that:
//! - Carpenter's ratio is the mean of `2 r`, and his dimension `D = ln 2 / ln(2 / ratio)`: `2^k` chords of
//!   mean length `(ratio / 2)^k`;
//! - the mean square of a chord falls as `2^(1 - beta)` a halving, so that `beta = 1 - log2(mean of r^2)` and
//!   `D = 2 / (beta - 1)` by mean squares;
//! - the dimension of the limit set is the solution of `2 mean(r^D) = 1` (R. D. Mauldin, S. C. Williams,
//!   "Random recursive constructions", 1986; K. Falconer, "Random fractals", 1986), where the parts do not
//!   overlap. It lies above Carpenter's: few long parts count for more than many short ones.

use attractor::curve::{Stop, Subdivision};
use attractor::num::Parameter;
use attractor::num::Real;
use attractor::plane::{PathElement, Point2};

use super::law::Law;
use crate::fail::Fail;
use crate::theory::{Theory, expected, root};

/// How many curves are measured.
pub(crate) const CURVES: usize = 64;

/// How the dimension of a curve shows in its chords.
pub(crate) struct Chords {
    /// 1 for their mean length, 2 for their mean square.
    pub(crate) order: i32,
    pub(crate) theory: Option<Theory>,
}

impl Law {
    /// `2^levels + 1` points at equal parameters of each of 64 curves, independent of one another, each from
    /// `(0, 0)` to `(1, 0)`.
    pub(crate) fn curves(&self, levels: u32) -> Result<Vec<Vec<(f64, f64)>>, Fail> {
        // what lies between two knots is a curve of its own
        let first = -(CURVES as i32) / 2;
        let knot = |i: usize| Point2::new(Real::from_num(first + i as i32), Real::ZERO);
        let knots: Vec<Point2> = (0..=CURVES).map(knot).collect();
        let step = Stop::Parameter(Parameter::from_bits(1 << 32 >> levels));
        let all = Subdivision::<_, 20>::new(self, &knots, step).map_err(Fail::new)?;
        let points: Vec<(f64, f64)> = all
            .map(|(PathElement::MoveTo(p) | PathElement::LineTo(p))| {
                (p.x.to_num::<f64>(), p.y.to_num::<f64>())
            })
            .collect();
        let curve = |i: usize| {
            let from = f64::from(first) + i as f64;
            let points = points.iter().skip(i << levels).take((1 << levels) + 1);
            points.map(|(x, y)| (x - from, *y)).collect()
        };
        Ok((0..CURVES).map(curve).collect())
    }

    /// The mean of `r^q` in the end, when the law is the same at all scales.
    fn mean(&self, q: f64) -> f64 {
        let across = |variance: f64| expected(|r| (0.25 + variance * r * r).powf(q / 2.0));
        match self {
            Self::Elbow(_, beta) => across((1.0 - beta).exp2() - 0.25),
            // along x, where a part is halved exactly
            Self::LineToLine(..) => 0.5_f64.powf(q),
            Self::OneVariable(law) => across(law.offset().to_num::<f64>().powi(2)),
            Self::TwoVariable(_, o) => {
                expected(|r| expected(|s| ((0.5 + o * r).powi(2) + (o * s).powi(2)).powf(q / 2.0)))
            }
        }
    }

    /// The spectral exponent; none below 1.
    pub(crate) fn spectrum(&self) -> Option<Theory> {
        match self {
            Self::Elbow(_, beta) | Self::LineToLine(_, beta) => Some(Theory::new(*beta, "as the scene asks")),
            _ => {
                let beta = 1.0 - self.mean(2.0).log2();
                let source = "1 - log2(mean square of a half's length over the whole's)";
                (beta >= 1.0).then(|| Theory::new(beta, source))
            }
        }
    }

    /// The dimension by chords, as the law's author defines it.
    pub(crate) fn chords(&self) -> Chords {
        match self {
            Self::Elbow(_, beta) | Self::LineToLine(_, beta) => {
                let source = "2 / (beta - 1): mean squares of chords fall as 2^(1 - beta) a halving";
                Chords { order: 2, theory: (*beta > 1.0).then(|| Theory::new(2.0 / (beta - 1.0), source)) }
            }
            _ => {
                let ratio = 2.0 * self.mean(1.0);
                let source =
                    format!("ln 2 / ln(2 / ratio), ratio {ratio:.4}: Carpenter, from the similarity ratio");
                let theory = (ratio < 2.0).then(|| Theory::new((2.0 / ratio).log2().recip(), source));
                Chords { order: 1, theory }
            }
        }
    }

    /// The dimension of the limit set if its parts did not overlap, at most 2.
    pub(super) fn similarity(&self) -> Option<Theory> {
        let source =
            "2 mean(r^D) = 1 for the lengths r of halves, reached where they do not overlap; at most 2";
        Some(Theory::new(root(|d| 2.0 * self.mean(d) - 1.0, 1.0, 2.0), source))
    }
}
