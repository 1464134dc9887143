//! A sheet of control heights as a surface of a world: open, over `[0, 1] x [0, 1]`, its upper side outward.
//!
//! No pyramid is stored: a cell knows its control heights, from which follow rigorous bounds and the control
//! heights of its `N x N` parts. A ray goes through the parts of a cell in the order in which it meets them,
//! from plane to plane, and down into those whose box it meets, with a frame a level. A part is a leaf at the
//! deepest level, or where it is no wider than the ray's cone; a crossing is where the ray comes into the box
//! of a leaf, as with a [`HeightField`](super::HeightField). Planes are the same numbers for the parts on
//! both sides, so that no ray passes between them.
//!
//! Source: Cochran, Lewis, Hart, "The Normal of a Fractal Surface", section 4, for the walk; Tosan, Guerin,
//! Baskurt, section 6.1, for control points of parts. Formats: lengths and `t` 24 fractional bits, directions
//! 28.

use core::ops::ControlFlow;

use super::ray::{Axis, Footprint, Ray};
use super::surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
use crate::Error;
use crate::num::formats::Q24;
use crate::num::{Real, Unit, Vec3, Wide, product, unit};
use crate::patch::{CORNERS, Scheme, Sheet, mean_normal};

/// The deepest level.
const MAX_DEPTH: usize = 12;

/// How many crossings of a ray are looked for.
const CROSSINGS: u32 = 8;

/// A gap of fewer units of `t` between two leaves is none.
const GAP: i32 = 16;

/// A sheet that rays meet.
#[derive(Debug, Clone, Copy)]
pub struct PatchSurface<'a, S, const J: usize> {
    sheet: Sheet<'a, S, J>,
    depth: u32,
    heights: [Q24; 2],
}

/// A node on the way down: its control heights, where it is, and which part the ray is in.
#[derive(Debug, Clone, Copy)]
struct Frame<const J: usize> {
    heights: [Q24; J],
    /// Its number along both axes at its level.
    place: [u32; 2],
    /// The part that comes next, and from where on the ray is in it.
    part: [u32; 2],
    from: i32,
    /// Where the ray leaves the node.
    until: i32,
}

/// A leaf that a ray meets: level, number and the ray's part in its box.
#[derive(Debug, Clone, Copy)]
struct Leaf {
    level: u32,
    place: [u32; 2],
    span: (i32, i32),
}

/// A leaf at which a ray comes in, and its control heights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Struck<const J: usize> {
    pub(super) t: Q24,
    pub(super) level: u32,
    pub(super) heights: [Q24; J],
}

impl<'a, S: Scheme<J>, const J: usize> PatchSurface<'a, S, J> {
    /// The sheet down to `depth` levels below its cells.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a depth above 12, or so deep that a side has more than `2^20` parts; for
    /// heights that are not proven to stay within ±64.
    pub fn new(sheet: Sheet<'a, S, J>, depth: u32) -> Result<Self, Error> {
        let parts = S::BASE.checked_pow(depth).and_then(|parts| parts.checked_mul(sheet.cells()));
        if depth > MAX_DEPTH as u32 || parts.is_none_or(|parts| parts > 1 << 20) {
            let is_room = |depth: &u32| {
                S::BASE.checked_pow(*depth).and_then(|parts| parts.checked_mul(sheet.cells()))
                    <= Some(1 << 20)
            };
            let most = (0..=MAX_DEPTH as u32).take_while(is_room).last().unwrap_or(0);
            let (value, max) = (Wide::saturating_from_num(depth), Wide::from_num(most));
            return Err(Error::OutOfRange { what: "depth", index: None, value, min: Wide::ZERO, max });
        }
        let mut heights = [i32::MAX, i32::MIN];
        for i in 0..sheet.cells() {
            for j in 0..sheet.cells() {
                let [low, high] = sheet.scheme().bounds(&sheet.cell([i, j]));
                heights = [heights[0].min(low), heights[1].max(high)];
            }
        }
        if let Some(beyond) = heights.iter().find(|height| height.unsigned_abs() > 64 << 24) {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            let value = Real::from_bits(*beyond).into();
            return Err(Error::OutOfRange { what: "height", index: None, value, min, max });
        }
        Ok(Self { sheet, depth, heights })
    }

    /// How many levels there are below the cells.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// Rigorous bounds of all heights.
    pub const fn heights(&self) -> (Real, Real) {
        (Real::from_bits(self.heights[0]), Real::from_bits(self.heights[1]))
    }

    /// How many nodes of a level lie along a side.
    pub(super) fn parts(&self, level: u32) -> u32 {
        S::BASE.saturating_pow(level).saturating_mul(self.sheet.cells())
    }

    /// The plane before node `index` of `parts`.
    #[inline(always)]
    fn plane(index: u32, parts: u32) -> Q24 {
        if index >= parts {
            return 1 << 24;
        }
        // index 2^24 / parts in two steps of 12 bits, as long as a word divides in one instruction; index and
        // rest are below 2^20
        let parts = parts.max(1);
        let (first, rest) = ((index << 12) / parts, (index << 12) % parts);
        ((first << 12) | ((rest << 12) / parts)).cast_signed()
    }

    /// The sheet.
    pub(super) const fn sheet(&self) -> &Sheet<'a, S, J> {
        &self.sheet
    }

    /// Hands over the leaves at which a ray with a cone comes in, until `found` breaks off.
    pub(super) fn strike(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Struck<J>) -> ControlFlow<()>) {
        self.walk(ray, Footprint::new(cone), &mut |leaf, heights| {
            found(Struck { t: leaf.span.0, level: leaf.level, heights: *heights })
        });
    }

    /// Hands over the leaves that a ray meets, in order, with their control heights.
    fn walk(
        &self,
        ray: &Ray,
        footprint: Footprint,
        found: &mut impl FnMut(&Leaf, &[Q24; J]) -> ControlFlow<()>,
    ) {
        let axes = ray.axes();
        let [x, y, z] = &axes;
        let span = y.clip(0, 1 << 24, x.clip(0, 1 << 24, (0, i32::MAX)));
        if span.0 > span.1 {
            return;
        }
        // below the frame of the whole sheet, whose parts are the cells, one of each level
        let none = Frame { heights: [0; J], place: [0; 2], part: [0; 2], from: 0, until: -1 };
        let mut frames = [none; MAX_DEPTH + 1];
        let mut level = 0_usize;
        if let Some(frame) = frames.first_mut() {
            *frame = Frame { from: span.0, until: span.1, ..none };
            frame.part = self.first_part(&axes, frame, 0, span.0);
        }
        while let Some(frame) = frames.get_mut(level) {
            // a frame's parts are one level deeper in numbers of the sheet; the sheet's are its cells
            let (branching, parts) = if level == 0 {
                (self.sheet.cells(), self.parts(0))
            } else {
                (S::BASE, self.parts(level as u32))
            };
            let done = frame.from > frame.until || frame.part.iter().any(|part| *part >= branching);
            if done {
                let Some(above) = level.checked_sub(1) else { return };
                level = above;
                continue;
            }
            let part = frame.part;
            let place = [0, 1].map(|k: usize| {
                let [of, part] = [frame.place, part].map(|pair| pair.get(k).copied().unwrap_or(0));
                of.wrapping_mul(branching).wrapping_add(part)
            });
            // where the ray leaves the part: the nearer of the two planes ahead
            let ahead = |axis: &Axis, place: u32| {
                axis.crossing(Self::plane(place.wrapping_add(u32::from(axis.direction > 0)), parts))
            };
            let (out_x, out_y) = (ahead(x, place[0]), ahead(y, place[1]));
            let leaves = out_x.min(out_y).min(frame.until).max(frame.from);
            let span = (frame.from, leaves);
            // on to the next part; beyond the last there is none
            let next = |part: u32, axis: &Axis| {
                if axis.direction > 0 {
                    part.wrapping_add(1)
                } else {
                    part.checked_sub(1).unwrap_or(u32::MAX)
                }
            };
            if out_x <= out_y {
                frame.part[0] = next(part[0], x);
            } else {
                frame.part[1] = next(part[1], y);
            }
            frame.from = leaves;
            if leaves >= frame.until {
                frame.from = i32::MAX;
            }
            let heights = if level == 0 {
                self.sheet.cell(part)
            } else {
                self.sheet.scheme().part(&frame.heights, part)
            };
            let [low, high] = self.sheet.scheme().bounds(&heights);
            let inside = z.clip(low, high, span);
            if inside.0 > inside.1 {
                continue;
            }
            let width = Self::plane(1, parts);
            if level as u32 >= self.depth || footprint.reaches(width) <= i64::from(inside.0) {
                let [low, high] = self.leaf_bounds(&heights, [low, high]);
                let inside = z.clip(low, high, span);
                let leaf = Leaf { level: level as u32, place, span: inside };
                if inside.0 <= inside.1 && found(&leaf, &heights).is_break() {
                    return;
                }
                continue;
            }
            level += 1;
            let below = Frame { heights, place, part: [0; 2], from: span.0, until: span.1 };
            let first = self.first_part(&axes, &below, level as u32, span.0);
            if let Some(frame) = frames.get_mut(level) {
                *frame = Frame { part: first, ..below };
            }
        }
    }

    /// The bounds of a leaf, tightened by those of its parts: what a picture shows of it.
    fn leaf_bounds(&self, heights: &[Q24; J], [low, high]: [Q24; 2]) -> [Q24; 2] {
        let mut hull = [i32::MAX, i32::MIN];
        for i in 0..S::BASE {
            for j in 0..S::BASE {
                let [below, above] = self.sheet.scheme().bounds(&self.sheet.scheme().part(heights, [i, j]));
                hull = [hull[0].min(below), hull[1].max(above)];
            }
        }
        [low.max(hull[0]), high.min(hull[1])]
    }

    /// The part of a node in which the ray is at `t`: as many planes are behind it.
    fn first_part(&self, axes: &[Axis; 3], frame: &Frame<J>, level: u32, t: i32) -> [u32; 2] {
        let branching = if level == 0 { self.sheet.cells() } else { S::BASE };
        let parts = self.parts(level);
        let [x, y, _] = axes;
        let along = |axis: &Axis, place: u32| {
            let first = place.wrapping_mul(branching);
            // how many of the inner planes have been crossed, from the side from which the ray comes
            let crossed = (1..branching)
                .take_while(|k| {
                    let plane = if axis.direction > 0 { *k } else { branching.wrapping_sub(*k) };
                    axis.crossing(Self::plane(first.wrapping_add(plane), parts)) <= t
                })
                .count() as u32;
            if axis.direction > 0 { crossed } else { branching.wrapping_sub(1).wrapping_sub(crossed) }
        };
        [along(x, frame.place[0]), along(y, frame.place[1])]
    }

    /// The mean normal over a node with these control heights, components saturated at ±64.
    pub(super) fn normal(&self, level: u32, heights: &[Q24; J]) -> [i32; 3] {
        let corners = CORNERS.map(|corner| i64::from(self.sheet.scheme().corner(heights, corner)));
        let normal = mean_normal(corners, self.parts(level).into());
        [normal.x, normal.y, normal.z].map(Real::to_bits)
    }
}

/// A leaf as what a crossing remembers: places have 20 bits, levels 4.
fn memo(leaf: &Leaf) -> [u32; 2] {
    [leaf.level << 24 | leaf.place[0], leaf.place[1]]
}

impl<S: Scheme<J>, const J: usize> Surface for PatchSurface<'_, S, J> {
    fn extent(&self) -> Extent {
        let (low, high) = self.heights();
        Extent { low: Vec3::new(Real::ZERO, Real::ZERO, low), high: Vec3::new(Real::ONE, Real::ONE, high) }
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        CROSSINGS
    }

    /// As far as the finest leaf is wide along both axes.
    fn error(&self) -> Real {
        let width = Self::plane(1, self.parts(self.depth));
        Real::from_bits(width.saturating_mul(2).max(1))
    }

    fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let (mut left, mut last) = (CROSSINGS, None);
        self.walk(ray, Footprint::new(cone).with_width(ray.width), &mut |leaf, heights| {
            let joined = last.is_some_and(|out: i32| leaf.span.0.saturating_sub(out) <= GAP);
            last = Some(leaf.span.1);
            // right behind the leaf before, it is the same crossing
            if joined {
                return ControlFlow::Continue(());
            }
            let normal = self.normal(leaf.level, heights);
            let dot: i64 = normal.iter().zip(ray.direction).map(|(n, d)| product(*n, d) >> 2).sum();
            left -= 1;
            let crossing =
                Crossing { t: Real::from_bits(leaf.span.0), enters: dot < 0, face: 0, memo: memo(leaf) };
            if found(crossing).is_break() || left == 0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
    }

    /// The height above the surface at the nearest place of the deepest level, at the rim outside the domain.
    fn value(&self, place: Vec3) -> Wide {
        let parts = self.parts(self.depth);
        let index = [place.x, place.y].map(|c| {
            let along = u64::from(c.to_bits().clamp(0, 1 << 24).unsigned_abs()) * u64::from(parts);
            ((along + (1 << 23)) >> 24) as u32
        });
        Wide::from(place.z) - Wide::from(self.sheet.at(index, self.depth))
    }

    /// The normal is the mean normal over the leaf; `u` and `v` are `x` and `y`.
    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let [first, second] = crossing.memo;
        let level = first >> 24;
        let normal = self.normal(level, &self.sheet.part_bits([first & ((1 << 24) - 1), second], level));
        let chart = if charted {
            let rise = |slope: i32| Real::from_bits(slope.saturating_neg());
            Chart {
                u: position.x.clamp(Real::ZERO, Real::ONE),
                v: position.y.clamp(Real::ZERO, Real::ONE),
                along_u: Vec3::new(Real::ONE, Real::ZERO, rise(normal[0])),
                along_v: Vec3::new(Real::ZERO, Real::ONE, rise(normal[1])),
            }
        } else {
            Chart::default()
        };
        SurfacePoint {
            position,
            place: position,
            normal: unit(normal),
            chart,
            face: 0,
            inward: false,
            width: ray.width_at(crossing.t, cone),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::exact::words;
    use super::*;
    use crate::patch::{Tensor, bezier, takagi};
    use std::vec::Vec;

    fn crossings(surface: &impl Surface, ray: &Ray, cone: Unit) -> Vec<Crossing> {
        let mut all = Vec::new();
        surface.cross(ray, cone, &mut |crossing| {
            all.push(crossing);
            ControlFlow::Continue(())
        });
        all
    }

    /// `16 s (1 - s) t (1 - t) h` in `[0, 1]`: heights of a parabola in both directions.
    fn dome(work: impl FnOnce(&PatchSurface<'_, Tensor<2, 3, 3, 9>, 9>)) {
        let parabola = bezier::<3>().unwrap();
        let product = Tensor::new(parabola, parabola).unwrap();
        let mut heights = [Real::ZERO; 9];
        heights[4] = Real::from_num(2);
        work(&PatchSurface::new(Sheet::new(&product, &heights, 1).unwrap(), 8).unwrap());
    }

    fn height(x: f64, y: f64) -> f64 {
        2.0 * 4.0 * x * (1.0 - x) * y * (1.0 - y)
    }

    /// Seeded rays at a dome: the first crossing is no farther from it than a leaf is high, on the side from
    /// which the ray comes; no ray that dips below it between two planes is missed.
    #[test]
    fn a_dome_is_met_where_it_is() {
        let mut word = words(61);
        let mut number = |low: f64, high: f64| low + (high - low) * (word() >> 40) as f64 / (1 << 24) as f64;
        dome(|surface| {
            let (mut met, mut missed, mut below, mut most) = (0, 0, 0, 0.0_f64);
            for _ in 0..3_000 {
                let eye = [number(-2.0, 3.0), number(-2.0, 3.0), number(-1.0, 2.0)];
                let to = [number(0.0, 1.0), number(0.0, 1.0), number(-0.2, 0.6)];
                let d = [0, 1, 2].map(|k| to[k] - eye[k]);
                let vector =
                    |v: [f64; 3]| Vec3::new(Real::from_num(v[0]), Real::from_num(v[1]), Real::from_num(v[2]));
                let ray = Ray::new(vector(eye), vector(d));
                // the truth: the first change of sign of z - h over the square, by small steps
                let above = |t: f64| {
                    let [x, y, z] = [0, 1, 2].map(|k| eye[k] + t * d[k]);
                    let inside = (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y);
                    inside.then(|| z - height(x, y))
                };
                let steps: Vec<_> =
                    (0..4000).map(|k| (f64::from(k) / 800.0, above(f64::from(k) / 800.0))).collect();
                let truth = steps.windows(2).find_map(|pair| match (pair[0].1, pair[1].1) {
                    (Some(a), Some(b)) if a * b <= 0.0 => Some((pair[1].0, a > 0.0)),
                    _ => None,
                });
                let first = crossings(surface, &ray, Unit::DELTA).first().copied();
                let Some((t, from_above)) = truth else { continue };
                let Some(first) = first else {
                    missed += 1;
                    continue;
                };
                met += 1;
                let got = first.t.to_num::<f64>();
                assert!(got <= t + 1e-3, "{got} {t}");
                let off = above(got).unwrap_or(0.0).abs();
                most = most.max(off);
                let point = surface.point(&ray, Unit::ONE / 4, &first, true);
                if (got - t).abs() < 0.01 {
                    below += u32::from(!from_above);
                    assert_eq!(first.enters, from_above, "{eye:?} {to:?}");
                    let [x, y] = [point.chart.u, point.chart.v].map(|c| c.to_num::<f64>());
                    let slope =
                        [8.0 * (1.0 - 2.0 * x) * y * (1.0 - y), 8.0 * x * (1.0 - x) * (1.0 - 2.0 * y)];
                    let length = (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
                    let n = [point.normal.x, point.normal.y].map(|c| c.to_num::<f64>());
                    assert!(
                        (n[0] + slope[0] / length).abs() < 0.05 && (n[1] + slope[1] / length).abs() < 0.05
                    );
                }
            }
            assert!(met > 1_500 && below > 100 && missed == 0, "{met} {below} {missed}");
            // leaves are 1/256 wide, and slopes at most 2
            assert!(most > 1e-3 && most < 0.06, "{most}");
        });
    }

    /// Planes are whole parts of 1, rounded down, for every count of parts.
    #[test]
    fn planes_are_where_parts_begin() {
        type Plain<'a> = PatchSurface<'a, Tensor<2, 3, 3, 9>, 9>;
        let mut tried = 0;
        for parts in (1..=40).chain([243, 1000, 65_536, 99_999, (1 << 20) - 1, 1 << 20]) {
            for index in (0..=parts).step_by(parts as usize / 200 + 1).chain([parts - 1, parts]) {
                let exact = (u64::from(index) << 24) / u64::from(parts);
                assert_eq!(
                    u64::from(Plain::plane(index, parts).cast_unsigned()),
                    exact,
                    "{index} of {parts}"
                );
                tried += 1;
            }
        }
        assert!(tried > 1_000);
    }

    /// A rough sheet hides the ground: no vertical ray through an edge or a corner of its cells passes.
    #[test]
    fn no_ray_passes_between_parts() {
        let curve = takagi().unwrap();
        let product = Tensor::<2, 3, 3, 9>::new(curve, curve).unwrap();
        let heights: Vec<Real> = (0..25).map(|k| Real::from_num((k * 7) % 5) / 8).collect();
        let surface = PatchSurface::new(Sheet::new(&product, &heights, 2).unwrap(), 6).unwrap();
        let (low, high) = surface.heights();
        assert!(low < 0 && high > Real::lit("0.5") && surface.depth() == 6);
        let mut rays = 0;
        for i in 0..=64 {
            for j in 0..=64 {
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (-1, 1), (1, 1)] {
                    let at = |k: i32, d: i32| Real::from_bits(((k << 18) + d).clamp(0, 1 << 24));
                    let [x, y] = [at(i, dx), at(j, dy)];
                    for lean in [Vec3::Z, Vec3::lit("0.0001", "0", "1"), Vec3::lit("-0.0001", "0.0001", "1")]
                    {
                        let down = Vec3::new(-lean.x, -lean.y, -lean.z);
                        let from =
                            Vec3::new(x, y, Real::ZERO).minus(Vec3::new(down.x * 2, down.y * 2, down.z * 2));
                        let ray = Ray::new(from, down);
                        assert!(
                            !crossings(&surface, &ray, Unit::DELTA).is_empty()
                                || [i, j].iter().any(|k| k % 64 == 0),
                            "{x} {y}"
                        );
                        rays += 1;
                    }
                }
            }
        }
        assert_eq!(rays, 65 * 65 * 15);
        assert!(PatchSurface::new(Sheet::new(&product, &heights, 2).unwrap(), 13).is_err());
        assert!(surface.error() == Real::ONE / 64 && !surface.is_closed() && surface.most_crossings() == 8);
        let middle = Vec3::new(Real::ONE / 2, Real::ONE / 2, Real::ONE);
        // the grid point (2, 2) is the height 12, 84 % 5 = 4 eighths
        assert_eq!(surface.value(middle), Wide::lit("0.5"));
    }

    /// Bounds hold: every height of a cell's parts is within them, at every level.
    #[test]
    fn bounds_of_a_cell_hold_its_parts() {
        let curve = takagi().unwrap();
        let product = Tensor::<2, 3, 3, 9>::new(curve, curve).unwrap();
        let mut word = words(67);
        let (mut tried, mut least) = (0, i64::MAX);
        for _ in 0..40 {
            let heights: [Q24; 9] = core::array::from_fn(|_| (word() >> 40) as i32 - (1 << 23));
            let [low, high] = product.bounds(&heights);
            for i in 0..=32 {
                for j in 0..=32 {
                    let height = product.at(&heights, [i, j], 5);
                    assert!((low..=high).contains(&height));
                    least = least.min(i64::from(height - low).min((high - height).into()));
                    tried += 1;
                }
            }
        }
        assert!(tried == 40 * 33 * 33 && least < 1 << 26, "{least}");
    }
}
