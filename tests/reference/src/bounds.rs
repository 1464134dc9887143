//! The cells of a profile: for every address of up to `depth` maps an interval, a rigorous range, the mean
//! and the mean slope.
//!
//! Let `j.w` be the cell whose address is map `j` followed by the address `w`, and `I_w` the interval of `w`.
//! Then
//! - the range follows from `B(j.w) = alpha_j B(w) + range of q_j over I_w`, starting at any rigorous root;
//!   parents become the hull of their children, and the finest level is computed again from its tightened
//!   parents, until nothing changes;
//! - `mean(j.w) = alpha_j mean(w) + mean of q_j over I_w`, and the rise `f(x1) - f(x0)` obeys the same
//!   recursion: both hold exactly, and neither subtracts values that are nearly equal.
//!
//! Source: CONTRIBUTING.md, "The picture of a height field, defined"; Cochran, Lewis and Hart, "The Normal of
//! a Fractal Surface", section 4, eq. 47-48 (which these bounds replace: min and max over both polynomials,
//! alpha may be negative).

use crate::double_double::DoubleDouble;
use crate::fif::Fif;

/// Ranges count as unchanged below this.
const UNCHANGED: f64 = 1e-12;
/// The most rounds at each depth.
const ROUNDS: usize = 400;
/// Outward rounding: far more than the rounding of one step of the recursion, relative to its terms.
const OUTWARD: f64 = 4.0 * f64::EPSILON;

/// What is known of the part of a function's graph that has one address.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// The left end of the interval.
    pub x0: f64,
    /// The right end of the interval; the next cell begins at the same number.
    pub x1: f64,
    /// No value over the interval is smaller.
    pub min: f64,
    /// No value over the interval is larger.
    pub max: f64,
    /// The mean of the function over the interval.
    pub mean: f64,
    /// The mean slope, `(f(x1) - f(x0)) / (x1 - x0)`.
    pub slope: f64,
}

/// The pyramid of cells of one profile.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// The number of maps: cell `i` of a level has the children `i maps .. (i + 1) maps` on the next.
    pub maps: usize,
    /// `levels[k]` has the `maps^k` cells of the addresses of length `k`, from left to right.
    pub levels: Vec<Vec<Cell>>,
}

/// A cell while the pyramid grows, in the normalised abscissa `u`.
struct Node {
    start: DoubleDouble,
    end: DoubleDouble,
    mean: DoubleDouble,
    rise: DoubleDouble,
    /// Of `q_j` over the interval of the rest of the address.
    q_range: (f64, f64),
    range: (f64, f64),
}

impl Bounds {
    /// The pyramid of `f` with `depth + 1` levels, the whole domain first.
    ///
    /// The ranges are the tightest that the recursion gives at this depth (up to 1e-12, or to 400 rounds at
    /// each level); they do not depend on the first root. Where the maps do not join, ends belong to the
    /// cell: its rise is that of one-sided limits.
    pub fn new(f: &Fif, depth: usize) -> Bounds {
        let mut levels = vec![vec![root(f)]];
        for _ in 0..depth {
            let finest = refine(f, &levels[levels.len() - 1]);
            levels.push(finest);
            tighten(f, &mut levels);
        }
        let (origin, length) = (DoubleDouble::from(f.knots_x[0]), f.offset(f.maps.len()));
        let cell = |node: &Node| Cell {
            x0: (origin + node.start * length).value(),
            x1: (origin + node.end * length).value(),
            min: node.range.0,
            max: node.range.1,
            mean: node.mean.value(),
            slope: (node.rise / ((node.end - node.start) * length)).value(),
        };
        let levels = levels.iter().map(|level| level.iter().map(cell).collect()).collect();
        Bounds { maps: f.maps.len(), levels }
    }

    /// The length of the addresses on the finest level.
    pub fn depth(&self) -> usize {
        self.levels.len() - 1
    }
}

/// The whole domain. `|f| <= max |q| / (1 - max |alpha|)` is rigorous, however coarse.
fn root(f: &Fif) -> Node {
    let largest =
        f.unit_q().iter().map(|q| q.range()).fold(0.0, |max: f64, (low, high)| max.max(-low).max(high));
    let bound = largest / (1.0 - f.max_scaling()) * (1.0 + OUTWARD);
    let (mut area, mut factor) = (DoubleDouble::ZERO, DoubleDouble::ONE);
    for (j, q) in f.unit_q().iter().enumerate() {
        let a = f.width(j) / f.offset(f.maps.len());
        area = area + a * q.mean();
        factor = factor - a * f.scaling(j);
    }
    Node {
        start: DoubleDouble::ZERO,
        end: DoubleDouble::ONE,
        mean: area / factor,
        rise: DoubleDouble::from(f.last) - DoubleDouble::from(f.first),
        q_range: (0.0, 0.0),
        range: (-bound, bound),
    }
}

/// The next level: for every map `j`, in order, the cells `j.w` of all `w` of the finest level so far.
fn refine(f: &Fif, rest: &[Node]) -> Vec<Node> {
    let length = f.offset(f.maps.len());
    let mut level = Vec::with_capacity(rest.len() * f.maps.len());
    for (j, q) in f.unit_q().iter().enumerate() {
        let (left, right, a) = (f.offset(j) / length, f.offset(j + 1) / length, f.width(j) / length);
        let image = |u: DoubleDouble| if u == DoubleDouble::ONE { right } else { left + a * u };
        for w in rest {
            let q = q.substitute(w.start, w.end - w.start);
            level.push(Node {
                start: image(w.start),
                end: image(w.end),
                mean: f.scaling(j) * w.mean + q.mean(),
                rise: f.scaling(j) * w.rise + q.rise(),
                q_range: q.range(),
                range: scaled(f.maps[j].vertical_scaling, w.range, q.range()),
            });
        }
    }
    level
}

/// Hulls upwards and the finest level again, until the ranges stand still; ends with the hulls.
fn tighten(f: &Fif, levels: &mut [Vec<Node>]) {
    hull_upwards(f.maps.len(), levels);
    for _ in 0..ROUNDS {
        let (above, finest) = levels.split_at_mut(levels.len() - 1);
        let parents = &above[above.len() - 1];
        let mut change: f64 = 0.0;
        for (i, node) in finest[0].iter_mut().enumerate() {
            let (j, w) = (i / parents.len(), i % parents.len());
            let range = scaled(f.maps[j].vertical_scaling, parents[w].range, node.q_range);
            // Both ranges are rigorous, so their intersection is, and rounding cannot undo progress.
            let range = (range.0.max(node.range.0), range.1.min(node.range.1));
            change = change.max(range.0 - node.range.0).max(node.range.1 - range.1);
            node.range = range;
        }
        hull_upwards(f.maps.len(), levels);
        if change <= UNCHANGED {
            break;
        }
    }
}

fn hull_upwards(maps: usize, levels: &mut [Vec<Node>]) {
    for k in (1..levels.len()).rev() {
        let (above, below) = levels.split_at_mut(k);
        for (parent, children) in above[k - 1].iter_mut().zip(below[0].chunks(maps)) {
            let hull =
                |hull: (f64, f64), child: &Node| (hull.0.min(child.range.0), hull.1.max(child.range.1));
            parent.range = children.iter().fold((f64::INFINITY, f64::NEG_INFINITY), hull);
        }
    }
}

/// `alpha range + q`, rounded outwards.
fn scaled(alpha: f64, range: (f64, f64), q: (f64, f64)) -> (f64, f64) {
    let (a, b) = (alpha * range.0, alpha * range.1);
    let slack = |y: f64, q: f64| OUTWARD * (y.abs() + q.abs());
    let (low, high) = (a.min(b), a.max(b));
    (low + q.0 - slack(low, q.0), high + q.1 + slack(high, q.1))
}

#[cfg(test)]
mod tests {
    use super::Bounds;
    use crate::fif::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    fn cubic_maps() -> Fif {
        let map = |vertical_scaling: f64, q: &[f64]| Map { vertical_scaling, q: q.to_vec() };
        Fif::from_polynomials(
            &[-1.0, 0.0, 0.5, 2.0],
            vec![
                map(0.4, &[1.0, -2.0, 0.5, 0.7]),
                map(-0.5, &[0.3, 1.0, 1.0, -0.6]),
                map(0.2, &[0.1, 0.0, -3.0, 1.0]),
            ],
        )
    }

    #[test]
    fn the_range_of_twice_takagis_function_is_found() {
        // Its maximum is 2 times 2/3, at dyadic depth only nearly reached.
        let bounds = Bounds::new(&Fif::interpolating(&KNOTS, &[0.5, 0.5]), 10);
        let root = bounds.levels[0][0];
        assert!(root.min <= 0.0 && root.min > -0.01, "{}", root.min);
        assert!(root.max >= 4.0 / 3.0 && root.max < 1.34, "{}", root.max);
        assert_eq!(bounds.levels[10].len(), 1024);
    }

    #[test]
    fn every_value_lies_in_all_its_cells() {
        let rough = Fif::interpolating(&KNOTS, &[0.85, -0.85]);
        for f in [&rough, &rough.integral(-0.5), &cubic_maps()] {
            let bounds = Bounds::new(f, 5);
            let (start, end) = (f.knots_x[0], f.knots_x[f.maps.len()]);
            let mut met = 0;
            for i in 0..=999 {
                let x = start + (end - start) * f64::from(i) / 999.0;
                let y = f.at(x);
                for cell in bounds.levels.iter().flatten().filter(|cell| cell.x0 < x && x < cell.x1) {
                    assert!(cell.min <= y && y <= cell.max, "{x} {y} {cell:?}");
                    met += 1;
                }
            }
            assert!(met > 4000);
        }
    }

    #[test]
    fn means_and_slopes_are_those_of_integrals_and_values() {
        for f in [
            Fif::interpolating(&KNOTS, &[0.85, -0.85]).integral(0.0),
            Fif::interpolating(&KNOTS, &[0.5, 0.5]),
        ] {
            let integral = f.integral(0.0);
            for cell in Bounds::new(&f, 6).levels.iter().flatten() {
                let width = cell.x1 - cell.x0;
                assert!((cell.slope - (f.at(cell.x1) - f.at(cell.x0)) / width).abs() < 1e-12);
                assert!((cell.mean - (integral.at(cell.x1) - integral.at(cell.x0)) / width).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn cells_tile_the_domain_and_parents_are_hulls() {
        let bounds = Bounds::new(&cubic_maps(), 5);
        for level in &bounds.levels {
            assert!(level.windows(2).all(|pair| pair[0].x1 == pair[1].x0));
            assert_eq!((level[0].x0, level[level.len() - 1].x1), (-1.0, 2.0));
        }
        for k in 0..bounds.depth() {
            for (i, parent) in bounds.levels[k].iter().enumerate() {
                let children = &bounds.levels[k + 1][3 * i..3 * i + 3];
                assert_eq!(parent.x0, children[0].x0);
                assert_eq!(parent.min, children.iter().map(|cell| cell.min).fold(f64::INFINITY, f64::min));
                assert_eq!(
                    parent.max,
                    children.iter().map(|cell| cell.max).fold(f64::NEG_INFINITY, f64::max)
                );
            }
        }
    }

    #[test]
    fn tightening_beats_the_naive_root_by_far() {
        // All dyadic values of level 20, from f(u/2) = 0.85 f(u) + u and f((u+1)/2) = -0.85 f(u) + 1 - u.
        let mut values = vec![0.0, 0.0];
        for k in 0..20 {
            let u = |i: usize| i as f64 / libm::exp2(f64::from(k));
            let left = values.iter().enumerate().map(|(i, y)| 0.85 * y + u(i));
            let right = values.iter().enumerate().skip(1).map(|(i, y)| -0.85 * y + 1.0 - u(i));
            values = left.chain(right).collect();
        }
        let (low, high) = values.iter().fold((0.0, 0.0), |(l, h): (f64, f64), &y| (l.min(y), h.max(y)));
        // Level 20 misses the extremes by up to 0.85^20 times the height, 0.11; the naive root is 6.67.
        let root = Bounds::new(&Fif::interpolating(&KNOTS, &[0.85, -0.85]), 12).levels[0][0];
        assert!(root.min <= low && root.min > low - 0.05, "{low} {}", root.min);
        assert!(root.max >= high && root.max < high + 0.05, "{high} {}", root.max);
    }
}
