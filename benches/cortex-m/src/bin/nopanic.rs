//! Calls every public kernel with inputs the compiler knows nothing about, and links only when none of them can panic.
//!
//! `panic_never` refers to a symbol that does not exist from its panic handler. The feature `deliberate-panic` adds an indexing that may
//! panic: the link must fail then, which proves that it could.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::num;
use attractor_cortex_m::{entry, semihosting};
use panic_never as _;

#[entry]
fn main() -> ! {
    numbers();
    #[cfg(feature = "deliberate-panic")]
    bb([1, 2, 3][bb(0_usize)]);
    semihosting::process::exit(0)
}

fn numbers() {
    bb(num::reciprocal(bb(0)));
    bb(num::reciprocal_sqrt(bb(0)));
    bb(num::sqrt(bb(0)));
    bb(num::sin_cos(bb(num::Angle::ZERO)));
    bb(num::mul_high(bb(0), bb(0)));
    bb(num::mul_high_u(bb(0), bb(0)));
    bb(num::round_shift(bb(0), bb(0)));
    bb(num::scale31(bb(0), bb(0)));
    bb(num::Reciprocal::of(bb(0)).quotient(bb(0)));
    if let Ok(alias) = num::Alias::<8>::new(bb(&[1, 2, 3])) {
        bb(alias.pick(bb(0)));
        bb(alias.len());
    }
    let v = num::Vec3::new(bb(num::Real::ONE), bb(num::Real::ONE), bb(num::Real::ONE));
    bb(v.minus(v));
    bb(v.normalised());
}
