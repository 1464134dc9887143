//! What an encoder shares with the decoder: it walks the same syntax with a coder that writes. For the
//! command
//! `attractor`; no part of the interface, and it may change in any release.

pub use super::context::{self, COUNT as MODELS, NUMBER};
pub use super::crc::crc32;
pub use super::edge::Edge;
pub use super::leaf::{CLASSES, Domain, Leaf, Setting, class, scan};
pub use super::levels::{FREQUENCIES, LARGEST, Levels};
pub use super::models::{Coder, Model, number};
pub use super::plane::Plane;
pub use super::shape::{Place, Shape};
