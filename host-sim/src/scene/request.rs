//! What a picture or a sample is asked for.

use embedded_graphics::geometry::Size;

/// The display, and the seed of what is random.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request {
    pub(crate) size: Size,
    pub(crate) seed: u64,
}
