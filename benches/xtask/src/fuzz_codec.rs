//! `cargo xtask fuzz-codec`: small streams, many of which decode whole, until as many were tried as asked
//! for. A panic, an overflow in a build with checks, a decoder that reads on for ever, and sweeps that show
//! something else where they keep leaves are faults; so is, in one of 128 streams as it was made, a sample
//! that is not the reference's, in any size. The first fault ends all threads, and its stream is printed.
//!
//! The streams are those of `tests/streams.rs`. Each is decoded as it is, then again and again with other
//! bytes changed, at another scale, and with another checksum, so that the changed bins are read. Most have
//! up to 12 x 12 or 4 x 36 pixels, one of 128 up to 96 x 96 or 32 x 288. An execution is one stream decoded,
//! of profiles iterated and pure by two decoders in two sweeps, sometimes in all. Memory is lent once.

use std::hint::black_box;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow, ensure};
use attractor::Error;
use attractor::codec::shared::crc32;
use attractor::codec::{Opened, Part, Planes, Profile, Sample, open};
use attractor::plane::Field as _;
use attractor_reference::codec::decode_scaled;
use attractor_tests::streams::{Random, stream_of};
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct Options {
    /// How many streams
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    executions: u64,
    /// Of the coins
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How many threads; 0 for as many as there are cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

/// How often each stream that was made is decoded.
const TRIES: usize = 128;
/// Of as many streams that were made one is compared with the reference.
const COMPARED: u64 = 128;
/// As logarithms of the sizes that it is compared in.
const SCALES: [i32; 5] = [-2, -1, 0, 1, 2];
/// Samples that a decoder may borrow: 16 a pixel of the largest, of three planes, and leaves beyond.
const MEMORY: usize = 1 << 19;

/// What came of how many.
#[derive(Debug, Default)]
struct Tally {
    whole: u64,
    compared: u64,
    refused: std::collections::BTreeMap<&'static str, u64>,
}

pub(crate) fn run(options: &Options) -> Result<bool> {
    let threads = match options.threads {
        0 => std::thread::available_parallelism()?.get(),
        threads => threads,
    };
    let (done, failed, start) = (AtomicU64::new(0), AtomicBool::new(false), Instant::now());
    let shares = std::thread::scope(|scope| {
        let share = |thread| {
            let (share, done, failed) = (options.executions.div_ceil(threads as u64), &done, &failed);
            let random = Random::new(options.seed << 8 | thread as u64);
            scope.spawn(move || {
                fuzz(random, share, done, failed).inspect_err(|_| failed.store(true, Ordering::Relaxed))
            })
        };
        let shares: Vec<_> = (0..threads).map(share).collect();
        let mut said = start;
        while !shares.iter().all(|share| share.is_finished()) {
            std::thread::sleep(Duration::from_millis(100));
            if said.elapsed() > Duration::from_secs(60) {
                said = Instant::now();
                eprintln!("{} after {:.0} s", done.load(Ordering::Relaxed), start.elapsed().as_secs_f64());
            }
        }
        shares.into_iter().map(|share| share.join()).collect::<Vec<_>>()
    });
    let mut all = Tally::default();
    for share in shares {
        let share = share.map_err(|_| anyhow!("a stream could not be made"))??;
        (all.whole, all.compared) = (all.whole + share.whole, all.compared + share.compared);
        for (name, count) in share.refused {
            *all.refused.entry(name).or_default() += count;
        }
    }
    let (executions, seconds) = (done.load(Ordering::Relaxed), start.elapsed().as_secs_f64());
    println!(
        "{executions} executions in {seconds:.1} s, {:.0} a second, {threads} threads, seed {}: {} decoded whole, {} \
         compared with the reference, refused {:?}",
        executions as f64 / seconds,
        options.seed,
        all.whole,
        all.compared,
        all.refused
    );
    ensure!(all.whole * 4 > executions && all.refused.len() > 2, "the streams reach too little");
    Ok(true)
}

fn fuzz(mut random: Random, executions: u64, done: &AtomicU64, failed: &AtomicBool) -> Result<Tally> {
    let mut tally = Tally::default();
    let (mut small, mut deep) = ([(); 2].map(|()| vec![0_u8; MEMORY]), [(); 2].map(|()| vec![0_u16; MEMORY]));
    let (mut bytes, mut made, mut tried) = (Vec::new(), 0, 0);
    while tried < executions && !failed.load(Ordering::Relaxed) {
        let compare = made % COMPARED == 0;
        // small ones are decoded faster, and come through more often
        let side = if compare { 96 } else { [4, 8, 12][random.below(3)] };
        let whole = stream_of(&mut random, compare, side)?;
        made += 1;
        for again in 0..TRIES {
            bytes.clone_from(&whole);
            // as it is at several scales, with more or less memory; then changed
            if again >= TRIES / 4 {
                change(&mut random, &mut bytes);
            }
            let scale = match SCALES.get(again) {
                Some(scale) if compare => *scale,
                _ => [0, 0, 0, 0, -2, -1, 1, 2][random.below(8)],
            };
            let beyond = random.below(6) * random.below(200);
            let compare = compare && again < SCALES.len();
            // all sweeps of a few, pictures compared after each; two of the others, pictures after them
            let all = compare || again % 16 == 0;
            let drawn = || {
                let opened = open(bytes.iter().copied())?;
                match opened.header().deep {
                    // what a changed header asks for beyond that is not lent
                    _ if opened.samples(scale) > MEMORY => Err(Error::BufferLength {
                        what: "samples",
                        given: MEMORY,
                        needed: opened.samples(scale),
                    }),
                    true => decoded(opened, scale, (beyond, all), compare.then_some(&bytes), &mut deep),
                    false => decoded(opened, scale, (beyond, all), compare.then_some(&bytes), &mut small),
                }
            };
            let result = catch_unwind(AssertUnwindSafe(drawn)).map_err(|_| {
                let hex: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
                anyhow!("a fault, drawn in 2^{scale} of its size, {beyond} samples beyond, all sweeps {all}: {hex}")
            })?;
            tally.compared += u64::from(compare);
            match result {
                Ok(()) => tally.whole += 1,
                Err(error) => *tally.refused.entry(name(&error)).or_default() += 1,
            }
        }
        tried += TRIES as u64;
        done.fetch_add(TRIES as u64, Ordering::Relaxed);
    }
    Ok(tally)
}

/// Changes up to three bytes or bits of the payload, seldom one of the header; most checksums are made right
/// again.
fn change(random: &mut Random, bytes: &mut Vec<u8>) {
    let end = bytes.len().saturating_sub(4);
    // magic, version and size stay but once in a while
    let start = if random.below(16) == 0 { random.below(10) } else { 10 };
    for _ in 0..=random.below(2) {
        // most of them late, so that what comes before is decoded
        let length = end.saturating_sub(start).max(1);
        let left = (random.below(length) * random.below(length) / length) * random.below(length) / length;
        let at = start + length - 1 - left;
        if let Some(byte) = bytes.get_mut(at) {
            *byte = if random.below(2) == 0 { *byte ^ 1 << random.below(8) } else { random.bits() as u8 };
        }
    }
    match random.below(16) {
        0 => bytes.truncate(random.below(bytes.len().max(1))),
        1 => {}
        _ => {
            let stated = crc32(&bytes[..end]);
            bytes.truncate(end);
            bytes.extend(stated.to_le_bytes());
        }
    }
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
/// picture is the reference's of these bytes, if there are any.
fn decoded<S: Sample + PartialEq>(
    opened: Opened<impl Iterator<Item = u8> + Clone>,
    scale: i32,
    (beyond, all): (usize, bool),
    compare: Option<&Vec<u8>>,
    [memory, other]: &mut [Vec<S>; 2],
) -> Result<(), Error> {
    let header = *opened.header();
    let (mut samples, halved) = (Vec::new(), usize::from(header.planes == Planes::ColourHalved));
    let mut show = |part: Part<'_, S>| {
        let size = part.size();
        for y in 0..size.height {
            match compare {
                Some(_) => samples.extend(part.row(y, 0..size.width)),
                None => {
                    black_box(part.at(y % size.width, y));
                }
            }
        }
    };
    let width;
    if header.profile == Profile::Streaming {
        let mut stream = opened.stream(scale, memory)?;
        width = stream.size().width as usize;
        while let Some(band) = stream.next_band()? {
            show(band);
        }
    } else {
        let needed = opened.samples(scale);
        let mut read = opened.clone().sweeps(scale, &mut memory[..needed])?;
        let end = other.len().min(needed + beyond);
        let mut kept = opened.sweeps(scale, &mut other[..end])?;
        width = read.size().width as usize;
        let sweeps = if all { header.reach } else { header.reach.min(2) };
        for done in 1..=sweeps {
            let (one, other) = (read.sweep(), kept.sweep());
            assert_eq!(one, other, "{header:?}, 2^{scale}, {beyond} samples beyond");
            one?;
            if !all && done < sweeps {
                continue;
            }
            let (one, other) = (read.picture(), kept.picture());
            let same = |y| one.row(y, 0..width as u32).eq(other.row(y, 0..width as u32));
            assert!((0..one.size().height).all(same), "{header:?}, 2^{scale}, {beyond} samples beyond");
        }
        show(read.picture());
    }
    let Some(bytes) = compare else { return Ok(()) };
    let expected = decode_scaled(bytes, scale);
    for (plane, (exact, (wide, high, _))) in expected.exact.iter().zip(&expected.planes).enumerate() {
        let halved = if plane == 0 { 0 } else { halved };
        for (i, sample) in samples.iter().enumerate() {
            // chroma that is halved is rounded up twice
            let (x, y) = (((i % width) >> halved).min(wide - 1), ((i / width) >> halved).min(high - 1));
            let same = i64::from(sample[plane].number()) == exact[y * wide + x];
            assert!(same, "{bytes:02x?}, 2^{scale}: ({x}, {y}) of plane {plane}");
        }
    }
    Ok(())
}
