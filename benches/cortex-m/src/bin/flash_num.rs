//! Flash taken by the functions of `num`: reciprocal, roots, sine and cosine.
#![no_std]
#![no_main]

use core::hint::black_box as bb;

use attractor::num;
use attractor_cortex_m::{entry, semihosting};

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    bb(num::reciprocal(bb(1)));
    bb(num::reciprocal_sqrt(bb(1)));
    bb(num::sqrt(bb(1)));
    bb(num::sin_cos(bb(num::Angle::ZERO)));
    semihosting::process::exit(0)
}
