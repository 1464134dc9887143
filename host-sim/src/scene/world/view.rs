//! A world ready to be drawn.

use std::convert::Infallible;

use attractor::trace::world::{Leaf, Object, World, WorldCaster};
use attractor::trace::{Extent, Sampling, Surface};
use attractor_gallery::{Shade, Watch, draw_field};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;

use super::super::motion::Motion;
use super::super::orbit::Orbit;
use super::super::request::Request;
use super::figure::{Cells, Figure, Solid};
use super::file::{DEEPEST, Description, Policy};
use super::lamp::Light;
use super::material::Matter;
use super::object::each;
use super::reference::Exact;
use super::stuff::{Stuff, stuff};
use super::surroundings::Outside;
use crate::color::Depth;
use crate::fail::Fail;
use crate::source::Source;

/// Room for crossings of a ray, 64 leaves of four each.
const EVENTS: usize = 256;
/// Room for rays that wait.
const RAYS: usize = DEEPEST as usize + 2;

/// The picture whose rays look for glass in glass.
const PROBES: Size = Size::new(64, 64);

/// The picture of a world on the host.
pub(crate) type Caster<'a> = WorldCaster<'a, Solid<'a>, Stuff<'a>, Outside<'a>, EVENTS, RAYS>;

/// A world, and where it is seen from.
#[derive(Debug)]
pub(crate) struct WorldScene {
    pub(crate) world: Description,
    /// Shapes of the parts.
    pub(crate) figures: Vec<Figure>,
    /// Of each part the numbers of its materials.
    pub(crate) made_of: Vec<Vec<u8>>,
    /// Whether a light was moved.
    is_lit_anew: bool,
    file: Source,
}

impl WorldScene {
    pub(crate) fn load(source: &Source) -> Result<Self, Fail> {
        let mut world = Description::load(source)?;
        let (mut figures, mut made_of) = (Vec::new(), Vec::new());
        for part in &world.programs.parts {
            let thing = &world.things[part.thing];
            let prefix = thing.prefix(part.thing);
            let figure = Figure::load(source, thing, &prefix)?;
            figure.placed(&part.steps, &mut figure.cells(1), 1).map_err(|error| {
                let span = thing.placement().span(&prefix, &error);
                let (span, key) = span.unwrap_or_else(|| (thing.shape.span(), format!("{prefix}shape")));
                source.fail(span, &key, error)
            })?;
            figures.push(figure);
            made_of.push(materials_of(source, &mut world.materials, &world.things, part.made_of)?);
        }
        let scene = Self { world, figures, made_of, is_lit_anew: false, file: source.clone() };
        scene.check()?;
        Ok(scene)
    }

    /// Builds the world for a display with so many pixels a side, and lends it.
    pub(crate) fn with_world<T>(
        &self,
        side: u32,
        use_it: impl FnOnce(World<'_, Solid<'_>, Stuff<'_>>) -> Result<T, Fail>,
    ) -> Result<T, Fail> {
        let fail = |error: attractor::Error| self.file.fail_all("object", error);
        self.with_surfaces(side, |surfaces| {
            let leaves = surfaces.into_iter().zip(&self.made_of);
            let leaves: Vec<_> = leaves.map(|(surface, materials)| Leaf { surface, materials }).collect();
            let mut boxes: Vec<Vec<Extent>> = Vec::new();
            for object in &self.world.programs.objects {
                boxes.push(vec![Extent::NOTHING; Object::extents(object.ops.len())]);
            }
            let mut objects = Vec::new();
            for (object, memory) in self.world.programs.objects.iter().zip(&mut boxes) {
                let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
                objects.push(Object::new(&object.ops, surface, memory).map_err(|error| {
                    let thing = &self.world.things[object.thing];
                    let of = thing.of.as_ref().map_or(thing.shape.span(), toml::Spanned::span);
                    self.file.fail(of, &format!("{}of", thing.prefix(object.thing)), error)
                })?);
            }
            let materials = self.world.materials.iter().map(|matter| stuff(matter, &self.world.textures));
            let materials: Vec<Stuff<'_>> = materials.collect::<Result<_, _>>().map_err(fail)?;
            let lamps = self.world.lights.iter().map(|light| light.lamp());
            let lamps = lamps.collect::<Result<Vec<_>, _>>().map_err(fail)?;
            use_it(World::new(&leaves, &objects, &materials).map_err(fail)?.with_lamps(&lamps))
        })
    }

    /// The picture on a display of this size.
    pub(crate) fn with_caster<T>(
        &self,
        request: &Request,
        use_it: impl FnOnce(&Caster<'_>) -> Result<T, Fail>,
    ) -> Result<T, Fail> {
        let seed = self.world.seed.unwrap_or(request.seed as u32);
        let sampling = match self.world.samples {
            1 => Sampling::Centre,
            n => Sampling::Jittered { n, seed },
        };
        let side = request.size.width.max(request.size.height);
        self.with_world(side, |world| {
            let caster = Caster::new(world, self.outside()?, self.world.camera, request.size)
                .and_then(|caster| caster.with_sampling(sampling, self.world.filter))
                .and_then(|caster| caster.with_depth(self.world.depth))
                .map_err(|error| self.world.eye.fail_at(request.size, error))?;
            use_it(&caster)
        })
    }

    /// Builds the world once, and refuses transparent things of equal priority that some of the rays of a
    /// small picture find in one place, where the file does not allow it.
    fn check(&self) -> Result<(), Fail> {
        let priorities = self.world.materials.iter().filter_map(|matter| matter.medium);
        if self.world.policy == Policy::Priority || priorities.count() == 0 {
            return self.with_world(1, |_| Ok(()));
        }
        let shared = self.with_world(PROBES.width, |world| {
            let caster = Caster::new(world, self.outside()?, self.world.camera, PROBES)
                .map_err(|error| self.world.eye.fail(error))?;
            Ok(caster.interpenetration())
        })?;
        let Some(shared) = shared else { return Ok(()) };
        let [one, other] = shared.objects.map(|object| self.name(object.into()));
        let [x, y, z] = [shared.place.x, shared.place.y, shared.place.z].map(|c| format!("{c:.3}"));
        let reason = format!(
            "both are transparent and share the place ({x}, {y}, {z}): give their materials priorities, or say \
             interpenetration = \"priority\""
        );
        Err(self.file.fail_all(&format!("{one} and {other}"), reason))
    }

    /// Moves the camera round what it looks at, or the first light; the message says why not.
    pub(crate) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        if let Motion::Light { right, up } = motion {
            let about = self.world.standpoint.look_at;
            let Some(light) = self.world.lights.first_mut() else {
                return Err(Fail::new("there is no light to move"));
            };
            light.carry(about, [right, up], size);
            self.is_lit_anew = true;
            return Ok(());
        }
        let Some(orbit) = &self.world.orbit else {
            return Err(Fail::new("the camera moves about only where z is up"));
        };
        let orbit = orbit.after(motion, size);
        self.world.camera = orbit.camera()?;
        self.world.orbit = Some(orbit);
        Ok(())
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(crate) fn place(&self) -> Option<String> {
        let camera = self.world.orbit.as_ref().map(Orbit::place).unwrap_or_default();
        let lights = self.world.lights.iter().filter(|_| self.is_lit_anew).map(Light::place);
        Some(camera + &lights.collect::<String>()).filter(|lines| !lines.is_empty())
    }

    pub(crate) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let shade = Shade::new::<D::Color>(self.world.contrast)
            .map_err(|error| self.file.fail_all("contrast", error))?;
        self.with_caster(request, |caster| {
            draw_field(caster, shade, target, watch);
            Ok(())
        })
    }

    /// What is seen where nothing is met.
    fn outside(&self) -> Result<Outside<'_>, Fail> {
        self.world.around.outside().map_err(|error| self.file.fail_all("environment", error))
    }

    /// How often a ray may cross the world.
    pub(crate) fn most_crossings(&self) -> u32 {
        self.with_surfaces(1, |all| Ok(all.iter().map(Surface::most_crossings).sum())).unwrap_or(0)
    }

    /// What messages and tables call an object: its name, or its number.
    pub(crate) fn name(&self, object: usize) -> String {
        let thing = self.world.programs.objects.get(object).map_or(0, |object| object.thing);
        self.world.things[thing].prefix(thing).trim_end_matches('.').to_owned()
    }

    /// The shapes of all parts as the reference has them.
    pub(super) fn exact(&self, side: u32) -> Vec<Exact> {
        let parts = self.figures.iter().zip(&self.world.programs.parts);
        parts.map(|(figure, part)| Exact::new(figure, &part.steps, figure.depth(side))).collect()
    }

    /// Lends the surfaces of all parts, for a display with so many pixels a side.
    pub(crate) fn with_surfaces<T>(
        &self,
        side: u32,
        use_them: impl FnOnce(Vec<Solid<'_>>) -> Result<T, Fail>,
    ) -> Result<T, Fail> {
        let mut cells: Vec<Cells> = self.figures.iter().map(|figure| figure.cells(side)).collect();
        let mut surfaces = Vec::new();
        for ((figure, part), cells) in self.figures.iter().zip(&self.world.programs.parts).zip(&mut cells) {
            let placed = figure.placed(&part.steps, cells, side);
            surfaces.push(placed.map_err(|error| self.file.fail_all("object", error))?);
        }
        use_them(surfaces)
    }
}

/// The numbers of the materials that a table names; where there is none, that of plain white, which is added.
fn materials_of(
    source: &Source,
    materials: &mut Vec<Matter>,
    things: &[super::object::Thing],
    made_of: Option<usize>,
) -> Result<Vec<u8>, Fail> {
    let mut numbers = Vec::new();
    let named = made_of.and_then(|thing| Some((thing, things[thing].material.as_ref()?)));
    let key = made_of.map(|thing| format!("{}material", things[thing].prefix(thing))).unwrap_or_default();
    for name in named.map(|(_, names)| each(names)).unwrap_or_default() {
        match materials.iter().position(|matter| matter.name == *name.get_ref()) {
            Some(number) => numbers.push(number as u8),
            None => return Err(source.fail(name.span(), &key, "there is no material of this name")),
        }
    }
    if numbers.is_empty() {
        if let Some((_, names)) = named {
            return Err(source.fail(names.span(), &key, "the list is empty"));
        }
        let plain = materials.iter().position(|matter| matter.name.is_empty());
        numbers.push(plain.unwrap_or(materials.len()) as u8);
        if plain.is_none() {
            materials.push(Matter::plain());
        }
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_light_that_was_moved_comes_back_by_the_lines_that_are_printed() {
        let head = "kind = \"world\"\n[[object]]\nshape = \"sphere\"\n";
        let camera = "[camera]\neye = [0, -6, 2]\nlook_at = [0, 0, 0.7]\nup = [0, 0, 1]\n";
        let lights = "[[light]]\nat = [1, -2, 5]\ncolor = \"#804020\"\n[[light]]\ntowards = [1, 2, 3]\n";
        let load = |text: &str| WorldScene::load(&Source::built_in("test", text)).unwrap();
        let mut scene = load(&format!("{head}{camera}{lights}"));
        assert_eq!(scene.place(), None);
        scene.go(Size::new(240, 240), Motion::Light { right: 30, up: -30 }).unwrap();
        let again = load(&format!("{head}{camera}{}", scene.place().unwrap()));
        assert_eq!(again.world.lights, scene.world.lights);
        let [before, after] = [load(&format!("{head}{camera}{lights}")), scene].map(|s| s.world.lights);
        assert!(before[0] != after[0] && before[0].color == after[0].color && before[1] == after[1]);
        let mut dark = load(&format!("{head}{camera}"));
        assert!(dark.go(Size::new(8, 8), Motion::Light { right: 1, up: 0 }).is_err());
    }
}
