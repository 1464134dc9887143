//! Dwell of the orbits of `z^2 + c`: Mandelbrot and filled-in Julia sets.
//!
//! Source: course unit V, "Fractals", 5.4.2-5.4.3 and 5.5.1-5.5.2, eq. 1-3. The printed loop returns Num + 1
//! for points that never escape; the definition in the text stands: the dwell is min(number of iterations
//! until |d_k| exceeds 2, Num). Plain `f64`, every product and sum rounded: near the boundary an orbit is
//! chaotic and the dwell is that of the rounded one.

/// The dwell of `c`: the orbit of 0 from `d_1 = c` on. 0 means that `|c| > 2` already; `max` that it did not
/// escape.
pub fn dwell(c: (f64, f64), max: u32) -> u32 {
    iterations(c, c, max)
}

/// The dwell of the starting point `z` for a fixed `c`: the orbit from `d_0 = z` on. 0 means that `|z| > 2`
/// already.
///
/// An orbit that passes 2 is certain to escape only for `|c| <= 2`.
pub fn julia_dwell(z: (f64, f64), c: (f64, f64), max: u32) -> u32 {
    iterations(z, c, max)
}

/// The number of times that `d = d^2 + c` is applied until `|d| > 2`, at most `max`.
fn iterations((mut x, mut y): (f64, f64), c: (f64, f64), max: u32) -> u32 {
    let mut count = 0;
    while count < max && x * x + y * y <= 4.0 {
        (x, y) = (x * x - y * y + c.0, 2.0 * x * y + c.1);
        count += 1;
    }
    count
}

/// Whether `c` lies in the main cardioid, where the orbit of 0 tends to a fixed point: `c = w/2 - w^2/4` with
/// `|w| <= 1` (`w = 2 p` is the derivative at the fixed point `p = 1/2 - sqrt(1/4 - c)`, eq. 4 as corrected).
pub fn in_cardioid((x, y): (f64, f64)) -> bool {
    let (from_cusp, y_squared) = (x - 0.25, y * y);
    let q = from_cusp * from_cusp + y_squared;
    q * (q + from_cusp) <= y_squared / 4.0
}

/// Whether `c` lies in the disc `|c + 1| <= 1/4`, where the orbit of 0 tends to a cycle of period 2: the
/// derivative along that cycle is `4 (c + 1)`.
pub fn in_period_2_bulb((x, y): (f64, f64)) -> bool {
    (x + 1.0) * (x + 1.0) + y * y <= 0.0625
}

#[cfg(test)]
mod tests {
    use super::{dwell, in_cardioid, in_period_2_bulb, julia_dwell};

    #[test]
    fn dwell_counts_the_steps_after_c() {
        // 3; then 2, 6; then 1, 2, 5; 0.5 0.75 1.0625 1.629 3.15.
        let real = |c: f64| dwell((c, 0.0), 100);
        assert_eq!((real(3.0), real(2.0), real(1.0), real(0.5)), (0, 1, 2, 4));
        assert_eq!(dwell((0.0, 2.0), 100), 1);
        assert_eq!(dwell((1.5, 1.5), 100), 0);
    }

    #[test]
    fn points_of_the_set_have_the_dwell_max_and_no_more() {
        for max in [0, 1, 7, 100] {
            for c in [(0.0, 0.0), (-2.0, 0.0), (0.0, 1.0), (0.25, 0.0)] {
                assert_eq!(dwell(c, max), max);
            }
        }
        assert_eq!(dwell((0.5, 0.0), 3), 3);
    }

    #[test]
    fn the_orbit_of_a_julia_set_starts_at_its_point() {
        assert_eq!(julia_dwell((2.5, 0.0), (0.0, 0.0), 100), 0);
        // 1.5, 2.25; 1.1, 1.21, 1.4641, 2.14.
        assert_eq!(julia_dwell((1.5, 0.0), (0.0, 0.0), 100), 1);
        assert_eq!(julia_dwell((0.0, 1.1), (0.0, 0.0), 100), 3);
        assert_eq!(julia_dwell((0.6, -0.79), (0.0, 0.0), 100), 100);
        // K_(-2) is the segment from -2 to 2.
        assert_eq!(julia_dwell((1.0, 0.0), (-2.0, 0.0), 100), 100);
        assert!(julia_dwell((1.0, 0.01), (-2.0, 0.0), 100) < 20);
        // The orbit of 0 is that of c, one step later.
        assert_eq!(julia_dwell((0.0, 0.0), (0.5, 0.0), 100), dwell((0.5, 0.0), 100) + 1);
    }

    #[test]
    fn k_c_is_symmetrical_about_the_origin() {
        for i in 0..100 {
            let z = (f64::from(i % 10) * 0.3 - 1.5, f64::from(i / 10) * 0.25 - 1.25);
            let c = (-0.74, 0.11);
            assert_eq!(julia_dwell(z, c, 500), julia_dwell((-z.0, -z.1), c, 500));
        }
    }

    #[test]
    fn nothing_in_the_cardioid_or_the_bulb_escapes_and_much_else_does() {
        let (mut inside, mut escaped) = (0, 0);
        for i in 0..200 {
            for j in 0..200 {
                let c = (f64::from(i) * 0.015 - 2.0, f64::from(j) * 0.0125 - 1.25);
                let member = in_cardioid(c) || in_period_2_bulb(c);
                assert!(!(in_cardioid(c) && in_period_2_bulb(c)), "they only touch");
                let d = dwell(c, 300);
                assert!(!member || d == 300, "{c:?}");
                inside += u32::from(member);
                escaped += u32::from(d < 300);
            }
        }
        // 3 pi / 8 and pi / 16 of the 7.5 units of area: 7,330 of 40,000 points.
        assert!((7200..7460).contains(&inside), "{inside}");
        assert!(escaped > 30_000);
    }

    #[test]
    fn the_boundaries_of_cardioid_and_bulb_are_where_they_belong() {
        assert!(in_cardioid((0.25, 0.0)) && !in_cardioid((0.2501, 0.0)));
        assert!(in_cardioid((-0.7499, 0.0)) && !in_cardioid((-0.7501, 0.0)));
        assert!(in_period_2_bulb((-1.25, 0.0)) && in_period_2_bulb((-1.0, 0.25)));
        assert!(!in_period_2_bulb((-1.0, 0.2501)) && !in_period_2_bulb((-0.7499, 0.0)));
    }
}
