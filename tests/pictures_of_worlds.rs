//! Pictures of worlds against the f64 reference, pixel by pixel.
//!
//! A world is described once, in numbers, and built for both. Both implement the page "The picture of a
//! world, defined" in CONTRIBUTING.md; what is compared are the colours of a display.

use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Scaling, Unit, Vec3, Wide};
use attractor::plane::Field;
use attractor::surfaces;
use attractor::trace::material::{Anisotropic, Clear, Highlight, Medium, Mixture, Phong, TorranceSparrow};
use attractor::trace::solid::{
    Cube, HalfSpace, Moved, Placed, Plane, Polygon, Polyhedron, Sphere, Square, TaperedCylinder, Torus,
};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, HeightField, Sky};
use attractor_reference as reference;
use attractor_reference::world as exact;
use embedded_graphics::geometry::Size;

type Vector = [f64; 3];

surfaces! {
    #[derive(Debug, Clone, Copy)]
    enum Solid<'a> {
        Sphere(Placed<Sphere>),
        Cube(Placed<Cube>),
        Plane(Placed<Plane>),
        Square(Placed<Square>),
        Cylinder(Placed<TaperedCylinder>),
        Torus(Placed<Torus>),
        Polyhedron(Placed<Polyhedron<'a>>),
        Polygon(Placed<Polygon>),
        Field(Moved<HeightField<'a>>),
    }
}

type Stuff = Mixture<Rgb, Highlight<'static>, Option<Clear>>;

#[derive(Debug, Clone, Copy)]
enum Kind {
    Sphere,
    Cube,
    Plane,
    Square,
    /// The radius of the cap.
    Cylinder(f64),
    /// The radius of the tube.
    Torus(f64),
    Polyhedron(&'static [(Vector, f64)]),
    Polygon(&'static [Vector]),
    /// The rough surface of the paper.
    Field,
}

/// One map after the other.
#[derive(Debug, Clone, Copy)]
enum Step {
    Scale(Vector),
    /// About an axis, by degrees.
    Turn(Vector, f64),
    Move(Vector),
}
use Step::{Move, Scale, Turn};

/// A shape, where it is, and the materials of its faces.
struct Part(Kind, &'static [Step], &'static [u8]);

#[derive(Debug, Clone, Copy)]
enum Shine {
    None,
    Phong(u16),
    /// Roughness and reflectance.
    Rough(f64, f64),
    /// Roughness along the grain and across.
    Brushed(f64, f64),
}

#[derive(Debug, Clone, Copy)]
struct Glass {
    index: f64,
    transmit: Vector,
    priority: u8,
    fresnel: bool,
}

#[derive(Debug, Clone, Copy)]
struct Material {
    pigment: Vector,
    ambient: f64,
    diffuse: f64,
    specular: Vector,
    shine: Shine,
    reflect: Vector,
    glass: Option<Glass>,
}

const fn matt(pigment: Vector) -> Material {
    Material {
        pigment,
        ambient: 0.125,
        diffuse: 0.875,
        specular: [0.0; 3],
        shine: Shine::None,
        reflect: [0.0; 3],
        glass: None,
    }
}

const fn shiny(pigment: Vector, specular: Vector, shine: Shine) -> Material {
    Material { specular, shine, ..matt(pigment) }
}

const fn mirror(reflect: Vector) -> Material {
    Material { ambient: 0.0, diffuse: 0.0, reflect, ..matt([0.0; 3]) }
}

const fn glass(index: f64, priority: u8) -> Material {
    let glass = Glass { index, transmit: [0.875, 1.0, 0.9375], priority, fresnel: true };
    Material { glass: Some(glass), ..mirror([0.0; 3]) }
}

enum Light {
    Distant(Vector, Vector),
    Point(Vector, Vector),
}

struct Scene {
    name: &'static str,
    parts: Vec<Part>,
    programs: Vec<Vec<Op>>,
    materials: Vec<Material>,
    lights: Vec<Light>,
    eye: Vector,
    look_at: Vector,
    degrees: f64,
    /// How many pixels show each leaf at least.
    seen: Vec<usize>,
}

/// Zenith, horizon and nadir.
const SKY: [Vector; 3] = [[0.25, 0.5, 1.0], [0.875, 0.875, 0.75], [0.25, 0.125, 0.0625]];
const SIDE: u32 = 240;

fn real(v: f64) -> Real {
    Real::from_num(v)
}

fn vector(v: Vector) -> Vec3 {
    Vec3::new(real(v[0]), real(v[1]), real(v[2]))
}

fn rgb(c: Vector) -> Rgb {
    let [r, g, b] = c.map(Lumen::from_num);
    Rgb::new(r, g, b)
}

fn map(steps: &[Step]) -> Affine3 {
    steps.iter().fold(Affine3::translate(Vec3::default()), |map, step| {
        map.then(&match *step {
            Scale(by) => Affine3::scale(vector(by)),
            Turn(axis, degrees) => {
                let angle = Angle::from_bits((degrees.rem_euclid(360.0) / 360.0 * 2_f64.powi(32)) as u32);
                Affine3::rotate(vector(axis), angle).unwrap()
            }
            Move(by) => Affine3::translate(vector(by)),
        })
    })
}

fn placing(steps: &[Step]) -> exact::Placing {
    steps.iter().fold(exact::Placing::IDENTITY, |placing, step| {
        placing.then(&match *step {
            Scale(by) => exact::Placing::scaling(by),
            Turn(axis, degrees) => exact::Placing::rotation(axis, degrees),
            Move(by) => exact::Placing::translation(by),
        })
    })
}

fn half_spaces(kind: Kind) -> Vec<HalfSpace> {
    let Kind::Polyhedron(planes) = kind else { return Vec::new() };
    let wide = |n: Vector| Vec3::new(Wide::from_num(n[0]), Wide::from_num(n[1]), Wide::from_num(n[2]));
    planes.iter().map(|&(n, d)| HalfSpace::new(wide(n), Wide::from_num(d)).unwrap()).collect()
}

const FIELD: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
/// How deep its pyramids are: as fine as a pixel at 240 a side.
const DEPTH: usize = 8;

fn with_field<R>(work: impl FnOnce(&HeightField<'_>) -> R) -> R {
    let knots = FIELD.map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let scalings = [0.85, -0.85].map(Scaling::from_num);
    let f = Fif::<2, 2>::interpolating(&knots, &scalings).unwrap().integral::<2>(Wide::ZERO).unwrap();
    let mut memory = vec![Cell::ZERO; Pyramid::cells(2, DEPTH as u32)];
    let pyramid = Pyramid::new(&f, DEPTH as u32, &mut memory).unwrap();
    work(&HeightField::new(&pyramid, &pyramid).unwrap())
}

fn solid<'a>(part: &Part, planes: &'a [HalfSpace], field: &HeightField<'a>) -> Solid<'a> {
    let map = &map(part.1);
    match part.0 {
        Kind::Sphere => Solid::Sphere(Placed::new(Sphere, map).unwrap()),
        Kind::Cube => Solid::Cube(Placed::new(Cube, map).unwrap()),
        Kind::Plane => Solid::Plane(Placed::new(Plane, map).unwrap()),
        Kind::Square => Solid::Square(Placed::new(Square, map).unwrap()),
        Kind::Cylinder(cap) => {
            Solid::Cylinder(Placed::new(TaperedCylinder::new(real(cap)).unwrap(), map).unwrap())
        }
        Kind::Torus(tube) => {
            Solid::Torus(Placed::new(Torus::new(Near::from_num(tube)).unwrap(), map).unwrap())
        }
        Kind::Polyhedron(_) => Solid::Polyhedron(Placed::new(Polyhedron::new(planes).unwrap(), map).unwrap()),
        Kind::Polygon(corners) => {
            let corners: Vec<Vec3> = corners.iter().copied().map(vector).collect();
            Solid::Polygon(Placed::new(Polygon::new(&corners).unwrap(), map).unwrap())
        }
        Kind::Field => Solid::Field(Moved::new(*field, map).unwrap()),
    }
}

fn shape(kind: Kind) -> Box<dyn exact::Shape> {
    match kind {
        Kind::Sphere => Box::new(exact::Sphere),
        Kind::Cube => Box::new(exact::Cube),
        Kind::Plane => Box::new(exact::Plane),
        Kind::Square => Box::new(exact::Square),
        Kind::Cylinder(cap) => Box::new(exact::TaperedCylinder { cap }),
        Kind::Torus(tube) => Box::new(exact::Torus { tube }),
        Kind::Polyhedron(planes) => Box::new(exact::Polyhedron { half_spaces: planes.to_vec() }),
        Kind::Polygon(corners) => Box::new(exact::Polygon { corners: corners.to_vec() }),
        Kind::Field => {
            let f = reference::Fif::interpolating(&FIELD, &[0.85, -0.85]).integral(0.0);
            Box::new(exact::HeightField::new(f.clone(), f, DEPTH))
        }
    }
}

fn stuff(material: &Material) -> Stuff {
    let part = Unit::from_num;
    let shine = match material.shine {
        Shine::None => Highlight::None,
        Shine::Phong(shininess) => Highlight::Phong(Phong { shininess }),
        Shine::Rough(roughness, reflectance) => {
            Highlight::TorranceSparrow(TorranceSparrow::new(part(roughness), part(reflectance)).unwrap())
        }
        Shine::Brushed(along, across) => {
            Highlight::Anisotropic(Anisotropic::new(part(along), part(across)).unwrap())
        }
    };
    let clear = material.glass.map(|glass| {
        let Glass { index, transmit, priority, fresnel } = glass;
        Clear::new(Medium { index: real(index), priority, fresnel }, rgb(transmit)).unwrap()
    });
    Mixture::matt(rgb(material.pigment))
        .with_parts(part(material.ambient), part(material.diffuse))
        .unwrap()
        .with_highlight(rgb(material.specular), shine)
        .with_reflection(rgb(material.reflect))
        .with_interior(clear)
}

fn exact_material(material: &Material) -> exact::Material {
    let colour = material.specular;
    exact::Material {
        ambient: material.ambient,
        diffuse: material.diffuse,
        specular: match material.shine {
            Shine::None => exact::Specular::None,
            Shine::Phong(e) => exact::Specular::Phong { colour, exponent: e.into() },
            Shine::Rough(roughness, reflectance) => {
                exact::Specular::TorranceSparrow { colour, roughness, reflectance }
            }
            Shine::Brushed(along, across) => exact::Specular::Ward { colour, along, across },
        },
        reflect: material.reflect,
        transmit: material.glass.map_or([0.0; 3], |glass| glass.transmit),
        index: material.glass.map(|glass| glass.index),
        fresnel: material.glass.is_some_and(|glass| glass.fresnel),
        priority: material.glass.map_or(0, |glass| glass.priority.into()),
        ..exact::Material::matte(exact::Pattern::plain(material.pigment))
    }
}

impl Scene {
    fn exact(&self) -> exact::World {
        let leaves = self.parts.iter().map(|Part(kind, steps, materials)| exact::Leaf {
            shape: shape(*kind),
            placing: placing(steps),
            materials: materials.iter().copied().map(usize::from).collect(),
        });
        let objects = self.programs.iter().map(|ops| {
            let steps = ops.iter().map(|op| match *op {
                Op::Leaf(leaf) => exact::Step::Leaf(leaf.into()),
                Op::Union => exact::Step::Union,
                Op::Intersection => exact::Step::Intersection,
                Op::Difference => exact::Step::Difference,
            });
            let program = exact::Program(steps.collect());
            // what is inside an object is that of its first leaf
            let first = program.leaves().next().unwrap();
            exact::Object { program, material: self.parts[first].2[0].into() }
        });
        let lights = self.lights.iter().map(|light| match *light {
            Light::Distant(towards, colour) => exact::Light::Distant { towards, colour },
            Light::Point(at, colour) => exact::Light::Point { at, colour },
        });
        let [zenith, horizon, nadir] = SKY;
        exact::World {
            leaves: leaves.collect(),
            objects: objects.collect(),
            materials: self.materials.iter().map(exact_material).collect(),
            lights: lights.collect(),
            surroundings: exact::Surroundings::Gradient { zenith, horizon, nadir },
            camera: reference::Camera {
                eye: self.eye,
                look_at: self.look_at,
                up: [0.0, 0.0, 1.0],
                field_of_view: self.degrees.to_radians(),
            },
            depth: 5,
            policy: exact::Policy::Priority,
            samples_per_axis: 1,
        }
    }

    /// The linear light of each pixel.
    fn core(&self, side: u32) -> Vec<Vector> {
        with_field(|field| self.core_with(side, field))
    }

    fn core_with(&self, side: u32, field: &HeightField<'_>) -> Vec<Vector> {
        let planes: Vec<Vec<HalfSpace>> = self.parts.iter().map(|part| half_spaces(part.0)).collect();
        let leaves: Vec<Leaf<'_, Solid<'_>>> = self
            .parts
            .iter()
            .zip(&planes)
            .map(|(part, planes)| Leaf { surface: solid(part, planes, field), materials: part.2 })
            .collect();
        let mut memory: Vec<Vec<Extent>> =
            self.programs.iter().map(|ops| vec![Extent::NOTHING; Object::extents(ops.len())]).collect();
        let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
        let objects: Vec<Object<'_>> = self
            .programs
            .iter()
            .zip(&mut memory)
            .map(|(ops, memory)| Object::new(ops, surface, memory).unwrap())
            .collect();
        let materials: Vec<Stuff> = self.materials.iter().map(stuff).collect();
        let lamps: Vec<Lamp> = self
            .lights
            .iter()
            .map(|light| match *light {
                Light::Distant(towards, colour) => Lamp::distant(vector(towards), rgb(colour)).unwrap(),
                Light::Point(at, colour) => Lamp::point(vector(at), rgb(colour)),
            })
            .collect();
        let [zenith, horizon, nadir] = SKY.map(rgb);
        let up = vector([0.0, 0.0, 1.0]);
        let camera = Camera::new(vector(self.eye), vector(self.look_at), up, real(self.degrees)).unwrap();
        let world = World::new(&leaves, &objects, &materials).unwrap().with_lamps(&lamps);
        let sky = Sky { zenith, horizon, nadir };
        let caster = WorldCaster::<_, _, _>::new(world, sky, camera, Size::new(side, side)).unwrap();
        (0..side)
            .flat_map(|y| caster.row(y, 0..side))
            .map(|p| [p.r, p.g, p.b].map(|c| f64::from(c) / 65535.0))
            .collect()
    }
}

/// The level of 255 at which a display shows a linear light (IEC 61966-2-1).
fn level(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    let code = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * code).round()
}

/// PSNR in dB, the share of the pixels within 2 levels of 255, and how many pixels show each leaf.
fn compared(scene: &Scene, side: u32) -> (f64, f64, Vec<usize>) {
    let (world, core) = (scene.exact(), scene.core(side));
    let side = side as usize;
    let expected = world.picture(side, side, &[(0.0, 0.0, 1.0)]).unwrap();
    let mut seen = vec![0; scene.parts.len()];
    let (mut square, mut near) = (0.0, 0);
    for (k, (got, expected)) in core.iter().zip(&expected).enumerate() {
        let off = [0, 1, 2].map(|c| level(got[c]) - level(expected[c]));
        square += off.iter().map(|d| d * d).sum::<f64>();
        let is_near = off.iter().all(|d| d.abs() <= 2.0);
        near += u32::from(is_near);
        let ray = world.camera.ray(side, side, (k % side, k / side), (0.0, 0.0));
        if let Some((_, leaf, ..)) = world.first_change(&ray) {
            seen[leaf] += 1;
        }
    }
    assert_eq!(core.len(), expected.len());
    let pixels = core.len() as f64;
    (10.0 * (255.0 * 255.0 / (square / (3.0 * pixels)).max(1e-9)).log10(), f64::from(near) / pixels, seen)
}

/// What pictures without glass and with it must reach: a PSNR, and a share of the pixels within 2 levels.
const OPAQUE: (f64, f64) = (45.0, 0.999);
const CLEAR: (f64, f64) = (40.0, 0.995);

fn assert_same(scene: &Scene, (psnr, share): (f64, f64)) {
    let (got, near, seen) = compared(scene, SIDE);
    println!("{:32} {got:.1} dB, {:.3} % within 2 levels, {seen:?}", scene.name, 100.0 * near);
    assert!(seen.len() == scene.seen.len(), "{}", scene.name);
    assert!(seen.iter().zip(&scene.seen).all(|(seen, least)| seen >= least), "{}: {seen:?}", scene.name);
    assert!(got >= psnr && near >= share, "{}: {got} dB, {near}", scene.name);
}

const WHITE: Vector = [1.0; 3];
const RED: Vector = [0.875, 0.125, 0.0625];
const GREEN: Vector = [0.125, 0.625, 0.1875];
const BLUE: Vector = [0.125, 0.25, 0.75];
const SAND: Vector = [0.75, 0.625, 0.375];

fn sun(brightness: f64) -> Light {
    Light::Distant([-0.6, -0.8, 1.1], [brightness; 3])
}

/// An object of one leaf each.
fn single(leaves: core::ops::Range<u8>) -> Vec<Vec<Op>> {
    leaves.map(|leaf| vec![Op::Leaf(leaf)]).collect()
}

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
