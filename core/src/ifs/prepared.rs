//! A map as the chaos game applies it: what does not depend on the point is done before.
//!
//! The translation stands with the 54 fractional bits of a product and the half unit that rounds: both
//! products are added to it, and a shift is left. A machine without a long product multiplies by halves,
//! `v = vh 2^16 + vl` with `vl` signed: `l x + m y = H 2^32 + M 2^16 + L` for `H = lh xh + mh yh`,
//! `M = lh xl + ll xh + mh yl + ml yh`, `L = ll xl + ml yl`. It keeps the coefficients in halves, and puts
//! only the upper part of the sum together. A machine without a carry adds 64 bits in four instructions and
//! wins nothing by a translation that takes two words: there nothing is prepared, and the maps stand once.

use super::affine::Affine;
#[cfg(any(test, not(no_long_product)))]
use super::affine::{product_q54, translated};
use crate::num::{Real, Unit};
use crate::plane::Point2;

impl Affine {
    /// As [`PreparedMap::apply_inside`], with nothing prepared.
    #[cfg(any(test, no_carry))]
    #[inline(always)]
    pub(super) fn apply_inside(&self, p: Point2) -> Point2 {
        let row = |l: Unit, m: Unit, t: Real| {
            let sum = translated(t).wrapping_add(product_q54(l, p.x)).wrapping_add(product_q54(m, p.y));
            Real::from_bits((sum >> 30) as i32)
        };
        Point2::new(row(self.a, self.b, self.e), row(self.c, self.d, self.f))
    }
}

/// A contraction of a system, prepared. Size: 32 bytes; 40 on a machine without a long product.
#[cfg(not(no_carry))]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PreparedMap {
    x: Row,
    y: Row,
}

#[cfg(not(any(no_carry, no_long_product)))]
type Row = Whole;
#[cfg(no_long_product)]
type Row = Halves;

#[cfg(not(no_carry))]
impl PreparedMap {
    /// The map, prepared: a contraction.
    pub(super) const fn new(map: &Affine) -> Self {
        Self { x: Row::new(map.a, map.b, map.e), y: Row::new(map.c, map.d, map.f) }
    }

    /// The image of a point whose image is known to lie in the format: an [`super::Ifs`] proves that for the
    /// points of its invariant disc.
    #[inline(always)]
    pub(super) fn apply_inside(&self, p: Point2) -> Point2 {
        Point2::new(self.x.apply(p), self.y.apply(p))
    }
}

/// One coordinate of the image, `l x + m y + t`.
// In this order two loads bring four words on Armv7-M.
#[cfg(any(test, not(any(no_carry, no_long_product))))]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
struct Whole {
    l: Unit,
    m: Unit,
    t: i64,
}

#[cfg(any(test, not(any(no_carry, no_long_product))))]
impl Whole {
    const fn new(l: Unit, m: Unit, t: Real) -> Self {
        Self { l, m, t: translated(t) }
    }

    /// With `|x|, |y| <= 64` and coefficients of at most 1 the sum stays below `2^62`.
    #[inline(always)]
    fn apply(&self, p: Point2) -> Real {
        let sum = self.t.wrapping_add(product_q54(self.l, p.x)).wrapping_add(product_q54(self.m, p.y));
        Real::from_bits((sum >> 30) as i32)
    }
}

/// The same by halves.
// In this order the compiler spills the fewest.
#[cfg(any(test, no_long_product))]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
struct Halves {
    lh: i32,
    mh: i32,
    ll: i32,
    ml: i32,
    t: Real,
}

#[cfg(any(test, no_long_product))]
impl Halves {
    const fn new(l: Unit, m: Unit, t: Real) -> Self {
        /// The lower half above `-2^15` and up to `2^15`.
        const fn split(v: Unit) -> [i32; 2] {
            let v = v.to_bits();
            let low = -((v.wrapping_neg() as i16) as i32);
            [v.wrapping_sub(low) >> 16, low]
        }
        let ([lh, ll], [mh, ml]) = (split(l), split(m));
        Self { lh, mh, ll, ml, t }
    }

    /// `|L| <= 2^31`, and `2^31` itself is not reached: no half of a coefficient is `-2^15`. A contraction
    /// has `l^2 + m^2 <= 1`, so that `|M| <= sqrt(2) 2^14 2^15 + 2 2^14 2^15 < 2^31 - 2^17`.
    #[inline(always)]
    fn apply(&self, p: Point2) -> Real {
        let split = |v: Real| {
            let low = i32::from(v.to_bits() as i16);
            (v.to_bits().wrapping_sub(low) >> 16, low)
        };
        let ((xh, xl), (yh, yl)) = (split(p.x), split(p.y));
        let Self { lh, mh, ll, ml, .. } = *self;
        let top = lh.wrapping_mul(xh).wrapping_add(mh.wrapping_mul(yh)) << 2;
        let top = top.wrapping_add(self.t.to_bits());
        let low = ll.wrapping_mul(xl).wrapping_add(ml.wrapping_mul(yl)) >> 16;
        let cross = low.wrapping_add(ll.wrapping_mul(xh)).wrapping_add(ml.wrapping_mul(yh));
        let cross = cross.wrapping_add(lh.wrapping_mul(xl)).wrapping_add(mh.wrapping_mul(yl));
        let middle = cross.wrapping_add(1 << 13) >> 14;
        Real::from_bits(top.wrapping_add(middle))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    /// Both ways, and the exact sum rounded.
    fn agree([l, m, t]: [i32; 3], [x, y]: [i32; 2]) {
        let exact = i128::from(l) * i128::from(x) + i128::from(m) * i128::from(y);
        let want = (exact + (i128::from(t) << 30) + (1 << 29)) >> 30;
        // a system's disc keeps the image in the format
        let Ok(want) = i32::try_from(want) else { return };
        let p = Point2::new(Real::from_bits(x), Real::from_bits(y));
        let (l, m, t) = (Unit::from_bits(l), Unit::from_bits(m), Real::from_bits(t));
        assert_eq!(Whole::new(l, m, t).apply(p).to_bits(), want, "{l} {m} {t} {p:?}");
        assert_eq!(Halves::new(l, m, t).apply(p).to_bits(), want, "{l} {m} {t} {p:?}");
    }

    /// Where the halves are the ends of theirs, over the square that a system may fill.
    #[test]
    fn both_ways_give_the_rounded_sum() {
        let ends = [0, 1, 32_767, 32_768, 32_769, 65_535, 98_304, (1 << 30) - 32_768, (1 << 30) - 1, 1 << 30];
        let ends = || ends.into_iter().flat_map(|v: i32| [v, -v]);
        let mut tried = 0;
        for l in ends() {
            let room = |m: &i32| i64::from(l).pow(2) + i64::from(*m).pow(2) <= 1 << 60;
            for m in ends().filter(room) {
                for x in ends() {
                    for y in ends() {
                        agree([l, m, 0], [x, y]);
                        tried += 1;
                    }
                }
            }
        }
        assert!(tried > 100_000, "{tried}");
    }

    #[test]
    fn a_step_is_the_map() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(5);
        let mut word = |reach: u32| rng.next_u32() as i32 >> (31 - reach);
        let mut maps: std::vec::Vec<Affine> =
            catalogue::ALL.iter().flat_map(|a| a.maps.iter().copied()).collect();
        while maps.len() < 400 {
            let linear = [(); 4].map(|()| Unit::from_bits(word(30)));
            let map = Affine::new(linear, [Real::from_bits(word(29)), Real::from_bits(word(29))]);
            if map.is_contraction() {
                maps.push(map);
            }
        }
        for map in maps {
            for _ in 0..500 {
                let p = Point2::new(Real::from_bits(word(30)), Real::from_bits(word(30)));
                let image = map.apply(p);
                if [image.x, image.y].iter().all(|v| v.abs() < Real::MAX) {
                    assert_eq!(PreparedMap::new(&map).apply_inside(p), image, "{map:?} {p:?}");
                    assert_eq!(map.apply_inside(p), image, "{map:?} {p:?}");
                }
                let rows = [
                    [map.a.to_bits(), map.b.to_bits(), map.e.to_bits()],
                    [map.c.to_bits(), map.d.to_bits(), map.f.to_bits()],
                ];
                for row in rows {
                    agree(row, [p.x.to_bits(), p.y.to_bits()]);
                }
            }
        }
    }
}
