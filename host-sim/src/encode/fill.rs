//! The last bytes of a target.
//!
//! What is decided early in a picture changes what all else costs, so that bytes are no smooth function of
//! anything: encodings that differ by little differ by more in bytes, and some are worth a little more than
//! others. So a few of them are made first. Then bits become dearer or cheaper from some row on. What is
//! above it stays as it is, and the fewer rows are left, the less can be missed.

use attractor::Error;
use attractor::codec::Step;

use super::target::Target;
use super::trials::{Encode, Fit, Trials};

/// Rounds of other steps, the last ones where not all are made: by how much coarser.
const ASIDE: [[i16; 4]; 3] = [[-7, -9, -11, -13], [-3, -4, -5, -6], [1, -1, 2, -2]];
/// What part of the bytes is left in each round after them.
const LEFT: [f64; 4] = [0.5, 0.25, 0.1, 0.1];
/// Bits become dearer by these parts of what seems right.
const PARTS: [f64; 4] = [0.8, 1.2, 0.8, 1.2];
/// All rounds of other steps are made of pictures of few pixels.
const FEW: f64 = 131_072.0;
/// No more encodings than fit into a few seconds: what one takes by its pixels, and by its bytes.
const TIME: f64 = 4.7e6;
const PER_PIXEL: f64 = 0.36;
const PER_BYTE: f64 = 13.0;
/// How much less is taken than is allowed, and from where on that is enough: logarithms, and a part.
const SPARE: f64 = 0.0003;
const FULL: f64 = 0.9992;
/// One that is worth less by so many decibels is as good.
const AS_GOOD: f64 = 0.004;
/// How far an encoding may miss the target to be mended.
const LOOSE: f64 = 0.04;
/// Logarithm of the bytes that a step takes, and of those that it takes to make bits dearer, at first.
const PER_STEP: f64 = 0.0035;
const RESPONSE: f64 = 0.5;

/// Encodes until all that is allowed is made use of, or at most as often as it is worth for so many pixels.
pub(super) fn fill<F: Encode>(trials: &mut Trials<'_, F>, pixels: f64) -> Result<(), Error> {
    let target = trials.target;
    let (aim, aside, most) = match target {
        Target::Bytes(bytes) if trials.effort.again => {
            let aside = 2 + usize::from(pixels < FEW);
            (-SPARE, aside, (TIME / (PER_PIXEL * pixels + PER_BYTE * bytes)) as usize)
        }
        _ if trials.any(|e| target.is_met(e, trials.effort.filled) || target.is_near(e)) => return Ok(()),
        _ => (trials.aim(), 0, usize::MAX),
    };
    let Some(mut fit) = trials.best(LOOSE, &|_| true).or_else(|| trials.nearest()) else { return Ok(()) };
    trials.stay(&fit);
    let mut response = RESPONSE;
    let rounds = ASIDE[ASIDE.len() - aside..].iter().map(|steps| (1.0, &steps[..]));
    let rounds: Vec<_> = rounds.chain(LEFT.map(|left| (left, &[0, 0][..]))).collect();
    for (k, (left, steps)) in rounds.iter().enumerate() {
        // other steps leave time for the rounds after them
        let room = if *left < 1.0 { steps.len() } else { steps.len() + 2 * LEFT.len() };
        if trials.tried.len() + room > most {
            continue;
        }
        let least = trials.worth()(&fit) - AS_GOOD;
        let full = trials.best(LOOSE, &|e| target.is_met(e, FULL));
        if full.is_some_and(|full| trials.worth()(&full) > least) {
            break;
        }
        // of a picture of one band nothing is left but all
        let all = fit.starts.last().map_or(0, |(_, bytes)| *bytes).max(1) as f64;
        let rest = |bytes: usize| 1.0 - bytes as f64 / all;
        let Some((from, before)) = fit.starts.iter().rfind(|(_, bytes)| rest(*bytes) >= *left) else { break };
        let dearer = ((fit.miss - aim) / (response * rest(*before))).clamp(-0.5, 0.5);
        let now = fit.thrift.last().map_or(1.0, |(_, thrift)| *thrift);
        let others = steps.iter().zip(PARTS).map(|(coarser, part)| {
            let step = fit.step.saturating_add_signed(*coarser).min(Step::MAX.to_bits());
            let same = f64::from(*coarser) * PER_STEP / response;
            let mut thrift = fit.thrift.clone();
            thrift.push((*from, now * (part * dearer - same).exp() as f32));
            (step, thrift)
        });
        let misses = trials.round(&others.collect::<Vec<_>>())?;
        let less: f64 = misses.iter().map(|miss| fit.miss - miss).sum();
        let dearer = dearer * PARTS.iter().take(steps.len()).sum::<f64>() * rest(*before);
        if dearer.abs() > 1e-6 {
            response = (less / dearer).clamp(0.4, 4.0);
        }
        // of those that the next round can mend the best, or else the nearest
        let reach = rounds.get(k + 1).map_or(0.0, |(left, _)| LOOSE * left);
        let worth = trials.worth();
        let last = || trials.fits[trials.fits.len() - misses.len()..].iter().chain([&fit]);
        let off = |fit: &Fit| (fit.miss - aim).abs();
        let best = last().filter(|fit| off(fit) < reach).max_by(|a, b| worth(a).total_cmp(&worth(b)));
        let next = best.or_else(|| last().min_by(|a, b| off(a).total_cmp(&off(b)))).cloned();
        fit = next.unwrap_or(fit);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::file::{At, Known};
    use super::super::search::Effort;
    use super::super::target::Encoded;
    use super::super::trials::Trial;
    use super::*;
    use attractor::codec::shared::MODELS;

    const BANDS: u32 = 8;
    const ROWS: u32 = 64;

    /// A picture whose bands take bytes as coded ones do: fewer where steps are coarser or bits dearer, and a
    /// grain, other in each band and for all that is encoded above it.
    fn encoded(picture: u64, at: At<'_>) -> Trial {
        let step = at.step.to_bits();
        let (mut bytes, mut starts, mut above) = (0.0_f64, Vec::new(), picture);
        for band in 0..BANDS {
            starts.push((band * ROWS, bytes as usize));
            let last = at.thrift.iter().rfind(|(row, _)| *row <= band * ROWS);
            let thrift = last.map_or(1.0, |(_, thrift)| *thrift);
            for word in [u64::from(step), u64::from(thrift.to_bits())] {
                above = (above ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
            }
            let grain = 1.0 + 0.02 * ((above >> 40) as f64 / f64::from(1 << 24) - 0.5);
            let dearer = f64::from(thrift).powf(-0.6);
            bytes += 1000.0 * (-0.003 * f64::from(step)).exp() * dearer * grain;
        }
        starts.push((BANDS * ROWS, bytes as usize));
        let encoded = Encoded { bytes: vec![0; bytes as usize], psnr: 8.0 * bytes.ln(), step, finest: false };
        Trial { encoded, pools: Vec::new(), counts: [[0; 2]; MODELS], starts }
    }

    /// The bytes of the best encoding that is allowed, as a part of the target, and how many encodings there
    /// were, which is held to what their time allows.
    fn filled(picture: u64, bytes: f64, pixels: f64) -> (f64, usize) {
        let target = Target::Bytes(bytes);
        let encode = |at: At<'_>, _: Known<'_>| Ok::<_, Error>(encoded(picture, at));
        let mut said = |_: &Encoded| {};
        let mut trials = Trials::new(encode, (target, Effort::BEST), 0, &[], [[0; 2]; MODELS], &mut said);
        // as the steps before leave it: one is off by up to 3 per cent, one is allowed
        let near = -(bytes / 8000.0).ln() / 0.003 + (picture % 21) as f64 - 10.0;
        trials.round(&[near, near + 25.0].map(|step| (step as u16, Vec::new()))).unwrap();
        fill(&mut trials, pixels).unwrap();
        let best = target.best(&trials.tried).unwrap();
        assert!(best.bytes.len() as f64 <= bytes, "{picture}: more bytes than are allowed");
        let most = (TIME / (PER_PIXEL * pixels + PER_BYTE * bytes)) as usize;
        let encodings = trials.tried.len();
        assert!(encodings <= most.max(2), "{picture}: {encodings} encodings, allowed {most}");
        (best.bytes.len() as f64 / bytes, encodings)
    }

    #[test]
    fn what_is_allowed_is_filled_but_for_a_five_hundredth() {
        const PICTURES: u64 = 1000;
        let mut short = 0;
        for picture in 0..PICTURES {
            let (part, _) = filled(picture, 2000.0 + 5.0 * picture as f64, 512.0 * 512.0);
            assert!(part >= 0.995, "{picture}: {part}");
            short += u32::from(part < 0.998);
        }
        // the grain may be against one in each of its rounds
        assert!(short <= 10, "{short} of {PICTURES}");
    }

    #[test]
    fn large_pictures_are_filled_as_far_as_there_is_time() {
        let counts = [20, 21, 22, 24].map(|octaves| {
            let counts = (20..300).map(|picture| filled(picture, 6000.0, f64::from(1 << octaves)).1);
            counts.max().unwrap_or(0)
        });
        assert!(counts[0] > 5 && counts[3] == 2, "{counts:?}");
    }
}
