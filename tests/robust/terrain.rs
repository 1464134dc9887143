//! Surfaces by subdivision of any heights, laws, seeds and places, and rays through them.

use std::ops::ControlFlow;

use attractor::num::{Coordinate, Lumen, RandomField, Real, Rgb, Unit, Vec3};
use attractor::terrain::{
    EdgeLevel, Heights, InnerGeometry, Law, Magnification, PlaneToLine, Randomness, Rows, Seam, Seamed, Side,
    Triangles,
};
use attractor::trace::material::{Hazy, Mixture};
use attractor::trace::texture::{Landscape, Noise, Texture, Turbulence};
use attractor::trace::{Crossing, DeepTerrain, HeightRange, Ray, Surface, Terrain};
use proptest::collection::vec;
use proptest::prelude::*;

use super::{fuzz, inside, real, unit, vector};

/// Columns, rows and room for heights of any of them.
fn grid() -> impl Strategy<Value = (u32, u32, Vec<Real>)> {
    let height = || prop_oneof![8 => inside(2), 1 => inside(64), 1 => real()];
    (1..6_u32, 1..5_u32).prop_flat_map(move |(columns, rows)| {
        let count = (columns * rows) as usize;
        (Just(columns), Just(rows), vec(height(), count))
    })
}

fn law() -> impl Strategy<Value = (Unit, Unit)> {
    let part = || (0..=1 << 30).prop_map(Unit::from_bits);
    prop_oneof![8 => ((0..1 << 28).prop_map(Unit::from_bits), part()), 1 => (unit(), unit())]
}

fn coordinate() -> impl Strategy<Value = Coordinate> {
    super::word().prop_map(Coordinate::from_bits)
}

/// What a ray meets, and all there is to know of it.
fn meet(surface: &impl Surface, ray: &Ray, cone: Unit) {
    let mut all: Vec<Crossing> = Vec::new();
    surface.cross(ray, cone, &mut |crossing| {
        all.push(crossing);
        ControlFlow::Continue(())
    });
    assert!(all.len() <= surface.most_crossings() as usize);
    for (k, crossing) in all.iter().enumerate() {
        assert!(crossing.t >= 0 && (k == 0 || all[k - 1].enters != crossing.enters));
        let point = surface.point(ray, cone, crossing, true);
        let color = Rgb::grey(Lumen::ONE / 2);
        let turbulence = Turbulence::new(Noise::new(1), Real::ONE, 2).unwrap();
        let ground = Landscape {
            sand: color,
            grass: color,
            rock: color,
            snow: color,
            shore: Real::ZERO,
            snow_line: Real::ONE,
            steep: cone,
            passage: cone,
            ragged: (turbulence, Unit::ONE),
        };
        // the same colour everywhere, but for a rounding at each passage
        assert!(ground.at(&point).r.to_bits().abs_diff(color.r.to_bits()) < 8);
        let hazy = Hazy { material: Mixture::matt(color), eye: ray.origin(), air: color, density: cone };
        assert!((Unit::ZERO..=Unit::ONE).contains(&hazy.clarity(point.position)));
    }
    let (extent, error) = (surface.extent(), surface.error());
    assert!(!extent.is_empty() && error > 0 && !surface.is_closed());
    let _ = surface.value(ray.at(Real::ONE));
}

#[test]
fn surfaces_of_any_heights_and_rays_through_them() {
    let view = (vector(inside(8)), vector(inside(4)), unit(), inside(64), inside(64));
    let places = (any::<[i16; 2]>(), coordinate(), coordinate(), any::<[i16; 4]>());
    let given = (grid(), law(), any::<u64>(), 0..4_u32, view, places);
    fuzz(given, 20, |((columns, rows, knots), (offset, similarity), seed, level, view, places)| {
        let (origin, u, v, [a, b, c, d]) = places;
        let Ok(law) = Law::new(offset, similarity) else { return false };
        assert!(law.offset(16) == 0 && law.offset(1) <= law.offset(0) && law.reach(3, 2) == 0);
        let Ok(heights) = Heights::new(columns, rows, &knots) else { return false };
        let Ok(heights) = heights.with_origin(origin[0], origin[1]) else { return false };
        assert_eq!((heights.columns(), heights.rows(), heights.origin()), (columns, rows, origin));
        let [low, high] = heights.range();
        assert!((low..=high).contains(&heights.at(99, 1)));
        let seams = Seam::new(seed as u32, [a, b], [c, b]).into_iter().chain(Seam::new(1, [a, b], [a, d]));
        let seams: Vec<Seam> = seams.collect();
        let field = RandomField::new(seed).numbered(level);
        let sewn = Seamed::new(field, &seams);
        if let Ok(terrain) = PlaneToLine::new(heights, law, sewn) {
            let _ = (terrain.height(u, v), terrain.random().at(u, v), terrain.law());
        }
        let Ok(terrain) = PlaneToLine::new(heights, law, field) else { return false };
        let _ = terrain.height(u, v);
        let mut beyond = vec![Real::ZERO; rows as usize];
        let _ = terrain.extrapolated(Side::West, &mut beyond);
        let mut memory = vec![Real::ZERO; Rows::<RandomField>::words(columns - 1, level)];
        let whole = Rows::new(&terrain, level, &mut memory).unwrap();
        let (width, count) = (whole.width(), whole.count());
        let mut all = vec![Real::ZERO; width * count];
        whole.write(&mut all).unwrap();
        let mut piece = Rows::of(&terrain, level, [1..2, 0..1], level, &mut memory);
        if let Ok(piece) = &mut piece {
            assert_eq!(piece.next_row(), Some(&all[1..3]));
        }
        let eye = [u, v, Coordinate::ONE];
        let rule = Magnification { eye, length: offset, most: 4 };
        assert!(rule.level(terrain.point(0, 0, 0), terrain.point(0, 1, 0)) <= 4);
        let triangles = Triangles::new(&terrain, level, [0, 0], &rule).unwrap();
        assert!((2..=2 * 16 * 16).contains(&triangles.count()));
        let (eye, way, cone, x, y) = view;
        let ray = Ray::new(eye, Vec3::new(way.x, way.y, way.z));
        let over = [[x.min(x + Real::ONE / 2), x.max(Real::ONE)], [y, Real::from_num(63)]];
        if let Ok(deep) = DeepTerrain::new(&terrain, level, over) {
            meet(&deep, &ray, cone);
        }
        let fine = Heights::new(width as u32, count as u32, &all).unwrap();
        let mut ranges = vec![HeightRange::default(); Terrain::ranges(width as u32, count as u32)];
        for inner in [InnerGeometry::Bilinear, InnerGeometry::Ferguson, InnerGeometry::BSpline] {
            let patch = inner.patch(&fine, seed as u32, level);
            let [low, high] = patch.range();
            assert!((low..=high).contains(&patch.height(offset, similarity)));
            let _ = patch.slopes(offset, similarity);
            if let Ok(stored) = Terrain::new(fine, inner, over, &mut ranges) {
                assert_eq!(stored.heights().columns(), width as u32);
                meet(&stored, &ray, cone);
                meet(&stored.with_plain(low), &ray, cone);
            }
        }
        true
    });
}
