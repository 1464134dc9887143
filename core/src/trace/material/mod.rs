//! Materials: what a surface makes of the light that reaches it.
//!
//! Source: the course unit V, section 5.9; Cochran, Lewis, Hart, sections 4 to 6.

mod respond;

pub use respond::{Lit, Material, Medium, Response};
