//! Orbits: views of the Mandelbrot set and of filled-in Julia sets, with their colours, and Julia sets
//! themselves.

use attractor::escape::{DeepMandelbrot, View};
use attractor::num::Complex;
use attractor::num::{Limbs, Wide};
use attractor::plane::MAX_SIDE;
use attractor_gallery::{Method, PAPER};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{IntoStorage as _, Rgb888};

use super::module::{Module, lit, lits};
use super::palette;
use crate::palette::Colors;
use crate::scene::coloring::Coloring;
use crate::scene::deep::{Deep, LIMBS};
use crate::scene::escape::Escape;
use crate::scene::julia::JuliaScene;
use crate::scene::julia_set::JuliaSetScene;
use crate::scene::mandelbrot::MandelbrotScene;

/// A view of the Mandelbrot set, in as many bits as the displays need.
pub(super) fn mandelbrot(MandelbrotScene(scene): &MandelbrotScene, module: &mut Module) {
    // what 32 bits show on no display, and what they do not show on all
    let shown = |columns: u32| {
        scene.width.is_none_or(|width| View::new(scene.centre, width, Size::new(columns, 1)).is_ok())
    };
    if shown(1) {
        view(scene, module);
        picture(scene, "Mandelbrot", "Mandelbrot::new(view(size)?, MAX_DWELL)", module);
    }
    if let Some(deep) = scene.deep.filter(|_| !shown(MAX_SIDE)) {
        deep_picture(scene, deep, if shown(1) { "deep_" } else { "" }, module);
    }
    colors(scene, module);
}

/// A view of a filled-in Julia set.
pub(super) fn julia(scene: &JuliaScene, module: &mut Module) {
    module.constant("The constant of the set.", "C", "Complex<Wide>", complex(scene.c));
    view(&scene.escape, module);
    picture(&scene.escape, "Julia", "Julia::new(view(size)?, C, MAX_DWELL)", module);
    colors(&scene.escape, module);
}

/// A Julia set itself.
pub(super) fn julia_set(scene: &JuliaSetScene, module: &mut Module, gallery: bool) {
    module.constant("The constant of the set.", "C", "Complex<Wide>", complex(scene.c));
    module.function(
        "The set.",
        "None: those of [`JuliaSet::new`] do not occur with this constant.",
        "fn set() -> Result<JuliaSet, Error>",
        &["JuliaSet::new(C)".to_owned()],
    );
    let picture = scene.picture;
    let doc = match picture.method {
        Method::Plain => {
            "How many points are drawn; none: 8 a pixel. Their density takes a `u16` for each pixel of lent memory."
        }
        Method::Cover => "Every pixel is covered for itself: there are no points.",
    };
    module.constant(doc, "POINTS", "Option<u32>", format_args!("{:?}", picture.points));
    palette::plain(picture.palette, module, gallery);
    if gallery {
        module.constant("How it is found.", "METHOD", "Method", format_args!("Method::{:?}", picture.method));
    }
}

fn complex(z: Complex<Wide>) -> String {
    lits("Complex", [z.re, z.im])
}

/// What a display of any size shows, for as many bits as 32-bit orbits have.
fn view(scene: &Escape, module: &mut Module) {
    module.constant("The middle of the picture.", "CENTRE", "Complex<Wide>", complex(scene.centre));
    let build: &[&str] = match scene.width {
        Some(width) => {
            module.constant("Its width.", "WIDTH", "Wide", lit("Wide", width));
            &["View::new(CENTRE, WIDTH, size)"]
        }
        None => {
            let (width, height) = scene.home;
            module.constant("Its width at least.", "WIDTH", "Wide", lit("Wide", width));
            module.constant("Its height at least.", "HEIGHT", "Wide", lit("Wide", height));
            &[
                "let (columns, rows) = (i64::from(size.width), i64::from(size.height.max(1)));",
                "let (whole, rest) = (HEIGHT.to_bits() / rows, HEIGHT.to_bits() % rows);",
                "let fitting = whole.saturating_mul(columns).saturating_add(rest * columns / rows);",
                "View::new(CENTRE, WIDTH.max(Wide::from_bits(fitting)), size)",
            ]
        }
    };
    module.constant("The most iterations.", "MAX_DWELL", "u32", scene.max_dwell);
    let lines: Vec<String> = build.iter().map(|line| (*line).to_owned()).collect();
    module.function(
        "What a display of this size shows.",
        "Those of [`View::new`].",
        "fn view(size: Size) -> Result<View, Error>",
        &lines,
    );
}

/// The same with all digits: where there are pictures in 32 bits as well, under names with this prefix.
fn deep_picture(scene: &Escape, deep: Deep, prefix: &str, module: &mut Module) {
    let Deep(sight) = deep;
    let upper = prefix.to_uppercase();
    let limbs = |v: Limbs<LIMBS>| format!("Limbs::from_limbs({:?})", v.limbs());
    let (re, im, complex) =
        (limbs(sight.centre.re), limbs(sight.centre.im), format!("Complex<Limbs<{LIMBS}>>"));
    module.item(
        "The middle of the picture with all its digits.",
        &format!(
            "#[rustfmt::skip]\npub const {upper}CENTRE: {complex} = Complex::new(\n    {re},\n    {im},\n);\n"
        ),
    );
    module.item(
        "Its width.",
        &format!("#[rustfmt::skip]\npub const {upper}WIDTH: Limbs<{LIMBS}> =\n    {};\n", limbs(sight.width)),
    );
    if prefix.is_empty() {
        module.constant("The most iterations.", "MAX_DWELL", "u32", scene.max_dwell);
    }
    // the widest formats for the smallest pixels
    let views = [1, 128, 240, 480, MAX_SIDE].map(|side| deep.view(Size::new(side, side)));
    let points = views.iter().flatten().map(|view| DeepMandelbrot::orbit_points(view, scene.max_dwell));
    let doc = "Points of the orbit that the picture borrows, on a display of any size.";
    module.constant(doc, &format!("{upper}ORBIT"), "usize", points.max().unwrap_or(0));
    module.function(
        "What a display of this size shows.",
        "Those of [`DeepView::new`].",
        &format!("fn {prefix}view(size: Size) -> Result<DeepView<{LIMBS}>, Error>"),
        &[format!("DeepView::new({upper}CENTRE, {upper}WIDTH, size)")],
    );
    let doc = match prefix {
        "" => "Every pixel's orbit on a display of this size.",
        _ => "The same where pixels are too near one another for [`picture`], which says so.",
    };
    let kind = wrapped(scene, &format!("DeepMandelbrot<'_, {LIMBS}>"));
    module.function(
        doc,
        &format!(
            "Those of [`DeepView::new`]; [`Error::BufferLength`] for an orbit shorter than [`{upper}ORBIT`]."
        ),
        &format!("fn {prefix}picture(size: Size, orbit: &mut [OrbitPoint]) -> Result<{kind}, Error>"),
        &[made(scene, &format!("DeepMandelbrot::new({prefix}view(size)?, MAX_DWELL, orbit)"))],
    );
}

/// The field of a set, as its colouring wants it.
fn picture(scene: &Escape, of: &str, build: &str, module: &mut Module) {
    module.function(
        "Every pixel's orbit on a display of this size.",
        "Those of [`View::new`].",
        &format!("fn picture(size: Size) -> Result<{}, Error>", wrapped(scene, of)),
        &[made(scene, build)],
    );
}

/// The type of a colouring's field.
fn wrapped(scene: &Escape, of: &str) -> String {
    match scene.coloring {
        Coloring::Dwell => of.to_owned(),
        other => format!("{other:?}<{of}>"),
    }
}

/// Its value.
fn made(scene: &Escape, build: &str) -> String {
    match scene.coloring {
        Coloring::Dwell => build.to_owned(),
        other => format!("Ok({other:?}({build}?))"),
    }
}

/// The palettes, for displays with colour and without.
fn colors(scene: &Escape, module: &mut Module) {
    if scene.equalised && [scene.colors, scene.grey].iter().any(|colors| colors.cycle.is_none()) {
        let counts = scene.coloring.counts(scene.max_dwell);
        module.constant("Counts that an equalised palette borrows.", "COUNTS", "usize", counts);
    }
    for (colors, name, on) in [(scene.colors, "color", "with"), (scene.grey, "grey", "without")] {
        let doc = format!("Its colours on a display {on} colour.");
        if name == "grey" && scene.colors == scene.grey {
            let alias = if is_function(scene, colors) { "color as grey" } else { "COLOR as GREY" };
            module.item(&doc, &format!("pub use self::{alias};\n"));
        } else {
            palette_of(scene, colors, name, &doc, module);
        }
    }
}

/// Whether colours are known only when a picture or a display is.
fn is_function(scene: &Escape, colors: Colors) -> bool {
    scene.coloring == Coloring::Interior || (scene.equalised && colors.cycle.is_none())
}

fn palette_of(scene: &Escape, colors: Colors, name: &str, doc: &str, module: &mut Module) {
    let (kind, value) = palette::of_core(colors.named);
    let inside = format!("hex({})", rgb(colors.inside));
    if scene.coloring == Coloring::Interior {
        let doc = format!(
            "{doc}\n`paper` is what lies outside: {}, black where that could only be scattered dots.",
            rgb(PAPER)
        );
        let head = format!("fn {name}(paper: Rgb888) -> Inside<Ramp<6>>");
        module.function(&doc, "", &head, &[format!("Inside::new(Ramp::of_periods({value}), paper)")]);
        return;
    }
    if is_function(scene, colors) {
        let picture = "picture: &impl Field<Value: Leveled>, counts: &'a mut [u32]";
        let head = format!("fn {name}<'a>({picture}) -> Result<Inside<Equalised<'a, {kind}>>, Error>");
        let line = format!("Ok(Inside::new(Equalised::new(picture, counts, {value})?, {inside}))");
        module.function(doc, "[`Error::BufferLength`] for fewer counts than [`COUNTS`].", &head, &[line]);
        return;
    }
    let (kind, value) = match colors.cycle {
        Some(counts) if scene.coloring == Coloring::Smooth => {
            (format!("Cycled<{kind}>"), format!("Cycled::new({value}, {counts} * FractionalDwell::STEPS)"))
        }
        Some(counts) => (format!("Cycled<{kind}>"), format!("Cycled::new({value}, {counts})")),
        None if colors.lift => (format!("Brightened<{kind}>"), format!("Brightened({value})")),
        None => (kind, value),
    };
    let value = format!("Inside::new({value}, {inside})");
    module.constant(doc, &name.to_uppercase(), &format!("Inside<{kind}>"), value);
}

fn rgb(color: Rgb888) -> String {
    format!("{:#08x}", color.into_storage())
}
