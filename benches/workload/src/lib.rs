//! What the target runs and the host runs again: a table of scenes, a table of kernels, and the sink that both draw into.
//!
//! - [`scenes::ALL`]: pictures of core, drawn row by row into a [`Sink`](sink::Sink) that keeps a CRC-32 and no pixel;
//! - [`kernels::ALL`]: inner loops, each in fixed point and, beside it, in f32 and in f64 as a competent C programmer would write them.
//!
//! Nothing here knows a processor. What a processor can do, count instructions and measure its stack, is a [`Machine`].
#![no_std]
#![cfg_attr(all(target_arch = "arm", target_abi = "eabihf"), feature(core_float_math))]
#![deny(missing_docs)]

#[cfg(test)]
extern crate std;

mod built_in;
mod escape_scenes;
mod float;
mod inputs;
pub mod kernels;
mod machine;
mod rivals;
pub mod scenes;
pub mod sink;
mod surface;

use crc::{CRC_32_ISO_HDLC, Crc};

pub use machine::{Blind, Machine};

/// The checksum of what is drawn: that of zlib and PNG.
pub static CRC_32: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

/// Whether this is an image for Armv6-M, which alone lacks atomic exchange: it has only the rows that a machine with 16 KiB of RAM runs, since all of
/// them would not fit its flash.
const SMALL: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));
