//! A picture as the bytes of a stream, at one step of quantisation.

use std::cell::Cell;

use attractor::Error;
use attractor::codec::shared::{Plane, Shape, crc32};
use attractor::codec::{Header, Planes, Profile, Sample, Step};
use embedded_graphics::geometry::Size;

use super::cosine::Cosine;
use super::finest::{finest, without_levels};
use super::partition::{Partition, Target, Without};
use super::quality::decibels;
use super::range_encoder::{Counts, Prices, RangeEncoder};
use super::samples::Samples;
use super::search::{Candidates, Effort};
use super::settled::Settled;

/// The exchange rate of squared error and bits, in squares of the step and of one grey level.
const LAMBDA: f32 = 0.12;
const LAMBDA_PURE: f32 = 0.14;

/// How a picture is encoded, but for the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub(crate) profile: Profile,
    /// Rows of the window in 8, or sweeps.
    pub(crate) reach: u8,
    /// Chroma's step in sixteenths.
    pub(crate) chroma: u8,
    pub(crate) without: Without,
}

/// A plane as an encoding before left it: what domains of sweeps lie in.
#[derive(Clone, Debug)]
pub(super) struct Pool {
    pub(super) samples: Vec<u16>,
    /// By the first sweep.
    pub(super) settled: Settled,
}

/// Rows of luma in a band.
const BAND: u32 = 32;
/// Of how many bands a rough encoding sees at least.
const FEW: u32 = 6;

/// How much more a bit is worth than it should be: from some rows on, the first of them 0.
pub(super) type Thrift = Vec<(u32, f32)>;

/// At what step, with what thrift, and how many bands there are for each one that is encoded: where that is
/// not each, the bytes are no stream, but let expect what it takes.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    pub(super) step: Step,
    pub(super) thrift: &'a [(u32, f32)],
    pub(super) every: u32,
}

/// What is known of the picture before an encoding: domains, what later sweeps will find in place of the
/// picture, and what the encoding before took of each bin.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    pub(super) candidates: &'a [Candidates],
    pub(super) pools: Option<&'a [Pool]>,
    pub(super) counts: Option<&'a Counts>,
}

/// An encoding.
pub(super) struct Pass {
    pub(super) bytes: Vec<u8>,
    /// Of what was encoded, where the encoder has drawn all as it will be decoded: grey, in one pass.
    pub(super) decibels: Option<f64>,
    /// By the first sweep.
    pub(super) settled: Vec<Settled>,
    pub(super) counts: Counts,
    /// Rows at which bands begin, and the bytes before them.
    pub(super) starts: Vec<(u32, usize)>,
}

/// A picture ready to be encoded.
pub(super) struct Source<'a> {
    size: Size,
    planes: Planes,
    deep: bool,
    plan: Plan,
    values: &'a [Vec<u16>],
    originals: Vec<Samples>,
    cosine: Cosine,
    prices: Prices,
    effort: Effort,
}

impl<'a> Source<'a> {
    pub(super) fn new(
        size: Size,
        planes: Planes,
        deep: bool,
        values: &'a [Vec<u16>],
        plan: Plan,
        effort: Effort,
    ) -> Self {
        let mut this = Self {
            size,
            planes,
            deep,
            plan,
            values,
            originals: Vec::new(),
            cosine: Cosine::new(),
            prices: Prices::new(),
            effort,
        };
        this.originals =
            this.shapes(Step::MAX).iter().zip(values).map(|(shape, plane)| samples(shape, plane)).collect();
        this
    }

    /// The finest step at which finer ones are still better.
    pub(super) fn finest(&self) -> u16 {
        let Without { transform, split, .. } = self.plan.without;
        match &self.originals[..] {
            _ if !self.deep => 0,
            [original, ..] if !transform && self.plan.profile != Profile::Pure => {
                finest(original, if split { 3 } else { 2 }, &self.cosine)
            }
            _ => without_levels(),
        }
    }

    fn header(&self, step: Step, payload: u32) -> Header {
        let chroma = if self.planes == Planes::Grey { 0 } else { self.plan.chroma };
        let Plan { profile, reach, .. } = self.plan;
        Header {
            version: Header::VERSION,
            size: self.size,
            profile,
            planes: self.planes,
            deep: self.deep,
            step,
            reach,
            chroma,
            payload,
        }
    }

    fn shapes(&self, step: Step) -> Vec<Shape> {
        self.header(step, 0).shapes(0).into_iter().take(self.values.len()).collect()
    }

    /// Domains for each plane, out of the picture itself, for squares that are worth the search at a step.
    pub(super) fn candidates(&self, effort: Option<Effort>, step: Step) -> Vec<Candidates> {
        let header = self.header(step, 0);
        let find = |(index, (shape, original)): (u32, (&Shape, &Samples))| {
            let Some(effort) = effort.filter(|_| !self.plan.without.domains) else {
                return Candidates::none();
            };
            let q = header.step_of(index) as f32 / 256.0;
            // what would not pay for its domain's bins is not looked for
            Candidates::find(shape, original, &original.halved(), effort, 6.0 * self.lambda(q))
        };
        (0..).zip(self.shapes(step).iter().zip(&self.originals)).map(find).collect()
    }

    /// What a domain costs besides its bits that the first sweep does not find ready: where all of it is
    /// settled
    /// by that sweep, and else. Whatever copies it waits for it as well, so few sweeps allow few of them.
    const fn late(&self) -> [f32; 2] {
        match self.plan.reach {
            0..=2 => [2.0, 1e4],
            3 => [12.0, 16.0],
            _ => [0.0; 2],
        }
    }

    /// The squared error that a bit is worth at a step. It grows with the error that there is: that of the
    /// step, and that of samples which are rounded.
    const fn lambda(&self, step: f32) -> f32 {
        let rate = if matches!(self.plan.profile, Profile::Pure) { LAMBDA_PURE } else { LAMBDA };
        rate * (step * step + 1.0)
    }

    /// How many bands there are for each of which a rough encoding needs to see one.
    pub(super) fn sparse(&self) -> u32 {
        // of small pictures all
        (self.size.height / BAND / FEW).clamp(1, 8)
    }

    /// Encodes. Domains of sweeps lie in the pools, the planes as they will be decoded, or else the picture.
    pub(super) fn encode(&self, at: At<'_>, known: Known<'_>) -> Result<Pass, Error> {
        if self.deep { self.encode_as::<u16>(at, known) } else { self.encode_as::<u8>(at, known) }
    }

    fn encode_as<S: Sample + Default>(&self, at: At<'_>, known: Known<'_>) -> Result<Pass, Error> {
        let At { step, thrift, every } = at;
        let Known { candidates, pools, counts } = known;
        let header = self.header(step, 0);
        let shapes = self.shapes(step);
        let mut memory = vec![S::default(); shapes.iter().map(Plane::<S>::samples).sum()];
        let mut rest = Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells();
        let mut planes: Vec<Plane<'_, S>> =
            shapes.iter().map(|shape| Plane::new(*shape, &mut rest)).collect();
        if self.plan.profile != Profile::Streaming {
            for (index, plane) in planes.iter().enumerate() {
                let pool = pools.map_or(&self.values[index], |pools| &pools[index].samples);
                plane.picture().iter().zip(pool).for_each(|(to, from)| to.set(S::cut(i32::from(*from))));
            }
        }
        let padded = |shape: &Shape| (shape.padded(), shape.height.next_multiple_of(shape.side()));
        let mut settled: Vec<Settled> =
            shapes.iter().map(padded).map(|(width, height)| Settled::new(width, height)).collect();
        let (mut out, mut starts) = (RangeEncoder::new(), Vec::new());
        let streaming = self.plan.profile == Profile::Streaming;
        let (mut error, mut seen, mut target) = (0, 0, Target::none());
        for row in (0..self.size.height).step_by((BAND * every) as usize) {
            starts.push((row, out.length()));
            let thrift = thrift.iter().rfind(|(from, _)| *from <= row).map_or(1.0, |(_, thrift)| *thrift);
            for (index, plane) in (0..).zip(&mut planes) {
                let band = row >> header.halved(index);
                plane.begin(band, 0);
                let q = header.step_of(index) as f32 / 256.0;
                let mut partition = Partition {
                    plane,
                    original: &self.originals[index as usize],
                    candidates: &candidates[index as usize],
                    cosine: &self.cosine,
                    prices: &self.prices,
                    profile: self.plan.profile,
                    step: q,
                    lambda: thrift * self.lambda(q),
                    late: self.late(),
                    without: self.plan.without,
                    effort: Effort { polish: self.effort.polish && every == 1, ..self.effort },
                    rates: self.prices.rates(&out.models, None, shapes[index as usize].chroma),
                    counts,
                    before: pools.map(|pools| &pools[index as usize].settled),
                    settled: &mut settled[index as usize],
                    target,
                };
                partition.band(band, &mut out);
                target = partition.target;
                if streaming && self.planes == Planes::Grey {
                    let start = (band * self.size.width) as usize;
                    let rows = (self.size.height - band).min(BAND) * self.size.width;
                    let truth = self.values[0][start..].iter().take(rows as usize);
                    error += truth.zip(plane.picture()).map(|(a, b)| off(*a, b.get().number())).sum::<u64>();
                    seen += rows;
                }
            }
        }
        starts.push((self.size.height, out.length()));
        let now = out.counts;
        let payload = out.finish();
        let mut start = [0; Header::LONGEST];
        let length = self.header(step, payload.len() as u32).write(&mut start)?;
        let mut bytes = [&start[..length], &payload].concat();
        bytes.extend(crc32(&bytes).to_le_bytes());
        let decibels = (seen > 0).then(|| decibels(error as f64, seen as usize, (1 << S::BITS) - 1));
        Ok(Pass { bytes, decibels, settled, counts: now, starts })
    }
}

/// Their difference squared.
fn off(a: u16, b: i32) -> u64 {
    u64::from(b.abs_diff(i32::from(a))).pow(2)
}

fn samples(shape: &Shape, plane: &[u16]) -> Samples {
    Samples::new(shape.width, shape.height, shape.side(), |at| f32::from(plane[at]))
}
