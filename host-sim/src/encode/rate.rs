//! The step that meets a target: so many bytes at most, or so many decibels at least.
//!
//! Bytes and decibels are nearly straight lines over the logarithm of the step; a few encodings bracket the
//! target and narrow it down. Domains are looked for once, when the step is roughly known: of large pictures
//! from some bands alone.

use std::cell::Cell;

use attractor::Error;
use attractor::codec::shared::crc32;
use attractor::codec::{Planes, Profile, Step, check};
use rayon::prelude::*;

use super::file::{At, Known, Plan, Pool, Source};
use super::quality::decibels;
use super::range_encoder::Counts;
use super::search::Effort;
use crate::decode::{decoded, decoded_with_planes};
use crate::still::Still;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Target {
    Bytes(f64),
    Decibels(f64),
}

/// A stream and what it is worth.
#[derive(Clone, Debug)]
pub(crate) struct Encoded {
    pub(crate) bytes: Vec<u8>,
    pub(crate) psnr: f64,
    pub(crate) step: u16,
}

/// How an encoding was made: its step, what a bit was worth more than it should be, what was known of bins;
/// and what came of it.
struct Fit {
    psnr: f64,
    miss: f64,
    step: u16,
    thrift: f32,
    counts: Counts,
}

/// Where a header says how many sweeps.
const REACH: usize = 12;

/// A step to begin with.
const FIRST: u16 = 0x900;
/// Bytes grow about as fast as the step shrinks, of which 256 are an octave.
const STEPS: f64 = 300.0;
/// The most encodings, at different steps: rough ones, and all.
const ROUGH: usize = 5;
const PASSES: usize = 12;
/// Then how much finer the step, and how often what a bit is worth is changed there at most.
const FINER: [u16; 8] = [0, 2, 7, 19, 4, 11, 14, 29];
const BETWEEN: usize = 6;
/// Logarithm of the bytes that a step takes.
const PER_STEP: f64 = 0.0035;
/// How many encodings there are side by side that differ by little, until one fills this part of the bytes.
const ASIDE: u16 = 4;
const FULL: f64 = 0.9992;
/// What part of the bytes is enough where what is wanted is not met soon.
const ENOUGH: f64 = 0.992;

impl Target {
    /// How far an encoding of so many bytes and decibels is on the wrong side: above 0 if the step is too
    /// fine.
    fn miss(self, bytes: f64, psnr: f64) -> f64 {
        match self {
            Self::Bytes(target) => (bytes / target).ln(),
            Self::Decibels(decibels) => (psnr - decibels) * 0.12,
        }
    }

    /// The same of a whole one.
    fn missed(self, encoded: &Encoded) -> f64 {
        self.miss(encoded.bytes.len() as f64, encoded.psnr)
    }

    /// Whether it is met: a part of the bytes or more, and not above them; within 0.05 dB and not below.
    fn is_met(self, encoded: &Encoded, part: f64) -> bool {
        match self {
            Self::Bytes(bytes) => {
                let length = encoded.bytes.len() as f64;
                length <= bytes && (length >= bytes * part || length + 1.0 > bytes)
            }
            Self::Decibels(decibels) => (0.0..0.05).contains(&(encoded.psnr - decibels)),
        }
    }

    /// Whether decibels are so near that nothing is tried between two steps: of bytes each counts.
    fn is_near(self, encoded: &Encoded) -> bool {
        matches!(self, Self::Decibels(decibels) if (0.0..0.2).contains(&(encoded.psnr - decibels)))
    }

    /// Whether an encoding is allowed at all.
    fn allows(self, encoded: &Encoded) -> bool {
        match self {
            Self::Bytes(bytes) => encoded.bytes.len() as f64 <= bytes,
            Self::Decibels(decibels) => encoded.psnr >= decibels,
        }
    }

    /// Of those that are allowed and within 1 per cent the one of most decibels, or of least bytes; else the
    /// nearest that is allowed, or the nearest of all.
    fn best(self, tried: &[Encoded]) -> Option<&Encoded> {
        let off = |e: &Encoded| self.missed(e).abs();
        let worth = |e: &Encoded| match self {
            Self::Bytes(_) => e.psnr,
            Self::Decibels(_) => -(e.bytes.len() as f64),
        };
        let allowed = || tried.iter().filter(|e| self.allows(e));
        let closest = |a: &&Encoded, b: &&Encoded| off(a).total_cmp(&off(b));
        let best = allowed().filter(|e| off(e) < 0.01).max_by(|a, b| worth(a).total_cmp(&worth(b)));
        best.or_else(|| allowed().min_by(closest)).or_else(|| tried.iter().min_by(closest))
    }
}

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
    let encode = |at: At, known: Known<'_>| {
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
        let encoded = Encoded { bytes: pass.bytes, psnr, step: at.step.to_bits() };
        Ok::<_, Error>((encoded, pools, pass.counts))
    };
    // first without domains: fast, and not far from what is wanted. Decibels of colour are those of a picture
    let none = source.candidates(None, Step::MAX);
    let every = match target {
        Target::Decibels(_) if sweeps || kind != Planes::Grey => 1,
        _ => source.sparse(),
    };
    let rough = |step: u16| {
        let step = Step::from_bits(step).unwrap_or(Step::MAX);
        let at = At { step, thrift: 1.0, every };
        let (encoded, _, counts) = encode(at, Known { candidates: &none, pools: None, counts: None })?;
        let miss = target.miss((encoded.bytes.len() * every as usize) as f64, encoded.psnr);
        Ok::<_, Error>((encoded.step, miss, counts))
    };
    let mut roughly = vec![rough(FIRST)?];
    while roughly.len() < ROUGH && !roughly.iter().any(|(_, miss, _)| miss.abs() < 0.03) {
        let tried: Vec<_> = roughly.iter().map(|(step, miss, _)| (*step, *miss)).collect();
        let Some(step) = next(target, &tried, 0.0, STEPS) else { break };
        roughly.push(rough(step)?);
    }
    let steps = slope(&roughly.iter().map(|(step, miss, _)| (*step, *miss)).collect::<Vec<_>>());
    let nearest = roughly.into_iter().min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let Some((near, _, mut counts)) = nearest else {
        return Err(Error::Degenerate { what: "number of encodings" });
    };
    let candidates = source.candidates(Some(effort), Step::from_bits(near).unwrap_or(Step::MAX));
    let (mut pool, mut passes): (Option<Vec<Pool>>, u32) = (None, 0);
    let learns = Cell::new(true);
    // how the best so far was made
    let mut fit = None::<Fit>;
    let mut one = |(step, thrift): (u16, f32)| {
        let at = At { step: Step::from_bits(step).unwrap_or(Step::MAX), thrift, every: 1 };
        let known = Known { candidates: &candidates, pools: pool.as_deref(), counts: Some(&counts) };
        let (encoded, pools, now) = encode(at, known)?;
        // the next ones take their domains from what this one looks like; then the pool stays, or no step
        // would meet the target
        if passes < 2 && sweeps {
            pool = Some(pools);
        }
        let miss = target.missed(&encoded);
        let better = fit.as_ref().is_none_or(|fit| encoded.psnr > fit.psnr);
        if target.allows(&encoded) && miss > -0.01 && better {
            fit = Some(Fit { psnr: encoded.psnr, step, thrift, miss, counts });
        }
        // prices of bins are those of the one before, but while bits are weighed at the nearest step
        if learns.get() {
            counts = now;
        }
        passes += 1;
        said(&encoded);
        Ok::<_, Error>(encoded)
    };
    // in the middle of what is enough
    let aim = match target {
        Target::Bytes(_) => -0.5 * (1.0 - effort.filled),
        Target::Decibels(_) => 0.003,
    };
    let mut tried: Vec<Encoded> = vec![one((near, 1.0))?];
    // the more of them there are, the sooner it is enough
    let filled = |tries: usize| (effort.filled - 0.0007 * tries as f64).max(ENOUGH);
    while tried.len() < PASSES && !tried.iter().any(|e| target.is_met(e, filled(tried.len() - 1))) {
        let points: Vec<_> = tried.iter().map(|e| (e.step, target.missed(e))).collect();
        let Some(step) = next(target, &points, aim, steps) else { break };
        tried.push(one((step, 1.0))?);
    }
    // where bytes are no straight line at all: ever further off, until a step is allowed
    let mut stride = 4;
    while !tried.iter().any(|e| target.allows(e)) {
        stride *= 2;
        let coarsest = tried.iter().map(|e| e.step).max().unwrap_or(near);
        let finest = tried.iter().map(|e| e.step).min().unwrap_or(near);
        let step = match target {
            Target::Bytes(_) => (coarsest + stride).min(Step::MAX.to_bits()),
            Target::Decibels(_) => finest.saturating_sub(stride),
        };
        if step == coarsest || step == finest {
            break;
        }
        tried.push(one((step, 1.0))?);
    }
    // between two steps: bits a little dearer at the coarsest step that is too fine
    let finest = tried.iter().filter(|e| target.missed(e) > 0.0).map(|e| e.step).max();
    let finest = finest.filter(|_| tried.iter().any(|e| target.missed(e) <= 0.0));
    if let Some(step) = finest.filter(|_| !tried.iter().any(|e| target.is_near(e))) {
        for finer in FINER {
            // of small pictures bytes may jump past what is enough while the prices stay
            learns.set(finer > 0);
            // logarithms of what a bit is worth, and what is missed
            let (mut over, mut under) = ((0.0, f64::from(finer) * PER_STEP), None::<(f64, f64)>);
            if finer == 0 {
                let there = tried.iter().find(|e| e.step == step);
                over.1 = there.map_or(0.0, |e| target.missed(e));
            }
            for turn in 0..BETWEEN {
                let enough = |e: &Encoded| target.is_near(e) || target.is_met(e, filled(tried.len() - 1));
                if tried.iter().any(enough) {
                    break;
                }
                let thrift = match under {
                    Some((dear, below)) => {
                        // a straight line, and in turn the middle: there are pictures whose bytes jump
                        let straight = (over.1 - aim) / (over.1 - below).max(1e-9);
                        let share = if turn % 2 == 0 { straight } else { 0.5 };
                        over.0 + (dear - over.0) * share.clamp(0.05, 0.95)
                    }
                    None => over.0 + 2.0 * (over.1 - aim),
                };
                let at = (step.saturating_sub(finer), thrift.exp() as f32);
                let encoded = one(at)?;
                let miss = target.missed(&encoded);
                if miss > 0.0 {
                    over = (thrift, miss);
                } else {
                    under = Some((thrift, miss));
                }
                tried.push(encoded);
            }
        }
    }
    // what is decided early in a picture changes what all else costs, so that bytes are no smooth function
    // of anything: a few more encodings that differ by little, side by side, until one fills what is asked
    // for
    if let (Target::Bytes(_), Some(fit)) = (target, &fit) {
        // how much less it is to take, and how that changes what it takes, as far as is known
        let (mut lean, mut slope, mut seen) = (fit.miss - aim, 1.0, None::<(f64, f64)>);
        for turn in 0..effort.again {
            if tried.iter().any(|e| target.is_met(e, FULL)) {
                break;
            }
            let others = (0..ASIDE).into_par_iter().map(|i| {
                let step = (fit.step + ASIDE / 2).saturating_sub(turn * ASIDE + i);
                let step = step.min(Step::MAX.to_bits());
                let finer = f64::from(fit.step) - f64::from(step);
                let thrift = fit.thrift * (2.0 * (lean + PER_STEP * finer)).exp() as f32;
                let at = At { step: Step::from_bits(step).unwrap_or(Step::MAX), thrift, every: 1 };
                let counts = Some(&fit.counts);
                let known = Known { candidates: &candidates, pools: pool.as_deref(), counts };
                encode(at, known).map(|(encoded, ..)| encoded)
            });
            let others = others.collect::<Result<Vec<_>, _>>()?;
            let over = others.iter().map(|e| target.missed(e) - aim).sum::<f64>() / f64::from(ASIDE);
            if let Some((less, before)) = seen.filter(|(less, _)| *less != lean) {
                slope = ((before - over) / (lean - less)).clamp(1.0, 8.0);
            }
            seen = Some((lean, over));
            lean += over / slope;
            others.iter().for_each(&mut *said);
            tried.extend(others);
        }
    }
    let best = target.best(&tried).cloned();
    let best = best.ok_or(Error::Degenerate { what: "number of encodings" })?;
    if sweeps { settled(best, still, target) } else { Ok(best) }
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

/// How many steps it takes to have as much again, from the two last ones tried.
fn slope(tried: &[(u16, f64)]) -> f64 {
    match tried {
        [.., (a, above), (b, below)] if (above - below).abs() < 100.0 => {
            ((f64::from(*b) - f64::from(*a)) / (above - below)).clamp(0.5 * STEPS, STEPS)
        }
        // a flat picture has infinite decibels
        _ => STEPS,
    }
}

/// The step to try next, from those tried and how far they missed; none where there is none between. On one
/// side of the target it takes so many `steps` to have as much again.
fn next(target: Target, tried: &[(u16, f64)], aim: f64, steps: f64) -> Option<u16> {
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
    let step = step.round().clamp(0.0, f64::from(Step::MAX.to_bits())) as u16;
    (!tried.iter().any(|(other, _)| *other == step)).then_some(step)
}
