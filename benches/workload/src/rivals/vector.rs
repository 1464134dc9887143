//! Vectors of three numbers.

use crate::float::Float;

/// `x`, `y`, `z`.
pub(crate) type Vector<F> = [F; 3];

#[inline(always)]
pub(crate) fn dot<F: Float>([a, b, c]: Vector<F>, [x, y, z]: Vector<F>) -> F {
    a.fused(x, b.fused(y, c * z))
}

/// `v / |v|`.
#[inline(always)]
pub(crate) fn unit<F: Float>(v: Vector<F>) -> Vector<F> {
    let scale = F::of(1.0) / dot(v, v).root();
    v.map(|c| c * scale)
}
