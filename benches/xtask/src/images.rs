//! Builds the images.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::targets::Target;
use crate::toolchain::Toolchain;

/// The images of one target.
#[derive(Debug)]
pub(crate) struct Images {
    /// Name and path of each.
    all: Vec<(String, PathBuf)>,
}

impl Images {
    /// The image of this name.
    pub(crate) fn path(&self, name: &str) -> Result<&Path> {
        let found = self.all.iter().find(|(image, _)| image == name);
        found.map(|(_, path)| path.as_path()).with_context(|| format!("there is no image {name}"))
    }

    /// The images that measure flash, by the name of what they hold.
    pub(crate) fn flash(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.all.iter().filter_map(|(name, path)| Some((name.strip_prefix("flash_")?, path.as_path())))
    }
}

/// The directory of the images' package.
pub(crate) fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../cortex-m")
}

/// Proves first that a panic breaks the link of `nopanic`, then builds every image.
pub(crate) fn build(target: &Target, toolchain: &Toolchain) -> Result<Images> {
    let deliberate = cargo(target, toolchain, &["--bin", "nopanic", "--features", "deliberate-panic"])?;
    if deliberate.success {
        bail!("nopanic links with a deliberate panic: the check for panics is blind");
    }
    if !deliberate.errors.contains("panic-never") {
        bail!("nopanic with a deliberate panic failed, but not for the panic:\n{}", deliberate.errors);
    }
    let built = cargo(target, toolchain, &["--bins"])?;
    if !built.success && built.errors.contains("panic-never") {
        bail!(
            "an image that must not panic has a panicking branch ({})\n{}  help: benches/cortex-m/README.md says how to find it",
            target.triple,
            built.errors
        );
    }
    if !built.success {
        bail!("the images for {} do not build:\n{}", target.triple, built.errors);
    }
    Ok(Images { all: built.executables })
}

struct Built {
    success: bool,
    errors: String,
    executables: Vec<(String, PathBuf)>,
}

fn cargo(target: &Target, toolchain: &Toolchain, arguments: &[&str]) -> Result<Built> {
    let output = toolchain
        .cargo("build", target, &package())
        .arg("--message-format=json-render-diagnostics")
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .context("cargo cannot be started")?;
    let mut executables = Vec::new();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let message: Value = serde_json::from_str(line).unwrap_or_default();
        if let (Some(name), Some(path)) = (message["target"]["name"].as_str(), message["executable"].as_str())
        {
            executables.push((name.to_owned(), PathBuf::from(path)));
        }
    }
    executables.sort();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    Ok(Built { success: output.status.success(), errors, executables })
}
