//! What a material is: an answer to the light at a point.

use super::super::surface::SurfacePoint;
use crate::num::{Real, Rgb, Unit, Vec3};

/// Light that reaches a point: from where, and how much is left of it after what stands between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lit {
    /// The unit vector towards the light.
    pub towards: Vec3<Unit>,
    /// How bright it is.
    pub light: Rgb,
}

/// What is inside a transparent thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Medium {
    /// Index of refraction: the speed of light in the vacuum over that in the medium, 0.1 to 10.
    pub index: Real,
    /// Where things overlap, that with the higher number is there.
    pub priority: u8,
    /// Whether it reflects more the flatter light meets it, by Fresnel's equations.
    pub fresnel: bool,
}

/// What leaves a point towards the eye, and what more is to be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Response {
    /// Ambient, diffuse and specular light.
    pub light: Rgb,
    /// How much of what comes along the mirrored ray is seen.
    pub reflected: Rgb,
    /// How much of what comes along the refracted ray is seen. Of this part the share that Fresnel's
    /// equations give, or all where light is reflected totally, joins the reflected one.
    pub refracted: Rgb,
}

/// What a surface is made of.
pub trait Material {
    /// Whether any material of this type may have a medium: where none has, a world has no code of glass.
    const MAY_BE_CLEAR: bool = true;

    /// Whether it looks at texture coordinates.
    fn is_charted(&self) -> bool {
        false
    }

    /// The medium inside; none for what is opaque.
    fn medium(&self) -> Option<Medium> {
        None
    }

    /// How much light passes straight through: the rule for shadows. None for what is opaque.
    fn passes(&self) -> Rgb {
        Rgb::BLACK
    }

    /// The unit normal that light sees: another one than the surface's where it is bumpy.
    fn normal(&self, point: &SurfacePoint) -> Vec3<Unit> {
        point.normal
    }

    /// What leaves the point against `view`, the unit direction in which it is looked at, when these lights
    /// reach it. The point's normal is against `view`.
    fn respond(&self, point: &SurfacePoint, view: Vec3<Unit>, lights: impl Iterator<Item = Lit>) -> Response;
}
