//! Streams of the image codec that no encoder wrote: made by the decoder's own walk over the syntax, with a
//! coder that tosses coins for bins and writes what it tossed.

use std::cell::Cell;

use attractor::Error;
use attractor::codec::shared::{Coder, Leaf, MODELS, Model, Plane, context, crc32};
use attractor::codec::{Header, Planes, Profile, Sample, Step};
use embedded_graphics::geometry::Size;

/// xorshift64*.
#[derive(Debug)]
pub struct Random(u64);

impl Random {
    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// A number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        ((self.bits() >> 32) as usize * end) >> 32
    }
}

/// Tosses coins for bins and writes them: a range coder whose carry runs back through its bytes.
struct Writer<'a> {
    random: Random,
    coins: &'a Coins,
    /// Leaves whose domain lay where none may, once for each time, in their order; and how many leaves there
    /// were.
    missed: &'a [usize],
    leaves: usize,
    low: u64,
    range: u32,
    bytes: Vec<u8>,
    models: [Model; MODELS],
}

/// Of 256, how often a square is divided, a leaf has a domain and any other bin is 1.
struct Coins {
    divided: usize,
    domains: usize,
    ones: usize,
    /// Column and row of most domains near their leaf, so that many lie where they may.
    near: [usize; 2],
    /// Those that are tried after it: then a leaf has none.
    others: &'static [[usize; 2]],
}

/// Above the leaf, or to the left of it.
const EARLIER: &[[usize; 2]] = &[[8, 11], [8, 8], [5, 13], [4, 11], [8, 5], [2, 14], [8, 2], [8, 0]];
/// Anywhere about it.
const ABOUT: &[[usize; 2]] = &[[8, 2], [2, 8], [8, 13], [13, 8]];

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
        // place in a tree of four bins: the one that comes next of a number
        let next = |of: usize, number: usize| {
            let node = (context - of) % 16;
            if number >> (3 - node.ilog2()) & 1 == 1 { 240 } else { 16 }
        };
        let leaf = self.leaves + usize::from((context::DOMAIN..context::NEAR).contains(&context));
        let first = self.missed.partition_point(|missed| *missed < leaf);
        let misses = self.missed[first..].iter().take_while(|missed| **missed == leaf).count();
        // a domain that is moved is near, where it is to be
        let other = misses.checked_sub(1).and_then(|miss| self.coins.others.get(miss));
        let [column, row] = other.copied().unwrap_or(self.coins.near);
        let ones = match context {
            context::SPLIT..context::DOMAIN => self.coins.divided,
            context::DOMAIN..context::NEAR => {
                self.leaves = leaf;
                match misses {
                    0 => self.coins.domains,
                    _ => 256 * usize::from(other.is_some()),
                }
            }
            context::NEAR..context::ISOMETRY if misses > 0 => 256,
            context::COLUMN..context::ROW => next(context::COLUMN, column),
            context::ROW..context::SCALING => next(context::ROW, row),
            _ => self.coins.ones,
        };
        let bin = self.random.below(256) < ones;
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

/// Payload of a picture in this memory. Where it is to be sound, a domain that lies where none may is moved
/// elsewhere or taken back, until none does.
fn payload<S: Sample>(header: &Header, random: &mut Random, sound: bool, memory: &mut [S]) -> Vec<u8> {
    let [divided, domains, ones] =
        [[40, 200, 230, 250], [4, 12, 40, 120], [20, 70, 128, 200]].map(|rates| rates[random.below(4)]);
    // above the leaf, or below where that may be
    let (rows, others) = match header.profile {
        Profile::Streaming => ([5, 8, 9, 10], EARLIER),
        _ => ([0, 1, 2, 15], ABOUT),
    };
    let near = [5 + random.below(7), rows[random.below(4)]];
    let coins = Coins { divided, domains, ones, near, others };
    let (seed, mut missed) = (random.bits(), Vec::new());
    loop {
        let mut writer = Writer {
            random: Random::new(seed),
            coins: &coins,
            missed: &missed,
            leaves: 0,
            low: 0,
            range: u32::MAX,
            bytes: Vec::new(),
            models: [Model::new(header.version); MODELS],
        };
        let drawn = walk(header, &mut writer, memory);
        if sound && !drawn {
            let last = writer.leaves;
            missed.push(last);
            continue;
        }
        for shift in [24, 16, 8, 0] {
            let byte = (writer.low >> shift) as u8;
            writer.bytes.push(byte);
        }
        return writer.bytes;
    }
}

/// Whether all of a picture could be decoded.
fn walk<S: Sample>(header: &Header, writer: &mut Writer<'_>, memory: &mut [S]) -> bool {
    let mut rest = Cell::from_mut(memory).as_slice_of_cells();
    let mut planes = header.shapes(0).map(|shape| Plane::new(shape, &mut rest));
    let count = if header.planes == Planes::Grey { 1 } else { 3 };
    let mut leaf = Leaf::default();
    (0..header.size.height).step_by(32).all(|row| {
        planes.iter_mut().zip(0..count).all(|(plane, index)| {
            plane.begin(row >> header.halved(index), 0);
            plane.decode(writer, &mut leaf, |_| false, |_, _, _, _| {})
        })
    })
}

fn payload_of(header: &Header, random: &mut Random, sound: bool) -> Vec<u8> {
    if header.deep {
        payload(header, random, sound, &mut vec![0_u16; 1 << 16])
    } else {
        payload(header, random, sound, &mut vec![0_u8; 1 << 16])
    }
}

/// Header and payload.
fn file_of(header: Header, payload: &[u8]) -> Result<Vec<u8>, Error> {
    let mut start = [0; Header::LONGEST];
    let length = Header { payload: payload.len() as u32, ..header }.write(&mut start)?;
    Ok([&start[..length], payload].concat())
}

/// A stream that can be decoded and says this of itself, up to the length of its payload.
///
/// # Errors
/// What no header can say.
pub fn stream_that_says(header: Header, random: &mut Random) -> Result<Vec<u8>, Error> {
    let mut bytes = file_of(header, &payload_of(&header, random, true))?;
    bytes.extend(crc32(&bytes).to_le_bytes());
    Ok(bytes)
}

/// A stream of up to 48 x 48 or 16 x 144 pixels: [`stream_of`].
///
/// # Errors
/// None.
pub fn stream(random: &mut Random, whole: bool) -> Result<Vec<u8>, Error> {
    stream_of(random, whole, 48)
}

/// A stream of up to `side` pixels a side, or a third and three times as many. If it is to be whole it can be
/// decoded. Else three of four could be; then bytes are changed here and there in two of three, header,
/// length and checksum stay right in seven of eight, so that the changed bins are read.
///
/// # Errors
/// None: a payload is far below what a header can say.
pub fn stream_of(random: &mut Random, whole: bool, side: usize) -> Result<Vec<u8>, Error> {
    let planes = [Planes::Grey, Planes::Grey, Planes::Colour, Planes::ColourHalved][random.below(4)];
    let profile = [Profile::Streaming, Profile::Iterated, Profile::Pure][random.below(3)];
    let [width, height] = if random.below(2) == 0 { [side / 3, 3 * side] } else { [side, side] };
    let header = Header {
        version: if random.below(4) == 0 { 1 } else { Header::VERSION },
        size: Size::new(1 + random.below(width) as u32, 1 + random.below(height) as u32),
        profile,
        planes,
        deep: random.below(4) == 0,
        step: Step::from_bits(random.below(24 * 256) as u16).unwrap_or(Step::MAX),
        reach: if profile == Profile::Streaming { random.below(9) } else { 1 + random.below(8) } as u8,
        chroma: if planes == Planes::Grey { 0 } else { 1 + random.below(255) as u8 },
        payload: 0,
    };
    let sound = whole || random.below(4) > 0;
    let mut payload = payload_of(&header, random, sound);
    if !whole && random.below(3) > 0 {
        for _ in 0..=random.below(3) {
            let at = random.below(payload.len());
            payload[at] = random.bits() as u8;
        }
    }
    let mut bytes = file_of(header, &payload)?;
    let broken = if whole { 2 } else { random.below(8) };
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
