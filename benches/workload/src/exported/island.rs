//! An island in a mirroring sea: sand, grass, rock and snow by height and slope.
//!
//! Written by `attractor export --gallery island`.

use attractor::Error;
use attractor::num::{Lumen, RandomField, Real, Rgb, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, Law, PlaneToLine};
use attractor::trace::Sky;
use attractor_gallery::{Floor, Ground, TerrainPicture};

/// The heights of the knots, rows from south to north.
#[rustfmt::skip]
pub static KNOTS: [Real; 25] = [
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.05"),
    Real::lit("0.02"),
    Real::lit("-0.05"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("0.05"),
    Real::lit("0.42"),
    Real::lit("0.08"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.1"),
    Real::lit("0.12"),
    Real::lit("0"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
    Real::lit("-0.3"),
];

/// The function of the surface.
///
/// # Errors
/// None: the command has built it.
pub fn function() -> Result<PlaneToLine<'static>, Error> {
    let knots = Heights::new(5, 5, &KNOTS)?.with_origin(0, 0)?;
    let random = RandomField::new(7).numbered(0);
    let (offset, similarity) = const { (Unit::lit("0.13"), Unit::lit("0.9")) };
    PlaneToLine::new(knots, Law::new(offset, similarity)?, random)
}

/// How often a cell between four knots is halved.
pub const LEVELS: u32 = 6;

/// The landscape.
#[rustfmt::skip]
pub const PICTURE: TerrainPicture<'static> = TerrainPicture {
    knots: &KNOTS,
    columns: 5,
    origin: [0, 0],
    roughness: (Unit::lit("0.13"), Unit::lit("0.9")),
    seed: (7, 0),
    levels: LEVELS,
    inner: InnerGeometry::Ferguson,
    over: [[Real::lit("-2"), Real::lit("2")], [Real::lit("-2"), Real::lit("2")]],
    ground: Ground { sand: Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.52711"), Lumen::lit("0.2789")), grass: Rgb::new(Lumen::lit("0.07227"), Lumen::lit("0.17465"), Lumen::lit("0.02956")), rock: Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.11697"), Lumen::lit("0.08022")), snow: Rgb::new(Lumen::lit("0.91557"), Lumen::lit("0.93065"), Lumen::lit("0.96117")), shore: Real::lit("0.03"), snow_line: Real::lit("0.42"), steep: Unit::lit("0.62"), passage: Unit::lit("0.12"), ragged: (Real::lit("6"), Unit::lit("0.12")) },
    plain: Some(Floor { level: Real::lit("0"), color: Rgb::new(Lumen::lit("0.00304"), Lumen::lit("0.03433"), Lumen::lit("0.0648")), reflect: Rgb::new(Lumen::lit("0.09758"), Lumen::lit("0.13843"), Lumen::lit("0.16203")) }),
    sun: (Vec3::lit("-3", "-1.4", "1.8"), Rgb::new(Lumen::lit("1.7"), Lumen::lit("1.55"), Lumen::lit("1.3"))),
    ambient: Unit::lit("0.22"),
    sky: Sky { zenith: Rgb::new(Lumen::lit("0.02519"), Lumen::lit("0.12213"), Lumen::lit("0.43416")), horizon: Rgb::new(Lumen::lit("0.47932"), Lumen::lit("0.63075"), Lumen::lit("0.80695")), nadir: Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.08022"), Lumen::lit("0.13843")) },
    haze: Unit::lit("0.035"),
    view: (Vec3::lit("-0.9", "-3.4", "0.8"), Vec3::lit("0", "0", "0.12"), Real::lit("32")),
    samples: 2,
    contrast: Some([84, 172]),
};
