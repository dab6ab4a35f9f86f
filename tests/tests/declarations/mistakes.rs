//! Mistaken declarations: all of their messages, word by word, each with the tokens that it stands on.

use libtest_mimic::Trial;
use piola_declare::{Energy, Place};
use piola_tests::declarations::{Text, texts};

/// A trial for each declaration, named by its number in the file.
pub(crate) fn trials() -> Vec<Trial> {
    let all = texts("mistakes");
    assert!(all.len() >= 50, "{} mistaken declarations", all.len());
    let trial = |(k, text): (usize, Text)| crate::trial(&format!("mistakes::{k}"), move || judge(&text));
    all.into_iter().enumerate().map(trial).collect()
}

fn judge(text: &Text) {
    let mistakes = Energy::from_rust(&text.source).expect_err("a mistaken declaration");
    let tokens = |Place { line, column, length }: Place| -> String {
        let line = text.source.lines().nth(line - 1).unwrap_or_default();
        line.chars().skip(column - 1).take(length).collect()
    };
    let said = mistakes
        .list
        .iter()
        .map(|mistake| format!("{} => {}", mistake.place.map(tokens).unwrap_or_default(), mistake.message));
    assert_eq!(said.collect::<Vec<_>>(), text.remarks("error").collect::<Vec<_>>(), "{}", text.source);
}
