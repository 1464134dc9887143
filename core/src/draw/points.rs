//! Points on a display: a dot for each.

use core::marker::PhantomData;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::{Drawable, Pixel};

use crate::draw::{Ink, Palette};
use crate::picture::{Point2, Window};

/// Draws an iterator of [`Point2`] in one colour, as seen through a [`Window`].
///
/// The iterator sets the number of points (`take`); it is cloned for each drawing, so the same object shows the same picture again. Points
/// outside the window are left out; points that share a pixel draw it again. The output is the number of points inside the window.
///
/// ```
/// use attractor::draw::Dots;
/// use attractor::num::Real;
/// use attractor::picture::{Bounds2, Point2, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// let p = |x: i32, y: i32| Point2::new(Real::from_num(x), Real::from_num(y));
/// let window = Window::stretch(Bounds2 { min: p(0, 0), max: p(4, 4) }, Size::new(4, 4)).unwrap();
/// let points = (0..9).map(|i| p(i, i));
///
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true); // points on the far edges belong to the last pixels
/// let inside = Dots::new(points, window, BinaryColor::On).draw(&mut display)?;
/// assert_eq!(inside, 5);
/// display.assert_pattern(&["   #", "   #", "  # ", "##  "]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Dots<I, C> {
    points: I,
    window: Window,
    color: C,
    top_left: Point,
}

impl<I, C> Dots<I, C> {
    /// These points in one colour, the window's first pixel at the target's origin.
    pub const fn new(points: I, window: Window, color: C) -> Self {
        Self { points, window, color, top_left: Point::zero() }
    }

    /// The same with the window's first pixel at `top_left`.
    pub const fn at(mut self, top_left: Point) -> Self {
        self.top_left = top_left;
        self
    }
}

impl<I, C> Dimensions for Dots<I, C> {
    /// The window's rectangle: what may be drawn on.
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(self.top_left, self.window.size())
    }
}

impl<I: Iterator<Item = Point2> + Clone, C: PixelColor> Drawable for Dots<I, C> {
    type Color = C;
    /// How many points lie inside the window.
    type Output = u32;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<u32, D::Error> {
        let points = self.points.clone().map(|p| (p, ()));
        draw(points, &self.window, self.top_left, |_, ()| self.color, target)
    }
}

/// Draws an iterator of points with a value each (the index of the map, the age of the point) in the colours of a palette.
///
/// Otherwise as [`Dots`]. On displays with few levels the dithering follows the position in the window.
///
/// ```
/// use attractor::draw::{ColoredDots, Ramp, hex};
/// # use attractor::num::Real;
/// # use attractor::picture::{Bounds2, Point2, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// # let p = |x: i32, y: i32| Point2::new(Real::from_num(x), Real::from_num(y));
/// # let window = Window::stretch(Bounds2 { min: p(0, 0), max: p(4, 4) }, Size::new(4, 4)).unwrap();
///
/// let points = (0..4).map(|i| (p(i, 3), i as u32));
/// let maps = Ramp::new([hex(0xff0000), hex(0x00ff00), hex(0x0000ff)]);
/// let mut display = MockDisplay::<Rgb565>::new();
/// ColoredDots::new(points, window, maps).draw(&mut display)?;
/// display.assert_pattern(&["    ", "RGBR"]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ColoredDots<I, P, C> {
    points: I,
    window: Window,
    palette: P,
    top_left: Point,
    color: PhantomData<fn() -> C>,
}

impl<I, P, C> ColoredDots<I, P, C> {
    /// These points in the colours of `palette`, the window's first pixel at the target's origin.
    pub const fn new(points: I, window: Window, palette: P) -> Self {
        Self { points, window, palette, top_left: Point::zero(), color: PhantomData }
    }

    /// The same with the window's first pixel at `top_left`.
    pub fn at(mut self, top_left: Point) -> Self {
        self.top_left = top_left;
        self
    }
}

impl<I, P, C> Dimensions for ColoredDots<I, P, C> {
    /// The window's rectangle: what may be drawn on.
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(self.top_left, self.window.size())
    }
}

impl<V, I, P, C> Drawable for ColoredDots<I, P, C>
where
    I: Iterator<Item = (Point2, V)> + Clone,
    P: Palette<V>,
    C: Ink,
{
    type Color = C;
    /// How many points lie inside the window.
    type Output = u32;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<u32, D::Error> {
        let color = |at, value| C::ink(self.palette.rgb(value), at);
        draw(self.points.clone(), &self.window, self.top_left, color, target)
    }
}

fn draw<V, D: DrawTarget>(
    points: impl Iterator<Item = (Point2, V)>,
    window: &Window,
    top_left: Point,
    color: impl Fn(Point, V) -> D::Color,
    target: &mut D,
) -> Result<u32, D::Error> {
    let mut inside = 0_u32;
    target.draw_iter(points.filter_map(|(point, value)| {
        let pixel = window.pixel(point)?;
        inside = inside.saturating_add(1);
        let at = Point::new(pixel.x.saturating_add(top_left.x), pixel.y.saturating_add(top_left.y));
        Some(Pixel(at, color(pixel, value)))
    }))?;
    Ok(inside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Grey;
    use crate::draw::testing::{Frame, point};
    use crate::picture::Bounds2;
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::pixelcolor::BinaryColor;
    use embedded_graphics_core::geometry::Size;

    fn window() -> Window {
        let bounds = Bounds2 { min: point(0, 0), max: point(8, 8) };
        Window::stretch(bounds, Size::new(8, 8)).unwrap()
    }

    #[test]
    fn points_outside_the_window_are_left_out() {
        let points = (-3..20).map(|x| point(2 * x, 7));
        let mut display = MockDisplay::new();
        display.set_allow_overdraw(true);
        let dots = Dots::new(points, window(), BinaryColor::On).at(Point::new(1, 1));
        assert_eq!(dots.draw(&mut display), Ok(5));
        display.assert_pattern(&["         ", "         ", " # # # ##"]);
        assert_eq!(dots.bounding_box(), Rectangle::new(Point::new(1, 1), Size::new(8, 8)));
    }

    #[test]
    fn the_same_dots_draw_twice() {
        let dots = Dots::new((0..4).map(|x| point(x, x)), window(), BinaryColor::On);
        let mut frames = [(); 2].map(|()| Frame::new(Size::new(8, 8), BinaryColor::Off));
        let counts = frames.each_mut().map(|frame| dots.draw(frame));
        assert_eq!(counts, [Ok(4), Ok(4)]);
        assert!(frames[0].colors == frames[1].colors && frames[0].drawn == 4);
    }

    #[test]
    fn dithering_follows_the_position_in_the_window() {
        let grey = (0..64).map(|i| (point(i % 8, i / 8 + 1), 64_u8));
        for shift in [Point::zero(), Point::new(3, 5)] {
            let mut frame = Frame::new(Size::new(16, 16), BinaryColor::Off);
            let dots = ColoredDots::new(grey.clone(), window(), Grey).at(shift);
            assert_eq!(dots.draw(&mut frame), Ok(64));
            let shown = frame.pixels(&dots.bounding_box());
            assert_eq!(shown.iter().filter(|color| color.is_on()).count(), 16);
            assert_eq!(shown.first(), Some(&BinaryColor::On));
        }
    }
}
