//! Whole worlds whose light can be said beforehand.

use crate::camera::{Camera, Ray};
use crate::fif::Fif;
use crate::shade::{Environment, Finish};
use crate::vector::{Vector, along, dot, normalised};
use crate::world::laws::Numbers;
use crate::world::{
    Colour, Cube, HeightField, Interpenetration, Leaf, Light, Material, Object, Part, Pattern, Placing,
    Plane, Policy, Program, Shape, Specular, Sphere, Square, Superellipsoid, Surroundings, TaperedCylinder,
    Torus, World,
};

/// Looking north from the south, from a little above.
const CAMERA: Camera =
    Camera { eye: [0.0, -5.0, 1.5], look_at: [0.0, 0.0, 0.0], up: [0.0, 0.0, 1.0], field_of_view: 0.7 };
const CENTRE: [(f64, f64, f64); 1] = [(0.0, 0.0, 1.0)];
const WHITE: Colour = [1.0; 3];
const BLACK: Colour = [0.0; 3];

/// A world without lights, in the given surroundings.
fn empty(surroundings: Surroundings) -> World {
    World {
        leaves: Vec::new(),
        objects: Vec::new(),
        materials: Vec::new(),
        lights: Vec::new(),
        surroundings,
        camera: CAMERA,
        depth: 5,
        policy: Policy::Refuse,
        samples_per_axis: 1,
    }
}

/// The direction itself as a colour: what a ray shows is where it went.
fn compass() -> Surroundings {
    Surroundings::Picture(Box::new(|e| e.map(|c| (c + 1.0) / 2.0)))
}

/// The direction that a colour of the compass stands for.
fn direction(colour: Colour) -> Vector {
    colour.map(|c| 2.0 * c - 1.0)
}

impl World {
    /// Adds a leaf that is not yet in an object.
    fn leaf(&mut self, shape: impl Shape + 'static, placing: Placing, materials: &[usize]) -> Program {
        self.leaves.push(Leaf { shape: Box::new(shape), placing, materials: materials.to_vec() });
        Program::leaf(self.leaves.len() - 1)
    }

    /// Adds an object that is one shape.
    fn one(&mut self, shape: impl Shape + 'static, placing: Placing, material: Material) {
        let program = self.leaf(shape, placing, &[]);
        self.object(program, material);
    }

    fn object(&mut self, program: Program, material: Material) {
        self.materials.push(material);
        self.objects.push(Object { program, material: self.materials.len() - 1 });
    }

    fn seen(&self, origin: Vector, direction: Vector) -> Colour {
        self.light_along(&Ray { origin, direction }, 0.0).expect("no glass interpenetrates")
    }
}

fn at(x: f64, y: f64, z: f64) -> Placing {
    Placing::translation([x, y, z])
}

fn matte(colour: Colour) -> Material {
    Material::matte(Pattern::plain(colour))
}

fn assert_close(a: Vector, b: Vector, bound: f64) {
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= bound), "{a:?} is not {b:?}");
}

#[test]
fn the_lens_is_met_where_both_spheres_are() {
    let mut world = empty(Surroundings::Plain(BLACK));
    let (a, b) = (world.leaf(Sphere, at(0.5, 0.0, 0.0), &[]), world.leaf(Sphere, at(-0.5, 0.0, 0.0), &[]));
    world.object(a.intersection(b), matte(WHITE));
    // Along the axis from the left: into the left sphere at -1.5, into the right one at -0.5.
    let ray = Ray { origin: [-4.0, 0.0, 0.0], direction: [2.0, 0.0, 0.0] };
    assert_eq!(world.first_change(&ray), Some((0, 0, Part::Face(0), 1.75)));
    assert_eq!(
        world.crossings(&ray).iter().map(|c| (c.1, c.2.t)).collect::<Vec<_>>(),
        [(1, 1.25), (0, 1.75), (1, 2.25), (0, 2.75)]
    );
    // Through one sphere only.
    let ray = Ray { origin: [0.9, 0.0, 4.0], direction: [0.0, 0.0, -1.0] };
    assert_eq!(world.first_change(&ray), None);
    assert_eq!(world.crossings(&ray).len(), 2);
}

/// The text's bowl, `(S1 - S2) - C`: a cone with its tip in the middle opens it above.
fn bowl() -> World {
    let mut world = empty(Surroundings::Plain(BLACK));
    let (globe, hollow) =
        (world.leaf(Sphere, at(0.0, 0.0, 0.0), &[]), world.leaf(Sphere, Placing::scaling([0.8; 3]), &[1]));
    let cone = Placing::scaling([2.0, 2.0, -2.0]).then(&at(0.0, 0.0, 2.0));
    let cone = world.leaf(TaperedCylinder { cap: 0.0 }, cone, &[]);
    world.object(globe.difference(hollow).difference(cone), matte([0.5; 3]));
    let glow = Material { ambient: 1.0, diffuse: 0.0, ..matte([0.0, 0.25, 0.75]) };
    world.materials.push(glow);
    world
}

#[test]
fn one_ray_hits_the_bowl_at_its_first_crossing_and_another_at_its_fifth() {
    let world = bowl();
    let outside = Ray { origin: [0.0, -3.0, -0.2], direction: [0.0, 1.0, 0.0] };
    let (_, leaf, _, t) = world.first_change(&outside).expect("a hit");
    assert_eq!((leaf, t), (0, world.crossings(&outside)[0].2.t));
    assert!((t - (3.0 - libm::sqrt(0.96))).abs() < 1e-15);

    // Down through the opening and out of the cone into the cavity: into cone, globe and hollow, out of the
    // cone and the hollow.
    let through = Ray { origin: [-0.3, 0.0, 3.0], direction: [0.2, 0.0, -1.0] };
    let crossings = world.crossings(&through);
    assert_eq!(
        crossings.iter().map(|c| (c.1, c.2.enters)).collect::<Vec<_>>(),
        [(2, true), (0, true), (1, true), (2, false), (1, false), (0, false)]
    );
    let (_, leaf, part, t) = world.first_change(&through).expect("a hit");
    assert_eq!((leaf, t), (1, crossings[4].2.t));
    // The subtracted face's normal is turned round, towards the middle, and the material is its own.
    let point = world.point(&through, t, leaf, part, 0.0);
    assert_close(point.normal, point.position.map(|c| -c / 0.8), 1e-14);
    assert_eq!(world.seen(through.origin, through.direction), [0.0, 0.25, 0.75]);
}

#[test]
fn coincident_faces_of_a_difference_show_nothing_and_of_a_union_no_seam() {
    let halves = |x: f64| Placing::scaling([0.5, 1.0, 1.0]).then(&at(x, 0.0, 0.0));
    let mut cut = empty(Surroundings::Plain(WHITE));
    let (block, half) = (cut.leaf(Cube, Placing::IDENTITY, &[]), cut.leaf(Cube, halves(0.5), &[]));
    cut.object(block.difference(half), matte(BLACK));
    // Two bounces are enough for a plate, and not for a plate with a seam.
    let mut joined = World { depth: 1, ..empty(compass()) };
    let (left, right) = (joined.leaf(Cube, halves(-0.5), &[]), joined.leaf(Cube, halves(0.5), &[]));
    joined.object(left.union(right), Material { fresnel: false, ..Material::glass(1.5) });
    let mut numbers = Numbers::new(1);
    let mut counts = [0, 0];
    for k in 0..2_000 {
        // Half of them past what is left, all of them through what is cut off.
        let to = [0.5 * (numbers.next() + 1.0), 0.9 * numbers.next(), 0.9 * numbers.next()];
        let from = [if k % 2 == 0 { to[0] } else { 3.0 }, to[1] + 0.3 * numbers.next(), 3.0];
        let ray = Ray { origin: from, direction: along(to, -1.0, from) };
        match cut.first_change(&ray) {
            None => counts[0] += 1,
            Some((_, leaf, _, t)) => {
                // What is left lies at x <= 0; its cut is the other cube's face.
                let x = ray.at(t)[0];
                assert!(k % 2 == 1 && x < 1e-12 && (leaf == 1) == (x.abs() < 1e-12), "{leaf} {x}");
                counts[1] += 1;
            }
        }
        let d = normalised([1.0, 0.2 * to[1], 0.2 * to[2]]);
        assert_close(direction(joined.seen([-3.0, to[1] / 4.0, to[2] / 4.0], d)), d, 1e-14);
    }
    assert!(counts[0] >= 1_000 && counts[1] > 300, "{counts:?}");
}

/// Shapes of every kind, side by side.
fn crowd(world: &mut World, material: impl Fn() -> Material) {
    let scaled = |x: f64, z: f64| Placing::scaling([0.45, 0.5, 0.4]).then(&at(x, 0.1 * x, z));
    let turned = |x: f64, z: f64| Placing::rotation([1.0, 0.7, 0.2], 50.0).then(&scaled(x, z));
    world.one(Sphere, scaled(-1.0, 0.6), material());
    world.one(Cube, turned(0.0, 0.6), material());
    world.one(Torus { tube: 0.4 }, turned(1.0, 0.6), material());
    world.one(TaperedCylinder { cap: 0.3 }, turned(-1.0, -0.5), material());
    world.one(Superellipsoid { n: 3.5, m: 2.5 }, turned(0.0, -0.5), material());
    world.one(Superellipsoid { n: 0.7, m: 1.5 }, turned(1.0, -0.5), material());
    let (ball, hole) =
        (world.leaf(Sphere, at(0.3, 1.5, 0.2), &[]), world.leaf(Sphere, at(0.3, 0.9, 0.4), &[]));
    world.object(ball.difference(hole), material());
    world.one(Square, turned(0.5, 0.1), material());
}

#[test]
fn in_a_white_furnace_nothing_that_keeps_its_light_is_seen() {
    let coloured = |kr: Colour| Material {
        reflect: kr,
        transmit: kr.map(|c| 1.0 - c),
        fresnel: true,
        ..Material::glass(1.5)
    };
    let materials: [Box<dyn Fn() -> Material>; 6] = [
        Box::new(|| Material::glass(1.5)),
        Box::new(|| Material { fresnel: false, ..Material::glass(2.4) }),
        Box::new(|| Material::glass(0.6)),
        Box::new(Material::mirror),
        Box::new(move || coloured([0.1, 0.5, 0.9])),
        Box::new(|| Material { ambient: 1.0, diffuse: 0.0, ..matte(WHITE) }),
    ];
    let mut worst = 0.0_f64;
    for material in &materials {
        for depth in [0, 1, 4] {
            let mut world = World { depth, policy: Policy::Priority, ..empty(Surroundings::Plain(WHITE)) };
            crowd(&mut world, material);
            for light in world.picture(24, 16, &CENTRE).expect("allowed") {
                worst = light.iter().fold(worst, |worst, c| worst.max((c - 1.0).abs()));
            }
            // The objects are there.
            world.surroundings = Surroundings::Plain(BLACK);
            world.lights = vec![Light::Distant { towards: [0.0, -1.0, 1.0], colour: WHITE }];
            let shapes = (0..384).filter(|k| {
                let ray = CAMERA.ray(24, 16, (k % 24, k / 24), (0.0, 0.0));
                world.first_change(&ray).is_some()
            });
            let count = shapes.count();
            assert!(count > 60, "{count}");
        }
    }
    assert!(worst < 1e-14, "{worst:e}");
}

#[test]
fn snell_bends_at_both_faces_of_a_plate_and_the_ray_goes_on_in_parallel() {
    let mut world = empty(compass());
    let plain = || Material { fresnel: false, ..Material::glass(1.5) };
    world.one(Cube, Placing::scaling([40.0, 40.0, 0.5]), plain());
    let d = normalised([0.8, 0.1, -0.7]);
    let from = along([0.0; 3], -3.0, d);
    assert_close(direction(world.seen(from, d)), d, 1e-15);
    // From inside, the sine grows by half.
    let d = normalised([0.4, 0.2, -1.0]);
    assert_close(direction(world.seen([0.0; 3], d)), [1.5 * d[0], 1.5 * d[1], -bent(1.5, d)], 1e-15);
    // Beyond the critical angle all is reflected, for ever: at depth 5 it shows the direction that it has.
    let d = normalised([1.0, 0.0, -0.5]);
    for depth in 0..4 {
        world.depth = depth;
        let up = if depth % 2 == 0 { -d[2] } else { d[2] };
        assert_close(direction(world.seen([0.0; 3], d)), [d[0], 0.0, up], 1e-15);
    }
}

#[test]
fn no_distance_is_too_short_to_be_seen() {
    for thickness in [1e-1, 1e-3, 1e-5] {
        // Out at the other side of the thinnest plate.
        let mut world = empty(compass());
        let plate = Placing::scaling([1.0, 1.0, thickness]);
        world.one(Cube, plate, Material { fresnel: false, ..Material::glass(1.5) });
        let d = normalised([0.4, 0.1, -1.0]);
        assert_close(direction(world.seen(along([0.0; 3], -2.0, d), d)), d, 1e-10);
        // What lies as near as that over a floor throws its shade on it, and hides it from an eye between.
        let mut world = empty(Surroundings::Plain(BLACK));
        world.lights = vec![Light::Distant { towards: [0.0, 0.0, 1.0], colour: WHITE }];
        world.one(Plane, Placing::IDENTITY, matte(WHITE));
        world.one(Square, at(0.0, 0.0, thickness), Material { ambient: 0.5, ..matte(WHITE) });
        let eye = [0.1, 0.2, thickness / 2.0];
        assert_eq!(world.seen(eye, [0.0, 0.0, -1.0]), BLACK);
        assert_eq!(world.seen(eye, [0.0, 0.0, 1.0]), [0.5; 3]);
    }
}

/// The cosine behind a level face.
fn bent(eta: f64, d: Vector) -> f64 {
    libm::sqrt(1.0 - eta * eta * (d[0] * d[0] + d[1] * d[1]))
}

#[test]
fn a_ball_of_glass_turns_light_by_twice_the_difference_of_its_angles() {
    let mut numbers = Numbers::new(2);
    for scale in [0.01, 1.0, 20.0] {
        let mut world = empty(compass());
        let size = Placing::scaling([scale; 3]).then(&at(3.0, -4.0, 5.0));
        world.one(Sphere, size, Material { fresnel: false, ..Material::glass(1.5) });
        for _ in 0..300 {
            let b = 0.99 * numbers.next();
            let from = [3.0 + scale * b, -4.0, 5.0 + 2.0 * scale];
            let angle = 2.0 * (libm::asin(b) - libm::asin(b / 1.5));
            let out = [-libm::sin(angle), 0.0, -libm::cos(angle)];
            assert_close(direction(world.seen(from, [0.0, 0.0, -1.0])), out, 1e-11);
        }
    }
}

#[test]
fn glass_in_a_medium_of_its_own_index_is_not_seen_and_in_water_it_has_the_relative_index() {
    let glass = |index: f64, priority: i32| Material { fresnel: false, priority, ..Material::glass(index) };
    let ball = |outer: f64, inner: f64, high: i32| {
        let mut world = empty(compass());
        world.one(Cube, Placing::scaling([3.0, 30.0, 30.0]), glass(outer, 0));
        world.one(Sphere, Placing::IDENTITY, glass(inner, high));
        world
    };
    let d = [1.0, 0.0, 0.0];
    let mut numbers = Numbers::new(3);
    for _ in 0..200 {
        let b = 0.8 * numbers.next();
        // The same index; and a ball of a lower priority than the water: neither is there, and of the second
        // no ray is spawned.
        let hidden = World { depth: 1, ..ball(1.33, 2.0, -1) };
        for world in [ball(1.33, 1.33, 1), hidden] {
            let d = normalised([1.0, 0.1, 0.0]);
            assert_close(direction(world.seen([-5.0, b, 0.0], d)), d, 1e-14);
        }
        let world = ball(1.33, 1.5, 1);
        let turned = 2.0 * (libm::asin(b) - libm::asin(b * 1.33 / 1.5));
        // Out of the water, whose face is at right angles to x.
        let sine = -1.33 * libm::sin(turned);
        let out = [libm::sqrt(1.0 - sine * sine), sine, 0.0];
        assert_close(direction(world.seen([-5.0, b, 0.0], d)), out, 1e-11);
    }
    // Of equal priorities the last named counts, where that is allowed.
    let mut world = ball(1.33, 1.5, 0);
    let ray = Ray { origin: [-5.0, 0.5, 0.0], direction: d };
    assert_eq!(world.light_along(&ray, 0.0), Err(Interpenetration(0, 1)));
    world.policy = Policy::Priority;
    let allowed = world.light_along(&ray, 0.0).expect("allowed");
    assert_close(allowed, ball(1.33, 1.5, 1).seen(ray.origin, d), 1e-15);
    // Beside the ball they do not meet.
    world.policy = Policy::Refuse;
    assert!(world.light_along(&Ray { origin: [-5.0, 1.5, 0.0], ..ray }, 0.0).is_ok());
}

#[test]
fn an_eye_in_the_middle_of_a_ball_of_glass_sees_straight_out() {
    let mut world = empty(compass());
    world.one(Sphere, Placing::IDENTITY, Material { fresnel: false, ..Material::glass(1.5) });
    let mut numbers = Numbers::new(4);
    for _ in 0..100 {
        let d = normalised(numbers.vector());
        assert_close(direction(world.seen([0.0; 3], d)), d, 1e-14);
        // From nearer the skin, the sine of the angle to the radius grows.
        let from = [0.5, 0.0, 0.0];
        let out = direction(world.seen(from, d));
        assert!((dot(out, out) - 1.0).abs() < 1e-13);
    }
}

#[test]
fn no_secondary_ray_sees_the_surface_that_it_leaves() {
    // A mirror ball, seen from all sides, at three scales and far from the origin: always the sky.
    let mut numbers = Numbers::new(5);
    let mut hits = 0;
    for scale in [1e-3, 1.0, 20.0] {
        for shape in 0..3 {
            let mut world = empty(compass());
            let place = Placing::scaling([scale, 0.5 * scale, scale]).then(&at(11.0, -40.0, 7.0));
            match shape {
                0 => world.one(Sphere, place, Material::mirror()),
                1 => world.one(Cube, place, Material::mirror()),
                _ => world.one(Superellipsoid { n: 2.5, m: 4.0 }, place, Material::mirror()),
            }
            for _ in 0..200 {
                let from = along([11.0, -40.0, 7.0], 1.5 * scale, normalised(numbers.vector()));
                let to = along([11.0, -40.0, 7.0], 0.9 * scale, numbers.vector());
                let ray = Ray { origin: from, direction: normalised(along(to, -1.0, from)) };
                if world.states_at(from)[0] {
                    continue;
                }
                let Some((_, leaf, part, t)) = world.first_change(&ray) else { continue };
                let n = world.point(&ray, t, leaf, part, 0.0).normal;
                let mirrored = along(ray.direction, -2.0 * dot(ray.direction, n), n);
                assert_close(direction(world.seen(from, ray.direction)), mirrored, 1e-14);
                hits += 1;
            }
        }
    }
    assert!(hits > 800, "{hits}");
}

#[test]
fn a_ball_throws_a_round_shadow_and_glass_one_of_its_colour() {
    for glass in [false, true] {
        let mut world = empty(Surroundings::Plain(BLACK));
        world.lights = vec![Light::Distant { towards: [1.0, 0.0, 1.0], colour: [0.5, 1.0, 0.25] }];
        world.one(Plane, Placing::IDENTITY, matte(WHITE));
        let tinted = Material { transmit: [0.5, 1.0, 0.0], ..Material::glass(1.5) };
        world.one(Sphere, at(0.0, 0.0, 3.0), if glass { tinted } else { matte(WHITE) });
        // In and out again, straight through.
        let passed = if glass { [0.25, 1.0, 0.0] } else { BLACK };
        let lambert = libm::sqrt(0.5);
        let (mut lit, mut shaded) = (0, 0);
        for i in -30..30 {
            for j in -20..20 {
                let (x, y) = (f64::from(i) / 5.0 + 0.013, f64::from(j) / 10.0 + 0.017);
                // The distance of the ball's middle from the ray to the light.
                let off = [x, y, -3.0];
                let (s, all) = (dot(off, [lambert, 0.0, lambert]), dot(off, off));
                let shade = all - s * s < 1.0;
                // From beside, under the ball.
                let colour = world.seen([x, y, 0.5], [0.0, 0.0, -1.0]);
                let expected =
                    [0, 1, 2].map(|k| [0.5, 1.0, 0.25][k] * lambert * if shade { passed[k] } else { 1.0 });
                assert_close(colour, expected, 1e-15);
                *(if shade { &mut shaded } else { &mut lit }) += 1;
            }
        }
        assert!(lit > 1_000 && shaded > 150, "{lit} {shaded}");
    }
}

#[test]
fn a_point_light_shines_as_far_as_it_stands() {
    let mut world = empty(Surroundings::Plain(BLACK));
    world.lights = vec![Light::Point { at: [0.0, 0.0, 2.0], colour: WHITE }];
    world.one(Plane, Placing::IDENTITY, matte(WHITE));
    // Behind the light, and so no shade.
    world.one(Sphere, at(0.0, 0.0, 4.0), matte(WHITE));
    assert_close(world.seen([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), WHITE, 1e-15);
    // At a slope, equally bright at any distance.
    assert_close(world.seen([4.0, 0.0, 0.1], [0.0, 0.0, -1.0]), [1.0 / libm::sqrt(5.0); 3], 1e-15);
    // Not behind the ball any more.
    world.lights = vec![Light::Point { at: [0.0, 0.0, 6.0], colour: WHITE }];
    assert_eq!(world.seen([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), BLACK);
}

#[test]
fn a_square_is_seen_and_throws_its_shade_from_either_side() {
    for turn in [0.0, 180.0] {
        let mut world = empty(Surroundings::Plain(BLACK));
        world.lights = vec![Light::Distant { towards: [0.0, 0.0, 1.0], colour: WHITE }];
        let place = Placing::rotation([1.0, 0.0, 0.0], turn).then(&at(0.0, 0.0, 1.0));
        world.one(Square, place, Material { ambient: 0.25, ..matte(WHITE) });
        world.one(Plane, Placing::IDENTITY, matte(WHITE));
        // From above lit, from below by its ambient part alone; the floor under it in its shade.
        assert_close(world.seen([0.3, 0.3, 3.0], [0.0, 0.0, -1.0]), [1.25; 3], 1e-15);
        assert_close(world.seen([0.3, 0.3, 0.5], [0.0, 0.0, 1.0]), [0.25; 3], 1e-15);
        assert_eq!(world.seen([0.3, 0.3, 0.5], [0.0, 0.0, -1.0]), BLACK);
        assert_close(world.seen([1.3, 0.3, 0.5], [0.0, 0.0, -1.0]), WHITE, 1e-15);
        // A mirror is left from either side without being met again.
        world.materials[0] = Material::mirror();
        world.surroundings = compass();
        let above = world.seen([-1.5, 0.0, 3.0], [0.6, 0.0, -0.8]);
        assert_close(direction(above), [0.6, 0.0, 0.8], 1e-15);
        // From below it shows the floor in its shade.
        assert_eq!(world.seen([-0.5, 0.0, 0.5], [0.6, 0.0, 0.8]), BLACK);
    }
}

#[test]
fn what_is_too_far_away_is_not_seen() {
    let mut world = empty(compass());
    world.one(Plane, Placing::IDENTITY, Material { ambient: 1.0, ..matte(BLACK) });
    let sees = |from: Vector, to: Vector| world.seen(from, along(to, -1.0, from)) == BLACK;
    assert!(sees([0.0, 0.0, 1.0], [63.9, 0.0, 0.0]) && !sees([0.0, 0.0, 1.0], [64.1, 0.0, 0.0]));
    // Along a direction of unit length, t is a distance.
    let down = |from: Vector| world.seen(from, [0.0, 0.0, -1.0]) == BLACK;
    assert!(down([0.0, -63.0, 127.9]) && !down([0.0, -63.0, 128.1]) && !down([0.0, -65.0, 1.0]));
    // Beyond the world's end nothing throws a shade either.
    let mut world = empty(Surroundings::Plain(BLACK));
    world.lights = vec![Light::Distant { towards: [0.0, 0.0, 1.0], colour: WHITE }];
    world.one(Plane, Placing::IDENTITY, matte(WHITE));
    for (z, light) in [(63.9, BLACK), (64.1, WHITE)] {
        world.one(Square, at(0.0, 0.0, z), matte(WHITE));
        assert_eq!(world.seen([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), light);
        world.objects.pop();
    }
}

#[test]
fn two_mirrors_face_each_other_down_to_the_depth() {
    let mut world = empty(Surroundings::Plain([0.5, 0.25, 1.0]));
    let mirror = || Material { reflect: [0.5, 0.5, 0.25], ..Material::mirror() };
    world.one(Plane, Placing::IDENTITY, mirror());
    world.one(Plane, Placing::scaling([1.0, 1.0, -1.0]).then(&at(0.0, 0.0, 2.0)), mirror());
    for depth in 0..6 {
        world.depth = depth;
        let power = |c: f64| libm::pow(c, depth as f64 + 1.0);
        let light = world.seen([0.0, 0.0, 1.0], [0.1, 0.0, -1.0]);
        assert_close(light, [0.5 * power(0.5), 0.25 * power(0.5), power(0.25)], 1e-15);
    }
    // Eight bounces are worth 1/256, and the ninth is not: there the light is that of the surroundings.
    world.depth = 50;
    let light = world.seen([0.0, 0.0, 1.0], [0.1, 0.0, -1.0]);
    let expected = [0.5 / 512.0, 0.25 / 512.0, libm::pow(0.25, 9.0)];
    assert_close(light, expected, 1e-15);
}

#[test]
fn a_bump_tilts_what_is_lit_and_a_frame_turns_the_grain() {
    let mut world = empty(Surroundings::Plain(BLACK));
    let l = normalised([0.6, 0.0, 0.8]);
    world.lights = vec![Light::Distant { towards: l, colour: WHITE }];
    let bump = |slope: f64| Material { bump: Some(Pattern::plain([slope, 0.0])), ..matte(WHITE) };
    for (scale, slope) in [(1.0, -0.5), (2.0, -1.0)] {
        // P_u is as long as the plane is stretched: the slope in space is the same.
        world.one(Plane, Placing::scaling([scale, 1.0, 1.0]), bump(slope));
        let n = normalised([0.5, 0.0, 1.0]);
        assert_close(world.seen([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), [dot(n, l); 3], 1e-15);
        (world.objects, world.leaves, world.materials) = (Vec::new(), Vec::new(), Vec::new());
    }
    let grain = |angle: f64| {
        let ward = Specular::Ward { colour: WHITE, along: 0.1, across: 0.5 };
        let frame = Some(Pattern::plain(angle));
        Material { diffuse: 0.0, specular: ward, frame, ..matte(WHITE) }
    };
    let bright = [0.0, core::f64::consts::FRAC_PI_2].map(|angle| {
        world.one(Plane, Placing::IDENTITY, grain(angle));
        let bright = world.seen([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])[0];
        (world.objects, world.leaves, world.materials) = (Vec::new(), Vec::new(), Vec::new());
        bright
    });
    assert!(bright[1] > 50.0 * bright[0] && bright[0] >= 0.0, "{bright:?}");
}

#[test]
fn a_bump_sends_no_light_through_a_mirror_and_none_back_from_clear_glass() {
    let bump = |slope: f64| Some(Pattern::plain([slope, 0.0]));
    let mirroring = |slope: f64| {
        let mut world = empty(compass());
        world.one(Plane, Placing::IDENTITY, Material { bump: bump(slope), ..Material::mirror() });
        world
    };
    // A slope that falls away from the ray: mirrored there it goes down, and is mirrored once more.
    let (d, n) = (normalised([1.0, 0.0, -0.1]), normalised([0.08, 0.0, 1.0]));
    let m = along(d, -2.0 * dot(d, n), n);
    assert!(dot(d, n) < 0.0 && m[2] < -0.05);
    assert_close(direction(mirroring(-0.08).seen([-1.0, 0.0, 0.1], d)), [m[0], 0.0, -m[2]], 1e-14);
    // One that falls away further is seen from behind: the plane itself mirrors.
    assert_close(direction(mirroring(-0.2).seen([-1.0, 0.0, 0.1], d)), [d[0], 0.0, -d[2]], 1e-14);
    // A slope that stands against the ray, before an index of 1/2: bent there the ray would go up again, and
    // at the plane it is reflected totally.
    let mut world = empty(compass());
    let glass = Material { fresnel: false, bump: bump(20.0), ..Material::glass(0.5) };
    world.one(Plane, Placing::IDENTITY, glass);
    let (d, n) = (normalised([1.0, 0.0, -0.02]), normalised([-20.0, 0.0, 1.0]));
    let t = super::refraction::refracted(d, n, 2.0).expect("almost straight on");
    assert!(t[2] > 0.005 && super::refraction::refracted(d, [0.0, 0.0, 1.0], 2.0).is_none());
    let m = along(d, -2.0 * dot(d, n), n);
    assert!(m[2] > 0.05);
    assert_close(direction(world.seen([-1.0, 0.0, 0.02], d)), m, 1e-14);
}

#[test]
fn a_sample_is_cut_off_at_white_before_it_is_weighed() {
    let mut world = empty(Surroundings::Plain([3.0, 0.5, 1.0]));
    world.one(Sphere, at(0.0, 0.0, 0.0), Material { ambient: 0.25, diffuse: 0.0, ..matte(WHITE) });
    let samples = [(0.0, 0.0, 0.5), (-8.0, 0.0, 0.5)];
    let light = world.pixel(16, 16, (8, 8), &samples).expect("opaque");
    assert_close(light, [0.625, 0.375, 0.625], 1e-15);
}

#[test]
fn a_mirroring_height_field_is_the_picture_of_a_height_field() {
    let knots = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
    let rough = Fif::interpolating(&knots, &[0.85, -0.85]).integral(0.0);
    let field = HeightField::new(rough.clone(), rough, 8);
    let camera = Camera { eye: [1.0, -3.0, 4.0], look_at: [1.0, 1.0, 0.5], ..CAMERA };
    let (zenith, horizon, nadir) = (0.9, 0.5, 0.25);
    let grey = crate::picture::Scene {
        x: field.x.clone(),
        y: field.y.clone(),
        camera,
        material: Finish::Mirror,
        environment: Environment::Gradient { zenith, horizon, nadir },
        light: [0.0, 0.0, 1.0],
        samples_per_axis: 1,
    };
    let tone = |tone: f64| [tone; 3];
    let sky = Surroundings::Gradient { zenith: tone(zenith), horizon: tone(horizon), nadir: tone(nadir) };
    let mut world = World { camera, depth: 0, ..empty(sky) };
    world.one(field.clone(), Placing::IDENTITY, Material::mirror());
    let tones = crate::picture::render(&grey, 48, 36, &CENTRE);
    let (mut surface, colours) = (0, world.picture(48, 36, &CENTRE).expect("opaque"));
    for (tone, colour) in tones.iter().zip(colours) {
        // There a mirror that points below the surface is what it is; here it is at the leaf's normal too.
        assert_close(colour, [*tone; 3], 1e-12);
        surface += 1;
    }
    assert_eq!(surface, 48 * 36);
    // Glass keeps its light in the furnace, at any depth.
    let mut furnace = World { camera, depth: 4, ..empty(Surroundings::Plain(WHITE)) };
    furnace.one(field, Placing::IDENTITY, Material::glass(1.5));
    for light in furnace.picture(24, 18, &CENTRE).expect("one medium") {
        assert_close(light, WHITE, 1e-14);
    }
}
