//! A height field as a surface of a world: open, its upper side outward.
//!
//! A crossing is the middle of a ray's part inside the box of the first leaf that it meets. Leaves met one
//! right behind the other are one crossing, the first: a ray that leaves the surface is not held up by the
//! boxes through which it gets away from it.

use core::ops::ControlFlow;

use super::super::ray::{Footprint, Ray};
use super::super::surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
use super::field::HeightField;
use super::hierarchy::{Hierarchy, Leaf, Profile};
use super::statistics::Uncounted;
use crate::fif::Cell;
use crate::num::{Real, Unit, Vec3, Wide, product, quotient, unit};

/// How many crossings of a ray are looked for.
const CROSSINGS: u32 = 8;

/// A gap of fewer units of `t` between two leaves is none.
const GAP: i32 = 16;

/// The widest leaf of a profile, 24 fractional bits.
fn widest(profile: &Profile<'_>, depth: u32) -> i32 {
    let ends = profile.starts.iter().skip(1).copied().chain([1 << 31]);
    let widest = profile.starts.iter().zip(ends).map(|(start, end)| end.saturating_sub(*start)).max();
    let part = i64::from(widest.unwrap_or(1 << 31));
    (0..depth).fold(i64::from(profile.width), |width, _| (width * part) >> 31) as i32
}

/// The finest cell at a coordinate, that at the end for what is outside.
fn finest<'a>(profile: &Profile<'a>, depth: u32, c: Real) -> Option<&'a Cell> {
    let count = profile.starts.len() as u32;
    let along = i64::from(c.to_bits()) - i64::from(profile.origin);
    // 31 fractional bits of a node
    let mut place =
        quotient(along, 31, u64::from(profile.width.unsigned_abs())).clamp(0, (1 << 31) - 1) as u32;
    let mut node = 0_u32;
    for _ in 0..depth {
        let mut part = (0_u32, 0, 1 << 31);
        for (k, start) in (0..).zip(profile.starts) {
            if *start <= place {
                part = (k, *start, 1 << 31);
            } else {
                part.2 = part.2.min(*start);
            }
        }
        let (k, start, end) = part;
        node = node.wrapping_mul(count).wrapping_add(1 + k);
        let width = u64::from(end.saturating_sub(start)).max(1);
        place = quotient(place.saturating_sub(start).into(), 31, width).clamp(0, (1 << 31) - 1) as u32;
    }
    profile.cells.get(node as usize)
}

impl HeightField<'_> {
    /// A leaf as a crossing: `from` is where the ray of its span begins.
    fn crossing(&self, ray: &Ray, leaf: &Leaf, from: i32) -> Option<Crossing> {
        let (normal, t) = (self.normal(leaf), self.middle(ray, leaf)?);
        let against = (0..3_usize).map(|k| product(normal[k], ray.direction[k]) >> 2).sum::<i64>() < 0;
        Some(Crossing {
            t: Real::from_bits(from.checked_add(t)?),
            enters: against,
            face: 0,
            memo: [leaf.nodes.0, leaf.nodes.1],
        })
    }
}

impl Surface for HeightField<'_> {
    fn extent(&self) -> Extent {
        let [[x0, x1], [y0, y1], [z0, z1]] = HeightField::extent(self).map(|ends| ends.map(Real::from_bits));
        Extent { low: Vec3::new(x0, y0, z0), high: Vec3::new(x1, y1, z1) }
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        CROSSINGS
    }

    /// As far as the finest leaf is wide along both axes.
    fn error(&self) -> Real {
        let Hierarchy { x, y, depth, .. } = &self.hierarchy;
        Real::from_bits(widest(x, *depth).saturating_add(widest(y, *depth)))
    }

    fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let footprint = Footprint::new(cone).with_width(ray.width);
        // the ray begins anew behind each leaf: `from` is where; a line crosses as many columns and rows
        let (mut rest, mut from, mut left) = (*ray, 0_i32, CROSSINGS);
        let Hierarchy { x, y, depth, .. } = &self.hierarchy;
        let leaves = |profile: &Profile<'_>| (profile.starts.len() as u32).saturating_pow(*depth);
        for k in 0..leaves(x).saturating_add(leaves(y)) {
            let rays = self.pencil::<true>(rest.origin, footprint.after(from));
            let Some(leaf) = self.leaf(&rays, &rest.direction, &mut Uncounted) else { return };
            // right behind the leaf before, it is the same crossing
            if k == 0 || leaf.span.0 > GAP {
                let Some(crossing) = self.crossing(&rest, &leaf, from) else { return };
                left -= 1;
                if found(crossing).is_break() || left == 0 {
                    return;
                }
            }
            let behind = leaf.span.1.max(leaf.span.0).saturating_add(1);
            let Some(sum) = from.checked_add(behind) else { return };
            from = sum;
            let at = ray.at(Real::from_bits(from));
            let origin = [at.x, at.y, at.z].map(Real::to_bits);
            if origin.iter().any(|c| c.unsigned_abs() > 64 << 24) {
                return;
            }
            rest = Ray::from_bits(origin, ray.direction);
        }
    }

    /// The height above the surface by the means of the finest cells, those at the rim outside the domain.
    fn value(&self, place: Vec3) -> Wide {
        let Hierarchy { x, y, depth, .. } = &self.hierarchy;
        let mean = |cell: Option<&Cell>| cell.map_or(0, |cell| cell.mean.to_bits());
        let height = product(mean(finest(x, *depth, place.x)), mean(finest(y, *depth, place.y)));
        Wide::from(place.z) - Wide::from_bits(height)
    }

    /// The normal is the mean normal over the leaf; `u` and `v` go along `x` and `y` from 0 to 1 over the
    /// domain.
    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let leaf = Leaf { nodes: (crossing.memo[0], crossing.memo[1]), span: (0, 0) };
        let normal = self.normal(&leaf);
        let Hierarchy { x, y, .. } = &self.hierarchy;
        let chart = if charted {
            let along = |c: Real, profile: &Profile<'_>| {
                let way = i64::from(c.to_bits()) - i64::from(profile.origin);
                let part = quotient(way, 24, u64::from(profile.width.unsigned_abs()));
                Real::from_bits(part.clamp(0, 1 << 24) as i32)
            };
            let rise = |width: i32, slope: i32| {
                let rise = -(product(width, slope) >> 24);
                Real::from_bits(rise.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
            };
            let (width, depth) = (Real::from_bits(x.width), Real::from_bits(y.width));
            Chart {
                u: along(position.x, x),
                v: along(position.y, y),
                along_u: Vec3::new(width, Real::ZERO, rise(x.width, normal[0])),
                along_v: Vec3::new(Real::ZERO, depth, rise(y.width, normal[1])),
            }
        } else {
            Chart::default()
        };
        SurfacePoint {
            position,
            place: position,
            normal: unit(normal),
            inward: false,
            chart,
            face: 0,
            width: ray.width_at(crossing.t, cone),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::super::exact::{with_polygon, words};
    use super::*;
    use std::vec::Vec;

    fn crossings(surface: &impl Surface, ray: &Ray, cone: Unit) -> Vec<Crossing> {
        let mut all = Vec::new();
        surface.cross(ray, cone, &mut |crossing| {
            all.push(crossing);
            ControlFlow::Continue(())
        });
        all
    }

    const TENT: [(i32, i32); 3] = [(0, 0), (1, 1), (2, 0)];

    /// `h(x, y)` is the product of two tents over `[0, 2]`, in `2^depth` parts along each axis.
    fn with_field(depth: u32, work: impl FnOnce(&HeightField<'_>)) {
        let tent = TENT.map(|(x, y)| (Wide::from_num(x), Wide::from_num(y)));
        with_polygon(&tent, depth, |f| {
            with_polygon(&tent, depth, |g| work(&HeightField::new(f, g).unwrap()));
        });
    }

    fn height(x: f64, y: f64) -> f64 {
        (1.0 - (x - 1.0).abs()).max(0.0) * (1.0 - (y - 1.0).abs()).max(0.0)
    }

    /// The first crossing is that of the leaf that the walk finds, no farther from the surface than a leaf is
    /// high.
    #[test]
    fn a_crossing_is_in_the_middle_of_the_leaf() {
        let mut word = words(43);
        let mut number = |scale: i32| Real::from_bits((word() >> 32) as i32 >> 7) * scale;
        with_field(6, |field| {
            let (mut met, mut below, mut most) = (0, 0, 0.0_f64);
            for _ in 0..4_000 {
                let eye = Vec3::new(number(6), number(6), number(6));
                let to = Vec3::new(number(1) + Real::ONE, number(1) + Real::ONE, number(1));
                let d = to.minus(eye);
                let ray = Ray::new(eye, Vec3::new(d.x / 8, d.y / 8, d.z / 8));
                let all = crossings(field, &ray, Unit::DELTA);
                let hit = field.intersect(&ray, Unit::DELTA);
                assert_eq!(all.is_empty(), hit.is_none());
                let (Some(first), Some(hit)) = (all.first(), hit) else { continue };
                met += 1;
                assert!(first.t == hit.t && all.len() <= 8, "{all:?}");
                assert!(all.windows(2).all(|pair| pair[0].t < pair[1].t), "{all:?}");
                let point = field.point(&ray, Unit::ONE / 4, first, true);
                let normal = hit.normal().normalised().unwrap();
                assert_eq!((point.normal, point.place, point.face), (normal, point.position, 0));
                assert_eq!(point.width, first.t / 4);
                let [x, y, z] =
                    [point.position.x, point.position.y, point.position.z].map(|c| c.to_num::<f64>());
                // above it when it comes from above: leaves are 1/32 wide, and at most twice as high
                let above = z - height(x, y);
                most = most.max(above.abs());
                let from_above = normal.dot(d.normalised().unwrap()) < 0;
                assert_eq!(first.enters, from_above);
                below += u32::from(!from_above);
                for (got, want) in [(point.chart.u, x / 2.0), (point.chart.v, y / 2.0)] {
                    assert!((got.to_num::<f64>() - want.clamp(0.0, 1.0)).abs() < 1e-6);
                }
            }
            assert!(met > 1_500 && below > 300, "{met} {below}");
            assert!(most > 0.01 && most < 0.07, "{most}");
        });
    }

    /// A ray is as wide behind a leaf as before it, and one that starts on another's way with the width that
    /// it has there meets the same leaves, of every level.
    #[test]
    fn a_ray_that_starts_on_its_way_meets_the_same_leaves() {
        let mut word = words(53);
        let mut number = |scale: i32| Real::from_bits((word() >> 32) as i32 >> 7) * scale;
        with_field(6, |field| {
            let (mut same, mut other, mut levels) = ([0; 2], [0; 2], [0; 7]);
            for k in 0..3_000 {
                let eye = Vec3::new(number(6), number(6), number(2));
                let to = Vec3::new(number(1) + Real::ONE, number(1) + Real::ONE, number(1) / 4);
                let d = to.minus(eye);
                let ray = Ray::new(eye, Vec3::new(d.x / 8, d.y / 8, d.z / 8));
                let cone = Unit::from_bits(1 << (20 + k % 8));
                for (n, crossing) in crossings(field, &ray, cone).into_iter().take(2).enumerate() {
                    // a quarter of a leaf's side before it
                    let level = field.hierarchy.x.level_and_index(crossing.memo[0]).0;
                    let t = crossing.t - Real::ONE / 8;
                    if t < 0 {
                        continue;
                    }
                    let later = Ray::new(ray.at(t), Vec3::new(d.x / 8, d.y / 8, d.z / 8));
                    let later = later.with_width(ray.width_at(t, cone));
                    match crossings(field, &later, cone).first() {
                        Some(again) if again.memo == crossing.memo => same[n] += 1,
                        _ => other[n] += 1,
                    }
                    levels[level as usize] += 1;
                }
            }
            // some start inside the leaf before it
            assert!(same[0] > 1_000 && same[1] > 100, "{same:?} {other:?}");
            assert!(other[0] < same[0] / 8 && other[1] < same[1] / 4, "{same:?} {other:?}");
            assert!(levels.iter().filter(|count| **count > 50).count() > 4, "{levels:?}");
        });
    }

    /// Through a ridge: into it, out of it on the other side, each once, as leaves next to each other are one
    /// crossing; straight up from below one.
    #[test]
    fn a_ray_through_a_ridge_crosses_it_twice() {
        with_field(7, |field| {
            let ray = |x: &str, y: &str, z: &str, d: Vec3| {
                let [x, y, z] = [x, y, z].map(|c| Real::from_num(c.parse::<f64>().unwrap()));
                Ray::new(Vec3::new(x, y, z), d)
            };
            let through = crossings(field, &ray("-1", "1", "0.5", Vec3::X), Unit::DELTA);
            let ends: Vec<f64> = through.iter().map(|c| c.t.to_num()).collect();
            assert_eq!(through.iter().map(|c| c.enters).collect::<Vec<_>>(), [true, false], "{ends:?}");
            // at x = 1/2 and x = 3/2, to a leaf of 1/64
            assert!((ends[0] - 1.5).abs() < 0.02 && (ends[1] - 2.5).abs() < 0.02, "{ends:?}");
            let up = crossings(field, &ray("0.3", "0.4", "-3", Vec3::Z), Unit::DELTA);
            assert_eq!(up.iter().map(|c| c.enters).collect::<Vec<_>>(), [false]);
            assert!((up[0].t.to_num::<f64>() - 3.12).abs() < 0.02);
            assert_eq!(crossings(field, &ray("0.3", "0.4", "3", Vec3::Z), Unit::DELTA), []);
            // who breaks off is asked no more
            let mut asked = 0;
            field.cross(&ray("-1", "1", "0.5", Vec3::X), Unit::DELTA, &mut |_| {
                asked += 1;
                ControlFlow::Break(())
            });
            assert_eq!(asked, 1);
            // 1/64 along both
            assert_eq!((field.error(), field.is_closed()), (Real::ONE / 32, false));
            let Extent { low, high } = Surface::extent(field);
            assert!(low.x == 0 && low.y == 0 && high.x == 2 && high.y == 2, "{low:?} {high:?}");
            let (down, up) = (low.z.to_num::<f64>(), high.z.to_num::<f64>());
            assert!((-1e-6..=0.0).contains(&down) && (1.0..1.000_001).contains(&up), "{down} {up}");
        });
    }

    /// Above it the height over the finest cells' means, outside the domain that of the rim.
    #[test]
    fn a_value_is_the_height_above_the_surface() {
        with_field(8, |field| {
            let mut word = words(47);
            let mut worst = 0.0_f64;
            for _ in 0..3_000 {
                let mut number = || Real::from_bits((word() >> 32) as i32 >> 6);
                let place = Vec3::new(number(), number(), number());
                let [x, y, z] = [place.x, place.y, place.z].map(|c| c.to_num::<f64>());
                worst = worst.max((field.value(place).to_num::<f64>() - (z - height(x, y))).abs());
            }
            // cells are 1/128 wide, and their means half of that from their ends
            assert!(worst > 1e-3 && worst < 1.0 / 128.0, "{worst}");
        });
    }
}
