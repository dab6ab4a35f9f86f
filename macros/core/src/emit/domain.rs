//! The test of a domain, by stretches or by invariants.

use proc_macro2::TokenStream;
use quote::quote;
use syn::Ident;

use super::writer::{Writer, free_name};
use crate::algebra::expr::Id;
use crate::model::Model;
use crate::read::domain::Volume;
use crate::read::parse::Declaration;

/// The test of a domain: bounds are positive expressions, functions test their own arguments, and a variable
/// has the sign of J, which matters unless the energy is `continued`.
pub(super) fn domain(
    declaration: &Declaration,
    model: &mut Model,
    writer: &Writer<'_>,
    bounds: &[Id],
    of_functions: impl FnOnce(&mut Model) -> Option<TokenStream>,
    signed: &Ident,
    continued: &TokenStream,
) -> TokenStream {
    let (statements, outputs) = writer.program(&model.program(bounds));
    let bounds = outputs.iter().map(|bound| quote!(R::splat(0.0).less(#bound)));
    let mut conditions: Vec<TokenStream> = bounds.collect();
    let defined = free_name(declaration, &["defined", "functions_defined"]);
    let of_functions = of_functions(model).map(|mask| {
        conditions.push(quote!(#defined));
        quote!(let #defined = #mask;)
    });
    let inside = match model.volume {
        Volume::Any => None,
        Volume::Positive => Some(quote!(R::splat(0.0).less(#signed))),
        Volume::Nonzero => Some(quote!(R::splat(0.0).less(#signed.abs()))),
    };
    conditions.extend(inside.map(|inside| match &model.extended {
        None => inside,
        Some(_) => quote! {
            match self.inversion {
                __p::Inversion::Refuse => #inside,
                #continued
            }
        },
    }));
    let all = conditions.into_iter().reduce(|a, b| quote!(#a & #b));
    let all = all.unwrap_or_else(|| quote!(__p::Mask::splat(true)));
    quote!(#statements #of_functions #all)
}
