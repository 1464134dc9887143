//! Textures as expressions of core's, and scenes that are one.

use attractor::num::{Real, Rgb, Unit, Vec3};

use super::module::{Module, lit, lits};
use crate::scene::slice::SliceScene;
use crate::scene::world::Picture;
use crate::scene::world::texture::{Grain, Pattern};

/// An expression that is evaluated at compile time.
pub(super) fn constant(expression: String) -> String {
    format!("const {{ {expression} }}")
}

pub(super) fn vector(v: Vec3) -> String {
    constant(lits("Vec3", [v.x, v.y, v.z]))
}

pub(super) fn color(light: Rgb) -> String {
    if light == Rgb::BLACK || light == Rgb::WHITE {
        return if light == Rgb::BLACK { "Rgb::BLACK" } else { "Rgb::WHITE" }.to_owned();
    }
    let [r, g, b] = [light.r, light.g, light.b].map(|part| lit("Lumen", part));
    constant(format!("Rgb::new({r}, {g}, {b})"))
}

fn real(real: Real) -> String {
    constant(lit("Real", real))
}

fn unit(unit: Unit) -> String {
    constant(lit("Unit", unit))
}

/// Turbulence as an expression.
fn turbulence(grain: &Grain) -> String {
    format!("Turbulence::new(Noise::new({}), {}, {})?", grain.seed, real(grain.frequency), grain.octaves)
}

fn spline(colors: &[(Unit, Rgb)]) -> String {
    let knots: Vec<String> =
        colors.iter().map(|(knot, light)| format!("({}, {})", unit(*knot), color(*light))).collect();
    format!("Spline::new(&[{}])?", knots.join(", "))
}

/// What a variant of a texture is called, and its type.
pub(super) fn kind(pattern: &Pattern) -> (String, String) {
    let (name, kind) = match pattern {
        Pattern::Pasted { parent, detail, .. } => {
            let [(under, parent), (over, detail)] = [parent, detail].map(|part| kind(part));
            return (format!("{over}On{under}"), format!("Pasted<'static, {parent}, {detail}>"));
        }
        Pattern::Checker { .. } => ("Checker", "Checker".to_owned()),
        Pattern::Mottle { colors, .. } => ("Mottle", format!("Mottle<{}>", colors.len())),
        Pattern::Marble { colors, .. } => ("Marble", format!("Marble<{}>", colors.len())),
        Pattern::Wood { .. } => ("Wood", "Wood".to_owned()),
        Pattern::Facets { .. } | Pattern::Plain(_) => ("Plain", "Rgb".to_owned()),
        Pattern::Image { .. } => ("Image", "Mapped<Image<'static>>".to_owned()),
    };
    (name.to_owned(), kind)
}

/// A texture as an expression.
pub(super) fn code(pattern: &Pattern) -> String {
    match pattern {
        Pattern::Checker { colors: [even, odd], frequency, squares } => {
            let [x, y, z] = *frequency;
            let (name, frequency) = if *squares {
                ("squares", format!("[{}, {}]", real(x), real(y)))
            } else {
                ("cubes", format!("[{}, {}, {}]", real(x), real(y), real(z)))
            };
            format!("Checker::{name}({frequency}, {}, {})", color(*even), color(*odd))
        }
        Pattern::Mottle { colors, grain } => {
            format!("Mottle {{ undulate: {}, turbulence: {} }}", spline(colors), turbulence(grain))
        }
        Pattern::Marble { colors, grain, amplitude, veins } => format!(
            "Marble {{ undulate: {}, turbulence: {}, amplitude: {}, frequency: {} }}",
            spline(colors),
            turbulence(grain),
            real(*amplitude),
            real(*veins)
        ),
        Pattern::Wood { wood, rough } => {
            let rough = match rough {
                Some((grain, rings)) => format!("Some(({}, {}))", turbulence(grain), real(*rings)),
                None => "None".to_owned(),
            };
            format!(
                "Wood {{ colors: [{}, {}], rings: {}, tilt: [{}, {}], wobble: {}, lobes: {}, twist: {}, rough: {rough}, soft: {} }}",
                color(wood.colors[0]),
                color(wood.colors[1]),
                real(wood.rings),
                real(wood.tilt[0]),
                real(wood.tilt[1]),
                real(wood.wobble),
                wood.lobes,
                real(wood.twist),
                unit(wood.soft)
            )
        }
        Pattern::Facets { .. } => color(Rgb::WHITE),
        Pattern::Plain(light) => color(*light),
        Pattern::Pasted { parent, detail, corners } => {
            let corner = |[u, v]: &[Real; 2]| format!("[{}, {}]", lit("Real", *u), lit("Real", *v));
            let corners: Vec<String> = corners.iter().map(corner).collect();
            let corners = constant(format!("[{}]", corners.join(", ")));
            format!("Pasted::new({}, &{corners}, {})?", code(parent), code(detail))
        }
        Pattern::Image { lookup, rows, .. } => {
            let row = |row: [Real; 3]| format!("[{}]", row.map(real).join(", "));
            let [u, v] = rows.map(row);
            format!("Mapped::new({}.with_lookup(Lookup::{lookup:?}), [{u}, {v}])?", image(pattern))
        }
    }
}

/// A picture as an expression, its bytes included.
pub(super) fn picture_code(picture: &Picture) -> String {
    let (columns, rows) = picture.size;
    format!("Image::new(Texels::Rgb888, {columns}, {rows}, &{:?})?", picture.bytes)
}

/// The picture of a texture.
fn image(pattern: &Pattern) -> String {
    match pattern {
        Pattern::Image { picture, .. } => picture_code(picture),
        _ => String::new(),
    }
}

/// What a variant is called, type and expression of the bumps that a texture makes.
pub(super) fn bump(pattern: &Pattern, strength: Real) -> (&'static str, &'static str, String) {
    match pattern {
        Pattern::Mottle { grain, .. } => (
            "Rough",
            "Rough",
            format!("Rough {{ turbulence: {}, height: {} }}", turbulence(grain), real(strength)),
        ),
        Pattern::Facets { cells: [u, v], seed } => {
            let tilt = unit(Unit::saturating_from_num(strength));
            (
                "Facets",
                "Facets",
                format!("Facets {{ cells: [{}, {}], tilt: {tilt}, seed: {seed} }}", real(*u), real(*v)),
            )
        }
        other => (
            "Relief",
            "Relief<'static>",
            format!("Relief {{ image: {}, height: {} }}", image(other), real(strength)),
        ),
    }
}

/// What a variant is called, type and expression of the grain that a texture turns.
pub(super) fn grain(pattern: &Pattern, strength: Real) -> (&'static str, &'static str, String) {
    match pattern {
        Pattern::Mottle { grain, .. } => {
            let turns = unit(Unit::saturating_from_num(strength));
            ("Streaks", "(Turbulence, Unit)", format!("({}, {turns})", turbulence(grain)))
        }
        Pattern::Checker { .. } => ("Threads", "Checker", code(pattern)),
        other => ("Table", "Image<'static>", image(other)),
    }
}

/// A texture cut by a plane.
pub(super) fn slice(scene: &SliceScene, module: &mut Module) {
    if let Some(bounds) = scene.bounds() {
        let corner = |p: attractor::plane::Point2| lits("Point2", [p.x, p.y]);
        let code = format!("Bounds2 {{ min: {}, max: {} }}", corner(bounds.min), corner(bounds.max));
        module.constant("The square that is shown at least.", "BOUNDS", "Bounds2", code);
    }
    module.constant("Where the plane is: time.", "HEIGHT", "Real", lit("Real", scene.height));
    let (_, kind) = kind(&scene.pattern);
    module.item(
        "The texture.\n\n# Errors\nNone: the command has built it.",
        &format!(
            "#[rustfmt::skip]\npub fn texture() -> Result<{kind}, Error> {{\n    Ok({})\n}}\n",
            code(&scene.pattern)
        ),
    );
    module.function(
        "The picture of the texture.",
        "Those of [`Window::fit`].",
        &format!("fn picture(size: Size) -> Result<Slice<{kind}>, Error>"),
        &["Ok(Slice::new(texture()?, Window::fit(BOUNDS, size)?, HEIGHT))".to_owned()],
    );
}
