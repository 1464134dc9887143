//! The attractor of affine maps by the chaos game.

use attractor::Error;
use attractor::draw::Level;
use attractor::ifs::Ifs;
use attractor::plane::Window;
use embedded_graphics::Pixel;
use embedded_graphics::geometry::Size;

use crate::density;
use crate::ink::{ground, solid};
use crate::named::Named;
use crate::page::{Display, MAX_POINTS, PAPER, Watch, draw_field, inner, paper};

/// What decides the colour of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
pub enum Shading {
    /// The map that made it.
    Maps,
    /// How often its pixel was hit.
    Density,
    /// One colour.
    Plain,
}

/// An attractor ready to be drawn.
#[derive(Debug)]
pub struct IfsPicture<'a, const N: usize> {
    /// Its maps.
    pub ifs: &'a Ifs<N>,
    /// How many points; none: 4 a pixel, 16 for a density.
    pub points: Option<u32>,
    /// What decides the colour.
    pub shading: Shading,
    /// Where it comes from.
    pub palette: Named,
}

/// Points drawn between two looks at the clock.
const PORTION: u32 = 4096;

impl<const N: usize> IfsPicture<'_, N> {
    /// Draws it. `counts` is needed for a density: a number for each pixel of the display.
    ///
    /// # Errors
    /// Those of [`Window::fit`]; [`Error::BufferLength`] with the numbers needed.
    pub fn draw<D: Display>(
        &self,
        (size, seed): (Size, u64),
        target: &mut D,
        counts: &mut [u16],
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let room = inner(size, 1);
        let window = Window::fit(self.ifs.bounds(), room.size)?;
        let pixels = size.width.saturating_mul(size.height);
        let each = if self.shading == Shading::Density { 16 } else { 4 };
        let points = self.points.unwrap_or(pixels.saturating_mul(each).min(MAX_POINTS));
        let game = self.ifs.seeded_chaos_game(seed);
        if self.shading == Shading::Density {
            let paper = ground::<D::Color>(PAPER);
            let color = |hits| density::color(self.palette, paper, hits);
            let margin = room.top_left.x.unsigned_abs();
            return density::counted(game.take(points as usize), window, (size, margin), counts, |framed| {
                draw_field(&framed, color, target, watch);
            });
        }
        paper(size, target);
        let colors: [D::Color; N] = core::array::from_fn(|map| solid(self.palette.at(self.level(map))));
        let mut dots = game.labelled().map(|(point, map)| {
            let pixel = room.top_left + window.pixel(point)?;
            Some(Pixel(pixel, *colors.get(usize::from(map))?))
        });
        let portions = points.div_ceil(PORTION);
        for portion in 0..portions {
            let count = PORTION.min(points - portion * PORTION) as usize;
            let Ok(()) = target.draw_iter(dots.by_ref().take(count).flatten());
            if !watch(target, portion + 1, portions) {
                break;
            }
        }
        Ok(())
    }

    fn level(&self, map: usize) -> Level {
        let maps = self.ifs.maps().len();
        match self.shading {
            // the darkest third is left to the paper
            Shading::Maps if maps > 1 => {
                Level::from_bits(Level::ratio(map as u32, maps as u32 - 1).to_bits() / 8 * 5 + 23_000)
            }
            _ => Level::from_bits(52_000),
        }
    }
}
