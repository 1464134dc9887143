//! All tests of the kernel's promises, in one binary: linking is what a test binary costs.

mod bad_input;
mod curves;
mod deep_zoom;
mod ifs;
mod julia_sets;
mod laws;
mod pictures;
mod promises;
mod robust;
mod worked_examples;
