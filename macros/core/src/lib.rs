//! From the tokens of an elastic energy to the tokens of everything a simulator needs of it.
//!
//! `parse` reads the form of a declaration; `model` understands, checks and differentiates it; `emit` writes Rust. The
//! energy travels as a hash-consed expression graph (`expr`), is differentiated once and twice (`diff`), divided into
//! flip and twist quotients that never cancel (`quotient`), continued beyond its domain (`extension`), freed from
//! implied cancellation (`simplify`), read once more by invariants where it can (`invariants`), and ordered into operations and loops (`schedule`).
//!
//! An ordinary library, so that tests and tools can call each step. It knows scalars only: no matrices, lanes, meshes.

pub mod check;
pub mod diagnostics;
pub mod diff;
pub mod divided;
pub mod emit;
pub mod expr;
pub mod extension;
pub mod fallback;
pub mod formula;
pub mod increment;
pub mod interpret;
pub mod invariants;
pub mod model;
pub mod parse;
pub mod quotient;
pub mod rational;
pub mod resolve;
pub mod schedule;
pub mod simplify;
#[cfg(test)]
mod testing;
pub mod volume;

use proc_macro2::TokenStream;

/// The expansion of `#[material(arguments)] item`.
#[must_use]
pub fn expand(arguments: TokenStream, item: TokenStream) -> TokenStream {
    let declaration = match parse::parse(arguments, item.clone()) {
        Ok(declaration) => declaration,
        Err(mistakes) => return fallback::without_form(&mistakes, item),
    };
    match model::model(&declaration) {
        Ok(model) => emit::emit(&declaration, model),
        Err(mistakes) => fallback::inert(&mistakes, &declaration),
    }
}

/// The declarations of a Rust source file, each as the arguments of its attribute and its item.
///
/// # Errors
/// Where the text is not Rust.
pub fn declarations(source: &str) -> syn::Result<Vec<(TokenStream, TokenStream)>> {
    let mut found = Vec::new();
    for item in syn::parse_file(source)?.items {
        let syn::Item::Fn(mut function) = item else { continue };
        let is_declaration = |attribute: &syn::Attribute| {
            attribute.path().segments.last().is_some_and(|last| last.ident == "material")
        };
        if let Some(k) = function.attrs.iter().position(is_declaration) {
            let arguments = match function.attrs.remove(k).meta {
                syn::Meta::List(list) => list.tokens,
                _ => TokenStream::new(),
            };
            found.push((arguments, quote::ToTokens::to_token_stream(&function)));
        }
    }
    Ok(found)
}
