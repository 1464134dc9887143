//! `attractor dimension`: the box-counting dimension of a scene, measured, and what theory says.
//!
//! Sets (`ifs`): all cells of a grid of up to 4096 a side that the attractor meets. Addresses are opened, depth first, until an image is smaller than
//! a cell; each leaves a point of the attractor. Boxes of 8 to 64 cells a side are counted, on eight positions of the grid for each size, and
//! `log N` is averaged over the positions: that removes most of the staircase. The line is fitted to the mean logarithms. Boxes below 8 cells feel the cells,
//! those above a 64th of the picture feel its rim. With `--boundary` only cells with an empty neighbour count: the boundary of a set with an inside.
//! The rim of a set with an inside lowers its own dimension: Heighway's dragon measures 1.86, not 2.
//!
//! Graphs (`fif-curve`): counting boxes on graphs converges slowly, because the width of a column adds to its height. Instead the oscillation of each column above
//! its chord is added up, `V(w)`: a variation method (B. Dubuc, J. F. Quiniou, C. Roques-Carmes, C. Tricot, S. W. Zucker, "Evaluating the fractal
//! dimension of profiles", Physical Review A 39, 1989) that leaves trends out. `V / w` boxes of side `w` cover the graph, so `D = 1 - slope(log V, log w)`, at least 1.
//! Columns are `1, N, N^2, ..` for `N <= 16` equal intervals, else powers of two; the two coarsest and what lies near the last place are left out.
//! With `N` equal intervals and affine maps the columns are images of one another, and heights above chords scale by `|alpha_j|` exactly: the measurement then tests
//! the kernel and the formula, and its error is no more than rounding. It is not blind: it takes `N` from the scene.
//!
//! The standard error is that of the fit and knows nothing of what the rim and the cells do to all sizes alike: the carpet measures 0.015 low, the dragon's boundary
//! 0.020 low, both by more than their standard errors.
//! The equal-interval formula is M. F. Barnsley, "Fractal functions and interpolation", 1986, theorem 4 (affine maps).

use std::io::Write as _;

use attractor::ifs::{Affine, Ifs, MAX_MAPS, catalogue};

use crate::cli::Dimension;
use crate::fail::Fail;
use crate::fit::Fit;
use crate::scene::{self, Graph, Subject};

/// The finest grid, and the coarsest that is still good enough.
const GRIDS: [i64; 4] = [4096, 2048, 1024, 512];
/// The most images that are opened for one grid.
const MOST_IMAGES: u64 = 1 << 26;
/// Sides of boxes in cells.
const BOXES: [i64; 13] = [8, 10, 11, 13, 16, 19, 23, 27, 32, 38, 45, 54, 64];
/// Positions of the grid of boxes for each size.
const POSITIONS: i64 = 8;
/// Ordinates taken in each column of a graph.
const ORDINATES: usize = 64;
/// The most columns of a graph.
const COLUMNS: usize = 1 << 14;

/// What was measured.
#[derive(Debug)]
struct Measured {
    method: &'static str,
    range: String,
    dimension: f64,
    error: f64,
    theory: Option<(f64, &'static str)>,
}

/// Prints it.
pub(crate) fn run(args: &Dimension) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let measured = match (scene.subject(), args.boundary) {
        (Some(Subject::Set(ifs)), boundary) => of_set(ifs, boundary),
        (Some(Subject::Graph(graph)), false) => of_graph(&graph),
        (Some(Subject::Graph(_)), true) => Err("a graph has no boundary: --boundary is for kind = ifs"),
        (None, _) => Err("no dimension is measured of this kind, only of ifs and fif-curve"),
    };
    let measured = measured
        .map_err(|reason| Fail::new(format_args!("{}: kind = {}: {reason}", args.scene, scene.kind())))?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "scene      {} ({})", scene.name, scene.kind())?;
    writeln!(out, "method     {}", measured.method)?;
    writeln!(out, "fit range  {}", measured.range)?;
    writeln!(out, "dimension  {:.4} +- {:.4}", measured.dimension, measured.error)?;
    match measured.theory {
        Some((value, source)) => writeln!(out, "theory     {value:.4} ({source})")?,
        None => writeln!(out, "theory     none known for this scene")?,
    }
    Ok(())
}

fn of_set(ifs: &Ifs<MAX_MAPS>, boundary: bool) -> Result<Measured, &'static str> {
    const TOO_MANY: &str =
        "its maps overlap or contract so little that it cannot be covered in reasonable time";
    let grid = GRIDS
        .into_iter()
        .find_map(|side| Grid::of(ifs, side, if boundary { 0.5 } else { 0.9 }))
        .ok_or(TOO_MANY)?;
    let cells = grid.cells(boundary);
    if cells.len() < 16 {
        return Err("it is a point, or nearly so");
    }
    let points: Vec<(f64, f64)> =
        BOXES.iter().map(|side| (-(*side as f64).ln(), mean_log_count(&cells, *side, grid.side))).collect();
    let fit = Fit::of(&points).ok_or(TOO_MANY)?;
    let range = format!(
        "boxes of 1/{} to 1/{} of the larger extent, {} sizes, {POSITIONS} positions each",
        grid.side / BOXES[BOXES.len() - 1],
        grid.side / BOXES[0],
        BOXES.len()
    );
    let heighway = ifs.maps() == catalogue::HEIGHWAY_DRAGON.maps;
    let theory = match boundary {
        true => heighway.then_some((1.523_627_086_2, "boundary of Heighway's dragon")),
        false => similarity(ifs.maps())
            .map(|d| (d, "similarity dimension: Moran's equation, unless images overlap")),
    };
    let method = if boundary { "boxes on the boundary" } else { "boxes" };
    Ok(Measured { method, range, dimension: fit.slope, error: fit.error, theory })
}

/// Which cells an attractor meets.
struct Grid {
    side: i64,
    met: Vec<u64>,
}

impl Grid {
    /// Opens addresses until an image is at most this share of a cell across: below half a cell no cell inside the set is missed. None when it takes too
    /// many images.
    fn of(ifs: &Ifs<MAX_MAPS>, side: i64, share: f64) -> Option<Self> {
        let float = |m: &Affine| {
            let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
            [a, b, c, d, m.e.to_num::<f64>(), m.f.to_num::<f64>()]
        };
        let maps: Vec<[f64; 6]> = ifs.maps().iter().map(float).collect();
        let bounds = ifs.bounds();
        let (x0, y0) = (bounds.min.x.to_num::<f64>(), bounds.min.y.to_num::<f64>());
        let (width, height) = (bounds.max.x.to_num::<f64>() - x0, bounds.max.y.to_num::<f64>() - y0);
        let cell = width.max(height) / side as f64;
        let small = share * cell / width.hypot(height).max(1e-9);
        let start = ifs.maps().first()?.fixed_point()?;
        let (px, py) = (start.x.to_num::<f64>(), start.y.to_num::<f64>());
        let mut grid = Self { side, met: vec![0; (side * side) as usize / 64] };
        let mut stack: Vec<[f64; 6]> = vec![[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]];
        let mut opened = 0_u64;
        while let Some([a, b, c, d, e, f]) = stack.pop() {
            let stretch = ((a + d).hypot(b - c) + (a - d).hypot(b + c)) / 2.0;
            if stretch <= small {
                let column = (((a * px + b * py + e) - x0) / cell).floor() as i64;
                let row = (((c * px + d * py + f) - y0) / cell).floor() as i64;
                let index = row.clamp(0, side - 1) * side + column.clamp(0, side - 1);
                if let Some(word) = grid.met.get_mut(index as usize / 64) {
                    *word |= 1 << (index % 64);
                }
                continue;
            }
            opened += maps.len() as u64;
            if opened > MOST_IMAGES {
                return None;
            }
            stack.extend(maps.iter().map(|[p, q, r, s, t, u]| {
                [
                    a * p + b * r,
                    a * q + b * s,
                    c * p + d * r,
                    c * q + d * s,
                    a * t + b * u + e,
                    c * t + d * u + f,
                ]
            }));
        }
        Some(grid)
    }

    fn is_met(&self, x: i64, y: i64) -> bool {
        let inside = (0..self.side).contains(&x) && (0..self.side).contains(&y);
        let index = (y * self.side + x) as usize;
        inside && self.met.get(index / 64).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// The cells that are met; for a boundary those with an empty neighbour.
    fn cells(&self, boundary: bool) -> Vec<(i64, i64)> {
        let on_the_rim = |x: i64, y: i64| {
            [(-1, 0), (1, 0), (0, -1), (0, 1)].iter().any(|(i, j)| !self.is_met(x + i, y + j))
        };
        (0..self.side)
            .flat_map(|y| (0..self.side).map(move |x| (x, y)))
            .filter(|&(x, y)| self.is_met(x, y) && (!boundary || on_the_rim(x, y)))
            .collect()
    }
}

/// The mean logarithm of the number of boxes, over positions spread along both axes.
fn mean_log_count(cells: &[(i64, i64)], side: i64, grid: i64) -> f64 {
    let across = grid / side + 2;
    let mut met = vec![0_i64; (across * across) as usize];
    let mut sum = 0.0;
    for position in 1..=POSITIONS {
        // the second shift by another odd multiple: no two positions share a row
        let (dx, dy) = (position * side / POSITIONS % side, position * 3 * side / POSITIONS % side);
        let mut count = 0_u64;
        for (x, y) in cells {
            if let Some(seen) = met.get_mut(((y + dy) / side * across + (x + dx) / side) as usize)
                && *seen != position
            {
                *seen = position;
                count += 1;
            }
        }
        sum += (count.max(1) as f64).ln();
    }
    sum / POSITIONS as f64
}

/// The solution of Moran's equation `sum r_j^D = 1` when all maps are similarities.
fn similarity(maps: &[Affine]) -> Option<f64> {
    let ratio = |m: &Affine| {
        let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
        let near = |u: f64, v: f64| (u - v).abs() < 1e-6;
        let is_similarity = (near(a, d) && near(b, -c)) || (near(a, -d) && near(b, c));
        let ratio = a.hypot(c);
        (is_similarity && ratio > 1e-6).then_some(ratio)
    };
    let ratios: Vec<f64> = maps.iter().map(ratio).collect::<Option<_>>()?;
    let (mut low, mut high) = (0.0, 64.0);
    for _ in 0..80 {
        let middle = (low + high) / 2.0;
        if ratios.iter().map(|r| r.powf(middle)).sum::<f64>() > 1.0 { low = middle } else { high = middle }
    }
    // more than 2 is no dimension of a set in the plane
    (ratios.len() > 1).then_some(low.min(2.0))
}

fn of_graph(graph: &Graph<'_>) -> Result<Measured, &'static str> {
    let base = match graph.equal_intervals {
        Some(n) if (2..=16).contains(&n) => n,
        _ => 2,
    };
    let (mut points, mut columns, mut range) = (Vec::new(), base * base, Vec::new());
    while columns <= COLUMNS {
        let variation = variation(graph, columns);
        // a mean oscillation near the last place of the format is noise
        if variation / (columns as f64) < 64.0 / 16_777_216.0 {
            break;
        }
        points.push(((columns as f64).ln(), variation.ln()));
        range.push(columns);
        columns *= base;
    }
    let fit = Fit::of(&points).ok_or("its graph is too smooth or too flat to be measured")?;
    let range = format!(
        "{} to {} columns, {} widths, {ORDINATES} ordinates a column",
        range.first().unwrap_or(&0),
        range.last().unwrap_or(&0),
        range.len()
    );
    let theory = graph.scalings.as_ref().zip(graph.equal_intervals).map(|(scalings, n)| {
        let sum: f64 = scalings.iter().map(|a| a.abs()).sum();
        let d = if sum > 1.0 { 1.0 + sum.ln() / (n as f64).ln() } else { 1.0 };
        (d, "1 + log(sum |alpha_j|) / log N where that is above 1, unless the knots lie on a line")
    });
    // log V against log(columns): the number of boxes is V times the columns
    let dimension = (1.0 + fit.slope).clamp(1.0, 2.0);
    Ok(Measured {
        method: "variation: oscillation of columns above their chords",
        range,
        dimension,
        error: fit.error,
        theory,
    })
}

/// The oscillations above the chord of all columns, added up.
fn variation(graph: &Graph<'_>, columns: usize) -> f64 {
    let f = |i: usize| graph.at(i as u64, (columns * ORDINATES) as u64);
    let mut first = f(0);
    let mut sum = 0.0;
    for column in 0..columns {
        let last = f((column + 1) * ORDINATES);
        let (mut low, mut high) = (0.0_f64, 0.0_f64);
        for i in 1..ORDINATES {
            let chord = first + (last - first) * i as f64 / ORDINATES as f64;
            let above = f(column * ORDINATES + i) - chord;
            (low, high) = (low.min(above), high.max(above));
        }
        sum += high - low;
        first = last;
    }
    sum
}
