//! Derivatives come from declarations.

use std::collections::BTreeSet;

use piola_tidy::{crates, forbid};
use proc_macro2::TokenTree;
use quote::ToTokens;
use syn::{Block, FnArg, ImplItem, Item, Pat, Signature, TraitItem};

/// Traits by which an energy answers.
const ANSWERS: [&str; 4] = ["Material", "Varying", "Law", "Response"];

/// Hands stretches to programs, whose derivatives the compiler has found.
const EXECUTOR: &str = "runtime/src/interpreter/material.rs";

/// No shipped code answers for a material but by other ones: a method of such a trait, and any that is called
/// as one, hands the stretches on to methods of these names and combines what they answer. Who looks at a
/// stretch computes an energy or a derivative of it by hand.
#[test]
fn no_derivative_is_written_by_hand() {
    let crates = crates();
    let modules = || crates.iter().filter(|one| one.is_published).flat_map(|one| &one.modules);
    let mut answers = BTreeSet::new();
    for item in modules().flat_map(|module| &module.items) {
        let Item::Trait(item) = item else { continue };
        if ANSWERS.iter().any(|name| item.ident == name) {
            let methods = item.items.iter().filter_map(|item| match item {
                TraitItem::Fn(method) => Some(&method.sig),
                _ => None,
            });
            let methods =
                methods.filter(|signature| signature.inputs.iter().any(|input| of_three(input).is_some()));
            answers.extend(methods.map(|signature| signature.ident.to_string()));
        }
    }
    let mut found = Vec::new();
    let mut judged = 0;
    for module in modules().filter(|module| !module.file.ends_with(EXECUTOR)) {
        for item in &module.items {
            let Item::Impl(block) = item else { continue };
            for item in &block.items {
                let ImplItem::Fn(method) = item else { continue };
                let name = method.sig.ident.to_string();
                if answers.contains(&name) {
                    judged += 1;
                    if looks_at_stretches(&method.sig, &method.block, &answers) {
                        let line = method.sig.ident.span().start().line;
                        found.push(format!("{}:{line}: {name}", module.file.display()));
                    }
                }
            }
        }
    }
    forbid("methods of materials that look at a stretch", &found);
    assert!(judged > 0, "nothing implements {answers:?}: this test looks for the wrong names");
}

/// The pattern of an argument of three numbers.
fn of_three(argument: &FnArg) -> Option<&Pat> {
    match argument {
        FnArg::Typed(typed) if typed.ty.to_token_stream().to_string().ends_with("; 3]") => Some(&typed.pat),
        _ => None,
    }
}

/// True if a method with arguments of three numbers uses them in any way other than passing them on to one of
/// `answers`.
fn looks_at_stretches(signature: &Signature, body: &Block, answers: &BTreeSet<String>) -> bool {
    let body: Vec<_> = body.to_token_stream().into_iter().collect();
    signature.inputs.iter().filter_map(of_three).any(|pattern| match pattern {
        Pat::Ident(name) => uses_otherwise(&body, &name.ident.to_string(), answers, false),
        Pat::Wild(_) => false,
        // Taken apart where it comes in.
        _ => true,
    })
}

/// True if a name stands anywhere except alone among the arguments of a call to one of `answers`.
fn uses_otherwise(tokens: &[TokenTree], name: &str, answers: &BTreeSet<String>, is_answered: bool) -> bool {
    let is_comma = |token: Option<&TokenTree>| match token {
        None => true,
        Some(TokenTree::Punct(punct)) => punct.as_char() == ',',
        Some(_) => false,
    };
    tokens.iter().enumerate().any(|(at, token)| match token {
        TokenTree::Ident(ident) if ident == name => {
            let before = at.checked_sub(1).and_then(|before| tokens.get(before));
            !(is_answered && is_comma(before) && is_comma(tokens.get(at + 1)))
        }
        TokenTree::Group(group) => {
            let inside: Vec<_> = group.stream().into_iter().collect();
            let called = tokens[..at].iter().rev().find_map(|token| match token {
                TokenTree::Ident(ident) => Some(ident.to_string()),
                _ => None,
            });
            let is_call = matches!(tokens[..at].last(), Some(TokenTree::Ident(_)))
                || matches!(tokens[..at].last(), Some(TokenTree::Punct(punct)) if punct.as_char() == '>');
            let is_answered = is_call && called.is_some_and(|name| answers.contains(&name));
            uses_otherwise(&inside, name, answers, is_answered)
        }
        _ => false,
    })
}
