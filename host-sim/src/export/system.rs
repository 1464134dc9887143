//! Systems of affine maps: attractors, and what a copier makes of a polyline.

use attractor::ifs::{Affine, Ifs, MAX_MAPS};
use attractor_gallery::Shading;

use super::module::{Module, decimal, lit};
use super::palette;
use crate::scene::copier::CopierScene;
use crate::scene::ifs::IfsScene;

/// An attractor by the chaos game.
pub(super) fn attractor(scene: &IfsScene, module: &mut Module, gallery: bool) {
    system(&scene.ifs, module);
    let doc = match scene.shading {
        Shading::Density => {
            "How many points are drawn; none: 16 a pixel. Their density takes a `u16` for each pixel of lent memory."
        }
        _ => "How many points are drawn; none: 4 a pixel.",
    };
    module.constant(doc, "POINTS", "Option<u32>", format_args!("{:?}", scene.points));
    palette::plain(scene.palette, module, gallery);
    if gallery {
        let value = format!("Shading::{:?}", scene.shading);
        module.constant("What decides the colour of a point.", "SHADING", "Shading", value);
    }
}

/// Copies of copies of a polyline.
pub(super) fn copies(scene: &CopierScene, module: &mut Module, gallery: bool) {
    system(&scene.ifs, module);
    module.points("What is copied.", "POLYLINE", &scene.shape);
    let orders: Vec<String> = scene.orders.iter().map(u32::to_string).collect();
    module.constant(
        "How often, a picture each.",
        "ORDERS",
        &format!("[u32; {}]", orders.len()),
        format_args!("[{}]", orders.join(", ")),
    );
    let deepest = scene.orders.iter().max().copied().unwrap_or(0);
    module.constant("The highest of them: the least `DEPTH` of a copier.", "DEPTH", "usize", deepest);
    palette::plain(scene.palette, module, gallery);
}

fn system(ifs: &Ifs<MAX_MAPS>, module: &mut Module) {
    module.item(
        "",
        "const fn map([a, b, c, d]: [&str; 4], [e, f]: [&str; 2]) -> Affine {\n    \
         let linear = [Unit::lit(a), Unit::lit(b), Unit::lit(c), Unit::lit(d)];\n    \
         Affine::new(linear, [Real::lit(e), Real::lit(f)])\n}\n",
    );
    let map = |m: &Affine| {
        let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(decimal);
        format!("map([{a:?}, {b:?}, {c:?}, {d:?}], [{:?}, {:?}])", decimal(m.e), decimal(m.f))
    };
    module.array("`x' = a x + b y + e`, `y' = c x + d y + f`.", "MAPS", "Affine", ifs.maps().iter().map(map));
    let probability = ifs.probabilities().iter().map(|p| lit("Unit", *p));
    module.array("One for each map.", "PROBABILITIES", "Unit", probability);
    module.function(
        "The system.",
        "[`Error::Capacity`] where there are more than `N` maps.",
        "fn system<const N: usize>() -> Result<Ifs<N>, Error>",
        &["Ifs::<N>::new(&MAPS, &PROBABILITIES)".to_owned()],
    );
}
