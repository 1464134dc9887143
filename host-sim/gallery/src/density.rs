//! The density of an attractor with a margin around it.

use attractor::Error;
use attractor::draw::{Level, Leveled as _};
use attractor::plane::{Density, Hits, Toned};
use attractor::plane::{Field, Point2, Window};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::named::Named;

/// A density on a larger display: nothing falls on the margin.
#[derive(Debug)]
pub(crate) struct Framed<'a> {
    pub(crate) density: Toned<'a, u16>,
    pub(crate) size: Size,
    /// Width of the margin on the left and above.
    pub(crate) margin: u32,
}

impl Field for Framed<'_> {
    type Value = Hits;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Hits {
        let (x, y) = (x.wrapping_sub(self.margin), y.wrapping_sub(self.margin));
        let inner = self.density.size();
        if x < inner.width && y < inner.height { self.density.at(x, y) } else { Hits::default() }
    }
}

/// How often each pixel of `window`, which lies within a margin of `size`, was hit by `points`; then shown by
/// `show`. `counts` has room for the window's pixels.
pub(crate) fn counted<R>(
    points: impl Iterator<Item = Point2>,
    window: Window,
    (size, margin): (Size, u32),
    counts: &mut [u16],
    show: impl FnOnce(Framed<'_>) -> R,
) -> Result<R, Error> {
    let (given, needed) = (counts.len(), (window.size().width * window.size().height) as usize);
    let counts = counts.get_mut(..needed).ok_or(Error::BufferLength { what: "counts", given, needed })?;
    let mut hits = Density::new(window, counts)?;
    hits.extend(points);
    // the scale ends where fewer than one hit pixel in 50 lie above
    Ok(show(Framed { density: hits.linear(hits.quantile(50)), size, margin }))
}

/// The square root of the tone, twice: neither the trunk nor the finest leaves are lost. None where no point
/// fell.
fn level(hits: Hits) -> Option<Level> {
    let root = |level: u32| (level * u32::from(u16::MAX)).isqrt();
    (hits.count > 0).then(|| Level::from_bits(root(root(u32::from(hits.level().to_bits()))) as u16))
}

/// Paper where nothing was hit, else the palette without its darkest part.
pub(crate) fn color(palette: Named, paper: Rgb888, hits: Hits) -> Rgb888 {
    level(hits).map_or(paper, |level| palette.at(Level::from_bits(level.to_bits() / 4 * 3 + 16_000)))
}
