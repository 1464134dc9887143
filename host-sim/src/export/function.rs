//! Fractal interpolation functions: knots, vertical scalings, polynomials, integrals.

use attractor::fif::Knot;
use attractor::num::Wide;

use super::module::{Module, lit, lits};
use super::palette;
use crate::scene::fif_curve::FifCurve;
use crate::scene::function::Function;

/// A function and the chart of its graph.
pub(super) fn graph(scene: &FifCurve, module: &mut Module, gallery: bool) {
    function(&scene.function, "function", "", module);
    let maps: Vec<String> = scene.contractions.iter().map(usize::to_string).collect();
    module.constant(
        "The maps whose intervals are shown below the graph, by index from 0, the outermost first.",
        "ADDRESS",
        &format!("[usize; {}]", maps.len()),
        format_args!("[{}]", maps.join(", ")),
    );
    palette::plain(scene.palette, module, gallery);
}

/// Constants with this prefix, and a function of this name that builds it.
pub(super) fn function(function: &Function, name: &str, prefix: &str, module: &mut Module) {
    let (parts, fixed) = (&function.parts, &function.fixed);
    let (maps, degree) = (fixed.maps(), fixed.degree().max(1));
    let wide = |v: &Wide| lit("Wide", *v);
    let build = match &parts.polynomials {
        None => {
            let knot = |k: &Knot| lits("Knot", [k.x, k.y]);
            let name = format!("{prefix}KNOTS");
            module.array("Where the graph passes.", &name, "Knot", parts.knots.iter().map(knot));
            format!("Fif::<N, D>::interpolating(&{name}, &{prefix}VERTICAL_SCALINGS)")
        }
        Some(rows) => {
            let (x, q) = (format!("{prefix}ABSCISSAE"), format!("{prefix}POLYNOMIALS"));
            module.array("The ends of the intervals.", &x, "Wide", parts.knots.iter().map(|k| wide(&k.x)));
            let row = |row: &Vec<Wide>| format!("&[{}]", row.iter().map(wide).collect::<Vec<_>>().join(", "));
            let doc = "One for each interval: coefficients in x, constant first.";
            module.array(doc, &q, "&[Wide]", rows.iter().map(row));
            format!("Fif::<N, D>::from_polynomials(&{x}, &{prefix}VERTICAL_SCALINGS, &{q})")
        }
    };
    let scalings = parts.scalings.iter().map(|s| lit("Scaling", *s));
    module.array("One for each interval.", &format!("{prefix}VERTICAL_SCALINGS"), "Scaling", scalings);
    module.constant("Its maps: the least `N`.", &format!("{prefix}MAPS"), "usize", maps);
    module.constant(
        "The degree of their polynomials: the least `D`.",
        &format!("{prefix}DEGREE"),
        "usize",
        degree,
    );
    let integral = "f.integral::<D>(Wide::ZERO)";
    let lines = match parts.integrate {
        0 => vec![build],
        times => {
            let mut lines = vec![format!("let f = {build}?;")];
            lines.extend((1..times).map(|_| format!("let f = {integral}?;")));
            lines.push(integral.to_owned());
            lines
        }
    };
    let doc = match parts.integrate {
        0 => "The function.".to_owned(),
        1 => "The integral of the function through the knots.".to_owned(),
        times => format!("The function through the knots, integrated {times} times."),
    };
    let head = format!("fn {name}<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error>");
    module.function(&doc, "[`Error::Capacity`] where `N` or `D` is too small.", &head, &lines);
}
