//! Builds the images.

use std::path::{Path, PathBuf};
use std::process::Stdio;

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::multiplications;
use crate::targets::Target;
use crate::toolchain::Toolchain;

/// How the names of images begin that measure flash.
const FLASH: &str = "flash_";

/// The images of one target.
#[derive(Debug)]
pub(crate) struct Images {
    /// Name and path of each.
    all: Vec<(String, PathBuf)>,
    /// Those that do not link because they can panic.
    pub(crate) panicking: Vec<String>,
}

impl Images {
    /// The image of this name.
    pub(crate) fn path(&self, name: &str) -> Result<&Path> {
        let found = self.all.iter().find(|(image, _)| image == name);
        found.map(|(_, path)| path.as_path()).with_context(|| format!("there is no image {name}"))
    }

    /// Where the compiler loses products: the functions, see [`multiplications`].
    pub(crate) fn lost(&self) -> Result<Vec<String>> {
        let mut lost = Vec::new();
        for (_, path) in &self.all {
            lost.extend(multiplications::lost(path)?);
        }
        lost.sort();
        lost.dedup();
        Ok(lost)
    }

    /// The images that prove that nothing panics.
    pub(crate) fn nopanic(&self) -> impl Iterator<Item = &Path> {
        self.all.iter().filter(|(name, _)| name.starts_with("nopanic")).map(|(_, path)| path.as_path())
    }

    /// The images that measure flash, by the name of what they hold.
    pub(crate) fn flash(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.all.iter().filter_map(|(name, path)| Some((name.strip_prefix(FLASH)?, path.as_path())))
    }
}

/// The directory of the images' package.
pub(crate) fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../cortex-m")
}

/// Proves first that a panic breaks the link of such an image, then builds every image.
pub(crate) fn build(target: &Target, toolchain: &Toolchain) -> Result<Images> {
    let deliberate = cargo(target, toolchain, &["--bin", "nopanic", "--features", "deliberate-panic"])?;
    if deliberate.success {
        bail!("nopanic links with a deliberate panic: the check for panics is blind");
    }
    if !deliberate.errors.contains("panic-never") {
        bail!("nopanic with a deliberate panic failed, but not for the panic:\n{}", deliberate.errors);
    }
    let built = cargo(target, toolchain, &["--bins", "--keep-going"])?;
    let panicking = if built.success { Vec::new() } else { unlinked(&built.errors) };
    let explained = built.errors.matches("error(panic-never)").count();
    if !built.success && (panicking.is_empty() || explained < panicking.len()) {
        bail!("the images for {} do not build:\n{}", target.triple, built.errors);
    }
    Ok(Images { all: built.executables, panicking })
}

/// What the images that measure flash hold, from the names of their sources.
pub(crate) fn measuring_flash() -> Result<Vec<String>> {
    let sources = package().join("src/bin");
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&sources).with_context(|| format!("no {}", sources.display()))? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        names.extend(name.strip_prefix(FLASH).and_then(|name| name.strip_suffix(".rs")).map(str::to_owned));
    }
    names.sort();
    Ok(names)
}

/// The image that measures the flash of `what`.
pub(crate) fn flash_of(target: &Target, toolchain: &Toolchain, what: &str) -> Result<PathBuf> {
    one(target, toolchain, &format!("{FLASH}{what}"))
}

/// Builds one image alone.
pub(crate) fn one(target: &Target, toolchain: &Toolchain, name: &str) -> Result<PathBuf> {
    let built = cargo(target, toolchain, &["--bin", name])?;
    let found = built.executables.into_iter().find(|(image, _)| image == name);
    let Some((_, path)) = found.filter(|_| built.success) else {
        bail!("the image {name} for {} does not build:\n{}", target.triple, built.errors);
    };
    Ok(path)
}

/// A name as an image's argument, which cannot hold spaces.
pub(crate) fn argument(name: &str) -> String {
    name.replace(' ', "+")
}

/// The images that cargo says it could not build: `error: could not compile `PACKAGE` (bin "NAME") ...`.
fn unlinked(errors: &str) -> Vec<String> {
    let lines = errors.lines().filter(|line| line.contains("could not compile"));
    let mut names: Vec<_> =
        lines.filter_map(|line| Some(line.split_once("(bin \"")?.1.split_once('"')?.0.to_owned())).collect();
    names.sort();
    names.dedup();
    names
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

#[cfg(test)]
mod tests {
    use super::unlinked;

    #[test]
    fn the_images_that_do_not_link_are_named() {
        let errors = "error: linking failed\nerror: could not compile `attractor-cortex-m` (bin \"nopanic\") due to 1 previous error\n";
        assert_eq!(unlinked(errors), ["nopanic"]);
        assert!(unlinked("error: could not compile `attractor` (lib)").is_empty());
    }
}
