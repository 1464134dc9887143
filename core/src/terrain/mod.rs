//! Surfaces by subdivision: mountains through given heights, or through four numbers.
//!
#![doc = include_str!("../../docs/terrain.md")]
//!
//! A [`PlaneToLine`] function knows the height of any point of its lattice on demand; [`Rows`] streams the
//! lattice, each row from those before. Random numbers are functions of the point ([`Randomness`]), so that
//! pieces fit together whatever is drawn first, also across [seams](Seam) between patches that lie apart.
//! What spans the finest cells is an [`InnerGeometry`]. [`Triangles`] are as fine as an [`EdgeLevel`] wants
//! each edge, without cracks. [`crate::trace::Terrain`] puts a surface under a ray caster.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980.
//!
//! ```
//! use attractor::num::{Coordinate, RandomField, Real, Unit};
//! use attractor::terrain::{Heights, Law, PlaneToLine};
//!
//! // an island: a summit among knots at the bottom of the sea
//! let knots = [-1, -1, -1, -1, 1, -1, -1, -1, -1].map(Real::from_num);
//! let law = Law::new(const { Unit::lit("0.4") }, const { Unit::lit("0.85") })?;
//! let island = PlaneToLine::new(Heights::new(3, 3, &knots)?, law, RandomField::new(5))?;
//! assert_eq!(island.height(Coordinate::ONE, Coordinate::ONE), Real::ONE);
//! # Ok::<(), attractor::Error>(())
//! ```

mod b_spline;
mod bicubic;
mod bilinear;
mod cell;
mod edge_level;
mod extrapolate;
mod ferguson;
mod heights;
mod law;
mod patch;
mod plane_to_line;
mod random;
mod rows;
mod seam;
mod triangles;

pub(crate) use bicubic::differences;
pub(crate) use bilinear::Bilinear;
pub(crate) use cell::{Cell, Halved};
pub use edge_level::{EdgeLevel, Magnification};
pub use extrapolate::Side;
pub use heights::Heights;
pub use law::{LEVELS, Law};
pub(crate) use patch::Form;
pub use patch::{InnerGeometry, Patch};
pub use plane_to_line::PlaneToLine;
pub use random::Randomness;
pub use rows::Rows;
pub use seam::{Seam, Seamed};
pub use triangles::{Triangles, Vertex};
