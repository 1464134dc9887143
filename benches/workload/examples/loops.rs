//! The fixed-point loops of every kernel on the host, for valgrind to count: see
//! `benches/xtask/src/valgrind.rs`, which starts this.
//!
//! Each loop runs once and then `1 + MORE` times (the argument), and [`mark`] is called after either: what
//! the second took more belongs to the loop.

use std::hint::black_box;

use attractor_workload::Blind;
use attractor_workload::kernels::{self, Watch};

fn main() {
    let more: u32 = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1);
    mark();
    for kernel in kernels::ALL {
        for times in [1, 1 + more] {
            black_box((kernel.fixed)(&mut Watch::new(&mut Blind, times)));
            mark();
        }
    }
}

/// Valgrind writes what it counted whenever this is called.
#[inline(never)]
fn mark() {
    black_box(());
}
