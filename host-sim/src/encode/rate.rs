//! The step that meets a target: so many bytes at most, or so many decibels at least.
//!
//! Bytes and decibels are nearly straight lines over the logarithm of the step; a few encodings bracket the
//! target and narrow it down. Domains are looked for once, when the step is roughly known.

use attractor::Error;
use attractor::codec::shared::crc32;
use attractor::codec::{Profile, Step, check};

use super::file::{Plan, Pool, Source};
use super::quality::psnr;
use super::search::{Candidates, Effort};
use crate::decode::{decoded, planes_of};
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
}

/// Where a header says how many sweeps.
const REACH: usize = 12;

/// The most encodings, at different steps.
const PASSES: usize = 12;
/// Then how much finer a step, and what a bit is worth at least and at most.
const BETWEEN: [(u16, f32, f32); 5] =
    [(1, 1.0, 1.3), (0, 0.5, 1.0), (3, 1.0, 1.3), (8, 1.0, 1.4), (20, 1.0, 1.8)];
const HALVINGS: usize = 6;

impl Target {
    /// How far an encoding is on the wrong side: above 0 if the step is too fine.
    fn miss(self, encoded: &Encoded) -> f64 {
        match self {
            Self::Bytes(bytes) => (encoded.bytes.len() as f64 / bytes).ln(),
            Self::Decibels(decibels) => (encoded.psnr - decibels) * 0.12,
        }
    }

    /// Whether it is met: within 1 per cent of the bytes and not above, within 0.05 dB and not below.
    fn is_met(self, encoded: &Encoded) -> bool {
        match self {
            Self::Bytes(bytes) => {
                let length = encoded.bytes.len() as f64;
                length <= bytes && (length >= bytes * 0.995 || length + 1.0 > bytes)
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
    let mut one = |(step, thrift): (u16, f32), candidates: &[Candidates], pools: Option<&[Pool]>| {
        let step = Step::from_bits(step).unwrap_or(Step::MAX);
        let (bytes, settled) = source.encode((step, thrift), candidates, pools)?;
        let picture = decoded(&bytes, 0, None)?;
        let planes = planes_of(&bytes)?.into_iter().zip(settled);
        let pools = planes.map(|(samples, settled)| Pool { samples, settled }).collect();
        let psnr = psnr(&truth, &picture.samples(), still.peak());
        let encoded = Encoded { bytes, psnr, picture, step: step.to_bits(), pools };
        said(&encoded);
        Ok::<_, Error>(encoded)
    };
    // first without domains: fast, and not far from what is wanted
    let none = source.candidates(None, Step::MAX);
    let rough = narrow(target, 0x780, 4, 0.03, |step| one((step, 1.0), &none, None))?;
    let Some(rough) = rough.into_iter().min_by(|a, b| target.miss(a).abs().total_cmp(&target.miss(b).abs()))
    else {
        return Err(Error::Degenerate { what: "number of encodings" });
    };
    let candidates = source.candidates(Some(effort), Step::from_bits(rough.step).unwrap_or(Step::MAX));
    let sweeps = plan.profile != Profile::Streaming;
    let (mut pool, mut passes): (Option<Vec<Pool>>, u32) = (None, 0);
    let tried = narrow(target, rough.step, PASSES, 0.0, |step| {
        let encoded = one((step, 1.0), &candidates, pool.as_deref().filter(|_| sweeps))?;
        // the next ones take their domains from what this one looks like; then the pool stays, or no step
        // would
        // meet the target
        if passes < 2 {
            pool = Some(encoded.pools.clone());
            passes += 1;
        }
        Ok(encoded)
    })?;
    let mut tried = tried;
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
        tried.push(one((step, 1.0), &candidates, pool.as_deref().filter(|_| sweeps))?);
    }
    // between two steps: bits a little cheaper at the finest step that is allowed, or dearer at finer ones
    let finest = tried.iter().filter(|e| target.allows(e)).map(|e| e.step).min();
    let met = |tried: &[Encoded]| tried.iter().any(|e| target.is_met(e));
    if let (Target::Bytes(_), Some(step)) = (target, finest) {
        for (finer, mut least, mut most) in BETWEEN {
            for _ in 0..HALVINGS {
                if met(&tried) {
                    break;
                }
                let thrift = 0.5 * (least + most);
                let step = step.saturating_sub(finer);
                let encoded = one((step, thrift), &candidates, pool.as_deref().filter(|_| sweeps))?;
                *(if target.miss(&encoded) > 0.0 { &mut least } else { &mut most }) = thrift;
                tried.push(encoded);
            }
        }
    }
    let closest = |a: &&Encoded, b: &&Encoded| target.miss(a).abs().total_cmp(&target.miss(b).abs());
    let best = tried.iter().filter(|e| target.allows(e)).min_by(closest);
    // a target out of reach: the nearest there is
    let best = best.or_else(|| tried.iter().min_by(closest)).cloned();
    let best = best.unwrap_or(rough);
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

/// Encodes with steps ever nearer to the target, from a first one on.
fn narrow(
    target: Target,
    first: u16,
    passes: usize,
    enough: f64,
    mut encode: impl FnMut(u16) -> Result<Encoded, Error>,
) -> Result<Vec<Encoded>, Error> {
    // 256 an octave: nearly a logarithm
    let mut step = f64::from(first);
    let mut tried = Vec::<Encoded>::new();
    let (mut fine, mut coarse) = (None::<(f64, f64)>, None::<(f64, f64)>);
    let mut near = 0.0;
    let mut used = std::collections::BTreeSet::new();
    for _ in 0..passes {
        let bits = step.round().clamp(0.0, f64::from(Step::MAX.to_bits())) as u16;
        if !used.insert(bits) {
            break;
        }
        let encoded = encode(bits)?;
        let miss = target.miss(&encoded);
        let done = target.is_met(&encoded) || miss.abs() < enough;
        tried.push(encoded);
        if done {
            break;
        }
        let here = (f64::from(bits), miss);
        *(if miss > 0.0 { &mut fine } else { &mut coarse }) = Some(here);
        // aim at a shade below the target, so that the next one is allowed
        let aim = if enough > 0.0 { 0.0 } else { -0.003 };
        step = match (fine, coarse) {
            (Some((a, above)), Some((b, below))) => {
                let share = ((above - aim) / (above - below)).clamp(0.05, 0.95);
                let next = a + share * (b - a);
                if (b - a).abs() <= 1.0 {
                    // no straight line so close: finer ones, one by one
                    near += 1.0;
                    step = a - near;
                    continue;
                }
                next.clamp(a.min(b) + 1.0, (a.max(b) - 1.0).max(a.min(b) + 1.0))
            }
            // bytes grow about as fast as the step shrinks
            _ => here.0 + ((miss - aim) * 300.0).clamp(-1500.0, 1500.0) + if miss > 0.0 { 1.0 } else { -1.0 },
        };
    }
    Ok(tried)
}
