//! Generators: the polyline that replaces each segment, as a list of similarity maps of the segment from `(0, 0)` to `(1, 0)`.
//!
//! A segment from `p` along `d` becomes the segments from `p + d v_i` along `d w_i`, with `w_i = v_{i+1} - v_i` and the vertices `v_0 = 0 .. v_n = 1`
//! as complex numbers. Each copy may be walked from its end (reversed) and laid on the other side (mirrored):
//! reversing turns `v_j` into `1 - v_{n-j}`, mirroring into its conjugate.
//! Source: course unit V, section 5.1.1, "successive refinement of curves"; B. B. Mandelbrot, "The Fractal Geometry of Nature", 1982, plates 42 to 69.
//! Format: [`Unit`], 30 fractional bits. Left out: copies that are affine but not similar.

use crate::Error;
use crate::num::{Unit, Wide, sqrt};

pub(super) const ONE: i32 = 1 << 30;

/// How a copy of the curve lies on its segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Orientation {
    /// As the whole lies on its own.
    #[default]
    Plain,
    /// Walked from its end to its start.
    Reversed,
    /// On the other side.
    Mirrored,
    /// Both.
    MirroredReversed,
}

impl Orientation {
    /// Bit 0: reversed, bit 1: mirrored.
    pub(super) const fn bits(self) -> u8 {
        match self {
            Self::Plain => 0,
            Self::Reversed => 1,
            Self::Mirrored => 2,
            Self::MirroredReversed => 3,
        }
    }
}

/// One segment of a generator, in the frame of the segment that it replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cell {
    /// Where the copy starts.
    pub(super) start: [i32; 2],
    /// From its start to its end.
    pub(super) vector: [i32; 2],
    /// The point that stands for the copy when it is not refined further.
    pub(super) show: [i32; 2],
    /// The length of the vector, rounded up.
    pub(super) ratio: u32,
    /// [`Orientation::bits`].
    pub(super) orientation: u8,
}

impl Cell {
    const EMPTY: Self = Self { start: [0; 2], vector: [0; 2], show: [0; 2], ratio: 0, orientation: 0 };
}

/// A generator of at most `S <= 127` segments. Size: 64 bytes a segment, and 16 on a 32-bit machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generator<const S: usize> {
    /// The segments in the order of a walk from start to end, and of a walk from end to start.
    cells: [[Cell; S]; 2],
    len: u8,
    /// The point that stands for a whole copy, when it is not the start.
    marker: Option<[i32; 2]>,
}

impl<const S: usize> Generator<S> {
    /// The generator with these vertices; the segment from the first to the last is what it replaces.
    ///
    /// Domain: points as a scene says them. Error: half a unit in the last place of each vertex after division
    /// by the segment, `2^-31` (`a_vertex_is_the_nearest_number`).
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than three points, [`Error::Capacity`] for more than `S` or 127 segments,
    /// [`Error::Degenerate`] when the first point is the last (within `2^-38`) or two neighbours coincide, [`Error::NotContractive`] with the first segment that is no shorter
    /// than the one it replaces, [`Error::OutOfRange`] for a vertex outside `-1 < x < 2, -2 < y < 2` in the frame of the segment.
    pub fn polyline(points: &[[Wide; 2]]) -> Result<Self, Error> {
        Self::oriented_polyline(points, &[])
    }

    /// [`Generator::polyline`] with an orientation for each segment; those without one are plain.
    ///
    /// # Errors
    /// As [`Generator::polyline`], and [`Error::LengthMismatch`] for more orientations than segments.
    pub fn oriented_polyline(points: &[[Wide; 2]], orientations: &[Orientation]) -> Result<Self, Error> {
        let Some(first) = points.first() else {
            return Err(Error::TooFew { what: "vertices", given: 0, at_least: 3 });
        };
        // differences of 64-bit numbers, brought below 2^46
        let difference = |p: &[Wide; 2]| {
            [0, 1].map(|i: usize| match (p.get(i), first.get(i)) {
                (Some(a), Some(b)) => i128::from(a.to_bits()) - i128::from(b.to_bits()),
                _ => 0,
            })
        };
        let largest = points.iter().flat_map(difference).map(i128::unsigned_abs).max().unwrap_or(0);
        let shift = 82_u32.saturating_sub(largest.leading_zeros());
        let vertices = points.iter().map(|p| difference(p).map(|d| (d >> shift) as i64));
        let segments = points.len() - 1;
        if orientations.len() > segments {
            return Err(Error::LengthMismatch {
                what: "orientations",
                given: orientations.len(),
                expected: segments,
            });
        }
        let given = orientations.iter().copied().chain(core::iter::repeat(Orientation::Plain));
        Self::build(segments, vertices, given)
    }

    /// From vertices below `2^46` that begin at 0, one more than segments, and an orientation for each segment.
    pub(super) fn build(
        segments: usize,
        vertices: impl Iterator<Item = [i64; 2]> + Clone,
        orientations: impl Iterator<Item = Orientation>,
    ) -> Result<Self, Error> {
        let capacity = S.min(127);
        if segments < 2 {
            return Err(Error::TooFew { what: "vertices", given: segments + 1, at_least: 3 });
        }
        if segments > capacity {
            return Err(Error::Capacity { what: "segments", needed: segments, capacity });
        }
        let whole = vertices.clone().last().unwrap_or_default();
        // what the rounding of sines leaves of a closed word
        if whole.iter().all(|w| w.unsigned_abs() < 1 << 10) {
            return Err(Error::Degenerate { what: "the segment that the generator replaces" });
        }
        let mut generator = Self { cells: [[Cell::EMPTY; S]; 2], len: segments as u8, marker: None };
        let [forward, backward] = &mut generator.cells;
        let ends = vertices.skip(1).zip(orientations);
        let mut start = [0; 2];
        for (index, (cell, (end, orientation))) in forward.iter_mut().zip(ends).enumerate() {
            let end = quotient(end, whole).ok_or(out_of_range(index + 1))?;
            *cell = Cell::between(start, end, orientation).map_err(|error| match error {
                Error::NotContractive { .. } => Error::NotContractive { map: index },
                other => other,
            })?;
            start = end;
        }
        for (mirror, cell) in backward.iter_mut().zip(forward.iter().take(segments).rev()) {
            // the end of the segment, seen from the other end of the whole
            let [x, y] = [0, 1].map(|i: usize| match (cell.start.get(i), cell.vector.get(i)) {
                (Some(s), Some(v)) => s.wrapping_add(*v),
                _ => 0,
            });
            let start = [ONE - x, -y];
            *mirror = Cell { start, show: start, ..*cell };
        }
        Ok(generator)
    }

    /// The same generator, drawn through one point of each copy instead of through its ends: space-filling curves through the middles of their tiles.
    /// The marker is given in the frame of the segment.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a marker outside the unit square `|x|, |y| <= 1`.
    pub fn through(mut self, marker: [Unit; 2]) -> Result<Self, Error> {
        if let Some(index) = marker.iter().position(|m| m.unsigned_abs() > Unit::ONE.unsigned_abs()) {
            return Err(Error::OutOfRange {
                what: "marker",
                index: Some(index),
                value: marker.get(index).map_or(Wide::ZERO, |m| Wide::from(*m)),
                min: -Wide::ONE,
                max: Wide::ONE,
            });
        }
        let marker = marker.map(Unit::to_bits);
        for (state, cells) in (0_u8..).zip(&mut self.cells) {
            for cell in cells {
                let local = oriented(marker, state ^ cell.orientation);
                // |start| < 3 and |w c| < 1.5: far inside 64 bits, and a tile stays near its segment
                let [x, y] = product(cell.vector, local);
                let [sx, sy] = cell.start;
                cell.show = [saturate(i64::from(sx) + x), saturate(i64::from(sy) + y)];
            }
        }
        self.marker = Some(marker);
        Ok(self)
    }

    /// How many segments replace one.
    pub const fn len(&self) -> usize {
        self.len as usize
    }

    /// Never: a generator has at least two segments.
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// By how much a refinement lengthens the curve: the sum of the segments' lengths over that of the segment they replace. Error: below
    /// `2^-29` a segment, upwards (`a_refinement_lengthens_by_the_sum_of_its_segments`).
    ///
    /// ```
    /// use attractor::curve::koch;
    /// assert!(koch::GENERATOR.lengthening().abs_diff(attractor::num::Wide::from_num(4) / 3) < 1e-8);
    /// ```
    pub fn lengthening(&self) -> Wide {
        // at most 127 segments shorter than 1
        Wide::from_bits(self.ratios().map(|r| i64::from(r) << 18).sum())
    }

    /// The length of the longest segment over that of the one it replaces, rounded up.
    pub fn contraction_factor(&self) -> Unit {
        Unit::from_bits(self.ratios().max().unwrap_or(0) as i32)
    }

    /// The lengths of the segments, 30 fractional bits.
    pub(super) fn ratios(&self) -> impl Iterator<Item = u32> {
        self.cells.iter().take(1).flatten().take(self.len()).map(|cell| cell.ratio)
    }

    /// Where the segments of a walk in a state begin and end among [`Generator::cells`].
    #[inline(always)]
    pub(super) const fn range(&self, state: u8) -> (u8, u8) {
        // 2 S cells at most: the capacity is 127
        let first = if state & 1 == 0 { 0 } else { S as u8 };
        (first, first.wrapping_add(self.len))
    }

    /// The segments in the order of a walk in a state.
    #[inline(always)]
    pub(super) fn walk(&self, state: u8) -> &[Cell] {
        let [forward, backward] = &self.cells;
        let cells = if state & 1 == 0 { forward } else { backward };
        cells.get(..self.len()).unwrap_or_default()
    }

    /// All segments, of both walks.
    #[inline(always)]
    pub(super) const fn cells(&self) -> &[Cell] {
        self.cells.as_flattened()
    }

    pub(super) const fn marker(&self) -> Option<[i32; 2]> {
        self.marker
    }

    /// How far from its start a copy reaches, over its length, after `order` refinements: 30 fractional bits, rounded up.
    pub(super) fn reach(&self, order: u32) -> u64 {
        let norm = |[x, y]: [i32; 2]| hypotenuse(i64::from(x), i64::from(y));
        let farthest = self
            .cells
            .iter()
            .flat_map(|cells| cells.iter().take(self.len()))
            .map(|cell| norm(cell.start).max(norm(cell.show)))
            .chain([ONE as u64])
            .max()
            .unwrap_or(0);
        // farthest (1 + s + s^2 + ..), at most `order` terms
        let gap = (ONE as u64).saturating_sub(u64::from(self.contraction_factor().to_bits().unsigned_abs()));
        let series = (farthest << 30).checked_div(gap).map_or(u64::MAX, |sum| sum + 1);
        series.min(farthest.saturating_mul(u64::from(order.max(1))))
    }

    /// A generator whose numbers are already in the frame of the segment: for constants.
    pub(super) const fn from_vertices(vertices: &[[i32; 2]], ratios: &[u32; S]) -> Self {
        let mut cells = [[Cell::EMPTY; S]; 2];
        let mut i = 0;
        while i < S {
            let ([x, y], [u, v]) = (vertices[i], vertices[i + 1]);
            let vector = [u - x, v - y];
            let cell = Cell { start: [x, y], vector, show: [x, y], ratio: ratios[i], orientation: 0 };
            cells[0][i] = cell;
            cells[1][S - 1 - i] = Cell { start: [ONE - u, -v], show: [ONE - u, -v], ..cell };
            i += 1;
        }
        Self { cells, len: S as u8, marker: None }
    }
}

impl Cell {
    /// `show` seen from the start.
    pub(super) const fn show_from_start(&self) -> [i32; 2] {
        let ([x, y], [u, v]) = (self.start, self.show);
        [u.wrapping_sub(x), v.wrapping_sub(y)]
    }

    fn between(start: [i32; 2], end: [i32; 2], orientation: Orientation) -> Result<Self, Error> {
        let ([x, y], [u, v]) = (start.map(i64::from), end.map(i64::from));
        let (dx, dy) = (u - x, v - y);
        let length = hypotenuse(dx, dy);
        if length == 0 {
            return Err(Error::Degenerate { what: "a segment of the generator" });
        }
        if length >= ONE as u64 {
            return Err(Error::NotContractive { map: 0 });
        }
        // shorter than 1: it fits
        let vector = [dx as i32, dy as i32];
        Ok(Self { start, vector, show: start, ratio: length as u32, orientation: orientation.bits() })
    }
}

/// A point of a copy in the frame of the walk along it.
pub(super) const fn oriented([x, y]: [i32; 2], state: u8) -> [i32; 2] {
    let [x, y] = if state & 1 == 0 { [x, y] } else { [ONE.saturating_sub(x), -y] };
    if state & 2 == 0 { [x, y] } else { [x, -y] }
}

/// The complex product of numbers with 30 fractional bits, rounded.
fn product(a: [i32; 2], b: [i32; 2]) -> [i64; 2] {
    let ([a, b], [c, d]) = (a.map(i64::from), b.map(i64::from));
    [(a * c - b * d + (1 << 29)) >> 30, (a * d + b * c + (1 << 29)) >> 30]
}

/// `v / whole` with 30 fractional bits, rounded, for numbers below `2^46`; none when it lies outside the frame.
fn quotient(v: [i64; 2], whole: [i64; 2]) -> Option<[i32; 2]> {
    let ([x, y], [u, w]) = (v.map(i128::from), whole.map(i128::from));
    let square = u * u + w * w;
    // below 2^94 << 31
    let divided = |numerator: i128| {
        let twice = (numerator << 31).checked_div_euclid(square).unwrap_or(i128::MAX);
        i64::try_from((twice + 1) >> 1).ok()
    };
    let (re, im) = (divided(x * u + y * w)?, divided(y * u - x * w)?);
    let one = i64::from(ONE);
    if re <= -one || re >= 2 * one || im <= -2 * one || im >= 2 * one {
        return None;
    }
    Some([re as i32, im as i32])
}

fn out_of_range(index: usize) -> Error {
    let (value, max) = (Wide::MAX, Wide::from_num(2));
    Error::OutOfRange { what: "vertex of the generator", index: Some(index), value, min: -max, max }
}

fn saturate(bits: i64) -> i32 {
    bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `sqrt(x^2 + y^2)` rounded up, for `|x|, |y| <= 2^31`.
pub(super) fn hypotenuse(x: i64, y: i64) -> u64 {
    let square = x.unsigned_abs() * x.unsigned_abs() + y.unsigned_abs() * y.unsigned_abs();
    let root = u64::from(sqrt(square));
    root + u64::from(root * root < square)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn a_vertex_is_the_nearest_number() {
        let (mut made, mut close) = (0, 0);
        let mut word = 1_u64;
        let mut next = || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            word as i64 >> 20
        };
        for _ in 0..4000 {
            let points = [(); 4].map(|()| [Wide::from_bits(next()), Wide::from_bits(next())]);
            let Ok(generator) = Generator::<3>::polyline(&points) else { continue };
            made += 1;
            let [u, v, _, w] = points
                .map(|p| [0, 1].map(|i| i128::from(p[i].to_bits()) - i128::from(points[0][i].to_bits())));
            assert_eq!(u, [0, 0]);
            let norm = w[0] * w[0] + w[1] * w[1];
            let exact = [v[0] * w[0] + v[1] * w[1], v[1] * w[0] - v[0] * w[1]].map(|e| e << 30);
            for (got, exact) in generator.cells[0][1].start.into_iter().zip(exact) {
                let twice = 2 * (i128::from(got) * norm - exact).abs();
                assert!(twice <= norm, "{points:?}: {got}");
                close += u32::from(4 * twice > norm);
            }
        }
        assert!(made > 100 && close > 100, "{made} {close}");
    }
}
