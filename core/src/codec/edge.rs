//! What a square leaves behind for later ones: an encoder that tries takes it back.

use super::plane::Plane;
use super::sample::Sample;

/// What later leaves know of a square's neighbours: [`Plane::edge`].
#[derive(Debug, Clone, Copy)]
pub struct Edge<S> {
    x: u32,
    y: u32,
    size: u32,
    above: [S; 32],
    cells: [S; 8],
    left: [S; 32],
    left_cells: [u8; 8],
}

impl<S> Edge<S> {
    /// Of its pixels and of its cells.
    const fn lengths(&self) -> (usize, usize) {
        (1 << self.size, 1 << (self.size - 2))
    }
}

impl<S: Sample> Plane<'_, S> {
    /// What later leaves know of a square's neighbours: for an encoder that tries.
    pub fn edge(&self, x: u32, y: u32, size: u32) -> Edge<S> {
        let blank = S::cut(0);
        let mut edge =
            Edge { x, y, size, above: [blank; 32], cells: [blank; 8], left: [blank; 32], left_cells: [0; 8] };
        let ((n, cells), down) = (edge.lengths(), (y - self.band) as usize);
        for (to, from) in edge.above.iter_mut().zip(self.above.iter().skip(x as usize)).take(n) {
            *to = from.get();
        }
        for (to, from) in edge.cells.iter_mut().zip(self.cells.iter().skip(x as usize >> 2)).take(cells) {
            *to = from.get();
        }
        for (to, from) in edge.left.iter_mut().zip(self.left.iter().skip(down)).take(n) {
            *to = from.get();
        }
        for (to, from) in edge.left_cells.iter_mut().zip(self.left_cells.iter().skip(down >> 2)).take(cells) {
            *to = *from;
        }
        edge
    }

    /// As it was.
    pub fn restore(&mut self, edge: &Edge<S>) {
        let ((n, cells), x, down) = (edge.lengths(), edge.x as usize, (edge.y - self.band) as usize);
        for (from, to) in edge.above.iter().zip(self.above.iter().skip(x)).take(n) {
            to.set(*from);
        }
        for (from, to) in edge.cells.iter().zip(self.cells.iter().skip(x >> 2)).take(cells) {
            to.set(*from);
        }
        for (from, to) in edge.left.iter().zip(self.left.iter().skip(down)).take(n) {
            to.set(*from);
        }
        for (from, to) in edge.left_cells.iter().zip(self.left_cells.iter_mut().skip(down >> 2)).take(cells) {
            *to = *from;
        }
    }
}
