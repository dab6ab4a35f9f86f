//! Mistakes: each gives one message, on its tokens, with the remedy. The mistakes that
//! `tests/declarations/mistakes.rs` shows with whole messages are left out here.
//!
//! The files `*.txt` are tables of mistakes, and of energies next to them that have none. Lines with `==` in
//! front are a declaration; each line below is one case, which stands for the `…` of the declaration, after
//! other arguments in `#[…]` if it has them, in which `…` are the declaration's own. After `=>` follow the
//! tokens of the message and a part of it, the end if a `$` follows; a case with several mistakes has them in
//! lines of their own. A case without is free of mistakes.

mod remedies;

use proc_macro2::TokenStream;

/// The messages of a declaration, each with the tokens that it stands on.
fn mistakes(arguments: &str, item: &str) -> Vec<(String, String)> {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let understood = piola_codegen::analyse(tokens(arguments), tokens(item));
    let errors = understood.err().into_iter().flatten();
    errors.map(|error| (error.span().source_text().unwrap_or_default(), error.to_string())).collect()
}

#[track_caller]
fn check(arguments: &str, item: &str, expected: &[(&str, &str)]) {
    let found = mistakes(arguments, item);
    assert_eq!(found.len(), expected.len(), "#[material({arguments})] {item}\n{found:#?}");
    for ((tokens, message), (expected_tokens, expected)) in found.iter().zip(expected) {
        let is_said = match expected.strip_suffix('$') {
            Some(end) => message.ends_with(end),
            None => message.contains(expected),
        };
        assert!(is_said, "{item}\nsays: {message}\nnot:  {expected}");
        assert_eq!(tokens, expected_tokens, "{item}\n{message}");
    }
}

/// The arguments of an attribute in front of a text, and the rest of the text. Without an attribute they are
/// those of the `declaration`, for which `…` stands.
fn attribute<'a>(text: &'a str, declaration: &str) -> (String, &'a str) {
    let Some(text) = text.strip_prefix("#[") else { return (declaration.to_owned(), text) };
    let mut depth = 1;
    let is_end = |c: char| {
        depth += i32::from(c == '[') - i32::from(c == ']');
        depth == 0
    };
    let (arguments, rest) = text.split_at(text.find(is_end).expect("`]`"));
    (arguments.replace('…', declaration), rest[1..].trim_start())
}

#[track_caller]
fn check_table(table: &str) {
    let is_read = |line: &&str| !line.is_empty() && !line.starts_with("//");
    let mut lines = table.lines().filter(is_read).peekable();
    let (mut arguments, mut item) = (String::new(), String::new());
    while let Some(line) = lines.next() {
        if let Some(line) = line.strip_prefix("== ") {
            let mut declaration = line.to_owned();
            while let Some(line) = lines.next_if(|line| line.starts_with("== ")) {
                declaration += &line.replacen("== ", "\n", 1);
            }
            let (own, rest) = attribute(&declaration, "");
            (arguments, item) = (own, rest.to_owned());
            continue;
        }
        let (written, mut expected) = match line.rsplitn(3, " => ").collect::<Vec<_>>()[..] {
            [message, tokens, written] => (written, vec![(tokens, message)]),
            _ => (line, Vec::new()),
        };
        while let Some(line) = lines.next_if(|line| line.starts_with("  => ")) {
            expected.extend(line.trim_start_matches("  => ").split_once(" => "));
        }
        let (arguments, written) = attribute(written, &arguments);
        check(&arguments, &item.replace('…', written), &expected);
    }
}

#[test]
fn single_terms_and_arguments() {
    check_table(include_str!("table.txt"));
}

#[test]
fn declarations() {
    check_table(include_str!("declaration.txt"));
}

#[test]
fn domains() {
    check_table(include_str!("domain.txt"));
}

#[test]
fn energies() {
    check_table(include_str!("energy.txt"));
}
