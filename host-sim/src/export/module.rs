//! A Rust module as text: constants and the functions that build core's objects of them, each formatted as
//! rustfmt leaves it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;
use std::str::FromStr;

use attractor::fixed::traits::Fixed;
use attractor::plane::Point2;

/// Where the names come from that a module may use.
const NAMES: [(&str, &str); 20] = [
    ("attractor", "Error"),
    ("attractor::codec", "Stream Sweeps open"),
    ("attractor::curve", "Elbow Generator LSystem LineToLine OneVariable Stop TwoVariable"),
    (
        "attractor::draw",
        "CourseUnit Cycled Equalised Gradient Grey Inside Brightened Ramp Leveled gradients hex",
    ),
    (
        "attractor::escape",
        "DeepMandelbrot DeepView Distance FractionalDwell Interior Julia JuliaSet Mandelbrot OrbitPoint Smooth View",
    ),
    ("attractor::fif", "Fif Knot Pyramid"),
    ("attractor::ifs", "Affine Ifs"),
    (
        "attractor::num",
        "Affine3 Angle Complex Coordinate Limbs Lumen Near Parameter RandomField Real Rgb Scaling Unit Vec3 Wide",
    ),
    ("attractor::patch", "Barycentric Mask Patch ProjectedCurve Sheet Tensor standard_curve"),
    ("attractor::plane", "Bounds2 Field Point2 Window"),
    ("attractor::terrain", "Heights InnerGeometry Law Magnification PlaneToLine"),
    (
        "attractor::trace",
        "Camera Environment Extent Filter HeightField Light Finish Panorama Quality RayCaster Sampling Sky Tiles",
    ),
    ("attractor::trace::material", "Anisotropic Clear Medium Mixture Phong Tabulated TorranceSparrow"),
    (
        "attractor::trace::solid",
        "Cube HalfSpace Moved Placed Plane Polygon Polyhedron Sphere Square Superellipsoid TaperedCylinder Torus",
    ),
    (
        "attractor::trace::texture",
        "Bumpy Checker Facets Framed Image Lookup Mapped Marble Mottle Noise Pasted Relief Rough Slice Spline \
         Texels Turbulence Wood",
    ),
    ("attractor::trace::world", "Lamp Leaf Object Op World WorldCaster"),
    (
        "attractor_gallery",
        "Floor Ground ImagePicture LatticePicture Lines Method Named PatchSurfacePicture Pencil Shading Standpoint TerrainPicture Tones",
    ),
    ("attractor::curve", "catalogue"),
    ("embedded_graphics::geometry", "Size"),
    ("embedded_graphics::pixelcolor", "Rgb888"),
];

/// The longest line that is not broken.
const WIDTH: usize = 110;

/// What is written so far.
#[derive(Debug, Default)]
pub(crate) struct Module {
    items: Vec<String>,
}

impl Module {
    /// A constant of one value.
    pub(crate) fn constant(&mut self, doc: &str, name: &str, kind: &str, value: impl Display) {
        let line = format!("pub const {name}: {kind} = {value};\n");
        // what has several lines is broken already
        let is_long = line.len() > WIDTH + 1 && line.lines().count() == 1;
        self.item(doc, &if is_long { format!("pub const {name}: {kind} =\n    {value};\n") } else { line });
    }

    /// An array with a line for each element.
    pub(crate) fn array<D: Display>(
        &mut self,
        doc: &str,
        name: &str,
        kind: &str,
        all: impl ExactSizeIterator<Item = D>,
    ) {
        let mut text = format!("#[rustfmt::skip]\npub static {name}: [{kind}; {}] = [\n", all.len());
        all.for_each(|one| text.push_str(&format!("    {one},\n")));
        self.item(doc, &format!("{text}];\n"));
    }

    /// An array of points of the plane.
    pub(crate) fn points(&mut self, doc: &str, name: &str, all: &[Point2]) {
        self.array(doc, name, "Point2", all.iter().map(|p| lits("Point2", [p.x, p.y])));
    }

    /// A function: its head without the brace, and its lines. `errors` is what it may fail with, as a part of
    /// its documentation.
    pub(crate) fn function(&mut self, doc: &str, errors: &str, head: &str, lines: &[String]) {
        let doc = if errors.is_empty() { doc.to_owned() } else { format!("{doc}\n\n# Errors\n{errors}") };
        let body: String = lines.iter().map(|line| format!("    {line}\n")).collect();
        let is_long = head.len() + "pub  {".len() > WIDTH;
        self.item(
            &doc,
            &format!("pub {} {{\n{body}}}\n", if is_long { broken(head) } else { head.to_owned() }),
        );
    }

    /// Any item; without a comment one of the module's own.
    pub(crate) fn item(&mut self, doc: &str, code: &str) {
        let line = |line: &str| if line.is_empty() { "///\n".to_owned() } else { format!("/// {line}\n") };
        self.items.push(doc.lines().map(line).collect::<String>() + code);
    }

    /// The text under its first comment.
    pub(crate) fn finished(&self, head: &str) -> String {
        let items = self.items.join("\n");
        let used = words(&items);
        let mut imports: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (path, names) in NAMES {
            for name in names.split(' ').filter(|name| used.contains(name)) {
                imports.entry(path).or_default().insert(name);
            }
        }
        let mut text = head.to_owned() + "\n";
        let mut lines: Vec<String> = imports
            .into_iter()
            .map(|(path, names)| import(path, &names.into_iter().collect::<Vec<_>>()))
            .collect();
        lines.sort();
        text.extend(lines);
        format!("{text}\n{items}")
    }
}

/// A function's head with a line for each parameter.
fn broken(head: &str) -> String {
    let parts = head.split_once('(').and_then(|(name, rest)| Some((name, rest.rsplit_once(") -> ")?)));
    let Some((name, (parameters, result))) = parts else { return head.to_owned() };
    format!("{name}(\n    {},\n) -> {result}", parameters.replace(", ", ",\n    "))
}

/// A line, or as many as the names take.
fn import(path: &str, names: &[&str]) -> String {
    let line = match names {
        [one] => format!("use {path}::{one};\n"),
        all => format!("use {path}::{{{}}};\n", all.join(", ")),
    };
    if line.len() <= WIDTH {
        return line;
    }
    let mut lines = vec![String::from("   ")];
    for name in names {
        match lines.last_mut() {
            Some(last) if last.len() + name.len() + " ,".len() <= WIDTH => *last += &format!(" {name},"),
            _ => lines.push(format!("    {name},")),
        }
    }
    format!("use {path}::{{\n{}\n}};\n", lines.join("\n"))
}

/// The words of what is code, neither comment nor string, and not a part of what stands before them.
fn words(text: &str) -> BTreeSet<&str> {
    let lines = text.lines().filter(|line| !line.starts_with("///"));
    let code = lines.flat_map(|line| line.split('"').step_by(2));
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut all = BTreeSet::new();
    for code in code {
        let mut rest = code;
        while let Some(start) = rest.find(is_word) {
            let (before, from) = rest.split_at(start);
            let end = from.find(|c| !is_word(c)).unwrap_or(from.len());
            let (word, after) = from.split_at(end);
            if !before.ends_with("::") {
                all.insert(word);
            }
            rest = after;
        }
    }
    all
}

/// A variant with named fields: on one line if there is room under a constant's name, else one a line.
pub(crate) fn variant(name: &str, fields: &[(&str, String)]) -> String {
    let pairs: Vec<String> = fields.iter().map(|(field, value)| format!("{field}: {value}")).collect();
    let line = format!("{name} {{ {} }}", pairs.join(", "));
    if line.len() + "    ;".len() <= WIDTH {
        return line;
    }
    let lines: String = pairs.iter().map(|pair| format!("    {pair},\n")).collect();
    format!("{name} {{\n{lines}}}")
}

/// A constant expression of a number: the format's `lit`.
pub(crate) fn lit<F: Fixed + FromStr>(format: &str, value: F) -> String {
    format!("{format}::lit({:?})", decimal(value))
}

/// The same of a type of several numbers.
pub(crate) fn lits<F: Fixed + FromStr, const N: usize>(kind: &str, values: [F; N]) -> String {
    let numbers = values.map(|value| format!("{:?}", decimal(value)));
    format!("{kind}::lit({})", numbers.join(", "))
}

/// The shortest decimal number that the format rounds to this one.
pub(crate) fn decimal<F: Fixed + FromStr>(value: F) -> String {
    let digits = (0..=F::FRAC_NBITS as usize).map(|places| format!("{value:.places$}"));
    digits.into_iter().find(|text| text.parse() == Ok(value)).unwrap_or_default()
}

/// A text as part of a comment of one line: without line ends, control characters, and what turns the order
/// of reading round, which rustc refuses.
pub(crate) fn comment(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let escape = |c: char| match c {
        c if c.is_control() => c.escape_unicode().to_string(),
        '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => c.escape_unicode().to_string(),
        c => c.to_string(),
    };
    words.chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::num::{Real, Wide};

    #[test]
    fn the_shortest_decimal_number_is_the_same_number() {
        for text in ["0", "-0.7453", "0.12256116687665", "1", "100", "-0.000000001"] {
            assert_eq!(decimal(text.parse::<Wide>().unwrap()), text);
        }
        for bits in [1, -1, 77, 123_456_789, i32::MAX, i32::MIN] {
            let value = Real::from_bits(bits);
            assert_eq!(decimal(value).parse(), Ok(value), "{bits}");
        }
        assert_eq!(lit("Real", Real::from_bits(1 << 23)), "Real::lit(\"0.5\")");
    }

    #[test]
    fn what_is_used_is_imported_and_nothing_else() {
        let mut module = Module::default();
        module.constant("An [`Error`] says so.", "AXIOM", "&str", "\"Real\"");
        module.function("", "", "fn f() -> Unit", &["Unit::lit(\"0.5\")".to_owned()]);
        let text = module.finished("//! Head.\n");
        assert!(text.starts_with("//! Head.\n\nuse attractor::num::Unit;\n\n/// An [`Error`]"), "{text}");
    }
}
