//! How a surface answers light: diffuse, Phong, Torrance-Sparrow, mirror.

use super::environment::{Environment, between};
use super::material::{Sight, TorranceSparrow};
use super::power::{power, times};
use crate::Error;
use crate::num::{Unit, Vec3, Wide, unit};

/// A light infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Light {
    pub(super) towards: Vec3<Unit>,
}

impl Light {
    /// From the left and behind the eye of one who looks along `y`: the direction `(-1, -2, 3)`.
    pub(super) const ORDINARY: Self = Self {
        towards: Vec3::new(
            Unit::from_bits(-286_969_574),
            Unit::from_bits(-573_939_147),
            Unit::from_bits(860_908_720),
        ),
    };

    /// A light in the direction `towards` (any length).
    ///
    /// # Errors
    /// [`Error::Degenerate`] for the zero vector.
    pub fn new(towards: Vec3) -> Result<Self, Error> {
        let towards = towards.normalised().ok_or(Error::Degenerate { what: "direction of the light" })?;
        Ok(Self { towards })
    }

    /// How much of it falls on a surface with unit normal `n`, of which the eye sees the side that `-along`
    /// tells.
    #[inline(always)]
    fn on(&self, n: Vec3<Unit>, along: i32) -> Unit {
        let lit = n.dot(self.towards);
        (if along > 0 { -lit } else { lit }).clamp(Unit::ZERO, Unit::ONE)
    }
}

/// How a surface answers light. All parts are in `[0, 1]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Finish {
    /// `ambient + (1 - ambient) max(0, n . l)`.
    Diffuse {
        /// The part that is seen in the shade.
        ambient: Unit,
    },
    /// `ambient + diffuse max(0, n . l) + specular max(0, m . l)^shininess`, `m` the mirrored ray.
    Phong {
        /// The part that is seen in the shade.
        ambient: Unit,
        /// The matt part.
        diffuse: Unit,
        /// The highlight.
        specular: Unit,
        /// Its exponent.
        shininess: u16,
    },
    /// `ambient + diffuse max(0, n . l) + specular F D G / (4 n . v)`: the highlight of tiny mirrors that
    /// lean at random, as [`TorranceSparrow`] has it.
    ///
    /// [`TorranceSparrow`]: super::material::TorranceSparrow
    TorranceSparrow {
        /// The part that is seen in the shade.
        ambient: Unit,
        /// The matt part.
        diffuse: Unit,
        /// The highlight.
        specular: Unit,
        /// By how much the mirrors' slopes deviate: 1/32 to 1.
        roughness: Unit,
        /// What they reflect at right angles.
        reflectance: Unit,
    },
    /// The environment in the direction of the mirrored ray.
    Mirror,
}

impl Finish {
    /// Matt, an eighth of it ambient.
    pub const DIFFUSE: Self = Self::Diffuse { ambient: Unit::from_bits(1 << 27) };
    /// Half matt with a small bright highlight.
    pub const PHONG: Self = Self::Phong {
        ambient: Unit::from_bits(1 << 27),
        diffuse: Unit::from_bits(1 << 29),
        specular: Unit::from_bits(3 << 27),
        shininess: 32,
    };

    /// Half matt with the sheen of brushed metal.
    pub const TORRANCE_SPARROW: Self = Self::TorranceSparrow {
        ambient: Unit::from_bits(1 << 27),
        diffuse: Unit::from_bits(1 << 29),
        specular: Unit::from_bits(3 << 27),
        roughness: Unit::from_bits(1 << 28),
        reflectance: Unit::from_bits(3 << 28),
    };

    /// A constant finish is checked by the compiler.
    #[inline(always)]
    pub(crate) fn checked(self) -> Result<Self, Error> {
        if let Self::TorranceSparrow { roughness, reflectance, .. } = self {
            TorranceSparrow::new(roughness, reflectance)?;
        }
        let parts = match self {
            Self::Diffuse { ambient } => [ambient, Unit::ZERO, Unit::ZERO],
            Self::Phong { ambient, diffuse, specular, .. }
            | Self::TorranceSparrow { ambient, diffuse, specular, .. } => [ambient, diffuse, specular],
            Self::Mirror => [Unit::ZERO; 3],
        };
        for (index, part) in parts.into_iter().enumerate() {
            between("part of the material", Some(index), part.into(), Wide::ZERO, Wide::ONE)?;
        }
        Ok(self)
    }

    /// The tone of a surface with unit normal `n` seen along the unit direction `d`; a normal that points
    /// away is turned round.
    ///
    /// Domain: any parts; `RayCaster::with_finish` takes only those in `[0, 1]`. Result: in `[0, 1]`. Error:
    /// below `2^-27` for diffuse light, `2^-22` for Phong's with an exponent up to 64, `2^-12` for a
    /// Torrance-Sparrow highlight (rows `Finish::tone (diffuse)`, `Finish::tone (Phong, exponent 64)` and
    /// `Finish::tone (Torrance-Sparrow)`).
    #[inline]
    pub fn tone(&self, n: Vec3<Unit>, d: Vec3<Unit>, light: &Light, environment: &Environment) -> Unit {
        match self.shade(n, [d.x, d.y, d.z].map(Unit::to_bits), light, self.highlight()) {
            Shade::Tone(tone) => tone,
            // a mirrored unit vector is one, but for its last bits
            Shade::Reflection(e) => {
                let [x, y, z] = e.map(|c| Unit::from_bits(c.clamp(-(1 << 30), 1 << 30)));
                environment.tone(Vec3::new(x, y, z))
            }
        }
    }

    /// The function of the highlight, of which [`Finish::shade`] is told: what no finish of a picture asks
    /// for is not linked.
    #[inline(always)]
    pub(super) fn highlight(self) -> Highlight {
        // tests one by one: a table of functions would refer to all
        if matches!(self, Self::Phong { .. }) {
            Self::phong
        } else if matches!(self, Self::TorranceSparrow { .. }) {
            Self::sheen
        } else {
            |_, _, _, _| Unit::ZERO
        }
    }

    /// What a Phong finish shows; others have none.
    fn phong(&self, n: Vec3<Unit>, d: [i32; 3], light: &Light) -> Unit {
        let Self::Phong { ambient, diffuse, specular, shininess } = *self else { return Unit::ZERO };
        let along = dot(n, d);
        let highlight = unit(mirrored(n, d, along)).dot(light.towards).clamp(Unit::ZERO, Unit::ONE);
        // three parts of at most 1 each would leave the format
        let matt = ambient.saturating_add(times(diffuse, light.on(n, along))).min(Unit::ONE);
        matt.saturating_add(times(specular, power(highlight, shininess))).clamp(Unit::ZERO, Unit::ONE)
    }

    /// What a Torrance-Sparrow finish shows; others have none.
    fn sheen(&self, n: Vec3<Unit>, d: [i32; 3], light: &Light) -> Unit {
        let Self::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance } = *self else {
            return Unit::ZERO;
        };
        let along = dot(n, d);
        let [x, y, z] = [n.x, n.y, n.z].map(|c| if along > 0 { c.saturating_neg() } else { c });
        let view = Sight { normal: Vec3::new(x, y, z), direction: unit(d), tangent: Vec3::default() };
        let highlight = TorranceSparrow::within(roughness, reflectance).tone(&view, light.towards);
        let matt = ambient.saturating_add(times(diffuse, light.on(n, along))).min(Unit::ONE);
        matt.saturating_add(times(specular, highlight)).clamp(Unit::ZERO, Unit::ONE)
    }

    /// What there is to see along a direction of any length below `2^31`.
    #[inline(always)]
    pub(super) fn shade(&self, n: Vec3<Unit>, d: [i32; 3], light: &Light, highlight: Highlight) -> Shade {
        match *self {
            Self::Diffuse { ambient } => {
                let lit = light.on(n, dot(n, d));
                let tone = ambient.saturating_add(times(Unit::ONE.saturating_sub(ambient), lit));
                Shade::Tone(tone.clamp(Unit::ZERO, Unit::ONE))
            }
            Self::Phong { .. } | Self::TorranceSparrow { .. } => Shade::Tone(highlight(self, n, d, light)),
            Self::Mirror => Shade::Reflection(mirrored(n, d, dot(n, d))),
        }
    }
}

/// What a finish with a highlight shows.
pub(super) type Highlight = fn(&Finish, Vec3<Unit>, [i32; 3], &Light) -> Unit;

/// What a surface shows.
pub(super) enum Shade {
    /// A tone.
    Tone(Unit),
    /// What its surroundings show in this direction, of any length.
    Reflection([i32; 3]),
}

/// `n . d` in the format of `d`.
#[inline]
fn dot(n: Vec3<Unit>, [x, y, z]: [i32; 3]) -> i32 {
    let product = |n: Unit, d: i32| i64::from(n.to_bits()) * i64::from(d);
    // what is longer than 1 wraps
    (product(n.x, x).wrapping_add(product(n.y, y)).wrapping_add(product(n.z, z)) >> 30) as i32
}

/// `d - 2 (d . n) n`, as long as `d`.
#[inline]
fn mirrored(n: Vec3<Unit>, [x, y, z]: [i32; 3], along: i32) -> [i32; 3] {
    let component = |d: i32, n: Unit| {
        let twice = (i64::from(along) * i64::from(n.to_bits())) >> 29;
        // as long as `d`: what wraps on the way comes back
        d.wrapping_sub(twice as i32)
    };
    [component(x, n.x), component(y, n.y), component(z, n.z)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Real;

    #[test]
    fn the_ordinary_light_is_the_one_of_its_direction() {
        assert_eq!(Light::new(Vec3::new((-1).into(), (-2).into(), 3.into())), Ok(Light::ORDINARY));
    }

    /// Pairs of directions of unit length.
    fn directions() -> impl Iterator<Item = (Vec3<Unit>, Vec3<Unit>)> {
        let direction = |i: i32| {
            let [x, y, z] = [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5_i32].map(|n| i.wrapping_mul(n) >> 3);
            Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z)).normalised().unwrap()
        };
        (1..3000).map(move |i| (direction(i), direction(7 * i + 3)))
    }

    fn numbers(v: Vec3<Unit>) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num())
    }

    fn product(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// Against the formulas of Lambert and Phong in floating point.
    #[test]
    fn tones_are_those_of_their_formulas() {
        let light = Light::ORDINARY;
        let l = numbers(light.towards);
        let (mut full, mut behind) = (0, 0);
        for (n, d) in directions() {
            let (normal, ray) = (numbers(n), numbers(d));
            let along = product(normal, ray);
            let lit = (if along > 0.0 { -product(normal, l) } else { product(normal, l) }).clamp(0.0, 1.0);
            let mirror: std::vec::Vec<_> = (0..3).map(|i| ray[i] - 2.0 * along * normal[i]).collect();
            let highlight = product([mirror[0], mirror[1], mirror[2]], l).clamp(0.0, 1.0);
            behind += usize::from(product([mirror[0], mirror[1], mirror[2]], l) < -0.5);
            let tone = |material: Finish| material.tone(n, d, &light, &Environment::SKY).to_num::<f64>();
            // the sign of a grazing ray is anybody's
            if along.abs() > 1e-8 {
                let exact = 0.25 + 0.75 * lit;
                let got = tone(Finish::Diffuse { ambient: Unit::from_num(0.25) });
                assert!((got - exact).abs() < 2_f64.powi(-26), "{n:?} {d:?}: {got} {exact}");
                for (parts, shininess) in [([0.125, 0.5, 0.375], 32), ([0.5, 0.75, 0.875], 3)] {
                    let [ambient, diffuse, specular] = parts.map(Unit::from_num);
                    let got = tone(Finish::Phong { ambient, diffuse, specular, shininess });
                    let matt = (parts[0] + parts[1] * lit).min(1.0);
                    let exact = matt + parts[2] * highlight.powi(shininess.into());
                    full += usize::from(exact > 1.25);
                    assert!((got - exact.min(1.0)).abs() < 2_f64.powi(-22), "{n:?} {d:?}: {got} {exact}");
                }
            }
            let sky = 0.5 + (if mirror[2] < 0.0 { 0.125 } else { 1.0 } - 0.5) * mirror[2].abs();
            assert!((tone(Finish::Mirror) - sky).abs() < 2_f64.powi(-26), "{n:?} {d:?}");
        }
        assert!(full > 10 && behind > 100, "{full} {behind}");
    }

    #[test]
    fn a_product_of_tones_is_the_nearest() {
        for (n, d) in directions() {
            let exact = i64::from(n.x.to_bits()) * i64::from(d.y.to_bits());
            let off = (i64::from(times(n.x, d.y).to_bits()) << 30) - exact;
            assert!((-(1 << 29) + 1..=1 << 29).contains(&off), "{n:?} {d:?}: {off}");
        }
    }

    /// Against integers: products rounded down, and nothing else rounded.
    #[test]
    fn a_mirrored_ray_is_the_exact_one_rounded_once_a_product() {
        for (n, d) in directions() {
            let [[a, b, c], [x, y, z]] = [n, d].map(|v| [v.x, v.y, v.z].map(|c| i128::from(c.to_bits())));
            let along = (a * x + b * y + c * z) >> 30;
            let ray = [d.x, d.y, d.z].map(Unit::to_bits);
            assert_eq!(i128::from(dot(n, ray)), along);
            let exact = [(a, x), (b, y), (c, z)].map(|(n, d)| d - ((2 * along * n) >> 30));
            assert_eq!(mirrored(n, ray, along as i32).map(i128::from), exact, "{n:?} {d:?}");
        }
    }

    /// What a diffuse surface shows, in integers: the ambient part, and the nearest to its rest times the
    /// light.
    #[test]
    fn a_diffuse_tone_is_the_nearest() {
        let light = Light::ORDINARY;
        let (mut dark, mut turned) = (0, 0);
        for (n, d) in directions() {
            let product = |v: Vec3<Unit>| {
                [(n.x, v.x), (n.y, v.y), (n.z, v.z)]
                    .iter()
                    .map(|(a, b)| i128::from(a.to_bits()) * i128::from(b.to_bits()))
                    .sum::<i128>()
                    >> 30
            };
            let (along, lit) = (product(d), product(light.towards));
            let lit = (if along > 0 { -lit } else { lit }).clamp(0, 1 << 30);
            (dark, turned) = (dark + u32::from(lit == 0), turned + u32::from(along > 0));
            for ambient in [0, 1, 123_456_789, 1 << 30] {
                let exact =
                    i128::from(ambient) + ((((1 << 30) - i128::from(ambient)) * lit + (1 << 29)) >> 30);
                let material = Finish::Diffuse { ambient: Unit::from_bits(ambient) };
                let got = material.tone(n, d, &light, &Environment::SKY);
                assert_eq!(i128::from(got.to_bits()), exact, "{n:?} {d:?} {ambient}");
            }
        }
        assert!(dark > 1000 && turned > 1000, "{dark} {turned}");
        // a normal across the ray points neither way and stays as it is
        let (across, up) = ([1, 0, 0].map(Unit::from_num), [0, 0, 1].map(Unit::from_num));
        let [across, up] = [across, up].map(|[x, y, z]| Vec3::new(x, y, z));
        let grazing = Finish::Diffuse { ambient: Unit::ZERO }.tone(up, across, &light, &Environment::SKY);
        assert!((grazing - light.towards.z).abs() <= Unit::DELTA, "{grazing}");
        // half a unit is rounded upwards
        assert_eq!(times(Unit::DELTA, Unit::ONE / 2), Unit::DELTA);
        // a normal that is two units too long still shows no more than there is
        let long = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE + Unit::DELTA * 2);
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        assert_eq!(Finish::Mirror.tone(long, down, &light, &Environment::SKY), Unit::ONE);
        // nor does a light that is too long shine more than it can
        let (light, [quarter, half]) = (Light { towards: long }, [Unit::ONE / 4, Unit::ONE / 2]);
        let bright = Finish::Phong { ambient: Unit::ZERO, diffuse: quarter, specular: half, shininess: 1 };
        assert_eq!(bright.tone(up, down, &light, &Environment::SKY), quarter + half);
    }

    /// A power is off by less than half a unit a product, each counted as often as it is multiplied on: its
    /// exponent.
    #[test]
    fn a_power_is_within_half_a_unit_for_each_of_its_factors() {
        let mut worst: f64 = 0.0;
        for exponent in (0..=130).chain([1000, 4097, u16::MAX]) {
            for i in 0..400_i32 {
                let below = i * i * i * 16;
                let base = Unit::from_bits((1 << 30) - below);
                // ln(1 - x) from the exact difference
                let logarithm = (-f64::from(below) / 2_f64.powi(30)).ln_1p();
                let exact = (logarithm * f64::from(exponent)).exp() * 2_f64.powi(30);
                let off = (f64::from(power(base, exponent).to_bits()) - exact).abs();
                assert!(off < 1e-4 || exponent > 1, "{base} {exponent}");
                worst = worst.max((off - 1e-4) / f64::from(exponent.max(1)));
            }
        }
        assert!((0.125..0.5).contains(&worst), "{worst}");
    }

    #[test]
    fn parts_of_a_material_are_refused_outside_the_unit_interval() {
        let [below, zero, one, above] = [-1, 0, 1 << 30, (1 << 30) + 1].map(Unit::from_bits);
        let refused = |material: Finish| match material.checked() {
            Err(Error::OutOfRange { what: "part of the material", index, .. }) => index,
            other => {
                assert_eq!(other, Ok(material));
                None
            }
        };
        for (ambient, index) in [(below, Some(0)), (zero, None), (one, None), (above, Some(0))] {
            assert_eq!(refused(Finish::Diffuse { ambient }), index);
        }
        for (index, [ambient, diffuse, specular]) in [
            (None, [zero, one, one]),
            (Some(0), [above, one, one]),
            (Some(1), [one, below, one]),
            (Some(2), [one, one, above]),
        ] {
            assert_eq!(refused(Finish::Phong { ambient, diffuse, specular, shininess: 1 }), index);
        }
        for (index, part) in [(None, zero), (Some(0), above)] {
            let (ambient, diffuse, specular) = (part, one, zero);
            let (roughness, reflectance) = (Unit::ONE / 4, Unit::ONE);
            let sheen = Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance };
            assert_eq!(refused(sheen), index);
        }
        let what = |roughness, reflectance| {
            let (ambient, diffuse, specular) = (zero, zero, zero);
            let sheen = Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance };
            match sheen.checked() {
                Err(Error::OutOfRange { what, .. }) => what,
                _ => "",
            }
        };
        assert_eq!(
            (what(Unit::ONE / 64, one), what(one, above), what(one, one)),
            ("roughness", "reflectance", "")
        );
        assert_eq!(refused(Finish::Mirror), None);
        let nowhere = Vec3::new(Real::ZERO, Real::ZERO, Real::ZERO);
        assert_eq!(Light::new(nowhere), Err(Error::Degenerate { what: "direction of the light" }));
    }

    #[test]
    fn the_tone_of_anything_is_between_black_and_white() {
        let ends = [Unit::MIN, Unit::MAX, Unit::ZERO];
        let vectors = || (0..27).map(|k| Vec3::new(ends[k % 3], ends[k / 3 % 3], ends[k / 9]));
        for (n, d) in vectors().flat_map(|n| vectors().map(move |d| (n, d))) {
            for part in ends {
                let phong = Finish::Phong { ambient: part, diffuse: part, specular: part, shininess: 9 };
                let sky = Environment::Gradient { zenith: part, horizon: Unit::MAX, nadir: Unit::MIN };
                let (roughness, reflectance) = (part, part);
                let sheen = Finish::TorranceSparrow {
                    ambient: part,
                    diffuse: part,
                    specular: part,
                    roughness,
                    reflectance,
                };
                for material in [Finish::Mirror, Finish::Diffuse { ambient: part }, phong, sheen] {
                    let tone = material.tone(n, d, &Light::ORDINARY, &sky);
                    assert!((Unit::ZERO..=Unit::ONE).contains(&tone), "{tone} of {material:?}: {n:?} {d:?}");
                }
            }
        }
    }
}
