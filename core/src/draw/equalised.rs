//! A palette equalised by histogram: each colour covers the same share of the picture, however unevenly its
//! values are spread.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::level::{Level, Leveled};
use super::palette::Palette;
use crate::Error;
use crate::plane::Field;

/// Another palette at the equalised level of one picture; black inside the set.
///
/// The level of a value becomes the share of the outer pixels whose count is smaller: the cumulative
/// histogram. Source: R. C. Gonzalez, R. E. Woods, "Digital Image Processing", section 3.3.1. The caller
/// lends one 32-bit word for each count that occurs.
///
/// ```
/// use attractor::draw::{Equalised, Palette, gradients};
/// use attractor::escape::{Mandelbrot, View};
/// use embedded_graphics::prelude::*;
/// let picture = Mandelbrot::new(View::home(Size::new(48, 40))?, 100)?;
/// let mut counts = [0; Equalised::counts(99)];
/// let palette = Equalised::new(&picture, &mut counts, gradients::FIRE)?;
/// # let _ = palette;
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Equalised<'a, P> {
    /// For each count, how many pixels have a smaller one.
    below: &'a [u32],
    /// How many pixels are outside.
    outside: u32,
    palette: P,
}

impl Equalised<'_, ()> {
    /// How many words a picture takes whose outer counts are at most `most`: the length of the memory to
    /// lend. The dwell of a point outside is at most `Num - 1`.
    pub const fn counts(most: u32) -> usize {
        (most as usize).saturating_add(1)
    }
}

impl<'a, P> Equalised<'a, P> {
    /// Counts the values of a whole picture, and then paints as `palette` does at the equalised level.
    ///
    /// Cost: every pixel of `picture` is computed once. Memory: 4 bytes a count.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `counts` is shorter than [`Equalised::counts`] of the largest count
    /// outside.
    pub fn new<F>(picture: &F, counts: &'a mut [u32], palette: P) -> Result<Self, Error>
    where
        F: Field,
        F::Value: Leveled,
    {
        counts.fill(0);
        let size = picture.size();
        let mut needed = 0;
        let mut outside = 0_u32;
        for value in (0..size.height).flat_map(|y| picture.row(y, 0..size.width)) {
            if value.is_inside() {
                continue;
            }
            let count = value.count() as usize;
            needed = needed.max(count.saturating_add(1));
            outside = outside.saturating_add(1);
            if let Some(bin) = counts.get_mut(count) {
                *bin += 1;
            }
        }
        if needed > counts.len() {
            return Err(Error::BufferLength { what: "counts", given: counts.len(), needed });
        }
        let mut below = 0_u32;
        for bin in counts.iter_mut() {
            let here = *bin;
            *bin = below;
            below = below.saturating_add(here);
        }
        Ok(Self { below: counts, outside, palette })
    }

    /// The share of the outer pixels that have a smaller count; 1 beyond the counts of the picture.
    pub fn level(&self, count: u32) -> Level {
        self.below.get(count as usize).map_or(Level::FULL, |below| Level::ratio(*below, self.outside))
    }
}

impl<V: Leveled, P: Palette<Level>> Palette<V> for Equalised<'_, P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() { Rgb888::BLACK } else { self.palette.rgb(self.level(value.count())) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{Grey, hex};
    use crate::escape::{Dwell, Mandelbrot, View};
    use embedded_graphics_core::geometry::Size;

    #[test]
    fn every_level_covers_the_same_share_of_the_outer_pixels() {
        let picture = Mandelbrot::new(View::home(Size::new(120, 100)).unwrap(), 200).unwrap();
        let mut counts = [0; 200];
        let palette = Equalised::new(&picture, &mut counts, Grey).unwrap();
        let (mut dark, mut bright, mut plain) = (0, 0, 0);
        for d in (0..100).flat_map(|y| picture.row(y, 0..120)).filter(|d| !d.is_inside()) {
            let level = palette.level(d.count);
            if level < Level::from_bits(32768) {
                dark += 1
            } else {
                bright += 1
            }
            plain += u32::from(d.level() > Level::from_bits(32768));
        }
        // a band of equal dwell is not divided
        assert!(dark < 2 * bright && bright < 2 * dark, "{dark} {bright}");
        assert!(plain * 20 < bright, "{plain}");
        assert_eq!(palette.rgb(Dwell { count: 200, max: 200 }), hex(0));
    }

    #[test]
    fn a_short_buffer_names_the_length_it_needs() {
        let picture = Mandelbrot::new(View::home(Size::new(60, 50)).unwrap(), 50).unwrap();
        let Err(Error::BufferLength { what: "counts", given: 7, needed }) =
            Equalised::new(&picture, &mut [0; 7], Grey)
        else {
            panic!("accepted")
        };
        assert!(needed > 30 && needed <= 50);
        let mut counts = [0; 50];
        assert!(Equalised::new(&picture, &mut counts[..needed], Grey).is_ok());
        assert!(Equalised::new(&picture, &mut counts[..needed - 1], Grey).is_err());
    }
}
