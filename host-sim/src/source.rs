//! A scene's text and where it stands: every complaint names the file, the line, the key and the value, also
//! one that comes up
//! while a picture is drawn.

use std::fmt::Display;
use std::fs::File;
use std::io::Read as _;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use attractor::fixed::traits::Fixed;
use embedded_graphics::geometry::Size;
use serde::de::DeserializeOwned;
use toml::Spanned;

use crate::builtin;
use crate::fail::{Fail, say, shortened};
use crate::number::{self, Number};

/// A number of a scene file, with its place.
pub(crate) type Num = Spanned<Number>;

/// Scene and data files are a few lines: nothing longer is read.
const LONGEST: u64 = 1 << 22;

/// A key of a scene file and its value, for complaints that come later.
#[derive(Debug, Clone)]
pub(crate) struct Place(String);

impl Place {
    /// A complaint about the value.
    pub(crate) fn fail(&self, reason: impl Display) -> Fail {
        Fail::new(format_args!("{}: {reason}", self.0))
    }

    /// A complaint about the value that depends on the size of the picture.
    pub(crate) fn fail_at(&self, size: Size, reason: impl Display) -> Fail {
        self.fail(format_args!("on {} x {} pixels: {reason}", size.width, size.height))
    }
}

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

    /// A text that another names.
    pub(crate) fn named(name: String, text: String) -> Self {
        Self { name, text, directory: None }
    }

    /// A file.
    pub(crate) fn read(path: &Path) -> Result<Self, Fail> {
        let name = path.display().to_string();
        let text = read_text(path)?;
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(Self { name, text, directory: Some(directory) })
    }

    /// The name and the text of a data file that the scene names.
    pub(crate) fn data(&self, file: &Spanned<String>, key: &str) -> Result<(String, String), Fail> {
        match &self.directory {
            Some(directory) => {
                let path = directory.join(file.get_ref());
                let text = read_text(&path).map_err(|fail| match fail {
                    Fail::Message(message) => self.fail(file.span(), key, message),
                    pipe => pipe,
                })?;
                Ok((path.display().to_string(), text))
            }
            None => match builtin::data(file.get_ref()) {
                Some(text) => Ok((format!("{} (built in)", file.get_ref()), text.to_owned())),
                None => Err(self.fail(file.span(), key, "no such data is built in")),
            },
        }
    }

    /// The path of a file that the scene names; none for a built-in scene.
    pub(crate) fn beside(&self, file: &str) -> Option<PathBuf> {
        self.directory.as_ref().map(|directory| directory.join(file))
    }

    /// Whether nothing is in it.
    pub(crate) fn is_empty(&self) -> bool {
        self.text.trim().is_empty()
    }

    /// The description that the text spells.
    pub(crate) fn parse<T: DeserializeOwned>(&self) -> Result<T, Fail> {
        toml::from_str(&self.text).map_err(|error| {
            let message = error.message().trim().replace('\n', ", ");
            let message = message.split(' ').map(shortened).collect::<Vec<_>>().join(" ");
            match error.span().filter(|span| !message.starts_with("missing field") && !span.is_empty()) {
                Some(span) => {
                    let place = self.line(span.start);
                    let line = self.text.lines().nth(place - 1).unwrap_or("");
                    Fail::new(format_args!("{}:{place}: {message}: {}", self.name, shortened(line)))
                }
                None => {
                    let place = error.span().map_or(1, |span| self.line(span.start));
                    let hint = "`attractor list` names the keys of every kind";
                    Fail::new(format_args!("{}:{place}: {message}; {hint}", self.name))
                }
            }
        })
    }

    /// The value at `span`, which belongs to `key`.
    pub(crate) fn place(&self, span: Range<usize>, key: &str) -> Place {
        let value = shortened(self.text.get(span.clone()).unwrap_or(""));
        Place(format!("{}:{}: {key} = {value}", self.name, self.line(span.start)))
    }

    /// A key that the file leaves out, or the scene as a whole.
    pub(crate) fn whole(&self, what: &str) -> Place {
        Place(format!("{}: {what}", self.name))
    }

    /// A complaint about the value at `span`, which belongs to `key`.
    pub(crate) fn fail(&self, span: Range<usize>, key: &str, reason: impl Display) -> Fail {
        self.place(span, key).fail(reason)
    }

    /// A complaint about the scene as a whole.
    pub(crate) fn fail_all(&self, what: &str, reason: impl Display) -> Fail {
        self.whole(what).fail(reason)
    }

    /// Says on standard error what becomes of the value at `span`, which is no mistake.
    pub(crate) fn note(&self, span: Range<usize>, key: &str, what: &str) {
        let Place(place) = self.place(span, key);
        say(&format!("{place}: {what}"));
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

pub(crate) fn read_text(path: &Path) -> Result<String, Fail> {
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
    // an editor's mark of UTF-8, no part of the text
    let bytes = match bytes.strip_prefix(b"\xef\xbb\xbf") {
        Some(text) => text.to_vec(),
        None => bytes,
    };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let byte = error.as_bytes().get(at).copied().unwrap_or(0);
        fail(format!("byte {at} is {byte:#04x}, this is no text in UTF-8"))
    })
}
