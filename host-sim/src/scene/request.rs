//! What a picture or a sample is asked for.

use std::path::Path;

use embedded_graphics::geometry::Size;

/// The display, and the seed of what is random.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request {
    pub(crate) size: Size,
    pub(crate) seed: u64,
}

/// Which numbers of a scene.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Question<'a> {
    /// Those of its kind.
    Usual,
    /// The crossings of the rays in a file.
    Rays(&'a Path),
    /// The inside-outside functions along a ray.
    Along(&'a str),
    /// The textures at the places in a file.
    Places(&'a Path),
    /// The light of every pixel.
    Pixels,
}

impl Question<'_> {
    /// The option that asks for it.
    pub(crate) fn option(self) -> &'static str {
        match self {
            Self::Usual => "",
            Self::Rays(_) => "--rays",
            Self::Along(_) => "--along",
            Self::Places(_) => "--at",
            Self::Pixels => "--pixels",
        }
    }
}
