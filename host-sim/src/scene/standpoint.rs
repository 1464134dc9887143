//! Where the camera of a surface stands.

use attractor::num::{Real, Vec3};
use attractor::trace::Camera;
pub(crate) use attractor_gallery::Standpoint;
use serde::Deserialize;
use toml::Spanned;

use super::orbit::Orbit;
use crate::fail::Fail;
use crate::source::{Num, Source};

/// The table `[camera]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Eye {
    pub(super) eye: Spanned<[Num; 3]>,
    look_at: Spanned<[Num; 3]>,
    up: Option<Spanned<[Num; 3]>>,
    field_of_view: Option<Num>,
}

/// Three numbers.
pub(super) fn vector(source: &Source, value: &Spanned<[Num; 3]>, key: &str) -> Result<Vec3, Fail> {
    let [x, y, z] = source.triple::<Real>(value.get_ref(), key)?;
    Ok(Vec3::new(x, y, z))
}

/// The camera, where it stands, and its orbit unless the scene says which way is up.
pub(super) fn camera(
    source: &Source,
    given: &Spanned<Eye>,
) -> Result<(Camera, Standpoint, Option<Orbit>), Fail> {
    let eye = given.get_ref();
    let up = match &eye.up {
        Some(up) => vector(source, up, "camera.up")?,
        None => Vec3::new(Real::ZERO, Real::ZERO, Real::ONE),
    };
    let field_of_view = match &eye.field_of_view {
        Some(angle) => source.fixed(angle, "camera.field_of_view")?,
        None => Real::from_num(40),
    };
    let (from, to) =
        (vector(source, &eye.eye, "camera.eye")?, vector(source, &eye.look_at, "camera.look_at")?);
    let camera =
        Camera::new(from, to, up, field_of_view).map_err(|error| match (&error, &eye.field_of_view) {
            (attractor::Error::OutOfRange { what: "field of view", .. }, Some(angle)) => {
                source.fail(angle.span(), "camera.field_of_view", error)
            }
            (attractor::Error::Degenerate { what: "up" | "angle between view and up" }, _)
                if eye.up.is_some() =>
            {
                source.fail(eye.up.as_ref().map_or(0..0, Spanned::span), "camera.up", error)
            }
            _ => source.fail(eye.eye.span(), "camera.eye", error),
        })?;
    let standpoint = Standpoint { eye: from, look_at: to, up, field_of_view };
    Ok((camera, standpoint, eye.up.is_none().then(|| Orbit::new(from, to, field_of_view))))
}
