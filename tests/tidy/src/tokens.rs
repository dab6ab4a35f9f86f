//! Paths read from tokens, inside of macros as well.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// A path with more than one segment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mention {
    /// `crate`, `point`, `Filter`; the last may be `*`.
    pub segments: Vec<String>,
    /// Line in the file, from 1.
    pub line: usize,
}

/// All paths in tokens, those of grouped imports one by one.
#[must_use]
pub fn mentions(tokens: TokenStream) -> Vec<Mention> {
    let mut found = Vec::new();
    collect(&tokens.into_iter().collect::<Vec<_>>(), &mut found);
    found
}

fn collect(tokens: &[TokenTree], found: &mut Vec<Mention>) {
    let mut next = 0;
    while next < tokens.len() {
        match &tokens[next] {
            TokenTree::Group(group) => {
                collect(&group.stream().into_iter().collect::<Vec<_>>(), found);
                next += 1;
            }
            TokenTree::Ident(_) if !continues(&tokens[..next]) => next += path(&tokens[next..], &[], found),
            _ => next += 1,
        }
    }
}

/// True if the next token continues a path or is a member of a value.
fn continues(before: &[TokenTree]) -> bool {
    match before {
        [.., TokenTree::Punct(a), TokenTree::Punct(b)] if a.as_char() == ':' && b.as_char() == ':' => true,
        // Not so after a range, `a..b::c`.
        [.., TokenTree::Punct(a), TokenTree::Punct(b)] if b.as_char() == '.' => a.as_char() != '.',
        [.., TokenTree::Punct(b)] => b.as_char() == '.',
        _ => false,
    }
}

fn is_separator(tokens: &[TokenTree]) -> bool {
    matches!(tokens, [TokenTree::Punct(a), TokenTree::Punct(b), ..] if a.as_char() == ':' && b.as_char() == ':')
}

/// Reads a path or a tree of imports behind a prefix; returns how many tokens it takes.
fn path(tokens: &[TokenTree], prefix: &[String], found: &mut Vec<Mention>) -> usize {
    let mut segments = prefix.to_vec();
    let line = tokens.first().map_or(0, |first| first.span().start().line);
    let mut next = 0;
    loop {
        match tokens.get(next) {
            Some(TokenTree::Ident(name)) => {
                segments.push(name.to_string());
                next += 1;
            }
            Some(TokenTree::Punct(star)) if star.as_char() == '*' && !segments.is_empty() => {
                segments.push("*".to_owned());
                next += 1;
                break;
            }
            Some(TokenTree::Group(group))
                if group.delimiter() == Delimiter::Brace && !segments.is_empty() =>
            {
                let inside: Vec<_> = group.stream().into_iter().collect();
                let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
                for part in inside.split(is_comma).filter(|part| !part.is_empty()) {
                    path(part, &segments, found);
                }
                return next + 1;
            }
            // Generic arguments, which may hold paths of their own.
            _ => break,
        }
        if !is_separator(&tokens[next..]) {
            break;
        }
        next += 2;
    }
    if segments.len() > 1 {
        found.push(Mention { segments, line });
    }
    next.max(1)
}

#[cfg(test)]
mod tests {
    use super::{Mention, mentions};

    #[track_caller]
    fn check(code: &str, expected: &[&str]) {
        let found = mentions(code.parse().expect("tokens"));
        let written: Vec<String> = found.iter().map(|Mention { segments, .. }| segments.join("::")).collect();
        assert_eq!(written, expected);
    }

    #[test]
    fn every_form_of_a_path_is_seen() {
        check(
            "use crate::{a::{self, B}, c as d, e::*};",
            &["crate::a::self", "crate::a::B", "crate::c", "crate::e::*"],
        );
        check(
            "fn f(x: super::super::X) -> [u8; 0] { x.y::<piola::Z>(0..self::w(1)) }",
            &["super::super::X", "piola::Z", "self::w"],
        );
        check("assert!(crate::a::<b::C>() == d.e);", &["crate::a", "b::C"]);
        check("macro_rules! m { () => { $crate::a::b!() } }", &["crate::a::b"]);
    }
}
