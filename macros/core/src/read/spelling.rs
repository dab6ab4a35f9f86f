//! Names in messages: the likely correction of a misspelt one, lists of names, names given twice.

use std::fmt::Display;

/// The known name that differs least, in at most a third of the letters.
#[must_use]
pub fn nearest<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    known
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|&(distance, candidate)| distance <= 1.max(candidate.len().min(name.len()) / 3))
        .filter(|&(distance, candidate)| distance < candidate.len())
        .min()
        .map(|(_, candidate)| candidate)
}

/// A list of names for a message: each in backticks, commas between them.
pub(crate) fn list(names: &[impl Display]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// A name without underscores, which papers write as indices.
pub(crate) fn plain(name: impl ToString) -> String {
    name.to_string().replace('_', "")
}

/// The message about a name that is given twice.
pub(crate) fn taken(name: &impl Display) -> String {
    format!("the name `{name}` is taken already: choose another one")
}

/// The number of insertions, deletions and replacements between two names, without regard to case.
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
