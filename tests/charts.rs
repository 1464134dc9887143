//! Texture coordinates, how a place moves with them, and normals: the reference's, on every face of every
//! shape.

use attractor::num::{Near, Real, Vec3, Wide};
use attractor::trace::solid::{
    Cube, HalfSpace, Plane, Polygon, Polyhedron, Shape, Sphere, Square, Superellipsoid, TaperedCylinder,
    Torus,
};
use attractor_reference::{Ray, world};

use attractor_tests::accuracy::words;

/// How far a chart is off at most: in parts of a turn or of an edge, in lengths against the length of `P_u`
/// or `P_v`, and in radians of the normal.
#[derive(Debug, Default)]
struct Off {
    coordinates: f64,
    along: f64,
    normal: f64,
    places: u32,
    faces: u64,
}

fn size(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn floats(v: Vec3) -> [f64; 3] {
    [v.x, v.y, v.z].map(|c| c.to_num())
}

/// Both at places where random rays cross the shape, as core has them. Where an edge or a pole is nearer than
/// `1/32`, or a derivative outside 1/16 to 16, the place's own rounding counts for more than the formula.
fn compare(shape: &impl Shape, exact: &dyn world::Shape) -> Off {
    let mut random = words(3);
    let mut number = || (random.next().unwrap() >> 40) as f64 / 2_f64.powi(23) - 1.0;
    let mut off = Off::default();
    for _ in 0..2_000 {
        let origin = [(); 3].map(|()| 3.0 * number());
        let aim = [(); 3].map(|()| number());
        let ray = Ray { origin, direction: [0, 1, 2].map(|k: usize| aim[k] - origin[k]) };
        for crossing in exact.crossings(&ray, world::Cone::THIN) {
            let place = ray.at(crossing.t);
            if place.iter().any(|c| c.abs() > 2.0) {
                continue;
            }
            let [x, y, z] = place.map(Real::from_num::<f64>);
            let place = floats(Vec3::new(x, y, z));
            // what is flat lies in a plane of symmetry
            if place.iter().any(|c| *c != 0.0 && c.abs() < 1.0 / 32.0) {
                continue;
            }
            let face = crossing.part.face() as u8;
            let (chart, frame) = (shape.chart(Vec3::new(x, y, z), face), exact.frame(place, crossing.part));
            if [frame.p_u, frame.p_v].iter().any(|along| !(1.0 / 16.0..=16.0).contains(&size(*along))) {
                continue;
            }
            let coordinate = |got: Real, exact: f64| {
                let apart = got.to_num::<f64>() - exact;
                // 0 and 1 are one longitude
                (apart.abs()).min((apart.abs() - 1.0).abs())
            };
            let apart = |got: Vec3, exact: [f64; 3]| {
                let got = floats(got);
                size([0, 1, 2].map(|k: usize| got[k] - exact[k])) / size(exact)
            };
            let [x, y, z] = place.map(Near::from_num::<f64>);
            let normal = shape.normal(Vec3::new(x, y, z), face);
            let normal = [normal.x, normal.y, normal.z].map(|c| c.to_num::<f64>());
            let lean =
                [0, 1, 2].map(|k: usize| normal[k] / size(normal) - frame.normal[k] / size(frame.normal));
            off.coordinates =
                off.coordinates.max(coordinate(chart.u, frame.uv[0])).max(coordinate(chart.v, frame.uv[1]));
            off.along = off.along.max(apart(chart.along_u, frame.p_u)).max(apart(chart.along_v, frame.p_v));
            off.normal = off.normal.max(size(lean));
            off.places += 1;
            off.faces |= 1 << face;
        }
    }
    off
}

#[test]
fn charts_and_normals_are_those_of_the_reference_on_every_face() {
    let real = |x: f64| Real::from_num(x);
    let vector = |[x, y, z]: [f64; 3]| Vec3::new(real(x), real(y), real(z));
    let mut rows = vec![
        ("sphere".to_owned(), 1, compare(&Sphere, &world::Sphere)),
        ("cube".to_owned(), 6, compare(&Cube, &world::Cube)),
        ("plane".to_owned(), 1, compare(&Plane, &world::Plane)),
        ("square".to_owned(), 1, compare(&Square, &world::Square)),
    ];
    for cap in [0.0, 0.25, 1.0] {
        let shape = TaperedCylinder::new(real(cap)).unwrap();
        let faces = if cap > 0.0 { 3 } else { 2 };
        rows.push((format!("cap {cap}"), faces, compare(&shape, &world::TaperedCylinder { cap })));
    }
    for tube in [0.125, 0.5, 0.875] {
        let shape = Torus::new(Near::from_num(tube)).unwrap();
        rows.push((format!("tube {tube}"), 1, compare(&shape, &world::Torus { tube })));
    }
    for n in [0.5, 1.0, 2.0, 3.5] {
        for m in [0.5, 1.0, 2.0, 3.5] {
            let shape = Superellipsoid::new(real(n), real(m)).unwrap();
            rows.push((format!("exponents {n}, {m}"), 1, compare(&shape, &world::Superellipsoid { n, m })));
        }
    }
    let corner = |x: f64, y: f64| [1.0 + x, -0.375 * x + y, 0.5 * x - 0.25 * y];
    let corners = vec![corner(-1.0, -1.0), corner(0.75, -0.875), corner(0.875, 0.75), corner(-0.625, 1.125)];
    let polygon = Polygon::<4>::new(&corners.iter().map(|c| vector(*c)).collect::<Vec<_>>()).unwrap();
    rows.push(("polygon".to_owned(), 1, compare(&polygon, &world::Polygon { corners })));
    let planes = [
        ([1.0, 0.0, 0.25], 0.75),
        ([-1.0, 0.5, 0.0], 0.75),
        ([0.0, 1.0, 0.25], 1.0),
        ([0.0, -1.0, 0.0], 0.5),
        ([0.0, 0.0, 1.0], 0.625),
        ([0.25, 0.125, -1.0], 0.875),
    ];
    let wide = |x: f64| Wide::from_num(x);
    let sides =
        planes.map(|([x, y, z], d)| HalfSpace::new(Vec3::new(wide(x), wide(y), wide(z)), wide(d)).unwrap());
    let exact = world::Polyhedron { half_spaces: planes.to_vec() };
    rows.push(("polyhedron".to_owned(), 6, compare(&Polyhedron::new(&sides).unwrap(), &exact)));
    for (name, faces, off) in &rows {
        println!("{name:>20}: {off:?}");
        assert_eq!(off.faces.count_ones(), *faces, "{name}: {off:?}");
        assert!(off.places > 150, "{name}: {off:?}");
        assert!(
            off.coordinates < 2_f64.powi(-22) && off.along < 2_f64.powi(-18) && off.normal < 2_f64.powi(-22),
            "{name}: {off:?}"
        );
    }
}
