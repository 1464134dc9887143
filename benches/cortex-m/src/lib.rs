//! What the images share: the board they run on, and the lines they print.
//!
//! Everything that depends on the processor is in [`board`]; the workload itself is `attractor-workload`.
#![no_std]

mod board;
mod show;
mod sizes;
mod wire;

pub use attractor_workload as workload;
pub use board::Board;
pub use semihosting;
pub use show::show;
pub use wire::Wire;

#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

/// A panic handler that says where and stops the emulator with a failure. Images that must not panic use
/// `panic_never` instead.
#[macro_export]
macro_rules! report_panics {
    () => {
        #[panic_handler]
        fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
            $crate::semihosting::eprintln!("{info}");
            $crate::semihosting::process::exit(101)
        }
    };
}

/// No panic handler: the image links only when nothing in it can panic.
#[cfg(not(feature = "locate-panics"))]
#[macro_export]
macro_rules! never_panics {
    () => {
        use panic_never as _;
    };
}

/// The least panic handler, so that the image links after all and the callers of `core::panicking` can be
/// looked for.
#[cfg(feature = "locate-panics")]
#[macro_export]
macro_rules! never_panics {
    () => {
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            $crate::semihosting::process::exit(101)
        }
    };
}

/// The image's own name and its arguments (`-semihosting-config arg=...`): calls `f` with each argument.
pub fn arguments(mut f: impl FnMut(usize, &str)) {
    if let Ok(args) = semihosting::experimental::env::args::<256>() {
        for (i, argument) in (&args).into_iter().enumerate() {
            f(i, argument.unwrap_or("?"));
        }
    }
}

/// Whether an argument names this row: an argument cannot hold spaces, so that it has `+` for them.
pub fn names(argument: &str, row: &str) -> bool {
    argument.len() == row.len()
        && argument.bytes().zip(row.bytes()).all(|(a, b)| a == b || (a, b) == (b'+', b' '))
}
