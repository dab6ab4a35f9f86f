//! Derivatives come from declarations.

use std::collections::BTreeSet;

use piola_tidy::{Function, crates, forbid, functions, tokens};
use quote::ToTokens;
use syn::{FnArg, Item, Pat, Signature, TraitItem};

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
            let methods = methods.filter(|signature| stretches(signature).next().is_some());
            answers.extend(methods.map(|signature| signature.ident.to_string()));
        }
    }
    let (mut found, mut judged) = (Vec::new(), 0);
    for module in modules().filter(|module| !module.file.ends_with(EXECUTOR)) {
        for method in module.items.iter().filter(|item| matches!(item, Item::Impl(_))).flat_map(functions) {
            let name = &method.signature.ident;
            if answers.contains(&name.to_string()) {
                judged += 1;
                if looks_at_stretches(&method, &answers) {
                    found.push(format!("{}:{}: {name}", module.file.display(), name.span().start().line));
                }
            }
        }
    }
    forbid("methods of materials that look at a stretch", &found);
    assert!(judged > 0, "nothing implements {answers:?}: this test looks for the wrong names");
}

/// The arguments of three numbers.
fn stretches(signature: &Signature) -> impl Iterator<Item = &Pat> {
    signature.inputs.iter().filter_map(|argument| match argument {
        FnArg::Typed(typed) if typed.ty.to_token_stream().to_string().ends_with("; 3]") => Some(&*typed.pat),
        _ => None,
    })
}

/// True if a method with arguments of three numbers uses them in any way other than alone among the arguments
/// of a call to one of `answers`.
fn looks_at_stretches(method: &Function<'_>, answers: &BTreeSet<String>) -> bool {
    let tokens = tokens(method.body);
    let text = |at: usize| tokens[at].text.as_str();
    stretches(method.signature).any(|pattern| {
        let name = match pattern {
            Pat::Ident(name) => name.ident.to_string(),
            Pat::Wild(_) => return false,
            // Taken apart where it comes in.
            _ => return true,
        };
        // Of each open bracket, whether it is that of such a call.
        let mut is_answered = Vec::new();
        for at in 0..tokens.len() {
            match text(at) {
                bracket @ ("(" | "[" | "{") => {
                    is_answered.push(bracket == "(" && answers.contains(text(at - 1)));
                }
                ")" | "]" | "}" => {
                    is_answered.pop();
                }
                used if used == name => {
                    let is_alone = ["(", ","].contains(&text(at - 1)) && [")", ","].contains(&text(at + 1));
                    if !is_alone || is_answered.last() != Some(&true) {
                        return true;
                    }
                }
                _ => {}
            }
        }
        false
    })
}

#[test]
fn a_look_at_a_stretch_is_seen() {
    let answers = BTreeSet::from(["energy".to_owned()]);
    for (code, expected) in [
        ("fn f(s: [R; 3], _: [R; 3]) -> R { self.0.energy(s) + two(2.0, self.1.energy(s)) }", false),
        ("fn f(s: [R; 3]) -> R { self.0.energy(s) * s[0] }", true),
        ("fn f(s: [R; 3]) -> R { self.0.energy(s.map(R::abs)) }", true),
        ("fn f([a, _, _]: [R; 3]) -> R { a * a }", true),
    ] {
        let item: Item = syn::parse_str(code).expect("a function");
        assert_eq!(looks_at_stretches(&functions(&item)[0], &answers), expected, "{code}");
    }
}
