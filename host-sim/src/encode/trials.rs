//! Encodings side by side, and what each round of them leaves for the next.

use attractor::Error;
use attractor::codec::Step;
use rayon::prelude::*;

use super::file::{At, Known, Pool, Thrift};
use super::range_encoder::Counts;
use super::search::{Candidates, Effort};
use super::target::{Encoded, LOSSLESS, Target};

/// An encoding.
pub(super) struct Trial {
    pub(super) encoded: Encoded,
    /// Planes as sweeps find them.
    pub(super) pools: Vec<Pool>,
    /// What it took of each bin.
    pub(super) counts: Counts,
    /// Where its bands begin.
    pub(super) starts: Vec<(u32, usize)>,
}

/// How an encoding was made: its step, what a bit was worth more than it should be, what was known of bins;
/// and what came of it.
#[derive(Clone)]
pub(super) struct Fit {
    pub(super) psnr: f64,
    pub(super) miss: f64,
    pub(super) step: u16,
    pub(super) thrift: Thrift,
    pub(super) starts: Vec<(u32, usize)>,
    counts: Counts,
}

/// What encodes.
pub(super) trait Encode: Fn(At<'_>, Known<'_>) -> Result<Trial, Error> + Sync {}

impl<F: Fn(At<'_>, Known<'_>) -> Result<Trial, Error> + Sync> Encode for F {}

/// All encodings so far.
pub(super) struct Trials<'a, F> {
    encode: F,
    pub(super) target: Target,
    pub(super) effort: Effort,
    /// No step is finer.
    pub(super) finest: u16,
    candidates: &'a [Candidates],
    /// What domains of sweeps lie in; none: the picture itself.
    pools: Option<Vec<Pool>>,
    counts: Counts,
    /// Whether bins cost what they did in the round before.
    pub(super) learns: bool,
    /// In how many rounds more domains of sweeps come to lie in another picture.
    settling: u32,
    pub(super) tried: Vec<Encoded>,
    /// How each of them was made.
    pub(super) fits: Vec<Fit>,
    said: &'a mut dyn FnMut(&Encoded),
}

/// In so many rounds that come so near to the target domains of sweeps come to lie in a picture as it is
/// decoded there: with other ones for ever, no step would meet the target.
const SETTLING: u32 = 2;
const NEAR: f64 = 0.1;
/// Decibels of a logarithm of bytes, by encodings that miss by less; where there are none.
const NEARBY: f64 = 0.12;
const SLOPE: f64 = 4.0;
/// By what part of the bytes less is enough with each encoding, and what part is in the end.
const SOONER: f64 = 0.0007;
const ENOUGH: f64 = 0.992;

impl<'a, F: Encode> Trials<'a, F> {
    /// None yet.
    pub(super) fn new(
        encode: F,
        (target, effort): (Target, Effort),
        finest: u16,
        candidates: &'a [Candidates],
        counts: Counts,
        said: &'a mut dyn FnMut(&Encoded),
    ) -> Self {
        let (pools, learns, settling) = (None, true, SETTLING);
        let (tried, fits) = (Vec::new(), Vec::new());
        Self {
            encode,
            target,
            effort,
            finest,
            candidates,
            pools,
            counts,
            learns,
            settling,
            tried,
            fits,
            said,
        }
    }

    /// Encodes at each of some steps, with what a bit is worth there more than it should be, and tells how
    /// far each is on the wrong side.
    pub(super) fn round(&mut self, ats: &[(u16, Thrift)]) -> Result<Vec<f64>, Error> {
        let (counts, finest) = (self.counts, self.finest);
        let known =
            Known { candidates: self.candidates, pools: self.pools.as_deref(), counts: Some(&counts) };
        let encode = |(step, thrift): &(u16, Thrift)| {
            let step = Step::from_bits((*step).max(finest)).unwrap_or(Step::MAX);
            (self.encode)(At { step, thrift, every: 1 }, known)
        };
        let trials = ats.par_iter().map(encode).collect::<Result<Vec<_>, _>>()?;
        let (mut misses, mut nearest) = (Vec::new(), None::<(f64, Vec<Pool>, Counts)>);
        for (Trial { encoded, pools, counts: now, starts }, (step, thrift)) in trials.into_iter().zip(ats) {
            let (miss, psnr) = (self.target.missed(&encoded), encoded.psnr.min(LOSSLESS));
            self.fits.push(Fit {
                psnr,
                miss,
                step: (*step).max(finest),
                thrift: thrift.clone(),
                starts,
                counts,
            });
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

    /// From now on bins cost what they did when that one was made.
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

    /// What an encoding is worth: decibels, less those that come of the bytes that it misses by.
    pub(super) fn worth(&self) -> impl Fn(&Fit) -> f64 + use<F> {
        // a straight line through those nearby
        let near: Vec<_> = self.fits.iter().filter(|fit| fit.miss.abs() < NEARBY).collect();
        let mean = |of: fn(&Fit) -> f64| near.iter().map(|fit| of(fit)).sum::<f64>() / near.len() as f64;
        let (miss, psnr) = (mean(|fit| fit.miss), mean(|fit| fit.psnr));
        let spread: f64 = near.iter().map(|fit| (fit.miss - miss).powi(2)).sum();
        let both: f64 = near.iter().map(|fit| (fit.miss - miss) * (fit.psnr - psnr)).sum();
        let slope = if spread > 1e-5 { both / spread } else { SLOPE };
        let slope = slope.clamp(0.5, 8.0);
        move |fit| fit.psnr - slope * fit.miss
    }

    /// Of encodings that miss by less, and are such, that of most worth.
    pub(super) fn best(&self, miss: f64, such: &dyn Fn(&Encoded) -> bool) -> Option<Fit> {
        let worth = self.worth();
        let fits = self.fits.iter().zip(&self.tried);
        let near = fits.filter(|(fit, encoded)| fit.miss.abs() < miss && such(encoded)).map(|(fit, _)| fit);
        near.max_by(|a, b| worth(a).total_cmp(&worth(b))).cloned()
    }

    /// The one that misses least.
    pub(super) fn nearest(&self) -> Option<Fit> {
        self.fits.iter().min_by(|a, b| a.miss.abs().total_cmp(&b.miss.abs())).cloned()
    }

    /// Steps, and how far each missed.
    pub(super) fn points(&self) -> Vec<(u16, f64)> {
        self.tried.iter().map(|encoded| (encoded.step, self.target.missed(encoded))).collect()
    }
}
