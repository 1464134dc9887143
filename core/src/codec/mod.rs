//! Images by fractals: a picture is a partition into squares, each of which says how it copies itself from a
//! square twice as large, and what is missing then.
//!
#![doc = include_str!("../../docs/codec.md")]
//!
//! "The original image is processed to create the list of affine maps, resulting in a greatly compressed
//! representation of the image. In the decompression phase the list of affine maps is used and an algorithm
//! such as the Chaos Game reconstructs the image." (CS2401 Computer Graphics, unit V, 5.3.4.) What is missing
//! is said by a cosine transform, and all of it coded by adaptive probabilities.
//!
//! | profile | domains | decoder |
//! | --- | --- | --- |
//! | [`Streaming`](Profile::Streaming) | decoded already, at most 64 rows above the band | [`Stream`], one pass, a window of rows; [`Streamed`], a field over a slice |
//! | [`Iterated`](Profile::Iterated) | anywhere | [`Sweeps`], at most 8, in place in one buffer |
//! | [`Pure`](Profile::Pure) | anywhere; no transform | the same |
//!
//! Bytes come from any iterator; with the feature `embedded-io` from any of its readers, by `Bytes`. The
//! format is written down in `docs/IMAGE-FORMAT.md` of the repository; the command `attractor encode` writes
//! it.

mod area;
#[doc(hidden)]
pub mod context;
mod crc;
mod domain;
mod draw;
mod edge;
mod header;
mod kept;
mod leaf;
mod leaves;
mod levels;
mod models;
mod neighbours;
mod opened;
mod plane;
mod planes;
mod quadtree;
mod range_decoder;
#[cfg(feature = "embedded-io")]
mod read;
mod rolled;
mod sample;
mod settled;
mod shape;
#[doc(hidden)]
pub mod shared;
mod stream;
mod streamed;
mod sweeps;
mod transform;

pub use header::{Header, Planes, Profile, Step};
pub use opened::{Opened, check, open};
pub use planes::{Luma, Part};
#[cfg(feature = "embedded-io")]
pub use read::Bytes;
pub use sample::Sample;
pub use stream::Stream;
pub use streamed::Streamed;
pub use sweeps::Sweeps;
