//! A camera that circles what it looks at, set up in f32 as firmware with a joystick would.

use attractor::num::{Real, Vec3};
use attractor::trace::Camera;
use embedded_graphics::geometry::Size;

use super::motion::Motion;
use crate::fail::Fail;

/// Where a camera stands, seen from what it looks at; z is up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Orbit {
    look_at: [f32; 3],
    distance: f32,
    /// Radians about the vertical, and above the horizon.
    turn: f32,
    lift: f32,
    /// Degrees.
    field_of_view: f32,
}

impl Orbit {
    /// The orbit on which a camera stands.
    pub(super) fn new(eye: Vec3, look_at: Vec3, field_of_view: Real) -> Self {
        let float = |v: Vec3| [v.x, v.y, v.z].map(|part| part.to_num::<f32>());
        let ([x, y, z], look_at) = (float(eye), float(look_at));
        let (right, ahead, up) = (x - look_at[0], y - look_at[1], z - look_at[2]);
        Self {
            look_at,
            distance: right.hypot(ahead).hypot(up),
            turn: ahead.atan2(right),
            lift: up.atan2(right.hypot(ahead)),
            field_of_view: field_of_view.to_num(),
        }
    }

    /// After a motion on a display of this size: a display's width is a quarter of a turn, twice as large is
    /// half as far.
    pub(super) fn after(&self, motion: Motion, size: Size) -> Self {
        /// Short of the zenith, where there is no up.
        const STEEPEST: f32 = 1.5;
        let angle =
            |pixels: i32| pixels as f32 / size.width.max(size.height) as f32 * std::f32::consts::FRAC_PI_2;
        let mut orbit = *self;
        match motion {
            Motion::Pan { right, up } => {
                orbit.turn += angle(right);
                orbit.lift = (orbit.lift + angle(up)).clamp(-STEEPEST, STEEPEST);
            }
            Motion::Zoom { closer: true, .. } => orbit.distance /= 1.25,
            Motion::Zoom { closer: false, .. } => orbit.distance *= 1.25,
            Motion::Iterate { .. } | Motion::Light { .. } => {}
        }
        orbit
    }

    /// The camera there.
    pub(super) fn camera(&self) -> Result<Camera, Fail> {
        Camera::orbit(self.look_at, self.distance, self.turn, self.lift, self.field_of_view)
            .map_err(Fail::new)
    }

    /// Where that is.
    pub(super) fn eye(&self) -> [f32; 3] {
        let [x, y, z] = self.look_at;
        let (level, up) = (self.distance * self.lift.cos(), self.distance * self.lift.sin());
        [x + level * self.turn.cos(), y + level * self.turn.sin(), z + up]
    }

    /// As a table of a scene file.
    pub(super) fn place(&self) -> String {
        let eye = self.eye();
        format!(
            "[camera]\neye = {eye:?}\nlook_at = {:?}\nfield_of_view = {:?}\n",
            self.look_at, self.field_of_view
        )
    }
}

/// A light at a place, carried round another place as a camera is that is panned as far.
pub(super) fn carried(light: Vec3, about: Vec3, pan: [i32; 2], size: Size) -> Vec3 {
    let [right, up] = pan;
    let orbit = Orbit::new(light, about, Real::ONE).after(Motion::Pan { right, up }, size);
    let [x, y, z] = orbit.eye().map(Real::saturating_from_num);
    Vec3::new(x, y, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_is_carried_round_and_back_at_its_distance() {
        let (light, about) = (Vec3::lit("3", "-2", "5"), Vec3::lit("1", "0.5", "-1"));
        let size = Size::new(240, 240);
        // a quarter of a turn to the right
        let there = carried(light, about, [240, 0], size);
        let off =
            [(there.x, 3.5), (there.y, 2.5), (there.z, 5.0)].map(|(c, exact)| c.to_num::<f64>() - exact);
        assert!(off.iter().all(|off| off.abs() < 1e-5), "{there:?}");
        let back = carried(carried(light, about, [-80, -60], size), about, [80, 60], size);
        let off = [back.x - light.x, back.y - light.y, back.z - light.z];
        assert!(off.iter().all(|off| off.abs() < Real::lit("0.00001")), "{back:?}");
    }

    #[test]
    fn a_camera_that_does_not_move_stays_where_it_is() {
        let at = |x: f32, y: f32, z: f32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        let orbit = Orbit::new(at(-4.0, -3.0, 5.0), at(1.0, 1.0, 0.5), Real::from_num(32));
        let place = orbit.place();
        let eye = place.lines().nth(1).unwrap().trim_start_matches("eye = [").trim_end_matches(']');
        for (got, wanted) in eye.split(", ").map(|v| v.parse::<f32>().unwrap()).zip([-4.0, -3.0, 5.0]) {
            assert!((got - wanted).abs() < 1e-5, "{place}");
        }
        assert!(orbit.camera().is_ok());
    }

    #[test]
    fn the_zenith_is_not_reached() {
        let at = |x: i32, z: i32| Vec3::new(Real::from_num(x), Real::ZERO, Real::from_num(z));
        let mut orbit = Orbit::new(at(2, 1), at(0, 0), Real::from_num(40));
        for _ in 0..50 {
            orbit = orbit.after(Motion::Pan { right: 7, up: 30 }, Size::new(240, 240));
            assert!(orbit.camera().is_ok());
        }
        // nearer and nearer: refused when the numbers end, never a panic
        let closer = Motion::Zoom { about: None, closer: true };
        for _ in 0..200 {
            orbit = orbit.after(closer, Size::new(240, 240));
        }
        assert!(orbit.camera().is_err());
    }
}
