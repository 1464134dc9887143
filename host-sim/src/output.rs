//! Files that are complete or not there: written aside in the same directory, then renamed.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use crate::fail::Fail;

/// Writes `bytes` to `path`.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Fail> {
    let fail =
        |error: std::io::Error| Fail::new(format_args!("{}: cannot be written: {error}", path.display()));
    if path.is_dir() {
        return Err(Fail::new(format_args!("{}: cannot be written: it is a directory", path.display())));
    }
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !directory.is_dir() {
        let directory = directory.display();
        return Err(Fail::new(format_args!(
            "{}: cannot be written: there is no directory {directory}",
            path.display()
        )));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".attractor-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // an ordinary file: what the umask leaves of rw-rw-rw-
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(directory).map_err(fail)?;
    file.write_all(bytes).map_err(fail)?;
    file.persist(path).map_err(|error| fail(error.error))?;
    Ok(())
}

/// Makes a directory, with those above it, unless it is there.
pub(crate) fn make_directory(path: &Path) -> Result<(), Fail> {
    fs::create_dir_all(path)
        .map_err(|error| Fail::new(format_args!("{}: cannot be made: {error}", path.display())))
}
