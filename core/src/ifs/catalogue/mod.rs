//! The classical attractors: names, maps, probabilities and where they come from.
//!
//! Coefficients stand in the order `[a, b, c, d, e, f]` of the tables, rounded once to the formats of
//! [`Affine`](super::Affine) (`2^-31` and `2^-25`). An [`Attractor`] is plain data with public fields: one of
//! your own needs nothing from this file.

mod attractor;
mod carpets;
mod curves;
mod plants;
mod tables;

pub use attractor::Attractor;
pub use carpets::{CANTOR_DUST, SIERPINSKI_CARPET, SIERPINSKI_GASKET, VICSEK_BOX};
pub use curves::{HEIGHWAY_DRAGON, KOCH_CURVE, LEVY_C_CURVE, PENTIGREE, TERDRAGON, TWINDRAGON};
pub use plants::{BARNSLEY_FERN, CULCITA_FERN, CYCLOSORUS_FERN, FRACTAL_TREE, MAPLE_LEAF};
pub use tables::{CORAL, CRYSTAL, DRAGON, SPIRAL};

/// All of them.
pub const ALL: &[&Attractor] = &[
    &BARNSLEY_FERN,
    &CANTOR_DUST,
    &CORAL,
    &CRYSTAL,
    &CULCITA_FERN,
    &CYCLOSORUS_FERN,
    &DRAGON,
    &FRACTAL_TREE,
    &HEIGHWAY_DRAGON,
    &KOCH_CURVE,
    &LEVY_C_CURVE,
    &MAPLE_LEAF,
    &PENTIGREE,
    &SIERPINSKI_CARPET,
    &SIERPINSKI_GASKET,
    &SPIRAL,
    &TERDRAGON,
    &TWINDRAGON,
    &VICSEK_BOX,
];

/// The largest number of maps of one of them.
pub const LARGEST: usize = 8;

/// The one with this name.
pub fn find(name: &str) -> Option<&'static Attractor> {
    ALL.iter().copied().find(|attractor| attractor.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::affine::Affine;
    use crate::num::Unit;

    #[test]
    fn every_attractor_has_a_name_a_source_and_makes_a_system() {
        for (i, attractor) in ALL.iter().enumerate() {
            assert!(attractor.ifs::<LARGEST>().is_ok(), "{}", attractor.name);
            assert!(attractor.title.len() > 3 && attractor.source.len() > 20, "{}", attractor.name);
            assert_eq!(find(attractor.name), Some(*attractor));
            let well_formed = |c: char| c.is_ascii_lowercase() || c == '-';
            assert!(attractor.name.chars().all(well_formed));
            if let Some(next) = ALL.get(i + 1) {
                assert!(attractor.name < next.name, "{} out of order", next.name);
            }
        }
        assert!(ALL.len() >= 12);
        assert_eq!(ALL.iter().map(|a| a.maps.len()).max(), Some(LARGEST));
        assert_eq!(find("nothing"), None);
    }

    #[test]
    fn the_pieces_of_a_curve_join_end_to_end() {
        use crate::num::Real;
        use crate::plane::Point2;
        let (start, end) = (Point2::default(), Point2::new(Real::ONE, Real::ZERO));
        for curve in [&KOCH_CURVE, &LEVY_C_CURVE, &PENTIGREE, &TERDRAGON] {
            let mut pen = start;
            for map in curve.maps {
                let from = map.apply(start);
                assert!(from.x.abs_diff(pen.x) < 1e-6 && from.y.abs_diff(pen.y) < 1e-6, "{}", curve.name);
                pen = map.apply(end);
            }
            assert!(pen.x.abs_diff(end.x) < 1e-6 && pen.y.abs() < 1e-6, "{}", curve.name);
        }
    }

    #[test]
    fn areas_are_those_of_the_similarity_ratios() {
        // sum of |det| = sum of s^2: 1 for tiles, below for carpets, dusts and thin curves
        for (attractor, sum) in [
            (&SIERPINSKI_GASKET, 0.75),
            (&SIERPINSKI_CARPET, 8.0 / 9.0),
            (&VICSEK_BOX, 5.0 / 9.0),
            (&CANTOR_DUST, 4.0 / 9.0),
            (&KOCH_CURVE, 4.0 / 9.0),
            (&HEIGHWAY_DRAGON, 1.0),
            (&LEVY_C_CURVE, 1.0),
            (&TWINDRAGON, 1.0),
            (&TERDRAGON, 1.0),
            (&PENTIGREE, 6.0 * 0.381_966_011_250_105_f64.powi(2)),
            (&BARNSLEY_FERN, 0.7241 + 0.1038 + 0.1088),
        ] {
            let total: f64 = attractor.maps.iter().map(|m| m.determinant().abs().to_num::<f64>()).sum();
            assert!((total - sum).abs() < 1e-7, "{}: {total} against {sum}", attractor.name);
        }
    }

    #[test]
    fn an_attractor_of_your_own_is_plain_data() {
        const SEGMENT: Attractor = Attractor {
            name: "segment",
            title: "A line segment",
            source: "two halves of itself",
            maps: &[
                Affine::from_thousandths([500, 0, 0, 0, 0, 0]),
                Affine::from_thousandths([500, 0, 0, 0, 500, 0]),
            ],
            probabilities: &[Unit::lit("0.5"), Unit::lit("0.5")],
        };
        let bounds = SEGMENT.ifs::<2>().unwrap().bounds();
        assert!(bounds.max.x >= 1.0 && bounds.max.x < 1.000_001 && bounds.max.y < 1e-6, "{bounds:?}");
    }
}
