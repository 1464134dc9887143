//! Julia sets of any constant: what is known of them, where they are, random points of them.

use std::cell::Cell as Counter;

use attractor::escape::{Connectedness, JuliaCover, JuliaSet, MAX_DWELL, SimpleCase, Stability, View};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::{Field, Point2};
use embedded_graphics::geometry::Size;
use proptest::prelude::*;

use super::{Drawn, complex, fuzz, part_of_a_row, size, wide};

fn float(z: Complex<Wide>) -> (f64, f64) {
    (z.re.to_num(), z.im.to_num())
}

/// Constants within 2, on its rim, and where formulas change.
fn constant() -> impl Strategy<Value = Complex<Wide>> {
    let special = [(0, 0), (-2, 0), (1, 0), (0, 2), (0, -2), (2, 0), (-3, 1), (1, 1)];
    let quarters = prop::sample::select(special.to_vec())
        .prop_map(|(re, im)| Complex::new(Wide::from_num(re) / 4, Wide::from_num(im) / 4));
    let wholes = prop::sample::select(special.to_vec())
        .prop_map(|(re, im)| Complex::new(Wide::from_num(re), Wide::from_num(im)));
    prop_oneof![2 => complex(), 1 => quarters, 1 => wholes]
}

#[test]
fn what_is_known_of_any_set() {
    let limit = prop_oneof![0..400_u32, any::<u32>()];
    fuzz((constant(), limit, any::<u64>()), 50, |(c, limit, seed)| {
        let Ok(set) = JuliaSet::new(c) else { return false };
        let stored = set.constant();
        let (a, b): (f64, f64) = (stored.re.to_num(), stored.im.to_num());
        assert!(
            a.hypot(b) <= 2.0 && (a - float(c).0).abs().max((b - float(c).1).abs()) < 2e-9,
            "{c:?}: {stored:?}"
        );
        let [outer, inner] = set.fixed_points();
        for point in [outer.point, inner.point] {
            let (x, y): (f64, f64) = (point.re.to_num(), point.im.to_num());
            let off = (x * x - y * y + a - x).hypot(2.0 * x * y + b - y);
            assert!(off < 4e-8, "{off} at {point:?}");
        }
        assert_ne!(outer.stability, Stability::Attracting);
        // proven without a step, or by no more steps than allowed
        match set.connectedness(limit) {
            Ok(Connectedness::Connected) => {
                assert!(a.hypot(b) < 1.26 || set.simple_case() == Some(SimpleCase::Segment))
            }
            Ok(Connectedness::BoundedFor(steps)) => assert_eq!(steps, limit),
            Ok(Connectedness::Dust(steps)) => assert!(steps < limit),
            Err(_) => assert!(limit == 0 || limit > MAX_DWELL),
        }
        assert_eq!(set.simple_case() == Some(SimpleCase::UnitCircle), (a, b) == (0.0, 0.0));
        let radius: f64 = set.radius().to_num();
        assert!((1.0..=2.0 + 2e-8).contains(&radius), "{radius}");
        // a word a point, and all points within the radius
        let words = Counter::new(0);
        let inside = |x: f64, y: f64| x.hypot(y) <= radius + 1e-6;
        let mut walk = set.backward_iteration(Drawn::new(seed, &words));
        for p in walk.by_ref().take(60) {
            assert!(inside(p.x.to_num(), p.y.to_num()), "{p:?} beyond {radius}");
        }
        let next = walk.next_preimage();
        assert!(
            inside(next.re.to_num(), next.im.to_num()) && words.get() == 61,
            "{next:?}, {} words",
            words.get()
        );
        let first: Option<Point2> = set.seeded_backward_iteration(seed).next();
        assert_eq!(first, set.backward_iteration(Drawn::new(seed, &words)).next());
        true
    });
}

#[test]
fn covers_of_any_view() {
    let width = prop_oneof![2 => (1_i64 << 30..1 << 51).prop_map(Wide::from_bits), 1 => wide()];
    let description = ((constant(), complex(), width, size()), (complex(), wide()), any::<[u32; 3]>());
    fuzz(description, 30, |((c, centre, width, size), (middle, length), at)| {
        let (Ok(set), Ok(view)) = (JuliaSet::new(c), View::new(centre, width, size)) else { return false };
        // what holds all of the set meets it; what is far from it does not
        let (x, y) = float(middle);
        let radius: f64 = length.to_num();
        let may_meet = set.may_meet(middle, length);
        let known = (x.hypot(y) + 2.001 < radius).then_some(true);
        let known = known.or((x.abs().max(y.abs()) > 2.001 + radius.max(0.0)).then_some(false));
        assert!(known.is_none_or(|known| known == may_meet), "{middle:?}, {radius}: {may_meet}");
        let count = set.sixteenths(middle, length);
        assert!(count <= 16 && (count == 0 || x.abs().max(y.abs()) < 8.0), "{count} at {middle:?}");
        let Ok(cover) = JuliaCover::new(view, set) else {
            assert!(view.pitch() > 4);
            return true;
        };
        let Size { width, height } = cover.size();
        part_of_a_row(&cover, at[0], at[1], (at[2] % 64) as usize);
        let x = at[1] % width;
        let row: Vec<u8> = cover.row(at[0] % height, x..width.min(x + 12)).collect();
        assert!(row.len() == width.min(x + 12) as usize - x as usize && row.iter().all(|count| *count <= 16));
        // beyond the picture there is nothing
        assert_eq!(cover.row(u32::MAX, width..u32::MAX).count(), 0);
        true
    });
}
