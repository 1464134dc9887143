//! Curves and surfaces by control points, against the text in f64 and against what is known exactly.

mod aspect;
mod contraction;
mod curves;
mod general;
mod lattices;
mod moments;
mod products;
mod seeded;
