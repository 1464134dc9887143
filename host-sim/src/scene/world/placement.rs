//! Where a thing stands: `scale`, then `rotate`, then `translate`, or the 12 numbers of a `matrix`.

use std::fmt;
use std::ops::Range;

use attractor::Error;
use attractor::num::{Angle, Real, Vec3, Wide};
use serde::de::{Deserialize, Deserializer, SeqAccess, Visitor};
use toml::Spanned;

use super::super::standpoint::vector;
use crate::fail::Fail;
use crate::number::Number;
use crate::source::{Num, Source};

/// A number for all axes, or one for each.
#[derive(Debug, Clone)]
pub(super) enum Scale {
    All(Number),
    Each(Vec<Num>),
}

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Scale;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or [x, y, z]")
            }
            fn visit_f64<E>(self, _: f64) -> Result<Scale, E> {
                Ok(Scale::All(Number::Plain))
            }
            fn visit_i64<E>(self, _: i64) -> Result<Scale, E> {
                Ok(Scale::All(Number::Plain))
            }
            fn visit_str<E>(self, text: &str) -> Result<Scale, E> {
                Ok(Scale::All(Number::Text(text.trim().to_owned())))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Scale, A::Error> {
                let mut all = Vec::new();
                while let Some(part) = parts.next_element()? {
                    all.push(part);
                }
                Ok(Scale::Each(all))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// A step on the way from the shape's own coordinates into the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Step {
    Scale(Vec3),
    /// About an axis, counterclockwise as seen from its end.
    Rotate {
        axis: Vec3,
        angle: Angle,
    },
    Translate(Vec3),
    /// Row by row.
    Matrix([[Wide; 4]; 3]),
}

/// The keys of a placement, as a table has them.
#[derive(Debug)]
pub(super) struct Keys<'a> {
    pub(super) scale: Option<&'a Spanned<Scale>>,
    pub(super) rotate: Option<&'a Spanned<Vec<Spanned<Vec<Num>>>>>,
    pub(super) translate: Option<&'a Spanned<[Num; 3]>>,
    pub(super) matrix: Option<&'a Spanned<Vec<Num>>>,
}

impl Keys<'_> {
    /// The steps, the first one first; none where a thing stays as it is.
    pub(super) fn compile(&self, source: &Source, prefix: &str) -> Result<Vec<Step>, Fail> {
        let key = |name: &str| format!("{prefix}{name}");
        if let Some(matrix) = self.matrix {
            let others = self.scale.is_some() || self.rotate.is_some() || self.translate.is_some();
            if others {
                let reason = "a matrix stands alone, without translate, rotate and scale";
                return Err(source.fail(matrix.span(), &key("matrix"), reason));
            }
            return Ok(vec![Step::Matrix(rows(source, matrix, &key("matrix"))?)]);
        }
        let mut steps = Vec::new();
        if let Some(scale) = self.scale {
            steps.push(Step::Scale(factors(source, scale, &key("scale"))?));
        }
        for (i, turn) in self.rotate.map_or(&[][..], |turns| turns.get_ref()).iter().enumerate() {
            steps.push(rotation(source, turn, &key(&format!("rotate[{i}]")))?);
        }
        if let Some(translate) = self.translate {
            steps.push(Step::Translate(vector(source, translate, &key("translate"))?));
        }
        Ok(steps)
    }

    /// What a complaint about the whole placement points at: where the thing is, or how it was made larger.
    pub(super) fn span(&self, prefix: &str, error: &Error) -> Option<(Range<usize>, String)> {
        let is_place = matches!(error, Error::OutOfRange { what: "place of a shape", .. });
        let named = |span, name: &str| (span, format!("{prefix}{name}"));
        let translate = self.translate.map(|translate| named(translate.span(), "translate"));
        let scale = self.scale.map(|scale| named(scale.span(), "scale"));
        let matrix = self.matrix.map(|matrix| named(matrix.span(), "matrix"));
        matrix.or(if is_place { translate.or(scale) } else { scale.or(translate) })
    }
}

fn rows(source: &Source, matrix: &Spanned<Vec<Num>>, key: &str) -> Result<[[Wide; 4]; 3], Fail> {
    let given = matrix.get_ref();
    if given.len() != 12 {
        let reason = format!("{} numbers, a matrix has 12: three rows of x, y, z and 1", given.len());
        return Err(source.fail(matrix.span(), key, reason));
    }
    let mut rows = [[Wide::ZERO; 4]; 3];
    for (i, (place, number)) in rows.iter_mut().flatten().zip(given).enumerate() {
        *place = source.fixed(number, &format!("{key}[{i}]"))?;
    }
    Ok(rows)
}

pub(super) fn factors(source: &Source, scale: &Spanned<Scale>, key: &str) -> Result<Vec3, Fail> {
    match scale.get_ref() {
        Scale::All(number) => {
            let number = Spanned::new(scale.span(), number.clone());
            let factor = source.fixed(&number, key)?;
            Ok(Vec3::new(factor, factor, factor))
        }
        Scale::Each(each) => match each.as_slice() {
            [x, y, z] => {
                let [x, y, z] = source.triple(&[x.clone(), y.clone(), z.clone()], key)?;
                Ok(Vec3::new(x, y, z))
            }
            all => Err(source.fail(
                scale.span(),
                key,
                format!("{} numbers, a scale has one or three", all.len()),
            )),
        },
    }
}

fn rotation(source: &Source, turn: &Spanned<Vec<Num>>, key: &str) -> Result<Step, Fail> {
    let [x, y, z, degrees] = turn.get_ref().as_slice() else {
        let reason = "a rotation is [x, y, z, degrees]: an axis and an angle";
        return Err(source.fail(turn.span(), key, reason));
    };
    let part = |number, i| source.fixed::<Real>(number, &format!("{key}[{i}]"));
    let axis = Vec3::new(part(x, 0)?, part(y, 1)?, part(z, 2)?);
    if axis == Vec3::new(Real::ZERO, Real::ZERO, Real::ZERO) {
        return Err(source.fail(turn.span(), key, "the axis has no direction"));
    }
    Ok(Step::Rotate { axis, angle: turns(source, degrees, &format!("{key}[3]"))? })
}

/// Degrees as a part of a turn, to the nearest of its format.
fn turns(source: &Source, degrees: &Num, key: &str) -> Result<Angle, Fail> {
    let given: Wide = source.fixed(degrees, key)?;
    let bits = (i128::from(given.to_bits()) << 32).div_euclid(360);
    Ok(Angle::from_bits(((bits + (1 << 47)) >> 48) as u32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degrees_are_parts_of_a_turn() {
        let source = Source::built_in("test", "90 -90 360 1 450");
        let angle = |span: std::ops::Range<usize>| {
            turns(&source, &Spanned::new(span, Number::Plain), "rotate").unwrap().to_bits()
        };
        let exact = (2_f64.powi(32) / 360.0).round() as u32;
        let got = [angle(0..2), angle(3..6), angle(7..10), angle(11..12), angle(13..16)];
        assert_eq!(got, [1 << 30, 3 << 30, 0, exact, 1 << 30]);
    }
}
