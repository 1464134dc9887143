//! One iteration of the Mandelbrot orbit.
//!
//! The points lie near the edge of the set, escape, and do so after 200 to 999 iterations: neither the
//! interior tests nor a period shortens the work, so that what is counted are iterations. The set-up finds
//! them; it is not counted.

use core::convert::Infallible;
use core::hint::black_box;

use attractor::Error;
use attractor::draw::Picture;
use attractor::escape::{Arithmetic, Dwell, Mandelbrot, View};
use attractor::num::Complex;
use attractor::num::Wide;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::image::ImageDrawable;
use embedded_graphics::pixelcolor::{IntoStorage, Rgb565, Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;

use super::watch::{Tally, Watch};
use crate::own::Rp2040;

const MAX: u32 = 1000;
const POINTS: usize = 32;

fn set(arithmetic: Arithmetic) -> Result<Mandelbrot, Error> {
    Mandelbrot::new(View::home(Size::new(240, 240))?, MAX)?.with_arithmetic(arithmetic)
}

/// Points of a grid of pitch `2^-6` whose orbits are long and end.
fn points() -> [Complex<Wide>; POINTS] {
    let mut points = [Complex::new(Wide::ZERO, Wide::ZERO); POINTS];
    let Ok(set) = set(Arithmetic::Word29) else { return points };
    let grid = (0..128 * 128).map(|i| {
        let part = |offset: i32, k: i32| Wide::from_bits(i64::from(k - offset) << 42);
        Complex::new(part(128, i % 128), part(0, i / 128))
    });
    let long = grid.filter(|c| (200..MAX).contains(&set.dwell_at(*c).count));
    for (point, c) in points.iter_mut().zip(long) {
        *point = c;
    }
    points
}

fn dwells(watch: &mut Watch<'_>, arithmetic: Arithmetic) -> Tally {
    let points = points();
    let Ok(set) = set(arithmetic) else { return Tally::default() };
    watch.time(|| {
        let mut tally = Tally::default();
        for c in black_box(&points) {
            let dwell = set.dwell_at(*c).count;
            tally.units += dwell;
            tally.checksum = tally.checksum.rotate_left(1) ^ dwell;
        }
        tally
    })
}

#[inline(never)]
pub(super) fn fine(watch: &mut Watch<'_>) -> Tally {
    dwells(watch, Arithmetic::Word29)
}

#[inline(never)]
pub(super) fn coarse(watch: &mut Watch<'_>) -> Tally {
    dwells(watch, Arithmetic::Word26)
}

/// The textbook's loop: two squares, one product, three sums, one comparison.
macro_rules! plain {
    ($name:ident, $float:ty) => {
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let points = points().map(|c| (c.re.to_num::<$float>(), c.im.to_num::<$float>()));
            watch.time(|| {
                let mut tally = Tally::default();
                for (re, im) in black_box(&points) {
                    let (re, im) = (*re, *im);
                    let (mut x, mut y, mut dwell) = (re, im, 0);
                    while dwell < MAX {
                        let (xx, yy) = (x * x, y * y);
                        if xx + yy > 4.0 {
                            break;
                        }
                        y = (x + x) * y + im;
                        x = xx - yy + re;
                        dwell += 1;
                    }
                    tally.units += dwell;
                    tally.checksum = tally.checksum.rotate_left(1) ^ dwell;
                }
                tally
            })
        }
    };
}

/// In f32 with what a C compiler contracts: two products become VFMA.
#[inline(never)]
pub(super) fn plain_f32(watch: &mut Watch<'_>) -> Tally {
    use crate::float::mul_add;
    let points = points().map(|c| (c.re.to_num::<f32>(), c.im.to_num::<f32>()));
    watch.time(|| {
        let mut tally = Tally::default();
        for (re, im) in black_box(&points) {
            let (re, im) = (*re, *im);
            let (mut x, mut y, mut dwell) = (re, im, 0);
            while dwell < MAX {
                let yy = y * y;
                if mul_add(x, x, yy) > 4.0 {
                    break;
                }
                let next = mul_add(x, x, re - yy);
                y = mul_add(x + x, y, im);
                x = next;
                dwell += 1;
            }
            tally.units += dwell;
            tally.checksum = tally.checksum.rotate_left(1) ^ dwell;
        }
        tally
    })
}

plain!(plain_f64, f64);

/// A display that keeps the sum of its colours alone.
struct Sum(u32);

impl OriginDimensions for Sum {
    fn size(&self) -> Size {
        Rp2040::SIZE
    }
}

impl DrawTarget for Sum {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let area = Rectangle::default();
        self.fill_contiguous(&area, pixels.into_iter().map(|Pixel(_, color)| color))
    }

    fn fill_contiguous<I>(&mut self, _: &Rectangle, colors: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Rgb565>,
    {
        let add = |sum: u32, color: Rgb565| sum.wrapping_add(u32::from(color.into_storage()));
        self.0 = colors.into_iter().fold(self.0, add);
        Ok(())
    }
}

/// The frame that was published for the RP2040, the half below its axis computed; the scene
/// `mandelbrot rp2040`.
#[inline(never)]
pub(super) fn rp2040(watch: &mut Watch<'_>) -> Tally {
    let Ok(frame) = Rp2040::new() else { return Tally::default() };
    let color = |dwell: Dwell| Rgb888::new(dwell.count as u8, 0, dwell.is_inside() as u8);
    let picture = Picture::<_, _, Rgb565>::new(frame, color);
    let mut row = [Rgb888::BLACK; Rp2040::SIZE.width as usize];
    let Ok(mirrored) = picture.mirrored(&mut row) else { return Tally::default() };
    watch.time(|| {
        let mut sum = Sum(0);
        let Ok(()) = mirrored.draw(&mut sum);
        Tally { checksum: sum.0, units: 1 }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::plane::{Field, Symmetric};

    #[test]
    fn the_grid_has_enough_points_with_long_orbits() {
        let points = points();
        assert!(points.iter().all(|c| c.re != Wide::ZERO || c.im != Wide::ZERO));
        let total: u32 = points.iter().map(|c| set(Arithmetic::Word29).unwrap().dwell_at(*c).count).sum();
        assert!(total > 32 * 200, "{total}");
    }

    #[test]
    fn floating_point_counts_about_the_same_iterations() {
        let mut blind = crate::machine::Blind;
        let units =
            |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut crate::machine::Blind, 1)).units;
        let fixed = fine(&mut Watch::new(&mut blind, 1)).units;
        for other in [units(coarse), units(plain_f32), units(plain_f64)] {
            assert!(other.abs_diff(fixed) < fixed / 8, "{other} against {fixed}");
        }
    }

    #[test]
    fn the_frame_has_the_same_pixels_without_the_mirror() {
        let frame = Rp2040::new().unwrap();
        let row = |y: u32| frame.row(y, 0..640).collect::<std::vec::Vec<_>>();
        for y in [241, 242, 300, 479] {
            assert_eq!(row(y), row(frame.mirror_image(y).unwrap()), "{y}");
        }
        assert!([0, 1, 240].iter().all(|y| frame.mirror_image(*y).is_none()));
    }
}
