//! Views: which point of the complex plane each pixel shows.

pub(crate) mod deep;
pub(crate) mod shallow;
