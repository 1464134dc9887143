//! Pattern polygons pasted on a surface: inside a convex polygon of texture coordinates another texture, or
//! another material, takes precedence. The surface underneath alone decides what is visible.
//!
//! Source: the course unit V, section 5.8 ("surface pattern polygons").
//!
//! Format: coordinates 24 fractional bits, products 48 and more in 128.

use super::super::material::{Lit, Material, Medium, Response};
use super::super::surface::SurfacePoint;
use super::field::Texture;
use crate::Error;
use crate::num::{Real, Rgb, Unit, Vec3};

/// A parent with a detail pasted on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pasted<'a, P, D> {
    parent: P,
    corners: &'a [[Real; 2]],
    detail: D,
}

impl<'a, P, D> Pasted<'a, P, D> {
    /// With `detail` inside the convex polygon of these corners `(u, v)`, counter-clockwise.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than three corners, [`Error::Unsupported`] where the polygon turns to the
    /// right or not at all at a corner, or goes round more than once.
    pub fn new(parent: P, corners: &'a [[Real; 2]], detail: D) -> Result<Self, Error> {
        let given = corners.len();
        if given < 3 {
            return Err(Error::TooFew { what: "corners of the pattern", given, at_least: 3 });
        }
        // every corner is to the left of, or on, every side: convex, and once round
        let sides = || corners.iter().zip(corners.iter().cycle().skip(1));
        let next = corners.iter().cycle().skip(2);
        let is_convex = sides().zip(next).all(|((a, b), c)| turn(*a, *b, *c) > 0)
            && sides().all(|(a, b)| corners.iter().all(|c| turn(*a, *b, *c) >= 0));
        if !is_convex {
            return Err(Error::Unsupported {
                what: "pattern polygon",
                allowed: "convex ones with counter-clockwise corners",
            });
        }
        Ok(Self { parent, corners, detail })
    }

    /// Whether a point is inside the polygon or on its edge. Exact
    /// (`a_pattern_covers_the_points_inside_its_polygon`).
    pub fn covers(&self, point: &SurfacePoint) -> bool {
        let place = [point.chart.u, point.chart.v];
        let sides = self.corners.iter().zip(self.corners.iter().cycle().skip(1));
        sides.into_iter().all(|(a, b)| turn(*a, *b, place) >= 0)
    }
}

/// The sign of the turn from `a` over `b` to `c`: above 0 to the left.
fn turn(a: [Real; 2], b: [Real; 2], c: [Real; 2]) -> i32 {
    // below 2^33 each, their products below 2^66
    let difference = |p: Real, q: Real| i128::from(q.to_bits()) - i128::from(p.to_bits());
    let area =
        difference(a[0], b[0]) * difference(a[1], c[1]) - difference(a[1], b[1]) * difference(a[0], c[0]);
    area.signum() as i32
}

impl<P: Texture, D: Texture> Texture for Pasted<'_, P, D> {
    fn is_charted(&self) -> bool {
        true
    }

    fn at(&self, point: &SurfacePoint) -> Rgb {
        if self.covers(point) { self.detail.at(point) } else { self.parent.at(point) }
    }
}

/// The medium inside, and what passes for shadows, are the parent's.
impl<P: Material, D: Material> Material for Pasted<'_, P, D> {
    const MAY_BE_CLEAR: bool = P::MAY_BE_CLEAR || D::MAY_BE_CLEAR;

    fn is_charted(&self) -> bool {
        true
    }

    fn medium(&self) -> Option<Medium> {
        self.parent.medium()
    }

    fn passes(&self) -> Rgb {
        self.parent.passes()
    }

    fn normal(&self, point: &SurfacePoint) -> Vec3<Unit> {
        if self.covers(point) { self.detail.normal(point) } else { self.parent.normal(point) }
    }

    fn respond(&self, point: &SurfacePoint, view: Vec3<Unit>, lights: impl Iterator<Item = Lit>) -> Response {
        if self.covers(point) {
            self.detail.respond(point, view, lights)
        } else {
            self.parent.respond(point, view, lights)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::charted;
    use super::*;
    use crate::trace::material::Mixture;

    fn corners<const N: usize>(corners: [[f64; 2]; N]) -> [[Real; 2]; N] {
        corners.map(|corner| corner.map(Real::from_num))
    }

    #[test]
    fn a_pattern_covers_the_points_inside_its_polygon() {
        let house = corners([[0.25, 0.25], [0.75, 0.25], [0.75, 0.5], [0.5, 0.75], [0.25, 0.5]]);
        let pasted = Pasted::new(Rgb::BLACK, &house, Rgb::WHITE).unwrap();
        let mut inside = 0;
        for (i, j) in (0..=32).flat_map(|i| (0..=32).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / 32.0, f64::from(j) / 32.0);
            let exact = (0.25..=0.75).contains(&u) && v >= 0.25 && v <= 0.5 + 0.25 - (u - 0.5).abs();
            let point = charted(Real::from_num(u), Real::from_num(v));
            assert_eq!(pasted.covers(&point), exact, "{u} {v}");
            assert_eq!(Texture::at(&pasted, &point), if exact { Rgb::WHITE } else { Rgb::BLACK });
            inside += u32::from(exact);
        }
        assert!(inside > 150 && Texture::is_charted(&pasted), "{inside}");
    }

    #[test]
    fn a_pattern_has_its_own_material_and_its_parents_inside() {
        let square = corners([[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]);
        let glass = Mixture::glass(Real::from_num(1.5)).unwrap();
        let pasted = Pasted::new(glass, &square, Mixture::mirror()).unwrap();
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -Unit::ONE);
        let [label, bottle] = [0.25, 0.75].map(|u| charted(Real::from_num(u), Real::from_num(0.25)));
        assert_eq!(pasted.respond(&label, down, core::iter::empty()).reflected, Rgb::WHITE);
        assert_eq!(pasted.respond(&bottle, down, core::iter::empty()).refracted, Rgb::WHITE);
        assert_eq!(pasted.medium(), glass.medium());
        assert_eq!((pasted.passes(), pasted.normal(&label)), (glass.passes(), label.normal));
        assert!(Material::is_charted(&pasted));
    }

    #[test]
    fn a_polygon_that_is_not_convex_or_the_wrong_way_round_is_refused() {
        let refused = |corners: &[[Real; 2]]| Pasted::new((), corners, ()).is_err();
        assert!(refused(&corners([[0.0, 0.0], [1.0, 0.0]])));
        assert!(refused(&corners([[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]])));
        assert!(refused(&corners([[0.0, 0.0], [1.0, 0.0], [0.25, 0.25], [0.0, 1.0]])));
        assert!(refused(&corners([[0.0, 0.0], [0.5, 0.0], [1.0, 0.0], [0.0, 1.0]])));
        // a star, which turns left at every corner
        let star: std::vec::Vec<[Real; 2]> = (0..5)
            .map(|k| (f64::from(2 * k) * core::f64::consts::TAU / 5.0).sin_cos())
            .map(|(y, x)| [x, y].map(Real::from_num))
            .collect();
        assert!(refused(&star));
        assert!(!refused(&corners([[-127.0, -127.0], [127.0, -127.0], [127.0, 127.0]])));
    }
}
