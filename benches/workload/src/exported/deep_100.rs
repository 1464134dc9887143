//! A copy of period 95 at a width of 1e-100: perturbation, fractional dwell.
//!
//! Written by `attractor export --gallery deep-100`.

use attractor::Error;
use attractor::draw::{Cycled, Gradient, Inside, gradients, hex};
use attractor::escape::{DeepMandelbrot, DeepView, FractionalDwell, OrbitPoint, Smooth};
use attractor::num::{Complex, Limbs};
use embedded_graphics::geometry::Size;

/// The middle of the picture with all its digits.
#[rustfmt::skip]
pub const CENTRE: Complex<Limbs<12>> = Complex::new(
    Limbs::from_limbs([3688874264, 1268263, 2997297781, 2805848981, 4176882588, 1595943102, 2310079787, 3575338051, 1192546319, 1067429634, 1488541245, 3946979613]),
    Limbs::from_limbs([2645455229, 4205572091, 3881051372, 1071308597, 1264753183, 3736920325, 1484542476, 3355661122, 356001660, 4239793817, 1159038649, 118608637]),
);

/// Its width.
#[rustfmt::skip]
pub const WIDTH: Limbs<12> =
    Limbs::from_limbs([1998876714, 57337, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);

/// The most iterations.
pub const MAX_DWELL: u32 = 2000;

/// Points of the orbit that the picture borrows, on a display of any size.
pub const ORBIT: usize = 2000;

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
    Inside::new(Cycled::new(gradients::PORCELAIN, 60 * FractionalDwell::STEPS), hex(0x0b0e1a));

/// Its colours on a display without colour.
pub use self::COLOR as GREY;
