//! The shapes of a world as the f64 reference has them.

use attractor::num::{Angle, Real, Vec3, Wide};
use attractor_reference::Ray;
use attractor_reference::world::{
    Cone, Cube, HeightField, Placing, Plane, Polygon, Polyhedron, Shape, Sphere, Square, Superellipsoid,
    TaperedCylinder, Torus,
};

use super::figure::Figure;
use super::placement::Step;

/// A shape and where it stands.
pub(super) struct Exact {
    shape: Box<dyn Shape>,
    placing: Placing,
}

/// A crossing: where, into the shape or out of it, and of which face.
pub(super) type Met = (f64, bool, usize);

pub(super) fn vector(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(Real::to_num)
}

fn placing(steps: &[Step]) -> Placing {
    steps.iter().fold(Placing::IDENTITY, |placing, step| {
        placing.then(&match *step {
            Step::Scale(factors) => Placing::scaling(vector(factors)),
            Step::Rotate { axis, angle } => Placing::rotation(vector(axis), degrees(angle)),
            Step::Translate(by) => Placing::translation(vector(by)),
            Step::Matrix(rows) => {
                let rows = rows.map(|row| row.map(Wide::to_num::<f64>));
                Placing::new(rows.map(|[x, y, z, _]| [x, y, z]), rows.map(|row| row[3]))
            }
        })
    })
}

fn degrees(angle: Angle) -> f64 {
    angle.to_num::<f64>() * 360.0
}

impl Exact {
    /// The shape where these steps put it, a height field with pyramids of this depth.
    pub(super) fn new(figure: &Figure, steps: &[Step], depth: u32) -> Self {
        let shape: Box<dyn Shape> = match figure {
            Figure::Plane => Box::new(Plane),
            Figure::Square => Box::new(Square),
            Figure::Polygon { corners, .. } => {
                Box::new(Polygon { corners: corners.iter().copied().map(vector).collect() })
            }
            Figure::Sphere => Box::new(Sphere),
            Figure::Cube => Box::new(Cube),
            Figure::Polyhedron { planes, .. } => {
                let half_spaces = planes
                    .iter()
                    .map(|plane| plane.map(Wide::to_num))
                    .map(|[x, y, z, d]| ([x, y, z], d))
                    .collect();
                Box::new(Polyhedron { half_spaces })
            }
            Figure::TaperedCylinder { cap, .. } => Box::new(TaperedCylinder { cap: cap.to_num() }),
            Figure::Torus(torus) => Box::new(Torus { tube: torus.tube().to_num() }),
            Figure::Superellipsoid { n, m, .. } => Box::new(Superellipsoid { n: n.to_num(), m: m.to_num() }),
            Figure::HeightField(profiles) => {
                let [f, g] = &**profiles;
                Box::new(HeightField::new(f.reference.clone(), g.reference.clone(), depth as usize))
            }
        };
        Self { shape, placing: placing(steps) }
    }

    /// The shape, and where it stands.
    pub(super) fn into_parts(self) -> (Box<dyn Shape>, Placing) {
        (self.shape, self.placing)
    }

    /// All crossings of a ray from its origin on.
    pub(super) fn crossings(&self, origin: [f64; 3], direction: [f64; 3]) -> Vec<Met> {
        let ray = self.placing.generic_ray(&Ray { origin, direction });
        let all = self.shape.crossings(&ray, Cone { width: 0.0, growth: 0.0 });
        all.iter().map(|crossing| (crossing.t, crossing.enters, crossing.part.face())).collect()
    }
}
