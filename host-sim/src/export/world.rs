//! Worlds: what stands in them, of what it is made, what lights it and how it is seen.
//!
//! Only what a world has is named, so that no more is linked: its own enums of shapes and materials, or the
//! one type itself where there is but one. What shapes borrow, half-spaces and the pyramids of height fields,
//! the firmware lends.

use attractor::fif::Pyramid;
use attractor::num::{Near, Real, Rgb, Wide};
use attractor::trace::Filter;
use attractor::trace::world::Op;

use super::function::function;
use super::module::{Module, lit, lits};
use super::surface::{SIDE, camera};
use super::texture::{self, color, constant, vector};
use crate::scene::function::Function;
use crate::scene::world::{Around, Colored, Figure, Gloss, Light, Matter, Stand, Step, WorldScene};
use crate::slopes::Slopes;

/// The map of a part.
fn map(steps: &[Step]) -> String {
    let step = |step: &Step| match *step {
        Step::Scale(factors) => format!("Affine3::scale({})", vector(factors)),
        Step::Rotate { axis, angle } => {
            format!("Affine3::rotate({}, {})?", vector(axis), constant(lit("Angle", angle)))
        }
        Step::Translate(by) => format!("Affine3::translate({})", vector(by)),
        Step::Matrix(rows) => {
            let row = |[x, y, z, _]: [_; 4]| lits("Vec3", [x, y, z]);
            let last = lits("Vec3", rows.map(|row| row[3]));
            constant(format!("Affine3::matrix([{}], {last})", rows.map(row).join(", ")))
        }
    };
    let mut steps = steps.iter().map(step);
    let first = steps.next().unwrap_or_else(|| "Affine3::IDENTITY".to_owned());
    steps.fold(first, |map, step| format!("{map}.then(&{step})"))
}

/// What the shapes of a world borrow.
#[derive(Default)]
struct Lent<'a> {
    /// All half-spaces, normals and distances, each with the name of its polyhedron.
    half_spaces: Vec<(String, [Wide; 4])>,
    /// Functions of height fields, each once.
    profiles: Vec<&'a Function>,
    /// The numbers of those of each height field.
    fields: Vec<[usize; 2]>,
    /// How deep their pyramids are on [`SIDE`] pixels.
    depths: Vec<u32>,
}

impl<'a> Lent<'a> {
    fn profile(&mut self, given: &'a Function) -> usize {
        let known = self.profiles.iter().position(|known| known.parts == given.parts);
        known.unwrap_or_else(|| {
            self.profiles.push(given);
            self.profiles.len() - 1
        })
    }

    fn is_empty(&self) -> bool {
        self.half_spaces.is_empty() && self.fields.is_empty()
    }

    /// A shape with its map as an expression.
    fn surface(&mut self, figure: &'a Figure, name: &str, map: &str) -> String {
        match figure {
            Figure::Polyhedron { planes, .. } => {
                let from = self.half_spaces.len();
                self.half_spaces.extend(planes.iter().map(|plane| (name.to_owned(), *plane)));
                let to = self.half_spaces.len();
                format!("Placed::new(Polyhedron::new(&half_spaces[{from}..{to}])?, &{map})?")
            }
            Figure::HeightField(profiles) => {
                let [f, g] = &**profiles;
                let numbers = [self.profile(f), self.profile(g)];
                self.fields.push(numbers);
                self.depths.push(figure.depth(SIDE));
                format!("Moved::new(fields[{}], &{map})?", self.fields.len() - 1)
            }
            other => format!("Placed::new({}, &{map})?", shape(other)),
        }
    }

    /// The functions that build it, and the parameters that `leaves` takes.
    fn write(&self, module: &mut Module) -> String {
        let mut parameters = Vec::new();
        if !self.half_spaces.is_empty() {
            let half_space = |(name, plane): &(String, [Wide; 4])| {
                let [x, y, z, d] = plane.map(|number| lit("Wide", number));
                let normal = constant(format!("Vec3::new({x}, {y}, {z})"));
                (name.clone(), format!("HalfSpace::new({normal}, {})?", constant(d)))
            };
            let rows: Vec<_> = self.half_spaces.iter().map(half_space).collect();
            list(module, "The half-spaces of the polyhedra.", "half_spaces", "HalfSpace", &rows);
            parameters.push(format!("half_spaces: &'a [HalfSpace; {}]", rows.len()));
        }
        for (k, profile) in self.profiles.iter().enumerate() {
            function(profile, &format!("profile_{k}"), &format!("PROFILE_{k}_"), module);
        }
        if !self.fields.is_empty() {
            let cells: Vec<String> = self
                .profiles
                .iter()
                .enumerate()
                .map(|(k, profile)| {
                    let used =
                        self.fields.iter().zip(&self.depths).filter(|(numbers, _)| numbers.contains(&k));
                    let depth = used.map(|(_, depth)| *depth).max().unwrap_or_default();
                    format!(
                        "{} cells of profile {k}, {depth} deep",
                        Pyramid::cells(profile.fixed.maps(), depth)
                    )
                })
                .collect();
            let rows: Vec<String> = self
                .fields
                .iter()
                .map(|[f, g]| format!("HeightField::new(&pyramids[{f}], &pyramids[{g}])?"))
                .collect();
            let doc = format!(
                "The height fields, by a pyramid of each profile:\non {SIDE} pixels a side, {}.\n\n# Errors\nThose of [`HeightField::new`].",
                cells.join(", ")
            );
            let (pyramids, count) = (self.profiles.len(), rows.len());
            module.item(&doc, &format!(
                "#[rustfmt::skip]\npub fn fields<'a>(pyramids: &[Pyramid<'a>; {pyramids}]) -> Result<[HeightField<'a>; {count}], Error> {{\n    Ok([{}])\n}}\n",
                rows.join(", ")));
            parameters.push(format!("fields: &[HeightField<'a>; {count}]"));
        }
        parameters.join(", ")
    }
}

/// A shape that borrows nothing as an expression.
fn shape(figure: &Figure) -> String {
    let list = |rows: Vec<String>| format!("[{}]", rows.join(", "));
    match figure {
        Figure::Polygon { corners, .. } => {
            let corners = corners.iter().map(|corner| lits("Vec3", [corner.x, corner.y, corner.z])).collect();
            format!("Polygon::new(&{})?", constant(list(corners)))
        }
        Figure::TaperedCylinder { cap, .. } => {
            format!("TaperedCylinder::new({})?", constant(lit("Real", *cap)))
        }
        Figure::Torus(torus) => format!("Torus::new({})?", constant(lit::<Near>("Near", torus.tube()))),
        Figure::Superellipsoid { n, m, .. } => {
            let [n, m] = [n, m].map(|exponent| constant(lit("Real", *exponent)));
            format!("Superellipsoid::new({n}, {m})?")
        }
        other => other.kind().0,
    }
}

/// The one type of a list, or an enum of them by a macro of core; and what turns a value of a type into one
/// of the whole.
struct Choice {
    name: &'static str,
    kinds: Vec<(String, String)>,
}

impl Choice {
    /// Of variants and types.
    fn new(name: &'static str, all: impl Iterator<Item = (String, String)>) -> Self {
        let mut kinds: Vec<(String, String)> = all.collect();
        kinds.sort();
        kinds.dedup();
        Self { name, kinds }
    }

    /// `life` is the lifetime of what is borrowed, in angles.
    fn write(&self, doc: &str, of: &str, life: &str, module: &mut Module) {
        match self.kinds.as_slice() {
            [(_, only)] => module.item(doc, &format!("pub type {}{life} = {only};\n", self.name)),
            kinds => {
                let variants: String = kinds
                    .iter()
                    .map(|(variant, kind)| format!("        /// `{kind}`.\n        {variant}({kind}),\n"))
                    .collect();
                module.item(
                    "",
                    &format!(
                        "attractor::{of}! {{\n    /// {doc}\n    #[derive(Debug, Clone, Copy)]\n    pub enum {}{life} {{\n{variants}    }}\n}}\n",
                        self.name
                    ),
                );
            }
        }
    }

    fn value(&self, variant: &str, value: String) -> String {
        if self.kinds.len() == 1 { value } else { format!("{}::{variant}({value})", self.name) }
    }
}

/// The tables of slopes, each once.
fn tables(scene: &WorldScene) -> Vec<&Slopes> {
    let mut tables = Vec::new();
    for matter in &scene.world.materials {
        if let Gloss::Tabulated { slopes, .. } = &matter.gloss
            && !tables.contains(&slopes)
        {
            tables.push(slopes);
        }
    }
    tables
}

/// Variant and type of a pigment with a highlight.
fn kind(scene: &WorldScene, matter: &Matter) -> (String, String) {
    let (pigment, pigment_kind) = match matter.pigment {
        Colored::Color(_) => ("Plain".to_owned(), "Rgb".to_owned()),
        Colored::Texture(number) => texture::kind(&scene.world.textures[number]),
    };
    let (gloss, gloss_kind) = match matter.gloss {
        Gloss::None => ("", "()"),
        Gloss::Phong { .. } => ("Phong", "Phong"),
        Gloss::TorranceSparrow { .. } => ("Rough", "TorranceSparrow"),
        Gloss::Anisotropic { .. } => ("Grained", "Anisotropic"),
        Gloss::Tabulated { .. } => ("Tabulated", "Tabulated<'static>"),
    };
    let (clear, inside) = if matter.medium.is_some() { ("Clear", "Clear") } else { ("", "()") };
    let kind = match (pigment_kind.as_str(), gloss_kind, inside) {
        ("Rgb", "()", "()") => "Mixture".to_owned(),
        (pigment, "()", "()") => format!("Mixture<{pigment}>"),
        (pigment, gloss, "()") => format!("Mixture<{pigment}, {gloss}>"),
        (pigment, gloss, inside) => format!("Mixture<{pigment}, {gloss}, {inside}>"),
    };
    let (mut name, mut kind) = (format!("{pigment}{gloss}{clear}"), kind);
    if let Some((number, strength)) = matter.frame {
        let (grain, grain_kind, _) = texture::grain(&scene.world.textures[number], strength);
        (name, kind) = (format!("{name}{grain}"), format!("Framed<{kind}, {grain_kind}>"));
    }
    if let Some((number, strength)) = matter.bump {
        let (bump, bump_kind, _) = texture::bump(&scene.world.textures[number], strength);
        (name, kind) = (format!("{name}{bump}"), format!("Bumpy<{kind}, {bump_kind}>"));
    }
    (name, kind)
}

/// A material as an expression.
fn mixture(scene: &WorldScene, matter: &Matter) -> String {
    let pigment = match matter.pigment {
        Colored::Color(light) => color(light),
        Colored::Texture(number) => texture::code(&scene.world.textures[number]),
    };
    let unit = |unit| constant(lit("Unit", unit));
    let mut code =
        format!("Mixture::matt({pigment}).with_parts({}, {})?", unit(matter.ambient), unit(matter.diffuse));
    let model = match matter.gloss {
        Gloss::Tabulated { ref slopes, reflectance } => {
            let k = tables(scene).iter().position(|known| *known == slopes).unwrap_or_default();
            Some(format!("Tabulated::new(&SLOPES_{k}, {})?", unit(reflectance)))
        }
        Gloss::None => None,
        Gloss::Phong { shininess } => Some(format!("Phong {{ shininess: {shininess} }}")),
        Gloss::TorranceSparrow { roughness, reflectance } => {
            Some(format!("TorranceSparrow::new({}, {})?", unit(roughness), unit(reflectance)))
        }
        Gloss::Anisotropic { along, across } => {
            Some(format!("Anisotropic::new({}, {})?", unit(along), unit(across)))
        }
    };
    if let Some(model) = model {
        code += &format!(".with_highlight({}, {model})", color(matter.specular));
    }
    if matter.reflect != Rgb::BLACK {
        code += &format!(".with_reflection({})", color(matter.reflect));
    }
    if let Some(medium) = matter.medium {
        let index = constant(lit("Real", medium.index));
        let (priority, fresnel) = (medium.priority, medium.fresnel);
        code += &format!(
            ".with_interior(Clear::new(Medium {{ index: {index}, priority: {priority}, fresnel: {fresnel} }}, {})?)",
            color(matter.transmit)
        );
    }
    if let Some((number, strength)) = matter.frame {
        let (_, _, grain) = texture::grain(&scene.world.textures[number], strength);
        code = format!("Framed {{ material: {code}, grain: {grain} }}");
    }
    if let Some((number, strength)) = matter.bump {
        let (_, _, bump) = texture::bump(&scene.world.textures[number], strength);
        code = format!("Bumpy {{ material: {code}, bump: {bump} }}");
    }
    code
}

fn lamp(light: &Light) -> String {
    match light.stand {
        Stand::Towards(towards) => format!("Lamp::distant({}, {})?", vector(towards), color(light.color)),
        Stand::At(place) => format!("Lamp::point({}, {})", vector(place), color(light.color)),
    }
}

/// A function that makes an array, an element a line, each under its comment.
fn list(module: &mut Module, doc: &str, name: &str, kind: &str, all: &[(String, String)]) {
    built(module, doc, &format!("{name}()"), kind, all);
}

/// The same with a head of its own.
fn built(module: &mut Module, doc: &str, head: &str, kind: &str, all: &[(String, String)]) {
    let rows: String = all.iter().map(|(note, row)| format!("        // {note}\n        {row},\n")).collect();
    let doc = format!("{doc}\n\n# Errors\nNone: the command has built them.");
    module.item(
        &doc,
        &format!(
            "#[rustfmt::skip]\npub fn {head} -> Result<[{kind}; {}], Error> {{\n    Ok([\n{rows}    ])\n}}\n",
            all.len()
        ),
    );
}

pub(super) fn world(scene: &WorldScene, module: &mut Module) {
    let world = &scene.world;
    let shapes = Choice::new("Thing", scene.figures.iter().map(Figure::kind));
    let mut lent = Lent::default();
    let parts = scene.figures.iter().zip(&world.programs.parts).zip(&scene.made_of);
    let leaves: Vec<_> = parts
        .map(|((figure, part), materials)| {
            let name = world.things[part.thing].prefix(part.thing);
            let name = super::module::comment(name.trim_end_matches('.'));
            let surface = shapes.value(&figure.kind().0, lent.surface(figure, &name, &map(&part.steps)));
            (name, format!("Leaf {{ surface: {surface}, materials: &{materials:?} }}"))
        })
        .collect();
    let life = if lent.is_empty() { "" } else { "<'a>" };
    shapes.write("What stands in it.", "surfaces", life, module);
    let stuffs = Choice::new("Stuff", world.materials.iter().map(|matter| kind(scene, matter)));
    stuffs.write("What things are made of.", "materials", "", module);
    for (k, slopes) in tables(scene).into_iter().enumerate() {
        module.item(
            "A table of slopes: version, side, reach in 256ths, weights.",
            &format!(
                "#[rustfmt::skip]\npub static SLOPES_{k}: [u16; {}] = [\n{}];\n",
                slopes.words().len(),
                slopes.code()
            ),
        );
    }
    let materials: Vec<_> = world
        .materials
        .iter()
        .map(|matter| {
            let name = if matter.name.is_empty() { "plain" } else { &matter.name };
            (super::module::comment(name), stuffs.value(&kind(scene, matter).0, mixture(scene, matter)))
        })
        .collect();
    list(module, "The materials.", "materials", "Stuff", &materials);
    let parameters = lent.write(module);
    let doc = "The shapes, each with the numbers of its materials.";
    if lent.is_empty() {
        list(module, doc, "leaves", "Leaf<'static, Thing>", &leaves);
    } else {
        built(module, doc, &format!("leaves<'a>({parameters})"), "Leaf<'a, Thing<'a>>", &leaves);
    }
    let lamps: Vec<_> =
        world.lights.iter().enumerate().map(|(i, light)| (format!("light {i}"), lamp(light))).collect();
    list(module, "What shines.", "lamps", "Lamp", &lamps);
    objects(scene, life, module);
    camera(&world.standpoint, module);
    picture(scene, life, module);
}

/// Programs, and what builds the objects of them.
fn objects(scene: &WorldScene, life: &str, module: &mut Module) {
    let programs = &scene.world.programs.objects;
    let step = |op: &Op| match op {
        Op::Leaf(leaf) => format!("Op::Leaf({leaf})"),
        op => format!("Op::{op:?}"),
    };
    let rows = programs.iter().map(|object| {
        let steps: Vec<String> = object.ops.iter().map(step).collect();
        format!("&[{}]", steps.join(", "))
    });
    let rows: Vec<String> = rows.collect();
    module.array("Of which shapes each object is made, in reverse Polish.", "PROGRAMS", "&[Op]", rows.iter());
    let boxes: usize = programs.iter().map(|object| object.ops.len()).sum();
    module.constant("How many boxes the objects borrow.", "BOXES", "usize", boxes);
    let names: Vec<String> = (0..programs.len()).map(|k| format!("one_{k}")).collect();
    let mut lines =
        vec!["let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);".to_owned()];
    for (k, (name, object)) in names.iter().zip(programs).enumerate() {
        let rest = if k + 1 < programs.len() { "boxes" } else { "_" };
        lines.push(format!("let ({name}, {rest}) = boxes.split_at_mut({});", object.ops.len()));
    }
    lines.push("Ok([".to_owned());
    lines.extend(
        names
            .iter()
            .enumerate()
            .map(|(k, name)| format!("    Object::new(PROGRAMS[{k}], surface, {name})?,")),
    );
    lines.push("])".to_owned());
    let body: String = lines.iter().map(|line| format!("    {line}\n")).collect();
    module.item(
        "The objects.\n\n# Errors\nNone: the command has built them.",
        &format!(
            "#[rustfmt::skip]\npub fn objects<'a>(\n    leaves: &[Leaf<{}>],\n    boxes: &'a mut [Extent; BOXES],\n) -> Result<[Object<'a>; {}], Error> {{\n{body}}}\n",
            if life.is_empty() { "'static, Thing" } else { "'_, Thing<'_>" },
            programs.len()
        ),
    );
}

/// Type and expression of the surroundings.
fn around(around: &Around) -> (&'static str, String) {
    match around {
        Around::Plain(light) => ("Rgb", color(*light)),
        Around::Sky(sky) => {
            let [zenith, horizon, nadir] = [sky.zenith, sky.horizon, sky.nadir].map(color);
            ("Sky", format!("Sky {{ zenith: {zenith}, horizon: {horizon}, nadir: {nadir} }}"))
        }
        Around::Tiles(tiles) => {
            let pair = |[a, b]: [Rgb; 2]| format!("[{}, {}]", color(a), color(b));
            let code = format!(
                "Tiles {{ ceiling: {}, floor: {}, horizon: {}, scale: {}, fade: {} }}",
                pair(tiles.ceiling),
                pair(tiles.floor),
                color(tiles.horizon),
                constant(lit("Real", tiles.scale)),
                constant(lit("Unit", tiles.fade))
            );
            ("Tiles", code)
        }
        Around::Image(picture) => {
            ("Panorama<'static>", format!("Panorama::new({})", texture::picture_code(picture)))
        }
    }
}

/// The world of these parts, the caster, and what it asks for.
fn picture(scene: &WorldScene, life: &str, module: &mut Module) {
    let world = &scene.world;
    // what has no compounds takes no code for them
    let has_compounds = world.programs.objects.iter().any(|object| object.ops.len() > 1);
    let (made_by, compounds) = if has_compounds { ("new", "") } else { ("of_leaves", ", false") };
    module.item("The world.", &format!("pub type Whole<'a> = World<'a, Thing{life}, Stuff{compounds}>;\n"));
    module.item(
        "The world of these parts.\n\n# Errors\nNone: the command has built it.",
        &format!(
            "pub fn world<'a>(\n    leaves: &'a [Leaf<'a, Thing{life}>],\n    objects: &'a [Object<'a>],\n    materials: &'a [Stuff],\n    lamps: &'a [Lamp],\n) -> Result<Whole<'a>, Error> {{\n    Ok(World::{made_by}(leaves, objects, materials)?.with_lamps(lamps))\n}}\n"
        ),
    );
    let greys = format!("{:?}", world.contrast);
    let doc =
        "The greys that a display of 16 levels or fewer shows as black and as white: for `draw::Contrast`.";
    module.constant(doc, "CONTRAST", "Option<[u8; 2]>", greys);
    let crossings = scene.most_crossings();
    let rays = usize::from(world.depth) + 2;
    module.item(
        "The picture of the world.",
        &format!(
            "pub type Caster<'a> = WorldCaster<'a, Thing{life}, Stuff, {}, {crossings}, {rays}{compounds}>;\n",
            around(&world.around).0
        ),
    );
    let sampling = match (world.samples, world.seed) {
        (1, _) => "Sampling::Centre".to_owned(),
        (n, None) => format!("Sampling::Jittered {{ n: {n}, seed }}"),
        (n, Some(seed)) => format!("Sampling::Jittered {{ n: {n}, seed: {seed} }}"),
    };
    let real = |real: Real| constant(lit("Real", real));
    let filter = match world.filter {
        Filter::Gaussian { deviation, width } => {
            format!("Filter::Gaussian {{ deviation: {}, width: {} }}", real(deviation), real(width))
        }
        _ => "Filter::Box".to_owned(),
    };
    let mut lines = vec![
        format!("let caster = Caster::new(world, {}, camera()?, size)?;", around(&world.around).1),
        format!("caster.with_sampling({sampling}, {filter})"),
    ];
    if !sampling.contains("seed }") {
        lines.insert(0, "let _ = seed;".to_owned());
    }
    let body: String = lines.iter().map(|line| format!("    {line}\n")).collect();
    module.item(
        "The picture of the world; the command's seed is 1.\n\n# Errors\nThose of [`WorldCaster::new`].",
        &format!(
            "#[rustfmt::skip]\npub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {{\n{body}}}\n"
        ),
    );
}
