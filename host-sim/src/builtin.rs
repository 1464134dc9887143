//! The built-in scenes: TOML files that are compiled in.

/// Embeds the files of `scenes/`, in the order in which they are listed.
macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../scenes/", $name, ".toml")))),*]
    };
}

/// Name and text of every built-in scene.
pub(crate) const SCENES: &[(&str, &str)] = scenes![
    "figure-1-f",
    "figure-1-g",
    "figure-2",
    "figure-3-f",
    "figure-3-g",
    "figure-6-ff",
    "figure-6-gg",
    "figure-6-ff-diffuse",
    "figure-6-gg-phong",
    "figure-6-gg-filtered",
    "figure-6-gg-phong-filtered",
    "figure-6-without-grain",
    "sunspots",
    "sierpinski",
    "fern",
    "dragon",
    "heighway-dragon",
    "koch-curve",
    "levy-c-curve",
    "maple-leaf",
    "pentigree",
    "sierpinski-carpet",
    "spiral",
    "terdragon",
    "tree",
    "koch-snowflake",
    "hilbert",
    "peano",
    "gosper",
    "minkowski",
    "cesaro-square",
    "elbow",
    "carpenter-1",
    "carpenter-2",
    "mountain-line",
    "extrapolation",
    "coastline",
    "cantor",
    "plant",
    "dragon-curve",
    "copier-gasket",
    "copier-fern",
    "mandelbrot",
    "mandelbrot-periods",
    "filaments",
    "seahorse-valley",
    "seahorse-smooth",
    "deep-30",
    "deep-100",
    "julia",
    "dendrite",
    "julia-dendrite",
    "san-marco",
    "rabbit-outline",
    "lens",
    "bowl",
    "rocket",
    "glass-spheres",
    "fish-bowl-outside",
    "fish-bowl-inside",
    "chain",
    "superellipsoids",
    "wood",
    "marble",
    "cloth",
    "orange",
    "brdf-spheres",
    "parcel",
    "figure-7",
    "figure-7-jittered",
    "clouds",
    "lava",
    "photograph",
    "photograph-colour",
    "regeneration",
    "maps-alone",
    "elevation",
    "edge-midpoints",
    "centre-midpoints",
    "no-hole",
    "mountain-bilinear",
    "mountain-ferguson",
    "mountain-b-spline",
    "island",
    "jacksboro",
    "flight",
    "patch-takagi",
    "patch-spirals",
    "patch-bezier",
    "patch-rock",
    "patch-joinings",
    "patch-diagonal",
    "patch-mountain",
];

/// The text of a built-in scene.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// The built-in scene whose name is nearest to a misspelt one; none when nothing is near.
pub(crate) fn nearest(name: &str) -> Option<&'static str> {
    let distance = |known: &str| {
        // a part of a name is nearer than its length says
        let part = known.contains(name) || known.split('-').any(|word| word == name);
        if part { 0 } else { strsim::damerau_levenshtein(name, known) }
    };
    let (known, _) = SCENES.iter().min_by_key(|(known, _)| (distance(known), known.len()))?;
    (distance(known) <= name.chars().count().div_ceil(3)).then_some(*known)
}

/// Built-in streams of images, by name.
pub(crate) const STREAMS: [(&str, &[u8]); 5] = [
    ("camera-streaming", include_bytes!("../../tests/vectors/version-1/camera-streaming.atfi")),
    ("camera-iterated", include_bytes!("../../tests/vectors/version-1/camera-iterated.atfi")),
    ("camera-pure", include_bytes!("../../tests/vectors/version-1/pure.atfi")),
    ("camera-colour", include_bytes!("../../tests/vectors/version-1/colour-halved.atfi")),
    ("jacksboro", include_bytes!("../data/jacksboro-elevation-m.atfi")),
];

/// A built-in data file that is no text.
pub(crate) fn bytes(file: &str) -> Option<&'static [u8]> {
    match file {
        "../data/jacksboro-elevation-m.png" => Some(include_bytes!("../data/jacksboro-elevation-m.png")),
        _ => None,
    }
}

/// The table of slopes of a built-in surface.
pub(crate) fn distribution(name: &str) -> Option<&'static str> {
    match name {
        "f-x-f" => Some(include_str!("../data/slopes-f-x-f.toml")),
        "g-x-g" => Some(include_str!("../data/slopes-g-x-g.toml")),
        _ => None,
    }
}

/// The text of a built-in data file.
pub(crate) fn data(file: &str) -> Option<&'static str> {
    match file {
        "../data/sunspots-yearly.csv" => Some(include_str!("../data/sunspots-yearly.csv")),
        _ => None,
    }
}
