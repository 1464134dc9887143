//! Draws every scene of the table, and sees that one too large is refused: see `show`.
#![no_std]
#![no_main]

use attractor_cortex_m::semihosting::{println, process};
use attractor_cortex_m::workload::{scenes, sink::Failure};
use attractor_cortex_m::{Board, entry, show};

attractor_cortex_m::report_panics!();

#[entry]
fn main() -> ! {
    let mut board = Board::new();
    show(&mut board, scenes::ALL);
    match scenes::TOO_LARGE.run(&mut board) {
        Ok(_) => println!("{{\"line\":\"refusal\",\"needed\":0,\"free\":0}}"),
        Err(Failure::Ram { needed, free }) => {
            println!("{{\"line\":\"refusal\",\"needed\":{needed},\"free\":{free}}}");
        }
        Err(failure) => println!(
            "{{\"line\":\"failure\",\"name\":\"{}\",\"size\":\"too large\",\"why\":\"{failure}\"}}",
            scenes::TOO_LARGE.name
        ),
    }
    println!("{{\"line\":\"end\"}}");
    process::exit(0)
}
