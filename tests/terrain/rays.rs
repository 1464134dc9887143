//! Rays at terrain: watertight, and crossed where the reference changes sides.

use std::ops::ControlFlow;

use attractor::num::{RandomField, Real, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, PlaneToLine};
use attractor::trace::{Crossing, DeepTerrain, HeightRange, Ray, Surface, Terrain};
use attractor_reference::terrain as reference;

use super::{INNER, OVER, Uniform, grid, knots, lattice, law, real};

/// All crossings of a ray.
fn crossings(surface: &impl Surface, ray: &Ray, cone: Unit) -> Vec<Crossing> {
    let mut all = Vec::new();
    surface.cross(ray, cone, &mut |crossing| {
        all.push(crossing);
        ControlFlow::Continue(())
    });
    all
}

/// A landscape of 32 x 32 cells over ±1.
fn with_landscape(work: impl Fn(Heights<'_>, &PlaneToLine<'_>)) {
    let given = knots(9, 12);
    let terrain =
        PlaneToLine::new(Heights::new(3, 3, &given).unwrap(), law(0.25, 0.8), RandomField::new(6)).unwrap();
    let (width, count, all) = lattice(&terrain, 4);
    work(Heights::new(width, count, &all).unwrap(), &terrain);
}

fn vector(v: [f64; 3]) -> Vec3 {
    Vec3::new(real(v[0]), real(v[1]), real(v[2]))
}

/// Rays from above that pass exactly through edges and corners of cells, not so near the rim that they could
/// leave the square above the ground, end below: all meet the surface, an odd number of times.
fn rays_through_edges(count: u32) {
    with_landscape(|heights, terrain| {
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        let deep = DeepTerrain::new(terrain, 4, OVER).unwrap();
        for (inner, _) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap();
            let mut uniform = Uniform(13);
            let mut met = 0;
            for k in 0..count {
                // a point on an edge and a direction, both such that the ray passes it exactly
                let on = |uniform: &mut Uniform| f64::from(uniform.below(27) + 3) / 16.0 - 1.0;
                let (edge, off) = (on(&mut uniform), uniform.next() * 1.6 - 0.8);
                let off = (off * 65_536.0).round() / 65_536.0;
                let (x, y) = match k % 3 {
                    0 => (edge, off),
                    1 => (off, edge),
                    _ => (edge, on(&mut uniform)),
                };
                let lean = |uniform: &mut Uniform| f64::from(uniform.below(9)) / 64.0 - 1.0 / 16.0;
                let (dx, dy) = (lean(&mut uniform), lean(&mut uniform));
                let from = [x - 8.0 * dx, y - 8.0 * dy, 8.0];
                let ray = Ray::new(vector(from), vector([dx, dy, -1.0]));
                let all = crossings(&stored, &ray, Unit::ZERO);
                assert!(all.len() % 2 == 1 && all[0].enters, "{inner:?} {x} {y} {dx} {dy}: {all:?}");
                if inner == InnerGeometry::Bilinear {
                    let alone = crossings(&deep, &ray, Unit::ZERO);
                    assert!(alone.len() % 2 == 1 && alone[0].enters, "{x} {y} {dx} {dy}: {alone:?}");
                }
                met += all.len();
            }
            assert!(met >= count as usize, "{met}");
        }
    });
}

#[test]
fn a_surface_is_watertight_under_rays_through_its_edges() {
    rays_through_edges(4000);
}

#[test]
#[ignore = "ten seconds of a release build: a million rays for each inner geometry"]
fn a_surface_is_watertight_under_a_million_rays() {
    rays_through_edges(1_000_000);
}

/// Crossings lie on the reference's surface, sides alternate, and a walk along the ray in f64 finds no more:
/// no thin hill is missed. The surface by bounds alone has the crossings of the stored one.
#[test]
fn crossings_are_where_the_reference_changes_sides() {
    with_landscape(|heights, terrain| {
        let exactly = grid(&heights);
        let deep = DeepTerrain::new(terrain, 4, OVER).unwrap();
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        for (inner, exact) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap();
            let over = |[x, y, z]: [f64; 3]| {
                z - reference::spanned(&exactly, exact, 16.0 * (x + 1.0), 16.0 * (y + 1.0))[0]
            };
            let mut uniform = Uniform(14);
            let (mut worst, mut met, mut thin, mut tilted) = (0.0_f64, 0, 0, 0.0_f64);
            for _ in 0..600 {
                let mut place = |size: f64| (uniform.next() * 2.0 - 1.0) * size;
                let (eye, target) =
                    ([place(2.0), place(2.0), place(1.0)], [place(0.9), place(0.9), place(0.8)]);
                let off: Vec<f64> = (0..3).map(|k| target[k] - eye[k]).collect();
                let length = off.iter().map(|c| c * c).sum::<f64>().sqrt();
                let ray = Ray::new(vector(eye), vector([0, 1, 2].map(|k: usize| off[k] / length)));
                let all = crossings(&stored, &ray, Unit::ZERO);
                let d = [ray.direction().x, ray.direction().y, ray.direction().z].map(|c| c.to_num::<f64>());
                let o = [ray.origin().x, ray.origin().y, ray.origin().z].map(|c| c.to_num::<f64>());
                let at = |t: f64| [0, 1, 2].map(|k: usize| o[k] + t * d[k]);
                for (k, crossing) in all.iter().enumerate() {
                    let place = at(crossing.t.to_num());
                    worst = worst.max(over(place).abs());
                    assert!(k == 0 || all[k - 1].enters != crossing.enters && all[k - 1].t <= crossing.t);
                    let point = stored.point(&ray, Unit::ZERO, crossing, true);
                    let [_, along_u, along_v] =
                        reference::spanned(&exactly, exact, 16.0 * (place[0] + 1.0), 16.0 * (place[1] + 1.0));
                    let (p, q) = (16.0 * along_u, 16.0 * along_v);
                    let long = (p * p + q * q + 1.0).sqrt();
                    let n = [point.normal.x, point.normal.y, point.normal.z].map(|c| c.to_num::<f64>());
                    let tilt = [n[0] + p / long, n[1] + q / long, n[2] - 1.0 / long];
                    // near an edge of bilinear patches the next cell has another normal
                    let near = |c: f64| (16.0 * c - (16.0 * c).round()).abs() < 1e-3;
                    if !near(place[0]) && !near(place[1]) {
                        tilted = tilt.iter().fold(tilted, |worst, c| worst.max(c.abs()));
                    }
                }
                // sides in f64, as far as they are sure
                let inside = |p: [f64; 3]| p[0].abs() < 1.0 && p[1].abs() < 1.0;
                let sides: Vec<bool> = (0..2000)
                    .map(|k| at(f64::from(k) * 0.003))
                    .filter(|p| inside(*p) && over(*p).abs() > 1e-5)
                    .map(|p| over(p) > 0.0)
                    .collect();
                let changes = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
                assert!(changes.min(8) <= all.len(), "{inner:?}: {changes} {all:?}");
                thin += usize::from(all.len() > changes);
                met += all.len();
                if inner == InnerGeometry::Bilinear {
                    let alone = crossings(&deep, &ray, Unit::ZERO);
                    assert_eq!(alone.len(), all.len());
                    for (a, b) in alone.iter().zip(&all) {
                        let apart = a.t.to_num::<f64>() - b.t.to_num::<f64>();
                        assert!(a.enters == b.enters && apart.abs() < 1e-4, "{a:?} {b:?}");
                    }
                    let coarse = crossings(&deep, &ray, Unit::from_num(0.5));
                    assert!(coarse.len() <= 8);
                }
            }
            println!("{inner:?}: {met} crossings within {worst:e}, {thin} thin, normals within {tilted:e}");
            assert!(met > 600 && worst > 1e-7 && worst < 1e-5 && tilted < 1e-3, "{met} {worst:e} {tilted:e}");
        }
    });
}

/// Walls of 120 over cells of 2^-12, where rounding of a place moves the height by many units: still
/// watertight.
#[test]
fn a_surface_is_watertight_however_steep_it_is() {
    let mut uniform = Uniform(31);
    let heights: Vec<Real> =
        (0..81).map(|_| real(if uniform.below(2) == 0 { -60.0 } else { 60.0 })).collect();
    let heights = Heights::new(9, 9, &heights).unwrap();
    let over = [[real(0.0), real(1.0 / 512.0)]; 2];
    let (mut met, mut most) = (0, 0);
    for (inner, _) in INNER {
        let mut memory = [HeightRange::default(); Terrain::ranges(9, 9)];
        // Ferguson's slopes leave the range
        let Ok(stored) = Terrain::new(heights, inner, over, &mut memory) else { continue };
        for _ in 0..4000 {
            let mut place = || {
                let edge = f64::from(uniform.below(7) + 1);
                (if uniform.below(2) == 0 { edge } else { 0.5 + 7.0 * uniform.next() }) / 4096.0
            };
            let (from, to) = ([place(), place()], [place(), place()]);
            let lean = [0, 1].map(|k: usize| (to[k] - from[k]) / 126.0);
            let ray = Ray::new(vector([from[0], from[1], 63.0]), vector([lean[0], lean[1], -1.0]));
            let d = [ray.direction().x, ray.direction().y].map(|c| c.to_num::<f64>());
            let o = [ray.origin().x, ray.origin().y].map(|c| c.to_num::<f64>());
            let all = crossings(&stored, &ray, Unit::ZERO);
            // the last that is looked for may be any
            assert!(all.len() == 8 || all.len() % 2 == 1, "{inner:?} {from:?} {to:?}: {all:?}");
            for (k, crossing) in all.iter().enumerate() {
                assert_eq!(crossing.enters, k % 2 == 0);
                // the cell where it is
                let [cell, level] = crossing.memo;
                for (axis, index) in [cell >> 16, cell & 0xffff].into_iter().enumerate() {
                    let place = 4096.0 * (o[axis] + d[axis] * crossing.t.to_num::<f64>());
                    assert!(level == 0 && (place - f64::from(index) - 0.5).abs() < 0.51, "{place} {index}");
                }
            }
            met += all.len();
            most = most.max(all.len());
        }
    }
    assert!(met > 8000 && most >= 5, "{met} {most}");
}

/// From below the plain a ray comes out where land and plain end, not at the plain under the land; sides
/// alternate.
#[test]
fn a_ray_from_below_comes_out_of_the_higher_of_land_and_plain() {
    with_landscape(|heights, _| {
        let exactly = grid(&heights);
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        let level = 0.05;
        for (inner, exact) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap().with_plain(real(level));
            let mut uniform = Uniform(16);
            let mut faces = [0; 2];
            for _ in 0..400 {
                let mut place = |size: f64| (uniform.next() * 2.0 - 1.0) * size;
                let ray = Ray::new(vector([place(0.8), place(0.8), -1.5]), vector([0.0, 0.0, 1.0]));
                let all = crossings(&stored, &ray, Unit::ZERO);
                assert!(
                    all.windows(2).all(|pair| pair[0].enters != pair[1].enters && pair[0].t <= pair[1].t)
                );
                let [x, y] = [ray.origin().x, ray.origin().y].map(|c| c.to_num::<f64>());
                let land = reference::spanned(&exactly, exact, 16.0 * (x + 1.0), 16.0 * (y + 1.0))[0];
                let height = -1.5 + all[0].t.to_num::<f64>();
                assert!(
                    !all[0].enters && (height - land.max(level)).abs() < 1e-5,
                    "{inner:?} {land} {height}"
                );
                if (land - level).abs() > 1e-4 {
                    assert_eq!((all.len(), all[0].face), (1, u8::from(land < level)), "{inner:?} {land}");
                    faces[usize::from(all[0].face)] += 1;
                }
            }
            assert!(faces.iter().all(|count| *count > 60), "{faces:?}");
        }
    });
}

/// A plain above the summit covers all, from below as from above, and is within the extent; so is one far
/// below.
#[test]
fn a_plain_above_or_below_all_land_is_there() {
    with_landscape(|heights, _| {
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        let (inner, _) = INNER[0];
        let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap().with_plain(real(3.0));
        for (from, towards) in [(2.7, 0.3), (-1.5, 1.0), (6.0, -1.0)] {
            let ray = Ray::new(vector([0.3, 0.2, from]), vector([0.01, 0.02, towards]));
            let all = crossings(&stored, &ray, Unit::ZERO);
            let height = from + all[0].t.to_num::<f64>() * towards;
            assert!((height - 3.0).abs() < 1e-5 && all[0].face == 1, "{from}: {all:?}");
        }
        assert!(stored.extent().high.z >= real(3.0));
        let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap().with_plain(real(-5.0));
        assert!(stored.extent().low.z <= real(-5.0));
        let ray = Ray::new(vector([9.0, 0.2, 4.0]), vector([0.0, 0.0, -1.0]));
        assert_eq!(crossings(&stored, &ray, Unit::ZERO).len(), 1);
    });
}

/// Land on a plain is the higher of both: the first crossing, on which face it is, and the normal there,
/// against a walk along the ray in f64.
#[test]
fn a_ray_meets_the_land_or_the_plain_whichever_is_higher() {
    with_landscape(|heights, _| {
        let exactly = grid(&heights);
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        let level = 0.05;
        for (inner, exact) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap().with_plain(real(level));
            let land = |[x, y]: [f64; 2]| {
                if x.abs() > 1.0 || y.abs() > 1.0 {
                    return f64::MIN;
                }
                reference::spanned(&exactly, exact, 16.0 * (x + 1.0), 16.0 * (y + 1.0))[0]
            };
            let over = |[x, y, z]: [f64; 3]| z - land([x, y]).max(level);
            let mut uniform = Uniform(15);
            let (mut faces, mut walls) = ([0; 3], 0);
            for _ in 0..800 {
                let mut place = |size: f64| (uniform.next() * 2.0 - 1.0) * size;
                let eye = [place(2.5), place(2.5), 1.6 + place(0.5)];
                let target = [place(1.6), place(1.6), place(0.7)];
                let off = [0, 1, 2].map(|k: usize| target[k] - eye[k]);
                let length = off.iter().map(|c| c * c).sum::<f64>().sqrt();
                let ray = Ray::new(vector(eye), vector(off.map(|c| c / length)));
                let d = [ray.direction().x, ray.direction().y, ray.direction().z].map(|c| c.to_num::<f64>());
                let o = [ray.origin().x, ray.origin().y, ray.origin().z].map(|c| c.to_num::<f64>());
                let at = |t: f64| [0, 1, 2].map(|k: usize| o[k] + t * d[k]);
                let first = crossings(&stored, &ray, Unit::ZERO).first().copied();
                let exact = (1..8000).map(|k| f64::from(k) * 0.001).find(|t| over(at(*t)) < -1e-5);
                // the wall at the rim of the land is open
                let rim = |[x, y, _]: [f64; 3]| x.abs().max(y.abs()) - 1.0;
                if exact.is_some_and(|exact| rim(at(exact)).abs() < 0.003) {
                    walls += 1;
                    continue;
                }
                let (Some(first), Some(exact)) = (first, exact) else {
                    // up into the sky, or along the horizon
                    assert!(exact.is_none() && (d[2] > -0.02 || first.is_none() || first.unwrap().t > 7));
                    faces[2] += 1;
                    continue;
                };
                let (t, place) = (first.t.to_num::<f64>(), at(first.t.to_num()));
                // the wall at the rim of the land is open
                if over(at(exact)) < -0.02 {
                    walls += 1;
                    continue;
                }
                assert!(
                    first.enters && over(place).abs() < 1e-5 && t < exact,
                    "{inner:?} {place:?} {t} {exact}"
                );
                let is_plain = land([place[0], place[1]]) < level;
                if (land([place[0], place[1]]) - level).abs() > 1e-4 {
                    assert_eq!(first.face, u8::from(is_plain), "{inner:?} {place:?}");
                    let point = stored.point(&ray, Unit::ZERO, &first, true);
                    assert_eq!((point.face, point.normal.z == 1), (first.face, is_plain));
                    faces[usize::from(first.face)] += 1;
                }
                let off = vector([place[0], place[1], place[2] + 0.01]);
                assert!(
                    (stored.value(off).to_num::<f64>() - over([place[0], place[1], place[2] + 0.01])).abs()
                        < 1e-5
                );
            }
            println!("{inner:?}: land, plain and sky {faces:?}");
            assert!(faces[0] > 150 && faces[1] > 150 && walls < 100, "{faces:?} {walls}");
            assert_eq!((stored.faces(), stored.most_crossings()), (2, 9));
            // below it nothing is looked for; from below it is crossed upwards
            let up = Ray::new(vector([1.5, 0.0, -1.0]), vector([0.0, 0.0, 1.0]));
            let all = crossings(&stored, &up, Unit::ZERO);
            assert!(all.len() == 1 && !all[0].enters && all[0].face == 1, "{all:?}");
        }
    });
}
