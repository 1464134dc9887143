//! `cargo xtask fuzz-codec`: small streams, most of which decode whole, until as many were tried as asked
//! for. A
//! panic, an overflow in a build with checks or a decoder that reads on for ever is a fault.
//!
//! A stream is made by the decoder's own walk over the syntax, with a coder that tosses coins for bins and
//! writes what it tossed. Then bytes of it are changed in most of them; header, length and checksum stay
//! right
//! in seven of eight, so that the changed bins are read.

use std::cell::Cell;
use std::time::Instant;

use anyhow::{Result, ensure};
use attractor::Error;
use attractor::codec::shared::{Coder, Leaf, MODELS, Model, Plane, context, crc32};
use attractor::codec::{Header, Planes, Profile, Sample, Step, open};
use attractor::plane::Field as _;
use clap::Args;
use embedded_graphics::geometry::Size;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    executions: u64,
    /// Of the coins
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

/// xorshift64*.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, end: usize) -> usize {
        ((self.next() >> 32) as usize * end) >> 32
    }
}

pub(crate) fn run(options: &Options) -> Result<bool> {
    let mut random = Random(options.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let start = Instant::now();
    let (mut whole, mut refused) = (0_u64, std::collections::BTreeMap::<&str, u64>::new());
    let (mut memory, mut deep) = (vec![0_u8; 1 << 16], vec![0_u16; 1 << 16]);
    for _ in 0..options.executions {
        let bytes = stream(&mut random, &mut memory, &mut deep)?;
        let (scale, beyond) = (random.below(5) as i32 - 2, random.below(6) * random.below(200));
        let result = match open(bytes.iter().copied()) {
            Ok(opened) if opened.header().deep => decoded(&bytes, scale, beyond, &mut deep),
            Ok(_) => decoded(&bytes, scale, beyond, &mut memory),
            Err(error) => Err(error),
        };
        match result {
            Ok(()) => whole += 1,
            Err(error) => *refused.entry(name(&error)).or_default() += 1,
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{} executions in {seconds:.1} s, seed {}: {whole} decoded whole, refused {refused:?}",
        options.executions, options.seed
    );
    ensure!(whole * 4 > options.executions && refused.len() > 2, "the streams reach too little");
    Ok(true)
}

fn name(error: &Error) -> &'static str {
    match error {
        Error::Ended { .. } => "ended",
        Error::Malformed { .. } => "malformed",
        Error::Checksum { .. } => "checksum",
        Error::OutOfRange { .. } => "out of range",
        Error::Unsupported { .. } => "unsupported",
        Error::BufferLength { .. } => "buffer",
        _ => "other",
    }
}

/// Tosses coins for bins and writes them: a range coder whose carry runs back through its bytes.
struct Writer<'a> {
    random: &'a mut Random,
    /// Of 256, how often a leaf has a domain, and any other bin is 1.
    domains: usize,
    ones: usize,
    low: u64,
    range: u32,
    bytes: Vec<u8>,
    models: [Model; MODELS],
}

impl Writer<'_> {
    fn add(&mut self, bound: u32) {
        self.low += u64::from(bound);
        if self.low >> 32 != 0 {
            self.low &= 0xffff_ffff;
            for byte in self.bytes.iter_mut().rev() {
                *byte = byte.wrapping_add(1);
                if *byte != 0 {
                    break;
                }
            }
        }
    }

    fn normalise(&mut self) {
        while self.range < 1 << 24 {
            self.range <<= 8;
            self.bytes.push((self.low >> 24) as u8);
            self.low = self.low << 8 & 0xffff_ffff;
        }
    }
}

impl Coder for Writer<'_> {
    fn bin(&mut self, context: usize, _: bool) -> bool {
        let of_domain = (context::DOMAIN..context::NEAR).contains(&context);
        let bin = self.random.below(256) < if of_domain { self.domains } else { self.ones };
        let bound = (self.range >> 13) * self.models[context].zero();
        if bin {
            self.add(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        self.models[context] = self.models[context].learn(bin);
        self.normalise();
        bin
    }

    fn raw(&mut self, count: u32, _: u32) -> u32 {
        (0..count).fold(0, |bits, _| {
            self.range >>= 1;
            let one = self.random.below(2) as u32;
            if one == 1 {
                self.add(self.range);
            }
            self.normalise();
            bits << 1 | one
        })
    }
}

/// Payload of a picture in this memory.
fn payload<S: Sample>(header: &Header, random: &mut Random, memory: &mut [S]) -> Vec<u8> {
    let mut rest = Cell::from_mut(memory).as_slice_of_cells();
    let mut planes = header.shapes(0).map(|shape| Plane::new(shape, &mut rest));
    let [domains, ones] = [[0, 4, 16, 120], [20, 70, 128, 200]].map(|rates| rates[random.below(4)]);
    let models = [Model::NEW; MODELS];
    let mut writer = Writer { random, domains, ones, low: 0, range: u32::MAX, bytes: Vec::new(), models };
    let count = if header.planes == Planes::Grey { 1 } else { 3 };
    let mut leaf = Leaf::default();
    'bands: for row in (0..header.size.height).step_by(32) {
        for (plane, index) in planes.iter_mut().zip(0..count) {
            plane.begin(row >> header.halved(index), 0);
            // a domain where none may be ends it: most of these streams are malformed
            if !plane.decode(&mut writer, &mut leaf, |_| false, |_, _, _, _| {}) {
                break 'bands;
            }
        }
    }
    for shift in [24, 16, 8, 0] {
        let byte = (writer.low >> shift) as u8;
        writer.bytes.push(byte);
    }
    writer.bytes
}

/// A stream: made, and then changed here and there in two of three.
fn stream(random: &mut Random, memory: &mut [u8], deep: &mut [u16]) -> Result<Vec<u8>> {
    let planes = [Planes::Grey, Planes::Grey, Planes::Colour, Planes::ColourHalved][random.below(4)];
    let profile = [Profile::Streaming, Profile::Iterated, Profile::Pure][random.below(3)];
    let mut header = Header {
        size: Size::new(1 + random.below(48) as u32, 1 + random.below(48) as u32),
        profile,
        planes,
        deep: random.below(4) == 0,
        step: Step::from_bits(random.below(24 * 256) as u16).unwrap_or(Step::MAX),
        reach: 1 + random.below(8) as u8,
        chroma: if planes == Planes::Grey { 0 } else { 1 + random.below(255) as u8 },
        payload: 0,
    };
    let mut payload =
        if header.deep { payload(&header, random, deep) } else { payload(&header, random, memory) };
    if random.below(3) > 0 {
        for _ in 0..=random.below(3) {
            let at = random.below(payload.len());
            payload[at] = random.next() as u8;
        }
    }
    header.payload = payload.len() as u32;
    let mut start = [0; Header::LONGEST];
    let length = header.write(&mut start)?;
    let mut bytes = [&start[..length], &payload].concat();
    let broken = random.below(8);
    if broken == 0 {
        let at = random.below(bytes.len());
        bytes[at] ^= 1 << random.below(8);
    }
    bytes.extend(crc32(&bytes).to_le_bytes());
    if broken == 1 {
        bytes.truncate(random.below(bytes.len()));
    }
    Ok(bytes)
}

/// Three sweeps leave the same picture whether there is memory for leaves or not: this much, or little.
fn decoded<S: Sample + Default + PartialEq>(
    bytes: &[u8],
    scale: i32,
    beyond: usize,
    memory: &mut [S],
) -> Result<(), Error> {
    let opened = open(bytes.iter().copied())?;
    if opened.header().profile == Profile::Streaming {
        let mut stream = opened.stream(scale, memory)?;
        while stream.next_band()?.is_some() {}
        return Ok(());
    }
    let needed = opened.samples(scale);
    let mut lean = vec![S::default(); needed];
    let mut read = opened.clone().sweeps(scale, &mut lean)?;
    let end = memory.len().min(needed + beyond);
    let mut kept = opened.sweeps(scale, &mut memory[..end])?;
    for _ in 0..3 {
        let (one, other) = (read.sweep(), kept.sweep());
        assert_eq!(one, other, "{bytes:02x?}");
        one?;
        let rows = 0..read.size().height;
        let same = |y: u32| (0..read.size().width).all(|x| read.at(x, y) == kept.at(x, y));
        assert!(rows.into_iter().all(same), "{bytes:02x?}, {beyond} samples beyond");
    }
    Ok(())
}
