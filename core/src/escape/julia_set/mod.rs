//! The Julia set itself, the boundary of the filled one: what is known of it, and two ways to draw it.

pub(crate) mod backward;
pub(crate) mod cover;
pub(crate) mod set;
pub(crate) mod square_root;
