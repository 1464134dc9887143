//! Deep views, and what colours and buffers make of shallow and deep pictures.

use attractor::draw::{Equalised, gradients};
use attractor::escape::{
    Arithmetic, Buffered, DeepMandelbrot, DeepView, Distance, Filled, Interior, Mandelbrot, OrbitPoint,
    Smooth, View,
};
use attractor::num::Complex;
use attractor::num::{Limbs, Wide};
use attractor::plane::Field;
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
    fuzz(description, 20, |(re, im, width, size, max, at, by)| {
        let Ok(view) = DeepView::<LIMBS>::new(Complex::new(re, im), width, size) else { return false };
        view.point(at[0], at[1]);
        let _ = view.pan(by.0, by.1).map(|view| view.point(u32::MAX, u32::MAX));
        let moved = view.pan(by.0 >> 20, by.1 >> 20).unwrap_or(view);
        let needed = DeepMandelbrot::orbit_points(&view, max);
        let mut orbit = vec![OrbitPoint::default(); needed.max(max as usize + 1) + 64];
        if needed > 0 {
            assert!(DeepMandelbrot::new(view, max, &mut orbit[..needed - 1]).is_err());
        }
        let all = [Arithmetic::Word64, Arithmetic::Word128, Arithmetic::Perturbed, Arithmetic::PerturbedLong];
        let chosen = all[at[3] as usize % 4];
        for arithmetic in [Arithmetic::of(view.pitch_exponent(), max), chosen] {
            for view in [view, moved] {
                let Ok(set) = DeepMandelbrot::new_in(view, max, arithmetic, &mut orbit) else {
                    continue;
                };
                assert!(set.dwell_at(at[0], at[1]).count <= max);
                let (x, y) = (at[0] % size.width, at[1] % size.height);
                let skip = (at[2] % 16) as usize;
                part_of_a_row(&set, y, x, skip);
                part_of_a_row(&Smooth(&set), y, x, skip);
                part_of_a_row(&Distance(&set), y, x, skip);
                part_of_a_row(&Interior(&set), y, x, skip);
            }
        }
        true
    });
}

/// What needs a buffer, over a picture small enough to be computed whole.
#[test]
fn buffers_and_colourings_of_any_view() {
    let size = (1..=20_u32, 1..=20_u32).prop_map(|(w, h)| Size::new(w, h));
    let width = prop_oneof![wide(), (1_i64 << 22..1 << 50).prop_map(Wide::from_bits)];
    let description =
        (complex(), width, size, 1..200_u32, any::<[u32; 2]>(), (-30..30_i32, -30..30_i32), 0..900_usize);
    fuzz(description, 20, |(centre, width, size, max, at, by, length)| {
        let Ok(view) = View::new(centre, width, size) else { return false };
        let set = Mandelbrot::new(view, max).expect("a limit above 0");
        let pixels = (size.width * size.height) as usize;
        let plain: Vec<_> = (0..size.height).flat_map(|y| set.row(y, 0..size.width)).collect();
        for y in 0..size.height {
            part_of_a_row(&Smooth(&set), y, at[0], 1);
            part_of_a_row(&Distance(&set), y, at[0], 1);
            part_of_a_row(&Interior(&set), y, at[0], 1);
        }
        let mut counts = vec![0_u16; pixels];
        let mut canvas = Buffered::new(set, &mut counts).expect("a count a pixel");
        let shown: Vec<_> = (0..size.height).flat_map(|y| canvas.row(y, 0..size.width)).collect();
        assert_eq!(shown, plain);
        let _ = canvas.pan(by.0, by.1);
        let mut bits = vec![0_u8; length];
        assert_eq!(Filled::new(set, &mut bits).is_ok(), length >= Filled::<'_, Mandelbrot>::bytes(size));
        let mut bits = vec![0_u8; Filled::<'_, Mandelbrot>::bytes(size)];
        let filled = Filled::new(set, &mut bits).expect("two bits a pixel");
        for i in 0..pixels as u32 {
            let (x, y) = (i.wrapping_mul(at[1] | 1) % size.width, i % size.height);
            // filling changes what has no edge of its own, never the outside into something else than the inside
            let (got, exact) = (filled.at(x, y), plain[(y * size.width + x) as usize]);
            assert!(got == exact || got.is_inside(), "{got:?} for {exact:?} at {x}, {y}");
        }
        let mut histogram = vec![0_u32; max as usize];
        if let Ok(palette) = Equalised::new(&set, &mut histogram, gradients::FIRE) {
            for count in [0, 1, max, u32::MAX] {
                palette.level(count);
            }
        }
        true
    });
}
