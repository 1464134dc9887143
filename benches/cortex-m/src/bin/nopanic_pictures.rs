//! As `nopanic`, for what makes pictures: escape-time sets, drawing. An image of its own, so
//! that each fits the flash of a Cortex-M0.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::draw::{
    ColoredDots, Contrast, CourseUnit, Cycled, Dots, Grey, Inverted, LsbPages, Luminance, MsbRows, Packing,
    Palette, Picture, PixelBytes, RowCursor, Strips, Stroke, gradients,
};
use attractor::escape::{
    Arithmetic, Buffered, DeepMandelbrot, DeepView, Distance, EscapeTime, Filled, Interior, Julia,
    Mandelbrot, OrbitPoint, Pan, Smooth, View,
};
use attractor::num::Complex;
use attractor::num::{Real, Wide};
use attractor::plane::{Bounds2, Field, Point2, Window, from_fn};
use attractor::{Error, draw};
use attractor_cortex_m::{Wire, entry, semihosting};
use embedded_graphics::image::{GetPixel, Image};
use embedded_graphics::pixelcolor::{BinaryColor, Gray4, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    // what is refused is refused: only panics count
    let _ = bb(escape());
    let _ = bb(drawing());
    semihosting::process::exit(0)
}

fn escape() -> Result<(), Error> {
    let c = Complex::new(bb(Wide::ZERO), bb(Wide::ZERO));
    bb(View::home(bb(Wire::<Rgb565>::SIZE)))?;
    let view = View::new(c, bb(Wide::ONE), bb(Wire::<Rgb565>::SIZE))?;
    bb((view.point(bb(0), bb(0)), view.pitch(), view.width(), view.centre()));
    let set = Mandelbrot::new(view, bb(100))?;
    bb((set.dwell_at(c), set.row(bb(0), bb(0)..bb(100)).last(), set.row(bb(1), bb(0)..bb(100)).nth(bb(5))));
    bb(set.with_arithmetic(bb(Arithmetic::Word29))?.dwell_at(c));
    let julia = Julia::new(view, c, bb(100))?;
    bb((
        julia.dwell_at(c),
        julia.row(bb(0), bb(0)..bb(100)).last(),
        julia.row(bb(1), bb(0)..bb(100)).nth(bb(5)),
    ));
    bb((view.size(), view.pan(bb(1), bb(1))?, set.view(), set.max_dwell(), set.arithmetic()));
    bb((julia.view(), julia.constant(), julia.max_dwell(), julia.arithmetic()));
    bb(julia.with_arithmetic(bb(Arithmetic::Word26))?.dwell_at(c).is_inside());
    colorings(set, c)?;
    colorings(julia, c)?;
    deep()
}

/// What takes any escape-time picture.
#[inline(never)]
fn colorings<P: EscapeTime + Pan + Clone>(picture: P, point: P::Point) -> Result<(), Error> {
    let row = || (bb(1), bb(0)..bb(100));
    let smooth = Smooth(&picture);
    bb((smooth.value_at(point).is_inside(), smooth.row(row().0, row().1).nth(bb(3))));
    let distance = Distance(&picture);
    bb((distance.value_at(point), distance.row(row().0, row().1).nth(bb(3))));
    let interior = Interior(&picture);
    bb((interior.value_at(point), interior.row(row().0, row().1).nth(bb(3))));
    let mut counts = [0; 600];
    let mut canvas = Buffered::new(picture.clone(), bb(&mut counts[..]))?;
    canvas.pan(bb(1), bb(-1))?;
    bb((canvas.computed(), canvas.row(row().0, row().1).nth(bb(3))));
    let mut bits = [0; 150];
    let filled = Filled::new(&picture, bb(&mut bits[..]))?;
    bb((Filled::<P>::bytes(bb(Size::new(1, 1))), filled.at(bb(1), bb(1))));
    bb(filled.row(row().0, row().1).nth(bb(3)));
    let mut below = [0; 100];
    let palette = draw::Equalised::new(&smooth, &mut below, gradients::FIRE)?;
    bb((palette.level(bb(3)), picture.pitch(), picture.mirror_image(bb(3))));
    let shown = Picture::<_, _, BinaryColor>::new(&picture, CourseUnit);
    let mut line = [Rgb888::BLACK; 240];
    let Ok(()) = Image::new(&shown.mirrored(bb(&mut line[..]))?, bb(Point::zero())).draw(&mut Wire::new());
    Ok(())
}

fn deep() -> Result<(), Error> {
    let view = DeepView::<12>::parse(bb("-1.25"), bb("0.5"), bb("1e-90"), bb(Size::new(30, 20)))?;
    let view = DeepView::new(*view.centre(), *view.width(), view.size())?.pan(bb(1), bb(1))?;
    bb((view.point(bb(1), bb(1)), view.pitch_exponent()));
    let mut orbit = [OrbitPoint::default(); 200];
    bb(DeepMandelbrot::new(view, bb(100), &mut orbit)?);
    bb(DeepMandelbrot::orbit_points(&view, bb(100)));
    // which one is not known here
    let set = DeepMandelbrot::new_in(view, bb(100), bb(Arithmetic::Word64), &mut orbit)?;
    bb((set.dwell_at(bb(1), bb(1)), set.row(bb(1), bb(0)..bb(30)).nth(bb(2)), set.view()));
    bb((set.max_dwell(), set.arithmetic(), set.reference_len()));
    colorings(set, bb((1, 1)))
}

/// Every way to draw one field, a path and points, on three kinds of display.
fn drawing() -> Result<(), Error> {
    on::<BinaryColor>()?;
    on::<Gray4>()?;
    on::<Rgb565>()?;
    let view = View::home(Wire::<BinaryColor>::SIZE)?;
    let picture = Picture::<_, _, BinaryColor>::new(Mandelbrot::new(view, bb(10))?, Grey);
    let mut buffer = [0; 256];
    if let Some((_, strip)) = picture.lsb_pages(&mut buffer)?.next_strip() {
        bb(strip);
    }
    if let Some((_, strip)) = picture.msb_rows(&mut buffer)?.next_strip() {
        bb(strip);
    }
    bb(picture.pack::<LsbPages>(bb(0), bb(0)..bb(10), &mut buffer))?;
    let picture = Picture::<_, _, BinaryColor>::new(
        from_fn(bb(Size::new(30, 20)), |x, y| bb((x ^ y) as u8)),
        Inverted(Luminance(gradients::FIRE)),
    )
    .with_dither_origin(bb(Point::new(3, -2)));
    let area = Rectangle::new(bb(Point::new(5, 7)), bb(Size::new(99, 3)));
    let mut strips = Strips::<_, _, _, MsbRows>::of_part(&picture, &area, bb(&mut buffer[..]))?;
    strips.repeat();
    bb(strips.for_each(|y, strip| if bb(y) == bb(8) { Err(strip.len()) } else { Ok(()) }).is_ok());
    bb(Palette::rgb(&Contrast::new(Grey, bb(90), bb(200))?, bb(150_u8)));
    let picture =
        Picture::<_, _, Rgb565>::new(Mandelbrot::new(view, bb(10))?, Cycled::new(gradients::FIRE, bb(16)));
    bb(draw::Ramp::of_periods(bb(Grey)));
    let mut buffer = [0; 480];
    if let Some((_, strip)) = picture.big_endian(&mut buffer)?.next_strip() {
        bb(strip);
    }
    bb(picture.pack::<PixelBytes>(bb(0), bb(0)..bb(10), &mut buffer))?;
    bb(<PixelBytes as Packing<Rgb565>>::length(bb(10)));
    if let Some((_, strip)) = picture.words(&mut [0; 240])?.next_strip() {
        bb(strip);
    }
    Ok(())
}

fn on<C: draw::Ink + From<BinaryColor>>() -> Result<(), Error> {
    let mut display = Wire::<C>::new();
    let white = C::from(BinaryColor::On);
    let view = View::home(bb(Wire::<C>::SIZE))?;
    let picture = Picture::<_, _, C>::new(Mandelbrot::new(view, bb(10))?, CourseUnit);
    let Ok(()) = Image::new(&picture, bb(Point::zero())).draw(&mut display);
    let Ok(()) = picture.draw_row(&mut display, bb(3));
    bb(picture.pixel(bb(Point::zero())));
    let mut cursor = RowCursor::starting_at(bb(1));
    let Ok(more) = cursor.draw_next(&picture, &mut display);
    bb((more, cursor.row()));
    let bounds = Bounds2 { min: point(0), max: point(1 << 24) };
    bb(Window::stretch(bounds, bb(Wire::<C>::SIZE)))?;
    let window = Window::fit(bounds, bb(Wire::<C>::SIZE))?;
    let points = (0..bb(10)).map(point);
    let Ok(_) = Dots::new(points.clone(), window, white).at(bb(Point::zero())).draw(&mut display);
    let coloured = points.clone().map(|p| (p, bb(1_u32)));
    let Ok(_) = ColoredDots::<_, _, C>::new(coloured.clone(), window, gradients::DUSK).draw(&mut display);
    let moved = ColoredDots::<_, _, C>::new(coloured, window, gradients::DUSK).at(bb(Point::zero()));
    let Ok(_) = moved.with_dither_origin(bb(Point::zero())).draw_once(&mut display);
    let path = points.map(attractor::plane::PathElement::LineTo);
    let Ok(_) = Stroke::new(path, window, white).at(bb(Point::zero())).draw(&mut display);
    Ok(())
}

fn point(bits: i32) -> Point2 {
    Point2::new(bb(Real::from_bits(bits)), bb(Real::from_bits(bits)))
}
