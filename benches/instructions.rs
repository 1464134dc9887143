//! Instructions of the target's kernels on the host, counted by valgrind: `cargo bench -p attractor-benches --bench instructions`.
//!
//! The bench runs itself under callgrind with each loop repeated once and 101 times; the difference belongs to the loop. Where there is no
//! valgrind it says so and counts nothing.

use std::process::Command;

use attractor_workload::Blind;
use attractor_workload::kernels::{self, Kernel, Watch};

/// More repetitions in the second run.
const MORE: u32 = 100;

fn main() {
    let mut arguments = std::env::args().skip(1);
    match (arguments.next().as_deref(), arguments.next(), arguments.next()) {
        (Some("run"), Some(kernel), Some(times)) => run(&kernel, times.parse().unwrap_or(1)),
        // as the other benches: with --test only see that it works
        (Some("--test"), ..) => run("identity", 1),
        _ => table(),
    }
}

fn find(name: &str) -> Option<&'static Kernel> {
    kernels::ALL.iter().find(|kernel| kernel.name == name)
}

fn run(name: &str, times: u32) {
    if let Some(kernel) = find(name) {
        std::hint::black_box((kernel.fixed)(&mut Watch::new(&mut Blind, times)));
    }
}

/// Instructions of a run, none where valgrind cannot be started.
fn collected(name: &str, times: u32) -> Option<u64> {
    let here = std::env::current_exe().ok()?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(here)
        .args(["run", name, &times.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    text.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok())
}

fn table() {
    println!("{:18} {:26} instructions on the host", "kernel", "unit");
    for kernel in kernels::ALL {
        let (Some(once), Some(often)) = (collected(kernel.name, 1), collected(kernel.name, 1 + MORE)) else {
            println!("valgrind is not here: apt install valgrind");
            return;
        };
        let units = (kernel.fixed)(&mut Watch::new(&mut Blind, 1)).units.max(1);
        let each = (often.saturating_sub(once)) as f64 / f64::from(MORE) / f64::from(units);
        println!("{:18} {:26} {each:12.2}", kernel.name, kernel.unit);
    }
}
