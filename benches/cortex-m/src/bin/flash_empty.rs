//! The floor of the flash sizes: start-up code and exit.
#![no_std]
#![no_main]

use attractor_cortex_m::{entry, semihosting};

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    semihosting::process::exit(0)
}
