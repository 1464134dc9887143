//! Landscapes: the knots and the law of the surface; with the gallery the whole picture.

use attractor::num::{Real, Rgb, Unit, Vec3};
use attractor::terrain::Magnification;
use attractor_gallery::{Lines, TerrainPicture};

use super::module::{Module, lit, lits};
use crate::scene::terrain::TerrainScene;

/// The most knots that a module lists.
pub(super) const MOST: usize = 1 << 12;

pub(super) fn terrain(scene: &TerrainScene, module: &mut Module, gallery: bool) {
    let picture = scene.picture();
    let knots = picture.knots.iter().map(|h| lit("Real", *h));
    module.array("The heights of the knots, rows from south to north.", "KNOTS", "Real", knots);
    let TerrainPicture { columns, origin: [u, v], roughness: (offset, similarity), seed, .. } = picture;
    let rows = picture.knots.len() as u32 / columns;
    module.function(
        "The function of the surface.",
        "None: the command has built it.",
        "fn function() -> Result<PlaneToLine<'static>, Error>",
        &[
            format!("let knots = Heights::new({columns}, {rows}, &KNOTS)?.with_origin({u}, {v})?;"),
            format!("let random = RandomField::new({}).numbered({});", seed.0, seed.1),
            format!(
                "let (offset, similarity) = const {{ ({}, {}) }};",
                lit("Unit", offset),
                lit("Unit", similarity)
            ),
            "PlaneToLine::new(knots, Law::new(offset, similarity)?, random)".to_owned(),
        ],
    );
    module.constant("How often a cell between four knots is halved.", "LEVELS", "u32", picture.levels);
    if gallery {
        module.item("The landscape.", &literal(&picture));
        if let Some((lines, palette)) = scene.lines {
            let lines = match lines {
                Lines::Triangles(Magnification { eye, length, most }) => {
                    let eye = eye.map(|c| lit("Coordinate", c)).join(", ");
                    let length = unit(length);
                    format!(
                        "Lines::Triangles(Magnification {{ eye: [{eye}], length: {length}, most: {most} }})"
                    )
                }
                plain => format!("Lines::{plain:?}"),
            };
            module.item("Its lines.", &format!("#[rustfmt::skip]\npub const LINES: Lines = {lines};\n"));
            let pencil = format!("Pencil {{ palette: Named::{palette:?}, closed: false }}");
            module.constant("What they are drawn with.", "PENCIL", "Pencil", pencil);
        }
    }
}

fn real(c: Real) -> String {
    lit("Real", c)
}

fn unit(c: Unit) -> String {
    lit("Unit", c)
}

fn vector(v: Vec3) -> String {
    lits("Vec3", [v.x, v.y, v.z])
}

fn color(c: Rgb) -> String {
    let [r, g, b] = [c.r, c.g, c.b].map(|part| lit("Lumen", part));
    format!("Rgb::new({r}, {g}, {b})")
}

fn literal(picture: &TerrainPicture<'_>) -> String {
    let TerrainPicture { over: [[x_0, x_1], [y_0, y_1]], ground, plain, sun, sky, view, .. } = *picture;
    let plain = match plain {
        None => "None".to_owned(),
        Some(plain) => format!(
            "Some(Floor {{ level: {}, color: {}, reflect: {} }})",
            real(plain.level),
            color(plain.color),
            color(plain.reflect)
        ),
    };
    let fields = [
        ("knots", "&KNOTS".to_owned()),
        ("columns", picture.columns.to_string()),
        ("origin", format!("{:?}", picture.origin)),
        ("roughness", format!("({}, {})", unit(picture.roughness.0), unit(picture.roughness.1))),
        ("seed", format!("{:?}", picture.seed)),
        ("levels", "LEVELS".to_owned()),
        ("inner", format!("InnerGeometry::{:?}", picture.inner)),
        ("over", format!("[[{}, {}], [{}, {}]]", real(x_0), real(x_1), real(y_0), real(y_1))),
        (
            "ground",
            format!(
                "Ground {{ sand: {}, grass: {}, rock: {}, snow: {}, shore: {}, snow_line: {}, steep: {}, passage: {}, ragged: ({}, {}) }}",
                color(ground.sand),
                color(ground.grass),
                color(ground.rock),
                color(ground.snow),
                real(ground.shore),
                real(ground.snow_line),
                unit(ground.steep),
                unit(ground.passage),
                real(ground.ragged.0),
                unit(ground.ragged.1)
            ),
        ),
        ("plain", plain),
        ("sun", format!("({}, {})", vector(sun.0), color(sun.1))),
        ("ambient", unit(picture.ambient)),
        (
            "sky",
            format!(
                "Sky {{ zenith: {}, horizon: {}, nadir: {} }}",
                color(sky.zenith),
                color(sky.horizon),
                color(sky.nadir)
            ),
        ),
        ("haze", unit(picture.haze)),
        ("view", format!("({}, {}, {})", vector(view.0), vector(view.1), real(view.2))),
        ("samples", picture.samples.to_string()),
        ("contrast", format!("{:?}", picture.contrast)),
    ];
    let lines: String = fields.iter().map(|(name, value)| format!("    {name}: {value},\n")).collect();
    format!("#[rustfmt::skip]\npub const PICTURE: TerrainPicture<'static> = TerrainPicture {{\n{lines}}};\n")
}
