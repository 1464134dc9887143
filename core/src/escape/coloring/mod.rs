//! Other values than the dwell for the pixels of an escape-time picture.

pub(crate) mod distance;
pub(crate) mod interior;
pub(crate) mod smooth;
