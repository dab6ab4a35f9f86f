//! The methods of `Material` that need invariants only.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::domain::domain;
use super::writer::Writer;
use super::{functions, inlined};
use crate::model::Model;
use crate::read::parse::Declaration;

/// The constant for it and the methods, if the energy is one of invariants.
pub(super) fn methods(declaration: &Declaration, model: &mut Model, writer: &Writer<'_>) -> TokenStream {
    let Some(invariants) = model.invariants.clone() else { return quote!() };
    let variables = ["I1", "I2", "J"].map(|name| format_ident!("{name}"));
    let [i1, i2, j] = &variables;
    let arguments = quote!([#i1, #i2, #j]: [R; 3]);
    let named = Writer { variables: variables.clone(), ..writer.clone() };
    let mut program = |roots: &[_]| named.program(&model.program(roots));
    let of_invariants = |name: &str, result: TokenStream, body: TokenStream| {
        let name = format_ident!("{name}");
        inlined(quote!(#[allow(non_snake_case)] fn #name<R: __p::Real>(&self, #arguments) -> #result), body)
    };
    let energy = if invariants.has_energy {
        let (energy, output) = program(&[invariants.energy]);
        of_invariants("energy_by_invariants", quote!(R), quote!(#energy #(#output)*))
    } else {
        inlined(quote!(fn has_energy_by_invariants(&self) -> bool), quote!(false))
    };
    let (gradient, outputs) = program(&invariants.gradient);
    let gradient = of_invariants("gradient_by_invariants", quote!([R; 3]), quote!(#gradient [#(#outputs),*]));
    let (derivatives, outputs) = program(&[&invariants.gradient[..], &invariants.hessian].concat());
    let derivatives = quote!(#derivatives [#(#outputs),*]);
    let derivatives = of_invariants("derivatives_by_invariants", quote!([R; 9]), derivatives);
    // λ1 λ2 ≤ (λ1² + λ2²)/2, so λ3 ≥ 2J/I1: no stretch is below the threshold where 2J > ε I1.
    let threshold = &writer.threshold;
    let continued = quote! {
        __p::Inversion::Extend { epsilon: #threshold } => {
            (R::splat(#threshold) * #i1).less(#j + #j)
        }
    };
    let of_functions = |model: &mut Model| functions::defined(declaration, model, &named, invariants.energy);
    let admits = domain(declaration, model, &named, &invariants.bounds, of_functions, j, &continued);
    let admits = of_invariants("admits_invariants", quote!(R::Mask), admits);
    let has_second = !model.graph.is_zero(invariants.gradient[1]);
    let curvature = invariants.curvature(&model.graph);
    let curvature = format_ident!("{curvature:?}");
    let properties = [
        inlined(quote!(fn has_invariants(&self) -> bool), quote!(true)),
        inlined(quote!(fn has_second_invariant(&self) -> bool), quote!(#has_second)),
        inlined(
            quote!(fn curvature_by_invariants(&self) -> __p::Curvature),
            quote!(__p::Curvature::#curvature),
        ),
    ];
    quote!(#(#properties)* #energy #gradient #derivatives #admits)
}
