//! Curves and surfaces by control points.

use attractor_gallery::Standpoint;

use super::module::{Module, lit, lits, variant};
use super::palette;
use super::surface::{look as of_look, named};
use crate::reconstruction::family::Family;
use crate::scene::patch_curve::{PatchCurve, Shape};
use crate::scene::patch_surface::{Look, PatchSurfaceScene};

/// A curve: its maps, column by column, its ends and its control points.
pub(super) fn curve(scene: &PatchCurve, module: &mut Module, gallery: bool) {
    let (count, columns, ends, points) = match &scene.shape {
        Shape::Two(curve, points) => (2, columns(curve), ends(curve), points.to_vec()),
        Shape::Three(curve, points) => (3, columns(curve), ends(curve), points.to_vec()),
        Shape::Four(curve, points) => (4, columns(curve), ends(curve), points.to_vec()),
        Shape::Five(curve, points) => (5, columns(curve), ends(curve), points.to_vec()),
        Shape::Six(curve, points) => (6, columns(curve), ends(curve), points.to_vec()),
    };
    let row = |row: &Vec<_>| {
        let numbers: Vec<String> = row.iter().map(|n| lit("Near", *n)).collect();
        format!("[{}]", numbers.join(", "))
    };
    let kind = format!("[Near; {count}]");
    module.array("The columns of both maps.", "COLUMNS", &kind, columns.iter().map(row));
    module.array("Where it begins and ends.", "ENDS", &kind, ends.iter().map(row));
    module.points("The control points.", "POINTS", &points);
    module.constant("How many binary digits a parameter has.", "LEVELS", "u32", scene.levels);
    module.function(
        "The curve.",
        "None: the command has built it.",
        &format!("fn curve() -> Result<ProjectedCurve<2, {count}>, Error>"),
        &[
            format!("let (left, right) = COLUMNS.split_at({count});"),
            "let map = |columns: &[_]| {".to_owned(),
            format!("    let mut all = [[Near::ZERO; {count}]; {count}];"),
            "    all.copy_from_slice(columns);".to_owned(),
            "    Barycentric::from_columns(all)".to_owned(),
            "};".to_owned(),
            "ProjectedCurve::with_ends([map(left)?, map(right)?], ENDS)".to_owned(),
        ],
    );
    palette::plain(scene.pencil.palette, module, false);
    if gallery {
        let pencil = format!("Pencil {{ palette: Named::{:?}, closed: false }}", scene.pencil.palette);
        module.constant("How it is coloured.", "PENCIL", "Pencil", pencil);
    }
}

type Rows = Vec<Vec<attractor::num::Near>>;

fn columns<const M: usize>(curve: &attractor::patch::ProjectedCurve<2, M>) -> Rows {
    let maps = curve.maps().iter();
    maps.flat_map(|map| (0..M).filter_map(|k| map.column(k).map(Vec::from))).collect()
}

fn ends<const M: usize>(curve: &attractor::patch::ProjectedCurve<2, M>) -> Rows {
    let at = |index| attractor::patch::Address::of(index, 0).ok();
    [0, 1].into_iter().filter_map(at).map(|address| curve.weights(address).to_vec()).collect()
}

/// A surface: its numbers, its heights, and what refines them.
pub(super) fn surface(scene: &PatchSurfaceScene, module: &mut Module, gallery: bool) {
    module.array(
        "The numbers of its maps.",
        "NUMBERS",
        "Near",
        scene.numbers.iter().map(|n| lit("Near", *n)),
    );
    module.array("The control heights.", "HEIGHTS", "Real", scene.heights.iter().map(|h| lit("Real", *h)));
    module.constant("Cells along a side.", "CELLS", "u32", scene.cells);
    if scene.look.is_none() {
        let doc = "How high 1 is, on a square from -1 to 1.";
        module.constant(doc, "HEIGHT", "Real", lit("Real", scene.height));
    }
    let (kind, width, build) = match scene.family {
        Family::Standard => ("Patch<2, 3, 9>", 9, vec!["Patch::standard(&NUMBERS)".to_owned()]),
        Family::Lattice => ("Mask", 16, vec!["Mask::from_numbers(&NUMBERS)".to_owned()]),
        Family::Tensor => (
            "Tensor<2, 3, 3, 9>",
            9,
            vec![
                "let [a, b, c, d, e, f, g, h] = NUMBERS;".to_owned(),
                "Tensor::new(standard_curve([a, b], [c, d])?, standard_curve([e, f], [g, h])?)".to_owned(),
            ],
        ),
    };
    module.function(
        "What refines the heights.",
        "None: the command has built it.",
        &format!("fn scheme() -> Result<{kind}, Error>"),
        &build,
    );
    module.function(
        "The surface over the unit square.",
        "None: the command has built it.",
        &format!("fn sheet(scheme: &{kind}) -> Result<Sheet<'_, {kind}, {width}>, Error>"),
        &["Sheet::new(scheme, &HEIGHTS, CELLS)".to_owned()],
    );
    if gallery {
        let Standpoint { eye, look_at, up, field_of_view } = scene.view;
        let vector = |v: attractor::num::Vec3| lits("Vec3", [v.x, v.y, v.z]);
        let view = [
            ("eye", vector(eye)),
            ("look_at", vector(look_at)),
            ("up", vector(up)),
            ("field_of_view", lit("Real", field_of_view)),
        ];
        module.constant("The camera.", "VIEW", "Standpoint", variant("Standpoint", &view));
        if let Some(look) = &scene.look {
            return lattice(scene, look, module);
        }
        module.constant("Towards the sun.", "SUN", "Vec3", vector(scene.sun));
        module.function(
            "The picture.",
            "None: the command has built it.",
            &format!(
                "fn picture(scheme: &{kind}) -> Result<PatchSurfacePicture<'_, {kind}, {width}>, Error>"
            ),
            &[format!(
                "Ok(PatchSurfacePicture {{ sheet: sheet(scheme)?, height: HEIGHT, view: VIEW, sun: SUN, \
                 samples: {} }})",
                scene.samples
            )],
        );
    }
}

/// The picture of a lattice in tones.
fn lattice(scene: &PatchSurfaceScene, look: &Look, module: &mut Module) {
    of_look(look.light, look.material, look.environment, module);
    palette::plain(look.palette, module, false);
    let light = if look.light.is_some() { "Some(LIGHT)" } else { "None" };
    let quality = look.quality.map_or("None".to_owned(), |quality| format!("Some({})", named(quality)));
    let (kind, _) = palette::of_core(look.palette);
    module.function(
        "The picture.",
        "None: the command has built it.",
        &format!("fn picture(scheme: &Mask) -> Result<LatticePicture<'_, {kind}>, Error>"),
        &[
            "Ok(LatticePicture {".to_owned(),
            "    sheet: sheet(scheme)?,".to_owned(),
            "    view: VIEW,".to_owned(),
            "    material: MATERIAL,".to_owned(),
            "    environment: ENVIRONMENT,".to_owned(),
            format!("    light: {light},"),
            format!("    samples: {},", scene.samples),
            format!("    quality: {quality},"),
            "    palette: PALETTE,".to_owned(),
            "})".to_owned(),
        ],
    );
}
