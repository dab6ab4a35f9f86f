//! The methods of `Material` that need invariants only.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::domain::domain;
use super::functions;
use super::writer::Writer;
use crate::model::Model;
use crate::read::parse::Declaration;

/// The constant for it and the methods, if the energy is one of invariants.
pub(super) fn methods(declaration: &Declaration, model: &mut Model, writer: &Writer<'_>) -> TokenStream {
    let Some(invariants) = model.invariants.clone() else { return quote!() };
    let variables = ["I1", "I2", "J"].map(|name| format_ident!("{name}"));
    let [i1, i2, j] = &variables;
    let arguments = quote!([#i1, #i2, #j]: [R; 3]);
    let named = writer.with_variables(variables.clone());
    let mut program = |roots: &[_]| named.program(&model.program(roots));
    let energy = invariants.has_energy.then(|| {
        let (energy, output) = program(&[invariants.energy]);
        quote! {
            #[inline(always)]
            #[allow(non_snake_case)]
            fn energy_by_invariants<R: __p::Real>(&self, #arguments) -> R {
                #energy
                #(#output)*
            }
        }
    });
    let (gradient, gradient_outputs) = program(&invariants.gradient);
    let all = [&invariants.gradient[..], &invariants.hessian].concat();
    let (derivatives, derivative_outputs) = program(&all);
    // λ1 λ2 ≤ (λ1² + λ2²)/2, so λ3 ≥ 2J/I1: no stretch is below the threshold where 2J > ε I1.
    let threshold = &writer.threshold;
    let continued = quote! {
        __p::Inversion::Extend { epsilon: #threshold } => {
            (R::splat(#threshold) * #i1).less(#j + #j)
        }
    };
    let of_functions = |model: &mut Model| functions::defined(declaration, model, &named, invariants.energy);
    let admits = domain(declaration, model, &named, &invariants.bounds, of_functions, j, &continued);

    let has_no_energy = (!invariants.has_energy).then(|| {
        quote!(
            #[inline(always)]
            fn has_energy_by_invariants(&self) -> bool {
                false
            }
        )
    });
    let has_second = !model.graph.is_zero(invariants.gradient[1]);
    let curvature = invariants.curvature(&model.graph);
    let curvature = format_ident!("{curvature:?}");

    quote! {
        #[inline(always)]
        fn has_invariants(&self) -> bool {
            true
        }

        #[inline(always)]
        fn has_second_invariant(&self) -> bool {
            #has_second
        }

        #[inline(always)]
        fn curvature_by_invariants(&self) -> __p::Curvature {
            __p::Curvature::#curvature
        }
        #has_no_energy

        #energy

        #[inline(always)]
        #[allow(non_snake_case)]
        fn gradient_by_invariants<R: __p::Real>(&self, #arguments) -> [R; 3] {
            #gradient
            [#(#gradient_outputs),*]
        }

        #[inline(always)]
        #[allow(non_snake_case)]
        fn derivatives_by_invariants<R: __p::Real>(&self, #arguments) -> [R; 9] {
            #derivatives
            [#(#derivative_outputs),*]
        }

        #[inline(always)]
        #[allow(non_snake_case)]
        fn admits_invariants<R: __p::Real>(&self, #arguments) -> R::Mask {
            #admits
        }
    }
}
