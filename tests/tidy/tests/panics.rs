//! Shipped code answers wrong arguments with errors.

use std::collections::BTreeSet;
use std::path::Path;

use piola_tidy::{Module, crates, files, forbid, tokens};
use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{
    Attribute, Block, ImplItem, ImplItemFn, Item, ItemFn, Signature, TraitItem, TraitItemFn, Visibility,
};

/// Macros and methods whose purpose is to panic.
const MACROS: [&str; 7] =
    ["panic", "unreachable", "todo", "unimplemented", "assert", "assert_eq", "assert_ne"];
const METHODS: [&str; 4] = ["unwrap", "unwrap_err", "expect", "expect_err"];

/// A function that panics on purpose says so under `# Panics`, and does not return a `Result` as well. So
/// nothing that a function with a `Result` calls panics unannounced, except for an index, a division by zero
/// or an overflow: hostile arguments are tried on each of these functions in `tests/hostile/` of its crate.
#[test]
fn what_panics_says_so_and_returns_no_result() {
    let (mut found, mut judged) = (Vec::new(), 0);
    for one in crates().iter().filter(|one| one.is_published) {
        for module in &one.modules {
            for Function { attributes, signature, body, .. } in module.items.iter().flat_map(functions) {
                judged += 1;
                let says_so =
                    |attribute: &Attribute| attribute.to_token_stream().to_string().contains("# Panics");
                let is_right = attributes.iter().any(says_so) && !returns_result(signature);
                if !is_right && !panics(body).is_empty() {
                    let (name, file) = (&signature.ident, module.file.display());
                    found.push(format!("{file}:{}: {name}", name.span().start().line));
                }
            }
        }
    }
    forbid("functions that panic without a word, or with a `Result` as well", &found);
    assert!(judged > 1000, "{judged} functions");
}

/// Every public function of bodies and batches that returns a `Result` is called with hostile arguments.
#[test]
fn what_returns_a_result_is_tried_with_hostile_arguments() {
    let tried: BTreeSet<String> = ["runtime/tests/hostile", "bodies/tests/hostile"]
        .into_iter()
        .flat_map(|folder| files(Path::new(folder)))
        .flat_map(|(_, text)| tokens(text.parse::<TokenStream>().expect("tokens")))
        .map(|token| token.text)
        .collect();
    let (mut found, mut judged) = (Vec::new(), 0);
    for one in crates().iter().filter(|one| ["piola", "piola_bodies"].contains(&one.name.as_str())) {
        let is_judged = |module: &&Module| {
            one.name != "piola" || module.path.first().is_some_and(|floor| floor == "batch")
        };
        for module in one.modules.iter().filter(is_judged) {
            for Function { owner, signature, .. } in module
                .items
                .iter()
                .flat_map(functions)
                .filter(|function| function.is_public && returns_result(function.signature))
            {
                judged += 1;
                // Constructors are distinguished by the name of the type.
                let name = &signature.ident;
                let called = owner.filter(|_| name == "new").unwrap_or_else(|| name.to_string());
                if !tried.contains(&called) {
                    found.push(format!("{}: {called}", module.file.display()));
                }
            }
        }
    }
    forbid("functions that `tests/hostile/` of their crate does not try", &found);
    assert!(judged > 30, "{judged} functions");
}

struct Function<'a> {
    attributes: &'a [Attribute],
    is_public: bool,
    /// The type that it is a method of.
    owner: Option<String>,
    signature: &'a Signature,
    body: &'a Block,
}

fn functions(item: &Item) -> Vec<Function<'_>> {
    match item {
        Item::Fn(ItemFn { attrs: attributes, vis, sig: signature, block: body, .. }) => {
            vec![Function { attributes, is_public: is_public(vis), owner: None, signature, body }]
        }
        Item::Impl(of_type) => {
            let owner = tokens(&of_type.self_ty).first().map(|token| token.text.clone());
            let methods = of_type.items.iter().filter_map(|item| match item {
                ImplItem::Fn(ImplItemFn { attrs: attributes, vis, sig: signature, block: body, .. }) => {
                    let (is_public, owner) = (is_public(vis), owner.clone());
                    Some(Function { attributes, is_public, owner, signature, body })
                }
                _ => None,
            });
            methods.collect()
        }
        Item::Trait(of_all) => {
            let methods = of_all.items.iter().filter_map(|item| match item {
                TraitItem::Fn(TraitItemFn { attrs: attributes, sig: signature, default, .. }) => {
                    let body = default.as_ref()?;
                    Some(Function { attributes, is_public: false, owner: None, signature, body })
                }
                _ => None,
            });
            methods.collect()
        }
        _ => Vec::new(),
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

fn returns_result(signature: &Signature) -> bool {
    let returned = signature.output.to_token_stream().to_string();
    returned.starts_with("-> Result ") || returned.contains(":: Result ")
}

/// Macros and methods in code that panic.
fn panics(code: impl ToTokens) -> Vec<String> {
    let tokens = tokens(code);
    let mut found = Vec::new();
    for three in tokens.windows(3) {
        let [before, name, behind] = [0, 1, 2].map(|k| three[k].text.as_str());
        if (behind == "!" && MACROS.contains(&name)) || (before == "." && METHODS.contains(&name)) {
            found.push(name.to_owned());
        }
    }
    found
}

#[test]
fn panics_are_seen_wherever_they_hide() {
    let found = |code: &str| panics(code.parse::<TokenStream>().expect("tokens"));
    assert_eq!(found("{ x.unwrap(); if y { z.expect(\"z\") } }"), ["unwrap", "expect"]);
    assert_eq!(
        found("for x in f(|| assert_eq!(1, g())) { core::unreachable!() }"),
        ["assert_eq", "unreachable"]
    );
    assert_eq!(found("x.unwrap_or(1); expect(2); quote!(panic!()); let panic = 3;"), [""; 0]);
}
