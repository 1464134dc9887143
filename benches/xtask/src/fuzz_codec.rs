//! `cargo xtask fuzz-codec`: small streams, mutated and forged with right checksums, until as many were
//! decoded
//! as asked for. A panic, an overflow in a build with checks or a decoder that reads on for ever is a fault.

use std::time::Instant;

use anyhow::{Result, ensure};
use attractor::Error;
use attractor::codec::{Profile, Sample, crc32, open};
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    executions: u64,
    /// Of the mutations
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

/// Streams to begin with.
const SEEDS: [&[u8]; 7] = [
    include_bytes!("../../../tests/vectors/flat-8.atfi"),
    include_bytes!("../../../tests/vectors/streaming.atfi"),
    include_bytes!("../../../tests/vectors/iterated.atfi"),
    include_bytes!("../../../tests/vectors/pure.atfi"),
    include_bytes!("../../../tests/vectors/colour.atfi"),
    include_bytes!("../../../tests/vectors/colour-halved.atfi"),
    include_bytes!("../../../tests/vectors/heights.atfi"),
];

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
    let (mut drawn, mut refused) = (0_u64, std::collections::BTreeMap::<&str, u64>::new());
    let (mut memory, mut deep) = (vec![0_u8; 1 << 16], vec![0_u16; 1 << 16]);
    for _ in 0..options.executions {
        let bytes = mutated(&mut random);
        let scale = random.below(5) as i32 - 2;
        let result = match open(bytes.iter().copied()) {
            Ok(opened) if opened.header().deep => decoded(&bytes, scale, &mut deep),
            Ok(_) => decoded(&bytes, scale, &mut memory),
            Err(error) => Err(error),
        };
        match result {
            Ok(()) => drawn += 1,
            Err(error) => *refused.entry(name(&error)).or_default() += 1,
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    println!(
        "{} executions in {seconds:.1} s, seed {}: {drawn} drawn, refused {refused:?}",
        options.executions, options.seed
    );
    ensure!(drawn > 0 && refused.len() > 2, "the mutations reach too little");
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

/// A stream changed here and there, small, mostly with a right checksum.
fn mutated(random: &mut Random) -> Vec<u8> {
    let mut bytes = SEEDS[random.below(SEEDS.len())].to_vec();
    // at most 64 a side
    bytes[6..10].copy_from_slice(&[random.below(65) as u8, 0, random.below(65) as u8, 0]);
    match random.below(4) {
        0 => {
            let from = 14 + random.below(bytes.len() - 14);
            bytes[from..].iter_mut().for_each(|byte| *byte = random.next() as u8);
        }
        1 => bytes.truncate(random.below(bytes.len()) + 1),
        _ => {}
    }
    for _ in 0..random.below(6) {
        let at = random.below(bytes.len());
        if !(6..10).contains(&at) {
            bytes[at] = random.next() as u8;
        }
    }
    // a payload as long as the file has room for, and its checksum
    if random.below(8) > 0 && bytes.len() > 24 {
        let payload = bytes.len() - 20;
        bytes[14..16].copy_from_slice(&[(payload & 127) as u8 | 128, (payload >> 7) as u8]);
        let end = bytes.len() - 4;
        let crc = crc32(&bytes[..end]).to_le_bytes();
        bytes[end..].copy_from_slice(&crc);
    }
    bytes
}

fn decoded<S: Sample>(bytes: &[u8], scale: i32, memory: &mut [S]) -> Result<(), Error> {
    let opened = open(bytes.iter().copied())?;
    if opened.header().profile == Profile::Streaming {
        let mut stream = opened.stream(scale, memory)?;
        while stream.next_band()?.is_some() {}
        return Ok(());
    }
    let mut sweeps = opened.sweeps(scale, memory)?;
    sweeps.sweep()?;
    sweeps.sweep().map(|_| ())
}
