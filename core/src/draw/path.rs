//! Draws a path on a display: thin lines from step to step.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::{Drawable, Pixel};

use crate::draw::clip::{Spans, common, spans};
use crate::draw::line::Line;
use crate::plane::{PathElement, Window};

/// Draws an iterator of [`PathElement`], one pixel wide, as seen through a [`Window`].
///
/// Lines run from pixel to pixel, so any coordinates of the plane are welcome; they are clipped to the window
/// and to the target without moving a pixel. A point where two lines meet is drawn once, a line that ends in
/// the pixel where it began draws nothing more; where a path crosses, touches or retraces itself, and where a
/// closed path meets its start, pixels are drawn again. A `LineTo` without a step before it only moves there.
/// The pixels of a line are the same in both directions: a path that is drawn again from its end leaves
/// nothing under XOR. The iterator is cloned for each drawing, or used up by [`Stroke::draw_once`]; the
/// output is the number of pixels drawn.
///
/// ```
/// use attractor::draw::Stroke;
/// use attractor::num::Real;
/// use attractor::plane::{Bounds2, Point2, PathElement, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// let p = |x: i32, y: i32| Point2::new(Real::from_num(x), Real::from_num(y));
/// let window = Window::stretch(Bounds2 { min: p(0, 0), max: p(8, 4) }, Size::new(9, 5)).unwrap();
/// let hat = [PathElement::MoveTo(p(-2, -2)), PathElement::LineTo(p(4, 4)), PathElement::LineTo(p(8, 0))];
///
/// let mut display = MockDisplay::new();
/// let drawn = Stroke::new(hat.into_iter(), window, BinaryColor::On).draw(&mut display)?;
/// display.assert_pattern(&[
///     "    #    ",
///     "   # #   ",
///     "  #   #  ",
///     " #     # ",
///     "#       #",
/// ]);
/// assert_eq!(drawn, 9);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Stroke<I, C> {
    steps: I,
    window: Window,
    color: C,
    pub(super) top_left: Point,
}

impl<I, C> Stroke<I, C> {
    /// The path `steps` in one colour, the window's first pixel at the target's origin.
    pub const fn new(steps: I, window: Window, color: C) -> Self {
        Self { steps, window, color, top_left: Point::zero() }
    }

    /// The same with the window's first pixel at `top_left`.
    pub const fn at(mut self, top_left: Point) -> Self {
        self.top_left = top_left;
        self
    }
}

impl<I: Iterator<Item = PathElement>, C: PixelColor> Stroke<I, C> {
    /// Draws the path and uses the iterator up: for one that cannot be cloned, or for a portion a tick. A
    /// portion that goes on from the one before begins with a `MoveTo` its last point. Returns the number of
    /// pixels drawn.
    ///
    /// # Errors
    /// Those of the target.
    pub fn draw_once<D: DrawTarget<Color = C>>(self, target: &mut D) -> Result<u32, D::Error> {
        let visible = common(&spans(&self.bounding_box()), &spans(&target.bounding_box()));
        let mut drawn = 0_u32;
        let pixels = Pixels {
            steps: self.steps,
            window: self.window,
            offset: (i64::from(self.top_left.x), i64::from(self.top_left.y)),
            visible,
            pen: None,
            fresh: true,
            line: Line::EMPTY,
        };
        let count = |point| {
            drawn = drawn.saturating_add(1);
            Pixel(point, self.color)
        };
        target.draw_iter(pixels.map(count))?;
        Ok(drawn)
    }
}

impl<I, C> Dimensions for Stroke<I, C> {
    /// The window's rectangle: what may be drawn on.
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(self.top_left, self.window.size())
    }
}

impl<I: Iterator<Item = PathElement> + Clone, C: PixelColor> Drawable for Stroke<I, C> {
    type Color = C;
    /// How many pixels were drawn.
    type Output = u32;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<u32, D::Error> {
        let stroke = Stroke { steps: self.steps.clone(), ..*self };
        stroke.draw_once(target)
    }
}

/// The visible pixels of a path, in the target's coordinates.
struct Pixels<I> {
    steps: I,
    window: Window,
    offset: (i64, i64),
    visible: Spans,
    /// Where the pen is.
    pen: Option<(i64, i64)>,
    /// Whether the pixel under the pen is still to be drawn.
    fresh: bool,
    line: Line,
}

impl<I: Iterator<Item = PathElement>> Iterator for Pixels<I> {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        loop {
            if let Some(point) = self.line.next() {
                return Some(point);
            }
            let (p, draws) = match self.steps.next()? {
                PathElement::MoveTo(p) => (p, false),
                PathElement::LineTo(p) => (p, true),
            };
            let (x, y) = self.window.raster(p);
            let to = (x + self.offset.0, y + self.offset.1);
            match self.pen {
                Some(from) if draws => {
                    self.line = Line::new(from, to, i64::from(!self.fresh), &self.visible);
                    self.fresh = false;
                }
                _ => self.fresh = true,
            }
            self.pen = Some(to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::testing::{Frame, point};
    use crate::num::Real;
    use crate::plane::{Bounds2, Point2};
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::pixelcolor::BinaryColor;
    use embedded_graphics_core::geometry::Size;

    extern crate std;
    use std::vec::Vec;

    fn window(side: i32) -> Window {
        let bounds = Bounds2 { min: point(0, 0), max: point(side, side) };
        Window::stretch(bounds, Size::new(side as u32, side as u32)).unwrap()
    }

    #[test]
    fn joints_are_drawn_once() {
        let steps = [(1, 9), (8, 9), (8, 9), (8, 2), (3, 2)];
        let path = steps.iter().map(|&(x, y)| PathElement::LineTo(point(x, y)));
        let mut display = MockDisplay::new(); // refuses to draw a pixel twice
        let drawn = Stroke::new(path, window(10), BinaryColor::On).draw(&mut display).unwrap();
        display.assert_pattern(&[
            "         ", //
            " ########",
            "        #",
            "        #",
            "        #",
            "        #",
            "        #",
            "        #",
            "   ######",
        ]);
        assert_eq!(drawn, 20);
    }

    #[test]
    fn a_move_lifts_the_pen() {
        let steps = [
            PathElement::MoveTo(point(1, 9)),
            PathElement::LineTo(point(3, 9)),
            PathElement::MoveTo(point(5, 9)),
            PathElement::LineTo(point(5, 9)),
            PathElement::MoveTo(point(7, 9)),
            PathElement::MoveTo(point(8, 9)),
            PathElement::LineTo(point(9, 9)),
        ];
        let mut display = MockDisplay::new();
        let stroke = Stroke::new(steps.into_iter(), window(10), BinaryColor::On).at(Point::new(2, 0));
        assert_eq!(stroke.draw(&mut display), Ok(6));
        display.assert_pattern(&["            ", "   ### #  ##"]);
        assert_eq!(stroke.bounding_box(), Rectangle::new(Point::new(2, 0), Size::new(10, 10)));
    }

    #[test]
    fn a_path_drawn_again_from_its_end_leaves_nothing_under_xor() {
        let mut state = 3_u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 26) as i32 - 12
        };
        let mut pixels = 0;
        for count in 1..120 {
            let corners: Vec<Point2> = (0..count % 9 + 1).map(|_| point(next(), next())).collect();
            let mut display = Xor { set: [false; SIDE * SIDE] };
            let there = corners.iter().copied().map(PathElement::LineTo);
            let drawn = Stroke::new(there, window(SIDE as i32), BinaryColor::On).draw(&mut display);
            pixels += drawn.unwrap();
            let back = corners.iter().rev().copied().map(PathElement::LineTo);
            let erased = Stroke::new(back, window(SIDE as i32), BinaryColor::On).draw(&mut display);
            assert_eq!(erased, drawn);
            assert!(display.set.iter().all(|set| !set), "{corners:?}");
        }
        assert!(pixels > 8000, "{pixels}");
    }

    const SIDE: usize = 40;

    /// Turns a pixel on or off each time it is drawn.
    struct Xor {
        set: [bool; SIDE * SIDE],
    }

    impl Dimensions for Xor {
        fn bounding_box(&self) -> Rectangle {
            Rectangle::new(Point::zero(), Size::new(SIDE as u32, SIDE as u32))
        }
    }

    impl DrawTarget for Xor {
        type Color = BinaryColor;
        type Error = core::convert::Infallible;

        fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
            &mut self,
            pixels: I,
        ) -> Result<(), Self::Error> {
            for Pixel(at, _) in pixels {
                self.set[at.y as usize * SIDE + at.x as usize] ^= true;
            }
            Ok(())
        }
    }

    #[test]
    fn a_smaller_target_shows_a_part_of_the_same_pixels() {
        let star: Vec<PathElement> =
            (0..40).map(|i| PathElement::LineTo(point((i * 37) % 101 - 18, (i * 53) % 97 - 16))).collect();
        let stroke = Stroke::new(star.iter().copied(), window(64), BinaryColor::On);
        let mut whole = Frame::new(Size::new(64, 64), BinaryColor::Off);
        stroke.draw(&mut whole).unwrap();
        let mut part = Frame::new(Size::new(64, 64), BinaryColor::Off);
        part.window = Rectangle::new(Point::new(11, 20), Size::new(30, 17));
        let drawn = stroke.draw(&mut part).unwrap();
        assert!(drawn > 100);
        assert_eq!(part.pixels(&part.window), whole.pixels(&part.window));
        assert_eq!(part.drawn as u32, drawn);
    }

    #[test]
    fn no_coordinate_overflows_in_the_narrowest_window() {
        let low = Point2::new(Real::from_bits(5), Real::from_bits(-7));
        let high = Point2::new(Real::from_bits(6), Real::from_bits(-6));
        let window = Window::stretch(Bounds2 { min: low, max: high }, Size::new(64, 64)).unwrap();
        let ends = [Real::MIN, Real::ZERO, Real::MAX];
        let corners =
            ends.iter().flat_map(|&x| ends.iter().map(move |&y| PathElement::LineTo(Point2::new(x, y))));
        let mut frame = Frame::new(Size::new(64, 64), BinaryColor::Off);
        Stroke::new(corners, window, BinaryColor::On).draw(&mut frame).unwrap();
        // straight through: a horizontal line from end to end of the numbers
        let y = Real::from_bits(-7);
        let line =
            [PathElement::MoveTo(Point2::new(Real::MIN, y)), PathElement::LineTo(Point2::new(Real::MAX, y))];
        assert_eq!(Stroke::new(line.into_iter(), window, BinaryColor::On).draw(&mut frame), Ok(64));
    }

    #[test]
    fn the_raster_continues_the_pixels_of_the_window() {
        let window = window(10);
        for i in -40..150 {
            let x = Real::from_bits(i << 21); // eighths
            let (column, row) = window.raster(Point2::new(x, x));
            assert_eq!(column, if i == 80 { 9 } else { i64::from(i).div_euclid(8) }, "{i}");
            if let Some(pixel) = window.pixel(Point2::new(x, x)) {
                assert_eq!((i64::from(pixel.x), i64::from(pixel.y)), (column, row));
            }
        }
    }
}
