//! An equalised picture while it is computed: each pixel once, each row shown as soon as it is there.
//!
//! The colours of a row depend on all the others. Rows are painted by what is known so far, and all of them
//! again whenever twice as many are known: the last time by the whole picture.

use attractor::Error;
use attractor::draw::{Equalised, Level, Leveled, Palette, Picture};
use attractor::plane::Field;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::page::{Display, Watch};

/// Draws a field so that every colour covers the same share of its outside; whether it was finished. `known`
/// takes the values, one a pixel, `counts` as many as [`Equalised::counts`] says; the inside has a colour of
/// its own.
///
/// # Errors
/// [`Error::BufferLength`] if one of them is shorter.
pub fn draw_equalised<F, P, D>(
    field: F,
    (palette, inside): (P, Rgb888),
    (known, counts): (&mut [Option<F::Value>], &mut [u32]),
    target: &mut D,
    watch: Watch<'_, D>,
) -> Result<bool, Error>
where
    F: Field<Value: Leveled>,
    P: Palette<Level>,
    D: Display,
{
    let Size { width, height } = field.size();
    let (given, needed) = (known.len(), width as usize * height as usize);
    let Some(known) = known.get_mut(..needed) else {
        return Err(Error::BufferLength { what: "values of the picture", given, needed });
    };
    let mut rows = 0;
    loop {
        let so_far = Known { size: Size::new(width, rows), values: known };
        let shares = Equalised::new(&so_far, counts, |level: Level| palette.rgb(level))?;
        let color = |value: Option<F::Value>| if value.is_inside() { inside } else { shares.rgb(value) };
        for y in 0..rows {
            let Ok(()) = Picture::new(so_far, &color).draw_row(target, y);
        }
        if rows == height {
            watch(target, height, height);
            return Ok(true);
        }
        let until = (2 * rows).clamp(1, height);
        while rows < until {
            let y = rows;
            let start = y as usize * width as usize;
            let row = known.iter_mut().skip(start).zip(field.row(y, 0..width));
            row.for_each(|(slot, value)| *slot = Some(value));
            rows += 1;
            let so_far = Known { size: Size::new(width, rows), values: known };
            let Ok(()) = Picture::new(so_far, &color).draw_row(target, y);
            if !watch(target, rows, height) {
                return Ok(false);
            }
        }
    }
}

/// The rows of a field that are computed.
#[derive(Debug, Clone, Copy)]
struct Known<'a, V> {
    size: Size,
    values: &'a [Option<V>],
}

impl<V: Copy> Field for Known<'_, V> {
    type Value = Option<V>;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Option<V> {
        let index = y as usize * self.size.width as usize + x as usize;
        self.values.get(index).copied().flatten()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::cell::Cell;
    use std::vec::Vec;

    use super::*;
    use crate::Named;
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::prelude::*;

    const SIZE: Size = Size::new(31, 23);
    const PIXELS: usize = 31 * 23;
    const RED: Rgb888 = Rgb888::RED;

    /// Counts how often a pixel is computed. Every eleventh is inside.
    struct Slow {
        computed: Cell<usize>,
    }

    impl Field for Slow {
        type Value = Option<u32>;

        fn size(&self) -> Size {
            SIZE
        }

        fn at(&self, x: u32, y: u32) -> Option<u32> {
            self.computed.set(self.computed.get() + 1);
            let value = (x * 7 + y * y) % 97;
            (!value.is_multiple_of(11)).then_some(value)
        }
    }

    fn draw(
        slow: &Slow,
        memory: (&mut [Option<Option<u32>>], &mut [u32]),
        watch: Watch<'_, MockDisplay<Rgb888>>,
    ) -> Result<(bool, MockDisplay<Rgb888>), Error> {
        let mut display = MockDisplay::new();
        display.set_allow_overdraw(true);
        let colours = (|level: Level| Named::Dusk.at(level), RED);
        Ok((draw_equalised(slow, colours, memory, &mut display, watch)?, display))
    }

    #[test]
    fn each_pixel_is_computed_once_and_coloured_by_the_whole_picture() {
        let slow = Slow { computed: Cell::new(0) };
        let mut portions = Vec::new();
        let watch = &mut |_: &mut MockDisplay<Rgb888>, done, all| {
            portions.push((done, all));
            true
        };
        let (finished, display) = draw(&slow, (&mut [None; PIXELS], &mut [0; 97]), watch).unwrap();
        assert_eq!((finished, slow.computed.get()), (true, PIXELS));
        assert_eq!(portions, (1..=23).chain([23]).map(|done| (done, 23)).collect::<Vec<_>>());
        let mut counts = [0; 97];
        let equalised = Equalised::new(&slow, &mut counts, |level| Named::Dusk.at(level)).unwrap();
        let mut inside = 0;
        for p in display.bounding_box().points().filter(|p| p.x < 31 && p.y < 23) {
            let value = slow.at(p.x as u32, p.y as u32);
            inside += usize::from(value.is_none());
            let expected = if value.is_none() { RED } else { equalised.rgb(value) };
            assert_eq!(display.get_pixel(p), Some(expected), "{p}");
        }
        assert!((50..100).contains(&inside), "{inside}");
    }

    #[test]
    fn nobody_waits_for_the_whole_picture() {
        let slow = Slow { computed: Cell::new(0) };
        let watch = &mut |_: &mut MockDisplay<Rgb888>, done, _| done < 5;
        let (finished, _) = draw(&slow, (&mut [None; PIXELS], &mut [0; 97]), watch).unwrap();
        assert_eq!((finished, slow.computed.get()), (false, 5 * 31));
    }

    #[test]
    fn short_memory_is_refused_with_what_it_takes() {
        let refused = |values: usize, counts: usize| {
            let slow = Slow { computed: Cell::new(0) };
            let (values, counts) = (&mut [None; PIXELS][..values], &mut [0; 97][..counts]);
            match draw(&slow, (values, counts), &mut |_, _, _| true) {
                Err(Error::BufferLength { given, needed, .. }) => Some((given, needed)),
                _ => None,
            }
        };
        assert_eq!(refused(PIXELS - 1, 97), Some((PIXELS - 1, PIXELS)));
        assert_eq!((refused(PIXELS, 96), refused(PIXELS, 97)), (Some((96, 97)), None));
    }
}
