//! Pictures of worlds against the f64 reference, pixel by pixel.
//!
//! A world is described once, in numbers, and built for both. Both implement the page "The picture of a
//! world, defined" in CONTRIBUTING.md; what is compared are the colours of a display.

mod glass;
mod rough;
mod solids;

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
