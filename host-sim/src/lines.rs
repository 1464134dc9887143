//! Tables of numbers that are given to the command: so many a line, separated by commas, with or without a
//! line of titles.

use std::path::Path;

use attractor::fixed::traits::Fixed;
use csv::{ReaderBuilder, Trim};

use crate::fail::{Fail, shortened};
use crate::number;
use crate::source;

/// Lines of `N` numbers, and what messages call each.
pub(crate) struct Lines<const N: usize> {
    /// What messages call the file.
    name: String,
    titles: [&'static str; N],
}

impl<const N: usize> Lines<N> {
    /// A table of these columns in a file.
    pub(crate) fn of(option: &str, path: &Path, titles: [&'static str; N]) -> Self {
        Self { name: format!("{option} {}", path.display()), titles }
    }

    /// A line on the command line itself.
    pub(crate) fn given(option: &str, titles: [&'static str; N]) -> Self {
        Self { name: option.to_owned(), titles }
    }

    /// The numbers of all lines.
    pub(crate) fn read<F: Fixed + std::str::FromStr>(
        &self,
        path: &Path,
        check: impl Fn([F; N]) -> Result<(), (usize, String)>,
    ) -> Result<Vec<[F; N]>, Fail> {
        let text = source::read_text(path)?;
        self.parse(&text, check)
    }

    /// The numbers of a text.
    pub(crate) fn parse<F: Fixed + std::str::FromStr>(
        &self,
        text: &str,
        check: impl Fn([F; N]) -> Result<(), (usize, String)>,
    ) -> Result<Vec<[F; N]>, Fail> {
        let mut table = ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            .trim(Trim::All)
            .from_reader(text.as_bytes());
        let mut all = Vec::new();
        for row in table.records() {
            let row = row.map_err(|error| Fail::new(format_args!("{}: {error}", self.name)))?;
            if row.iter().all(str::is_empty) || row.iter().eq(self.titles) {
                continue;
            }
            let line = line_of(text, row.position());
            let place =
                |key: &str, value: &str| format!("{}:{line}: {key} = {}", self.name, shortened(value));
            if row.len() != N {
                let whole: Vec<&str> = row.iter().collect();
                let place = place("line", &whole.join(","));
                let titles = self.titles.join(",");
                return Err(Fail::new(format_args!(
                    "{place}: {} numbers, a line has {N}: {titles}",
                    row.len()
                )));
            }
            let mut numbers = [F::ZERO; N];
            for ((number, cell), title) in numbers.iter_mut().zip(&row).zip(self.titles) {
                *number = number::nearest(cell)
                    .map_err(|reason| Fail::new(format_args!("{}: {reason}", place(title, cell))))?;
            }
            check(numbers).map_err(|(column, reason)| {
                let (title, cell) = (self.titles.get(column).unwrap_or(&""), row.get(column).unwrap_or(""));
                Fail::new(format_args!("{}: {reason}", place(title, cell)))
            })?;
            all.push(numbers);
        }
        if all.is_empty() {
            return Err(Fail::new(format_args!("{}: no line of numbers is in it", self.name)));
        }
        Ok(all)
    }
}

/// The line on which a row stands, from 1. Its position is where the row before ended: line ends and empty
/// lines follow.
pub(crate) fn line_of(text: &str, position: Option<&csv::Position>) -> usize {
    let before = position.and_then(|position| usize::try_from(position.byte()).ok()).unwrap_or(0);
    let bytes = text.as_bytes();
    let empty = bytes.iter().skip(before).take_while(|byte| matches!(byte, b'\r' | b'\n')).count();
    1 + bytes.iter().take(before + empty).filter(|byte| **byte == b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::num::Real;

    #[test]
    fn lines_are_read_with_and_without_titles() {
        let lines = Lines::given("--at", ["x", "y"]);
        let fine = |_: [Real; 2]| Ok(());
        let two = Ok(vec![[Real::ONE, Real::lit("-2.5")], [Real::ZERO, Real::ONE]]);
        for text in ["x,y\n1,-2.5\n0,1\n", "1,-2.5\n\n 0 , 1", "x, y\r\n1,-2.5\r\n0,1\r\n"] {
            assert_eq!(lines.parse(text, fine).map_err(|_| ()), two);
        }
        let said = |text: &str| match lines
            .parse(text, |[x, _]: [Real; 2]| if x == 0 { Err((0, "is 0".to_owned())) } else { Ok(()) })
        {
            Err(Fail::Message(message)) => message,
            other => panic!("{other:?}"),
        };
        assert_eq!(said("1,2\n3"), "--at:2: line = 3: 1 numbers, a line has 2: x,y");
        assert_eq!(said("1,2\n\n3,x"), "--at:3: y = x: is not a finite decimal number");
        assert_eq!(said("1,2\n0,5"), "--at:2: x = 0: is 0");
        assert_eq!(said("x,y\n"), "--at: no line of numbers is in it");
    }
}
