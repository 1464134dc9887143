//! What the escape-time pictures have in common, for the types that colour them in another way or draw them faster.

use super::dwell::{Fine, Step, Word};
use super::{Complex, Dwell, Julia, Mandelbrot, View};
use crate::num::Wide;
use crate::picture::Field;

/// A picture whose pixels are dwells of orbits of `z^2 + c`: [`Mandelbrot`] and [`Julia`].
pub trait EscapeTime: Field<Value = Dwell> {
    /// Which points the pixels show.
    fn view(&self) -> &View;
    /// The dwell of a point that does not escape.
    fn max_dwell(&self) -> u32;
    /// The dwell at a point.
    fn dwell_at(&self, point: Complex<Wide>) -> Dwell;
    /// The orbit of a point; none where the dwell is 0.
    fn orbit(&self, point: Complex<Wide>) -> Option<Orbit>;
    /// The constant of that orbit.
    fn constant_at(&self, point: Complex<Wide>) -> Complex<Wide>;
    /// Whether conjugate points have the same dwell, to the last bit.
    fn is_mirrored(&self) -> bool;
    /// The same picture through another view.
    #[must_use]
    fn with_view(self, view: View) -> Self
    where
        Self: Sized;
}

/// The orbit of a point: where it starts, and the constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Orbit {
    pub(super) z: Word,
    pub(super) c: Word,
    /// Whether the constant moves with the point: the derivative by the point then gains 1 at each step.
    pub(super) by_constant: bool,
}

impl Orbit {
    /// The next point, wrapped, for a point within 2.
    #[inline]
    pub(super) fn step(&mut self) {
        self.z = Fine::step(self.z, self.c);
    }
}

macro_rules! escape_time {
    ($($picture:ty, $mirrored:literal;)*) => {$(
        impl EscapeTime for $picture {
            fn view(&self) -> &View {
                self.view()
            }

            fn max_dwell(&self) -> u32 {
                self.max_dwell()
            }

            #[inline]
            fn dwell_at(&self, point: Complex<Wide>) -> Dwell {
                self.dwell_at(point)
            }

            #[inline]
            fn orbit(&self, point: Complex<Wide>) -> Option<Orbit> {
                self.orbit_of(point)
            }

            fn constant_at(&self, point: Complex<Wide>) -> Complex<Wide> {
                self.constant_of(point)
            }

            fn is_mirrored(&self) -> bool {
                $mirrored
            }

            fn with_view(self, view: View) -> Self {
                self.through(view)
            }
        }
    )*};
}

escape_time! { Mandelbrot, true; Julia, false; }
