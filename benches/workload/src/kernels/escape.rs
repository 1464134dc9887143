//! One iteration of the Mandelbrot orbit.
//!
//! The points lie near the edge of the set, escape, and do so after 200 to 999 iterations: neither the interior tests nor a period
//! shortens the work, so that what is counted are iterations. The set-up finds them; it is not counted.

use core::hint::black_box;

use attractor::Error;
use attractor::escape::{Complex, Mandelbrot, Precision, View};
use attractor::num::Wide;
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};

const MAX: u32 = 1000;
const POINTS: usize = 32;

fn set(precision: Precision) -> Result<Mandelbrot, Error> {
    Ok(Mandelbrot::new(View::home(Size::new(240, 240))?, MAX)?.with_precision(precision))
}

/// Points of a grid of pitch `2^-6` whose orbits are long and end.
fn points() -> [Complex<Wide>; POINTS] {
    let mut points = [Complex::new(Wide::ZERO, Wide::ZERO); POINTS];
    let Ok(set) = set(Precision::Fine29) else { return points };
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

fn dwells(watch: &mut Watch<'_>, precision: Precision) -> Tally {
    let points = points();
    let Ok(set) = set(precision) else { return Tally::default() };
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
    dwells(watch, Precision::Fine29)
}

#[inline(never)]
pub(super) fn coarse(watch: &mut Watch<'_>) -> Tally {
    dwells(watch, Precision::Coarse26)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_has_enough_points_with_long_orbits() {
        let points = points();
        assert!(points.iter().all(|c| c.re != Wide::ZERO || c.im != Wide::ZERO));
        let total: u32 = points.iter().map(|c| set(Precision::Fine29).unwrap().dwell_at(*c).count).sum();
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
}
