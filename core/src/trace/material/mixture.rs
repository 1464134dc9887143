//! The five components of the text in one material: ambient, diffuse, specular, reflected and refracted
//! light.
//!
//! Source: the course unit V, section 5.9, `I = I_amb + I_diff + I_spec + I_refl + I_tran`.

use super::super::environment::between;
use super::super::surface::SurfacePoint;
use super::super::texture::field::Texture;
use super::respond::{Lit, Material, Medium, Response};
use super::specular::{Sight, Specular};
use super::sum::{Light, Sum, lit, part, whole_or_less};
use crate::Error;
use crate::num::{Lumen, Real, Rgb, Unit, Vec3, Wide};

/// A material by its components. `T` is what colours it, `S` its model of highlights, `I` what is inside:
/// nothing that light passes, unless it is [`Clear`]. What a type rules out takes no code: a world without
/// glass has none of refraction's.
///
/// ```
/// use attractor::num::{Lumen, Real, Rgb, Unit};
/// use attractor::trace::material::{Mixture, Phong};
///
/// const ORANGE: Rgb = Rgb::new(Lumen::lit("1"), Lumen::lit("0.4"), Lumen::lit("0.05"));
/// let chalk = Mixture::matt(ORANGE);
/// let plastic = Mixture::matt(ORANGE).with_highlight(Rgb::WHITE, Phong { shininess: 40 });
/// let glass = Mixture::glass(Real::lit("1.5"))?;
/// # let _ = (chalk, plastic, glass);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mixture<T = Rgb, S = (), I = ()> {
    pigment: T,
    ambient: Unit,
    diffuse: Unit,
    specular: Rgb,
    model: S,
    reflect: Rgb,
    interior: I,
}

/// What is inside a thing of a material.
pub trait Interior {
    /// Whether there is ever a medium.
    const MAY_BE_CLEAR: bool = true;

    /// The medium; none where no light passes.
    fn medium(&self) -> Option<Medium>;
    /// How much of the light that meets the surface goes through.
    fn passes(&self) -> Rgb;
}

/// Opaque.
impl Interior for () {
    const MAY_BE_CLEAR: bool = false;

    fn medium(&self) -> Option<Medium> {
        None
    }

    fn passes(&self) -> Rgb {
        Rgb::BLACK
    }
}

/// Transparent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Clear {
    medium: Medium,
    transmit: Rgb,
}

impl Clear {
    /// A medium, and how much of the light that meets the surface goes through.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an index outside 0.1 to 10.
    pub fn new(medium: Medium, transmit: Rgb) -> Result<Self, Error> {
        // a tenth is no binary fraction
        let least = Wide::ONE / 10 - (Wide::ONE >> 24);
        between("index of refraction", None, medium.index.into(), least, Wide::from_num(10))?;
        Ok(Self { medium, transmit })
    }
}

impl Interior for Clear {
    fn medium(&self) -> Option<Medium> {
        Some(self.medium)
    }

    fn passes(&self) -> Rgb {
        self.transmit
    }
}

/// Either, for a choice at run time.
impl Interior for Option<Clear> {
    fn medium(&self) -> Option<Medium> {
        self.as_ref().and_then(Clear::medium)
    }

    fn passes(&self) -> Rgb {
        self.as_ref().map_or(Rgb::BLACK, Clear::passes)
    }
}

impl<T> Mixture<T> {
    /// Matt, an eighth of it ambient.
    pub const fn matt(pigment: T) -> Self {
        Self {
            pigment,
            ambient: Unit::from_bits(1 << 27),
            diffuse: Unit::from_bits(7 << 27),
            specular: Rgb::BLACK,
            model: (),
            reflect: Rgb::BLACK,
            interior: (),
        }
    }
}

impl Mixture {
    /// A mirror that reflects all light.
    pub const fn mirror() -> Self {
        Self { ambient: Unit::ZERO, diffuse: Unit::ZERO, reflect: Rgb::WHITE, ..Self::matt(Rgb::BLACK) }
    }

    /// Clear glass of an index of refraction, which reflects by Fresnel's equations.
    ///
    /// # Errors
    /// As [`Clear::new`].
    pub fn glass(index: Real) -> Result<Mixture<Rgb, (), Clear>, Error> {
        let none = Self { ambient: Unit::ZERO, diffuse: Unit::ZERO, ..Self::matt(Rgb::BLACK) };
        Ok(none.with_interior(Clear::new(Medium { index, priority: 0, fresnel: true }, Rgb::WHITE)?))
    }
}

impl<T, S, I> Mixture<T, S, I> {
    /// With this part of ambient and this of diffuse light.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a part outside `[0, 1]`.
    pub fn with_parts(mut self, ambient: Unit, diffuse: Unit) -> Result<Self, Error> {
        for (index, part) in [ambient, diffuse].into_iter().enumerate() {
            between("part of the material", Some(index), part.into(), Wide::ZERO, Wide::ONE)?;
        }
        (self.ambient, self.diffuse) = (ambient, diffuse);
        Ok(self)
    }

    /// With highlights of a colour and a model.
    pub fn with_highlight<H>(self, color: Rgb, model: H) -> Mixture<T, H, I> {
        let Self { pigment, ambient, diffuse, reflect, interior, .. } = self;
        Mixture { pigment, ambient, diffuse, specular: color, model, reflect, interior }
    }

    /// With this part of what the mirrored ray brings.
    #[must_use]
    pub fn with_reflection(mut self, part: Rgb) -> Self {
        self.reflect = part;
        self
    }

    /// With this inside.
    pub fn with_interior<J>(self, interior: J) -> Mixture<T, S, J> {
        let Self { pigment, ambient, diffuse, specular, model, reflect, .. } = self;
        Mixture { pigment, ambient, diffuse, specular, model, reflect, interior }
    }
}

impl<T: Texture, S: Specular, I: Interior> Material for Mixture<T, S, I> {
    const MAY_BE_CLEAR: bool = I::MAY_BE_CLEAR;

    fn is_charted(&self) -> bool {
        self.pigment.is_charted() || self.model.is_charted()
    }

    fn medium(&self) -> Option<Medium> {
        self.interior.medium()
    }

    fn passes(&self) -> Rgb {
        self.interior.passes()
    }

    fn respond(&self, point: &SurfacePoint, view: Vec3<Unit>, lights: impl Iterator<Item = Lit>) -> Response {
        let pigment = self.pigment.at(point);
        let view = Sight::new(point, view, self.model.is_charted());
        let is_shiny = self.specular != Rgb::BLACK;
        let mut diffuse = Sum::of(self.ambient);
        let mut specular = Sum::of(Unit::ZERO);
        for Lit { towards, light } in lights {
            let light = Light::new(light);
            let cos = point.normal.dot(towards).max(Unit::ZERO);
            diffuse.add(light, part(self.diffuse, cos));
            if is_shiny {
                match self.model.part(&view, towards) {
                    seen if seen <= Lumen::ONE => specular.add(light, whole_or_less(seen)),
                    seen => specular.add(light.brighter(seen), i32::MAX),
                }
            }
        }
        let light = if is_shiny {
            lit([(pigment, diffuse), (self.specular, specular)])
        } else {
            lit([(pigment, diffuse)])
        };
        Response { light, reflected: self.reflect, refracted: self.interior.passes() }
    }
}
