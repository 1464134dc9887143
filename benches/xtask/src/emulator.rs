//! Runs an image in QEMU, with a time limit.

use std::ffi::{OsStr, OsString};
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use wait_timeout::ChildExt as _;
use which::which_in_global;

use crate::targets::{Machine, Target};

/// Fails with the names of the packages when an emulator is missing, before anything is built.
pub(crate) fn find_all(targets: &[&Target]) -> Result<()> {
    look_for(targets, &path())
}

fn look_for(targets: &[&Target], path: &OsStr) -> Result<()> {
    let machines = targets.iter().flat_map(|target| [Some(target.machine), target.counting]).flatten();
    let mut missing: Vec<_> =
        machines.filter(|m| !is_in(path, m.qemu)).map(|m| (m.qemu, m.package)).collect();
    missing.sort_unstable();
    missing.dedup();
    if missing.is_empty() {
        return Ok(());
    }
    let (programs, packages): (Vec<_>, Vec<_>) = missing.into_iter().unzip();
    bail!(
        "{} not found\n  help: apt-get install {} (or .ci/target-setup)",
        programs.join(", "),
        packages.join(" ")
    )
}

/// Whether there is such a program.
pub(crate) fn has(program: &str) -> bool {
    is_in(&path(), program)
}

fn path() -> OsString {
    std::env::var_os("PATH").unwrap_or_default()
}

fn is_in(path: &OsStr, program: &str) -> bool {
    which_in_global(program, Some(path)).is_ok_and(|mut found| found.next().is_some())
}

/// Runs `image` on `machine` and returns what it printed. An image that fails or does not end in time is an
/// error.
pub(crate) fn run(
    machine: &Machine,
    image: &Path,
    arguments: &[&str],
    options: &[&str],
    directory: &Path,
    limit: Duration,
) -> Result<String> {
    let name = image.file_name().unwrap_or_default().display().to_string();
    let mut semihosting = format!("enable=on,target=native,arg={name}");
    for argument in arguments {
        semihosting.push_str(",arg=");
        // QEMU's way to write a comma inside of a value
        semihosting.push_str(&argument.replace(',', ",,"));
    }
    let mut child = Command::new(machine.qemu)
        .args(machine.arguments)
        .args(["-nographic", "-semihosting-config", &semihosting])
        .args(options)
        .arg("-kernel")
        .arg(image)
        .current_dir(directory)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| {
            format!("{} cannot be started (apt-get install {})", machine.qemu, machine.package)
        })?;
    let drain = |pipe: Option<Box<dyn Read + Send>>| {
        thread::spawn(move || {
            let mut text = Vec::new();
            if let Some(mut pipe) = pipe {
                // a broken pipe ends the text, and the exit status says why
                let _ = pipe.read_to_end(&mut text);
            }
            String::from_utf8_lossy(&text).into_owned()
        })
    };
    let output = drain(child.stdout.take().map(|pipe| Box::new(pipe) as _));
    let errors = drain(child.stderr.take().map(|pipe| Box::new(pipe) as _));
    let status = child.wait_timeout(limit)?;
    if status.is_none() {
        child.kill()?;
        child.wait()?;
    }
    let text = |reader: thread::JoinHandle<String>| reader.join().unwrap_or_default();
    let (output, errors) = (text(output), text(errors));
    let tail = || {
        let lines: Vec<_> = output.lines().chain(errors.lines()).collect();
        lines[lines.len().saturating_sub(5)..].join("\n    ")
    };
    match status {
        Some(status) if status.success() => Ok(output),
        Some(status) => bail!("{name} on {}: {status}\n    {}", machine.name, tail()),
        None => bail!(
            "{name} on {} did not end within {} s and was stopped\n    {}",
            machine.name,
            limit.as_secs_f64(),
            tail()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::targets;

    #[test]
    fn missing_emulators_are_named_with_their_packages() {
        let all: Vec<_> = targets::ALL.iter().collect();
        let refused = look_for(&all, OsStr::new("/nowhere")).unwrap_err().to_string();
        assert!(refused.contains("qemu-system-arm, qemu-system-riscv32 not found"), "{refused}");
        assert!(refused.contains("apt-get install qemu-system-arm qemu-system-misc"), "{refused}");
    }

    /// A shell in place of the emulator, which runs `script`.
    fn ran(script: &'static str) -> Result<String> {
        let arguments: &'static [&'static str] = Vec::leak(vec!["-c", script]);
        let machine = Machine { name: "shell", qemu: "sh", package: "dash", arguments };
        run(&machine, Path::new("image"), &[], &[], Path::new("."), Duration::from_millis(500))
    }

    #[test]
    fn an_image_that_hangs_is_stopped_and_reported() {
        let start = std::time::Instant::now();
        let stopped = ran("echo started; exec sleep 60").unwrap_err().to_string();
        assert!(start.elapsed() < Duration::from_secs(30), "the image was not stopped");
        assert!(stopped.contains("image on shell did not end within 0.5 s and was stopped"), "{stopped}");
        assert!(stopped.contains("started"), "{stopped}");
    }

    #[test]
    fn an_image_that_fails_is_an_error_with_what_it_said_last() {
        assert_eq!(ran("echo done").unwrap(), "done\n");
        let failed = ran("echo why >&2; exit 3").unwrap_err().to_string();
        assert!(failed.contains("exit status: 3") && failed.contains("why"), "{failed}");
    }
}
