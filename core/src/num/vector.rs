//! Vectors of three [`Real`] components: positions and directions in the set-up of a camera.

use super::{Real, Unit, reciprocal_sqrt};

/// A vector in space; `z` points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vec3<T = Real> {
    /// First component.
    pub x: T,
    /// Second component.
    pub y: T,
    /// Third component, upwards.
    pub z: T,
}

impl<T> Vec3<T> {
    /// The vector `(x, y, z)`.
    pub const fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }
}

impl Vec3<Real> {
    /// The difference `self - other`, saturated.
    pub fn minus(self, other: Self) -> Self {
        Self::new(
            self.x.saturating_sub(other.x),
            self.y.saturating_sub(other.y),
            self.z.saturating_sub(other.z),
        )
    }

    /// The unit vector in this direction, none for the zero vector. Error: below `2^-27` in each component.
    pub fn normalised(self) -> Option<Vec3<Unit>> {
        let bits = [self.x.to_bits(), self.y.to_bits(), self.z.to_bits()];
        let largest = bits.iter().map(|b| b.unsigned_abs()).max().unwrap_or(0);
        if largest == 0 {
            return None;
        }
        // Scale the largest component into [2^29, 2^30): the squares then add up to less than 2^62.
        let up = i64::from(largest.leading_zeros()) - 2;
        let scaled = bits.map(|b| if up >= 0 { i64::from(b) << up } else { i64::from(b) >> -up });
        let square: i64 = scaled.iter().map(|s| s * s).sum();
        let (mantissa, shift) = reciprocal_sqrt(square as u64);
        // scaled * mantissa / 2^shift, with 30 fractional bits
        let unit = |s: i64| Unit::from_bits(((s * i64::from(mantissa)) >> (shift - 30)) as i32);
        Some(Vec3::new(unit(scaled[0]), unit(scaled[1]), unit(scaled[2])))
    }
}

impl Vec3<Unit> {
    /// The scalar product, for vectors no longer than 1.
    pub fn dot(self, other: Self) -> Unit {
        let sum = i64::from(self.x.to_bits()) * i64::from(other.x.to_bits())
            + i64::from(self.y.to_bits()) * i64::from(other.y.to_bits())
            + i64::from(self.z.to_bits()) * i64::from(other.z.to_bits());
        Unit::from_bits((sum >> 30) as i32)
    }

    /// The vector product, for vectors no longer than 1.
    pub fn cross(self, other: Self) -> Self {
        let minor = |a: Unit, b: Unit, c: Unit, d: Unit| {
            let sum = i64::from(a.to_bits()) * i64::from(b.to_bits())
                - i64::from(c.to_bits()) * i64::from(d.to_bits());
            Unit::from_bits((sum >> 30) as i32)
        };
        Self::new(
            minor(self.y, other.z, self.z, other.y),
            minor(self.z, other.x, self.x, other.z),
            minor(self.x, other.y, self.y, other.x),
        )
    }

    /// The unit vector in this direction, none for the zero vector.
    pub fn normalised(self) -> Option<Self> {
        let real = |u: Unit| Real::from_bits(u.to_bits());
        Vec3::<Real>::new(real(self.x), real(self.y), real(self.z)).normalised()
    }
}
