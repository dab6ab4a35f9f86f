//! Tables in Markdown.

/// A table with these titles of columns of words, and of columns of numbers.
pub(crate) fn table(words: &[&str], numbers: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let titles = [words, numbers].concat().join(" | ");
    let mut text = format!("| {titles} |\n|{}{}\n", "---|".repeat(words.len()), "--:|".repeat(numbers.len()));
    for cells in rows {
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}
