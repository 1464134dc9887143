//! The built-in scenes on the target are those of the command, pixel for pixel.

use std::collections::{BTreeMap, BTreeSet};

use attractor_workload::{CRC_32, Machine, scenes};
use embedded_graphics::geometry::Size;
use embedded_graphics::primitives::Rectangle;

/// Scene, colour, size and CRC-32 of the display's bytes, as the command draws it.
const GOLDENS: &str = include_str!("../../../host-sim/tests/goldens.txt");

const LATTICE: &str = "its lattice of 257 x 257 heights takes 258 KiB of RAM, twice what there is";

/// Scenes of the command that the target does not draw, in one colour or at all, and why.
const MISSING: &[(&str, &str)] = &[
    ("lens", LONG),
    ("glass-spheres", LONG),
    ("fish-bowl-outside", LONG),
    ("fish-bowl-inside", LONG),
    ("chain", LONG),
    ("superellipsoids", LONG),
    ("wood", LONG),
    ("marble", LONG),
    ("cloth", LONG),
    ("figure-7-jittered", LONG),
    ("island", LATTICE),
    ("flight", LATTICE),
    ("jacksboro", LATTICE),
    ("patch-joinings rgb565", LONG),
    ("patch-rock rgb565", LONG),
    ("patch-diagonal rgb565", LONG),
    ("patch-mountain rgb565", LONG),
    ("figure-6-without-grain rgb565", LONG),
];
/// Up to 16 rays a pixel, and as many again as there are bounces; or surfaces by control points, point by
/// point.
const LONG: &str = "the emulator would take minutes for it";

/// A display with pixels.
struct Frame {
    size: Size,
    bits: u8,
    pixels: Vec<u16>,
}

impl Machine for Frame {
    fn instructions(&mut self) -> u32 {
        0
    }

    fn pixels(&mut self, area: Rectangle, offset: usize, colours: &[u16]) {
        let (width, columns) = (self.size.width as usize, area.size.width as usize);
        for (i, colour) in (offset..).zip(colours) {
            let (x, y) = (area.top_left.x as usize + i % columns, area.top_left.y as usize + i / columns);
            self.pixels[y * width + x] = *colour;
        }
    }
}

impl Frame {
    /// What a driver would send: 16 bits big-endian, or packed bits with the leftmost pixel highest.
    fn crc(&self) -> String {
        let bytes: Vec<u8> = if self.bits == 1 {
            let packed = |byte: &[u16]| byte.iter().fold(0, |byte, pixel| byte << 1 | *pixel as u8);
            self.pixels.chunks(8).map(packed).collect()
        } else {
            self.pixels.iter().flat_map(|pixel| pixel.to_be_bytes()).collect()
        };
        format!("{:08x}", CRC_32.checksum(&bytes))
    }
}

#[test]
fn the_target_draws_what_the_command_draws() {
    let mut goldens = BTreeMap::new();
    for line in GOLDENS.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<_> = line.split(' ').collect();
        goldens.insert((words[0], words[1]), words[3]);
    }
    let mut drawn = 0;
    let mut different = Vec::new();
    for scene in scenes::TABLES.iter().flat_map(|(_, table)| *table) {
        let key = (scene.name, if scene.bits == 1 { "mono" } else { "rgb565" });
        let Some(golden) = goldens.remove(&key) else { continue };
        let pixels = vec![0; (scene.size.width * scene.size.height) as usize];
        let mut frame = Frame { size: scene.size, bits: scene.bits, pixels };
        scene.run(&mut frame).unwrap_or_else(|failure| panic!("{key:?}: {failure}"));
        if frame.crc() != golden {
            different.push(key);
        }
        drawn += 1;
    }
    assert!(different.is_empty(), "other pixels than the command's: {different:#?}");
    assert!(drawn >= 97, "{drawn}");
    let excuse = |(name, color): &(&str, &str)| {
        MISSING.iter().position(|(key, _)| key == name || *key == format!("{name} {color}"))
    };
    let left: Vec<_> = goldens.keys().filter(|key| excuse(key).is_none()).collect();
    assert!(left.is_empty(), "neither drawn on the target nor excused: {left:#?}");
    let excused: BTreeSet<_> = goldens.keys().filter_map(excuse).collect();
    assert_eq!(excused.len(), MISSING.len(), "some are excused and drawn all the same");
}
