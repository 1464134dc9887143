//! A digital elevation model as given heights: a PNG file of 16 grey bits, or a window of it.

use std::io::{BufRead, BufReader, Cursor, Seek};

use attractor::num::Real;
use png::{BitDepth, ColorType, Decoder};
use serde::Deserialize;
use toml::Spanned;

use crate::builtin;
use crate::fail::Fail;
use crate::source::{Num, Source};

/// The table `[elevation]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// Relative to the scene.
    png: Spanned<String>,
    /// Column and row of the north-west corner, columns, rows; all of it without.
    window: Option<Spanned<[u32; 4]>>,
    /// The elevation that becomes height 0, and how much height one step of elevation is.
    base: Option<Num>,
    step: Num,
    /// The value that says that nothing is known.
    void: Option<Spanned<u16>>,
    voids: Option<Spanned<Voids>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Voids {
    Refuse,
    Fill,
}

/// The most samples a side of a window: every one is a knot.
const MOST: u32 = 1025;

/// What a file holds: columns, rows, and samples row by row from north to south.
struct Samples {
    size: (u32, u32),
    values: Vec<u16>,
    is_coarse: bool,
}

impl Table {
    /// Columns, and heights row by row from south to north.
    pub(super) fn read(&self, source: &Source) -> Result<(u32, Vec<Real>), Fail> {
        let refused = |reason: String| source.fail(self.png.span(), "elevation.png", reason);
        let samples = match (source.beside(self.png.get_ref()), builtin::bytes(self.png.get_ref())) {
            (Some(path), _) => {
                let file = std::fs::File::open(path).map_err(|error| refused(error.to_string()))?;
                decoded(BufReader::new(file))
            }
            (None, Some(bytes)) => decoded(Cursor::new(bytes)),
            (None, None) => Err("no such elevations are built in".to_owned()),
        };
        let samples = samples.map_err(refused)?;
        if samples.is_coarse {
            let note = "8 bits a sample: the land will have terraces; elevations want 16";
            source.note(self.png.span(), "elevation.png", note);
        }
        let (columns, rows) = samples.size;
        let window = match &self.window {
            None => [0, 0, columns, rows],
            Some(window) => {
                let [x, y, wide, high] = *window.get_ref();
                let fits = |from: u32, count: u32, all: u32| {
                    count >= 2 && from.checked_add(count).is_some_and(|end| end <= all)
                };
                if !fits(x, wide, columns) || !fits(y, high, rows) {
                    let reason = format!(
                        "[column, row, columns, rows] of a part of {columns} x {rows} samples, 2 x 2 at least"
                    );
                    return Err(source.fail(window.span(), "elevation.window", reason));
                }
                *window.get_ref()
            }
        };
        let [x, y, wide, high] = window;
        if wide < 2 || high < 2 || wide > MOST || high > MOST {
            let reason =
                format!("{wide} x {high} samples, allowed is 2 to {MOST} a side; a window takes a part");
            return Err(refused(reason));
        }
        let mut values = Vec::new();
        for row in (y..y + high).rev() {
            let from = (row * columns + x) as usize;
            values.extend_from_slice(&samples.values[from..from + wide as usize]);
        }
        let known = self.filled(source, &values, (wide, high), window)?;
        let (base, step) = (self.base.as_ref(), crate::number::float(source.digits(&self.step)));
        let base = base.map_or(0.0, |base| crate::number::float(source.digits(base)));
        let height = |value: &f64| {
            let height = (value - base) * step;
            Real::checked_from_num(height).filter(|h| h.to_bits().unsigned_abs() < 64 << 24).ok_or_else(
                || {
                    let reason = format!("elevation {value} becomes {height}, allowed is -64 to 64");
                    source.fail(self.step.span(), "elevation.step", reason)
                },
            )
        };
        Ok((wide, known.iter().map(height).collect::<Result<_, _>>()?))
    }

    /// The values as numbers, voids refused by their place or filled from what surrounds them.
    fn filled(
        &self,
        source: &Source,
        values: &[u16],
        (wide, high): (u32, u32),
        [x, y, ..]: [u32; 4],
    ) -> Result<Vec<f64>, Fail> {
        let void = self.void.as_ref().map(|void| *void.get_ref());
        let mut known: Vec<Option<f64>> =
            values.iter().map(|value| (Some(*value) != void).then_some(f64::from(*value))).collect();
        let Some(first) = known.iter().position(Option::is_none) else {
            return Ok(known.into_iter().flatten().collect());
        };
        let count = known.iter().filter(|value| value.is_none()).count();
        let policy = self.voids.as_ref().map_or(Voids::Refuse, |voids| *voids.get_ref());
        let (column, row) = (x + first as u32 % wide, y + high - 1 - first as u32 / wide);
        let span = self.void.as_ref().map_or(0..0, Spanned::span);
        if policy == Voids::Refuse {
            let reason = format!(
                "{count} samples are void, one at column {column}, row {row}: say voids = \"fill\" or choose another window"
            );
            return Err(source.fail(span, "elevation.void", reason));
        }
        if count == known.len() {
            return Err(source.fail(
                span,
                "elevation.void",
                "all samples are void: there is nothing to fill from",
            ));
        }
        // from the rim inwards, each the mean of those known beside it
        while known.contains(&None) {
            let before = known.clone();
            for (at, value) in known.iter_mut().enumerate().filter(|(_, value)| value.is_none()) {
                let (i, wide) = (at % wide as usize, wide as usize);
                let beside = [
                    (i > 0).then(|| at - 1),
                    (i + 1 < wide).then_some(at + 1),
                    at.checked_sub(wide),
                    Some(at + wide),
                ];
                let beside = beside.into_iter().flatten();
                let beside: Vec<f64> = beside.filter_map(|k| before.get(k).copied().flatten()).collect();
                if !beside.is_empty() {
                    *value = Some(beside.iter().sum::<f64>() / beside.len() as f64);
                }
            }
        }
        source.note(span, "elevation.void", &format!("{count} samples filled from what surrounds them"));
        Ok(known.into_iter().flatten().collect())
    }
}

/// The grey samples of a PNG file.
fn decoded(reader: impl BufRead + Seek) -> Result<Samples, String> {
    let none = |error: png::DecodingError| format!("it is no PNG file that can be read: {error}");
    let mut png = Decoder::new(reader).read_info().map_err(none)?;
    let size = png.info().size();
    if u64::from(size.0) * u64::from(size.1) > 1 << 26 {
        return Err(format!("{} x {} samples are too many", size.0, size.1));
    }
    let mut bytes = vec![0; png.output_buffer_size().unwrap_or(0)];
    let info = png.next_frame(&mut bytes).map_err(none)?;
    bytes.truncate(info.buffer_size());
    let values = match (info.color_type, info.bit_depth) {
        (ColorType::Grayscale, BitDepth::Sixteen) => bytes
            .chunks(2)
            .map(|pair| pair.iter().fold(0, |value, byte| value << 8 | u16::from(*byte)))
            .collect(),
        (ColorType::Grayscale, BitDepth::Eight) => bytes.iter().map(|byte| u16::from(*byte)).collect(),
        (color, depth) => {
            return Err(format!("elevations are grey with 16 bits or 8, this is {color:?}, {depth:?}"));
        }
    };
    Ok(Samples { size, values, is_coarse: info.bit_depth == BitDepth::Eight })
}
