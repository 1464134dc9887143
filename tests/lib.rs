//! What the tests and the command share: the table of promises about accuracy, and every input of the
//! elementary functions.

pub mod accuracy;
pub mod exhaust;

/// The README's snippet is a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
