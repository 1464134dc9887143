//! What a leaf says of its transform: a level for each frequency, those next to each other within reach.

use super::rolled::rolled;

/// Frequencies along each axis.
pub const FREQUENCIES: usize = 16;
/// The largest level.
pub const LARGEST: i32 = 8191;

/// From a column of levels to the next.
pub(super) const STRIDE: usize = FREQUENCIES + 1;

/// What a block's coefficients are.
#[derive(Debug, Clone)]
pub struct Levels {
    /// A column of the transform lies together; what is above it and before the first column is 0.
    pub(super) levels: [i16; STRIDE * STRIDE],
    /// A bit for each `u` of a level that was set, and one more than the greatest `v`.
    pub(super) columns: u32,
    pub(super) rows: u32,
}

impl Default for Levels {
    fn default() -> Self {
        Self { levels: [0; STRIDE * STRIDE], columns: 0, rows: 0 }
    }
}

/// Where a level is kept.
#[inline]
const fn at(place: u8) -> usize {
    ((place & 15) as usize + 1) * STRIDE + (place >> 4) as usize
}

impl Levels {
    /// Whether all are 0.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.columns == 0
    }

    /// Sets the level at `v`, `u`, a nibble each, cut off at [`LARGEST`].
    #[inline]
    pub fn set(&mut self, place: u8, level: i32) {
        self.levels[at(place)] = level.clamp(-LARGEST, LARGEST) as i16;
        self.columns |= 1 << (place & 15);
        self.rows = self.rows.max((u32::from(place) >> 4) + 1);
    }

    /// The level at a place.
    #[inline]
    pub fn get(&self, place: u8) -> i32 {
        i32::from(self.levels[at(place)])
    }

    /// How much is at the next lower frequencies along both axes: 0, 1, or 2 for more. The mean, whose level
    /// is not kept here, counts as 0.
    #[inline]
    pub fn about(&self, place: u8) -> usize {
        let at = at(place);
        let [above, left] = [self.levels[at - 1], self.levels[at - STRIDE]];
        usize::from(above.unsigned_abs() + left.unsigned_abs()).min(2)
    }

    /// Makes them all 0.
    #[inline(never)]
    pub fn clear(&mut self) {
        while self.columns != 0 {
            let column = (self.columns.trailing_zeros() as usize + 1) * STRIDE;
            if let Some(levels) = self.levels.get_mut(column..column + FREQUENCIES) {
                levels.fill(0);
            }
            rolled();
            self.columns &= self.columns - 1;
        }
        (self.columns, self.rows) = (0, 0);
    }
}
