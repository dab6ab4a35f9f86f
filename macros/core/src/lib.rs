//! From the tokens of an elastic energy to the tokens of everything a simulator needs of it.
//!
//! `parse` reads the form of a declaration; `model` understands, checks and differentiates it; `emit` writes Rust. The
//! energy travels as a hash-consed expression graph (`expr`), is differentiated once and twice (`diff`), divided into
//! flip and twist quotients that never cancel (`quotient`), continued beyond its domain (`extension`), freed from
//! implied cancellation (`simplify`), read once more by invariants where it can (`invariants`), differentiated by its parameters
//! where that is asked for (`by_parameters`), and ordered into operations and loops (`schedule`).
//!
//! An ordinary library, so that tests and tools can call each step. It knows scalars only: no matrices, lanes, meshes.

pub mod algebra;
pub mod emit;
mod judge;
pub mod model;
pub mod printer;
pub mod read;
pub mod schedule;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Attribute, Item, ItemFn, Meta};

use model::Model;
use read::diagnostics::Diagnostics;
use read::parse::{self, Declaration};

/// The expansion of `#[material(arguments)] item`.
#[must_use]
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    match understand(arguments, item.clone()) {
        Ok((declaration, model)) => emit::emit(&declaration, model),
        Err(mistakes) => emit::stub::inert(&mistakes, item),
    }
}

/// What `#[material(arguments)] item` means.
///
/// # Errors
/// All mistakes of form and meaning, each at its tokens.
pub fn understand(arguments: TokenStream, item: TokenStream) -> syn::Result<(Declaration, Model)> {
    let mut diagnostics = Diagnostics::default();
    let understood = parse::read(arguments, item, &mut diagnostics).and_then(|declaration| {
        let model = model::read(&declaration, &mut diagnostics)?;
        Some((declaration, model))
    });
    diagnostics.finish(understood)
}

/// The declarations of a Rust source file and of the modules written out in it, each as the arguments of its attribute and its
/// item.
///
/// # Errors
/// Where the text is not Rust.
pub fn declarations(source: &str) -> syn::Result<Vec<(TokenStream, TokenStream)>> {
    let mut found = Vec::new();
    collect(syn::parse_file(source)?.items, &mut found);
    Ok(found)
}

fn collect(items: Vec<Item>, found: &mut Vec<(TokenStream, TokenStream)>) {
    for item in items {
        match item {
            Item::Fn(function) => found.extend(declaration(function)),
            Item::Mod(module) => collect(module.content.map(|(_, items)| items).unwrap_or_default(), found),
            _ => {}
        }
    }
}

fn declaration(mut function: ItemFn) -> Option<(TokenStream, TokenStream)> {
    let is_material =
        |attribute: &Attribute| attribute.path().segments.last().is_some_and(|last| last.ident == "material");
    let k = function.attrs.iter().position(is_material)?;
    let arguments = match function.attrs.remove(k).meta {
        Meta::List(list) => list.tokens,
        _ => TokenStream::new(),
    };
    Some((arguments, function.into_token_stream()))
}
