//! Worlds with the rough surface of the paper, as a mirror and as glass.

use super::{
    BLUE, CLEAR, GREEN, Kind, Light, Material, Move, OPAQUE, Part, RED, SAND, Scale, Scene, Shine, Turn,
    Vector, assert_same, glass, matt, shiny, single, sun,
};

/// A fractal surface that mirrors its corner of a room and itself, under a map that scales it by another
/// factor along each axis: pixels show leaves of every size.
#[test]
fn a_rough_surface_that_mirrors_a_corner() {
    const WALL: &[Vector] = &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]];
    const OTHER: &[Vector] = &[[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let turned = Turn([0.0, 0.0, 1.0], 180.0);
    for (name, scale) in [("rough", [1.2, 1.2, 1.7]), ("rough, of uneven scales", [1.1, 0.9, 2.2])] {
        let steps = vec![Scale(scale), turned, Move([2.4, 2.4, 0.02])];
        assert_same(
            &Scene {
                name,
                parts: vec![
                    Part(Kind::Plane, &[], &[0]),
                    Part(Kind::Polygon(WALL), &[Scale([1.0, 8.0, 4.0])], &[1]),
                    Part(Kind::Polygon(OTHER), &[Scale([8.0, 1.0, 4.0])], &[2]),
                    Part(Kind::Field, steps.leak(), &[3]),
                    Part(Kind::Sphere, &[Scale([0.42; 3]), Move([0.85, 2.9, 0.42])], &[4]),
                ],
                programs: single(0..5),
                materials: vec![
                    matt(SAND),
                    matt(RED),
                    matt(BLUE),
                    Material { reflect: [0.7; 3], ..shiny([0.5; 3], [0.25; 3], Shine::Phong(40)) },
                    matt(GREEN),
                ],
                lights: vec![
                    Light::Point([2.6, 3.4, 3.7], [0.75; 3]),
                    Light::Point([4.5, 1.0, 3.0], [0.25; 3]),
                ],
                eye: [5.6, 6.2, 3.6],
                look_at: [0.9, 1.0, 0.85],
                degrees: 36.0,
                seen: vec![5000, 5000, 5000, 10_000, 1000],
            },
            OPAQUE,
        );
    }
}

/// The same surface of glass: what lies below it is bent, and seen through it from below as well.
#[test]
fn a_rough_surface_of_glass() {
    for (name, eye) in [("rough glass", [3.0, 3.5, 2.5]), ("rough glass from below", [3.0, 3.5, -1.5])] {
        assert_same(
            &Scene {
                name,
                parts: vec![
                    Part(Kind::Field, &[Scale([1.0, 1.0, 0.7]), Move([-1.0, -1.0, 0.0])], &[0]),
                    Part(Kind::Sphere, &[Scale([0.4; 3]), Move([0.3, 0.0, -0.4])], &[1]),
                    Part(Kind::Sphere, &[Scale([0.3; 3]), Move([-0.5, 0.2, 1.2])], &[2]),
                ],
                programs: single(0..3),
                materials: vec![glass(1.33, 0), matt(RED), matt(GREEN)],
                lights: vec![sun(0.75)],
                eye,
                look_at: [0.0, 0.0, 0.2],
                degrees: 34.0,
                seen: vec![1000, 0, 300],
            },
            CLEAR,
        );
    }
}
