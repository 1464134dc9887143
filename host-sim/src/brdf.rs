//! `attractor brdf`: how much of a height field leans which way, as a table for a material, and as a picture.

use std::io::Write as _;
use std::path::Path;

use attractor::draw::{Level, Palette as _};
use attractor::fif::{Sum, Sums};
use attractor::num::{Real, Wide};
use attractor::trace::material::Tabulated;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use indicatif::{ProgressBar, ProgressStyle};

use crate::cli::Brdf;
use crate::fail::Fail;
use crate::output;
use crate::palette::Named;
use crate::scene::fif_surface::Profile;
use crate::scene::{self, Kind, Scene};
use crate::slopes::Slopes;
use crate::still::{Pixels, Still};

/// Cells of the running sums, of whatever function, at least.
const CELLS: usize = 1 << 11;
/// The side of a picture in pixels, at least.
const PICTURE: u32 = 256;

/// What a file holds, by its ending.
#[derive(Debug, Clone, Copy)]
enum Format {
    Toml,
    Rust,
    Png,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Fail> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("toml") => Ok(Self::Toml),
            Some("rs") => Ok(Self::Rust),
            Some("png") => Ok(Self::Png),
            _ => {
                let reason = "a name ends in .toml or .rs, a table, or in .png, a picture";
                Err(Fail::new(format_args!("--output {}: {reason}", path.display())))
            }
        }
    }
}

/// Counts slopes and writes all files.
pub(crate) fn run(args: &Brdf) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let formats = args.output.iter().map(|path| Format::of(path)).collect::<Result<Vec<_>, _>>()?;
    // a built-in scene is no file, whatever lies there under its name
    let read = crate::builtin::find(&args.scene).is_none().then(|| Path::new(&args.scene));
    args.output.iter().try_for_each(|path| output::check_beside(path, read))?;
    let bar = ProgressBar::new(3);
    // not a terminal: indicatif stays silent
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}") {
        bar.set_style(style.progress_chars("=> "));
    }
    let slopes = tabulated(args, &scene, &bar)?;
    let title = title(args, &scene);
    // all of them are made before one is written
    let mut files = Vec::new();
    for (path, format) in args.output.iter().zip(formats) {
        let bytes = match format {
            Format::Toml => slopes.toml(&title).into_bytes(),
            Format::Rust => rust(&slopes, &title).into_bytes(),
            Format::Png => picture(&slopes, args.palette)
                .png()
                .map_err(|error| Fail::new(format_args!("{}: {error}", path.display())))?,
        };
        files.push((path, bytes));
    }
    bar.finish_and_clear();
    let mut out = std::io::stdout().lock();
    for (path, bytes) in files {
        output::write(path, &bytes)?;
        writeln!(out, "{}", path.display())?;
    }
    Ok(())
}

/// One line that says whose slopes they are.
fn title(args: &Brdf, scene: &Scene) -> String {
    let part = match args.region {
        None => String::new(),
        Some([x0, x1, y0, y1]) => format!(" above [{x0}, {x1}] x [{y0}, {y1}]"),
    };
    let (side, reach) = (args.side, f64::from(args.reach) / 256.0);
    let words = scene.name.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("The slopes of {words}{part}: {side} x {side} squares from -{reach} to {reach}.")
}

fn tabulated(args: &Brdf, scene: &Scene, bar: &ProgressBar) -> Result<Slopes, Fail> {
    let Kind::FifSurface(surface) = &scene.kind else {
        let (name, kind) = (&scene.name, scene.kind());
        let reason = "only a height field, a fif-surface, leans one way here and another there";
        return Err(Fail::new(format_args!("{name} is a {kind}: {reason}")));
    };
    let region = |axis: usize| args.region.map(|region| [region[axis], region[axis + 1]]);
    let points = |profile: &Profile, region: Option<[Wide; 2]>, axis: &str| {
        let (from, to) = profile.function.fixed.domain();
        if let Some([a, b]) = region.filter(|[a, b]| *a < from || *b > to) {
            let reason = format!("[{a}, {b}] leaves the domain [{from}, {to}] of {axis}");
            return Err(Fail::new(format_args!("--region: {}: {reason}", scene.name)));
        }
        bar.set_message(format!("slopes along {axis}"));
        bar.inc(1);
        along(profile, region.unwrap_or([from, to]), args.points)
    };
    let (x, y) = (points(&surface.f, region(0), "x")?, points(&surface.g, region(2), "y")?);
    bar.set_message("pairs");
    let count = usize::from(args.side).pow(2);
    let (mut counts, mut table) = (vec![0; count], vec![0; Tabulated::words(args.side)]);
    let table = Tabulated::tabulate((&x, &y), (args.side, args.reach), &mut counts, &mut table)
        .map_err(|error| Fail::new(format_args!("{}: {error}", scene.name)))?;
    Ok(Slopes::new(table))
}

/// Slopes and values along an axis.
fn along(profile: &Profile, [from, to]: [Wide; 2], count: u32) -> Result<Vec<[Real; 2]>, Fail> {
    let fixed = &profile.function.fixed;
    let deep = |depth: &u32| Sums::places(fixed.maps(), *depth) > CELLS;
    let depth = (1..Sums::MAX_DEPTH).find(deep).unwrap_or(Sums::MAX_DEPTH);
    let mut memory = vec![Sum::ZERO; Sums::places(fixed.maps(), depth)];
    let sums = Sums::new(fixed, depth, &mut memory).map_err(|error| profile.fail(error))?;
    let mut points = vec![[Real::ZERO; 2]; count as usize];
    sums.points(from, to, &mut points);
    Ok(points)
}

/// The table as a Rust module.
fn rust(slopes: &Slopes, title: &str) -> String {
    let title = crate::export::comment(title);
    let count = slopes.words().len();
    format!(
        "//! {title}\n//!\n//! Written by `attractor brdf`.\n\nuse attractor::Error;\nuse attractor::num::Unit;\nuse attractor::trace::material::Tabulated;\n\n/// Version, side, reach in 256ths, weights.\n#[rustfmt::skip]\npub static SLOPES: [u16; {count}] = [\n{}];\n\n/// The highlight of mirrors that lean so.\n///\n/// # Errors\n/// [`Error::OutOfRange`] for a reflectance outside `[0, 1]`.\npub fn highlight(reflectance: Unit) -> Result<Tabulated<'static>, Error> {{\n    Tabulated::new(&SLOPES, reflectance)\n}}\n",
        slopes.code()
    )
}

/// The table as a picture: each square as so many pixels a side that there are enough.
fn picture(slopes: &Slopes, palette: Named) -> Still {
    let side = u32::from(slopes.side()).max(1);
    let scale = PICTURE.div_ceil(side);
    let rows: Vec<&[u16]> = slopes.rows().collect();
    let most = f64::from(slopes.rows().flatten().copied().max().unwrap_or(1).max(1));
    let pixel = |i: u32, j: u32| {
        // upwards
        let (column, row) = ((i / scale) as usize, (side - 1 - j / scale) as usize);
        let weight = rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0);
        let level = ((f64::from(weight) / most).sqrt() * 65535.0).round();
        let color: Rgb888 = palette.rgb(Level::from_bits(level as u16));
        [color.r(), color.g(), color.b()]
    };
    let all = (0..side * scale).flat_map(|j| (0..side * scale).map(move |i| (i, j)));
    let size = embedded_graphics::geometry::Size::new(side * scale, side * scale);
    Still { size, pixels: Pixels::Colour(all.map(|(i, j)| pixel(i, j)).collect()) }
}
