//! `cargo xtask drivers`: compiles `examples/drivers` with the real drivers for a Cortex-M4. That it draws
//! the right pictures is tested on the host.

use std::path::Path;

use anyhow::{Context, Result};

use crate::{Prefer, targets, toolchain};

/// Whether it compiles.
pub(crate) fn run() -> Result<bool> {
    let target = &targets::ALL[0];
    let compiler = toolchain::find(target, Prefer::Auto)?;
    eprintln!("{}: {compiler}", target.triple);
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/drivers");
    // nothing of it is run or measured
    let mut cargo = compiler.cargo("build", target, &package);
    let status = cargo.arg("--lib").env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0").status();
    Ok(status.context("cargo cannot be started")?.success())
}
