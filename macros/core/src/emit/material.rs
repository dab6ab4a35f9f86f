//! The implementation of `Material`: energy, gradient and blocks as straight-line programs.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::Ident;

use super::invariants;
use super::writer::Writer;
use super::{generics, naming};
use crate::algebra::expr::Id;
use crate::model::{Model, Variant};
use crate::read::domain::Volume;
use crate::read::parse::Declaration;

/// `impl Material`, and `impl Varying` where all parameters are numbers.
pub(super) fn material(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let constants = constants(declaration, model);
    // What is not inlined into the function of a back end is not compiled for its instructions.
    if declaration.has_functions() {
        let own = Bodies::new(declaration, model, Writer::new(declaration));
        let computed = own.methods(&quote!(&self), "");
        let by_invariants = invariants::methods(model, &own.writer, &quote!(&self), "");
        let constants = [constants, invariants::constant(model)];
        return quote! {
            #[allow(unused_variables, clippy::all)]
            #naming
            impl #bounds ::piola::Material for #name #arguments {
                #computed
                #by_invariants
                #(#constants)*
            }
        };
    }
    let writer = Writer::for_several(declaration);
    let materials = writer.materials.clone();
    let several = Bodies::new(declaration, model, writer);
    let receiver = quote!(#materials: &impl ::piola::material::Parameters<Self>);
    let computed = several.methods(&receiver, "_of");
    let by_invariants = invariants::methods(model, &several.writer, &receiver, "_of");
    let delegated = invariants::delegated(model);
    let uniform = quote!(&::piola::material::Uniform(self));
    let varying = quote!(<Self as ::piola::material::Varying>);
    quote! {
        #naming
        impl #bounds ::piola::Material for #name #arguments {
            #[inline(always)]
            fn energy<R: ::piola::Real>(&self, stretches: [R; 3]) -> R {
                #varying::energy_of(#uniform, stretches)
            }

            #[inline(always)]
            fn gradient<R: ::piola::Real>(&self, stretches: [R; 3]) -> [R; 3] {
                #varying::gradient_of(#uniform, stretches)
            }

            #[inline(always)]
            fn gradient_at_strains<R: ::piola::Real>(&self, strains: [R; 3]) -> [R; 3] {
                #varying::gradient_at_strains_of(#uniform, strains)
            }

            #[inline(always)]
            fn blocks<R: ::piola::Real>(&self, stretches: [R; 3]) -> ::piola::material::Blocks<R> {
                #varying::blocks_of(#uniform, stretches)
            }

            #[inline(always)]
            fn admits<R: ::piola::Real>(&self, stretches: [R; 3]) -> R::Mask {
                #varying::admits_of(#uniform, stretches)
            }

            #delegated
            #constants
        }

        #[allow(unused_variables, clippy::all)]
        #naming
        impl #bounds ::piola::material::Varying for #name #arguments {
            #computed
            #by_invariants
        }
    }
}

/// What a material says of itself without a point: whether it has a pole, where its domain ends and what it does there, and its
/// moduli.
fn constants(declaration: &Declaration, model: &Model) -> TokenStream {
    let is_positive = model.volume == Volume::Positive;
    let plain_pole = model.plain.has_pole;
    let (has_pole, ends) = match &model.extended {
        None => (quote!(#plain_pole), quote!(#is_positive)),
        Some(extended) => {
            let extended_pole = extended.has_pole;
            let pole = if plain_pole == extended_pole {
                quote!(#plain_pole)
            } else {
                quote! {
                    match self.inversion {
                        ::piola::Inversion::Refuse => #plain_pole,
                        ::piola::Inversion::Extend { .. } => #extended_pole,
                    }
                }
            };
            let refuses = quote!(::core::matches!(self.inversion, ::piola::Inversion::Refuse));
            (pole, if is_positive { refuses } else { quote!(false) })
        }
    };
    let inversion = declaration.options.extend.as_ref().map(|_| {
        quote! {
            #[inline]
            fn inversion(&self) -> ::piola::Inversion {
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

        fn stated_moduli(&self) -> ::core::option::Option<::piola::material::Moduli> {
            ::core::option::Option::Some(::piola::material::Declared::moduli(self))
        }
    }
}

/// The methods that compute, for one way to read parameters.
struct Bodies<'a> {
    writer: Writer<'a>,
    stretches: &'a [Ident; 3],
    energy: TokenStream,
    gradient: TokenStream,
    at_strains: TokenStream,
    blocks: TokenStream,
    admits: TokenStream,
}

impl<'a> Bodies<'a> {
    fn new(declaration: &'a Declaration, model: &mut Model, writer: Writer<'a>) -> Self {
        let stretches = &declaration.stretches;
        let threshold = &writer.threshold;
        let inversion = writer.inversion();
        let mut bodies = |select: &dyn Fn(&Variant) -> Vec<Id>,
                          result: &dyn Fn(&[TokenStream]) -> TokenStream| {
            let body = |model: &mut Model, roots: &[Id]| {
                let program = model.program(roots);
                let (mut body, outputs) = writer.program(&program);
                body.extend(result(&outputs));
                body
            };
            let plain = body(model, &select(&model.plain));
            match model.extended.as_ref().map(select) {
                None => plain,
                Some(extended) => {
                    let extended = body(model, &extended);
                    quote! {
                        match #inversion {
                            ::piola::Inversion::Refuse => { #plain }
                            ::piola::Inversion::Extend { epsilon: #threshold } => {
                                let #threshold = R::splat(#threshold);
                                #extended
                            }
                        }
                    }
                }
            }
        };
        let energy = bodies(&|variant| vec![variant.energy], &|outputs| quote!(#(#outputs)*));
        let gradient = bodies(&|variant| variant.gradient.to_vec(), &|outputs| quote!([#(#outputs),*]));
        let blocks = bodies(&Variant::blocks, &|outputs| {
            let (gradient, hessian, flip, twist) =
                (&outputs[..3], &outputs[3..9], &outputs[9..12], &outputs[12..]);
            quote! {
                ::piola::material::Blocks {
                    gradient: [#(#gradient),*],
                    hessian: [#(#hessian),*],
                    flip: [#(#flip),*],
                    twist: [#(#twist),*],
                }
            }
        });

        let at_strains = at_strains(model, &writer, stretches);
        let admits = admits(model, &writer, stretches);
        Self { writer, stretches, energy, gradient, at_strains, blocks, admits }
    }

    /// `receiver` is what parameters are read from, `ending` that of the methods' names.
    fn methods(&self, receiver: &TokenStream, ending: &str) -> TokenStream {
        let Self { writer, stretches: [l1, l2, l3], energy, gradient, at_strains, blocks, admits } = self;
        let strains = &writer.strains;
        let method = |name: &str| format_ident!("{name}{ending}");
        let names = ["energy", "gradient", "gradient_at_strains", "blocks", "admits"];
        let [energy_of, gradient_of, at_strains_of, blocks_of, admits_of] = names.map(method);
        let stretches = quote!([#l1, #l2, #l3]: [R; 3]);
        quote! {
            #[inline(always)]
            fn #energy_of<R: ::piola::Real>(#receiver, #stretches) -> R {
                #energy
            }

            #[inline(always)]
            fn #gradient_of<R: ::piola::Real>(#receiver, #stretches) -> [R; 3] {
                #gradient
            }

            #[inline(always)]
            fn #at_strains_of<R: ::piola::Real>(#receiver, #strains: [R; 3]) -> [R; 3] {
                #at_strains
            }

            #[inline(always)]
            fn #blocks_of<R: ::piola::Real>(#receiver, #stretches) -> ::piola::material::Blocks<R> {
                #blocks
            }

            #[inline(always)]
            fn #admits_of<R: ::piola::Real>(#receiver, #stretches) -> R::Mask {
                #admits
            }
        }
    }
}

/// Below the threshold of an extension strains are not small, and the gradient by stretches is as good.
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
    let inversion = writer.inversion();
    let gradient = match &writer.materials {
        None => quote!(self.gradient(#stretches)),
        Some(materials) => {
            quote!(<Self as ::piola::material::Varying>::gradient_of(#materials, #stretches))
        }
    };
    quote! {
        #inside
        let inside = [#(#outputs),*];
        if let ::piola::Inversion::Extend { epsilon: #threshold } = #inversion {
            let below = #strains[2].less(R::splat(#threshold - 1.0));
            if ::piola::lanes::Mask::any(below) {
                let extended = #gradient;
                return [
                    R::select(below, extended[0], inside[0]),
                    R::select(below, extended[1], inside[1]),
                    R::select(below, extended[2], inside[2]),
                ];
            }
        }
        inside
    }
}

/// J > 0 is λ3 > 0 and J ≠ 0 is |λ3| > 0, the last stretch being the smallest and carrying the sign; the other bounds are
/// positive expressions.
fn admits(model: &mut Model, writer: &Writer<'_>, stretches: &[Ident; 3]) -> TokenStream {
    let program = model.program(&model.bounds.clone());
    let (statements, outputs) = writer.program(&program);
    let bounds = outputs.iter().map(|bound| quote!(R::splat(0.0).less(#bound)));
    let mut conditions: Vec<TokenStream> = bounds.collect();
    let smallest = &stretches[2];
    let inside = match model.volume {
        Volume::Any => None,
        Volume::Positive => Some(quote!(R::splat(0.0).less(#smallest))),
        Volume::Nonzero => Some(quote!(R::splat(0.0).less(#smallest.abs()))),
    };
    let inversion = writer.inversion();
    conditions.extend(inside.map(|inside| match &model.extended {
        None => inside,
        Some(_) => quote! {
            match #inversion {
                ::piola::Inversion::Refuse => #inside,
                ::piola::Inversion::Extend { .. } => <R::Mask as ::piola::lanes::Mask>::splat(true),
            }
        },
    }));
    let all = conditions.into_iter().reduce(|a, b| quote!(#a & #b));
    let all = all.unwrap_or_else(|| quote!(<R::Mask as ::piola::lanes::Mask>::splat(true)));
    quote!(#statements #all)
}
