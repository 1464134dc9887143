//! Runs every kernel of the table and prints a line of JSON for each.
//!
//! Arguments: `NAME FORMAT TIMES` runs one loop of the table's row (its spaces as `+`) (`fixed`, `f32` or
//! `f64`) so many times and prints its units and instructions, for a histogram of these.
#![no_std]
#![no_main]

use core::hint::black_box;

use attractor_cortex_m::semihosting::{print, println, process};
use attractor_cortex_m::workload::kernels::{self, Kernel, Loop, Tally, Watch};
use attractor_cortex_m::{Board, arguments, entry, names};

attractor_cortex_m::report_panics!();

/// Reading the counter costs as much.
#[inline(never)]
fn nothing(watch: &mut Watch<'_>) -> Tally {
    watch.time(Tally::default)
}

/// One run: what it computed and how many instructions it took, the reading of the counter included.
#[inline(never)]
fn count(board: &mut Board, work: Loop) -> (Tally, u32) {
    let mut watch = Watch::new(board, 1);
    let tally = black_box(work)(&mut watch);
    (tally, watch.spent())
}

#[entry]
fn main() -> ! {
    let mut board = Board::new();
    let mut chosen: Option<&Kernel> = None;
    let mut work: Option<Loop> = None;
    let mut times = None;
    arguments(|i, argument| match i {
        0 => {}
        1 => chosen = kernels::ALL.iter().find(|kernel| names(argument, kernel.name)),
        2 => {
            work = chosen.and_then(|kernel| match argument {
                "f32" => kernel.f32,
                "f64" => kernel.f64,
                _ => Some(kernel.fixed),
            })
        }
        _ => times = argument.parse::<u32>().ok(),
    });
    if let (Some(work), Some(times)) = (work, times) {
        let mut watch = Watch::new(&mut board, times);
        println!("{} {}", work(&mut watch).units, watch.spent());
        process::exit(0);
    }

    let (_, floor) = count(&mut board, nothing);
    for kernel in kernels::ALL {
        print!(
            "{{\"line\":\"kernel\",\"name\":\"{}\",\"unit\":\"{}\",\"counted\":{}",
            kernel.name,
            kernel.unit,
            board.counts()
        );
        for (format, work) in [("fixed", Some(kernel.fixed)), ("f32", kernel.f32), ("f64", kernel.f64)] {
            if let Some(work) = work {
                let (tally, instructions) = count(&mut board, work);
                print!(
                    ",\"{format}\":{{\"checksum\":\"{:08x}\",\"units\":{},\"instructions\":{}}}",
                    tally.checksum,
                    tally.units,
                    instructions.wrapping_sub(floor)
                );
            }
        }
        println!("}}");
    }
    println!("{{\"line\":\"end\"}}");
    process::exit(0)
}
