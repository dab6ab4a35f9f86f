//! Tables in Markdown.

/// The first two rows: titles of columns of words, and of columns of numbers.
pub(crate) fn header(words: &[&str], numbers: &[&str]) -> String {
    let titles = [words, numbers].concat().join(" | ");
    format!("| {titles} |\n|{}{}\n", "---|".repeat(words.len()), "--:|".repeat(numbers.len()))
}

/// Adds a row.
pub(crate) fn row(table: &mut String, cells: &[String]) {
    *table += &format!("| {} |\n", cells.join(" | "));
}
