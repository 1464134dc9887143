//! Carpenter's figure 9: 1,024 Ferguson patches through the same heights.
//!
//! Written by `attractor export --gallery mountain-ferguson`.

use attractor::Error;
use attractor::num::{Lumen, RandomField, Real, Rgb, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, Law, PlaneToLine};
use attractor::trace::Sky;
use attractor_gallery::{Floor, Ground, TerrainPicture};

/// The heights of the knots, rows from south to north.
#[rustfmt::skip]
pub static KNOTS: [Real; 9] = [
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("0.5"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
];

/// The function of the surface.
///
/// # Errors
/// None: the command has built it.
pub fn function() -> Result<PlaneToLine<'static>, Error> {
    let knots = Heights::new(3, 3, &KNOTS)?.with_origin(0, 0)?;
    let random = RandomField::new(9).numbered(0);
    let (offset, similarity) = const { (Unit::lit("0.24"), Unit::lit("0.9")) };
    PlaneToLine::new(knots, Law::new(offset, similarity)?, random)
}

/// How often a cell between four knots is halved.
pub const LEVELS: u32 = 4;

/// The landscape.
#[rustfmt::skip]
pub const PICTURE: TerrainPicture<'static> = TerrainPicture {
    knots: &KNOTS,
    columns: 3,
    origin: [0, 0],
    roughness: (Unit::lit("0.24"), Unit::lit("0.9")),
    seed: (9, 0),
    levels: LEVELS,
    inner: InnerGeometry::Ferguson,
    over: [[Real::lit("-1"), Real::lit("1")], [Real::lit("-1"), Real::lit("1")]],
    ground: Ground { sand: Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.63075"), Lumen::lit("0.52711")), grass: Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.63075"), Lumen::lit("0.52711")), rock: Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.63075"), Lumen::lit("0.52711")), snow: Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.63075"), Lumen::lit("0.52711")), shore: Real::lit("0.02"), snow_line: Real::lit("0.5"), steep: Unit::lit("0.7"), passage: Unit::lit("0.1"), ragged: (Real::lit("6"), Unit::lit("0.1")) },
    plain: Some(Floor { level: Real::lit("0"), color: Rgb::new(Lumen::lit("0.14996"), Lumen::lit("0.17465"), Lumen::lit("0.20155")), reflect: Rgb::new(Lumen::lit("0"), Lumen::lit("0"), Lumen::lit("0")) }),
    sun: (Vec3::lit("-3", "-1", "2"), Rgb::new(Lumen::lit("1"), Lumen::lit("0.94"), Lumen::lit("0.84"))),
    ambient: Unit::lit("0.2"),
    sky: Sky { zenith: Rgb::new(Lumen::lit("0.01938"), Lumen::lit("0.03189"), Lumen::lit("0.06848")), horizon: Rgb::new(Lumen::lit("0.25415"), Lumen::lit("0.29614"), Lumen::lit("0.37123")), nadir: Rgb::new(Lumen::lit("0.25195"), Lumen::lit("0.23645"), Lumen::lit("0.22145")) },
    haze: Unit::lit("0"),
    view: (Vec3::lit("-0.9", "-2.7", "1.35"), Vec3::lit("0", "0.1", "0.12"), Real::lit("36")),
    samples: 1,
    contrast: None,
};
