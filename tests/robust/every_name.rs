//! Every public function of core, and every type that is a picture, a palette or the like, is named by a test
//! of this room: a new one
//! cannot be forgotten.
//!
//! A method counts as named where it is called, `.name(`, any other function of a type where both stand
//! together, `Type::name`; a
//! type by its name.

use std::fs;
use std::path::{Path, PathBuf};

/// What core tells apart, or others implement: a type is one of these.
const TRAITS: [&str; 12] = [
    "Field",
    "EscapeTime",
    "Displacement",
    "Palette",
    "Leveled",
    "Ink",
    "Packing",
    "Drawable",
    "ImageDrawable",
    "GetPixel",
    "TryFrom",
    "FromStr",
];

/// The text of every Rust file at and below a path, with its name.
fn texts(path: &Path) -> Vec<(PathBuf, String)> {
    if path.is_dir() {
        let mut entries: Vec<_> = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        return entries.iter().flat_map(|entry| texts(entry)).collect();
    }
    let is_code = path.extension().is_some_and(|extension| extension == "rs");
    is_code.then(|| (path.to_owned(), fs::read_to_string(path).unwrap())).into_iter().collect()
}

/// Without what stands between `<` and its `>` at the beginning.
fn without_generics(text: &str) -> &str {
    if !text.starts_with('<') {
        return text;
    }
    let (mut depth, mut before) = (0, ' ');
    for (at, letter) in text.char_indices() {
        depth += match letter {
            '<' => 1,
            '>' if before != '-' => -1,
            _ => 0,
        };
        if depth == 0 {
            return &text[at + 1..];
        }
        before = letter;
    }
    text
}

fn word(text: &str) -> &str {
    let text = text.trim_start().trim_start_matches('&');
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

/// What must occur in the tests: any of the alternatives.
fn names(text: &str) -> Vec<Vec<String>> {
    let mut names = Vec::new();
    let mut owner = "";
    let mut rest = text;
    while let Some((line, after)) = rest.split_once('\n') {
        if line.starts_with("impl") && line.as_bytes().get(4).is_some_and(|c| matches!(c, b' ' | b'<')) {
            let header = rest.split('{').next().unwrap_or_default();
            let header = without_generics(header["impl".len()..].trim_start());
            match header.split_once(" for ") {
                Some((interface, implementor)) => {
                    owner = word(implementor);
                    // one letter: a parameter
                    if TRAITS.contains(&word(interface)) && owner.len() > 1 && owner != "dyn" {
                        names.push(vec![owner.to_owned()]);
                    }
                }
                None => owner = word(header),
            }
        }
        let public = line.trim_start().strip_prefix("pub ");
        let function = public.and_then(|line| line.trim_start_matches("const ").strip_prefix("fn "));
        if let Some(function) = function {
            let name = word(function);
            let signature = without_generics(&rest[rest.find(function).unwrap_or(0) + name.len()..]);
            let first = signature.split([',', ')']).next().unwrap_or_default();
            names.push(if !line.starts_with(' ') {
                vec![format!("{name}("), format!("({name})")]
            } else if first.split(|c: char| !c.is_alphanumeric()).any(|word| word == "self") {
                vec![format!(".{name}("), format!("{owner}::{name}")]
            } else {
                vec![format!("{owner}::{name}(")]
            });
        }
        rest = after;
    }
    names
}

/// Code without comments, blanks and the parameters of `::<..>`.
fn bare(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.flat_map(str::chars).filter(|c| !c.is_whitespace()).collect();
    let mut parts = code.split("::<");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |mut bare, part| {
        let with_bracket = format!("<{part}");
        bare += without_generics(&with_bracket);
        bare
    })
}

/// Whether a name stands in code, and not as a part of a longer one.
fn stands(code: &str, name: &str) -> bool {
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(name).any(|(at, _)| {
        let joined = |own: Option<char>, other: Option<char>| {
            own.is_some_and(is_letter) && other.is_some_and(is_letter)
        };
        !joined(name.chars().next(), code[..at].chars().next_back())
            && !joined(name.chars().next_back(), code[at + name.len()..].chars().next())
    })
}

#[test]
fn every_public_name_of_core_is_tried() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let this = Path::new(file!()).file_name();
    let mut tests = bare(&fs::read_to_string(root.join("robust.rs")).unwrap());
    for (path, text) in texts(&root.join("robust")) {
        if path.file_name() != this {
            tests += &bare(&text);
        }
    }
    let (mut found, mut missing) = (0, Vec::new());
    for (path, text) in texts(&root.join("../core/src")) {
        if path.file_name().is_some_and(|name| name == "testing.rs") {
            continue;
        }
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        for alternatives in names(code) {
            found += 1;
            if !alternatives.iter().any(|name| stands(&tests, name)) {
                missing.push(format!("{}: {}", path.display(), alternatives.join(" or ")));
            }
        }
    }
    println!("{found} names");
    assert!(found > 350 && missing.is_empty(), "{} of {found}: {missing:#?}", missing.len());
}
