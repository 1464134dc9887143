//! An enum of surfaces that is a surface, of textures that is a texture, of materials that is a material: a
//! world of things of several kinds, with the code of those kinds alone.
//!
//! ```
//! use attractor::num::{Lumen, Rgb};
//! use attractor::textures;
//! use attractor::trace::SurfacePoint;
//! use attractor::trace::texture::Texture;
//!
//! /// Red where it is high, black where it is low.
//! #[derive(Debug, Clone, Copy)]
//! pub struct Tide;
//!
//! impl Texture for Tide {
//!     fn at(&self, point: &SurfacePoint) -> Rgb {
//!         Rgb::new(if point.place.z > 0 { Lumen::ONE } else { Lumen::ZERO }, Lumen::ZERO, Lumen::ZERO)
//!     }
//! }
//!
//! textures! {
//!     /// What colours the things of this world.
//!     #[derive(Debug, Clone, Copy)]
//!     pub enum Pigment {
//!         /// The same everywhere.
//!         Plain(Rgb),
//!         /// High or low.
//!         Tide(Tide),
//!     }
//! }
//!
//! assert!(!Pigment::Tide(Tide).is_charted());
//! ```

/// An enum of surfaces, which is a [`Surface`](crate::trace::Surface).
#[macro_export]
macro_rules! surfaces {
    (
        $(#[$attribute:meta])*
        $visibility:vis enum $name:ident $(<$life:lifetime>)? {
            $($(#[$note:meta])* $variant:ident($kind:ty)),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        $visibility enum $name $(<$life>)? {
            $($(#[$note])* $variant($kind)),+
        }

        impl $(<$life>)? $crate::trace::Surface for $name $(<$life>)? {
            fn extent(&self) -> $crate::trace::Extent {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::extent(one)),+
                }
            }

            fn ball(&self) -> $crate::trace::Ball {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::ball(one)),+
                }
            }

            fn is_closed(&self) -> bool {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::is_closed(one)),+
                }
            }

            fn most_crossings(&self) -> u32 {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::most_crossings(one)),+
                }
            }

            fn faces(&self) -> u8 {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::faces(one)),+
                }
            }

            fn error(&self) -> $crate::num::Real {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::error(one)),+
                }
            }

            fn cross(
                &self,
                ray: &$crate::trace::Ray,
                cone: $crate::num::Unit,
                found: &mut impl ::core::ops::FnMut($crate::trace::Crossing) -> ::core::ops::ControlFlow<()>,
            ) {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::cross(one, ray, cone, found)),+
                }
            }

            fn value(&self, place: $crate::num::Vec3) -> $crate::num::Wide {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::value(one, place)),+
                }
            }

            fn is_clear_of(&self, place: $crate::num::Vec3) -> bool {
                match self {
                    $(Self::$variant(one) => $crate::trace::Surface::is_clear_of(one, place)),+
                }
            }

            fn point(
                &self,
                ray: &$crate::trace::Ray,
                cone: $crate::num::Unit,
                crossing: &$crate::trace::Crossing,
                charted: bool,
            ) -> $crate::trace::SurfacePoint {
                match self {
                    $(Self::$variant(one) => {
                        $crate::trace::Surface::point(one, ray, cone, crossing, charted)
                    }),+
                }
            }
        }
    };
}

/// An enum of textures, which is a [`Texture`](crate::trace::texture::Texture).
#[macro_export]
macro_rules! textures {
    (
        $(#[$attribute:meta])*
        $visibility:vis enum $name:ident $(<$life:lifetime>)? {
            $($(#[$note:meta])* $variant:ident($kind:ty)),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        $visibility enum $name $(<$life>)? {
            $($(#[$note])* $variant($kind)),+
        }

        impl $(<$life>)? $crate::trace::texture::Texture for $name $(<$life>)? {
            fn is_charted(&self) -> bool {
                match self {
                    $(Self::$variant(one) => $crate::trace::texture::Texture::is_charted(one)),+
                }
            }

            fn at(&self, point: &$crate::trace::SurfacePoint) -> $crate::num::Rgb {
                match self {
                    $(Self::$variant(one) => $crate::trace::texture::Texture::at(one, point)),+
                }
            }
        }
    };
}

/// An enum of materials, which is a [`Material`](crate::trace::material::Material).
#[macro_export]
macro_rules! materials {
    (
        $(#[$attribute:meta])*
        $visibility:vis enum $name:ident $(<$life:lifetime>)? {
            $($(#[$note:meta])* $variant:ident($kind:ty)),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        $visibility enum $name $(<$life>)? {
            $($(#[$note])* $variant($kind)),+
        }

        impl $(<$life>)? $crate::trace::material::Material for $name $(<$life>)? {
            const MAY_BE_CLEAR: bool =
                $(<$kind as $crate::trace::material::Material>::MAY_BE_CLEAR)||+;

            fn is_charted(&self) -> bool {
                match self {
                    $(Self::$variant(one) => $crate::trace::material::Material::is_charted(one)),+
                }
            }

            fn medium(&self) -> ::core::option::Option<$crate::trace::material::Medium> {
                match self {
                    $(Self::$variant(one) => $crate::trace::material::Material::medium(one)),+
                }
            }

            fn passes(&self) -> $crate::num::Rgb {
                match self {
                    $(Self::$variant(one) => $crate::trace::material::Material::passes(one)),+
                }
            }

            fn normal(
                &self,
                point: &$crate::trace::SurfacePoint,
            ) -> $crate::num::Vec3<$crate::num::Unit> {
                match self {
                    $(Self::$variant(one) => $crate::trace::material::Material::normal(one, point)),+
                }
            }

            fn respond(
                &self,
                point: &$crate::trace::SurfacePoint,
                view: $crate::num::Vec3<$crate::num::Unit>,
                lights: impl ::core::iter::Iterator<Item = $crate::trace::material::Lit>,
            ) -> $crate::trace::material::Response {
                match self {
                    $(Self::$variant(one) => {
                        $crate::trace::material::Material::respond(one, point, view, lights)
                    }),+
                }
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use crate::num::{Lumen, Real, Rgb, Unit, Vec3};
    use crate::trace::material::{Clear, Lit, Material, Mixture, Phong};
    use crate::trace::texture::Texture;
    use crate::trace::{Chart, SurfacePoint};

    /// Where it is, as a colour.
    #[derive(Debug, Clone, Copy)]
    struct Position;

    impl Texture for Position {
        fn is_charted(&self) -> bool {
            true
        }

        fn at(&self, point: &SurfacePoint) -> Rgb {
            Rgb::grey(Lumen::from_bits(point.place.x.to_bits().unsigned_abs() >> 8))
        }
    }

    textures! {
        #[derive(Debug, Clone, Copy)]
        enum Pigment {
            Plain(Rgb),
            Position(Position),
        }
    }

    materials! {
        #[derive(Debug, Clone, Copy)]
        enum Stuff {
            Chalk(Mixture<Pigment>),
            Plastic(Mixture<Pigment, Phong>),
            Glass(Mixture<Rgb, (), Clear>),
        }
    }

    /// Every function of a choice is that of what was chosen.
    #[test]
    fn a_choice_answers_as_what_was_chosen() {
        let point = SurfacePoint {
            position: Vec3::lit("1", "2", "3"),
            place: Vec3::lit("0.5", "0", "0"),
            normal: Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE),
            inward: false,
            chart: Chart::default(),
            face: 0,
            width: Real::ZERO,
        };
        let view = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        let lights = || [Lit { towards: point.normal, light: Rgb::WHITE }].into_iter();
        let chalk = Mixture::matt(Pigment::Position(Position));
        let plastic =
            Mixture::matt(Pigment::Plain(Rgb::WHITE)).with_highlight(Rgb::WHITE, Phong { shininess: 9 });
        let glass = Mixture::glass(Real::lit("1.5")).unwrap();
        let all = [Stuff::Chalk(chalk), Stuff::Plastic(plastic), Stuff::Glass(glass)];
        assert_eq!(all.map(|one| one.is_charted()), [true, false, false]);
        assert_eq!(all.map(|one| one.medium()), [None, None, glass.medium()]);
        assert_eq!(all.map(|one| one.passes()), [Rgb::BLACK, Rgb::BLACK, Rgb::WHITE]);
        assert_eq!(all.map(|one| one.normal(&point)), [point.normal; 3]);
        let answers = all.map(|one| one.respond(&point, view, lights()));
        let single = [
            chalk.respond(&point, view, lights()),
            plastic.respond(&point, view, lights()),
            glass.respond(&point, view, lights()),
        ];
        assert_eq!(answers, single);
        assert!(single[0].light != single[1].light && single[1] != single[2]);
        assert_eq!(Pigment::Position(Position).at(&point), Rgb::grey(Lumen::from_bits(1 << 15)));
    }
}
