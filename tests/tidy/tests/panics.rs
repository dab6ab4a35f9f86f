//! Shipped code answers wrong arguments with errors.

use std::collections::BTreeSet;
use std::path::Path;

use piola_tidy::{Module, crates, files, forbid};
use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, ImplItemFn, Item, ItemFn, ReturnType, Signature, TraitItemFn, Visibility};

/// Macros and methods whose purpose is to panic.
const MACROS: [&str; 7] =
    ["panic", "unreachable", "todo", "unimplemented", "assert", "assert_eq", "assert_ne"];
const METHODS: [&str; 4] = ["unwrap", "unwrap_err", "expect", "expect_err"];

/// A function that panics on purpose says so under `# Panics`, and does not return a `Result` as well. So
/// nothing that a function with a `Result` calls panics unannounced, except for an index, a division by zero
/// or an overflow: hostile arguments are tried on each of these functions in `tests/hostile/` of its crate.
#[test]
fn what_panics_says_so_and_returns_no_result() {
    let mut found = Vec::new();
    let mut judged = 0;
    for one in crates().iter().filter(|one| one.is_published) {
        for module in &one.modules {
            for Function { name, body, says_so, returns_result, .. } in functions(module) {
                judged += 1;
                if !panics(body).is_empty() && (!says_so || returns_result) {
                    found.push(format!("{}:{}: {name}", module.file.display(), name.span().start().line));
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
        .flat_map(|(_, text)| words(text.parse().expect("tokens")))
        .collect();
    let crates = crates();
    let mut found = Vec::new();
    let mut judged = 0;
    let of =
        |name: &'static str| crates.iter().filter(move |one| one.name == name).flat_map(|one| &one.modules);
    let is_batch = |module: &&Module| module.path.first().is_some_and(|floor| floor == "batch");
    for module in of("piola").filter(is_batch).chain(of("piola_bodies")) {
        let returning = functions(module).into_iter().filter(|one| one.is_public && one.returns_result);
        for Function { name, owner, .. } in returning {
            judged += 1;
            // Constructors are distinguished by the name of the type.
            let called = owner.filter(|_| name == "new").unwrap_or_else(|| name.to_string());
            if !tried.contains(&called) {
                found.push(format!("{}: {called}", module.file.display()));
            }
        }
    }
    forbid("functions that `tests/hostile/` of their crate does not try", &found);
    assert!(judged > 30, "{judged} functions");
}

/// A function of an item, with the facts that these tests need.
struct Function {
    name: Ident,
    body: TokenStream,
    /// The type that it is a method of.
    owner: Option<String>,
    is_public: bool,
    says_so: bool,
    returns_result: bool,
}

/// The functions and methods of a module.
fn functions(module: &Module) -> Vec<Function> {
    let mut functions = Functions::default();
    for item in &module.items {
        (functions.owner, functions.is_of_trait) = (None, false);
        functions.visit_item(item);
    }
    functions.found
}

#[derive(Default)]
struct Functions {
    found: Vec<Function>,
    owner: Option<String>,
    is_of_trait: bool,
}

impl Functions {
    fn add(
        &mut self,
        signature: &Signature,
        body: &Block,
        attributes: &[Attribute],
        visibility: Option<&Visibility>,
    ) {
        let documentation = attributes.iter().map(|attribute| attribute.to_token_stream().to_string());
        let result = match &signature.output {
            ReturnType::Default => false,
            ReturnType::Type(_, returned) => {
                let returned = returned.to_token_stream().to_string();
                returned.starts_with("Result ") || returned.contains(":: Result ")
            }
        };
        self.found.push(Function {
            name: signature.ident.clone(),
            body: body.to_token_stream(),
            owner: self.owner.clone(),
            is_public: matches!(visibility, Some(Visibility::Public(_))),
            says_so: documentation.into_iter().any(|line| line.contains("# Panics")),
            returns_result: result,
        });
    }
}

impl<'a> Visit<'a> for Functions {
    fn visit_item(&mut self, item: &'a Item) {
        if let Item::Impl(block) = item {
            let owner = block.self_ty.to_token_stream().to_string();
            self.owner = Some(owner.split(' ').next().unwrap_or_default().to_owned());
            self.is_of_trait = block.trait_.is_some();
        }
        visit::visit_item(self, item);
    }

    fn visit_item_fn(&mut self, function: &'a ItemFn) {
        self.add(&function.sig, &function.block, &function.attrs, Some(&function.vis));
    }

    fn visit_impl_item_fn(&mut self, method: &'a ImplItemFn) {
        let visibility = (!self.is_of_trait).then_some(&method.vis);
        self.add(&method.sig, &method.block, &method.attrs, visibility);
    }

    fn visit_trait_item_fn(&mut self, method: &'a TraitItemFn) {
        if let Some(body) = &method.default {
            self.add(&method.sig, body, &method.attrs, None);
        }
    }
}

/// Macros and methods in tokens that panic. What is quoted becomes code of others.
fn panics(tokens: TokenStream) -> Vec<String> {
    let tokens: Vec<_> = tokens.into_iter().collect();
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let is_mark = |at: Option<usize>, mark: char| matches!(at.and_then(|at| tokens.get(at)), Some(TokenTree::Punct(punct)) if punct.as_char() == mark);
        match token {
            TokenTree::Ident(name) => {
                let is_macro = is_mark(Some(at + 1), '!') && MACROS.iter().any(|one| name == one);
                let is_method = is_mark(at.checked_sub(1), '.') && METHODS.iter().any(|one| name == one);
                if is_macro || is_method {
                    found.push(name.to_string());
                }
            }
            TokenTree::Group(group) => {
                let is_quoted = is_mark(at.checked_sub(1), '!')
                    && matches!(at.checked_sub(2).map(|at| &tokens[at]),
                        Some(TokenTree::Ident(name)) if name == "quote" || name == "quote_spanned");
                if !is_quoted {
                    found.extend(panics(group.stream()));
                }
            }
            _ => {}
        }
    }
    found
}

/// All identifiers in tokens.
fn words(tokens: TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for token in tokens {
        match token {
            TokenTree::Ident(name) => drop(found.insert(name.to_string())),
            TokenTree::Group(group) => found.extend(words(group.stream())),
            _ => {}
        }
    }
    found
}

#[test]
fn panics_are_seen_wherever_they_hide() {
    let found = |code: &str| panics(code.parse().expect("tokens"));
    assert_eq!(found("{ x.unwrap(); if y { z.expect(\"z\") } }"), ["unwrap", "expect"]);
    assert_eq!(
        found("for x in f(|| assert_eq!(1, g())) { core::unreachable!() }"),
        ["assert_eq", "unreachable"]
    );
    assert_eq!(found("x.unwrap_or(1); expect(2); quote!(panic!()); let panic = 3;"), [""; 0]);
}
