//! All tests of the command, in one binary: linking is what a test binary costs.

mod accuracy;
mod bad_curves;
mod bad_images;
mod bad_input;
mod bad_terrain;
mod bad_world;
mod brdf;
mod common;
mod encode;
mod export;
mod exported;
mod fits;
mod images;
mod measure;
mod pictures;
mod rooms;
mod samples;
