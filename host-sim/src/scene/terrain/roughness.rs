//! How rough given heights are, in the numbers of the law of displacement.
//!
//! The law displaces the middle of an edge of length `2 s` by `o (2 s)^H R`. So the mean square of
//! `h(x) - (h(x - s) + h(x + s)) / 2` over all places and both axes is `(o (2 s)^H)^2`: a straight line
//! through its logarithms for `s` = 1, 2, 4 and 8 knots has the slope `2 H` and passes `o^2` at an edge of
//! one knot. Source: R. F. Voss, in M. F. Barnsley et al., "The Science of Fractal Images", 1988, section 1.4
//! (scaling of increments).

/// Offset and similarity exponent of heights row by row; none where they are too few or too flat to say.
pub(super) fn estimate(columns: usize, rows: usize, heights: &[f64]) -> Option<(f64, f64)> {
    let mut points = Vec::new();
    for s in [1_usize, 2, 4, 8] {
        let (mut sum, mut count) = (0.0, 0_u32);
        for y in 0..rows {
            for x in 0..columns {
                let at = |x: usize, y: usize| heights[y * columns + x];
                if x >= s && x + s < columns {
                    sum += (at(x, y) - (at(x - s, y) + at(x + s, y)) / 2.0).powi(2);
                    count += 1;
                }
                if y >= s && y + s < rows {
                    sum += (at(x, y) - (at(x, y - s) + at(x, y + s)) / 2.0).powi(2);
                    count += 1;
                }
            }
        }
        if count >= 8 && sum > 0.0 {
            points.push(((2.0 * s as f64).log2(), (sum / f64::from(count)).log2()));
        }
    }
    if points.len() < 2 {
        return None;
    }
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    // above the length of one knot, log2 of it is 0
    Some((((y - slope * x) / 2.0).exp2(), slope / 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Sums of waves in all directions whose amplitudes fall as their frequency's power `-H`: the exponent
    /// and the displacement of an edge of one knot, which such a sum has in closed form, are found again.
    #[test]
    fn the_roughness_of_a_sum_of_waves_is_found_again() {
        const SIDE: usize = 97;
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / 2.0_f64.powi(53)
        };
        for similarity in [0.3_f64, 0.6, 0.9] {
            let (mut heights, mut square) = (vec![0.0; SIDE * SIDE], 0.0);
            for _ in 0..300 {
                // from a four hundredth of a wave a knot to eight, finer than the samples
                let frequency = PI / 200.0 * (3200.0_f64).powf(uniform());
                let (turn, phase) = (TAU * uniform(), TAU * uniform());
                let (amplitude, k) =
                    (frequency.powf(-similarity), [turn.cos(), turn.sin()].map(|c| c * frequency));
                for (at, height) in heights.iter_mut().enumerate() {
                    let (x, y) = ((at % SIDE) as f64, (at / SIDE) as f64);
                    *height += amplitude * (k[0] * x + k[1] * y + phase).cos();
                }
                let bent = |k: f64| (1.0 - (k / 2.0).cos()).powi(2);
                square += amplitude * amplitude / 2.0 * (bent(k[0]) + bent(k[1])) / 2.0;
            }
            let (o, h) = estimate(SIDE, SIDE, &heights).unwrap();
            println!("H {similarity}: {h:.3}; offset {:.3}: {o:.3}", square.sqrt());
            assert!((h - similarity).abs() < 0.08 && (o / square.sqrt() - 1.0).abs() < 0.15);
        }
        assert_eq!(estimate(4, 4, &[1.0; 16]), None);
        assert_eq!(estimate(2, 2, &[1.0, 2.0, 3.0, 5.0]), None);
    }
}
