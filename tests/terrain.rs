//! Surfaces by subdivision against their reference: what their tests have in common.

mod heights;
mod pieces;
mod random_fields;
mod rays;
mod refused;
mod spanned;

use attractor::num::{RandomField, Real, Unit};
use attractor::terrain::{Heights, InnerGeometry, Law, PlaneToLine, Randomness, Rows};
use attractor_reference::terrain::{self as reference, Inner};

const ULP: f64 = 1.0 / 16_777_216.0;

/// A generator of one's own for places: uniform in 0 .. 1.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2.0_f64.powi(53)
    }

    fn below(&mut self, end: u32) -> u32 {
        (self.next() * f64::from(end)) as u32
    }
}

fn real(x: f64) -> Real {
    Real::from_num(x)
}

fn law(offset: f64, similarity: f64) -> Law {
    Law::new(Unit::from_num(offset), Unit::from_num(similarity)).unwrap()
}

/// Knots between ±1.
fn knots(count: u32, seed: u64) -> Vec<Real> {
    let mut uniform = Uniform(seed);
    (0..count).map(|_| real(2.0 * uniform.next() - 1.0)).collect()
}

fn grid(heights: &Heights<'_>) -> reference::Grid {
    let row = |j| (0..heights.columns()).map(|i| heights.at(i, j).to_num()).collect();
    (0..heights.rows()).map(row).collect()
}

/// All heights of a level.
fn lattice(terrain: &PlaneToLine<'_, impl Randomness>, level: u32) -> (u32, u32, Vec<Real>) {
    let cells = terrain.heights().columns() - 1;
    let mut memory = vec![Real::ZERO; Rows::<RandomField>::words(cells, level)];
    let rows = Rows::new(terrain, level, &mut memory).unwrap();
    let (width, count) = (rows.width(), rows.count());
    let mut heights = vec![Real::ZERO; width * count];
    rows.write(&mut heights).unwrap();
    (width as u32, count as u32, heights)
}

const INNER: [(InnerGeometry, Inner); 3] = [
    (InnerGeometry::Bilinear, Inner::Bilinear),
    (InnerGeometry::Ferguson, Inner::Ferguson),
    (InnerGeometry::BSpline, Inner::BSpline),
];

const OVER: [[Real; 2]; 2] = [[Real::from_bits(-1 << 24), Real::from_bits(1 << 24)]; 2];
