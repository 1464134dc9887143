//! The targets, and the machines that QEMU emulates for them.

use anyhow::{Context, Result};
use clap::builder::PossibleValuesParser;

/// One machine of QEMU.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    pub(crate) qemu: &'static str,
    /// Debian's package of `qemu`.
    pub(crate) package: &'static str,
    pub(crate) arguments: &'static [&'static str],
}

/// One target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target {
    pub(crate) triple: &'static str,
    /// Where checksums are made.
    pub(crate) machine: Machine,
    /// Where instructions are counted, if elsewhere: the same image on a machine with a counter.
    pub(crate) counting: Option<Machine>,
    /// Whether the image leaves out scenes that do not fit 16 KiB of RAM.
    pub(crate) small: bool,
    /// Whether `stack` can bound its images: a Cortex-M0 moves the stack pointer and jumps by registers.
    pub(crate) bounded: bool,
    /// Options of rustc for Debian's compiler; rustup's takes them from benches/cortex-m/.cargo/config.toml.
    pub(crate) options: &'static [&'static str],
    /// Whether the compiler is known to lose products, see `multiplications`.
    pub(crate) loses: bool,
}

/// TIM2 of this machine ticks once an instruction under `-icount shift=0`.
const NETDUINO: Machine = Machine {
    name: "netduinoplus2",
    qemu: "qemu-system-arm",
    package: "qemu-system-arm",
    arguments: &["-M", "netduinoplus2", "-icount", "shift=0"],
};

/// The first is the one that budgets and counts are about.
pub(crate) const ALL: &[Target] = &[
    Target {
        triple: "thumbv7em-none-eabihf",
        machine: NETDUINO,
        counting: None,
        small: false,
        bounded: true,
        options: &["-Ctarget-cpu=cortex-m4"],
        loses: false,
    },
    Target {
        triple: "thumbv6m-none-eabi",
        machine: Machine {
            name: "microbit",
            qemu: "qemu-system-arm",
            package: "qemu-system-arm",
            arguments: &["-M", "microbit"],
        },
        counting: Some(NETDUINO),
        small: true,
        bounded: false,
        options: &[],
        loses: false,
    },
    Target {
        triple: "riscv32imac-unknown-none-elf",
        machine: Machine {
            name: "virt",
            qemu: "qemu-system-riscv32",
            package: "qemu-system-misc",
            arguments: &["-M", "virt", "-bios", "none", "-icount", "shift=0"],
        },
        counting: None,
        small: false,
        bounded: false,
        options: &["--emit=llvm-ir"],
        loses: true,
    },
];

/// The names that the command line accepts.
pub(crate) fn names() -> PossibleValuesParser {
    PossibleValuesParser::new(ALL.iter().map(|target| target.triple))
}

/// The targets of these names, all when none is given.
pub(crate) fn choose(names: &[String]) -> Result<Vec<&'static Target>> {
    if names.is_empty() {
        return Ok(ALL.iter().collect());
    }
    let find =
        |name: &String| ALL.iter().find(|t| t.triple == name).with_context(|| format!("no target {name}"));
    names.iter().map(find).collect()
}
