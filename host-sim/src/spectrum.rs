//! `attractor spectrum`: how the power of a curve's ordinate falls with the frequency, `P ~ 1/f^beta`, measured, and what theory says.
//!
//! 2^16 ordinates at equal distances, less the chord between both ends (a jump from the end back to the start would add `1/f^2`), times a Hann window,
//! through a discrete Fourier transform; the mean power of each octave; a line through the logarithms from 8 periods to a 16th of the sampling rate.
//! Lower octaves feel the window, higher ones the aliases of what lies above the sampling rate. The periodogram is A. Schuster, 1898; the window J. von Hann's
//! (F. J. Harris, "On the use of windows for harmonic analysis", 1978).
//!
//! Theory, for affine maps on `N` equal intervals: second differences at distance `h / N` are `alpha_j` times those at `h`, so that their mean square scales by
//! `sum alpha_j^2 / N` and `beta = 2 - log(sum alpha_j^2) / log N` as long as that is between 1 and 3; with all `|alpha_j|` alike it is `5 - 2 D`.

use std::f64::consts::TAU;
use std::io::Write as _;

use crate::cli::Spectrum;
use crate::fail::Fail;
use crate::fit::Fit;
use crate::scene::{self, Graph, Subject};

/// Logarithm of the number of ordinates.
const LOG: u32 = 16;
/// Octaves that are fitted: periods from `2^FIRST` to `2^LAST`.
const FIRST: u32 = 3;
const LAST: u32 = LOG - 4;

/// Prints it.
pub(crate) fn run(args: &Spectrum) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let fail = |reason: &str| Fail::new(format_args!("{}: kind = {}: {reason}", args.scene, scene.kind()));
    let Some(Subject::Graph(graph)) = scene.subject() else {
        return Err(fail("no spectrum is measured of this kind, only of fif-curve"));
    };
    let count = 1_u64 << LOG;
    let ordinates: Vec<f64> = (0..count).map(|i| graph.at(i, count - 1)).collect();
    let fit = beta(&ordinates).ok_or_else(|| fail("its graph is flat: it has no spectrum"))?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "scene      {} ({})", scene.name, scene.kind())?;
    writeln!(
        out,
        "method     periodogram of {count} ordinates above the chord, Hann window, mean power of octaves"
    )?;
    writeln!(out, "fit range  {} to {} periods, {} octaves", 1 << FIRST, 1 << LAST, LAST - FIRST)?;
    writeln!(out, "beta       {:.3} +- {:.3}", fit.slope, fit.error)?;
    match theory(&graph) {
        Some(beta) => writeln!(out, "theory     {beta:.3} (2 - log(sum alpha_j^2) / log N)")?,
        None => writeln!(out, "theory     none known for this scene")?,
    }
    Ok(())
}

fn theory(graph: &Graph<'_>) -> Option<f64> {
    let (scalings, n) = graph.scalings.as_ref().zip(graph.equal_intervals)?;
    let beta = 2.0 - scalings.iter().map(|a| a * a).sum::<f64>().ln() / (n as f64).ln();
    (1.0..3.0).contains(&beta).then_some(beta)
}

/// The exponent of a signal of `2^LOG` values.
pub(crate) fn beta(ordinates: &[f64]) -> Option<Fit> {
    let n = ordinates.len();
    let (first, last) = (*ordinates.first()?, *ordinates.last()?);
    let windowed = ordinates.iter().enumerate().map(|(i, y)| {
        let t = i as f64 / (n - 1) as f64;
        ((y - first - (last - first) * t) * (1.0 - (TAU * t).cos()) / 2.0, 0.0)
    });
    let transformed = fourier(windowed.collect());
    let octave = |k: u32| {
        let periods = 1_usize << k..1 << (k + 1);
        let count = periods.len() as f64;
        let power: f64 = transformed.get(periods)?.iter().map(|(re, im)| re * re + im * im).sum();
        Some((-(1.5 * f64::from(1 << k)).ln(), (power / count).ln()))
    };
    Fit::of(&(FIRST..LAST).map(octave).collect::<Option<Vec<_>>>()?)
}

/// The discrete Fourier transform of `2^n` complex values, by decimation in time (J. W. Cooley, J. W. Tukey, 1965).
fn fourier(mut z: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let n = z.len();
    let shift = usize::BITS - n.trailing_zeros();
    for i in 0..n {
        let j = i.reverse_bits() >> shift;
        if i < j {
            z.swap(i, j);
        }
    }
    let mut half = 1;
    while half < n {
        for k in 0..half {
            let (sin, cos) = (-TAU * k as f64 / (2 * half) as f64).sin_cos();
            for i in (k..n).step_by(2 * half) {
                let ((a, b), (c, d)) = (z[i], z[i + half]);
                let (re, im) = (c * cos - d * sin, c * sin + d * cos);
                (z[i], z[i + half]) = ((a + re, b + im), (a - re, b - im));
            }
        }
        half *= 2;
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_is_the_sum_that_defines_it() {
        let signal: Vec<(f64, f64)> = (0..16).map(|i| (f64::from(i * i % 7), f64::from(i % 3))).collect();
        for (k, (re, im)) in fourier(signal.clone()).into_iter().enumerate() {
            let (mut x, mut y) = (0.0, 0.0);
            for (i, (a, b)) in signal.iter().enumerate() {
                let (sin, cos) = (-TAU * (i * k) as f64 / 16.0).sin_cos();
                x += a * cos - b * sin;
                y += a * sin + b * cos;
            }
            assert!((re - x).abs() < 1e-12 && (im - y).abs() < 1e-12, "{k}");
        }
    }

    #[test]
    fn a_power_law_is_found_again() {
        // phases by the golden ratio
        for request in [1.0, 1.5, 2.0, 2.5] {
            let n = 1 << LOG;
            let mut z = vec![(0.0, 0.0); n];
            for k in 1..n / 2 {
                let (sin, cos) = (TAU * (k as f64 * k as f64 * 0.618_033_988_749_895).fract()).sin_cos();
                let amplitude = (k as f64).powf(-request / 2.0);
                z[k] = (amplitude * cos, amplitude * sin);
                z[n - k] = (amplitude * cos, -amplitude * sin);
            }
            let signal: Vec<f64> = fourier(z).into_iter().map(|z| z.0).collect();
            let fit = beta(&signal).unwrap();
            assert!((fit.slope - request).abs() < 0.1, "{request}: {fit:?}");
        }
        assert!(beta(&[1.0; 1 << LOG]).is_none());
    }
}
