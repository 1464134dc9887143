//! A model of highlights that is chosen at run time.

use super::anisotropic::Anisotropic;
use super::phong::Phong;
use super::specular::{Sight, Specular};
use super::tabulated::Tabulated;
use super::torrance_sparrow::TorranceSparrow;
use crate::num::{Lumen, Unit, Vec3};

/// Any of the models, for a choice at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Highlight<'a> {
    /// None.
    None,
    /// Phong's.
    Phong(Phong),
    /// Torrance's and Sparrow's.
    TorranceSparrow(TorranceSparrow),
    /// Ward's, along a grain.
    Anisotropic(Anisotropic),
    /// By a table of slopes.
    Tabulated(Tabulated<'a>),
}

impl Specular for Highlight<'_> {
    fn is_charted(&self) -> bool {
        matches!(self, Self::Anisotropic(_) | Self::Tabulated(_))
    }

    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen {
        match self {
            Self::None => Lumen::ZERO,
            Self::Phong(model) => model.part(view, towards),
            Self::TorranceSparrow(model) => model.part(view, towards),
            Self::Anisotropic(model) => model.part(view, towards),
            Self::Tabulated(model) => model.part(view, towards),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::specular::tests::views;
    use super::*;

    #[test]
    fn a_choice_of_models_is_what_each_of_them_is() {
        let phong = Phong { shininess: 9 };
        let rough = TorranceSparrow::new(Unit::from_num(0.3), Unit::from_num(0.5)).unwrap();
        let brushed = Anisotropic::new(Unit::from_num(0.1), Unit::from_num(0.4)).unwrap();
        let words = [1, 2, 256, 5, 3, 3, 5];
        let table = Tabulated::new(&words, Unit::from_num(0.75)).unwrap();
        let mut lit = 0;
        for (view, towards) in views().iter().take(50) {
            assert_eq!(Highlight::Tabulated(table).part(view, *towards), table.part(view, *towards));
            lit += u32::from(table.part(view, *towards) > Lumen::ZERO);
            assert_eq!(Highlight::Phong(phong).part(view, *towards), phong.part(view, *towards));
            assert_eq!(Highlight::TorranceSparrow(rough).part(view, *towards), rough.part(view, *towards));
            assert_eq!(Highlight::Anisotropic(brushed).part(view, *towards), brushed.part(view, *towards));
            assert_eq!(
                (Highlight::None.part(view, *towards), ().part(view, *towards)),
                (Lumen::ZERO, Lumen::ZERO)
            );
        }
        assert!(lit > 10 && Highlight::Tabulated(table).is_charted());
        assert!(Highlight::Anisotropic(brushed).is_charted() && !Highlight::Phong(phong).is_charted());
    }
}
