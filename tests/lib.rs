//! What the tests and the command share: the table of promises about accuracy, and every input of the elementary functions.

pub mod accuracy;
pub mod exhaust;
