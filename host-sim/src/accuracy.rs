//! `attractor accuracy`: the table of promises, measured now.

use std::io::Write as _;

use crate::cli::Accuracy;
use crate::fail::Fail;

/// Prints kernel, format, inputs tried, largest error, root of the mean square error, and the bound promised.
pub(crate) fn run(args: &Accuracy) -> Result<(), Fail> {
    let rows = attractor_tests::accuracy::table();
    let mut out = std::io::stdout().lock();
    if args.csv {
        writeln!(out, "kernel,format,inputs,max_error,rms,bound")?;
        for row in &rows {
            let quoted = |text: &str| {
                if text.contains([',', '"']) {
                    format!("\"{}\"", text.replace('"', "\"\""))
                } else {
                    text.to_owned()
                }
            };
            let (kernel, format) = (quoted(row.kernel), quoted(row.format));
            writeln!(
                out,
                "{kernel},{format},{},{:?},{:?},{:?}",
                row.inputs, row.max_error, row.rms, row.bound
            )?;
        }
        return Ok(());
    }
    let width = |text: fn(&attractor_tests::accuracy::Row) -> &str, title: &str| {
        rows.iter().map(|row| text(row).chars().count()).max().unwrap_or(0).max(title.len())
    };
    let (k, f) = (width(|r| r.kernel, "kernel"), width(|r| r.format, "format"));
    writeln!(
        out,
        "{:k$}  {:f$}  {:>9}  {:>9}  {:>9}  {:>9}",
        "kernel", "format", "inputs", "max error", "rms", "bound"
    )?;
    for row in &rows {
        let (max, rms, bound) = (row.max_error, row.rms, row.bound);
        writeln!(
            out,
            "{:k$}  {:f$}  {:>9}  {max:>9.2e}  {rms:>9.2e}  {bound:>9.2e}",
            row.kernel, row.format, row.inputs
        )?;
    }
    writeln!(
        out,
        "\nBounds of fractal interpolation functions (Fif, Dyadic, Surface, Cell) are those at an exact abscissa, \
         error_bound:\nthe rows of values have dyadic partitions, and a cell has no abscissa. On any other partition error_bound_at_x bounds the \
         error at x itself."
    )?;
    Ok(())
}
