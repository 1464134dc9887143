//! A coastline to roughen: the outline of Iceland, as knots for a random curve.
//!
//! 44 capes, fjord heads and stretches of the south coast, anticlockwise from Reykjanes, read off by hand at
//! a tenth of a degree of latitude and a fifth of longitude, as far as general geographical knowledge goes:
//! geographical facts, in the public domain, drawn from no data set. It shows the shape of the island and no
//! more; it is not for navigation.
//!
//! Projection: equirectangular about 65 degrees north, 18.5 degrees west, one unit a degree of latitude, so
//! that a degree of longitude is `cos 65 = 0.4226`.

use crate::num::Real;
use crate::plane::Point2;

/// How many points the outline has, the first repeated at its end.
pub const COUNT: usize = OUTLINE.len() + 1;

/// Latitude north and longitude west, in tenths of a degree.
const OUTLINE: [[i32; 2]; 44] = [
    [638, 227], // Reykjanes
    [638, 222], // Krysuvik
    [638, 214], // Thorlakshofn
    [638, 209], // Stokkseyri
    [636, 203], // Landeyjar
    [634, 191], // Dyrholaey
    [634, 186], // Kotlutangi
    [637, 178], // Skaftaros
    [638, 169], // Skeidararsandur
    [640, 162], // Breidamerkursandur
    [642, 152], // Hofn
    [644, 145], // Eystrahorn
    [647, 140], // Breiddalsvik
    [650, 136], // Gerpir
    [653, 137], // Dalatangi
    [656, 143], // Heradsfloi
    [658, 144], // Kollumuli
    [660, 149], // Vopnafjordur's mouth
    [664, 146], // Langanes
    [662, 153], // Thistilfjordur
    [665, 160], // Melrakkasletta
    [661, 165], // Axarfjordur
    [662, 172], // Tjornes
    [660, 175], // Skjalfandi
    [662, 182], // Gjogurta
    [657, 181], // Eyjafjordur's head
    [662, 189], // Siglunes
    [657, 196], // Skagafjordur's head
    [661, 204], // Skagi
    [656, 203], // Hunafjordur
    [653, 211], // Hrutafjordur's head
    [657, 214], // Steingrimsfjordur
    [662, 217], // Krossnes
    [665, 225], // Horn
    [661, 232], // Isafjardardjup's mouth
    [659, 226], // Isafjardardjup's head
    [660, 236], // Sugandafjordur
    [655, 245], // Bjargtangar
    [655, 232], // Vatnsfjordur
    [654, 222], // Gilsfjordur's mouth
    [650, 224], // Hvammsfjordur's mouth
    [649, 240], // Snaefellsnes
    [646, 222], // Borgarfjordur
    [641, 220], // Reykjavik
];

/// The outline, closed, within `-2.6 .. 2.1` by `-1.6 .. 1.5`.
///
/// ```
/// use attractor::curve::{OneVariable, Stop, Subdivision, coast};
/// use attractor::num::{Real, Unit};
/// let law = OneVariable::new(Unit::from_num(0.16), 1980)?;
/// let rough = Subdivision::<_, 16>::new(&law, &coast::ICELAND, Stop::Norm(Real::from_num(0.02)))?;
/// assert!(rough.count() > 1000);
/// # Ok::<(), attractor::Error>(())
/// ```
pub const ICELAND: [Point2; COUNT] = {
    let mut points = [Point2::new(Real::ZERO, Real::ZERO); COUNT];
    let mut i = 0;
    while i < COUNT {
        let [latitude, longitude] = OUTLINE[i % OUTLINE.len()];
        // cos 65 degrees = 0.422618
        let x = (((185 - longitude as i64) * 422_618) << 24) / 10_000_000;
        let y = ((latitude as i64 - 650) << 24) / 10;
        points[i] = Point2::new(Real::from_bits(x as i32), Real::from_bits(y as i32));
        i += 1;
    }
    points
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_is_closed_simple_and_as_large_as_the_island() {
        let points: std::vec::Vec<(f64, f64)> =
            ICELAND.iter().map(|p| (p.x.to_num(), p.y.to_num())).collect();
        assert_eq!(ICELAND.first(), ICELAND.last());
        // 111.2 km a degree; 103,000 square kilometres
        let area =
            points.windows(2).map(|w| w[0].0 * w[1].1 - w[1].0 * w[0].1).sum::<f64>() / 2.0 * 111.2 * 111.2;
        assert!((area - 103_000.0).abs() < 5_000.0, "{area}");
        let side = |a: (f64, f64), b: (f64, f64), c: (f64, f64)| {
            (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
        };
        for (i, v) in points.windows(2).enumerate() {
            for w in points.windows(2).skip(i + 2) {
                let crossing = side(v[0], v[1], w[0]) * side(v[0], v[1], w[1]) < 0.0
                    && side(w[0], w[1], v[0]) * side(w[0], w[1], v[1]) < 0.0;
                assert!(!crossing, "{v:?} {w:?}");
            }
        }
    }
}
