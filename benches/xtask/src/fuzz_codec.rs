//! `cargo xtask fuzz-codec`: small streams, most of which decode whole, until as many were tried as asked
//! for. A panic, an overflow in a build with checks, a decoder that reads on for ever, and sweeps that show
//! something else where they keep leaves are faults; so is, in one whole stream of 64, a sample that is not
//! the reference's.
//!
//! The streams are those of `tests/streams.rs`: bytes are changed in most of them.

use std::time::Instant;

use anyhow::{Result, ensure};
use attractor::Error;
use attractor::codec::{Profile, Sample, open};
use attractor::plane::Field as _;
use attractor_reference::codec::decode;
use attractor_tests::streams::{Random, stream};
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    executions: u64,
    /// Of the coins
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

pub(crate) fn run(options: &Options) -> Result<bool> {
    let mut random = Random::new(options.seed);
    let start = Instant::now();
    let (mut whole, mut refused) = (0_u64, std::collections::BTreeMap::<&str, u64>::new());
    let (mut memory, mut deep) = (vec![0_u8; 1 << 18], vec![0_u16; 1 << 18]);
    for execution in 0..options.executions {
        let compare = execution % 64 == 0;
        let bytes = stream(&mut random, false)?;
        let scale = if compare { 0 } else { random.below(5) as i32 - 2 };
        let beyond = random.below(6) * random.below(200);
        let result = match open(bytes.iter().copied()) {
            Ok(opened) if opened.header().deep => decoded(&bytes, scale, beyond, compare, &mut deep),
            Ok(_) => decoded(&bytes, scale, beyond, compare, &mut memory),
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

/// All sweeps leave the same picture whether there is memory for leaves or not: this much, or little. The
/// picture is the reference's, if that is asked for.
fn decoded<S: Sample + Default + PartialEq>(
    bytes: &[u8],
    scale: i32,
    beyond: usize,
    compare: bool,
    memory: &mut [S],
) -> Result<(), Error> {
    let opened = open(bytes.iter().copied())?;
    let header = *opened.header();
    let mut rows: Vec<Vec<[S; 3]>> = Vec::new();
    if header.profile == Profile::Streaming {
        let mut stream = opened.stream(scale, memory)?;
        let width = stream.size().width;
        while let Some(band) = stream.next_band()? {
            rows.extend((0..band.size().height).map(|y| band.row(y, 0..width).collect()));
        }
    } else {
        let needed = opened.samples(scale);
        let mut lean = vec![S::default(); needed];
        let mut read = opened.clone().sweeps(scale, &mut lean)?;
        let end = memory.len().min(needed + beyond);
        let mut kept = opened.sweeps(scale, &mut memory[..end])?;
        for _ in 0..header.reach {
            let (one, other) = (read.sweep(), kept.sweep());
            assert_eq!(one, other, "{bytes:02x?}");
            one?;
            let size = read.size();
            rows = (0..size.height).map(|y| read.row(y, 0..size.width).collect()).collect();
            let same = |(y, row): (u32, &Vec<[S; 3]>)| kept.row(y, 0..size.width).eq(row.iter().copied());
            assert!((0..).zip(&rows).all(same), "{bytes:02x?}, {beyond} samples beyond");
        }
    }
    if compare {
        for (plane, (exact, (width, height, _))) in
            decode(bytes).exact.iter().zip(&decode(bytes).planes).enumerate()
        {
            let halved = usize::from(*width < rows[0].len() || *height < rows.len());
            let exact = |x: usize, y: usize| exact[(y >> halved) * width + (x >> halved)];
            let same = |x: usize, y: usize| i64::from(rows[y][x][plane].number()) == exact(x, y);
            let all = (0..rows.len()).all(|y| (0..rows[0].len()).all(|x| same(x, y)));
            assert!(all, "{bytes:02x?}: plane {plane}");
        }
    }
    Ok(())
}
