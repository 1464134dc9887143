//! Real roots: of a function in a bracket, and all those of a polynomial.
//!
//! Between two neighbouring roots of its derivative a polynomial is monotone and has at most one root, which
//! a change of sign shows (Rolle). The roots of the derivative are found in the same way. Signs are those of
//! double-doubles: the value at a root of the derivative, on which it depends whether two roots that almost
//! meet are there, is as exact as the coefficients.
//!
//! Source: M. Dowell and P. Jarratt, "A modified regula falsi method", BIT 11, 1971 (the Illinois step).

use crate::double_double::DoubleDouble;

/// A root of `f` between `low` and `high`, at which it has different signs (0 counts as positive): halving,
/// between two steps of the Illinois method, until the bracket cannot be divided or does not matter.
pub(crate) fn bracketed(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    for step in 0..400 {
        let tiny = 2.0 * f64::EPSILON * low.abs().max(high.abs()).max(1e-30);
        if high - low <= tiny {
            break;
        }
        let secant = high - at_high * ((high - low) / (at_high - at_low));
        // A step that stays within a few roundings of one end is lengthened across the root.
        let middle = if step % 3 == 2 || !secant.is_finite() { low + (high - low) / 2.0 } else { secant };
        let middle = middle.clamp(low + tiny / 2.0, high - tiny / 2.0);
        let value = f(middle);
        if value == 0.0 {
            return middle;
        }
        if (value < 0.0) == (at_low < 0.0) {
            (low, at_low, at_high) = (middle, value, if step % 3 == 1 { at_high / 2.0 } else { at_high });
        } else {
            (high, at_high, at_low) = (middle, value, if step % 3 == 1 { at_low / 2.0 } else { at_low });
        }
    }
    if at_low.abs() < at_high.abs() { low } else { high }
}

/// All roots in `(low, high)` of the polynomial with the given coefficients, constant first, at which its
/// sign changes, by growing size.
pub(crate) fn polynomial(coefficients: &[DoubleDouble], low: f64, high: f64) -> Vec<f64> {
    if coefficients.len() < 2 {
        return Vec::new();
    }
    let scaled = |(power, &c): (usize, &DoubleDouble)| DoubleDouble::from(power as f64) * c;
    let derivative: Vec<DoubleDouble> = coefficients.iter().enumerate().skip(1).map(scaled).collect();
    let value = |t: f64| {
        let t = DoubleDouble::from(t);
        coefficients.iter().rev().fold(DoubleDouble::ZERO, |sum, &c| sum * t + c).value()
    };
    let mut ends = vec![low];
    ends.extend(polynomial(&derivative, low, high));
    ends.push(high);
    let monotone = ends.windows(2).filter(|piece| (value(piece[0]) < 0.0) != (value(piece[1]) < 0.0));
    monotone.map(|piece| bracketed(value, piece[0], piece[1])).collect()
}

#[cfg(test)]
mod tests {
    use super::{bracketed, polynomial};
    use crate::double_double::DoubleDouble;

    #[test]
    fn a_bracketed_root_is_found_to_its_last_bits() {
        let root = bracketed(|t| t * t - 2.0, 0.0, 2.0);
        assert!((root - core::f64::consts::SQRT_2).abs() < 1e-15);
        // Almost vertical, and almost level.
        let steep = bracketed(|t| libm::cbrt(t - 0.3), 0.0, 1.0);
        assert!((steep - 0.3).abs() < 1e-15, "{steep}");
        let level = bracketed(|t| libm::pow(t, 9.0) - 1e-18, 0.0, 1.0);
        assert!((level - 0.01).abs() < 1e-15, "{level}");
    }

    #[test]
    fn roots_that_almost_meet_are_told_from_those_that_do_not() {
        // (t^2 - 1/4)^2 - e: pairs of roots at a distance of about 2 sqrt e, or none; e is lost in f64.
        for (e, count) in [(1e-24, 4), (-1e-24, 0)] {
            let constant = DoubleDouble::from(0.0625) - DoubleDouble::from(e);
            let coefficients = [constant, DoubleDouble::ZERO, DoubleDouble::from(-0.5)];
            let coefficients = [&coefficients[..], &[DoubleDouble::ZERO, DoubleDouble::ONE]].concat();
            let roots = polynomial(&coefficients, -2.0, 2.0);
            assert_eq!(roots.len(), count, "{roots:?}");
            for (root, sign) in roots.iter().zip([1.0, -1.0, -1.0, 1.0]) {
                let exact = libm::copysign(libm::sqrt(0.25 + sign * 1e-12), *root);
                assert!((root - exact).abs() < 1e-15, "{root} {exact}");
            }
        }
    }
}
