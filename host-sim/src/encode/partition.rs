//! The partition of a plane: each square is a leaf or four squares, whichever costs less.
//!
//! The cost is squared error plus `lambda` a bit, with `lambda` in proportion to the square of the step
//! (G. Sullivan, T. Wiegand, "Rate-distortion optimization for video compression", 1998). What a bin costs is
//! asked of the models as they stand before the square and as they were in an encoding before; they learn
//! when it is written.

use attractor::codec::shared::Coder as _;
use attractor::codec::shared::{Domain, Leaf, Plane, Setting};
use attractor::codec::{Profile, Sample};

use super::cosine::{Coefficients, Cosine};
use super::quantise::Quantiser;
use super::range_encoder::{Cost, Counts, Prices, RangeEncoder, Rates};
use super::samples::Samples;
use super::search::Candidates;
use super::settled::Settled;

/// How many domains of a leaf are weighed with what its coefficients add to them.
const WEIGHED: usize = 5;
/// How often the levels of a leaf are weighed again.
const ROUNDS: u32 = 2;

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
    pub(super) rates: Rates,
    /// How often bins of each model had which value in the encoding before.
    pub(super) counts: Option<&'a Counts>,
    /// What the first sweep of the encoding before this one settled, and what that of this one does.
    pub(super) before: Option<&'a Settled>,
    pub(super) settled: &'a mut Settled,
}

/// The pixels of a square, mean off.
struct Target {
    values: [f32; 1024],
    energy: f32,
    coefficients: Coefficients,
    /// Of the mean, what is left of what the neighbours let expect, and the nearest number of steps.
    off: f32,
    mean: i32,
}

impl<S: Sample> Partition<'_, '_, S> {
    /// Decides about a band and writes it.
    pub(super) fn band(&mut self, band: u32, out: &mut RangeEncoder) {
        let size = self.plane.shape().largest;
        for x in (0..self.plane.shape().width).step_by(1 << size) {
            self.rates = self.prices.rates(&out.models, self.counts, self.plane.shape().chroma);
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
        let (mut cost, leaf) =
            if must_divide { (f32::INFINITY, Leaf::default()) } else { self.leaf(x, y, size) };
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
        (cost, Node::Leaf(Box::new(leaf)))
    }

    fn write(&mut self, node: &mut Node, out: &mut RangeEncoder, x: u32, y: u32, size: u32) {
        match node {
            Node::Outside => self.plane.skip(x, y, size),
            Node::Leaf(leaf) => {
                if size > 2 {
                    out.bin(self.plane.split_context(x, y, size), false);
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

    /// The best leaf for a square, and its cost.
    fn leaf(&self, x: u32, y: u32, size: u32) -> (f32, Leaf) {
        let target = self.target(x, y, size);
        let setting = self.plane.setting(x, y, size);
        let mut best = self.cost(&target, &target.coefficients, target.energy, None, &setting, ROUNDS);
        if best.0 <= 12.0 * self.lambda {
            return best;
        }
        let count = 1_usize << (2 * size);
        // what each would cost if nothing were added to it
        let (mut copied, mut copy) = ([0; 1024], [0.0; 1024]);
        let mut likely = Vec::new();
        for candidate in self.candidates.of(x, y, size) {
            if candidate.gain < 4.0 * self.lambda {
                break;
            }
            if !self.plane.copied(&candidate.domain, x, y, size, &mut copied) {
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
            let domain = Domain { scaling: (eighths - 1) | sign, ..candidate.domain };
            let leaf = Leaf { domain: Some(domain), ..Leaf::default() };
            let gain = contrast * (2.0 * dot - contrast * energy);
            let late = self.late_bits(&domain, x, y, size);
            let cost = self.lambda * (self.plain_bits(&leaf, &setting) + late) - gain;
            likely.push((cost, domain, dot, energy, late));
        }
        likely.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut frequencies = [0.0; 256];
        let most = if setting.transform { WEIGHED } else { likely.len() };
        for (_, domain, dot, energy, late) in likely.into_iter().take(most) {
            self.plane.copied(&domain, x, y, size, &mut copied);
            copy.iter_mut().zip(&copied).take(count).for_each(|(to, from)| *to = *from as f32 / 128.0);
            self.cosine.forward(size, &copy[..count], &mut frequencies);
            let eighths = domain.scaling & 7;
            for eighths in eighths.saturating_sub(1)..=(eighths + 1).min(7) {
                let domain = Domain { scaling: eighths | domain.scaling & 8, ..domain };
                let contrast = domain.contrast() as f32 / 8.0;
                let mut rest = target.coefficients;
                rest.iter_mut().zip(&frequencies).for_each(|(rest, domain)| *rest -= contrast * domain);
                let energy = target.energy - 2.0 * contrast * dot + contrast * contrast * energy;
                let late = self.lambda * late;
                let mut with = self.cost(&target, &rest, energy, Some(domain), &setting, 0);
                if with.0 + late < best.0 + 4.0 * self.lambda {
                    with = self.cost(&target, &rest, energy, Some(domain), &setting, ROUNDS);
                }
                if with.0 + late < best.0 {
                    best = (with.0 + late, with.1);
                }
            }
        }
        best
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
    fn plain_bits(&self, leaf: &Leaf, setting: &Setting) -> f32 {
        let mut cost = Cost { rates: &self.rates, bits: 0.0 };
        let mut plain = Leaf { domain: leaf.domain, mean: leaf.mean, ..Leaf::default() };
        plain.code(&mut cost, &Setting { transform: false, ..*setting });
        cost.bits
    }

    fn target(&self, x: u32, y: u32, size: u32) -> Target {
        let n = 1_usize << size;
        let mut values = [0.0; 1024];
        let mean = self.original.square(x, y, n, &mut values);
        let energy = values[..n * n].iter().map(|value| value * value).sum();
        let mut coefficients = [0.0; 256];
        self.cosine.forward(size, &values[..n * n], &mut coefficients);
        let off = mean - self.plane.expected(x, y, size) as f32 / 128.0;
        let mean = (off * n as f32 / self.step).round() as i32;
        Target { values, energy, coefficients, off, mean }
    }

    fn cost(
        &self,
        target: &Target,
        coefficients: &Coefficients,
        energy: f32,
        domain: Option<Domain>,
        setting: &Setting,
        rounds: u32,
    ) -> (f32, Leaf) {
        let mut leaf = Leaf { domain, ..Leaf::default() };
        let mut cost = energy;
        if setting.transform && !self.without.transform {
            let quantiser = Quantiser { rates: &self.rates, step: self.step, lambda: self.lambda };
            cost += quantiser.levels(coefficients, setting, &mut leaf, rounds);
        } else if setting.transform {
            cost += self.lambda * self.rates.last[(setting.size - 2) as usize][0];
        }
        // the nearest mean, or one that is a step nearer to what the neighbours let expect
        let n = (1 << setting.size) as f32;
        let price = |leaf: &mut Leaf, mean: i32| {
            leaf.mean = mean;
            let off = target.off * n - mean as f32 * self.step;
            off * off + self.lambda * self.plain_bits(leaf, setting)
        };
        let nearer = target.mean - target.mean.signum();
        let (less, all) = (price(&mut leaf, nearer), price(&mut leaf, target.mean));
        if less < all {
            leaf.mean = nearer;
        }
        (cost.max(0.0) + less.min(all), leaf)
    }
}
