//! Whole pictures, drawn as firmware would draw them.
//!
//! To add one: write a function that builds its objects, [claims](Stage::claim) their RAM and [shows](Stage::show) them, and add a line to
//! [`ALL`]. The function takes the size from the stage, so that one function serves several lines.

use core::iter::FusedIterator;
use core::ops::Range;

use attractor::draw::{Brightened, CourseUnit, Dots, Grey, Ink, Inside, Palette, Picture, Stroke, gradients};
use attractor::escape::{Dwell, Mandelbrot, View};
use attractor::fif::{Cell, Fif, Pyramid};
use attractor::ifs::Ifs;
use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::Complex;
use attractor::num::{Angle, Real, Wide, sin_cos};
use attractor::plane::{Bounds2, Field, Point2, Symmetric, Window, along};
use attractor::trace::RayCaster;
use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;

use crate::built_in;
use crate::escape_scenes as escape;
use crate::kernels::figure_1;
use crate::sink::{Colour, Failure, Outcome, Stage};
use crate::surface::{g_integral, mirror};
use crate::{Machine, SMALL};

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Scene {
    /// What is drawn.
    pub name: &'static str,
    /// Width and height in pixels.
    pub size: Size,
    /// Bits of a pixel: 1 or 16.
    pub bits: u8,
    /// Whether it is small enough for a machine with 16 KiB of RAM.
    pub small: bool,
    /// Builds and shows it.
    pub show: Show,
}

pub(crate) type Show = fn(&mut Stage<'_>) -> Result<(), Failure>;

/// The usual displays.
pub(crate) const COLOUR: Size = Size::new(240, 240);
pub(crate) const MONO: Size = Size::new(128, 64);

pub(crate) const fn colour(name: &'static str, show: Show) -> Scene {
    Scene { name, size: COLOUR, bits: 16, small: true, show }
}

pub(crate) const fn mono(name: &'static str, show: Show) -> Scene {
    Scene { name, size: MONO, bits: 1, small: true, show }
}

/// For machines with more than 16 KiB of RAM.
pub(crate) const fn roomy(scene: Scene) -> Scene {
    Scene { small: false, ..scene }
}

impl Scene {
    /// Builds, shows and measures the scene.
    ///
    /// # Errors
    /// What the kernel or the machine refuses.
    pub fn run(&self, machine: &mut dyn Machine) -> Result<Outcome, Failure> {
        let mut stage = Stage::new(machine, self.size);
        (self.show)(&mut stage)?;
        Ok(stage.outcome())
    }
}

/// The table: what is drawn here, and the built-in scenes of the command; in an image for Armv6-M those that it can draw.
pub static ALL: &[Scene] = &{
    let mut all = [OWN[0]; count(OWNED + PAIRS.len())];
    let (mut i, mut kept) = (0, 0);
    while kept < all.len() {
        if fits(i) {
            all[kept] = row(i);
            kept += 1;
        }
        i += 1;
    }
    all
};

const OWNED: usize = OWN.len();
const PAIRS: &[Scene] = built_in::PAIRS.as_flattened();

const fn row(i: usize) -> Scene {
    if i < OWNED { OWN[i] } else { PAIRS[i - OWNED] }
}

const fn fits(i: usize) -> bool {
    row(i).small || !SMALL
}

const fn count(rows: usize) -> usize {
    let (mut i, mut kept) = (0, 0);
    while i < rows {
        kept += fits(i) as usize;
        i += 1;
    }
    kept
}

/// The first rows are the floor: a picture that computes nothing.
#[rustfmt::skip]
const OWN: &[Scene] = &[
    colour("blank", blank::<Rgb565>),
    mono("blank", blank::<BinaryColor>),
    colour("waves", waves::<Rgb565>),
    mono("waves", waves::<BinaryColor>),
    colour("mandelbrot", |stage| escape::mandelbrot::<Rgb565>(stage, CourseUnit)),
    mono("mandelbrot", |stage| escape::mandelbrot::<BinaryColor>(stage, Inside::new(Brightened(Grey), Rgb888::WHITE))),
    Scene { size: Rp2040::SIZE, ..roomy(colour("mandelbrot rp2040", rp2040::<Rgb565>)) },
    colour("julia", |stage| escape::julia::<Rgb565>(stage, Rgb888::BLACK)),
    mono("julia", |stage| escape::julia::<BinaryColor>(stage, Rgb888::WHITE)),
    colour("dendrite", escape::dendrite::<Rgb565>),
    mono("dendrite", escape::dendrite::<BinaryColor>),
    colour("seahorse-valley", escape::seahorse_valley::<Rgb565>),
    mono("seahorse-valley", escape::seahorse_valley::<BinaryColor>),
    roomy(colour("seahorse-smooth", escape::seahorse_smooth::<Rgb565>)),
    roomy(mono("seahorse-smooth", escape::seahorse_smooth::<BinaryColor>)),
    roomy(colour("filaments", escape::filaments::<Rgb565>)),
    mono("filaments", escape::filaments::<BinaryColor>),
    roomy(colour("mandelbrot-periods", |stage| escape::periods::<Rgb565>(stage, gradients::EVEN, escape::PAPER))),
    mono("mandelbrot-periods", |stage| escape::periods::<BinaryColor>(stage, Grey, Rgb888::BLACK)),
    roomy(colour("deep-30", escape::deep_30::<Rgb565>)),
    roomy(mono("deep-30", escape::deep_30::<BinaryColor>)),
    roomy(colour("deep-100", escape::deep_100::<Rgb565>)),
    roomy(mono("deep-100", escape::deep_100::<BinaryColor>)),
    colour("fern in dots", fern::<Rgb565>),
    mono("fern in dots", fern::<BinaryColor>),
    colour("fif graph", graph::<Rgb565>),
    mono("fif graph", graph::<BinaryColor>),
    roomy(colour("fif mirror", fif_mirror::<Rgb565, 8, { Pyramid::cells(2, 8) }>)),
    roomy(mono("fif mirror", fif_mirror::<BinaryColor, 8, { Pyramid::cells(2, 8) }>)),
    mono("fif mirror of depth 6", fif_mirror::<BinaryColor, 6, { Pyramid::cells(2, 6) }>),
];

/// A mirror whose pyramid is larger than the RAM of any of the targets: each must refuse it.
pub static TOO_LARGE: Scene =
    roomy(mono("fif mirror of depth 13", fif_mirror::<BinaryColor, 13, { Pyramid::cells(2, 13) }>));

fn blank<C: Colour>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let blank = Waves::<C> { size: stage.size(), tone: |_, _| C::from(BinaryColor::Off) };
    stage.show(&blank, size_of_val(&blank))
}

fn waves<C: Colour>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let waves = Waves {
        size: stage.size(),
        tone: |x, y| {
            let (sin, _) = sin_cos(Angle::from_bits(x.wrapping_mul(x) << 20));
            let (_, cos) = sin_cos(Angle::from_bits(y.wrapping_mul(y) << 20));
            C::from(BinaryColor::from(sin.to_bits() ^ cos.to_bits() < 0))
        },
    };
    stage.show(&waves, size_of_val(&waves))
}

/// Shows a field through a palette, as one image at the origin.
pub(crate) fn field<C: Colour + Ink, F: Field, P: Palette<F::Value>>(
    stage: &mut Stage<'_>,
    field: F,
    palette: P,
    borrowed: usize,
) -> Result<(), Failure> {
    let picture = Picture::<F, P, C>::new(field, palette);
    stage.show(&Image::new(&picture, Point::zero()), size_of_val(&picture) + borrowed)
}

/// The frame that was published for the RP2040: `c = (-2 + 3 i / 640, 1 - 2 j / 480)`, at most 1000 iterations. Its pixels are not square.
pub(crate) struct Rp2040(Mandelbrot);

impl Rp2040 {
    pub(crate) const SIZE: Size = Size::new(640, 480);

    pub(crate) fn new() -> Result<Self, attractor::Error> {
        Ok(Self(Mandelbrot::new(View::home(Self::SIZE)?, 1000)?))
    }
}

impl Symmetric for Rp2040 {
    /// `1 - 2 j / 480` is 0 in row 240; quotients are cut towards 0.
    fn mirror_image(&self, row: u32) -> Option<u32> {
        480_u32.checked_sub(row).filter(|image| *image < row)
    }
}

impl Field for Rp2040 {
    type Value = Dwell;

    fn size(&self) -> Size {
        Self::SIZE
    }

    fn at(&self, x: u32, y: u32) -> Dwell {
        // the numerator is a multiple of 128: 3 2^48 / 640 = 3 2^41 / 5
        self.0.dwell_at(Complex::new(Wide::from_bits(LEFT + FIFTHS * i64::from(x) / 5), Self::ordinate(y)))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Dwell> {
        let across = FIFTHS * i64::from(x.start);
        let abscissae = Abscissae { columns: x, re: LEFT + across / 5, fifths: across % 5 };
        let im = Self::ordinate(y);
        along(abscissae, move |re| self.0.dwell_at(Complex::new(re, im)))
    }
}

impl Rp2040 {
    fn ordinate(y: u32) -> Wide {
        const DOWN: i64 = Wide::lit("2").to_bits();
        Wide::from_bits((DOWN >> 1) - DOWN * i64::from(y) / 480)
    }
}

const LEFT: i64 = Wide::lit("-2").to_bits();
const FIFTHS: i64 = Wide::lit("3").to_bits() >> 7;

/// The real parts of a row, each carried along as a quotient and its remainder in fifths of a bit.
struct Abscissae {
    columns: Range<u32>,
    re: i64,
    fifths: i64,
}

impl Iterator for Abscissae {
    type Item = Wide;

    fn next(&mut self) -> Option<Wide> {
        self.columns.next()?;
        let re = Wide::from_bits(self.re);
        self.re += FIFTHS / 5;
        self.fifths += FIFTHS % 5;
        if self.fifths >= 5 {
            self.fifths -= 5;
            self.re += 1;
        }
        Some(re)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.columns.size_hint()
    }
}

impl ExactSizeIterator for Abscissae {}
impl FusedIterator for Abscissae {}

fn rp2040<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    // no palette: the frame's cost is the dwell's
    let picture = Picture::<_, _, C>::new(Rp2040::new()?, |dwell: Dwell| {
        Rgb888::new(dwell.count as u8, 0, dwell.is_inside() as u8)
    });
    let mut row = [Rgb888::BLACK; Rp2040::SIZE.width as usize];
    let bytes = size_of_val(&picture) + size_of_val(&row);
    let mirrored = picture.mirrored(&mut row)?;
    stage.show(&Image::new(&mirrored, Point::zero()), size_of_val(&mirrored) + bytes)
}

fn fern<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    stage.claim(size_of::<Ifs<4>>())?;
    let fern = BARNSLEY_FERN.ifs::<4>()?;
    let window = Window::fit(fern.bounds(), stage.size())?;
    let points = fern.seeded_chaos_game(1).take(stage.size().width as usize * 100);
    let dots = Dots::new(points, window, C::from(BinaryColor::On));
    stage.show(&dots, size_of_val(&dots) + size_of_val(&fern))
}

fn graph<C: Colour + Ink>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let f = figure_1()?;
    let (low, high) = f.range();
    let at = |x, y| Point2::new(Real::from_bits(x), y);
    let window = Window::stretch(Bounds2 { min: at(0, low), max: at(1 << 24, high) }, stage.size())?;
    let stroke = Stroke::new(f.graph(stage.size().width), window, C::from(BinaryColor::On));
    stage.show(&stroke, size_of_val(&stroke) + size_of_val(&f))
}

fn fif_mirror<C: Colour + Ink, const DEPTH: u32, const CELLS: usize>(
    stage: &mut Stage<'_>,
) -> Result<(), Failure> {
    stage.claim(size_of::<[Cell; CELLS]>() + size_of::<RayCaster<'_>>() + size_of::<Fif<2, 2>>())?;
    fif_mirror_with_room::<C, DEPTH, CELLS>(stage)
}

/// Not inlined: the cells are on this function's stack, and the claim comes before.
#[inline(never)]
fn fif_mirror_with_room<C: Colour + Ink, const DEPTH: u32, const CELLS: usize>(
    stage: &mut Stage<'_>,
) -> Result<(), Failure> {
    let mut memory = [Cell::ZERO; CELLS];
    let g = g_integral()?;
    let pyramid = Pyramid::new(&g, DEPTH, &mut memory)?;
    let caster = mirror(&pyramid, stage.size())?;
    let borrowed = size_of::<[Cell; CELLS]>() + size_of_val(&g) + size_of_val(&pyramid);
    field::<C, _, _>(stage, caster, Grey, borrowed)
}

/// A colour for each pixel, row by row.
struct Waves<C> {
    size: Size,
    tone: fn(u32, u32) -> C,
}

impl<C: Colour> Drawable for Waves<C> {
    type Color = C;
    type Output = ();

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        for y in 0..self.size.height {
            let row = Rectangle::new(Point::new(0, y as i32), Size::new(self.size.width, 1));
            target.fill_contiguous(&row, (0..self.size.width).map(|x| (self.tone)(x, y)))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Blind;

    /// With as much RAM as the largest target.
    struct Board;

    impl Machine for Board {
        fn instructions(&mut self) -> u32 {
            0
        }

        fn ram_free(&mut self) -> usize {
            128 << 10
        }
    }

    #[test]
    fn a_scene_too_large_for_a_board_is_refused_there_and_drawn_here() {
        let cells = 16 * ((1 << 14) - 1);
        let refused = TOO_LARGE.run(&mut Board).unwrap_err();
        assert!(matches!(refused, Failure::Ram { needed, .. } if needed > cells), "{refused}");
        assert!(TOO_LARGE.run(&mut Blind).unwrap().ram_bytes > cells);
    }
}
