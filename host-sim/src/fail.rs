//! Why the command gives up: a message of one line, or nobody listening.

use std::fmt::Display;
use std::io::{self, Write as _};

/// The most characters of a message: what somebody else's file holds does not fill the screen.
const LONGEST: usize = 1000;
/// The most characters of a value that a message quotes.
const QUOTED: usize = 60;

/// What ends a command early.
#[derive(Debug)]
pub(crate) enum Fail {
    /// One line that names the file, the key and the value.
    Message(String),
    /// Standard output was closed by its reader, who has seen enough.
    ClosedPipe,
}

impl Fail {
    /// A message of [`one_line`].
    pub(crate) fn new(message: impl Display) -> Self {
        Self::Message(one_line(&message.to_string()))
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

impl From<csv::Error> for Fail {
    fn from(error: csv::Error) -> Self {
        match error.into_kind() {
            csv::ErrorKind::Io(error) => error.into(),
            other => Self::new(format_args!("standard output: {other:?}")),
        }
    }
}

/// Says it on standard error; if nobody listens there either, so be it.
pub(crate) fn say(message: &str) {
    let _ = writeln!(io::stderr(), "attractor: {}", one_line(message));
}

/// The text with a space for all line ends, control characters and spaces in a row; of a long one the
/// beginning and the end.
pub(crate) fn one_line(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let words: Vec<&str> = text.split(' ').filter(|word| !word.is_empty()).collect();
    let line = words.join(" ");
    let end = |from: usize| line.char_indices().nth(from).map_or(line.len(), |(at, _)| at);
    match line.chars().count().checked_sub(LONGEST) {
        None | Some(0) => line,
        Some(more) => format!("{} ... {}", &line[..end(LONGEST / 2)], &line[end(LONGEST / 2 + more)..]),
    }
}

/// What a message quotes of somebody else's text.
pub(crate) fn shortened(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.char_indices().nth(QUOTED) {
        Some((end, _)) => format!("{}...", &words[..end]),
        None => words,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_message_keeps_its_beginning_and_its_end() {
        let text = format!("scene.toml:3:\n{}\u{1b}[31m\t allowed is 1 to 3", "é".repeat(1_000_000));
        let line = one_line(&text);
        assert!(line.starts_with("scene.toml:3: é") && line.ends_with("é [31m allowed is 1 to 3"), "{line}");
        assert_eq!(line.chars().count(), LONGEST + " ... ".len());
        assert_eq!(one_line(&line), line);
        assert_eq!(one_line(&"x".repeat(LONGEST)), "x".repeat(LONGEST));
        assert_eq!(shortened(&"y".repeat(61)), format!("{}...", "y".repeat(60)));
    }
}
