//! What constructors refuse, by name.

use attractor::Error;
use attractor::num::{RandomField, Real, Unit};
use attractor::terrain::{Heights, InnerGeometry, Law, PlaneToLine, Rows, Seam, Triangles};
use attractor::trace::{DeepTerrain, HeightRange, Terrain};

use super::{OVER, law};

/// What constructors refuse, and what they take just before.
#[test]
fn surfaces_out_of_range_are_refused_by_name() {
    let zero = [Real::ZERO; 6];
    let refused = |result: Result<Heights<'_>, Error>| match result {
        Err(
            Error::TooFew { what, .. } | Error::LengthMismatch { what, .. } | Error::OutOfRange { what, .. },
        ) => what,
        Err(Error::Capacity { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(Heights::new(1, 6, &zero)), "columns of knots");
    assert_eq!(refused(Heights::new(6, 1, &zero)), "rows of knots");
    assert_eq!(refused(Heights::new(2, 2, &zero)), "heights");
    assert_eq!(refused(Heights::new(40_000, 2, &zero)), "columns of knots");
    let high = [0, 0, 64, 0].map(Real::from_num);
    assert_eq!(refused(Heights::new(2, 2, &high)), "height");
    let heights = Heights::new(3, 2, &zero).unwrap();
    assert!(heights.with_origin(32765, -32768).is_ok());
    assert_eq!(refused(heights.with_origin(32766, 0)), "first column of knots");
    assert_eq!(refused(heights.with_origin(0, 32767)), "first row of knots");
    for (offset, similarity, taken) in
        [(0.0, 0.0, true), (1.99, 1.0, true), (-0.01, 0.5, false), (0.1, 1.01, false), (0.1, -0.1, false)]
    {
        let law = Law::new(Unit::from_num(offset), Unit::from_num(similarity));
        assert_eq!(law.is_ok(), taken, "{offset} {similarity}: {law:?}");
    }
    // 16 levels of 1.9 without decay leave the range
    let surface = |offset| PlaneToLine::new(heights, law(offset, 0.0), RandomField::new(0)).map(|_| ());
    assert!(surface(0.6).is_ok());
    let what = "height with its displacements";
    assert!(matches!(surface(0.75), Err(Error::OutOfRange { what: w, .. }) if w == what));
    let terrain = PlaneToLine::new(heights, law(0.1, 0.5), RandomField::new(0)).unwrap();
    let mut memory = [Real::ZERO; 40];
    assert!(Rows::new(&terrain, 17, &mut memory).is_err());
    assert!(Rows::of(&terrain, 2, [0..9, 0..1], 2, &mut memory).is_err());
    assert_eq!(
        Rows::new(&terrain, 3, &mut memory).map(|_| ()).unwrap_err(),
        Error::BufferLength { what: "rows of a surface", given: 40, needed: 3 + 2 * (5 + 9 + 17) }
    );
    assert!(
        Triangles::new(&terrain, 1, [4, 0], &0).is_err() && Triangles::new(&terrain, 17, [0, 0], &0).is_err()
    );
    assert!(Seam::new(0, [0, 0], [1, 1]).is_err() && Seam::new(0, [2, 2], [2, 2]).is_err());
    assert!(DeepTerrain::new(&terrain, 17, OVER).is_err() && DeepTerrain::new(&terrain, 16, OVER).is_err());
    let mut ranges = [HeightRange::default(); 1];
    let stored = Terrain::new(heights, InnerGeometry::Bilinear, OVER, &mut ranges).map(|_| ());
    assert_eq!(stored.unwrap_err(), Error::BufferLength { what: "bounds of a terrain", given: 1, needed: 2 });
}
