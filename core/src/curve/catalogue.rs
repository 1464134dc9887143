//! The classical curves: names, turtle words and where they come from.
//!
//! A [`Curve`] is plain data with public fields: one of your own needs nothing from this file.

use super::generator::Generator;
use super::turtle::turn_over;
use crate::Error;
use crate::num::{Angle, Unit};

/// A named generator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Curve {
    /// Lower case, words joined by hyphens: what [`find`] looks for.
    pub name: &'static str,
    /// What it is called in print.
    pub title: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// One refinement as a turtle word ([`Generator::turtle`]).
    pub word: &'static str,
    /// By which the turtle turns.
    pub angle: Angle,
    /// For curves through the middles of their tiles ([`Generator::through`]).
    pub marker: Option<[Unit; 2]>,
    /// Whether its picture is drawn on a triangle ([`super::koch::triangle`]) instead of a segment.
    pub closed: bool,
}

impl Curve {
    /// Its generator; `S` is [`LARGEST`] for those of the catalogue whose number of segments is not known
    /// beforehand.
    ///
    /// # Errors
    /// As [`Generator::turtle`] and [`Generator::through`]; for those of the catalogue only
    /// [`Error::Capacity`].
    pub fn generator<const S: usize>(&self) -> Result<Generator<S>, Error> {
        let generator = Generator::turtle(self.word, self.angle)?;
        match self.marker {
            Some(marker) => generator.through(marker),
            None => Ok(generator),
        }
    }

    const fn on_a_segment(
        name: &'static str,
        title: &'static str,
        word: &'static str,
        turn: u32,
        source: &'static str,
    ) -> Self {
        Self { name, title, source, word, angle: turn_over(turn), marker: None, closed: false }
    }
}

const HALF: Unit = Unit::from_bits(1 << 29);
const KOCH_SOURCE: &str = "H. von Koch, Sur une courbe continue sans tangente, 1904";
const DRAGON_SOURCE: &str = "C. Davis and D. E. Knuth, Number representations and dragon curves, 1970";

/// Gosper's flowsnake: seven segments of length `1/sqrt(7)`.
pub const GOSPER: Curve = Curve::on_a_segment(
    "gosper",
    "Gosper's flowsnake",
    "F-B--B+F++FF+B-",
    6,
    "M. Gardner, Mathematical Games, Scientific American, December 1976",
);

/// Heighway's dragon.
pub const HEIGHWAY_DRAGON: Curve =
    Curve::on_a_segment("heighway-dragon", "Heighway dragon", "F-B", 4, DRAGON_SOURCE);

/// Hilbert's curve through the middles of the squares of a board of `2^n x 2^n`; its base is the lower side.
pub const HILBERT: Curve = Curve {
    marker: Some([HALF, HALF]),
    ..Curve::on_a_segment(
        "hilbert",
        "Hilbert curve",
        "a-FF-a",
        4,
        "D. Hilbert, Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck, 1891",
    )
};

/// The Koch curve: turns of 60, -120 and 60 degrees.
pub const KOCH: Curve = Curve::on_a_segment("koch", "Koch curve", "F+F--F+F", 6, KOCH_SOURCE);

/// The Koch snowflake, on a triangle.
pub const KOCH_SNOWFLAKE: Curve = Curve {
    closed: true,
    ..Curve::on_a_segment("koch-snowflake", "Koch snowflake", "F+F--F+F", 6, KOCH_SOURCE)
};

/// Levy's C curve.
pub const LEVY_C: Curve = Curve::on_a_segment(
    "levy-c",
    "Levy C curve",
    "F-F",
    4,
    "P. Levy, Les courbes planes ou gauches et les surfaces composees de parties semblables au tout, 1938",
);

/// The quadric Koch curve, Minkowski's sausage: eight segments of length `1/4`.
pub const MINKOWSKI: Curve = Curve::on_a_segment(
    "minkowski",
    "Minkowski sausage",
    "F+F-F-FF+F+F-F",
    4,
    "B. B. Mandelbrot, The Fractal Geometry of Nature, 1982, plate 49: quadric Koch curve",
);

/// Peano's curve through the middles of the squares of a board of `3^n x 3^n`; its base is a diagonal.
pub const PEANO: Curve = Curve {
    marker: Some([HALF, Unit::ZERO]),
    ..Curve::on_a_segment(
        "peano",
        "Peano curve",
        "F+a-F-a-F+a+F+a-F",
        4,
        "G. Peano, Sur une courbe qui remplit toute une aire plane, 1890",
    )
};

/// McWorter's pentigree: six segments of length `(3 - sqrt(5)) / 2`.
pub const PENTIGREE: Curve = Curve::on_a_segment(
    "pentigree",
    "McWorter's pentigree",
    "F++F----F--F++F++F",
    10,
    "W. A. McWorter, Byte, 1987; construction in L. Riddle, Classic Iterated Function Systems",
);

/// Sierpinski's gasket as a curve.
pub const SIERPINSKI_ARROWHEAD: Curve = Curve::on_a_segment(
    "sierpinski-arrowhead",
    "Sierpinski arrowhead",
    "a-F-a",
    6,
    "W. Sierpinski, Sur une courbe dont tout point est un point de ramification, 1915",
);

/// The terdragon: three segments of length `1/sqrt(3)`.
pub const TERDRAGON: Curve = Curve::on_a_segment("terdragon", "Terdragon", "F+F-F", 3, DRAGON_SOURCE);

/// All of them.
pub const ALL: &[&Curve] = &[
    &GOSPER,
    &HEIGHWAY_DRAGON,
    &HILBERT,
    &KOCH,
    &KOCH_SNOWFLAKE,
    &LEVY_C,
    &MINKOWSKI,
    &PEANO,
    &PENTIGREE,
    &SIERPINSKI_ARROWHEAD,
    &TERDRAGON,
];

/// The largest number of segments of one of them.
pub const LARGEST: usize = 9;

/// The one with this name.
pub fn find(name: &str) -> Option<&'static Curve> {
    ALL.iter().copied().find(|curve| curve.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_has_a_name_a_source_and_makes_a_generator() {
        for (i, curve) in ALL.iter().enumerate() {
            assert!(curve.generator::<LARGEST>().is_ok(), "{}", curve.name);
            assert!(curve.title.len() > 3 && curve.source.len() > 20, "{}", curve.name);
            assert_eq!(find(curve.name), Some(*curve));
            if let Some(next) = ALL.get(i + 1) {
                assert!(curve.name < next.name, "{} out of order", next.name);
            }
        }
        assert_eq!(find("nothing"), None);
    }

    #[test]
    fn segments_have_the_lengths_of_the_text() {
        let fifth = (3.0 - 5.0_f64.sqrt()) / 2.0;
        for (curve, len, ratio) in [
            (&GOSPER, 7, 7.0_f64.sqrt().recip()),
            (&HEIGHWAY_DRAGON, 2, 0.5_f64.sqrt()),
            (&HILBERT, 4, 0.5),
            (&KOCH, 4, 1.0 / 3.0),
            (&KOCH_SNOWFLAKE, 4, 1.0 / 3.0),
            (&LEVY_C, 2, 0.5_f64.sqrt()),
            (&MINKOWSKI, 8, 0.25),
            (&PEANO, 9, 1.0 / 3.0),
            (&PENTIGREE, 6, fifth),
            (&SIERPINSKI_ARROWHEAD, 3, 0.5),
            (&TERDRAGON, 3, 3.0_f64.sqrt().recip()),
        ] {
            let generator = curve.generator::<LARGEST>().unwrap();
            assert_eq!(generator.len(), len, "{}", curve.name);
            for got in generator.ratios() {
                let got = f64::from(got) / f64::from(1 << 30);
                assert!((got - ratio).abs() < 2e-8, "{}: {got} against {ratio}", curve.name);
            }
        }
    }
}
