//! Encodings side by side, and what each round of them leaves for the next.

use attractor::Error;
use attractor::codec::Step;
use rayon::prelude::*;

use super::file::{At, Known, Pool};
use super::range_encoder::Counts;
use super::search::{Candidates, Effort};
use super::target::{Encoded, Target};

/// An encoding, its planes as sweeps find them, and what it took of each bin.
pub(super) type Trial = (Encoded, Vec<Pool>, Counts);

/// How an encoding was made: its step, what a bit was worth more than it should be, what was known of bins;
/// and what came of it.
#[derive(Clone, Copy)]
pub(super) struct Fit {
    psnr: f64,
    pub(super) miss: f64,
    pub(super) step: u16,
    pub(super) thrift: f32,
    counts: Counts,
}

/// What encodes.
pub(super) trait Encode: Fn(At, Known<'_>) -> Result<Trial, Error> + Sync {}

impl<F: Fn(At, Known<'_>) -> Result<Trial, Error> + Sync> Encode for F {}

/// All encodings so far.
pub(super) struct Trials<'a, F> {
    encode: F,
    pub(super) target: Target,
    effort: Effort,
    candidates: &'a [Candidates],
    /// What domains of sweeps lie in; none: the picture itself.
    pools: Option<Vec<Pool>>,
    counts: Counts,
    /// Whether bins cost what they did in the round before.
    pub(super) learns: bool,
    /// In how many rounds more domains of sweeps come to lie in another picture.
    settling: u32,
    pub(super) tried: Vec<Encoded>,
    /// How the best of those that are allowed was made.
    pub(super) fit: Option<Fit>,
    said: &'a mut dyn FnMut(&Encoded),
}

/// In so many rounds that come so near to the target domains of sweeps come to lie in a picture as it is
/// decoded there: with other ones for ever, no step would meet the target.
const SETTLING: u32 = 2;
const NEAR: f64 = 0.1;
/// By what part of the bytes less is enough with each encoding, and what part is in the end.
const SOONER: f64 = 0.0007;
const ENOUGH: f64 = 0.992;

impl<'a, F: Encode> Trials<'a, F> {
    /// None yet.
    pub(super) fn new(
        encode: F,
        (target, effort): (Target, Effort),
        candidates: &'a [Candidates],
        counts: Counts,
        said: &'a mut dyn FnMut(&Encoded),
    ) -> Self {
        let (pools, learns, settling) = (None, true, SETTLING);
        let (tried, fit) = (Vec::new(), None);
        Self { encode, target, effort, candidates, pools, counts, learns, settling, tried, fit, said }
    }

    /// Encodes at each of some steps, with what a bit is worth there more than it should be, and tells how
    /// far each is on the wrong side.
    pub(super) fn round(&mut self, ats: &[(u16, f32)]) -> Result<Vec<f64>, Error> {
        let counts = self.counts;
        let known =
            Known { candidates: self.candidates, pools: self.pools.as_deref(), counts: Some(&counts) };
        let encode = |(step, thrift): &(u16, f32)| {
            let step = Step::from_bits(*step).unwrap_or(Step::MAX);
            (self.encode)(At { step, thrift: *thrift, every: 1 }, known)
        };
        let trials = ats.par_iter().map(encode).collect::<Result<Vec<_>, _>>()?;
        let (mut misses, mut nearest) = (Vec::new(), None::<(f64, Vec<Pool>, Counts)>);
        for ((encoded, pools, now), (step, thrift)) in trials.into_iter().zip(ats) {
            let (miss, psnr) = (self.target.missed(&encoded), encoded.psnr);
            let better = self.fit.is_none_or(|fit| psnr > fit.psnr);
            if self.target.allows(&encoded) && miss > -0.01 && better {
                self.fit = Some(Fit { psnr, miss, step: *step, thrift: *thrift, counts });
            }
            if nearest.as_ref().is_none_or(|(other, ..)| miss.abs() < other.abs()) {
                nearest = Some((miss, pools, now));
            }
            (self.said)(&encoded);
            misses.push(miss);
            self.tried.push(encoded);
        }
        if let Some((miss, pools, now)) = nearest {
            if self.settling > 0 && !pools.is_empty() {
                self.pools = Some(pools);
                self.settling -= u32::from(miss.abs() < NEAR);
            }
            if self.learns {
                self.counts = now;
            }
        }
        Ok(misses)
    }

    /// From now on bins cost what they did when the best so far was made.
    pub(super) fn stay(&mut self, fit: &Fit) {
        (self.counts, self.learns) = (fit.counts, false);
    }

    /// What to miss the target by: the middle of what is enough.
    pub(super) fn aim(&self) -> f64 {
        match self.target {
            Target::Bytes(_) => -0.5 * (1.0 - self.effort.filled),
            Target::Decibels(_) => 0.003,
        }
    }

    /// Whether one meets the target: the more of them there are, the sooner.
    pub(super) fn are_enough(&self) -> bool {
        let tries = self.tried.len().saturating_sub(1) as f64;
        let part = (self.effort.filled - SOONER * tries).max(ENOUGH);
        self.any(|encoded| self.target.is_met(encoded, part))
    }

    pub(super) fn any(&self, is: impl Fn(&Encoded) -> bool) -> bool {
        self.tried.iter().any(is)
    }

    /// Steps, and how far each missed.
    pub(super) fn points(&self) -> Vec<(u16, f64)> {
        self.tried.iter().map(|encoded| (encoded.step, self.target.missed(encoded))).collect()
    }
}
