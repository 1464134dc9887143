//! Surfaces under a ray caster: their factors, where they are seen from, and how they answer light.

use attractor::fif::Pyramid;
use attractor::num::Vec3;
use attractor::trace::{Environment, Finish, Quality};

use super::function::function;
use super::module::{Module, lit, lits, variant};
use super::palette;
use crate::scene::Standpoint;
use crate::scene::fif_surface::FifSurface;

/// The longer side of the display for which a depth is stated.
pub(super) const SIDE: u32 = 240;

pub(super) fn surface(scene: &FifSurface, module: &mut Module, gallery: bool) {
    let (f, g) = (&scene.f.function, &scene.g.function);
    if f.parts == g.parts {
        function(f, "factor", "", module);
    } else {
        function(f, "f", "F_", module);
        function(g, "g", "G_", module);
    }
    let maps = [f.fixed.maps(), g.fixed.maps()];
    let depth = scene.depth_of_pyramids(SIDE);
    let cells = maps.map(|maps| Pyramid::cells(maps, depth));
    let lent = if f.parts == g.parts {
        format!("One pyramid serves for both factors: {} cells", cells[0])
    } else {
        format!("A pyramid for each factor: {} and {} cells", cells[0], cells[1])
    };
    let (fine, lent) = match scene.filter {
        None => ("as fine as a pixel", lent),
        Some(_) => ("half as wide as a pixel", format!("{lent}, and as many spreads")),
    };
    let doc = format!(
        "How deep the pyramids are; none: their cells are {fine}.\n{lent} are lent on {SIDE} pixels a side, {depth} deep."
    );
    module.constant(&doc, "DEPTH", "Option<u32>", format_args!("{:?}", scene.depth));
    camera(&scene.standpoint, module);
    look(scene.light, scene.material, scene.environment, module);
    let mut lines = vec![
        "let caster = RayCaster::new(surface, camera()?, size)?;",
        "let caster = caster.with_finish(MATERIAL)?;",
        "let caster = caster.with_environment(ENVIRONMENT)?;",
    ];
    lines.extend(scene.light.map(|_| "let caster = caster.with_light(Light::new(LIGHT)?);"));
    let mut lines: Vec<String> = lines.into_iter().map(str::to_owned).collect();
    let sampling = match scene.samples {
        1 => {
            lines.push("let _ = seed;".to_owned());
            "Sampling::Centre".to_owned()
        }
        n => format!("Sampling::Jittered {{ n: {n}, seed }}"),
    };
    lines.push(format!("caster.with_sampling({sampling}, Filter::Box)"));
    module.function(
        "The picture of the surface; the command's seed is 1.",
        "Those of [`RayCaster::new`].",
        "fn caster<'a>(surface: HeightField<'a>, size: Size, seed: u32) -> Result<RayCaster<'a>, Error>",
        &lines,
    );
    if let Some(quality) = scene.filter {
        let doc = "How fine the normals of a pixel are integrated.";
        module.constant(doc, "QUALITY", "Quality", named(quality));
    }
    palette::plain(scene.palette, module, gallery);
}

/// A quality by its name.
pub(super) fn named(quality: Quality) -> &'static str {
    match quality {
        Quality::Coarse => "Quality::Coarse",
        Quality::Fine => "Quality::Fine",
        Quality::Finest => "Quality::Finest",
        other => unreachable!("no scene is filtered by {other:?}"),
    }
}

fn vector(v: Vec3) -> String {
    lits("Vec3", [v.x, v.y, v.z])
}

/// Where the camera stands.
pub(super) fn camera(at: &Standpoint, module: &mut Module) {
    module.constant("Where the camera stands.", "EYE", "Vec3", vector(at.eye));
    module.constant("What it looks at.", "LOOK_AT", "Vec3", vector(at.look_at));
    module.constant("Which way is up.", "UP", "Vec3", vector(at.up));
    module.constant("Vertical, in degrees.", "FIELD_OF_VIEW", "Real", lit("Real", at.field_of_view));
    module.function(
        "The camera.",
        "Those of [`Camera::new`].",
        "fn camera() -> Result<Camera, Error>",
        &["Camera::new(EYE, LOOK_AT, UP, FIELD_OF_VIEW)".to_owned()],
    );
}

/// Light, material and surroundings.
pub(super) fn look(light: Option<Vec3>, material: Finish, environment: Environment, module: &mut Module) {
    if let Some(light) = light {
        module.constant("Towards the light.", "LIGHT", "Vec3", vector(light));
    }
    let material = match material {
        Finish::Diffuse { ambient } => format!("Finish::Diffuse {{ ambient: {} }}", lit("Unit", ambient)),
        Finish::Phong { ambient, diffuse, specular, shininess } => variant(
            "Finish::Phong",
            &[
                ("ambient", lit("Unit", ambient)),
                ("diffuse", lit("Unit", diffuse)),
                ("specular", lit("Unit", specular)),
                ("shininess", shininess.to_string()),
            ],
        ),
        Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance } => variant(
            "Finish::TorranceSparrow",
            &[
                ("ambient", lit("Unit", ambient)),
                ("diffuse", lit("Unit", diffuse)),
                ("specular", lit("Unit", specular)),
                ("roughness", lit("Unit", roughness)),
                ("reflectance", lit("Unit", reflectance)),
            ],
        ),
        Finish::Mirror => "Finish::Mirror".to_owned(),
        other => unreachable!("no scene is made of {other:?}"),
    };
    module.constant("What it is made of.", "MATERIAL", "Finish", material);
    let environment = match environment {
        Environment::Plain(tone) => format!("Environment::Plain({})", lit("Unit", tone)),
        Environment::Gradient { zenith, horizon, nadir } => variant(
            "Environment::Gradient",
            &[
                ("zenith", lit("Unit", zenith)),
                ("horizon", lit("Unit", horizon)),
                ("nadir", lit("Unit", nadir)),
            ],
        ),
        Environment::Checkerboard { bright, dark, horizon, scale, fade } => variant(
            "Environment::Checkerboard",
            &[
                ("bright", lit("Unit", bright)),
                ("dark", lit("Unit", dark)),
                ("horizon", lit("Unit", horizon)),
                ("scale", lit("Real", scale)),
                ("fade", lit("Unit", fade)),
            ],
        ),
        other => unreachable!("no scene is surrounded by {other:?}"),
    };
    module.constant("What surrounds it.", "ENVIRONMENT", "Environment", environment);
}
