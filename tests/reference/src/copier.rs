//! The copier: all images of a list of points under the maps composed of `k` of a system's.
//!
//! Source: course unit V, section 5.3.3, `superCopier`. The text errs here: each map makes as many new points
//! as there are, and all images are drawn. The maps are applied to the points one after the other, the last
//! of the composition first; nothing is composed.

/// An affine map `[a, b, c, d, e, f]`: `x' = a x + b y + e`, `y' = c x + d y + f`.
pub type Affine = [f64; 6];

/// The `k`-th iterate, image by image: all that begin with the first map, then the second.
pub fn super_copier(maps: &[Affine], points: &[(f64, f64)], k: u32) -> Vec<(f64, f64)> {
    if k == 0 {
        return points.to_vec();
    }
    let before = super_copier(maps, points, k - 1);
    let image = |m: &Affine, (x, y): (f64, f64)| (m[0] * x + m[1] * y + m[4], m[2] * x + m[3] * y + m[5]);
    maps.iter().flat_map(|m| before.iter().map(move |p| image(m, *p))).collect()
}
