//! Names in messages: the one that somebody may have meant, lists of them, names given twice.

use std::fmt::Display;

/// The known name within a third of the letters, if there is one.
pub(crate) fn nearest<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    known
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|&(distance, candidate)| distance <= 1.max(candidate.len().min(name.len()) / 3))
        .filter(|&(distance, candidate)| distance < candidate.len())
        .min()
        .map(|(_, candidate)| candidate)
}

/// Names as they stand in a message: each in backticks, commas between them.
pub(crate) fn list(names: &[impl Display]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// A name without underscores, which papers write as indices.
pub(crate) fn plain(name: impl ToString) -> String {
    name.to_string().replace('_', "")
}

/// What to say of a name given to a second thing.
pub(crate) fn taken(name: &impl Display) -> String {
    format!("the name `{name}` is taken already: choose another one")
}

/// Insertions, deletions and replacements from one to the other; letters of either case are equal.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(!x.eq_ignore_ascii_case(&y));
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
