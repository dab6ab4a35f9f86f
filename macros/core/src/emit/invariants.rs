//! The methods of `Material` and `Varying` that need invariants only.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::writer::Writer;
use crate::model::Model;
use crate::read::domain::Volume;

/// Says that there are such methods.
pub(super) fn constant(model: &Model) -> TokenStream {
    match &model.invariants {
        Some(_) => quote!(
            const HAS_INVARIANTS: bool = true;
        ),
        None => quote!(),
    }
}

/// The methods of `Material` by those of `Varying`.
pub(super) fn delegated(model: &Model) -> TokenStream {
    if model.invariants.is_none() {
        return quote!();
    }
    let constant = constant(model);
    let varying = quote!(<Self as ::piola::material::Varying>);
    let uniform = quote!(&::piola::material::Uniform(self));
    quote! {
        #constant

        #[inline(always)]
        fn energy_by_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> R {
            #varying::energy_by_invariants_of(#uniform, invariants)
        }

        #[inline(always)]
        fn gradient_by_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> [R; 3] {
            #varying::gradient_by_invariants_of(#uniform, invariants)
        }

        #[inline(always)]
        fn admits_invariants<R: ::piola::Real>(&self, invariants: [R; 3]) -> R::Mask {
            #varying::admits_invariants_of(#uniform, invariants)
        }
    }
}

/// What computes; `receiver` is what parameters are read from, `ending` that of the methods' names.
pub(super) fn methods(
    model: &mut Model,
    writer: &Writer<'_>,
    receiver: &TokenStream,
    ending: &str,
) -> TokenStream {
    let Some(invariants) = model.invariants.clone() else { return quote!() };
    let variables = ["I1", "I2", "J"].map(|name| format_ident!("{name}"));
    let [i1, i2, j] = &variables;
    let arguments = quote!([#i1, #i2, #j]: [R; 3]);
    let named = writer.with_variables(variables.clone());
    let mut program = |roots: &[_]| named.program(&model.program(roots));
    let (energy, energy_output) = program(&[invariants.energy]);
    let (gradient, gradient_outputs) = program(&invariants.gradient);
    let (bounds, bound_outputs) = program(&invariants.bounds);

    // λ1 λ2 ≤ (λ1² + λ2²)/2, so λ3 ≥ 2J/I1: no stretch is below the threshold where 2J > ε I1.
    let (inversion, threshold) = (writer.inversion(), &writer.threshold);
    let inside = match model.volume {
        Volume::Any => None,
        Volume::Positive => Some(quote!(R::splat(0.0).less(#j))),
        Volume::Nonzero => Some(quote!(R::splat(0.0).less(#j.abs()))),
    };
    let inside = inside.map(|inside| match model.extended {
        None => inside,
        Some(_) => quote! {
            match #inversion {
                ::piola::Inversion::Refuse => #inside,
                ::piola::Inversion::Extend { epsilon: #threshold } => {
                    (R::splat(#threshold) * #i1).less(#j + #j)
                }
            }
        },
    });
    let conditions = bound_outputs.iter().map(|bound| quote!(R::splat(0.0).less(#bound))).chain(inside);
    let admits = conditions.reduce(|a, b| quote!(#a & #b));
    let admits = admits.unwrap_or_else(|| quote!(<R::Mask as ::piola::lanes::Mask>::splat(true)));

    let names = ["energy_by_invariants", "gradient_by_invariants", "admits_invariants"];
    let [energy_of, gradient_of, admits_of] = names.map(|name| format_ident!("{name}{ending}"));
    quote! {
        #[inline(always)]
        #[allow(non_snake_case)]
        fn #energy_of<R: ::piola::Real>(#receiver, #arguments) -> R {
            #energy
            #(#energy_output)*
        }

        #[inline(always)]
        #[allow(non_snake_case)]
        fn #gradient_of<R: ::piola::Real>(#receiver, #arguments) -> [R; 3] {
            #gradient
            [#(#gradient_outputs),*]
        }

        #[inline(always)]
        #[allow(non_snake_case)]
        fn #admits_of<R: ::piola::Real>(#receiver, #arguments) -> R::Mask {
            #bounds
            #admits
        }
    }
}
