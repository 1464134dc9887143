//! `attractor accuracy`: the table of promises, measured now.

use std::io::Write as _;

use crate::cli::Accuracy;
use crate::fail::Fail;
use crate::table;

const COLUMNS: [&str; 6] = ["kernel", "format", "inputs", "max_error", "rms", "bound"];

/// Prints kernel, format, inputs tried, largest error, root of the mean square error, and the bound promised.
pub(crate) fn run(args: &Accuracy) -> Result<(), Fail> {
    let rows = attractor_tests::accuracy::table();
    if args.csv {
        let rows = rows.iter().map(|r| (r.kernel, r.format, r.inputs, r.max_error, r.rms, r.bound));
        return table::csv(&COLUMNS, rows);
    }
    let short = |error: f64| format!("{error:.2e}");
    let head = COLUMNS.map(|column| column.replace('_', " "));
    let rows = rows.iter().map(|row| {
        let (kernel, format, inputs) = (row.kernel.into(), row.format.into(), row.inputs.to_string());
        [kernel, format, inputs, short(row.max_error), short(row.rms), short(row.bound)]
    });
    writeln!(
        std::io::stdout(),
        "{}\n\nBounds of fractal interpolation functions (Fif, Dyadic, Surface, Cell) are those at an exact abscissa, \
         error_bound:\nthe rows of values have dyadic partitions, and a cell has no abscissa. On any other partition error_bound_at_x bounds the \
         error at x itself.",
        table::columns([head].into_iter().chain(rows), 2)
    )?;
    Ok(())
}
