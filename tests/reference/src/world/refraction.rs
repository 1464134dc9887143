//! The directions of reflected and refracted light, and how much of it is reflected.
//!
//! Source: course unit V, section 5.9 (`r = dir - 2 (dir . m) m`) and 5.9.1 (Snell's law,
//! `sin t / c_2 = sin i / c_1` with the speeds of light; an index is the inverse of a speed);
//! CONTRIBUTING.md, "The picture of a world, defined", Material (Fresnel's reflectance of unpolarised light).

use crate::vector::{Vector, along, dot};

/// The direction `d`, mirrored at the unit normal `n`.
pub fn mirrored(d: Vector, n: Vector) -> Vector {
    along(d, -2.0 * dot(d, n), n)
}

/// The unit direction of the light that comes along the unit direction `d` and goes on behind a surface with
/// the unit normal `n` against it, `eta` being the index before it over the index behind it; nothing if all
/// is reflected.
///
/// The part of `d` along the surface, `d + cos i n`, is the sine of the one angle; `eta` times it is that of
/// the other.
pub fn refracted(d: Vector, n: Vector, eta: f64) -> Option<Vector> {
    let cos_i = -dot(d, n);
    let level = along(d, cos_i, n).map(|c| eta * c);
    let rest = 1.0 - dot(level, level);
    (rest > 0.0).then(|| along(level, -libm::sqrt(rest), n))
}

/// Fresnel's reflectance, from the cosines of the two angles.
pub fn reflectance(eta: f64, cos_i: f64, cos_t: f64) -> f64 {
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let across = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    (parallel * parallel + across * across) / 2.0
}

#[cfg(test)]
mod tests {
    use super::{mirrored, reflectance, refracted};
    use crate::vector::{cross, dot, normalised};

    #[test]
    fn the_sines_are_as_the_indices_and_the_ray_stays_in_its_plane() {
        let mut bent = 0;
        for k in 1..200 {
            let angle = f64::from(k) * 0.0078;
            let n = normalised([0.3, -0.2, 1.0]);
            let side = normalised(cross(n, [1.0, 0.0, 0.0]));
            let (s, c) = (libm::sin(angle), libm::cos(angle));
            let d = [0, 1, 2].map(|i| s * side[i] - c * n[i]);
            for eta in [1.0 / 1.5, 1.5, 1.0, 1.33 / 2.4] {
                let answer = refracted(d, n, eta);
                assert_eq!(answer.is_some(), s * eta < 1.0);
                let Some(t) = answer else { continue };
                assert!((dot(t, side) - eta * s).abs() < 1e-14);
                assert!((dot(t, t) - 1.0).abs() < 1e-14 && dot(t, n) < 0.0);
                assert!(dot(cross(t, side), n).abs() < 1e-14);
                bent += 1;
            }
        }
        assert!(bent > 600, "{bent}");
    }

    #[test]
    fn light_at_right_angles_goes_straight_on_and_back() {
        let n = [0.0, 0.0, 1.0];
        assert_eq!(refracted([0.0, 0.0, -1.0], n, 1.0 / 1.5), Some([0.0, 0.0, -1.0]));
        assert_eq!(mirrored([0.0, 0.0, -1.0], n), n);
        assert_eq!(mirrored([0.6, 0.0, -0.8], n), [0.6, 0.0, 0.8]);
    }

    #[test]
    fn the_critical_angle_of_glass_is_41_degrees() {
        let n = [0.0, 0.0, 1.0];
        let at = |degrees: f64| {
            let angle = degrees.to_radians();
            refracted([libm::sin(angle), 0.0, -libm::cos(angle)], n, 1.5).is_some()
        };
        assert!(at(41.81) && !at(41.82));
    }

    #[test]
    fn fresnel_is_4_percent_straight_on_glass_and_all_when_grazing() {
        assert!((reflectance(1.0 / 1.5, 1.0, 1.0) - 0.04).abs() < 1e-15);
        assert_eq!(reflectance(1.0 / 1.5, 0.0, 0.7), 1.0);
        // At Brewster's angle, tan i = 1.5, only the part across is reflected: ((n^2 - 1) / (n^2 + 1))^2 / 2.
        let cos_i = 1.0 / libm::sqrt(1.0 + 2.25);
        let sin_t = libm::sqrt(1.0 - cos_i * cos_i) / 1.5;
        let r = reflectance(1.0 / 1.5, cos_i, libm::sqrt(1.0 - sin_t * sin_t));
        let across = 1.25 / 3.25;
        assert!((r - across * across / 2.0).abs() < 1e-15, "{r}");
    }
}
