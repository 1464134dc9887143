//! `attractor spectrum`: how the power of a curve's coordinates falls with the frequency, `P ~ 1/f^beta`,
//! measured, and what theory says.
//!
//! `2^n` values at equal distances, less the chord between both ends (a jump from the end back to the start
//! would add `1/f^2`), times a Hann window, through a discrete Fourier transform; the mean power of each
//! octave; a line through the logarithms from 8 periods to a 16th of the sampling rate. Lower octaves feel
//! the window, higher ones the aliases of what lies above the sampling rate. The periodogram is A. Schuster,
//! 1898; the window J. von Hann's (F. J. Harris, "On the use of windows for harmonic analysis", 1978).
//! Functions (`fif-curve`): 2^16 ordinates. Random curves: 2^14 points at equal parameters of each of 64
//! curves of the law, powers added up, those of both coordinates too where the curve lies in the plane:
//! displacements begin along one coordinate and end in all directions.

use std::f64::consts::TAU;
use std::io::Write as _;

use realfft::RealFftPlanner;

use crate::cli::Spectrum;
use crate::fail::{Fail, one_line};
use crate::fit::Fit;
use crate::scene::{self, Subject};
use crate::table;
use crate::theory::Theory;

/// Logarithm of the number of ordinates of a function, and of the points of a random curve.
const ORDINATES: u32 = 16;
const POINTS: u32 = 14;
/// Octaves that are fitted: periods from `2^FIRST` to `2^(n - LAST)` of `2^n` values.
const FIRST: u32 = 3;
const LAST: u32 = 4;

/// Prints it.
pub(crate) fn run(args: &Spectrum) -> Result<(), Fail> {
    let scene = scene::load(&args.scene)?;
    let fail = |reason: &str| Fail::new(format_args!("{}: kind = {}: {reason}", args.scene, scene.kind()));
    const REFUSED: &str = "a spectrum is measured of kinds fif-curve and random-curve";
    let (what, signals, theory) = match scene.subject() {
        Ok(Subject::Graph(graph)) => {
            let signals = graph.ordinates(ORDINATES);
            let what = match signals.len() {
                1 => "ordinates above the chord".to_owned(),
                n => format!("ordinates of each of {n} functions of the law"),
            };
            (what, signals, graph.spectrum)
        }
        Ok(Subject::Trail(trail)) => {
            let law = trail.law.ok_or_else(|| fail(REFUSED))?;
            coordinates(law)?
        }
        Ok(Subject::Set(_) | Subject::Julia(_)) | Err(Fail::Message(_)) => return Err(fail(REFUSED)),
        Err(other) => return Err(other),
    };
    let count = signals.first().map_or(0, Vec::len).saturating_sub(1);
    let octaves = octaves(&signals).ok_or_else(|| fail("it is flat: it has no spectrum"))?;
    let fit = Fit::of(&octaves).ok_or_else(|| fail("it is flat: it has no spectrum"))?;
    if args.csv {
        return table::csv(&["log_frequency", "log_power"], octaves);
    }
    let mut out = std::io::stdout().lock();
    writeln!(out, "scene      {} ({})", one_line(&scene.name), scene.kind())?;
    writeln!(out, "method     periodogram: {count} {what}, Hann window, mean power of octaves")?;
    writeln!(out, "fit range  {} to {} periods, {} octaves", 1 << FIRST, count >> LAST, octaves.len())?;
    writeln!(out, "beta       {:.3} +- {:.3}", -fit.slope, fit.error)?;
    match theory {
        Some(theory) => writeln!(out, "theory     {:.3} ({})", theory.value, theory.source)?,
        None => writeln!(out, "theory     none known for this scene")?,
    }
    Ok(())
}

/// What they are, in words, the signals, and the exponent that theory gives them.
type Signals = (String, Vec<Vec<f64>>, Option<Theory>);

/// Both coordinates of a law's curves.
fn coordinates(law: &scene::Law) -> Result<Signals, Fail> {
    let curves = law.curves(POINTS)?;
    let what = format!("points in both coordinates of each of {} curves of the law", curves.len());
    let split = |curve: &Vec<(f64, f64)>| {
        let (x, y): (Vec<f64>, Vec<f64>) = curve.iter().copied().unzip();
        [x, y]
    };
    Ok((what, curves.iter().flat_map(split).collect(), law.spectrum()))
}

/// `(log f, log P)` of each octave that is fitted, the powers of all signals added up. Each has `2^n + 1`
/// values, of which the last is left out.
fn octaves(signals: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let n = signals.first()?.len() - 1;
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let mut spectrum = transform.make_output_vec();
    let mut power = vec![0.0; spectrum.len()];
    for signal in signals {
        let (first, last) = (*signal.first()?, *signal.last()?);
        let windowed = signal.iter().take(n).enumerate().map(|(i, y)| {
            let t = i as f64 / n as f64;
            (y - first - (last - first) * t) * (1.0 - (TAU * t).cos()) / 2.0
        });
        transform.process(&mut windowed.collect::<Vec<_>>(), &mut spectrum).ok()?;
        for (sum, value) in power.iter_mut().zip(&spectrum) {
            *sum += value.norm_sqr();
        }
    }
    let octave = |k: u32| {
        let periods = 1_usize << k..1 << (k + 1);
        let mean = power.get(periods.clone())?.iter().sum::<f64>() / periods.len() as f64;
        Some(((1.5 * periods.start as f64).ln(), mean.ln()))
    };
    (FIRST..n.ilog2() - LAST).map(octave).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_again() {
        // phases by the golden ratio
        let n = 1 << ORDINATES;
        let transform = RealFftPlanner::<f64>::new().plan_fft_inverse(n);
        for request in [1.0, 1.5, 2.0, 2.5] {
            let mut z = transform.make_input_vec();
            for (k, z) in z.iter_mut().enumerate().take(n / 2).skip(1) {
                let (sin, cos) = (TAU * (k as f64 * k as f64 * 0.618_033_988_749_895).fract()).sin_cos();
                let amplitude = (k as f64).powf(-request / 2.0);
                (z.re, z.im) = (amplitude * cos, amplitude * sin);
            }
            let mut signal = transform.make_output_vec();
            transform.process(&mut z, &mut signal).unwrap();
            signal.push(signal[0]);
            let fit = Fit::of(&octaves(&[signal]).unwrap()).unwrap();
            assert!((fit.slope + request).abs() < 0.1, "{request}: {fit:?}");
        }
        assert!(Fit::of(&octaves(&[vec![1.0; n + 1]]).unwrap()).is_none());
    }
}
