//! `attractor dimension`: the dimension of a scene, measured in one or two ways, and what theory says.
//!
//! Boxes (sets, paths, points; see `boxes`). Of attractors (`ifs`, `copier`) all cells of a grid of 4096 a
//! side that the set meets, no matter which points a chaos game would visit; of 2048, or most of them, where
//! the maps overlap; curves are refined until their pieces are shorter than half a cell; of Julia sets each
//! box is decided by itself (see `cover`). With `--boundary` only cells with an empty neighbour count: the
//! boundary of a set with an inside. What is systematic: boxes across the rim count in full, the more so the
//! larger they are, which lowers the slope: by 0.005 for the gasket, 0.015 for the carpet, 0.06 for the
//! pentigree, by 0.04 (Hilbert's curve) to 0.17 (Levy's) for sets of dimension 2. Inlets narrower than a cell
//! are closed, which the small boxes miss: boundaries measure 0.02 to 0.03 low. The standard error is that of
//! the fit and knows nothing of this; the drift, the slope of the smaller boxes less that of the larger ones,
//! does.
//!
//! Chords (random curves in the plane): `2^k` chords between points at equal parameters, over 64 curves of
//! the law; `D = log 2^k / log(1/L)` for chords of mean length `L`. This is how Carpenter defines the
//! dimension of a curve that becomes longer by a ratio whenever it is halved, as with a coast and a measuring
//! stick. For boxes theory has another value, `2 mean(r^D) = 1`, which is greater, 1.70 at a ratio of 1.3;
//! and they count less than that, 1.62 there: such a curve has double points, as Brownian paths do (A.
//! Dvoretzky, P. Erdos, S. Kakutani, "Double points of paths of Brownian motion in n-space", 1950), and a box
//! that is passed twice counts once. The smaller the boxes, the rarer that is: the drift is upwards.
//!
//! Graphs (`fif-curve`, `line-to-line`): counting boxes on graphs converges slowly, because the width of a
//! column adds to its height. Instead the oscillation of each column above its chord is added up, `V(w)`: a
//! variation method (B. Dubuc, J. F. Quiniou, C. Roques-Carmes, C. Tricot, S. W. Zucker, "Evaluating the
//! fractal dimension of profiles", Physical Review A 39, 1989) that leaves trends out. `V / w` boxes of side
//! `w` cover the graph, `D` is their slope, at least 1. The numbers of columns are powers of `sqrt 2`,
//! whatever the knots are; what lies near the last place is left out.

use std::io::Write as _;

use attractor::Error;
use attractor::escape::{JuliaSet, SimpleCase};
use attractor::ifs::{Ifs, MAX_MAPS, catalogue};
use attractor::num::Real;

use crate::boxes::{self, Grid};
use crate::cli::Dimension;
use crate::cover;
use crate::fail::{Fail, one_line};
use crate::fit::Fit;
use crate::scene::{self, Chords, Graph, Law, Subject, Trail};
use crate::table;
use crate::theory::{Theory, boundary_of, similarity};

/// Cells a side: the finest grid, and the coarsest that is still good enough.
const GRIDS: [i64; 4] = [4096, 2048, 1024, 512];
/// Ordinates taken in each column of a graph.
const ORDINATES: usize = 64;
/// Logarithm of the number of equal steps along a graph.
const STEPS: u32 = 20;
/// Halvings of a random curve: the finest chords, and the coarsest that are fitted.
const CHORDS: (u32, u32) = (14, 8);

/// What was measured in one way.
struct Measured {
    method: &'static str,
    /// The method in words.
    words: String,
    range: String,
    /// `(log(1 / size), log N)`, the largest sizes first.
    counts: Vec<(f64, f64)>,
    /// The least value that makes sense.
    least: f64,
    /// What the standard error does not know of.
    systematic: Option<&'static str>,
    theory: Option<Theory>,
}

/// Prints it.
pub(crate) fn run(args: &Dimension) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let fail = |fail: Fail| match fail {
        Fail::Message(reason) => Fail::new(format_args!("{}: kind = {}: {reason}", args.scene, scene.kind())),
        other => other,
    };
    let (ways, left_out) = ways(scene.subject().map_err(fail)?, args.boundary).map_err(fail)?;
    if args.csv {
        let points = |way: Measured| way.counts.into_iter().map(move |(x, y)| (way.method, x, y));
        let rows = ways.into_iter().flat_map(points);
        return table::csv(&["method", "log_inverse_size", "log_count"], rows);
    }
    let mut out = std::io::stdout().lock();
    writeln!(out, "scene      {} ({})", one_line(&scene.name), scene.kind())?;
    for way in &ways {
        let fit = Fit::of(&way.counts).ok_or_else(|| fail(Fail::new(TOO_FEW)))?;
        writeln!(out, "\nmethod     {}: {}", way.method, way.words)?;
        writeln!(out, "fit range  {}", way.range)?;
        writeln!(out, "dimension  {:.4} +- {:.4}", fit.slope.max(way.least), fit.error)?;
        if let Some(drift) = Fit::drift(&way.counts) {
            writeln!(out, "drift      {drift:+.4} from the larger half of the sizes to the smaller")?;
        }
        if let Some(systematic) = way.systematic {
            writeln!(out, "systematic {systematic}")?;
        }
        match &way.theory {
            Some(theory) => writeln!(out, "theory     {:.4} ({})", theory.value, theory.source)?,
            None => writeln!(out, "theory     none known for this scene")?,
        }
    }
    if let Some(Fail::Message(reason)) = left_out {
        writeln!(out, "\nmethod     boxes: left out: {reason}")?;
    }
    Ok(())
}

const POINT: &str = "it is a point, or nearly so";
const TOO_FEW: &str = "its graph is too smooth or too flat to be measured";

/// All that was measured, and why a second way is left out.
fn ways(subject: Subject<'_>, boundary: bool) -> Result<(Vec<Measured>, Option<Fail>), Fail> {
    match subject {
        Subject::Set(ifs) => Ok((vec![of_set(ifs, boundary)?], None)),
        Subject::Graph(_) if boundary => {
            Err(Fail::new("a graph has no boundary: --boundary is for sets and curves with an inside"))
        }
        Subject::Graph(graph) => Ok((vec![of_graph(&graph)?], None)),
        Subject::Julia(_) if boundary => {
            Err(Fail::new("a Julia set is a boundary: --boundary is for sets and curves with an inside"))
        }
        Subject::Julia(set) => Ok((vec![of_julia_set(&set)], None)),
        Subject::Trail(trail) => {
            let chords = trail.law.filter(|_| !boundary).map(by_chords).transpose()?;
            match (of_trail(trail, boundary), chords) {
                (Ok(boxes), chords) => Ok((chords.into_iter().chain([boxes]).collect(), None)),
                (Err(fail), Some(chords)) => Ok((vec![chords], Some(fail))),
                (Err(fail), None) => Err(fail),
            }
        }
    }
}

/// What large boxes do to a set, cells to a boundary, double points to a random curve.
const RIM: &str = "low where large boxes reach across a rim: 0.005 for the gasket, 0.015 for the carpet, 0.04 to 0.17 at dimension 2";
const INLETS: &str =
    "low where cells close inlets: 0.02 for Heighway's dragon and Gosper's island, 0.03 for the terdragon";
const SIEGEL: &str = "high where the set bounds a Siegel disc: boxes inside, near the edge, count as well";
const DOUBLE_POINTS: &str = "low where the curve has double points: a box that it passes twice counts once";

fn of_julia_set(set: &JuliaSet) -> Measured {
    let theory = set.simple_case().map(|case| match case {
        SimpleCase::UnitCircle => Theory::new(1.0, "the unit circle"),
        SimpleCase::Segment => Theory::new(1.0, "the segment from -2 to 2"),
    });
    Measured {
        method: "boxes",
        words: "boxes that meet the set".to_owned(),
        range: cover::RANGE.to_owned(),
        counts: cover::counts(set),
        least: 0.0,
        systematic: Some(SIEGEL),
        theory,
    }
}

/// Boxes on a grid.
fn by_boxes(
    grid: &Grid,
    boundary: bool,
    systematic: &'static str,
    theory: Option<Theory>,
) -> Result<Measured, Fail> {
    let counts = grid.counts(boundary).ok_or_else(|| Fail::new(POINT))?;
    let (method, words, systematic) = match boundary {
        true => ("boundary", "boxes that meet cells with an empty neighbour", INLETS),
        false => ("boxes", "boxes that meet the set", systematic),
    };
    let words = words.to_owned();
    let range = grid.range();
    Ok(Measured { method, words, range, counts, least: 0.0, systematic: Some(systematic), theory })
}

fn of_set(ifs: &Ifs<MAX_MAPS>, boundary: bool) -> Result<Measured, Fail> {
    const TOO_MANY: &str = "its maps overlap so much that its boundary cannot be told in reasonable time";
    let covered =
        GRIDS[..2].iter().find_map(|side| Grid::of_attractor(ifs, *side, if boundary { 0.5 } else { 0.9 }));
    let grid = match covered {
        Some(grid) => grid,
        // what orbits miss would count as boundary
        None if boundary => return Err(Fail::new(TOO_MANY)),
        None => Grid::of_orbits(ifs, GRIDS[1]).ok_or_else(|| Fail::new(POINT))?,
    };
    let named = || catalogue::ALL.iter().find(|attractor| attractor.maps == ifs.maps());
    let theory = match boundary {
        true => named().and_then(|attractor| boundary_of(attractor.name)),
        false => similarity(ifs.maps()),
    };
    by_boxes(&grid, boundary, RIM, theory)
}

fn of_trail(trail: Trail<'_>, boundary: bool) -> Result<Measured, Fail> {
    const TOO_MANY: &str = "it has too many pieces to be covered in reasonable time";
    // the extent, roughly first
    let walk = |length: f64| (trail.finer_than)(Real::saturating_from_num(length).max(Real::DELTA));
    let too_many = || Fail::new(TOO_MANY);
    let mut extent = 1.0;
    for _ in 0..2 {
        let bounds = boxes::bounds(walk(extent / 64.0).map_err(Fail::new)?).ok_or_else(too_many)?;
        extent = boxes::extent(&bounds);
    }
    let grid = |side: i64| -> Result<Option<Grid>, Error> {
        let length = extent / (2 * side) as f64;
        let Some(bounds) = boxes::bounds(walk(length)?) else { return Ok(None) };
        let mut grid = Grid::empty(&bounds, side);
        grid.follow(walk(length)?);
        Ok(Some(grid))
    };
    let mut found = Ok(None);
    for side in GRIDS {
        found = grid(side);
        if let Ok(Some(_)) = found {
            break;
        }
    }
    let grid = found.map_err(Fail::new)?.ok_or_else(too_many)?;
    let systematic = if trail.law.is_some() { DOUBLE_POINTS } else { RIM };
    by_boxes(&grid, boundary, systematic, if boundary { trail.boundary } else { trail.theory })
}

fn by_chords(law: &Law) -> Result<Measured, Fail> {
    let (finest, coarsest) = CHORDS;
    let curves = law.curves(finest)?;
    let Chords { order, theory } = law.chords();
    let counts = (coarsest..=finest).map(|k| {
        let stride = 1 << (finest - k);
        let chords = curves.iter().flat_map(|curve| {
            curve
                .iter()
                .step_by(stride)
                .zip(curve.iter().step_by(stride).skip(1))
                .map(|(p, q)| (q.0 - p.0).hypot(q.1 - p.1))
        });
        let sum: f64 = chords.map(|length| length.powi(order)).sum();
        let count = f64::from(1_u32 << k);
        let mean = (sum / (count * curves.len() as f64)).powf(1.0 / f64::from(order));
        (-mean.ln(), count.ln())
    });
    let mean = if order == 1 { "mean length" } else { "root mean square length" };
    Ok(Measured {
        method: "chords",
        words: format!("{mean} of 2^k chords between equal parameters"),
        range: format!("2^{coarsest} to 2^{finest} chords of each of {} curves of the law", curves.len()),
        counts: counts.collect(),
        least: 1.0,
        systematic: None,
        theory,
    })
}

fn of_graph(graph: &Graph<'_>) -> Result<Measured, Fail> {
    let functions = graph.ordinates(STEPS);
    let steps = functions.first().map_or(0, |f| f.len() - 1);
    let (mut counts, mut range) = (Vec::new(), Vec::new());
    for half_octave in 4.. {
        let columns = (f64::from(half_octave) / 2.0).exp2().round() as usize;
        if columns * ORDINATES > steps {
            break;
        }
        let sum: f64 = functions.iter().map(|f| variation(f, columns)).sum();
        let mean = sum / functions.len() as f64;
        // a mean oscillation near the last place of the format is noise
        if mean / (columns as f64) < 64.0 / 16_777_216.0 {
            break;
        }
        counts.push(((columns as f64).ln(), (mean * columns as f64).ln()));
        range.push(columns);
    }
    if counts.len() < 3 {
        return Err(Fail::new(TOO_FEW));
    }
    let of = match graph.count() {
        1 => String::new(),
        n => format!(" of each of {n} functions of the law"),
    };
    Ok(Measured {
        method: "variation",
        words: "oscillation of columns above their chords".to_owned(),
        range: format!(
            "{} to {} columns{of}, {} widths, {ORDINATES} ordinates a column",
            range.first().unwrap_or(&0),
            range.last().unwrap_or(&0),
            range.len()
        ),
        counts,
        least: 1.0,
        systematic: None,
        theory: Some(graph.dimension.clone()),
    })
}

/// The oscillations above the chord of all columns, added up.
fn variation(f: &[f64], columns: usize) -> f64 {
    let all = columns * ORDINATES;
    let at = |i: usize| f[(i * (f.len() - 1) + all / 2) / all];
    let mut first = at(0);
    let mut sum = 0.0;
    for column in 0..columns {
        let last = at((column + 1) * ORDINATES);
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for i in 1..ORDINATES {
            let chord = first + (last - first) * i as f64 / ORDINATES as f64;
            let above = at(column * ORDINATES + i) - chord;
            (low, high) = (low.min(above), high.max(above));
        }
        sum += high - low;
        first = last;
    }
    sum
}
