//! Refined curves, the copier and random curves against their references; the spectra of random curves.

mod generators;
mod random;
mod spectra;

use attractor::num::Real;
use attractor::plane::{PathElement, Point2};

fn point(x: f64, y: f64) -> Point2 {
    Point2::new(Real::from_num(x), Real::from_num(y))
}

fn xy(p: Point2) -> (f64, f64) {
    (p.x.to_num(), p.y.to_num())
}

/// The points of one stroke.
fn stroke(steps: impl Iterator<Item = PathElement>) -> Vec<Point2> {
    steps
        .enumerate()
        .map(|(i, step)| match step {
            PathElement::MoveTo(p) if i == 0 => p,
            PathElement::LineTo(p) if i > 0 => p,
            other => panic!("{other:?} at {i}"),
        })
        .collect()
}

fn worst(got: impl IntoIterator<Item = Point2>, want: &[(f64, f64)]) -> f64 {
    let mut count = 0;
    let worst = got.into_iter().zip(want).fold(0.0_f64, |worst, (p, q)| {
        count += 1;
        let (x, y) = xy(p);
        worst.max((x - q.0).abs()).max((y - q.1).abs())
    });
    assert_eq!(count, want.len());
    worst
}

const ULP: f64 = 1.0 / 16_777_216.0;
