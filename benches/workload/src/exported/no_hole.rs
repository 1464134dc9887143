//! Carpenter's figure 7, the hole that does not happen: cells of different resolution share their edges.
//!
//! Written by `attractor export --gallery no-hole`.

use attractor::Error;
use attractor::num::{Coordinate, Lumen, RandomField, Real, Rgb, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, Law, Magnification, PlaneToLine};
use attractor::trace::Sky;
use attractor_gallery::{Ground, Lines, Named, Pencil, TerrainPicture};

/// The heights of the knots, rows from south to north.
#[rustfmt::skip]
pub static KNOTS: [Real; 12] = [
    Real::lit("0"),
    Real::lit("0.3"),
    Real::lit("0.1"),
    Real::lit("0"),
    Real::lit("0.3"),
    Real::lit("0.1"),
    Real::lit("0.2"),
    Real::lit("0.1"),
    Real::lit("0.1"),
    Real::lit("0"),
    Real::lit("0.15"),
    Real::lit("0.2"),
];

/// The function of the surface.
///
/// # Errors
/// None: the command has built it.
pub fn function() -> Result<PlaneToLine<'static>, Error> {
    let knots = Heights::new(4, 3, &KNOTS)?.with_origin(0, 0)?;
    let random = RandomField::new(9).numbered(0);
    let (offset, similarity) = const { (Unit::lit("0.2"), Unit::lit("0.85")) };
    PlaneToLine::new(knots, Law::new(offset, similarity)?, random)
}

/// How often a cell between four knots is halved.
pub const LEVELS: u32 = 5;

/// The landscape.
#[rustfmt::skip]
pub const PICTURE: TerrainPicture<'static> = TerrainPicture {
    knots: &KNOTS,
    columns: 4,
    origin: [0, 0],
    roughness: (Unit::lit("0.2"), Unit::lit("0.85")),
    seed: (9, 0),
    levels: LEVELS,
    inner: InnerGeometry::BSpline,
    over: [[Real::lit("-1"), Real::lit("1")], [Real::lit("-1"), Real::lit("1")]],
    ground: Ground { sand: Rgb::new(Lumen::lit("0.61514"), Lumen::lit("0.49826"), Lumen::lit("0.30142")), grass: Rgb::new(Lumen::lit("0.12456"), Lumen::lit("0.22145"), Lumen::lit("0.04822")), rock: Rgb::new(Lumen::lit("0.22145"), Lumen::lit("0.17937"), Lumen::lit("0.14172")), snow: Rgb::new(Lumen::lit("0.91557"), Lumen::lit("0.93065"), Lumen::lit("0.96117")), shore: Real::lit("0.02"), snow_line: Real::lit("0.5"), steep: Unit::lit("0.7"), passage: Unit::lit("0.1"), ragged: (Real::lit("6"), Unit::lit("0.1")) },
    plain: None,
    sun: (Vec3::lit("-3", "-1", "2"), Rgb::new(Lumen::lit("1"), Lumen::lit("0.94"), Lumen::lit("0.84"))),
    ambient: Unit::lit("0.15"),
    sky: Sky { zenith: Rgb::new(Lumen::lit("0.05173"), Lumen::lit("0.17279"), Lumen::lit("0.47636")), horizon: Rgb::new(Lumen::lit("0.59077"), Lumen::lit("0.69118"), Lumen::lit("0.79944")), nadir: Rgb::new(Lumen::lit("0.25195"), Lumen::lit("0.23645"), Lumen::lit("0.22145")) },
    haze: Unit::lit("0"),
    view: (Vec3::lit("0", "1", "0"), Vec3::lit("0", "0", "0"), Real::lit("40")),
    samples: 2,
    contrast: None,
};

/// Its lines.
#[rustfmt::skip]
pub const LINES: Lines = Lines::Triangles(Magnification { eye: [Coordinate::lit("0"), Coordinate::lit("0"), Coordinate::lit("0.5")], length: Unit::lit("0.12"), most: 5 });

/// What they are drawn with.
pub const PENCIL: Pencil = Pencil { palette: Named::Fire, closed: false };
