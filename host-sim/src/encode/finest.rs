//! The finest step that a picture of 16 bits is encoded at.
//!
//! A level is at most 8191, a mean at most `2^21 - 2` steps from what is expected. The smallest squares,
//! 4 x 4, have coefficients up to twice the range and means up to four times: of 8 bits no step is too fine
//! for that, of 16 bits one below 16 may be, as what levels cut off outweighs what they round away. So steps
//! are made finer as long as that takes error off the smallest squares.

use attractor::codec::Step;
use attractor::codec::shared::{FREQUENCIES, LARGEST, scan};
use rayon::prelude::*;

use super::cosine::Cosine;
use super::samples::Samples;

/// The most steps that a mean is from what is expected.
pub(super) const MOST: f32 = 2_097_150.0;
/// An eighth: at finer steps a mean of the smallest squares may be cut off.
const MEANS: u16 = 0x100;
/// By how much finer the next one is.
const STRIDE: u16 = 16;

/// The finest step whose means are never cut off: all there is to it where there are no levels.
pub(super) const fn without_levels() -> u16 {
    MEANS
}

/// The finest step, for smallest squares of `2^size`, 2 or 3.
pub(super) fn finest(original: &Samples, size: u32, cosine: &Cosine) -> u16 {
    let n = 1 << size;
    let bands = original.values.par_chunks_exact(original.width << size);
    let lengths = bands.flat_map_iter(|band| {
        let (mut square, mut coefficients) = ([0.0; 64], [0.0; FREQUENCIES * FREQUENCIES]);
        let band = Samples { width: original.width, values: band.to_vec() };
        (0..original.width as u32).step_by(n).flat_map(move |x| {
            band.square(x, 0, n, &mut square);
            cosine.forward(size, &square[..n * n], &mut coefficients);
            scan(size)[1..].iter().map(|place| coefficients[usize::from(*place)].abs()).collect::<Vec<_>>()
        })
    });
    let lengths: Vec<f32> = lengths.collect();
    // sums in an order that threads do not change
    let error = |step: u16| {
        let step = Step::from_bits(step).map_or(0.0, |step| f64::from(step.value()) / 256.0);
        let sum = |chunk: &[f32]| chunk.iter().map(|length| lost(f64::from(*length), step)).sum::<f64>();
        lengths.par_chunks(1 << 12).map(sum).collect::<Vec<_>>().into_iter().sum::<f64>()
    };
    // at that no level is cut off
    let mut step = ((6 + size) << 8) as u16;
    let mut least = error(step);
    while step > MEANS {
        let finer = error(step - STRIDE);
        if finer > least {
            break;
        }
        (step, least) = (step - STRIDE, finer);
    }
    step
}

/// The squared error of a coefficient, rounded or cut off.
fn lost(length: f64, step: f64) -> f64 {
    let above = length - f64::from(LARGEST) * step;
    if above > 0.5 * step {
        above * above
    } else if length > 0.5 * step {
        step * step / 12.0
    } else {
        length * length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: impl Fn(usize) -> f32) -> u16 {
        finest(&Samples::new(64, 64, 32, value), 2, &Cosine::new())
    }

    #[test]
    fn steps_are_as_fine_as_levels_allow() {
        // flat or smooth: as fine as means allow
        assert_eq!(of(|_| 65535.0), MEANS);
        assert_eq!(of(|at| (at % 64 * 100) as f32), MEANS);
        // the greatest coefficient there is, of two frequencies at once
        let stripes = of(|at| if (at + at / 64 % 4 / 2) % 4 / 2 == 0 { 0.0 } else { 65535.0 });
        assert!((0x700..=0x800).contains(&stripes), "{stripes:x}");
    }
}
