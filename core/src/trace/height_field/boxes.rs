//! The box test: whether a ray passes through the box of a node.
//!
//! The ray is cut to the part over the node already: what is left to compare are two heights and the range of
//! `f g` (eq. 49-50). No plane of constant height is intersected. Formats: 24 fractional bits.

use crate::fif::Cell;
use crate::num::Real;

/// Whether a ray that runs from height `z_in` to `z_out` over a part of the surface meets the part's box: the
/// test of which a walk consists.
///
/// Domain: heights of magnitude below 64, and so the products of the ranges' ends; others wrap.
#[inline]
pub fn meets(f: &Cell, g: &Cell, z_in: Real, z_out: Real) -> bool {
    meets_bits(f, g, z_in.to_bits(), z_out.to_bits())
}

#[inline(always)]
pub(crate) fn meets_bits(f: &Cell, g: &Cell, z_in: i32, z_out: i32) -> bool {
    let [a, b, c, d] = [f.min, f.max, g.min, g.max].map(Real::to_bits);
    if (b | d | a & c) < 0 {
        return meets_any(f, g, z_in, z_out);
    }
    // no maximum is negative and at most one minimum: the maximum is that of the maxima
    let top = product(b, d).wrapping_add(1);
    if z_in > top && z_out > top {
        return false;
    }
    if z_in >= top || z_out >= top {
        return true;
    }
    // a negative minimum is furthest down times the other's maximum
    let low = product(if c < 0 { b } else { a }, if a < 0 { d } else { c });
    z_in >= low || z_out >= low
}

/// The same whatever the signs.
#[cold]
#[inline(never)]
fn meets_any(f: &Cell, g: &Cell, z_in: i32, z_out: i32) -> bool {
    let (low, high) = range(f, g);
    z_in.min(z_out) <= high && z_in.max(z_out) >= low
}

#[inline(always)]
fn product(a: i32, b: i32) -> i32 {
    // HeightField::new has checked that the products stay below 64
    ((i64::from(a) * i64::from(b)) >> 24) as i32
}

/// Bounds of the product of two ranges (eq. 49), 24 fractional bits, outward by at most one unit more than
/// need be.
#[inline(never)]
pub(crate) fn range(f: &Cell, g: &Cell) -> (i32, i32) {
    let [a, b, c, d] = [f.min, f.max, g.min, g.max].map(Real::to_bits);
    let ends = [product(a, c), product(a, d), product(b, c), product(b, d)];
    let (mut low, mut high) = (ends[0], ends[0]);
    for end in ends {
        (low, high) = (low.min(end), high.max(end));
    }
    (low, high.wrapping_add(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ranges of every sign, whose products are no multiples of a unit.
    fn cells() -> impl Iterator<Item = Cell> + Clone {
        let ends = [-(3 << 24) - 1, -(1 << 24), -12_345_677, -1, 0, 1, 4_097, (1 << 24) - 1, (2 << 24) + 3];
        ends.into_iter().enumerate().flat_map(move |(i, min)| {
            let cell =
                move |max: i32| Cell { min: Real::from_bits(min), max: Real::from_bits(max), ..Cell::ZERO };
            ends.into_iter().skip(i).map(cell)
        })
    }

    /// The exact ends with 48 fractional bits.
    fn exact(f: &Cell, g: &Cell) -> (i64, i64) {
        let [a, b, c, d] = [f.min, f.max, g.min, g.max].map(|end| i64::from(end.to_bits()));
        let ends = [a * c, a * d, b * c, b * d];
        (ends.into_iter().min().unwrap(), ends.into_iter().max().unwrap())
    }

    #[test]
    fn a_range_holds_every_product_and_hardly_more() {
        let mut between = 0;
        for f in cells() {
            for g in cells() {
                let (low, high) = range(&f, &g);
                let (exact_low, exact_high) = exact(&f, &g);
                assert!(
                    i64::from(low) << 24 <= exact_low && exact_high <= i64::from(high) << 24,
                    "{f:?} {g:?}"
                );
                assert!(exact_low - (i64::from(low) << 24) < 1 << 24);
                assert!((i64::from(high) << 24) - exact_high <= 1 << 24);
                between += usize::from(exact_high & 0xff_ffff != 0);
            }
        }
        assert!(between > 500, "{between}");
    }

    /// A ray meets a box exactly where its heights touch the range: just above, just below, on both ends.
    #[test]
    fn a_ray_meets_what_its_heights_touch() {
        let (mut met, mut missed) = (0, 0);
        for f in cells() {
            for g in cells() {
                let (low, high) = range(&f, &g);
                for (z_in, z_out) in [
                    (high, high + 9),
                    (high + 1, high + 9),
                    (low - 9, low),
                    (low - 9, low - 1),
                    (low - 2, high + 2),
                    (low, low),
                    (high, high),
                ] {
                    let expected = z_in.max(z_out) >= low && z_in.min(z_out) <= high;
                    assert_eq!(meets_bits(&f, &g, z_in, z_out), expected, "{f:?} {g:?} {z_in} {z_out}");
                    assert_eq!(meets_bits(&f, &g, z_out, z_in), expected, "{f:?} {g:?} {z_out} {z_in}");
                    if expected { met += 1 } else { missed += 1 }
                }
            }
        }
        assert!(met > 1000 && missed > 1000);
    }

    /// One height on the surface and one outside: the walk itself needs no more than the public name of the
    /// test.
    #[test]
    fn a_box_is_met_by_name_as_by_bits() {
        let cell =
            |min: i32, max: i32| Cell { min: Real::from_num(min), max: Real::from_num(max), ..Cell::ZERO };
        let at = |z_in: i32, z_out: i32| {
            meets(&cell(1, 2), &cell(3, 4), Real::from_num(z_in), Real::from_num(z_out))
        };
        // products from 3 to 8
        assert_eq!([at(2, 2), at(3, 3), at(8, 8), at(9, 9), at(9, 2)], [false, true, true, false, true]);
    }

    /// 128 less a unit is the largest top that there is, and wraps where a unit is added.
    #[test]
    fn products_at_the_end_of_the_format_are_compared() {
        let cell = |min, max| Cell { min, max, ..Cell::ZERO };
        let one = cell(Real::ZERO, Real::ONE);
        let low = Real::from_num(3);
        for (end, other) in [(Real::MAX, Real::MAX), (Real::MIN, -Real::ONE), (Real::MIN, Real::MAX)] {
            let f = cell(end.min(other), end.max(other));
            let _ =
                [meets(&f, &one, low, Real::MAX), meets(&one, &f, Real::MIN, low), meets(&f, &f, low, low)];
        }
        assert!(meets(&cell(Real::ZERO, low), &one, Real::MIN, Real::MAX));
    }
}
