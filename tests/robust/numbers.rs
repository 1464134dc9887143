//! Limbs, decimal strings and elementary functions of anything.

use attractor::Error;
use attractor::fixed::types::I3F29;
use attractor::num::Complex;
use attractor::num::{self, Angle, Limbs, Real, Reciprocal, Unit, Vec3, Wide, limbs_for};
use attractor::plane::Point2;
use proptest::prelude::*;

use super::{fuzz, real, unit, vector, wide, word};

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
            assert_eq!(x.limbs(), &a);
            for divisor in [0, 1, 2, divisor, u32::MAX] {
                let (quotient, rest) = x.magnitude().divided(divisor);
                assert!(rest < divisor.max(1), "{rest} of {divisor}");
                // 2^(32 n - 1), the magnitude of the least number, is the one that wraps
                assert!(x.magnitude().is_negative() || !quotient.is_negative());
            }
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
    fuzz((text, wide()), 28, |(text, value)| {
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
        assert_eq!(direction.minus(direction), Vec3::default());
        let _ = Wide::from(num::Real::saturating_from_num(x));
        true
    });
}

/// Results in the ranges that are stated, near the exact ones where that costs nothing to say.
#[test]
fn tables_and_roots_of_anything() {
    let v = prop_oneof![
        any::<u64>(),
        (any::<u64>(), 0..64_u32).prop_map(|(v, s)| v >> s),
        Just(0),
        Just(u64::MAX)
    ];
    let part = || word().prop_map(I3F29::from_bits);
    fuzz((v, word(), (part(), part())), 99, |(v, bits, (re, im))| {
        let root = u128::from(num::sqrt(v));
        assert!(root * root <= u128::from(v) && u128::from(v) < (root + 1) * (root + 1), "{v}: {root}");
        let logarithm = f64::from(num::log2(v)) / 16_777_216.0;
        assert!((logarithm - (v.max(1) as f64).log2()).abs() < 1e-7, "{v}: {logarithm}");
        for (d, (mantissa, shift)) in [(1.0, num::reciprocal(v as u32)), (0.5, num::reciprocal_sqrt(v))] {
            let exact = if d == 1.0 { f64::from((v as u32).max(1)) } else { v.max(1) as f64 }.powf(-d);
            let got = f64::from(mantissa) / 2_f64.powi(shift as i32);
            assert!((got / exact - 1.0).abs() < 2_f64.powi(-28), "{v}: {got}");
        }
        let (sin, cos) = num::sin_cos(Angle::from_bits(bits as u32));
        let turn = f64::from(bits as u32) / 2_f64.powi(32) * std::f64::consts::TAU;
        assert!(
            (sin.to_num::<f64>() - turn.sin()).abs().max((cos.to_num::<f64>() - turn.cos()).abs()) < 4e-9
        );
        let (y, x) = (v as i32, bits);
        let angle = num::atan2(y, x).to_num::<f64>();
        let turns = f64::from(y).atan2(f64::from(x)) / std::f64::consts::TAU;
        let off = angle - turns - (angle - turns).round();
        assert!(off.abs() < 5.0 / 2_f64.powi(32), "{y} {x}: {angle}");
        let decay = num::exp_minus(Real::from_bits(bits)).to_num::<f64>();
        assert!((decay - (-Real::from_bits(bits).to_num::<f64>().max(0.0)).exp()).abs() < 4e-9);
        // the root of z: near a branch cut either of the two
        let (x, y): (f64, f64) = (re.to_num(), im.to_num());
        let root = Complex::new(re, im).sqrt();
        let (u, w): (f64, f64) = (root.re.to_num(), root.im.to_num());
        let modulus = x.hypot(y);
        let exact = (((modulus + x) / 2.0).max(0.0).sqrt(), ((modulus - x) / 2.0).max(0.0).sqrt());
        let off = (u - exact.0).abs().max((w.abs() - exact.1).abs());
        assert!(off < 4e-9 && u >= 0.0 && (w == 0.0 || (w < 0.0) == (y < 0.0)), "{x} {y}: {u} {w}");
        true
    });
    for places in [0, 1, 100, usize::MAX / 200_000, usize::MAX] {
        assert!(limbs_for(places) >= 2);
    }
}

#[test]
fn vectors_of_anything() {
    const EYE: Vec3 = Vec3::lit("-128", "127.5", "0");
    const TIP: Point2 = Point2::lit("-128", "127.5");
    const C: Complex<Wide> = Complex::lit("-32768", "0");
    assert!(EYE.x == TIP.x && EYE.y == TIP.y && C.re == Wide::MIN);
    let any_unit = || (unit(), unit(), unit()).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    fuzz((vector(real()), vector(real()), any_unit(), any_unit()), 99, |(from, to, a, b)| {
        for (direction, is_none) in
            [(from.towards(to), from == to), (from.normalised(), from == Vec3::default())]
        {
            assert_eq!(direction.is_none(), is_none);
            let length = direction
                .map_or(1.0, |d| [d.x, d.y, d.z].map(|c| c.to_num::<f64>().powi(2)).iter().sum::<f64>());
            assert!((length - 1.0).abs() < 1e-7, "{length}");
        }
        // what is longer than 1 has a product, if not the right one
        let [low, high] = [Unit::MIN, Unit::MAX].map(|end| Vec3::new(end, end, end));
        let _ = [low.dot(low), low.dot(high), high.dot(high), low.dot(a)];
        let _ =
            [low.cross(low), low.cross(high), low.cross(a), Vec3::new(Unit::MIN, Unit::MAX, a.z).cross(low)];
        let (dot, cross) = (a.dot(b), a.cross(b));
        let component = |v: Vec3<Unit>| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
        let ([p, q, r], [u, v, w]) = (component(a), component(b));
        let near =
            |got: Unit, exact: f64| (-2.0..2.0).contains(&exact).then(|| (got.to_num::<f64>() - exact).abs());
        assert!(near(dot, p * u + q * v + r * w).is_none_or(|off| off < 2e-9));
        for (got, exact) in component(cross).into_iter().zip([q * w - r * v, r * u - p * w, p * v - q * u]) {
            assert!(near(Unit::from_num(got), exact).is_none_or(|off| off < 2e-9));
        }
        true
    });
}

#[test]
fn texts_of_any_bytes_are_refused_by_name() {
    for text in
        ["", "-", "+", ".", "e", "1e", "1e+", "--1", "1e99999999999999999999", "0x1", "\u{2212}1", "1 "]
    {
        let error = text.parse::<Limbs<3>>().expect_err(text);
        assert!(
            matches!(error, Error::Malformed { position, .. } if position <= text.len())
                || text.starts_with("1e9"),
            "{text}: {error}"
        );
    }
}
