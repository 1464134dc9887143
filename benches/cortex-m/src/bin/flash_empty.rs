//! The floor of the flash sizes: start-up code and exit.
#![no_std]
#![no_main]

use attractor_cortex_m::{entry, semihosting};
use panic_never as _;

#[entry]
fn main() -> ! {
    semihosting::process::exit(0)
}
