//! `attractor inspect`: what a stream is made of, as a table and as a picture of its partition.

use std::io::Write as _;

use attractor::Error;
use attractor::codec::shared::{Coder, Leaf, MODELS, Model, Setting, context};
use attractor::codec::{Profile, Sample, open};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;

use crate::canvas;
use crate::cli::Inspect;
use crate::decode;
use crate::fail::Fail;
use crate::output;
use crate::still::{Pixels, Still};

/// Bits by what they say.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
struct Shares {
    choice: f64,
    domain: f64,
    mean: f64,
    levels: f64,
    /// How many bins and raw bits there are, those of divided squares left out.
    count: f64,
}

/// Counts bits as the models that learn like the decoder's price them.
struct Counter {
    models: [Model; MODELS],
    shares: Shares,
    /// The model of the last bin: whose raw bits come.
    last: usize,
}

impl Counter {
    /// Nothing yet, of a stream of that version.
    fn new(version: u8) -> Self {
        Self { models: [Model::new(version); MODELS], shares: Shares::default(), last: 0 }
    }
}

impl Coder for Counter {
    fn bin(&mut self, context: usize, bin: bool) -> bool {
        let zero = f64::from(self.models[context].zero()) / 8192.0;
        let bits = -(if bin { 1.0 - zero } else { zero }).log2();
        self.models[context] = self.models[context].learn(bin);
        self.last = context;
        let share = match context {
            _ if context < context::DOMAIN => &mut self.shares.choice,
            _ if context < context::NEAR => &mut self.shares.choice,
            _ if context < context::MEAN => &mut self.shares.domain,
            _ if context < context::LAST => &mut self.shares.mean,
            _ => &mut self.shares.levels,
        };
        *share += bits;
        self.shares.count += 1.0;
        bin
    }

    fn raw(&mut self, count: u32, bits: u32) -> u32 {
        let share = match self.last {
            context::MEAN..context::LAST => &mut self.shares.mean,
            context::LAST.. => &mut self.shares.levels,
            _ => &mut self.shares.domain,
        };
        *share += f64::from(count);
        self.shares.count += f64::from(count);
        bits
    }
}

/// A leaf: plane, place, size and where its domain begins.
pub(crate) type Square = (u32, [u32; 2], u32, Option<(bool, [u32; 2])>);

/// All leaves of a stream.
fn leaves<S: Sample + Default>(bytes: &[u8], counter: &mut Counter) -> Result<Vec<Square>, Error> {
    let opened = open(bytes.iter().copied())?;
    let shapes = opened.header().shapes(0);
    let mut memory = vec![S::default(); opened.samples(0)];
    let mut all = Vec::new();
    opened.leaves(&mut memory, |plane, leaf: &Leaf, setting: &Setting, at| {
        leaf.clone().code(counter, setting);
        let place = |domain| shapes[plane as usize].place(domain, at[0], at[1], setting.size);
        let domain = leaf.domain.as_ref().map(|d| (d.near, place(d).map_or([0; 2], |p| [2 * p.x, 2 * p.y])));
        all.push((plane, at, setting.size, domain));
    })?;
    Ok(all)
}

/// Prints the shares, and draws the partition if a file is named.
pub(crate) fn run(args: &Inspect) -> Result<(), Fail> {
    let refused = |error: Error| Fail::new(format_args!("{}: {error}", args.file.display()));
    let (bytes, header) = decode::load(&args.file)?;
    let mut counter = Counter::new(header.version);
    let squares =
        if header.deep { leaves::<u16>(&bytes, &mut counter) } else { leaves::<u8>(&bytes, &mut counter) };
    let squares = squares.map_err(refused)?;
    if let Some(picture) = &args.output {
        output::check_png(picture)?;
        output::check_beside(picture, [&*args.file])?;
        let still = decode::decoded(&bytes, 0, None).map_err(refused)?;
        let png = drawn(&still, &squares)
            .map_err(|error| Fail::new(format_args!("{}: {error}", picture.display())))?;
        output::write(picture, &png)?;
    }
    let mut out = std::io::stdout().lock();
    let profile = match header.profile {
        Profile::Streaming => format!("streaming, window {} rows", 8 * u32::from(header.reach)),
        Profile::Iterated => format!("iterated, {} sweeps", header.reach),
        Profile::Pure => format!("pure, {} sweeps", header.reach),
    };
    writeln!(
        out,
        "{} x {}, {:?}, {} bits, {profile}, step {:.3}, {} bytes ({} of them header and checksum)",
        header.size.width,
        header.size.height,
        header.planes,
        if header.deep { 16 } else { 8 },
        f64::from(header.step_of(0)) / 256.0,
        bytes.len(),
        bytes.len() - header.payload as usize
    )?;
    let Shares { choice, domain, mean, levels, count } = counter.shares;
    let payload = 8.0 * f64::from(header.payload);
    // what the leaves do not account for says how squares are divided
    let division = (payload - choice - domain - mean - levels).max(0.0);
    writeln!(
        out,
        "bits: division {}, with or without a domain {}, domains {}, means {}, coefficients {}",
        percent(division, payload),
        percent(choice, payload),
        percent(domain, payload),
        percent(mean, payload),
        percent(levels, payload)
    )?;
    writeln!(
        out,
        "without adaptive models: {:.0} bytes of payload instead of {}",
        count / 8.0,
        header.payload
    )?;
    writeln!(out, "{:>6} {:>8} {:>8} {:>8}", "side", "leaves", "near", "far")?;
    for size in 2..=5 {
        let of = |near: Option<bool>| {
            squares
                .iter()
                .filter(|(_, _, s, d)| *s == size && near.is_none_or(|near| d.is_some_and(|d| d.0 == near)))
                .count()
        };
        writeln!(out, "{:>6} {:>8} {:>8} {:>8}", 1 << size, of(None), of(Some(true)), of(Some(false)))?;
    }
    Ok(())
}

fn percent(part: f64, all: f64) -> String {
    format!("{:.1} %", 100.0 * part / all.max(1.0))
}

/// The picture, washed out, with the leaves of its first plane: those with a domain in red.
fn drawn(still: &Still, squares: &[Square]) -> Result<Vec<u8>, png::EncodingError> {
    let size = still.size;
    let mut display = SimulatorDisplay::<Rgb888>::new(size);
    let pale = |v: u8| 96 + v / 2 + v / 8;
    let at = |i: usize| match &still.pixels {
        Pixels::Grey(p) => [p[i]; 3],
        Pixels::Deep(p) => [(p[i] >> 8) as u8; 3],
        Pixels::Colour(p) => p[i],
    };
    let pixels = (0..size.width * size.height).map(|i| {
        let [r, g, b] = at(i as usize).map(pale);
        Pixel(Point::new((i % size.width) as i32, (i / size.width) as i32), Rgb888::new(r, g, b))
    });
    let Ok(()) = display.draw_iter(pixels);
    for (_, [x, y], size, domain) in squares.iter().filter(|(plane, ..)| *plane == 0) {
        let color = if domain.is_some() { Rgb888::new(200, 40, 40) } else { Rgb888::new(60, 80, 140) };
        let side = 1 << size;
        let edge = (0..side).flat_map(|k| [Point::new(k, 0), Point::new(0, k)]);
        let corner = Point::new(*x as i32, *y as i32);
        let Ok(()) = display.draw_iter(edge.map(|p| Pixel(corner + p, color)));
    }
    canvas::png(&display, 1)
}

#[cfg(test)]
mod tests {
    use attractor::codec::Header;

    use super::*;

    #[test]
    fn a_counter_prices_each_kind() {
        let mut counter = Counter::new(Header::VERSION);
        counter.bin(context::DOMAIN, true);
        counter.bin(context::COLUMN, false);
        counter.raw(9, 5);
        counter.bin(context::MEAN, false);
        counter.raw(2, 1);
        counter.bin(context::SIGNIFICANT, false);
        counter.raw(1, 1);
        let Shares { choice, domain, mean, levels, count } = counter.shares;
        assert_eq!((choice, domain, mean, levels, count), (1.0, 10.0, 3.0, 2.0, 16.0));
    }
}
