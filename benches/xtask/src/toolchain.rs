//! A compiler for the target: rustup's, else rustup's after fetching the target, else Debian's with `core`
//! built from source.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::Prefer;
use crate::targets::Target;

/// A compiler that can build for a target.
#[derive(Debug, Clone)]
pub(crate) struct Toolchain {
    cargo: PathBuf,
    rustc: PathBuf,
    /// What `rustc --version` says of the release, for instance `1.95.0`. Counts belong to a release.
    pub(crate) release: String,
    /// The linker, where `core` has to be built as well.
    build_std: Option<Linker>,
}

#[derive(Debug, Clone)]
struct Linker {
    path: PathBuf,
    /// `-C` options that it takes to use it.
    options: &'static [&'static str],
}

impl fmt::Display for Toolchain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.build_std {
            None => write!(f, "rustc {} with rustup's core", self.release),
            Some(linker) => {
                let (rustc, linker) = (self.rustc.display(), linker.path.display());
                write!(f, "rustc {} ({rustc}), core from source, linked by {linker}", self.release)
            }
        }
    }
}

impl Toolchain {
    /// `cargo COMMAND` for the target in `directory`, without whatever flags the environment holds: they
    /// would replace the package's own.
    pub(crate) fn cargo(&self, command: &str, target: &Target, directory: &Path) -> Command {
        let mut cargo = Command::new(&self.cargo);
        cargo.current_dir(directory).arg(command).args(["--locked", "--release", "--target", target.triple]);
        let kept =
            ["CARGO_HOME", "CARGO_NET", "CARGO_HTTP", "CARGO_REGISTR", "CARGO_SOURCE", "CARGO_TERM_COLOR"];
        for (name, _) in std::env::vars() {
            let foreign = name.starts_with("CARGO") && !kept.iter().any(|kept| name.starts_with(kept));
            if name == "RUSTFLAGS" || name == "RUSTC" || foreign {
                cargo.env_remove(name);
            }
        }
        if let Some(linker) = &self.build_std {
            let options = [format!("linker={}", linker.path.display())];
            let options = options.iter().map(String::as_str).chain(linker.options.iter().copied());
            let mut flags: Vec<_> = options.map(|o| format!("-C{o}")).collect();
            flags.extend(target.options.iter().map(|option| (*option).to_owned()));
            cargo
                .arg("-Zbuild-std=core")
                .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"))
                .env("CARGO_TARGET_DIR", directory.join("../../target/cortex-m-web"))
                .env("RUSTC", &self.rustc)
                .env("RUSTC_BOOTSTRAP", "1")
                .env_remove("RUSTUP_TOOLCHAIN");
        }
        cargo
    }
}

/// A compiler for `target`.
pub(crate) fn find(target: &Target, prefer: Prefer) -> Result<Toolchain> {
    let mut tried = Vec::new();
    if prefer != Prefer::Web {
        match rustup(target) {
            Ok(found) => return Ok(found),
            Err(error) => tried.push(format!("rustup: {error:#}")),
        }
    }
    if prefer != Prefer::Rustup {
        match web(target) {
            Ok(found) => return Ok(found),
            Err(error) => tried.push(format!("Debian's compiler: {error:#}")),
        }
    }
    bail!(
        "no compiler can build for {}\n  {}\n  help: rustup target add {}, or: apt-get install rustc-web cargo-web rust-web-src lld (.ci/target-setup does what is missing)",
        target.triple,
        tried.join("\n  "),
        target.triple
    )
}

/// The compiler that built this program, if it has the target's `core` or can get it.
fn rustup(target: &Target) -> Result<Toolchain> {
    let cargo = PathBuf::from(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let rustc = own_rustc();
    let sysroot = PathBuf::from(say(Command::new(&rustc).args(["--print", "sysroot"]))?);
    let core = sysroot.join("lib/rustlib").join(target.triple).join("lib");
    if !core.is_dir() {
        let mut add = Command::new("rustup");
        add.args(["target", "add", target.triple]);
        if let Some(name) = sysroot.file_name() {
            add.arg("--toolchain").arg(name);
        }
        eprintln!("{}: fetching it with rustup", target.triple);
        say(&mut add)?;
    }
    if !core.is_dir() {
        bail!("{} has no core for the target", sysroot.display());
    }
    Ok(Toolchain { cargo, release: release(&rustc)?, rustc, build_std: None })
}

/// The compiler beside the cargo that runs this program.
fn own_rustc() -> PathBuf {
    let beside = std::env::var_os("CARGO").map(|cargo| PathBuf::from(cargo).with_file_name("rustc"));
    beside.filter(|rustc| rustc.is_file()).unwrap_or_else(|| "rustc".into())
}

/// Debian's compiler, its library's source and a linker.
fn web(target: &Target) -> Result<Toolchain> {
    let [rustc, cargo] = ["/usr/bin/rustc", "/usr/bin/cargo"].map(PathBuf::from);
    for (program, package) in [(&rustc, "rustc-web"), (&cargo, "cargo-web")] {
        if !program.is_file() {
            bail!("{} is missing (apt-get install {package})", program.display());
        }
    }
    let sysroot = PathBuf::from(say(Command::new(&rustc).args(["--print", "sysroot"]))?);
    if !sysroot.join("lib/rustlib/src/rust/library/core").is_dir() {
        bail!("the source of core is missing (apt-get install rust-web-src)");
    }
    Ok(Toolchain { cargo, release: release(&rustc)?, rustc, build_std: Some(linker(target)?) })
}

/// A linker: LLVM's of rustup or of Debian, else GNU's.
fn linker(target: &Target) -> Result<Linker> {
    let rustup = say(Command::new(own_rustc()).args(["--print", "sysroot"]))
        .map(|sysroot| {
            let lib = Path::new(&sysroot).join("lib/rustlib");
            let host = if cfg!(target_arch = "aarch64") { "aarch64" } else { "x86_64" };
            lib.join(format!("{host}-unknown-linux-gnu/bin/rust-lld"))
        })
        .ok();
    let gnu = if target.triple.starts_with("riscv") { "riscv64-unknown-elf-ld" } else { "arm-none-eabi-ld" };
    let mut candidates = rustup
        .into_iter()
        .chain(["ld.lld", "ld.lld-19", "ld.lld-16", "ld.lld-14"].map(|name| Path::new("/usr/bin").join(name)))
        .map(|path| Linker { path, options: &[] })
        .chain([Linker { path: Path::new("/usr/bin").join(gnu), options: &["linker-flavor=ld"] }]);
    candidates.find(|linker| linker.path.is_file()).context("no linker (apt-get install lld)")
}

fn release(rustc: &Path) -> Result<String> {
    let version = say(Command::new(rustc).arg("--version"))?;
    version
        .split_whitespace()
        .nth(1)
        .map(str::to_owned)
        .with_context(|| format!("unknown version: {version}"))
}

/// What a command prints, without the last line end.
fn say(command: &mut Command) -> Result<String> {
    let output =
        command.output().with_context(|| format!("{} cannot be started", command.get_program().display()))?;
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        bail!(
            "{} failed: {}",
            command.get_program().display(),
            errors.trim().lines().last().unwrap_or("no message")
        );
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim_end().to_owned())
}
