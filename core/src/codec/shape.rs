//! Where a plane's squares are, how large they are drawn, and where domains may lie.

use super::leaf::Domain;
use super::quadtree::is_earlier;

/// What a plane is before its memory.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Logarithm of the side of the largest square, 4 or 5.
    pub largest: u32,
    /// 1 for chroma.
    pub chroma: u32,
    /// Step in `2^-8`.
    pub step: u32,
    /// Rows above a band that a domain may lie in; none: anywhere.
    pub window: Option<u32>,
    /// Whether there are coefficients.
    pub transform: bool,
    /// Logarithm of the size that is drawn.
    pub scale: i32,
}

impl Shape {
    /// A length that is a multiple of four pixels, as it is drawn.
    #[inline]
    pub const fn scaled(&self, v: u32) -> u32 {
        (v << 2) >> self.fraction()
    }

    /// Any length, rounded up.
    #[inline]
    pub const fn scaled_up(&self, v: u32) -> u32 {
        ((v << 2) + (1 << self.fraction()) - 1) >> self.fraction()
    }

    /// How many quarters of a drawn pixel a quarter of a pixel is, as a logarithm: scales are from -2 to 2.
    #[inline]
    const fn fraction(&self) -> u32 {
        (2 - self.scale) as u32
    }

    /// A mean of so many steps in a leaf of `2^size`, with 7 fractional bits.
    #[inline]
    pub(super) fn moved(&self, steps: i32, size: u32) -> i32 {
        let moved = (i64::from(steps) * i64::from(self.step) + (1 << size)) >> (1 + size);
        moved.clamp(-(1 << 25), 1 << 25) as i32
    }

    /// Logarithm of the side of a leaf as it is drawn.
    #[inline]
    pub(super) const fn drawn(&self, size: u32) -> u32 {
        size.saturating_add_signed(self.scale)
    }

    /// Width as it is drawn.
    pub const fn columns(&self) -> u32 {
        self.scaled_up(self.width)
    }

    /// Height as it is drawn.
    pub const fn rows(&self) -> u32 {
        self.scaled_up(self.height)
    }

    /// Side of the largest squares.
    pub const fn side(&self) -> u32 {
        1 << self.largest
    }

    /// Width up to whole squares.
    pub const fn padded(&self) -> u32 {
        (self.width + self.side() - 1) >> self.largest << self.largest
    }

    /// Rows of the halved picture that domains lie in.
    pub const fn half_rows(&self) -> u32 {
        match self.window {
            Some(rows) => (rows + self.side()) >> 1,
            None => self.height >> 1,
        }
    }

    /// The columns and rows of places, half a leaf apart, for domains of leaves of `2^size`; none of the
    /// smallest leaves.
    #[inline]
    pub const fn far(&self, size: u32) -> Option<(u32, u32)> {
        let (columns, rows) = (self.width >> size, self.half_rows() >> (size - 1));
        if size == 2 || columns == 0 || rows == 0 { None } else { Some((columns, rows)) }
    }

    /// Where a leaf's domain begins in the halved picture; none where it may not lie.
    #[inline(never)]
    pub fn place(&self, domain: &Domain, x: u32, y: u32, size: u32) -> Option<Place> {
        let n = 1_i32 << size;
        let band = y >> self.largest << self.largest;
        let top = self.window.map_or(0, |rows| (band >> 1) as i32 - (rows >> 1) as i32);
        let (px, py) = if domain.near {
            let step = if n >= 8 { n >> 2 } else { 1 };
            let centre = if self.window.is_some() { 14 } else { 8 };
            let at =
                |v: u32, place: u32, centre: i32| (v >> 1) as i32 - (n >> 2) + (place as i32 - centre) * step;
            (at(x, domain.column, 8), at(y, domain.row, centre))
        } else {
            (domain.column as i32 * (n >> 1), top + domain.row as i32 * (n >> 1))
        };
        let (right, bottom) = (px + n, py + n);
        if px < 0 || py < top.max(0) || right > (self.width >> 1) as i32 || bottom > (self.height >> 1) as i32
        {
            return None;
        }
        // the last pixel of it that is decoded
        let (last_x, last_y) = (2 * right as u32 - 1, 2 * bottom as u32 - 1);
        let decoded = last_y < band
            || last_y < band + self.side()
                && is_earlier([last_x, last_y - band], [x, y - band], self.largest);
        let apart = |v: u32, from: i32, last: u32| last < v || 2 * from as u32 >= v + n as u32;
        let allowed = decoded || self.window.is_none() && (apart(x, px, last_x) || apart(y, py, last_y));
        allowed.then_some(Place { x: px as u32, y: py as u32, decoded })
    }
}

/// Where a domain lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Its first column in the halved picture.
    pub x: u32,
    /// Its first row.
    pub y: u32,
    /// Whether all of it is decoded before its leaf.
    pub decoded: bool,
}
