//! The ground of a landscape: sand on the shore, grass, rock where it is steep, snow where it is high.
//!
//! With the height `z`, raised by turbulence so that no line is a level curve, and the steepness, the
//! vertical part `n_z` of the unit normal: sand passes into grass where `z` passes the shore, grass into snow
//! where it passes the snow line, and either into rock where `n_z` falls below a limit. Each passage is
//! linear and as wide as is asked.
//!
//! Source: F. K. Musgrave, in D. S. Ebert et al., "Texturing and Modeling", 1994, chapter 16 (ecosystems by
//! altitude and slope).
//!
//! Formats: heights 24 fractional bits, parts 30.

use super::super::surface::SurfacePoint;
use super::field::Texture;
use super::turbulence::Turbulence;
use crate::num::{Real, Rgb, Unit, product, quotient};

/// What grows and lies where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Landscape {
    /// Below the shore.
    pub sand: Rgb,
    /// Above it.
    pub grass: Rgb,
    /// Where it is steep.
    pub rock: Rgb,
    /// Where it is high.
    pub snow: Rgb,
    /// The height of the shore.
    pub shore: Real,
    /// The height from which snow lies.
    pub snow_line: Real,
    /// The vertical part of the normal below which there is rock.
    pub steep: Unit,
    /// How wide passages are: of heights, and, the same number, of the normal's vertical part.
    pub passage: Unit,
    /// What makes lines ragged, and how much.
    pub ragged: (Turbulence, Unit),
}

/// How much of a passage of this width lies behind, all as bits of the same format.
fn behind(way: i64, width: Unit, places: u32) -> Unit {
    // a passage of no width is a step
    let width = u64::from(width.max(Unit::DELTA).to_bits().unsigned_abs());
    // most places are in no passage: off a line by more than half its width
    if (way.unsigned_abs() << (places + 1)) >= width {
        return if way < 0 { Unit::ZERO } else { Unit::ONE };
    }
    // way 2^places has 30 fractional bits: the quotient's half is the middle
    let part = quotient(way, places + 30, width).saturating_add(1 << 29);
    Unit::from_bits(part.clamp(0, 1 << 30) as i32)
}

impl Texture for Landscape {
    /// Error: below `2^-15` of light where passages are wider than 1/64
    /// (`ground_passes_from_sand_to_snow_and_to_rock`).
    fn at(&self, point: &SurfacePoint) -> Rgb {
        let (turbulence, amount) = &self.ragged;
        // 24 fractional bits
        let ragged = product(turbulence.at(point.place).to_bits(), amount.to_bits()) >> 36;
        let height = i64::from(point.place.z.to_bits()) + ragged;
        let above = |line: Real| behind(height - i64::from(line.to_bits()), self.passage, 6);
        let flat = self.sand.mixed(self.grass, above(self.shore)).mixed(self.snow, above(self.snow_line));
        let upright = point.normal.z.saturating_abs().to_bits();
        let level = behind(i64::from(upright) - i64::from(self.steep.to_bits()), self.passage, 0);
        self.rock.mixed(flat, level)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::noise::Noise;
    use super::*;
    use crate::num::{Lumen, Vec3};
    use crate::trace::Chart;

    fn point(z: f64, upright: f64) -> SurfacePoint {
        let across = (1.0 - upright * upright).max(0.0).sqrt();
        let place = Vec3::new(Real::from_num(0.3), Real::from_num(-0.7), Real::from_num(z));
        let normal = Vec3::new(Unit::from_num(across), Unit::ZERO, Unit::from_num(upright));
        let (chart, width) = (Chart::default(), Real::ZERO);
        SurfacePoint { position: place, place, normal, inward: false, chart, face: 0, width }
    }

    /// Against the formula in f64, over heights and slopes, with and without raggedness.
    #[test]
    fn ground_passes_from_sand_to_snow_and_to_rock() {
        let grey = |part: f64| Rgb::grey(Lumen::from_num(part));
        let turbulence = Turbulence::new(Noise::new(3), Real::from_num(4), 3).unwrap();
        let (mut worst, mut between) = (0.0_f64, 0);
        for ragged in [0.0, 0.25] {
            let ground = Landscape {
                sand: grey(0.8),
                grass: grey(0.3),
                rock: grey(0.1),
                snow: grey(1.0),
                shore: Real::from_num(0.125),
                snow_line: Real::from_num(0.75),
                steep: Unit::from_num(0.75),
                passage: Unit::from_num(0.25),
                ragged: (turbulence, Unit::from_num(ragged)),
            };
            for k in 0..60 {
                for upright in [0.0, 0.5, 0.7, 0.75, 0.8, 0.9, 1.0] {
                    let point = point(f64::from(k) / 40.0 - 0.25, upright);
                    let z =
                        point.place.z.to_num::<f64>() + ragged * turbulence.at(point.place).to_num::<f64>();
                    let part = |way: f64| (way / 0.25 + 0.5).clamp(0.0, 1.0);
                    let mixed = |a: f64, b: f64, part: f64| a + (b - a) * part;
                    let flat = mixed(mixed(0.8, 0.3, part(z - 0.125)), 1.0, part(z - 0.75));
                    let exact = mixed(0.1, flat, part(point.normal.z.to_num::<f64>() - 0.75));
                    let got = ground.at(&point).r.to_num::<f64>();
                    worst = worst.max((got - exact).abs());
                    between += u32::from((0.11..0.29).contains(&got) || (0.31..0.79).contains(&got));
                }
            }
        }
        std::println!("{worst:e} {between}");
        assert!(
            worst < 2.0_f64.powi(-14) && worst > 2.0_f64.powi(-18) && between > 200,
            "{worst:e} {between}"
        );
        // no passage: a step
        let step = behind(1, Unit::ZERO, 6);
        assert_eq!(
            [step, behind(-1, Unit::ZERO, 6), behind(0, Unit::ONE, 6)],
            [Unit::ONE, Unit::ZERO, Unit::ONE / 2]
        );
    }
}
