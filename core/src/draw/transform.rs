//! Points and paths move as other drawables do: by `Transform` of embedded-graphics, which is not part of its
//! core, and so is behind a feature.

use embedded_graphics::transform::Transform;
use embedded_graphics_core::geometry::Point;

use super::path::Stroke;
use super::points::{ColoredDots, Dots};

macro_rules! transform {
    ($([$($generic:ident),*] $name:ty;)*) => {$(
        /// Moves the window's first pixel; with the feature `embedded-graphics`. Coordinates saturate.
        impl<$($generic: Clone),*> Transform for $name {
            fn translate(&self, by: Point) -> Self {
                let mut moved = self.clone();
                moved.translate_mut(by);
                moved
            }

            fn translate_mut(&mut self, by: Point) -> &mut Self {
                let Point { x, y } = self.top_left;
                self.top_left = Point::new(x.saturating_add(by.x), y.saturating_add(by.y));
                self
            }
        }
    )*};
}

transform! {
    [I, C] Dots<I, C>;
    [I, P, C] ColoredDots<I, P, C>;
    [I, C] Stroke<I, C>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Grey;
    use crate::draw::testing::point;
    use crate::plane::{Bounds2, PathElement, Window};
    use embedded_graphics::mock_display::MockDisplay;
    use embedded_graphics::pixelcolor::BinaryColor;
    use embedded_graphics_core::Drawable;
    use embedded_graphics_core::geometry::{Dimensions, Size};

    fn window() -> Window {
        let bounds = Bounds2 { min: point(0, 0), max: point(4, 4) };
        Window::stretch(bounds, Size::new(4, 4)).unwrap()
    }

    /// Drawn at the origin, moved by (2, 1), and moved on to (0, 1) and beyond the end of the coordinates.
    fn check<T: Transform + Drawable<Color = BinaryColor> + Dimensions>(mut drawable: T) {
        let drawn = |drawable: &T| {
            let mut display = MockDisplay::new();
            assert!(drawable.draw(&mut display).is_ok());
            display
        };
        drawn(&drawable).assert_pattern(&["    ", "    ", "    ", "####"]);
        let moved = drawable.translate(Point::new(2, 1));
        drawn(&moved).assert_pattern(&["      ", "      ", "      ", "      ", "  ####"]);
        assert_eq!(moved.bounding_box().top_left, Point::new(2, 1));
        drawable.translate_mut(Point::new(2, 1)).translate_mut(Point::new(-2, 0));
        drawn(&drawable).assert_pattern(&["    ", "    ", "    ", "    ", "####"]);
        drawable.translate_mut(Point::new(i32::MAX, i32::MAX)).translate_mut(Point::new(7, 0));
        assert_eq!(drawable.bounding_box().top_left, Point::new(i32::MAX, i32::MAX));
    }

    #[test]
    fn dots_and_strokes_move() {
        let row = (0..4).map(|x| point(x, 0));
        check(Dots::new(row.clone(), window(), BinaryColor::On));
        check(ColoredDots::new(row.clone().map(|p| (p, 255_u8)), window(), Grey));
        check(Stroke::new(row.map(PathElement::LineTo), window(), BinaryColor::On));
    }
}
