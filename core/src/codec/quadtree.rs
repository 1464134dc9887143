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

/// Whether one pixel is decoded before another, within a band of squares of `2^largest`: by the square, then
/// by the highest bit in which their places along Z differ, of which those of `y` come before those of `x`.
#[inline]
pub(super) const fn is_earlier([x, y]: [u32; 2], [other_x, other_y]: [u32; 2], largest: u32) -> bool {
    let (across, down) = (x ^ other_x, y ^ other_y);
    // in another square, or the highest bit of `across` is above that of `down`
    if across >> largest != 0 || down < across && down < (down ^ across) { x < other_x } else { y < other_y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pixel_is_earlier_as_a_walk_through_the_squares_has_it() {
        let mut tried = 0;
        for largest in [4, 5] {
            // the cells of two squares of a band in the order of the walk
            let mut cells = std::vec::Vec::new();
            for square in 0..2 {
                let mut walk = Walk::new(largest);
                while let Some((x, y, size)) = walk.square() {
                    if size > SMALLEST {
                        walk.divide();
                        continue;
                    }
                    cells.push([x + (square << largest), y]);
                    walk.pass();
                }
            }
            for (i, one) in cells.iter().enumerate() {
                for (j, other) in cells.iter().enumerate() {
                    assert_eq!(is_earlier(*one, *other, largest), i < j, "{one:?} {other:?}");
                    let [x, y] = *one;
                    // the last pixel of a cell
                    assert!(i == j || is_earlier([x + 3, y + 3], *other, largest) == (i < j));
                    tried += 1;
                }
            }
        }
        assert_eq!(tried, 128 * 128 + 32 * 32);
    }
}
