//! The highlight of tiny mirrors that lean as a fractal surface does: `F D G / (4 n . v)` with a table for
//! `D`.
//!
//! The mirrors' slopes `(p, q)` against the surface, `p = -h_T / h_n`, `q = -h_B / h_n` along the grain `T`
//! and across it `B = n x T`, have a density `P` of integral 1, so that `D = pi P / (n . h)^4` (without `1 /
//! pi` in diffuse light, as in [`super::torrance_sparrow`], which has `F` and `G`). The table holds weights
//! of `side x side` equal squares of slopes from `-reach` to `reach`; between their middles `P` is bilinear.
//! It is the same for opposite slopes: grooves have two sides, and no light is made.
//!
//! A table is a list of words: version, side, reach in 256ths, then the weights, row by row along `p`.
//! Sources: K. E. Torrance, E. M. Sparrow, 1967; Cochran, Lewis, Hart, section 6.1, "a normal distribution of
//! the fractal surface".

use super::super::environment::between;
use super::super::power::times;
use super::specular::{Sight, Specular};
use super::torrance_sparrow::seen;
use crate::Error;
use crate::num::{Lumen, Real, Unit, Vec3, Wide, reciprocal};

/// Words before the weights.
const HEADER: usize = 3;
/// The version that is read and written.
const VERSION: u16 = 1;
/// `pi`, 30 fractional bits.
const PI: u64 = 3_373_259_426;

/// A highlight by a table of slopes and a reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tabulated<'a> {
    weights: &'a [u16],
    side: u32,
    /// Squares per slope, 16 fractional bits.
    per_slope: u32,
    /// `pi` over the area of a square and the sum of the weights: mantissa and shift.
    scale: (u32, u32),
    reflectance: Unit,
}

impl Tabulated<'static> {
    /// How many words a table of `side x side` squares has.
    pub const fn words(side: u16) -> usize {
        side as usize * side as usize + HEADER
    }

    /// The most squares along a side.
    pub const MOST: u16 = 128;
}

/// How far slopes reach, 256ths: an eighth to 8.
fn checked_reach(reach: u16) -> Result<(), Error> {
    let wide = Wide::from_bits(i64::from(reach) << 40);
    between("reach of a table of slopes", None, wide, Wide::ONE >> 3, Wide::ONE << 3)
}

fn checked_side(side: u16) -> Result<(), Error> {
    let wide = |side: u16| Wide::from_bits(i64::from(side.min(0x7fff)) << 48);
    between("side of a table of slopes", None, wide(side), wide(2), wide(Tabulated::MOST))
}

impl<'a> Tabulated<'a> {
    /// The highlight of mirrors that lean as the table says and reflect `reflectance` of what meets them at
    /// right angles.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a table of another version, or one that has not as much of every slope as
    /// of its opposite; [`Error::LengthMismatch`] for one of the wrong size; [`Error::OutOfRange`] for a side
    /// outside 2 to 128, a reach outside 1/8 to 8, weights that are all 0, or a reflectance outside `[0, 1]`.
    pub fn new(table: &'a [u16], reflectance: Unit) -> Result<Self, Error> {
        between("reflectance", None, reflectance.into(), Wide::ZERO, Wide::ONE)?;
        let what = "words of a table of slopes";
        let Some(([version, side, reach], weights)) = table.split_first_chunk() else {
            return Err(Error::LengthMismatch { what, given: table.len(), expected: HEADER });
        };
        if *version != VERSION {
            return Err(Error::Unsupported { what: "version of a table of slopes", allowed: "version 1" });
        }
        checked_side(*side)?;
        checked_reach(*reach)?;
        let expected = Tabulated::words(*side);
        if table.len() != expected {
            return Err(Error::LengthMismatch { what, given: table.len(), expected });
        }
        if weights.iter().ne(weights.iter().rev()) {
            let allowed = "those with as much of every slope as of its opposite";
            return Err(Error::Unsupported { what: "table of slopes", allowed });
        }
        // at most 2^14 weights
        let sum = weights.iter().map(|w| u64::from(*w)).sum::<u64>();
        between("sum of a table of slopes", None, Wide::from_bits(sum as i64), Wide::DELTA, Wide::MAX)?;
        let (side, reach) = (u32::from(*side), u64::from(*reach));
        // pi side^2 / (4 reach^2 sum): both normal with 32 bits
        let (over, under) = (PI * u64::from(side * side), 4 * reach * reach * sum);
        let (up, down) = (over.leading_zeros(), under.leading_zeros());
        let over = (over << up >> 32) as u32;
        let (mantissa, _) = reciprocal((under << down >> 32) as u32);
        // 2^(down - up) over mantissa / 2^62, with 30 fractional bits of pi and 16 of the square of the reach
        let scale = ((u64::from(over) * u64::from(mantissa)) >> 32) as u32;
        let shift = (30 + 14 + up).saturating_sub(down);
        let per_slope = (side << 23).checked_div(reach as u32).unwrap_or(0);
        Ok(Self { weights, side, per_slope, scale: (scale, shift), reflectance })
    }

    /// Writes a table of the slopes `(f G, F g)` of a height field `F(x) G(y)`, from points `(f, F)` along x
    /// and `(g, G)` along y ([`crate::fif::Sums::points`]), each pair with its opposite around their mean;
    /// slopes beyond `reach` (256ths) count where the table ends. `counts` is lent for the while, one a
    /// square.
    ///
    /// Cost: a step for each pair.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] as in [`Tabulated::new`]; [`Error::BufferLength`] for memory that is too short;
    /// [`Error::TooFew`] without points.
    pub fn tabulate<'b>(
        (x, y): (&[[Real; 2]], &[[Real; 2]]),
        (side, reach): (u16, u16),
        counts: &mut [u32],
        table: &'b mut [u16],
    ) -> Result<&'b [u16], Error> {
        checked_side(side)?;
        checked_reach(reach)?;
        let (given, needed) = (table.len(), Tabulated::words(side));
        let what = "words of a table of slopes";
        let table = table.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        let (given, needed) = (counts.len(), needed - HEADER);
        let what = "counts of a table of slopes";
        let counts = counts.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        let (what, given) = ("points of a surface", x.len().min(y.len()));
        // 16 fractional bits, so that means of 2^20 pairs have room
        let number = i64::try_from(given).ok().filter(|n| *n > 0);
        let _ = number.ok_or(Error::TooFew { what, given, at_least: 1 })?;
        let slope = |a: Real, b: Real| (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 24;
        let mean = |points: &[[Real; 2]], k: usize| {
            let sum = points.iter().filter_map(|p| p.get(k)).map(|c| i64::from(c.to_bits())).sum::<i64>();
            Real::from_bits(sum.checked_div(points.len() as i64).unwrap_or(0) as i32)
        };
        let means = [slope(mean(x, 0), mean(y, 1)), slope(mean(x, 1), mean(y, 0))];
        counts.fill(0);
        let (n, most) = (i64::from(side), i64::from(side) - 1);
        let per_slope = i64::from((u32::from(side) << 23).checked_div(reach.into()).unwrap_or(0));
        for [f, big_f] in x {
            for [g, big_g] in y {
                let (p, q) = (slope(*f, *big_g) - means[0], slope(*big_f, *g) - means[1]);
                // in squares, 16 fractional bits, from the middle: at most 2^(33 + 13 - 24 + 16)
                let place = |s: i64| (((s.clamp(-(1 << 33), 1 << 33) * per_slope) >> 24) + (n << 15)) >> 16;
                let square = |p: i64, q: i64| (q.clamp(0, most) * n + p.clamp(0, most)) as usize;
                let here = square(place(p), place(q));
                for k in [here, (n * n - 1) as usize - here] {
                    if let Some(count) = counts.get_mut(k) {
                        *count = count.saturating_add(1);
                    }
                }
            }
        }
        let highest = counts.iter().copied().max().unwrap_or(1).max(1);
        let Some((header, weights)) = table.split_first_chunk_mut::<HEADER>() else { return Ok(table) };
        *header = [VERSION, side, reach];
        for (weight, count) in weights.iter_mut().zip(counts) {
            let share = (u64::from(*count) * 0xffff + u64::from(highest / 2)).checked_div(highest.into());
            *weight = share.unwrap_or(0) as u16;
        }
        Ok(table)
    }

    /// `D` of the direction `half`, 20 fractional bits.
    fn facing(&self, view: &Sight, half: Vec3<Unit>) -> u64 {
        let cos = view.normal.dot(half);
        let square = times(cos, cos);
        // slopes beyond 5.6: beyond most tables, and next to nothing of the others
        if cos <= Unit::ZERO || square.to_bits() < 1 << 25 {
            return 0;
        }
        let (mantissa, shift) = reciprocal(cos.to_bits().unsigned_abs());
        let across = |a: Unit, b: Unit, c: Unit, d: Unit| times(a, b).saturating_sub(times(c, d));
        let (n, t) = (view.normal, view.tangent);
        let binormal =
            Vec3::new(across(n.y, t.z, n.z, t.y), across(n.z, t.x, n.x, t.z), across(n.x, t.y, n.y, t.x));
        // in squares from the middle of the first, 15 fractional bits
        let place = |axis: Vec3<Unit>| {
            let slope = (-i64::from(axis.dot(half).to_bits()) * i64::from(mantissa)) >> ((shift - 24) & 63);
            ((slope * i64::from(self.per_slope)) >> 25) + (i64::from(self.side) << 14) - (1 << 14)
        };
        let (p, q) = (place(t), place(binormal));
        let weight = |i: i64, j: i64| {
            let inside = |k: i64| (0..i64::from(self.side)).contains(&k);
            let index = (inside(i) && inside(j)).then_some(j * i64::from(self.side) + i);
            index.and_then(|k| self.weights.get(k as usize)).map_or(0, |w| u64::from(*w))
        };
        let ((i, j), (u, v)) = ((p >> 15, q >> 15), ((p & 0x7fff) as u64, (q & 0x7fff) as u64));
        let row = |j: i64| weight(i, j) * (0x8000 - u) + weight(i + 1, j) * u;
        // 30 fractional bits, then as many fewer as a word asks
        let mean = (row(j) * (0x8000 - v) + row(j + 1) * v) >> 15;
        let (scale, down) = self.scale;
        let density = (mean * u64::from(scale)) >> (down.saturating_sub(20 - 15) & 63).min(63);
        // over the fourth power of the cosine
        let (mantissa, shift) = reciprocal(square.to_bits().unsigned_abs());
        let over = |d: u64| (d.min(u64::from(u32::MAX)) * u64::from(mantissa)) >> ((shift - 30) & 63);
        over(over(density))
    }
}

impl Specular for Tabulated<'_> {
    fn is_charted(&self) -> bool {
        true
    }

    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen {
        let half = view.half(towards);
        seen(view, towards, half, self.reflectance, self.facing(view, half))
    }
}

#[cfg(test)]
mod tests {
    use super::super::specular::tests::{dot, floats, half_of, views};
    use super::*;
    use std::vec::Vec;

    /// A lopsided hill of slopes, alike for opposite ones.
    fn table(side: u16, reach: f64) -> Vec<u16> {
        let mut table = std::vec![VERSION, side, (reach * 256.0) as u16];
        let at = |k: u16| (f64::from(k) + 0.5) / f64::from(side) * 2.0 - 1.0;
        for (j, i) in (0..side).flat_map(|j| (0..side).map(move |i| (j, i))) {
            let (p, q) = (at(i), at(j));
            let hill = |p: f64, q: f64| {
                (-(9.0 * p * p + 5.0 * q * q + 6.0 * p * q)).exp() * (1.0 + (7.0 * (p * q)).cos())
            };
            table.push((hill(p, q) * 30000.0) as u16);
        }
        table
    }

    fn exact(table: &[u16], view: &Sight, towards: Vec3<Unit>, f: f64) -> f64 {
        let (n, l, h) = (floats(view.normal), floats(towards), half_of(view, towards));
        let v = floats(view.direction).map(|c| -c);
        let t = floats(view.tangent);
        let b = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
        let (a, nv, nl, vh) = (dot(n, h), dot(n, v), dot(n, l), dot(v, h));
        let (side, reach) = (f64::from(table[1]), f64::from(table[2]) / 256.0);
        let place = |s: f64| (s + reach) * side / (2.0 * reach) - 0.5;
        let (p, q) = (place(-dot(t, h) / a), place(-dot(b, h) / a));
        let weight = |i: f64, j: f64| {
            let inside = i >= 0.0 && j >= 0.0 && i < side && j < side;
            if inside { f64::from(table[HEADER + (j * side + i) as usize]) } else { 0.0 }
        };
        let ((i, u), (j, w)) = ((p.floor(), p - p.floor()), (q.floor(), q - q.floor()));
        let row = |j: f64| weight(i, j) * (1.0 - u) + weight(i + 1.0, j) * u;
        let sum: f64 = table[HEADER..].iter().map(|w| f64::from(*w)).sum();
        let density = (row(j) * (1.0 - w) + row(j + 1.0) * w) * (side / (2.0 * reach)).powi(2) / sum;
        let g = (2.0 * a * nv / vh).min(2.0 * a * nl / vh).min(1.0);
        let d = if a * a < 1.0 / 32.0 { 0.0 } else { core::f64::consts::PI * density / a.powi(4) };
        (f + (1.0 - f) * (1.0 - vh).powi(5)) * d * g / (4.0 * nv)
    }

    /// Relative to the value where it exceeds 1.
    #[test]
    fn the_highlight_of_a_table_is_within_two_to_the_minus_11() {
        let (mut worst, mut bright) = (0.0_f64, 0);
        for (side, reach, f) in [(2, 1.0, 0.5), (9, 0.25, 0.04), (32, 2.0, 1.0), (128, 8.0, 0.3)] {
            let table = table(side, reach);
            let model = Tabulated::new(&table, Unit::from_num(f)).unwrap();
            for (view, towards) in views() {
                let exact = exact(&table, &view, towards, f);
                let off = (model.part(&view, towards).to_num::<f64>() - exact).abs() / exact.max(1.0);
                worst = worst.max(off);
                bright += u32::from(exact > 0.5);
            }
        }
        assert!(
            worst < 2_f64.powi(-11) && worst > 2_f64.powi(-20) && bright > 1000,
            "2^{} {bright}",
            worst.log2()
        );
    }

    /// With the eye and the light exchanged, `part / (n . l)` is the same.
    #[test]
    fn a_table_is_reciprocal() {
        let table = table(24, 1.5);
        let model = Tabulated::new(&table, Unit::from_num(0.6)).unwrap();
        let (mut tried, mut worst) = (0, 0.0_f64);
        for (view, towards) in views() {
            let minus = |v: Vec3<Unit>| Vec3::new(-v.x, -v.y, -v.z);
            let back = Sight { direction: minus(towards), ..view };
            let n = floats(view.normal);
            let (nl, nv) = (dot(n, floats(towards)), -dot(n, floats(view.direction)));
            let there = model.part(&view, towards).to_num::<f64>() / nl;
            let here = model.part(&back, minus(view.direction)).to_num::<f64>() / nv;
            if nl > 0.1 && nv > 0.1 {
                worst = worst.max((there - here).abs() / there.max(1.0));
                tried += 1;
            }
        }
        assert!(worst < 1e-3 && tried > 2000, "{worst} {tried}");
    }

    /// No more light leaves than arrives, within `2^-10`, from wherever it is looked at; most of it does,
    /// from above.
    #[test]
    fn no_light_is_made_by_a_table() {
        let unit = Unit::from_num::<f64>;
        let (up, grain) =
            (Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE), Vec3::new(Unit::ONE, Unit::ZERO, Unit::ZERO));
        let (mut most, mut least) = (0.0_f64, 2.0_f64);
        for reach in [0.5, 1.5, 4.0] {
            let table = table(32, reach);
            let model = Tabulated::new(&table, Unit::ONE).unwrap();
            for (slant, turn) in [(0.0, 0.0), (0.5, 0.3), (0.9, 2.0), (0.97, 4.5)] {
                let (s, c) = f64::sin_cos(turn);
                let direction =
                    Vec3::new(unit(slant * c), unit(slant * s), -unit((1.0_f64 - slant * slant).sqrt()));
                let view = Sight { normal: up, direction, tangent: grain };
                let (n, mut sum) = (160, 0.0);
                // equal solid angles
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    let z = (f64::from(i) + 0.5) / f64::from(n);
                    let (r, a) =
                        ((1.0 - z * z).sqrt(), (f64::from(j) + 0.5) / f64::from(n) * core::f64::consts::TAU);
                    let towards = Vec3::new(unit(r * a.cos()), unit(r * a.sin()), unit(z));
                    sum += model.part(&view, towards).to_num::<f64>();
                }
                // 2 pi over n^2 directions, and the pi that is left out of diffuse light
                let all = sum * 2.0 / f64::from(n * n);
                (most, least) = (most.max(all), least.min(all));
            }
        }
        assert!(most < 1.0 + 2_f64.powi(-10) && most > 0.97 && least > 0.2, "{most} {least}");
    }

    #[test]
    fn tables_that_are_none_are_refused_by_name() {
        let good = table(4, 1.0);
        let said = |change: &dyn Fn(&mut Vec<u16>)| {
            let mut table = good.clone();
            change(&mut table);
            std::format!("{}", Tabulated::new(&table, Unit::ONE).unwrap_err())
        };
        assert_eq!(
            said(&|t| t[0] = 2),
            "this version of a table of slopes is not supported; supported: version 1"
        );
        assert_eq!(said(&|t| t.truncate(2)), "2 words of a table of slopes given, 3 expected");
        assert_eq!(said(&|t| t.truncate(18)), "18 words of a table of slopes given, 19 expected");
        assert_eq!(said(&|t| t.push(0)), "20 words of a table of slopes given, 19 expected");
        assert!(said(&|t| t[1] = 1).starts_with("side of a table of slopes is 1"));
        assert!(said(&|t| t[1] = 129).starts_with("side of a table of slopes is 129"));
        assert!(said(&|t| t[2] = 31).starts_with("reach of a table of slopes is 0.121"));
        assert!(said(&|t| t[2] = 2049).starts_with("reach of a table of slopes is 8.003"));
        assert!(said(&|t| t[3] += 1).contains("as much of every slope as of its opposite"));
        assert!(said(&|t| t[3..].fill(0)).starts_with("sum of a table of slopes is 0"));
        assert!(Tabulated::new(&good, Unit::from_bits(-1)).is_err());
        assert!(Tabulated::new(&good, Unit::ONE).unwrap().is_charted());
        let (points, mut counts, mut words) = ([[Real::ONE; 2]; 3], [0; 16], [0; 19]);
        let mut tabulate = |points: &[[Real; 2]], side, counts: usize, given: usize| {
            let all = Tabulated::tabulate(
                (points, points),
                (side, 256),
                &mut counts_of(&mut [0; 16])[..counts],
                &mut words[..given],
            );
            all.map(<[u16]>::len)
        };
        fn counts_of(counts: &mut [u32; 16]) -> &mut [u32] {
            counts
        }
        counts.fill(0);
        assert_eq!(tabulate(&points, 4, 16, 19), Ok(19));
        let needs =
            |needed: usize| move |e: Error| matches!(e, Error::BufferLength { needed: n, .. } if n == needed);
        assert!(tabulate(&points, 4, 15, 19).is_err_and(needs(16)));
        assert!(tabulate(&points, 4, 16, 18).is_err_and(needs(19)));
        assert!(tabulate(&points, 1, 16, 19).is_err_and(|e| matches!(e, Error::OutOfRange { .. })));
        assert!(tabulate(&[], 4, 16, 19).is_err_and(|e| matches!(e, Error::TooFew { given: 0, .. })));
    }
}
