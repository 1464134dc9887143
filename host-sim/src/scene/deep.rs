//! Deep zooms: coordinates with all their digits, for views that are finer than 32 bits.

use attractor::Error;
use attractor::escape::{DeepMandelbrot, DeepView, OrbitPoint};
use attractor::num::Complex;
use attractor::num::Limbs;
use attractor::plane::Field as _;
use embedded_graphics::geometry::Size;

use super::keys::Keys;
use super::motion::Sight;
use crate::fail::Fail;
use crate::number;
use crate::source::{Num, Source};
use crate::table::Csv;

/// 380 fractional bits: 114 decimal places.
pub(crate) const LIMBS: usize = 12;
/// A unit of the 32-bit format: no display shows a view as narrow as this in it.
pub(crate) const UNIT: f64 = 1.0 / (1 << 29) as f64;
/// A coordinate rounded to 114 decimal places is within a 256th of a pixel of the largest display in views as
/// wide as this.
const ROUNDED: f64 = 1e-114 * (1 << 22) as f64;
/// The widest view that may be too fine for it, on the largest display.
const WIDEST: f64 = UNIT * (1 << 14) as f64;

pub(super) type View = DeepView<LIMBS>;
pub(super) type Picture<'a> = DeepMandelbrot<'a, LIMBS>;

/// Centre and width of a view, all digits kept.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deep(pub(crate) Sight<LIMBS>);

impl Deep {
    /// None for a view that 32 bits show on every display.
    pub(super) fn load(source: &Source, keys: &Keys<'_>) -> Result<Option<Self>, Fail> {
        let Some(width) = keys.width else { return Ok(None) };
        let about = number::float(source.digits(width));
        if about <= 0.0 {
            let reason = "it must be above 0, and may be as small as 1e-100";
            return Err(source.fail(width.span(), "width", reason));
        }
        if about < 1e-100 {
            let reason = "it is too narrow: it may be as small as 1e-100";
            return Err(source.fail(width.span(), "width", reason));
        }
        if about < UNIT && keys.centre.is_none() {
            return Err(source.fail(width.span(), "width", "a view as narrow as this needs a centre"));
        }
        let Some(centre) = keys.centre.filter(|_| about < WIDEST) else { return Ok(None) };
        let limbs = |number: &Num, key: &str| {
            let digits = source.digits(number).replace('_', "");
            let rounded = match digits.parse::<Limbs<LIMBS>>() {
                Err(Error::Capacity { .. }) if about >= ROUNDED => {
                    let places = Limbs::<LIMBS>::DECIMAL_PLACES;
                    if about < UNIT {
                        let note =
                            format!("rounded to {places} decimal places: no picture shows the difference");
                        source.note(number.span(), key, &note);
                    }
                    number::rounded(&digits, places).parse()
                }
                exactly => exactly,
            };
            rounded.map_err(|error| source.fail(number.span(), key, error))
        };
        let [re, im] = centre.get_ref();
        let deep = || {
            let centre = Complex::new(limbs(re, "centre[0]")?, limbs(im, "centre[1]")?);
            let width_bits = limbs(width, "width")?;
            // the coarsest grid there is: what it refuses, every size refuses
            DeepView::new(centre, width_bits, Size::new(1, 1))
                .map_err(|error| source.fail(width.span(), "width", error))?;
            Ok(Self(Sight { centre, width: width_bits }))
        };
        match deep() {
            Ok(deep) => Ok(Some(deep)),
            Err(_) if about >= UNIT => Ok(None),
            Err(fail) => Err(fail),
        }
    }

    /// The view on a display of this size.
    pub(crate) fn view(&self, size: Size) -> Result<View, Error> {
        DeepView::new(self.0.centre, self.0.width, size)
    }
}

/// The orbit that a picture of this view borrows.
pub(super) fn orbit(view: &View, max_dwell: u32) -> Vec<OrbitPoint> {
    vec![OrbitPoint::default(); DeepMandelbrot::orbit_points(view, max_dwell)]
}

/// `re,im,dwell,reference` for every pixel, row by row; no reference reaches as deep.
pub(super) fn sample(picture: &Picture<'_>, out: &mut Csv) -> Result<(), Fail> {
    out.write_record(["re", "im", "dwell", "reference"])?;
    let size = picture.size();
    for (row, column) in (0..size.height).flat_map(|row| (0..size.width).map(move |column| (row, column))) {
        let c = picture.view().point(column, row);
        let dwell = picture.dwell_at(column, row).count.to_string();
        out.write_record([exact(c.re), exact(c.im), dwell, String::new()])?;
    }
    Ok(())
}

/// All digits: as many decimals as fractional bits, without zeros at the end.
fn exact(number: Limbs<LIMBS>) -> String {
    let mut words = *number.magnitude().limbs();
    let mut text = String::from(if number.is_negative() { "-" } else { "" });
    let mut whole = || {
        let top = words.last_mut()?;
        // 4 bits before the point
        let digit = *top >> 28;
        *top &= (1 << 28) - 1;
        let mut carry = 0_u64;
        for word in &mut words {
            carry += u64::from(*word) * 10;
            *word = carry as u32;
            carry >>= 32;
        }
        char::from_digit(digit, 10)
    };
    text.extend(whole());
    text.push('.');
    text.extend((0..Limbs::<LIMBS>::FRACTION).filter_map(|_| whole()));
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The nearest decimal number that [`Limbs`] reads back.
pub(super) fn decimal(number: Limbs<LIMBS>) -> String {
    let text = exact(number);
    let Some(point) = text.find('.') else { return text };
    let end = point + 1 + Limbs::<LIMBS>::DECIMAL_PLACES;
    let (Some(kept), Some(next)) = (text.get(..end), text.as_bytes().get(end)) else { return text };
    let mut digits = kept.as_bytes().to_vec();
    if *next >= b'5' {
        // nines become zeros up to the first digit that is none; the format ends below 8
        for digit in digits.iter_mut().rev().filter(|digit| digit.is_ascii_digit()) {
            if *digit < b'9' {
                *digit += 1;
                break;
            }
            *digit = b'0';
        }
    }
    let text = String::from_utf8_lossy(&digits);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_digits_of_a_deep_coordinate_are_printed() {
        for text in ["0", "1", "-0.5", "-1.9990234375", "3.0000000000009094947017729282379150390625"] {
            assert_eq!(exact(text.parse().unwrap()), text);
            assert_eq!(decimal(text.parse().unwrap()), text);
        }
        let third: Limbs<LIMBS> = "-0.333333333333333333333333333333333333".parse().unwrap();
        assert!(exact(third).parse::<Limbs<LIMBS>>().is_err());
        assert!(exact(third).starts_with("-0.3333333333333333333333333333333333"));
    }

    #[test]
    fn a_printed_coordinate_is_read_back_within_a_unit_of_the_last_decimal_place() {
        for text in ["-1.9", "0.1", "0.9999999999999999999999999999999999", "1e-100", "-3e-114"] {
            let number: Limbs<LIMBS> = text.parse().unwrap();
            let short = decimal(number);
            assert!(short.len() < 120 && exact(number).len() > 300, "{short}");
            let back: Limbs<LIMBS> = short.parse().unwrap();
            assert_eq!(back, number);
        }
        let third = Limbs::from_wide(attractor::num::Wide::ONE).unwrap().divided(3).0;
        assert_eq!(decimal(third), format!("0.{}", "3".repeat(114)));
        let almost =
            Limbs::<LIMBS>::ZERO.plus_units(-1).plus(&Limbs::from_wide(attractor::num::Wide::ONE).unwrap());
        assert_eq!(decimal(almost), "1");
    }
}
