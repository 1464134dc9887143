//! Limbs, decimal strings and elementary functions of anything.

use attractor::num::{self, Limbs, Reciprocal, Vec3, Wide};
use proptest::prelude::*;

use super::{fuzz, real, vector, wide};

#[test]
fn limbs_of_any_bits() {
    fuzz(
        (any::<[u32; 5]>(), any::<[u32; 5]>(), any::<(u32, i32, i64)>()),
        99,
        |(a, b, (divisor, factor, units))| {
            let (x, y) = (Limbs::<5>::from_limbs(a), Limbs::<5>::from_limbs(b));
            assert_eq!(x.plus(&y).minus(&y), x);
            assert_eq!(x.negated().negated(), x);
            assert_eq!(x.times(&y), y.times(&x));
            assert_eq!(x.plus_units(units).plus_units(units.wrapping_neg()), x);
            let _ = x.times_small(factor);
            let _ = x.magnitude().divided(divisor);
            let (top, wide) = (x.top128(), x.to_wide());
            assert_eq!((top >> 64) as i64, x.top64());
            assert!(wide.is_negative() == x.is_negative() || wide == 0, "{wide}");
            let _ = Limbs::<1>::from_limbs([a[0]]).times(&Limbs::from_limbs([b[0]]));
            true
        },
    );
}

#[test]
fn decimals_of_any_text() {
    let digits = "[-+]?[0-9]{0,140}(\\.[0-9]{0,140})?([eE][-+]?[0-9]{0,12})?";
    let near = "[-+]?[0-7]?(\\.[0-9]{0,110})?([eE]-[0-9]{1,2})?";
    let text = prop_oneof![2 => digits, 4 => near, 1 => any::<String>()];
    fuzz((text, wide()), 20, |(text, value)| {
        let read = text.parse::<Limbs<12>>();
        let _ = (text.parse::<Limbs<1>>(), text.parse::<Limbs<2>>());
        if let Ok(limbs) = read {
            // what fits a wide number is that number, as f64 reads it
            let exact: f64 = text.parse().expect("f64 reads all that is accepted");
            assert!((limbs.to_wide().to_num::<f64>() - exact).abs() < 1e-14, "{text}");
        }
        if let Some(limbs) = Limbs::<12>::from_wide(value) {
            assert_eq!(limbs.to_wide(), value);
        }
        read.is_ok()
    });
}

#[test]
fn elementary_functions_of_anything() {
    let words = (any::<(i64, u64, u32, i32)>(), vector(real()), wide());
    fuzz(words, 99, |((v, w, d, factor), direction, x)| {
        num::mul_high(v, v.wrapping_mul(3));
        num::mul_high_u(w, w);
        for shift in [0, 1, 31, 62, 63, 64, d] {
            num::round_shift(v, shift);
        }
        let reciprocal = Reciprocal::of(w);
        let part = w.min(u64::from(d));
        assert!(reciprocal.quotient(part) <= 1 << 63, "{part} / {w}");
        let scaled = i128::from(num::scale31(v, factor));
        let exact = (i128::from(v) * i128::from(factor)) >> 31;
        assert_eq!(scaled, exact.min(i64::MAX.into()), "{v} {factor}");
        let _ = direction.normalised().map(|n| (n.dot(n), n.cross(n)));
        Vec3::minus(direction, direction);
        let _ = Wide::from(num::Real::saturating_from_num(x));
        true
    });
}
