//! The Mandelbrot set and Julia pictures through any view, their colourings, and the buffers that hold them.

use std::cell::Cell as Counter;

use attractor::draw::{Equalised, Grey, Picture, gradients};
use attractor::escape::{
    Arithmetic, Buffered, Distance, Dwell, EscapeTime, Filled, Interior, Julia, MAX_DWELL, MAX_PERIOD,
    Mandelbrot, Smooth, View,
};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::{Field, MAX_SIDE, checked_size, from_fn};
use embedded_graphics::image::Image;
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use embedded_graphics::prelude::*;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{complex, fuzz, part_of_a_row, size, wide};

/// What is told of any point of a picture of at most `max` iterations.
fn colourings<P: EscapeTime<Point = Complex<Wide>> + Copy>(picture: P, max: u32, place: Complex<Wide>) {
    let dwell = EscapeTime::dwell_at(&picture, place);
    assert!(dwell.count <= max && dwell.max == max && picture.max_dwell() == max);
    let smooth = Smooth(picture).value_at(place);
    assert!(smooth.is_inside() == dwell.is_inside() && smooth.dwell <= max, "{smooth:?} for {dwell:?}");
    assert_eq!(Distance(picture).value_at(place).is_none(), dwell.is_inside());
    let period = Interior(picture).value_at(place);
    assert!(period.is_none_or(|period| period.length() <= MAX_PERIOD), "{period:?}");
    let size = picture.size();
    for (y, x) in [(0, 0..0), (u32::MAX, 0..3), (0, size.width..u32::MAX), (size.height, u32::MAX..u32::MAX)]
    {
        assert!(picture.line(y, x.clone()).len() <= 3);
        assert!(picture.row(y, x.clone()).count() <= 3 && Smooth(picture).row(y, x.clone()).count() <= 3);
        assert!(Distance(picture).row(y, x.clone()).count() <= 3 && Interior(picture).row(y, x).count() <= 3);
    }
}

#[test]
fn escape_times_of_any_view() {
    let width = prop_oneof![wide(), (1_i64 << 40..1 << 51).prop_map(Wide::from_bits)];
    let dwell = prop_oneof![4 => 0..300_u32, 1 => any::<u32>()];
    let description = (complex(), width, size(), dwell, complex());
    let pan = (any::<i32>(), any::<i32>());
    fuzz(
        (description, any::<[u32; 3]>(), complex(), pan),
        40,
        |((centre, width, size, dwell, c), at, place, by)| {
            assert_eq!(
                checked_size(size).is_ok(),
                (1..=MAX_SIDE).contains(&size.width) && (1..=MAX_SIDE).contains(&size.height)
            );
            assert_eq!(View::home(size).is_ok_and(|home| home.pitch() > 0), checked_size(size).is_ok());
            let Ok(view) = View::new(centre, width, size) else { return false };
            assert_eq!(
                (view.centre(), view.width(), view.size(), view.panned()),
                (centre, width, size, (0, 0))
            );
            for by in [by, (by.0 >> 20, by.1 >> 20), (i32::MIN, i32::MAX), (0, i32::MIN)] {
                if let Ok(moved) = view.pan(by.0, by.1) {
                    assert_eq!(moved.panned(), by);
                    moved.point(at[0], u32::MAX);
                    let _ = moved.pan(by.0, i32::MIN).map(|further| further.point(0, 0));
                }
            }
            view.point(at[0], at[1]);
            assert_eq!(view.point(u32::MAX, u32::MAX), view.point(size.width - 1, size.height - 1));
            assert_eq!(Mandelbrot::new(view, dwell).is_ok(), (1..=MAX_DWELL).contains(&dwell));
            let steps = dwell.clamp(1, 2000);
            let set = Mandelbrot::new(view, steps).expect("a limit above 0");
            let skip = (at[2] % 64) as usize;
            for arithmetic in [set.arithmetic(), Arithmetic::Word29, Arithmetic::Word26] {
                let set = set.with_arithmetic(arithmetic).expect("words");
                assert_eq!((set.view(), set.max_dwell(), set.arithmetic()), (&view, steps, arithmetic));
                part_of_a_row(&set, at[0], at[1], skip);
                assert!(set.dwell_at(place).count <= steps);
                assert!(set.row(at[0], at[1]..at[2]).count() <= 1 << 14);
                colourings(set, steps, place);
            }
            // few iterations, beside the circle: what is outside is shown as outside
            for steps in 1..4 {
                let set = Mandelbrot::new(view, steps).expect("a limit above 0");
                for (re, im) in
                    [(-33, 0), (32, 0), (33, 0), (23, 23), (0, -33), (i16::MIN, i16::MAX), (8, 16)]
                {
                    colourings(set, steps, Complex::new(Wide::from_num(re) / 16, Wide::from_num(im) / 16));
                }
            }
            if let Ok(set) = Julia::new(view, c, steps) {
                assert_eq!((set.view(), set.constant(), set.max_dwell()), (&view, c, steps));
                for arithmetic in [set.arithmetic(), Arithmetic::Word29, Arithmetic::Word26] {
                    let set = set.with_arithmetic(arithmetic).expect("words");
                    part_of_a_row(&set, at[0], at[1], skip);
                    assert!(set.dwell_at(place).count <= steps);
                    colourings(set, steps, place);
                }
            }
            true
        },
    );
}

/// What needs a buffer, over a picture small enough to be computed whole.
#[test]
fn buffers_and_colourings_of_any_view() {
    let size = (1..=20_u32, 1..=20_u32).prop_map(|(w, h)| Size::new(w, h));
    let width = prop_oneof![wide(), (1_i64 << 22..1 << 50).prop_map(Wide::from_bits)];
    let description =
        (complex(), width, size, 1..200_u32, any::<[u32; 2]>(), (-30..30_i32, -30..30_i32), 0..900_usize);
    fuzz(description, 45, |(centre, width, size, max, at, by, length)| {
        let Ok(view) = View::new(centre, width, size) else { return false };
        let set = Mandelbrot::new(view, max).expect("a limit above 0");
        let pixels = (size.width * size.height) as usize;
        let plain: Vec<_> = (0..size.height).flat_map(|y| set.row(y, 0..size.width)).collect();
        for y in 0..size.height {
            part_of_a_row(&Smooth(&set), y, at[0], 1);
            part_of_a_row(&Distance(&set), y, at[0], 1);
            part_of_a_row(&Interior(&set), y, at[0], 1);
        }
        let picture = Picture::<_, _, Rgb565>::new(set, Grey);
        let mut row = vec![Rgb888::BLACK; length % 25];
        let given = row.len();
        let mirrored = picture.mirrored(&mut row);
        assert_eq!(mirrored.is_ok(), given >= size.width as usize);
        if let Ok(mirrored) = mirrored {
            let (mut whole, mut halves) = (MockDisplay::new(), MockDisplay::new());
            assert!(Image::new(&picture, Point::zero()).draw(&mut whole).is_ok());
            assert!(Image::new(&mirrored, Point::zero()).draw(&mut halves).is_ok());
            halves.assert_eq(&whole);
        }
        let mut counts = vec![0_u16; Buffered::<Mandelbrot>::counts(size)];
        let mut canvas = Buffered::new(set, &mut counts).expect("a count a pixel");
        let shown: Vec<_> = (0..size.height).flat_map(|y| canvas.row(y, 0..size.width)).collect();
        assert_eq!(shown, plain);
        assert!(canvas.computed() <= pixels && canvas.picture().max_dwell() == max);
        for by in [by, (i32::MIN, i32::MAX), (0, i32::MIN), (i32::MAX, 0)] {
            if canvas.pan(by.0, by.1).is_ok() {
                assert!(canvas.computed() <= pixels);
            }
        }
        for (y, x) in [(u32::MAX, 0..u32::MAX), (0, u32::MAX - 1..u32::MAX), (size.height, 0..1)] {
            assert_eq!(canvas.row(y, x).count(), 0);
        }
        assert_eq!(canvas.row(0, 1..u32::MAX).count(), size.width as usize - 1);
        let mut bits = vec![0_u8; length];
        assert_eq!(Filled::new(set, &mut bits).is_ok(), length >= Filled::<Mandelbrot>::bytes(size));
        let mut bits = vec![0_u8; Filled::<Mandelbrot>::bytes(size)];
        let filled = Filled::new(set, &mut bits).expect("two bits a pixel");
        assert_eq!(filled.picture(), &set);
        for i in 0..pixels as u32 {
            let (x, y) = (i.wrapping_mul(at[1] | 1) % size.width, i % size.height);
            // filling changes what has no edge of its own, never the outside into something else than the
            // inside
            let (got, exact) = (filled.at(x, y), plain[(y * size.width + x) as usize]);
            assert!(got == exact || got.is_inside(), "{got:?} for {exact:?} at {x}, {y}");
        }
        let mut histogram = vec![0_u32; Equalised::counts(max - 1)];
        let palette = Equalised::new(&set, &mut histogram, gradients::FIRE).expect("a word a count");
        for count in [0, 1, max, u32::MAX] {
            palette.level(count);
        }
        true
    });
}

/// Filling looks at a pixel once, in whatever order it is asked, and nowhere else: pictures of dots, lines,
/// rings and noise.
#[test]
fn filling_looks_at_each_pixel_once() {
    let size = (1..=24_u32, 1..=24_u32).prop_map(|(w, h)| Size::new(w, h));
    let shape = (0..6_u32, any::<u64>(), 1..5_u32);
    let asked = vec((any::<u32>(), any::<u32>(), 0..3_u8), 0..12);
    fuzz((size, shape, asked), 99, |(size, (kind, noise, period), asked)| {
        let Size { width, height } = size;
        let looked = vec![Counter::new(0_u32); (width * height) as usize];
        let is_inside = |x: u32, y: u32| match kind {
            0 => true,
            1 => !x.is_multiple_of(period + 1),
            2 => x.min(y).min(width - 1 - x).min(height - 1 - y).is_multiple_of(period + 1),
            3 => (x ^ y) & period != 0,
            _ => (noise.rotate_left(x * 7 + y * 13) ^ noise >> (x + y)) & 3 != 0,
        };
        // the last kind changes its mind whenever it is asked
        let is_fickle = kind == 5;
        let field = from_fn(size, |x, y| {
            assert!(x < width && y < height, "asked for {x}, {y} of {size:?}");
            let looked = &looked[(y * width + x) as usize];
            looked.set(looked.get() + 1);
            let is_inside = is_inside(x, y) != (is_fickle && looked.get().is_multiple_of(2));
            Dwell { count: if is_inside { 9 } else { 3 }, max: 9 }
        });
        let mut bits = vec![0; Filled::<Mandelbrot>::bytes(size)];
        let filled = Filled::new(field, &mut bits).expect("two bits a pixel");
        for (x, y, how) in asked {
            // a pixel beyond the picture counts as the nearest
            let (column, row) = (x.min(width - 1), y.min(height - 1));
            match how {
                0 => assert!(filled.at(x, y) == filled.at(column, row) || is_fickle),
                1 => assert!(filled.row(y, x..u32::MAX).count() <= width as usize),
                _ => assert!(filled.row(y % height, x % width..width).all(|dwell| dwell.max == 9)),
            }
        }
        for y in 0..height {
            for (x, dwell) in (0..width).zip(filled.row(y, 0..width)) {
                assert!(dwell.is_inside() || is_fickle || !is_inside(x, y), "{x}, {y} is left out");
            }
        }
        // once to know it; and its dwell, which is not kept, whenever it is asked for
        let most = looked.iter().map(Counter::get).max().unwrap_or(0);
        assert!(most <= 30, "a pixel was looked at {most} times");
        let whole = {
            looked.iter().for_each(|looked| looked.set(0));
            let mut bits = vec![0; Filled::<Mandelbrot>::bytes(size)];
            let filled = Filled::new(field, &mut bits).expect("two bits a pixel");
            (0..height).map(|y| filled.row(y, 0..width).count()).sum::<usize>()
        };
        let most = looked.iter().map(Counter::get).max().unwrap_or(0);
        assert!(whole == (width * height) as usize && most <= 2, "a pixel was looked at {most} times");
        true
    });
}

/// Pictures that no buffer is large enough for are refused as any other.
#[test]
fn buffers_of_pictures_without_end() {
    for (width, height) in [(0, 0), (0, 9), (9, 0), (1 << 16, 1 << 16), (u32::MAX, u32::MAX), (u32::MAX, 1)] {
        let size = Size::new(width, height);
        let field = from_fn(size, |_, _| Dwell { count: 1, max: 1 });
        let pixels = u128::from(width) * u128::from(height);
        let needed = usize::try_from(pixels.div_ceil(4)).unwrap_or(usize::MAX);
        assert_eq!(Filled::<Mandelbrot>::bytes(size), needed);
        assert!(Filled::new(field, &mut []).is_err());
    }
    let most = Size::new(MAX_SIDE, MAX_SIDE);
    assert_eq!(Filled::<Mandelbrot>::bytes(most), 1 << 26);
}
