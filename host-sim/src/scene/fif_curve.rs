//! `kind = "fif-curve"`: the graph of a fractal interpolation function, figures 1 to 3, and data.

use std::convert::Infallible;

use attractor::fif::{Cell, Pyramid};
use attractor::num::Wide;
use attractor_gallery::{CELLS_ACROSS, Chart, Watch, depth_for};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::data::{self, Table};
use super::function::{Description, Fixed, Function, Parts};
use super::graph::Graph;
use super::request::Request;
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    knots: Option<Spanned<Vec<Spanned<[Num; 2]>>>>,
    vertical_scaling: Option<Spanned<Vec<Num>>>,
    polynomials: Option<Spanned<Vec<Spanned<Vec<Num>>>>>,
    integrate: Option<Spanned<u32>>,
    contractions: Option<Spanned<Vec<Spanned<u32>>>>,
    data: Option<Spanned<Table>>,
    palette: Option<Named>,
}

/// A curve ready to be drawn.
#[derive(Debug)]
pub(crate) struct FifCurve {
    pub(crate) function: Function,
    /// Maps by index from 0, the outermost first.
    pub(crate) contractions: Vec<usize>,
    pub(crate) palette: Named,
    /// What it passes through.
    place: Place,
}

impl FifCurve {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let palette = file.palette.unwrap_or(Named::Ocean);
        let contractions = file.contractions;
        let place = match (&file.data, &file.knots) {
            (Some(table), _) => source.place(table.span(), "data"),
            (None, knots) => source.place(knots.as_ref().map_or(0..0, Spanned::span), "knots"),
        };
        let function = match (file.data, file.knots, file.vertical_scaling) {
            (Some(table), None, None) if file.polynomials.is_none() && file.integrate.is_none() => {
                from_data(source, &table)?
            }
            (Some(table), ..) => {
                let reason =
                    "a table of data stands in place of knots, vertical_scaling, polynomials and integrate";
                return Err(source.fail(table.span(), "data", reason));
            }
            (None, Some(knots), Some(vertical_scaling)) => {
                let (polynomials, integrate) = (file.polynomials, file.integrate);
                Description { knots, vertical_scaling, polynomials, integrate }.compile(source, "")?
            }
            (None, None, _) => return Err(source.fail_all("knots", "missing, or a table [data]")),
            (None, _, None) => return Err(source.fail_all("vertical_scaling", "missing")),
        };
        let maps = function.fixed.maps();
        let mut indices = Vec::new();
        for (i, map) in contractions.iter().flat_map(|list| list.get_ref()).enumerate() {
            match usize::try_from(*map.get_ref()) {
                Ok(number) if (1..=maps).contains(&number) => indices.push(number - 1),
                _ => {
                    let reason = format!("maps are numbered 1 to {maps}");
                    return Err(source.fail(map.span(), &format!("contractions[{i}]"), reason));
                }
            }
        }
        if let Some(list) = contractions.filter(|list| list.get_ref().len() > 16) {
            return Err(source.fail(list.span(), "contractions", "at most 16 are shown"));
        }
        Ok(Self { function, contractions: indices, palette, place })
    }

    /// What measurements need of it.
    pub(super) fn graph(&self) -> Graph<'_> {
        Graph::of_function(&self.function)
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let fif = &self.function.fixed;
        let mut cells = vec![Cell::ZERO; Pyramid::cells(fif.maps(), depth_for(fif.maps(), CELLS_ACROSS))];
        let mut columns = vec![0; request.size.width as usize];
        Chart::new(fif, request.size, &self.contractions, self.palette, &mut cells)
            .and_then(|chart| chart.draw(target, &mut columns, watch))
            .map_err(|error| self.place.fail_at(request.size, error))
    }

    /// `x,fixed,reference,error` at `points` equally spaced abscissae, first and last knot included.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        out.write_record(["x", "fixed", "reference", "error"])?;
        let (from, to) = self.function.fixed.domain();
        for i in 0..points {
            let x = abscissa(from, to, i, points);
            let fixed = self.function.fixed.at(x);
            let reference = self.function.reference.at(x.to_num());
            let error = fixed.to_num::<f64>() - reference;
            let (reference, error) = (format!("{reference:?}"), format!("{error:?}"));
            out.write_record([exact(x), exact(fixed), reference, error])?;
        }
        Ok(())
    }
}

/// A function through all points of a table, its scalings fitted.
fn from_data(source: &Source, table: &Spanned<Table>) -> Result<Function, Fail> {
    let points = table.get_ref().read(source)?;
    let scalings = data::fitted(&points);
    let knots: Vec<_> = points.iter().map(|(x, y)| attractor::fif::Knot::new(*x, *y)).collect();
    let fixed =
        Fixed::interpolating(&knots, &scalings).map_err(|error| source.fail(table.span(), "data", error))?;
    let parts = Parts { knots, scalings: scalings.clone(), polynomials: None, integrate: 0 };
    let knots: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.to_num(), y.to_num())).collect();
    let scalings: Vec<f64> = scalings.iter().map(|s| s.to_num()).collect();
    let reference = attractor_reference::Fif::interpolating(&knots, &scalings);
    Ok(Function { fixed: Box::new(fixed), reference, parts })
}

/// `from + i (to - from) / (points - 1)`, rounded to a multiple of `2^-48` and, beyond 32, to the 53 bits of
/// the `f64` that the reference takes.
pub(super) fn abscissa(from: Wide, to: Wide, i: u32, points: u32) -> Wide {
    // the ends are exact, whatever an f64 makes of them
    if i == 0 || i + 1 >= points.max(2) {
        return if i == 0 { from } else { to };
    }
    let steps = i128::from(points.max(2) - 1);
    let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
    let offset = (2 * i128::from(i) * width + steps).div_euclid(2 * steps);
    let x = Wide::from_bits((i128::from(from.to_bits()) + offset) as i64);
    Wide::saturating_from_num(x.to_num::<f64>()).clamp(from, to)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn abscissae_are_numbers_of_both_formats_and_reach_both_ends() {
        let (from, to) = (Wide::from_num(1700), Wide::from_num(2008));
        let all: Vec<Wide> = (0..1000).map(|i| abscissa(from, to, i, 1000)).collect();
        assert_eq!((all[0], all[999]), (from, to));
        assert!(all.iter().all(|x| Wide::from_num(x.to_num::<f64>()) == *x));
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
        let third = abscissa(Wide::ZERO, Wide::ONE, 1, 4);
        assert_eq!(third.to_bits(), ((1_i64 << 48) + 1) / 3);
        assert_eq!(abscissa(from, to, 0, 1), from);
    }
}
