//! What gives light: a lamp that is infinitely far away, or one that stands at a place.

use crate::Error;
use crate::num::{Real, Rgb, Unit, Vec3, sqrt};

/// A source of light. Its colour may be brighter than white.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lamp {
    place: Place,
    light: Rgb,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Towards(Vec3<Unit>),
    At(Vec3),
}

/// Greatest parameter of a ray, 24 fractional bits.
pub(super) const FAR: i32 = i32::MAX - (1 << 10);

impl Lamp {
    /// A lamp infinitely far away in the direction `towards` (any length): the sun.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for the zero vector.
    pub fn distant(towards: Vec3, light: Rgb) -> Result<Self, Error> {
        let towards = towards.normalised().ok_or(Error::Degenerate { what: "direction of the light" })?;
        Ok(Self { place: Place::Towards(towards), light })
    }

    /// A lamp at a place, equally bright at any distance.
    pub const fn point(at: Vec3, light: Rgb) -> Self {
        Self { place: Place::At(at), light }
    }

    /// What it gives.
    pub(super) fn light(&self) -> Rgb {
        self.light
    }

    /// The unit vector to the lamp from a place, and how far it is, 24 fractional bits; none at the lamp.
    pub(super) fn seen_from(&self, place: Vec3) -> Option<(Vec3<Unit>, i32)> {
        match self.place {
            Place::Towards(towards) => Some((towards, FAR)),
            Place::At(at) => {
                let towards = place.towards(at)?;
                let square = |a: Real, b: Real| {
                    let d = (i64::from(b.to_bits()) - i64::from(a.to_bits())).unsigned_abs();
                    // 33 bits: a square of 66 is cut off at what three of them may sum up to
                    d.min(1 << 31).pow(2) / 4
                };
                let sum = square(place.x, at.x) + square(place.y, at.y) + square(place.z, at.z);
                let distance = i32::try_from(u64::from(sqrt(sum)) * 2).unwrap_or(FAR).min(FAR);
                Some((towards, distance))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lamp_is_seen_where_it_stands() {
        let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        let lamp = Lamp::point(at(3, 4, 0), Rgb::WHITE);
        let (towards, distance) = lamp.seen_from(at(0, 0, 0)).unwrap();
        assert!((towards.x.to_num::<f64>() - 0.6).abs() < 1e-8 && towards.z == 0);
        assert!((distance - (5 << 24)).abs() <= 2, "{distance}");
        assert_eq!(lamp.seen_from(at(3, 4, 0)), None);
        let far = Lamp::point(at(-128, -128, -128), Rgb::WHITE);
        assert_eq!(far.seen_from(at(127, 127, 127)).unwrap().1, FAR);
        assert!(Lamp::distant(at(0, 0, 0), Rgb::WHITE).is_err());
        let sun = Lamp::distant(at(0, 0, 7), Rgb::WHITE).unwrap();
        let (towards, distance) = sun.seen_from(at(1, 2, 3)).unwrap();
        assert!((Unit::ONE - towards.z).to_bits() <= 2 && distance == FAR);
        assert_eq!(sun.light(), Rgb::WHITE);
    }
}
