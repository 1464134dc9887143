//! Moving about in a scene, as a window's keys and mouse ask for it.

use attractor::num::Complex;
use attractor::num::Limbs;
use embedded_graphics::geometry::{Point, Size};

/// What the viewer wants.
#[cfg_attr(not(feature = "window"), expect(dead_code, reason = "only a window moves about"))]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Motion {
    /// To look at what lies so many pixels to the right and up.
    Pan { right: i32, up: i32 },
    /// To see everything twice as large, or half as large; the point under this pixel stays where it is, else
    /// the middle of the display.
    Zoom { about: Option<Point>, closer: bool },
    /// Twice as many iterations, or half as many.
    Iterate { more: bool },
    /// The light further to the right and up, by as many pixels as a camera that is panned.
    Light { right: i32, up: i32 },
}

/// A square-pixel view of the plane: its middle and its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Sight<const LIMBS: usize> {
    pub(crate) centre: Complex<Limbs<LIMBS>>,
    pub(crate) width: Limbs<LIMBS>,
}

impl<const LIMBS: usize> Sight<LIMBS> {
    /// The view on a display of this size after a motion, within a pixel. None where it would leave the
    /// format's `-8 .. 8`.
    pub(super) fn after(&self, motion: Motion, size: Size) -> Option<Self> {
        let (half_pitch, _) = self.width.divided(2 * size.width);
        let moved = |right: i32, up: i32, step: &Limbs<LIMBS>| {
            let by = |middle: &Limbs<LIMBS>, steps: i32| middle.plus(&step.times_small(steps));
            Complex::new(by(&self.centre.re, right), by(&self.centre.im, up))
        };
        let next = match motion {
            Motion::Pan { right, up } => {
                Self { centre: moved(2 * right, 2 * up, &half_pitch), width: self.width }
            }
            Motion::Zoom { about, closer } => {
                // from the middle of the display to the middle of the pixel, in half pitches
                let (right, up) = about.map_or((0, 0), |about| {
                    (2 * about.x + 1 - size.width as i32, size.height as i32 - 1 - 2 * about.y)
                });
                if closer {
                    let quarter_pitch = half_pitch.divided(2).0;
                    Self { centre: moved(right, up, &quarter_pitch), width: self.width.divided(2).0 }
                } else {
                    Self { centre: moved(-right, -up, &half_pitch), width: self.width.times_small(2) }
                }
            }
            Motion::Iterate { .. } | Motion::Light { .. } => *self,
        };
        // the formats end at 8: a view that reaches 4 from 0 is wide enough for any of these sets
        let inside = |v: &Limbs<LIMBS>| v.to_wide().unsigned_abs() <= 4;
        (inside(&next.centre.re)
            && inside(&next.centre.im)
            && next.width.to_wide() < 8
            && !next.width.is_negative())
        .then_some(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size::new(240, 120);

    fn sight(re: &str, im: &str, width: &str) -> Sight<12> {
        let parse = |text: &str| text.parse().unwrap();
        Sight { centre: Complex::new(parse(re), parse(im)), width: parse(width) }
    }

    /// The point under a pixel's middle.
    fn under(sight: &Sight<12>, at: Point) -> Complex<Limbs<12>> {
        let step = sight.width.divided(2 * SIZE.width).0;
        let (right, up) = (2 * at.x + 1 - 240, 119 - 2 * at.y);
        Complex::new(
            sight.centre.re.plus(&step.times_small(right)),
            sight.centre.im.plus(&step.times_small(up)),
        )
    }

    #[test]
    fn the_point_under_the_mouse_stays_under_it() {
        let at = Point::new(17, 101);
        let about = Some(at);
        let start = sight("-0.75", "0.1", "3");
        let mut now = start;
        let fixed = under(&start, at);
        for _ in 0..300 {
            now = now.after(Motion::Zoom { about, closer: true }, SIZE).unwrap();
        }
        // 3 / 2^300
        assert!(now.width.to_wide() == 0 && !now.width.is_negative());
        let error = |a: &Limbs<12>, b: &Limbs<12>| a.minus(b).magnitude().to_wide();
        assert_eq!(error(&under(&now, at).re, &fixed.re), 0);
        for _ in 0..300 {
            now = now.after(Motion::Zoom { about, closer: false }, SIZE).unwrap();
        }
        assert!(error(&now.width, &start.width) == 0);
        assert!(error(&under(&now, at).im, &fixed.im) == 0);
    }

    #[test]
    fn a_pan_moves_by_pixels() {
        let start = sight("0", "0", "2.4");
        let moved = start.after(Motion::Pan { right: 30, up: -12 }, SIZE).unwrap();
        let close = |a: &Limbs<12>, b: f64| (a.to_wide().to_num::<f64>() - b).abs() < 1e-12;
        assert!(close(&moved.centre.re, 0.3) && close(&moved.centre.im, -0.12));
    }

    #[test]
    fn nobody_leaves_the_format() {
        let about = None;
        assert_eq!(sight("0", "0", "4").after(Motion::Zoom { about, closer: false }, SIZE), None);
        assert_eq!(sight("3.9", "0", "3").after(Motion::Pan { right: 100, up: 0 }, SIZE), None);
    }
}
