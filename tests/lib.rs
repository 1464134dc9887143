//! What the tests and the command share: the table of promises about accuracy, every input of the elementary
//! functions, and streams of images that no encoder wrote.

pub mod accuracy;
pub mod exhaust;
pub mod streams;

/// The README's snippet is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
