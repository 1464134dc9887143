//! What of an orbit decides the colour of a pixel: dwell, fractional dwell, distance or period.

use std::convert::Infallible;

use attractor::draw::{Equalised, Inside, Level, Leveled, Ramp};
use attractor::escape::{Distance, EscapeTime, FractionalDwell, Interior, Smooth};
use attractor::plane::Field;
use attractor_gallery::{PAPER, Watch, draw_equalised, draw_field};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;

use crate::color::{Depth, ground};
use crate::fail::Fail;
use crate::palette::Colors;

/// The key `coloring`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Coloring {
    /// Whole counts, in bands.
    #[default]
    Dwell,
    /// Fractional counts, without bands.
    Smooth,
    /// The distance to the set, up to a pixel.
    Distance,
    /// The length of the cycle, inside.
    Interior,
}

impl Coloring {
    /// How many counts an equalised palette borrows.
    pub(crate) fn counts(self, max_dwell: u32) -> usize {
        Equalised::counts(match self {
            Self::Dwell => max_dwell,
            Self::Smooth => max_dwell * FractionalDwell::STEPS,
            Self::Distance | Self::Interior => Level::FULL.to_bits().into(),
        })
    }
}

/// Draws an escape-time picture in this colouring.
pub(super) fn draw<P, D>(
    picture: P,
    coloring: Coloring,
    equalised: bool,
    colors: Colors,
    target: &mut D,
    watch: Watch<'_, D>,
) -> Result<(), Fail>
where
    P: EscapeTime,
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    // colours that come round need no equal shares
    let counts = (equalised && colors.cycle.is_none()).then(|| coloring.counts(picture.max_dwell()));
    match coloring {
        Coloring::Dwell => paint(picture, colors, counts, target, watch),
        Coloring::Smooth => {
            let cycle = colors.cycle.map(|counts| counts * FractionalDwell::STEPS);
            let colors = Colors { cycle, ..colors };
            paint(Smooth(picture), colors, counts, target, watch)
        }
        Coloring::Distance => paint(Distance(picture), colors, counts, target, watch),
        Coloring::Interior => {
            let paper = ground::<D::Color>(PAPER);
            let color = Inside::new(Ramp::of_periods(|level| colors.named.at(level)), paper);
            draw_field(Interior(picture), color, target, watch);
            Ok(())
        }
    }
}

/// Draws a field as the palette says, equalised by so many counts.
fn paint<F, D>(
    field: F,
    colors: Colors,
    counts: Option<usize>,
    target: &mut D,
    watch: Watch<'_, D>,
) -> Result<(), Fail>
where
    F: Field,
    F::Value: Leveled,
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    let Some(counts) = counts else {
        draw_field(field, colors, target, watch);
        return Ok(());
    };
    let size = field.size();
    let mut known = vec![None; size.width as usize * size.height as usize];
    let palette = (|level: Level| colors.named.at(level), colors.inside);
    draw_equalised(field, palette, (&mut known, &mut vec![0; counts]), target, watch).map_err(Fail::new)?;
    Ok(())
}
