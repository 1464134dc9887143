//! The last picture where the next one will be: moved or scaled, until its rows are drawn.

use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;

use crate::color::Depth;
use crate::scene::Motion;

/// The picture after a motion; what comes into view is black.
pub(super) fn moved<C: Depth>(display: &SimulatorDisplay<C>, motion: Motion) -> SimulatorDisplay<C> {
    let (area, size) = (display.bounding_box(), display.size());
    let color = |p: Point| {
        let before = before(p, motion, size);
        if area.contains(before) { display.get_pixel(before) } else { C::from(BinaryColor::Off) }
    };
    let mut next = SimulatorDisplay::new(size);
    let Ok(()) = next.fill_contiguous(&area, area.points().map(color));
    next
}

/// Where a pixel was before the motion.
fn before(p: Point, motion: Motion, size: Size) -> Point {
    match motion {
        Motion::Pan { right, up } => p + Point::new(right, -up),
        // in half pixels: the middle of a pixel is odd
        Motion::Zoom { about, closer } => {
            let middle = |p: Point| p * 2 + Point::new(1, 1);
            let about = about.map_or(Point::new(size.width as i32, size.height as i32), middle);
            let part = |p: i32, about: i32| {
                if closer { (p + about).div_euclid(4) } else { (2 * p - about).div_euclid(2) }
            };
            Point::new(part(middle(p).x, about.x), part(middle(p).y, about.y))
        }
        Motion::Iterate { .. } | Motion::Light { .. } => p,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_graphics::pixelcolor::Gray8;

    const SIZE: Size = Size::new(12, 10);

    fn picture() -> SimulatorDisplay<Gray8> {
        let mut display = SimulatorDisplay::new(SIZE);
        let area = display.bounding_box();
        display.fill_contiguous(&area, (1..=120).map(Gray8::new)).unwrap();
        display
    }

    #[test]
    fn a_pan_moves_every_pixel_and_there_is_a_way_back() {
        let motion = |right, up| Motion::Pan { right, up };
        let there = moved(&picture(), motion(3, -2));
        // what lay 3 to the right and 2 below
        assert_eq!(there.get_pixel(Point::new(0, 0)), picture().get_pixel(Point::new(3, 2)));
        assert_eq!(there.get_pixel(Point::new(11, 0)), Gray8::new(0));
        let back = moved(&there, motion(-3, 2));
        assert_eq!(back.get_pixel(Point::new(11, 9)), picture().get_pixel(Point::new(11, 9)));
    }

    #[test]
    fn a_zoom_keeps_what_is_under_the_mouse() {
        for at in [Point::new(0, 0), Point::new(7, 3), Point::new(11, 9)] {
            for closer in [true, false] {
                let there = moved(&picture(), Motion::Zoom { about: Some(at), closer });
                assert_eq!(there.get_pixel(at), picture().get_pixel(at), "{at} {closer}");
            }
        }
        // about the middle each pixel becomes four
        let there = moved(&picture(), Motion::Zoom { about: None, closer: true });
        for p in [Point::new(0, 0), Point::new(1, 0), Point::new(0, 1), Point::new(1, 1)] {
            // (12 / 4, 10 / 4), half a pixel further up: two rows of two pixels and one of one
            let row = if p.y == 0 { 2 } else { 3 };
            assert_eq!(there.get_pixel(p), picture().get_pixel(Point::new(3, row)), "{p}");
        }
        let there = moved(&picture(), Motion::Zoom { about: None, closer: false });
        let lit = there.bounding_box().points().filter(|p| there.get_pixel(*p) != Gray8::new(0));
        assert_eq!(lit.count(), 30);
    }
}
