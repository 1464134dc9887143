//! Curves and surfaces by control points: numbers of every kind, and addresses at their ends.

use std::ops::ControlFlow;

use attractor::num::{Near, Real, Unit, Vec3, Wide};
use attractor::patch::{
    Address, Barycentric, HeightMoments, Mask, Patch, ProjectedCurve, Sheet, SlopeMoments, Tail, Tensor,
    Type, b_spline, bezier, standard_curve, takagi,
};
use attractor::plane::{Field as _, Point2};
use attractor::trace::{
    Camera, Environment, Filter, FilteredPatch, Finish, Found, Light, PatchCaster, PatchSurface, Quality,
    Ray, Sampling, Surface as _,
};
use embedded_graphics::geometry::Size;

/// Seeded words.
fn words(seed: u64) -> impl FnMut() -> u32 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 32) as u32
    }
}

fn addresses() -> Vec<Address<2>> {
    let ends = [Tail::Zeros, Tail::Last].into_iter().flat_map(|tail| {
        [&[] as &[u8], &[0; 31], &[1; 31], &[0, 1], &[1, 0]]
            .map(|digits| Address::from_digits(digits, tail).unwrap())
    });
    let middle = [(0, 0), (1, 0), (1, 31), (u32::MAX >> 1, 31), (1 << 31, 31), (1, 1)];
    let all: Vec<_> = ends.chain(middle.map(|(index, levels)| Address::of(index, levels).unwrap())).collect();
    for address in &all {
        let parameter = address.parameter();
        assert!((Wide::ZERO..=Wide::ONE).contains(&parameter));
        if let Some(other) = address.other() {
            assert_eq!((other.parameter(), other.shortest().parameter()), (parameter, parameter));
            assert_ne!(other.tail(), address.tail());
        }
        assert!(address.digits().1 <= Address::<2>::MAX_LEVELS);
    }
    assert_eq!(
        (Address::<2>::count(31), Address::<2>::count(32), Address::<1>::count(3)),
        (Some(1 << 31), None, None)
    );
    all
}

/// Any numbers make a curve or are refused; a curve has points at every address.
#[test]
fn any_numbers_make_a_curve_or_an_error() {
    let mut word = words(51);
    let addresses = addresses();
    let (mut made, mut refused) = (0, 0);
    for round in 0..400 {
        let mut near = || Near::from_bits((word() as i32) >> (round % 6));
        let curve = standard_curve([near(), near()], [near(), near()]);
        let columns: [[Near; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| near()));
        assert!(Barycentric::from_columns(columns).is_err());
        let Ok(curve) = curve else {
            refused += 1;
            continue;
        };
        made += 1;
        let points = [Point2::lit("-128", "127"), Point2::lit("127", "127"), Point2::lit("-128", "-128")];
        for address in &addresses {
            let _ = (curve.point(&points, *address), curve.value(&[Real::MIN; 3], *address));
            assert!(curve.weights(*address).iter().all(|weight| weight.abs() < 8));
        }
        let contraction = curve.contraction();
        assert!(contraction.norm() < 1 && contraction.radius() < 32 && contraction.depth() <= 12);
        assert!(contraction.levels(Real::MAX) >= contraction.levels(Real::DELTA));
        let _ = (curve.aspect(), curve.turn(&points), curve.polyline(points, 31).unwrap().nth(3));
        let [left, right] = *curve.maps();
        assert_eq!(ProjectedCurve::new([left, right]), Ok(curve));
        let ends = [[Near::MIN, Near::MIN, Near::MAX], [Near::MAX; 3]];
        assert!(ProjectedCurve::with_ends([left, right], ends).is_err());
        assert_eq!(left.column(3), None);
        let _ = [Real::MIN, Real::MAX].map(|far| left.control_points(&[far, Real::MAX, far]));
        if made > 3 {
            break;
        }
    }
    assert!(made > 3 && refused > 15, "{made} {refused}");
    assert!(ProjectedCurve::<2, 3>::from_grid(&[[Near::MAX; 3]; 5]).is_err());
    assert!(bezier::<18>().is_err() && bezier::<1>().is_err() && b_spline::<5>().is_err());
    assert!(bezier::<17>().is_ok() && Type::ALL[0].curve().is_ok());
}

/// The numbers of the standard grid whose points are halfway between control points.
fn halves() -> [Near; 72] {
    let weights = |k: usize| [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 0.5]][k];
    let boundary = [1, 3, 1, 3].into_iter().flat_map(|k| [weights(k)[0], weights(k)[2]]);
    let inner = [(1, 2), (3, 2), (2, 1), (2, 3), (1, 1), (1, 3), (3, 1), (3, 3)]
        .into_iter()
        .flat_map(|(k, l)| (0..9).filter(|c| *c != 4).map(move |c| weights(k)[c / 3] * weights(l)[c % 3]));
    let all: Vec<Near> = boundary.chain(inner).map(Near::from_num).collect();
    all.try_into().unwrap()
}

#[test]
fn any_numbers_make_a_surface_or_an_error() {
    let mut word = words(53);
    let addresses = addresses();
    let takagi = takagi().unwrap();
    let product = Tensor::<2, 3, 3, 9>::new(takagi, takagi).unwrap();
    assert!(product.factors() == (&takagi, &takagi) && product.contraction().depth() > 0);
    let mut surfaces = 0;
    for round in 0..30 {
        // small changes of what is a surface, and large ones
        let mut near = |by: i32| Near::from_bits((word() as i32) >> (round % 3 * 4 + by));
        let mut numbers = halves();
        numbers.iter_mut().for_each(|number| *number = number.saturating_add(near(1)));
        let patch = Patch::standard(&numbers);
        let mut numbers =
            [[1, 4, 6, 4, 1], [4, 16, 0, 16, 4], [6, 0, 0, 24, 6], [4, 16, 24, 16, 4], [1, 4, 6, 4, 1]]
                .as_flattened()
                .iter()
                .enumerate()
                .filter(|(k, _)| ![6, 7, 11, 12].contains(k))
                .map(|(_, n)| Near::from_bits(n << 22).saturating_add(near(1)));
        let mask = Mask::from_numbers(&std::array::from_fn(|_| numbers.next().unwrap()));
        drop(numbers);
        let _ = Mask::new(std::array::from_fn(|_| std::array::from_fn(|_| near(0))));
        for s in &addresses {
            for t in &addresses {
                let at = [*s, *t];
                if let Ok(patch) = &patch {
                    let _ = (patch.weights(at), patch.height(&[Real::MIN; 9], at));
                }
                if let Ok(mask) = &mask {
                    let extremes = std::array::from_fn(|k| if k % 3 == 0 { Real::MIN } else { Real::MAX });
                    let _ = mask.height(&extremes, at);
                    assert_eq!(mask.height(&[Real::MAX; 16], at), Real::MAX);
                }
                let _ = (product.weights(at), product.height(&[Real::MIN; 9], at));
            }
        }
        if let Ok(patch) = patch {
            surfaces += 1;
            assert!(patch.boundary().is_ok() && patch.map(2, 0).is_none() && patch.contraction().norm() < 1);
        }
        if let Ok(mask) = mask {
            surfaces += 1;
            let _ = (mask.entries(), mask.contraction());
            let heights = [Real::ONE; 25];
            let sheet = Sheet::<Mask, 16>::new(&mask, &heights, 2).unwrap();
            let extremes = std::array::from_fn(|k| if k % 3 == 0 { Real::MIN } else { Real::MAX });
            let (of_heights, of_slopes) = (HeightMoments::new(&mask), SlopeMoments::new(&mask));
            for parts in [0, 1, 1 << 20, u32::MAX] {
                if let Ok(moments) = of_heights {
                    assert_eq!(moments.mean(&[Real::MAX; 16]), Real::MAX);
                    let _ = (moments.over(&extremes, parts), moments.over(&[Real::MIN; 16], parts));
                }
                if let Ok(moments) = of_slopes {
                    let _ = moments.over(&extremes, parts);
                }
            }
            for index in [0, 1, 7, 1 << 31, u32::MAX] {
                for levels in [0, 1, 30, 31, 32, u32::MAX] {
                    let _ = (sheet.at([index, 3], levels), sheet.mean_normal([3, index], levels));
                    let _ = sheet.part([index, 3], levels);
                    for tolerance in [Real::MIN, Real::ZERO, Real::MAX] {
                        let _ = sheet.normal([index, 3], levels, tolerance);
                    }
                }
            }
            for depth in [0, 3, 12, 13, u32::MAX] {
                let Ok(surface) = PatchSurface::new(sheet, depth) else {
                    assert!(depth > 12);
                    continue;
                };
                assert!(surface.depth() == depth && surface.heights().0 <= surface.heights().1);
                for from in [Real::MIN, Real::ZERO, Real::ONE, Real::MAX] {
                    for to in [Real::MIN, Real::ZERO, Real::DELTA, Real::MAX] {
                        let ray = Ray::new(Vec3::new(from, to, from), Vec3::new(to, from, to));
                        let mut last = Real::ZERO;
                        surface.cross(&ray, Unit::ONE / 4, &mut |crossing| {
                            assert!(crossing.t >= last);
                            last = crossing.t;
                            let _ = surface.point(&ray, Unit::ONE / 4, &crossing, true);
                            ControlFlow::Continue(())
                        });
                        let _ = surface.value(Vec3::new(from, to, from));
                    }
                }
            }
            assert_eq!((sheet.cells(), sheet.contraction().depth()), (2, mask.contraction().depth()));
        }
    }
    assert!((10..50).contains(&surfaces), "{surfaces}");
    assert_eq!(
        Sheet::<Mask, 16>::heights(u32::MAX),
        (u32::MAX as usize + 3).saturating_mul(u32::MAX as usize + 3)
    );
    assert!(Patch::<3, 2, 4>::from_grid(&[[Near::MIN; 4]; 16]).is_err());
}

/// A lattice as a height field, from any place, of any material, in any light.
#[test]
fn any_picture_of_a_lattice() {
    let cubic = [1, 4, 6, 4, 1];
    let mask = Mask::new(cubic.map(|a| cubic.map(|b| Near::from_bits((a * b) << 22)))).unwrap();
    let moments = SlopeMoments::new(&mask).unwrap();
    let mut word = words(61);
    let mut count = [0; 3];
    for round in 0..60 {
        let mut number = |bits: u32| Real::from_bits((word() as i32) >> bits);
        let heights: [Real; 25] = std::array::from_fn(|_| number(2 + round % 5));
        let Ok(sheet) = Sheet::<Mask, 16>::new(&mask, &heights, 2) else { continue };
        let Ok(surface) = PatchSurface::new(sheet, round % 13) else { continue };
        let [eye, at] = [(); 2].map(|()| Vec3::new(number(5), number(5), number(6)));
        let Ok(camera) = Camera::new(eye, at, Vec3::Z, Real::from_num(10 + round)) else { continue };
        let size = Size::new(7, 5);
        let finish =
            [Finish::DIFFUSE, Finish::PHONG, Finish::TORRANCE_SPARROW, Finish::Mirror][round as usize % 4];
        let Ok(caster) = PatchCaster::new(surface, camera, size) else { continue };
        let caster = caster.with_finish(finish).unwrap().with_environment(Environment::CHECKERBOARD).unwrap();
        let Ok(caster) = caster.with_sampling(Sampling::Grid(1 + (round % 3) as u8), Filter::Box) else {
            continue;
        };
        let Ok(light) = Light::new(Vec3::new(number(5), number(5), number(5))) else { continue };
        let caster = caster.with_light(light);
        for quality in [Quality::Coarse, Quality::Fine, Quality::Finest] {
            let filtered = FilteredPatch::new(caster.clone(), &moments, quality);
            assert_eq!((filtered.size(), filtered.caster().size()), (size, size));
            for (x, y) in (0..35).map(|k| (k % 7, k / 7)) {
                let _ = (filtered.at(x, y), caster.at(x, y));
                count[match filtered.found(x, y) {
                    Found::Filtered => 0,
                    Found::Sampled => 1,
                    _ => 2,
                }] += 1;
            }
            assert_eq!(filtered.found(7, 4), Found::Beyond);
        }
    }
    assert!(count.iter().all(|count| *count > 50), "{count:?}");
}
