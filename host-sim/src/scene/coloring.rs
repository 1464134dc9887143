//! What of an orbit decides the colour of a pixel: dwell, fractional dwell, distance or period.

use std::convert::Infallible;

use attractor::draw::{Equalised, Inside, Level, Leveled, Palette, Ramp};
use attractor::escape::{Distance, EscapeTime, FractionalDwell, Interior, Smooth};
use attractor::picture::Field;
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;

use super::{Watch, draw_field};
use crate::color::{Depth, ground};
use crate::fail::Fail;
use crate::palette::Colors;
use attractor_gallery::PAPER;

/// The key `coloring`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Coloring {
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
    P: EscapeTime + Copy,
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    let counts = if equalised { picture.max_dwell() } else { 0 };
    match coloring {
        Coloring::Dwell => paint(picture, colors, counts, target, watch),
        Coloring::Smooth => {
            let cycle = colors.cycle.map(|counts| counts * FractionalDwell::STEPS);
            let colors = Colors { cycle, ..colors };
            paint(Smooth(picture), colors, counts * FractionalDwell::STEPS, target, watch)
        }
        Coloring::Distance => {
            let counts = if equalised { 1 << 16 } else { 0 };
            paint(Distance(picture), colors, counts, target, watch)
        }
        Coloring::Interior => {
            let paper = ground::<D::Color>(PAPER);
            let color = Inside::new(Ramp::of_periods(|level| colors.named.at(level)), paper);
            draw_field(Interior(picture), color, target, watch);
            Ok(())
        }
    }
}

/// Draws a field as the palette says; with `counts` above 0 every colour covers the same share of the outside.
pub(super) fn paint<F, D>(
    field: F,
    colors: Colors,
    counts: u32,
    target: &mut D,
    watch: Watch<'_, D>,
) -> Result<(), Fail>
where
    F: Field,
    F::Value: Leveled,
    D: DrawTarget<Error = Infallible>,
    D::Color: Depth,
{
    if counts == 0 {
        draw_field(field, colors, target, watch);
        return Ok(());
    }
    let mut counts = vec![0; counts as usize + 1];
    let named = |level: Level| colors.named.at(level);
    let equalised = Equalised::new(&field, &mut counts, named).map_err(Fail::new)?;
    let color = |value: F::Value| if value.is_inside() { colors.inside } else { equalised.rgb(value) };
    draw_field(field, color, target, watch);
    Ok(())
}
