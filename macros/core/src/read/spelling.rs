//! Names: the likely correction of a misspelt one, lists of names, names given twice, Greek letters.

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

/// Greek letters by their names; other forms of a letter follow the one that is printed.
const GREEK: [(&str, &str); 24] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("gamma", "γ"),
    ("delta", "δ"),
    ("epsilon", "εϵ"),
    ("zeta", "ζ"),
    ("eta", "η"),
    ("theta", "θϑ"),
    ("iota", "ι"),
    ("kappa", "κϰ"),
    ("lambda", "λ"),
    // The second one is the sign of micrometres.
    ("mu", "μµ"),
    ("nu", "ν"),
    ("xi", "ξ"),
    ("omicron", "ο"),
    ("pi", "πϖ"),
    ("rho", "ρϱ"),
    ("sigma", "σς"),
    ("tau", "τ"),
    ("upsilon", "υ"),
    ("phi", "φϕ"),
    ("chi", "χ"),
    ("psi", "ψ"),
    ("omega", "ω"),
];

/// A name with the names of its Greek letters: `mu_1` for `μ_1`, `Lambda` for `Λ`.
#[must_use]
pub fn spelled_out(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        let small = letter.to_lowercase().next().unwrap_or(letter);
        match GREEK.iter().find(|(_, letters)| letters.contains(small)) {
            Some((word, _)) if small == letter => text += word,
            Some((word, _)) => {
                text += &word[..1].to_uppercase();
                text += &word[1..];
            }
            None => text.push(letter),
        }
    }
    text
}

/// The small Greek letter of a name.
#[must_use]
pub fn greek(name: &str) -> Option<char> {
    GREEK.iter().find(|(word, _)| *word == name).and_then(|(_, letters)| letters.chars().next())
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
