//! A pinhole camera: where the eye is, where it looks, how wide.

use super::environment::between;
use crate::Error;
use crate::num::{Angle, Real, Unit, Vec3, Wide, nth, quotient, sin_cos};

/// A pinhole camera.
///
/// The view's frame is `w = norm(look_at - eye)`, `r = norm(w x up)`, `u = r x w`; a ray through the picture
/// at `(a, b)` half heights to the right of and above its centre has the direction `w + k (a r + b u)`, `k`
/// the tangent of half the field of view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Camera {
    pub(crate) eye: Vec3,
    pub(crate) forward: Vec3<Unit>,
    pub(crate) right: Vec3<Unit>,
    pub(crate) up: Vec3<Unit>,
    /// `k`, 28 fractional bits.
    pub(crate) tangent: i32,
}

impl Camera {
    /// A camera at `eye` that looks at `look_at`, with the vertical `field_of_view` in degrees.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an eye 64 or more from the origin along an axis or a field of view outside 1
    /// to 120 degrees; [`Error::Degenerate`] if the eye is where it looks, or looks along `up`.
    pub fn new(eye: Vec3, look_at: Vec3, up: Vec3, field_of_view: Real) -> Result<Self, Error> {
        for (index, c) in [eye.x, eye.y, eye.z].into_iter().enumerate() {
            if c.unsigned_abs().to_bits() >= 64 << 24 {
                let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
                return Err(Error::OutOfRange { what: "eye", index: Some(index), value: c.into(), min, max });
            }
        }
        between("field of view", None, field_of_view.into(), Wide::ONE, Wide::from_num(120))?;
        let forward =
            eye.towards(look_at).ok_or(Error::Degenerate { what: "distance from eye to look_at" })?;
        let up = up.normalised().ok_or(Error::Degenerate { what: "up" })?;
        let side = forward.cross(up);
        // an `up` within 2^-10 of the view's direction leaves the frame undecided
        if side.dot(side) < Unit::DELTA * 1024 {
            return Err(Error::Degenerate { what: "angle between view and up" });
        }
        let right = side.normalised().ok_or(Error::Degenerate { what: "angle between view and up" })?;
        // half the angle in turns: degrees / 720, with 32 fractional bits
        let half = nth(i64::from(field_of_view.to_bits()) << 8, 720);
        let (sin, cos) = sin_cos(Angle::from_bits(half as u32));
        let tangent = quotient(i64::from(sin.to_bits()), 28, u64::from(cos.to_bits().unsigned_abs()));
        Ok(Self { eye, forward, right, up: right.cross(forward), tangent: tangent as i32 })
    }

    /// The same from f32 numbers, for firmware that moves a camera about: an eye at `distance` from
    /// `look_at`, `turn` radians about the vertical, `lift` radians above the horizon. Sines and cosines are
    /// micromath's, good to `2e-3`.
    ///
    /// # Errors
    /// As [`Camera::new`].
    #[cfg(feature = "micromath")]
    #[allow(
        clippy::float_arithmetic,
        reason = "set-up from user input, not a kernel; IEEE single precision gives the same bits everywhere"
    )]
    pub fn orbit(
        look_at: [f32; 3],
        distance: f32,
        turn: f32,
        lift: f32,
        field_of_view: f32,
    ) -> Result<Self, Error> {
        // by name: where std is linked its methods would be taken instead
        use micromath::F32Ext;
        let [x, y, z] = look_at;
        let (level, height) = (distance * F32Ext::cos(lift), distance * F32Ext::sin(lift));
        // what is no number counts as too large
        let real = |v: f32| {
            let value = Wide::checked_from_num(v).unwrap_or(if v < 0.0 { Wide::MIN } else { Wide::MAX });
            let (min, max) = (Wide::from_num(-128), Wide::from_num(128));
            let refused =
                Error::OutOfRange { what: "coordinate or angle of the orbit", index: None, value, min, max };
            Real::checked_from_num(v).ok_or(refused)
        };
        let eye = Vec3::new(
            real(x + level * F32Ext::cos(turn))?,
            real(y + level * F32Ext::sin(turn))?,
            real(z + height)?,
        );
        let up = Vec3::new(Real::ZERO, Real::ZERO, Real::ONE);
        Self::new(eye, Vec3::new(real(x)?, real(y)?, real(z)?), up, real(field_of_view)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i32, y: i32, z: i32) -> Vec3 {
        Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z))
    }

    /// Eyes and aims as far apart as they may be, along every axis and diagonal.
    #[test]
    fn a_camera_looks_at_what_it_is_told_however_far() {
        let (mut far, mut tried) = (0, 0);
        for [ex, ey, ez] in [[-60, 0, 0], [63, -63, 63], [0, 0, 0], [-63, 63, 5], [1, -63, -63]] {
            for [lx, ly, lz] in [[120, 90, 0], [-128, 127, -128], [127, 127, 127], [0, -128, 1], [64, 0, 127]]
            {
                let camera =
                    Camera::new(at(ex, ey, ez), at(lx, ly, lz), at(1, 2, 101), Real::from_num(30)).unwrap();
                let exact = [lx - ex, ly - ey, lz - ez].map(f64::from);
                let length = exact.iter().map(|c| c * c).sum::<f64>().sqrt();
                let got = [camera.forward.x, camera.forward.y, camera.forward.z].map(|c| c.to_num::<f64>());
                for (g, e) in got.iter().zip(exact) {
                    assert!((g - e / length).abs() < 2_f64.powi(-27), "{got:?} against {exact:?}");
                }
                far += usize::from(exact.iter().any(|c| c.abs() >= 128.0));
                tried += 1;
            }
        }
        assert!(far >= 10 && tried == 25, "{far} of {tried}");
    }

    #[test]
    fn the_frame_of_a_camera_is_orthonormal_and_its_tangent_that_of_half_the_view() {
        for (look_at, degrees) in [(at(120, 90, 0), 1.0_f64), (at(3, -2, 1), 40.0), (at(-60, 1, 127), 120.0)]
        {
            let camera = Camera::new(at(-60, 0, 0), look_at, at(0, 0, 1), Real::from_num(degrees)).unwrap();
            let (w, r, u) = (camera.forward, camera.right, camera.up);
            for (a, b, product) in
                [(w, w, 1.0), (r, r, 1.0), (u, u, 1.0), (w, r, 0.0), (w, u, 0.0), (r, u, 0.0)]
            {
                assert!((a.dot(b).to_num::<f64>() - product).abs() < 1e-7);
            }
            // upright: the horizon is level and up is not down
            assert!(r.z.to_num::<f64>().abs() < 1e-7 && u.z > 0);
            let exact = (degrees.to_radians() / 2.0).tan();
            let error = (f64::from(camera.tangent) / 2_f64.powi(28) - exact).abs();
            assert!(error < 2_f64.powi(-26), "{degrees}: {error:e}");
        }
    }

    #[test]
    fn right_is_to_the_right_and_up_is_up() {
        // along y with z upwards, x is to the right
        let camera = Camera::new(at(1, 2, 3), at(1, 5, 3), at(0, 0, 7), Real::from_num(90)).unwrap();
        let nearly = |v: Vec3<Unit>, exact: [i32; 3]| {
            [v.x, v.y, v.z]
                .iter()
                .zip(exact)
                .all(|(c, e)| (i64::from(c.to_bits()) - (i64::from(e) << 30)).abs() < 8)
        };
        assert!(
            nearly(camera.forward, [0, 1, 0])
                && nearly(camera.right, [1, 0, 0])
                && nearly(camera.up, [0, 0, 1])
        );
        // half of 90 degrees has the tangent 1
        assert!((camera.tangent - (1 << 28)).abs() <= 4, "{}", camera.tangent);
        assert_eq!(camera.eye, at(1, 2, 3));
    }

    /// Degrees, the eye's coordinates and the angle between view and `up`, just inside and just outside.
    #[test]
    fn a_camera_is_refused_from_its_limits_on() {
        let camera = |eye: [i32; 3], up: Vec3, degrees: i32| {
            let [x, y, z] = eye.map(Real::from_bits);
            Camera::new(Vec3::new(x, y, z), at(0, 0, 100), up, Real::from_bits(degrees)).map(|_| ())
        };
        let (up, limit, degree) = (at(1, 0, 0), 64 << 24, 1 << 24);
        let far = |index, bits: i32| {
            let value = Wide::from(Real::from_bits(bits));
            Err(Error::OutOfRange {
                what: "eye",
                index: Some(index),
                value,
                min: Wide::from_num(-64),
                max: Wide::from_num(64),
            })
        };
        for index in 0..3 {
            for edge in [limit, -limit] {
                let mut eye = [0; 3];
                eye[index] = edge;
                assert_eq!(camera(eye, at(1, 2, 0), 40 * degree), far(index, edge));
                eye[index] -= edge.signum();
                assert_eq!(camera(eye, at(1, 2, 0), 40 * degree), Ok(()));
            }
        }
        let fits =
            [degree - 1, degree, 120 * degree, 120 * degree + 1].map(|d| camera([0; 3], up, d).is_ok());
        assert_eq!(fits, [false, true, true, false]);
        // looking along z, with an `up` that leans away from it by a 1023rd and by a 1025th
        let leaning = |n: i32| {
            let up = Vec3::new(Real::from_bits((1 << 30) / n), Real::ZERO, Real::from_bits(1 << 30));
            camera([0; 3], up, 40 * degree)
        };
        let refused = Err(Error::Degenerate { what: "angle between view and up" });
        assert_eq!([leaning(1023), leaning(1025), leaning(-1023)], [Ok(()), refused, Ok(())]);
        assert_eq!(camera([0; 3], at(0, 0, 1), 40 * degree), refused);
        assert_eq!(camera([0; 3], at(0, 0, 0), 40 * degree), Err(Error::Degenerate { what: "up" }));
        let there = Camera::new(at(1, 2, 3), at(1, 2, 3), at(0, 0, 1), Real::from_num(40)).map(|_| ());
        assert_eq!(there, Err(Error::Degenerate { what: "distance from eye to look_at" }));
    }

    /// Against sines and cosines in double precision.
    #[cfg(feature = "micromath")]
    #[test]
    fn an_orbit_is_where_its_angles_say() {
        let mut worst: f64 = 0.0;
        for i in 0..200_u8 {
            let (turn, lift) = (f32::from(i) * 0.3 - 30.0, (f32::from(i % 29) - 14.0) / 10.0);
            let camera = Camera::orbit([1.0, -2.0, 3.0], 10.0, turn, lift, 40.0).unwrap();
            let (turn, lift) = (f64::from(turn), f64::from(lift));
            let exact = [
                1.0 + 10.0 * lift.cos() * turn.cos(),
                -2.0 + 10.0 * lift.cos() * turn.sin(),
                3.0 + 10.0 * lift.sin(),
            ];
            for (got, exact) in [camera.eye.x, camera.eye.y, camera.eye.z].into_iter().zip(exact) {
                worst = worst.max((got.to_num::<f64>() - exact).abs() / 10.0);
            }
        }
        assert!((5e-4..2e-3).contains(&worst), "{worst}");
        let lost = |x: f32, turn: f32| Camera::orbit([x, 0.0, 0.0], 10.0, turn, 0.5, 40.0).is_err();
        assert_eq!(
            [lost(0.0, 0.0), lost(f32::NAN, 0.0), lost(1e9, 0.0), lost(60.0, 0.0)],
            [false, true, true, true]
        );
    }
}
