//! Perturbation, for the deepest views: one orbit in wide numbers, and for each pixel its small distance from
//! it.

pub(crate) mod jumps;
pub(crate) mod reference;
