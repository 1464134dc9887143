//! A plane of a picture as an encoder sees it: numbers, with its last column and row repeated up to whole
//! squares.

/// Numbers in rows.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub(super) width: usize,
    pub(super) values: Vec<f32>,
}

impl Samples {
    /// A plane of `width x height` up to whole squares of `side`.
    pub(super) fn new(width: u32, height: u32, side: u32, at: impl Fn(usize) -> f32) -> Self {
        let (w, h) = (width as usize, height as usize);
        let (across, down) = (width.next_multiple_of(side) as usize, height.next_multiple_of(side) as usize);
        let places = (0..down).flat_map(|y| (0..across).map(move |x| y.min(h - 1) * w + x.min(w - 1)));
        Self { width: across, values: places.map(at).collect() }
    }

    /// Half as large, each the mean of four.
    pub(super) fn halved(&self) -> Self {
        let rows: Vec<&[f32]> = self.values.chunks_exact(self.width).collect();
        let pairs = rows.chunks_exact(2);
        let mean = |pair: &[&[f32]], x: usize| {
            0.25 * (pair[0][2 * x] + pair[0][2 * x + 1] + pair[1][2 * x] + pair[1][2 * x + 1])
        };
        let values = pairs.flat_map(|pair| (0..self.width / 2).map(move |x| mean(pair, x))).collect();
        Self { width: self.width / 2, values }
    }

    /// A square, row after row; its mean is taken off and told.
    pub(super) fn square(&self, x: u32, y: u32, side: usize, into: &mut [f32]) -> f32 {
        let start = y as usize * self.width + x as usize;
        for (row, into) in self.values[start..].chunks(self.width).zip(into.chunks_exact_mut(side)).take(side)
        {
            into.copy_from_slice(&row[..side]);
        }
        let square = &mut into[..side * side];
        let mean = square.iter().sum::<f32>() / (side * side) as f32;
        square.iter_mut().for_each(|value| *value -= mean);
        mean
    }
}
