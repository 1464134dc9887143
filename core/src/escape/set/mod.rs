//! Pictures of sets: the dwell at every pixel of a view.

pub(crate) mod deep_mandelbrot;
pub(crate) mod escape_time;
mod in_words;
pub(crate) mod julia;
pub(crate) mod mandelbrot;
