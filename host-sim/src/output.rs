//! Where a picture goes. A file is complete or not there: written aside in the same directory, then renamed.
//! A device or a pipe is written to as it is.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use crate::fail::Fail;

/// Writes `bytes` to `path`.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Fail> {
    let written = match fs::metadata(path) {
        Ok(there) if there.is_file() => replace(path, bytes),
        Ok(_) => OpenOptions::new().write(true).open(path).and_then(|mut device| device.write_all(bytes)),
        Err(_) => create(path, bytes, None),
    };
    written.map_err(|error| refused(path, &error))
}

/// Whether a file that is there may be written, or there is a directory for it, before anything is computed.
pub(crate) fn check(path: &Path) -> Result<(), Fail> {
    match fs::metadata(path) {
        Ok(_) => OpenOptions::new().write(true).open(path).map(|_| ()).map_err(|error| refused(path, &error)),
        Err(_) => directory_of(path).map(|_| ()).map_err(|error| refused(path, &error)),
    }
}

/// The same, and whether it is another file than all that are read: written over one, it would be lost.
pub(crate) fn check_beside<'a>(path: &Path, inputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Fail> {
    // two devices, such as a terminal, may be one
    let goal = path.canonicalize().ok().filter(|goal| goal.is_file());
    let is_goal = |input: &&Path| goal.is_some() && input.canonicalize().ok() == goal;
    if let Some(input) = inputs.into_iter().find(is_goal) {
        let (path, input) = (path.display(), input.display());
        let reason = format!("it is what is read, {input}, which would be lost: another name is needed");
        return Err(Fail::new(format_args!("--output {path}: {reason}")));
    }
    check(path)
}

/// What is wrong with the name of another file.
pub(crate) const PNG: &str = "pictures are PNG files, whose names end in .png";

/// Whether a picture may have this name: that of a PNG file, or of a device or a pipe.
pub(crate) fn check_png(path: &Path) -> Result<(), Fail> {
    let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    // of a directory something else is said
    if is_png || fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return Ok(());
    }
    Err(Fail::new(format_args!("--output {}: {PNG}", path.display())))
}

/// Whether nothing is there yet, of a name that nobody has given: what is there may be the only copy.
pub(crate) fn vacant(path: &Path) -> Result<(), Fail> {
    match fs::symlink_metadata(path) {
        Ok(_) => {
            let path = path.display();
            let reason = "it is there already, and without --output nothing is replaced";
            Err(Fail::new(format_args!("{path}: {reason}; -o FILE.png names what is written")))
        }
        Err(_) => Ok(()),
    }
}

fn refused(path: &Path, error: &io::Error) -> Fail {
    Fail::new(format_args!("{}: cannot be written: {error}", path.display()))
}

/// A file that is there keeps its permissions, and a link to it stays a link.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // may it be written to?
    let there = OpenOptions::new().write(true).open(path)?;
    create(&path.canonicalize()?, bytes, Some(&there))
}

/// A new file, with the permissions of another.
fn create(path: &Path, bytes: &[u8], like: Option<&File>) -> io::Result<()> {
    let directory = directory_of(path)?;
    let mut builder = tempfile::Builder::new();
    builder.prefix(".attractor-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // an ordinary file: what the umask leaves of rw-rw-rw-
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(directory)?;
    if let Some(like) = like {
        file.as_file().set_permissions(like.metadata()?.permissions())?;
    }
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

fn directory_of(path: &Path) -> io::Result<&Path> {
    let directory = parent(path);
    if directory.is_dir() {
        return Ok(directory);
    }
    Err(io::Error::other(format!("there is no directory {}", directory.display())))
}

/// The directory in which a file lies.
pub(crate) fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// A directory that is there until the end if something is written into it.
#[derive(Debug)]
pub(crate) struct Directory {
    /// Those that were not there before, the outermost first.
    made: Vec<PathBuf>,
}

impl Directory {
    /// Makes a directory, with those above it, unless it is there, and sees whether it can be written to.
    /// `output` is what the complaint names.
    pub(crate) fn ready(path: &Path, output: &Path) -> Result<Self, Fail> {
        let missing = path.ancestors().take_while(|a| !a.as_os_str().is_empty() && !a.exists());
        let mut made: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
        made.reverse();
        let this = Self { made };
        match fs::create_dir_all(path).and_then(|()| tempfile::tempfile_in(path)) {
            Ok(_) => Ok(this),
            Err(error) => {
                let (output, path) = (output.display(), path.display());
                Err(Fail::new(format_args!("--output {output}: nothing can be written into {path}: {error}")))
            }
        }
    }
}

impl Drop for Directory {
    fn drop(&mut self) {
        // one with something in it stays
        for directory in self.made.iter().rev() {
            let _ = fs::remove_dir(directory);
        }
    }
}
