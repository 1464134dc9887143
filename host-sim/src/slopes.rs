//! Tables of slopes as files: how much of a surface leans which way, for a material of a world.
//!
//! TOML: `version`, `side`, `reach` in 256ths, and the `weights`, a row of slopes along x for each slope
//! along y. The same words as Rust, for firmware: [`attractor::trace::material::Tabulated`].

use attractor::num::Unit;
use attractor::trace::material::Tabulated;
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

/// A table as core has it: version, side, reach, weights.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Slopes {
    words: Vec<u16>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: Spanned<u16>,
    side: Spanned<u16>,
    reach: Spanned<u16>,
    weights: Spanned<Vec<Vec<u16>>>,
}

impl Slopes {
    /// Of words that core has written.
    pub(crate) fn new(words: &[u16]) -> Self {
        Self { words: words.to_vec() }
    }

    /// The table of a file; complaints name its line, key and value.
    pub(crate) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let [version, side, reach] = [&file.version, &file.side, &file.reach].map(|word| *word.get_ref());
        let mut words = vec![version, side, reach];
        let rows = file.weights.get_ref();
        let place = || source.place(file.weights.span(), "weights");
        if let Some((k, row)) = rows.iter().enumerate().find(|(_, row)| row.len() != usize::from(side)) {
            let reason = format!("row {k} has {} weights, side = {side} asks for as many", row.len());
            return Err(place().fail(reason));
        }
        words.extend(rows.iter().flatten());
        let slopes = Self { words };
        let refused = |error: attractor::Error| match error {
            attractor::Error::OutOfRange { what: "side of a table of slopes", .. } => {
                source.fail(file.side.span(), "side", error)
            }
            attractor::Error::OutOfRange { what: "reach of a table of slopes", .. } => {
                source.fail(file.reach.span(), "reach", error)
            }
            attractor::Error::Unsupported { what: "version of a table of slopes", .. } => {
                source.fail(file.version.span(), "version", error)
            }
            error => place().fail(error),
        };
        slopes.model(Unit::ONE).map_err(refused)?;
        Ok(slopes)
    }

    /// As core has it, of mirrors with this reflectance.
    pub(crate) fn model(&self, reflectance: Unit) -> Result<Tabulated<'_>, attractor::Error> {
        Tabulated::new(&self.words, reflectance)
    }

    /// Version, side, reach and weights.
    pub(crate) fn words(&self) -> &[u16] {
        &self.words
    }

    /// Squares along a side.
    pub(crate) fn side(&self) -> u16 {
        self.words.get(1).copied().unwrap_or(0)
    }

    /// The largest slope.
    pub(crate) fn reach(&self) -> f64 {
        f64::from(self.words.get(2).copied().unwrap_or(0)) / 256.0
    }

    /// The weights, a row of slopes along x for each slope along y.
    pub(crate) fn rows(&self) -> impl Iterator<Item = &[u16]> {
        self.words.get(3..).unwrap_or_default().chunks(usize::from(self.side().max(1)))
    }

    /// As a file.
    pub(crate) fn toml(&self, title: &str) -> String {
        let [version, side, reach] = [0, 1, 2].map(|k| self.words.get(k).copied().unwrap_or(0));
        let rows: String = self.rows().map(|row| format!("  [{}],\n", list(row))).collect();
        format!(
            "# {title}\n# reach in 256ths; a row of slopes along x for each slope along y\nversion = {version}\nside = {side}\nreach = {reach}\nweights = [\n{rows}]\n"
        )
    }

    /// The words as a list, sixteen a line.
    pub(crate) fn code(&self) -> String {
        let (head, weights) = self.words.split_at(3.min(self.words.len()));
        let lines = [head].into_iter().chain(weights.chunks(16));
        lines.map(|line| format!("    {},\n", list(line))).collect()
    }
}

fn list(words: &[u16]) -> String {
    words.iter().map(u16::to_string).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_comes_back_from_its_file() {
        let words = [1, 3, 500, 1, 0, 7, 40, 65535, 40, 7, 0, 1];
        let text = Slopes::new(&words).toml("A title.");
        let back = Slopes::load(&Source::built_in("table", &text)).unwrap();
        assert_eq!(back.words(), words);
        assert_eq!((back.side(), back.reach()), (3, 500.0 / 256.0));
        assert!(text.starts_with("# A title.\n") && text.contains("\n  [40, 65535, 40],\n"));
        assert_eq!(back.code(), "    1, 3, 500,\n    1, 0, 7, 40, 65535, 40, 7, 0, 1,\n");
    }
}
