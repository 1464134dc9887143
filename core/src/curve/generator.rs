//! Generators: the polyline that replaces each segment of a curve, again and again. The Koch curve's has four
//! segments, a straight line with a bump.
//!
//! A [`Generator`] is made once, from points or from a turtle word, and checked: its segments are shorter
//! than the one that they replace, so that the curve converges. [`super::Refined`] then walks the curve that
//! it makes.
//!
//! All is said in the frame of the segment that is replaced, which leads from 0 to 1 in the complex plane.
//! The polyline has the vertices `v_0 = 0 .. v_n = 1` and the segments `w_i = v_{i+1} - v_i`; a segment from
//! `p` along `d` becomes the segments from `p + d v_i` along `d w_i`. Each of them stands for a copy of the
//! whole curve, which may be walked from its end (reversed) and laid on the other side (mirrored): reversing
//! turns `v_j` into `1 - v_{n-j}`, mirroring into its conjugate. So a walk along a copy is in one of four
//! states, and the segments are kept in the order of a walk forwards and of one backwards.
//!
//! Source: course unit V, section 5.1.1, "successive refinement of curves"; B. B. Mandelbrot, "The Fractal
//! Geometry of Nature", 1982, plates 42 to 69. Format: [`Unit`], 30 fractional bits. Left out: copies that
//! are affine but not similar.

use crate::Error;
use crate::num::formats::{Q30, UQ30};
use crate::num::{Unit, Wide, sqrt};

pub(super) const ONE_Q30: Q30 = 1 << 30;

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
pub(super) struct Segment {
    /// Where the copy starts.
    pub(super) start: [Q30; 2],
    /// From its start to its end.
    pub(super) vector: [Q30; 2],
    /// The point that stands for the copy when it is not refined further.
    pub(super) show: [Q30; 2],
    /// The length of the vector, rounded up.
    pub(super) ratio: UQ30,
    /// [`Orientation::bits`].
    pub(super) orientation: u8,
}

impl Segment {
    const EMPTY: Self = Self { start: [0; 2], vector: [0; 2], show: [0; 2], ratio: 0, orientation: 0 };
}

/// A generator of at most `S <= 127` segments. Size: 64 bytes a segment, and 16 on a 32-bit machine.
///
/// A program in which one for more is made does not compile, as a walk counts the segments of both directions
/// in a byte:
///
/// ```compile_fail
/// use attractor::curve::Generator;
/// let _ = Generator::<128>::polyline(&[]);
/// ```
///
/// ```
/// use attractor::curve::Generator;
/// let _ = Generator::<127>::polyline(&[]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Generator<const S: usize> {
    /// The segments in the order of a walk from start to end, and of a walk from end to start.
    segments: [[Segment; S]; 2],
    len: u8,
    /// The point that stands for a whole copy, when it is not the start.
    marker: Option<[Q30; 2]>,
}

impl<const S: usize> Generator<S> {
    /// The generator with these vertices; the segment from the first to the last is what it replaces.
    ///
    /// Domain: points as a scene says them. Error: half a unit in the last place of each vertex after
    /// division by the segment, `2^-31` (`a_vertex_is_the_nearest_number`).
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than three points, [`Error::Capacity`] for more than `S` segments,
    /// [`Error::Degenerate`] when the first point is the last (within `2^-38`) or two neighbours coincide,
    /// [`Error::NotContractive`] with the first segment that is no shorter than the one it replaces,
    /// [`Error::OutOfRange`] for a vertex outside `-1 < x < 2, -2 < y < 2` in the frame of the segment.
    pub fn polyline(points: &[[Wide; 2]]) -> Result<Self, Error> {
        Self::oriented_polyline(points, &[])
    }

    /// Checked where a program is compiled.
    const FITS: () = assert!(S <= 127, "a generator has at most 127 segments");

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

    /// From vertices below `2^46` that begin at 0, one more than segments, and an orientation for each
    /// segment.
    pub(super) fn build(
        segments: usize,
        vertices: impl Iterator<Item = [i64; 2]> + Clone,
        orientations: impl Iterator<Item = Orientation>,
    ) -> Result<Self, Error> {
        const { Self::FITS };
        let capacity = S;
        if segments < 2 {
            return Err(Error::TooFew { what: "vertices", given: segments + 1, at_least: 3 });
        }
        if segments > capacity {
            return Err(Error::Capacity { what: "segments", needed: segments, capacity });
        }
        let whole = vertices.clone().last().unwrap_or_default();
        // a turtle that comes back to its start misses it by what the rounding of sines leaves
        if whole.iter().all(|w| w.unsigned_abs() < 1 << 10) {
            return Err(Error::Degenerate { what: "the segment that the generator replaces" });
        }
        let mut generator = Self { segments: [[Segment::EMPTY; S]; 2], len: segments as u8, marker: None };
        let [forward, backward] = &mut generator.segments;
        let ends = vertices.skip(1).zip(orientations);
        let mut start = [0; 2];
        for (index, (segment, (end, orientation))) in forward.iter_mut().zip(ends).enumerate() {
            let end = complex_quotient_q30(end, whole).ok_or(out_of_range(index + 1))?;
            *segment = Segment::between(start, end, orientation).map_err(|error| match error {
                Error::NotContractive { .. } => Error::NotContractive { map: index },
                other => other,
            })?;
            start = end;
        }
        for (mirror, segment) in backward.iter_mut().zip(forward.iter().take(segments).rev()) {
            // the end of the segment, seen from the other end of the whole
            let [x, y] = [0, 1].map(|i: usize| match (segment.start.get(i), segment.vector.get(i)) {
                (Some(s), Some(v)) => s.wrapping_add(*v),
                _ => 0,
            });
            let start = [ONE_Q30 - x, -y];
            *mirror = Segment { start, show: start, ..*segment };
        }
        Ok(generator)
    }

    /// The same generator, drawn through one point of each copy instead of through its ends: space-filling
    /// curves through the middles of their tiles. The marker is given in the frame of the segment.
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
        for (state, segments) in (0_u8..).zip(&mut self.segments) {
            for segment in segments {
                let local = oriented(marker, state ^ segment.orientation);
                // |start| < 3 and |w c| < 1.5: far inside 64 bits, and a tile stays near its segment
                let [x, y] = complex_product_q30(segment.vector, local);
                let [sx, sy] = segment.start;
                segment.show = [saturate(i64::from(sx) + x), saturate(i64::from(sy) + y)];
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

    /// By how much a refinement lengthens the curve: the sum of the segments' lengths over that of the
    /// segment they replace. Error: below `2^-29` a segment, upwards
    /// (`a_refinement_lengthens_by_the_sum_of_its_segments`).
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

    /// The lengths of the segments.
    pub(super) fn ratios(&self) -> impl Iterator<Item = UQ30> {
        self.segments.iter().take(1).flatten().take(self.len()).map(|segment| segment.ratio)
    }

    /// Where the segments of a walk in a state begin and end among [`Generator::segments`].
    #[inline(always)]
    pub(super) const fn range(&self, state: u8) -> (u8, u8) {
        // 2 S segments at most: the capacity is 127
        let first = if state & 1 == 0 { 0 } else { S as u8 };
        (first, first.wrapping_add(self.len))
    }

    /// The segments in the order of a walk in a state.
    #[inline(always)]
    pub(super) fn walk(&self, state: u8) -> &[Segment] {
        let [forward, backward] = &self.segments;
        let segments = if state & 1 == 0 { forward } else { backward };
        segments.get(..self.len()).unwrap_or_default()
    }

    /// All segments, of both walks.
    #[inline(always)]
    pub(super) const fn segments(&self) -> &[Segment] {
        self.segments.as_flattened()
    }

    pub(super) const fn marker(&self) -> Option<[Q30; 2]> {
        self.marker
    }

    /// How far from its start a copy reaches, over its length, after `order` refinements: 30 fractional bits,
    /// rounded up.
    pub(super) fn reach(&self, order: u32) -> u64 {
        let norm = |[x, y]: [Q30; 2]| hypotenuse(i64::from(x), i64::from(y));
        let farthest = self
            .segments
            .iter()
            .flat_map(|segments| segments.iter().take(self.len()))
            .map(|segment| norm(segment.start).max(norm(segment.show)))
            .chain([ONE_Q30 as u64])
            .max()
            .unwrap_or(0);
        // farthest (1 + s + s^2 + ..), at most `order` terms
        let factor = u64::from(self.contraction_factor().to_bits().unsigned_abs());
        let gap = (ONE_Q30 as u64).saturating_sub(factor);
        let series = (farthest << 30).checked_div(gap).map_or(u64::MAX, |sum| sum + 1);
        series.min(farthest.saturating_mul(u64::from(order.max(1))))
    }

    /// A generator whose numbers are already in the frame of the segment: for constants.
    pub(super) const fn from_vertices(vertices: &[[Q30; 2]], ratios: &[UQ30; S]) -> Self {
        const { Self::FITS };
        let mut segments = [[Segment::EMPTY; S]; 2];
        let mut i = 0;
        while i < S {
            let ([x, y], [u, v]) = (vertices[i], vertices[i + 1]);
            let vector = [u - x, v - y];
            let segment = Segment { start: [x, y], vector, show: [x, y], ratio: ratios[i], orientation: 0 };
            segments[0][i] = segment;
            let start = [ONE_Q30 - u, -v];
            segments[1][S - 1 - i] = Segment { start, show: start, ..segment };
            i += 1;
        }
        Self { segments, len: S as u8, marker: None }
    }
}

impl Segment {
    /// `show` seen from the start.
    pub(super) const fn show_from_start(&self) -> [Q30; 2] {
        let ([x, y], [u, v]) = (self.start, self.show);
        [u.wrapping_sub(x), v.wrapping_sub(y)]
    }

    fn between(start: [Q30; 2], end: [Q30; 2], orientation: Orientation) -> Result<Self, Error> {
        let ([x, y], [u, v]) = (start.map(i64::from), end.map(i64::from));
        let (dx, dy) = (u - x, v - y);
        let length = hypotenuse(dx, dy);
        if length == 0 {
            return Err(Error::Degenerate { what: "a segment of the generator" });
        }
        if length >= ONE_Q30 as u64 {
            return Err(Error::NotContractive { map: 0 });
        }
        // shorter than 1: it fits
        let vector = [dx as i32, dy as i32];
        Ok(Self { start, vector, show: start, ratio: length as u32, orientation: orientation.bits() })
    }
}

/// A point of a copy in the frame of the walk along it.
pub(super) const fn oriented([x, y]: [Q30; 2], state: u8) -> [Q30; 2] {
    let [x, y] = if state & 1 == 0 { [x, y] } else { [ONE_Q30.saturating_sub(x), -y] };
    if state & 2 == 0 { [x, y] } else { [x, -y] }
}

/// The product of complex numbers, rounded, in words that it cannot leave: 30 fractional bits.
fn complex_product_q30(a: [Q30; 2], b: [Q30; 2]) -> [i64; 2] {
    let ([a, b], [c, d]) = (a.map(i64::from), b.map(i64::from));
    [(a * c - b * d + (1 << 29)) >> 30, (a * d + b * c + (1 << 29)) >> 30]
}

/// `v / whole`, rounded, for complex numbers below `2^46`; none when it lies outside the frame.
fn complex_quotient_q30(v: [i64; 2], whole: [i64; 2]) -> Option<[Q30; 2]> {
    let ([x, y], [u, w]) = (v.map(i128::from), whole.map(i128::from));
    let square = u * u + w * w;
    // below 2^94 << 31
    let divided = |numerator: i128| {
        let twice = (numerator << 31).checked_div_euclid(square).unwrap_or(i128::MAX);
        i64::try_from((twice + 1) >> 1).ok()
    };
    let (re, im) = (divided(x * u + y * w)?, divided(y * u - x * w)?);
    let one = i64::from(ONE_Q30);
    if re <= -one || re >= 2 * one || im <= -2 * one || im >= 2 * one {
        return None;
    }
    Some([re as i32, im as i32])
}

fn out_of_range(index: usize) -> Error {
    let (value, max) = (Wide::MAX, Wide::from_num(2));
    Error::OutOfRange { what: "vertex of the generator", index: Some(index), value, min: -max, max }
}

/// Inside the domain of [`crate::num::complex_product_added`].
fn saturate(bits: i64) -> Q30 {
    const FARTHEST: i64 = (1 << 31) - (1 << 15);
    bits.clamp(-FARTHEST, FARTHEST) as i32
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
            for (got, exact) in generator.segments[0][1].start.into_iter().zip(exact) {
                let twice = 2 * (i128::from(got) * norm - exact).abs();
                assert!(twice <= norm, "{points:?}: {got}");
                close += u32::from(4 * twice > norm);
            }
        }
        assert!(made > 100 && close > 100, "{made} {close}");
    }
}
