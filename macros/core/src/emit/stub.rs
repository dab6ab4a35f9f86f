//! The expansion of a mistaken declaration: its mistakes, and a type with inert implementations.
//!
//! So that one mistake gives one message, and not another one for each place that uses the material.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};
use syn::{Expr, FnArg, GenericParam, Ident, Item, Lit, Pat, Signature, Type};

use crate::read::parse::{
    Function, entry, identifiers, is_f64, is_reserved, is_type, is_u32, is_vector, may_be_function,
};

/// The mistakes of an item, and as much of a type as its tokens allow; an item that is not a function stays
/// as it is.
pub(crate) fn inert(mistakes: &syn::Error, item: TokenStream) -> TokenStream {
    let errors = mistakes.to_compile_error();
    let inert = match Function::read(item.clone()) {
        // A type of such a name would make mistakes of its own.
        Ok(function) if is_type(&function.signature.ident) => TokenStream::new(),
        Ok(function) => inert_type(&function),
        Err(_) => syn::parse2::<Item>(item).map(Item::into_token_stream).unwrap_or_default(),
    };
    quote!(#errors #inert)
}

/// The lengths of lists, each once.
fn lengths(signature: &Signature) -> Vec<Ident> {
    let names: Vec<_> = signature.generics.const_params().map(|constant| &constant.ident).collect();
    let firsts = (0..names.len()).filter(|&k| !names[..k].contains(&names[k]));
    firsts.map(|k| names[k].clone()).collect()
}

/// Types of the constructor's arguments, and the parameters with the results of their methods.
fn parameters(signature: &Signature, lengths: &[Ident]) -> (Vec<Type>, Vec<(Ident, Type)>) {
    let (mut types, mut methods): (_, Vec<(Ident, Type)>) = (Vec::new(), Vec::new());
    for input in signature.inputs.iter().skip(1) {
        let FnArg::Typed(argument) = input else { continue };
        let is_sound = is_sound(&argument.ty, signature, lengths);
        let ty =
            if is_sound { (*argument.ty).clone() } else { syn::parse_quote!(impl ::core::marker::Sized) };
        types.push(ty);
        if let Pat::Ident(name) = &*argument.pat
            && !is_reserved(&name.ident)
            && methods.iter().all(|(other, _)| *other != name.ident)
        {
            let result = match &*argument.ty {
                ty if is_vector(ty) => {
                    let number = if entry(ty).is_some_and(is_u32) { quote!(u32) } else { quote!(f64) };
                    syn::parse_quote!(&[#number])
                }
                ty if is_sound && may_be_function(ty) => syn::parse_quote!(&#ty),
                ty if is_sound => ty.clone(),
                Type::Array(_) | Type::Slice(_) | Type::Reference(_) => syn::parse_quote!(&[f64]),
                _ => syn::parse_quote!(f64),
            };
            methods.push((name.ident.clone(), result));
        }
    }
    (types, methods)
}

/// True if the compiler can name the type and a correct declaration could have it.
fn is_sound(ty: &Type, signature: &Signature, lengths: &[Ident]) -> bool {
    match ty {
        Type::Array(array) => {
            let is_length = match &array.len {
                Expr::Lit(literal) => matches!(literal.lit, Lit::Int(_)),
                Expr::Path(path) => lengths.iter().any(|length| path.path.is_ident(length)),
                _ => false,
            };
            is_length && (is_f64(&array.elem) || is_u32(&array.elem))
        }
        ty if may_be_function(ty) => {
            let names = identifiers(ty.to_token_stream());
            !signature.generics.params.iter().any(|generic| match generic {
                GenericParam::Type(generic) => names.contains(&generic.ident),
                GenericParam::Lifetime(generic) => names.contains(&generic.lifetime.ident),
                GenericParam::Const(_) => false,
            })
        }
        ty => is_f64(ty) || is_u32(ty),
    }
}

fn inert_type(function: &Function) -> TokenStream {
    let Function { attributes, visibility, signature, .. } = function;
    let name = &signature.ident;
    let generics = lengths(signature);
    let (types, methods) = parameters(signature, &generics);
    let replacements = methods.iter().map(|(name, _)| format_ident!("with_{name}"));
    let made = quote!(::core::result::Result<Self, ::piola::material::MaterialError>);
    let of_type = [
        quote!(fn new(#(_: #types),*) -> #made),
        quote!(fn with_inversion(self, inversion: ::piola::Inversion) -> #made),
    ];
    let replacements = replacements.map(|method| quote!(fn #method<AnyValue>(self, _: AnyValue) -> #made));
    let getters = methods.iter().map(|(method, result)| quote!(fn #method(&self) -> #result));
    let of_type = of_type.into_iter().chain(replacements).chain(getters);
    let of_type = inert_functions(of_type.map(|function| quote!(#visibility #function)));
    let stretches = quote!(&self, stretches: [AnyReal; 3]);
    let material = inert_functions([
        quote!(fn energy<AnyReal: ::piola::Real>(#stretches) -> AnyReal),
        quote!(fn gradient<AnyReal: ::piola::Real>(#stretches) -> [AnyReal; 3]),
        quote!(fn blocks<AnyReal: ::piola::Real>(#stretches) -> ::piola::material::Blocks<AnyReal>),
        quote!(fn admits<AnyReal: ::piola::Real>(#stretches) -> AnyReal::Mask),
        quote!(fn has_pole(&self) -> bool),
        quote!(fn ends_at_zero_volume(&self) -> bool),
    ]);
    let graded = inert_functions([quote! {
        fn on_lanes<'lanes>(material: impl ::core::ops::Fn(usize) -> &'lanes Self + ::core::marker::Copy) -> Self
        where
            Self: 'lanes
    }]);
    let declared =
        inert_functions([quote!(fn from_values(values: &[&[f64]], inversion: ::piola::Inversion) -> #made)]);
    let empty = quote!(::std::borrow::Cow::Borrowed(""));
    let description = quote! {
        const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
            name: #empty,
            summary: #empty,
            formula: #empty,
            parameters: ::std::borrow::Cow::Borrowed(&[]),
            domain: #empty,
            extends: false,
            refusal: ::core::option::Option::None,
            admissible: ::std::borrow::Cow::Borrowed(&[]),
            moduli: [#empty, #empty],
            typical: ::core::option::Option::None,
        };
    };
    let of_traits = [
        (quote!(Material), material),
        (quote!(material::Graded), quote!(type OnLanes<'lanes> = Self; #graded)),
        (quote!(material::Declared), quote!(#description #declared)),
    ];
    let implementations = of_traits.map(|(interface, items)| {
        quote! {
            #[allow(unused_variables)]
            impl<#(const #generics: usize),*> ::piola::#interface for #name<#(#generics),*> {
                #items
            }
        }
    });
    quote! {
        #(#attributes)*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[allow(missing_docs, non_camel_case_types)]
        #visibility struct #name<#(const #generics: usize),*> {}

        #[allow(missing_docs, dead_code, non_snake_case, unused_variables, clippy::too_many_arguments)]
        impl<#(const #generics: usize),*> #name<#(#generics),*> {
            #of_type
        }

        #(#implementations)*
    }
}

/// Functions that no program calls, given without their bodies.
fn inert_functions(functions: impl IntoIterator<Item = TokenStream>) -> TokenStream {
    let inert = |function| quote!(#function { ::core::unreachable!("this material does not compile") });
    functions.into_iter().map(inert).collect()
}
