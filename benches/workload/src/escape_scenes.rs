//! The escape-time pictures of the command's built-in scenes, with their names, parameters and palettes.

use attractor::draw::Level;
use attractor::draw::{Brightened, Cycled, Equalised, Ink, Inside, Palette, Ramp, gradients, hex};
use attractor::escape::{
    DeepMandelbrot, DeepView, Distance, FractionalDwell, Interior, Julia, JuliaSet, Mandelbrot, OrbitPoint,
    Period, Smooth, View,
};
use attractor::num::Complex;
use attractor::num::Wide;
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::scenes::field;
use crate::sink::{Colour, Failure, Stage};

/// The ground of the command's charts.
pub(crate) const PAPER: Rgb888 = hex(0x0b0e1a);

fn view(stage: &Stage<'_>, re: Wide, im: Wide, width: Wide) -> Result<View, Failure> {
    Ok(View::new(Complex::new(re, im), width, stage.size())?)
}

/// The whole set, at most 100 iterations.
pub(crate) fn mandelbrot<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    palette: impl Palette<attractor::escape::Dwell>,
) -> Result<(), Failure> {
    let set = Mandelbrot::new(View::home(stage.size())?, 100)?;
    field::<C, _, _>(stage, set, palette, 0)
}

/// Between head and body of the set.
fn seahorses(stage: &Stage<'_>) -> Result<View, Failure> {
    let (re, im) = const { (Wide::lit("-0.7453"), Wide::lit("0.1127")) };
    view(stage, re, im, const { Wide::lit("0.0065") })
}

pub(crate) fn seahorse_valley<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let view = seahorses(stage)?;
    field::<C, _, _>(stage, Mandelbrot::new(view, 500)?, Cycled::new(gradients::PORCELAIN, 96), 0)
}

pub(crate) fn seahorse_smooth<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    const MAX: u32 = 1000;
    const COUNTS: usize = (MAX * FractionalDwell::STEPS) as usize + 1;
    stage.claim(size_of::<[u32; COUNTS]>() + size_of::<Mandelbrot>())?;
    equalised::<C, MAX, COUNTS>(stage)
}

/// Out of line: its frame is the array that was claimed.
#[inline(never)]
fn equalised<C: Colour + Ink, const MAX: u32, const COUNTS: usize>(
    stage: &mut Stage<'_>,
) -> Result<(), Failure> {
    let view = seahorses(stage)?;
    let smooth = Smooth(Mandelbrot::new(view, MAX)?);
    let mut counts = [0; COUNTS];
    let palette = Equalised::new(&smooth, &mut counts, gradients::DUSK)?;
    field::<C, _, _>(stage, smooth, Inside::new(palette, PAPER), size_of::<[u32; COUNTS]>())
}

pub(crate) fn filaments<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let view =
        view(stage, const { Wide::lit("-0.16") }, const { Wide::lit("0.98") }, const { Wide::lit("0.36") })?;
    field::<C, _, _>(stage, Distance(Mandelbrot::new(view, 500)?), attractor::draw::Grey, 0)
}

/// One colour of `palette` for each period.
pub(crate) fn periods<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    palette: impl Palette<Level>,
    paper: Rgb888,
) -> Result<(), Failure> {
    let view = view(stage, const { Wide::lit("-0.3") }, const { Wide::lit("0.75") }, Wide::ONE)?;
    let palette = Inside::new(Ramp::of_periods(palette), paper);
    field::<C, _, _>(
        stage,
        Interior(Mandelbrot::new(view, 1000)?),
        |period: Option<Period>| palette.rgb(period),
        0,
    )
}

/// A filled-in set, all of it.
fn filled_in(stage: &Stage<'_>, re: Wide, im: Wide, max: u32) -> Result<Julia, Failure> {
    let c = Complex::new(re, im);
    let across = JuliaSet::new(c)?.radius() * 2;
    let Size { width, height } = stage.size();
    let fitting = (across.to_bits() * i64::from(width)).checked_div(i64::from(height)).unwrap_or(0);
    let view = view(stage, Wide::ZERO, Wide::ZERO, across.max(Wide::from_bits(fitting)))?;
    Ok(Julia::new(view, c, max)?)
}

/// Douady's rabbit.
pub(crate) fn julia<C: Colour + Ink>(stage: &mut Stage<'_>, inside: Rgb888) -> Result<(), Failure> {
    let (re, im) = const { (Wide::lit("-0.12256116687665"), Wide::lit("0.74486176661974")) };
    let set = filled_in(stage, re, im, 60)?;
    field::<C, _, _>(stage, set, Inside::new(Brightened(gradients::FIRE), inside), 0)
}

pub(crate) fn dendrite<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let set = filled_in(stage, const { Wide::lit("-0.8") }, const { Wide::lit("0.156") }, 300)?;
    field::<C, _, _>(stage, set, Brightened(gradients::DUSK), 0)
}

/// Fractional dwells of a deep picture, `cycle` iterations once round the palette.
fn deep<C: Colour + Ink, const MAX: usize>(
    stage: &mut Stage<'_>,
    [re, im, width]: [&str; 3],
    cycle: u32,
) -> Result<(), Failure> {
    stage.claim(size_of::<[OrbitPoint; MAX]>() + size_of::<DeepMandelbrot<'_, 12>>())?;
    perturbed::<C, MAX>(stage, [re, im, width], cycle)
}

/// Out of line: its frame is the array that was claimed.
#[inline(never)]
fn perturbed<C: Colour + Ink, const MAX: usize>(
    stage: &mut Stage<'_>,
    [re, im, width]: [&str; 3],
    cycle: u32,
) -> Result<(), Failure> {
    let mut orbit = [OrbitPoint::default(); MAX];
    let view = DeepView::<12>::parse(re, im, width, stage.size())?;
    let set = DeepMandelbrot::new(view, MAX as u32, &mut orbit)?;
    let palette = Cycled::new(gradients::PORCELAIN, cycle * FractionalDwell::STEPS);
    field::<C, _, _>(stage, Smooth(set), Inside::new(palette, PAPER), size_of::<[OrbitPoint; MAX]>())
}

pub(crate) fn deep_30<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let place = [
        "-0.22815549365396177228498592653253904365159762112307",
        "1.11514250803993715834441655794265638994873014695612",
        "1e-30",
    ];
    deep::<C, 1000>(stage, place, 24)
}

/// Where a jump and the rest of an orbit are kernels, too.
pub(crate) const PERIOD_95: [&str; 3] = [
    "-1.29635513817303621680830447784528226626573574844788965989775373437658283646656950419705479937689642448160117166",
    "0.44185160573519660121284858017498694884009686670289384049246002968454720003912446200889312161452904430664647486",
    "1e-100",
];

pub(crate) fn deep_100<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    deep::<C, 2000>(stage, PERIOD_95, 60)
}
