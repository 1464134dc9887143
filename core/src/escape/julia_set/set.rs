//! What is known of the Julia set `J_c` before anything is drawn: its fixed points, whether it is connected,
//! the two simple cases.
//!
//! `J_c` is the boundary of `K_c`, the points whose orbits under `z^2 + c` stay bounded. Source: course unit
//! V, sections 5.5.3 and 5.5.4. Fixed points of `z^2 + c`: `p = 1/2 ± sqrt(1/4 - c)` (eq. 4); `p` attracts
//! when `|2 p| < 1` and repels when `|2 p| > 1`. `K_c` is connected exactly when the orbit of 0 is bounded,
//! that is when `c` belongs to the Mandelbrot set.
//!
//! Format: 29 fractional bits.

use fixed::types::I3F29;

use crate::Error;
use crate::escape::julia_set::square_root::square_root;
use crate::escape::orbit::cardioid;
use crate::escape::orbit::dwell::{self, FRACTION_Q29, Fine, Point29};
use crate::escape::orbit::narrow::narrow;
use crate::escape::value::checked_max;
use crate::num::Complex;
use crate::num::formats::Q29;
use crate::num::{Wide, sqrt};

/// The Julia set of `z^2 + c`.
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::{Connectedness, JuliaSet, Stability};
/// use attractor::num::Wide;
/// let basilica = JuliaSet::new(Complex::new(Wide::from_num(-1), Wide::ZERO))?;
/// assert_eq!(basilica.connectedness(100)?, Connectedness::Connected);
/// assert!(basilica.fixed_points().iter().all(|p| p.stability == Stability::Repelling));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::JuliaSetNumbers", into = "crate::serial::JuliaSetNumbers")
)]
pub struct JuliaSet {
    c: Point29,
}

/// A fixed point of `z^2 + c`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FixedPoint {
    /// Where it is, within 2 units of `2^-29`.
    pub point: Complex<I3F29>,
    /// What it does to its neighbourhood.
    pub stability: Stability,
}

/// What a fixed point `p` does to orbits that start near it. Decided by exact arithmetic on the stored `c`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stability {
    /// `|2 p| < 1`: it draws them in.
    Attracting,
    /// `|2 p| = 1`: the first derivative does not decide.
    Indifferent,
    /// `|2 p| > 1`: it drives them away, and belongs to `J_c`.
    Repelling,
}

/// Whether `K_c` is connected, and how far that is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Connectedness {
    /// Connected, proved: `c` lies in the main cardioid or in the disc of period 2, or is -2.
    Connected,
    /// The orbit of 0 stays bounded for as many iterations: connected as far as that shows.
    BoundedFor(u32),
    /// A Cantor set: the orbit of 0 exceeds 2 after as many iterations.
    Dust(u32),
}

/// The two Julia sets that have a name in elementary geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum SimpleCase {
    /// `c = 0`: the circle of radius 1 around 0; `K_c` is its disc.
    UnitCircle,
    /// `c = -2`: the segment from -2 to 2, which is `K_c` as well.
    Segment,
}

impl JuliaSet {
    /// The set of `c`, which is rounded to 29 fractional bits.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `|c| > 2`, as for [`Julia`](crate::escape::Julia).
    pub fn new(c: Complex<Wide>) -> Result<Self, Error> {
        Ok(Self { c: checked_constant(c)? })
    }

    pub(crate) const fn word(&self) -> Point29 {
        self.c
    }

    /// The constant as it is stored.
    pub const fn constant(&self) -> Complex<I3F29> {
        Complex::new(I3F29::from_bits(self.c.0), I3F29::from_bits(self.c.1))
    }

    /// Both fixed points, `1/2 + sqrt(1/4 - c)` first. The first never attracts and always belongs to `J_c`.
    ///
    /// Error: 2 units (`fixed_points_are_fixed`); the stability is exact.
    pub fn fixed_points(&self) -> [FixedPoint; 2] {
        const HALF: Q29 = 1 << (FRACTION_Q29 - 1);
        const QUARTER: i64 = 1 << (FRACTION_Q29 - 2);
        let (re, im) = square_root(QUARTER - i64::from(self.c.0), -i64::from(self.c.1));
        // the root has a real part of at most 3/2
        let point = |x: Q29, y: Q29| Complex::new(I3F29::from_bits(HALF + x), I3F29::from_bits(y));
        // |1 + 2 s| with re s >= 0 is 1 for s = 0 alone
        let at_cusp = i64::from(self.c.0) == QUARTER && self.c.1 == 0;
        let first = if at_cusp { Stability::Indifferent } else { Stability::Repelling };
        [
            FixedPoint { point: point(re, im), stability: first },
            FixedPoint { point: point(-re, -im), stability: self.inner_stability() },
        ]
    }

    /// `|1 - 2 s| < 1` is the main cardioid: `4 q (q + p) < y^2` (see [`interior`]), in integers.
    fn inner_stability(&self) -> Stability {
        let (x, y) = (i128::from(self.c.0), i128::from(self.c.1));
        // |p| < 2^31.2, q < 2^61.2: the left side stays below 2^126
        let p = x - (1 << (FRACTION_Q29 - 2));
        let q = p * p + y * y;
        let left = 4 * q * (q + (p << FRACTION_Q29));
        let right = (y * y) << (2 * FRACTION_Q29);
        match left.cmp(&right) {
            core::cmp::Ordering::Less => Stability::Attracting,
            core::cmp::Ordering::Equal => Stability::Indifferent,
            core::cmp::Ordering::Greater => Stability::Repelling,
        }
    }

    /// Whether `K_c` is connected. Where no formula knows, the orbit of 0 is followed for at most `limit`
    /// iterations.
    ///
    /// # Errors
    /// As for the iterations of a picture: [`Error::TooFew`] for 0, [`Error::Capacity`] above
    /// [`MAX_DWELL`](crate::escape::MAX_DWELL).
    pub fn connectedness(&self, limit: u32) -> Result<Connectedness, Error> {
        let limit = checked_max(limit)?;
        if cardioid::contains(self.c) || self.simple_case() == Some(SimpleCase::Segment) {
            return Ok(Connectedness::Connected);
        }
        let count = dwell::dwell::<Fine>(self.c, self.c, limit);
        Ok(if count < limit { Connectedness::Dust(count) } else { Connectedness::BoundedFor(limit) })
    }

    /// Whether `c` is 0 or -2.
    pub const fn simple_case(&self) -> Option<SimpleCase> {
        match self.c {
            (0, 0) => Some(SimpleCase::UnitCircle),
            (re, 0) if re == -(2 << FRACTION_Q29) => Some(SimpleCase::Segment),
            _ => None,
        }
    }
}

/// The stored constant of a Julia set.
///
/// # Errors
/// [`Error::OutOfRange`] for `|c| > 2` (such a set is dust, and 2 is no bound for its orbits), with the
/// larger part of `c`.
pub(crate) fn checked_constant(c: Complex<Wide>) -> Result<Point29, Error> {
    const TWO: Wide = Wide::lit("2");
    narrow(c).ok_or_else(|| {
        // 16 fractional bits, rounded up
        let square = |v: Wide| (v.to_bits() >> 32).pow(2).unsigned_abs();
        let magnitude = i64::from(sqrt(square(c.re) + square(c.im))) + 2;
        let value = Wide::from_bits(magnitude.saturating_mul(1 << 32));
        Error::OutOfRange { what: "|c|", index: None, value, min: Wide::ZERO, max: TWO }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(re: f64, im: f64) -> JuliaSet {
        JuliaSet::new(Complex::new(Wide::from_num(re), Wide::from_num(im))).unwrap()
    }

    #[test]
    fn fixed_points_are_fixed() {
        let mut attracting = 0;
        for k in 0..10_000 {
            let (r, t) = (f64::from(k % 100) / 50.0, f64::from(k));
            let set = set(r * t.cos(), r * t.sin());
            let c = set.constant();
            for p in set.fixed_points() {
                let (x, y) = (p.point.re.to_num::<f64>(), p.point.im.to_num::<f64>());
                let image = (x * x - y * y + c.re.to_num::<f64>(), 2.0 * x * y + c.im.to_num::<f64>());
                let error = (image.0 - x).hypot(image.1 - y);
                assert!(error < 3.0 * 5.0 * 2_f64.powi(-29), "{c:?}: {error:e}");
                let multiplier = 2.0 * x.hypot(y);
                if (multiplier - 1.0).abs() > 1e-6 {
                    assert_eq!(p.stability == Stability::Attracting, multiplier < 1.0, "{c:?}");
                    attracting += u32::from(multiplier < 1.0);
                }
            }
        }
        assert!(attracting > 500);
    }

    #[test]
    fn the_border_of_the_cardioid_is_indifferent() {
        assert_eq!(set(0.25, 0.0).fixed_points().map(|p| p.stability), [Stability::Indifferent; 2]);
        let expected = [Stability::Repelling, Stability::Indifferent];
        assert_eq!(set(-0.75, 0.0).fixed_points().map(|p| p.stability), expected);
        assert_eq!(set(0.0, 0.0).fixed_points()[1].stability, Stability::Attracting);
        assert_eq!(set(0.0, 0.0).fixed_points()[1].point, Complex::default());
        assert_eq!(set(-2.0, 0.0).fixed_points()[0].point.re, 2);
    }

    #[test]
    fn connected_sets_are_told_from_dust() {
        assert_eq!(set(0.0, 0.0).connectedness(50), Ok(Connectedness::Connected));
        assert_eq!(set(-2.0, 0.0).connectedness(50), Ok(Connectedness::Connected));
        assert_eq!(set(0.0, 1.0).connectedness(50), Ok(Connectedness::BoundedFor(50)));
        assert_eq!(set(1.0, 0.0).connectedness(50), Ok(Connectedness::Dust(2)));
        assert!(set(1.0, 0.0).connectedness(0).is_err());
        assert_eq!(set(-2.0, 0.0).simple_case(), Some(SimpleCase::Segment));
        assert_eq!(set(0.0, 0.0).simple_case(), Some(SimpleCase::UnitCircle));
        assert_eq!(set(0.1, 0.0).simple_case(), None);
        assert!(JuliaSet::new(Complex::new(Wide::from_num(2.1), Wide::ZERO)).is_err());
    }
}
