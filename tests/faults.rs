//! What goes wrong in other ray tracers, and the tests that it does not here: fault, colon, tests.
//!
//! 1. a ray sees the surface that it left: `a_ring_of_glass_at_any_size_and_distance`,
//!    `no_ray_meets_the_surface_that_it_left`;
//! 2. pinholes of a torus, a wrong parity inside: `the_surface_has_no_pinholes`,
//!    `from_inside_a_torus_the_crossings_are_odd`;
//! 3. a compound forgets crossings of a torus, phantoms in mirrors:
//!    `a_compound_uses_all_four_crossings_of_a_torus`, `a_ring_that_is_cut_and_mirrors`;
//! 4. rays along or across the axis of a cylinder, from inside, pointing away:
//!    `rays_along_and_across_the_axis_meet_the_tapered_cylinder`;
//! 5. the other nappe of a cone: `rays_along_and_across_the_axis_meet_the_tapered_cylinder`,
//!    `rays_meet_the_tapered_cylinder_where_they_should`;
//! 6. rims and seams: `entries_and_exits_alternate_at_rims_and_corners`;
//! 7. faces that coincide: `faces_that_coincide_leave_no_trace`, `faces_in_one_plane`,
//!    `a_ring_of_glass_and_a_block_that_stands_on_the_floor`;
//! 8. acne, and thin things that are skipped: `no_ray_meets_the_surface_that_it_left`,
//!    `things_a_hair_apart_are_told_apart`;
//! 9. total reflection that is black: `a_white_furnace_is_white_for_every_material`;
//! 10. glass in water, overlaps, an eye inside glass: `media_follow_their_priorities`,
//!     `a_ball_of_glass_in_water`, `an_eye_inside_glass`;
//! 11. noise with seams, runs and dead gradients:
//!     `noise_is_zero_at_every_lattice_point_and_has_its_gradient_there`,
//!     `noise_goes_on_smoothly_over_cells_and_over_the_ends_of_the_format`,
//!     `noise_never_stands_still_for_long`;
//! 12. speckle of a checker on a plane at an integer:
//!     `a_checker_has_no_speckle_on_a_plane_at_an_integer`,
//!     `cubes_take_turns_and_planes_between_them_have_one_colour`;
//! 13. a seam of `u` that is seen: `frames_go_on_over_the_seam_of_a_sphere`,
//!     `a_wobbly_log_has_no_seam`;
//! 14. shadows through glass: `shadows_follow_the_rule_for_glass`, `a_ball_of_glass_in_water`;
//! 15. other bits on other machines: `noises_of_other_seeds_have_nothing_to_do_with_each_other`;
//! 16. bumps without `P_u`, normals and tangents under uneven scales:
//!     `a_constant_slope_leans_against_the_way_up_and_less_where_tangents_are_long`,
//!     `normals_and_tangents_follow_their_rules_under_any_map`, `scaled_differently_along_each_axis`;
//! 17. a hit on the wrong side, a wrap count that is not whole:
//!     `no_ray_meets_the_surface_that_it_left`, `a_whole_number_of_images_closes_round_a_shape`.

use core::ops::ControlFlow;

use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Unit, Vec3, Wide};
use attractor::plane::Field;
use attractor::surfaces;
use attractor::trace::material::Mixture;
use attractor::trace::solid::{
    Cube, HalfSpace, Placed, Plane, Polyhedron, Sphere, Square, TaperedCylinder, Torus,
};
use attractor::trace::texture::Checker;
use attractor::trace::world::{Difference, Intersection, Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Crossing, Extent, Ray, Surface, SurfacePoint};
use embedded_graphics::geometry::Size;

type Vector = [f64; 3];

fn vector(v: Vector) -> Vec3 {
    let [x, y, z] = v.map(Real::from_num);
    Vec3::new(x, y, z)
}

fn floats(v: Vec3) -> Vector {
    [v.x, v.y, v.z].map(|c| c.to_num())
}

fn units(v: Vec3<Unit>) -> Vector {
    [v.x, v.y, v.z].map(|c| c.to_num())
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k: usize| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

/// Numbers in ±1, of 24 bits: what both sides know exactly.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut word = seed;
    move || {
        word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((word >> 39) as f64 - 2_f64.powi(24)) / 2_f64.powi(24)
    }
}

fn crossings(surface: &impl Surface, ray: &Ray) -> Vec<Crossing> {
    let mut all = Vec::new();
    surface.cross(ray, Unit::ZERO, &mut |crossing| {
        all.push(crossing);
        ControlFlow::Continue(())
    });
    all
}

/// Scaled by different factors, turned and moved.
fn askew() -> Affine3 {
    let angle = Angle::from_bits(600_000_000);
    Affine3::scale(vector([1.5, 0.4, 0.8]))
        .then(&Affine3::rotate(vector([0.3, -0.5, 1.0]), angle).unwrap())
        .then(&Affine3::scale(vector([0.7, 1.25, 1.0])))
        .then(&Affine3::translate(vector([2.0, -3.0, 1.0])))
}

#[test]
fn from_inside_a_torus_the_crossings_are_odd() {
    let mut number = numbers(3);
    let mut counts = [0; 5];
    for (tube, map) in [0.05, 0.3, 0.6, 0.95]
        .into_iter()
        .flat_map(|tube| [(tube, askew()), (tube, Affine3::scale(vector([1.0; 3])))])
    {
        let torus = Placed::new(Torus::new(Near::from_num(tube)).unwrap(), &map).unwrap();
        for _ in 0..2000 {
            // a place inside the tube, in its own coordinates, well away from the surface
            let (turn, round, part) = (number() * 3.0, number() * 3.0, number().abs() * 0.98 * tube);
            let out = 1.0 + part * round.cos();
            let place = vector([out * turn.cos(), out * turn.sin(), part * round.sin()]);
            let ray = Ray::new(map.at(place), vector([number(), number(), number()]));
            let found = crossings(&torus, &ray);
            assert!(found.len() % 2 == 1, "{tube} {place:?}: {found:?}");
            let alternate = found.iter().enumerate().all(|(k, crossing)| crossing.enters == (k % 2 == 1));
            assert!(alternate, "{tube} {place:?}: {found:?}");
            counts[found.len()] += 1;
        }
    }
    assert!(counts[1] > 8000 && counts[3] > 500, "{counts:?}");
}

/// A ray in the plane of a torus enters it twice. What of it is cut off is not met, what is left is, be it
/// the last crossing of all; as a type and as data.
#[test]
fn a_compound_uses_all_four_crossings_of_a_torus() {
    surfaces! {
        #[derive(Debug, Clone, Copy)]
        enum Solid {
            Torus(Placed<Torus>),
            Cube(Placed<Cube>),
        }
    }
    let torus =
        Placed::new(Torus::new(Near::from_num(0.25)).unwrap(), &Affine3::scale(vector([1.0; 3]))).unwrap();
    // crossings at x = -1.25, -0.75, 0.75, 1.25
    let cube = |x: f64| {
        let map = Affine3::scale(vector([0.75, 2.0, 2.0])).then(&Affine3::translate(vector([x, 0.0, 0.0])));
        Placed::new(Cube, &map).unwrap()
    };
    let ray = Ray::new(vector([-4.0, 0.0, 0.0]), vector([1.0, 0.0, 0.0]));
    assert_eq!(crossings(&torus, &ray).len(), 4);
    for (x, cut, kept) in [
        // from -1.5 to 0, from -1 to 0.5 and from 0.25 to 1.75
        (-0.75, vec![0.75, 1.25], vec![-1.25, -0.75]),
        (-0.25, vec![-1.25, -1.0, 0.75, 1.25], vec![-1.0, -0.75]),
        (1.0, vec![-1.25, -0.75], vec![0.75, 1.25]),
    ] {
        let places =
            |found: Vec<Crossing>| found.iter().map(|c| c.t.to_num::<f64>() - 4.0).collect::<Vec<_>>();
        let close = |found: &[f64], expected: &[f64]| {
            found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
        };
        let (less, both) = (Difference(torus, cube(x)), Intersection(torus, cube(x)));
        let (less, both) = (places(crossings(&less, &ray)), places(crossings(&both, &ray)));
        assert!(close(&less, &cut) && close(&both, &kept), "{x}: {less:?} {both:?}");
        for (op, first) in [(Op::Difference, cut[0]), (Op::Intersection, kept[0])] {
            let leaves = [Solid::Torus(torus), Solid::Cube(cube(x))];
            let leaves = leaves.map(|surface| Leaf { surface, materials: &[0] });
            let ops = [Op::Leaf(0), Op::Leaf(1), op];
            let mut memory = [Extent::NOTHING; 3];
            let object =
                Object::new(&ops, |leaf| leaves.get(leaf).map(|leaf| &leaf.surface), &mut memory).unwrap();
            // its own colour tells where it was met
            let material = [Mixture::matt(Where).with_parts(Unit::ONE, Unit::ZERO).unwrap()];
            let objects = [object];
            let world = World::new(&leaves, &objects, &material).unwrap();
            let camera = Camera::new(
                vector([-4.0, 0.0, 0.0]),
                vector([0.0; 3]),
                vector([0.0, 0.0, 1.0]),
                Real::from_num(1),
            )
            .unwrap();
            let seen =
                WorldCaster::<_, _, _>::new(world, Rgb::BLACK, camera, Size::new(1, 1)).unwrap().at(0, 0);
            let met = f64::from(seen.r) / 65535.0 * 4.0 - 2.0;
            assert!((met - first).abs() < 1e-3, "{x} {op:?}: {met} for {first}");
        }
    }
}

/// `x` from -2 to 2 as a grey.
#[derive(Debug, Clone, Copy)]
struct Where;

impl attractor::trace::texture::Texture for Where {
    fn at(&self, point: &SurfacePoint) -> Rgb {
        Rgb::grey(Lumen::from_num((point.position.x.to_num::<f64>() + 2.0) / 4.0))
    }
}

/// Rays aimed at rims, edges, corners, tips and seams, and past them by a bit or two.
#[test]
fn entries_and_exits_alternate_at_rims_and_corners() {
    let corners: Vec<Vector> =
        (0..27).map(|k| [k % 3, k / 3 % 3, k / 9].map(|c| f64::from(c) - 1.0)).collect();
    let ring = |radius: f64, z: f64| {
        (0..16).map(move |k| {
            let turn = f64::from(k) * std::f64::consts::TAU / 16.0;
            [radius * turn.cos(), radius * turn.sin(), z]
        })
    };
    let rims: Vec<Vector> = ring(1.0, 0.0).chain(ring(1.0, 1.0)).chain([[0.0, 0.0, 1.0], [0.0; 3]]).collect();
    let rings: Vec<Vector> = ring(1.25, 0.0).chain(ring(0.75, 0.0)).chain(ring(1.0, 0.25)).collect();
    let wide = |n: Vector| Vec3::new(Wide::from_num(n[0]), Wide::from_num(n[1]), Wide::from_num(n[2]));
    let planes: Vec<HalfSpace> = (0..8)
        .map(|k| HalfSpace::new(wide([k & 1, k >> 1 & 1, k >> 2].map(|s| f64::from(2 * s) - 1.0)), Wide::ONE))
        .collect::<Result<_, _>>()
        .unwrap();
    let tips: Vec<Vector> = (0..6)
        .map(|k| std::array::from_fn(|axis| if axis == k / 2 { 1.0 - 2.0 * (k % 2) as f64 } else { 0.0 }))
        .collect();
    let maps = [Affine3::scale(vector([1.0; 3])), askew()];
    let (mut tried, mut met) = (0, 0);
    let mut number = numbers(11);
    for map in &maps {
        let mut along = |name: &str, surface: &dyn Fn(&Ray) -> Vec<Crossing>, targets: &[Vector]| {
            for target in targets {
                for k in 0..300 {
                    // along the axes too, and along edges
                    let way = match k % 6 {
                        0 => [1.0, 0.0, 0.0],
                        1 => [0.0, -1.0, 0.0],
                        2 => [0.0, 0.0, -1.0],
                        3 => [1.0, -1.0, 0.0],
                        _ => [number(), number(), number()],
                    };
                    // from well outside
                    let way = way.map(|c| 4.0 * c / dot(way, way).sqrt());
                    let from = map.at(vector([0, 1, 2].map(|c| target[c] - way[c])));
                    let to = map.at(vector(*target));
                    let bits = |k: u32| Real::from_bits((k.wrapping_mul(2_654_435_761) >> 30) as i32 - 1);
                    let to = Vec3::new(to.x + bits(k), to.y + bits(k + 7), to.z + bits(k + 19));
                    let half = |a: Real, b: Real| Real::from_bits((b - a).to_bits() / 4);
                    let d = Vec3::new(half(from.x, to.x), half(from.y, to.y), half(from.z, to.z));
                    let found = surface(&Ray::new(from, d));
                    let fair = found.len().is_multiple_of(2)
                        && found.iter().enumerate().all(|(k, crossing)| crossing.enters == (k % 2 == 0))
                        && found.windows(2).all(|pair| pair[0].t <= pair[1].t);
                    assert!(fair, "{name} {target:?} {k}: {found:?}");
                    tried += 1;
                    met += usize::from(!found.is_empty());
                }
            }
        };
        let cylinder =
            |cap: f64| Placed::new(TaperedCylinder::new(Real::from_num(cap)).unwrap(), map).unwrap();
        let (one, half, cone) = (cylinder(1.0), cylinder(0.5), cylinder(0.0));
        along("cylinder", &|ray| crossings(&one, ray), &rims);
        along("tapered", &|ray| crossings(&half, ray), &rims);
        along("cone", &|ray| crossings(&cone, ray), &rims);
        let cube = Placed::new(Cube, map).unwrap();
        along("cube", &|ray| crossings(&cube, ray), &corners);
        let octahedron = Placed::new(Polyhedron::new(&planes).unwrap(), map).unwrap();
        let far: Vec<Vector> = tips.iter().map(|t| t.map(|c| c * 3_f64.sqrt())).collect();
        along("octahedron", &|ray| crossings(&octahedron, ray), &far);
        let torus = Placed::new(Torus::new(Near::from_num(0.25)).unwrap(), map).unwrap();
        along("torus", &|ray| crossings(&torus, ray), &rings);
        let sphere = Placed::new(Sphere, map).unwrap();
        along("sphere", &|ray| crossings(&sphere, ray), &tips);
    }
    assert!(tried > 100_000 && met > tried / 3 && met < tried, "{met} of {tried}");
}

/// A sheet over a floor, an eye between them, a lamp above: the floor is in the shade, and the sheet is seen,
/// as near as `2^-17`.
#[test]
fn things_a_hair_apart_are_told_apart() {
    surfaces! {
        #[derive(Debug, Clone, Copy)]
        enum Solid {
            Plane(Placed<Plane>),
            Square(Placed<Square>),
            Cube(Placed<Cube>),
        }
    }
    let mut tried = 0;
    for exponent in [4, 10, 14, 17] {
        for closed in [false, true] {
            let gap = 2_f64.powi(-exponent);
            for floor in [0.0, 1.0 / 3.0, 20.0] {
                let sheet = if closed {
                    let map = Affine3::translate(vector([0.0, 0.0, floor + gap + 1.0]));
                    Solid::Cube(Placed::new(Cube, &map).unwrap())
                } else {
                    let map = Affine3::translate(vector([0.0, 0.0, floor + gap]));
                    Solid::Square(Placed::new(Square, &map).unwrap())
                };
                let plane = Placed::new(Plane, &Affine3::translate(vector([0.0, 0.0, floor]))).unwrap();
                let leaves = [
                    Leaf { surface: Solid::Plane(plane), materials: &[0] },
                    Leaf { surface: sheet, materials: &[1] },
                ];
                let mut memory = [[Extent::NOTHING; 1]; 2];
                let [first, second] = &mut memory;
                let surface = |leaf: usize| leaves.get(leaf).map(|leaf: &Leaf<'_, Solid>| &leaf.surface);
                let objects = [
                    Object::new(&[Op::Leaf(0)], surface, first).unwrap(),
                    Object::new(&[Op::Leaf(1)], surface, second).unwrap(),
                ];
                let half = Unit::from_num(0.5);
                let materials = [
                    Mixture::matt(Rgb::WHITE).with_parts(Unit::ZERO, Unit::ONE).unwrap(),
                    Mixture::matt(Rgb::WHITE).with_parts(half, half).unwrap(),
                ];
                let lamps = [Lamp::distant(vector([0.1, 0.2, 1.0]), Rgb::WHITE).unwrap()];
                let world = World::new(&leaves, &objects, &materials).unwrap().with_lamps(&lamps);
                for (z, expected) in [(-1.0, 0), (1.0, 32768)] {
                    let eye = vector([0.1, 0.2, floor + gap / 2.0]);
                    let aim = vector([0.1, 0.2, floor + gap / 2.0 + z]);
                    let camera = Camera::new(eye, aim, vector([1.0, 0.0, 0.0]), Real::from_num(30)).unwrap();
                    let size = Size::new(8, 8);
                    let caster = WorldCaster::<_, _, _>::new(world, Rgb::WHITE, camera, size).unwrap();
                    for y in 0..8 {
                        for pixel in caster.row(y, 0..8) {
                            assert!(pixel.r.abs_diff(expected) <= 2, "{gap} {closed} {floor} {z}: {pixel:?}");
                            tried += 1;
                        }
                    }
                }
            }
        }
    }
    assert_eq!(tried, 4 * 2 * 3 * 2 * 64);
}

/// A tilted plane lies between two layers of the checker, and its points a rounding error above or below: one
/// colour a square.
#[test]
fn a_checker_has_no_speckle_on_a_plane_at_an_integer() {
    let map = askew();
    let plane = Placed::new(Plane, &map).unwrap();
    let two = Real::from_num(2);
    let checker = Checker::cubes([two; 3], Rgb::WHITE, Rgb::BLACK);
    let mut number = numbers(5);
    let (mut counts, mut sides) = ([0; 2], [0; 2]);
    for _ in 0..20_000 {
        let aim = [4.0 * number(), 4.0 * number(), 0.0];
        // not at a seam
        if aim[..2].iter().any(|c| (2.0 * c - (2.0 * c).round()).abs() < 0.01) {
            continue;
        }
        let from = map.at(vector([aim[0] + 0.5 * number(), aim[1] + 0.5 * number(), 2.0]));
        let Some(d) = from.towards(map.at(vector(aim))) else { continue };
        let ray = Ray::new(from, vector(units(d)));
        let first = crossings(&plane, &ray)[0];
        let point = plane.point(&ray, Unit::ZERO, &first, false);
        // that of the layer above
        let odd = ((2.0 * aim[0]).floor() + (2.0 * aim[1]).floor()).rem_euclid(2.0) == 1.0;
        assert_eq!(checker.is_odd(&point), odd, "{aim:?} {point:?}");
        counts[usize::from(odd)] += 1;
        sides[usize::from(point.place.z < 0)] += 1;
    }
    assert!(counts.iter().chain(&sides).all(|count| *count > 1000), "{counts:?} {sides:?}");
}

/// On both sides of the meridian where `u` jumps by one turn, place, normal and tangents are the same.
#[test]
fn frames_go_on_over_the_seam_of_a_sphere() {
    let map = askew();
    let sphere = Placed::new(Sphere, &map).unwrap();
    let mut tried = 0;
    for k in 1..200 {
        let latitude = (f64::from(k) / 100.0 - 1.0) * 1.5;
        let at = |y: f64| {
            let aim = [latitude.cos(), y, latitude.sin()];
            let from = map.at(vector([2.0 * aim[0], 2.0 * y, 2.0 * aim[2]]));
            let d = from.towards(map.at(vector([0.0; 3]))).unwrap();
            let ray = Ray::new(from, vector(units(d)));
            sphere.point(&ray, Unit::ZERO, &crossings(&sphere, &ray)[0], true)
        };
        let (left, right) = (at(-1e-5), at(1e-5));
        let jump = (left.chart.u - right.chart.u).to_num::<f64>();
        assert!((jump.abs() - 1.0).abs() < 2e-4, "{latitude}: {jump}");
        let near = |a: Vector, b: Vector| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 5e-4);
        assert!(near(units(left.normal), units(right.normal)), "{left:?} {right:?}");
        assert!(near(floats(left.chart.along_u), floats(right.chart.along_u)), "{left:?} {right:?}");
        assert!(near(floats(left.chart.along_v), floats(right.chart.along_v)), "{left:?} {right:?}");
        assert!((left.chart.v - right.chart.v).abs() < 0.0001);
        tried += 1;
    }
    assert_eq!(tried, 199);
}

/// `N = M^-T n`, `P_u' = M P_u`: on a sphere that is scaled, turned and scaled again, against the same in
/// double precision; a normal brought back as a tangent would be off by far.
#[test]
fn normals_and_tangents_follow_their_rules_under_any_map() {
    let map = askew();
    let sphere = Placed::new(Sphere, &map).unwrap();
    let centre = floats(map.at(vector([0.0; 3])));
    // the columns of M
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| {
        let end = floats(map.at(vector(e)));
        [0, 1, 2].map(|k| end[k] - centre[k])
    });
    let applied = |v: Vector| [0, 1, 2].map(|k| (0..3).map(|c| columns[c][k] * v[c]).sum::<f64>());
    // M^-T up to a factor: its columns are the vector products of those of M
    let [a, b, c] = columns;
    let cofactors = [cross(b, c), cross(c, a), cross(a, b)];
    let inverse_transposed =
        |v: Vector| [0, 1, 2].map(|k| (0..3).map(|c| cofactors[c][k] * v[c]).sum::<f64>());
    let normalised = |v: Vector| v.map(|c| c / dot(v, v).sqrt());
    let mut number = numbers(8);
    let (mut worst, mut worst_tangent, mut other) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut tried = 0;
    while tried < 3000 {
        let aim = [number(), number(), number()];
        if dot(aim, aim) > 1.0 || dot(aim, aim) < 0.01 {
            continue;
        }
        let from = map.at(vector(normalised(aim).map(|c| 1.8 * c)));
        let d = from.towards(map.at(vector([number() * 0.3, number() * 0.3, number() * 0.3]))).unwrap();
        let ray = Ray::new(from, vector(units(d)));
        let point = sphere.point(&ray, Unit::ZERO, &crossings(&sphere, &ray)[0], true);
        let p = floats(point.place);
        let exact = normalised(inverse_transposed(p));
        let tangent = applied([-p[1], p[0], 0.0].map(|c| c * std::f64::consts::TAU));
        let (n, u) = (units(point.normal), floats(point.chart.along_u));
        for k in 0..3 {
            worst = worst.max((n[k] - exact[k]).abs());
            worst_tangent = worst_tangent.max((u[k] - tangent[k]).abs());
            other = other.max((normalised(applied(p))[k] - exact[k]).abs());
        }
        // what they are for: the tangent lies in the surface
        assert!(dot(n, normalised(u)).abs() < 1e-5, "{point:?}");
        tried += 1;
    }
    assert!(worst > 1e-9 && worst < 1e-6, "{worst:e}");
    assert!(worst_tangent > 1e-9 && worst_tangent < 2e-6, "{worst_tangent:e}");
    assert!(other > 0.1, "{other}");
}
