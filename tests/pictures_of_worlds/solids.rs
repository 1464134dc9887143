//! Worlds without glass: solids cut out of solids, flat things, faces in one plane, mirrors.

use attractor::trace::world::Op;

use super::{
    BLUE, GREEN, Kind, Light, Material, Move, OPAQUE, Part, RED, SAND, Scale, Scene, Shine, Step, Turn,
    Vector, WHITE, assert_same, matt, mirror, shiny, single, sun,
};

#[test]
fn a_bowl_and_its_shadows() {
    use Op::{Difference, Leaf};
    let bowl = vec![Leaf(0), Leaf(1), Difference, Leaf(2), Difference];
    assert_same(
        &Scene {
            name: "bowl",
            parts: vec![
                Part(Kind::Sphere, &[], &[0]),
                Part(Kind::Sphere, &[Scale([0.8; 3])], &[1]),
                Part(Kind::Cylinder(0.0), &[Scale([2.0, 2.0, -2.0]), Move([0.0, 0.0, 2.0])], &[2]),
                Part(Kind::Plane, &[Move([0.0, 0.0, -1.0])], &[3]),
            ],
            programs: vec![bowl, vec![Leaf(3)]],
            materials: vec![
                shiny(RED, WHITE, Shine::Phong(30)),
                matt(SAND),
                matt(GREEN),
                matt([0.5, 0.5, 0.625]),
            ],
            lights: vec![sun(0.5), Light::Point([1.5, -1.0, 2.5], [0.5, 0.5, 0.375])],
            eye: [1.5, -3.5, 3.0],
            look_at: [0.0, 0.0, -0.3],
            degrees: 38.0,
            seen: vec![500, 500, 100, 1000],
        },
        OPAQUE,
    );
}

#[test]
fn a_rocket() {
    use Op::{Difference, Leaf, Union};
    // body, nose, a window that is drilled, three fins, a nozzle
    let rocket = vec![
        Leaf(0),
        Leaf(1),
        Union,
        Leaf(2),
        Difference,
        Leaf(3),
        Union,
        Leaf(4),
        Union,
        Leaf(5),
        Union,
        Leaf(6),
        Union,
    ];
    const FIN: Step = Scale([0.5, 0.04, 0.4]);
    assert_same(
        &Scene {
            name: "rocket",
            parts: vec![
                Part(Kind::Cylinder(1.0), &[Scale([0.4, 0.4, 1.5])], &[0, 3, 3]),
                Part(Kind::Cylinder(0.0), &[Scale([0.4, 0.4, 0.9]), Move([0.0, 0.0, 1.5])], &[1]),
                Part(
                    Kind::Cylinder(1.0),
                    &[Scale([0.15, 0.15, 2.0]), Turn([1.0, 0.0, 0.0], 90.0), Move([0.0, 1.0, 1.1])],
                    &[2],
                ),
                Part(Kind::Cube, &[FIN, Move([0.5, 0.0, 0.3]), Turn([0.0, 0.0, 1.0], 20.0)], &[1]),
                Part(Kind::Cube, &[FIN, Move([0.5, 0.0, 0.3]), Turn([0.0, 0.0, 1.0], 140.0)], &[1]),
                Part(Kind::Cube, &[FIN, Move([0.5, 0.0, 0.3]), Turn([0.0, 0.0, 1.0], 260.0)], &[1]),
                Part(Kind::Cylinder(0.6), &[Scale([0.35, 0.35, 0.4]), Move([0.0, 0.0, -0.39])], &[2]),
                Part(Kind::Plane, &[Move([0.0, 0.0, -0.8])], &[4]),
            ],
            programs: vec![rocket, vec![Leaf(7)]],
            materials: vec![
                shiny([0.75; 3], WHITE, Shine::Phong(60)),
                shiny(RED, [0.5; 3], Shine::Phong(12)),
                matt(BLUE),
                matt(GREEN),
                matt(SAND),
            ],
            lights: vec![sun(0.75), Light::Point([3.0, -4.0, 1.0], [0.25, 0.25, 0.375])],
            eye: [1.2, -5.0, 0.9],
            look_at: [0.0, 0.0, 0.7],
            degrees: 38.0,
            seen: vec![300, 100, 20, 50, 20, 20, 20, 500],
        },
        OPAQUE,
    );
}

/// A cube with its top cut off and its sides leaning.
const CUT: &[(Vector, f64)] = &[
    ([0.0, 0.0, -1.0], 0.5),
    ([1.0, 0.0, 0.5], 0.75),
    ([-1.0, 0.25, 0.5], 0.75),
    ([0.25, 1.0, 0.5], 0.75),
    ([0.0, -1.0, 0.25], 0.75),
    ([0.25, -0.5, 1.0], 0.625),
];

/// Five corners on the plane `z = x / 2 + y / 4`.
const PENTAGON: &[Vector] =
    &[[1.0, 0.0, 0.5], [0.25, 1.0, 0.375], [-0.75, 0.5, -0.25], [-0.75, -0.5, -0.5], [0.25, -1.0, -0.125]];

#[test]
fn flat_things_with_every_highlight() {
    assert_same(
        &Scene {
            name: "flat things, all highlights",
            parts: vec![
                Part(
                    Kind::Cube,
                    &[Scale([0.6, 0.6, 0.6]), Turn([0.0, 0.0, 1.0], 33.0), Move([-1.1, 0.0, 0.6])],
                    &[0, 1, 2, 3, 0, 1],
                ),
                Part(Kind::Polyhedron(CUT), &[Move([0.9, -0.4, 0.5])], &[1, 1, 2, 2, 3, 3]),
                Part(Kind::Polygon(PENTAGON), &[Turn([1.0, 0.0, 0.0], 40.0), Move([0.3, 1.5, 1.2])], &[2]),
                Part(
                    Kind::Square,
                    &[Scale([0.7, 0.5, 1.0]), Turn([1.0, 0.3, 0.0], 70.0), Move([-0.3, -1.4, 0.7])],
                    &[3],
                ),
                Part(Kind::Sphere, &[Scale([0.45; 3]), Move([-1.0, -1.9, 0.45])], &[3]),
                Part(Kind::Plane, &[], &[4]),
            ],
            programs: single(0..6),
            materials: vec![
                shiny(RED, [0.75; 3], Shine::Phong(20)),
                shiny(GREEN, [0.75; 3], Shine::Rough(0.25, 0.25)),
                shiny(BLUE, WHITE, Shine::Rough(0.4, 0.125)),
                shiny(SAND, [0.5; 3], Shine::Brushed(0.15, 0.4)),
                shiny([0.375; 3], [0.25; 3], Shine::Brushed(0.4, 0.2)),
            ],
            lights: vec![sun(0.5), Light::Point([0.5, -3.0, 3.0], [0.5; 3])],
            eye: [0.3, -5.5, 3.0],
            look_at: [0.0, 0.0, 0.5],
            degrees: 36.0,
            seen: vec![300, 500, 200, 300, 200, 1000],
        },
        OPAQUE,
    );
}

#[test]
fn a_torus_a_sphere_and_a_plane_that_mirror() {
    assert_same(
        &Scene {
            name: "mirrors",
            parts: vec![
                Part(Kind::Torus(0.4), &[Turn([1.0, 0.5, 0.0], 60.0), Move([-0.7, 0.3, 1.2])], &[0]),
                Part(Kind::Sphere, &[Scale([0.7; 3]), Move([1.2, 0.0, 0.7])], &[1]),
                Part(Kind::Plane, &[], &[2]),
            ],
            programs: single(0..3),
            materials: vec![
                Material { reflect: [0.5, 0.5, 0.25], ..shiny(SAND, [0.5; 3], Shine::Phong(40)) },
                mirror([0.9375; 3]),
                Material { reflect: [0.5; 3], ..matt([0.25, 0.375, 0.25]) },
            ],
            lights: vec![sun(0.75), Light::Point([2.0, -3.0, 4.0], [0.375; 3])],
            eye: [0.5, -5.0, 2.2],
            look_at: [0.1, 0.0, 0.7],
            degrees: 40.0,
            seen: vec![800, 500, 1000],
        },
        OPAQUE,
    );
}

#[test]
fn scaled_differently_along_each_axis() {
    assert_same(
        &Scene {
            name: "scales",
            parts: vec![
                Part(
                    Kind::Sphere,
                    &[Scale([0.8, 0.3, 0.5]), Turn([0.0, 0.0, 1.0], 30.0), Move([-1.3, 0.3, 0.5])],
                    &[0],
                ),
                Part(
                    Kind::Torus(0.45),
                    // turned before it is scaled: sheared
                    &[Turn([1.0, 0.4, 0.1], 50.0), Scale([0.7, 0.5, 0.35]), Move([0.1, -0.5, 0.6])],
                    &[1],
                ),
                Part(
                    Kind::Cylinder(0.5),
                    &[Scale([0.6, 0.3, 1.4]), Turn([0.0, 1.0, 0.3], 25.0), Move([1.0, 0.5, 0.2])],
                    &[2],
                ),
                Part(
                    Kind::Cube,
                    &[Turn([1.0, 1.0, 0.0], 35.0), Scale([0.2, 0.7, 0.4]), Move([-0.3, 1.4, 1.0])],
                    &[3],
                ),
                Part(Kind::Plane, &[Turn([1.0, 0.0, 0.0], 4.0)], &[4]),
            ],
            programs: single(0..5),
            materials: vec![
                shiny(RED, WHITE, Shine::Phong(25)),
                shiny(SAND, [0.75; 3], Shine::Brushed(0.15, 0.4)),
                shiny(BLUE, WHITE, Shine::Rough(0.3, 0.25)),
                shiny(GREEN, [0.5; 3], Shine::Phong(10)),
                matt([0.5; 3]),
            ],
            lights: vec![sun(0.5), Light::Point([1.0, -3.0, 3.5], [0.5; 3])],
            eye: [0.3, -5.0, 2.5],
            look_at: [0.0, 0.0, 0.6],
            degrees: 38.0,
            seen: vec![300, 300, 300, 150, 1000],
        },
        OPAQUE,
    );
}

/// Faces in one plane: one colour all over, that of the last named, and no speckle.
#[test]
fn faces_in_one_plane() {
    use Op::{Difference, Intersection, Leaf, Union};
    const TURN: Step = Turn([0.3, 1.0, 0.2], 20.0);
    assert_same(
        &Scene {
            name: "faces in one plane",
            parts: vec![
                Part(Kind::Cube, &[Scale([0.5, 0.6, 0.5]), TURN, Move([-1.2, 0.0, 0.9])], &[0]),
                Part(
                    Kind::Cube,
                    &[Scale([0.4, 0.3, 0.5]), Move([0.2, 0.1, 0.0]), TURN, Move([-1.2, 0.0, 0.9])],
                    &[1],
                ),
                Part(Kind::Cube, &[Scale([0.6, 0.6, 0.5]), TURN, Move([0.5, 0.0, 0.9])], &[2]),
                Part(
                    Kind::Cube,
                    &[Scale([0.4, 0.6, 0.5]), Move([0.3, 0.0, 0.0]), TURN, Move([0.5, 0.0, 0.9])],
                    &[3],
                ),
                Part(Kind::Cylinder(1.0), &[Scale([0.5, 0.5, 0.6]), Move([1.9, 0.0, 0.0])], &[0]),
                Part(Kind::Cylinder(1.0), &[Scale([0.25, 0.25, 0.3]), Move([1.9, 0.0, 0.3])], &[1]),
                Part(Kind::Cube, &[Scale([3.0, 3.0, 0.25]), Move([0.0, 0.0, -0.25])], &[4]),
            ],
            programs: vec![
                vec![Leaf(0), Leaf(1), Union],
                vec![Leaf(2), Leaf(3), Intersection],
                vec![Leaf(4), Leaf(5), Difference],
                vec![Leaf(6)],
            ],
            materials: vec![matt(RED), matt(GREEN), matt(BLUE), matt(WHITE), matt(SAND)],
            lights: vec![sun(0.875)],
            eye: [0.5, -4.5, 3.5],
            look_at: [0.3, 0.0, 0.4],
            degrees: 42.0,
            seen: vec![200, 200, 0, 300, 100, 50, 1000],
        },
        OPAQUE,
    );
}

/// What is left of a ring from which a box was taken, and what a ring and a box share: no phantoms in
/// mirrors.
#[test]
fn a_ring_that_is_cut_and_mirrors() {
    use Op::{Difference, Intersection, Leaf};
    const TURN: Step = Turn([1.0, 0.3, 0.0], 40.0);
    assert_same(
        &Scene {
            name: "a ring that is cut",
            parts: vec![
                Part(Kind::Torus(0.4), &[TURN, Move([-1.0, 0.0, 1.2])], &[0]),
                Part(Kind::Cube, &[Move([0.9, -0.4, 0.0]), TURN, Move([-1.0, 0.0, 1.2])], &[1]),
                Part(Kind::Torus(0.3), &[TURN, Move([1.4, 0.0, 1.2])], &[0]),
                Part(
                    Kind::Cube,
                    &[Scale([0.6, 2.0, 2.0]), Move([0.2, 0.0, 0.0]), TURN, Move([1.4, 0.0, 1.2])],
                    &[1],
                ),
                Part(Kind::Plane, &[], &[2]),
            ],
            programs: vec![
                vec![Leaf(0), Leaf(1), Difference],
                vec![Leaf(2), Leaf(3), Intersection],
                vec![Leaf(4)],
            ],
            materials: vec![
                Material { reflect: [0.75, 0.75, 0.5], ..shiny(SAND, [0.25; 3], Shine::Phong(40)) },
                Material { reflect: [0.5; 3], ..matt(BLUE) },
                matt(GREEN),
            ],
            lights: vec![sun(0.75)],
            eye: [0.2, -4.5, 2.6],
            look_at: [0.1, 0.0, 0.9],
            degrees: 46.0,
            seen: vec![2000, 100, 1000, 100, 5000],
        },
        OPAQUE,
    );
}
