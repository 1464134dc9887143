//! `kind = "ifs"`: the attractor of affine maps by the chaos game.

use std::convert::Infallible;
use std::io::Write;

use attractor::draw::{Dots, Level};
use attractor::ifs::{Ifs, MAX_MAPS};
use attractor::picture::{Bounds2, Window};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::Drawable;
use embedded_graphics::primitives::Rectangle;
use serde::Deserialize;
use toml::Spanned;

use super::chart::PAPER;
use super::density;
use super::system::{Maps, system};
use super::{Request, Watch, draw_field};
use crate::cli::MAX_POINTS;
use crate::color::{Depth, ground, solid};
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::Source;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    maps: Maps,
    points: Option<Spanned<u32>>,
    shading: Option<Shading>,
    palette: Option<Named>,
}

/// What decides the colour of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Shading {
    /// The map that made it.
    Maps,
    /// How often its pixel was hit.
    Density,
    /// One colour.
    Plain,
}

/// An attractor ready to be drawn.
#[derive(Debug)]
pub(super) struct IfsScene {
    ifs: Box<Ifs<MAX_MAPS>>,
    bounds: Bounds2,
    points: Option<u32>,
    shading: Shading,
    palette: Named,
}

/// Points drawn between two looks at the clock.
const PORTION: usize = 4096;

impl IfsScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let ifs = system(source, &file.maps)?;
        let points = file.points.map(|points| match *points.get_ref() {
            n @ 1..=MAX_POINTS => Ok(n),
            _ => Err(source.fail(points.span(), "points", format!("allowed is 1 to {MAX_POINTS}"))),
        });
        let bounds = ifs.bounds();
        Ok(Self {
            ifs,
            bounds,
            points: points.transpose()?,
            shading: file.shading.unwrap_or(Shading::Maps),
            palette: file.palette.unwrap_or(Named::Even),
        })
    }

    /// The system.
    pub(super) fn ifs(&self) -> &Ifs<MAX_MAPS> {
        &self.ifs
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let size = request.size;
        let margin = margin(size);
        let inner = Size::new(size.width - 2 * margin, size.height - 2 * margin);
        let corner = Point::new(margin as i32, margin as i32);
        let window = Window::fit(self.bounds, inner).map_err(Fail::new)?;
        let pixels = size.width.saturating_mul(size.height);
        let each = if self.shading == Shading::Density { 16 } else { 4 };
        let points = self.points.unwrap_or(pixels.saturating_mul(each).min(MAX_POINTS)) as usize;
        let mut game = self.ifs.seeded_chaos_game(request.seed);
        if self.shading == Shading::Density {
            let paper = ground::<D::Color>(PAPER);
            let color = |hits| density_color(self.palette, paper, density::level(hits));
            density::counted(game.take(points), window, size, margin, |framed| {
                draw_field(&framed, color, target, watch);
            })?;
            return Ok(());
        }
        let paper = solid(ground::<D::Color>(PAPER));
        let Ok(()) = target.fill_solid(&Rectangle::new(Point::zero(), size), paper);
        let portions = points.div_ceil(PORTION);
        let colors = self.map_colors();
        for portion in 0..portions {
            let count = PORTION.min(points - portion * PORTION);
            let mut dots = vec![Vec::new(); colors.len()];
            for _ in 0..count {
                let Some(point) = game.next() else { break };
                let made_by = game.last_map();
                if let Some(dots) = dots.get_mut(made_by) {
                    dots.push(point);
                }
            }
            for (dots, color) in dots.into_iter().zip(&colors) {
                let dots = Dots::new(dots.into_iter(), window, solid::<D::Color>(*color));
                let Ok(_) = dots.at(corner).draw(target);
            }
            if !watch(target, portion as u32 + 1, portions as u32) {
                break;
            }
        }
        Ok(())
    }

    fn map_colors(&self) -> Vec<Rgb888> {
        let maps = self.ifs.maps().len() as u32;
        let level = |map: u32| match self.shading {
            // the darkest third is left to the paper
            Shading::Maps if maps > 1 => Level(Level::ratio(map, maps - 1).0 / 8 * 5 + 23_000),
            _ => Level(52_000),
        };
        (0..maps).map(|map| self.palette.at(level(map))).collect()
    }

    /// `x,y` of the first points of the chaos game.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut dyn Write) -> Result<(), Fail> {
        writeln!(out, "x,y")?;
        for p in self.ifs.seeded_chaos_game(request.seed).take(points as usize) {
            writeln!(out, "{},{}", exact(p.x), exact(p.y))?;
        }
        Ok(())
    }
}

/// A sixteenth of the shorter side, nothing on the smallest displays.
pub(super) fn margin(size: Size) -> u32 {
    let side = size.width.min(size.height);
    if side < 32 { 0 } else { (side / 24).max(1) }
}

/// Paper where nothing was hit, else the palette without its darkest part.
pub(super) fn density_color(palette: Named, paper: Rgb888, level: Option<Level>) -> Rgb888 {
    level.map_or(paper, |level| palette.at(Level(level.0 / 4 * 3 + 16_000)))
}
