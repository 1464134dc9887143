//! Mean and covariance of the invariant measure: what the points of an endless chaos game would average to,
//! computed from the maps without playing it.
//!
//! They say where an attractor is heavy and in which direction it stretches, and they are what a chaos game
//! is tested against.
//!
//! The measure is that of a point `P` distributed as `w_i(P)`, `i` drawn with `p_i` (J. E. Hutchinson, 1981;
//! M. F. Barnsley, "Fractals Everywhere", 1988, section 9.6). So `m = sum p_i w_i(m)`, a 2x2 system, and with
//! `s_i = w_i(m) - m` the covariance obeys `C = sum p_i (A_i C A_i^T + s_i s_i^T)`, a 3x3 system for
//! `(C_xx, C_xy, C_yy)`. The probabilities are those that the alias table draws with: divided by their sum.
//!
//! Formats: the 2x2 system is solved exactly in 128 bits, by Cramer's rule and a long division. The 3x3
//! system has entries of 60 fractional bits; Cramer's rule with 40 of them gives a correction from the
//! residual, three times (iterative refinement). Its matrix is `I` minus an average of maps that do not
//! lengthen: the determinant is at least `(1 - s^2)^3`.

use super::system::Ifs;
use crate::Error;
use crate::num::formats::{Q30, Q48};
use crate::num::{Unit, Wide};

/// The largest contraction factor for which the systems are solved: `1 - 2^-8`.
const LARGEST: Q30 = (1 << 30) - (1 << 22);

/// Mean and covariance of a measure in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Moments {
    /// The mean of `x` and of `y`.
    pub mean: [Wide; 2],
    /// The variance of `x`, the covariance of `x` and `y`, the variance of `y`.
    pub covariance: [Wide; 3],
}

impl<const N: usize> Ifs<N> {
    /// Mean and covariance of the invariant measure: of infinitely many points of the chaos game.
    ///
    /// Domain: contraction factors up to `1 - 2^-8`.
    /// Error: of the mean below `2^-46`, of the covariance below `2^-40`, for the catalogue
    /// (rows `Ifs::moments (mean)` and `Ifs::moments (covariance)`).
    /// Cost: 91 thousand Cortex-M4 instructions (kernel `moments`) for the fern.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for larger contraction factors.
    pub fn moments(&self) -> Result<Moments, Error> {
        let factor = self.contraction_factor();
        let refused = Error::OutOfRange {
            what: "contraction factor",
            index: None,
            value: factor.into(),
            min: Wide::ZERO,
            max: Unit::from_bits(LARGEST).into(),
        };
        if factor.to_bits() > LARGEST {
            return Err(refused);
        }
        let mean = self.mean().ok_or(refused)?;
        let covariance = self.covariance(mean).ok_or(refused)?;
        Ok(Moments { mean: mean.map(Wide::from_bits), covariance })
    }

    /// The sum of the probabilities, 30 fractional bits.
    fn total(&self) -> i128 {
        self.probabilities().iter().map(|p| i128::from(p.to_bits())).sum()
    }

    /// `m` from `(I - sum p A) m = sum p t`.
    fn mean(&self) -> Option<[Q48; 2]> {
        // 60 fractional bits on the left, 54 on the right: below 2^62
        let one = self.total() << 30;
        let mut matrix = [[one, 0], [0, one]];
        let mut right = [0_i128; 2];
        for (map, p) in self.maps().iter().zip(self.probabilities()) {
            let p = i128::from(p.to_bits());
            let rows = [[map.a, map.b], [map.c, map.d]];
            for (row, linear) in matrix.iter_mut().zip(rows) {
                for (entry, l) in row.iter_mut().zip(linear) {
                    *entry -= p * i128::from(l.to_bits());
                }
            }
            for (sum, t) in right.iter_mut().zip([map.e, map.f]) {
                *sum += p * i128::from(t.to_bits());
            }
        }
        let [[a, b], [c, d]] = matrix;
        let [e, f] = right;
        let determinant = a * d - b * c;
        Some([quotient(e * d - b * f, determinant)?, quotient(a * f - e * c, determinant)?])
    }

    /// `C` from the 3x3 system of [`Ifs::second_order`], by Cramer's rule and three corrections.
    fn covariance(&self, mean: [Q48; 2]) -> Option<[Wide; 3]> {
        let (matrix, right) = self.second_order(mean)?;
        // 40 fractional bits, each entry at most 2
        let coarse = matrix.map(|row| row.map(|entry| (entry + (1 << 19)) >> 20));
        let cofactors = cofactors(&coarse);
        let [first, ..] = coarse;
        let [[x, ..], [y, ..], [z, ..]] = cofactors;
        let [p, q, r] = first;
        // 120 fractional bits, the lower 40 dropped
        let determinant = (p * x + q * y + r * z) >> 40;
        // 50 fractional bits
        let mut solution = [0_i128; 3];
        for _ in 0..4 {
            // below 2^125 with 110 fractional bits
            let mut residual = [0_i128; 3];
            for ((rest, row), b) in residual.iter_mut().zip(&matrix).zip(right) {
                *rest = (b << 50) - row.iter().zip(&solution).map(|(m, c)| m * c).sum::<i128>();
            }
            let size = residual.iter().map(|r| r.unsigned_abs()).max().unwrap_or(0);
            let excess = (128 - size.leading_zeros()).saturating_sub(38);
            for (c, row) in solution.iter_mut().zip(&cofactors) {
                // 2^84 times 2^38; 40 fractional bits more than the residual's after the division
                let sum: i128 = row.iter().zip(&residual).map(|(k, r)| k * (r >> excess)).sum();
                let step = sum.checked_div(determinant)?;
                // from 110 - excess fractional bits to 50
                let step = if excess >= 60 { step << (excess - 60) } else { step >> (60 - excess) };
                // no variance in the disc is larger than 64^2
                *c = (*c + step).clamp(-(1 << 62), 1 << 62);
            }
        }
        Some(solution.map(|c| Wide::from_bits(((c + 2) >> 2) as i64)))
    }

    /// `I - sum p A (x) A` and `sum p s s^T`, both with 60 fractional bits, rows for `xx`, `xy`, `yy`.
    fn second_order(&self, [x, y]: [Q48; 2]) -> Option<([[i128; 3]; 3], [i128; 3])> {
        let total = self.total();
        let mut matrix = [[0_i128; 3]; 3];
        let mut right = [0_i128; 3];
        let (x, y) = (i128::from(x), i128::from(y));
        for (map, p) in self.maps().iter().zip(self.probabilities()) {
            let p = i128::from(p.to_bits());
            let [a, b, c, d] = [map.a, map.b, map.c, map.d].map(|l| i128::from(l.to_bits()));
            let image = [[a * a, 2 * a * b, b * b], [a * c, a * d + b * c, b * d], [c * c, 2 * c * d, d * d]];
            for (row, terms) in matrix.iter_mut().zip(image) {
                for (entry, term) in row.iter_mut().zip(terms) {
                    // 90 fractional bits
                    *entry -= p * term;
                }
            }
            // 78 fractional bits, then 54 and below 2^63: the disc is at most 128 wide
            let offset = |l: i128, m: i128, t: i32, z: i128| {
                (l * x + m * y + (i128::from(t) << 54) - (z << 30) + (1 << 23)) >> 24
            };
            let (u, v) = (offset(a, b, map.e.to_bits(), x), offset(c, d, map.f.to_bits(), y));
            for (sum, product) in right.iter_mut().zip([u * u, u * v, v * v]) {
                // 60 fractional bits and below 2^76, times 2^30
                *sum += p * ((product + (1 << 47)) >> 48);
            }
        }
        for (row, sum) in matrix.iter_mut().zip(&mut right) {
            for entry in row.iter_mut() {
                *entry = entry.checked_div(total)?;
            }
            *sum = sum.checked_div(total)?;
        }
        let [[xx, ..], [_, xy, _], [.., yy]] = &mut matrix;
        for diagonal in [xx, xy, yy] {
            *diagonal += 1 << 60;
        }
        Some((matrix, right))
    }
}

/// The adjugate: the inverse times the determinant.
fn cofactors(m: &[[i128; 3]; 3]) -> [[i128; 3]; 3] {
    let [[a, b, c], [d, e, f], [g, h, i]] = *m;
    [
        [e * i - f * h, c * h - b * i, b * f - c * e],
        [f * g - d * i, a * i - c * g, c * d - a * f],
        [d * h - e * g, b * g - a * h, a * e - b * d],
    ]
}

/// `numerator / denominator` for 114 fractional bits over 120, rounded to nearest; none outside `-64 .. 64`.
fn quotient(numerator: i128, denominator: i128) -> Option<Q48> {
    let (mut rest, divisor) = (numerator.unsigned_abs(), denominator.unsigned_abs());
    // the quotient of the integers is 2^-6 of the true one
    if rest >= divisor {
        return None;
    }
    let mut twice = 0_u64;
    // 6 bits before the point, 48 behind it, one for rounding; rest < divisor < 2^124
    for _ in 0..55 {
        rest <<= 1;
        twice <<= 1;
        if rest >= divisor {
            rest -= divisor;
            twice |= 1;
        }
    }
    let magnitude = ((twice + 1) >> 1) as i64;
    Some(if (numerator < 0) == (denominator < 0) { magnitude } else { -magnitude })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::{Affine, catalogue};
    use crate::num::Real;

    #[test]
    fn the_unit_interval_is_uniform() {
        let half = |e: i32| Affine::from_thousandths([500, 0, 0, 500, e, e]);
        let ifs = Ifs::<2>::new(&[half(0), half(500)], &[Unit::from_num(0.5); 2]).unwrap();
        let moments = ifs.moments().unwrap();
        assert_eq!(moments.mean, [Wide::from_num(0.5); 2]);
        for v in moments.covariance {
            assert!((v.to_bits() - (1_i64 << 48) / 12).abs() <= 1, "{v}");
        }
    }

    #[test]
    fn a_point_has_no_variance() {
        let map = Affine::from_thousandths([900, 100, -100, 900, 3000, -2000]);
        let ifs = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap();
        let m = ifs.moments().unwrap();
        let fixed = map.fixed_point().unwrap();
        assert!(
            (m.mean[0] - Wide::from(fixed.x)).abs() < 1e-7 && (m.mean[1] - Wide::from(fixed.y)).abs() < 1e-7
        );
        assert!(m.covariance.iter().all(|c| c.abs() < 1e-12), "{m:?}");
    }

    #[test]
    fn a_mean_is_the_nearest_number() {
        for k in 1..400_i64 {
            let (a, e) = ((k * 7_919_777) % (1 << 30) - (1 << 29), (k * 1_299_709) % (1 << 28) - (1 << 27));
            let map =
                Affine { a: Unit::from_bits(a as i32), e: Real::from_bits(e as i32), ..Affine::default() };
            let [mean, _] = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap().moments().unwrap().mean;
            // |mean - e / (1 - a)| <= 2^-49
            let gap = i128::from((1 << 30) - a);
            let off = i128::from(mean.to_bits()) * gap - (i128::from(e) << 54);
            assert!(2 * off.abs() <= gap, "{map:?} {mean}");
        }
    }

    #[test]
    fn probabilities_are_those_that_are_drawn() {
        // a sum of 1 + 2e-6 draws evenly all the same
        let maps = catalogue::SIERPINSKI_GASKET.maps;
        let third = |excess: f64| [Unit::from_num(1.0 / 3.0 + excess); 3];
        let a = Ifs::<3>::new(maps, &third(0.0)).unwrap().moments().unwrap();
        let b = Ifs::<3>::new(maps, &third(0.7e-6)).unwrap().moments().unwrap();
        assert!((a.mean[0] - b.mean[0]).abs() < 1e-13 && (a.covariance[0] - b.covariance[0]).abs() < 1e-13);
    }

    #[test]
    fn contractions_that_hardly_contract_are_refused() {
        let slow = Affine::from_thousandths([999, 0, 0, 999, 0, 0]);
        let ifs = Ifs::<1>::new(&[slow], &[Unit::ONE]).unwrap();
        assert!(matches!(ifs.moments(), Err(Error::OutOfRange { what: "contraction factor", .. })));
        let below = Affine::from_ratios([995, 0, 0, -995, 1, 1], 1000);
        let m = Ifs::<1>::new(&[below], &[Unit::ONE]).unwrap().moments().unwrap();
        assert!((m.mean[0].to_num::<f64>() - 0.2).abs() < 1e-4, "{m:?}");
    }

    /// One map in both coordinates: Cramer's rule in rationals, `x = ((1 - d) e + b f) / det`.
    #[test]
    fn a_mean_in_the_plane_is_the_nearest_number() {
        for k in 1..400_i64 {
            let word = |n: i64, bits: u32| ((k.wrapping_mul(n) >> 7) & ((1 << bits) - 1)) - (1 << (bits - 1));
            let [a, b, c, d] = [7_919_777, 15_485_863, 32_452_843, 49_979_687].map(|n| word(n, 29));
            let [e, f] = [67_867_967, 86_028_121].map(|n| word(n, 28));
            let linear = [a, b, c, d].map(|l| Unit::from_bits(l as i32));
            let map = Affine::new(linear, [e, f].map(|t| Real::from_bits(t as i32)));
            let mean = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap().moments().unwrap().mean;
            let [a, b, c, d, e, f] = [a, b, c, d, e, f].map(i128::from);
            let (p, q) = ((1 << 30) - a, (1 << 30) - d);
            let det = p * q - b * c;
            for (mean, numerator) in mean.into_iter().zip([q * e + b * f, c * e + p * f]) {
                let off = i128::from(mean.to_bits()) * det - (numerator << 54);
                assert!(2 * off.abs() <= det, "{map:?} {mean}");
            }
        }
    }

    /// Two maps `a x + e`, `a x - e` with even chances: `C = e^2 / (1 - a^2)`, in both coordinates; and maps
    /// of unequal chances.
    #[test]
    fn a_covariance_is_that_of_a_geometric_series() {
        let mut most = 0.0_f64;
        for k in 1..600_i64 {
            let [a, d] = [7_919_777, 15_485_863].map(|n: i64| (k * n % (1 << 31) - (1 << 30)) * 127 / 128);
            let [e, f] = [1_299_709, 2_750_159].map(|n: i64| ((k * n % (1 << 24)) << (k % 3)) >> 2);
            let map = |sign: i64| {
                let translation = [e, f].map(|t| Real::from_bits((sign * t) as i32));
                Affine::new(
                    [Unit::from_bits(a as i32), Unit::ZERO, Unit::ZERO, Unit::from_bits(d as i32)],
                    translation,
                )
            };
            let Ok(ifs) = Ifs::<2>::new(&[map(1), map(-1)], &[Unit::from_num(0.5); 2]) else { continue };
            let moments = ifs.moments().unwrap();
            assert_eq!(moments.mean, [Wide::ZERO; 2]);
            let pairs = [(a, a, e, e), (a, d, e, f), (d, d, f, f)];
            for (got, (a, b, e, f)) in moments.covariance.into_iter().zip(pairs) {
                let gap = (1 << 60) - i128::from(a) * i128::from(b);
                // 48 fractional bits times 60 over 48 and 60
                let off = i128::from(got.to_bits()) * gap - ((i128::from(e) * i128::from(f)) << 60);
                most = most.max(off.abs() as f64 / gap as f64);
            }
        }
        // half a unit of 2^-48 is the result's rounding
        assert!(most > 0.45 && most < 0.75, "{most}");
    }

    /// A mean off zero: chances of a quarter and three quarters, `C = 3/16 (e_1 - e_2)^2 / (1 - a^2)` where
    /// both maps have the same linear part.
    #[test]
    fn a_covariance_does_not_depend_on_the_mean() {
        let mut most = 0.0_f64;
        for k in 1..400_i64 {
            let a = (k * 7_919_777 % (1 << 31) - (1 << 30)) * 15 / 16;
            let [e, f] = [1_299_709, 2_750_159].map(|n: i64| (k * n % (1 << 25)) - (1 << 24));
            let map = |t: i64| Affine {
                a: Unit::from_bits(a as i32),
                e: Real::from_bits(t as i32),
                ..Affine::default()
            };
            let ifs = Ifs::<2>::new(&[map(e), map(f)], &[0.25, 0.75].map(Unit::from_num));
            let got = ifs.unwrap().moments().unwrap().covariance[0];
            let gap = (1 << 60) - i128::from(a) * i128::from(a);
            let off = i128::from(got.to_bits()) * gap - 3 * (i128::from(e - f).pow(2) << 56);
            most = most.max(off.abs() as f64 / gap as f64);
        }
        assert!(most > 0.4 && most < 1.0, "{most}");
    }

    #[test]
    fn a_quotient_is_rounded_to_nearest_and_ends_at_64() {
        for (n, d, got) in [
            (1, 2, Some(1 << 53)),
            (1, 3, Some(((1_i64 << 55) / 3 + 1) >> 1)),
            (-2, 3, Some(-(((1_i64 << 56) / 3 + 1) >> 1))),
            (2, -3, Some(-(((1_i64 << 56) / 3 + 1) >> 1))),
            (-1, -4, Some(1 << 52)),
            (3, 3, None),
            (-4, 3, None),
            (0, 5, Some(0)),
            // 2^54 - 2^-8: rounds up
            ((1 << 62) - 1, 1 << 62, Some(1 << 54)),
        ] {
            assert_eq!(quotient(n, d), got, "{n} / {d}");
        }
    }

    /// Two maps of any linear parts, `A_1 x + t` and `A_2 x - t` with even chances: the mean is 0, and
    /// `C = (A_1 C A_1^T + A_2 C A_2^T) / 2 + t t^T` holds for what was computed, in integers with 108
    /// fractional bits, within the rounding of its numbers.
    #[test]
    fn a_covariance_obeys_its_equation() {
        let mut word = 1_u64;
        let mut entry = |bits: u32| {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word as i64) >> (64 - bits)
        };
        let (mut checked, mut most) = (0, 0.0_f64);
        for k in 0..2000 {
            let [first, second] = [(); 2].map(|()| [(); 4].map(|()| entry(30 + k % 2) as i32));
            let [e, f] = [(); 2].map(|()| entry(26));
            let map = |linear: [i32; 4], sign: i64| {
                Affine::new(linear.map(Unit::from_bits), [e, f].map(|t| Real::from_bits((sign * t) as i32)))
            };
            let maps = [map(first, 1), map(second, -1)];
            let Ok(ifs) = Ifs::<2>::new(&maps, &[Unit::from_num(0.5); 2]) else { continue };
            let Ok(moments) = ifs.moments() else { continue };
            assert_eq!(moments.mean, [Wide::ZERO; 2]);
            let [xx, xy, yy] = moments.covariance.map(|c| i128::from(c.to_bits()));
            // twice the equation
            let mut sums = [0_i128; 3];
            for [a, b, c, d] in [first, second].map(|l| l.map(i128::from)) {
                sums[0] += a * a * xx + 2 * a * b * xy + b * b * yy;
                sums[1] += a * c * xx + (a * d + b * c) * xy + b * d * yy;
                sums[2] += c * c * xx + 2 * c * d * xy + d * d * yy;
            }
            let [e, f] = [e, f].map(i128::from);
            for ((c, sum), t) in [xx, xy, yy].into_iter().zip(sums).zip([e * e, e * f, f * f]) {
                most = most.max(((2 * c - 2 * t) * (1 << 60) - sum).abs() as f64 / 2_f64.powi(61));
            }
            checked += 1;
        }
        assert!(checked > 300 && most > 0.5 && most < 1.5, "{checked} {most}");
    }

    #[test]
    fn the_largest_contraction_factor_is_the_largest() {
        let slow = |units: i32| {
            let map = Affine { a: Unit::from_bits(LARGEST + units), ..Affine::default() };
            Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap().moments()
        };
        assert!(slow(-2).is_ok() && slow(2).is_err());
    }

    #[test]
    fn a_variance_may_be_as_large_as_the_range_allows() {
        let at = |e: i32| Affine { e: Real::from_num(e), ..Affine::default() };
        let ifs = Ifs::<2>::new(&[at(50), at(-50)], &[Unit::from_num(0.5); 2]).unwrap();
        assert_eq!(ifs.moments().unwrap().covariance[0], 2500);
    }
}
