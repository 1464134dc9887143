//! The Mandelbrot set as deep as the coordinates reach. The distance of two pixels decides how orbits are
//! computed: in 64 bits, in 128 bits, or by perturbation.

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::orbit::arithmetic::Arithmetic;
use crate::escape::orbit::block_float::{BlockFloat, Number};
use crate::escape::orbit::ending::{Ending, follow};
use crate::escape::orbit::narrow::narrow;
use crate::escape::orbit::wide_dwell::{self, WideOrbit, WideWord};
use crate::escape::orbit::word_orbit::{self, WordOrbit};
use crate::escape::perturbation::reference::{OrbitPoint, Reference};
use crate::escape::set::escape_time::{EscapeTime, Pan};
use crate::escape::value::Dwell;
use crate::escape::value::Period;
use crate::escape::value::checked_max;
use crate::escape::view::deep::DeepView;
use crate::num::Complex;
use crate::num::Limbs;
use crate::num::formats::{Q60, Q124};
use crate::plane::{Field, Symmetric};

/// The dwell at every pixel of a deep view.
///
/// ```
/// use attractor::escape::{Arithmetic, DeepMandelbrot, DeepView, OrbitPoint};
/// use attractor::plane::Field;
/// use embedded_graphics_core::geometry::Size;
/// // the Misiurewicz point i, where the set looks the same at every depth
/// let view = DeepView::<12>::parse("0", "1", "1e-100", Size::new(9, 9))?;
/// let mut orbit = [OrbitPoint::default(); 400];
/// let picture = DeepMandelbrot::new(view, 400, &mut orbit)?;
/// assert_eq!(picture.arithmetic(), Arithmetic::Perturbed);
/// let row: Vec<u32> = picture.row(3, 0..9).map(|d| d.count).collect();
/// assert!(row.iter().all(|count| (255..285).contains(count)), "{row:?}");
/// # Ok::<(), attractor::Error>(())
/// ```
///
/// # From a width of 4 to 1e-100
/// [`Mandelbrot`](crate::escape::Mandelbrot) is the fastest while its 32 bits tell pixels apart. Its
/// [`View`](crate::escape::View) becomes a [`DeepView`] of the same pixels, whose width shrinks from there
/// on; the arithmetic follows by itself.
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::{Arithmetic, DeepMandelbrot, DeepView, Mandelbrot, OrbitPoint, View};
/// use attractor::num::Wide;
/// use attractor::plane::Field;
/// use embedded_graphics_core::geometry::Size;
/// // pixels 2^-20 apart, whose middles both formats hold: a row comes out the same
/// let (i, size) = (Complex::new(Wide::ZERO, Wide::ONE), Size::new(16, 9));
/// let shallow = Mandelbrot::new(View::new(i, Wide::from_bits(1 << 32), size)?, 300)?;
/// let mut view = DeepView::<12>::try_from(*shallow.view())?;
/// let deep = DeepMandelbrot::new(view, 300, &mut [])?;
/// assert_eq!(deep.arithmetic(), Arithmetic::Word64);
/// assert!(deep.row(3, 0..16).eq(shallow.row(3, 0..16)));
/// // on, twice as close at each step
/// for _ in 0..316 {
///     view = DeepView::new(*view.centre(), view.width().divided(2).0, size)?;
/// }
/// let mut orbit = [OrbitPoint::default(); 400];
/// let deep = DeepMandelbrot::new(view, 400, &mut orbit)?;
/// assert_eq!(deep.arithmetic(), Arithmetic::Perturbed);
/// let row: Vec<u32> = deep.row(3, 0..16).map(|d| d.count).collect();
/// assert!(row.iter().all(|count| (255..285).contains(count)), "{row:?}");
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct DeepMandelbrot<'a, const LIMBS: usize> {
    view: DeepView<LIMBS>,
    max: u32,
    orbits: Orbits<'a>,
    /// Whether points of the view may be near `|c| = 2`, where 30 bits do not decide.
    at_edge: bool,
}

impl<'a, const LIMBS: usize> DeepMandelbrot<'a, LIMBS> {
    /// The set as `view` shows it, with at most `max_dwell` iterations a pixel. `orbit` is used by
    /// perturbation only: `max_dwell` points; where 128 bits are enough it may be empty
    /// ([`DeepMandelbrot::orbit_points`]).
    ///
    /// # Errors
    /// [`Error::TooFew`] and [`Error::Capacity`] for the iterations as in
    /// [`Mandelbrot`](crate::escape::Mandelbrot); [`Error::BufferLength`] for a short `orbit`.
    pub fn new(view: DeepView<LIMBS>, max_dwell: u32, orbit: &'a mut [OrbitPoint]) -> Result<Self, Error> {
        Self::new_in(view, max_dwell, Arithmetic::of(view.pitch_exponent(), max_dwell), orbit)
    }

    /// The set computed in an arithmetic of the caller's choice, whatever would suit the view.
    ///
    /// # Errors
    /// As [`DeepMandelbrot::new`].
    pub fn new_in(
        view: DeepView<LIMBS>,
        max_dwell: u32,
        arithmetic: Arithmetic,
        orbit: &'a mut [OrbitPoint],
    ) -> Result<Self, Error> {
        let max = checked_max(max_dwell)?;
        let orbits = match arithmetic {
            Arithmetic::Word26 | Arithmetic::Word29 => Orbits::Word32(arithmetic),
            Arithmetic::Word64 => Orbits::Word64,
            Arithmetic::Word128 => Orbits::Word128,
            Arithmetic::Perturbed => {
                Orbits::Perturbed(Reference::new(view.centre(), max, view.reach(), orbit)?)
            }
            Arithmetic::PerturbedLong => {
                Orbits::PerturbedLong(Reference::new(view.centre(), max, view.reach(), orbit)?)
            }
        };
        let at_edge = match arithmetic {
            Arithmetic::Perturbed | Arithmetic::PerturbedLong => {
                // the picture, panned or not, is within 2^-20 of its centre, or is looked at everywhere
                let square = |part: &Limbs<LIMBS>| i128::from(part.to_wide().to_bits()).pow(2);
                let norm = square(&view.centre().re) + square(&view.centre().im);
                let four = 4_i128 << 96;
                view.pitch_exponent() > -40 || (norm - four).abs() < four >> 10
            }
            _ => false,
        };
        Ok(Self { view, max, orbits, at_edge })
    }

    /// How many points a picture of this view takes: the length of the orbit to lend. At compile time:
    /// [`Arithmetic::orbit_points`].
    pub fn orbit_points(view: &DeepView<LIMBS>, max_dwell: u32) -> usize {
        Arithmetic::of(view.pitch_exponent(), max_dwell).orbit_points(max_dwell)
    }

    /// The view.
    pub const fn view(&self) -> &DeepView<LIMBS> {
        &self.view
    }

    /// `Num`, the dwell of a point that does not escape.
    pub const fn max_dwell(&self) -> u32 {
        self.max
    }

    /// How orbits are computed.
    pub const fn arithmetic(&self) -> Arithmetic {
        match &self.orbits {
            Orbits::Word32(arithmetic) => *arithmetic,
            Orbits::Word64 => Arithmetic::Word64,
            Orbits::Word128 => Arithmetic::Word128,
            Orbits::Perturbed(_) => Arithmetic::Perturbed,
            Orbits::PerturbedLong(_) => Arithmetic::PerturbedLong,
        }
    }

    /// The length of the reference orbit, which ends where it escapes; 0 without one.
    pub fn reference_len(&self) -> usize {
        match &self.orbits {
            Orbits::Perturbed(reference) => reference.len(),
            Orbits::PerturbedLong(reference) => reference.len(),
            Orbits::Word32(_) | Orbits::Word64 | Orbits::Word128 => 0,
        }
    }

    /// The dwell at the middle of a pixel.
    ///
    /// Domain: inside the view; others count as the nearest pixel. Cost: at most the greatest dwell in steps,
    /// and by perturbation, where orbits are looked at for a cycle, fewer than 42,000 more
    /// (`perturbation_takes_a_bounded_number_of_steps`).
    pub fn dwell_at(&self, column: u32, row: u32) -> Dwell {
        if self.starts_beyond(column, row) {
            return Dwell { count: 0, max: self.max };
        }
        let dwell = |ending: Option<Ending>| ending.map_or(self.max, |ending| ending.steps);
        let count = match self.orbit(column, row) {
            PixelOrbit::Word32(orbit) => orbit.arithmetic.dwell(orbit.z, orbit.c, self.max),
            PixelOrbit::Beyond => 0,
            PixelOrbit::Word64(c) => wide_dwell::dwell(c, c, self.max),
            PixelOrbit::Word128(c) => wide_dwell::dwell(c, c, self.max),
            PixelOrbit::Perturbed(reference, g) => dwell(reference.ending::<false>(g, self.max)),
            PixelOrbit::PerturbedLong(reference, g) => dwell(reference.ending::<false>(g, self.max)),
        };
        Dwell { count, max: self.max }
    }

    /// Whether `|c| > 2`, for perturbation, which sees 30 bits of it: the other orbits know.
    fn starts_beyond(&self, column: u32, row: u32) -> bool {
        self.at_edge && is_beyond_two(&self.view.point_at(self.view.steps(column, row)))
    }

    fn orbit(&self, column: u32, row: u32) -> PixelOrbit<'_> {
        let (across, up) = self.view.steps(column, row);
        // conjugate points have the same dwell: the picture is symmetric to the last bit
        let steps = (across, if self.view.is_mirrored() { up.abs() } else { up });
        match &self.orbits {
            Orbits::Perturbed(reference) => {
                PixelOrbit::Perturbed(reference, self.view.distance(steps).short())
            }
            Orbits::PerturbedLong(reference) => {
                PixelOrbit::PerturbedLong(reference, self.view.distance(steps))
            }
            Orbits::Word32(arithmetic) => {
                let c = self.view.point_at(steps);
                let c = narrow(Complex::new(c.re.to_wide(), c.im.to_wide()));
                let orbit = |c| WordOrbit { z: c, c, arithmetic: *arithmetic };
                c.map_or(PixelOrbit::Beyond, |c| PixelOrbit::Word32(orbit(c)))
            }
            Orbits::Word64 => {
                let c = self.view.point_at(steps);
                let nearest = |v: i128| ((v + (1 << 63)) >> 64) as i64;
                PixelOrbit::Word64((nearest(c.re.top128()), nearest(c.im.top128())))
            }
            Orbits::Word128 => {
                let c = self.view.point_at(steps);
                PixelOrbit::Word128((c.re.top128(), c.im.top128()))
            }
        }
    }

    fn ending_of<const DERIVATIVE: bool>(&self, (column, row): (u32, u32)) -> Option<Ending> {
        if self.starts_beyond(column, row) {
            return Some(self.beyond(column, row));
        }
        match self.orbit(column, row) {
            PixelOrbit::Beyond => Some(self.beyond(column, row)),
            PixelOrbit::Word32(orbit) => {
                let dwell = orbit.arithmetic.dwell(orbit.z, orbit.c, self.max);
                (dwell < self.max).then(|| follow::<DERIVATIVE, _>(orbit, dwell, BlockFloat::<i32>::ONE))
            }
            PixelOrbit::Word64(c) => self.follow::<DERIVATIVE, _>(c),
            PixelOrbit::Word128(c) => self.follow::<DERIVATIVE, _>(c),
            PixelOrbit::Perturbed(reference, g) => reference.ending::<DERIVATIVE>(g, self.max),
            PixelOrbit::PerturbedLong(reference, g) => reference.ending::<DERIVATIVE>(g, self.max),
        }
    }

    /// The end of an orbit that starts beyond 2.
    fn beyond(&self, column: u32, row: u32) -> Ending {
        let c = self.view.point_at(self.view.steps(column, row));
        let c = WideWord::block((c.re.top64(), c.im.top64()));
        let one = BlockFloat::<i32>::ONE;
        Ending { steps: 0, z: c, c, derivative: one, gain: one }
    }

    fn follow<const DERIVATIVE: bool, W: WideWord>(&self, c: (W, W)) -> Option<Ending> {
        let dwell = wide_dwell::dwell(c, c, self.max);
        (dwell < self.max)
            .then(|| follow::<DERIVATIVE, _>(WideOrbit { z: c, c }, dwell, BlockFloat::<i32>::ONE))
    }
}

/// Whether `|c| > 2`: a unit of the last place decides but for `|im|^2` below it, which counts where the real
/// part is 2.
fn is_beyond_two<const LIMBS: usize>(c: &Complex<Limbs<LIMBS>>) -> bool {
    let four = Limbs::ZERO.plus_whole(4);
    let (re, im) = (c.re.times(&c.re), c.im.times(&c.im));
    // the top is enough beyond the format of the sum, and for what is far from 2
    let square = |part: &Limbs<LIMBS>| i128::from(part.to_wide().to_bits()).pow(2);
    if square(&c.re) + square(&c.im) > 5 << 96 {
        return true;
    }
    let over = re.plus(&im).minus(&four);
    if over == Limbs::ZERO { re == four && c.im != Limbs::ZERO } else { !over.is_negative() }
}

/// What a pixel's orbit is computed from.
enum PixelOrbit<'a> {
    /// It starts beyond 2.
    Beyond,
    Word32(WordOrbit),
    Word64((Q60, Q60)),
    Word128((Q124, Q124)),
    Perturbed(&'a Reference<'a, BlockFloat>, BlockFloat),
    PerturbedLong(&'a Reference<'a, BlockFloat<i64>>, BlockFloat<i64>),
}

/// What all orbits share.
#[allow(clippy::large_enum_variant, reason = "there is no heap to put a reference on")]
#[derive(Debug, Clone)]
enum Orbits<'a> {
    /// 26 or 29 bits.
    Word32(Arithmetic),
    Word64,
    Word128,
    Perturbed(Reference<'a, BlockFloat>),
    PerturbedLong(Reference<'a, BlockFloat<i64>>),
}

impl<const LIMBS: usize> Symmetric for DeepMandelbrot<'_, LIMBS> {
    fn mirror_image(&self, row: u32) -> Option<u32> {
        self.view.mirror_image(row)
    }
}

impl<const LIMBS: usize> EscapeTime for DeepMandelbrot<'_, LIMBS> {
    /// Column and row.
    type Point = (u32, u32);

    fn point_at(&self, column: u32, row: u32) -> (u32, u32) {
        (column, row)
    }

    fn max_dwell(&self) -> u32 {
        self.max
    }

    fn dwell_at(&self, (column, row): (u32, u32)) -> Dwell {
        self.dwell_at(column, row)
    }

    fn ending(&self, pixel: (u32, u32)) -> Option<Ending> {
        self.ending_of::<false>(pixel)
    }

    fn ending_with_derivative(&self, pixel: (u32, u32)) -> Option<Ending> {
        self.ending_of::<true>(pixel)
    }

    fn period_at(&self, (column, row): (u32, u32)) -> Option<Period> {
        if self.starts_beyond(column, row) {
            return None;
        }
        let period = match self.orbit(column, row) {
            PixelOrbit::Beyond => None,
            PixelOrbit::Word32(orbit) => word_orbit::period(orbit, self.max),
            PixelOrbit::Word64(c) => wide_dwell::period(c, self.max),
            PixelOrbit::Word128(c) => wide_dwell::period(c, self.max),
            PixelOrbit::Perturbed(reference, g) => reference.period(g, self.max),
            PixelOrbit::PerturbedLong(reference, g) => reference.period(g, self.max),
        };
        period.and_then(Period::new)
    }

    fn pitch(&self) -> (u32, i32) {
        let pitch = self.view.pitch_block().short();
        (pitch.re.unsigned_abs(), pitch.exponent)
    }
}

impl<const LIMBS: usize> Pan for DeepMandelbrot<'_, LIMBS> {
    fn pan(&mut self, right: i32, up: i32) -> Result<(), Error> {
        self.view = self.view.pan(right, up)?;
        Ok(())
    }
}

impl<const LIMBS: usize> Field for DeepMandelbrot<'_, LIMBS> {
    type Value = Dwell;

    fn size(&self) -> Size {
        self.view.size()
    }

    fn at(&self, x: u32, y: u32) -> Dwell {
        self.dwell_at(x, y)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::{Arithmetic, Buffered, Distance, Interior, Mandelbrot, Smooth, View};
    use crate::num::Wide;
    use core::cell::Cell;
    use fixed::types::U21F11;

    #[test]
    fn every_arithmetic_shows_the_same_picture_of_a_shallow_view() {
        let size = Size::new(40, 30);
        let view = DeepView::<4>::parse("-0.74", "0.13", "0.05", size).unwrap();
        let narrow = View::new(
            Complex::new(view.centre().re.to_wide(), view.centre().im.to_wide()),
            view.width().to_wide(),
            size,
        );
        let narrow =
            Mandelbrot::new(narrow.unwrap(), 300).unwrap().with_arithmetic(Arithmetic::Word29).unwrap();
        let mut orbit = [OrbitPoint::default(); 600];
        for arithmetic in ALL {
            let picture = DeepMandelbrot::new_in(view, 300, arithmetic, &mut orbit).unwrap();
            let differ = (0..30)
                .map(|y| picture.row(y, 0..40).zip(narrow.row(y, 0..40)).filter(|(a, b)| a != b).count());
            assert!(differ.sum::<usize>() <= 4, "{arithmetic:?}");
        }
    }

    const ALL: [Arithmetic; 5] = [
        Arithmetic::Word29,
        Arithmetic::Word64,
        Arithmetic::Word128,
        Arithmetic::Perturbed,
        Arithmetic::PerturbedLong,
    ];

    /// A view, the same in 32 bits, and the picture of it in each arithmetic.
    fn compare(
        [re, im, width]: [&str; 3],
        max: u32,
        check: impl Fn(&Mandelbrot, &DeepMandelbrot<'_, 4>, (u32, u32), Complex<Wide>),
    ) {
        let size = Size::new(48, 36);
        let view = DeepView::<4>::parse(re, im, width, size).unwrap();
        let centre = Complex::new(view.centre().re.to_wide(), view.centre().im.to_wide());
        let narrow = View::new(centre, view.width().to_wide(), size).unwrap();
        let narrow = Mandelbrot::new(narrow, max).unwrap().with_arithmetic(Arithmetic::Word29).unwrap();
        let mut orbit = std::vec![OrbitPoint::default(); 2 * max as usize];
        for arithmetic in ALL {
            let picture = DeepMandelbrot::new_in(view, max, arithmetic, &mut orbit).unwrap();
            for (column, row) in (0..36).flat_map(|row| (0..48).map(move |column| (column, row))) {
                check(&narrow, &picture, (column, row), narrow.view().point(column, row));
            }
        }
    }

    #[test]
    fn fractional_dwells_and_distances_are_those_of_a_shallow_picture() {
        let checked = Cell::new(0);
        compare(["-0.7", "0.3", "0.6"], 300, |narrow, picture, pixel, point| {
            let (shallow, deep) = (Smooth(*narrow).value_at(point), Smooth(picture).value_at(pixel));
            // later the orbits part
            if shallow.dwell > 25 {
                return;
            }
            checked.set(checked.get() + 1);
            let apart = shallow.dwell.abs_diff(deep.dwell);
            assert!(apart <= U21F11::DELTA * 4, "{:?} {pixel:?}: {shallow:?} {deep:?}", picture.arithmetic());
            let distances = (Distance(*narrow).value_at(point), Distance(picture).value_at(pixel));
            let (Some(shallow), Some(deep)) = distances else { panic!("{distances:?}") };
            let allowed = shallow.to_bits() / 256 + 1;
            assert!(shallow.to_bits().abs_diff(deep.to_bits()) <= allowed as u32, "{shallow} {deep}");
        });
        assert!(checked.get() > 1000, "{checked:?}");
    }

    #[test]
    fn periods_are_those_of_a_shallow_picture() {
        let (found, differ) = (Cell::new(0), Cell::new(0));
        compare(["-1.2", "0", "0.5"], 2000, |narrow, picture, pixel, point| {
            let (shallow, deep) = (Interior(*narrow).value_at(point), Interior(picture).value_at(pixel));
            // on the edge of a component one of them may find none, or a multiple
            let (Some(shallow), Some(deep)) = (shallow, deep) else { return };
            found.set(found.get() + u32::from(shallow.length() > 1 && shallow == deep));
            if shallow != deep {
                assert_eq!(deep.max(shallow).length() % deep.min(shallow).length(), 0, "{pixel:?}");
                differ.set(differ.get() + 1);
            }
        });
        assert!(found.get() > 1000 && differ.get() * 1000 <= found.get(), "{found:?} {differ:?}");
    }

    #[test]
    fn a_deep_canvas_is_mirrored_and_panned_without_a_change() {
        // a copy of period 3 on the real axis, and one beside it
        for (im, arithmetic) in [
            ("0", Arithmetic::Word64),
            ("0", Arithmetic::Word128),
            ("0", Arithmetic::Perturbed),
            ("0", Arithmetic::PerturbedLong),
            ("1e-22", Arithmetic::Perturbed),
        ] {
            let view =
                DeepView::<4>::parse("-1.7548776662466927601", im, "1e-15", Size::new(20, 15)).unwrap();
            let mut orbit = [OrbitPoint::default(); 600];
            let picture = DeepMandelbrot::new_in(view, 300, arithmetic, &mut orbit).unwrap();
            let mut counts = [0; 300];
            let mut buffered = Buffered::new(picture, &mut counts).unwrap();
            assert_eq!(buffered.computed(), if im == "0" { 20 * 8 } else { 300 });
            for (right, up) in [(0, 0), (3, 1), (-9, 4), (0, -15), (40, -2)] {
                buffered.pan(right, up).unwrap();
                let (moved, size) = (buffered.picture(), buffered.size());
                for y in 0..size.height {
                    assert!(buffered.row(y, 0..20).eq(moved.row(y, 0..20)), "{arithmetic:?} {y}");
                }
            }
            assert!(buffered.pan(40_000, 0).is_err());
            // the same point, whichever way it came
            let (once, twice) = (view.pan(5, -3).unwrap(), view.pan(7, 0).unwrap().pan(-2, -3).unwrap());
            assert_eq!((once, once.point(2, 9)), (twice, view.point(7, 12)));
        }
        assert!(DeepView::<4>::parse("-2", "0", "4e-2", Size::new(8, 8)).unwrap().pan(1000, 0).is_err());
    }

    #[test]
    fn an_orbit_that_escapes_has_no_period() {
        let view = DeepView::<6>::parse("1", "0", "1e-40", Size::new(8, 8)).unwrap();
        for max in [1, 2, 3, 50] {
            let mut orbit = [OrbitPoint::default(); 50];
            let picture = Interior(DeepMandelbrot::new(view, max, &mut orbit).unwrap());
            assert!((0..8).flat_map(|y| picture.row(y, 0..8)).all(|p| p.is_none()), "{max}");
        }
    }

    #[test]
    fn deep_copies_have_no_holes() {
        // well inside the disc of a fixed point, and a copy of period 34
        for (re, im, width, max, period) in [
            ("-0.1", "0", "1e-50", 1 << 20, 1),
            (
                "-0.22815549365396177228498592653253904365159762112307",
                "1.11514250803993715834441655794265638994873014695612",
                "1e-40",
                1000,
                34,
            ),
        ] {
            let view = DeepView::<6>::parse(re, im, width, Size::new(16, 16)).unwrap();
            let mut orbit = std::vec![OrbitPoint::default(); DeepMandelbrot::orbit_points(&view, max)];
            let picture = DeepMandelbrot::new(view, max, &mut orbit).unwrap();
            for (column, row) in (0..16).flat_map(|row| (0..16).map(move |column| (column, row))) {
                assert_eq!(Interior(&picture).value_at((column, row)), Period::new(period), "{column} {row}");
                assert!(picture.dwell_at(column, row).is_inside());
            }
        }
    }

    #[test]
    fn left_of_the_tip_every_dwell_is_0() {
        for width in ["1e-28", "1e-31", "1e-50"] {
            let view = DeepView::<8>::parse("-2", "0", width, Size::new(16, 16)).unwrap();
            let mut orbit = std::vec![OrbitPoint::default(); 1000];
            let picture = DeepMandelbrot::new(view, 500, &mut orbit).unwrap();
            for (column, row) in (0..16).flat_map(|row| (0..16).map(move |column| (column, row))) {
                assert_eq!(picture.dwell_at(column, row).count == 0, column < 8, "{width} {column} {row}");
            }
        }
    }

    #[test]
    fn the_pitch_chooses_the_arithmetic() {
        let of = |width: &str| {
            let view = DeepView::<12>::parse("-0.75", "0.1", width, Size::new(64, 64)).unwrap();
            (Arithmetic::of(view.pitch_exponent(), 700), DeepMandelbrot::orbit_points(&view, 700))
        };
        assert_eq!(of("1"), (Arithmetic::Word64, 0));
        assert_eq!(of("4e-12"), (Arithmetic::Word64, 0));
        assert_eq!(of("3e-12"), (Arithmetic::Word128, 0));
        assert_eq!(of("4e-30"), (Arithmetic::Word128, 0));
        assert_eq!(of("2e-30"), (Arithmetic::Perturbed, 700));
    }

    #[test]
    fn a_short_orbit_names_the_length_it_needs() {
        let view = DeepView::<12>::parse("-0.75", "0.1", "1e-50", Size::new(8, 8)).unwrap();
        let mut orbit = [OrbitPoint::default(); 99];
        let error = DeepMandelbrot::new(view, 100, &mut orbit).unwrap_err();
        let what = "points of the orbit";
        assert_eq!(error, Error::BufferLength { what, given: 99, needed: 100 });
        assert!(DeepMandelbrot::new(view, 99, &mut orbit).is_ok());
        assert!(DeepMandelbrot::new(view, 0, &mut orbit).is_err());
    }

    #[test]
    fn a_reference_that_escapes_at_once_serves_all_the_same() {
        // the centre is outside and escapes early, the left part is inside
        let size = Size::new(40, 40);
        let view = DeepView::<4>::parse("0.4", "0.4", "1.5", size).unwrap();
        let mut orbit = [OrbitPoint::default(); 200];
        let perturbed = DeepMandelbrot::new_in(view, 200, Arithmetic::Perturbed, &mut orbit).unwrap();
        assert!(perturbed.reference_len() < 20);
        let plain = DeepMandelbrot::new_in(view, 200, Arithmetic::Word128, &mut []).unwrap();
        let mut inside = 0;
        for y in 0..40 {
            for (a, b) in perturbed.row(y, 0..40).zip(plain.row(y, 0..40)) {
                assert_eq!(a, b);
                inside += u32::from(a.is_inside());
            }
        }
        assert!(inside > 100);
        assert_eq!(Wide::ONE, 1);
    }
}
