//! The partition of a plane: each square is a leaf or four squares, whichever costs less.
//!
//! The cost is squared error plus `lambda` a bit, with `lambda` in proportion to the square of the step
//! (G. Sullivan, T. Wiegand, "Rate-distortion optimization for video compression", 1998). What a bin costs is
//! asked of the models as they stand before the square and as they were in an encoding before; they learn
//! when it is written.

use attractor::codec::shared::Coder as _;
use attractor::codec::shared::{Domain, FREQUENCIES, Leaf, Plane, Setting};
use attractor::codec::{Profile, Sample};

use super::bins::Bins;
use super::cosine::{Coefficients, Cosine};
use super::finest::MOST;
use super::polish::Polish;
use super::quantise::Quantiser;
use super::range_encoder::{Cost, Counts, Prices, RangeEncoder, Rates};
use super::rounded::Rounded;
use super::samples::Samples;
use super::search::{Candidates, Effort};
use super::settled::Settled;

/// How many domains of a leaf are weighed with what its coefficients add to them.
const WEIGHED: usize = 5;

/// Of pairs of changes at the end, so many first ones are weighed.
const AHEAD: usize = 8;

/// What a leaf may cost more than the best so far, in bits, before its levels are weighed again.
const LIKELY: f32 = 6.0;

/// A square.
enum Node {
    Leaf(Box<Leaf>),
    Divided(Vec<Node>),
    /// Outside the picture.
    Outside,
}

/// What of the codec is left out, to see what it is worth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Without {
    pub(crate) domains: bool,
    pub(crate) transform: bool,
    /// All leaves are 8 x 8.
    pub(crate) split: bool,
}

/// Encodes a plane, band by band.
pub(super) struct Partition<'a, 'm, S: Sample> {
    pub(super) plane: &'a mut Plane<'m, S>,
    pub(super) original: &'a Samples,
    pub(super) candidates: &'a Candidates,
    pub(super) cosine: &'a Cosine,
    pub(super) prices: &'a Prices,
    pub(super) profile: Profile,
    pub(super) step: f32,
    pub(super) lambda: f32,
    /// Bits for domains that a sweep more must wait for.
    pub(super) late: [f32; 2],
    pub(super) without: Without,
    pub(super) effort: Effort,
    pub(super) rates: Rates,
    /// How often bins of each model had which value in the encoding before.
    pub(super) counts: Option<&'a Counts>,
    /// What the first sweep of the encoding before this one settled, and what that of this one does.
    pub(super) before: Option<&'a Settled>,
    pub(super) settled: &'a mut Settled,
    /// The square that is weighed.
    pub(super) target: Box<Target>,
}

/// The pixels of a square, mean off.
pub(super) struct Target {
    values: [f32; 1024],
    energy: f32,
    coefficients: Coefficients,
    /// Of the mean, what is left of what the neighbours let expect, and the nearest number of steps.
    off: f32,
    mean: i32,
}

impl Target {
    pub(super) fn none() -> Box<Self> {
        Box::new(Self { values: [0.0; 1024], energy: 0.0, coefficients: [0.0; 256], off: 0.0, mean: 0 })
    }
}

impl<S: Sample> Partition<'_, '_, S> {
    /// Decides about a band and writes it.
    pub(super) fn band(&mut self, band: u32, out: &mut RangeEncoder) {
        let size = self.plane.shape().largest;
        for x in (0..self.plane.shape().width).step_by(1 << size) {
            self.rates = self.prices.rates(
                &out.models,
                self.counts.map(|counts| (counts, self.effort.whole)),
                self.plane.shape().chroma,
            );
            let edge = self.plane.edge(x, band, size);
            let (_, mut node) = self.choose(x, band, size);
            self.plane.restore(&edge);
            self.write(&mut node, out, x, band, size);
        }
    }

    fn choose(&mut self, x: u32, y: u32, size: u32) -> (f32, Node) {
        if x >= self.plane.shape().width || y >= self.plane.shape().height {
            self.plane.skip(x, y, size);
            return (0.0, Node::Outside);
        }
        let must_divide = self.without.split && size > 3;
        let (mut cost, mut leaf) =
            if must_divide { (f32::INFINITY, Box::default()) } else { self.leaf(x, y, size) };
        if self.effort.polish && !must_divide {
            // a leaf whose samples are not known is rounded as any number is
            let rounding = (1 << (2 * size)) as f32 / 12.0;
            cost = self.polish(&mut leaf, x, y, size, 0).unwrap_or(cost + rounding);
        }
        if size > 2 && !(self.without.split && size == 3) {
            let [whole, parts] = self.rates.bins[self.plane.split_context(x, y, size)];
            cost += self.lambda * whole;
            let mut divided = self.lambda * parts;
            let edge = self.plane.edge(x, y, size);
            let half = 1 << (size - 1);
            let mut nodes = Vec::with_capacity(4);
            for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
                let (quarter, node) = self.choose(x + dx, y + dy, size - 1);
                divided += quarter;
                nodes.push(node);
                if divided >= cost {
                    break;
                }
            }
            if divided < cost {
                return (divided, Node::Divided(nodes));
            }
            self.plane.restore(&edge);
        }
        self.draw(&leaf, x, y, size);
        (cost, Node::Leaf(leaf))
    }

    fn write(&mut self, node: &mut Node, out: &mut RangeEncoder, x: u32, y: u32, size: u32) {
        match node {
            Node::Outside => self.plane.skip(x, y, size),
            Node::Leaf(leaf) => {
                if size > 2 {
                    out.bin(self.plane.split_context(x, y, size), false);
                }
                if self.effort.polish {
                    self.polish(leaf, x, y, size, AHEAD);
                }
                leaf.code(out, &self.plane.setting(x, y, size));
                self.draw(leaf, x, y, size);
                let place = |domain| self.plane.shape().place(domain, x, y, size);
                let settled = match leaf.domain.as_ref().and_then(place) {
                    Some(place) => self.settled.has(2 * place.x, 2 * place.y, 2 << size),
                    None => true,
                };
                if settled {
                    self.settled.add(x, y, 1 << size);
                }
            }
            Node::Divided(nodes) => {
                out.bin(self.plane.split_context(x, y, size), true);
                let half = 1 << (size - 1);
                for (node, (dx, dy)) in nodes.iter_mut().zip([(0, 0), (half, 0), (0, half), (half, half)]) {
                    self.write(node, out, x + dx, y + dy, size - 1);
                }
            }
        }
    }

    /// What later squares see. Sweeps see the pool that was found before instead of what is drawn.
    fn draw(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) {
        match self.profile {
            Profile::Streaming => {
                self.plane.draw(leaf, x, y, size);
            }
            Profile::Iterated | Profile::Pure => self.plane.settle(leaf, x, y, size),
        }
    }

    /// Changes a leaf by what its samples cost as they are rounded, and tells that; of pairs of changes so
    /// many first ones are tried. Samples of a domain in sweeps are not known yet: none for those, and where
    /// there are no coefficients.
    fn polish(&self, leaf: &mut Leaf, x: u32, y: u32, size: u32, ahead: usize) -> Option<f32> {
        let (setting, shape) = (self.plane.setting(x, y, size), *self.plane.shape());
        let known = leaf.domain.is_none() || matches!(self.profile, Profile::Streaming);
        if !setting.transform || self.without.transform || !known {
            return None;
        }
        let n = 1 << size;
        let mut truth = [0.0; 1024];
        let mean = self.original.square(x, y, n, &mut truth);
        truth.iter_mut().take(n * n).for_each(|value| *value = (*value + mean).round());
        let seen = [shape.width - x, shape.height - y];
        let mut rounded = Rounded::new(self.cosine, (size, S::BITS, shape.step), seen, &truth);
        rounded.fill(self.plane.expected(x, y, size), leaf.mean);
        if let Some(domain) = &leaf.domain {
            let mut copied = [0; 1024];
            self.plane.copied(domain, x, y, size, &mut copied);
            rounded.copy(&copied[..n * n], domain.contrast());
        }
        let rates = &self.rates;
        let mean = |mean| rates.mean(setting.chroma, size, mean);
        let bins = Bins::new(rates, size);
        let error = Polish::new(rounded, bins, leaf, self.step, self.lambda, mean).polish(ahead);
        let mut cost = Cost { rates, bits: 0.0 };
        leaf.code(&mut cost, &setting);
        Some(error + self.lambda * cost.bits)
    }

    /// The best leaf for a square, and its cost.
    fn leaf(&mut self, x: u32, y: u32, size: u32) -> (f32, Box<Leaf>) {
        self.aim(x, y, size);
        let target = &*self.target;
        let setting = self.plane.setting(x, y, size);
        let (mut best, mut other) = (Box::<Leaf>::default(), Box::<Leaf>::default());
        let mut least =
            self.cost(&target.coefficients, target.energy, &setting, self.effort.rounds, &mut best);
        let candidates = self.candidates.of(x, y, size);
        if candidates.is_empty() || least <= 12.0 * self.lambda {
            return (least, best);
        }
        let count = 1_usize << (2 * size);
        // what each would cost if nothing were added to it
        let (mut copied, mut copy) = ([0; 1024], [0.0; 1024]);
        let mut likely = Vec::new();
        for candidate in candidates {
            if candidate.gain < 4.0 * self.lambda {
                break;
            }
            let domain = candidate.domain();
            if !self.plane.copied(&domain, x, y, size, &mut copied) {
                continue;
            }
            let (mut dot, mut energy) = (0.0, 0.0);
            for (copied, value) in copied.iter().zip(&target.values).take(count) {
                let copied = *copied as f32 / 128.0;
                dot += copied * value;
                energy += copied * copied;
            }
            if energy < 1.0 {
                continue;
            }
            let contrast = (dot / energy).clamp(-1.0, 1.0);
            let eighths = ((8.0 * contrast.abs() + 0.5) as u32).clamp(1, 8);
            let sign = if contrast < 0.0 { 8 } else { 0 };
            let domain = Domain { scaling: (eighths - 1) | sign, ..domain };
            let gain = contrast * (2.0 * dot - contrast * energy);
            let late = self.late_bits(&domain, x, y, size);
            (other.domain, other.mean) = (Some(domain), 0);
            let cost = self.lambda * (self.plain_bits(&mut other, &setting) + late) - gain;
            likely.push((cost, domain, dot, energy, late));
        }
        likely.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut frequencies = [0.0; 256];
        let most = if setting.transform { WEIGHED } else { likely.len() };
        for (_, domain, dot, energy, late) in likely.into_iter().take(most) {
            self.plane.copied(&domain, x, y, size, &mut copied);
            copy.iter_mut().zip(&copied).take(count).for_each(|(to, from)| *to = *from as f32 / 128.0);
            self.cosine.forward(size, &copy[..count], &mut frequencies);
            let nearest = domain.scaling & 7;
            for eighths in [nearest, nearest.wrapping_sub(1), nearest + 1] {
                if eighths > 7 {
                    continue;
                }
                let domain = Domain { scaling: eighths | domain.scaling & 8, ..domain };
                let contrast = domain.contrast() as f32 / 8.0;
                let mut rest = target.coefficients;
                let less = rest.iter_mut().zip(&frequencies).take(FREQUENCIES << size);
                less.for_each(|(rest, domain)| *rest -= contrast * domain);
                let energy = target.energy - 2.0 * contrast * dot + contrast * contrast * energy;
                let late = self.lambda * late;
                other.domain = Some(domain);
                let mut with = late + self.cost(&rest, energy, &setting, 0, &mut other);
                if with > least + LIKELY * self.lambda {
                    // other contrasts of it change little
                    if eighths == nearest {
                        break;
                    }
                    continue;
                }
                with = late + self.cost(&rest, energy, &setting, self.effort.rounds, &mut other);
                if with < least {
                    least = with;
                    std::mem::swap(&mut best, &mut other);
                }
            }
        }
        (least, best)
    }

    /// What a domain costs for what it makes later sweeps wait: bits.
    fn late_bits(&self, domain: &Domain, x: u32, y: u32, size: u32) -> f32 {
        match self.plane.shape().place(domain, x, y, size) {
            Some(place) if !place.decoded => {
                let [ready, else_] = self.late;
                let settled = self.before.is_some_and(|b| b.has(2 * place.x, 2 * place.y, 2 << size));
                if settled { ready } else { else_ }
            }
            _ => 0.0,
        }
    }

    /// Bits of a leaf's domain and mean.
    fn plain_bits(&self, leaf: &mut Leaf, setting: &Setting) -> f32 {
        let mut cost = Cost { rates: &self.rates, bits: 0.0 };
        leaf.code(&mut cost, &Setting { transform: false, ..*setting });
        cost.bits
    }

    fn aim(&mut self, x: u32, y: u32, size: u32) {
        let (n, target) = (1_usize << size, &mut *self.target);
        let mean = self.original.square(x, y, n, &mut target.values);
        let values = &target.values[..n * n];
        target.energy = values.iter().map(|value| value * value).sum();
        self.cosine.forward(size, values, &mut target.coefficients);
        target.off = mean - self.plane.expected(x, y, size) as f32 / 128.0;
        // of 16 bits that of a large square may be further off than can be said
        target.mean = (target.off * n as f32 / self.step).round().clamp(-MOST, MOST) as i32;
    }

    /// Sets a leaf's mean and levels, whose domain is known, and tells its cost.
    fn cost(
        &self,
        coefficients: &Coefficients,
        energy: f32,
        setting: &Setting,
        rounds: u32,
        leaf: &mut Leaf,
    ) -> f32 {
        let mut cost = energy;
        if setting.transform && !self.without.transform {
            let quantiser = Quantiser { rates: &self.rates, step: self.step, lambda: self.lambda };
            cost += quantiser.levels(coefficients, setting, leaf, rounds);
        } else if setting.transform {
            cost += self.lambda * self.rates.last[(setting.size - 2) as usize][0];
        }
        // the nearest mean, or one that is a step nearer to what the neighbours let expect
        let n = (1 << setting.size) as f32;
        let mut price = |mean: i32| {
            leaf.mean = mean;
            let off = self.target.off * n - mean as f32 * self.step;
            off * off + self.lambda * self.plain_bits(leaf, setting)
        };
        let mean = self.target.mean;
        let all = price(mean);
        let less = if mean == 0 { all } else { price(mean - mean.signum()) };
        if less >= all {
            leaf.mean = mean;
        }
        cost.max(0.0) + less.min(all)
    }
}
