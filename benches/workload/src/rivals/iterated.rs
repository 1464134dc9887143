//! The torus and the superellipsoid in floating point: the same crossings by the same methods, Newton's in
//! brackets.

use super::solid::{Line, cube};
use super::vector::dot;
use crate::float::Float;

/// Where a function that has another sign at each end of a bracket vanishes: Newton's method, halving where
/// it leaves the bracket. `at` answers value and derivative.
#[inline(always)]
fn root<F: Float>(at: impl Fn(F) -> (F, F), low: F, high: F) -> F {
    let (zero, half) = (F::of(0.0), F::of(0.5));
    let rises = at(low).0 < zero;
    let (mut low, mut high, mut s) = (low, high, (low + high) * half);
    for _ in 0..30 {
        let (value, slope) = at(s);
        if (value < zero) == rises {
            low = s;
        } else {
            high = s;
        }
        let next = s - value / slope;
        let next = if next > low && next < high { next } else { (low + high) * half };
        let step = next - s;
        s = next;
        if step.most(-step) < F::of(1e-7) {
            break;
        }
    }
    s
}

/// All crossings of the torus with this tube round a ring of radius 1, and how many there are.
#[inline(always)]
pub(crate) fn torus<F: Float>((o, d): Line<F>, tube: F) -> ([F; 4], usize) {
    let (zero, one, two) = (F::of(0.0), F::of(1.0), F::of(2.0));
    let mut found = [zero; 4];
    let scale = one / dot(d, d).root();
    let d = d.map(|c| c * scale);
    // from the place nearest to the centre on
    let begin = -dot(o, d);
    let p = [d[0].fused(begin, o[0]), d[1].fused(begin, o[1]), d[2].fused(begin, o[2])];
    let (square, reach) = (dot(p, p), one + tube);
    let half = reach * reach - square;
    if half <= zero {
        return (found, 0);
    }
    let limit = half.root();
    let m = square - one - tube * tube;
    // 4 g = (s^2 + m)^2 + 4 (p_z + u s)^2 - 4 tube^2, its derivative / 4 and the second
    let (height, rise) = (p[2], d[2]);
    let g = |s: F| {
        let (h, z) = (s.fused(s, m), rise.fused(s, height));
        (h.fused(h, F::of(4.0) * (z * z - tube * tube)), F::of(4.0) * (h * s + two * z * rise))
    };
    let (slope, turn) = (m + two * rise * rise, two * height * rise);
    let cubic = |s: F| ((s * s + slope) * s + turn, F::of(3.0).fused(s * s, slope));
    // the places where the derivative turns, then where it vanishes
    let mut ends = [-limit, limit, limit, limit, limit];
    let mut count = 1;
    let inflection = if slope < zero { (-slope * F::of(1.0 / 3.0)).root() } else { zero };
    let mut low = -limit;
    for high in [-inflection, inflection, limit] {
        if high > low && high <= limit && (cubic(low).0 < zero) != (cubic(high).0 < zero) {
            if let Some(end) = ends.get_mut(count) {
                *end = root(cubic, low, high);
            }
            count += 1;
        }
        low = if high > low { high } else { low };
    }
    let mut crossings = 0;
    for pair in ends.windows(2).take(count) {
        let [low, high] = [pair[0], pair[1]];
        if (g(low).0 < zero) != (g(high).0 < zero) {
            if let Some(place) = found.get_mut(crossings) {
                *place = (root(g, low, high) + begin) * scale;
            }
            crossings += 1;
        }
    }
    (found, crossings)
}

/// The first crossing of a superellipsoid with exponents above 1: Newton's method on the norm, from where the
/// line enters the cube.
#[inline(always)]
pub(crate) fn superellipsoid<F: Float>((o, d): Line<F>, n: F, m: F) -> Option<F> {
    let [(mut s, _), (end, _)] = cube((o, d))?;
    let (one, zero) = (F::of(1.0), F::of(0.0));
    for _ in 0..30 {
        let place = [d[0].fused(s, o[0]), d[1].fused(s, o[1]), d[2].fused(s, o[2])];
        let [x, y, z] = place.map(|c| c.most(-c));
        // with the derivatives of powers
        let power = |c: F, e: F| if c > zero { c.power(e - one) } else { zero };
        let (xn, yn, zm) = (power(x, n), power(y, n), power(z, m));
        let sum = xn * x + yn * y;
        let across = if sum > zero { sum.power(m / n - one) } else { zero };
        let f = across * sum + zm * z;
        // N = f^(1 / m): its derivative along the line
        let sign = |c: F, v: F| if c < zero { -v } else { v };
        let slope =
            across * (sign(place[0], xn) * d[0] + sign(place[1], yn) * d[1]) + sign(place[2], zm) * d[2];
        let norm = f.power(one / m);
        let slope = slope * norm / f;
        let over = norm - one;
        if over < F::of(3e-7) {
            return Some(s);
        }
        if slope >= zero || s > end {
            return None;
        }
        s = s - over / slope;
    }
    Some(s)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Through the middle of the ring, along it, and past it.
    #[test]
    fn a_line_crosses_a_torus_where_it_should() {
        let (found, count) = torus(([-3.0, 0.0, 0.0], [1.5, 0.0, 0.0]), 0.25_f64);
        assert_eq!(count, 4);
        for (got, want) in found.into_iter().zip([1.75, 2.25, 3.75, 4.25]) {
            assert!((got - want / 1.5).abs() < 1e-6, "{found:?}");
        }
        let (found, count) = torus(([1.0, 0.0, -2.0], [0.0, 0.0, 1.0]), 0.25_f32);
        assert!(count == 2 && (found[0] - 1.75).abs() < 1e-5 && (found[1] - 2.25).abs() < 1e-5, "{found:?}");
        assert_eq!(torus(([0.0, 0.0, -2.0], [0.0, 0.0, 1.0]), 0.25_f64).1, 0);
    }

    #[test]
    fn a_superellipsoid_of_squares_is_a_sphere() {
        let at = |o: [f64; 3], d: [f64; 3]| superellipsoid((o, d), 2.0, 2.0);
        let s = at([-2.0, 0.3, 0.2], [1.0, 0.1, -0.2]).unwrap();
        let place = [s - 2.0, 0.3 + 0.1 * s, 0.2 - 0.2 * s];
        assert!((dot(place, place) - 1.0).abs() < 1e-6 && place[0] < 0.0, "{s}");
        assert_eq!(at([-2.0, 0.9, 0.9], [1.0, 0.0, 0.0]), None);
    }
}
