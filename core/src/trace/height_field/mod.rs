//! The height field `h(x, y) = f(x) g(y)` of two fractal functions, and where a ray meets it.
//!
//! [`hierarchy`] is what the pyramids of both factors span; [`boxes`] tests one of its boxes, [`halves`] and
//! [`parts`] walk through them to the first leaf, and [`statistics`] counts their steps. [`field`] is the
//! height field, [`surface`] the same as a thing of a world, [`outline`] where on a picture its box can be
//! seen.

pub(crate) mod boxes;
pub(crate) mod field;
pub(crate) mod halves;
pub(crate) mod hierarchy;
pub(crate) mod outline;
pub(crate) mod parts;
pub(crate) mod statistics;
pub(crate) mod surface;
