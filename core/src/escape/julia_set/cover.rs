//! Where the Julia set `J_c` is: decides of a disc or a square whether the set meets it, by a disc that is
//! carried forward.
//!
//! A picture is made of such squares, one a pixel. Unlike backward iteration it also finds what a random walk
//! rarely visits, and neither picture nor grid has to be stored: a square is decided by itself, and exactly
//! as its negative is, since both have the same image.
//!
//! `z -> z^2 + c` takes the disc of radius `r` round `z` into the disc of radius `r (2 |z| + r)` round
//! `z^2 + c`; every rounding is added to the radius. The disc is carried on until it tells:
//!
//! - it lies beyond `R = (1 + sqrt(1 + 4 |c|)) / 2`: all of it escapes, it does not meet `J_c`;
//! - it lies within a disc that it has been before: its orbits stay bounded, it does not meet `J_c`. The
//!   earlier disc is kept at doubling distances, as in R. P. Brent, "An improved Monte Carlo factorization
//!   algorithm", 1980;
//! - its radius reaches 1/2: it may meet `J_c`, for near `J_c` the map drives apart whatever it is given.
//!
//! Where `|f'|` is 1, at parabolic points and in Siegel discs, the radius grows by `r^2` alone although
//! nothing is driven apart. Therefore a disc counts only when `r |(f^n)'|`, its size to first order, grows to
//! `5 r` or 1/48 as well before its middle escapes or it shrinks to `r / 64`; by Schwarz and Pick it is then
//! no farther from `J_c` than some radii.
//!
//! Source: interval arithmetic in midpoints and radii (R. E. Moore, "Interval Analysis", 1966) on the level
//! sets of H.-O. Peitgen, D. Saupe, "The Science of Fractal Images", 1988, section 4.2. Format: 27 fractional
//! bits.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::julia_set::set::JuliaSet;
use crate::escape::view::shallow::View;
use crate::num::Complex;
use crate::num::formats::{Q27, UQ27};
use crate::num::{Wide, sqrt};
use crate::plane::Field;

const FRACTION_Q27: u32 = 27;
const ONE_UQ27: UQ27 = 1 << FRACTION_Q27;
/// The radius from which on a disc tells nothing more.
const LARGE: UQ27 = ONE_UQ27 / 2;
/// How many times its own size, and what size, a disc near `J_c` reaches to first order, whichever is less.
const STRETCH: u32 = 5;
const STRETCHED: UQ27 = ONE_UQ27 / 48;
/// A middle beyond this never returns, for all `|c| <= 2`; a step from here stays below 9.
const FAR: UQ27 = ONE_UQ27 / 2 * 5;
/// What a step adds to the radius: each part of the product is cut off by less than a unit, `c` was rounded
/// by half of one, the modulus is low by less than one and so is the new radius: below 5 units in all.
const ROUNDING: u64 = 5;

/// A point of the plane, as discs have it for their middles.
type Point27 = (Q27, Q27);

impl JuliaSet {
    /// The radius of a disc round 0 that contains `J_c`: `(1 + sqrt(1 + 4 |c|)) / 2`, beyond which every
    /// orbit grows; 2 for `|c| = 2`.
    ///
    /// Error: at most `2^-26` too large (`the_radius_bounds_the_set`).
    pub fn radius(&self) -> Wide {
        let (x, y) = self.word();
        let square = |v: i32| u64::from(v.unsigned_abs()) * u64::from(v.unsigned_abs());
        // |c| with 29 bits, rounded up; 1 + 4 |c| <= 9 with 56
        let modulus = u64::from(sqrt(square(x) + square(y))) + 1;
        let root = u64::from(sqrt((1 << 56) + (modulus << (56 + 2 - 29)))) + 1;
        Wide::from_bits((((1_u64 << 28) + root) << (48 - 29)) as i64)
    }

    /// Whether `J_c` may meet the disc round `middle`.
    ///
    /// Domain: all. Result: `true` means that `J_c` is no farther than a few radii. `false` is certain where
    /// all of the disc escapes or comes to lie in itself. Near a parabolic point or a Siegel disc it may also
    /// mean that nothing was driven apart in the `4 (64 + 2 / radius)` steps that are taken, at most 65,536
    /// (`a_disc_round_a_point_of_the_set_may_meet_it`). Cost: 10 to 100 steps as a rule.
    pub fn may_meet(&self, middle: Complex<Wide>, radius: Wide) -> bool {
        match point(middle) {
            Some(z) => Discs::of(self).meets(z, up(radius)) == Meeting::May,
            None => {
                let reach = radius.saturating_add(self.radius());
                middle.re.saturating_abs() <= reach && middle.im.saturating_abs() <= reach
            }
        }
    }

    /// How many of the 4 by 4 squares that make up the square round `middle` may meet `J_c`: 0 to 16, a
    /// density.
    ///
    /// Domain: sides from `2^-20`, below which rounding makes lines thicker, to 4; others count as 4. Result:
    /// on a grid of 240 by 240 cells from `-2 - 2i` to `2 + 2i` no more than 1 in 100 of the cells that `J_c`
    /// meets have no count among themselves and their 8 neighbours; of the cells with a count no more than 1
    /// in 100 are more than a cell from `J_c`, 1 in 40 round a Siegel disc; a cell and its negative have the
    /// same count (`what_backward_orbits_visit_is_covered_and_little_else`).
    pub fn sixteenths(&self, middle: Complex<Wide>, side: Wide) -> u8 {
        let side = up(side.min(WIDEST));
        point(middle).map_or(0, |z| Discs::of(self).sixteenths(z, side))
    }
}

/// The widest square that is looked at.
const WIDEST: Wide = Wide::lit("4");

/// A point, rounded to nearest; none beyond `-4 .. 4`, where squares as wide as 4 do not meet the set.
fn point(z: Complex<Wide>) -> Option<Point27> {
    let part = |v: Wide| {
        let bits = (v.to_bits() >> 20).saturating_add(1) >> 1;
        i32::try_from(bits).ok().filter(|bits| bits.unsigned_abs() < 4 * ONE_UQ27)
    };
    Some((part(z.re)?, part(z.im)?))
}

/// A length, rounded up, at most 16, which reaches from any point to all of the set; and 2 units more, as a
/// middle is rounded too.
fn up(length: Wide) -> UQ27 {
    ((length.to_bits() >> 21).clamp(0, 16 * i64::from(ONE_UQ27) - 3) as u32) + 3
}

/// Half the diagonal of a square, rounded up.
const fn half_diagonal(side: UQ27) -> UQ27 {
    // sqrt(1/2) < 182/256; the side is at most 2^29
    ((side as u64 * 182) >> 8) as u32 + 1
}

/// What a disc tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Meeting {
    /// It may meet the set.
    May,
    /// It does not, for certain.
    Never,
    /// Nothing was driven apart: of its parts some may meet the set.
    Unknown,
}

/// What is needed of a set to carry discs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Discs {
    c: Point27,
    /// The radius of the disc round 0 that contains the set.
    bound: UQ27,
}

impl Discs {
    fn of(set: &JuliaSet) -> Self {
        let (x, y) = set.word();
        let nearest = |v: i32| (v + 2) >> 2;
        Self { c: (nearest(x), nearest(y)), bound: up(set.radius()) }
    }

    fn may_meet(&self, middle: Point27, radius: UQ27) -> bool {
        self.meets(middle, radius) == Meeting::May
    }

    /// Whether the set meets a disc. What does not meet it has no part that may: the images of a disc's parts
    /// lie in its own.
    fn meets(&self, middle: Point27, radius: UQ27) -> Meeting {
        let (mut z, mut r) = (middle, radius);
        let mut first_order = radius;
        let mut is_large = false;
        let mut saved = (z, r);
        let mut next_save = 2;
        let stretched = radius.saturating_mul(STRETCH).min(STRETCHED);
        let limit = (64 + (2 * ONE_UQ27).checked_div(radius).unwrap_or(0)).min(1 << 14);
        // what is large may take its time: at a parabolic point with two petals orbits part like 1 / sqrt(n)
        for step in 1..=4 * limit {
            if step > limit && !is_large {
                return Meeting::Unknown;
            }
            // |z| < 9: the squares add up to less than 2^61
            let (x, y) = (i64::from(z.0), i64::from(z.1));
            let modulus = sqrt((x * x + y * y) as u64);
            if !is_large && modulus > r.saturating_add(self.bound) {
                return Meeting::Never;
            }
            is_large |= r >= LARGE;
            if is_large {
                if first_order >= stretched {
                    return Meeting::May;
                }
                // it escapes, or sinks into a petal
                if modulus > FAR || first_order < radius / 64 {
                    return Meeting::Unknown;
                }
            }
            // here |z| <= 5/2, or r < 1/2 and |z| <= r + bound
            let twice = 2 * u64::from(modulus);
            // round 0 a disc goes into one of its radius squared
            let size = u64::from(first_order);
            first_order = ((size * twice.max(size)) >> FRACTION_Q27).min(u64::from(ONE_UQ27)) as u32;
            z = (
                (((x - y) * (x + y)) >> FRACTION_Q27) as i32 + self.c.0,
                ((x * y) >> (FRACTION_Q27 - 1)) as i32 + self.c.1,
            );
            if is_large {
                continue;
            }
            r = ((u64::from(r) * (twice + 2 + u64::from(r))) >> FRACTION_Q27) as u32 + ROUNDING as u32;
            if is_within((z, r), saved) {
                return Meeting::Never;
            }
            if step == next_save {
                saved = (z, r);
                next_save *= 2;
            }
        }
        Meeting::Unknown
    }

    fn sixteenths(&self, middle: Point27, side: UQ27) -> u8 {
        let mut count = 0;
        if !self.may_meet(middle, half_diagonal(side)) {
            return 0;
        }
        for quarter in around(middle, side / 4) {
            if self.may_meet(quarter, half_diagonal(side.div_ceil(2)) + 1) {
                for small in around(quarter, side / 8) {
                    count += u8::from(self.may_meet(small, half_diagonal(side.div_ceil(4)) + 1));
                }
            }
        }
        count
    }
}

fn around((x, y): Point27, d: UQ27) -> [Point27; 4] {
    let d = d as i32; // at most 2^27; the parts of a point are below 2^29 each
    [(x - d, y - d), (x + d, y - d), (x - d, y + d), (x + d, y + d)]
}

/// Whether the first disc lies in the second.
fn is_within((z, r): (Point27, UQ27), (w, s): (Point27, UQ27)) -> bool {
    let Some(room) = s.checked_sub(r) else { return false };
    let square = |a: i32, b: i32| {
        let d = (i64::from(a) - i64::from(b)).unsigned_abs();
        d * d // parts below 9: the two add up to less than 2^64
    };
    square(z.0, w.0) + square(z.1, w.1) <= u64::from(room) * u64::from(room)
}

/// `J_c` in every pixel of a view: [`JuliaSet::sixteenths`] of the pixel's square. Nothing is stored.
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::{JuliaCover, JuliaSet, View};
/// use attractor::num::Wide;
/// use attractor::plane::Field;
/// use embedded_graphics_core::geometry::Size;
/// let circle = JuliaSet::new(Complex::default())?;
/// let view = View::new(Complex::default(), Wide::from_num(4), Size::new(64, 64))?;
/// let cover = JuliaCover::new(view, circle)?;
/// let row: Vec<u8> = cover.row(32, 0..64).collect();
/// assert!(row[15] + row[16] > 0 && row[47] + row[48] > 0 && row[20..44].iter().all(|n| *n == 0));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JuliaCover {
    view: View,
    discs: Discs,
    pitch: UQ27,
}

impl JuliaCover {
    /// The cover of a set as a view shows it. In a view round 0 whose half pitch is a multiple of `2^-27`
    /// each pixel has the value of its negative.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for pixels wider than 4.
    pub fn new(view: View, set: JuliaSet) -> Result<Self, Error> {
        let pitch = view.pitch();
        if pitch > WIDEST {
            let (what, min) = ("side of a pixel", Wide::ZERO);
            return Err(Error::OutOfRange { what, index: None, value: pitch, min, max: WIDEST });
        }
        Ok(Self { view, discs: Discs::of(&set), pitch: up(pitch) })
    }
}

impl Field for JuliaCover {
    type Value = u8;

    fn size(&self) -> Size {
        self.view.size()
    }

    fn at(&self, x: u32, y: u32) -> u8 {
        point(self.view.point(x, y)).map_or(0, |z| self.discs.sixteenths(z, self.pitch))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = u8> {
        let end = x.end.min(self.view.size().width);
        JuliaCoverRow { cover: self, y, next: x.start.min(end), end, run: None }
    }
}

/// The counts of a row, from left to right. Runs of 8 or 9 pixels are decided together where the set is far
/// for certain: each pixel has the count that it has by itself
/// (`a_row_is_what_its_pixels_are_by_themselves`).
struct JuliaCoverRow<'a> {
    cover: &'a JuliaCover,
    y: u32,
    next: u32,
    end: u32,
    /// The run that was decided last, and whether any of its pixels may have a count.
    run: Option<(i32, bool)>,
}

impl JuliaCoverRow<'_> {
    /// The number of a pixel's run, and the run's middle less the pixel's in half pitches. The middle of the
    /// row lies between runs or in the middle of one.
    fn run_of(&self, column: u32) -> (i32, i32) {
        let width = self.cover.view.size().width as i32; // at most 2^14
        let place = 2 * column as i32 + 1 - width;
        if width & 1 == 0 {
            let run = place >> 4;
            (run, 16 * run + 8 - place)
        } else {
            let run = (place + 9).div_euclid(18);
            (run, 18 * run - place)
        }
    }
}

impl Iterator for JuliaCoverRow<'_> {
    type Item = u8;

    fn next(&mut self) -> Option<u8> {
        if self.next >= self.end {
            return None;
        }
        let column = self.next;
        self.next += 1;
        let JuliaCover { view, discs, pitch } = *self.cover;
        let Some(z) = point(view.point(column, self.y)) else { return Some(0) };
        let (run, aside) = self.run_of(column);
        let may_meet = match self.run {
            Some((decided, may_meet)) if decided == run => may_meet,
            _ => {
                // runs of wide pixels are not worth their while: the first disc already tells nothing
                let shift = i64::from(aside) * i64::from(pitch) / 2;
                let middle = i64::from(z.0) + shift;
                // half a diagonal of 9 by 1 pixels is 4.53 of them
                let radius = u64::from(pitch) * 39 / 8 + 16;
                let may_meet = match (i32::try_from(middle), u32::try_from(radius)) {
                    (Ok(x), Ok(r)) if x.unsigned_abs() < 8 * ONE_UQ27 && r < LARGE => {
                        discs.meets((x, z.1), r) != Meeting::Never
                    }
                    _ => true,
                };
                self.run = Some((run, may_meet));
                may_meet
            }
        };
        Some(if may_meet { discs.sixteenths(z, pitch) } else { 0 })
    }

    fn nth(&mut self, n: usize) -> Option<u8> {
        let left = self.end.saturating_sub(self.next);
        self.next += u32::try_from(n).unwrap_or(u32::MAX).min(left);
        self.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.end.saturating_sub(self.next) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for JuliaCoverRow<'_> {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    fn cover(c: [f64; 2], centre: [f64; 2], width: f64, size: Size) -> JuliaCover {
        let complex = |[re, im]: [f64; 2]| Complex::new(Wide::from_num(re), Wide::from_num(im));
        let view = View::new(complex(centre), Wide::from_num(width), size).unwrap();
        JuliaCover::new(view, JuliaSet::new(complex(c)).unwrap()).unwrap()
    }

    /// Where nothing is driven apart a run of pixels tells nothing of them: at parabolic points and in Siegel
    /// discs.
    #[test]
    fn a_row_is_what_its_pixels_are_by_themselves() {
        let constants = [
            [-0.75, 0.0],
            [-0.125, 0.649_519],
            [-1.25, 0.0],
            [0.25, 0.0],
            [-0.390_540_870_218_4, -0.586_787_907_346_969],
            [-0.8, 0.156],
            [0.0, 0.0],
            [-0.75, 0.000_01],
        ];
        let views = [
            ([0.0, 0.0], 4.0, Size::new(64, 64), 1),
            ([0.0, 0.0], 3.0, Size::new(97, 41), 1),
            ([-0.5, 0.0], 0.2, Size::new(96, 96), 3),
            ([0.5, 0.0], 0.1, Size::new(64, 48), 3),
            ([0.3, 0.6], 0.05, Size::new(48, 48), 5),
        ];
        for c in constants {
            let mut counted = 0;
            for (centre, width, size, every) in views {
                let cover = cover(c, centre, width, size);
                for y in (0..size.height).step_by(every) {
                    let row: Vec<u8> = cover.row(y, 0..size.width).collect();
                    let alone: Vec<u8> = (0..size.width).map(|x| cover.at(x, y)).collect();
                    assert_eq!(row, alone, "{c:?} round {centre:?}, {width} wide, row {y}");
                    counted += row.iter().filter(|n| **n > 0).count();
                }
            }
            assert!(counted > 100, "{c:?}: {counted}");
        }
        let cover = cover([-0.75, 0.0], [-0.5, 0.0], 0.2, Size::new(96, 96));
        assert_eq!((cover.at(47, 39), cover.row(39, 0..96).nth(47)), (16, Some(16)));
    }
}
