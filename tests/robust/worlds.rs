//! Worlds of any shapes under any maps, of any materials, in any light, from anywhere.

use std::ops::ControlFlow;

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Unit, Vec3, Wide};
use attractor::plane::{Field, LinearRgb};
use attractor::trace::material::{
    Anisotropic, Clear, Highlight, Interior, Lit, Material, Medium, Mixture, Phong, Sight, Specular,
    Tabulated, TorranceSparrow,
};
use attractor::trace::refracted_direction;
use attractor::trace::solid::{
    Cube, Function, HalfSpace, Implicit, Moved, NearRay, Placed, Plane, Polygon, Polyhedron, Shape, Sphere,
    Square, Superellipsoid, TaperedCylinder, Torus,
};
use attractor::trace::world::{Difference, Intersection, Lamp, Leaf, Object, Op, Union, World, WorldCaster};
use attractor::trace::{
    Ball, Camera, Chart, Environment, Extent, Filter, Ray, Sampling, Surface, SurfacePoint,
};
use embedded_graphics::geometry::Size;
use proptest::collection::vec;
use proptest::prelude::*;

/// What is handed the crossings.
type Found<'a> = &'a mut dyn FnMut(attractor::trace::Crossing);

use super::{fuzz, inside, real, unit, vector, word};

fn lumen() -> impl Strategy<Value = Lumen> {
    let ends = prop_oneof![Just(0), Just(1), Just(1 << 16), Just(u32::MAX)];
    prop_oneof![2 => 0..=1_u32 << 16, 1 => any::<u32>(), 1 => ends].prop_map(Lumen::from_bits)
}

fn rgb() -> impl Strategy<Value = Rgb> {
    (lumen(), lumen(), lumen()).prop_map(|(r, g, b)| Rgb::new(r, g, b))
}

#[test]
fn light_of_any_brightness() {
    fuzz((rgb(), rgb(), unit(), lumen()), 100, |(a, b, part, grey)| {
        let (sum, product) = (a.plus(b), a.through(b));
        assert!(sum.r >= a.r && sum.brightest() >= b.brightest().max(a.brightest()));
        assert!(product.brightest() >= product.b);
        let mixed = a.mixed(b, part);
        let (least, most) = (a.g.min(b.g), a.g.max(b.g));
        // two products, each to the nearest
        assert!(
            mixed.g.saturating_add(Lumen::DELTA) >= least && mixed.g <= most.saturating_add(Lumen::DELTA)
        );
        assert!(a.scaled(part).r <= a.r.saturating_add(a.r).saturating_add(Lumen::DELTA));
        assert_eq!(Rgb::grey(grey).brightest(), grey);
        assert!(Rgb::from_tone(part).r <= Lumen::ONE);
        let pixel = LinearRgb::from(a);
        assert_eq!(pixel, LinearRgb::new(pixel.r, pixel.g, pixel.b));
        true
    });
}

/// A map of space: turned, scaled, moved, or of any entries.
fn map() -> impl Strategy<Value = Affine3> {
    let scale = || prop_oneof![4 => (1 << 21..=4 << 24).prop_map(Real::from_bits), 1 => real()];
    let ordinary = (vector(inside(6)), vector(real()), any::<u32>(), scale(), scale(), scale());
    let entry = || any::<i64>().prop_map(|bits| Wide::from_bits(bits >> 12));
    let row = || (entry(), entry(), entry()).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    prop_oneof![
        6 => ordinary.prop_map(|(to, axis, angle, x, y, z)| {
            let turned = Affine3::rotate(axis, Angle::from_bits(angle)).unwrap_or(Affine3::IDENTITY);
            Affine3::scale(Vec3::new(x, y, z)).then(&turned).then(&Affine3::translate(to))
        }),
        1 => (row(), row(), row(), row()).prop_map(|(a, b, c, to)| Affine3::matrix([a, b, c], to)),
    ]
}

attractor::surfaces! {
    /// A closed surface under a map.
    #[derive(Debug, Clone, Copy)]
    enum Solid {
        Sphere(Placed<Sphere>),
        Plane(Placed<Plane>),
        Torus(Placed<Torus>),
        Superellipsoid(Placed<Superellipsoid>),
    }
}

fn solid() -> impl Strategy<Value = Option<Solid>> {
    let exponent = || (3_355_444..=20 << 24).prop_map(Real::from_bits);
    let tube = (1 << 21..=1 << 28).prop_map(Near::from_bits);
    (map(), any::<u8>(), tube, (exponent(), exponent())).prop_map(|(map, kind, tube, (n, m))| {
        Some(match kind % 8 {
            0 | 1 => Solid::Plane(Placed::new(Plane, &map).ok()?),
            2 | 3 => {
                let torus = Placed::new(Torus::new(tube).ok()?, &map).ok()?;
                assert_eq!(torus.shape().tube(), tube);
                Solid::Torus(torus)
            }
            4 => Solid::Superellipsoid(Placed::new(Superellipsoid::new(n, m).ok()?, &map).ok()?),
            _ => Solid::Sphere(Placed::new(Sphere, &map).ok()?),
        })
    })
}

/// Near rays of any kind within what is asked of them, and any places.
#[test]
fn shapes_that_take_an_iteration() {
    let near = |limit: i32| (-limit..=limit).prop_map(Near::from_bits);
    let three = |limit| (near(limit), near(limit), near(limit)).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    let exponent = || {
        prop_oneof![
            (0..=21 << 24).prop_map(Real::from_bits),
            (-8_i32..=80).prop_map(|e| Real::from_num(e) / 4)
        ]
    };
    let tube = prop_oneof![
        (-8..=1 << 28).prop_map(Near::from_bits),
        ((1 << 28) - (1 << 18)..=1 << 28).prop_map(Near::from_bits)
    ];
    let ray = (three(4 << 28 >> 1), three((1 << 29) - 1), 0..3_u8, near(i32::MAX));
    let place = || vector(real());
    fuzz(
        (ray, (tube, exponent(), exponent()), (place(), three(2 << 28), place())),
        99,
        |((half, mut direction, axis, from), (tube, n, m), (place, on, far))| {
            let origin = Vec3::new(half.x * 2, half.y * 2, half.z * 2);
            let greatest = |c: Near| if c < 0 { c.min(-Near::ONE) } else { c.max(Near::ONE) };
            match axis {
                0 => direction.x = greatest(direction.x),
                1 => direction.y = greatest(direction.y),
                _ => direction.z = greatest(direction.z),
            }
            let ray = NearRay { origin, direction };
            let plane = |p: Vec3<Near>| (p.z >> 1) - (p.x >> 2);
            let [low, high] = [-Near::ONE, Near::ONE].map(|c| Vec3::new(c, c, c));
            let sheet = Implicit::new(plane, [low, high], far.x);
            let gradient = plane.gradient(low);
            assert!(gradient.x < 0 && gradient.z > 0);
            let _ = Torus::new(tube).map(|shape| any_ray(&shape, &ray, from, place, on));
            let _ = Superellipsoid::new(n, m).map(|shape| any_ray(&shape, &ray, from, place, on));
            let _ = sheet.map(|shape| any_ray(&shape, &ray, from, place, on));
            true
        },
    );
}

fn any_ray(shape: &impl Shape, ray: &NearRay, from: Near, place: Vec3, on: Vec3<Near>) {
    let (mut count, mut before) = (0, from);
    shape.cross(ray, from, &mut |crossing| {
        assert!(crossing.s >= before, "{ray:?}");
        before = crossing.s;
        count += 1;
        ControlFlow::Continue(())
    });
    assert!(count <= shape.most_crossings());
    shape.value(place);
    shape.normal(on, 0);
    shape.chart(place, 0);
}

fn highlight() -> impl Strategy<Value = Highlight<'static>> {
    (0..4_u8, unit(), unit(), any::<u16>()).prop_map(|(kind, a, b, shininess)| match kind {
        0 => Highlight::None,
        1 => Highlight::Phong(Phong { shininess }),
        2 => TorranceSparrow::new(a, b).map_or(Highlight::None, Highlight::TorranceSparrow),
        _ => Anisotropic::new(a, b).map_or(Highlight::None, Highlight::Anisotropic),
    })
}

fn material() -> impl Strategy<Value = Mixture<Rgb, Highlight<'static>, Option<Clear>>> {
    let medium =
        (prop_oneof![(1 << 21..=10 << 24).prop_map(Real::from_bits), real()], 0..3_u8, any::<bool>());
    (rgb(), (unit(), unit()), (rgb(), highlight()), rgb(), proptest::option::of((medium, rgb()))).prop_map(
        |(pigment, (ambient, diffuse), (color, highlight), reflect, medium)| {
            let matt = Mixture::matt(pigment);
            let matt = matt.with_parts(ambient, diffuse).unwrap_or(matt);
            let opaque = matt.with_highlight(color, highlight).with_reflection(reflect);
            let clear = |((index, priority, fresnel), transmit)| {
                Clear::new(Medium { index, priority, fresnel }, transmit).ok()
            };
            opaque.with_interior(medium.and_then(clear))
        },
    )
}

/// Any material answers any light at any point.
#[test]
fn materials_at_any_point() {
    let direction = || vector(real());
    let place = (vector(real()), direction(), direction(), direction(), real());
    let lights = vec((direction(), rgb()), 0..4);
    fuzz((material(), place, lights), 60, |(material, (position, normal, view, along_u, u), lights)| {
        let (Some(normal), Some(view)) = (normal.normalised(), view.normalised()) else { return false };
        let chart = Chart { u, v: u, along_u, along_v: along_u };
        let point =
            SurfacePoint { position, place: position, normal, inward: false, chart, face: 0, width: u };
        let lit: Vec<Lit> = lights
            .iter()
            .filter_map(|(towards, light)| Some(Lit { towards: towards.normalised()?, light: *light }))
            .collect();
        for lit in &lit {
            let view = Sight { normal, direction: view, tangent: normal };
            let _ = Highlight::Phong(Phong { shininess: 7 }).part(&view, lit.towards);
        }
        // whatever the index
        let _ = refracted_direction(view, normal, u);
        let response = material.respond(&point, view, lit.into_iter());
        assert_eq!(response.refracted, material.passes());
        assert_eq!(material.normal(&point), normal);
        material.is_charted() || material.medium().is_none() || response.reflected.brightest() >= Lumen::ZERO
    });
}

/// Tables of any words, and those of any points of a surface; a highlight by each.
#[test]
fn tables_of_any_slopes() {
    let words = (0..3_u16, 0..9_u16, 20..2100_u16, vec(any::<u16>(), 100));
    let points = vec((real(), real()), 0..9);
    let direction = || vector(inside(4));
    let look = (direction(), direction(), direction(), direction(), unit());
    fuzz((words, points, look), 8, |((version, side, reach, mut words), points, look)| {
        let (a, b, c, d, reflectance) = look;
        let [Some(normal), Some(direction), Some(tangent), Some(towards)] =
            [a, b, c, d].map(|v| v.normalised())
        else {
            return false;
        };
        let view = Sight { normal, direction, tangent };
        let _ = Tabulated::new(&words, reflectance);
        // alike for opposite slopes
        let count = usize::from(side) * usize::from(side);
        words.splice(..3, [version, side, reach]);
        words.truncate(3 + count);
        for k in 0..count / 2 {
            words[2 + count - k] = words[3 + k];
        }
        let mine = Tabulated::new(&words, reflectance).map(|model| model.part(&view, towards));
        let points: Vec<[Real; 2]> = points.into_iter().map(|(slope, value)| [slope, value]).collect();
        let (mut counts, mut table) = (vec![0; count], vec![0; Tabulated::words(side)]);
        let all = (points.as_slice(), points.as_slice());
        if let Ok(table) = Tabulated::tabulate(all, (side, reach), &mut counts, &mut table) {
            let model = Tabulated::new(table, Unit::ONE).expect("a table that core made");
            let _ = model.part(&view, towards);
        }
        mine.is_ok()
    });
}

/// A program over the first `leaves` leaves: operations as the numbers say.
fn program(leaves: usize, numbers: &[u8]) -> Vec<Op> {
    let operation = |n: u8| [Op::Union, Op::Intersection, Op::Difference][usize::from(n % 3)];
    let mut ops = Vec::new();
    for leaf in 0..leaves {
        ops.push(Op::Leaf(leaf as u8));
        if leaf > 0 {
            ops.push(operation(numbers.get(leaf).copied().unwrap_or(0)));
        }
    }
    ops
}

/// Pictures of any world: no panic, no overflow; every ray ends within the bounces that it may have.
#[test]
fn worlds_from_any_eye() {
    let things = vec((solid(), material()), 1..6);
    let lamps = vec((vector(real()), rgb(), any::<bool>()), 0..3);
    let view = (vector(inside(20)), vector(inside(3)), (20 << 24..=70 << 24).prop_map(Real::from_bits));
    fuzz(
        (things, lamps, view, vec(any::<u8>(), 6), 0..=5_u8),
        50,
        |(things, lamps, view, numbers, depth)| {
            let things: Vec<(Solid, _)> =
                things.into_iter().filter_map(|(solid, material)| Some((solid?, material))).collect();
            if things.is_empty() {
                return false;
            }
            let lamps: Vec<Lamp> =
                lamps
                    .into_iter()
                    .filter_map(|(at, light, near)| {
                        if near { Some(Lamp::point(at, light)) } else { Lamp::distant(at, light).ok() }
                    })
                    .collect();
            let (surfaces, materials): (Vec<Solid>, Vec<_>) = things.into_iter().unzip();
            let of: Vec<u8> = (0..surfaces.len() as u8).collect();
            let leaves: Vec<Leaf<'_, Solid>> = surfaces
                .iter()
                .zip(of.chunks(1))
                .map(|(surface, materials)| Leaf { surface: *surface, materials })
                .collect();
            // all in one compound, or each for itself
            let ops: Vec<Vec<Op>> = if numbers[0] & 1 == 0 {
                vec![program(leaves.len(), &numbers)]
            } else {
                of.iter().map(|leaf| vec![Op::Leaf(*leaf)]).collect()
            };
            let mut memory: Vec<Vec<Extent>> =
                ops.iter().map(|ops| vec![Extent::NOTHING; Object::extents(ops.len())]).collect();
            let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
            let objects: Result<Vec<Object<'_>>, _> =
                ops.iter().zip(&mut memory).map(|(ops, memory)| Object::new(ops, surface, memory)).collect();
            let objects = objects.expect("a program of closed leaves");
            for object in &objects {
                let _ = object.extent();
            }
            let world =
                World::new(&leaves, &objects, &materials).expect("a world that fits").with_lamps(&lamps);
            assert_eq!(
                world.most_crossings(),
                leaves.iter().map(|l| l.surface.most_crossings()).sum::<u32>()
            );
            let (eye, look_at, degrees) = view;
            let Ok(camera) = Camera::new(eye, look_at, Vec3::Z, degrees) else { return false };
            let size = Size::new(5, 4);
            let caster = WorldCaster::<_, _, _>::new(world, Environment::CHECKERBOARD, camera, size);
            let caster =
                caster.expect("room for five leaves").with_depth(depth).expect("a depth of at most five");
            let _ = caster.interpenetration();
            let jittered = Sampling::Jittered { n: 2, seed: depth.into() };
            let caster = caster.with_sampling(jittered, Filter::Box).expect("four samples");
            for y in 0..size.height {
                let row: Vec<LinearRgb> = caster.row(y, 0..size.width).collect();
                assert_eq!(row[2], caster.at(2, y));
            }
            // the same as types
            if let [a, b, ..] = surfaces.as_slice() {
                let ray = Ray::new(eye, look_at.minus(eye));
                assert_eq!(ray.at(Real::ZERO), ray.origin());
                assert!(ray.direction().x.abs() <= Near::from_num(4));
                let (mut inside, mut count) = (None, 0);
                Union(Difference(*a, *b), Intersection(*a, *b)).cross(&ray, Unit::DELTA, &mut |crossing| {
                    assert!(inside != Some(crossing.enters), "entries and exits alternate");
                    inside = Some(crossing.enters);
                    count += 1;
                    core::ops::ControlFlow::Continue(())
                });
                assert!(count <= 8);
                let both = a.extent().hull(b.extent());
                assert_eq!(
                    both.overlap(a.extent()),
                    if a.extent().is_empty() { Extent::NOTHING } else { a.extent() }
                );
            }
            true
        },
    );
}

#[test]
fn ready_made_materials() {
    assert!(Mixture::mirror().medium().is_none() && Interior::medium(&()).is_none());
    assert_eq!(Mixture::glass(Real::from_num(1.5)).unwrap().passes(), Rgb::WHITE);
    fuzz(word(), 1, |bits| Mixture::glass(Real::from_bits(bits)).is_ok());
}

/// Whatever a ray meets of any shape under any map: crossings in order, points that are told.
fn any_shape(shape: impl Shape + Copy, map: &Affine3, ray: &Ray, cone: Unit, place: Vec3) -> bool {
    let Ok(placed) = Placed::new(shape, map) else { return false };
    let mut before = Real::ZERO;
    let met = |surface: &dyn Fn(Found<'_>), before: &mut Real| {
        surface(&mut |crossing| {
            assert!(crossing.t >= *before && crossing.face < 32);
            *before = crossing.t;
        });
    };
    let crossed = |found: &mut dyn FnMut(attractor::trace::Crossing)| {
        placed.cross(ray, cone, &mut |crossing| {
            let point = placed.point(ray, cone, &crossing, true);
            assert!(point.face == crossing.face && placed.faces() >= 1);
            found(crossing);
            std::ops::ControlFlow::Continue(())
        });
    };
    met(&crossed, &mut before);
    let _ = (placed.value(place), placed.error(), placed.extent(), placed.shape().bounds());
    let _ = (placed.ball().centre(), placed.is_clear_of(place), shape.radius(), shape.is_clear_of(place));
    let _ = Ball::round(place, ray.origin());
    let wide = ray.with_width(place.x);
    let _ = (wide.width_at(place.y, cone), wide.width_at(Real::MAX, Unit::MAX));
    if let Ok(moved) = Moved::new(placed, map) {
        moved.cross(&wide, cone, &mut |crossing| {
            let _ = moved.point(&wide, cone, &crossing, true);
            std::ops::ControlFlow::Continue(())
        });
        let _ = (moved.value(place), moved.error(), moved.extent(), moved.most_crossings());
    }
    true
}

/// What is placed at design time is what is placed later, and refused where that is.
fn alike<S: Shape + Copy>(early: Result<Placed<S>, Error>, shape: S, map: &Affine3, place: Vec3) -> bool {
    let known = |placed: Placed<S>| (placed.extent(), placed.ball(), placed.error(), placed.value(place));
    let (early, late) = (early.map(known), Placed::new(shape, map).map(known));
    assert!(early == late, "{early:?} {late:?}");
    late.is_ok()
}

#[test]
fn shapes_placed_at_design_time_under_any_map() {
    fuzz((map(), vector(real()), real()), 60, |(map, place, cap)| {
        let mut any = alike(Placed::sphere(&map), Sphere, &map, place);
        any |= alike(Placed::plane(&map), Plane, &map, place);
        any |= alike(Placed::square(&map), Square, &map, place);
        any |= alike(Placed::cube(&map), Cube, &map, place);
        if let Ok(shape) = TaperedCylinder::new(cap) {
            any |= alike(Placed::tapered_cylinder(shape, &map), shape, &map, place);
        }
        any
    });
}

/// A ball alone, as a leaf of its own: a world of leaves takes it, wherever it is.
#[test]
fn a_world_of_one_leaf_anywhere() {
    fuzz(map(), 60, |map| {
        let Ok(ball) = Placed::sphere(&map) else { return false };
        let leaves = [Leaf { surface: ball, materials: &[0] }];
        let objects = [Object::leaf(0, &leaves[0].surface)];
        let materials = [Mixture::matt(Rgb::WHITE)];
        let world = World::of_leaves(&leaves, &objects, &materials);
        assert!(world.is_ok() && objects[0].extent() == leaves[0].surface.extent());
        true
    });
}

#[test]
fn shapes_of_any_numbers_under_any_map() {
    let at = || vector(real());
    let entry = || prop_oneof![Just(Wide::ZERO), any::<i64>().prop_map(|bits| Wide::from_bits(bits >> 14))];
    let plane = (entry(), entry(), entry(), entry())
        .prop_map(|(x, y, z, d)| HalfSpace::new(Vec3::new(x, y, z), d).unwrap_or_default());
    let corner = vector(inside(2));
    let lists = (vec(plane, 0..9), vec(corner, 0..9));
    fuzz((map(), (at(), at(), unit(), at()), real(), lists), 60, |(map, ray, cap, (planes, corners))| {
        let (origin, direction, cone, place) = ray;
        let ray = Ray::new(origin, direction);
        let mut any = any_shape(Sphere, &map, &ray, cone, place);
        any |= any_shape(Plane, &map, &ray, cone, place);
        any |= any_shape(Cube, &map, &ray, cone, place);
        any |= any_shape(Square, &map, &ray, cone, place);
        if let Ok(tapered) = TaperedCylinder::new(cap) {
            any |= any_shape(tapered, &map, &ray, cone, place);
        }
        for tapered in [TaperedCylinder::CONE, TaperedCylinder::CYLINDER] {
            any |= any_shape(tapered, &map, &ray, cone, place);
        }
        if let Ok(polyhedron) = Polyhedron::new(&planes) {
            any |= any_shape(polyhedron, &map, &ray, cone, place);
        }
        if let Ok(polygon) = Polygon::<8>::new(&corners) {
            any |= any_shape(polygon, &map, &ray, cone, place);
        }
        any
    });
}
