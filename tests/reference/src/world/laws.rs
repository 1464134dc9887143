//! What holds for every shape: its crossings are where its inside-outside function changes its sign, its
//! normal is that of the function, its tangents are the derivatives of its texture coordinates.

use crate::camera::Ray;
use crate::fif::Fif;
use crate::vector::{Vector, along, cross, dot, normalised};
use crate::world::{
    Cone, Crossing, Cube, HeightField, Implicit, Leaf, Part, Placing, Plane, Polygon, Polyhedron, Shape,
    Sphere, Square, Superellipsoid, TaperedCylinder, Torus,
};

/// Numbers in (-1, 1), the same at every run.
pub(crate) struct Numbers(u64);

impl Numbers {
    pub(crate) fn new(seed: u64) -> Self {
        Numbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 * libm::exp2(-52.0) - 1.0
    }

    pub(crate) fn vector(&mut self) -> Vector {
        [self.next(), self.next(), self.next()]
    }

    /// A ray that passes near the origin, from up to 60 units away; one in four has a zero component, one in
    /// four is along an axis.
    pub(crate) fn ray(&mut self) -> Ray {
        let mut through = self.vector().map(|c| 1.3 * c);
        let mut direction = self.vector();
        // Half of them near the planes of symmetry, where small exponents have all that they have.
        if self.next() > 0.0 {
            through = through.map(|c| c * c * c * c * c);
        }
        let kind = self.next();
        if kind > 0.5 {
            direction[((kind - 0.5) * 6.0) as usize] = 0.0;
        } else if kind < -0.5 {
            let axis = ((-kind - 0.5) * 6.0) as usize;
            direction = [0.0; 3];
            direction[axis] = if kind < -0.75 { 1.0 } else { -1.0 };
        }
        if self.next() > 0.8 {
            through[(self.next().abs() * 3.0) as usize] = 0.0;
        }
        let direction = direction.map(|c| 0.7 * c);
        let back = libm::pow(60.0, self.next()) - 0.5;
        Ray { origin: along(through, -back, direction), direction }
    }
}

/// A superellipsoid with the given exponents, a fair number of which has the extremes.
fn superellipsoids() -> Vec<Superellipsoid> {
    let exponents = [0.2, 0.5, 0.9, 1.0, 1.7, 2.0, 3.5, 20.0];
    exponents.iter().flat_map(|&n| exponents.map(|m| Superellipsoid { n, m })).collect()
}

/// `(x^2 + y^2 + z^2)^2 - (x^2 - y^2) / 2 - 0.1`: a peanut.
fn peanut() -> Implicit {
    let square = |p: Vector| dot(p, p);
    Implicit {
        function: Box::new(move |p| square(p) * square(p) - (p[0] * p[0] - p[1] * p[1]) / 2.0 - 0.1),
        gradient: Box::new(move |p| {
            let s = 4.0 * square(p);
            [(s - 1.0) * p[0], (s + 1.0) * p[1], s * p[2]]
        }),
        // 4 |p|^3 + |p| at the corner.
        lipschitz: 22.6,
    }
}

/// `x + y / 2 < 0.3`, cut off by the cube.
fn half_cube() -> Implicit {
    Implicit {
        function: Box::new(|p| p[0] + 0.5 * p[1] - 0.3),
        gradient: Box::new(|_| [1.0, 0.5, 0.0]),
        lipschitz: 1.2,
    }
}

fn octahedron() -> Polyhedron {
    let sign = |bit: usize| if bit == 0 { -1.0 } else { 2.0 };
    let side = |k: usize| ([sign(k & 1), sign(k & 2), sign(k & 4)], 1.0);
    Polyhedron { half_spaces: (0..8).map(side).collect() }
}

/// Closed shapes.
fn solids() -> Vec<Box<dyn Shape>> {
    let mut solids: Vec<Box<dyn Shape>> =
        vec![Box::new(Sphere), Box::new(Cube), Box::new(octahedron()), Box::new(Plane), Box::new(peanut())];
    solids.push(Box::new(half_cube()));
    solids.extend([0.0, 0.4, 1.0, 1.7].map(|cap| Box::new(TaperedCylinder { cap }) as Box<dyn Shape>));
    solids.extend([0.02, 0.3, 0.5, 0.999].map(|tube| Box::new(Torus { tube }) as Box<dyn Shape>));
    solids.extend(superellipsoids().into_iter().map(|shape| Box::new(shape) as Box<dyn Shape>));
    solids
}

/// Whether the ray is inside at `t`, as the crossings say.
fn inside(crossings: &[Crossing], t: f64) -> bool {
    match crossings.iter().rev().find(|crossing| crossing.t < t) {
        Some(crossing) => crossing.enters,
        None => crossings.first().is_some_and(|crossing| !crossing.enters),
    }
}

/// Asserts that between the crossings of `ray` the shape is on the side that they say, at `samples` points
/// and close before and behind each crossing, wherever the sign of its function is certain. The number of
/// certain points.
pub(crate) fn assert_sides(shape: &dyn Shape, ray: &Ray, samples: &[f64], certain: f64) -> usize {
    let crossings = shape.crossings(ray, Cone::THIN);
    for pair in crossings.windows(2) {
        assert!(
            pair[0].t <= pair[1].t && pair[0].enters != pair[1].enters,
            "{shape:?} {ray:?} {crossings:?}"
        );
    }
    let scale = libm::sqrt(dot(ray.direction, ray.direction));
    let near =
        crossings.iter().flat_map(|c| [-1e-4, -1e-7, -1e-9, 1e-9, 1e-7, 1e-4].map(|s| c.t + s / scale));
    let mut tried = 0;
    for t in near.chain(samples.iter().copied()) {
        let value = shape.value(ray.at(t));
        if value.abs() > certain {
            assert_eq!(value < 0.0, inside(&crossings, t), "{shape:?} {ray:?} at {t}: {value} {crossings:?}");
            tried += 1;
        }
    }
    tried
}

/// Points of a ray, from -2 to 2 about the point that is nearest to the origin.
fn samples(ray: &Ray, count: usize) -> Vec<f64> {
    let square = dot(ray.direction, ray.direction);
    let (middle, scale) = (-dot(ray.origin, ray.direction) / square, libm::sqrt(square));
    (0..count).map(|k| middle + (4.0 * (k as f64 + 0.31) / count as f64 - 2.0) / scale).collect()
}

#[test]
fn crossings_are_where_the_inside_outside_function_changes_its_sign() {
    let mut numbers = Numbers::new(1);
    let (mut tried, mut crossed) = (0, 0);
    for shape in solids() {
        let mut hits = 0;
        for _ in 0..150 {
            let ray = numbers.ray();
            // A line along the plane is wholly on one side of it.
            if ray.direction[2] == 0.0 && format!("{shape:?}") == "Plane" {
                continue;
            }
            tried += assert_sides(&*shape, &ray, &samples(&ray, 60), 1e-11);
            hits += usize::from(!shape.crossings(&ray, Cone::THIN).is_empty());
        }
        assert!(hits > 4, "{shape:?}: {hits}");
        crossed += hits;
    }
    assert!(tried > 500_000 && crossed > 4_000, "{tried} {crossed}");
}

#[test]
fn crossings_of_smooth_shapes_lie_on_the_surface() {
    let mut numbers = Numbers::new(2);
    let (mut tried, mut worst) = (0, 0.0_f64);
    for shape in solids() {
        if format!("{shape:?}").contains("Superellipsoid") {
            continue;
        }
        for _ in 0..300 {
            let ray = numbers.ray();
            for crossing in shape.crossings(&ray, Cone::THIN) {
                worst = worst.max(shape.value(ray.at(crossing.t)).abs());
                tried += 1;
            }
        }
    }
    assert!(tried > 2_000, "{tried}");
    // Rays from 60 units away.
    assert!(worst < 2e-13 && worst > 0.0, "{worst:e}");
}

/// A point of the surface with the frame there, for rays that meet it well.
fn frames(shape: &dyn Shape, numbers: &mut Numbers, mut check: impl FnMut(&Ray, Crossing)) {
    for _ in 0..100 {
        let origin = numbers.vector().map(|c| 3.0 * c);
        let ray = Ray { origin, direction: along(numbers.vector(), -1.0, origin) };
        for crossing in shape.crossings(&ray, Cone::THIN) {
            check(&ray, crossing);
        }
    }
}

#[test]
fn normals_point_to_where_the_function_grows() {
    let mut numbers = Numbers::new(3);
    let mut tried = 0;
    for shape in solids() {
        frames(&*shape, &mut numbers, |ray, crossing| {
            let p = ray.at(crossing.t);
            let normal = normalised(shape.frame(p, crossing.part).normal);
            // A crease of small exponents is narrower than an f64.
            if p.iter().all(|c| c.abs() > 1e-9) {
                assert_eq!(dot(normal, ray.direction) < 0.0, crossing.enters, "{shape:?} {p:?}");
            }
            // The gradient, by differences; not near an edge, where the function is not smooth.
            let step = 1e-6;
            let difference = |axis: usize| {
                let mut by = [0.0; 3];
                by[axis] = step;
                let (up, down) = (shape.value(along(p, 1.0, by)), shape.value(along(p, -1.0, by)));
                (up - down) / (2.0 * step)
            };
            let gradient = [0, 1, 2].map(difference);
            if !p.iter().all(|c| c.abs() > 0.05 && (c.abs() - 1.0).abs() > 0.05) {
                return;
            }
            let unit = normalised(gradient);
            let apart = cross(unit, normal);
            assert!(
                dot(apart, apart) < 1e-8 && dot(unit, normal) > 0.0,
                "{shape:?} {p:?} {unit:?} {normal:?}"
            );
            tried += 1;
        });
    }
    assert!(tried > 2_000, "{tried}");
}

#[test]
fn tangents_are_the_derivatives_of_the_texture_coordinates() {
    let mut numbers = Numbers::new(4);
    let mut tried = 0;
    let corner = |x: f64, y: f64| [1.0 + x, -0.4 * x + y, 0.5 * x - 0.3 * y];
    let corners = vec![corner(-1.0, -1.0), corner(0.8, -0.9), corner(1.0, 0.7), corner(-0.6, 1.1)];
    let mut shapes = solids();
    shapes.push(Box::new(Square));
    shapes.push(Box::new(Polygon { corners }));
    for shape in shapes {
        frames(&*shape, &mut numbers, |ray, crossing| {
            let p = ray.at(crossing.t);
            let frame = shape.frame(p, crossing.part);
            let size = |v: Vector| libm::sqrt(dot(v, v));
            let smooth = p.iter().all(|c| c.abs() > 0.05) && size(frame.p_u).max(size(frame.p_v)) < 50.0;
            let inner = frame.uv.iter().all(|c| (c - 0.5).abs() < 0.49);
            let polar = format!("{shape:?}").contains("cap: 0.0") && crossing.part == Part::Face(2);
            if !smooth || !inner || polar || format!("{shape:?}").starts_with("Implicit") {
                return;
            }
            let step = 1e-5;
            for (tangent, expected) in [(frame.p_u, [step, 0.0]), (frame.p_v, [0.0, step])] {
                assert!(
                    dot(tangent, frame.normal).abs() < 1e-9 * size(tangent) * size(frame.normal),
                    "{shape:?}"
                );
                let (after, before) = (along(p, step / 2.0, tangent), along(p, -step / 2.0, tangent));
                let (after, before) =
                    (shape.frame(after, crossing.part).uv, shape.frame(before, crossing.part).uv);
                for k in 0..2 {
                    let moved = after[k] - before[k];
                    assert!((moved - expected[k]).abs() < 1e-3 * step, "{shape:?} {p:?} {k}: {moved}");
                }
            }
            tried += 1;
        });
    }
    assert!(tried > 3_000, "{tried}");
}

#[test]
fn tangents_turn_to_the_left_seen_from_outside() {
    let mut numbers = Numbers::new(5);
    let mut tried = 0;
    let mut shapes: Vec<Box<dyn Shape>> = vec![Box::new(Sphere), Box::new(Torus { tube: 0.4 })];
    shapes.push(Box::new(Superellipsoid { n: 2.5, m: 1.5 }));
    shapes.push(Box::new(TaperedCylinder { cap: 0.5 }));
    shapes.push(Box::new(Square));
    shapes.push(Box::new(Cube));
    for shape in shapes {
        frames(&*shape, &mut numbers, |ray, crossing| {
            let frame = shape.frame(ray.at(crossing.t), crossing.part);
            assert!(dot(cross(frame.p_u, frame.p_v), frame.normal) > 0.0);
            tried += 1;
        });
    }
    assert!(tried > 200, "{tried}");
}

/// The texture coordinates at points that can be read off.
#[test]
fn texture_coordinates_are_those_of_the_textbook() {
    let face = Part::Face;
    let close = |a: [f64; 2], b: [f64; 2]| {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} is not {b:?}");
    };
    let half = core::f64::consts::FRAC_1_SQRT_2;
    close(Sphere.frame([0.0, half, half], face(0)).uv, [0.25, 0.75]);
    close(Sphere.frame([half, -half, 0.0], face(0)).uv, [0.875, 0.5]);
    let cone = TaperedCylinder { cap: 0.5 };
    close(cone.frame([-0.75, 0.0, 0.5], face(0)).uv, [0.5, 0.5]);
    close(cone.frame([-0.5, 0.25, 0.0], face(1)).uv, [0.75, 0.625]);
    close(cone.frame([-0.25, 0.125, 1.0], face(2)).uv, [0.375, 0.5625]);
    let torus = Torus { tube: 0.25 };
    close(torus.frame([0.0, 1.25, 0.0], face(0)).uv, [0.25, 0.0]);
    close(torus.frame([0.0, -1.0, 0.25], face(0)).uv, [0.75, 0.25]);
    close(torus.frame([0.75, 0.0, 0.0], face(0)).uv, [0.0, 0.5]);
    close(torus.frame([1.0, 0.0, -0.25], face(0)).uv, [0.0, 0.75]);
    close(Square.frame([0.5, -0.5, 0.0], face(0)).uv, [0.75, 0.25]);
    close(Cube.frame([-1.0, 0.5, -0.5], face(0)).uv, [0.25, 0.25]);
    close(Cube.frame([0.5, 1.0, -0.5], face(3)).uv, [0.25, 0.25]);
    close(Plane.frame([3.5, -7.0, 0.0], face(0)).uv, [3.5, -7.0]);
    close(Superellipsoid { n: 1.0, m: 1.0 }.frame([0.0, 0.5, 0.5], face(0)).uv, [0.25, 0.75]);
}

#[test]
fn an_open_shape_is_entered_from_above() {
    let down = Ray { origin: [0.25, -0.5, 3.0], direction: [0.0, 0.0, -2.0] };
    let up = Ray { origin: [0.25, -0.5, 3.0], direction: [0.0, 0.0, 2.0] };
    let corners = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let turned = corners.iter().rev().copied().collect();
    let (above, below) = (Polygon { corners }, Polygon { corners: turned });
    for (shape, enters) in [(&Square as &dyn Shape, true), (&above, true), (&below, false)] {
        for (ray, t, sign) in [(down, 1.5, enters), (up, -1.5, !enters)] {
            assert_eq!(
                shape.crossings(&ray, Cone::THIN),
                [Crossing { t, part: Part::Face(0), enters: sign }]
            );
        }
        let beside = Ray { origin: [1.01, 0.0, 3.0], ..down };
        assert_eq!(shape.crossings(&beside, Cone::THIN), []);
        assert!(shape.is_open());
    }
}

#[test]
fn a_polygon_is_met_between_its_edges_alone() {
    let corners = vec![[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 2.0, 1.0]];
    let triangle = Polygon { corners };
    let (mut inside, mut outside) = (0, 0);
    for i in -5..40 {
        for j in -5..30 {
            let (x, y) = (f64::from(i) / 10.0 + 0.03, f64::from(j) / 10.0 + 0.02);
            let ray = Ray { origin: [x, y, 5.0], direction: [0.0, 0.0, -1.0] };
            let within = x > 0.0 && y > 0.0 && x / 3.0 + y / 2.0 < 1.0;
            assert_eq!(!triangle.crossings(&ray, Cone::THIN).is_empty(), within);
            *(if within { &mut inside } else { &mut outside }) += 1;
        }
    }
    assert!(inside > 250 && outside > 800);
}

#[test]
fn a_torus_is_told_from_a_miss_by_a_millionth() {
    let mut numbers = Numbers::new(6);
    let mut tried = 0;
    for _ in 0..4_000 {
        let shape = Torus { tube: 0.51 + 0.489 * numbers.next() };
        let (a, b) = (numbers.next() * 3.2, numbers.next() * 3.2);
        let ring = 1.0 + shape.tube * libm::cos(b);
        let p = [ring * libm::cos(a), ring * libm::sin(a), shape.tube * libm::sin(b)];
        let normal = shape.frame(p, Part::Face(0)).normal;
        let tangent = normalised(cross(normal, numbers.vector()));
        let offset = if numbers.next() > 0.0 { 1e-6 } else { -1e-6 };
        let back = 30.0 * (1.0 + numbers.next());
        let origin = along(along(p, offset, normal), -back, tangent);
        let ray = Ray { origin, direction: tangent };
        let mut around: Vec<f64> =
            (0..24).flat_map(|k| [1.0, -1.0].map(|s| back + s * libm::exp2(-f64::from(k)))).collect();
        around.push(back);
        tried += assert_sides(&shape, &ray, &around, 1e-12);
    }
    assert!(tried > 150_000, "{tried}");
}

#[test]
fn a_torus_has_four_crossings_along_its_plane_and_from_inside_an_odd_number() {
    let shape = Torus { tube: 0.25 };
    let ray = Ray { origin: [-3.0, 0.0, 0.0], direction: [2.0, 0.0, 0.0] };
    let ts: Vec<f64> = shape.crossings(&ray, Cone::THIN).iter().map(|c| c.t).collect();
    assert_eq!(ts, [0.875, 1.125, 1.875, 2.125]);
    let mut numbers = Numbers::new(7);
    for _ in 0..300 {
        let origin = [1.0 + 0.1 * numbers.next(), 0.1 * numbers.next(), 0.1 * numbers.next()];
        let ray = Ray { origin, direction: numbers.vector() };
        let ahead = shape.crossings(&ray, Cone::THIN).iter().filter(|c| c.t > 0.0).count();
        assert_eq!(ahead % 2, 1);
    }
}

#[test]
fn a_superellipsoid_of_twos_is_a_sphere_and_of_ones_an_octahedron() {
    let mut numbers = Numbers::new(8);
    let (round, flat) = (Superellipsoid { n: 2.0, m: 2.0 }, Superellipsoid { n: 1.0, m: 1.0 });
    let sign = |bit: usize| if bit == 0 { -1.0 } else { 1.0 };
    let side = |k: usize| ([sign(k & 1), sign(k & 2), sign(k & 4)], 1.0);
    let octahedron = Polyhedron { half_spaces: (0..8).map(side).collect() };
    let mut crossed = [0, 0];
    for _ in 0..2_000 {
        let ray = numbers.ray();
        for (k, (a, b)) in
            [(&round, &Sphere as &dyn Shape), (&flat, &octahedron as &dyn Shape)].into_iter().enumerate()
        {
            let (a, b) = (a.crossings(&ray, Cone::THIN), b.crossings(&ray, Cone::THIN));
            // Only a touch may be seen by one of them alone.
            let chord = |c: &[Crossing]| c.last().map_or(0.0, |last| last.t - c[0].t);
            if a.len() != b.len() {
                assert!(chord(&a).max(chord(&b)) < 1e-6, "{ray:?} {a:?} {b:?}");
                continue;
            }
            for (a, b) in a.iter().zip(&b) {
                assert!((a.t - b.t).abs() < 1e-12 / chord(std::slice::from_ref(a)).max(0.01) * 60.0);
                crossed[k] += 1;
            }
        }
    }
    assert!(crossed[0] > 1_500 && crossed[1] > 800, "{crossed:?}");
}

#[test]
fn a_star_of_small_exponents_has_every_crossing() {
    // x^(1/2) + y^(1/2) + z^(1/2) = 1: the line x + y = 1/2, z = 0 touches it; a little farther out it
    // crosses four times, through two arms.
    let star = Superellipsoid { n: 0.5, m: 0.5 };
    let ray = Ray { origin: [0.65, -0.05, 0.0], direction: [-1.0, 1.0, 0.0] };
    // sqrt x + sqrt y = 1 and x + y = 0.6: (sqrt x sqrt y) = 0.2, so sqrt x = (1 +- sqrt 0.2) / 2.
    let ts: Vec<f64> = star.crossings(&ray, Cone::THIN).iter().map(|c| c.t).collect();
    let root = |sign: f64| (1.0 + sign * libm::sqrt(0.2)) / 2.0;
    // Beyond the axes, |y| + |x| = 0.6 + 2 |y|.
    assert_eq!(ts.len(), 4, "{ts:?}");
    for (t, x) in [(ts[1], root(1.0)), (ts[2], root(-1.0))] {
        assert!((0.65 - t - x * x).abs() < 1e-14, "{t} {x}");
    }
}

#[test]
fn the_cube_cuts_an_implicit_surface_off() {
    let ray = Ray { origin: [-3.0, 0.0, 0.5], direction: [1.0, 0.0, 0.0] };
    let found = half_cube().crossings(&ray, Cone::THIN);
    assert_eq!(found.iter().map(|c| c.part).collect::<Vec<_>>(), [Part::Face(1), Part::Face(0)]);
    assert!(found[0].t == 2.0 && (found[1].t - 3.3).abs() < 1e-14, "{found:?}");
    let normal = half_cube().frame([-1.0, 0.0, 0.5], Part::Face(1)).normal;
    assert_eq!(normal, [-1.0, 0.0, 0.0]);
    let back = Ray { origin: [3.0, 0.0, 0.5], direction: [-1.0, 0.0, 0.0] };
    let found = half_cube().crossings(&back, Cone::THIN);
    assert_eq!(found.iter().map(|c| c.part).collect::<Vec<_>>(), [Part::Face(0), Part::Face(1)]);
}

#[test]
fn a_cone_has_one_nappe_and_rays_along_the_axis_meet_base_and_cap() {
    let cone = TaperedCylinder { cap: 0.0 };
    // Through the place of the other nappe, at z = 1.5.
    let ray = Ray { origin: [-3.0, 0.0, 1.5], direction: [1.0, 0.0, 0.0] };
    assert_eq!(cone.crossings(&ray, Cone::THIN), []);
    // Down through the other nappe into the tip's side.
    let ray = Ray { origin: [0.25, 0.0, 3.0], direction: [0.0, 0.0, -1.0] };
    let found = cone.crossings(&ray, Cone::THIN);
    assert_eq!(
        found.iter().map(|c| (c.t, c.part)).collect::<Vec<_>>(),
        [(2.25, Part::Face(0)), (3.0, Part::Face(1))]
    );
    for cap in [0.5, 1.0, 2.0] {
        let shape = TaperedCylinder { cap };
        let ray = Ray { origin: [0.2, 0.1, 3.0], direction: [0.0, 0.0, -2.0] };
        let found = shape.crossings(&ray, Cone::THIN);
        assert_eq!(
            found.iter().map(|c| (c.t, c.part)).collect::<Vec<_>>(),
            [(1.0, Part::Face(2)), (1.5, Part::Face(1))]
        );
    }
    // Along a side line of the cone, a little inside: a = 0.
    let ray = Ray { origin: [-0.9, 0.0, 0.0], direction: [1.0, 0.0, 1.0] };
    let found = cone.crossings(&ray, Cone::THIN);
    assert_eq!(found.len(), 2);
    assert!((found[1].t - 0.95).abs() < 1e-15 && found[1].part == Part::Face(0), "{found:?}");
}

#[test]
fn a_height_field_is_first_met_where_the_picture_of_a_height_field_says() {
    let knots = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let rough = |a: f64| Fif::interpolating(&knots, &[a, -a]).integral(0.0);
    let field = HeightField::new(rough(0.85), rough(0.5), 8);
    let mut numbers = Numbers::new(9);
    let (mut same, mut below) = (0, 0);
    for _ in 0..400 {
        let target = [1.0 + numbers.next(), 1.0 + numbers.next(), 0.0];
        let origin = [1.0 + 3.0 * numbers.next(), 1.0 + 3.0 * numbers.next(), 2.0 + numbers.next()];
        let ray = Ray { origin, direction: along(target, -1.0, origin) };
        for growth in [0.0, 0.05] {
            let cone = Cone { width: 0.0, growth };
            let found = field.crossings(&ray, cone);
            let hit = crate::height_field::trace(&field.x, &field.y, &ray, growth).hit;
            assert_eq!(found.is_empty(), hit.is_none());
            let (Some(first), Some(hit)) = (found.first(), hit) else { continue };
            let part = Part::Cell { level: hit.level, i: hit.i, j: hit.j };
            assert_eq!((first.t, first.part), (hit.t, part));
            assert!(found.windows(2).all(|pair| pair[0].t < pair[1].t));
            // From above, as a rule: a leaf may slope otherwise than the surface where the ray meets it.
            same += usize::from(first.enters);
            below += usize::from(!first.enters);
            let frame = field.frame(ray.at(first.t), part);
            let normal = crate::height_field::leaf_normal(&field.x, &field.y, &ray, &hit);
            assert_eq!(if first.enters { frame.normal } else { frame.normal.map(|c| -c) }, normal);
            assert!(dot(frame.p_u, frame.normal).abs() < 1e-12 && frame.p_u[0] == 2.0);
            assert!(dot(frame.p_v, frame.normal).abs() < 1e-12 && frame.p_v[1] == 2.0);
        }
    }
    assert!(same > 400 && below < same / 10, "{same} {below}");
}

/// A node is a leaf where its side in the world is no longer than the cone is wide there.
#[test]
fn a_leaf_of_a_moved_height_field_is_as_wide_as_the_cone_in_the_world() {
    let knots = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let rough = |a: f64| Fif::interpolating(&knots, &[a, -a]).integral(0.0);
    let mut numbers = Numbers::new(10);
    let (mut levels, mut between) = ([0; 9], 0);
    for scale in [[1.0, 1.0, 1.0], [3.0, 3.0, 0.5], [0.25, 0.5, 2.0], [2.0, 0.1, 5.0]] {
        let turn = Placing::rotation([1.0, 2.0, 3.0], 50.0);
        let placing = Placing::scaling(scale).then(&turn).then(&Placing::translation([1.0, -2.0, 3.0]));
        let shape = Box::new(HeightField::new(rough(0.85), rough(0.5), 8));
        let leaf = Leaf { shape, placing, materials: Vec::new() };
        for _ in 0..100 {
            let target = placing.point([1.0 + numbers.next(), 1.0 + numbers.next(), 0.0]);
            let origin = [0, 1, 2].map(|k| target[k] + 6.0 * numbers.next());
            let ray = Ray { origin, direction: along(target, -1.0, origin) };
            let cone = Cone { width: 0.1 + 0.1 * numbers.next(), growth: 0.2 + 0.2 * numbers.next() };
            let found = crate::world::walk::leaf_crossings(&leaf, &ray, cone);
            let Some(Crossing { t, part: Part::Cell { level, .. }, .. }) = found.first() else { continue };
            let wide = scale[0].max(scale[1]) * 2.0 * libm::exp2(-(*level as f64));
            levels[*level] += 1;
            // The middle of the interval is behind where the ray enters.
            assert!(*level == 8 || wide <= cone.at(*t) * (1.0 + 1e-12), "{scale:?} {level} {t}");
            between += usize::from(*level > 0 && 2.0 * wide > cone.at(*t));
        }
    }
    assert!(levels.iter().filter(|count| **count > 3).count() > 3 && between > 100, "{levels:?} {between}");
}
