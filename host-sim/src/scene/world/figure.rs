//! The shapes of a world: numbers as the file has them, and core's surfaces that are made of them.

use attractor::num::{Affine3, Vec3};
use attractor::surfaces;
use attractor::trace::solid::{Placed, Plane, Sphere};

use super::object::{Form, Thing};
use super::placement::Step;
use crate::fail::Fail;
use crate::source::Source;

surfaces! {
    /// A surface of any kind that a file can name.
    #[derive(Debug, Clone, Copy)]
    pub(crate) enum Solid {
        Plane(Placed<Plane>),
        Sphere(Placed<Sphere>),
    }
}

/// A shape in its own coordinates.
#[derive(Debug)]
pub(crate) enum Figure {
    Plane,
    Sphere,
}

impl Figure {
    /// The shape of a table that is no compound.
    pub(super) fn load(source: &Source, thing: &Thing, prefix: &str) -> Result<Self, Fail> {
        let key = |name: &str| format!("{prefix}{name}");
        match thing.shape.get_ref() {
            Form::Plane => Ok(Self::Plane),
            Form::Sphere => Ok(Self::Sphere),
            _ => Err(source.fail(thing.shape.span(), &key("shape"), "not yet")),
        }
    }

    /// The shape where these steps put it.
    pub(crate) fn placed(&self, steps: &[Step]) -> Result<Solid, attractor::Error> {
        let map = map(steps)?;
        Ok(match self {
            Self::Plane => Solid::Plane(Placed::new(Plane, &map)?),
            Self::Sphere => Solid::Sphere(Placed::new(Sphere, &map)?),
        })
    }
}

/// The map of steps, the first one first.
fn map(steps: &[Step]) -> Result<Affine3, attractor::Error> {
    let mut map = Affine3::IDENTITY;
    for step in steps {
        map = map.then(&match *step {
            Step::Scale(factors) => Affine3::scale(factors),
            Step::Rotate { axis, angle } => Affine3::rotate(axis, angle)?,
            Step::Translate(by) => Affine3::translate(by),
            Step::Matrix(rows) => {
                let row = |k: usize| Vec3::new(rows[k][0], rows[k][1], rows[k][2]);
                Affine3::matrix([row(0), row(1), row(2)], Vec3::new(rows[0][3], rows[1][3], rows[2][3]))
            }
        });
    }
    Ok(map)
}
