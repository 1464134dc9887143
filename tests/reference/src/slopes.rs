//! How much of a height field `F(x) G(y)` leans which way: bounds from both sides of the share of each square
//! of slopes `(f G, F g)`, `f = F'` and `g = G'`.
//!
//! Branch and bound over boxes of slopes. Both domains are cut into cells; over a pair of cells `f` and `g`
//! are independent, and `F` and `G` nearly constant: a square of slopes is a box of `f` and `g`, known to
//! within the ranges of `F` and `G`, whose share is the product of two distribution functions. That of `f`
//! over a cell is the one of `A (f + l u) + C` over the whole, `u` from 0 to 1 along it, because `f(L_j u) =
//! a_j f(u) + c_j + d_j u`: a function `f + l u` is over each part such a function again, with `l' = (d_j +
//! l w_j) / a_j`, which stays bounded where `|a_j| > w_j`, the width of the part. Its distribution lies
//! between two tables over `l` and the value, which begin as what the range of `f` says and are replaced by
//! the means of what they say of the parts of parts: what is not known shrinks by `|a_j|` each time. Every
//! rounding goes outwards. Beside the bounds stands an estimate, by the middles of all that is known, which
//! is off by the square of what is not. Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface",
//! section 6.1; J. Hutchinson, "Fractals and self similarity", 1981, section 4.4 (the measure as a fixed
//! point).

use crate::fif::Fif;
use crate::surface::Factor;

/// How finely a distribution is bounded.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Cells of each domain: `2^depth`, where there are two maps.
    pub depth: u32,
    /// Steps of `l` and of values in the tables.
    pub steps: [f64; 2],
    /// Of the values of `f` over a cell.
    pub step: f64,
}

/// Levels of parts that one round looks into.
const LEVELS: u32 = 6;

/// `A (f + l u) + C` over the whole.
#[derive(Debug, Clone, Copy)]
struct State {
    a: f64,
    d: f64,
    c: f64,
    /// The width of the cell.
    width: f64,
}

impl State {
    const WHOLE: Self = Self { a: 1.0, d: 0.0, c: 0.0, width: 1.0 };

    fn of(l: f64) -> Self {
        Self { d: l, ..Self::WHOLE }
    }
}

/// The affine maps of a function, in the unit abscissa.
struct Maps {
    /// Scaling, constant, slope, where the part begins and how wide it is.
    maps: Vec<[f64; 5]>,
    /// The range of the function.
    range: [f64; 2],
}

impl Maps {
    fn new(fif: &Fif) -> Self {
        let knots = &fif.knots_x;
        let length = knots[knots.len() - 1] - knots[0];
        let map = |(j, scaling, c, d)| {
            let (x, w): (f64, f64) = ((knots[j] - knots[0]) / length, (knots[j + 1] - knots[j]) / length);
            [scaling, c, d, x, w]
        };
        let maps: Vec<[f64; 5]> = fif.affine().into_iter().map(map).collect();
        let steepest = maps.iter().fold(0.0_f64, |most, map| most.max(map[0].abs()));
        let largest =
            maps.iter().fold(0.0_f64, |most, map| most.max(map[1].abs()).max((map[1] + map[2]).abs()));
        let crude = largest / (1.0 - steepest);
        let mut this = Self { maps, range: [-crude, crude] };
        // the range of the cells of a fine level, a few times over
        for _ in 0..8 {
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            this.each(State::WHOLE, 10, &mut |part| {
                let [low, high] = this.reach(&part);
                range = [range[0].min(low), range[1].max(high)];
            });
            this.range = range;
        }
        this
    }

    /// The range of a state.
    fn reach(&self, part: &State) -> [f64; 2] {
        let [low, high] = self.range.map(|f| part.a * f);
        let (low, high) = (low.min(high), low.max(high));
        [part.c + low + part.d.min(0.0), part.c + high + part.d.max(0.0)]
    }

    /// All parts so many levels down.
    fn each(&self, part: State, levels: u32, then: &mut impl FnMut(State)) {
        if levels == 0 {
            return then(part);
        }
        for [a, c, d, x, w] in &self.maps {
            let next = State {
                a: part.a * a,
                d: part.a * d + part.d * w,
                c: part.c + part.a * c + part.d * x,
                width: part.width * w,
            };
            self.each(next, levels - 1, then);
        }
    }
}

/// Bounds of the distribution function of `f + l u`.
struct Tables {
    maps: Maps,
    /// The first `l`, and how far apart they and the values are; no `l` where the tables would not end.
    first: f64,
    steps: [f64; 2],
    /// For each `l` the first value and the bounds there and on.
    rows: Vec<(f64, Vec<[f64; 2]>)>,
}

impl Tables {
    fn new(fif: &Fif, steps: [f64; 2]) -> Self {
        let maps = Maps::new(fif);
        // all `l` that come from 0
        let mut range = [0.0_f64; 2];
        let bounded = maps.maps.iter().all(|map| map[0].abs() > 1.1 * map[4]);
        for _ in 0..if bounded { 400 } else { 0 } {
            for [a, _, d, _, w] in &maps.maps {
                for l in range {
                    let l = (d + l * w) / a;
                    range = [range[0].min(l), range[1].max(l)];
                }
            }
        }
        let mut this = Self { maps, first: range[0] - steps[0], steps, rows: Vec::new() };
        if !bounded {
            return this;
        }
        let count = ((range[1] - range[0]) / steps[0]).ceil() as usize + 3;
        let contraction = this.maps.maps.iter().fold(0.0_f64, |most, map| most.max(map[0].abs()));
        let mut unknown = this.maps.range[1] - this.maps.range[0] + range[1] - range[0];
        while unknown > steps[1] / 4.0 {
            let rows = (0..count).map(|k| this.row(k));
            this.rows = rows.collect();
            unknown *= contraction.powi(LEVELS as i32);
        }
        this
    }

    /// The bounds for one `l` from those of the parts.
    fn row(&self, k: usize) -> (f64, Vec<[f64; 2]>) {
        let whole = State::of(self.first + k as f64 * self.steps[0]);
        let [low, high] = self.maps.reach(&whole);
        let step = self.steps[1];
        let count = ((high - low) / step).ceil() as usize + 2;
        (low - step / 2.0, self.bounds(whole, LEVELS, low - step / 2.0, step, count))
    }

    /// The bounds of a state at evenly spaced values, by its parts.
    fn bounds(&self, whole: State, levels: u32, from: f64, step: f64, count: usize) -> Vec<[f64; 2]> {
        let (mut all, mut full) = (vec![[0.0; 2]; count], vec![0.0; count]);
        self.maps.each(whole, levels, &mut |part| {
            let share = part.width / whole.width;
            let [low, high] = self.maps.reach(&part).map(|value| (value - from) / step);
            let end = (libm::floor(high + 1.0).max(0.0) as usize).min(count);
            let first = (libm::ceil(low).max(0.0) as usize).min(end);
            for (k, sum) in (first..end).zip(&mut all[first..end]) {
                let [below, above] = self.at(&part, from + k as f64 * step);
                *sum = [sum[0] + share * below, sum[1] + share * above];
            }
            // from there on all of it
            if let Some(whole) = full.get_mut(end) {
                *whole += share;
            }
        });
        let mut sum = 0.0;
        for (pair, whole) in all.iter_mut().zip(full) {
            sum += whole;
            *pair = pair.map(|bound| bound + sum);
        }
        all
    }

    /// The bounds of one state at a value within its reach.
    fn at(&self, part: &State, value: f64) -> [f64; 2] {
        if self.rows.is_empty() {
            return [0.0, 1.0];
        }
        let (t, l) = ((value - part.c) / part.a, part.d / part.a);
        let k = ((l - self.first) / self.steps[0]).round() as usize;
        let off = l - (self.first + k as f64 * self.steps[0]);
        let (from, row) = &self.rows[k];
        let place = |t: f64| (t - from) / self.steps[1];
        let (low, high) = (place(t - off.max(0.0)).floor(), place(t - off.min(0.0)).ceil());
        let low = if low < 0.0 { 0.0 } else { row.get(low as usize).map_or(1.0, |pair| pair[0]) };
        let high = if high < 0.0 { 0.0 } else { row.get(high as usize).map_or(1.0, |pair| pair[1]) };
        if part.a > 0.0 { [low, high] } else { [1.0 - high, 1.0 - low] }
    }
}

/// A cell of one axis: the range of the value, and the distribution of the slope.
struct Cell {
    share: f64,
    value: [f64; 2],
    from: f64,
    slope: Vec<[f64; 2]>,
}

fn cells(factor: &Factor, effort: &Effort) -> Vec<Cell> {
    let tables = Tables::new(&factor.slope, effort.steps);
    let knots = &factor.slope.knots_x;
    let (x0, length) = (knots[0], knots[knots.len() - 1] - knots[0]);
    let (mut all, mut at) = (Vec::new(), 0.0);
    tables.maps.each(State::WHOLE, effort.depth, &mut |part| {
        let [low, high] = tables.maps.reach(&part);
        let count = ((high - low) / effort.step).ceil() as usize + 2;
        let from = low - effort.step / 2.0;
        let slope = tables.bounds(part, LEVELS, from, effort.step, count);
        // the value changes by what the slope may be
        let ends = [at, (at + part.width).min(1.0)].map(|u| factor.value.at(x0 + length * u));
        let most = low.abs().max(high.abs()) * length * part.width / 2.0;
        let middle = (ends[0] + ends[1]) / 2.0;
        at += part.width;
        all.push(Cell { share: part.width, value: [middle - most, middle + most], from, slope });
    });
    all
}

impl Cell {
    /// The share with slopes below `limit / G`, by the middle of `G` and of the bounds.
    fn near(&self, limit: f64, [least, most]: [f64; 2], step: f64) -> f64 {
        let middle = (least + most) / 2.0;
        let place = ((limit / middle - self.from) / step).clamp(0.0, (self.slope.len() - 1) as f64);
        let (k, part) = (place as usize, place - libm::floor(place));
        let mean = |k: usize| self.slope.get(k).map_or(1.0, |pair| (pair[0] + pair[1]) / 2.0);
        mean(k) * (1.0 - part) + mean(k + 1) * part
    }

    /// Bounds of the share with slopes below `limit / G`, whatever `G` of a range.
    fn below(&self, limit: f64, [least, most]: [f64; 2], step: f64) -> [f64; 2] {
        let (inner, outer) = if least <= 0.0 {
            // next to nothing: no more is said
            (f64::NEG_INFINITY, f64::INFINITY)
        } else if limit >= 0.0 {
            (limit / most, limit / least)
        } else {
            (limit / least, limit / most)
        };
        let place = |s: f64| (s - self.from) / step;
        let (low, high) = (place(inner).floor(), place(outer).ceil());
        let low = if low < 0.0 { 0.0 } else { self.slope.get(low as usize).map_or(1.0, |pair| pair[0]) };
        let high = if high < 0.0 { 0.0 } else { self.slope.get(high as usize).map_or(1.0, |pair| pair[1]) };
        [low, high]
    }
}

/// What is known of the slopes of `F(x) G(y)`, positive inside: for each of `side x side` squares from
/// `-reach` to `reach` around `centre`, a row along `p` for each `q`, the least and the largest share of the
/// surface, and an estimate; the outermost squares count all beyond them.
pub fn slopes(
    (x, y): (&Factor, &Factor),
    centre: [f64; 2],
    (side, reach): (usize, f64),
    effort: &Effort,
) -> Vec<[f64; 3]> {
    let (xs, ys) = (cells(x, effort), cells(y, effort));
    let mut sums = vec![[0.0; 3]; side * side];
    let limits = |centre: f64| -> Vec<f64> {
        (1..side).map(|k| centre + reach * (2.0 * k as f64 / side as f64 - 1.0)).collect()
    };
    let limits = centre.map(limits);
    // the squares that a pair may reach, with their bounds
    let shares = |cell: &Cell, value: [f64; 2], limits: &[f64], shares: &mut Vec<(usize, [f64; 3])>| {
        shares.clear();
        let (mut before, mut nearly) = ([0.0; 2], 0.0);
        for k in 0..side {
            let below = limits.get(k).map_or([1.0; 2], |limit| cell.below(*limit, value, effort.step));
            let most = (below[1] - before[0]).clamp(0.0, 1.0);
            let near = limits.get(k).map_or(1.0, |limit| cell.near(*limit, value, effort.step));
            if most > 0.0 {
                shares.push((k, [(below[0] - before[1]).max(0.0), most, near - nearly]));
            }
            if below[0] >= 1.0 {
                break;
            }
            (before, nearly) = (below, near);
        }
    };
    let (mut along_p, mut along_q) = (Vec::new(), Vec::new());
    for a in &xs {
        for b in &ys {
            shares(a, b.value, &limits[0], &mut along_p);
            shares(b, a.value, &limits[1], &mut along_q);
            let share = a.share * b.share;
            for (j, q) in &along_q {
                for (i, p) in &along_p {
                    let sum = &mut sums[j * side + i];
                    sum.iter_mut().zip(p.iter().zip(q)).for_each(|(sum, (p, q))| *sum += share * p * q);
                }
            }
        }
    }
    sums
}
