//! Where the maps of a curve or a surface must agree: the conditions, and by how much they fail.
//!
//! A curve: `T_0 c_0 = c_0`, `T_(N-1) c_1 = c_1`, `T_(i-1) c_1 = T_i c_0` (Tosan, Guerin, Baskurt, eq. 2). A
//! patch: its boundary curves lie in the sides of the control grid (embedding, eq. 3), opposite sides have
//! the same curve, and neighbouring parts have a side in common (section 4.2).

use super::barycentric::wide;
use crate::Error;
use crate::num::Near;

/// The greatest difference of two weights, 28 fractional bits.
fn gap<const J: usize>(a: &[Near; J], b: &[Near; J]) -> i64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| i64::from(a.to_bits()).abs_diff(i64::from(b.to_bits())) as i64)
        .max()
        .unwrap_or(0)
}

/// Whether two points agree to within `tolerance` units of `2^-28`.
///
/// # Errors
/// [`Error::Unjoined`] with the condition, the map and the greatest difference of a coordinate.
pub(super) fn agree<const J: usize>(
    condition: &'static str,
    map: usize,
    (a, b): (&[Near; J], &[Near; J]),
    tolerance: i64,
) -> Result<(), Error> {
    let gap = gap(a, b);
    if gap > tolerance {
        return Err(Error::Unjoined { condition, map, gap: wide(gap) });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Wide;

    #[test]
    fn a_condition_fails_by_its_greatest_difference() {
        let near = |v: f64| Near::from_num(v);
        let (a, b) = ([near(1.0), near(0.0)], [near(0.25), near(0.5)]);
        let error = agree("T_0 c_1 = T_1 c_0", 1, (&a, &b), 5).unwrap_err();
        assert_eq!(error, Error::Unjoined { condition: "T_0 c_1 = T_1 c_0", map: 1, gap: Wide::lit("0.75") });
        let close = [a[0] - Near::DELTA * 5, a[1]];
        assert!(agree("", 0, (&a, &close), 5).is_ok() && agree("", 0, (&a, &close), 4).is_err());
        let ends = ([Near::MIN; 1], [Near::MAX; 1]);
        assert!(matches!(agree("", 0, (&ends.0, &ends.1), 9), Err(Error::Unjoined { gap, .. }) if gap > 15));
    }
}
