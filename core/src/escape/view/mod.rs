//! Views: which point of the complex plane each pixel shows.

pub(crate) mod deep;
pub(crate) mod raster;
pub(crate) mod shallow;
