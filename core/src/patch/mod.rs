//! Curves and surfaces by control points: fractals that are shaped as splines are.
//!
#![doc = include_str!("../../docs/patch.md")]
//!
//! `F(s) = P phi(s)`: control points `P`, and the attractor `phi` of matrices whose columns add up to 1, the
//! projected iterated function system of E. Tosan, E. Guerin and A. Baskurt, "Design and Reconstruction of
//! Fractal Surfaces", 2002. Bezier curves and B-splines are cases of it, and so are Takagi's curve and rough
//! terrain.
//!
//! ```
//! use attractor::num::Real;
//! use attractor::patch::{Address, takagi};
//!
//! let curve = takagi()?;
//! // the height at 1/4, by the heights of its three control points
//! let heights = [Real::ZERO, Real::lit("0.5"), Real::ZERO];
//! assert_eq!(curve.value(&heights, Address::of(1, 2)?), Real::lit("0.5"));
//! # Ok::<(), attractor::Error>(())
//! ```
//!
//! | what | control points | type |
//! | --- | --- | --- |
//! | a curve | `M` | [`ProjectedCurve`] |
//! | the product of two curves | `M L` | [`Tensor`] |
//! | a patch with rough inner curves | `M M` | [`Patch`], of 72 numbers for `N` = 2, `M` = 3 |
//! | a lattice of any size | 4 x 4 a cell | [`Mask`], of 21 numbers |
//!
//! [`Sheet`] puts many cells side by side, which [`crate::trace`] shows. A lattice is a fractal function of
//! two variables with a calculus of its own: [`HeightMoments`], [`SlopeMoments`].

mod address;
mod affine;
mod aspect;
mod barycentric;
mod catalogue;
mod columns;
mod contraction;
mod curve;
mod form;
mod grid;
mod joining;
mod lattice;
mod mask_step;
mod moments;
mod scheme;
#[cfg(test)]
mod seeded;
mod sheet;
mod standard_grid;
mod standard_step;
mod tensor;

pub use address::{Address, Tail};
pub use aspect::{Aspect, End, Joint};
pub use barycentric::Barycentric;
pub use catalogue::{Type, b_spline, bezier, standard_curve, takagi};
pub use contraction::Contraction;
pub use curve::{Polyline, ProjectedCurve};
pub use grid::Patch;
pub use lattice::Mask;
pub use moments::{CellMoments, CellSlopes, HeightMoments, SlopeMoments};
pub(crate) use scheme::CORNERS;
pub use scheme::Scheme;
pub use sheet::Sheet;
pub(crate) use sheet::mean_normal;
pub use tensor::Tensor;
