//! Knots from a table of measurements, and the vertical scalings that suit it best.
//!
//! For the interval `j` of width `h` between two knots the data suggest the parabola
//! `rho(t) = -t (1 - t) / 2 * h^2 c` above the chord, `c` the mean of the second divided differences at both
//! ends. The map `F_j` sends the whole graph there: above the chord it puts `alpha_j r`, `r` the data above
//! their own chord from first to last. Least squares over the data's own abscissae give
//! `alpha_j = sum r rho(t) / sum r^2` in closed form.

use attractor::num::{Scaling, Wide};
use csv::{ReaderBuilder, Trim};
use serde::Deserialize;
use toml::Spanned;

use crate::fail::{Fail, shortened};
use crate::lines::line_of;
use crate::number;
use crate::source::{Num, Source};

/// Fitted scalings stay at or below this.
const STEEPEST: f64 = 0.95;

/// The table `[data]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    /// A file with a header line and values separated by commas, relative to the scene.
    csv: Spanned<String>,
    /// Names of the columns.
    x: Spanned<String>,
    y: Spanned<String>,
    /// Ordinates are divided by this: values of the kernel end at 128.
    y_unit: Option<Num>,
}

impl Table {
    /// Its points; both coordinates are multiples of `2^-48`, and in order.
    pub(super) fn read(&self, source: &Source) -> Result<Vec<(Wide, Wide)>, Fail> {
        let unit = match &self.y_unit {
            Some(unit) => {
                let value = source.fixed::<Wide>(unit, "data.y_unit")?;
                if value <= 0 {
                    return Err(source.fail(unit.span(), "data.y_unit", "a unit is positive"));
                }
                number::float(source.digits(unit))
            }
            None => 1.0,
        };
        let (name, text) = source.data(&self.csv, "csv")?;
        let malformed = |error: csv::Error| Fail::new(format_args!("{name}: {error}"));
        let mut table = ReaderBuilder::new().flexible(true).trim(Trim::All).from_reader(text.as_bytes());
        let header = table.headers().map_err(malformed)?.clone();
        let column = |key: &str, title: &Spanned<String>| {
            header.iter().position(|t| t == title.get_ref().as_str()).ok_or_else(|| {
                let columns: Vec<String> = header.iter().map(shortened).collect();
                source.fail(title.span(), key, format!("{name} has the columns {}", columns.join(", ")))
            })
        };
        let (x, y) = (column("data.x", &self.x)?, column("data.y", &self.y)?);
        let mut points: Vec<(Wide, Wide)> = Vec::new();
        for row in table.records() {
            let row = row.map_err(malformed)?;
            if row.iter().all(str::is_empty) {
                continue;
            }
            let cell = |column: usize| row.get(column).unwrap_or("");
            let fail = |column: usize, reason: &str| {
                let (title, value) = (header.get(column).unwrap_or(""), shortened(cell(column)));
                let line = line_of(&text, row.position());
                Fail::new(format_args!("{name}:{line}: {} = {value}: {reason}", shortened(title)))
            };
            let abscissa = number::nearest::<Wide>(cell(x)).map_err(|reason| fail(x, &reason))?;
            number::nearest::<Wide>(cell(y)).map_err(|reason| fail(y, &reason))?;
            let ordinate = Wide::checked_from_num(number::float(cell(y)) / unit)
                .filter(|v| v.abs() < 128)
                .ok_or_else(|| fail(y, "over y_unit it leaves the format, allowed is -128 to 128"))?;
            if points.last().is_some_and(|last| last.0 >= abscissa) {
                return Err(fail(x, "abscissae increase from line to line"));
            }
            points.push((abscissa, ordinate));
        }
        if points.len() < 3 {
            return Err(source.fail(self.csv.span(), "data.csv", "at least 3 lines of data are needed"));
        }
        Ok(points)
    }
}

/// The vertical scaling of each map by least squares.
pub(super) fn fitted(points: &[(Wide, Wide)]) -> Vec<Scaling> {
    let points: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.to_num(), y.to_num())).collect();
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    // place in the whole, height above the whole chord
    let whole = points.iter().map(|(x, y)| {
        let t = (x - first.0) / (last.0 - first.0);
        (t, y - (first.1 + t * (last.1 - first.1)))
    });
    let whole: Vec<(f64, f64)> = whole.collect();
    // the sums for rho(t) = -t (1 - t) / 2
    let product: f64 = whole.iter().map(|(t, r)| -r * t * (1.0 - t) / 2.0).sum();
    let square: f64 = whole.iter().map(|(_, r)| r * r).sum();
    let bend = |k: usize| -> Option<f64> {
        let [a, b, c] = [points.get(k.checked_sub(1)?)?, points.get(k)?, points.get(k + 1)?];
        let slope = |p: &(f64, f64), q: &(f64, f64)| (q.1 - p.1) / (q.0 - p.0);
        Some(2.0 * (slope(b, c) - slope(a, b)) / (c.0 - a.0))
    };
    let alpha = |(j, pair): (usize, &[(f64, f64)])| {
        let width = match pair {
            [a, b] => b.0 - a.0,
            _ => 0.0,
        };
        let bends: Vec<f64> = [bend(j), bend(j + 1)].into_iter().flatten().collect();
        let mean = bends.iter().sum::<f64>() / bends.len().max(1) as f64;
        let alpha = if square > 0.0 { product * mean * width * width / square } else { 0.0 };
        Scaling::from_num(alpha.clamp(-STEEPEST, STEEPEST))
    };
    points.windows(2).enumerate().map(alpha).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_its_own_copy_a_quarter_as_high() {
        // y = x (4 - x) / 4 on 0..4 in unit steps: half the domain is a parabola a quarter as high, a quarter
        // one of a sixteenth
        let point = |x: i32| (Wide::from_num(x), Wide::from_num(x * (4 - x)) / 4);
        let scalings = fitted(&(0..=4).map(point).collect::<Vec<_>>());
        assert_eq!(scalings.len(), 4);
        assert!(scalings.iter().all(|s| (s.to_num::<f64>() - 1.0 / 16.0).abs() < 1e-9), "{scalings:?}");
    }

    #[test]
    fn wild_data_are_clipped_and_a_line_has_no_bends() {
        let point = |x: i32, y: f64| (Wide::from_num(x), Wide::from_num(y));
        let line: Vec<_> = (0..9).map(|x| point(x, f64::from(x))).collect();
        assert!(fitted(&line).iter().all(|s| *s == Scaling::ZERO));
        let wild = [
            point(0, 0.0),
            point(1, 0.01),
            point(2, 0.0),
            point(3, 100.0),
            point(4, 0.0),
            point(5, 0.01),
            point(6, 0.0),
        ];
        assert!(fitted(&wild).iter().all(|s| s.to_num::<f64>().abs() <= STEEPEST));
    }
}
