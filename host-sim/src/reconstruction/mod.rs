//! `attractor fit`: the surface by control points that is nearest to a landscape.
//!
//! Source: Tosan, Guerin, Baskurt, "Design and Reconstruction of Fractal Surfaces", 2002, section 6.

mod elevation;
pub(crate) mod family;
pub(crate) mod scheme;
mod solver;
mod spline;
pub(crate) mod table;

use std::fmt::Write as _;
use std::io::{Write as _, stdout};
use std::path::{Path, PathBuf};
use std::time::Instant;

use attractor::num::{Near, Real};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use crate::fail::Fail;
use crate::number::exact;
use crate::{output, table as columns};
use elevation::{Elevation, Voids};
use family::Family;
use scheme::Scheme;
use solver::{Fitted, Model, Samples};

/// The most steps from one start.
const STEPS: u32 = 80;

/// Bits of a height and of a number where bytes are counted, and bytes for the place and the range.
const HEIGHT_BITS: usize = 12;
const NUMBER_BITS: usize = 16;
const HEADER_BYTES: usize = 8;

#[derive(Debug, Args)]
#[command(after_help = "Families
  standard   patches of 3 x 3 heights that share the 72 numbers of the text's 5 x 5 grid; 72 + 9 for one patch
  tensor     patches of 3 x 3 heights that share the product of two curves: 8 numbers
  lattice    (g + 3)^2 heights and the 21 numbers of one refinement mask: the bicubic B-spline is one of them

A window of g 2^k + 1 samples a side is shown by g x g patches or cells, as many as --parameters or --bytes allow: of
129 samples, 142 parameters are a lattice of 8 x 8 cells, 382 one of 16 x 16.
With --bytes heights are rounded to 12 bits, numbers to 16, and 8 bytes say where and how high.

Examples:
  attractor fit elevation.png --model lattice --parameters 382 --window 60,200,129 -o hills.toml
  attractor fit elevation.png --model standard --parameters 81 --window 60,200,129 -o patch.toml
  attractor fit elevation.png --model lattice --parameters 142 --tiles 129     sixteen tiles, each beside splines")]
#[command(group = clap::ArgGroup::new("size").required(true))]
pub(crate) struct Fit {
    /// A grey PNG file of 16 bits, one sample an elevation
    #[arg(value_name = "DEM.png")]
    elevation: PathBuf,
    /// What is fitted
    #[arg(long, default_value = "lattice")]
    model: Family,
    /// At most so many numbers and heights
    #[arg(long, value_name = "N", allow_hyphen_values = true, group = "size")]
    parameters: Option<usize>,
    /// At most so many bytes
    #[arg(long, value_name = "B", allow_hyphen_values = true, group = "size")]
    bytes: Option<usize>,
    /// The square window that is fitted: its first row and column, and its side; else the whole file
    #[arg(long, value_name = "row,col,side", allow_hyphen_values = true, value_parser = parse_window)]
    window: Option<[usize; 3]>,
    /// What becomes of missing samples
    #[arg(long, default_value = "refuse")]
    voids: Voids,
    /// The scene file that is written
    #[arg(short, long, value_name = "SCENE.toml", required_unless_present = "tiles")]
    output: Option<PathBuf>,
    /// Instead: fit sixteen tiles of this side, evenly over the file, and print each beside splines
    #[arg(long, value_name = "SIDE", allow_hyphen_values = true, conflicts_with_all = ["window", "output"])]
    tiles: Option<usize>,
}

fn parse_window(text: &str) -> Result<[usize; 3], String> {
    let numbers: Vec<usize> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    let numbers = numbers.try_into().ok().filter(|_| text.split(',').count() == 3);
    numbers.ok_or_else(|| "a window is row,col,side, for example 60,200,129".to_owned())
}

/// A fit and what is said of it.
struct Report {
    model: Model,
    best: Fitted,
    /// Of core's surface with the numbers that are written.
    psnr: f64,
    bytes: usize,
    seconds: f64,
    /// Of B-splines of degree 1 to 3 with as many coefficients.
    splines: [Option<f64>; 3],
    numbers: Vec<Near>,
    heights: Vec<Real>,
}

/// Fits, and writes a scene or prints a table. `check` says whether a text that goes to a path is a scene.
pub(crate) fn run(args: &Fit, check: impl Fn(&Path, &str) -> Result<(), Fail>) -> Result<(), Fail> {
    let name = args.elevation.display().to_string();
    let elevation = Elevation::read(&args.elevation)?;
    if let Some(side) = args.tiles {
        return tiles(args, &elevation, side);
    }
    let window = match args.window {
        Some(window) => window,
        None if elevation.rows == elevation.columns => [0, 0, elevation.rows],
        None => {
            let (rows, columns) = (elevation.rows, elevation.columns);
            let reason =
                format!("{rows} rows and {columns} columns are no square: --window row,col,side takes one");
            return Err(Fail::new(format_args!("{name}: {reason}")));
        }
    };
    let path = args.output.as_deref().unwrap_or(Path::new("-"));
    let (samples, least, range) = elevation.window(&name, window, args.voids)?;
    output::check_beside(path, [&*args.elevation])?;
    let report = fit(args, &samples, range)?;
    let text = scene(&report, &args.elevation, window, (least, range));
    check(path, &text).map_err(|fail| match fail {
        Fail::Message(reason) => {
            let what = "the fit is no scene that can be drawn, and is not written";
            Fail::new(format_args!("{name}: {what}: {reason}"))
        }
        pipe => pipe,
    })?;
    output::write(path, text.as_bytes())?;
    let mut out = stdout().lock();
    writeln!(out, "{}", columns::columns([head(), row("", &report)], 1))?;
    writeln!(out, "{}", path.display())?;
    Ok(())
}

/// Sixteen tiles, evenly over the file.
fn tiles(args: &Fit, elevation: &Elevation, side: usize) -> Result<(), Fail> {
    let name = args.elevation.display().to_string();
    if side > elevation.rows.min(elevation.columns) {
        let (rows, columns) = (elevation.rows, elevation.columns);
        return Err(Fail::new(format_args!("--tiles {side}: {name} has {rows} rows and {columns} columns")));
    }
    let along = |length: usize| (0..4).map(move |k| k * (length - side) / 3);
    let (mut rows, mut won, mut cubic) = (vec![head()], 0, 0);
    for at in along(elevation.rows) {
        for column in along(elevation.columns) {
            let (samples, _, range) = elevation.window(&name, [at, column, side], args.voids)?;
            let report = fit(args, &samples, range)?;
            let beats = |psnr: Option<f64>| psnr.is_none_or(|psnr| report.psnr > psnr);
            won += u32::from(report.splines.iter().all(|psnr| beats(*psnr)));
            cubic += u32::from(beats(report.splines[2]));
            rows.push(row(&format!("({at},{column})"), &report));
        }
    }
    let mut out = stdout().lock();
    writeln!(out, "{}", columns::columns(rows, 1))?;
    writeln!(out, "better than the spline of degree 3 on {cubic} of 16 tiles, than every degree on {won}")?;
    Ok(())
}

fn head() -> [String; 11] {
    [
        "tile",
        "model",
        "cells",
        "parameters",
        "bytes",
        "PSNR",
        "steps",
        "seconds",
        "spline 1",
        "spline 2",
        "spline 3",
    ]
    .map(str::to_owned)
}

fn row(tile: &str, report: &Report) -> [String; 11] {
    let Model { family, cells, .. } = report.model;
    let decibels = |psnr: f64| format!("{psnr:.2}");
    let spline = |k: usize| report.splines[k].map_or_else(|| "-".to_owned(), decibels);
    [
        tile.to_owned(),
        family.name().to_owned(),
        format!("{cells} x {cells}"),
        family.parameters(cells).to_string(),
        report.bytes.to_string(),
        decibels(report.psnr),
        report.best.steps.to_string(),
        format!("{:.1}", report.seconds),
        spline(0),
        spline(1),
        spline(2),
    ]
}

/// Bytes of a surface of so many cells.
fn bytes(family: Family, cells: usize) -> usize {
    let side = family.side(cells);
    (HEIGHT_BITS * side * side).div_ceil(8) + (NUMBER_BITS * family.numbers()).div_ceil(8) + HEADER_BYTES
}

/// The most cells that parameters or bytes allow.
fn model(args: &Fit, side: usize) -> Result<Model, Fail> {
    let family = args.model;
    let allowed = |cells: usize| match (args.parameters, args.bytes) {
        (Some(most), _) => family.parameters(cells) <= most,
        (None, most) => bytes(family, cells) <= most.unwrap_or(0),
    };
    let asked = match (args.parameters, args.bytes) {
        (Some(most), _) => format!("--parameters {most}"),
        (None, most) => format!("--bytes {}", most.unwrap_or(0)),
    };
    if let Some(most) = args.parameters.filter(|most| *most > side * side) {
        let count = side * side;
        return Err(Fail::new(format_args!(
            "--parameters {most}: more than the {count} samples of the window"
        )));
    }
    let spans = side.saturating_sub(1);
    let fits = |cells: &usize| spans.is_multiple_of(*cells) && (spans / cells).is_power_of_two();
    let possible: Vec<usize> =
        (1..=spans).filter(fits).filter(|cells| family.parameters(*cells) < side * side).collect();
    let Some(fewest) = possible.first() else {
        let reason = format!("a window of {side} samples a side holds no {}", family.name());
        return Err(Fail::new(format_args!(
            "{reason}: it takes g 2^k + 1 of them, and more samples than parameters"
        )));
    };
    let Some(cells) = possible.iter().copied().filter(|cells| allowed(*cells)).max() else {
        let (parameters, bytes) = (family.parameters(*fewest), bytes(family, *fewest));
        let (name, plural) = (family.name(), if *fewest == 1 { "" } else { "s" });
        let reason = format!("the smallest {name} for {side} samples a side, {fewest} cell{plural} along it");
        return Err(Fail::new(format_args!("{asked}: {reason}, has {parameters} parameters, {bytes} bytes")));
    };
    Ok(Model { family, cells, levels: (spans / cells).ilog2(), tether: family.tether() })
}

/// The best of all starts, or a start itself. The range is that of the file's whole numbers.
fn fit(args: &Fit, samples: &Samples, range: f64) -> Result<Report, Fail> {
    let model = model(args, samples.side)?;
    let begun = Instant::now();
    // not a terminal: indicatif stays silent
    let bar = ProgressBar::new_spinner().with_style(
        ProgressStyle::with_template("{spinner} {msg} {elapsed}").unwrap_or(ProgressStyle::default_spinner()),
    );
    let starts = model.family.starts();
    let (mut best, mut before): (Option<Fitted>, f64) = (None, f64::INFINITY);
    let mut nearest = None;
    for (number, start) in starts.iter().enumerate() {
        let mut first = None;
        let fitted = model.fit(samples, start, STEPS, |step, error| {
            first.get_or_insert(error);
            let (number, count) = (number + 1, starts.len());
            bar.set_message(format!("start {number} of {count}, step {step}: {:.2} dB", samples.psnr(error)));
            bar.tick();
        });
        if let Some(first) = first.filter(|first| *first < before) {
            (before, nearest) = (first, Some(start));
        }
        if let Some(fitted) = fitted.filter(|fitted| model.is_one(&fitted.numbers, &fitted.heights)) {
            if best.as_ref().is_none_or(|best| fitted.error < best.error) {
                best = Some(fitted);
            }
        }
    }
    bar.finish_and_clear();
    // what rounding to whole numbers makes of any surface
    let rounding = samples.values.len() as f64 * (1.0 / (12.0 * range * range)).max(1e-12);
    // less than a millionth is what rounding does
    let improves = |fitted: &Fitted| fitted.error < before * (1.0 - 1e-6) || fitted.error < rounding;
    // a plane is where one starts
    let start = nearest.and_then(|start| model.fit(samples, start, 0, |_, _| ()));
    let start = start.filter(|start| model.is_one(&start.numbers, &start.heights));
    let all = best.into_iter().chain(start).filter(improves);
    let best = all.min_by(|a, b| a.error.total_cmp(&b.error));
    let Some(best) = best else {
        return Err(Fail::new(
            "the fit does not improve: no step from any start lessened the error; nothing is written",
        ));
    };
    let (numbers, heights) = written(args, &best);
    let scheme = Scheme::new(model.family, &numbers).map_err(|error| {
        Fail::new(format_args!("rounded to their formats the numbers are no surface: {error}"))
    })?;
    let table = scheme.tabulated(&heights, model.cells as u32, model.levels).map_err(Fail::new)?;
    let error: f64 = table
        .iter()
        .zip(&samples.values)
        .map(|(height, value)| (height.to_num::<f64>() - value).powi(2))
        .sum();
    let sides = spline::sides(model.family.parameters(model.cells));
    let splines = [1, 2, 3].map(|degree| Some(samples.psnr(spline::squared_error(samples, sides, degree)?)));
    let parameters = model.family.parameters(model.cells);
    let bytes =
        if args.bytes.is_some() { bytes(model.family, model.cells) } else { 4 * parameters + HEADER_BYTES };
    let (seconds, psnr) = (begun.elapsed().as_secs_f64(), samples.psnr(error));
    Ok(Report { model, best, psnr, bytes, seconds, splines, numbers, heights })
}

/// Numbers and heights as the scene has them: in core's formats, with `--bytes` rounded to fewer bits.
fn written(args: &Fit, best: &Fitted) -> (Vec<Near>, Vec<Real>) {
    let coarse = args.bytes.is_some();
    let number = |n: &f64| {
        let places = f64::from(1 << (NUMBER_BITS - 3));
        Near::saturating_from_num(if coarse { (n * places).round() / places } else { *n })
    };
    let least = best.heights.iter().copied().fold(f64::INFINITY, f64::min);
    let range = best.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least;
    let height = |h: &f64| {
        let steps = f64::from((1 << HEIGHT_BITS) - 1);
        let rounded = if coarse { least + ((h - least) / range * steps).round() / steps * range } else { *h };
        Real::saturating_from_num(rounded)
    };
    (best.numbers.iter().map(number).collect(), best.heights.iter().map(height).collect())
}

/// The scene file.
fn scene(
    report: &Report,
    file: &Path,
    [row, column, side]: [usize; 3],
    (least, range): (f64, f64),
) -> String {
    let Model { family, cells, .. } = report.model;
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let list = |words: Vec<String>, a_line: usize| {
        let lines: Vec<String> =
            words.chunks(a_line).map(|line| format!("  {},\n", line.join(", "))).collect();
        format!("[\n{}]", lines.concat())
    };
    let mut text = String::new();
    let spline = |k: usize| report.splines[k].map_or_else(|| "-".to_owned(), |psnr| format!("{psnr:.2}"));
    let _ = write!(
        text,
        "kind = \"patch-surface\"\ntitle = \"{side} x {side} samples by {} parameters, {:.2} dB\"\n\
         # {name}, row {row}, column {column}: height 0 is {least}, 1 is {}\n\
         # B-splines of degree 1, 2 and 3 with as many coefficients: {}, {}, {} dB\n\
         model = \"{}\"\ncells = {cells}\nheight = 0.5\nnumbers = {}\nheights = {}\n\
         [camera]\neye = [-2.4, -3.3, 2.5]\nlook_at = [0.05, 0, 0.1]\nfield_of_view = 34\n\
         [light]\ndirection = [-3, 1, 2]\n",
        family.parameters(cells),
        report.psnr,
        least + range,
        spline(0),
        spline(1),
        spline(2),
        family.name(),
        list(report.numbers.iter().map(|n| format!("\"{}\"", exact(*n))).collect(), 4),
        list(report.heights.iter().map(|h| exact(*h)).collect(), 8),
    );
    text
}
