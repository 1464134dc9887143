//! All tests of the kernel's promises, in one binary: linking is what a test binary costs.

mod bad_input;
mod codec;
mod curves;
mod curves_at_the_edge;
mod deep_zoom;
mod faults;
mod filtered;
mod filtered_lattice;
mod fractal_normals;
mod ifs;
mod imports;
mod julia_sets;
mod l_systems;
mod laws;
mod moments;
mod patches;
mod pictures;
mod pictures_of_worlds;
mod promises;
mod pure_maps;
mod robust;
mod slopes;
mod solids;
mod terrain;
mod worked_examples;
mod worlds;
