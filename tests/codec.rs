//! The image codec: files of today decode for ever, as the f64 reference does, and what is no file is
//! refused.
//!
//! The faults that others reported are named where they are tested.

use std::cell::Cell;
use std::fmt::Debug;

use attractor::Error;
use attractor::codec::shared::crc32;
use attractor::codec::{Header, Luma, Planes, Profile, Sample, Step, Streamed, check, open};
use attractor::draw::{Grey, Picture};
use attractor::plane::Field;
use attractor_reference::codec::{Leaf, decode, decode_scaled};
use attractor_tests::streams::{Random, stream, stream_that_says};
use embedded_graphics::geometry::Size;

/// Every file that is kept of a version. `vectors/*/checksums.txt` has the CRC-32 of each one's samples, luma,
/// orange and green of every pixel in 16 bits, lowest byte first.
macro_rules! files {
    ($version:literal: $($name:literal)*) => {
        [$(($name, include_bytes!(concat!("vectors/", $version, "/", $name, ".atfi")))),*]
    };
}
const FILES: [(&str, &[u8]); 10] = files!(
    "version-2": "flat-8" "streaming" "iterated" "pure" "colour" "colour-halved" "heights" "camera-streaming"
        "camera-iterated" "camera-two-sweeps"
);
const FILES_OF_VERSION_1: [(&str, &[u8]); 10] = files!(
    "version-1": "flat-8" "streaming" "iterated" "pure" "colour" "colour-halved" "heights" "camera-streaming"
        "camera-iterated" "camera-two-sweeps"
);

/// A file of one, by its name.
fn file(name: &str) -> &'static [u8] {
    FILES.iter().find(|(other, ..)| *other == name).unwrap().1
}

/// What a decoder shows: size and values. It takes the bytes from any iterator.
fn pixels<S: Sample + Default + Debug>(
    bytes: impl Iterator<Item = u8> + Clone,
    scale: i32,
    sweeps: Option<u32>,
) -> Result<(Size, Vec<[S; 3]>), Error> {
    let opened = open(bytes)?;
    // what was there before is not seen
    let mut memory = vec![S::cut(0x5a); opened.samples(scale)];
    let mut all = Vec::new();
    let size;
    if opened.header().profile == Profile::Streaming {
        let mut stream = opened.stream(scale, &mut memory)?;
        size = stream.size();
        while let Some(band) = stream.next_band()? {
            (0..band.size().height).for_each(|y| all.extend(band.row(y, 0..size.width)));
        }
    } else {
        let mut iterated = opened.sweeps(scale, &mut memory)?;
        size = iterated.size();
        match sweeps {
            None => iterated.finish()?,
            Some(count) => (0..count).try_for_each(|_| iterated.sweep().map(|_| ()))?,
        }
        (0..size.height).for_each(|y| all.extend(iterated.row(y, 0..size.width)));
    }
    assert_eq!(all.len(), (size.width * size.height) as usize);
    Ok((size, all))
}

/// The same in numbers, whatever the depth.
fn numbers(bytes: &[u8], scale: i32, sweeps: Option<u32>) -> Result<(Size, Vec<[i32; 3]>), Error> {
    let source = bytes.iter().copied();
    if open(source.clone())?.header().deep {
        let (size, all) = pixels::<u16>(source, scale, sweeps)?;
        Ok((size, all.into_iter().map(|p| p.map(i32::from)).collect()))
    } else {
        let (size, all) = pixels::<u8>(source, scale, sweeps)?;
        Ok((size, all.into_iter().map(|p| p.map(i32::from)).collect()))
    }
}

fn checksum(pixels: &[[i32; 3]]) -> u32 {
    let bytes: Vec<u8> = pixels.iter().flatten().flat_map(|v| (*v as u16).to_le_bytes()).collect();
    crc32(&bytes)
}

#[test]
fn files_of_both_versions_decode_to_the_same_bits() {
    assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    for (version, files) in [(1, FILES_OF_VERSION_1), (2, FILES)] {
        let line = |(name, bytes): &(&str, &[u8])| {
            assert_eq!(bytes[4], version, "{name}");
            format!("{name} {:08x}\n", checksum(&numbers(bytes, 0, None).unwrap().1))
        };
        let got: String = files.iter().map(line).collect();
        let kept = format!("{}/vectors/version-{version}/checksums.txt", env!("CARGO_MANIFEST_DIR"));
        assert_eq!(got, std::fs::read_to_string(kept).unwrap(), "version {version}");
    }
}

/// Each sample that leaves `draw` is what the format's integers say, to the bit, and off from the formulas in
/// exact numbers by at most what its roundings let it be off, carried through maps and sweeps.
#[test]
fn samples_are_those_of_the_format_and_as_near_to_its_formulas_as_their_roundings_allow() {
    // what `draw` leaves in the picture
    let (mut differing, mut sharp, mut all) = (0, 0, 0);
    for (name, bytes) in FILES.into_iter().chain(FILES_OF_VERSION_1) {
        let (size, got) = numbers(bytes, 0, None).unwrap();
        let expected = decode(bytes);
        let (mut worst, mut square, mut allowed, mut most) = (0.0_f64, 0.0, 0.0, 0.0_f64);
        for (i, pixel) in got.iter().enumerate() {
            for (plane, (width, height, samples)) in expected.planes.iter().enumerate() {
                let (x, y) = (i % size.width as usize, i / size.width as usize);
                let halved = usize::from(*width < size.width as usize || *height < size.height as usize);
                let at = (y >> halved) * width + (x >> halved);
                let difference = (f64::from(pixel[plane]) - samples[at]).abs();
                let off = expected.off[plane][at];
                let exact = expected.exact[plane][at];
                assert_eq!(i64::from(pixel[plane]), exact, "{name} ({x}, {y}), plane {plane}");
                assert!(difference <= off, "{name} ({x}, {y}), plane {plane}: {difference}, allowed {off}");
                (worst, most) = (worst.max(difference), most.max(off));
                (square, allowed) = (square + difference * difference, allowed + off * off);
                differing += usize::from(difference > 0.0);
                sharp += usize::from(off == 0.0);
                all += 1;
            }
        }
        let count = (got.len() * expected.planes.len()) as f64;
        let mean = |square: f64| (square / count).sqrt();
        println!(
            "{name}: {worst} at most, {:.4} in the mean; allowed {most} and {:.4}",
            mean(square),
            mean(allowed)
        );
    }
    println!("{differing} of {all} samples differ, {sharp} must not");
    assert!(all > 180_000 && differing > 1000 && sharp > all / 3, "{differing} {sharp} of {all}");
}

#[test]
fn a_stream_is_a_field_whose_rows_come_in_any_order() {
    let all = ["streaming", "camera-streaming", "flat-8", "colour-halved"].map(|name| (name, file(name)));
    let odd: &[u8] = include_bytes!("vectors/odd-window.atfi");
    let all = all.into_iter().chain([("odd-window", odd)]);
    for (name, bytes, scale) in all.flat_map(|(name, bytes)| [0, -2, -1, 1].map(|scale| (name, bytes, scale)))
    {
        let (size, expected) = pixels::<u8>(bytes.iter().copied(), scale, None).unwrap();
        let mut memory = vec![0_u8; open(bytes.iter().copied()).unwrap().samples(scale)];
        let field = Streamed::new(bytes, scale, &mut memory).unwrap();
        assert_eq!(field.size(), size);
        let (width, height) = (size.width, size.height);
        let mut rows: Vec<u32> = (0..height).collect();
        rows.extend([height - 1, 0, height / 2, 0, height - 1]);
        for y in rows {
            let row: Vec<_> = field.row(y, 0..width).collect();
            assert_eq!(row, expected[(y * width) as usize..][..width as usize], "{name}, 2^{scale}: row {y}");
        }
        assert_eq!(field.at(width - 1, 0), expected[width as usize - 1]);
        let sixth = expected[..width as usize].get(5);
        assert_eq!(field.row(0, 3..width + 9).nth(2), sixth.copied());
        assert_eq!(field.error(), None);
        // on a display, in part and dithered
        let picture = Picture::<_, _, embedded_graphics::pixelcolor::Gray8>::new(Luma(&field), Grey);
        let column: Vec<_> = (0..height).map(|y| picture.colors(y, 1..2).unwrap().next().unwrap()).collect();
        for (y, color) in column.iter().enumerate() {
            use embedded_graphics::pixelcolor::GrayColor as _;
            assert_eq!(color.luma(), expected[y * width as usize + 1][0]);
        }
    }
}

#[test]
fn sweeps_begin_black_and_come_closer_to_their_fixed_point() {
    for name in ["iterated", "camera-iterated", "pure"] {
        let at = |sweeps| numbers(file(name), 0, Some(sweeps)).unwrap().1;
        let fixed = at(16);
        let distance = |sweeps| {
            let pairs = at(sweeps);
            pairs.iter().zip(&fixed).map(|(a, b)| f64::from(a[0] - b[0]).powi(2)).sum::<f64>()
                / pairs.len() as f64
        };
        assert!(at(0).iter().all(|pixel| *pixel == [0, 128, 128]));
        let distances: Vec<f64> = (0..6).map(distance).collect();
        println!("{name}: mean square distances {distances:.3?}");
        let closer = distances.windows(2).all(|pair| pair[1] <= 0.6 * pair[0] || pair[0] < 0.1);
        assert!(distances[0] > 1000.0 && distances[1] > 10.0 && closer, "{distances:?}");
        // 0.02 dB of what the encoder measured against the picture, 50 squared or more
        let reach = u32::from(check(file(name)).unwrap().reach);
        assert!(reach <= 4 && distance(reach) < 0.25, "{reach} sweeps: {}", distance(reach));
    }
}

/// Whatever depends on nothing that may change is drawn once: two sweeps are all where the encoder kept to
/// that.
#[test]
fn two_sweeps_settle_a_stream_that_was_made_for_two() {
    let at = |sweeps| numbers(file("camera-two-sweeps"), 0, Some(sweeps)).unwrap().1;
    let (one, two, nine) = (at(1), at(2), at(9));
    let changed = |a: &[[i32; 3]], b: &[[i32; 3]]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    let (late, left) = (changed(&one, &two), changed(&two, &nine));
    println!("{late} pixels in the second sweep, {left} later");
    assert!((500..20_000).contains(&late) && left < 300, "{late} {left}");
}

/// A stream by sweeps in so much memory beyond what it must have: after each of five its bytes taken so far
/// and its picture.
fn swept<S: Sample + Default + Debug>(bytes: &[u8], scale: i32, beyond: usize) -> Vec<(u32, Vec<[S; 3]>)> {
    let taken = Cell::new(0);
    let opened = open(Counted(bytes.iter().copied(), &taken)).unwrap();
    let mut memory = vec![S::default(); opened.samples(scale) + beyond];
    let mut sweeps = opened.sweeps(scale, &mut memory).unwrap();
    let size = sweeps.size();
    let mut after = |count| {
        assert_eq!(sweeps.sweep(), Ok(count));
        (
            taken.get(),
            (0..size.height).flat_map(|y| sweeps.row(y, 0..size.width).collect::<Vec<_>>()).collect(),
        )
    };
    (1..=5).map(&mut after).collect()
}

/// Memory beyond the picture's keeps the leaves that are not settled: then no sweep after the first reads the
/// stream, and each shows what it shows without. Returns how much that takes.
fn kept<S: Sample + Default + Debug + PartialEq>(name: &str, bytes: &[u8], scale: i32) -> usize {
    let read = swept::<S>(bytes, scale, 0);
    let whole = read[0].0;
    let enough = (0..1 << 14).collect::<Vec<_>>();
    let enough = enough.partition_point(|beyond| swept::<S>(bytes, scale, *beyond)[1].0 > whole);
    for beyond in [enough.saturating_sub(1), enough, enough + 999] {
        let got = swept::<S>(bytes, scale, beyond);
        for (sweep, (got, expected)) in got.iter().zip(&read).enumerate() {
            assert!(got.1 == expected.1, "{name}, 2^{scale}, {beyond} bytes: sweep {}", sweep + 1);
            assert_eq!(got.0 == whole, sweep == 0 || beyond >= enough, "{name}, {beyond} bytes");
        }
    }
    enough
}

#[test]
fn sweeps_over_kept_leaves_show_what_sweeps_over_the_stream_show() {
    for (name, least, most) in [("camera-iterated", 1700, 2100), ("camera-two-sweeps", 100, 200)] {
        let bytes = kept::<u8>(name, file(name), 0);
        println!("{name}: {bytes} bytes");
        assert!((least..=most).contains(&bytes), "{name}: {bytes}");
    }
    for name in ["iterated", "pure"] {
        let bytes = [-1, 0, 2].map(|scale| kept::<u8>(name, file(name), scale));
        // the same bins are as well a picture of 16 bits
        let deep = kept::<u16>(name, &forged(name, |bytes| bytes[5] |= 16), 0);
        println!("{name}: {bytes:?} bytes, {deep} of 16 bits");
        assert!(bytes[1] > 100 && deep > 100, "{name}: {bytes:?}, {deep}");
    }
}

/// Drawn `2^scale` times as large, each sample is what the integers say, to the bit; how many differ from the
/// formulas in exact numbers, by more than roundings allow, and how many there are.
fn compared(name: &str, bytes: &[u8], scale: i32) -> [usize; 3] {
    let (drawn, pixels) = numbers(bytes, scale, None).unwrap();
    let Size { width, height } = check(bytes).unwrap().size;
    let side = |v: u32| if scale > 0 { v << scale } else { (v + (1 << -scale) - 1) >> -scale };
    assert_eq!(drawn, Size::new(side(width), side(height)), "{name}, 2^{scale}");
    let expected = decode_scaled(bytes, scale);
    let [mut differing, mut wrong, mut all] = [0; 3];
    for (plane, (wide, high, samples)) in expected.planes.iter().enumerate() {
        let halved = usize::from(*wide < drawn.width as usize || *high < drawn.height as usize);
        for (i, pixel) in pixels.iter().enumerate() {
            let (x, y) = (i % drawn.width as usize, i / drawn.width as usize);
            // chroma that is halved is rounded up twice
            let at = (y >> halved).min(high - 1) * wide + (x >> halved).min(wide - 1);
            let place = format!("{name}, 2^{scale}: ({x}, {y}), plane {plane}");
            assert_eq!(i64::from(pixel[plane]), expected.exact[plane][at], "{place}");
            let difference = (f64::from(pixel[plane]) - samples[at]).abs();
            let off = expected.off[plane][at];
            differing += usize::from(difference > 0.0);
            wrong += usize::from(difference > off);
            all += 1;
        }
    }
    [differing, wrong, all]
}

#[test]
fn other_sizes_are_those_of_the_format_and_as_near_to_its_formulas_as_their_roundings_allow() {
    // what `draw` leaves in the picture, and `join` along the edges of what is larger
    for scale in [-2, -1, 1, 2] {
        let (mut differing, mut all) = (0, 0);
        for (name, bytes) in FILES {
            let [off, wrong, of] = compared(name, bytes, scale);
            assert_eq!(wrong, 0, "{name}, 2^{scale}");
            (differing, all) = (differing + off, all + of);
        }
        // steps of noise: terms are cut off, so that the formulas are no measure
        let mut random = Random::new(13);
        (0..200).for_each(|i| {
            compared(&format!("stream {i}"), &stream(&mut random, true).unwrap(), scale);
        });
        println!("2^{scale}: {differing} of {all} samples differ");
        assert!(differing < all / 8, "2^{scale}: {differing} of {all}");
    }
}

/// In a window of any rows above a band, drawn in any size, domains take what was drawn before, and no
/// more: also where the window's first row is no whole row of what is drawn (halved chroma, an odd number
/// of 8 rows, a quarter of the size).
#[test]
fn any_window_is_that_of_the_format_in_any_size() {
    let (mut random, mut highest) = (Random::new(21), 0);
    for (reach, planes) in
        (0..=8).flat_map(|r| [Planes::Grey, Planes::ColourHalved].map(|planes| (r, planes)))
    {
        for i in 0..12 {
            let header = Header {
                version: Header::VERSION,
                size: Size::new(33 + random.below(40) as u32, 65 + random.below(64) as u32),
                profile: Profile::Streaming,
                planes,
                deep: random.below(4) == 0,
                step: Step::from_bits(random.below(12 * 256) as u16).unwrap(),
                reach,
                chroma: if planes == Planes::Grey { 0 } else { 16 },
                payload: 0,
            };
            let bytes = stream_that_says(header, &mut random).unwrap();
            // larger ones round nothing
            for scale in -2..=if i == 0 { 2 } else { 0 } {
                compared(&format!("{header:?}"), &bytes, scale);
            }
            // domains that begin in the window's first rows
            let top = |leaf: &Leaf| (leaf.y / 32 * 16).checked_sub(usize::from(reach) * 4);
            let begins = |leaf: &&Leaf| leaf.domain.is_some_and(|(_, y, ..)| top(leaf) == Some(y));
            highest += decode(&bytes).leaves.iter().filter(begins).count();
        }
    }
    println!("{highest} domains begin at the top of their windows");
    assert!(highest > 200, "{highest}");
    // found by `cargo xtask fuzz-codec --seed 15`: 48 x 39, reach 3
    compared("odd window", include_bytes!("vectors/odd-window.atfi"), -2);
}

/// Bytes that are counted as they are taken.
#[derive(Clone)]
struct Counted<'a, I>(I, &'a Cell<u32>);

impl<I: Iterator<Item = u8>> Iterator for Counted<'_, I> {
    type Item = u8;
    fn next(&mut self) -> Option<u8> {
        self.1.set(self.1.get() + 1);
        self.0.next()
    }
}

/// Every prefix of a stream is an error that says so (lzma-rust2 103).
#[test]
fn a_file_cut_off_anywhere_says_that_it_ends_too_early() {
    let mut cut = 0;
    for name in ["streaming", "iterated", "pure", "colour-halved", "heights"] {
        let bytes = file(name);
        for length in 0..bytes.len() {
            let part = &bytes[..length];
            assert!(matches!(check(part), Err(Error::Ended { .. })), "{name} {length}");
            let end = numbers(part, 0, Some(1)).unwrap_err();
            assert!(matches!(end, Error::Ended { .. }), "{name} {length}: {end}");
            cut += 1;
        }
    }
    assert!(cut > 3000);
}

/// The bands before an error are those of the whole file; a field shows 0 below them, and says why.
#[test]
fn nothing_is_drawn_that_was_not_decoded() {
    let (bytes, mut shown) = (file("streaming"), std::collections::BTreeMap::new());
    let (size, whole) = pixels::<u8>(bytes.iter().copied(), 0, None).unwrap();
    let mut memory = vec![0_u8; open(bytes.iter().copied()).unwrap().samples(0)];
    for length in 19..bytes.len() {
        let mut stream = open(bytes[..length].iter().copied()).unwrap().stream(0, &mut memory).unwrap();
        let mut rows = 0;
        let error = loop {
            match stream.next_band() {
                Ok(Some(band)) => {
                    for y in 0..band.size().height {
                        let row = &whole[((rows + y) * size.width) as usize..][..size.width as usize];
                        assert!(
                            band.row(y, 0..size.width).eq(row.iter().copied()),
                            "{length} bytes, row {y}"
                        );
                    }
                    rows += band.size().height;
                }
                Ok(None) => panic!("{length} bytes are no picture"),
                Err(error) => break error,
            }
        };
        // it comes again, and nothing with it
        assert_eq!(stream.next_band().err(), Some(error));
        *shown.entry(rows).or_insert(0) += 1;
    }
    println!("{shown:?} rows of a cut file");
    assert_eq!(shown.keys().copied().collect::<Vec<_>>(), [0, 32, 64, 96, 128, 129]);
    // noise in the payload, with a right checksum: a domain lies where none may
    let mut refused = 0;
    for seed in 0..40_u8 {
        let bytes = forged("streaming", |bytes| bytes[400..].iter_mut().for_each(|byte| *byte ^= seed));
        let mut memory = vec![9_u8; open(bytes.iter().copied()).unwrap().samples(0)];
        let field = Streamed::new(&bytes, 0, &mut memory).unwrap();
        let last: Vec<_> = (0..size.height).map(|y| field.at(0, y)).collect();
        if let Some(error) = field.error() {
            assert!(matches!(error, Error::Malformed { .. }), "{error}");
            assert_eq!(last.last(), Some(&[0; 3]), "{seed}");
            assert_eq!(last[0], whole[0]);
            refused += 1;
        }
    }
    assert!(refused > 30, "{refused}");
}

#[test]
fn a_file_with_any_bit_flipped_is_refused_and_its_decoder_ends() {
    let (mut refused, mut kinds) = (0, std::collections::BTreeSet::new());
    for name in ["flat-8", "streaming", "iterated", "pure", "colour"] {
        let mut bytes = file(name).to_vec();
        for bit in 0..8 * bytes.len() {
            bytes[bit / 8] ^= 1 << (bit % 8);
            let error = check(&bytes).unwrap_err();
            kinds.insert(format!("{error:?}").split([' ', '{']).next().unwrap().to_owned());
            // whoever decodes all the same comes to an end; a picture of another size takes its time
            if bit >= 80 && bit % 3 == 0 || bit < 48 {
                assert!(numbers(&bytes, 0, Some(1)).is_err(), "{name}, bit {bit}");
            }
            bytes[bit / 8] ^= 1 << (bit % 8);
            refused += 1;
        }
    }
    println!("{refused} flipped: {kinds:?}");
    assert!(refused > 20_000 && kinds.len() >= 5, "{kinds:?}");
}

/// A header with a right checksum: `change` alters the bytes before it is made.
fn forged(name: &str, change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut bytes = file(name).to_vec();
    bytes.truncate(bytes.len() - 4);
    change(&mut bytes);
    let crc = crc32(&bytes);
    bytes.extend(crc.to_le_bytes());
    bytes
}

#[test]
fn what_no_header_says_is_refused_by_name() {
    let refused = |change: &dyn Fn(&mut Vec<u8>)| check(&forged("streaming", change)).unwrap_err();
    assert_eq!(refused(&|b| b[0] = b'a'), Error::Malformed { what: "image", position: 0 });
    assert_eq!(refused(&|b| b[3] = 0), Error::Malformed { what: "image", position: 3 });
    assert!(matches!(
        refused(&|b| b[4] = 3),
        Error::Unsupported { what: "version of an image", allowed: "1 and 2" }
    ));
    for flags in [3, 12, 32, 64, 128] {
        assert_eq!(refused(&|b| b[5] = flags), Error::Malformed { what: "image", position: 5 });
    }
    // no area, and 65,530 squared, which takes no work (weezl 75, astc-encoder 670)
    for (at, side, what) in
        [(6, 0_u16, "width"), (8, 0, "height"), (6, 65_530, "width"), (8, 65_530, "height")]
    {
        let error = refused(&|b| b[at..at + 2].copy_from_slice(&side.to_le_bytes()));
        assert!(matches!(error, Error::OutOfRange { what: named, .. } if named == what), "{error}");
    }
    assert_eq!(refused(&|b| b[11] = 24), Error::Malformed { what: "image", position: 11 });
    assert_eq!(refused(&|b| b[12] = 9), Error::Malformed { what: "image", position: 12 });
    assert_eq!(refused(&|b| b[13] = 1), Error::Malformed { what: "image", position: 13 });
    assert!(matches!(refused(&|b| b.push(0)), Error::LengthMismatch { what: "bytes of an image", .. }));
    assert!(matches!(refused(&|b| b[14..18].fill(255)), Error::Malformed { position: 17, .. }));
    let mut damaged = file("streaming").to_vec();
    *damaged.last_mut().unwrap() ^= 1;
    assert!(matches!(check(&damaged), Err(Error::Checksum { .. })));
    assert!(matches!(numbers(&damaged, 0, None), Err(Error::Checksum { .. })));
    // no sweeps in a picture that needs them
    let none = forged("iterated", |b| b[12] = 0);
    assert_eq!(check(&none), Err(Error::Malformed { what: "image", position: 12 }));
    // the largest size there is tells what it needs and takes nothing
    let large = forged("streaming", |b| b[6..10].copy_from_slice(&[0, 64, 0, 64]));
    let opened = open(large.iter().copied()).unwrap();
    let needed = opened.samples(0);
    assert_eq!(needed, 16384 * 32 + 8192 * 48 + 16384 + 4096);
    let error = opened.stream(0, &mut [0_u8; 100]).err();
    assert_eq!(error, Some(Error::BufferLength { what: "samples", given: 100, needed }));
}

#[test]
fn memory_one_sample_short_or_of_another_kind_is_refused() {
    for (name, bytes) in FILES {
        let opened = || open(bytes.iter().copied()).unwrap();
        let (deep, streaming) = (opened().header().deep, opened().header().profile == Profile::Streaming);
        for scale in -2..=2 {
            let needed = opened().samples(scale);
            let short = Some(Error::BufferLength { what: "samples", given: needed - 1, needed });
            let got = match (deep, streaming) {
                (false, true) => opened().stream(scale, &mut vec![0_u8; needed - 1]).err(),
                (false, false) => opened().sweeps(scale, &mut vec![0_u8; needed - 1]).err(),
                (true, _) => opened().stream(scale, &mut vec![0_u16; needed - 1]).err(),
            };
            assert_eq!(got, short, "{name} {scale}");
        }
        let mut memory = vec![0_u8; 1 << 20];
        let wrong = if streaming {
            opened().sweeps(0, &mut memory).err()
        } else {
            opened().stream(0, &mut memory).err()
        };
        assert!(matches!(wrong, Some(Error::Unsupported { .. })), "{name}");
        let wrong = opened().stream(3, &mut vec![0_u16; 1 << 20]).err();
        assert!(
            matches!(wrong, Some(Error::Unsupported { .. } | Error::OutOfRange { what: "scale", .. })),
            "{name}"
        );
    }
}

#[test]
fn an_endless_reader_is_read_to_the_end_of_the_picture_and_no_further() {
    for (name, bytes) in FILES {
        let taken = Cell::new(0);
        let endless = Counted(bytes.iter().copied().chain(std::iter::repeat(0xa5)), &taken);
        let size = match open(endless.clone()).unwrap().header().deep {
            false => pixels::<u8>(endless, 0, Some(1)).unwrap().0,
            true => pixels::<u16>(endless, 0, Some(1)).unwrap().0,
        };
        // the header twice, the rest once
        let header = bytes.len() as u32 - open(bytes.iter().copied()).unwrap().header().payload - 4;
        assert_eq!(taken.get(), bytes.len() as u32 + header, "{name}, {size}");
    }
    // nothing but noise, for ever
    for seed in 0..200_u32 {
        let mut state = seed;
        let noise = std::iter::from_fn(move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            Some((state >> 24) as u8)
        });
        let head = file("streaming")[..14].to_vec();
        let endless = head.into_iter().chain([255, 255, 255, 127]).chain(noise);
        assert!(pixels::<u8>(endless, 0, None).is_err(), "{seed}");
    }
}

/// Streams of tossed coins, of every profile, depth, kind of planes and reach, against the reference to the
/// bit.
#[test]
fn streams_that_no_encoder_wrote_decode_to_the_bits_of_the_format() {
    let mut random = Random::new(12);
    let (mut domains, mut kinds) = ([0; 3], std::collections::BTreeSet::new());
    for _ in 0..400 {
        let bytes = stream(&mut random, true).unwrap();
        let (size, got) = numbers(&bytes, 0, None).unwrap();
        let header = check(&bytes).unwrap();
        let expected = decode(&bytes);
        for (plane, (width, height, _)) in expected.planes.iter().enumerate() {
            let halved = usize::from(*width < size.width as usize || *height < size.height as usize);
            for (i, pixel) in got.iter().enumerate() {
                let (x, y) = (i % size.width as usize, i / size.width as usize);
                let exact = expected.exact[plane][(y >> halved) * width + (x >> halved)];
                assert_eq!(i64::from(pixel[plane]), exact, "({x}, {y}), plane {plane} of {header:?}");
            }
        }
        let below = expected.leaves.iter().filter(|leaf| leaf.domain.is_some() && leaf.y >= 32).count();
        domains[usize::from(bytes[5] & 3)] += below;
        kinds.insert((bytes[5] & 3, header.deep));
        kinds.insert((4 + header.reach, header.profile == Profile::Streaming));
        kinds.insert((bytes[5] >> 2 & 3 | 16, header.deep));
    }
    println!("{domains:?} domains below the first band, {} kinds", kinds.len());
    assert!(domains.iter().all(|count| *count >= 40) && kinds.len() == 6 + 17 + 6, "{domains:?} {kinds:?}");
}

/// Payloads of noise with a right checksum: a domain is where nothing is, a contrast the largest, a leaf
/// refers
/// to itself; all samples stay samples and all ends.
#[test]
fn forged_payloads_decode_or_are_refused() {
    let (mut drawn, mut refused) = (0, 0);
    for (name, _) in FILES {
        for seed in 0..60_u32 {
            let mut state = seed.wrapping_mul(2_654_435_761);
            let bytes = forged(name, |bytes| {
                for byte in bytes.iter_mut().skip(17) {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    if seed % 3 != 0 || state >> 29 == 0 {
                        *byte = (state >> 24) as u8;
                    }
                }
                if seed % 2 == 0 {
                    bytes[11] = (seed % 24) as u8;
                }
            });
            match numbers(&bytes, (seed % 5) as i32 - 2, Some(2)) {
                Ok(_) => drawn += 1,
                Err(Error::Malformed { .. }) => refused += 1,
                Err(error) => panic!("{name} {seed}: {error}"),
            }
        }
    }
    println!("{drawn} drawn, {refused} refused");
    assert!(drawn > 20 && refused > 100, "{drawn} {refused}");
}
