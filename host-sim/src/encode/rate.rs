//! The step that meets a target: so many bytes at most, or so many decibels at least.
//!
//! Bytes and decibels are nearly straight lines over the logarithm of the step; a few encodings bracket the
//! target and narrow it down, and `fill` does the rest. Domains are looked for once, when the step is
//! roughly known: of large pictures from some bands alone.

use attractor::Error;
use attractor::codec::shared::{context, crc32};
use attractor::codec::{Planes, Profile, Step, check};
use rayon::prelude::*;

use super::file::{At, Known, Plan, Pool, Source, Thrift};
use super::fill::fill;
use super::finest::without_levels;
use super::quality::decibels;
use super::range_encoder::Counts;
use super::search::Effort;
use super::target::{Encoded, Target};
use super::trials::{Encode, Trial, Trials};
use crate::decode::{decoded, decoded_with_planes};
use crate::still::Still;

/// Where a header says how many sweeps.
const REACH: usize = 12;

/// A step to begin with, one that is tried beside it; how much finer and coarser the first with domains are.
const FIRST: u16 = 0x900;
const OCTAVE: u16 = 256;
const CHEAPER: u16 = 6;
const DEARER: u16 = 20;
/// Bytes grow about as fast as the step shrinks, of which 256 are an octave.
const STEPS: f64 = 300.0;
/// The most encodings, at different steps: rough ones, until one is so near, and all.
const ROUGH: usize = 6;
const NEAR: f64 = 0.03;
const PASSES: usize = 16;
/// Between two steps bytes differ by no more, if prices of bins stay.
const JUMP: f64 = 0.02;
/// The part of the bytes that is promised: where all else has missed it, how much finer the step is, and
/// how often what a bit is worth is changed there at most.
const MET: f64 = 0.99;
const FINER: [u16; 8] = [0, 2, 7, 19, 4, 11, 14, 29];
const BETWEEN: usize = 6;
/// How near to the finest step others are of which the best is looked for, how far from each other at first,
/// and how often.
const NEARLY: u16 = 96;
const STRIDE: u16 = 24;
const CLIMBS: usize = 5;
/// Where bytes are left, no step is tried that is coarser, and none after one that is worse by more decibels.
const COARSE: u16 = 0xb00;
const WORSE: f64 = 6.0;
/// Logarithm of the bytes that a step takes.
const PER_STEP: f64 = 0.0035;

/// Encodes a picture. `said` hears of every encoding.
pub(crate) fn meet(
    still: &Still,
    halved: bool,
    plan: Plan,
    effort: Effort,
    target: Target,
    said: &mut dyn FnMut(&Encoded),
) -> Result<Encoded, Error> {
    let (kind, values) = still.planes(halved);
    let source = Source::new(still.size, kind, still.peak() > 255, &values, plan, effort);
    let sweeps = plan.profile != Profile::Streaming;
    let finest = source.finest();
    let encode = |at: At<'_>, known: Known<'_>| {
        let pass = source.encode(at, known)?;
        let mut pools = Vec::new();
        let psnr = match pass.decibels {
            Some(psnr) => psnr,
            // what it takes is all that is asked of a part
            None if at.every > 1 => f64::NAN,
            None => {
                let (picture, planes) = decoded_with_planes(&pass.bytes)?;
                if sweeps {
                    let planes = planes.into_iter().zip(pass.settled);
                    pools = planes.map(|(samples, settled)| Pool { samples, settled }).collect();
                }
                psnr(still, &picture)
            }
        };
        let encoded = Encoded { bytes: pass.bytes, psnr, step: at.step.to_bits(), finest: false };
        Ok::<_, Error>(Trial { encoded, pools, counts: pass.counts, starts: pass.starts })
    };
    // first without domains: fast, and not far from what is wanted. Decibels of colour are those of a picture
    let every = match target {
        Target::Decibels(_) if sweeps || kind != Planes::Grey => 1,
        _ => source.sparse(),
    };
    let none = source.candidates(None, Step::MAX);
    let rough = |step: u16| {
        let at = At { step: Step::from_bits(step).unwrap_or(Step::MAX), thrift: &[], every };
        let Trial { encoded, counts, .. } =
            encode(at, Known { candidates: &none, pools: None, counts: None })?;
        let miss = target.miss((encoded.bytes.len() * every as usize) as f64, encoded.psnr);
        Ok::<_, Error>((encoded.step, miss, counts))
    };
    let (near, mut counts) = roughly(target, finest, rough)?;
    // whether a domain pays is not known without domains
    counts[context::DOMAIN..context::NEAR].fill([0; 2]);
    let candidates = source.candidates(Some(effort), Step::from_bits(near).unwrap_or(Step::MAX));
    let mut trials = Trials::new(encode, (target, effort), finest, &candidates, counts, said);
    if still.peak() > 255 && near <= finest + NEARLY {
        climb(&mut trials)?;
    }
    let near = near.max(trials.finest);
    let since = steps(&mut trials, near)?;
    fill(&mut trials, f64::from(still.size.width) * f64::from(still.size.height))?;
    if !trials.any(|e| target.is_met(e, MET) || target.is_near(e)) {
        between(&mut trials, since)?;
    }
    octaves(&mut trials)?;
    let best = target.best(&trials.tried).cloned();
    let best = best.map(|best| Encoded { finest: best.step <= trials.finest, ..best });
    let best = best.ok_or(Error::Degenerate { what: "number of encodings" })?;
    if sweeps { settled(best, still, target) } else { Ok(best) }
}

/// The step that is most likely to meet the target, and what is known of bins there, from rough encodings.
fn roughly(
    target: Target,
    finest: u16,
    rough: impl Fn(u16) -> Result<(u16, f64, Counts), Error> + Sync,
) -> Result<(u16, Counts), Error> {
    let (mut found, mut points): (Vec<(u16, f64, Counts)>, Vec<_>) = (Vec::new(), Vec::new());
    let mut ats = vec![FIRST.max(finest), (FIRST - OCTAVE).max(finest)];
    while !ats.is_empty() {
        found.extend(ats.par_iter().map(|step| rough(*step)).collect::<Result<Vec<_>, _>>()?);
        points = found.iter().map(|(step, miss, _)| (*step, *miss)).collect();
        let enough = found.len() >= ROUGH || points.iter().any(|(_, miss)| miss.abs() < NEAR);
        ats = if enough { Vec::new() } else { pair(target, finest, &points, 0.0) };
    }
    let nearest = found.into_iter().min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (near, _, counts) = nearest.ok_or(Error::Degenerate { what: "number of encodings" })?;
    Ok((next(target, finest, &points, 0.0).unwrap_or(near), counts))
}

/// Of 16 bits, where about the finest step is asked for: looks for that of most decibels. Domains may help
/// where levels are cut off, and there are pictures whose numbers of 32 bits end before that.
fn climb<F: Encode>(trials: &mut Trials<'_, F>) -> Result<(), Error> {
    let (target, mut at) = (trials.target, trials.finest);
    trials.finest = without_levels();
    let best = |tried: &[Encoded]| {
        let best = tried.iter().max_by(|a, b| a.psnr.total_cmp(&b.psnr));
        best.map_or((0, 0.0), |best| (best.step, best.psnr))
    };
    trials.round(&[at, at.saturating_sub(STRIDE)].map(|step| (step, Thrift::new())))?;
    let (mut top, mut stride) = (best(&trials.tried), STRIDE);
    let is_finer = top.0 < at;
    at = top.0;
    for _ in 0..CLIMBS {
        let enough = match target {
            Target::Bytes(_) => is_finer && trials.tried.last().is_some_and(|e| !target.allows(e)),
            Target::Decibels(_) => trials.any(|e| target.allows(e)),
        };
        let next = |by: u16| if is_finer { at.saturating_sub(by).max(trials.finest) } else { at + by };
        let ats = [next(stride), next(2 * stride)];
        if enough || top.1.is_infinite() || ats[0] == at {
            break;
        }
        trials.round(&ats.map(|step| (step, Thrift::new())))?;
        let now = best(&trials.tried);
        if now.0 != ats[1] {
            top = now;
            break;
        }
        (at, top, stride) = (ats[1], now, 2 * stride);
    }
    trials.finest = top.0;
    Ok(())
}

/// Steps on both sides of the target, until one meets it or there is none between. Tells how many of the
/// first trials are no longer true, as prices of bins have changed.
fn steps<F: Encode>(trials: &mut Trials<'_, F>, near: u16) -> Result<usize, Error> {
    let (target, finest) = (trials.target, trials.finest);
    // with domains a picture takes a little less at the same step, or more
    let coarser = near.saturating_add(DEARER).min(Step::MAX.to_bits());
    trials.round(&[near.saturating_sub(CHEAPER), coarser].map(|step| (step, Thrift::new())))?;
    let mut since = 0;
    let most = trials.tried.len() + PASSES;
    while trials.tried.len() < most && !trials.are_enough() {
        let points = &trials.points()[since..];
        let mut ats = pair(target, finest, points, trials.aim());
        if ats.is_empty() && jump(points) > JUMP {
            // prices have changed: the last round alone counts
            since = trials.tried.len() - 2;
            ats = pair(target, finest, &points[points.len() - 2..], trials.aim());
        }
        if ats.is_empty() {
            break;
        }
        trials.round(&ats.into_iter().map(|step| (step, Thrift::new())).collect::<Vec<_>>())?;
    }
    // where bytes are no straight line at all: ever further off, until a step is allowed
    let mut stride = 4;
    while !trials.any(|e| target.allows(e)) {
        stride *= 2;
        let coarsest = trials.tried.iter().map(|e| e.step).max().unwrap_or(near);
        let finer = trials.tried.iter().map(|e| e.step).min().unwrap_or(near);
        let step = match target {
            Target::Bytes(_) => (coarsest + stride).min(Step::MAX.to_bits()),
            Target::Decibels(_) => finer.saturating_sub(stride).max(finest),
        };
        if step == coarsest || step >= finer && matches!(target, Target::Decibels(_)) {
            break;
        }
        trials.round(&[(step, Thrift::new())])?;
    }
    Ok(since)
}

/// Between two steps: bits a little dearer at the coarsest step that is too fine, if there is one that is
/// not. The first trials, up to `since`, had other prices.
fn between<F: Encode>(trials: &mut Trials<'_, F>, since: usize) -> Result<(), Error> {
    let (points, aim) = (trials.points(), trials.aim());
    let both = |points: &[(u16, f64)]| jump(points) > 0.0;
    let points = if both(&points[since..]) { &points[since..] } else { &points[..] };
    let fine = points.iter().filter(|(_, miss)| *miss > 0.0).max_by_key(|(step, _)| *step);
    let Some((step, missed)) = fine.filter(|_| both(points)) else {
        return Ok(());
    };
    for finer in FINER {
        // of small pictures bytes may jump past what is enough while the prices stay
        trials.learns = finer > 0;
        // logarithms of what a bit is worth, and what is missed
        let there = if finer == 0 { *missed } else { f64::from(finer) * PER_STEP };
        let (mut over, mut under) = ((0.0, there), None::<(f64, f64)>);
        for _ in 0..BETWEEN {
            if trials.are_enough() || trials.any(|e| trials.target.is_near(e)) {
                return Ok(());
            }
            let thrifts = match under {
                Some((dear, below)) => {
                    // a straight line, and the middle: there are pictures whose bytes jump
                    let straight = (over.1 - aim) / (over.1 - below).max(1e-9);
                    [straight.clamp(0.05, 0.95), 0.5].map(|share| over.0 + (dear - over.0) * share)
                }
                None => [2.0, 3.0].map(|part| over.0 + part * (over.1 - aim)),
            };
            let at = |thrift: f64| (step.saturating_sub(finer), vec![(0, thrift.exp() as f32)]);
            let misses = trials.round(&thrifts.map(at))?;
            for (thrift, miss) in thrifts.into_iter().zip(misses) {
                let within = thrift > over.0 && under.is_none_or(|(dear, _)| thrift < dear);
                if within && miss > 0.0 {
                    over = (thrift, miss);
                } else if within {
                    under = Some((thrift, miss));
                }
            }
        }
    }
    Ok(())
}

/// Where bytes are left though no finer step takes them: coarser ones, as long as that is not much worse. Of
/// flat squares whole octaves meet the means exactly.
fn octaves<F: Encode>(trials: &mut Trials<'_, F>) -> Result<(), Error> {
    let target = trials.target;
    let is_full = |trials: &Trials<'_, F>| {
        trials.any(|e| target.is_met(e, MET) || target.allows(e) && e.psnr.is_infinite())
    };
    let Some((mut step, psnr)) = target.best(&trials.tried).map(|best| (best.step, best.psnr)) else {
        return Ok(());
    };
    while matches!(target, Target::Bytes(_)) && trials.any(|e| target.allows(e)) && !is_full(trials) {
        let ats = [1, 2].map(|octaves| (step & !255) + octaves * OCTAVE);
        if ats[1] > COARSE {
            break;
        }
        step = ats[1];
        trials.round(&ats.map(|step| (step, Thrift::new())))?;
        let last = trials.tried.iter().rev().take(2).map(|e| e.psnr).fold(0.0, f64::max);
        if last < psnr - WORSE {
            break;
        }
    }
    Ok(())
}

/// Peak signal to noise of all samples.
fn psnr(truth: &Still, picture: &Still) -> f64 {
    decibels(truth.error(picture), truth.count(), truth.peak())
}

/// The same stream with no more sweeps than it needs: so many that more of them gain less than 0.02 dB.
fn settled(best: Encoded, truth: &Still, target: Target) -> Result<Encoded, Error> {
    let most = check(&best.bytes)?.reach;
    for reach in 1..most {
        let picture = decoded(&best.bytes, 0, Some(u32::from(reach)))?;
        let psnr = psnr(truth, &picture);
        if psnr < best.psnr - 0.02 || matches!(target, Target::Decibels(least) if psnr < least) {
            continue;
        }
        let mut bytes = best.bytes[..best.bytes.len() - 4].to_vec();
        bytes[REACH] = reach;
        bytes.extend(crc32(&bytes).to_le_bytes());
        return Ok(Encoded { bytes, psnr, ..best });
    }
    Ok(best)
}

/// The steps to try next, side by side: the most likely one, and one a little further, or else nearer; none
/// where there is none between those tried.
fn pair(target: Target, finest: u16, tried: &[(u16, f64)], aim: f64) -> Vec<u16> {
    let Some(step) = next(target, finest, tried, aim) else { return Vec::new() };
    let far = tried.iter().map(|(other, _)| other.abs_diff(step)).min().unwrap_or(0);
    let by = (far / 4).max(1);
    let mut beside = [step.saturating_add(by).min(Step::MAX.to_bits()), step.saturating_sub(by).max(finest)];
    if tried.iter().all(|(other, _)| *other > step) {
        beside.reverse();
    }
    let free = |other: &u16| *other != step && !tried.iter().any(|(step, _)| step == other);
    [step].into_iter().chain(beside.into_iter().find(free)).collect()
}

/// By how much the misses next to the target differ, one on each side.
fn jump(tried: &[(u16, f64)]) -> f64 {
    let misses = || tried.iter().map(|(_, miss)| *miss);
    let over = misses().filter(|miss| *miss > 0.0).fold(f64::INFINITY, f64::min);
    let under = misses().filter(|miss| *miss <= 0.0).fold(f64::NEG_INFINITY, f64::max);
    // all may be on one side
    if (over - under).is_finite() { over - under } else { 0.0 }
}

/// How many steps it takes to have as much again, from those tried.
fn slope(tried: &[(u16, f64)]) -> f64 {
    let finest = tried.iter().min_by_key(|(step, _)| *step);
    match (finest, tried.iter().max_by_key(|(step, _)| *step)) {
        (Some((a, above)), Some((b, below))) if a < b && (above - below).abs() < 100.0 => {
            (f64::from(b - a) / (above - below)).clamp(0.5 * STEPS, 1.5 * STEPS)
        }
        // what is flat has all its decibels at any step
        _ => STEPS,
    }
}

/// The step to try next, from those tried and how far they missed; none where there is none between.
fn next(target: Target, finest: u16, tried: &[(u16, f64)], aim: f64) -> Option<u16> {
    let steps = slope(tried);
    // 256 an octave: nearly a logarithm
    let points = || tried.iter().map(|(step, miss)| (f64::from(*step), *miss));
    let fine = points().filter(|e| e.1 > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
    let coarse = points().filter(|e| e.1 <= 0.0).min_by(|a, b| a.0.total_cmp(&b.0));
    let far = |(step, miss): (f64, f64)| step + ((miss - aim) * steps).clamp(-1500.0, 1500.0);
    let step = match (fine, coarse) {
        (Some((a, above)), Some((b, below))) if b - a > 1.0 => {
            let share = ((above - aim) / (above - below)).clamp(0.05, 0.95);
            (a + share * (b - a)).clamp(a + 1.0, b - 1.0)
        }
        // no straight line so close: decibels are tried for at finer steps, one by one
        (Some(_), Some((b, _))) => match target {
            Target::Bytes(_) => return None,
            Target::Decibels(_) => points().map(|e| e.0).fold(b, f64::min) - 1.0,
        },
        (Some(fine), None) => far(fine) + 1.0,
        (None, Some(coarse)) => far(coarse) - 1.0,
        (None, None) => return None,
    };
    let step = step.round().clamp(f64::from(finest), f64::from(Step::MAX.to_bits())) as u16;
    (!tried.iter().any(|(other, _)| *other == step)).then_some(step)
}

#[cfg(test)]
mod tests {
    use embedded_graphics::geometry::Size;

    use super::*;
    use crate::still::Pixels;

    const SIDE: u32 = 64;

    fn picture(value: impl Fn(u32, u32) -> u16) -> Still {
        let samples = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
        let pixels = Pixels::Deep(samples.map(|(x, y)| value(x, y)).collect());
        Still { size: Size::new(SIDE, SIDE), pixels }
    }

    /// The same of 8 bits.
    fn shallow(still: Still) -> Still {
        let Pixels::Deep(samples) = &still.pixels else { return still };
        let pixels = Pixels::Grey(samples.iter().map(|value| (value >> 8) as u8).collect());
        Still { pixels, ..still }
    }

    fn met(still: &Still, profile: Profile, target: Target) -> Encoded {
        meet(still, true, Plan::new(profile), Effort::FAST, target, &mut |_| {}).unwrap()
    }

    /// More bytes never make it worse, and decibels 3 below what bytes reach are met when they are asked for.
    fn hold(name: &str, still: &Still, profile: Profile) -> f64 {
        let mut best = 0.0_f64;
        for bytes in [22.0, 60.0, 100.0, 400.0, 1500.0, 4000.0, 5500.0, 6500.0, 8000.0, 12000.0, 40000.0] {
            let encoded = met(still, profile, Target::Bytes(bytes));
            let (length, psnr) = (encoded.bytes.len(), encoded.psnr);
            assert!(psnr >= best - 0.1, "{name}: {best} dB, but {psnr} in {length} of {bytes} bytes");
            best = best.max(psnr);
        }
        for decibels in [45.0, 70.0, best - 3.0] {
            if decibels < best - 0.2 && decibels.is_finite() {
                let psnr = met(still, profile, Target::Decibels(decibels)).psnr;
                assert!(psnr >= decibels, "{name}: {psnr} of {decibels} dB, {best} are within reach");
            }
        }
        best
    }

    fn grain(x: u32, y: u32) -> u16 {
        ((x * 374_761 + y * 66_826 + 1).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b)
            >> 16) as u16
    }

    #[test]
    fn more_bytes_of_16_bits_make_no_picture_worse() {
        let waves = |x: u32, y: u32| {
            (30000.0 + 20000.0 * (f64::from(x) * 0.21).sin() + 9000.0 * (f64::from(y) * 0.37).cos()) as u16
        };
        // coefficients that levels cut off at fine steps: a few, and all
        let edges =
            |x: u32, y: u32| if (x / 9 + y / 13).is_multiple_of(2) { 1000 } else { 64000 } + grain(x, y) / 64;
        let stripes = |x: u32, y: u32| if (x + y / 2) % 4 < 2 { grain(x, y) / 99 } else { 65535 };
        let smooth = hold("waves", &picture(waves), Profile::Streaming);
        assert!(smooth > 100.0, "{smooth}");
        let sharp = hold("edges", &picture(edges), Profile::Streaming);
        assert!(sharp > 75.0, "{sharp}");
        let all = hold("stripes", &picture(stripes), Profile::Streaming);
        assert!(all > 70.0, "{all}");
        let pure = hold("waves", &picture(waves), Profile::Pure);
        assert!(pure > 30.0, "{pure}");
    }

    #[test]
    fn more_bytes_make_no_flat_picture_worse() {
        for value in [0, 65535, 1000, 32768] {
            let flat = picture(|_, _| value);
            assert!(hold("flat", &flat, Profile::Streaming).is_infinite(), "{value}");
            let encoded = met(&flat, Profile::Streaming, Target::Decibels(45.0));
            assert!(encoded.psnr >= 45.0 && encoded.bytes.len() <= 30, "{value}: {encoded:?}");
        }
        let boxes =
            || picture(|x, y| if (13..40).contains(&x) && (9..50).contains(&y) { 60000 } else { 5000 });
        assert!(hold("box", &boxes(), Profile::Streaming) > 90.0);
        assert!(hold("box of 8 bits", &shallow(boxes()), Profile::Streaming) > 40.0);
        assert!(hold("box of 8 bits in sweeps", &shallow(boxes()), Profile::Iterated) > 40.0);
    }

    #[test]
    fn steps_are_tried_in_pairs_that_close_in_on_the_target() {
        let target = Target::Bytes(1000.0);
        for right in (40..5900_u16).step_by(37) {
            // bytes by the step, with a grain of a per cent
            let grain = |step: u16| f64::from((u32::from(step) * 40_503) >> 4 & 63) / 6400.0 - 0.005;
            let miss = |step: u16| (f64::from(right) - f64::from(step)) * 0.0031 + grain(step);
            let mut tried = vec![(FIRST, miss(FIRST)), (FIRST - OCTAVE, miss(FIRST - OCTAVE))];
            for _ in 0..12 {
                let now = pair(target, 0, &tried, 0.0);
                assert!(now.len() <= 2);
                for step in now {
                    assert!(step <= Step::MAX.to_bits() && tried.iter().all(|(other, _)| *other != step));
                    tried.push((step, miss(step)));
                }
            }
            let above = tried.iter().filter(|(_, miss)| *miss > 0.0).map(|(step, _)| *step).max();
            let below = tried.iter().filter(|(_, miss)| *miss <= 0.0).map(|(step, _)| *step).min();
            // the grain may turn two around
            assert!(below.unwrap() <= above.unwrap() + 1, "{right}: {tried:?}");
            // soon
            assert!(tried.iter().take(10).any(|(_, miss)| miss.abs() < 0.01), "{right}: {tried:?}");
        }
    }
}
