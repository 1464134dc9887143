//! Curves by refinement: the Koch curve and its relatives from generators, random curves from laws of
//! displacement.
//!
#![doc = include_str!("../../docs/curve.md")]
//!
//! A [`Generator`] says by which polyline each segment is replaced; [`Refined`] walks the result, order by
//! order or down to the length of a pixel, with a stack of fixed capacity and no recursion. A law
//! ([`OneVariable`], [`TwoVariable`], [`LineToLine`], [`Elbow`], or one of your own) says where the midpoint
//! of a part lies; [`Subdivision`] walks the curve through given knots, all of it or a piece. An [`LSystem`]
//! rewrites words that a turtle draws, plants with branches among them. All are paths: iterators of
//! [`crate::plane::PathElement`].
//!
//! Sources: course unit V, sections 5.1 and 5.6; P. Prusinkiewicz, A. Lindenmayer, "The Algorithmic Beauty of
//! Plants", 1990; L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980.
//!
//! ```
//! use attractor::curve::{Elbow, Generator, Stop, Subdivision, koch, turn_over};
//! use attractor::num::{Real, Unit};
//!
//! // the snowflake of order 3
//! let triangle = koch::triangle(Default::default(), Real::ONE);
//! assert_eq!(koch::GENERATOR.refined::<12>(&triangle, 3)?.count(), 3 * 64 + 1);
//!
//! // a generator of your own, down to pixels of 1/100
//! let own = Generator::<5>::turtle("F+F-F-F+F", turn_over(4))?;
//! assert!(own.refined_to::<12>(&koch::SEGMENT, Real::from_num(0.01))?.count() > 1000);
//!
//! // Brownian motion from (0, 0) to (1, 0)
//! let law = Elbow::new(Unit::from_num(0.3), Real::from_num(2), 7)?;
//! let path = Subdivision::<_, 20>::new(&law, &koch::SEGMENT, Stop::Length(Real::from_num(0.01)))?;
//! assert!(path.count() > 100);
//! # Ok::<(), attractor::Error>(())
//! ```

mod backwards;
mod carpenter;
pub mod catalogue;
pub mod coast;
mod dimension;
mod displacement;
mod elbow;
mod generator;
pub mod koch;
mod l_system;
mod refined;
mod subdivision;
mod turtle;

pub use backwards::Backwards;
pub use carpenter::{LineToLine, OneVariable, TwoVariable};
pub use dimension::{dimension_of_ratio, dimension_of_spectrum};
pub use displacement::{Displacement, Part, displaced};
pub use elbow::Elbow;
pub use generator::{Generator, Orientation};
pub use l_system::{LSystem, MAX_LETTERS, MAX_RULES, Turtle};
pub use refined::Refined;
pub use subdivision::{Stop, Subdivision};
pub use turtle::turn_over;
