//! An iterated function system: at most `N` contractions and the probability of each. Everything else in this
//! room starts from one.
//!
//! Its constructor checks all there is to check, so that nothing that is computed from a system can wrap: it
//! proves an invariant [`Disc`] with `|x|, |y| <= 64`, for the maps as they are computed, rounding included;
//! each chaos game starts in it, and so never leaves it. The coefficients of a contraction are below 1, the
//! translations below 128; so the 64-bit accumulator of a map stays below `2^60 + 2^60 + 2^61 + 2^29 < 2^63`,
//! and the result in the disc.
//!
//! Source: J. E. Hutchinson, "Fractals and self similarity", 1981; M. F. Barnsley, "Fractals Everywhere",
//! 1988, sections 3.7 and 3.8 (probabilities in proportion to the determinants). Left out: systems that
//! contract on average only.

use super::affine::Affine;
use super::disc::{Contractions, Disc};
#[cfg(not(no_carry))]
use super::prepared::PreparedMap;
use crate::Error;
use crate::num::{Alias, Unit, Wide};
use crate::plane::Point2;

/// The largest number of maps in a system.
pub const MAX_MAPS: usize = 256;

/// How far the sum of the probabilities may be from 1, for each of them: `10^-6` in units of `2^-30`.
const TOLERANCE: i64 = 1074;

/// An iterated function system of at most `N <= 256` maps. Size on a 32-bit machine: 65 bytes a map, and 36;
/// 73 a map on a machine without a long product, 33 on one without a carry.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::IfsNumbers<N>", into = "crate::serial::IfsNumbers<N>")
)]
pub struct Ifs<const N: usize> {
    maps: [Affine; N],
    #[cfg(not(no_carry))]
    prepared: [PreparedMap; N],
    len: usize,
    choice: Alias<N>,
    probabilities: [Unit; N],
    contraction_factor: Unit,
    disc: Disc,
    start: Point2,
    warm_up: u32,
}

impl<const N: usize> Ifs<N> {
    /// The system of these maps, each chosen with its probability.
    ///
    /// Cost: 35 square roots and up to 33 divisions for each map, and a few thousand instructions more: 161
    /// thousand Cortex-M4 instructions (kernel `ifs`) for the fern.
    ///
    /// # Errors
    /// [`Error::TooFew`] without maps, [`Error::Capacity`] for more than `N` or 256,
    /// [`Error::LengthMismatch`] unless there is one probability for each map, [`Error::NotContractive`] with
    /// the first map that is no contraction, [`Error::OutOfRange`] for a probability of 0, which would leave
    /// a part of the attractor out, or a negative one, or when a fixed point or the invariant disc leaves
    /// `-64 .. 64`, [`Error::Probabilities`] when they do not add up to 1 within `10^-6` each.
    pub fn new(maps: &[Affine], probabilities: &[Unit]) -> Result<Self, Error> {
        Self::check_count(maps)?;
        if probabilities.len() != maps.len() {
            return Err(Error::LengthMismatch {
                what: "probabilities",
                given: probabilities.len(),
                expected: maps.len(),
            });
        }
        if let Some((index, value)) = probabilities.iter().enumerate().find(|(_, p)| **p <= Unit::ZERO) {
            let value = Wide::from(*value);
            return Err(Error::OutOfRange {
                what: "probability",
                index: Some(index),
                value,
                min: Wide::from(Unit::DELTA),
                max: Wide::ONE,
            });
        }
        let sum: i64 = probabilities.iter().map(|p| i64::from(p.to_bits())).sum();
        if (sum - (1 << 30)).abs() > TOLERANCE * maps.len() as i64 {
            // at most 256 numbers below 2: 512 fits
            return Err(Error::Probabilities { sum: Wide::from_bits(sum << 18) });
        }
        Self::build(maps, probabilities)
    }

    /// The system of these maps, chosen in proportion to the areas of their images, `|a d - b c|`: the points
    /// are then spread evenly where the images do not overlap. A map that flattens gets a thirty-second of
    /// the average all the same, so that no part of the attractor is missed.
    ///
    /// # Errors
    /// As [`Ifs::new`].
    pub fn proportional_to_determinant(maps: &[Affine]) -> Result<Self, Error> {
        Self::check_count(maps)?;
        if let Some(map) = maps.iter().position(|m| !m.is_contraction()) {
            return Err(Error::NotContractive { map });
        }
        // 32 fractional bits, below 1; the sum below 2^40
        let area = |map: &Affine| map.area() >> 28;
        let total: u64 = maps.iter().map(area).sum();
        let floor = total.checked_div(32 * maps.len() as u64).unwrap_or(0).max(1);
        let total: u64 = maps.iter().map(|m| area(m).max(floor)).sum();
        let mut probabilities = [Unit::ZERO; N];
        for (probability, map) in probabilities.iter_mut().zip(maps) {
            let share = (area(map).max(floor) << 30).checked_div(total).unwrap_or(0);
            *probability = Unit::from_bits(share as i32);
        }
        Self::build(maps, probabilities.get(..maps.len()).unwrap_or_default())
    }

    fn check_count(maps: &[Affine]) -> Result<(), Error> {
        let capacity = N.min(MAX_MAPS);
        match maps.len() {
            0 => Err(Error::TooFew { what: "maps", given: 0, at_least: 1 }),
            needed if needed > capacity => Err(Error::Capacity { what: "maps", needed, capacity }),
            _ => Ok(()),
        }
    }

    /// With as many probabilities as maps, at most `N`, all positive.
    fn build(given: &[Affine], shares: &[Unit]) -> Result<Self, Error> {
        let mut maps = [Affine::default(); N];
        let mut probabilities = [Unit::ZERO; N];
        let mut factors = [Unit::ZERO; N];
        let mut weights = [0_u32; N];
        for (index, (map, share)) in given.iter().zip(shares).enumerate() {
            if !map.is_contraction() {
                return Err(Error::NotContractive { map: index });
            }
            if let (Some(m), Some(p), Some(f), Some(w)) = (
                maps.get_mut(index),
                probabilities.get_mut(index),
                factors.get_mut(index),
                weights.get_mut(index),
            ) {
                (*m, *p, *f, *w) = (*map, *share, map.contraction_factor(), share.to_bits().unsigned_abs());
            }
        }
        let len = given.len();
        let disc = Contractions { maps: given, factors: &factors }.invariant_disc()?;
        let contraction_factor = factors.iter().copied().max().unwrap_or(Unit::ONE);
        Ok(Self {
            maps,
            #[cfg(not(no_carry))]
            prepared: maps.each_ref().map(PreparedMap::new),
            len,
            choice: Alias::new(weights.get(..len).unwrap_or_default())?,
            probabilities,
            contraction_factor,
            disc,
            start: given.first().and_then(Affine::fixed_point).unwrap_or(disc.centre),
            warm_up: warm_up(contraction_factor),
        })
    }

    /// The maps.
    pub fn maps(&self) -> &[Affine] {
        self.maps.get(..self.len).unwrap_or_default()
    }

    /// The probability of each map.
    pub fn probabilities(&self) -> &[Unit] {
        self.probabilities.get(..self.len).unwrap_or_default()
    }

    /// The largest of the maps' contraction factors, rounded up.
    pub const fn contraction_factor(&self) -> Unit {
        self.contraction_factor
    }

    /// A disc that each map sends into itself: all of the attractor lies in it, and each point of each chaos
    /// game.
    pub const fn invariant_disc(&self) -> Disc {
        self.disc
    }

    /// How far a point of a chaos game can be from the attractor in each coordinate: what roundings of at
    /// most one unit add up to, `1 / (1 - s)` units of `2^-24` for the contraction factor `s`. In those
    /// units, at most `2^30`.
    pub fn deviation(&self) -> u32 {
        let gap = (1_u32 << 30).saturating_sub(self.contraction_factor.to_bits().unsigned_abs());
        (1_u32 << 30).checked_div(gap).map_or(1 << 30, |units| (units + 1).min(1 << 30))
    }

    pub(super) const fn choice(&self) -> &Alias<N> {
        &self.choice
    }

    /// The map at an index, which the alias table keeps below the number of maps, as a game applies it.
    #[cfg(not(no_carry))]
    #[inline(always)]
    pub(super) fn step(&self, index: usize) -> Option<&PreparedMap> {
        self.prepared.get(index)
    }

    /// The same where nothing is prepared.
    #[cfg(no_carry)]
    #[inline(always)]
    pub(super) fn step(&self, index: usize) -> Option<&Affine> {
        self.maps.get(index)
    }

    /// The fixed point of the first map: a point of the attractor, within half a unit.
    pub(super) const fn start(&self) -> Point2 {
        self.start
    }

    /// See [`warm_up`].
    pub(super) const fn warm_up(&self) -> u32 {
        self.warm_up
    }
}

/// After how many steps the starting point does not matter: the least `k` with `s^k <= 2^-24`, powers rounded
/// down to 30 bits (for slow contractions a fiftieth fewer), at most 1024. The start lies on the attractor,
/// so that every point does; but its first successors crowd around it. The distribution of the `k`-th differs
/// from the invariant one by no more than `s^k` times the diameter (Hutchinson's metric). 1024 steps are
/// enough for `s <= 0.9838`.
fn warm_up(contraction_factor: Unit) -> u32 {
    let mut power = 1_u64 << 30;
    let mut steps = 0;
    while power > 1 << 6 && steps < 1024 {
        power = (power * u64::from(contraction_factor.to_bits().unsigned_abs())) >> 30;
        steps += 1;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue;
    use crate::num::Real;

    const HALF: Affine = Affine::from_thousandths([500, 0, 0, 500, 0, 0]);

    #[test]
    fn a_description_that_is_no_system_is_refused() {
        let half = Unit::from_num(0.5);
        let refused = |maps: &[Affine], p: &[Unit]| Ifs::<2>::new(maps, p).unwrap_err();
        assert!(matches!(refused(&[], &[]), Error::TooFew { .. }));
        assert!(matches!(refused(&[HALF; 3], &[half; 3]), Error::Capacity { needed: 3, capacity: 2, .. }));
        assert!(matches!(refused(&[HALF; 2], &[half]), Error::LengthMismatch { given: 1, expected: 2, .. }));
        let rotation = Affine::from_thousandths([0, -1000, 1000, 0, 0, 0]);
        assert_eq!(refused(&[HALF, rotation], &[half; 2]), Error::NotContractive { map: 1 });
        let negative = [Unit::from_num(1.25), Unit::from_num(-0.25)];
        assert!(matches!(refused(&[HALF; 2], &negative), Error::OutOfRange { index: Some(1), .. }));
        let error = refused(&[HALF; 2], &[half, Unit::from_num(0.6)]);
        let Error::Probabilities { sum } = error else { panic!("{error}") };
        assert!((sum.to_num::<f64>() - 1.1).abs() < 1e-8);
        let far = Affine::from_thousandths([500, 0, 0, 500, 33_000, 0]);
        assert!(matches!(refused(&[far], &[Unit::ONE]), Error::OutOfRange { .. }));
        let error = Ifs::<2>::proportional_to_determinant(&[rotation]).unwrap_err();
        assert_eq!(error, Error::NotContractive { map: 0 });
    }

    #[test]
    fn probabilities_may_miss_1_by_a_millionth_each() {
        let third = |excess: f64| [Unit::from_num(1.0 / 3.0 + excess); 3];
        assert!(Ifs::<3>::new(&[HALF; 3], &third(0.9e-6)).is_ok());
        assert!(Ifs::<3>::new(&[HALF; 3], &third(1.1e-6)).is_err());
        assert!(Ifs::<3>::new(&[HALF; 3], &third(-1.1e-6)).is_err());
        // a millionth is 1073.7 units of 2^-30
        let half = |units: i32| [Unit::from_bits((1 << 29) + units); 2];
        for units in [1073, -1073] {
            assert!(Ifs::<2>::new(&[HALF; 2], &half(units)).is_ok());
        }
        for units in [1075, -1075] {
            assert!(matches!(Ifs::<2>::new(&[HALF; 2], &half(units)), Err(Error::Probabilities { .. })));
        }
    }

    #[test]
    fn areas_decide_and_no_map_is_forgotten() {
        let fern = Ifs::<4>::proportional_to_determinant(catalogue::BARNSLEY_FERN.maps).unwrap();
        let p: heapless::Vec<f64, 4> = fern.probabilities().iter().map(|p| p.to_num()).collect();
        let areas = [0.0, 0.7241, 0.1038, 0.1088];
        let total: f64 = areas.iter().sum();
        assert!((p.iter().sum::<f64>() - 1.0).abs() < 1e-8);
        assert!((p[0] - 1.0 / 129.0).abs() < 1e-6, "{p:?}");
        for (got, area) in p.iter().zip(areas).skip(1) {
            assert!((got - area / total * 128.0 / 129.0).abs() < 1e-6, "{p:?}");
        }
        let flat = [Affine::from_thousandths([500, 0, 0, 0, 0, 0]); 256];
        let even = Ifs::<256>::proportional_to_determinant(&flat).unwrap();
        assert!(even.probabilities().iter().all(|p| *p == Unit::from_num(1.0 / 256.0)));
    }

    #[test]
    fn the_start_is_forgotten_after_the_warm_up() {
        assert_eq!(warm_up(Unit::from_num(0.5)), 24);
        assert_eq!(warm_up(Unit::ZERO), 1);
        assert_eq!(warm_up(Unit::ONE), 1024);
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let s = fern.contraction_factor().to_num::<f64>();
        assert!((s - (0.85_f64 * 0.85 + 0.04 * 0.04).sqrt()).abs() < 2_f64.powi(-28), "{s}");
        assert!((103..=104).contains(&fern.warm_up()), "{}", fern.warm_up());
    }

    #[test]
    fn the_deviation_is_what_the_roundings_add_up_to() {
        let one = Ifs::<1>::new(&[HALF], &[Unit::ONE]).unwrap();
        assert_eq!(one.deviation(), 3);
        // 1 - s = 1/64: the rounded orbit of x -> x - x/64 + t stops short of its fixed point by up to half
        // of 64 units
        let slow = Affine { a: Unit::ONE - Unit::from_num(1.0 / 64.0), ..Affine::default() };
        let ifs = Ifs::<1>::new(&[slow], &[Unit::ONE]).unwrap();
        let mut p = Point2::new(Real::ONE, Real::ZERO);
        for _ in 0..5000 {
            p = slow.apply(p);
        }
        let units = p.x.to_bits().unsigned_abs();
        assert!(units > 16 && units <= ifs.deviation(), "{units} of {}", ifs.deviation());
    }

    /// 1074 units of `2^-30` for each map, not one more: a millionth is 1073.7.
    #[test]
    fn the_tolerance_of_probabilities_ends_with_a_unit() {
        let one = |units: i32| Ifs::<1>::new(&[HALF], &[Unit::from_bits((1 << 30) + units)]);
        let two = |a: i32, b: i32| {
            let half = |units| Unit::from_bits((1 << 29) + units);
            Ifs::<2>::new(&[HALF; 2], &[half(a), half(b)])
        };
        for sign in [1, -1] {
            assert!(one(sign * 1074).is_ok() && two(sign * 1074, sign * 1074).is_ok());
            for refused in [one(sign * 1075).err(), two(sign * 1074, sign * 1075).err()] {
                let Some(Error::Probabilities { sum }) = refused else { panic!("{refused:?}") };
                assert!((sum.to_bits() - (1 << 48)).abs() >> 18 >= 1075, "{sum}");
            }
        }
        let zero = Ifs::<2>::new(&[HALF; 2], &[Unit::ONE, Unit::ZERO]).unwrap_err();
        assert!(matches!(zero, Error::OutOfRange { what: "probability", index: Some(1), .. }));
        assert!(Ifs::<2>::new(&[HALF; 2], &[Unit::ONE - Unit::DELTA, Unit::DELTA]).is_ok());
    }

    /// `1 / (1 - s)` and a unit; the least `k` with `s^k <= 2^-24`, in integers.
    #[test]
    fn deviation_and_warm_up_follow_from_the_contraction_factor() {
        for (numerator, denominator) in [(1, 3), (1, 2), (9, 10), (97, 100), (999, 1000)] {
            let map = Affine::from_ratios([numerator, 0, 0, numerator, 0, 0], denominator);
            let ifs = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap();
            let s = ifs.contraction_factor().to_bits() as u64;
            assert!(s >= map.a.to_bits() as u64 && s <= map.a.to_bits() as u64 + 4);
            assert_eq!(u64::from(ifs.deviation()), (1 << 30) / ((1 << 30) - s) + 1);
            let exact = (24.0 / -(s as f64 / 2_f64.powi(30)).log2()).ceil().min(1024.0);
            // powers are rounded down
            let got = f64::from(ifs.warm_up());
            assert!(got <= exact && got >= 0.98 * exact - 1.0, "{numerator}: {got} against {exact}");
        }
    }

    #[test]
    fn a_system_has_256_maps_at_most() {
        let error = Ifs::<300>::proportional_to_determinant(&[HALF; 257]).unwrap_err();
        assert_eq!(error, Error::Capacity { what: "maps", needed: 257, capacity: 256 });
        assert_eq!(Ifs::<300>::proportional_to_determinant(&[HALF; 256]).unwrap().maps().len(), 256);
    }
}
