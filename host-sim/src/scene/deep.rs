//! Deep zooms: coordinates with all their digits, for views that are finer than 32 bits.

use std::io::Write;

use attractor::escape::{Complex, DeepMandelbrot, DeepView, OrbitPoint};
use attractor::num::Limbs;
use attractor::picture::Field as _;
use embedded_graphics::geometry::Size;

use super::escape::Keys;
use crate::fail::Fail;
use crate::number;
use crate::source::{Num, Source};

/// 380 fractional bits: 114 decimal places.
const LIMBS: usize = 12;
/// A unit of the 32-bit format: no display shows a view as narrow as this in it.
pub(super) const UNIT: f64 = 1.0 / (1 << 29) as f64;
/// The widest view that may be too fine for it, on the largest display.
const WIDEST: f64 = UNIT * (1 << 14) as f64;

pub(super) type View = DeepView<LIMBS>;
pub(super) type Picture<'a> = DeepMandelbrot<'a, LIMBS>;

/// Centre and width of a view, all digits kept.
#[derive(Debug, Clone, Copy)]
pub(super) struct Deep {
    centre: Complex<Limbs<LIMBS>>,
    width: Limbs<LIMBS>,
}

impl Deep {
    /// None for a view that 32 bits show on every display.
    pub(super) fn load(source: &Source, keys: &Keys<'_>) -> Result<Option<Self>, Fail> {
        let (Some(centre), Some(width)) = (keys.centre, keys.width) else { return Ok(None) };
        let about = number::float(source.digits(width));
        if !(0.0 < about && about < WIDEST) {
            return Ok(None);
        }
        let limbs = |number: &Num, key: &str| {
            let digits = source.digits(number).replace('_', "");
            digits.parse::<Limbs<LIMBS>>().map_err(|error| source.fail(number.span(), key, error))
        };
        let [re, im] = centre.get_ref();
        let deep = || {
            let centre = Complex::new(limbs(re, "centre[0]")?, limbs(im, "centre[1]")?);
            let width_bits = limbs(width, "width")?;
            // the coarsest grid there is: what it refuses, every size refuses
            DeepView::new(centre, width_bits, Size::new(1, 1))
                .map_err(|error| source.fail(width.span(), "width", error))?;
            Ok(Self { centre, width: width_bits })
        };
        match deep() {
            Ok(deep) => Ok(Some(deep)),
            Err(_) if about >= UNIT => Ok(None),
            Err(fail) => Err(fail),
        }
    }

    /// The view on a display of this size.
    pub(super) fn view(&self, size: Size) -> Result<View, Fail> {
        DeepView::new(self.centre, self.width, size).map_err(Fail::new)
    }
}

/// The orbit that a picture of this view borrows.
pub(super) fn orbit(view: &View, max_dwell: u32) -> Vec<OrbitPoint> {
    vec![OrbitPoint::default(); DeepMandelbrot::orbit_points(view, max_dwell)]
}

/// `re,im,dwell,reference` for every pixel, row by row; no reference reaches as deep.
pub(super) fn sample(picture: &Picture<'_>, out: &mut dyn Write) -> Result<(), Fail> {
    writeln!(out, "re,im,dwell,reference")?;
    let size = picture.size();
    for (row, column) in (0..size.height).flat_map(|row| (0..size.width).map(move |column| (row, column))) {
        let c = picture.view().point(column, row);
        writeln!(out, "{},{},{},", exact(c.re), exact(c.im), picture.dwell_at(column, row).count)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_digits_of_a_deep_coordinate_are_printed() {
        for text in ["0", "1", "-0.5", "-1.9990234375", "3.0000000000009094947017729282379150390625"] {
            assert_eq!(exact(text.parse().unwrap()), text);
        }
        let third: Limbs<LIMBS> = "-0.333333333333333333333333333333333333".parse().unwrap();
        assert!(exact(third).parse::<Limbs<LIMBS>>().is_err());
        assert!(exact(third).starts_with("-0.3333333333333333333333333333333333"));
    }
}
