//! A pinhole camera: where the eye is, where it looks, how wide.

use super::environment::between;
use crate::Error;
use crate::num::{Angle, Real, Unit, Vec3, Wide, nth, quotient, sin_cos};

/// A pinhole camera.
///
/// The view's frame is `w = norm(look_at - eye)`, `r = norm(w x up)`, `u = r x w`; a ray through the picture at `(a, b)` half heights to the right of and
/// above its centre has the direction `w + k (a r + b u)`, `k` the tangent of half the field of view.
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
    /// [`Error::OutOfRange`] for an eye 64 or more from the origin along an axis or a field of view outside 1 to 120 degrees;
    /// [`Error::Degenerate`] if the eye is where it looks, or looks along `up`.
    pub fn new(eye: Vec3, look_at: Vec3, up: Vec3, field_of_view: Real) -> Result<Self, Error> {
        for (index, c) in [eye.x, eye.y, eye.z].into_iter().enumerate() {
            if c.unsigned_abs().to_bits() >= 64 << 24 {
                let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
                return Err(Error::OutOfRange { what: "eye", index: Some(index), value: c.into(), min, max });
            }
        }
        between("field of view", None, field_of_view.into(), Wide::ONE, Wide::from_num(120))?;
        let forward = look_at
            .minus(eye)
            .normalised()
            .ok_or(Error::Degenerate { what: "distance from eye to look_at" })?;
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

    /// The same from f32 numbers, for firmware that moves a camera about: an eye at `distance` from `look_at`, `turn` radians about the vertical, `lift` radians above
    /// the horizon. Sines and cosines are micromath's, good to `2e-3`.
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
