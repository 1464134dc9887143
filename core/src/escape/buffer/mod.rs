//! Escape-time pictures in lent memory, which spare the iterations of pixels that are known already.

pub(crate) mod buffered;
pub(crate) mod filled;
