//! Escape-time pictures in lent memory: what is known already is not computed again.

pub(crate) mod buffered;
pub(crate) mod filled;
