//! Paths: refined curves, random ones, L-systems.

use attractor::curve::Stop;
use attractor_gallery::Pencil;

use super::module::{Module, lit};
use super::palette;
use crate::scene::curve::{CurveScene, Origin};
use crate::scene::l_system::LSystemScene;
use crate::scene::law::Recipe;
use crate::scene::random_curve::RandomCurve;

/// A polyline each of whose segments is replaced by a generator.
pub(super) fn refined(scene: &CurveScene, module: &mut Module, gallery: bool) {
    let build = match &scene.origin {
        Origin::Named(curve) => {
            format!("catalogue::{}.generator::<S>()", curve.name.replace('-', "_").to_uppercase())
        }
        Origin::Polyline(vertices) => {
            let pair = |[x, y]: &[_; 2]| format!("[{}, {}]", lit("Wide", *x), lit("Wide", *y));
            let doc = "What stands in place of a segment, from its start to its end.";
            module.array(doc, "VERTICES", "[Wide; 2]", vertices.iter().map(pair));
            "Generator::<S>::polyline(&VERTICES)".to_owned()
        }
        Origin::Turtle(word, angle) => {
            module.constant("What stands in place of a segment.", "WORD", "&str", format_args!("{word:?}"));
            let turn = format!("Angle::from_bits({})", angle.to_bits());
            module.constant("Of a turn, with 32 fractional bits.", "ANGLE", "Angle", turn);
            "Generator::<S>::turtle(WORD, ANGLE)".to_owned()
        }
    };
    module.constant("Segments of the generator: the least `S`.", "SEGMENTS", "usize", scene.generator.len());
    module.function(
        "The generator.",
        "[`Error::Capacity`] where it has more than `S` segments.",
        "fn generator<const S: usize>() -> Result<Generator<S>, Error>",
        &[build],
    );
    module.points("What is refined.", "BASE", &scene.base);
    let doc = "How often; none: down to the length of a pixel.";
    module.constant(doc, "ORDER", "Option<u32>", format_args!("{:?}", scene.order));
    ground(scene.filled, module);
    inked(scene.pencil, module, gallery);
}

/// A curve whose midpoints a law displaces.
pub(super) fn random(scene: &RandomCurve, module: &mut Module, gallery: bool) {
    let (law, build) = match scene.recipe {
        Recipe::Elbow { deviation, beta } => {
            module.constant("The spectral exponent.", "BETA", "Real", lit("Real", beta));
            let build = match deviation {
                None => "self_similar(BETA, SEED)",
                Some(deviation) => {
                    let doc = "The standard deviation of the first offset, for each length of a segment.";
                    module.constant(doc, "DEVIATION", "Unit", lit("Unit", deviation));
                    "new(DEVIATION, BETA, SEED)"
                }
            };
            ("Elbow", build)
        }
        Recipe::LineToLine { offset, beta } => {
            module.constant("The spectral exponent.", "BETA", "Real", lit("Real", beta));
            module.constant("The first offset.", "OFFSET", "Unit", lit("Unit", offset));
            ("LineToLine", "from_spectrum(OFFSET, BETA, SEED)")
        }
        Recipe::OneVariable { offset } => {
            module.constant("The offset.", "OFFSET", "Unit", lit("Unit", offset));
            ("OneVariable", "new(OFFSET, SEED)")
        }
        Recipe::OfRatio { ratio } => {
            module.constant("The similarity ratio.", "RATIO", "Real", lit("Real", ratio));
            ("OneVariable", "from_ratio(RATIO, SEED)")
        }
        Recipe::TwoVariable { offset } => {
            module.constant("The offset.", "OFFSET", "Unit", lit("Unit", offset));
            ("TwoVariable", "new(OFFSET, SEED)")
        }
    };
    module.constant("Selects one of all curves.", "SEED", "u64", scene.seed);
    module.function(
        "The law.",
        &format!("None: those of [`{law}`]'s constructors do not occur with these numbers."),
        &format!("fn law() -> Result<{law}, Error>"),
        &[format!("{law}::{build}")],
    );
    module.points("What it goes through.", "KNOTS", &scene.knots);
    let stop = scene.stop.map_or("None".to_owned(), |stop| match stop {
        Stop::Parameter(p) => format!("Some(Stop::Parameter({}))", lit("Parameter", p)),
        Stop::Norm(r) => format!("Some(Stop::Norm({}))", lit("Real", r)),
        Stop::Length(r) => format!("Some(Stop::Length({}))", lit("Real", r)),
        other => unreachable!("no scene stops by {other:?}"),
    });
    module.item(
        "Where it stops; none: at the length of a pixel.",
        &format!("pub const STOP: Option<Stop> = {stop};\n"),
    );
    let doc = "Whether it is the graph of a function, stretched over the display.";
    module.constant(doc, "GRAPH", "bool", scene.is_graph());
    ground(scene.filled, module);
    inked(scene.pencil, module, gallery);
}

/// A word that is rewritten and drawn by a turtle.
pub(super) fn words(scene: &LSystemScene, module: &mut Module, gallery: bool) {
    module.constant("What is rewritten.", "AXIOM", "&str", format_args!("{:?}", scene.axiom));
    let rules = scene.rules.iter().map(|(letter, word)| format!("({letter:?}, {word:?})"));
    module.array("By what each letter is replaced.", "RULES", "(char, &str)", rules);
    module.constant("Of a turn, in degrees.", "ANGLE", "Wide", lit("Wide", scene.angle));
    module.constant(
        "Where the turtle heads first, in degrees.",
        "HEADING",
        "Wide",
        lit("Wide", scene.heading),
    );
    module.function(
        "The system.",
        "None: those of [`LSystem::new`] do not occur with these words.",
        "fn system() -> Result<LSystem<'static>, Error>",
        &["Ok(LSystem::new(AXIOM, &RULES, ANGLE)?.with_heading(HEADING))".to_owned()],
    );
    let doc = "How often it is rewritten: the least `ORDERS` of a path.";
    module.constant(doc, "ORDER", "u32", scene.order);
    let doc = "How many brackets are open at once: the least `BRANCHES` of a path.";
    module.constant(doc, "BRANCHES", "usize", scene.branches());
    inked(scene.pencil, module, gallery);
}

/// Whether there is a ground.
fn ground(filled: bool, module: &mut Module) {
    let doc = "Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.";
    module.constant(doc, "FILLED", "bool", filled);
}

/// How a path is drawn.
fn inked(pencil: Pencil, module: &mut Module, gallery: bool) {
    let Pencil { palette, closed } = pencil;
    palette::plain(palette, module, false);
    if gallery {
        let value = format!("Pencil {{ palette: Named::{palette:?}, closed: {closed} }}");
        module.constant("How its colours change along it.", "PENCIL", "Pencil", value);
    }
}
