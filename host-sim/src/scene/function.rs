//! A fractal interpolation function of a scene file, in fixed point and as the reference: knots, vertical
//! scalings, polynomials, integrals.

use attractor::Error;
use attractor::fif::{Fif, Knot};
use attractor::num::{Scaling, Wide};
use attractor_reference as reference;
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::number;
use crate::source::{Num, Source};

/// Room for maps and for the degree of their polynomials.
pub(super) const MAPS: usize = 512;
pub(super) const DEGREE: usize = 8;
pub(crate) type Fixed = Fif<MAPS, DEGREE>;

/// The keys of a function.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    pub(super) knots: Spanned<Vec<Spanned<[Num; 2]>>>,
    pub(super) vertical_scaling: Spanned<Vec<Num>>,
    pub(super) polynomials: Option<Spanned<Vec<Spanned<Vec<Num>>>>>,
    pub(super) integrate: Option<Spanned<u32>>,
}

/// A function twice: as the kernel has it, and as the reference has it.
#[derive(Debug)]
pub(crate) struct Function {
    pub(crate) fixed: Box<Fixed>,
    pub(super) reference: reference::Fif,
    /// What it was made of.
    pub(crate) parts: Parts,
}

/// What a function is made of: all that firmware needs to make it again.
#[derive(Debug, PartialEq)]
pub(crate) struct Parts {
    pub(crate) knots: Vec<Knot>,
    pub(crate) scalings: Vec<Scaling>,
    /// Coefficients in x, constant first; none: the maps are affine.
    pub(crate) polynomials: Option<Vec<Vec<Wide>>>,
    /// How often it is integrated afterwards.
    pub(crate) integrate: u32,
}

impl Description {
    /// Compiles it; `prefix` stands before the keys in messages.
    pub(super) fn compile(&self, source: &Source, prefix: &str) -> Result<Function, Fail> {
        let key = |name: &str| format!("{prefix}{name}");
        let mut knots = Vec::new();
        for (i, knot) in self.knots.get_ref().iter().enumerate() {
            let [x, y] = source.pair::<Wide>(knot.get_ref(), &key(&format!("knots[{i}]")))?;
            knots.push(Knot::new(x, y));
        }
        let mut scalings = Vec::new();
        for (i, scaling) in self.vertical_scaling.get_ref().iter().enumerate() {
            let name = key(&format!("vertical_scaling[{i}]"));
            let value = source.fixed::<Scaling>(scaling, &name).ok().filter(|s| *s > Scaling::MIN);
            let value = value.ok_or_else(|| {
                source.fail(scaling.span(), &name, "a vertical scaling lies strictly between -1 and 1")
            })?;
            scalings.push(value);
        }
        let polynomials = self.polynomials.as_ref();
        let rows = polynomials.map(|rows| self.coefficients(source, &key("polynomials"), rows.get_ref()));
        let rows = rows.transpose()?;
        let fixed = match &rows {
            None => Fixed::interpolating(&knots, &scalings),
            Some(rows) => {
                let rows: Vec<&[Wide]> = rows.iter().map(Vec::as_slice).collect();
                let x: Vec<Wide> = knots.iter().map(|k| k.x).collect();
                Fixed::from_polynomials(&x, &scalings, &rows)
            }
        };
        let mut fixed = fixed.map_err(|error| self.explain(source, prefix, error))?;
        self.check_ordinates(source, prefix, &knots, &fixed)?;
        self.check_abscissae(source, prefix, &knots)?;
        let mut reference = self.reference(source, &knots, rows.as_deref());
        let times = self.integrate.as_ref().map_or(0, |times| *times.get_ref());
        for _ in 0..times {
            fixed = fixed.integral(Wide::ZERO).map_err(|error| {
                let span = self.integrate.as_ref().map_or(0..0, Spanned::span);
                source.fail(span, &key("integrate"), error)
            })?;
            reference = reference.integral(0.0);
        }
        let parts = Parts { knots, scalings, polynomials: rows, integrate: times };
        Ok(Function { fixed: Box::new(fixed), reference, parts })
    }

    fn coefficients(
        &self,
        source: &Source,
        key: &str,
        polynomials: &[Spanned<Vec<Num>>],
    ) -> Result<Vec<Vec<Wide>>, Fail> {
        let row = |(i, row): (usize, &Spanned<Vec<Num>>)| -> Result<Vec<Wide>, Fail> {
            if row.get_ref().len() > DEGREE + 1 {
                let reason = format!("at most {} coefficients, constant first", DEGREE + 1);
                return Err(source.fail(row.span(), &format!("{key}[{i}]"), reason));
            }
            let number = |(k, c): (usize, &Num)| source.fixed(c, &format!("{key}[{i}][{k}]"));
            row.get_ref().iter().enumerate().map(number).collect()
        };
        polynomials.iter().enumerate().map(row).collect()
    }

    /// With polynomials the maps decide where the graph passes: the knots of the file must say the same.
    fn check_ordinates(
        &self,
        source: &Source,
        prefix: &str,
        knots: &[Knot],
        fixed: &Fixed,
    ) -> Result<(), Fail> {
        const TOLERANCE: Wide = Wide::lit("0x1p-20");
        for (i, (given, got)) in knots.iter().zip(fixed.knots()).enumerate() {
            if given.y.saturating_sub(got.y).abs() > TOLERANCE {
                let span = self.knots.get_ref().get(i).map_or(0..0, Spanned::span);
                let reason = format!("the polynomials make its ordinate {:.6}", got.y);
                return Err(source.fail(span, &format!("{prefix}knots[{i}]"), reason));
            }
        }
        Ok(())
    }

    /// Knots that differ in the format may be one and the same `f64`, of which the reference could make
    /// nothing.
    fn check_abscissae(&self, source: &Source, prefix: &str, knots: &[Knot]) -> Result<(), Fail> {
        for (i, pair) in knots.windows(2).enumerate() {
            if let [a, b] = pair
                && a.x.to_num::<f64>() >= b.x.to_num::<f64>()
            {
                let reason = "its abscissa is the same f64 as that of its neighbour";
                let span = self.knots.get_ref().get(i + 1).map_or(0..0, Spanned::span);
                return Err(source.fail(span, &format!("{prefix}knots[{}]", i + 1), reason));
            }
        }
        Ok(())
    }

    /// The same in `f64`, through the knots that the kernel has: beside a decimal number that the format does
    /// not have, a rough function is another one. Scalings are the file's decimal numbers; the fixed-point
    /// function has checked everything.
    fn reference(&self, source: &Source, knots: &[Knot], rows: Option<&[Vec<Wide>]>) -> reference::Fif {
        let float = |n: &Num| number::float(source.digits(n));
        let scalings: Vec<f64> = self.vertical_scaling.get_ref().iter().map(float).collect();
        let knots = knots.iter().map(|knot| (knot.x.to_num::<f64>(), knot.y.to_num::<f64>()));
        match rows {
            None => reference::Fif::interpolating(&knots.collect::<Vec<_>>(), &scalings),
            Some(rows) => {
                let maps = scalings.iter().zip(rows).map(|(&vertical_scaling, q)| reference::Map {
                    vertical_scaling,
                    q: q.iter().map(|c| c.to_num()).collect(),
                });
                let x: Vec<f64> = knots.map(|knot| knot.0).collect();
                reference::Fif::from_polynomials(&x, maps.collect())
            }
        }
    }

    /// The kernel's error with the place that it is about.
    fn explain(&self, source: &Source, prefix: &str, error: Error) -> Fail {
        let knot = |index: usize| self.knots.get_ref().get(index).map_or(self.knots.span(), Spanned::span);
        match error {
            Error::NotIncreasing { index, .. } => {
                let reason =
                    format!("its abscissa is not to the right of that of knot {}", index.saturating_sub(1));
                source.fail(knot(index), &format!("{prefix}knots[{index}]"), reason)
            }
            Error::NotJoined { knot: index } => {
                source.fail(knot(index), &format!("{prefix}knots[{index}]"), error)
            }
            Error::OutOfRange { what: "y of knot", index: Some(index), .. } => {
                source.fail(knot(index), &format!("{prefix}knots[{index}]"), error)
            }
            Error::TooFew { .. } | Error::Capacity { what: "maps", .. } => {
                source.fail(self.knots.span(), &format!("{prefix}knots"), error)
            }
            Error::LengthMismatch { what: "polynomials", .. } => {
                let span = self.polynomials.as_ref().map_or(0..0, Spanned::span);
                source.fail(span, &format!("{prefix}polynomials"), error)
            }
            _ => source.fail(self.vertical_scaling.span(), &format!("{prefix}vertical_scaling"), error),
        }
    }
}
