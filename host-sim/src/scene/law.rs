//! The laws of random curves, with the parameters that a scene gives them.

use attractor::Error;
use attractor::curve::{Displacement, Elbow, LineToLine, OneVariable, Part, TwoVariable};
use attractor::num::{Parameter, Real, Unit};
use attractor::plane::Point2;
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// What a file says about its law.
#[derive(Debug)]
pub(super) struct Parameters {
    pub(super) law: Name,
    pub(super) beta: Option<Num>,
    pub(super) deviation: Option<Num>,
    pub(super) offset: Option<Num>,
    pub(super) ratio: Option<Num>,
    pub(super) seed: u64,
}

/// The key `law`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Name {
    Elbow,
    LineToLine,
    OneVariable,
    TwoVariable,
}

/// Any of the laws, with the number that theory needs.
#[derive(Debug, Clone)]
pub(crate) enum Law {
    /// And its spectral exponent.
    Elbow(Elbow, f64),
    /// And its spectral exponent.
    LineToLine(LineToLine, f64),
    OneVariable(OneVariable),
    /// And its offset.
    TwoVariable(TwoVariable, f64),
}

impl Displacement for Law {
    fn check(&self, knots: &[Point2]) -> Result<(), Error> {
        match self {
            Self::Elbow(law, _) => law.check(knots),
            Self::LineToLine(law, _) => law.check(knots),
            Self::OneVariable(law) => law.check(knots),
            Self::TwoVariable(law, _) => law.check(knots),
        }
    }

    fn midpoint(&self, part: &Part) -> Point2 {
        match self {
            Self::Elbow(law, _) => law.midpoint(part),
            Self::LineToLine(law, _) => law.midpoint(part),
            Self::OneVariable(law) => law.midpoint(part),
            Self::TwoVariable(law, _) => law.midpoint(part),
        }
    }
}

impl Law {
    /// The knot that makes `to` the midpoint between `from` and it; none for a law that is not Carpenter's.
    pub(super) fn extrapolated(
        &self,
        from: Point2,
        to: Point2,
        at: Parameter,
    ) -> Option<Result<Point2, Error>> {
        match self {
            Self::Elbow(..) => None,
            Self::LineToLine(law, _) => Some(law.extrapolated(from, to, at)),
            Self::OneVariable(law) => Some(law.extrapolated(from, to, at)),
            Self::TwoVariable(law, _) => Some(law.extrapolated(from, to, at)),
        }
    }
}

/// A law by its numbers: all that firmware needs to make it again.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Recipe {
    /// The deviation; none: self-similar.
    Elbow {
        deviation: Option<Unit>,
        beta: Real,
    },
    LineToLine {
        offset: Unit,
        beta: Real,
    },
    OneVariable {
        offset: Unit,
    },
    /// The one-variable law of this similarity ratio.
    OfRatio {
        ratio: Real,
    },
    TwoVariable {
        offset: Unit,
    },
}

impl Recipe {
    fn law(self, seed: u64) -> Result<Law, Error> {
        match self {
            Self::Elbow { deviation: None, beta } => {
                Elbow::self_similar(beta, seed).map(|law| Law::Elbow(law, beta.to_num()))
            }
            Self::Elbow { deviation: Some(deviation), beta } => {
                Elbow::new(deviation, beta, seed).map(|law| Law::Elbow(law, beta.to_num()))
            }
            Self::LineToLine { offset, beta } => {
                LineToLine::from_spectrum(offset, beta, seed).map(|law| Law::LineToLine(law, beta.to_num()))
            }
            Self::OneVariable { offset } => OneVariable::new(offset, seed).map(Law::OneVariable),
            Self::OfRatio { ratio } => OneVariable::from_ratio(ratio, seed).map(Law::OneVariable),
            Self::TwoVariable { offset } => {
                TwoVariable::new(offset, seed).map(|law| Law::TwoVariable(law, offset.to_num()))
            }
        }
    }
}

/// The law with its parameters; those of other laws are refused.
pub(super) fn law(source: &Source, file: &Parameters) -> Result<(Law, Recipe), Fail> {
    let (name, allowed) = match file.law {
        Name::Elbow => ("elbow", &["beta", "deviation"][..]),
        Name::LineToLine => ("line-to-line", &["beta", "offset"][..]),
        Name::OneVariable => ("one-variable", &["ratio", "offset"][..]),
        Name::TwoVariable => ("two-variable", &["offset"][..]),
    };
    let given = [
        ("beta", &file.beta),
        ("deviation", &file.deviation),
        ("offset", &file.offset),
        ("ratio", &file.ratio),
    ];
    for (key, number) in given {
        if let Some(number) = number.as_ref().filter(|_| !allowed.contains(&key)) {
            let reason = format!("the law {name} takes {}", allowed.join(" and "));
            return Err(source.fail(number.span(), key, reason));
        }
    }
    if let (Some(ratio), Some(_)) = (&file.ratio, &file.offset) {
        return Err(source.fail(ratio.span(), "ratio", "an offset is given as well"));
    }
    let real = |number: &Option<Num>, key: &str, otherwise: Real| {
        number.as_ref().map_or(Ok(otherwise), |n| source.fixed::<Real>(n, key))
    };
    let unit = |number: &Option<Num>, key: &str, otherwise: Unit| {
        number.as_ref().map_or(Ok(otherwise), |n| source.fixed::<Unit>(n, key))
    };
    // which of the numbers a law refuses
    let refused = |error: Error| {
        let key = match error {
            Error::OutOfRange { what: "beta", .. } => "beta",
            Error::OutOfRange { what: "similarity ratio", .. } => "ratio",
            _ if file.law == Name::Elbow => "deviation",
            _ => "offset",
        };
        let number = given.iter().find(|(k, _)| *k == key).and_then(|(_, number)| number.as_ref());
        source.fail(number.map_or(0..0, Spanned::span), key, error)
    };
    let offset = unit(&file.offset, "offset", Unit::lit("0.3"))?;
    let recipe = match file.law {
        Name::Elbow => {
            let deviation = &file.deviation;
            let deviation = deviation.as_ref().map(|n| source.fixed::<Unit>(n, "deviation")).transpose()?;
            Recipe::Elbow { deviation, beta: real(&file.beta, "beta", Real::lit("2"))? }
        }
        Name::LineToLine => Recipe::LineToLine { offset, beta: real(&file.beta, "beta", Real::lit("3"))? },
        Name::OneVariable => match &file.ratio {
            None => Recipe::OneVariable { offset },
            Some(ratio) => Recipe::OfRatio { ratio: source.fixed::<Real>(ratio, "ratio")? },
        },
        Name::TwoVariable => Recipe::TwoVariable { offset },
    };
    Ok((recipe.law(file.seed).map_err(refused)?, recipe))
}
