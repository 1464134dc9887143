//! `attractor export`: the numbers of a scene as constants of a Rust module, for firmware that has no TOML.

use std::fmt::{Display, Write as _};
use std::io::Write as _;

use attractor::fif::Knot;
use attractor::ifs::{Ifs, MAX_MAPS};
use attractor::num::Scaling;

use crate::cli::Export;
use crate::fail::Fail;
use crate::scene;

/// What of a scene is more than a few numbers.
pub(crate) enum Constants<'a> {
    /// A function through knots with affine maps, integrated so often afterwards.
    Function { knots: &'a [Knot], scalings: &'a [Scaling], integrate: u32 },
    /// A system of affine maps.
    System(&'a Ifs<MAX_MAPS>),
}

/// Prints the module.
pub(crate) fn run(args: &Export) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let constants = scene
        .constants()
        .map_err(|reason| Fail::new(format_args!("{}: kind = {}: {reason}", args.scene, scene.kind())))?;
    let text = module(&scene.name, &scene.title, &constants);
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}

fn module(name: &str, title: &str, constants: &Constants<'_>) -> String {
    let (title, name) = (comment(title), comment(name).replace('`', "'"));
    let mut text = format!("//! {title}.\n//!\n//! Written by `attractor export {name}`.\n\n");
    // what is written to a string does not fail
    let _ = match constants {
        Constants::Function { knots, scalings, integrate } => {
            let call = format!("Fif::<{}, 1>::interpolating(&KNOTS, &VERTICAL_SCALINGS)", scalings.len());
            let then = if *integrate > 0 { format!(", integrated {integrate} times") } else { String::new() };
            write!(
                text,
                "use attractor::fif::Knot;\nuse attractor::num::{{Scaling, Wide}};\n\n\
                 const fn knot(x: i64, y: i64) -> Knot {{\n    Knot::new(Wide::from_bits(x), Wide::from_bits(y))\n}}\n\n\
                 /// Of `{call}`{then}.\n{}\n/// One for each interval.\n{}",
                array("KNOTS", "Knot", knots, |k| format!("knot({}, {})", k.x.to_bits(), k.y.to_bits())),
                array("VERTICAL_SCALINGS", "Scaling", scalings, |s| format!(
                    "Scaling::from_bits({})",
                    s.to_bits()
                )),
            )
        }
        Constants::System(ifs) => write!(
            text,
            "use attractor::ifs::Affine;\nuse attractor::num::{{Real, Unit}};\n\n\
             const fn map(l: [i32; 4], t: [i32; 2]) -> Affine {{\n    \
             let linear = [Unit::from_bits(l[0]), Unit::from_bits(l[1]), Unit::from_bits(l[2]), Unit::from_bits(l[3])];\n    \
             Affine::new(linear, [Real::from_bits(t[0]), Real::from_bits(t[1])])\n}}\n\n\
             /// Of `Ifs::<{}>::new(&MAPS, &PROBABILITIES)`.\n{}\n/// One for each map.\n{}",
            ifs.maps().len(),
            array("MAPS", "Affine", ifs.maps(), |m| {
                let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_bits());
                format!("map([{a}, {b}, {c}, {d}], [{}, {}])", m.e.to_bits(), m.f.to_bits())
            }),
            array("PROBABILITIES", "Unit", ifs.probabilities(), |p| format!(
                "Unit::from_bits({})",
                p.to_bits()
            )),
        ),
    };
    text
}

/// A text as part of a comment of one line: without line ends, control characters, and what turns the order
/// of reading round, which rustc refuses.
fn comment(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let escape = |c: char| match c {
        c if c.is_control() => c.escape_unicode().to_string(),
        '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => c.escape_unicode().to_string(),
        c => c.to_string(),
    };
    words.chars().map(escape).collect()
}

/// An array with a line for each element, as rustfmt leaves it.
fn array<T, D: Display>(name: &str, kind: &str, all: &[T], element: impl Fn(&T) -> D) -> String {
    let mut text = format!("#[rustfmt::skip]\npub static {name}: [{kind}; {}] = [\n", all.len());
    for one in all {
        let _ = writeln!(text, "    {},", element(one));
    }
    text.push_str("];\n");
    text
}
