//! Density: counts how often the chaos game hits each pixel, in a buffer that the caller lends.
//!
//! Dots alone show where an attractor is; counts also show where its points crowd. The share of hits in a
//! pixel tends to the invariant measure of the pixel (J. H. Elton, "An ergodic theorem for iterated maps",
//! 1987; course unit V, section 5.3.4).
//!
//! A [`Density`] is recorded point by point, then seen as a field of tones: linear, `min(count / full, 1)`,
//! or logarithmic, `min(log2(1 + count) / log2(1 + full), 1)`, the usual choice for measures that span
//! decades (S. Draves, E. Reckase, "The Fractal Flame Algorithm", 2003, section on log-density display).
//! Counters saturate. A second buffer keeps the last map that hit each pixel. Left out: anti-aliasing, decay
//! of old hits.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::field::{Field, along};
use super::point::{Bounds2, Point2};
use super::window::{Window, distance, whole_pixels};
use crate::Error;
use crate::num::formats::UQ31;
use crate::num::{log2, reciprocal};

/// A saturating counter of hits: `u8` or `u16`, or one of your own.
pub trait Counter: Copy {
    /// No hit.
    const ZERO: Self;
    /// One hit more, or the same at the end of the range.
    fn hit(&mut self);
    /// How many hits there were, at most 65535.
    fn count(self) -> u16;
}

impl Counter for u8 {
    const ZERO: Self = 0;
    #[inline]
    fn hit(&mut self) {
        *self = self.saturating_add(1);
    }
    #[inline]
    fn count(self) -> u16 {
        u16::from(self)
    }
}

impl Counter for u16 {
    const ZERO: Self = 0;
    #[inline]
    fn hit(&mut self) {
        *self = self.saturating_add(1);
    }
    #[inline]
    fn count(self) -> u16 {
        self
    }
}

/// The hit counts of a window, row by row from the upper left.
///
/// ```
/// use attractor::draw::{Inside, Picture, gradients, hex};
/// use attractor::ifs::catalogue;
/// use attractor::plane::Density;
/// use attractor::plane::Window;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
///
/// let fern = catalogue::BARNSLEY_FERN.ifs::<4>()?;
/// let window = Window::fit(fern.bounds(), Size::new(32, 32))?;
/// let mut counts = [0_u8; 32 * 32];
/// let mut density = Density::new(window, &mut counts)?;
/// density.extend(fern.seeded_chaos_game(1).take(10_000));
/// let toned = density.logarithmic(density.peak());
/// let picture = Picture::<_, _, Rgb888>::new(toned, Inside::new(gradients::MOSS, hex(0xffffff)));
/// # let mut display = MockDisplay::new();
/// # display.set_allow_overdraw(true);
/// Image::new(&picture, Point::zero()).draw(&mut display).ok();
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug)]
pub struct Density<'a, C> {
    window: Window,
    /// See `Window::fractions`.
    fractions: [[u32; 2]; 2],
    /// How far from the left edge the shortcut holds: the extent, or 0 where there is none.
    extent: u32,
    width: u32,
    counts: &'a mut [C],
    /// The last map of each pixel; empty when nobody asked.
    maps: &'a mut [u8],
}

impl Density<'_, u8> {
    /// How many counts a window of this size takes: the length of the memory to lend.
    pub const fn counts_of(size: Size) -> usize {
        size.width as usize * size.height as usize
    }
}

impl<'a, C: Counter> Density<'a, C> {
    /// An empty count of what `window` shows: the buffer is cleared.
    ///
    /// Memory: one counter a pixel, lent; beyond that 88 bytes on a 32-bit machine.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `counts` is shorter than [`Density::counts_of`].
    pub fn new(window: Window, counts: &'a mut [C]) -> Result<Self, Error> {
        let counts = one_each("counts", &window, counts)?;
        let Bounds2 { min, max } = window.bounds();
        let (fractions, extent) =
            window.fractions().map_or(([[0; 2]; 2], 0), |fractions| (fractions, distance(min.x, max.x)));
        counts.fill(C::ZERO);
        Ok(Self { window, fractions, extent, width: window.size().width, counts, maps: &mut [] })
    }

    /// The same count, which also keeps the last map of each pixel in one byte a pixel: use
    /// [`Density::record_from`].
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `maps` is shorter than [`Density::counts_of`].
    pub fn with_maps(self, maps: &'a mut [u8]) -> Result<Self, Error> {
        let maps = one_each("maps", &self.window, maps)?;
        maps.fill(0);
        Ok(Self { maps, ..self })
    }

    /// Counts a point, unless it lies outside the window.
    ///
    /// Result: the pixel is that of [`Window::pixel`] (`each_point_is_counted_in_its_pixel`).
    #[inline]
    pub fn record(&mut self, point: Point2) {
        match self.counts.get_mut(self.index(point)) {
            Some(counter) => counter.hit(),
            None => self.record_slowly(point, 0),
        }
    }

    /// Counts a point, and remembers the map that made it.
    #[inline]
    pub fn record_from(&mut self, point: Point2, map: u8) {
        let index = self.index(point);
        match (self.counts.get_mut(index), self.maps.get_mut(index)) {
            (Some(counter), Some(last)) => {
                counter.hit();
                *last = map;
            }
            _ => self.record_slowly(point, map),
        }
    }

    /// The index of [`Window::pixel`], or one beyond the buffer: the right and the lower edge, which belong
    /// to the last pixels, and whatever lies outside are left to [`Density::record_slowly`]. What lies below
    /// the window is in a row below the last one, as rows are exact.
    #[inline(always)]
    fn index(&self, p: Point2) -> usize {
        let Bounds2 { min, max } = self.window.bounds();
        let [x, y] = self.fractions;
        // modulo 2^32 a coordinate outside is farther than the extent
        let (right, down) = (distance(min.x, p.x), distance(p.y, max.y));
        if right >= self.extent {
            return usize::MAX;
        }
        let (column, row) = (whole_pixels(right, x), whole_pixels(down, y));
        row.wrapping_mul(self.width).wrapping_add(column) as usize
    }

    #[cold]
    #[inline(never)]
    fn record_slowly(&mut self, p: Point2, map: u8) {
        let Some(pixel) = self.window.pixel(p) else { return };
        let index = (pixel.y as u32).wrapping_mul(self.width).wrapping_add(pixel.x as u32) as usize;
        if let Some(counter) = self.counts.get_mut(index) {
            counter.hit();
        }
        if let Some(last) = self.maps.get_mut(index) {
            *last = map;
        }
    }

    /// The counters, row by row from the upper left.
    pub fn counts(&self) -> &[C] {
        self.counts
    }

    /// What these counts are seen through.
    pub const fn window(&self) -> Window {
        self.window
    }

    /// The largest count, at least 1.
    pub fn peak(&self) -> u16 {
        self.counts.iter().map(|c| c.count()).max().unwrap_or(1).max(1)
    }

    /// The least count that fewer than one in `one_in` of the pixels that were hit exceed, at least 1: as the
    /// full tone it loses only so many (`fewer_than_one_in_n_exceed_the_quantile`).
    ///
    /// Cost: 17 passes over the buffer.
    pub fn quantile(&self, one_in: u32) -> u16 {
        let above = |limit: u16| self.counts.iter().filter(|c| c.count() > limit).count() as u64;
        let hit = above(0);
        let mut low = 0_u16;
        let mut high = u16::MAX;
        // invariant: `high` will do, nothing below `low` does
        while low < high {
            let middle = low + (high - low) / 2;
            if above(middle).saturating_mul(u64::from(one_in)) < hit {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        if hit == 0 { 1 } else { low.max(1) }
    }

    /// The counts as tones in proportion, 1 at `full` and beyond.
    ///
    /// Domain: all (0 counts as 1). Error: of a tone half a step of 65535
    /// (`linear_tones_are_rounded_to_the_nearest_step`). Cost of a pixel: one 32-bit division.
    pub fn linear(&self, full: u16) -> Toned<'_, C> {
        Toned {
            counts: self.counts,
            maps: self.maps,
            size: self.window.size(),
            scale: Scale::Linear(full.max(1)),
        }
    }

    /// The counts as tones in proportion to `log2(1 + count)`, 1 at `full` and beyond.
    ///
    /// Domain: all (0 counts as 1). Error: of a tone below one step of 65535
    /// (`logarithmic_tones_are_within_a_step`). Cost of a pixel: one [`log2`] and two multiplications.
    pub fn logarithmic(&self, full: u16) -> Toned<'_, C> {
        let (mantissa, shift) = reciprocal(log2(u64::from(full.max(1)) + 1));
        let scale = Scale::Logarithmic { full: full.max(1), mantissa, shift };
        Toned { counts: self.counts, maps: self.maps, size: self.window.size(), scale }
    }
}

/// Counts every point of an iterator: `density.extend(game.take(100_000))`.
///
/// Cost of a point: with the chaos game of the fern 75.5 Cortex-M4 instructions (kernel `density u8`) for
/// `u8`, 74.5 (kernel `density u16`) for `u16`, 82.5 (kernel `density with maps`) with maps (64 x 64 pixels).
impl<C: Counter> Extend<Point2> for Density<'_, C> {
    #[inline]
    fn extend<I: IntoIterator<Item = Point2>>(&mut self, points: I) {
        points.into_iter().for_each(|point| self.record(point));
    }
}

/// Counts every point with its map: `density.extend(game.labelled().take(100_000))`.
impl<C: Counter> Extend<(Point2, u8)> for Density<'_, C> {
    #[inline]
    fn extend<I: IntoIterator<Item = (Point2, u8)>>(&mut self, points: I) {
        points.into_iter().for_each(|(point, map)| self.record_from(point, map));
    }
}

/// What a window takes of a buffer with an element a pixel.
fn one_each<'a, T>(what: &'static str, window: &Window, buffer: &'a mut [T]) -> Result<&'a mut [T], Error> {
    let (given, needed) = (buffer.len(), Density::counts_of(window.size()));
    buffer.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })
}

/// What a pixel of a [`Density`] shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hits {
    /// How often it was hit; where that is 0 it is no part of the attractor, and the palettes paint it as the
    /// inside of a set.
    pub count: u16,
    /// The tone, 65535 for 1.
    pub tone: u16,
    /// The last map that hit it, 0 without a buffer of maps.
    pub map: u8,
}

#[derive(Debug, Clone, Copy)]
enum Scale {
    Linear(u16),
    /// `1 / log2(1 + full)` as mantissa and shift.
    Logarithmic {
        full: u16,
        mantissa: UQ31,
        shift: u32,
    },
}

impl Scale {
    fn tone(self, count: u16) -> u16 {
        match self {
            Self::Linear(full) if count < full => {
                // 65534 * 65535 + 32767 < 2^32
                let (count, full) = (u32::from(count), u32::from(full));
                (count * 0xffff + full / 2).checked_div(full).unwrap_or(0) as u16
            }
            Self::Logarithmic { full, mantissa, shift } if count < full => {
                // log2 <= 16 with 24 fractional bits, below 2^28; shift is 55 to 59, the quotient has 32
                // fractional bits
                let quotient = (u64::from(log2(u64::from(count) + 1)) * u64::from(mantissa))
                    >> (shift.wrapping_sub(32) & 63);
                ((quotient * 0xffff + (1 << 31)) >> 32).min(0xffff) as u16
            }
            _ => u16::MAX,
        }
    }
}

/// A [`Density`] as a picture: a [`Field`] of [`Hits`].
#[derive(Debug, Clone, Copy)]
pub struct Toned<'a, C> {
    counts: &'a [C],
    maps: &'a [u8],
    size: Size,
    scale: Scale,
}

impl<C: Counter> Field for Toned<'_, C> {
    type Value = Hits;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> Hits {
        // inside, an index is at most 2^28
        let index = y.wrapping_mul(self.size.width).wrapping_add(x) as usize;
        let count = self.counts.get(index).map_or(0, |count| count.count());
        let tone = if count == 0 { 0 } else { self.scale.tone(count) };
        Hits { count, tone, map: self.maps.get(index).copied().unwrap_or(0) }
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Hits> {
        let Size { width, height } = self.size;
        // what lies outside the picture has no pixels
        let end = if y < height { x.end.min(width) } else { 0 };
        along(x.start.min(end)..end, move |x| self.at(x, y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue::{self, BARNSLEY_FERN};
    use crate::num::Real;
    use std::{vec, vec::Vec};

    fn window(width: u32, height: u32) -> Window {
        Window::fit(BARNSLEY_FERN.ifs::<4>().unwrap().bounds(), Size::new(width, height)).unwrap()
    }

    #[test]
    fn each_point_is_counted_in_its_pixel() {
        let real = |bits: i32| Real::from_bits(bits);
        let narrow = |bits: i32| Bounds2 {
            min: Point2::new(real(1 << 24), real(-bits)),
            max: Point2::new(real((1 << 24) + bits), real(bits)),
        };
        let whole =
            Bounds2 { min: Point2::new(Real::MIN, Real::MIN), max: Point2::new(Real::MAX, Real::MAX) };
        for bounds in [
            BARNSLEY_FERN.ifs::<4>().unwrap().bounds(),
            whole,
            narrow(1),
            narrow(33),
            narrow(65),
            narrow(400),
            narrow(1 << 20),
        ] {
            for size in [Size::new(1, 1), Size::new(33, 7), Size::new(64, 64)] {
                let window = Window::stretch(bounds, size).unwrap();
                let mut counts = vec![0_u16; (size.width * size.height) as usize];
                let mut want = counts.clone();
                let mut density = Density::new(window, &mut counts).unwrap();
                let (low, high) = (bounds.min, bounds.max);
                let corners = [low, high, Point2::new(low.x, high.y), Point2::new(high.x, low.y)];
                let beyond =
                    Point2::new(high.x.saturating_add(Real::DELTA), low.y.saturating_sub(Real::DELTA));
                let fern = BARNSLEY_FERN.ifs::<4>().unwrap();
                let mixed = fern.seeded_chaos_game(1).take(2000).chain(corners).chain([beyond]).chain(
                    fern.seeded_chaos_game(2).take(500).map(|p| {
                        Point2::new(
                            real((1 << 24) + (p.x.to_bits() & 31) - 8),
                            real((p.y.to_bits() & 31) - 16),
                        )
                    }),
                );
                for point in mixed {
                    density.record(point);
                    if let Some(p) = window.pixel(point) {
                        want[(p.y as u32 * size.width + p.x as u32) as usize] += 1;
                    }
                }
                assert!(want.iter().any(|c| *c > 0));
                assert_eq!(density.counts(), want);
            }
        }
    }

    #[test]
    fn a_wrong_buffer_names_the_length_it_needs() {
        for length in [0, 7, 1199] {
            let error = Density::new(window(40, 30), &mut vec![0_u8; length]).unwrap_err();
            assert_eq!(error, Error::BufferLength { what: "counts", given: length, needed: 1200 });
        }
        let (mut counts, mut maps) = (vec![9_u16; 1200], vec![0; 7]);
        let density = Density::new(window(40, 30), &mut counts).unwrap();
        assert_eq!(density.peak(), 1, "the buffer is cleared");
        let error = density.with_maps(&mut maps).unwrap_err();
        assert_eq!(error, Error::BufferLength { what: "maps", given: 7, needed: 1200 });
    }

    #[test]
    fn counters_saturate() {
        let mut counts = [0_u8; 1];
        let mut density = Density::new(window(1, 1), &mut counts).unwrap();
        density.extend(BARNSLEY_FERN.ifs::<4>().unwrap().seeded_chaos_game(1).take(300));
        assert_eq!((density.counts(), density.peak()), (&[255_u8][..], 255));
        let mut counts = [0_u16; 1];
        let mut density = Density::new(window(1, 1), &mut counts).unwrap();
        density.extend(BARNSLEY_FERN.ifs::<4>().unwrap().seeded_chaos_game(1).take(70_000));
        assert_eq!(density.peak(), u16::MAX);
    }

    /// A row of given counts as tones.
    fn tones(counts: &[u16], toned: impl Fn(&Density<'_, u16>) -> Vec<u16>) -> Vec<u16> {
        let mut buffer = vec![0; counts.len()];
        let density = Density::new(window(counts.len() as u32, 1), &mut buffer).unwrap();
        density.counts.copy_from_slice(counts);
        toned(&density)
    }

    #[test]
    fn linear_tones_are_rounded_to_the_nearest_step() {
        let counts: Vec<u16> = (0..=255).chain([1000, 32767, 65534, 65535]).collect();
        for full in [0, 1, 2, 3, 200, 999, 65534, 65535] {
            let got =
                tones(&counts, |d| d.linear(full).row(0, 0..counts.len() as u32).map(|h| h.tone).collect());
            for (count, tone) in counts.iter().zip(got) {
                let exact = (f64::from(*count) / f64::from(full.max(1))).min(1.0) * 65535.0;
                assert!((f64::from(tone) - exact).abs() <= 0.5, "{count}/{full}: {tone}");
            }
        }
    }

    #[test]
    fn logarithmic_tones_are_within_a_step() {
        let counts: Vec<u16> = (0..=255).chain([1000, 32767, 65534, 65535]).collect();
        let mut worst: f64 = 0.0;
        for full in [0, 1, 2, 3, 200, 999, 65534, 65535] {
            let row = |d: &Density<'_, u16>| {
                d.logarithmic(full).row(0, 0..counts.len() as u32).map(|h| h.tone).collect()
            };
            for (count, tone) in counts.iter().zip(tones(&counts, row)) {
                let exact = (f64::from(*count).ln_1p() / f64::from(full.max(1)).ln_1p()).min(1.0) * 65535.0;
                worst = worst.max((f64::from(tone) - exact).abs());
            }
        }
        // half a step of rounding, and hardly more
        assert!(worst > 0.4 && worst < 0.51, "{worst}");
    }

    #[test]
    fn fewer_than_one_in_n_exceed_the_quantile() {
        let counts: Vec<u16> = (0..1000).map(|i| if i % 3 == 0 { 0 } else { (i * i % 997) as u16 }).collect();
        let mut sorted: Vec<u16> = counts.iter().copied().filter(|c| *c > 0).collect();
        sorted.sort_unstable();
        for one_in in [1_u32, 2, 10, 50, 100_000] {
            let got = tones(&counts, |d| vec![d.quantile(one_in)])[0];
            let want = sorted[sorted.len() - sorted.len().div_ceil(one_in as usize)];
            let expected = if one_in == 1 { sorted[0] } else { want };
            assert_eq!(got, expected, "one in {one_in}");
        }
        assert_eq!(tones(&[0; 5], |d| vec![d.quantile(50)]), [1]);
    }

    #[test]
    fn the_last_map_colours_its_pixel() {
        let gasket = catalogue::SIERPINSKI_GASKET.ifs::<3>().unwrap();
        let window = Window::fit(gasket.bounds(), Size::new(64, 64)).unwrap();
        let (mut counts, mut maps) = (vec![0_u8; 4096], vec![0_u8; 4096]);
        let mut density = Density::new(window, &mut counts).unwrap().with_maps(&mut maps).unwrap();
        density.extend(gasket.seeded_chaos_game(1).labelled().take(20_000));
        let toned = density.linear(255);
        let mut seen = [0_u32; 3];
        for (point, map) in gasket.seeded_chaos_game(1).labelled().take(20_000) {
            let pixel = window.pixel(point).unwrap();
            let hits = toned.row(pixel.y as u32, 0..64).nth(pixel.x as usize).unwrap();
            assert!(hits.count > 0 && hits.map < 3);
            // images meet in corners only
            seen[usize::from(map)] += u32::from(hits.map == map);
        }
        assert!(seen.iter().sum::<u32>() > 19_000 && seen.iter().all(|n| *n > 6000), "{seen:?}");
        let hit = |hits: &Hits| hits.count > 0;
        assert!((0..64).flat_map(|y| toned.row(y, 0..64)).filter(hit).count() > 800);
    }

    #[test]
    fn there_is_nothing_beyond_the_picture() {
        let mut counts = [0_u8; 63];
        let density = Density::new(window(9, 7), &mut counts).unwrap();
        let toned = density.linear(1);
        // a row that is 0 modulo 2^32 / 9, and columns that belong to the next row
        let far = (u32::MAX / 9) + 1;
        for (y, x, expected) in
            [(7, 0..9, 0), (far, 0..9, 0), (2, 7..u32::MAX, 2), (6, 9..12, 0), (0, 0..9, 9)]
        {
            assert_eq!(toned.row(y, x.clone()).count(), expected, "{y}, {x:?}");
        }
    }

    /// Halves, to the nearest step upwards: `(2 count 65535 + full) / (2 full)` in integers, for every count
    /// below.
    #[test]
    fn linear_tones_are_those_of_whole_numbers() {
        for full in [1, 2, 6, 255, 1000, 65535_u16] {
            for count in 0..=u16::MAX {
                let (c, f) = (u64::from(count.min(full)), u64::from(full));
                let want = (2 * c * 65535 + f - f % 2) / (2 * f);
                assert_eq!(u64::from(Scale::Linear(full).tone(count)), want, "{count} / {full}");
            }
        }
    }

    #[test]
    fn a_row_ends_where_its_buffer_ends() {
        let mut counts = [0_u16; 12];
        let mut maps = [0_u8; 12];
        let density = Density::new(window(4, 3), &mut counts).unwrap().with_maps(&mut maps).unwrap();
        density.counts.copy_from_slice(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
        density.maps.copy_from_slice(&[21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32]);
        let toned = density.linear(12);
        assert_eq!(toned.size(), Size::new(4, 3));
        let row: Vec<(u16, u8)> = toned.row(1, 1..4).map(|h| (h.count, h.map)).collect();
        assert_eq!(row, [(6, 26), (7, 27), (8, 28)]);
        assert_eq!(toned.row(2, 0..4).nth(2).map(|h| (h.count, h.map)), Some((11, 31)));
        assert_eq!((toned.row(0, 0..3).len(), toned.row(3, 0..4).len()), (3, 0));
        assert_eq!(toned.row(0, 0..4).map(|h| h.tone).max(), Some(21845));
    }

    /// One in ten of ten is not fewer than one in ten; 0 counts as none that may exceed.
    #[test]
    fn a_quantile_is_met_and_not_only_neared() {
        let counts: Vec<u16> = (1..=10).collect();
        for (one_in, least) in [(10, 10), (9, 9), (5, 9), (4, 8), (1, 1), (0, 1)] {
            assert_eq!(tones(&counts, |d| vec![d.quantile(one_in)]), [least], "one in {one_in}");
        }
    }

    #[test]
    fn a_buffer_of_maps_is_cleared() {
        let (mut counts, mut maps) = (vec![7_u8; 12], vec![9_u8; 12]);
        let density = Density::new(window(4, 3), &mut counts).unwrap().with_maps(&mut maps).unwrap();
        assert!(density.maps.iter().all(|map| *map == 0) && density.counts().iter().all(|count| *count == 0));
    }
}
