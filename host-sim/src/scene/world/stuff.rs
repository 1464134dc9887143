//! Of what the things of a world are made, as core has it: pigments, bumps, grains and media chosen at run
//! time.

use attractor::num::{Angle, Real, Rgb, Unit};
use attractor::trace::SurfacePoint;
use attractor::trace::material::{Clear, Highlight, Mixture};
use attractor::trace::texture::{
    Bump, Bumpy, Checker, Facets, Framed, Grain, Image, Relief, Rough, Turbulence,
};
use attractor::{Error, materials};

use super::material::{Colored, Matter};
use super::texture::{Pattern, Pigment};

/// The five components.
type Mixed<'a> = Mixture<Pigment<'a>, Highlight<'a>, Option<Clear>>;

materials! {
    /// Of what a thing is made.
    #[derive(Debug, Clone)]
    pub(crate) enum Stuff<'a> {
        Smooth(Mixed<'a>),
        Bumpy(Bumpy<Mixed<'a>, Raised<'a>>),
        Grained(Framed<Mixed<'a>, Turned<'a>>),
        BumpyGrained(Bumpy<Framed<Mixed<'a>, Turned<'a>>, Raised<'a>>),
    }
}

/// How a surface is raised.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Raised<'a> {
    Rough(Rough),
    Facets(Facets),
    Relief(Relief<'a>),
}

impl Bump for Raised<'_> {
    fn slopes(&self, point: &SurfacePoint) -> [Real; 2] {
        match self {
            Self::Rough(bump) => bump.slopes(point),
            Self::Facets(bump) => bump.slopes(point),
            Self::Relief(bump) => bump.slopes(point),
        }
    }
}

/// Where a grain goes.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Turned<'a> {
    Threads(Checker),
    Streaks(Turbulence, Unit),
    Table(Image<'a>),
}

impl Grain for Turned<'_> {
    fn turn(&self, point: &SurfacePoint) -> Angle {
        match self {
            Self::Threads(checker) => checker.turn(point),
            Self::Streaks(turbulence, turns) => (*turbulence, *turns).turn(point),
            Self::Table(image) => image.turn(point),
        }
    }
}

/// The bumps of a texture with a strength; none of one that is no relief.
pub(super) fn raised(pattern: &Pattern, strength: Real) -> Result<Option<Raised<'_>>, Error> {
    Ok(match pattern {
        Pattern::Mottle { grain, .. } => {
            Some(Raised::Rough(Rough { turbulence: grain.turbulence()?, height: strength }))
        }
        Pattern::Facets { cells, seed } => Some(Raised::Facets(Facets {
            cells: *cells,
            tilt: Unit::saturating_from_num(strength),
            seed: *seed,
        })),
        Pattern::Image { picture, .. } => {
            Some(Raised::Relief(Relief { image: picture.image()?, height: strength }))
        }
        _ => None,
    })
}

/// The grain of a texture with a strength; none of one that has no direction.
pub(super) fn turned(pattern: &Pattern, strength: Real) -> Result<Option<Turned<'_>>, Error> {
    Ok(match (pattern, pattern.pigment()?) {
        (Pattern::Checker { .. }, Pigment::Checker(checker)) => Some(Turned::Threads(checker)),
        (Pattern::Mottle { grain, .. }, _) => {
            Some(Turned::Streaks(grain.turbulence()?, Unit::saturating_from_num(strength)))
        }
        (Pattern::Image { picture, .. }, _) => Some(Turned::Table(picture.image()?)),
        _ => None,
    })
}

/// A material with these textures to choose from.
pub(super) fn stuff<'a>(matter: &'a Matter, textures: &'a [Pattern]) -> Result<Stuff<'a>, Error> {
    let texture = |number: usize| textures.get(number);
    let pigment = match matter.pigment {
        Colored::Color(color) => Pigment::Plain(color),
        Colored::Texture(number) => {
            texture(number).map_or(Ok(Pigment::Plain(Rgb::WHITE)), Pattern::pigment)?
        }
    };
    let mixed = matter.mixture(pigment)?;
    let bump = match matter.bump {
        Some((number, strength)) => texture(number).map_or(Ok(None), |pattern| raised(pattern, strength))?,
        None => None,
    };
    let grain = match matter.frame {
        Some((number, strength)) => texture(number).map_or(Ok(None), |pattern| turned(pattern, strength))?,
        None => None,
    };
    Ok(match (bump, grain) {
        (None, None) => Stuff::Smooth(mixed),
        (Some(bump), None) => Stuff::Bumpy(Bumpy { material: mixed, bump }),
        (None, Some(grain)) => Stuff::Grained(Framed { material: mixed, grain }),
        (Some(bump), Some(grain)) => {
            Stuff::BumpyGrained(Bumpy { material: Framed { material: mixed, grain }, bump })
        }
    })
}
