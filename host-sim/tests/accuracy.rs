//! `attractor accuracy` prints the table of promises.

use std::path::Path;

use crate::common::good;

#[test]
fn the_table_has_its_columns_in_both_forms() {
    let csv = good(Path::new("."), &["accuracy", "--csv"]);
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("kernel,format,inputs,max_error,rms,bound"));
    let rows = lines.count();
    assert!(rows > 0);
    let table = good(Path::new("."), &["accuracy"]);
    let (table, words) = table.split_once("\n\n").expect("what the bounds are follows the table");
    assert_eq!(table.lines().count(), rows + 1);
    assert!(words.contains("error_bound_at_x"), "{words}");
    assert!(table.starts_with("kernel"));
}
