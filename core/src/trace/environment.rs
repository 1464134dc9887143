//! What surrounds a scene, infinitely far away: a tone for every direction.

use core::num::NonZeroU32;

use crate::Error;
use crate::num::{
    Real, Unit, Vec3, Wide, high, high_u, product, product_u, reciprocal, reciprocal_of, reciprocal_sqrt_of,
    rough_sqrt, rounded_down, scaled, square,
};

/// A tone for every direction: seen by rays that miss, and in a mirror.
///
/// Tones are in `[0, 1]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Environment {
    /// One tone everywhere.
    Plain(Unit),
    /// From `horizon` to `zenith` with the sine of the elevation, to `nadir` downwards.
    Gradient {
        /// Straight up.
        zenith: Unit,
        /// At the horizon.
        horizon: Unit,
        /// Straight down.
        nadir: Unit,
    },
    /// A ceiling and a floor at unit height with squares of side `1 / scale`, faded to `horizon` where the
    /// sine of the elevation falls below `fade`.
    Checkerboard {
        /// Tone of the even squares.
        bright: Unit,
        /// Tone of the odd squares.
        dark: Unit,
        /// Tone of the horizon.
        horizon: Unit,
        /// Squares a unit, `1/64` to 64.
        scale: Real,
        /// Where the fading starts, `1/64` to 1.
        fade: Unit,
    },
}

impl Environment {
    /// A sky that brightens towards the zenith above a dark ground.
    pub const SKY: Self = Self::Gradient {
        zenith: Unit::from_bits(1 << 30),
        horizon: Unit::from_bits(1 << 29),
        nadir: Unit::from_bits(1 << 27),
    };

    /// Light and dark squares overhead and underfoot, as in figure 6.
    pub const CHECKERBOARD: Self = Self::Checkerboard {
        bright: Unit::from_bits(15 << 26),
        dark: Unit::from_bits(3 << 26),
        horizon: Unit::from_bits(1 << 29),
        scale: Real::from_bits(1 << 24),
        fade: Unit::from_bits(1 << 27),
    };

    /// Checks tones, scale and fade.
    pub(crate) fn checked(self) -> Result<Self, Error> {
        let tones = match self {
            Self::Plain(tone) => [tone; 3],
            Self::Gradient { zenith, horizon, nadir } => [zenith, horizon, nadir],
            Self::Checkerboard { bright, dark, horizon, scale, fade } => {
                between("scale of the checkerboard", None, scale.into(), Wide::ONE >> 6, Wide::from_num(64))?;
                between("fade of the checkerboard", None, fade.into(), Wide::ONE >> 6, Wide::ONE)?;
                [bright, dark, horizon]
            }
        };
        for (index, tone) in tones.into_iter().enumerate() {
            between("tone of the environment", Some(index), tone.into(), Wide::ZERO, Wide::ONE)?;
        }
        Ok(self)
    }

    /// The tone in direction `e`, a unit vector.
    ///
    /// Domain: any parts; `RayCaster::with_environment` takes only those in their ranges. Result: in
    /// `[0, 1]`. Error: below `2^-29` (row `Environment::tone (gradient)`), and a square's edge is off by
    /// less than `2^-15 (scale + d)` of a square at the distance `d = max(|e_x|, |e_y|) / |e_z|`
    /// (`an_edge_is_where_it_should_be`).
    #[inline]
    pub fn tone(&self, e: Vec3<Unit>) -> Unit {
        self.seen([e.x, e.y, e.z].map(Unit::to_bits), |z| z).clamp(Unit::ZERO, Unit::ONE)
    }

    /// The tone in a direction of any length.
    #[inline]
    pub(super) fn towards(&self, e: [i32; 3]) -> Unit {
        self.seen(e, |z| scaled(z, reciprocal_sqrt_of(square(e))))
    }

    /// The tone in a direction that `unit` brings to length 1, component by component: a gradient asks for
    /// one alone.
    #[inline(always)]
    fn seen(&self, e: [i32; 3], unit: impl Fn(i32) -> i32) -> Unit {
        match *self {
            Self::Plain(tone) => tone,
            Self::Gradient { zenith, horizon, nadir } => {
                let pole = if e[2] < 0 { nadir } else { zenith };
                mix(horizon, pole, unit(e[2]).wrapping_abs())
            }
            Self::Checkerboard { bright, dark, horizon, scale, fade } => {
                let [x, y, z] = e.map(unit);
                let elevation = z.unsigned_abs();
                let tone = if is_even(x, y, elevation, scale) { bright } else { dark };
                mix(horizon, tone, part(elevation, fade))
            }
        }
    }
}

/// A checkerboard, made ready for means over many directions.
///
/// A square's tone is the middle of both tones and half of their difference times `S(u) S(v)`, where `S` is 1
/// on even and -1 on odd squares and `u = scale e_x / |e_z|`, `v = scale e_y / |e_z|`. Over an interval the
/// mean of `S` is what its integral gains, a triangle wave: so it is over the box whose sides have the
/// variances of `u` and `v`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Checkerboard {
    horizon: Unit,
    /// The middle and half of the difference.
    middle: i32,
    half: i32,
    /// The scale, and times the root of 3, which makes half of an interval of a deviation.
    scale: i32,
    wide: i32,
    /// Where the fading starts, a power of two that brings what is below to 32 bits, and the reciprocal.
    fade: u32,
    up: u32,
    per_fade: u32,
}

/// Directions around a unit vector `e`, that change by two vectors, each times a number of mean 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Around {
    pub(super) e: [i32; 3],
    pub(super) changes: [[i32; 3]; 2],
    /// Of these numbers: `[S_00, S_01, S_11]`, 24 fractional bits, below 64.
    pub(super) covariance: [i32; 3],
}

impl Checkerboard {
    /// None of other surroundings.
    pub(super) fn new(environment: &Environment) -> Option<Self> {
        let Environment::Checkerboard { bright, dark, horizon, scale, fade } = *environment else {
            return None;
        };
        let [bright, dark] = [bright, dark].map(|tone| tone.to_bits() >> 1);
        let (middle, half) = (bright.wrapping_add(dark), bright.wrapping_sub(dark));
        let (scale, fade) = (scale.to_bits(), NonZeroU32::new(fade.to_bits().unsigned_abs())?);
        let (per_fade, zeros) = reciprocal_of(fade);
        let wide = (product(scale, 1_859_775_393) >> 30) as i32;
        let up = 1 << zeros;
        Some(Self { horizon, middle, half, scale, wide, fade: fade.get(), up, per_fade: per_fade as u32 })
    }

    /// The mean tone.
    ///
    /// Error: against that over the box, `2^-12` (`a_mean_of_squares_is_that_over_their_box`); within `2^-9`
    /// of the horizon squares count as grey.
    #[inline(always)]
    pub(super) fn over(&self, Around { e, changes, covariance }: &Around) -> Unit {
        let ([x, y, z], [[ax, ay, az], [bx, by, bz]]) = (*e, *changes);
        let elevation = z.unsigned_abs();
        let mut tone = self.middle;
        if let Some(height) = NonZeroU32::new(elevation).filter(|_| elevation >= 1 << 21) {
            let (mantissa, zeros) = reciprocal_of(height);
            // 1 / |e_z|, 20 fractional bits, and times scale and root, 16
            let per_height = mantissa >> (12_u32.wrapping_sub(zeros) & 31);
            let per_deviation = (product(per_height, self.wide) >> 28) as u32;
            let up = [az, bz].map(|up| if z < 0 { up.wrapping_neg() } else { up });
            let at = [x, y].map(|c| rounded_down::<30>(product(c, per_height)));
            let [u, v] =
                [variance(at[0], [ax, bx], up, covariance), variance(at[1], [ay, by], up, covariance)];
            // what leaves a word is an even number of squares
            let [x, y] = at.map(|at| (product(at, self.scale) >> 20) as i32);
            let both = product(mean(x, u, per_deviation), mean(y, v, per_deviation));
            let both = rounded_down::<30>(both);
            tone = tone.wrapping_add((product(self.half, both) >> 30) as i32);
        }
        let part = high_u(elevation.min(self.fade).wrapping_mul(self.up), self.per_fade) as i32;
        let horizon = self.horizon.to_bits();
        // 28 bits of it count
        let faded = high(tone.wrapping_sub(horizon), part) << 2;
        Unit::from_bits(horizon.wrapping_add(faded).max(0))
    }
}

/// The variance of `e_x / |e_z|` times `e_z^2`, 44 fractional bits: of its value `at`, 20, where `e_x`
/// changes by `by` and `|e_z|` by `up`. Changes count up to 32: what leaves that is far down at the horizon.
#[inline(always)]
fn variance(at: i32, by: [i32; 2], up: [i32; 2], [aa, ab, bb]: &[i32; 3]) -> u64 {
    let change = |by: i32, up: i32| {
        (by >> 10).wrapping_sub(rounded_down::<30>(product(at, up))).clamp(-1 << 25, (1 << 25) - 1)
    };
    let [a, b] = [change(by[0], up[0]), change(by[1], up[1])];
    let term = |a: i32, b: i32, s: &i32| product(rounded_down::<20>(product(a, b)), *s);
    (term(a, a, aa) + 2 * term(a, b, ab) + term(b, b, bb)).max(0) as u64
}

/// The mean of `S` around a place, 24 fractional bits, where what has a [`variance`] counts times so much: 30
/// fractional bits.
#[inline(always)]
fn mean(at: i32, variance: u64, per_deviation: u32) -> i32 {
    let integral = |at: i32| {
        let odd = at & ((1 << 25) - 1);
        odd.min((1 << 25) - odd)
    };
    let half = product_u(rough_sqrt(variance), per_deviation);
    // a half of little more than 16 squares at most: it has two zeros at least
    let half = ((half >> 32) as u32).min(1 << 10) << 18 | (half as u32 >> 14) | 1;
    let from = |half: i32| integral(at.wrapping_add(half));
    let gained = from(half as i32).wrapping_sub(from((half as i32).wrapping_neg()));
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::MIN | half);
    // over twice the half
    high(gained << (zeros.wrapping_sub(2) & 31), mantissa) << 1
}

/// Whether the square in a direction is an even one; any where its tone does not count.
#[inline(never)]
pub(super) fn is_even(x: i32, y: i32, elevation: u32, scale: Real) -> bool {
    // below 2^-18 the horizon is so near that less than 2^-11 of a square's tone is left
    let (mantissa, shift) = reciprocal(elevation.max(1 << 12));
    let squares = |c: i32| {
        // c / |e_z| with 16 fractional bits is below 2^34, times the scale with 16 bits below 2^57
        let ratio = (i64::from(c) * i64::from(mantissa)) >> (shift - 16);
        (ratio * i64::from(scale.to_bits() >> 8)) >> 32
    };
    (squares(x) + squares(y)) & 1 == 0
}

/// `elevation / fade`, at most 1; 0 below `2^-18`.
#[inline(never)]
pub(super) fn part(elevation: u32, fade: Unit) -> i32 {
    if elevation < 1 << 12 {
        return 0;
    }
    let (mantissa, shift) = reciprocal(fade.to_bits().unsigned_abs());
    ((i64::from(elevation) * i64::from(mantissa)) >> (shift - 30)).min(1 << 30) as i32
}

/// `from + (to - from) part`.
#[inline]
fn mix(from: Unit, to: Unit, part: i32) -> Unit {
    // tones of a scene are in [0, 1]; others wrap
    let difference = to.to_bits().wrapping_sub(from.to_bits());
    from.wrapping_add(Unit::from_bits(((i64::from(difference) * i64::from(part)) >> 30) as i32))
}

pub(crate) fn between(
    what: &'static str,
    index: Option<usize>,
    value: Wide,
    min: Wide,
    max: Wide,
) -> Result<(), Error> {
    if value < min || value > max { Err(Error::OutOfRange { what, index, value, min, max }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions of unit length on both sides of the horizon, down to `2^-19` of it.
    fn directions() -> impl Iterator<Item = Vec3<Unit>> {
        (1..6000_i32).filter_map(|i| {
            let bits = |n: i32| i.wrapping_mul(n) >> 3;
            let [x, y, z] = [bits(0x2545_f491), bits(0x6c07_8965), bits(0x1f12_3bb5) >> (i % 19)];
            Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z)).normalised()
        })
    }

    #[test]
    fn a_gradient_is_linear_on_both_sides_of_the_horizon() {
        let tones = [0.9, 0.3, 0.05];
        let [zenith, horizon, nadir] = tones.map(Unit::from_num);
        let sky = Environment::Gradient { zenith, horizon, nadir };
        for e in directions() {
            let z = e.z.to_num::<f64>();
            let pole = if z < 0.0 { tones[2] } else { tones[0] };
            let exact = tones[1] + (pole - tones[1]) * z.abs();
            assert!((sky.tone(e).to_num::<f64>() - exact).abs() < 2_f64.powi(-29), "{e:?}");
        }
    }

    /// Against floating point, except where a ray comes within `2^-7` of a square from its side.
    #[test]
    fn a_checkerboard_has_the_tones_of_its_squares_and_fades() {
        let [bright, dark, horizon] = [0.875, 0.125, 0.5].map(Unit::from_num);
        let (mut evens, mut faded) = ([0; 2], 0);
        for (scale, fade) in [(1.0, 0.125), (0.75, 1.0 / 64.0), (2.3125, 1.0)] {
            let (scale_bits, fade_bits) = (Real::from_num(scale), Unit::from_num(fade));
            let board =
                Environment::Checkerboard { bright, dark, horizon, scale: scale_bits, fade: fade_bits };
            for e in directions() {
                let [x, y, z] = [e.x, e.y, e.z].map(|c| c.to_num::<f64>());
                let squares = [x, y].map(|c| c / z.abs() * scale);
                if squares.iter().any(|s| (s - s.round()).abs() < 2_f64.powi(-7)) || z.abs() < 2_f64.powi(-18)
                {
                    continue;
                }
                let even = (squares[0].floor() + squares[1].floor()) % 2.0 == 0.0;
                let tone = if even { 0.875 } else { 0.125 };
                let exact = 0.5 + (tone - 0.5) * (z.abs() / fade).min(1.0);
                assert!((board.tone(e).to_num::<f64>() - exact).abs() < 2_f64.powi(-26), "{scale} {e:?}");
                evens[usize::from(even)] += 1;
                faded += usize::from(z.abs() < 2_f64.powi(-14));
            }
        }
        assert!(evens.iter().all(|n| *n > 3000) && faded > 100, "{evens:?} {faded}");
    }

    /// Against floating point: the box, and the mean over it.
    #[test]
    fn a_mean_of_squares_is_that_over_their_box() {
        let (mut worst, mut grey, mut plain) = (0.0_f64, 0, 0);
        let integral = |at: f64| (at.rem_euclid(2.0) - 1.0).abs();
        for (k, e) in directions().enumerate().filter(|(_, e)| e.z.to_num::<f64>().abs() > 0.05) {
            let bits = |n: u32, shift: u32| ((k as u32).wrapping_mul(n) as i32) >> shift;
            let changes = [[0x2c1b_3c6d, 0x297a_2d39, 0x1b56_c4e9], [0x7feb_352d, 0x846c_a68b, 0x9e37_79b9]];
            let changes = changes.map(|v| v.map(|n| bits(n, 2 + k as u32 % 5)));
            // from none to a fourth
            let least = if k % 7 == 0 { 0 } else { 1 << (8 + k % 15) };
            let covariance = [least, -least / 3, least / 2];
            let (scale, fade) = (Real::from_bits(1 << (21 + k % 5)), Unit::ONE / 2);
            let [bright, dark, horizon] = [0.875, 0.125, 0.5].map(Unit::from_num);
            let board = Environment::Checkerboard { bright, dark, horizon, scale, fade };
            let around = Around { e: [e.x, e.y, e.z].map(Unit::to_bits), changes, covariance };
            let got = Checkerboard::new(&board).unwrap().over(&around).to_num::<f64>();
            let [x, y, z] = [e.x, e.y, e.z].map(|c| c.to_num::<f64>());
            let [a, b] = changes.map(|v| v.map(|c| f64::from(c) / f64::from(1 << 30)));
            let [aa, ab, bb] = covariance.map(|c| f64::from(c) / f64::from(1 << 24));
            let scale = scale.to_num::<f64>();
            let mean = |c: f64, i: usize| {
                let at = c / z.abs();
                let [a, b] = [a, b].map(|v| (v[i] - at * v[2] * z.signum()) / z.abs());
                let half = scale * (3.0 * (a * a * aa + 2.0 * a * b * ab + b * b * bb)).sqrt();
                if half < 1e-3 {
                    let at = (scale * at).rem_euclid(2.0);
                    // an edge is anybody's
                    let near = [0.0, 1.0, 2.0].iter().any(|edge| (at - edge).abs() < 2e-3);
                    return if near {
                        f64::NAN
                    } else if at < 1.0 {
                        1.0
                    } else {
                        -1.0
                    };
                }
                // falling towards odd numbers: minus the triangle wave
                (integral(scale * at - half) - integral(scale * at + half)) / (2.0 * half)
            };
            let both = mean(x, 0) * mean(y, 1);
            let exact = 0.5 + 0.375 * both * (z.abs() / 0.5).min(1.0);
            if both.is_nan() {
                continue;
            }
            grey += usize::from(both.abs() < 0.2);
            plain += usize::from(both.abs() == 1.0);
            worst = worst.max((got - exact).abs());
            assert!((got - exact).abs() < 2_f64.powi(-12), "{around:?}: {got} {exact}");
        }
        assert!(grey > 150 && plain > 150 && worst > 2_f64.powi(-13), "{grey} {plain} {worst}");
        assert!(Checkerboard::new(&Environment::SKY).is_none());
    }

    #[test]
    fn the_ends_of_a_range_belong_to_it() {
        let within = |v: i32| between("number", None, Wide::from_num(v), Wide::ZERO, Wide::ONE).is_ok();
        assert!(within(0) && within(1) && !within(-1) && !within(2));
    }

    #[test]
    fn an_edge_is_where_it_should_be() {
        let (mut worst, mut tried, mut other) = (0.0_f64, 0, 0);
        let mut word = 1_u64;
        for _ in 0..400_000 {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let [x, y] = [word >> 33, word >> 13].map(|w| (w as u32 as i32) >> 2);
            let z = ((word >> 24) as i32 >> 2) | 1 << 24;
            let scale = Real::from_bits((word >> 40) as i32 | 1 << 22);
            let sky = Environment::Checkerboard {
                bright: Unit::ONE,
                dark: Unit::ZERO,
                horizon: Unit::ZERO,
                scale,
                fade: Unit::from_bits(1 << 20),
            };
            if z.unsigned_abs() < 1 << 22 {
                continue;
            }
            tried += 1;
            let steps = f64::from(scale.to_bits()) / 16_777_216.0;
            let places = [x, y].map(|c| f64::from(c) / f64::from(z.abs()));
            let even = places.iter().map(|p| (p * steps).floor() as i64).sum::<i64>() & 1 == 0;
            let tone = sky.tone(Vec3::new(Unit::from_bits(x), Unit::from_bits(y), Unit::from_bits(z)));
            if (tone > 0.5) != even {
                other += 1;
                let distance = places.iter().fold(0.0_f64, |d, p| d.max(p.abs()));
                let off = |p: &f64| (p * steps - (p * steps).round()).abs();
                let off = places.iter().map(off).fold(f64::MAX, f64::min) / (steps + distance);
                worst = worst.max(off * 32_768.0);
            }
        }
        // some directions lie in the sliver, and none farther off
        assert!(tried > 300_000 && other > 5 && worst < 1.0, "{worst} of {other} of {tried}");
        assert!(worst > 0.25, "{worst}");
    }

    /// Against integers: `from + (to - from) part`, rounded down; the part of the fade, within a unit and at
    /// most 1.
    #[test]
    fn a_mixture_and_a_fade_are_exact() {
        for from in [0, 1, 1 << 29, 1 << 30] {
            for to in [0, 77_777_777, 1 << 30] {
                for part in [0, 1, 123_456_789, (1 << 30) - 1, 1 << 30] {
                    let exact = from + (((to - from) * i64::from(part)) >> 30);
                    let got = mix(Unit::from_bits(from as i32), Unit::from_bits(to as i32), part);
                    assert_eq!(i64::from(got.to_bits()), exact, "{from} {to} {part}");
                }
            }
        }
        let mut worst = 0;
        for fade in [1 << 24, 77_777_777, 1 << 27, (1 << 30) - 1, 1 << 30] {
            for elevation in
                [1 << 12, 4097, 1 << 20, 12_345_678, 1 << 24, fade as u32 - 1, fade as u32, 1 << 30]
            {
                let exact = ((i64::from(elevation) << 30) / i64::from(fade)).min(1 << 30);
                let off = exact - i64::from(part(elevation, Unit::from_bits(fade)));
                assert!((0..=3).contains(&off), "{elevation} / {fade}: {off}");
                worst = worst.max(off);
            }
            // the whole from the fade on, but for the reciprocal's last bits
            let whole = [fade + (fade >> 20) + 4, i32::MAX].map(|e| part(e as u32, Unit::from_bits(fade)));
            assert_eq!(whole, [1 << 30; 2], "{fade}");
            assert_eq!([part(0, Unit::from_bits(fade)), part((1 << 12) - 1, Unit::from_bits(fade))], [0, 0]);
        }
        assert!(worst > 0);
    }

    /// A direction's length changes nothing but the last bits, and the square where a direction comes near
    /// its edge.
    #[test]
    fn a_tone_is_that_of_the_unit_vector() {
        let (mut worst, mut tried, mut crossed) = (0, 0, 0);
        for e in directions() {
            let bits = [e.x, e.y, e.z].map(Unit::to_bits);
            for length in [bits.map(|c| c / 2 * 3), bits.map(|c| c >> 1), bits.map(|c| c >> 4)] {
                for sky in
                    [Environment::SKY, Environment::Plain(Unit::from_bits(77)), Environment::CHECKERBOARD]
                {
                    let off = (sky.towards(length) - sky.tone(e)).abs().to_bits();
                    tried += 1;
                    if sky == Environment::CHECKERBOARD && off > 64 {
                        crossed += 1;
                    } else {
                        worst = worst.max(off);
                    }
                }
            }
        }
        assert!(
            (32..64).contains(&worst) && tried > 30_000 && crossed * 20 < tried,
            "{worst} {crossed} of {tried}"
        );
    }

    #[test]
    fn surroundings_are_refused_outside_their_ranges() {
        let [below, zero, one, above] = [-1, 0, 1 << 30, (1 << 30) + 1].map(Unit::from_bits);
        let refused = |environment: Environment| match environment.checked() {
            Err(Error::OutOfRange { what, index, .. }) => Some((what, index)),
            other => {
                assert_eq!(other, Ok(environment));
                None
            }
        };
        let tone = |index| Some(("tone of the environment", Some(index)));
        for (value, index) in [(below, tone(0)), (zero, None), (one, None), (above, tone(0))] {
            assert_eq!(refused(Environment::Plain(value)), index);
        }
        assert_eq!(refused(Environment::Gradient { zenith: one, horizon: below, nadir: zero }), tone(1));
        assert_eq!(refused(Environment::Gradient { zenith: one, horizon: one, nadir: above }), tone(2));
        let board = |dark, scale, fade| {
            let (scale, fade) = (Real::from_bits(scale), Unit::from_bits(fade));
            refused(Environment::Checkerboard { bright: one, dark, horizon: zero, scale, fade })
        };
        assert_eq!(board(above, 1 << 24, 1 << 28), tone(1));
        let (scale, fade) =
            (Some(("scale of the checkerboard", None)), Some(("fade of the checkerboard", None)));
        let scales = [(1 << 18) - 1, 1 << 18, 64 << 24, (64 << 24) + 1].map(|s| board(zero, s, 1 << 28));
        let fades = [(1 << 24) - 1, 1 << 24, 1 << 30, (1 << 30) + 1].map(|f| board(zero, 1 << 24, f));
        assert_eq!((scales, fades), ([scale, None, None, scale], [fade, None, None, fade]));
    }

    #[test]
    fn the_tone_of_parts_outside_their_ranges_is_a_tone() {
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        assert_eq!(Environment::Plain(Unit::MAX).tone(down), Unit::ONE);
        assert_eq!(Environment::Plain(Unit::MIN).tone(down), Unit::ZERO);
        let ends = [Unit::MIN, Unit::MAX, Unit::ZERO, Unit::ONE, Unit::DELTA];
        for k in 0..625 {
            let [a, b, c, z] = [k % 5, k / 5 % 5, k / 25 % 5, k / 125].map(|k| ends[k]);
            let scale = Real::from_bits(c.to_bits());
            let checkers = Environment::Checkerboard { bright: a, dark: b, horizon: c, scale, fade: z };
            for sky in [Environment::Gradient { zenith: a, horizon: b, nadir: c }, checkers] {
                let tone = sky.tone(Vec3::new(a, b, z));
                assert!((Unit::ZERO..=Unit::ONE).contains(&tone), "{tone} of {sky:?}");
            }
        }
    }
}
