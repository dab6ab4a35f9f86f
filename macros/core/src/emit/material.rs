//! The implementation of `Material`: energy, gradient and blocks as straight-line programs.

use proc_macro2::TokenStream;
use quote::quote;
use syn::Ident;

use super::domain::domain;
use super::writer::Writer;
use super::{functions, invariants};
use super::{generics, inlined, naming, value_parameter};
use crate::algebra::expr::Id;
use crate::model::{Model, Variant};
use crate::read::domain::Volume;
use crate::read::parse::{Declaration, Kind};

/// `impl Material` and `impl Graded`.
pub(super) fn material(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let computed = computed(declaration, model);
    let constants = constants(declaration, model);
    let lengths = &declaration.generics;
    let value = value_parameter(declaration);
    let kept = value.as_ref().map(|value| quote!(#value: __p::ParameterValue));
    let (implementation, (on_lanes, gathered), shares_lanes) = if declaration.is_plain() {
        let implementation =
            quote!(impl<#(const #lengths: usize,)* #kept> ::piola::Material for #name<#(#lengths,)* #value>);
        (implementation, per_lane(declaration), None)
    } else {
        let shares_lanes = quote! {
            fn shares_lanes(&self, other: &Self) -> bool {
                ::core::ptr::eq(self, other) || self == other
            }
        };
        let implementation = quote!(impl #bounds ::piola::Material for #name #arguments);
        (implementation, (quote!(&'lanes Self), quote!(material(0))), Some(shares_lanes))
    };
    // What is not inlined into the function of a back end is not compiled for its instructions.
    quote! {
        #[allow(unused_variables, clippy::all)]
        #naming
        #implementation {
            #computed
            #constants
        }

        impl #bounds __p::Graded for #name #arguments {
            type OnLanes<'lanes> = #on_lanes;

            #[inline(always)]
            fn on_lanes<'lanes>(material: impl ::core::ops::Fn(usize) -> &'lanes Self + ::core::marker::Copy) -> Self::OnLanes<'lanes>
            where
                Self: 'lanes,
            {
                #gathered
            }

            #shares_lanes
        }
    }
}

/// The type with a value of each parameter for each lane, and the value of this type.
fn per_lane(declaration: &Declaration) -> (TokenStream, TokenStream) {
    let (name, lengths) = (&declaration.name, &declaration.generics);
    let value = value_parameter(declaration).map(|_| quote!(__p::PerLane));
    let gathered = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Kind::List(_) => quote! {
                #name: ::core::array::from_fn(|k| __p::PerLane::gather(|lane| material(lane).#name[k]))
            },
            _ => quote!(#name: __p::PerLane::gather(|lane| material(lane).#name)),
        }
    });
    let inversion = declaration.options.extend.is_some().then(|| quote!(inversion: material(0).inversion,));
    (quote!(#name<#(#lengths,)* #value>), quote!(#name { #(#gathered,)* #inversion }))
}

/// Properties of a material that do not depend on the deformation: its pole, the end of its domain, its
/// moduli.
fn constants(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let program = model.program(&model.moduli.clone());
    let (statements, outputs) = Writer::new(declaration).program(&program);
    let (mu, lambda) = (&outputs[0], &outputs[1]);
    let is_positive = model.volume == Volume::Positive;
    let plain_pole = model.plain.has_pole;
    let (has_pole, ends) = match &model.extended {
        None => (quote!(#plain_pole), quote!(#is_positive)),
        Some(extended) => {
            let extended_pole = extended.has_pole;
            let refuses = quote!(self.inversion == __p::Inversion::Refuse);
            let pole = match (plain_pole, extended_pole) {
                (true, false) => refuses.clone(),
                (false, true) => quote!(self.inversion != __p::Inversion::Refuse),
                _ => quote!(#plain_pole),
            };
            (pole, if is_positive { refuses } else { quote!(false) })
        }
    };
    // A function may end where a stretch is 0.
    let is_certain = is_positive && model.extended.is_none();
    let ends = match is_positive {
        _ if is_certain || !declaration.has_functions() => ends,
        true => quote!(#ends || __p::sign_decides(self)),
        false => quote!(__p::sign_decides(self)),
    };
    let inversion = declaration.options.extend.as_ref().map(|_| {
        quote! {
            #[inline]
            fn inversion(&self) -> __p::Inversion {
                self.inversion
            }
        }
    });
    quote! {
        #[inline]
        fn has_pole(&self) -> bool {
            #has_pole
        }

        #[inline]
        fn ends_at_zero_volume(&self) -> bool {
            #ends
        }

        #inversion

        #[allow(unused_imports)]
        fn stated_moduli(&self) -> __p::Option<__p::Moduli> {
            use ::piola::Real;
            type R = f64;
            #statements
            __p::stated_moduli(#mu, #lambda)
        }
    }
}

/// The methods that evaluate the energy.
fn computed(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let writer = &Writer::new(declaration);
    let [l1, l2, l3] = &declaration.stretches;
    let mut bodies = |select: &dyn Fn(&Variant) -> Vec<Id>,
                      result: &dyn Fn(&[TokenStream]) -> TokenStream| {
        let body = |model: &mut Model, roots: &[Id]| {
            let program = model.program(roots);
            let (mut body, outputs) = writer.program(&program);
            body.extend(result(&outputs));
            body
        };
        let plain = body(model, &select(&model.plain));
        let extended = model.extended.as_ref().map(select);
        writer.by_inversion(plain, extended.map(|extended| body(model, &extended)))
    };
    let energy = bodies(&|variant| vec![variant.energy], &|outputs| quote!(#(#outputs)*));
    let gradient = bodies(&|variant| variant.gradient.to_vec(), &|outputs| quote!([#(#outputs),*]));
    let blocks = bodies(&Variant::blocks, &|outputs| {
        let (gradient, hessian, flip, twist) =
            (&outputs[..3], &outputs[3..9], &outputs[9..12], &outputs[12..]);
        quote! {
            __p::Blocks {
                gradient: [#(#gradient),*],
                hessian: [#(#hessian),*],
                flip: [#(#flip),*],
                twist: [#(#twist),*],
            }
        }
    });
    let at_strains = at_strains(model, writer, &declaration.stretches);
    let admits = admits(declaration, model, writer);
    let by_invariants = invariants::methods(declaration, model, writer);
    let (strains, stretches) = (&writer.strains, quote!([#l1, #l2, #l3]: [R; 3]));
    let methods = [
        inlined(quote!(fn energy<R: __p::Real>(&self, #stretches) -> R), energy),
        inlined(quote!(fn gradient<R: __p::Real>(&self, #stretches) -> [R; 3]), gradient),
        inlined(quote!(fn gradient_at_strains<R: __p::Real>(&self, #strains: [R; 3]) -> [R; 3]), at_strains),
        inlined(quote!(fn blocks<R: __p::Real>(&self, #stretches) -> __p::Blocks<R>), blocks),
        inlined(quote!(fn admits<R: __p::Real>(&self, #stretches) -> R::Mask), admits),
    ];
    quote!(#(#methods)* #by_invariants)
}

/// The gradient at strains. Below the threshold of an extension strains are not small, and the gradient by
/// stretches is as good.
fn at_strains(model: &mut Model, writer: &Writer<'_>, [l1, l2, l3]: &[Ident; 3]) -> TokenStream {
    let program = model.program(&model.at_strains.clone());
    let (statements, outputs) = writer.program(&program);
    let (strains, threshold) = (&writer.strains, &writer.threshold);
    let one = quote!(R::splat(1.0));
    let stretches = quote!([#one + #strains[0], #one + #strains[1], #one + #strains[2]]);
    let inside = quote! {
        let [#l1, #l2, #l3] = #stretches;
        #statements
    };
    if model.extended.is_none() {
        return quote!(#inside [#(#outputs),*]);
    }
    quote! {
        #inside
        let inside = [#(#outputs),*];
        if let __p::Inversion::Extend { epsilon: #threshold } = self.inversion {
            let below = #strains[2].less(R::splat(#threshold - 1.0));
            if __p::Mask::any(below) {
                let extended = ::piola::Material::gradient(self, #stretches);
                return ::core::array::from_fn(|k| R::select(below, extended[k], inside[k]));
            }
        }
        inside
    }
}

/// The test of the domain: J > 0 is λ3 > 0 and J ≠ 0 is |λ3| > 0, the last stretch being the smallest and
/// carrying the sign.
fn admits(declaration: &Declaration, model: &mut Model, writer: &Writer<'_>) -> TokenStream {
    let (plain, extended) = (model.plain.energy, model.extended.as_ref().map(|variant| variant.energy));
    let of_functions = |model: &mut Model| {
        let plain = functions::defined(declaration, model, writer, plain)?;
        let extended = extended.and_then(|energy| functions::defined(declaration, model, writer, energy));
        let extended = extended.filter(|extended| extended.to_string() != plain.to_string());
        Some(writer.by_inversion(plain, extended))
    };
    let continued = quote!(__p::Inversion::Extend { .. } => __p::Mask::splat(true),);
    let (bounds, smallest) = (model.bounds.clone(), &declaration.stretches[2]);
    domain(declaration, model, writer, &bounds, of_functions, smallest, &continued)
}
