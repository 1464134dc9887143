//! Light in a scene file: `"#rrggbb"`, what a display shows and the sRGB curve decodes, or `[r, g, b]`, light
//! itself.

use std::fmt;

use attractor::num::{Lumen, Rgb};
use serde::de::{Deserialize, Deserializer, Error as _, SeqAccess, Visitor};
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// A colour as its file has it.
#[derive(Debug, Clone)]
pub(crate) enum Color {
    Code(String),
    Light([Num; 3]),
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Color;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour, \"#rrggbb\" or [red, green, blue]")
            }
            fn visit_str<E>(self, text: &str) -> Result<Color, E> {
                Ok(Color::Code(text.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Color, A::Error> {
                let mut part = |n| parts.next_element()?.ok_or_else(|| A::Error::invalid_length(n, &self));
                let light = [part(0)?, part(1)?, part(2)?];
                match parts.next_element::<Num>()? {
                    None => Ok(Color::Light(light)),
                    Some(_) => Err(A::Error::invalid_length(4, &self)),
                }
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The light of a colour, each part at most `most`.
pub(crate) fn light(source: &Source, given: &Spanned<Color>, key: &str, most: u16) -> Result<Rgb, Fail> {
    match given.get_ref() {
        Color::Code(text) => {
            let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.is_ascii());
            let Some(code) = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()) else {
                return Err(source.fail(given.span(), key, "a colour is \"#rrggbb\" or [red, green, blue]"));
            };
            let part = |shift: u32| decoded((code >> shift) as u8);
            Ok(Rgb::new(part(16), part(8), part(0)))
        }
        Color::Light(parts) => {
            let [r, g, b] = source.triple::<Lumen>(parts, key)?;
            for (i, (part, number)) in [r, g, b].into_iter().zip(parts).enumerate() {
                if part > most {
                    return Err(source.fail(
                        number.span(),
                        &format!("{key}[{i}]"),
                        format!("allowed is 0 to {most}"),
                    ));
                }
            }
            Ok(Rgb::new(r, g, b))
        }
    }
}

/// A colour that may be left out, of parts up to 1.
pub(crate) fn light_or(
    source: &Source,
    given: Option<&Spanned<Color>>,
    key: &str,
    usual: Rgb,
) -> Result<Rgb, Fail> {
    given.map_or(Ok(usual), |given| light(source, given, key, 1))
}

/// IEC 61966-2-1.
fn decoded(code: u8) -> Lumen {
    let v = f64::from(code) / 255.0;
    Lumen::from_num(if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::draw::{Palette as _, Srgb, hex};
    use attractor::plane::LinearRgb;

    #[test]
    fn a_code_becomes_the_light_that_shows_it() {
        for code in 0..=255_u8 {
            let light = Rgb::new(decoded(code), decoded(255 - code), Lumen::ONE);
            let shown = u32::from(code) << 16 | u32::from(255 - code) << 8 | 0xff;
            assert_eq!(Srgb.rgb(LinearRgb::from(light)), hex(shown));
        }
    }
}
