//! Affine iterated function systems: attractors by the chaos game, their exact bounds, a catalogue of the
//! classical ones.
//!
#![doc = include_str!("../../docs/ifs.md")]
//!
//! An iterated function system is a set of contractions `w_1 .. w_n` of the plane. It has exactly one
//! attractor, the compact set with `A = w_1(A) u .. u w_n(A)` (J. E. Hutchinson, "Fractals and self
//! similarity", 1981). The chaos game draws it: apply a map chosen at random, show the point, repeat (M. F.
//! Barnsley, "Fractals Everywhere", 1988, chapter 3). The copier draws its iterates: all images of a shape.
//!
//! ```
//! use attractor::ifs::{Affine, Ifs, catalogue};
//!
//! let fern = catalogue::BARNSLEY_FERN.ifs::<4>()?;
//! let bounds = fern.bounds();
//! for point in fern.seeded_chaos_game(7).take(1000) {
//!     assert!(bounds.min.x <= point.x && point.x <= bounds.max.x);
//!     assert!(bounds.min.y <= point.y && point.y <= bounds.max.y);
//! }
//!
//! // one of your own: a, b, c, d, e, f in thousandths
//! let maps = [
//!     Affine::from_thousandths([600, -300, 300, 600, 0, 0]),
//!     Affine::from_thousandths([400, 200, -200, 400, 500, 250]),
//! ];
//! let own = Ifs::<2>::proportional_to_determinant(&maps)?;
//! assert_eq!(own.maps().len(), 2);
//! # Ok::<(), attractor::Error>(())
//! ```

mod affine;
mod bounds;
pub mod catalogue;
mod chaos;
mod copier;
mod disc;
mod moments;
mod prepared;
mod system;

pub use affine::Affine;
pub use chaos::{ChaosGame, Labelled, Walk};
pub use copier::{CopiedPath, CopiedPoints, Copier};
pub use disc::Disc;
pub use moments::Moments;
pub use system::{Ifs, MAX_MAPS};
