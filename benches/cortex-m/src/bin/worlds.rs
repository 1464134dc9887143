//! Draws every world and texture of the table: see `show`.
#![no_std]
#![no_main]

use attractor_cortex_m::semihosting::{println, process};
use attractor_cortex_m::workload::scenes;
use attractor_cortex_m::{Board, entry, show};

attractor_cortex_m::report_panics!();

#[entry]
fn main() -> ! {
    show(&mut Board::new(), scenes::WORLDS);
    println!("{{\"line\":\"end\"}}");
    process::exit(0)
}
