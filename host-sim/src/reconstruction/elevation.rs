//! A grid of elevations: the samples of a grey PNG file, or a square window of them.

use std::io::BufReader;
use std::path::Path;

use png::{BitDepth, ColorType, Decoder, Transformations};

use super::solver::Samples;
use crate::fail::{Fail, say};

/// What missing samples hold: -32768, as elevation models have it, and the greatest number.
const VOIDS: [u16; 2] = [1 << 15, u16::MAX];

/// What becomes of missing samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Voids {
    /// A message, exit code 2
    Refuse,
    /// The mean of the nearest samples that are there
    Fill,
}

/// Elevations as their file has them.
#[derive(Debug)]
pub(crate) struct Elevation {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    values: Vec<u16>,
}

impl Elevation {
    pub(crate) fn read(path: &Path) -> Result<Self, Fail> {
        let refused = |reason: String| Fail::new(format_args!("{}: {reason}", path.display()));
        let file = std::fs::File::open(path).map_err(|error| refused(error.to_string()))?;
        let mut decoder = Decoder::new(BufReader::new(file));
        decoder.set_transformations(Transformations::EXPAND);
        let none =
            |error: png::DecodingError| refused(format!("it is no PNG file that can be read: {error}"));
        let mut png = decoder.read_info().map_err(none)?;
        let mut bytes = vec![0; png.output_buffer_size().unwrap_or(0)];
        let info = png.next_frame(&mut bytes).map_err(none)?;
        if info.color_type != ColorType::Grayscale {
            return Err(refused("elevations are a grey picture, this one has colours".to_owned()));
        }
        let values = if info.bit_depth == BitDepth::Sixteen {
            bytes.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
        } else {
            say(&format!("{}: 8 bits a sample: slopes become terraces", path.display()));
            bytes.iter().map(|byte| u16::from(*byte)).collect()
        };
        Ok(Self { columns: info.width as usize, rows: info.height as usize, values })
    }

    /// The square window with its first row and column, in `[0, 1]`, with its least value and its range.
    pub(crate) fn window(
        &self,
        name: &str,
        [row, column, side]: [usize; 3],
        voids: Voids,
    ) -> Result<(Samples, f64, f64), Fail> {
        let refused = |reason: String| Fail::new(format_args!("{name}: {reason}"));
        if side < 2 {
            return Err(refused(format!("a window of {side} samples a side has no range: 2 are the least")));
        }
        let reaches = |begin: usize, all: usize| begin.checked_add(side).is_none_or(|end| end > all);
        if reaches(row, self.rows) || reaches(column, self.columns) {
            let (rows, columns) = (self.rows, self.columns);
            let reason = format!(
                "--window {row},{column},{side} reaches beyond its {rows} rows and {columns} columns"
            );
            return Err(refused(reason));
        }
        let at = |k: usize| self.values[(row + k / side) * self.columns + column + k % side];
        let mut values: Vec<Option<f64>> = (0..side * side)
            .map(|k| Some(at(k)).filter(|value| !VOIDS.contains(value)).map(f64::from))
            .collect();
        let missing = values.iter().filter(|value| value.is_none()).count();
        if missing > 0 && voids == Voids::Refuse {
            let reason = format!(
                "{missing} samples of the window are missing; --voids fill takes the mean of their neighbours"
            );
            return Err(refused(reason));
        }
        if missing == values.len() {
            return Err(refused("all samples of the window are missing".to_owned()));
        }
        while values.iter().any(Option::is_none) {
            values = filled(&values, side);
        }
        let values: Vec<f64> = values.into_iter().flatten().collect();
        let samples = Samples { side, values };
        let (least, range) = (samples.values.iter().copied().fold(f64::INFINITY, f64::min), samples.range());
        if range <= 0.0 {
            return Err(refused(format!("the window is flat: every sample is {least}")));
        }
        let values = samples.values.iter().map(|value| (value - least) / range).collect();
        Ok((Samples { side, values }, least, range))
    }
}

/// Missing samples that have neighbours become their mean.
fn filled(values: &[Option<f64>], side: usize) -> Vec<Option<f64>> {
    let mean = |k: usize| {
        let (row, column) = (k / side, k % side);
        let near = (row.saturating_sub(1)..(row + 2).min(side))
            .flat_map(|i| (column.saturating_sub(1)..(column + 2).min(side)).map(move |j| i * side + j))
            .filter_map(|place| values[place]);
        let (count, sum) = near.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
        (count > 0.0).then(|| sum / count)
    };
    values.iter().enumerate().map(|(k, value)| value.or_else(|| mean(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_is_cut_out_and_voids_are_filled_or_refused() {
        let mut values: Vec<u16> = (0..20).map(|k| 100 + k).collect();
        values[7] = 1 << 15;
        let grid = Elevation { columns: 5, rows: 4, values };
        let window = |at, voids| grid.window("dem", at, voids);
        let (samples, least, range) = window([2, 1, 2], Voids::Refuse).unwrap();
        assert_eq!((least, range), (111.0, 6.0));
        assert_eq!(samples.values, [0.0, 1.0 / 6.0, 5.0 / 6.0, 1.0]);
        assert!(window([1, 1, 3], Voids::Refuse).is_err() && window([3, 0, 2], Voids::Refuse).is_err());
        let (samples, least, _) = window([0, 1, 3], Voids::Fill).unwrap();
        // the void in the middle is the mean of its eight neighbours, 107
        assert_eq!((least, samples.values[4]), (101.0, 0.5));
        let flat = Elevation { columns: 2, rows: 2, values: vec![7; 4] };
        assert!(flat.window("dem", [0, 0, 2], Voids::Refuse).is_err());
        let none = Elevation { columns: 2, rows: 2, values: vec![u16::MAX; 4] };
        assert!(none.window("dem", [0, 0, 2], Voids::Fill).is_err());
    }
}
