//! The partition: each square of the grid is a leaf or is divided in four, from the upper left to the lower
//! right, down to 4 x 4.
//!
//! A walk without a stack: leaves follow each other along Z. After a leaf the next square begins at the next
//! place along it, and is as large as the place's trailing zeros allow: either a sibling or one that follows
//! an ancestor.

/// The smallest square, as a logarithm.
pub(super) const SMALLEST: u32 = 2;

/// Where a walk through one square of the grid is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk {
    /// Place along Z, in squares of the smallest size.
    place: u32,
    size: u32,
    largest: u32,
}

impl Walk {
    /// At the beginning of a square of `2^largest`.
    pub(super) const fn new(largest: u32) -> Self {
        Self { place: 0, size: largest, largest }
    }

    /// Where the square begins, and the logarithm of its side; none at the end.
    #[inline]
    pub(super) const fn square(&self) -> Option<(u32, u32, u32)> {
        if self.place >> (2 * (self.largest - SMALLEST)) != 0 {
            return None;
        }
        Some((every_other(self.place) << SMALLEST, every_other(self.place >> 1) << SMALLEST, self.size))
    }

    /// Goes to the first quarter of the square.
    #[inline]
    pub(super) const fn divide(&mut self) {
        if self.size > SMALLEST {
            self.size -= 1;
        }
    }

    /// Goes behind the square.
    #[inline]
    pub(super) const fn pass(&mut self) {
        self.place += 1 << (2 * (self.size - SMALLEST));
        let aligned = SMALLEST + (self.place.trailing_zeros() >> 1);
        self.size = if aligned < self.largest { aligned } else { self.largest };
    }
}

/// Bits 0, 2, 4 and 6 of a place.
#[inline]
const fn every_other(place: u32) -> u32 {
    place & 1 | place >> 1 & 2 | place >> 2 & 4 | place >> 3 & 8
}

/// When a pixel is decoded: greater is later, within a band of squares of `2^largest`.
#[inline]
pub(super) const fn order(x: u32, y: u32, largest: u32) -> u32 {
    let low = (1 << largest) - 1;
    x >> largest << (2 * largest) | spread(x & low) | spread(y & low) << 1
}

/// Bits of a number below 32, each before a 0.
#[inline]
const fn spread(v: u32) -> u32 {
    v & 1 | (v & 2) << 1 | (v & 4) << 2 | (v & 8) << 3 | (v & 16) << 4
}
