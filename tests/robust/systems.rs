//! Copiers, densities and moments of any system.

use attractor::ifs::{Affine, Ifs};
use attractor::num::{Alias, Real, Unit};
use attractor::plane::Density;
use attractor::plane::{Field, Point2, Window};
use embedded_graphics::geometry::Size;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{fuzz, part_of_a_row, point, size, word};

fn system() -> impl Strategy<Value = Option<Ifs<5>>> {
    let tame = (vec(-(1 << 29)..=1 << 29, 4), vec(-(20 << 24)..=20 << 24, 2));
    let wild = (vec(word(), 4), vec(word(), 2));
    let maps = vec(prop_oneof![9 => tame, 1 => wild], 1..=5);
    maps.prop_map(|maps| {
        let affine = |(l, t): &(Vec<i32>, Vec<i32>)| {
            let linear = [l[0], l[1], l[2], l[3]].map(Unit::from_bits);
            Affine::new(linear, [t[0], t[1]].map(Real::from_bits))
        };
        let maps: Vec<_> = maps.iter().map(affine).collect();
        Ifs::<5>::proportional_to_determinant(&maps).ok()
    })
}

#[test]
fn copiers_of_any_shape() {
    fuzz((system(), vec(point(), 0..4), any::<u32>()), 20, |(system, shape, order)| {
        let Some(system) = system else { return false };
        let _ = system.copier::<6>(&shape, order).map(|copier| copier.points().take(50).count());
        let Ok(copier) = system.copier::<6>(&shape, order % 7) else { return false };
        let images = system.maps().len().pow(order % 7);
        assert_eq!(copier.clone().points().take(5000).count(), (images * shape.len()).min(5000));
        assert_eq!(copier.path().take(5000).count(), (images * shape.len()).min(5000));
        true
    });
}

#[test]
fn moments_of_any_system() {
    fuzz(system(), 20, |system| {
        let Some(system) = system else { return false };
        let Ok(moments) = system.moments() else { return false };
        let bounds = system.bounds();
        let [x, y] = [moments.mean[0], moments.mean[1]].map(|m| m.to_num::<f64>());
        let slack = 1e-3;
        assert!(
            bounds.min.x.to_num::<f64>() - slack <= x && x <= bounds.max.x.to_num::<f64>() + slack,
            "{x}: {bounds:?}"
        );
        assert!(
            bounds.min.y.to_num::<f64>() - slack <= y && y <= bounds.max.y.to_num::<f64>() + slack,
            "{y}: {bounds:?}"
        );
        true
    });
}

#[test]
fn densities_of_any_points() {
    let description = (vec(point(), 0..300), (point(), point()), size(), any::<[u32; 3]>(), 0..70_000_usize);
    fuzz(description, 5, |(points, (a, b), wanted, at, length)| {
        let corner = |f: fn(Real, Real) -> Real| Point2::new(f(a.x, b.x), f(a.y, b.y));
        let bounds = attractor::plane::Bounds2 { min: corner(Real::min), max: corner(Real::max) };
        let Ok(window) = Window::stretch(bounds, wanted) else { return false };
        let Size { width, height } = window.size();
        // a buffer of the wrong length is refused
        let mut wrong = vec![0_u16; length];
        let pixels = width as usize * height as usize;
        assert!(Density::new(window, &mut wrong).is_ok() == (length >= pixels));
        if pixels > 1 << 16 {
            return false;
        }
        let (mut counts, mut maps) = (vec![0_u8; pixels], vec![0_u8; pixels]);
        let mut density = Density::new(window, &mut counts).expect("one count a pixel");
        for (i, p) in points.iter().enumerate() {
            density.record(*p);
            // points and density agree on what is seen
            let seen = points[..=i].iter().filter(|q| window.pixel(**q).is_some()).count();
            let total: usize = density.counts().iter().map(|c| usize::from(*c)).sum();
            assert!(total == seen || density.peak() == 255, "{total} of {seen}");
        }
        let mut density = density.with_maps(&mut maps).expect("one map a pixel");
        density.record_from(Point2::new(b.x, a.y), u8::MAX);
        for one_in in [0, 1, at[0], u32::MAX] {
            let full = density.quantile(one_in);
            part_of_a_row(&density.linear(full), at[0] % height, at[1], 3);
            part_of_a_row(&density.logarithmic(full), at[0] % height, at[1], 3);
        }
        assert!(density.linear(0).row(u32::MAX, 0..9).count() <= 9);
        true
    });
}

#[test]
fn tables_of_any_weights() {
    fuzz((vec(any::<u32>(), 0..300), any::<[u32; 8]>()), 50, |(weights, draws)| {
        let Ok(table) = Alias::<256>::new(&weights) else { return false };
        let edges = [0, 1, u32::MAX, u32::MAX - 1, 1 << 31];
        for word in draws.into_iter().chain(edges) {
            let item = table.pick(word);
            assert!(weights[item] > 0, "item {item} of weight 0");
        }
        true
    });
}
