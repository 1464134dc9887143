//! The step that meets a target: so many bytes at most, or so many decibels at least.
//!
//! Bytes and decibels are nearly straight lines over the logarithm of the step; a few encodings bracket the
//! target and narrow it down. Domains are looked for once, when the step is roughly known.

use attractor::Error;
use attractor::codec::shared::crc32;
use attractor::codec::{Profile, Step, check};

use super::file::{Plan, Pool, Source};
use super::quality::psnr;
use super::range_encoder::Counts;
use super::search::{Candidates, Effort};
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
    pub(crate) picture: Still,
    pub(crate) step: u16,
    pools: Vec<Pool>,
    counts: Counts,
}

/// Where a header says how many sweeps.
const REACH: usize = 12;

/// Steps to begin with, at once.
const FIRST: [u16; 2] = [0x780, 0x900];
/// The most encodings, at different steps.
const PASSES: usize = 12;
/// Then how much finer the step, and how often what a bit is worth is changed there at most.
const FINER: [u16; 4] = [0, 2, 7, 19];
const BETWEEN: usize = 10;
/// What part of the bytes is filled at least, and what is enough where that is not met soon.
const NEAR: f64 = 0.998;
const ENOUGH: f64 = 0.993;
/// What is aimed at: a shade below the target, so that the next one is allowed.
const AIM: f64 = -0.001;

impl Target {
    /// How far an encoding is on the wrong side: above 0 if the step is too fine.
    fn miss(self, encoded: &Encoded) -> f64 {
        match self {
            Self::Bytes(bytes) => (encoded.bytes.len() as f64 / bytes).ln(),
            Self::Decibels(decibels) => (encoded.psnr - decibels) * 0.12,
        }
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
        let off = |e: &Encoded| self.miss(e).abs();
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
    let source = Source::new(still.size, kind, still.peak() > 255, &values, plan);
    let truth = still.samples();
    let one = |(step, thrift): (u16, f32),
               candidates: &[Candidates],
               pools: Option<&[Pool]>,
               counts: Option<&Counts>| {
        let step = Step::from_bits(step).unwrap_or(Step::MAX);
        let (bytes, settled, counts) = source.encode((step, thrift), candidates, pools, counts)?;
        let (picture, planes) = decoded_with_planes(&bytes)?;
        let planes = planes.into_iter().zip(settled);
        let pools = planes.map(|(samples, settled)| Pool { samples, settled }).collect();
        let psnr = psnr(&truth, &picture.samples(), still.peak());
        Ok(Encoded { bytes, psnr, picture, step: step.to_bits(), pools, counts })
    };
    // first without domains: fast, and not far from what is wanted
    let none = source.candidates(None, Step::MAX);
    let rough = |step| one((step, 1.0), &none, None, None);
    let (fine, coarse) = rayon::join(|| rough(FIRST[0]), || rough(FIRST[1]));
    let mut rough_ones = vec![fine?, coarse?];
    rough_ones.iter().for_each(&mut *said);
    narrow(target, &mut rough_ones, FIRST[0], 4, 0.03, |step| {
        let encoded = rough(step)?;
        said(&encoded);
        Ok(encoded)
    })?;
    let nearest = |a: &Encoded, b: &Encoded| target.miss(a).abs().total_cmp(&target.miss(b).abs());
    let Some(rough) = rough_ones.into_iter().min_by(nearest) else {
        return Err(Error::Degenerate { what: "number of encodings" });
    };
    let candidates = source.candidates(Some(effort), Step::from_bits(rough.step).unwrap_or(Step::MAX));
    let mut one = |at, pools: Option<&[Pool]>, counts: &Counts| {
        let encoded = one(at, &candidates, pools, Some(counts))?;
        said(&encoded);
        Ok::<_, Error>(encoded)
    };
    let sweeps = plan.profile != Profile::Streaming;
    let (mut pool, mut passes): (Option<Vec<Pool>>, u32) = (None, 0);
    let mut counts = rough.counts;
    let mut tried = Vec::new();
    narrow(target, &mut tried, rough.step, PASSES, 0.0, |step| {
        let encoded = one((step, 1.0), pool.as_deref().filter(|_| sweeps), &counts)?;
        // the next ones take their domains from what this one looks like; then the pool stays, or no step
        // would meet the target
        if passes < 2 {
            pool = Some(encoded.pools.clone());
            passes += 1;
        }
        counts = encoded.counts;
        Ok(encoded)
    })?;
    // where bytes are no straight line at all: ever further off, until a step is allowed
    let mut stride = 4;
    while !tried.iter().any(|e| target.allows(e)) {
        stride *= 2;
        let coarsest = tried.iter().map(|e| e.step).max().unwrap_or(rough.step);
        let finest = tried.iter().map(|e| e.step).min().unwrap_or(rough.step);
        let step = match target {
            Target::Bytes(_) => (coarsest + stride).min(Step::MAX.to_bits()),
            Target::Decibels(_) => finest.saturating_sub(stride),
        };
        if step == coarsest || step == finest {
            break;
        }
        tried.push(one((step, 1.0), pool.as_deref().filter(|_| sweeps), &counts)?);
    }
    // between two steps: bits a little dearer at the coarsest step that is too fine
    let finest = tried.iter().filter(|e| !target.allows(e)).map(|e| e.step).max();
    let finest = finest.filter(|_| tried.iter().any(|e| target.allows(e)));
    if let (Target::Bytes(_), Some(step)) = (target, finest) {
        for finer in FINER {
            let part = if finer == 0 { NEAR } else { ENOUGH };
            // logarithms of what a bit is worth, and what is missed
            let (mut over, mut under) = ((0.0, f64::from(finer) * 0.0035), None::<(f64, f64)>);
            if finer == 0 {
                let there = tried.iter().find(|e| e.step == step);
                over.1 = there.map_or(0.0, |e| target.miss(e));
            }
            for turn in 0..BETWEEN {
                if tried.iter().any(|e| target.is_met(e, part)) {
                    break;
                }
                let thrift = match under {
                    Some((dear, below)) => {
                        // a straight line, and in turn the middle: there are pictures whose bytes jump
                        let straight = (over.1 - AIM) / (over.1 - below).max(1e-9);
                        let share = if turn % 2 == 0 { straight } else { 0.5 };
                        over.0 + (dear - over.0) * share.clamp(0.05, 0.95)
                    }
                    None => over.0 + 2.0 * (over.1 - AIM),
                };
                let at = (step.saturating_sub(finer), thrift.exp() as f32);
                let encoded = one(at, pool.as_deref().filter(|_| sweeps), &counts)?;
                let miss = target.miss(&encoded);
                if miss > 0.0 {
                    over = (thrift, miss);
                } else {
                    under = Some((thrift, miss));
                }
                tried.push(encoded);
            }
        }
    }
    let best = target.best(&tried).cloned().unwrap_or(rough);
    if sweeps { settled(best, &truth, still.peak(), target) } else { Ok(best) }
}

/// The same stream with no more sweeps than it needs: so many that more of them gain less than 0.02 dB.
fn settled(best: Encoded, truth: &[f64], peak: u32, target: Target) -> Result<Encoded, Error> {
    let most = check(&best.bytes)?.reach;
    for reach in 1..most {
        let picture = decoded(&best.bytes, 0, Some(u32::from(reach)))?;
        let psnr = psnr(truth, &picture.samples(), peak);
        if psnr < best.psnr - 0.02 || matches!(target, Target::Decibels(least) if psnr < least) {
            continue;
        }
        let mut bytes = best.bytes[..best.bytes.len() - 4].to_vec();
        bytes[REACH] = reach;
        bytes.extend(crc32(&bytes).to_le_bytes());
        return Ok(Encoded { bytes, psnr, picture, ..best });
    }
    Ok(best)
}

/// Encodes with steps ever nearer to the target: a first one, or what the ones before let expect.
fn narrow(
    target: Target,
    tried: &mut Vec<Encoded>,
    first: u16,
    passes: usize,
    enough: f64,
    mut encode: impl FnMut(u16) -> Result<Encoded, Error>,
) -> Result<(), Error> {
    let aim = if enough > 0.0 { 0.0 } else { AIM };
    while tried.len() < passes {
        if tried.iter().any(|e| target.is_met(e, NEAR) || target.miss(e).abs() < enough) {
            break;
        }
        // 256 an octave: nearly a logarithm
        let here = |e: &Encoded| (f64::from(e.step), target.miss(e));
        let fine = tried.iter().map(here).filter(|e| e.1 > 0.0).max_by(|a, b| a.0.total_cmp(&b.0));
        let coarse = tried.iter().map(here).filter(|e| e.1 <= 0.0).min_by(|a, b| a.0.total_cmp(&b.0));
        // bytes grow about as fast as the step shrinks
        let far = |(step, miss): (f64, f64)| step + ((miss - aim) * 300.0).clamp(-1500.0, 1500.0);
        let step = match (fine, coarse) {
            (Some((a, above)), Some((b, below))) if b - a > 1.0 => {
                let share = ((above - aim) / (above - below)).clamp(0.05, 0.95);
                (a + share * (b - a)).clamp(a + 1.0, b - 1.0)
            }
            // no straight line so close: decibels are tried for at finer steps, one by one
            (Some(_), Some((b, _))) => match target {
                Target::Bytes(_) => break,
                Target::Decibels(_) => tried.iter().map(|e| f64::from(e.step)).fold(b, f64::min) - 1.0,
            },
            (Some(fine), None) => far(fine) + 1.0,
            (None, Some(coarse)) => far(coarse) - 1.0,
            (None, None) => f64::from(first),
        };
        let step = step.round().clamp(0.0, f64::from(Step::MAX.to_bits())) as u16;
        if tried.iter().any(|e| e.step == step) {
            break;
        }
        tried.push(encode(step)?);
    }
    Ok(())
}
