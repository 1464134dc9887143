//! Which cells of a plane the first sweep of an encoding settles: a leaf is settled once it was drawn with a
//! domain of which all is settled, or without one.

/// Cells of 4 x 4 that stay as they are.
#[derive(Clone, Debug, Default)]
pub(super) struct Settled {
    across: u32,
    cells: Vec<bool>,
}

impl Settled {
    /// None, for a plane of so many columns and rows, whole squares.
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { across: width / 4, cells: vec![false; (width / 4 * height / 4) as usize] }
    }

    fn square(&self, x: u32, y: u32, side: u32) -> impl Iterator<Item = usize> {
        let (across, columns) = (self.across, x / 4..(x + side).div_ceil(4));
        let rows = y / 4..(y + side).div_ceil(4);
        rows.flat_map(move |row| columns.clone().map(move |column| (row * across + column) as usize))
    }

    pub(super) fn has(&self, x: u32, y: u32, side: u32) -> bool {
        self.square(x, y, side).all(|cell| self.cells[cell])
    }

    pub(super) fn add(&mut self, x: u32, y: u32, side: u32) {
        for cell in self.square(x, y, side).collect::<Vec<_>>() {
            self.cells[cell] = true;
        }
    }
}
