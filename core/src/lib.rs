//! Fractals for small displays, in fixed point.
//!
#![doc = include_str!("../docs/trace.md")]
//!
//! `attractor` is a `no_std` kernel without allocation, without `unsafe`, without a panicking path and
//! without floating point: it gives the same bits on a Cortex-M4, a Cortex-M0, RISC-V and the desktop.
//! Everything it computes is one of three kinds of [picture](plane): points, a path, or a field of values;
//! [draw] puts any of them on any `embedded-graphics` display.
//!
//! | room | what it knows |
//! | --- | --- |
//! | [num] | formats, wide products, roots, trigonometry, vectors |
//! | [plane] | points, paths and fields: the three kinds of picture; windows onto the plane |
//! | [fif] | fractal interpolation functions: evaluation, calculus, bounds, tensor-product surfaces |
//! | [ifs] | affine iterated function systems: chaos game, bounds, a catalogue of attractors |
//! | [curve] | curves by refinement: Koch, Hilbert and their relatives; random curves: elbows, Carpenter's subdivision |
//! | [escape] | dwell of the Mandelbrot set and of filled Julia sets, backward iteration, deep zoom |
//! | [terrain] | surfaces by subdivision: mountains through given heights, patches, seams, any resolution |
//! | [patch] | curves and surfaces by control points: projected systems, tensor products, patches, refinable lattices |
//! | [codec] | images compressed by fractals: decoders in one pass or by sweeps |
//! | [trace] | a scanline ray caster: height fields, terrain, and worlds of shapes, materials, textures and lamps |
//! | [draw] | points, paths and fields on a display, palettes, dithering, rows for DMA |
//!
//! Imports point downwards in this table's order: a kernel returns values and knows no colour.
//!
//! Numbers are explained in [num], the kernels' methods and sources in [methods].
//!
//! # Features
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `defmt` | `defmt::Format` for values, descriptions and set-ups that borrow nothing; numbers of `fixed` are printed by their `Debug` |
//! | `serde` | `Serialize` and `Deserialize` for values and descriptions; a type whose constructor checks something is read back through it, so that none is invalid |
//! | `micromath` | a camera from f32 angles |
//! | `embedded-io` | images from its readers |
//!
//! Read back through their constructors: [`plane::Window`], [`escape::View`], [`escape::DeepView`],
//! [`escape::Mandelbrot`], [`escape::Julia`], [`escape::JuliaSet`], [`ifs::Ifs`]. Not read back, as they keep
//! only what they computed: [`fif::Fif`], [`curve::Generator`], [`trace::Camera`], [`trace::Light`] and the
//! laws of random curves; store the knots, points and vectors they are made from. Written only: [`Error`],
//! [`trace::Hit`] and the entries of the catalogues, which borrow their names.
//!
//! The types of the [`fixed`] crate are part of the public interface; it is re-exported. Version 1.29 is
//! required: later ones conflict with `embedded-graphics` 0.8.2 over the crate `az`.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![cfg_attr(
    not(test),
    warn(
        clippy::float_arithmetic,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable
    )
)]

#[cfg(test)]
extern crate std;

pub mod codec;
pub mod curve;
pub mod draw;
mod error;
pub mod escape;
pub mod fif;
#[cfg(feature = "defmt")]
mod format;
pub mod ifs;
#[cfg(any(doc, test))]
pub mod methods;
pub mod num;
pub mod patch;
pub mod plane;
#[cfg(test)]
mod promised;
#[cfg(feature = "serde")]
mod serial;
pub mod terrain;
pub mod trace;

pub use error::Error;
pub use fixed;
pub use rand_core;
pub use rand_xoshiro;

/// The README's snippets are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
