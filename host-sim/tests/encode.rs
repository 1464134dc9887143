//! `encode`, `decode` and `inspect`: targets are met, pictures of every size and kind come back, bad input is
//! named.

use std::fs;
use std::path::Path;

use crate::common::{attractor_in, bad, decode, good, text};

/// A PNG file.
fn png(path: &Path, size: (u32, u32), color: png::ColorType, depth: png::BitDepth, data: &[u8]) {
    let file = fs::File::create(path).unwrap();
    let mut encoder = png::Encoder::new(file, size.0, size.1);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == png::ColorType::Indexed {
        encoder.set_palette(vec![10, 20, 30, 200, 100, 50]);
        encoder.set_trns(vec![255, 0]);
    }
    encoder.write_header().unwrap().write_image_data(data).unwrap();
}

/// Something with edges, slopes and grain.
fn scene(width: u32, height: u32) -> Vec<u8> {
    let value = |x: u32, y: u32| {
        let disc = (x as i32 - 30).pow(2) + (y as i32 - 25).pow(2) < 300;
        let grain = (x * 7919 + y * 104_729 + x * y * 31) % 13;
        (if disc { 200 } else { 40 + x + y / 2 } + grain).min(255) as u8
    };
    (0..height).flat_map(|y| (0..width).map(move |x| value(x, y))).collect()
}

fn grey(path: &Path, width: u32, height: u32, data: &[u8]) {
    png(path, (width, height), png::ColorType::Grayscale, png::BitDepth::Eight, data);
}

fn psnr(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let square: f64 = a.iter().zip(b).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
    10.0 * (65025.0 * a.len() as f64 / square).log10()
}

/// Sizes at which others wrote past the end or lost a row (fractal-image-compression 8, libheif 130, openmv
/// 6).
#[test]
fn pictures_of_any_size_come_back_in_that_size() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    let sizes = [(1, 1), (1, 67), (129, 1), (2, 3), (7, 8), (31, 33), (33, 31), (64, 32), (67, 129)];
    for (i, (width, height)) in sizes.into_iter().enumerate() {
        let data = scene(width, height);
        grey(&dir.join("in.png"), width, height, &data);
        let profile = ["streaming", "iterated", "pure"][i % 3];
        // maps alone come less close
        let (wanted, least) = if profile == "pure" { ("25", 24.9) } else { ("34", 33.9) };
        good(
            dir,
            &[
                "encode",
                "in.png",
                "-o",
                "out.atfi",
                "--psnr",
                wanted,
                "--profile",
                profile,
                "--effort",
                "fast",
            ],
        );
        good(dir, &["decode", "out.atfi", "-o", "back.png"]);
        let back = decode(&dir.join("back.png"));
        assert_eq!((back.size, back.color), ((width, height), png::ColorType::Grayscale));
        let got = psnr(&data, &back.data);
        assert!(got >= least, "{width} x {height}, {profile}: {got}");
        for (scale, up, down) in [("2", 2, 1), ("1/4", 1, 4)] {
            good(dir, &["decode", "out.atfi", "-o", "scaled.png", "--scale", scale]);
            let size = decode(&dir.join("scaled.png")).size;
            assert_eq!(size, ((width * up).div_ceil(down), (height * up).div_ceil(down)));
        }
    }
}

/// FLIF 370.
#[test]
fn flat_pictures_come_back_exactly_in_at_most_40_bytes() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    for value in [0, 128, 255, 77] {
        for (width, height) in [(1, 1), (384, 303)] {
            let data = vec![value; (width * height) as usize];
            grey(&dir.join("in.png"), width, height, &data);
            good(dir, &["encode", "in.png", "-o", "out.atfi", "--psnr", "99", "--effort", "fast"]);
            assert!(fs::metadata(dir.join("out.atfi")).unwrap().len() <= 40, "{value}");
            good(dir, &["decode", "out.atfi", "-o", "back.png"]);
            assert!(decode(&dir.join("back.png")).data == data, "{value}");
        }
    }
}

#[test]
fn targets_are_met_and_what_is_out_of_reach_is_said() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    grey(&dir.join("in.png"), 97, 90, &scene(97, 90));
    for profile in ["streaming", "iterated", "pure"] {
        // a byte is a fifth of a per cent below 1,000; maps alone do not make use of many
        let most = if profile == "pure" { 600 } else { 3000 };
        for (bytes, part) in [(600_u64, 0.985), (1500, 0.99), (3000, 0.99)] {
            if bytes > most {
                continue;
            }
            let wanted = bytes.to_string();
            let said =
                good(dir, &["encode", "in.png", "-o", "out.atfi", "--bytes", &wanted, "--profile", profile]);
            let length = fs::metadata(dir.join("out.atfi")).unwrap().len();
            assert!(length <= bytes && length as f64 >= part * bytes as f64, "{profile} {bytes}: {length}");
            assert!(said.contains(&format!("{length} bytes")) && said.contains("MS-SSIM 0."), "{said}");
        }
    }
    let said = attractor_in(dir, &["encode", "in.png", "-o", "out.atfi", "--bytes", "1"]);
    let length = fs::metadata(dir.join("out.atfi")).unwrap().len();
    let complaint = text(&said.stderr);
    assert!(
        complaint.contains(&format!("the smallest file of this picture has {length}")) && length < 40,
        "{complaint}"
    );
    assert_eq!(said.status.code(), Some(0));
    let out = good(dir, &["inspect", "out.atfi", "-o", "squares.png"]);
    assert!(out.contains("97 x 90, Grey, 8 bits, streaming") && out.contains("side"), "{out}");
    assert_eq!(decode(&dir.join("squares.png")).size, (97, 90));
    good(dir, &["decode", "out.atfi", "-o", "mono.png", "--color", "mono"]);
    assert_eq!(decode(&dir.join("mono.png")).depth, png::BitDepth::One);
}

/// No detail is invented, but a picture at twice the size is no worse than its pixels twice as large: not by
/// its edges, and by far not where it is smooth, as its leaves are joined there (without that 8.5 dB).
#[test]
fn twice_the_size_is_nearer_than_the_nearest_pixel() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    let (w, h) = (96_usize, 80_usize);
    // what the picture is a half of
    let disc = |x: usize, y: usize| {
        let disc = (x as i32 - 90).pow(2) + (y as i32 - 70).pow(2) < 2500;
        let wave = (20.0 * (0.09 * x as f64).sin() * (0.07 * y as f64).cos()) as i32;
        (if disc { 190 } else { 60 + x as i32 / 3 + wave }).clamp(0, 255) as u8
    };
    let rings = |x: usize, y: usize| {
        let square = (x as i32 - 90).pow(2) + (y as i32 - 70).pow(2);
        (128.0 + 60.0 * (0.9 * f64::from(square).sqrt()).sin()) as u8
    };
    let pictures: [(&dyn Fn(usize, usize) -> u8, _, _); 2] = [(&disc, "0.8", 2.0), (&rings, "1.5", 8.75)];
    for (value, rate, gain) in pictures {
        let whole: Vec<u8> = (0..2 * h).flat_map(|y| (0..2 * w).map(move |x| value(x, y))).collect();
        let at = |x: usize, y: usize| u32::from(whole[y * 2 * w + x]);
        let mean = |i: usize| {
            let (x, y) = (2 * (i % w), 2 * (i / w));
            ((at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1) + 2) / 4) as u8
        };
        let half: Vec<u8> = (0..w * h).map(mean).collect();
        grey(&dir.join("in.png"), w as u32, h as u32, &half);
        for profile in ["streaming", "iterated"] {
            good(dir, &["encode", "in.png", "-o", "out.atfi", "--bpp", rate, "--profile", profile]);
            good(dir, &["decode", "out.atfi", "-o", "one.png"]);
            good(dir, &["decode", "out.atfi", "-o", "two.png", "--scale", "2"]);
            let (one, two) = (decode(&dir.join("one.png")).data, decode(&dir.join("two.png")).data);
            let nearest: Vec<u8> = (0..4 * w * h).map(|i| one[i / (4 * w) * w + i % (2 * w) / 2]).collect();
            let (scaled, nearest) = (psnr(&whole, &two), psnr(&whole, &nearest));
            println!("{profile}: {scaled:.2} dB, nearest {nearest:.2} dB");
            assert!(scaled > nearest + gain && nearest > 22.0, "{profile}: {scaled} {nearest}");
        }
    }
}

#[test]
fn colour_palettes_transparency_and_16_bits_are_encoded() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    let (w, h) = (40_u32, 36_u32);
    let luma = scene(w, h);
    let rgb: Vec<u8> = luma.iter().flat_map(|v| [*v, 255 - v, v / 2]).collect();
    png(&dir.join("rgb.png"), (w, h), png::ColorType::Rgb, png::BitDepth::Eight, &rgb);
    good(dir, &["encode", "rgb.png", "-o", "rgb.atfi", "--psnr", "36", "--full-chroma"]);
    good(dir, &["decode", "rgb.atfi", "-o", "back.png"]);
    let back = decode(&dir.join("back.png"));
    assert!(back.color == png::ColorType::Rgb && psnr(&rgb, &back.data) > 35.9);
    // colours that change from pixel to pixel are gone where chroma is halved
    let dots: Vec<u8> = (0..w * h).flat_map(|i| [255 * (i % 3 == 0) as u8, 128, (i * 77) as u8]).collect();
    png(&dir.join("dots.png"), (w, h), png::ColorType::Rgb, png::BitDepth::Eight, &dots);
    let target = ["encode", "dots.png", "-o", "dots.atfi", "--psnr", "40"];
    let said = attractor_in(dir, &target);
    assert!(said.status.success());
    let said = text(&said.stderr);
    assert!(said.contains("40 dB are out of reach") && said.contains("--full-chroma keeps"), "{said}");
    let said = attractor_in(dir, &[&target[..], &["--full-chroma"]].concat());
    assert!(said.status.success() && !text(&said.stderr).contains("chroma"), "{}", text(&said.stderr));
    // one colour and one that is transparent, on the ground that was named
    let bits: Vec<u8> =
        (0..h).flat_map(|y| (0..w / 8).map(move |x| if (x + y / 8) % 2 == 0 { 0 } else { 255 })).collect();
    png(&dir.join("two.png"), (w, h), png::ColorType::Indexed, png::BitDepth::One, &bits);
    good(
        dir,
        &["encode", "two.png", "-o", "two.atfi", "--psnr", "40", "--full-chroma", "--ground", "#0000ff"],
    );
    good(dir, &["decode", "two.atfi", "-o", "back.png"]);
    let back = decode(&dir.join("back.png"));
    let near =
        |at: usize, to: [u8; 3]| back.data[3 * at..][..3].iter().zip(to).all(|(a, b)| a.abs_diff(b) < 24);
    assert!(near(4 * 40 + 4, [10, 20, 30]) && near(4 * 40 + 12, [0, 0, 255]), "{:?}", &back.data[480..520]);
    // heights
    let deep: Vec<u16> =
        (0..h).flat_map(|y| (0..w).map(move |x| 20_000 + 300 * x as u16 + y as u16 * y as u16)).collect();
    let bytes: Vec<u8> = deep.iter().flat_map(|v| v.to_be_bytes()).collect();
    png(&dir.join("deep.png"), (w, h), png::ColorType::Grayscale, png::BitDepth::Sixteen, &bytes);
    good(dir, &["encode", "deep.png", "-o", "deep.atfi", "--psnr", "70"]);
    good(dir, &["decode", "deep.atfi", "-o", "back.png"]);
    let back = decode(&dir.join("back.png"));
    assert_eq!(back.depth, png::BitDepth::Sixteen);
    let got: Vec<u16> = back.data.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
    let square: f64 = deep.iter().zip(&got).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
    assert!((square / got.len() as f64).sqrt() < 65535.0 / 10_f64.powf(3.49), "{square}");
}

#[test]
fn what_is_no_picture_or_no_stream_is_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    grey(&dir.join("in.png"), 9, 9, &scene(9, 9));
    fs::write(dir.join("no.png"), b"no picture").unwrap();
    let file = fs::File::create(dir.join("moving.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_animated(2, 0).unwrap();
    let mut writer = encoder.write_header().unwrap();
    (0..2).for_each(|_| writer.write_image_data(&[1, 2, 3, 4]).unwrap());
    writer.finish().unwrap();
    png(&dir.join("deep.png"), (2, 1), png::ColorType::Rgb, png::BitDepth::Sixteen, &[0; 12]);
    let refused = |args: &[&str], named: &[&str]| {
        let said = bad(dir, args);
        assert!(named.iter().all(|part| said.contains(part)), "{args:?}: {said}");
        assert!(!dir.join("out.atfi").exists() && !dir.join("out.png").exists());
    };
    let encode = |image: &'static str| ["encode", image, "-o", "out.atfi", "--bytes", "100"];
    refused(&encode("none.png"), &["none.png"]);
    refused(&encode("no.png"), &["no.png", "no PNG file"]);
    refused(&encode("moving.png"), &["moving.png", "animated"]);
    refused(&encode("deep.png"), &["deep.png", "16 bits"]);
    refused(&["encode", "in.png", "-o", "out.atfi"], &["--bytes"]);
    refused(&["encode", "in.png", "-o", "out.atfi", "--bytes", "0"], &["--bytes"]);
    refused(&["encode", "in.png", "-o", "out.atfi", "--bpp", "-1"], &["--bpp", "no number above 0"]);
    refused(&["encode", "in.png", "-o", "nowhere/out.atfi", "--bytes", "100"], &["nowhere"]);
    refused(&["decode", "in.png", "-o", "out.png"], &["in.png", "no image", "byte 0"]);
    good(dir, &["encode", "in.png", "-o", "fine.atfi", "--psnr", "30"]);
    let bytes = fs::read(dir.join("fine.atfi")).unwrap();
    fs::write(dir.join("short.atfi"), &bytes[..bytes.len() - 1]).unwrap();
    fs::write(dir.join("long.atfi"), [&bytes[..], b"x"].concat()).unwrap();
    let mut damaged = bytes;
    damaged[16] ^= 4;
    fs::write(dir.join("damaged.atfi"), damaged).unwrap();
    for command in ["decode", "inspect"] {
        refused(&[command, "short.atfi", "-o", "out.png"], &["short.atfi", "ends too early"]);
        refused(&[command, "long.atfi", "-o", "out.png"], &["long.atfi", "bytes of an image given"]);
        refused(&[command, "damaged.atfi", "-o", "out.png"], &["damaged.atfi", "checksum"]);
    }
    refused(&["decode", "fine.atfi", "-o", "out.png", "--scale", "3"], &["--scale", "1/4"]);
    refused(&["decode", "fine.atfi", "-o", "out.png", "--sweeps", "2"], &["--sweeps", "one pass"]);
}

/// A stream lies beside the photograph that it was made of.
#[test]
fn a_picture_that_is_there_is_replaced_only_where_it_was_named() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    grey(&dir.join("photo.png"), 9, 9, &scene(9, 9));
    good(dir, &["encode", "photo.png", "-o", "photo.atfi", "--psnr", "30"]);
    let photograph = fs::read(dir.join("photo.png")).unwrap();
    let said = bad(dir, &["decode", "photo.atfi"]);
    assert!(said.contains("photo.png: it is there already") && said.contains("-o FILE.png"), "{said}");
    assert_eq!(fs::read(dir.join("photo.png")).unwrap(), photograph);
    assert_eq!(fs::read_dir(dir).unwrap().count(), 2);
    good(dir, &["decode", "photo.atfi", "-o", "photo.png"]);
    assert_ne!(fs::read(dir.join("photo.png")).unwrap(), photograph);
    fs::remove_file(dir.join("photo.png")).unwrap();
    good(dir, &["decode", "photo.atfi"]);
    assert_eq!(decode(&dir.join("photo.png")).size, (9, 9));
}

/// No other format is written: a name that says so would mislead.
#[test]
fn pictures_have_names_of_png_files() {
    let directory = tempfile::tempdir().unwrap();
    let dir = directory.path();
    grey(&dir.join("in.png"), 9, 9, &scene(9, 9));
    good(dir, &["encode", "in.png", "-o", "in.atfi", "--psnr", "30"]);
    for command in ["decode", "inspect"] {
        for name in ["out.jpg", "out", "-", "out.png.atfi"] {
            let said = bad(dir, &[command, "in.atfi", "-o", name]);
            assert!(said.contains(&format!("--output {name}: pictures are PNG files")), "{said}");
        }
        assert_eq!(fs::read_dir(dir).unwrap().count(), 2);
        good(dir, &[command, "in.atfi", "-o", "out.PNG"]);
        fs::remove_file(dir.join("out.PNG")).unwrap();
    }
}
