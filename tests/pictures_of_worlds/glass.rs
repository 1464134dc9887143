//! Worlds of glass: rays that are bent, eyes inside, media that touch or share a place.

use attractor::trace::world::Op;

use super::{
    CLEAR, GREEN, Glass, Kind, Light, Material, Move, Part, RED, SAND, Scale, Scene, Shine, Step, Turn,
    WHITE, assert_same, compared, glass, matt, mirror, shiny, single, sun,
};

#[test]
fn balls_of_glass_and_mirrors_on_a_plane() {
    assert_same(
        &Scene {
            name: "balls of glass and mirrors",
            parts: vec![
                Part(Kind::Sphere, &[Scale([0.6; 3]), Move([-0.7, -0.5, 0.65])], &[0]),
                Part(Kind::Sphere, &[Scale([0.7; 3]), Move([0.9, 0.0, 0.7])], &[1]),
                Part(Kind::Sphere, &[Scale([0.5; 3]), Move([0.1, 1.5, 0.5])], &[2]),
                Part(Kind::Plane, &[], &[3]),
            ],
            programs: single(0..4),
            materials: vec![
                glass(1.5, 0),
                mirror([0.875, 0.9375, 0.875]),
                shiny(RED, WHITE, Shine::Phong(50)),
                Material { reflect: [0.25; 3], ..matt(SAND) },
            ],
            lights: vec![sun(0.75), Light::Point([2.0, -3.0, 4.0], [0.375; 3])],
            eye: [0.2, -4.5, 2.0],
            look_at: [0.0, 0.0, 0.5],
            degrees: 40.0,
            seen: vec![500, 500, 100, 1000],
        },
        CLEAR,
    );
}

#[test]
fn a_ball_of_glass_in_water() {
    // one ball wholly in the water, one half out of it: there its priority decides
    assert_same(
        &Scene {
            name: "water",
            parts: vec![
                Part(Kind::Cube, &[Scale([1.5, 1.2, 0.8]), Move([0.0, 0.0, 0.9])], &[0]),
                Part(Kind::Sphere, &[Scale([0.5; 3]), Move([-0.6, 0.0, 0.8])], &[1]),
                Part(Kind::Sphere, &[Scale([0.5; 3]), Move([0.7, -0.1, 1.7])], &[1]),
                Part(Kind::Sphere, &[Scale([0.4; 3]), Move([0.0, 0.5, 0.6])], &[2]),
                Part(Kind::Plane, &[], &[3]),
            ],
            programs: single(0..5),
            materials: vec![glass(1.33, 0), glass(1.6, 1), matt(RED), matt(SAND)],
            lights: vec![sun(0.75)],
            eye: [0.7, -5.0, 3.2],
            look_at: [0.0, 0.0, 0.8],
            degrees: 40.0,
            // what is in the water no ray of the camera meets first
            seen: vec![1500, 0, 100, 0, 1000],
        },
        CLEAR,
    );
}

#[test]
fn an_eye_inside_glass() {
    for (name, fresnel) in [("an eye inside glass", false), ("an eye inside glass, Fresnel", true)] {
        let Material { glass: Some(clear), .. } = glass(1.5, 0) else { panic!("glass") };
        assert_same(
            &Scene {
                name,
                parts: vec![
                    Part(Kind::Sphere, &[Scale([1.5; 3])], &[0]),
                    Part(Kind::Sphere, &[Scale([0.5; 3]), Move([0.9, 2.5, 0.0])], &[1]),
                    Part(
                        Kind::Cube,
                        &[Scale([0.4; 3]), Turn([0.3, 1.0, 0.2], 40.0), Move([-0.8, 3.0, 0.2])],
                        &[2],
                    ),
                    Part(Kind::Sphere, &[Scale([0.25; 3]), Move([0.0, 0.9, -0.2])], &[2]),
                    Part(Kind::Plane, &[Move([0.0, 0.0, -1.6])], &[3]),
                ],
                programs: single(0..5),
                materials: vec![
                    Material { glass: Some(Glass { fresnel, ..clear }), ..mirror([0.0; 3]) },
                    matt(RED),
                    shiny(GREEN, WHITE, Shine::Phong(20)),
                    matt(SAND),
                ],
                lights: vec![sun(0.875)],
                eye: [0.1, -0.6, 0.2],
                look_at: [0.0, 2.0, 0.0],
                degrees: 70.0,
                seen: vec![5000, 0, 0, 100, 0],
            },
            CLEAR,
        );
    }
}

/// The floor is named before the glass and after it, and touches what stands on it: where the glass ends and
/// the floor begins, both are met.
#[test]
fn a_ring_of_glass_and_a_block_that_stands_on_the_floor() {
    // so that a place on the floor is rounded to either side of it
    const TILT: Step = Turn([1.0, 0.3, 0.2], 7.0);
    for (name, order) in [("glass on the floor, named first", [0, 1, 2]), ("named last", [2, 1, 0])] {
        assert_same(
            &Scene {
                name,
                parts: vec![
                    Part(
                        Kind::Cube,
                        &[
                            Scale([0.5, 0.5, 0.375]),
                            Turn([0.0, 0.0, 1.0], 28.0),
                            Move([-0.8, 0.0, 0.375]),
                            TILT,
                        ],
                        &[0],
                    ),
                    Part(Kind::Torus(0.3), &[Turn([1.0, 0.2, 0.0], 50.0), Move([0.8, 0.3, 1.0]), TILT], &[0]),
                    Part(Kind::Plane, &[TILT], &[1]),
                ],
                programs: order.map(|leaf| vec![Op::Leaf(leaf)]).to_vec(),
                materials: vec![glass(1.5, 0), matt(RED)],
                lights: vec![sun(0.875)],
                eye: [0.2, -4.5, 2.8],
                look_at: [0.0, 0.0, 0.4],
                degrees: 40.0,
                seen: vec![500, 500, 1000],
            },
            CLEAR,
        );
    }
}

/// No ray sees the surface that it left, however small or large the ring is, and wherever it stands.
#[test]
fn a_ring_of_glass_at_any_size_and_distance() {
    let mut compared_pictures = 0;
    for size in [1.0 / 32.0, 0.25, 1.0, 8.0] {
        for (centre, far) in [([0.0; 3], 1.0), ([20.0, -20.0, 11.0], 1.0), ([-30.0, 25.0, -20.0], 5.0)] {
            // not farther than the world's end
            let far = if size > 1.0 { 1.0 } else { far };
            let steps = vec![Scale([size; 3]), Turn([1.0, 0.2, 0.0], 50.0), Move(centre)];
            let eye = [2.5, -2.0, 1.5];
            let scene = Scene {
                name: "ring",
                parts: vec![Part(Kind::Torus(0.4), steps.leak(), &[0])],
                programs: single(0..1),
                materials: vec![glass(1.5, 0)],
                lights: vec![],
                eye: [0, 1, 2].map(|k| centre[k] + far * size * eye[k]),
                look_at: centre,
                degrees: 45.0 / far,
                seen: vec![800],
            };
            let (psnr, near, seen) = compared(&scene, 64);
            println!("ring of {size} at {centre:?}: {psnr:.1} dB, {:.3} %, {seen:?}", 100.0 * near);
            assert!(seen[0] >= 800 && psnr >= CLEAR.0 && near >= CLEAR.1, "{size} {centre:?}: {psnr} {near}");
            compared_pictures += 1;
        }
    }
    assert_eq!(compared_pictures, 12);
}

/// A ray that passes a compound by does not follow its parts, which it may come to be inside of or outside:
/// where it meets something else they are looked up before a medium is named.
#[test]
fn parts_that_a_ray_did_not_follow_are_looked_up_where_it_ends() {
    use Op::{Difference, Intersection, Leaf};
    let clear = |index, priority| Material {
        glass: Some(Glass { index, transmit: [0.95, 1.0, 0.9], priority, fresnel: false }),
        ..mirror([0.0; 3])
    };
    let scene = Scene {
        name: "parts that are passed by",
        parts: vec![
            Part(
                Kind::Torus(0.4),
                &[Scale([0.79; 3]), Turn([0.95, -0.12, 0.87], -105.0), Move([-0.25, -0.05, 0.78])],
                &[0],
            ),
            Part(Kind::Sphere, &[Scale([0.84; 3]), Move([-1.51, 0.2, 0.92])], &[1]),
            Part(
                Kind::Cube,
                &[Scale([0.73; 3]), Turn([-0.47, 0.87, 0.74], -10.0), Move([-0.28, -0.11, -0.22])],
                &[1],
            ),
            Part(
                Kind::Cube,
                &[Scale([0.85; 3]), Turn([0.41, -0.54, -0.02], 164.0), Move([-0.75, -0.07, 0.62])],
                &[1],
            ),
        ],
        programs: vec![vec![Leaf(0)], vec![Leaf(1), Leaf(2), Leaf(3), Intersection, Difference]],
        materials: vec![clear(1.4, 0), clear(1.44, 2)],
        lights: vec![sun(0.8)],
        eye: [-0.09, -0.27, -0.06],
        look_at: [0.0, 0.1, 0.0],
        degrees: 50.0,
        seen: vec![],
    };
    let (psnr, near, _) = compared(&scene, 60);
    assert!(psnr >= CLEAR.0 && near >= CLEAR.1, "{psnr} {near}");
}
