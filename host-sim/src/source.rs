//! A scene's text and where it stands: every complaint names the file, the line, the key and the value.

use std::fs::File;
use std::io::Read as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use attractor::fixed::traits::Fixed;
use serde::de::DeserializeOwned;
use toml::Spanned;

use crate::builtin;
use crate::fail::Fail;
use crate::number::{self, Number};

/// A number of a scene file, with its place.
pub(crate) type Num = Spanned<Number>;

/// Scene and data files are a few lines: nothing longer is read.
const LONGEST: u64 = 1 << 22;

/// The text of a scene.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    /// What messages call it: a path, or the name of a built-in scene.
    pub(crate) name: String,
    text: String,
    /// Where its data files lie; none for a built-in scene.
    directory: Option<PathBuf>,
}

impl Source {
    /// A built-in scene.
    pub(crate) fn built_in(name: &str, text: &str) -> Self {
        Self { name: format!("{name} (built in)"), text: text.to_owned(), directory: None }
    }

    /// A file.
    pub(crate) fn read(path: &Path) -> Result<Self, Fail> {
        let name = path.display().to_string();
        let text = read_text(path)?;
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(Self { name, text, directory: Some(directory) })
    }

    /// The name and the text of a data file that the scene names.
    pub(crate) fn data(&self, file: &Spanned<String>) -> Result<(String, String), Fail> {
        match &self.directory {
            Some(directory) => {
                let path = directory.join(file.get_ref());
                let text = read_text(&path).map_err(|fail| match fail {
                    Fail::Message(message) => self.fail(file.span(), "csv", message),
                    pipe => pipe,
                })?;
                Ok((path.display().to_string(), text))
            }
            None => match builtin::data(file.get_ref()) {
                Some(text) => Ok((format!("{} (built in)", file.get_ref()), text.to_owned())),
                None => Err(self.fail(file.span(), "csv", "no such data is built in")),
            },
        }
    }

    /// The description that the text spells.
    pub(crate) fn parse<T: DeserializeOwned>(&self) -> Result<T, Fail> {
        toml::from_str(&self.text).map_err(|error| {
            let message = error.message().trim().replace('\n', ", ");
            match error.span().filter(|span| !message.starts_with("missing field") && !span.is_empty()) {
                Some(span) => {
                    let place = self.line(span.start);
                    let line = self.text.lines().nth(place - 1).unwrap_or("");
                    Fail::new(format_args!("{}:{place}: {message}: {}", self.name, shortened(line)))
                }
                None if self.text.trim().is_empty() => {
                    Fail::new(format_args!("{}: the file is empty, {message}", self.name))
                }
                None => {
                    let place = error.span().map_or(1, |span| self.line(span.start));
                    Fail::new(format_args!("{}:{place}: {message}", self.name))
                }
            }
        })
    }

    /// A complaint about the value at `span`, which belongs to `key`.
    pub(crate) fn fail(&self, span: Range<usize>, key: &str, reason: impl std::fmt::Display) -> Fail {
        let value = shortened(self.text.get(span.clone()).unwrap_or(""));
        Fail::new(format_args!("{}:{}: {key} = {value}: {reason}", self.name, self.line(span.start)))
    }

    /// A complaint about the scene as a whole.
    pub(crate) fn fail_all(&self, what: &str, reason: impl std::fmt::Display) -> Fail {
        Fail::new(format_args!("{}: {what}: {reason}", self.name))
    }

    /// The number nearest to the digits in the file.
    pub(crate) fn fixed<F: Fixed + FromStr>(&self, number: &Num, key: &str) -> Result<F, Fail> {
        number::nearest(self.digits(number)).map_err(|reason| self.fail(number.span(), key, reason))
    }

    /// Two of them.
    pub(crate) fn pair<F: Fixed + FromStr>(&self, pair: &[Num; 2], key: &str) -> Result<[F; 2], Fail> {
        let [a, b] = pair;
        Ok([self.fixed(a, &format!("{key}[0]"))?, self.fixed(b, &format!("{key}[1]"))?])
    }

    /// Three of them.
    pub(crate) fn triple<F: Fixed + FromStr>(&self, triple: &[Num; 3], key: &str) -> Result<[F; 3], Fail> {
        let [a, b, c] = triple;
        let at = |n: &Num, i| self.fixed(n, &format!("{key}[{i}]"));
        Ok([at(a, 0)?, at(b, 1)?, at(c, 2)?])
    }

    /// The digits of a number: what a string holds, or what stands in the file.
    pub(crate) fn digits<'a>(&'a self, number: &'a Num) -> &'a str {
        match number.get_ref() {
            Number::Text(text) => text,
            Number::Plain => self.text.get(number.span()).unwrap_or("").trim(),
        }
    }

    fn line(&self, offset: usize) -> usize {
        1 + self.text.bytes().take(offset).filter(|b| *b == b'\n').count()
    }
}

fn shortened(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.char_indices().nth(60) {
        Some((end, _)) => format!("{}...", &words[..end]),
        None => words,
    }
}

fn read_text(path: &Path) -> Result<String, Fail> {
    let fail = |reason: String| Fail::new(format_args!("{}: cannot be read: {reason}", path.display()));
    if path.is_dir() {
        return Err(fail("it is a directory".to_owned()));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| fail(error.to_string()))?;
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|error| fail(error.to_string()))?;
    if bytes.len() as u64 > LONGEST {
        return Err(fail(format!("it is longer than {LONGEST} bytes")));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(at).copied().unwrap_or(0);
        fail(format!("byte {at} is {byte:#04x}, this is no text in UTF-8"))
    })
}
