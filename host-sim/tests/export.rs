//! `attractor export`: what it writes are modules that firmware compiles, with the bits that the command
//! draws with.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::{bad, decode, good};
use crate::exported::{self, corner, near_seahorses, periods, polynomials, stopped, turtle, two_factors};
use attractor::curve::Subdivision;
use attractor::draw::{Ink, Palette, Picture, Srgb};
use attractor::escape::OrbitPoint;
use attractor::fif::{Cell, Pyramid};
use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::{Real, Unit, Wide};
use attractor::plane::{Field, PathElement};
use attractor::trace::{Extent, HeightField};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::{BinaryColor, Gray8, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::SimulatorDisplay;

/// The modules that the target is built with; `benches/workload/tests/built_in.rs` holds the picture of each
/// to the command's.
const TARGET: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../benches/workload/src/exported");

fn modules(directory: &Path) -> BTreeMap<PathBuf, String> {
    let files = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path());
    files.map(|path| (path.file_name().unwrap().into(), fs::read_to_string(&path).unwrap())).collect()
}

/// A scene was changed? `ATTRACTOR_BLESS=1 cargo test -p attractor-sim --test suite export` writes the
/// modules again.
#[test]
fn the_modules_of_the_target_are_what_the_command_writes() {
    let directory = tempfile::tempdir().unwrap();
    let printed = good(directory.path(), &["export", "--all", "--gallery", "-o", "here"]);
    let (written, target) = (modules(&directory.path().join("here")), Path::new(TARGET));
    assert_eq!(printed.lines().count(), written.len());
    if std::env::var_os("ATTRACTOR_BLESS").is_some() {
        modules(target).keys().for_each(|old| fs::remove_file(target.join(old)).unwrap());
        written.iter().for_each(|(file, text)| fs::write(target.join(file), text).unwrap());
        return;
    }
    let kept = modules(target);
    let names = written.keys().chain(kept.keys()).filter(|name| written.get(*name) != kept.get(*name));
    let stale: BTreeSet<_> = names.collect();
    assert!(stale.is_empty(), "not what `attractor export --all --gallery` writes now: {stale:?}");
}

/// As for the target.
#[test]
fn the_modules_of_these_tests_are_what_the_command_writes() {
    let here = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/exported"));
    for (name, text) in exported::FILES {
        let written = good(here, &["export", &format!("{name}.toml")]);
        if std::env::var_os("ATTRACTOR_BLESS").is_some() {
            fs::write(here.join(name.replace('-', "_") + ".rs"), &written).unwrap();
            continue;
        }
        assert_eq!(written, text, "{name}");
    }
}

/// A scene file of these tests.
fn file(name: &str) -> String {
    format!("{}/tests/exported/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// The pixels of a picture that core alone draws.
fn drawn<C, F, P>(field: F, palette: P) -> Vec<Rgb888>
where
    C: Ink + From<BinaryColor> + Into<Rgb888>,
    F: Field,
    P: Palette<F::Value>,
{
    let mut display = SimulatorDisplay::<C>::new(field.size());
    let picture = Picture::<F, P, C>::new(field, palette);
    Image::new(&picture, Point::zero()).draw(&mut display).unwrap();
    display.bounding_box().points().map(|p| display.get_pixel(p).into()).collect()
}

/// The pixels that the command writes.
fn dumped(name: &str, color: &str, size: Size) -> Vec<Rgb888> {
    let directory = tempfile::tempdir().unwrap();
    let size = format!("{}x{}", size.width, size.height);
    good(directory.path(), &["dump", &file(name), "--color", color, "--size", &size, "-o", "a.png"]);
    let png = decode(&directory.path().join("a.png"));
    match png.color {
        png::ColorType::Grayscale => png.data.iter().map(|grey| Rgb888::new(*grey, *grey, *grey)).collect(),
        _ => png.data.chunks(3).map(|p| Rgb888::new(p[0], p[1], p[2])).collect(),
    }
}

/// The lines of a sample, without their head.
fn sampled(name: &str, points: &str) -> Vec<String> {
    let printed = good(Path::new("."), &["sample", &file(name), "--points", points, "--size", "64x64"]);
    printed.lines().skip(1).map(str::to_owned).collect()
}

/// A path as far as a sample goes.
fn assert_walked(path: impl Iterator<Item = PathElement>, sample: &[String]) {
    let points: Vec<_> = path.map(|(PathElement::MoveTo(p) | PathElement::LineTo(p))| (p.x, p.y)).collect();
    let number = |text: &str| text.parse::<Real>().unwrap();
    let wanted = sample.iter().map(|line| line.split_once(',').unwrap());
    let wanted: Vec<_> = wanted.map(|(x, y)| (number(x), number(y))).collect();
    assert!(wanted.len() > 30 && points == wanted, "{points:?} {wanted:?}");
}

#[test]
fn a_function_of_polynomials_is_the_command_s_own() {
    let f = polynomials::function::<{ polynomials::MAPS }, { polynomials::DEGREE }>().unwrap();
    assert!(polynomials::function::<{ polynomials::MAPS }, { polynomials::DEGREE - 1 }>().is_err());
    for line in sampled("polynomials", "33") {
        let numbers: Vec<&str> = line.split(',').collect();
        let (x, value) = (numbers[0].parse::<Wide>().unwrap(), numbers[1].parse::<Real>().unwrap());
        assert_eq!(f.at(x), value, "{x}");
    }
    assert_eq!(polynomials::ADDRESS, [1, 0]);
}

#[test]
fn a_surface_of_two_factors_is_the_picture_of_the_command() {
    let (size, depth) = (Size::new(60, 40), two_factors::DEPTH.unwrap());
    let f = two_factors::f::<{ two_factors::F_MAPS }, { two_factors::F_DEGREE }>().unwrap();
    let g = two_factors::g::<{ two_factors::G_MAPS }, { two_factors::G_DEGREE }>().unwrap();
    let cells = |maps| vec![Cell::ZERO; Pyramid::cells(maps, depth)];
    let (mut a, mut b) = (cells(two_factors::F_MAPS), cells(two_factors::G_MAPS));
    let (x, y) = (Pyramid::new(&f, depth, &mut a).unwrap(), Pyramid::new(&g, depth, &mut b).unwrap());
    let caster = two_factors::caster(HeightField::new(&x, &y).unwrap(), size, 1).unwrap();
    let pixels = drawn::<Rgb565, _, _>(&caster, two_factors::PALETTE);
    assert!(pixels.iter().any(|pixel| *pixel != pixels[0]));
    assert!(pixels == dumped("two-factors", "rgb565", size));
}

#[test]
fn a_world_that_borrows_is_the_picture_of_the_command() {
    let size = Size::new(60, 40);
    let f = corner::profile_0::<{ corner::PROFILE_0_MAPS }, { corner::PROFILE_0_DEGREE }>().unwrap();
    let g = corner::profile_1::<{ corner::PROFILE_1_MAPS }, { corner::PROFILE_1_DEGREE }>().unwrap();
    let depth = attractor_gallery::surface_depth([f.maps(), g.maps()], None, 60);
    let cells = |maps| vec![Cell::ZERO; Pyramid::cells(maps, depth)];
    let (mut a, mut b) = (cells(f.maps()), cells(g.maps()));
    let [x, y] = [Pyramid::new(&f, depth, &mut a).unwrap(), Pyramid::new(&g, depth, &mut b).unwrap()];
    let (fields, half_spaces) = (corner::fields(&[x, y]).unwrap(), corner::half_spaces().unwrap());
    let leaves = corner::leaves(&half_spaces, &fields).unwrap();
    let mut boxes = [Extent::NOTHING; corner::BOXES];
    let objects = corner::objects(&leaves, &mut boxes).unwrap();
    let (materials, lamps) = (corner::materials().unwrap(), corner::lamps().unwrap());
    let world = corner::world(&leaves, &objects, &materials, &lamps).unwrap();
    let pixels = drawn::<Rgb565, _, _>(&corner::caster(world, size, 1).unwrap(), Srgb);
    let colours: BTreeSet<_> = pixels.iter().map(|p| (p.r(), p.g(), p.b())).collect();
    assert!(colours.len() > 30, "{}", colours.len());
    assert!(pixels == dumped("corner", "rgb565", size));
}

#[test]
fn curves_are_the_paths_of_the_command() {
    let generator = turtle::generator::<{ turtle::SEGMENTS }>().unwrap();
    let path = generator.refined::<3>(&turtle::BASE, turtle::ORDER.unwrap()).unwrap();
    assert_walked(path, &sampled("turtle", "1000"));
    let law = stopped::law().unwrap();
    let path = Subdivision::<_, 20>::new(&law, &stopped::KNOTS, stopped::STOP.unwrap()).unwrap();
    assert_walked(path, &sampled("stopped", "1000"));
}

#[test]
fn a_view_is_the_picture_of_the_command_in_as_many_bits_as_it_takes() {
    let mut counts = vec![0; near_seahorses::COUNTS];
    let mut orbit = vec![OrbitPoint::default(); near_seahorses::DEEP_ORBIT];
    let (small, large) = (Size::new(8, 8), Size::new(40, 8));
    let picture = near_seahorses::picture(small).unwrap();
    let color = near_seahorses::color(&picture, &mut counts).unwrap();
    assert!(drawn::<Rgb565, _, _>(picture, color) == dumped("near-seahorses", "rgb565", small));
    assert!(near_seahorses::picture(large).is_err());
    let picture = near_seahorses::deep_picture(large, &mut orbit).unwrap();
    let color = near_seahorses::color(&picture, &mut counts).unwrap();
    let pixels = drawn::<Rgb565, _, _>(&picture, color);
    assert!(pixels == dumped("near-seahorses", "rgb565", large));
    let greys = drawn::<Gray8, _, _>(&picture, near_seahorses::GREY);
    assert!(greys == dumped("near-seahorses", "gray8", large));
    for pixels in [pixels, greys] {
        assert!(pixels.iter().any(|pixel| *pixel != pixels[0]));
    }
}

#[test]
fn a_whole_set_fits_whatever_the_shape_of_the_display() {
    let paper = Rgb888::new(0x0b, 0x0e, 0x1a);
    for size in [Size::new(40, 30), Size::new(30, 40), Size::new(100, 1)] {
        let picture = periods::picture(size).unwrap();
        assert!(drawn::<Rgb565, _, _>(picture, periods::color(paper)) == dumped("periods", "rgb565", size));
        assert!(drawn::<Gray8, _, _>(picture, periods::grey(paper)) == dumped("periods", "gray8", size));
    }
}

#[test]
fn maps_are_exported_bit_for_bit() {
    for scene in ["fern", "copier-fern"] {
        let text = good(Path::new("."), &["export", scene]);
        let quoted =
            |line: &str| -> Vec<String> { line.split('"').skip(1).step_by(2).map(str::to_owned).collect() };
        let maps: Vec<_> = text.lines().filter(|line| line.starts_with("    map(")).map(quoted).collect();
        assert_eq!(maps.len(), BARNSLEY_FERN.maps.len(), "{text}");
        for (map, wanted) in maps.iter().zip(BARNSLEY_FERN.maps) {
            let unit = |i: usize| map[i].parse::<Unit>().unwrap();
            let real = |i: usize| map[i].parse::<Real>().unwrap();
            assert_eq!([unit(0), unit(1), unit(2), unit(3)], [wanted.a, wanted.b, wanted.c, wanted.d]);
            assert_eq!([real(4), real(5)], [wanted.e, wanted.f]);
        }
        assert_eq!(text.matches("Unit::lit(\"0.07\")").count(), 2, "{text}");
    }
}

#[test]
fn only_what_is_asked_for_needs_the_gallery() {
    for (name, ..) in exported::FILES {
        let text = good(Path::new("."), &["export", &file(name)]);
        assert!(!text.contains("attractor_gallery"), "{text}");
        let more = good(Path::new("."), &["export", "--gallery", &file(name)]);
        let beyond = text.lines().filter(|line| !line.starts_with("//! Written") && !more.contains(line));
        assert_eq!(beyond.count(), 0, "{more}");
    }
}

/// Nothing of a scene file's title or name becomes code: all that is not a comment is what the scene without
/// them gives.
#[test]
fn titles_and_names_of_files_stay_comments() {
    let directory = tempfile::tempdir().unwrap();
    let scene = "kind = \"fif-curve\"\nknots = [[0, 0], [1, 1], [2, 0]]\nvertical_scaling = [0.5, 0.5]\n";
    let code = |file: &str, title: &str| {
        fs::write(directory.path().join(file), format!("title = \"{title}\"\n{scene}")).unwrap();
        let module = good(directory.path(), &["export", file]);
        let comment = |line: &&str| line.starts_with("//!");
        assert!(!module.contains(['\r', '\u{1b}', '\u{202e}', '\u{2066}']), "{module:?}");
        assert_eq!(module.lines().take_while(comment).count(), 3, "{module}");
        module.lines().skip_while(comment).map(|line| format!("{line}\n")).collect::<String>()
    };
    let plain = code("plain.toml", "Plain");
    for title in ["One\\npub fn injected() {}\\n", "a\\rb", "\\u001b[2J\\u202e}\\u2066 \\u2028 \\t", ""] {
        assert_eq!(code("plain.toml", title), plain, "{title}");
    }
    for file in ["one\npub fn injected() {}\n.toml", "a`b\u{202e}.toml", "c\rd.toml"] {
        assert_eq!(code(file, "Plain"), plain, "{file:?}");
    }
}

#[test]
fn what_cannot_be_exported_is_said_in_one_line() {
    assert!(bad(Path::new("."), &["export", "no-such-scene"]).contains("no-such-scene"));
    for (args, says) in [
        (&["export"][..], "SCENE"),
        (&["export", "--all"], "--output"),
        (&["export", "fern", "--all", "-o", "here"], "--all"),
        (&["export", "fern", "-o", "here"], "--all"),
        (&["export", "--all", "-o", "Cargo.toml"], "Cargo.toml"),
    ] {
        let complaint = bad(Path::new(env!("CARGO_MANIFEST_DIR")), args);
        assert!(complaint.contains(says), "{complaint}");
    }
}
