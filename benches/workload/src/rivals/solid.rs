//! Generic solids in floating point: the same crossings of the same rays, by the formulas of a textbook.

use super::vector::{Vector, dot};
use crate::float::Float;

/// A place and a direction.
pub(crate) type Line<F> = (Vector<F>, Vector<F>);

/// Both crossings of the sphere of radius 1.
#[inline(always)]
pub(crate) fn sphere<F: Float>((o, d): Line<F>) -> Option<[F; 2]> {
    let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - F::of(1.0));
    let discriminant = b.fused(b, -(a * c));
    if discriminant > F::of(0.0) {
        let (root, scale) = (discriminant.root(), F::of(1.0) / a);
        Some([(-b - root) * scale, (root - b) * scale])
    } else {
        None
    }
}

/// The crossing of the square.
#[inline(always)]
pub(crate) fn square<F: Float>(([ox, oy, oz], [dx, dy, dz]): Line<F>) -> Option<F> {
    let s = -oz / dz;
    let (x, y, one) = (dx.fused(s, ox), dy.fused(s, oy), F::of(1.0));
    (x.most(-x) <= one && y.most(-y) <= one).then_some(s)
}

/// Both crossings of a box and their faces.
#[inline(always)]
fn slabs<F: Float>((o, d): Line<F>, low: Vector<F>, high: Vector<F>) -> Option<[(F, u32); 2]> {
    let mut part = [(F::of(-1e30), 0), (F::of(1e30), 0)];
    let mut face = 0;
    for (((o, d), low), high) in o.into_iter().zip(d).zip(low).zip(high) {
        let scale = F::of(1.0) / d;
        let (a, b) = ((low - o) * scale, (high - o) * scale);
        let (near, far) = if a < b { ((a, face), (b, face + 1)) } else { ((b, face + 1), (a, face)) };
        if near.0 > part[0].0 {
            part[0] = near;
        }
        if far.0 < part[1].0 {
            part[1] = far;
        }
        face += 2;
    }
    (part[0].0 < part[1].0).then_some(part)
}

/// Both crossings of the cube and their faces.
#[inline(always)]
pub(crate) fn cube<F: Float>(line: Line<F>) -> Option<[(F, u32); 2]> {
    slabs(line, [F::of(-1.0); 3], [F::of(1.0); 3])
}

/// Both crossings of the tapered cylinder with a cap of 1/2, and their faces.
#[inline(always)]
pub(crate) fn tapered<F: Float>((o, d): Line<F>) -> Option<[(F, u32); 2]> {
    let (one, taper) = (F::of(1.0), F::of(-0.5));
    let scale = one / d[2];
    let (base, cap) = (-o[2] * scale, (one - o[2]) * scale);
    let mut part = if base < cap { [(base, 1), (cap, 2)] } else { [(cap, 2), (base, 1)] };
    let (e, de) = (taper.fused(o[2], one), taper * d[2]);
    let a = d[0].fused(d[0], d[1] * d[1]) - de * de;
    let b = o[0].fused(d[0], o[1] * d[1]) - e * de;
    let c = o[0].fused(o[0], o[1] * o[1]) - e * e;
    let discriminant = b.fused(b, -(a * c));
    let zero = F::of(0.0);
    if discriminant > zero {
        let (root, scale) = (discriminant.root(), one / a);
        let (x, y) = ((-b - root) * scale, (root - b) * scale);
        let (first, second) = if x < y { (x, y) } else { (y, x) };
        if a > zero {
            if first > part[0].0 {
                part[0] = (first, 0);
            }
            if second < part[1].0 {
                part[1] = (second, 0);
            }
        } else if part[0].0 < first {
            if first < part[1].0 {
                part[1] = (first, 0);
            }
        } else if second > part[0].0 {
            part[0] = (second, 0);
        }
    } else if a >= zero {
        return None;
    }
    (part[0].0 < part[1].0).then_some(part)
}

/// An affine map: what it adds, and its rows.
pub(crate) type Map<F> = (Vector<F>, [Vector<F>; 3]);

/// Origin and direction under the map.
#[inline(always)]
pub(crate) fn carried<F: Float>((o, d): Line<F>, (centre, rows): &Map<F>) -> Line<F> {
    let w = [o[0] - centre[0], o[1] - centre[1], o[2] - centre[2]];
    let [o, d] = [w, d].map(|v| rows.map(|row| dot(row, v)));
    (o, d)
}

/// The same; none where the line passes the ball round the origin with this squared
/// radius.
#[inline(always)]
pub(crate) fn mapped<F: Float>(line: Line<F>, map: &Map<F>, ball: F) -> Option<Line<F>> {
    let (o, d) = carried(line, map);
    let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - ball);
    (b * b > a * c).then_some((o, d))
}
