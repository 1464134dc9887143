//! Graphs and surfaces of fractal interpolation functions: figures 1, 2, 3 and 6 of the paper.

use attractor::Error;
use attractor::draw::Ink;
use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{Real, Scaling, Unit, Vec3, Wide};
use attractor::trace::{Camera, Environment, Filter, HeightField, Light, Material, RayCaster, Sampling};
use attractor_gallery::{CELLS_ACROSS, Chart, Named, depth_for, draw_field};
use embedded_graphics::pixelcolor::Rgb888;

use super::SEED;
use super::sunspots::{KNOTS, VERTICAL_SCALINGS};
use crate::scenes::{COLOUR, MONO};
use crate::sink::{Colour, Failure, Stage};

/// The paper's functions through (0, 0), (1, 1), (2, 0), or their integrals.
pub(super) struct Function {
    scalings: [Scaling; 2],
    integrate: bool,
}

const HALF: Scaling = Scaling::lit("0.5");
const STEEP: Scaling = Scaling::lit("0.85");
const DOWN: Scaling = Scaling::lit("-0.85");
pub(super) const F: Function = Function { scalings: [HALF, HALF], integrate: false };
pub(super) const G: Function = Function { scalings: [STEEP, DOWN], integrate: false };
pub(super) const F_INTEGRAL: Function = Function { integrate: true, ..F };
pub(super) const G_INTEGRAL: Function = Function { integrate: true, ..G };

impl Function {
    fn build(&self) -> Result<Fif<2, 2>, Error> {
        let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f = Fif::<2, 2>::interpolating(&knots, &self.scalings)?;
        if self.integrate { f.integral(Wide::ZERO) } else { Ok(f) }
    }
}

pub(super) fn chart<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    function: &Function,
    address: &[usize],
) -> Result<(), Failure> {
    const CELLS: usize = Pyramid::cells(2, depth_for(2, CELLS_ACROSS));
    charted::<C, 2, 2, CELLS>(stage, &function.build()?, address, Named::Ocean)
}

/// 309 years as knots, with the scalings that the command fitted.
pub(super) fn sunspots<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    const MAPS: usize = VERTICAL_SCALINGS.len();
    const CELLS: usize = Pyramid::cells(MAPS, depth_for(MAPS, CELLS_ACROSS));
    stage.claim(size_of::<Fif<MAPS, 1>>() + size_of::<[Cell; CELLS]>())?;
    let f = Fif::<MAPS, 1>::interpolating(&KNOTS, &VERTICAL_SCALINGS)?;
    charted::<C, MAPS, 1, CELLS>(stage, &f, &[], Named::Fire)
}

/// The chart of a function on all of the stage.
fn charted<C: Colour + Ink, const N: usize, const D: usize, const CELLS: usize>(
    stage: &mut Stage<'_>,
    f: &Fif<N, D>,
    address: &[usize],
    palette: Named,
) -> Result<(), Failure> {
    let (size, mut cells, mut columns) = (stage.size(), [Cell::ZERO; CELLS], [0; COLOUR.width as usize]);
    let chart = Chart::new(f, size, address, palette, &mut cells)?;
    let bytes = size_of_val(f) + size_of_val(&chart) + size_of_val(&cells) + size_of_val(&columns);
    stage.draw::<C>(bytes, |sink| chart.draw(sink, &mut columns, &mut |_, _, _| true))
}

/// A surface `f(x) f(y)` and how it is seen.
pub(super) struct Surface {
    function: Function,
    eye: [Real; 3],
    look_at: [Real; 3],
    field_of_view: Real,
    material: Material,
    light: Option<[Real; 3]>,
    environment: Environment,
    palette: Named,
}

/// Cells of a pyramid down to the width of a pixel.
pub(super) const CELLS: [usize; 2] =
    [Pyramid::cells(2, depth_for(2, COLOUR.width)), Pyramid::cells(2, depth_for(2, MONO.width))];

const DIM: Environment =
    Environment::Gradient { zenith: Unit::lit("0.5"), horizon: Unit::lit("0.12"), nadir: Unit::ZERO };

const fn board(scale: Option<Real>, fade: Unit) -> Environment {
    match (Environment::CHECKERBOARD, scale) {
        (Environment::Checkerboard { bright, dark, horizon, scale, .. }, None) => {
            Environment::Checkerboard { bright, dark, horizon, scale, fade }
        }
        (Environment::Checkerboard { bright, dark, horizon, .. }, Some(scale)) => {
            Environment::Checkerboard { bright, dark, horizon, scale, fade }
        }
        (other, _) => other,
    }
}

pub(super) const FIGURE_6_FF: Surface = Surface {
    function: F_INTEGRAL,
    eye: [Real::lit("-6"), Real::lit("-4.9"), Real::lit("4.4")],
    look_at: [Real::lit("1.15"), Real::lit("1.15"), Real::lit("1.7")],
    field_of_view: Real::lit("28.5"),
    material: Material::Mirror,
    light: None,
    environment: board(None, Unit::lit("0.9")),
    palette: Named::Dusk,
};
pub(super) const FIGURE_6_FF_DIFFUSE: Surface = Surface {
    material: Material::DIFFUSE,
    light: Some([Real::lit("-3"), Real::lit("1"), Real::lit("2")]),
    environment: DIM,
    ..FIGURE_6_FF
};
pub(super) const FIGURE_6_GG: Surface = Surface {
    function: G_INTEGRAL,
    eye: [Real::lit("-4.4"), Real::lit("-3.7"), Real::lit("2.8")],
    look_at: [Real::lit("1"), Real::lit("1"), Real::lit("0.35")],
    field_of_view: Real::lit("22"),
    environment: board(Some(Real::lit("0.3")), Unit::lit("0.6")),
    ..FIGURE_6_FF
};
pub(super) const FIGURE_6_GG_PHONG: Surface = Surface {
    material: Material::PHONG,
    light: Some([Real::lit("-1"), Real::lit("-2"), Real::lit("3")]),
    environment: DIM,
    palette: Named::Ocean,
    ..FIGURE_6_GG
};

/// Both profiles are one function: one pyramid is enough.
pub(super) fn surface<C: Colour + Ink, const CELLS: usize>(
    stage: &mut Stage<'_>,
    surface: &Surface,
) -> Result<(), Failure> {
    let vector = |[x, y, z]: [Real; 3]| Vec3::new(x, y, z);
    let size = stage.size();
    let f = surface.function.build()?;
    let mut cells = [Cell::ZERO; CELLS];
    let pyramid = Pyramid::new(&f, depth_for(2, size.width), &mut cells)?;
    let up = Vec3::new(Real::ZERO, Real::ZERO, Real::ONE);
    let camera = Camera::new(vector(surface.eye), vector(surface.look_at), up, surface.field_of_view)?;
    let heights = HeightField::new(&pyramid, &pyramid)?;
    let mut caster = RayCaster::new(heights, camera, size)?
        .with_material(surface.material)?
        .with_environment(surface.environment)?
        .with_sampling(Sampling::Jittered { n: 4, seed: SEED as u32 }, Filter::Box)?;
    if let Some(light) = surface.light {
        caster = caster.with_light(Light::new(vector(light))?);
    }
    let bytes = size_of_val(&f) + size_of_val(&pyramid) + size_of::<[Cell; CELLS]>() + size_of_val(&caster);
    let palette = |tone| color(surface.palette, tone);
    stage.draw::<C>(bytes, |sink| {
        draw_field(&caster, palette, sink, &mut |_, _, _| true);
        Ok(())
    })
}

fn color<V: attractor::draw::Leveled>(palette: Named, value: V) -> Rgb888 {
    palette.at(value.level())
}
