//! A small copy of the set of period 34 at a width of 1e-30, fractional dwell.
//!
//! Written by `attractor export --gallery deep-30`.

use attractor::Error;
use attractor::draw::{Cycled, Gradient, Inside, gradients, hex};
use attractor::escape::{DeepMandelbrot, DeepView, FractionalDwell, OrbitPoint, Smooth};
use attractor::num::{Complex, Limbs};
use embedded_graphics::geometry::Size;

/// The middle of the picture with all its digits.
#[rustfmt::skip]
pub const CENTRE: Complex<Limbs<12>> = Complex::new(
    Limbs::from_limbs([1598254387, 999911182, 2554358132, 3375892624, 246361258, 1391810166, 1254078750, 788925674, 870800989, 2392273664, 94891570, 4233722272]),
    Limbs::from_limbs([255317046, 412716309, 3080345014, 2638504445, 2816095665, 1662052738, 3237088710, 3150221946, 922748869, 2048795778, 2794667347, 299343787]),
);

/// Its width.
#[rustfmt::skip]
pub const WIDTH: Limbs<12> =
    Limbs::from_limbs([520558701, 3817078574, 124547848, 2587869204, 439467609, 4082276869, 1665288966, 4005308920, 21267647, 0, 0, 0]);

/// The most iterations.
pub const MAX_DWELL: u32 = 1000;

/// Points of the orbit that the picture borrows, on a display of any size.
pub const ORBIT: usize = 1000;

/// What a display of this size shows.
///
/// # Errors
/// Those of [`DeepView::new`].
pub fn view(size: Size) -> Result<DeepView<12>, Error> {
    DeepView::new(CENTRE, WIDTH, size)
}

/// Every pixel's orbit on a display of this size.
///
/// # Errors
/// Those of [`DeepView::new`]; [`Error::BufferLength`] for an orbit shorter than [`ORBIT`].
pub fn picture(size: Size, orbit: &mut [OrbitPoint]) -> Result<Smooth<DeepMandelbrot<'_, 12>>, Error> {
    Ok(Smooth(DeepMandelbrot::new(view(size)?, MAX_DWELL, orbit)?))
}

/// Its colours on a display with colour.
pub const COLOR: Inside<Cycled<Gradient<13>>> =
    Inside::new(Cycled::new(gradients::PORCELAIN, 24 * FractionalDwell::STEPS), hex(0x0b0e1a));

/// Its colours on a display without colour.
pub use self::COLOR as GREY;
