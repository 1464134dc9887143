//! In 32 bits on small displays, with all digits on large ones.
//!
//! Written by `attractor export near-seahorses`.

use attractor::Error;
use attractor::draw::{Cycled, Equalised, Gradient, Inside, Leveled, gradients, hex};
use attractor::escape::{DeepMandelbrot, DeepView, FractionalDwell, Mandelbrot, OrbitPoint, Smooth, View};
use attractor::num::{Complex, Limbs, Wide};
use attractor::plane::Field;
use embedded_graphics::geometry::Size;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.743643887037152", "0.13182590420533");

/// Its width.
pub const WIDTH: Wide = Wide::lit("0.00000003");

/// The most iterations.
pub const MAX_DWELL: u32 = 2000;

/// What a display of this size shows.
///
/// # Errors
/// Those of [`View::new`].
pub fn view(size: Size) -> Result<View, Error> {
    View::new(CENTRE, WIDTH, size)
}

/// Every pixel's orbit on a display of this size.
///
/// # Errors
/// Those of [`View::new`].
pub fn picture(size: Size) -> Result<Smooth<Mandelbrot>, Error> {
    Ok(Smooth(Mandelbrot::new(view(size)?, MAX_DWELL)?))
}

/// The middle of the picture with all its digits.
#[rustfmt::skip]
pub const DEEP_CENTRE: Complex<Limbs<12>> = Complex::new(
    Limbs::from_limbs([1601416482, 1513008881, 4002838894, 2443259124, 1743443468, 2841010018, 3300484364, 1375626942, 1305737883, 582033850, 350339977, 4095346910]),
    Limbs::from_limbs([2213411779, 946818934, 2165490520, 1761100635, 2031729913, 406697034, 746969801, 2581093636, 3988060493, 3185964621, 3040708323, 35386746]),
);

/// Its width.
#[rustfmt::skip]
pub const DEEP_WIDTH: Limbs<12> =
    Limbs::from_limbs([2788119596, 3921331254, 339837053, 507127748, 1156279413, 277934549, 3751731586, 2428359390, 3843595782, 882226139, 227906770, 8]);

/// Points of the orbit that the picture borrows, on a display of any size.
pub const DEEP_ORBIT: usize = 0;

/// What a display of this size shows.
///
/// # Errors
/// Those of [`DeepView::new`].
pub fn deep_view(size: Size) -> Result<DeepView<12>, Error> {
    DeepView::new(DEEP_CENTRE, DEEP_WIDTH, size)
}

/// The same where pixels are too near one another for [`picture`], which says so.
///
/// # Errors
/// Those of [`DeepView::new`]; [`Error::BufferLength`] for an orbit shorter than [`DEEP_ORBIT`].
pub fn deep_picture(size: Size, orbit: &mut [OrbitPoint]) -> Result<Smooth<DeepMandelbrot<'_, 12>>, Error> {
    Ok(Smooth(DeepMandelbrot::new(deep_view(size)?, MAX_DWELL, orbit)?))
}

/// Counts that an equalised palette borrows.
pub const COUNTS: usize = 32001;

/// Its colours on a display with colour.
///
/// # Errors
/// [`Error::BufferLength`] for fewer counts than [`COUNTS`].
pub fn color<'a>(
    picture: &impl Field<Value: Leveled>,
    counts: &'a mut [u32],
) -> Result<Inside<Equalised<'a, Gradient<9>>>, Error> {
    Ok(Inside::new(Equalised::new(picture, counts, gradients::DUSK)?, hex(0x102030)))
}

/// Its colours on a display without colour.
pub const GREY: Inside<Cycled<Gradient<13>>> =
    Inside::new(Cycled::new(gradients::EVEN, 30 * FractionalDwell::STEPS), hex(0x000000));
