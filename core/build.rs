//! Tells the kernel whether the target multiplies 32 by 32 bits to 64 in one instruction. It is asked of the target, so that no user has to set a feature.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(no_long_product)");
    // Armv6-M and Armv8-M Baseline: Cortex-M0, M0+, M1 and M23
    let target = std::env::var("TARGET").unwrap_or_default();
    if target.starts_with("thumbv6m") || target.starts_with("thumbv8m.base") {
        println!("cargo::rustc-cfg=no_long_product");
    }
}
