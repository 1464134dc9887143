//! Vectors in space, as arrays of three coordinates.

/// A point or a direction `(x, y, z)`; the height field lies over the x-y plane.
pub type Vector = [f64; 3];

/// `a + s b`.
pub(crate) fn along(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// The scalar product.
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product `a x b`.
pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector in the direction of `a`.
///
/// # Panics
/// When `a` is zero or not finite.
pub(crate) fn normalised(a: Vector) -> Vector {
    let length = libm::sqrt(dot(a, a));
    assert!(length > 0.0 && length.is_finite(), "a direction is not zero");
    a.map(|coordinate| coordinate / length)
}

#[cfg(test)]
mod tests {
    use super::{along, cross, dot, normalised};

    #[test]
    fn the_vector_product_is_right_handed_and_upright() {
        assert_eq!(cross([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        let (a, b) = ([1.0, 2.0, 3.0], [-2.0, 0.5, 4.0]);
        assert_eq!((dot(cross(a, b), a), dot(cross(a, b), b)), (0.0, 0.0));
    }

    #[test]
    fn normalising_keeps_the_direction() {
        assert_eq!(normalised([0.0, 3.0, -4.0]), [0.0, 0.6, -0.8]);
        assert_eq!(along([1.0, 1.0, 1.0], 2.0, [0.0, 1.0, -1.0]), [1.0, 3.0, -1.0]);
    }
}
