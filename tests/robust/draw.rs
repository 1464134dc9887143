//! From values to pixels: any palette, ink and packing; images, strips, points and paths anywhere on targets
//! anywhere.

use std::cell::Cell as Counter;
use std::fmt::Debug;
use std::marker::PhantomData;

use attractor::draw::{
    Brightened, ColoredDots, Contrast, CourseUnit, Cycled, Dithered, Dots, Equalised, Gradient, Grey, Ink,
    Inside, Inverted, Level, Leveled, Lines, LsbPages, Luminance, MsbRows, Packing, Palette, Picture,
    PixelBytes, PixelWords, Ramp, RowCursor, Srgb, Strips, Stroke, bayer, dithered, gradients, hex, luma,
};
use attractor::escape::{Dwell, FractionalDwell, Period};
use attractor::fixed::types::U21F11;
use attractor::num::Real;
use attractor::plane::Tone;
use attractor::plane::{Bounds2, Field, FromFn, PathElement, Point2, Window, from_fn};
use attractor::plane::{Hits, LinearRgb};
use embedded_graphics::geometry::{Dimensions, OriginDimensions, Point, Size};
use embedded_graphics::image::{GetPixel, ImageDrawable};
use embedded_graphics::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, PixelColor, Rgb555, Rgb565,
    Rgb666, Rgb888, RgbColor,
};
use embedded_graphics::prelude::{DrawTarget, Drawable, Pixel};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::transform::Transform;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{fuzz, point, size, word};

/// A target whose box may lie anywhere, which accepts no pixel outside it, and breaks after some.
struct Target<C> {
    area: Rectangle,
    drawn: u32,
    /// How many pixels it takes.
    room: u32,
    color: PhantomData<C>,
}

#[derive(Debug, PartialEq)]
struct Broken;

impl<C> Target<C> {
    fn new(area: Rectangle, room: u32) -> Self {
        Self { area, drawn: 0, room, color: PhantomData }
    }

    fn take(&mut self, x: i64, y: i64) -> Result<(), Broken> {
        let Rectangle { top_left, size } = self.area;
        let inside =
            |p: i64, start: i32, length: u32| (0..i64::from(length)).contains(&(p - i64::from(start)));
        assert!(inside(x, top_left.x, size.width) && inside(y, top_left.y, size.height), "{x}, {y} outside");
        if self.drawn == self.room {
            return Err(Broken);
        }
        self.drawn += 1;
        Ok(())
    }
}

impl<C> Dimensions for Target<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Target<C> {
    type Color = C;
    type Error = Broken;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Broken> {
        pixels.into_iter().try_for_each(|Pixel(at, _)| self.take(at.x.into(), at.y.into()))
    }

    /// By itself, as that of embedded-graphics overflows at the ends of i32.
    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Broken> {
        let Rectangle { top_left, size: Size { width, height } } = *area;
        let mut places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        for _ in colors {
            let (x, y) = places.next().expect("as many colours as pixels");
            self.take(i64::from(top_left.x) + i64::from(x), i64::from(top_left.y) + i64::from(y))?;
        }
        assert!(places.next().is_none(), "fewer colours than pixels");
        Ok(())
    }
}

/// The part that intervals, by start and length, have in common, and that has coordinates in 32 bits.
fn common(spans: &[(i64, i64)]) -> std::ops::Range<i64> {
    let start = spans.iter().map(|s| s.0).max().unwrap_or(0);
    let end = spans.iter().map(|s| s.0 + s.1).min().unwrap_or(0).min(1 << 31);
    start..end.max(start)
}

fn length(span: &std::ops::Range<i64>) -> u32 {
    u32::try_from(span.end - span.start).expect("a part of a picture")
}

fn corner() -> impl Strategy<Value = Point> {
    let any_corner = (word(), word()).prop_map(|(x, y)| Point::new(x, y));
    prop_oneof![1 => any_corner, 3 => (-24..24, -24..24).prop_map(|(x, y)| Point::new(x, y))]
}

/// A few pixels or none, wherever they are.
fn small_area() -> impl Strategy<Value = Rectangle> {
    (corner(), (0..=48_u32, 0..=48_u32)).prop_map(|(at, (w, h))| Rectangle::new(at, Size::new(w, h)))
}

/// Of any size, none and all that there are included.
fn any_size() -> impl Strategy<Value = Size> {
    let side = || prop_oneof![12 => 0..=60_u32, 1 => Just(0), 1 => Just(u32::MAX), 1 => any::<u32>()];
    (side(), side()).prop_map(|(w, h)| Size::new(w, h))
}

fn any_level() -> impl Strategy<Value = Level> {
    prop_oneof![any::<u16>(), prop::sample::select(vec![0, 1, 32_767, 32_768, u16::MAX - 1, u16::MAX])]
        .prop_map(Level::from_bits)
}

/// A field that counts its evaluations and must not be asked beyond itself.
fn counted(size: Size, evaluated: &Counter<u32>) -> FromFn<impl Fn(u32, u32) -> u8 + Copy> {
    from_fn(size, move |x, y| {
        assert!(x < size.width && y < size.height, "{x}, {y} of {size:?}");
        evaluated.set(evaluated.get() + 1);
        (x.wrapping_mul(37) ^ y.wrapping_mul(101)) as u8
    })
}

/// A palette that counts its calls.
fn counting(painted: &Counter<u32>) -> impl Fn(u8) -> Rgb888 + Copy {
    move |value| {
        painted.set(painted.get() + 1);
        Rgb888::new(value, !value, value >> 1)
    }
}

#[test]
fn closures_as_fields_of_any_size() {
    fuzz((any_size(), any::<[u32; 3]>(), any::<usize>()), 99, |(size, [y, a, b], skip)| {
        let evaluated = Counter::new(0);
        let field = from_fn(size, |x, y| {
            evaluated.set(evaluated.get() + 1);
            (x, y)
        });
        assert_eq!(field.size(), size);
        let mut row = field.row(y, a.min(b)..a.max(b));
        // what lies beyond the picture has no pixels
        let columns = a.min(b).min(size.width)..a.max(b).min(size.width);
        assert_eq!(row.len(), columns.len());
        let got = row.nth(skip % 4096).map(|(x, _)| x);
        assert_eq!(got, columns.clone().nth(skip % 4096));
        assert!(row.nth(usize::MAX).is_none() && row.next().is_none() && evaluated.get() <= 1);
        assert_eq!(field.row(y, a.max(b)..a.min(b)).take(3).count(), 0);
        true
    });
}

/// A value by all palettes: what is inside is black, and the same colour comes by reference and through
/// `dyn`.
fn paint<V: Leveled + Copy + Debug>(
    value: V,
    gradient: &Gradient<3>,
    (period, offset): (u32, u32),
    below: &Equalised<'_, Grey>,
) {
    let ramp = Ramp::new([hex(0x112233), hex(u32::MAX), hex(0)]);
    let cycled = Cycled::new(gradients::PORCELAIN, period).with_offset(offset);
    assert_eq!(cycled.palette(), &gradients::PORCELAIN);
    let periods = Ramp::of_periods(gradients::FIRE);
    let palettes: [&dyn Palette<V>; 15] = [
        &CourseUnit,
        &Grey,
        &Brightened(Grey),
        gradient,
        &cycled,
        &ramp,
        &periods,
        below,
        &gradients::DUSK,
        &gradients::OCEAN,
        &gradients::MOSS,
        &Luminance(Grey),
        &Contrast::new(Grey, 90, 91).unwrap(),
        &Inside::new(Grey, hex(0)),
        &Brightened(&cycled),
    ];
    for (k, palette) in palettes.into_iter().enumerate() {
        let color = palette.rgb(value);
        assert!(!value.is_inside() || color == Rgb888::BLACK, "palette {k}: {color:?} for {value:?}");
        assert_eq!((&palette).rgb(value), color);
        let negative = Inverted(palette).rgb(value);
        assert_eq!((color.r(), color.g(), color.b()), (!negative.r(), !negative.g(), !negative.b()));
        let grey = Luminance(palette).rgb(value);
        let (least, most) =
            (color.r().min(color.g()).min(color.b()), color.r().max(color.g()).max(color.b()));
        assert!(grey.r() == grey.g() && grey.g() == grey.b() && grey.r() <= most, "{grey:?} for {color:?}");
        assert!((luma(color) >= least) && luma(color) <= most);
    }
    let inside = Inside::new(Grey, hex(0x0a0b0c)).rgb(value);
    assert_eq!(inside == hex(0x0a0b0c), value.is_inside());
}

#[test]
fn palettes_of_any_value() {
    let stops = [any_level(), any_level(), any_level()];
    let values = (any::<(u32, u32)>(), word(), any::<(bool, u8, u16)>());
    fuzz((stops, values, any::<[u32; 3]>(), any::<(u32, u32)>()), 60, |(mut stops, values, colors, wind)| {
        let [first, second, third] = colors.map(hex);
        if wind.0 % 4 != 0 {
            stops.sort_unstable();
        }
        let made = Gradient::new([(stops[0], first), (stops[1], second), (stops[2], third)]);
        assert_eq!(made.is_ok(), stops[0] < stops[1] && stops[1] < stops[2]);
        let gradient = made.unwrap_or(Gradient::evenly([first, second, third]));
        let ((count, max), bits, (yes, byte, short)) = values;
        let level = Level::from_bits(short);
        let between = |color: Rgb888, a: Rgb888, b: Rgb888| {
            let parts = |c: Rgb888| [c.r(), c.g(), c.b()];
            parts(color)
                .into_iter()
                .zip(parts(a))
                .zip(parts(b))
                .all(|((c, a), b)| a.min(b) <= c && c <= a.max(b))
        };
        if made.is_ok() {
            let at = gradient.at(level);
            let ends = match level {
                level if level < stops[0] => (first, first),
                level if level < stops[1] => (first, second),
                level if level < stops[2] => (second, third),
                _ => (third, third),
            };
            assert!(between(at, ends.0, ends.1), "{at:?} at {level:?} of {gradient:?}");
        }
        let ratio = Level::ratio(count, max);
        assert_eq!(ratio == Level::FULL, max > 0 && u128::from(count) * 131_070 >= u128::from(max) * 131_069);
        let picture = from_fn(Size::new(9, 3), |x, y| (x * y) as u8);
        let mut counts = [0; 17];
        let Ok(below) = Equalised::new(&picture, &mut counts, Grey) else { panic!("17 counts") };
        assert!(below.level(count) <= Level::FULL && below.level(0) == Level::ZERO);
        assert!(Equalised::new(&picture, &mut [0; 16], Grey).is_err());
        let dwell = Dwell { count, max };
        let fractional = FractionalDwell { dwell: U21F11::from_bits(count), max };
        paint(level, &gradient, wind, &below);
        paint(yes, &gradient, wind, &below);
        paint(byte, &gradient, wind, &below);
        paint(short, &gradient, wind, &below);
        paint(count, &gradient, wind, &below);
        paint(Real::from_bits(bits), &gradient, wind, &below);
        paint(dwell, &gradient, wind, &below);
        paint(fractional, &gradient, wind, &below);
        paint(Period::new(count), &gradient, wind, &below);
        paint(Hits { count: short, tone: max as u16, map: byte }, &gradient, wind, &below);
        paint(Tone::from_bits(short), &gradient, wind, &below);
        paint(yes.then_some(dwell), &gradient, (0, u32::MAX), &below);
        made.is_ok()
    });
    assert!(
        Gradient::<0>::new([]).is_err()
            && Gradient::new([(Level::FULL, hex(7))]).is_ok_and(|g| g.at(Level::ZERO) == hex(7))
    );
    let even = Gradient::evenly([hex(0); 256]);
    assert_eq!(even.at(Level::FULL), hex(0));
    assert_eq!(Gradient::evenly([hex(9)]).at(Level::from_bits(1)), hex(9));
}

fn ink<C: Ink + Debug>(rgb: Rgb888, at: Point) -> C {
    let color = C::ink(rgb, at);
    // a square of the matrix on, the same
    let on = Point::new(at.x.wrapping_add(8), at.y.wrapping_sub(64));
    assert_eq!(C::ink(rgb, on), color);
    assert_eq!(C::dithered_ink(rgb, on), C::dithered_ink(rgb, at));
    color
}

#[test]
fn inks_of_any_colour_anywhere() {
    fuzz((any::<u32>(), corner(), any::<(u8, u8)>()), 99, |(color, at, (value, max))| {
        let rgb = hex(color);
        assert!(bayer(at) < 64);
        let level = dithered(value, max, at);
        assert_eq!((dithered(0, max, at), dithered(255, max, at)), (0, max));
        let exact = u32::from(value) * u32::from(max) / 255;
        assert!(level <= max && (exact..=exact + 1).contains(&u32::from(level)), "{value} of {max}: {level}");
        let (on, two, four) = (ink::<BinaryColor>(rgb, at), ink::<Gray2>(rgb, at), ink::<Gray4>(rgb, at));
        assert!(two.luma() <= 3 && four.luma() <= 15 && ink::<Gray8>(rgb, at).luma() == luma(rgb));
        assert!(on.is_on() || luma(rgb) < 255);
        let light = LinearRgb::new(color as u16, (color >> 8) as u16, (color >> 16) as u16);
        let shown = Picture::<_, _, Rgb565>::new(from_fn(Size::new(1, 1), |_, _| light), Srgb);
        let again = Picture::<_, _, Rgb565>::new(from_fn(Size::new(1, 1), |_, _| light), Dithered(&Srgb));
        assert_eq!(shown.pixel(Point::zero()), again.pixel(Point::zero()));
        let wide = ink::<Rgb888>(rgb, at);
        assert_eq!((wide, Rgb888::from(ink::<Bgr888>(rgb, at))), (rgb, rgb));
        assert_eq!(Rgb565::from(ink::<Bgr565>(rgb, at)), ink::<Rgb565>(rgb, at));
        assert_eq!(Rgb555::from(ink::<Bgr555>(rgb, at)), ink::<Rgb555>(rgb, at));
        assert_eq!(Rgb666::from(ink::<Bgr666>(rgb, at)), ink::<Rgb666>(rgb, at));
        true
    });
}

/// What is seen is evaluated, once, and nothing else.
#[test]
fn images_of_any_size_anywhere() {
    let targets = (small_area(), prop_oneof![3 => Just(u32::MAX), 1 => 0..900_u32]);
    let area = (corner(), any_size()).prop_map(|(at, size)| Rectangle::new(at, size));
    fuzz(
        (any_size(), targets, area, corner(), any::<[u32; 3]>()),
        33,
        |(size, (target, room), area, origin, at)| {
            let (evaluated, painted) = (Counter::new(0), Counter::new(0));
            let picture = Picture::<_, _, BinaryColor>::new(counted(size, &evaluated), counting(&painted));
            let picture = picture.with_dither_origin(origin);
            let (w, h) = (i64::from(size.width), i64::from(size.height));
            let Rectangle { top_left: Point { x: left, y: top }, size: screen } = target;
            let (left, top) = (i64::from(left), i64::from(top));
            let visible = (
                common(&[(0, w), (left, screen.width.into())]),
                common(&[(0, h), (top, screen.height.into())]),
            );
            let pixels = length(&visible.0) * length(&visible.1);
            let settled = |drawn: Result<(), Broken>, target: &Target<BinaryColor>, pixels: u32| {
                assert_eq!(drawn, if pixels <= room { Ok(()) } else { Err(Broken) });
                assert_eq!(target.drawn, pixels.min(room));
                // of what a broken target does not take the first pixel is known
                let (looked, colored) = (evaluated.take(), painted.take());
                assert!(
                    looked == colored
                        && (looked == target.drawn || looked == target.drawn + 1 && pixels > room)
                );
            };
            assert_eq!((picture.size(), picture.field().size()), (size, size));
            assert!(picture.palette()(0) == hex(0x00ff00) && painted.take() == 1);
            let mut whole = Target::new(target, room);
            settled(picture.draw(&mut whole), &whole, pixels);

            // the area's first pixel comes to lie on the origin
            let (x, y) = (i64::from(area.top_left.x), i64::from(area.top_left.y));
            let columns = common(&[(0, w), (x, area.size.width.into()), (x + left, screen.width.into())]);
            let rows = common(&[(0, h), (y, area.size.height.into()), (y + top, screen.height.into())]);
            let mut part = Target::new(target, room);
            settled(picture.draw_sub_image(&mut part, &area), &part, length(&columns) * length(&rows));

            for y in [0, at[0], at[0] % size.height.max(1), u32::MAX] {
                let shown = if visible.1.contains(&i64::from(y)) { length(&visible.0) } else { 0 };
                let mut row = Target::new(target, room);
                settled(picture.draw_row(&mut row, y), &row, shown);
            }

            // as many steps as rows are seen, and one that says so
            let first = (i64::from(at[1]) % 70).max(visible.1.start);
            let rows = u32::try_from((visible.1.end - first).max(0)).expect("rows of a picture");
            let mut cursor = RowCursor::starting_at(at[1] % 70);
            let mut target = Target::new(target, u32::MAX);
            let mut steps = 0;
            while cursor.draw_next(&picture, &mut target) == Ok(true) {
                steps += 1;
                assert!(steps <= rows, "{steps} of {rows} rows");
            }
            assert!(steps == rows || length(&visible.0) == 0 && steps == 0);
            assert_eq!(target.drawn, steps * length(&visible.0));
            assert_eq!(RowCursor::starting_at(u32::MAX).draw_next(&picture, &mut target), Ok(false));
            assert!(RowCursor::new() == RowCursor::default() && steps == 0 || cursor.row() > 0);
            evaluated.take();
            painted.take();

            // single pixels, and rows with a hole
            for p in [
                Point::new(at[0] as i32, at[1] as i32),
                Point::zero(),
                origin,
                Point::new(i32::MAX, i32::MIN),
            ] {
                let (inside_x, inside_y) =
                    ((0..w).contains(&i64::from(p.x)), (0..h).contains(&i64::from(p.y)));
                assert_eq!(picture.pixel(p).is_some(), inside_x && inside_y);
                assert_eq!(evaluated.take(), u32::from(inside_x && inside_y));
            }
            for (a, b) in [(at[1], at[2]), (0, u32::MAX), (at[1] % 60, at[1] % 60 + 9)] {
                let Some(mut colors) = picture.colors(at[0], a..b) else {
                    assert!(at[0] >= size.height);
                    continue;
                };
                let expected = b.min(size.width) as usize - (a.min(b.min(size.width))) as usize;
                assert_eq!(colors.len(), expected);
                let skip = at[2] as usize % 61;
                assert_eq!(colors.nth(skip).is_some(), skip < expected);
                assert_eq!(colors.len(), expected.saturating_sub(skip + 1));
                assert!(colors.nth(usize::MAX).is_none() && evaluated.take() <= 1);
            }
            pixels > 0
        },
    );
}

/// The strips of a part by one packing.
fn strips_of<C: Ink, K: Packing<C>>(
    size: Size,
    area: &Rectangle,
    buffer: &mut [K::Unit],
    at: [u32; 3],
) -> bool
where
    K::Unit: PartialEq + Debug,
{
    let (evaluated, painted) = (Counter::new(0), Counter::new(0));
    let picture = Picture::<_, _, C>::new(counted(size, &evaluated), counting(&painted));
    let (given, Rectangle { top_left: Point { x, y }, size: wanted }) = (buffer.len(), *area);
    let columns = common(&[(0, size.width.into()), (x.into(), wanted.width.into())]);
    let rows = common(&[(0, size.height.into()), (y.into(), wanted.height.into())]);
    let packed = picture.pack::<K>(at[0], at[1]..at[2], buffer).map(<[_]>::len);
    let expected = K::length(at[2].min(size.width).saturating_sub(at[1]));
    assert_eq!(packed.ok(), (at[0] < size.height && expected <= given).then_some(expected));
    assert_eq!(Strips::<_, _, _, K>::new(&picture, buffer).is_ok(), K::length(size.width) <= given);
    evaluated.take();
    painted.take();
    let Ok(mut strips) = Strips::<_, _, _, K>::of_part(&picture, area, buffer) else {
        assert!(K::length(length(&columns)) > given);
        return false;
    };
    assert!(
        K::length(length(&columns)) <= given
            && strips.next_strip().is_none() == (columns.is_empty() || rows.is_empty())
    );
    let pixels = |strips: u32| (strips * K::ROWS).min(length(&rows)) * length(&columns);
    assert_eq!(evaluated.get(), pixels(1));
    // as it lies in the buffer
    strips.repeat();
    let again = strips.next_strip().map(|(y, strip)| (i64::from(y), strip.to_vec()));
    assert_eq!(again.is_some(), pixels(1) > 0);
    assert!(again.is_none_or(|(y, strip)| y == rows.start && strip.len() == K::length(length(&columns))));
    assert_eq!(evaluated.get(), pixels(1));
    // a sink that takes two, and breaks
    let mut sent = 0;
    let sink = |y: u32, _: &[K::Unit]| {
        sent += 1;
        assert_eq!(i64::from(y), rows.start + i64::from(sent * K::ROWS));
        if sent < 3 { Ok(()) } else { Err(Broken) }
    };
    let ended = strips.for_each(sink);
    let all = if pixels(1) > 0 { length(&rows).div_ceil(K::ROWS) } else { 0 };
    assert_eq!((ended, sent), if all >= 4 { (Err(Broken), 3) } else { (Ok(()), all.saturating_sub(1)) });
    assert_eq!(evaluated.get(), pixels(sent + 1));
    assert_eq!(strips.next_strip().is_some(), all >= 4);
    assert_eq!((evaluated.get(), painted.get()), (pixels(sent + 1), pixels(sent + 1)));
    pixels(1) > 0
}

#[test]
fn strips_of_any_part() {
    let area = (corner(), any_size()).prop_map(|(at, size)| Rectangle::new(at, size));
    let whole = any_size().prop_map(|size| Rectangle::new(Point::zero(), size));
    let given = prop_oneof![0..200_usize, Just(0), Just(3000)];
    fuzz((any_size(), prop_oneof![area, whole], given, any::<[u32; 3]>()), 22, |(size, area, given, at)| {
        let at = if at[0] % 2 == 0 { at } else { at.map(|v| v % 60) };
        let (bytes, words) = (&mut vec![0xa5; given], &mut vec![0xa5a5; given]);
        let mut packed = strips_of::<Rgb565, Lines>(size, &area, &mut vec![Rgb565::BLACK; given], at);
        packed |= strips_of::<Rgb565, PixelBytes>(size, &area, bytes, at);
        packed |= strips_of::<Rgb666, PixelBytes>(size, &area, bytes, at);
        packed |= strips_of::<Gray8, PixelBytes>(size, &area, bytes, at);
        packed |= strips_of::<Rgb565, PixelWords>(size, &area, words, at);
        packed |= strips_of::<BinaryColor, MsbRows>(size, &area, bytes, at);
        packed |= strips_of::<Gray2, MsbRows>(size, &area, bytes, at);
        packed |= strips_of::<Gray4, MsbRows>(size, &area, bytes, at);
        packed |= strips_of::<BinaryColor, LsbPages>(size, &area, bytes, at);
        // the short ways to them
        let (width, looked) = (size.width as usize, Counter::new(0));
        let field = counted(size, &looked);
        let one = Picture::<_, _, BinaryColor>::new(field, Grey);
        let wide = Picture::<_, _, Rgb565>::new(field, Grey);
        assert_eq!(wide.lines(&mut vec![Rgb565::BLACK; given]).is_ok(), width <= given);
        assert_eq!(wide.big_endian(bytes).is_ok(), 2 * width <= given);
        assert_eq!(wide.words(words).is_ok(), width <= given);
        assert_eq!(one.msb_rows(bytes).is_ok(), width.div_ceil(8) <= given);
        assert_eq!(one.lsb_pages(bytes).is_ok(), width <= given);
        packed
    });
}

/// Points and paths through any window: each step is taken once, each dot coloured once.
#[test]
fn windows_points_and_paths_anywhere() {
    let target = (corner(), size()).prop_map(|(top_left, size)| Rectangle::new(top_left, size));
    let steps = vec((point(), any::<bool>()), 0..12);
    let description = (point(), point(), size(), any::<bool>());
    let places = (corner(), corner());
    fuzz((description, steps, places, target), 42, |((a, b, size, tidy), steps, (at, by), target)| {
        let mut bounds = Bounds2 { min: a, max: b };
        if tidy {
            bounds.min = Point2::new(a.x.min(b.x), a.y.min(b.y));
            bounds.max = Point2::new(a.x.max(b.x), a.y.max(b.y));
        }
        let windows = [Window::stretch(bounds, size), Window::fit(bounds, size)];
        let accepted = windows[0].is_ok();
        assert!(windows[1].is_ok() || !accepted, "what can be stretched can be fitted");
        for window in windows.into_iter().flatten() {
            let shown = window.bounds();
            assert!(shown.min.x < shown.max.x && shown.min.y < shown.max.y && window.size() == size);
            for (p, _) in &steps {
                let (column, row) = window.raster(*p);
                assert!(column.abs() <= 1 << 47 && row.abs() <= 1 << 47);
                if let Some(pixel) = window.pixel(*p) {
                    assert_eq!((i64::from(pixel.x), i64::from(pixel.y)), (column, row));
                    assert!(Rectangle::new(Point::zero(), window.size()).contains(pixel));
                }
            }
            let taken = Counter::new(0_usize);
            let count = || taken.set(taken.get() + 1);
            let path = steps
                .iter()
                .map(|(p, pen)| if *pen { PathElement::LineTo(*p) } else { PathElement::MoveTo(*p) });
            let stroke = Stroke::new(path.inspect(|_| count()), window, BinaryColor::On).at(at);
            for stroke in [stroke.clone(), stroke.translate(by)] {
                let mut canvas = Target::new(target, u32::MAX);
                assert_eq!(stroke.draw(&mut canvas), Ok(canvas.drawn));
                // as long as the target is wide or high, and no longer
                let most =
                    u64::from(target.size.width.max(target.size.height)).min(1 << 15) * steps.len() as u64;
                assert!(u64::from(canvas.drawn) <= most && taken.take() == steps.len());
                let mut once = Target::new(target, canvas.drawn / 2);
                let ended = stroke.draw_once(&mut once);
                assert_eq!(ended, if canvas.drawn == 0 { Ok(0) } else { Err(Broken) });
                taken.take();
            }

            // dots have no part in clipping: a target that is large enough takes them
            let everywhere = Rectangle::new(Point::new(i32::MIN, i32::MIN), Size::new(u32::MAX, u32::MAX));
            let inside = steps.iter().filter(|(p, _)| window.pixel(*p).is_some()).count() as u32;
            let dots =
                Dots::new(steps.iter().map(|(p, _)| *p).inspect(|_| count()), window, BinaryColor::On).at(at);
            let painted = Counter::new(0);
            let palette = |value: u8| counting(&painted)(value);
            let points = steps.iter().map(|(p, pen)| (*p, u8::from(*pen))).inspect(|_| count());
            let colored =
                ColoredDots::<_, _, Gray4>::new(points, window, palette).with_dither_origin(by).at(at);
            for by in [Point::zero(), by] {
                let mut screen = Target::new(everywhere, u32::MAX);
                let dots = dots.translate(by);
                assert_eq!(dots.bounding_box().size, window.size());
                // the last column and row of all coordinates are outside the widest box that there is
                let at_the_end = |p: Point| {
                    let place = |a: i32, b: i32, c: i32| i64::from(a.saturating_add(b)) + i64::from(c);
                    place(at.x, by.x, p.x) >= i64::from(i32::MAX)
                        || place(at.y, by.y, p.y) >= i64::from(i32::MAX)
                };
                if steps.iter().filter_map(|(p, _)| window.pixel(*p)).any(at_the_end) {
                    continue;
                }
                assert_eq!(dots.draw(&mut screen), Ok(inside));
                assert!(screen.drawn == inside && taken.take() == steps.len());
                let mut screen = Target::new(everywhere, u32::MAX);
                let colored = colored.clone().translate(by);
                assert_eq!(colored.draw(&mut screen), Ok(inside));
                assert!(taken.take() == steps.len() && screen.drawn == inside && painted.take() == inside);
                assert_eq!(dots.draw_once(&mut Target::new(everywhere, u32::MAX)), Ok(inside));
                assert_eq!(colored.draw_once(&mut screen), Ok(inside));
                assert_eq!((taken.take(), painted.take()), (2 * steps.len(), inside));
            }
        }
        accepted
    });
}
