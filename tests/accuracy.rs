//! The table of promises: every kernel with its format, the inputs tried, the errors found and the bound that it states.

/// One line of the table.
#[derive(Debug, Clone)]
pub struct Row {
    /// What was evaluated.
    pub kernel: &'static str,
    /// The format of its result.
    pub format: &'static str,
    /// How many inputs were tried.
    pub inputs: usize,
    /// The largest error.
    pub max_error: f64,
    /// The root of the mean square error.
    pub rms: f64,
    /// The bound promised in the documentation.
    pub bound: f64,
}

/// The whole table, measured now.
pub fn table() -> Vec<Row> {
    Vec::new()
}
