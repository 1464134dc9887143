//! Why the command gives up: a message of one line, or nobody listening.

use std::fmt::Display;
use std::io::{self, Write as _};

/// What ends a command early.
#[derive(Debug)]
pub(crate) enum Fail {
    /// One line that names the file, the key and the value.
    Message(String),
    /// Standard output was closed by its reader, who has seen enough.
    ClosedPipe,
}

impl Fail {
    /// A message; line ends and control characters in it become spaces.
    pub(crate) fn new(message: impl Display) -> Self {
        let text: String =
            message.to_string().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        Self::Message(text.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" "))
    }
}

/// Errors of standard output.
impl From<io::Error> for Fail {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::ClosedPipe
        } else {
            Self::new(format_args!("standard output: {error}"))
        }
    }
}

/// Says it on standard error; if nobody listens there either, so be it.
pub(crate) fn say(message: &str) {
    let _ = writeln!(io::stderr(), "attractor: {message}");
}
