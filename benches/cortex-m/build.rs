//! The memory map and the linker script of each target.

use std::{env, fs, path::Path};

/// Flash is generous: how much of it a capability takes is measured on the images, not enforced here.
const MEMORIES: &[(&str, &str)] = &[
    (
        "thumbv7em",
        "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 1024K  RAM : ORIGIN = 0x20000000, LENGTH = 128K }\n",
    ),
    // as the micro:bit's nRF51822; the same image runs on the Cortex-M4's machine, where it can be counted
    (
        "thumbv6m",
        "MEMORY { FLASH : ORIGIN = 0x00000000, LENGTH = 256K  RAM : ORIGIN = 0x20000000, LENGTH = 16K }\n",
    ),
    (
        "riscv32",
        "MEMORY { FLASH : ORIGIN = 0x80000000, LENGTH = 2048K  RAM : ORIGIN = 0x80200000, LENGTH = 128K }
REGION_ALIAS(\"REGION_TEXT\", FLASH);
REGION_ALIAS(\"REGION_RODATA\", FLASH);
REGION_ALIAS(\"REGION_DATA\", RAM);
REGION_ALIAS(\"REGION_BSS\", RAM);
REGION_ALIAS(\"REGION_HEAP\", RAM);
REGION_ALIAS(\"REGION_STACK\", RAM);
",
    ),
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let target = env::var("TARGET").expect("cargo sets TARGET");
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    let Some((_, memory)) = MEMORIES.iter().find(|(name, _)| target.starts_with(name)) else {
        panic!("no memory map for {target}: add one to benches/cortex-m/build.rs");
    };
    fs::write(Path::new(&out).join("memory.x"), memory).expect("OUT_DIR can be written");
    println!("cargo:rustc-link-search={out}");
    println!("cargo:rustc-check-cfg=cfg(roomy)");
    // where there is more RAM than 16 KiB
    if !memory.contains("LENGTH = 16K") {
        println!("cargo:rustc-cfg=roomy");
    }
    if target.starts_with("riscv") {
        println!("cargo:rustc-link-arg-bins=-Tmemory.x");
    }
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}
