//! An equalised picture while it is computed: each pixel once, each row shown as soon as it is there.
//!
//! The colours of a row depend on all the others. Rows are painted by what is known so far, and all of them
//! again whenever twice as many are known:
//! the last time by the whole picture.

use std::convert::Infallible;

use attractor::draw::{Equalised, Level, Leveled, Palette, Picture};
use attractor::plane::Field;
use attractor_gallery::Watch;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Colors;

/// Draws a field so that every colour covers the same share of its outside.
pub(super) fn draw<F, D>(field: F, colors: Colors, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
where
    F: Field,
    F::Value: Leveled,
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    let Size { width, height } = field.size();
    let mut known = Known { width, values: Vec::with_capacity((width * height) as usize) };
    let mut counts = Vec::new();
    loop {
        let palette = known.palette(colors, &mut counts)?;
        let rows = known.size().height;
        for y in 0..rows {
            let Ok(()) = Picture::new(&known, &palette).draw_row(target, y);
        }
        if rows == height {
            watch(target, height, height);
            return Ok(());
        }
        for y in rows..(2 * rows).clamp(1, height) {
            known.values.extend(field.row(y, 0..width));
            let Ok(()) = Picture::new(&known, &palette).draw_row(target, y);
            if !watch(target, y + 1, height) {
                return Ok(());
            }
        }
    }
}

/// The rows of a field that are computed.
struct Known<V> {
    width: u32,
    values: Vec<V>,
}

impl<V: Leveled + Copy> Known<V> {
    /// The palette that these rows are equalised by.
    fn palette<'a>(
        &self,
        colors: Colors,
        counts: &'a mut Vec<u32>,
    ) -> Result<impl Fn(V) -> Rgb888 + 'a, Fail> {
        let outside = self.values.iter().filter(|value| !value.is_inside());
        let needed = outside.map(|value| value.count() as usize + 1).max().unwrap_or(0);
        counts.resize(needed, 0);
        let named = move |level: Level| colors.named.at(level);
        let equalised = Equalised::new(self, counts, named).map_err(Fail::new)?;
        Ok(move |value: V| if value.is_inside() { colors.inside } else { equalised.rgb(value) })
    }
}

impl<V: Copy> Field for Known<V> {
    type Value = V;

    fn size(&self) -> Size {
        Size::new(self.width, self.values.len() as u32 / self.width)
    }

    fn at(&self, x: u32, y: u32) -> V {
        self.values[(y * self.width + x) as usize]
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::palette::Named;
    use embedded_graphics::pixelcolor::Rgb888;
    use embedded_graphics::prelude::*;
    use embedded_graphics_simulator::SimulatorDisplay;

    const SIZE: Size = Size::new(31, 23);

    fn plain(named: Named) -> Colors {
        Colors { named, lift: false, cycle: None, inside: Rgb888::BLACK }
    }

    /// Counts how often a pixel is computed.
    struct Slow {
        computed: Cell<u32>,
    }

    impl Field for Slow {
        type Value = u32;

        fn size(&self) -> Size {
            SIZE
        }

        fn at(&self, x: u32, y: u32) -> u32 {
            self.computed.set(self.computed.get() + 1);
            (x * 7 + y * y) % 97
        }
    }

    #[test]
    fn each_pixel_is_computed_once_and_coloured_by_the_whole_picture() {
        let slow = Slow { computed: Cell::new(0) };
        let colors = plain(Named::Dusk);
        let mut display = SimulatorDisplay::<Rgb888>::new(SIZE);
        let mut portions = Vec::new();
        draw(&slow, colors, &mut display, &mut |_, done, all| {
            portions.push((done, all));
            true
        })
        .unwrap();
        assert_eq!(slow.computed.get(), SIZE.width * SIZE.height);
        assert_eq!(portions, (1..=23).chain([23]).map(|done| (done, 23)).collect::<Vec<_>>());
        let mut counts = [0; 97];
        let equalised = Equalised::new(&slow, &mut counts, |level| Named::Dusk.at(level)).unwrap();
        for p in display.bounding_box().points() {
            let value = slow.at(p.x as u32, p.y as u32);
            assert_eq!(display.get_pixel(p), equalised.rgb(value), "{p}");
        }
    }

    #[test]
    fn nobody_waits_for_the_whole_picture() {
        let slow = Slow { computed: Cell::new(0) };
        let mut display = SimulatorDisplay::<Rgb888>::new(SIZE);
        let watch = &mut |_: &mut SimulatorDisplay<Rgb888>, done, _| done < 5;
        draw(&slow, plain(Named::Fire), &mut display, watch).unwrap();
        assert_eq!(slow.computed.get(), 5 * SIZE.width);
    }
}
