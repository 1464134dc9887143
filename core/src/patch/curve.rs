//! Curves by control points: `F(s) = P phi(s)`, `phi(s) = lim T_s1 ... T_sn lambda`.
//!
//! `T_0 .. T_(N-1)` are matrices with barycentric columns that join: `T_0 c_0 = c_0`, `T_(N-1) c_1 = c_1`,
//! `T_(i-1) c_1 = T_i c_0`. The `M` coordinates of `phi` are the blending functions of the control points
//! `p_0 .. p_(M-1)`; de Casteljau's matrices give Bezier curves.
//!
//! A parameter `i / N^p` takes `p` products, from the *last* digit to the first, beginning with the end
//! `c_0`: nothing is cut off, and the cost of `phi` does not depend on the dimension of the points.
//!
//! Source: Tosan, Guerin, Baskurt, sections 2 and 3; H. Prautzsch, C. A. Micchelli, "Computing curves
//! invariant under halving", 1987. Formats: matrices and weights 28 fractional bits.

use super::address::{Address, Tail, split};
use super::affine::Affine;
use super::barycentric::{Barycentric, add_up, completed, mixed, unit};
use super::contraction::{Contraction, mean};
use super::joining::agree;
use crate::Error;
use crate::num::formats::Q28;
use crate::num::{Near, Real};
use crate::plane::{PathElement, Point2};

/// A curve by `M` control points in base `N`: its maps and its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProjectedCurve<const N: usize, const M: usize> {
    maps: [Barycentric<M>; N],
    /// The same maps.
    steps: [Affine<M>; N],
    ends: [[Q28; M]; 2],
    contraction: Contraction,
}

impl<const N: usize, const M: usize> ProjectedCurve<N, M> {
    /// The curve with these maps from the first control point to the last: `c_0 = e_0`, `c_1 = e_(M-1)`.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two maps or control points, [`Error::Unjoined`] for maps that do not
    /// join to the last bit, [`Error::NotContractive`] or [`Error::OutOfRange`] as [`Contraction`] says;
    /// [`Error::OutOfRange`] where two entries of a row of a map differ by 8 or more.
    pub fn new(maps: [Barycentric<M>; N]) -> Result<Self, Error> {
        let ends = [unit(0), unit(M.wrapping_sub(1))].map(|end| end.map(Near::to_bits));
        Self::between(maps, ends, 0)
    }

    /// The curve with these maps and ends, as a B-spline has them inside its control polygon. The ends are
    /// rounded, so that maps have to join to within `4 M` units of `2^-28`.
    ///
    /// # Errors
    /// As [`ProjectedCurve::new`]; [`Error::NotBarycentric`] for an end that does not add up to 1.
    pub fn with_ends(maps: [Barycentric<M>; N], ends: [[Near; M]; 2]) -> Result<Self, Error> {
        let mut exact = ends.map(|end| end.map(Near::to_bits));
        for (column, end) in exact.iter_mut().enumerate() {
            add_up(end, column)?;
        }
        Self::between(maps, exact, 4 * M as i64)
    }

    /// The curve through a grid of `(M - 1) N + 1` points of the barycentric space:
    /// `T_i e_k = q_((M-1) i + k)`. Its parts have their ends in common, so that it joins whatever the points
    /// are, but for its own two ends.
    ///
    /// # Errors
    /// As [`ProjectedCurve::new`], [`Error::LengthMismatch`] for another number of points, and those of
    /// [`Barycentric::from_columns`].
    pub fn from_grid(grid: &[[Near; M]]) -> Result<Self, Error> {
        enough::<N, M>()?;
        let expected = (M - 1).saturating_mul(N).saturating_add(1);
        if grid.len() != expected {
            return Err(Error::LengthMismatch { what: "points of the grid", given: grid.len(), expected });
        }
        let mut maps = [Barycentric::IDENTITY; N];
        for (map, columns) in maps.iter_mut().zip(grid.windows(M).step_by(M - 1)) {
            let mut of = [[Near::ZERO; M]; M];
            of.copy_from_slice(columns);
            *map = Barycentric::from_columns(of)?;
        }
        Self::new(maps)
    }

    fn between(maps: [Barycentric<M>; N], ends: [[Q28; M]; 2], tolerance: i64) -> Result<Self, Error> {
        enough::<N, M>()?;
        let [first, last] = ends.map(|end| end.map(Near::from_bits));
        let at = |map: usize, end: usize| {
            let image = maps.get(map).zip(ends.get(end)).map_or([0; M], |(map, end)| map.image(end));
            image.map(Near::from_bits)
        };
        agree("T_0 c_0 = c_0", 0, (&at(0, 0), &first), tolerance)?;
        agree("T_(N-1) c_1 = c_1", N - 1, (&at(N - 1, 1), &last), tolerance)?;
        for map in 1..N {
            agree("T_(i-1) c_1 = T_i c_0", map, (&at(map - 1, 1), &at(map, 0)), tolerance)?;
        }
        let mut steps = [Affine::NONE; N];
        for (step, map) in steps.iter_mut().zip(&maps) {
            *step = Affine::of(map)?;
        }
        Ok(Self { maps, steps, ends, contraction: Contraction::prove(&maps, &mean(ends))? })
    }

    /// The proof that it is a curve, and how fast it tends to it.
    pub const fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    /// Its maps.
    pub const fn maps(&self) -> &[Barycentric<M>; N] {
        &self.maps
    }

    /// `c_0` and `c_1`.
    pub(super) const fn end_weights(&self) -> [[Q28; M]; 2] {
        self.ends
    }

    /// `phi` at an address: how much of each control point. Both addresses of a joint give the same bits.
    ///
    /// They add up to 1 exactly. Error: below `(M - 1) / 2` units of `2^-28` a digit, times how much the maps
    /// before it contract (`weights_are_within_two_units_a_digit`); none where the products need no more than
    /// 28 fractional bits, as those of a parabola up to 14 binary digits
    /// (`a_parabola_and_takagis_curve_are_exact`).
    pub fn weights(&self, address: Address<N>) -> [Near; M] {
        self.weights_bits(address).map(Near::from_bits)
    }

    #[inline(always)]
    pub(super) fn weights_bits(&self, address: Address<N>) -> [Q28; M] {
        let address = address.canonical();
        let ((mut index, levels), [first, last]) = (address.digits(), &self.ends);
        let mut weights = if address.tail() == Tail::Last { *last } else { *first };
        for _ in 0..levels {
            let (rest, digit) = split::<N>(index);
            if let Some(step) = self.steps.get(digit as usize) {
                weights = step.image(&weights);
            }
            index = rest;
        }
        completed(weights)
    }

    /// `F` at an address: the weighted mean of numbers, saturated.
    pub fn value(&self, values: &[Real; M], address: Address<N>) -> Real {
        Real::from_bits(mixed(&values.map(Real::to_bits), &self.weights_bits(address)))
    }

    /// `F` at an address in the plane, saturated.
    pub fn point(&self, points: &[Point2; M], address: Address<N>) -> Point2 {
        let weights = self.weights_bits(address);
        let coordinate = |of: fn(&Point2) -> Real| {
            Real::from_bits(mixed(&points.each_ref().map(|point| of(point).to_bits()), &weights))
        };
        Point2::new(coordinate(|point| point.x), coordinate(|point| point.y))
    }

    /// The polyline through the points at all `i / N^levels`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for more levels than an address has.
    pub fn polyline(&self, points: [Point2; M], levels: u32) -> Result<Polyline<'_, N, M>, Error> {
        let last = Address::<N>::of(0, levels).map(|_| Address::<N>::count(levels).unwrap_or(0))?;
        Ok(Polyline { curve: self, points, levels, next: Some(0), last })
    }
}

/// Whether there are enough maps and control points for a curve.
///
/// # Errors
/// [`Error::TooFew`] for fewer than two.
pub(super) fn enough<const N: usize, const M: usize>() -> Result<(), Error> {
    for (what, given) in [("maps", N), ("control points", M)] {
        if given < 2 {
            return Err(Error::TooFew { what, given, at_least: 2 });
        }
    }
    Ok(())
}

/// A curve as a path: a straight line to each of its points at one level.
#[derive(Debug, Clone)]
pub struct Polyline<'a, const N: usize, const M: usize> {
    curve: &'a ProjectedCurve<N, M>,
    points: [Point2; M],
    levels: u32,
    next: Option<u32>,
    last: u32,
}

impl<const N: usize, const M: usize> Iterator for Polyline<'_, N, M> {
    type Item = PathElement;

    fn next(&mut self) -> Option<PathElement> {
        let index = self.next?;
        self.next = (index < self.last).then(|| index.wrapping_add(1));
        let point = self.curve.point(&self.points, Address::of(index, self.levels).ok()?);
        Some(if index == 0 { PathElement::MoveTo(point) } else { PathElement::LineTo(point) })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.next.map_or(0, |next| u64::from(self.last.wrapping_sub(next)) + 1);
        usize::try_from(left).map_or((usize::MAX, None), |left| (left, Some(left)))
    }
}

impl<const N: usize, const M: usize> core::iter::FusedIterator for Polyline<'_, N, M> {}
