//! Judges convex shapes by double precision: rays made up at random, grazing and special ones among them.

use core::ops::ControlFlow;
use std::vec::Vec;

use super::super::exact::words;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::num::{Near, Vec3};

pub(super) type V = [f64; 3];

pub(super) fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `o + s d`.
pub(super) fn along(o: V, d: V, s: f64) -> V {
    [o[0] + s * d[0], o[1] + s * d[1], o[2] + s * d[2]]
}

fn numbers(v: Vec3<Near>) -> V {
    [v.x, v.y, v.z].map(|c| c.to_num::<f64>())
}

pub(super) fn vector([x, y, z]: [i32; 3]) -> Vec3<Near> {
    Vec3::new(Near::from_bits(x), Near::from_bits(y), Near::from_bits(z))
}

/// All crossings from `from` on.
pub(super) fn crossings(shape: &impl Shape, ray: &NearRay, from: Near) -> Vec<NearCrossing> {
    let mut all = Vec::new();
    shape.cross(ray, from, &mut |crossing| {
        all.push(crossing);
        ControlFlow::Continue(())
    });
    // whoever breaks off is asked no more
    let mut asked = 0;
    shape.cross(ray, from, &mut |_| {
        asked += 1;
        ControlFlow::Break(())
    });
    assert_eq!(asked, all.len().min(1));
    all
}

/// Rays near a shape within ±2: in any direction; with components of 0, very small ones and equal ones; from
/// near an edge or an axis.
pub(super) fn rays(seed: u64) -> impl Iterator<Item = NearRay> {
    let mut word = words(seed);
    core::iter::from_fn(move || {
        const ONE: i32 = 1 << 28;
        let mut direction = [(); 3].map(|()| match word() % 16 {
            0 => 0,
            1 => (word() >> 32) as i32 >> (3 + word() % 28),
            2 => ONE,
            _ => (word() >> 32) as i32 >> 2,
        });
        // the greatest in [1, 2)
        let greatest = direction.iter().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        if greatest < ONE as u32 {
            direction[(word() % 3) as usize] = ONE + (word() >> 36) as i32;
        }
        let direction = direction.map(|c| c.clamp(1 - 2 * ONE, 2 * ONE - 1));
        // a place that the ray passes: anywhere within ±1.5, or special in some coordinates
        let place = [(); 3].map(|()| match word() % 10 {
            0 => 0,
            1 => ONE - (word() >> 40) as i32 % 64,
            2 => (word() >> 60) as i32 - ONE,
            _ => ((word() >> 32) as i32 >> 3) + ((word() >> 32) as i32 >> 4),
        });
        // begin before or behind it, mostly near
        let back = if word().is_multiple_of(8) { 0 } else { (word() >> 32) as i32 >> (3 + word() % 2) };
        let origin = [0, 1, 2].map(|k: usize| {
            place[k].wrapping_sub(((i64::from(direction[k]) * i64::from(back)) >> 28) as i32)
        });
        Some(NearRay { origin: vector(origin), direction: vector(direction) })
    })
    .filter(|ray| [ray.origin.x, ray.origin.y, ray.origin.z].iter().all(|c| c.abs() <= 4))
}

/// What was seen.
#[derive(Debug, Default)]
pub(super) struct Seen {
    /// Rays whose crossings were counted.
    pub(super) judged: u32,
    /// Crossings.
    pub(super) met: u32,
    /// The greatest distance of a crossing from the surface.
    pub(super) off: f64,
    /// Crossings of each face.
    pub(super) faces: [u32; 8],
}

/// Judges a convex solid. `part` is the part of a ray inside the solid grown by an offset, `heights` the
/// distances of a place above each face's surface: that of the crossing's face has to be 0, all others 0 or
/// less. A ray that enters the solid shrunk by `2^-20` has to meet it, one that passes the solid grown by as
/// much may not.
pub(super) fn convex<const F: usize>(
    shape: &impl Shape,
    count: usize,
    part: impl Fn(V, V, f64) -> Option<[f64; 2]>,
    heights: impl Fn(V) -> [f64; F],
) -> Seen {
    let (mut seen, nearly) = (Seen::default(), 2_f64.powi(-20));
    for (k, ray) in rays(17).take(count).enumerate() {
        let (o, d) = (numbers(ray.origin), numbers(ray.direction));
        let from = if k % 2 == 0 { Near::MIN } else { Near::ZERO };
        let all = crossings(shape, &ray, from);
        for crossing in &all {
            let heights = heights(along(o, d, crossing.s.to_num()));
            let own = heights[usize::from(crossing.face)];
            let off = heights.iter().fold(own.abs(), |most, h| most.max(*h));
            assert!(off < 2_f64.powi(-22), "{ray:?} {crossing:?} {heights:?}");
            seen.off = seen.off.max(off);
            seen.met += 1;
            seen.faces[usize::from(crossing.face)] += 1;
        }
        assert!(all.iter().all(|c| c.s >= from), "{ray:?} {all:?}");
        assert!(all.windows(2).all(|w| w[0].s <= w[1].s && w[0].enters != w[1].enters), "{all:?}");
        let (inner, outer) = (part(o, d, -nearly), part(o, d, nearly));
        let exact = part(o, d, 0.0);
        let (Some([begin, end]), Some(_)) = (exact, inner) else {
            if outer.is_none() {
                assert!(all.is_empty(), "{ray:?} passes by: {all:?}");
                seen.judged += 1;
            }
            continue;
        };
        // a crossing where the ray begins may be found or not
        let start = from.to_num::<f64>();
        let slack = 2_f64.powi(-18);
        if (begin - start).abs() < slack || (end - start).abs() < slack {
            continue;
        }
        let want = u32::from(begin > start) + u32::from(end > start);
        assert_eq!(all.len() as u32, want, "{ray:?}: {begin} to {end}, {all:?}");
        assert!(want != 1 || !all[0].enters, "{ray:?}: {all:?}");
        assert!(want != 2 || all[0].enters, "{ray:?}: {all:?}");
        seen.judged += 1;
    }
    seen
}

/// The part of a ray inside planes, each `[n_x, n_y, n_z, d]`: `n p <= d`.
pub(super) fn inside(planes: &[[f64; 4]], o: V, d: V) -> Option<[f64; 2]> {
    let (mut begin, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
    for [x, y, z, distance] in planes {
        let (height, up) = (dot([*x, *y, *z], o) - distance, dot([*x, *y, *z], d));
        if up < 0.0 {
            begin = begin.max(-height / up);
        } else if up > 0.0 {
            end = end.min(-height / up);
        } else if height > 0.0 {
            return None;
        }
    }
    (begin < end).then_some([begin, end])
}
