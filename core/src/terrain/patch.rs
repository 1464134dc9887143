//! The inner geometry of a surface: what spans the cells of its finest lattice.
//!
//! "The behavior of the geometry inside the inner scale is up to the implementor." Source: L. C. Carpenter,
//! "Computer rendering of fractal curves and surfaces", 1980, figures 8 to 10.

use super::b_spline::BSpline;
use super::bicubic::Bicubic;
use super::bilinear::Bilinear;
use super::ferguson::ferguson;
use super::heights::Heights;
use crate::num::formats::{Q24, Q30};
use crate::num::{Real, Unit};

/// What spans the cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum InnerGeometry {
    /// Bilinear patches through the heights: `C0`.
    #[default]
    Bilinear,
    /// Ferguson's patches through the heights, slopes from their neighbours, no twist: `C1`.
    Ferguson,
    /// A bicubic B-spline whose vertices are the heights: `C2`, it passes near them.
    BSpline,
}

/// The patch of one cell: a function of `s` and `t`, both 0 to 1.
///
/// ```
/// use attractor::num::{Real, Unit};
/// use attractor::terrain::{Heights, InnerGeometry};
///
/// let knots = [0, 1, 1, 2].map(Real::from_num);
/// let heights = Heights::new(2, 2, &knots)?;
/// let half = Unit::ONE / 2;
/// for inner in [InnerGeometry::Bilinear, InnerGeometry::Ferguson, InnerGeometry::BSpline] {
///     let middle = inner.patch(&heights, 0, 0).height(half, half);
///     assert!((middle - Real::ONE).abs() <= 3 * Real::DELTA);
/// }
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patch(pub(crate) Form);

/// How a patch is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    Bilinear(Bilinear),
    Bicubic(Bicubic),
    BSpline(BSpline),
}

impl InnerGeometry {
    /// The patch of the cell at this column and row, those beyond the end being the last.
    pub fn patch(self, heights: &Heights<'_>, column: u32, row: u32) -> Patch {
        Patch(self.form(heights, column.min(heights.columns() - 2), row.min(heights.rows() - 2)))
    }

    /// That of a cell which is there.
    #[inline(always)]
    pub(crate) fn form(self, heights: &Heights<'_>, i: u32, j: u32) -> Form {
        match self {
            Self::Bilinear => Form::Bilinear(Bilinear::new(heights, i, j)),
            Self::Ferguson => Form::Bicubic(ferguson(heights, i, j)),
            Self::BSpline => Form::BSpline(BSpline::new(heights, i, j)),
        }
    }
}

impl Form {
    #[inline]
    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        match self {
            Self::Bilinear(patch) => patch.height(s, t),
            Self::Bicubic(patch) => patch.height(s, t),
            Self::BSpline(patch) => patch.height(s, t),
        }
    }
}

impl Patch {
    /// The height at `(s, t)`, each clamped to 0 .. 1.
    ///
    /// Error: below 4 units of `2^-24` (`a_patch_is_within_4_units`).
    pub fn height(&self, s: Unit, t: Unit) -> Real {
        let [s, t] = [s, t].map(|c| c.clamp(Unit::ZERO, Unit::ONE).to_bits());
        Real::from_bits(self.0.height(s, t))
    }

    /// `h_s` and `h_t` at `(s, t)`, each clamped to 0 .. 1: by how much the height grows when one of them
    /// grows by 1. The normal is `(-h_s / a, -h_t / b, 1)` for a cell of the sides `a` and `b`.
    ///
    /// Result: clamped to the format where it is steeper than 128, as Ferguson's patches may be. Error: below
    /// 16 units of `2^-24` (`a_patch_is_within_4_units`, `slopes_of_high_patches_do_not_wrap`).
    pub fn slopes(&self, s: Unit, t: Unit) -> [Real; 2] {
        let [s, t] = [s, t].map(|c| c.clamp(Unit::ZERO, Unit::ONE).to_bits());
        let slopes: [Q24; 2] = match &self.0 {
            Form::Bilinear(patch) => patch.slopes(s, t),
            Form::Bicubic(patch) => patch.slopes(s, t),
            Form::BSpline(patch) => patch.slopes(s, t),
        };
        slopes.map(Real::from_bits)
    }

    /// Its Bezier points as of a bicubic patch, row by row, to within two units.
    pub(crate) fn points(&self) -> [[Q24; 4]; 4] {
        const THIRDS: [Q30; 4] = [0, 357_913_941, 715_827_883, 1 << 30];
        match &self.0 {
            Form::Bilinear(patch) => THIRDS.map(|t| THIRDS.map(|s| patch.height(s, t))),
            Form::Bicubic(patch) => patch.points,
            Form::BSpline(patch) => patch.bezier().points,
        }
    }

    /// Rigorous bounds of its heights.
    pub fn range(&self) -> [Real; 2] {
        let range: [Q24; 2] = match &self.0 {
            Form::Bilinear(patch) => patch.range(),
            Form::Bicubic(patch) => patch.range(),
            Form::BSpline(patch) => patch.range(),
        };
        range.map(Real::from_bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The derivatives of the cubic patch with these Bezier points.
    fn slopes(points: [[Q24; 4]; 4], s: f64, t: f64) -> [f64; 2] {
        let value =
            |s: f64| [(1.0 - s).powi(3), 3.0 * s * (1.0 - s).powi(2), 3.0 * s * s * (1.0 - s), s.powi(3)];
        let slope = |s: f64| {
            let [a, b, c] = [(1.0 - s).powi(2), 2.0 * s * (1.0 - s), s * s].map(|w| 3.0 * w);
            [-a, a - b, b - c, c]
        };
        let sum = |along: [f64; 4], across: [f64; 4]| -> f64 {
            let row = |row: [Q24; 4]| row.iter().zip(along).map(|(h, w)| f64::from(*h) * w).sum::<f64>();
            points.iter().zip(across).map(|(points, w)| row(*points) * w).sum()
        };
        [sum(slope(s), value(t)), sum(value(s), slope(t))]
    }

    /// Heights as far apart as they may be, where differences of slopes leave the format.
    #[test]
    fn slopes_of_high_patches_do_not_wrap() {
        let saddle = [33, -33, -33, 33].map(Real::from_num);
        let heights = Heights::new(2, 2, &saddle).unwrap();
        let middle = InnerGeometry::Bilinear.patch(&heights, 0, 0).slopes(Unit::ONE / 2, Unit::ONE / 2);
        assert_eq!(middle, [Real::ZERO; 2]);
        let mut word = 1_u64;
        let mut random = move || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            word >> 33
        };
        let (mut steep, mut clamped) = ([0; 3], 0);
        for k in 0..2000 {
            // as high or as low as may be, or anything between
            let knots: [Real; 16] = core::array::from_fn(|_| {
                let any = (random() as i32).wrapping_sub(1 << 30);
                let most = if any < 0 { 1 - (64 << 24) } else { (64 << 24) - 1 };
                Real::from_bits(if random() & 1 == 0 { most } else { any })
            });
            let heights = Heights::new(4, 4, &knots).unwrap();
            let [s, t] = [0; 2].map(|_| Unit::from_bits((random() >> 1) as i32));
            let [s, t] = if k % 8 == 0 { [Unit::ZERO, t] } else { [s, t] };
            for (inner, steep) in [InnerGeometry::Bilinear, InnerGeometry::Ferguson, InnerGeometry::BSpline]
                .into_iter()
                .zip(&mut steep)
            {
                let patch = inner.patch(&heights, k % 3, k / 3 % 3);
                let exact = slopes(patch.points(), s.to_num(), t.to_num());
                for (got, exact) in patch.slopes(s, t).into_iter().zip(exact) {
                    let most = 2_f64.powi(31);
                    let off = f64::from(got.to_bits()) - exact.clamp(-most, most - 1.0);
                    assert!(off.abs() < 16.0, "{inner:?} {k}: {off}");
                    *steep += i32::from(exact.abs() > 2_f64.powi(30));
                    clamped += i32::from(exact.abs() > most);
                }
            }
        }
        assert!(steep.iter().all(|n| *n > 100) && clamped > 10, "{steep:?} {clamped}");
    }

    /// How much a patch bends between heights 128 apart.
    #[test]
    fn the_twist_of_a_high_saddle_does_not_wrap() {
        let high = (64 << 24) - 1;
        let twist = |corners: [Q24; 4]| Bilinear { corners }.twist();
        assert_eq!(twist([high, -high, -high, high]), (high.unsigned_abs() >> 6) + 1);
        assert_eq!(twist([33 << 24, -33 << 24, -33 << 24, 33 << 24]), (132 << 16) + 1);
        assert_eq!(twist([1 << 24, 0, 0, 1 << 24]), (2 << 16) + 1);
    }
}
