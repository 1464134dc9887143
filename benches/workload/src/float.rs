//! The floating-point operations that C has and `core` has not yet.
//!
//! Where the target has a single-precision FPU, a C compiler turns `sqrtf` into VSQRT and, contracting as C compilers do by default,
//! `a * b + c` into VFMA. Rust never contracts, so the f32 loops ask for it by name; otherwise fixed point would win against a straw man.
//! The names are unstable in `core`: `benches/cortex-m/.cargo/config.toml` permits them to this crate alone.

/// `a * b + c`, fused where the target does it in one instruction.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
pub(crate) fn mul_add(a: f32, b: f32, c: f32) -> f32 {
    a * b + c
}

#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
pub(crate) use libm::sqrtf as sqrt;

#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
pub(crate) use core::f32::math::{mul_add, sqrt};
