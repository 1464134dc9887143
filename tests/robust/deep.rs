//! Deep views of any centre and width, in every arithmetic.

use attractor::escape::{
    Arithmetic, Complex, DeepMandelbrot, DeepView, Distance, EscapeTime, Interior, MAX_DWELL, MAX_PERIOD,
    OrbitPoint, Smooth, View,
};
use attractor::num::{Limbs, Wide};
use embedded_graphics::geometry::Size;
use proptest::prelude::*;

use super::{complex, fuzz, part_of_a_row, size, wide};

const LIMBS: usize = 6;

/// A number of any size down to the last limb, partly near -2, 0 or 1.
fn limbs() -> impl Strategy<Value = Limbs<LIMBS>> {
    let near = (prop::sample::select(vec![-2, -1, 0, 1]), any::<[u32; LIMBS]>(), 3..160_u32).prop_map(
        |(whole, bits, down)| {
            let whole = Limbs::from_wide(Wide::from_num(whole)).expect("small");
            let mut rest = Limbs::from_limbs(bits).magnitude();
            for _ in 0..down / 30 {
                rest = rest.divided(1 << 30).0;
            }
            whole.plus(&rest.divided(1 << (down % 30)).0)
        },
    );
    prop_oneof![4 => near, 1 => any::<[u32; LIMBS]>().prop_map(Limbs::from_limbs)]
}

fn width() -> impl Strategy<Value = Limbs<LIMBS>> {
    let power = (0..190_usize, any::<[u32; LIMBS]>()).prop_map(|(down, bits)| {
        let mut v = Limbs::from_limbs(bits).magnitude();
        for _ in 0..down / 30 {
            v = v.divided(1 << 30).0;
        }
        v.divided(1 << (down % 30)).0
    });
    prop_oneof![4 => power, 1 => any::<[u32; LIMBS]>().prop_map(Limbs::from_limbs)]
}

#[test]
fn deep_pictures_of_any_view() {
    let small = (1..=24_u32, 1..=24_u32).prop_map(|(w, h)| Size::new(w, h));
    let size = prop_oneof![4 => small, 1 => size()];
    let description =
        (limbs(), limbs(), width(), size, 1..400_u32, any::<[u32; 4]>(), (any::<i32>(), any::<i32>()));
    fuzz(description, 45, |(re, im, width, size, max, at, by)| {
        let Ok(view) = DeepView::<LIMBS>::new(Complex::new(re, im), width, size) else { return false };
        assert!(view.centre() == &Complex::new(re, im) && view.width() == &width);
        view.point(at[0], at[1]);
        assert_eq!(view.point(u32::MAX, u32::MAX), view.point(size.width - 1, size.height - 1));
        let _ = view.pan(i32::MIN, i32::MAX).map(|view| view.point(0, 0));
        let _ = view.pan(by.0, by.1).map(|view| view.point(u32::MAX, u32::MAX));
        let moved = view.pan(by.0 >> 20, by.1 >> 20).unwrap_or(view);
        assert!(moved.panned() == (by.0 >> 20, by.1 >> 20) || moved == view);
        let needed = DeepMandelbrot::orbit_points(&view, max);
        let mut orbit = vec![OrbitPoint::default(); needed.max(max as usize + 1) + 64];
        if needed > 0 {
            assert!(DeepMandelbrot::new(view, max, &mut orbit[..needed - 1]).is_err());
        }
        let all = [Arithmetic::Word64, Arithmetic::Word128, Arithmetic::Perturbed, Arithmetic::PerturbedLong];
        let chosen = all[at[3] as usize % 4];
        for arithmetic in [Arithmetic::of(view.pitch_exponent(), max), chosen] {
            for view in [view, moved] {
                let Ok(set) = DeepMandelbrot::with_arithmetic(view, max, arithmetic, &mut orbit) else {
                    continue;
                };
                assert_eq!((set.view(), set.max_dwell(), set.arithmetic()), (&view, max, arithmetic));
                assert!(set.reference_len() <= max.max(2) as usize);
                let dwell = set.dwell_at(at[0], at[1]);
                assert!(dwell.count <= max);
                let (x, y) = (at[0].min(size.width - 1), at[1].min(size.height - 1));
                assert_eq!(set.dwell_at(x, y), dwell);
                let smooth = Smooth(set).value_at((at[0], at[1]));
                assert!(
                    smooth.is_inside() == dwell.is_inside() && smooth.dwell <= max,
                    "{smooth:?}: {dwell:?}"
                );
                assert_eq!(Distance(set).value_at((at[0], at[1])).is_none(), dwell.is_inside());
                let period = Interior(set).value_at((at[0], at[1]));
                assert!(period.0 <= MAX_PERIOD, "{period:?}");
                assert_eq!(set.line(at[1], size.width..u32::MAX).len(), 0);
                let (x, y) = (at[0] % size.width, at[1] % size.height);
                let skip = (at[2] % 16) as usize;
                part_of_a_row(&set, y, x, skip);
                part_of_a_row(&Smooth(set), y, x, skip);
                part_of_a_row(&Distance(set), y, x, skip);
                part_of_a_row(&Interior(set), y, x, skip);
            }
        }
        true
    });
}

/// Iterations without end: what perturbation and words are asked for at most, and buffers that are too short
/// for it.
#[test]
fn iterations_of_any_number() {
    let size = Size::new(3, 2);
    let views =
        ["1", "1e-9", "1e-20", "1e-50"].map(|width| DeepView::<LIMBS>::parse("-0.1", "0", width, size));
    for (view, max) in views
        .into_iter()
        .flat_map(|view| [0, 1, 2, MAX_DWELL, MAX_DWELL + 1, u32::MAX].map(|max| (view, max)))
    {
        let view = view.expect("a view within the disc");
        let needed = DeepMandelbrot::orbit_points(&view, max);
        let mut short = vec![OrbitPoint::default(); needed.saturating_sub(1).min(1 << 8)];
        let made = DeepMandelbrot::new(view, max, &mut short).is_ok();
        assert_eq!(made, needed == 0 && (1..=MAX_DWELL).contains(&max), "{max}");
    }
}

/// Texts, and shallow views as deep ones.
#[test]
fn deep_views_of_any_text_or_view() {
    let number = "-?[0-3]?(\\.[0-9]{0,40})?(e-[0-9]{1,2})?";
    let text = || prop_oneof![8 => number.prop_map(String::from), 1 => any::<String>()];
    let near = (-5_i64 << 46..5_i64 << 46, -5_i64 << 46..5_i64 << 46);
    let near = near.prop_map(|(re, im)| Complex::new(Wide::from_bits(re), Wide::from_bits(im)));
    let width = (any::<u64>(), 16..34_u32).prop_map(|(bits, down)| Wide::from_bits((bits >> down) as i64));
    let shallow = (prop_oneof![9 => near, 1 => complex()], prop_oneof![9 => width, 1 => wide()], size());
    fuzz(
        (text(), text(), text(), shallow, any::<[u32; 2]>()),
        60,
        |(re, im, width, (centre, wide, size), at)| {
            let small = Size::new(size.width.clamp(1, 30), size.height.clamp(1, 30));
            let parsed = DeepView::<LIMBS>::parse(&re, &im, &width, small);
            for view in [parsed, DeepView::parse(&re, &im, "1e-12", small)].into_iter().flatten() {
                view.point(at[0], at[1]);
                let mut orbit = [OrbitPoint::default(); 50];
                let set = DeepMandelbrot::new(view, 50, &mut orbit);
                assert!(set.is_err() || view.pitch_exponent() > -200);
            }
            let _ = DeepView::<2>::parse(&re, &im, &width, small);
            let _ = DeepView::<1>::parse(&re, &im, &width, small);
            let Ok(view) = View::new(centre, wide, small) else { return false };
            let view = view.pan(at[0] as i32 >> 20, at[1] as i32 >> 20).unwrap_or(view);
            let Ok(deep) = DeepView::<LIMBS>::try_from(view) else { return false };
            assert!(DeepView::<1>::try_from(view).is_err());
            assert_eq!((deep.panned(), deep.size()), (view.panned(), small));
            for (column, row) in [(0, 0), (at[0], at[1]), (u32::MAX, u32::MAX)] {
                let (near, exact) = (view.point(column, row), deep.point(column, row));
                for (near, exact) in [(near.re, exact.re), (near.im, exact.im)] {
                    assert!((exact.to_wide() - near).abs() <= Wide::from_bits(2), "{near} for {exact:?}");
                }
            }
            true
        },
    );
}
