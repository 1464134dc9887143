//! The scenes that are the target's own: the floor, patterns, and pictures of one room of core each.

use core::iter::FusedIterator;
use core::ops::Range;

use attractor::draw::{Dots, Grey, Ink, Palette, Picture, Srgb, Stroke};
use attractor::escape::{Dwell, Mandelbrot, View};
use attractor::fif::{Cell, Fif, Pyramid};
use attractor::ifs::Ifs;
use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::Complex;
use attractor::num::{Angle, Real, Wide, sin_cos};
use attractor::plane::{Bounds2, Field, Point2, Symmetric, Window, along};
use attractor::trace::{Extent, Filter, RayCaster, Sampling};
use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565, Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;

use crate::exported::{bowl, figure_1_f, figure_3_g, glass_spheres};
use crate::scene::{Scene, colour, mono, roomy};
use crate::sink::{Colour, Failure, Stage};
use crate::surface::mirror;

/// A world of the command with one ray a pixel in place of its samples.
macro_rules! once {
    ($stage:ident, $of:ident) => {{
        let (leaves, materials, lamps) = ($of::leaves()?, $of::materials()?, $of::lamps()?);
        let mut boxes = [Extent::NOTHING; $of::BOXES];
        let objects = $of::objects(&leaves, &mut boxes)?;
        let world = $of::world(&leaves, &objects, &materials, &lamps)?;
        let caster = $of::caster(world, $stage.size(), 1)?.with_sampling(Sampling::Centre, Filter::Box)?;
        let lent = size_of_val(&leaves)
            + size_of_val(&materials)
            + size_of_val(&lamps)
            + size_of::<[Extent; $of::BOXES]>()
            + size_of_val(&objects);
        field::<Rgb565, _, _>($stage, caster, Srgb, lent)
    }};
}

/// The first rows are the floor: a picture that computes nothing.
#[rustfmt::skip]
pub(crate) const ROWS: &[Scene] = &[
    colour("blank", blank::<Rgb565>),
    mono("blank", blank::<BinaryColor>),
    colour("waves", waves::<Rgb565>),
    mono("waves", waves::<BinaryColor>),
    Scene { size: Rp2040::SIZE, ..roomy(colour("mandelbrot rp2040", rp2040::<Rgb565>)) },
    colour("fern in dots", fern::<Rgb565>),
    mono("fern in dots", fern::<BinaryColor>),
    colour("fif graph", graph::<Rgb565>),
    mono("fif graph", graph::<BinaryColor>),
    roomy(colour("fif mirror", fif_mirror::<Rgb565, 8, { Pyramid::cells(2, 8) }>)),
    roomy(mono("fif mirror", fif_mirror::<BinaryColor, 8, { Pyramid::cells(2, 8) }>)),
    mono("fif mirror of depth 6", fif_mirror::<BinaryColor, 6, { Pyramid::cells(2, 6) }>),
];

/// Worlds of the command with one ray a pixel.
pub(crate) const WORLDS: &[Scene] = &[
    roomy(colour("bowl of one sample", |stage| once!(stage, bowl))),
    roomy(colour("glass spheres of one sample", |stage| once!(stage, glass_spheres))),
];

/// A mirror whose pyramid is larger than the RAM of any of the targets: each must refuse it.
pub(crate) const TOO_LARGE: Scene =
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
fn field<C: Colour + Ink, F: Field, P: Palette<F::Value>>(
    stage: &mut Stage<'_>,
    field: F,
    palette: P,
    borrowed: usize,
) -> Result<(), Failure> {
    let picture = Picture::<F, P, C>::new(field, palette);
    stage.show(&Image::new(&picture, Point::zero()), size_of_val(&picture) + borrowed)
}

/// The frame that was published for the RP2040: `c = (-2 + 3 i / 640, 1 - 2 j / 480)`, at most 1000
/// iterations. Its pixels are not square.
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
    let f = figure_1_f::function::<2, 1>()?;
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
    let g = figure_3_g::function::<2, 2>()?;
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
