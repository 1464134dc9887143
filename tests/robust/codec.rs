//! Images: whatever the bytes, a decoder ends, and what an encoder shares with it takes whatever it is given.

use attractor::codec::shared::{
    Coder, Domain, Leaf, Levels, MODELS, Model, Plane, Setting, Shape, class, context, crc32, number, scan,
};
use attractor::codec::{Bytes, Header, Luma, Part, Planes, Profile, Step, Streamed, Sweeps, check, open};
use attractor::draw::{Palette, YCoCg};

use std::cell::Cell;

use super::*;

/// Answers with bits of a seed, and remembers how often it was asked.
struct Any(u64, u32);

impl Coder for Any {
    fn bin(&mut self, context: usize, _: bool) -> bool {
        assert!(context < MODELS);
        self.raw(1, 0) == 1
    }

    fn raw(&mut self, count: u32, _: u32) -> u32 {
        self.1 += 1;
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        if count == 0 { 0 } else { (self.0 >> 33) as u32 >> (31 - count.min(31)) }
    }
}

#[test]
fn any_bytes_are_a_picture_or_refused() {
    const FILES: [&[u8]; 3] = [
        include_bytes!("../vectors/version-2/streaming.atfi"),
        include_bytes!("../vectors/version-2/iterated.atfi"),
        include_bytes!("../vectors/version-2/colour-halved.atfi"),
    ];
    let strategy = (0..3_usize, vec((0..700_usize, any::<u8>()), 0..12), -2..=2, any::<bool>());
    fuzz(strategy, 5, |(file, changes, scale, mended)| {
        let mut bytes = FILES[file].to_vec();
        for (at, byte) in changes {
            let at = at % bytes.len();
            // not the size, or most of the time goes into large pictures
            if !(6..10).contains(&at) {
                bytes[at] = byte;
            }
        }
        if mended {
            let end = bytes.len() - 4;
            let crc = crc32(&bytes[..end]);
            bytes[end..].copy_from_slice(&crc.to_le_bytes());
        }
        let Ok(opened) = open(bytes.iter().copied()) else { return false };
        let header = *opened.header();
        let mut memory = vec![0_u8; opened.samples(scale)];
        if header.deep {
            return false;
        }
        if header.profile != Profile::Streaming {
            let Ok(mut sweeps) = opened.sweeps(scale, &mut memory) else { return false };
            let swept = sweeps.sweep().is_ok() && sweeps.finish().is_ok();
            assert_eq!(Luma(sweeps.picture()).at(0, 0), sweeps.at(0, 0)[0]);
            return swept;
        }
        let Ok(mut stream) = opened.stream(scale, &mut memory) else { return false };
        let size = stream.size();
        let mut rows = 0;
        let whole = loop {
            match stream.next_band() {
                Ok(Some(band)) => {
                    assert_eq!((band.top(), band.sample(9, 0, 0)), (rows, 128));
                    rows += band.size().height;
                }
                Ok(None) => break rows == size.height,
                Err(_) => break false,
            }
        };
        let mut memory = vec![0_u8; open(bytes.iter().copied()).unwrap().samples(scale)];
        let streamed = Streamed::new(&bytes, scale, &mut memory);
        match streamed {
            Ok(field) => {
                let last = field.at(size.width - 1, size.height - 1);
                // bytes that are left over are found behind the last row
                let decoded = rows == size.height;
                assert!(field.error().is_some() || decoded);
                assert!(decoded || last == [0; 3]);
            }
            Err(_) => assert!(check(&bytes).is_err() || !whole),
        }
        whole
    });
    let mut reader = Bytes::<_, 3>::new(&b"any"[..]);
    assert!(reader.by_ref().eq(*b"any") && reader.error().is_none());
    // what the types are called
    let _: Option<Sweeps<'_, u8, std::iter::Empty<u8>>> = None;
    let _: Option<Part<'_, u8>> = None;
    let _ = YCoCg.rgb([1_u8, 2, 3]);
}

#[test]
fn leaves_say_what_they_hear() {
    let strategy = (any::<u64>(), 2..=5_u32, 0..=1_u32, 0..=2_u32, any::<bool>(), (0..9000_u32, 0..9000_u32));
    fuzz(strategy, 99, |(seed, size, chroma, neighbours, transform, far)| {
        let far = (size > 2 && far.0 * far.1 > 0).then_some(far);
        let setting = Setting { size, chroma, neighbours, far, transform };
        let (mut leaf, mut coder) = (Leaf::default(), Any(seed, 0));
        leaf.code(&mut coder, &setting);
        let count = scan(size).len() as u32;
        assert!(leaf.last < count && coder.1 < 100 + 45 * count, "{}", coder.1);
        let contrast = leaf.domain.map_or(1, |domain: Domain| domain.contrast());
        assert!(contrast != 0 && contrast.abs() <= 8);
        let levels: Vec<i32> = scan(size).iter().map(|place| leaf.levels.get(*place)).collect();
        assert!(levels.iter().all(|level| level.abs() <= 8191));
        assert_eq!(leaf.levels.is_empty(), levels.iter().all(|level| *level == 0));
        assert!(scan(size).iter().all(|place| leaf.levels.about(*place) <= 2));
        let mut again = Levels::default();
        scan(size).iter().zip(&levels).for_each(|(place, level)| again.set(*place, *level));
        again.clear();
        assert!(again.is_empty() && class(leaf.last) < 13);
        number(&mut coder, context::LAST, u32::MAX);
        true
    });
}

/// A coder that says what is longest: divide or not, as a seed has it, and every other bin 1.
struct Longest(u64, u32);

impl Coder for Longest {
    fn bin(&mut self, context: usize, _: bool) -> bool {
        self.1 += 1;
        self.0 = self.0.rotate_left(1);
        if context < context::DOMAIN { self.0 & 1 == 1 } else { context < context::MEAN || self.0 & 2 == 0 }
    }

    fn raw(&mut self, count: u32, _: u32) -> u32 {
        self.1 += count;
        0
    }
}

/// A header bounds how many bins and raw bits a picture has: 64 for each sample up to whole squares.
#[test]
fn bins_are_bounded_by_the_header() {
    let (mut most, mut tried) = (0.0_f64, 0);
    for (width, height) in [(1, 1), (4, 4), (32, 32), (33, 65), (70, 40)] {
        for largest in [4, 5] {
            for (window, divided) in
                [(None, 0), (None, u64::MAX), (Some(64), 0), (None, 0x5555_5555_5555_5555)]
            {
                let shape =
                    Shape { width, height, largest, chroma: 0, step: 16, window, transform: true, scale: 0 };
                let mut memory = vec![0_u8; Plane::<u8>::samples(&shape)];
                let mut rest = Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells();
                let (mut plane, mut leaf) = (Plane::new(shape, &mut rest), Leaf::default());
                let mut coder = Longest(divided, 0);
                let bands = height.div_ceil(shape.side());
                for band in 0..bands {
                    plane.begin(band * shape.side(), 0);
                    // a domain where none may be ends a band
                    plane.decode(&mut coder, &mut leaf, |_| false, |_, _, _, _| {});
                }
                let samples = shape.padded() * bands * shape.side();
                assert!(coder.1 <= 64 * samples, "{} of {samples}: {shape:?}", coder.1);
                most = most.max(f64::from(coder.1) / f64::from(samples));
                tried += 1;
            }
        }
    }
    println!("{most:.1} bins a sample");
    assert!(tried == 40 && most > 20.0, "{most}");
}

#[test]
fn models_stay_probabilities() {
    for (version, ends) in [(1, [31, 8160]), (2, [11, 8179])] {
        let (mut least, mut most) = (8192, 0);
        for bins in 0..4096_u32 {
            let model = (0..12).fold(Model::new(version), |model, k| model.learn(bins >> k & 1 == 1));
            let model = (0..2000).fold(model, |model, _| model.learn(bins & 1 == 1));
            least = least.min(model.zero());
            most = most.max(model.zero());
        }
        assert_eq!([least, most], ends, "version {version}");
    }
}

#[test]
fn any_header_is_written_and_read() {
    let strategy = (
        1..=16384_u32,
        1..=16384_u32,
        0..=2_u8,
        (0..=2_u8, 1..=2_u8),
        any::<bool>(),
        any::<u16>(),
        (1..=8_u8, 1..=255_u8),
        0..1_u32 << 28,
    );
    fuzz(strategy, 5, |(width, height, profile, (planes, version), deep, step, (reach, chroma), payload)| {
        let Some(step) = Step::from_bits(step) else { return false };
        assert!(step <= Step::MAX && Step::from_bits(step.to_bits()) == Some(step) && step.value() >= 16);
        let profile = [Profile::Streaming, Profile::Iterated, Profile::Pure][usize::from(profile)];
        let planes = [Planes::Grey, Planes::Colour, Planes::ColourHalved][usize::from(planes)];
        let chroma = if planes == Planes::Grey { 0 } else { chroma };
        let header = Header {
            version,
            size: Size::new(width, height),
            profile,
            planes,
            deep,
            step,
            reach,
            chroma,
            payload,
        };
        let mut bytes = [0; Header::LONGEST];
        let length = header.write(&mut bytes).unwrap();
        assert_eq!(*open(bytes[..length].iter().copied()).unwrap().header(), header);
        assert!(Header { payload: 1 << 28, ..header }.write(&mut bytes).is_err());
        for (plane, shape) in (0..).zip(header.shapes(-1)) {
            assert_eq!(
                (shape.step, shape.side() >> header.halved(plane)),
                (header.step_of(plane), if plane == 0 || planes != Planes::ColourHalved { 32 } else { 8 })
            );
            assert!(
                shape.padded() >= shape.width
                    && shape.columns() <= shape.width
                    && shape.rows() <= shape.height
            );
            assert!(
                header.plane_size(plane).width >= shape.width
                    && shape.scaled(8) == 4
                    && shape.scaled_up(9) == 5
            );
        }
        true
    });
}

#[test]
fn a_plane_takes_any_leaf() {
    let strategy = (
        any::<u64>(),
        (1..70_u32, 1..70_u32),
        4..=5_u32,
        -2..=2,
        any::<u32>(),
        proptest::option::of(0..=64_u32),
    );
    fuzz(strategy, 90, |(seed, (width, height), largest, scale, step, window)| {
        let shape = Shape {
            width,
            height,
            largest,
            chroma: 0,
            step: step >> (seed % 32),
            window,
            transform: true,
            scale,
        };
        let shape = Shape { step: shape.step.min(Step::MAX.value()), ..shape };
        let mut memory = vec![0_u8; Plane::<u8>::samples(&shape)];
        let mut rest = Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells();
        let mut plane = Plane::new(shape, &mut rest);
        assert!(
            rest.is_empty()
                && plane.shape().half_rows() <= 64 + 32
                && plane.picture().len() <= 70 * 70 * 16 * 3
        );
        let mut coder = Any(seed, 0);
        let mut leaf = Leaf::default();
        for band in (0..height).step_by(1 << largest) {
            plane.begin(band, (seed % 3) as u32);
            plane.decode(&mut coder, &mut leaf, |_| false, |_, _, _, _| {});
        }
        // what an encoder asks
        plane.begin(0, 0);
        let edge = plane.edge(0, 0, largest);
        let setting = plane.setting(0, 0, 3);
        assert!(plane.split_context(0, 0, 3) < context::DOMAIN && setting.far == shape.far(3));
        plane.expected(0, 0, 3);
        let domain = Domain { near: true, column: 8, row: 8, isometry: 5, scaling: 15 };
        let mut copied = [0; 1 << 14];
        if scale == 0 {
            let there = plane.copied(&domain, 0, 0, 2, &mut copied);
            assert!(!there || shape.place(&domain, 0, 0, 2).is_some());
        }
        plane.settle(&leaf, 0, 0, 3);
        plane.draw(&Leaf::default(), 0, 0, 3);
        plane.skip(0, 0, 3);
        plane.restore(&edge);
        coder.1 > 0
    });
    let mut all = vec![0_u8; 1 << 16];
    let file = include_bytes!("../vectors/version-2/pure.atfi");
    let mut domains = 0;
    let seen = |_: u32, leaf: &Leaf, _: &Setting, _: [u32; 2]| domains += u32::from(leaf.domain.is_some());
    open(file.iter().copied()).unwrap().leaves(&mut all, seen).unwrap();
    assert!(domains > 20);
}
