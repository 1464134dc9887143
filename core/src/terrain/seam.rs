//! Seams: edges of surfaces that lie apart in the parameters and together in space.
//!
//! Patches in one parametric range share their edges as they are. To close a strip to a ring, or to sew six
//! squares to a cube, both edges of a seam must get the same random numbers: "a seam function needs only to
//! be an offset and a procedure for accessing the random number table" (L. C. Carpenter, "Computer rendering
//! of fractal curves and surfaces", 1980). Here the offset is the number of a random field of the seam's own,
//! and the procedure the distance from where the seam begins: the edges may run in any direction.
//!
//! Where the heights of the knots along both edges agree as well, so do all heights between, bit for bit.

use super::random::Randomness;
use crate::Error;
use crate::num::{Coordinate, Deviate, RandomField};

/// One edge of a seam: a segment along `u` or `v`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Seam {
    number: u32,
    from: [Coordinate; 2],
    to: [Coordinate; 2],
}

impl Seam {
    /// The edge from one knot to another of the seam of this number.
    ///
    /// # Errors
    /// [`Error::Degenerate`] unless it runs along one of the axes.
    pub fn new(number: u32, from: [i16; 2], to: [i16; 2]) -> Result<Self, Error> {
        let ([u_0, v_0], [u_1, v_1]) = (from, to);
        if (u_0 == u_1) == (v_0 == v_1) {
            return Err(Error::Degenerate { what: "extent of a seam along one axis" });
        }
        let corner = |knot: [i16; 2]| knot.map(Coordinate::from);
        Ok(Self { number, from: corner(from), to: corner(to) })
    }

    /// How far along the edge a point of it lies, from the seam's beginning.
    fn along(&self, u: Coordinate, v: Coordinate) -> Option<u32> {
        let ([u_0, v_0], [u_1, v_1]) = (self.from, self.to);
        let inside = |c: Coordinate, a: Coordinate, b: Coordinate| a.min(b) <= c && c <= a.max(b);
        if !inside(u, u_0, u_1) || !inside(v, v_0, v_1) {
            return None;
        }
        Some(u.to_bits().abs_diff(u_0.to_bits()) + v.to_bits().abs_diff(v_0.to_bits()))
    }
}

/// A random field with seams.
///
/// ```
/// use attractor::num::{Coordinate, RandomField};
/// use attractor::terrain::{Randomness, Seam, Seamed};
///
/// // a strip of four patches, closed to a ring
/// let seams = [Seam::new(1, [0, 0], [0, 1])?, Seam::new(1, [4, 0], [4, 1])?];
/// let random = Seamed::new(RandomField::new(7), &seams);
/// let [left, right, half] = [0.0, 4.0, 0.5].map(Coordinate::from_num);
/// assert_eq!(random.at(left, half), random.at(right, half));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seamed<'a> {
    field: RandomField,
    seams: &'a [Seam],
}

impl<'a> Seamed<'a> {
    /// A field with these seams, each of at least two edges.
    pub const fn new(field: RandomField, seams: &'a [Seam]) -> Self {
        Self { field, seams }
    }
}

impl Randomness for Seamed<'_> {
    fn at(&self, u: Coordinate, v: Coordinate) -> [Deviate; 2] {
        let on = self.seams.iter().find_map(|seam| Some((seam.number, seam.along(u, v)?)));
        match on {
            None => self.field.at(u, v),
            Some((number, along)) => {
                let own = self.field.numbered(number.wrapping_add(1 << 31));
                // whichever way the edge runs, its middles get the same number
                let [r, _] = own.at(Coordinate::from_bits(along as i32), Coordinate::ZERO);
                [r; 2]
            }
        }
    }
}
