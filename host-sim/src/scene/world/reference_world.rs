//! A world as the f64 reference has it, and its picture.

use attractor::num::{Real, Unit};
use attractor::trace::Filter;
use attractor::trace::world::Op;
use attractor_reference::world::{
    Interpenetration, Leaf, Light, Material, Object, Pattern, Policy, Program, Slopes, Specular, Step,
    Surroundings, World,
};
use attractor_reference::{Camera, Samples};

use super::super::request::Request;
use super::file;
use super::lamp::{self, Stand};
use super::material::{Colored, Gloss, Matter};
use super::reference::vector;
use super::reference_texture::{color, pigment, raised, texels, turned};
use super::surroundings::Around;
use super::view::WorldScene;

/// What of a world a picture asks for.
#[derive(Debug)]
pub(super) struct Exact {
    world: World,
    samples: Samples,
    size: (usize, usize),
}

impl Exact {
    pub(super) fn new(scene: &WorldScene, request: &Request) -> Self {
        let (world, size) = (&scene.world, request.size);
        let shapes = scene.exact(size.width.max(size.height));
        let leaves = shapes.into_iter().zip(&scene.made_of).map(|(shape, materials)| {
            let (shape, placing) = shape.into_parts();
            Leaf { shape, placing, materials: materials.iter().copied().map(usize::from).collect() }
        });
        let objects = world.programs.objects.iter().map(|object| {
            let program = Program(object.ops.iter().map(step).collect());
            // what is inside an object is that of its first leaf
            let first = program.leaves().next().unwrap_or_default();
            Object { program, material: scene.made_of[first][0].into() }
        });
        let at = world.standpoint;
        Self {
            world: World {
                leaves: leaves.collect(),
                objects: objects.collect(),
                materials: world.materials.iter().map(|matter| material(scene, matter)).collect(),
                lights: world.lights.iter().map(light).collect(),
                surroundings: surroundings(&world.around),
                camera: Camera {
                    eye: vector(at.eye),
                    look_at: vector(at.look_at),
                    up: vector(at.up),
                    field_of_view: at.field_of_view.to_num::<f64>().to_radians(),
                },
                depth: world.depth.into(),
                policy: match world.policy {
                    file::Policy::Refuse => Policy::Refuse,
                    file::Policy::Priority => Policy::Priority,
                },
                samples_per_axis: world.samples.into(),
            },
            samples: Samples {
                n: world.samples.into(),
                seed: (world.samples > 1).then(|| world.seed.unwrap_or(request.seed as u32)),
                gaussian: match world.filter {
                    Filter::Gaussian { deviation, width } => Some([deviation, width].map(Real::to_num)),
                    _ => None,
                },
            },
            size: (size.width as usize, size.height as usize),
        }
    }

    /// The light of a pixel.
    pub(super) fn pixel(&self, i: u32, j: u32) -> Result<[f64; 3], Interpenetration> {
        let (columns, rows) = self.size;
        self.world.pixel(columns, rows, (i as usize, j as usize), &self.samples.of((i, j)))
    }
}

fn step(op: &Op) -> Step {
    match *op {
        Op::Leaf(leaf) => Step::Leaf(leaf.into()),
        Op::Union => Step::Union,
        Op::Intersection => Step::Intersection,
        Op::Difference => Step::Difference,
    }
}

fn light(light: &lamp::Light) -> Light {
    let colour = color(light.color);
    match light.stand {
        Stand::Towards(towards) => Light::Distant { towards: vector(towards), colour },
        Stand::At(at) => Light::Point { at: vector(at), colour },
    }
}

fn material(scene: &WorldScene, matter: &Matter) -> Material {
    let textures = &scene.world.textures;
    let (unit, colour) = (Unit::to_num::<f64>, color(matter.specular));
    Material {
        pigment: match matter.pigment {
            Colored::Color(light) => Pattern::plain(color(light)),
            Colored::Texture(number) => pigment(&textures[number]),
        },
        ambient: unit(matter.ambient),
        diffuse: unit(matter.diffuse),
        specular: match matter.gloss {
            Gloss::Tabulated { ref slopes, reflectance } => Specular::Tabulated {
                colour,
                slopes: Slopes::new(
                    slopes.reach(),
                    slopes.rows().map(|row| row.iter().copied().map(f64::from)),
                ),
                reflectance: unit(reflectance),
            },
            Gloss::None => Specular::None,
            Gloss::Phong { shininess } => Specular::Phong { colour, exponent: shininess.into() },
            Gloss::TorranceSparrow { roughness, reflectance } => Specular::TorranceSparrow {
                colour,
                roughness: unit(roughness),
                reflectance: unit(reflectance),
            },
            Gloss::Anisotropic { along, across } => {
                Specular::Ward { colour, along: unit(along), across: unit(across) }
            }
        },
        reflect: color(matter.reflect),
        transmit: color(matter.transmit),
        index: matter.medium.map(|medium| medium.index.to_num()),
        fresnel: matter.medium.is_some_and(|medium| medium.fresnel),
        priority: matter.medium.map_or(0, |medium| medium.priority.into()),
        bump: matter.bump.and_then(|(number, strength)| raised(&textures[number], strength)),
        frame: matter.frame.and_then(|(number, strength)| turned(&textures[number], strength)),
    }
}

fn surroundings(around: &Around) -> Surroundings {
    match around {
        Around::Plain(light) => Surroundings::Plain(color(*light)),
        Around::Sky(sky) => Surroundings::Gradient {
            zenith: color(sky.zenith),
            horizon: color(sky.horizon),
            nadir: color(sky.nadir),
        },
        // a scene file has the same squares above and below
        Around::Tiles(tiles) => Surroundings::Checkerboard {
            scale: tiles.scale.to_num(),
            bright: color(tiles.floor[0]),
            dark: color(tiles.floor[1]),
            horizon: color(tiles.horizon),
            fade: tiles.fade.to_num(),
        },
        Around::Image(picture) => Surroundings::Image(texels(picture)),
    }
}
