//! The compiler behind `#[piola::material]`: from the tokens of an elastic energy to Rust that evaluates it
//! and its derivatives.
//!
//! Its folders are its stages, and [`model`] is their table of contents:
//!
//! 1. [`read`] parses a declaration and resolves its names into a hash-consed expression graph;
//! 2. [`algebra`] differentiates the energy once and twice, divides it into flip and twist quotients that
//!    never cancel, continues it beyond its domain, frees it from implied cancellation, and rewrites it by
//!    invariants;
//! 3. `judge` checks that the energy is isotropic, has a value wherever its domain reaches, and has no stress
//!    at rest;
//! 4. [`schedule`] orders expressions into operations and loops over lists;
//! 5. [`emit`] writes them as Rust: the type, its constructor, its documentation and its implementations.
//!
//! Imports point from later stages to earlier ones. [`printer`] writes expressions as text, for messages and
//! documentation.
//!
//! An ordinary library, so that tests and tools can call each step. It handles scalars only: no matrices,
//! lanes or meshes.

/// The value of a key in a map, computed when it is first requested.
macro_rules! once {
    ($memo:expr, $key:expr, $value:expr) => {{
        let key = $key;
        match $memo.get(&key) {
            Some(&done) => done,
            None => {
                let value = $value;
                $memo.insert(key, value);
                value
            }
        }
    }};
}

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
use read::notation::Notation;
use read::parse::{self, Declaration};

/// The expansion of `#[material(arguments)] item`.
#[must_use]
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    match analyse(arguments, item.clone()) {
        Ok((declaration, model)) => emit::emit(&declaration, model),
        Err(mistakes) => emit::stub::inert(&mistakes, item),
    }
}

/// The declaration `#[material(arguments)] item` with its energy, derived and checked.
///
/// # Errors
/// All mistakes of form and meaning, each at its tokens.
pub fn analyse(arguments: TokenStream, item: TokenStream) -> syn::Result<(Declaration, Model)> {
    analyse_in(Notation::Attribute, arguments, item, None)
}

/// A declaration in any notation, which is also that of the messages, with its energy: see [`analyse`]. The
/// size of its expressions, derivatives included, is limited; `None` for no limit except memory.
///
/// # Errors
/// All mistakes of form and meaning, each at its tokens.
pub fn analyse_in(
    notation: Notation,
    arguments: TokenStream,
    item: TokenStream,
    most: Option<usize>,
) -> syn::Result<(Declaration, Model)> {
    let mut diagnostics = Diagnostics::new(notation);
    let analysed = parse::parse_declaration(arguments, item, &mut diagnostics).and_then(|declaration| {
        let model = model::read(&declaration, &mut diagnostics, most)?;
        Some((declaration, model))
    });
    diagnostics.finish(analysed)
}

/// The declarations of a Rust source file and of the modules written out in it, each as the arguments of its
/// attribute and its item.
///
/// # Errors
/// A syntax error if the text is not Rust.
pub fn declarations(source: &str) -> syn::Result<Vec<(TokenStream, TokenStream)>> {
    let mut found = Vec::new();
    parse::check(parse::DEEPEST_FILE, &source.parse()?, Notation::Rust)?;
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
