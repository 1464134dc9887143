//! What the target runs and the host runs again: a table of scenes, a table of kernels, and the sink that
//! both draw into.
//!
//! - [`exported`]: the built-in scenes of the command by their numbers, as `attractor export` writes them;
//! - [`scenes::ALL`]: pictures of core, drawn row by row into a [`Sink`](sink::Sink) that keeps a CRC-32 and
//!   no pixel;
//! - [`kernels::ALL`]: inner loops, each in fixed point and, beside it, in f32 and in f64 as a competent C
//!   programmer would write them.
//!
//! Nothing here knows a processor. What a processor can do, count instructions and measure its stack, is a
//! [`Machine`].
#![no_std]
#![cfg_attr(all(target_arch = "arm", target_abi = "eabihf"), feature(core_float_math))]
#![deny(missing_docs)]

#[cfg(test)]
extern crate std;

mod built_in;
mod checksum;
pub mod exported;
mod float;
mod inputs;
pub mod kernels;
mod machine;
mod own;
mod rivals;
mod scene;
pub mod scenes;
pub mod sink;
mod surface;

pub use checksum::CRC_32;
pub use machine::{Blind, Machine};
