//! The least display: every colour goes out over a wire and is gone.

use core::convert::Infallible;
use core::hint::black_box;
use core::marker::PhantomData;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::pixelcolor::PixelColor;
use embedded_graphics::primitives::Rectangle;

/// A display of 240 x 240 pixels, for images whose size is measured.
#[derive(Debug, Clone, Copy, Default)]
pub struct Wire<C>(PhantomData<C>);

impl<C> Wire<C> {
    /// Its width and height.
    pub const SIZE: Size = Size::new(240, 240);

    /// The display.
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<C> OriginDimensions for Wire<C> {
    fn size(&self) -> Size {
        Self::SIZE
    }
}

impl<C: PixelColor> DrawTarget for Wire<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        pixels.into_iter().for_each(|pixel| {
            black_box(pixel);
        });
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Infallible> {
        black_box(*area);
        colours.into_iter().for_each(|colour| {
            black_box(colour);
        });
        Ok(())
    }
}
