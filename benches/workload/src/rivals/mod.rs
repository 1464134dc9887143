//! What the ray caster is measured against: the same picture of the surface `G x G` in single and in double
//! precision.
//!
//! - [`Caster`]: core's own algorithm, the walk through a pyramid of cells, as a competent C programmer would
//!   write it in floating point;
//! - [`Paper`]: the algorithm of the paper, which composes maps and needs no pyramid.
//!
//! Both are one text for `float` and `double` ([`crate::float::Float`]): where these differ is the width
//! alone.

mod camera;
pub(crate) mod iterated;
mod paper;
mod shade;
pub(crate) mod solid;
mod vector;
mod walk;

pub(crate) use paper::Paper;
pub(crate) use shade::{Sun, mirror, normal, phong, phong_rgb, refracted};
pub(crate) use vector::{Vector, unit};
pub(crate) use walk::{CELLS, Caster, Cell, DEPTH, meets};
