//! What a highlight is: light that leaves a surface near the direction in which it is mirrored.

use super::super::surface::SurfacePoint;
use super::anisotropic::Anisotropic;
use super::phong::Phong;
use super::torrance_sparrow::TorranceSparrow;
use crate::num::{Lumen, Unit, Vec3, unit};

/// From where a point is looked at: unit vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct View {
    /// The normal that light sees, against the ray.
    pub normal: Vec3<Unit>,
    /// The direction of the ray.
    pub direction: Vec3<Unit>,
    /// Along the grain of the surface, at right angles to the normal; any such direction where the point has
    /// no texture coordinates.
    pub tangent: Vec3<Unit>,
}

/// A model of highlights.
pub trait Specular {
    /// Whether it looks at the grain.
    fn is_charted(&self) -> bool {
        false
    }

    /// The part of the light from the unit direction `towards`, above the surface, that is seen.
    fn part(&self, view: &View, towards: Vec3<Unit>) -> Lumen;
}

/// No highlight.
impl Specular for () {
    fn part(&self, _: &View, _: Vec3<Unit>) -> Lumen {
        Lumen::ZERO
    }
}

/// Any of the models, for a choice at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Highlight {
    /// None.
    None,
    /// Phong's.
    Phong(Phong),
    /// Torrance's and Sparrow's.
    TorranceSparrow(TorranceSparrow),
    /// Ward's, along a grain.
    Anisotropic(Anisotropic),
}

impl Specular for Highlight {
    fn is_charted(&self) -> bool {
        matches!(self, Self::Anisotropic(_))
    }

    fn part(&self, view: &View, towards: Vec3<Unit>) -> Lumen {
        match self {
            Self::None => Lumen::ZERO,
            Self::Phong(model) => model.part(view, towards),
            Self::TorranceSparrow(model) => model.part(view, towards),
            Self::Anisotropic(model) => model.part(view, towards),
        }
    }
}

impl View {
    /// Of a point with this normal, looked at in this direction.
    pub(super) fn new(point: &SurfacePoint, normal: Vec3<Unit>, direction: Vec3<Unit>) -> Self {
        let grain = point.chart.along_u;
        // at right angles to the normal: what of the grain lies along it is taken off
        let bits = [grain.x, grain.y, grain.z].map(|c| i64::from(c.to_bits()));
        let n = [normal.x, normal.y, normal.z].map(|c| i64::from(c.to_bits()));
        let along = bits.iter().zip(n).map(|(g, n)| (g * n) >> 30).sum::<i64>();
        let mut tangent = [0; 3];
        for ((t, g), n) in tangent.iter_mut().zip(bits).zip(n) {
            // below 2^31 times 4
            *t = ((g - ((along * n) >> 30)) >> 2) as i32;
        }
        Self { normal, direction, tangent: unit(tangent) }
    }

    /// The unit vector half way between the eye and a light.
    pub(super) fn half(&self, towards: Vec3<Unit>) -> Vec3<Unit> {
        let half = |l: Unit, d: Unit| (l.to_bits() >> 1).wrapping_sub(d.to_bits() >> 1);
        let d = self.direction;
        unit([half(towards.x, d.x), half(towards.y, d.y), half(towards.z, d.z)])
    }

    /// How far the eye stands above the surface: `n . v`, at least `2^-12`.
    pub(super) fn height(&self) -> Unit {
        self.normal.dot(self.direction).saturating_neg().clamp(Unit::from_bits(1 << 18), Unit::ONE)
    }
}

/// The product of two numbers in `[0, 1]`, to the nearest.
#[inline]
pub(super) fn times(a: Unit, b: Unit) -> Unit {
    Unit::from_bits(((i64::from(a.to_bits()) * i64::from(b.to_bits()) + (1 << 29)) >> 30) as i32)
}
