//! What a mistaken declaration expands to: its mistakes, and a type with inert implementations.
//!
//! So that one mistake gives one message, and not another one for each place that uses the material.

use proc_macro2::TokenStream;
use quote::quote;
use syn::{FnArg, GenericParam, ItemFn, Pat, Type};

use crate::parse::Declaration;

/// For an item whose form is wrong: as much of a type as its tokens allow.
#[must_use]
pub fn without_form(mistakes: &syn::Error, item: TokenStream) -> TokenStream {
    let errors = mistakes.to_compile_error();
    let Ok(function) = syn::parse2::<ItemFn>(item) else { return errors };
    let names: Vec<_> = function
        .sig
        .generics
        .params
        .iter()
        .filter_map(|generic| match generic {
            GenericParam::Const(constant) => Some(constant.ident.clone()),
            _ => None,
        })
        .collect();
    let arguments = function.sig.inputs.iter().skip(1).filter_map(|input| match input {
        FnArg::Typed(argument) => match &*argument.pat {
            Pat::Ident(name) => Some((name.ident.clone(), (*argument.ty).clone())),
            _ => None,
        },
        FnArg::Receiver(_) => None,
    });
    let inert = inert_type(&function.vis, &function.sig.ident, &names, arguments.collect());
    quote!(#errors #inert)
}

/// For a declaration whose meaning is wrong.
#[must_use]
pub fn inert(mistakes: &syn::Error, declaration: &Declaration) -> TokenStream {
    let errors = mistakes.to_compile_error();
    let arguments = declaration
        .parameters
        .iter()
        .map(|parameter| (parameter.name.clone(), declaration.parameter_type(parameter)))
        .collect();
    let inert = inert_type(&declaration.visibility, &declaration.name, &declaration.generics, arguments);
    quote!(#errors #inert)
}

fn inert_type(
    visibility: &syn::Visibility,
    name: &syn::Ident,
    generics: &[syn::Ident],
    arguments: Vec<(syn::Ident, Type)>,
) -> TokenStream {
    let (names, types): (Vec<_>, Vec<_>) = arguments.into_iter().unzip();
    let unreachable = quote!(::core::unreachable!("this material does not compile"));
    quote! {
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(missing_docs)]
        #visibility struct #name<#(const #generics: usize),*>;

        #[allow(missing_docs, unused_variables, clippy::too_many_arguments)]
        impl<#(const #generics: usize),*> #name<#(#generics),*> {
            pub fn new(#(#names: #types),*) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
                #unreachable
            }
            pub fn with_inversion(
                self,
                inversion: ::piola::Inversion,
            ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
                #unreachable
            }
        }

        #[allow(unused_variables)]
        impl<#(const #generics: usize),*> ::piola::Material for #name<#(#generics),*> {
            fn energy<R: ::piola::Real>(&self, stretches: [R; 3]) -> R {
                #unreachable
            }
            fn gradient<R: ::piola::Real>(&self, stretches: [R; 3]) -> [R; 3] {
                #unreachable
            }
            fn blocks<R: ::piola::Real>(&self, stretches: [R; 3]) -> ::piola::material::Blocks<R> {
                #unreachable
            }
            fn admits<R: ::piola::Real>(&self, stretches: [R; 3]) -> R::Mask {
                #unreachable
            }
            fn has_pole(&self) -> bool {
                #unreachable
            }
            fn ends_at_zero_volume(&self) -> bool {
                #unreachable
            }
        }

        #[allow(unused_variables)]
        impl<#(const #generics: usize),*> ::piola::material::Varying for #name<#(#generics),*> {
            fn energy_of<R: ::piola::Real>(
                materials: &impl ::piola::material::Parameters<Self>,
                stretches: [R; 3],
            ) -> R {
                #unreachable
            }
            fn gradient_of<R: ::piola::Real>(
                materials: &impl ::piola::material::Parameters<Self>,
                stretches: [R; 3],
            ) -> [R; 3] {
                #unreachable
            }
            fn gradient_at_strains_of<R: ::piola::Real>(
                materials: &impl ::piola::material::Parameters<Self>,
                strains: [R; 3],
            ) -> [R; 3] {
                #unreachable
            }
            fn blocks_of<R: ::piola::Real>(
                materials: &impl ::piola::material::Parameters<Self>,
                stretches: [R; 3],
            ) -> ::piola::material::Blocks<R> {
                #unreachable
            }
            fn admits_of<R: ::piola::Real>(
                materials: &impl ::piola::material::Parameters<Self>,
                stretches: [R; 3],
            ) -> R::Mask {
                #unreachable
            }
            fn inversion(&self) -> ::piola::Inversion {
                #unreachable
            }
        }

        #[allow(unused_variables)]
        impl<#(const #generics: usize),*> ::piola::material::Declared for #name<#(#generics),*> {
            const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
                name: "",
                summary: "",
                formula: "",
                parameters: &[],
                domain: "",
                extends: false,
                refusal: ::core::option::Option::None,
                admissible: &[],
                moduli: ["", ""],
            };
            fn from_values(
                values: &[&[f64]],
                inversion: ::piola::Inversion,
            ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
                #unreachable
            }
            fn moduli(&self) -> ::piola::material::Moduli {
                #unreachable
            }
        }
    }
}
