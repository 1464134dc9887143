//! What `encode` is asked for that cannot be: one line that says what, where, which value and what is
//! allowed, exit code 2, and nothing is written; and what lies just inside of what is allowed.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use png::{BitDepth, ColorType};
use tempfile::TempDir;

use crate::common::{Said, attractor_in, decode, good, text};

/// A PNG file of zeros, or of `data` over and over.
fn png(path: &Path, size: (u32, u32), color: ColorType, depth: BitDepth, data: &[u8]) {
    let mut encoder = png::Encoder::new(fs::File::create(path).unwrap(), size.0, size.1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ColorType::Indexed {
        encoder.set_palette(vec![200, 100, 0]);
        encoder.set_trns(vec![128]);
    }
    let length = ((size.0 as usize * color.samples() * depth as usize).div_ceil(8)) * size.1 as usize;
    let bytes: Vec<u8> = data.iter().copied().cycle().take(length).collect();
    encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
}

/// A directory with a good picture, `in.png`.
fn room() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    png(&directory.path().join("in.png"), (24, 20), ColorType::Grayscale, BitDepth::Eight, &[7, 200, 90]);
    good(directory.path(), &["encode", "in.png", "-o", "out.atfi", "--psnr", "30"]);
    fs::remove_file(directory.path().join("out.atfi")).unwrap();
    directory
}

/// What is said of a command that is refused; the directory stays as it is.
fn refused(said: &mut Said, dir: &Path, args: &[&str]) {
    let names = || {
        let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let before = names();
    said.command(dir, args);
    assert_eq!(names(), before, "{args:?} wrote something");
}

/// Each with the rest of a good command.
fn options(cases: &[&[&str]]) -> Said {
    let (directory, mut said) = (room(), Said::default());
    for case in cases {
        refused(&mut said, directory.path(), &[&["encode", "in.png", "-o", "out.atfi"], *case].concat());
    }
    said
}

#[test]
fn files_that_are_no_picture_are_refused() {
    let (directory, mut said) = (room(), Said::default());
    let dir = directory.path();
    let encode = |said: &mut Said, name| {
        refused(said, dir, &["encode", name, "-o", "out.atfi", "--bytes", "100"]);
    };
    fs::create_dir(dir.join("room.png")).unwrap();
    fs::write(dir.join("empty.png"), b"").unwrap();
    fs::write(dir.join("text.png"), b"no picture\n").unwrap();
    fs::write(dir.join("jpeg.png"), b"\xff\xd8\xff\xe0\0\x10JFIF\0").unwrap();
    let whole = fs::read(dir.join("in.png")).unwrap();
    fs::write(dir.join("header.png"), &whole[..20]).unwrap();
    fs::write(dir.join("short.png"), &whole[..whole.len() - 20]).unwrap();
    let mut flipped = whole;
    flipped[20] ^= 1;
    fs::write(dir.join("flipped.png"), flipped).unwrap();
    png(&dir.join("wide.png"), (16385, 1), ColorType::Grayscale, BitDepth::One, &[0]);
    png(&dir.join("high.png"), (1, 16385), ColorType::Grayscale, BitDepth::One, &[0]);
    png(&dir.join("rgb16.png"), (2, 1), ColorType::Rgb, BitDepth::Sixteen, &[0]);
    png(&dir.join("alpha16.png"), (2, 1), ColorType::GrayscaleAlpha, BitDepth::Sixteen, &[0]);
    let mut encoder = png::Encoder::new(fs::File::create(dir.join("moving.png")).unwrap(), 2, 2);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    (0..2).for_each(|_| writer.write_image_data(&[1, 2, 3, 4]).unwrap());
    writer.finish().unwrap();
    for name in ["none.png", "room.png", "empty.png", "text.png", "jpeg.png", "header.png", "short.png"] {
        encode(&mut said, name);
    }
    for name in ["flipped.png", "wide.png", "high.png", "rgb16.png", "alpha16.png", "moving.png"] {
        encode(&mut said, name);
    }
    assert_snapshot!(said);
}

#[test]
fn targets_that_cannot_be_are_refused() {
    assert_snapshot!(options(&[
        &[],
        &["--bytes", "0"],
        &["--bytes", "-1"],
        &["--bytes", "1e3"],
        &["--bytes", "268435457"],
        &["--bpp", "0"],
        &["--bpp", "-1"],
        &["--bpp", "nan"],
        &["--bpp", "inf"],
        &["--bpp", "64.1"],
        &["--psnr", "0"],
        &["--psnr", "-3"],
        &["--psnr", "200"],
        &["--psnr", "loud"],
        &["--bytes", "100", "--psnr", "30"],
    ]));
}

#[test]
fn options_of_an_encoder_outside_what_there_is_are_refused() {
    let all = |case: &[&'static str]| [case, &["--bytes", "100"]].concat();
    let cases = [
        all(&["--profile", "steaming"]),
        all(&["--effort", "slow"]),
        all(&["--profile", "pure", "--sweeps", "0"]),
        all(&["--profile", "pure", "--sweeps", "9"]),
        all(&["--sweeps", "3"]),
        all(&["--without", "everything"]),
        all(&["--ground", "red"]),
        all(&["--ground", "#12345"]),
    ];
    assert_snapshot!(options(&cases.each_ref().map(Vec::as_slice)));
}

#[test]
fn streams_that_cannot_be_written_are_named() {
    let (directory, mut said) = (room(), Said::default());
    fs::create_dir(directory.path().join("room")).unwrap();
    for output in ["nowhere/out.atfi", "room", "in.png/out.atfi", ""] {
        refused(&mut said, directory.path(), &["encode", "in.png", "-o", output, "--bytes", "100"]);
    }
    refused(&mut said, directory.path(), &["encode", "in.png", "--bytes", "100"]);
    assert_snapshot!(said);
}

/// Flat pictures, so that what comes back is off by no more than what a pixel of `YCoCg` and its steps are
/// rounded by.
#[test]
fn what_shines_through_shows_the_ground_that_was_named() {
    let directory = room();
    let dir = directory.path();
    let cases: [(&str, ColorType, &[u8], [u8; 3]); 3] = [
        // (v 128 + ground 127 + 127) / 255, ground #3264c8
        ("rgba.png", ColorType::Rgba, &[200, 100, 0, 128], [125, 100, 100]),
        ("grey-alpha.png", ColorType::GrayscaleAlpha, &[200, 128], [125, 150, 200]),
        ("palette.png", ColorType::Indexed, &[0], [125, 100, 100]),
    ];
    for (name, color, data, want) in cases {
        png(&dir.join(name), (9, 9), color, BitDepth::Eight, data);
        let ground = ["--ground", "#3264c8", "--psnr", "45", "--full-chroma"];
        good(dir, &[&["encode", name, "-o", "out.atfi"], &ground[..]].concat());
        good(dir, &["decode", "out.atfi", "-o", "back.png"]);
        let back = decode(&dir.join("back.png"));
        assert_eq!(back.color, ColorType::Rgb, "{name}");
        let near = |p: &[u8]| p.iter().zip(want).all(|(a, b)| a.abs_diff(b) <= 2);
        assert!(back.data.chunks_exact(3).all(near), "{name}: {:?}, wanted {want:?}", &back.data[..3]);
    }
}

#[test]
fn the_smallest_and_the_longest_pictures_are_encoded() {
    let directory = room();
    let dir = directory.path();
    for (size, profile) in [((1, 1), "streaming"), ((1, 16384), "streaming"), ((16384, 1), "iterated")] {
        png(&dir.join("long.png"), size, ColorType::Grayscale, BitDepth::Eight, &[7, 9, 30, 22, 90]);
        for target in [["--bpp", "2"], ["--psnr", "40"]] {
            let args = ["encode", "long.png", "-o", "out.atfi", "--profile", profile, "--effort", "fast"];
            let output = attractor_in(dir, &[&args[..], &target].concat());
            assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
            good(dir, &["decode", "out.atfi", "-o", "back.png"]);
            assert_eq!(decode(&dir.join("back.png")).size, size);
        }
    }
}

#[test]
fn targets_of_bits_and_decibels_are_met_within_1_per_cent() {
    let directory = room();
    let dir = directory.path();
    // waves with noise that grows: everywhere the same, all of it would be worth its bits at one step
    let value = |x: u32, y: u32| {
        let wave = 60.0 * (f64::from(x) * 0.11).sin() + 40.0 * (f64::from(y) * 0.07).cos();
        let hash = (x * 374_761 + y * 66_826 + 1)
            .wrapping_mul(0x9e37_79b9)
            .rotate_left(13)
            .wrapping_mul(0x85eb_ca6b);
        (110.0 + wave + f64::from((hash >> 8) % 41) * f64::from(x) / 128.0) as u8
    };
    let data: Vec<u8> = (0..96).flat_map(|y| (0..128).map(move |x| value(x, y))).collect();
    png(&dir.join("waves.png"), (128, 96), ColorType::Grayscale, BitDepth::Eight, &data);
    let number = |said: &str, before: &str| -> f64 {
        let rest = said.split(before).nth(1).and_then(|rest| rest.split([' ', ',']).next());
        rest.unwrap().parse().unwrap()
    };
    for bpp in [0.4, 1.0, 2.5] {
        let said = good(dir, &["encode", "waves.png", "-o", "out.atfi", "--bpp", &bpp.to_string()]);
        let length = fs::metadata(dir.join("out.atfi")).unwrap().len() as f64;
        let wanted = bpp * 1536.0;
        assert!(length <= wanted && length >= 0.99 * wanted - 1.0, "{bpp}: {said}");
    }
    for decibels in [28.0, 33.0, 41.0] {
        let said = good(dir, &["encode", "waves.png", "-o", "out.atfi", "--psnr", &decibels.to_string()]);
        let got = number(&said, "PSNR ");
        assert!(got >= decibels - 0.005 && got <= 1.01 * decibels, "{decibels}: {said}");
    }
}
