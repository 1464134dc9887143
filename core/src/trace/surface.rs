//! What a ray can meet: the seam between the things of a world and what casts rays at them.
//!
//! There are two phases. [`Surface::cross`] finds, cheaply, where a ray crosses a surface;
//! [`Surface::point`] then tells all that shading wants to know, of the nearest crossing alone.
//!
//! Formats: lengths and parameters 24 fractional bits, directions 28.

use core::ops::ControlFlow;

use super::ball::Ball;
use super::ray::{Axis, Ray};
use crate::num::{Real, Unit, Vec3, Wide};

/// Where a ray crosses a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// The ray's parameter, 0 or more.
    pub t: Real,
    /// Whether the ray goes in: against the outward normal of a solid, or of the upper side of an open
    /// surface.
    pub enters: bool,
    /// Which face of the shape it is.
    pub face: u8,
    /// What the surface needs to tell more about the crossing; 0 for most.
    pub memo: [u32; 2],
}

/// A box along the axes of the world, both ends along x, y and z; whole space where nothing limits it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Extent {
    /// The least coordinates.
    pub low: Vec3,
    /// The greatest.
    pub high: Vec3,
}

impl Extent {
    /// The whole of space.
    pub const SPACE: Self = Self {
        low: Vec3::new(Real::MIN, Real::MIN, Real::MIN),
        high: Vec3::new(Real::MAX, Real::MAX, Real::MAX),
    };
    /// Nothing: no point is inside.
    pub const NOTHING: Self = Self { low: Self::SPACE.high, high: Self::SPACE.low };

    /// The least box round both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        let (a, b) = (self, other);
        Self {
            low: Vec3::new(a.low.x.min(b.low.x), a.low.y.min(b.low.y), a.low.z.min(b.low.z)),
            high: Vec3::new(a.high.x.max(b.high.x), a.high.y.max(b.high.y), a.high.z.max(b.high.z)),
        }
    }

    /// What both have in common.
    #[must_use]
    pub fn overlap(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let both = Self {
            low: Vec3::new(a.low.x.max(b.low.x), a.low.y.max(b.low.y), a.low.z.max(b.low.z)),
            high: Vec3::new(a.high.x.min(b.high.x), a.high.y.min(b.high.y), a.high.z.min(b.high.z)),
        };
        if both.is_empty() { Self::NOTHING } else { both }
    }

    /// Whether a ray meets the box, or passes it by less than `2^-17`.
    pub(super) fn is_met(&self, axes: &[Axis; 3]) -> bool {
        if self.is_empty() {
            return false;
        }
        let (low, high) = (self.low, self.high);
        let mut span = (0, i32::MAX);
        for (axis, (low, high)) in axes.iter().zip([(low.x, high.x), (low.y, high.y), (low.z, high.z)]) {
            // a world ends at ±64, and a ray begins inside it
            let end = |c: Real| c.to_bits().clamp(1 - (64 << 24), 64 << 24);
            span = axis.clip(end(low), end(high), span);
        }
        span.0.saturating_sub(span.1) <= 1 << 7
    }

    /// Whether a place is inside or on the box.
    pub(super) fn holds(&self, place: Vec3) -> bool {
        let within = |low: Real, c: Real, high: Real| low <= c && c <= high;
        let (low, high) = (self.low, self.high);
        within(low.x, place.x, high.x) && within(low.y, place.y, high.y) && within(low.z, place.z, high.z)
    }

    /// Whether no point is inside.
    pub fn is_empty(&self) -> bool {
        self.low.x > self.high.x || self.low.y > self.high.y || self.low.z > self.high.z
    }
}

/// Texture coordinates of a point and how it moves with them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chart {
    /// First coordinate, mostly in `[0, 1]`.
    pub u: Real,
    /// Second coordinate.
    pub v: Real,
    /// `P_u`: how the point moves when `u` grows.
    pub along_u: Vec3,
    /// `P_v`: how the point moves when `v` grows.
    pub along_v: Vec3,
}

/// All that shading knows of a point of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfacePoint {
    /// Where it is, in the world.
    pub position: Vec3,
    /// Where it is, in the coordinates of the shape: what solid textures are carved from.
    pub place: Vec3,
    /// The outward unit normal, in the world. Casters turn it towards the eye before a material sees it.
    pub normal: Vec3<Unit>,
    /// Whether the normal was turned inwards, since the eye is behind the surface.
    pub inward: bool,
    /// Its texture coordinates; zero unless they were asked for.
    pub chart: Chart,
    /// Which face of the shape it is on.
    pub face: u8,
    /// How wide the ray's cone is here.
    pub width: Real,
}

/// Parameters that differ by no more are the same to within what they are known to: `2^-19`, 24 fractional
/// bits.
pub(super) const SAME: i32 = 1 << 5;

/// A thing of a world.
pub trait Surface {
    /// A box of the world that holds it.
    fn extent(&self) -> Extent;

    /// A ball that holds it, which is looked at first: that round the extent, unless it knows a smaller one.
    fn ball(&self) -> Ball {
        let Extent { low, high } = self.extent();
        Ball::round(low, high)
    }

    /// Whether it encloses a part of space, so that it can be a part of a compound. An open surface, as a
    /// square, has two sides and no inside.
    fn is_closed(&self) -> bool;

    /// The most crossings that a ray can have.
    fn most_crossings(&self) -> u32;

    /// How many faces it has, each of which may have a material of its own.
    fn faces(&self) -> u8 {
        1
    }

    /// How wrong the parameter of a crossing is at most, for a direction of length 1.
    fn error(&self) -> Real;

    /// Hands over the crossings with `t >= 0` in the order of `t`, until `found` breaks off. The ray is
    /// [`Ray::width_at`] wide, and grows by `cone` for each 1 of `t`: details along x and y that are smaller
    /// need not be told apart. Where a ray starts on one surface that touches another, rounding may put the
    /// other's crossing behind it: what is less than `2^-19` behind, give or take [`Surface::error`], should
    /// be handed over, with a `t` of 0. A crossing into what a ray is in already does nothing.
    fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>);

    /// The inside-outside function at a place of the world: above 0 outside, 0 on the surface, below 0
    /// inside. Of an open surface: which side.
    fn value(&self, place: Vec3) -> Wide;

    /// Whether a place is outside for certain: by more than places are known to. False in case of doubt.
    fn is_clear_of(&self, _: Vec3) -> bool {
        false
    }

    /// All there is to know of a crossing that [`Surface::cross`] found on this ray; with texture coordinates
    /// if they are asked for.
    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint;
}
