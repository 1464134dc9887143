//! What the tests and the command share: the table of promises about accuracy.

pub mod accuracy;
