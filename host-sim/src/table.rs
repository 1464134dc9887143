//! Tables: in columns for people, as CSV for programs.

use std::io::{StdoutLock, stdout};

use comfy_table::{CellAlignment, Row, Table, presets};
use serde::Serialize;

use crate::fail::Fail;

/// Rows in columns, the first `left` of them flush left, the others flush right.
pub(crate) fn columns<R: Into<Row>>(rows: impl IntoIterator<Item = R>, left: usize) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).add_rows(rows);
    for (i, column) in table.column_iter_mut().enumerate() {
        column.set_padding((0, 2));
        column.set_cell_alignment(if i < left { CellAlignment::Left } else { CellAlignment::Right });
    }
    table.trim_fmt()
}

/// Writes a header and rows to standard output.
pub(crate) fn csv<R: Serialize>(header: &[&str], rows: impl IntoIterator<Item = R>) -> Result<(), Fail> {
    let mut writer = records();
    writer.write_record(header)?;
    rows.into_iter().try_for_each(|row| writer.serialize(row))?;
    Ok(writer.flush()?)
}

/// CSV on standard output, record by record.
pub(crate) type Csv = csv::Writer<StdoutLock<'static>>;

/// A writer of records to standard output; flush it at the end.
pub(crate) fn records() -> Csv {
    csv::Writer::from_writer(stdout().lock())
}

#[cfg(test)]
mod tests {
    use super::columns;

    #[test]
    fn words_stand_left_and_numbers_right() {
        let rows = [["name", "count"], ["a", "1,234,567"], ["longer", ""]];
        assert_eq!(columns(rows, 1), "name        count\na       1,234,567\nlonger");
    }
}
