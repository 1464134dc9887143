//! Draws points on a display: a dot for each, in one colour or in the colour of a value that comes with it.

use core::marker::PhantomData;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use embedded_graphics_core::{Drawable, Pixel};

use super::ink::{Ink, shown};
use super::palette::Palette;
use crate::plane::{Point2, Window};

/// Draws an iterator of [`Point2`] in one colour, as seen through a [`Window`].
///
/// The iterator sets the number of points (`take`); it is cloned for each drawing, so the same object shows
/// the same picture again; [`Dots::draw_once`] uses it up instead. Points outside the window are left out,
/// and pixels that have no coordinates in 32 bits; points that share a pixel draw it again. The output is the
/// number of points inside the window.
///
/// ```
/// use attractor::draw::Dots;
/// use attractor::num::Real;
/// use attractor::plane::{Bounds2, Point2, Window};
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
    pub(super) top_left: Point,
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

impl<I: Iterator<Item = Point2>, C: PixelColor> Dots<I, C> {
    /// Draws the points and uses the iterator up: a portion a tick of a game that goes on. Returns the number
    /// of points inside the window.
    ///
    /// ```
    /// use attractor::draw::Dots;
    /// use attractor::ifs::{Ifs, Walk, catalogue};
    /// use attractor::plane::Window;
    /// use attractor::rand_xoshiro::Xoshiro128PlusPlus;
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    ///
    /// /// An attractor and the game on it, side by side.
    /// struct Screen {
    ///     fern: Ifs<4>,
    ///     walk: Walk<Xoshiro128PlusPlus>,
    ///     window: Window,
    /// }
    ///
    /// impl Screen {
    ///     fn tick<D: DrawTarget<Color = BinaryColor>>(&mut self, display: &mut D) -> Result<u32, D::Error> {
    ///         let points = self.fern.resume(&mut self.walk).take(50);
    ///         Dots::new(points, self.window, BinaryColor::On).draw_once(display)
    ///     }
    /// }
    ///
    /// let fern = catalogue::BARNSLEY_FERN.ifs::<4>()?;
    /// let window = Window::fit(fern.bounds(), Size::new(64, 64))?;
    /// let walk = fern.seeded_walk(1);
    /// let mut screen = Screen { fern, walk, window };
    /// let mut display = MockDisplay::new();
    /// # display.set_allow_overdraw(true);
    /// for _ in 0..10 {
    ///     assert_eq!(screen.tick(&mut display), Ok(50));
    /// }
    /// # Ok::<(), attractor::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the target.
    pub fn draw_once<D: DrawTarget<Color = C>>(self, target: &mut D) -> Result<u32, D::Error> {
        let color = self.color;
        draw(self.points.map(|p| (p, ())), &self.window, self.top_left, |_, ()| color, target)
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
        let dots = Dots { points: self.points.clone(), ..*self };
        dots.draw_once(target)
    }
}

/// Draws an iterator of points with a value each (the index of the map, the age of the point) in the colours
/// of a palette.
///
/// Otherwise as [`Dots`]. On displays with few levels the dithering follows the position in the window.
///
/// ```
/// use attractor::draw::{ColoredDots, Ramp, hex};
/// use attractor::ifs::catalogue::SIERPINSKI_GASKET;
/// use attractor::plane::Window;
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
///
/// let gasket = SIERPINSKI_GASKET.ifs::<3>()?;
/// let window = Window::stretch(gasket.bounds(), Size::new(8, 8))?;
/// let maps = Ramp::new([hex(0xff0000), hex(0x00ff00), hex(0x0000ff)]);
/// let points = gasket.seeded_chaos_game(1).labelled().take(300);
/// let mut display = MockDisplay::<Rgb565>::new();
/// # display.set_allow_overdraw(true);
/// let Ok(_) = ColoredDots::new(points, window, maps).draw(&mut display) else { return Ok(()) };
/// display.assert_pattern(&[
///     "   BB   ",
///     "   BB   ",
///     "  BBBB  ",
///     "  BBBB  ",
///     " R   GG ",
///     " RR  GG ",
///     "RRRRGGGG",
///     "RRRRGGGG",
/// ]);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ColoredDots<I, P, C> {
    points: I,
    window: Window,
    palette: P,
    pub(super) top_left: Point,
    dither_origin: Point,
    color: PhantomData<fn() -> C>,
}

impl<I, P, C> ColoredDots<I, P, C> {
    /// These points in the colours of `palette`, the window's first pixel at the target's origin.
    pub const fn new(points: I, window: Window, palette: P) -> Self {
        let (top_left, dither_origin) = (Point::zero(), Point::zero());
        Self { points, window, palette, top_left, dither_origin, color: PhantomData }
    }

    /// The same, dithered as if the window's pixel `origin` were its first: see
    /// [`Picture::with_dither_origin`](crate::draw::Picture::with_dither_origin).
    pub const fn with_dither_origin(mut self, origin: Point) -> Self {
        self.dither_origin = origin;
        self
    }

    /// The same with the window's first pixel at `top_left`.
    pub const fn at(mut self, top_left: Point) -> Self {
        self.top_left = top_left;
        self
    }
}

impl<V, I: Iterator<Item = (Point2, V)>, P: Palette<V>, C: Ink> ColoredDots<I, P, C> {
    /// Draws the points and uses the iterator up: see [`Dots::draw_once`].
    ///
    /// # Errors
    /// Those of the target.
    pub fn draw_once<D: DrawTarget<Color = C>>(self, target: &mut D) -> Result<u32, D::Error> {
        draw(self.points, &self.window, self.top_left, dithered(&self.palette, self.dither_origin), target)
    }
}

/// The colour of a value at a pixel of the window.
fn dithered<V, P: Palette<V>, C: Ink>(palette: &P, origin: Point) -> impl Fn(Point, V) -> C {
    move |at, value| {
        let at = Point::new(at.x.wrapping_sub(origin.x), at.y.wrapping_sub(origin.y));
        shown(palette, value, at)
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
        let color = dithered(&self.palette, self.dither_origin);
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
        let at = Point::new(pixel.x.checked_add(top_left.x)?, pixel.y.checked_add(top_left.y)?);
        Some(Pixel(at, color(pixel, value)))
    }))?;
    Ok(inside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Grey;
    use crate::draw::testing::{Frame, point};
    use crate::plane::Bounds2;
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::pixelcolor::BinaryColor;
    use embedded_graphics_core::geometry::Size;

    extern crate std;

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
    fn portions_of_a_running_iterator_are_the_whole() {
        let mut whole = Frame::new(Size::new(8, 8), BinaryColor::Off);
        let places = || (0..40).map(|i| ((i * 5) % 11, (i * 3) % 10));
        let points = || places().zip(0..).map(|((x, y), i)| (point(x, y), i * 6_u8));
        let expected = places().filter(|(x, y)| *x <= 8 && *y <= 8).count() as u32;
        assert_eq!(ColoredDots::new(points(), window(), Grey).draw(&mut whole), Ok(expected));
        let mut parts = Frame::new(Size::new(8, 8), BinaryColor::Off);
        let mut rest = points();
        let mut inside = 0;
        for _ in 0..6 {
            inside += ColoredDots::new(rest.by_ref().take(7), window(), Grey).draw_once(&mut parts).unwrap();
        }
        assert!(inside == expected && parts.colors == whole.colors);
        // one colour
        let mut rest = points().map(|(p, _)| p);
        let mut dots = || Dots::new(rest.by_ref().take(25), window(), BinaryColor::On).draw_once(&mut parts);
        assert_eq!([dots(), dots(), dots()].map(Result::unwrap).iter().sum::<u32>(), expected);
    }

    #[test]
    fn a_pan_moves_the_dots_of_a_colour_with_the_points() {
        let grey = |dx: i32| (0..64).map(move |i| (point(i % 8 - dx, i / 8 + 1), (i % 8 * 30) as u8));
        let frame = |dx: i32| {
            let mut frame = Frame::new(Size::new(8, 8), BinaryColor::Off);
            let dots = ColoredDots::new(grey(dx), window(), Grey).with_dither_origin(Point::new(-dx, 0));
            dots.draw(&mut frame).unwrap();
            frame
        };
        let columns = |x, width| Rectangle::new(Point::new(x, 0), Size::new(width, 8));
        for dx in 1..8 {
            let width = 8 - dx as u32;
            assert_eq!(frame(dx).pixels(&columns(0, width)), frame(0).pixels(&columns(dx, width)), "{dx}");
        }
    }

    #[test]
    fn dots_and_strokes_agree_on_the_last_coordinate() {
        use crate::draw::Stroke;
        use crate::plane::PathElement;
        // the window's columns 5 to 7 have no coordinate
        let corner = Point::new(i32::MAX - 4, i32::MAX - 6);
        let place = Rectangle::new(corner, Size::new(5, 7));
        let row = || (0..8).map(|x| point(x, 3));
        let mut dots = Corner { place, seen: std::vec::Vec::new() };
        let colors = ColoredDots::new(row().map(|p| (p, 255_u8)), window(), Grey).at(corner);
        assert_eq!(colors.draw(&mut dots), Ok(8));
        assert_eq!(Dots::new(row(), window(), BinaryColor::On).at(corner).draw(&mut dots), Ok(8));
        assert_eq!(dots.seen.split_off(5), dots.seen);
        let mut stroke = Corner { place, seen: std::vec::Vec::new() };
        let path = Stroke::new(row().map(PathElement::LineTo), window(), BinaryColor::On).at(corner);
        assert_eq!(path.draw(&mut stroke), Ok(5));
        assert_eq!(dots.seen, stroke.seen);
        assert_eq!(dots.seen.last(), Some(&Point::new(i32::MAX, i32::MAX - 1)));
    }

    /// A target at the end of the coordinates that writes down where it is drawn on.
    struct Corner {
        place: Rectangle,
        seen: std::vec::Vec<Point>,
    }

    impl Dimensions for Corner {
        fn bounding_box(&self) -> Rectangle {
            self.place
        }
    }

    impl DrawTarget for Corner {
        type Color = BinaryColor;
        type Error = core::convert::Infallible;

        fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
            &mut self,
            pixels: I,
        ) -> Result<(), Self::Error> {
            self.seen.extend(pixels.into_iter().map(|Pixel(at, _)| at));
            Ok(())
        }
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
