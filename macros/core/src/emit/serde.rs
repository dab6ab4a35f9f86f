//! Serialisation by serde: a material is written as its parameters and read through the constructor that
//! checks them.

use proc_macro2::TokenStream;
use quote::quote;

use super::generics;
use crate::read::parse::{Declaration, Entries, Kind};

/// `impl Serialize` and `impl Deserialize`, if the attribute requests them.
///
/// Both go through a struct of the parameters with lists as vectors, because serde has no arrays of any
/// length. Nothing but the two implementations leaves the block.
pub(super) fn serde(declaration: &Declaration) -> TokenStream {
    if !declaration.options.serde {
        return TokenStream::new();
    }
    let name = &declaration.name;
    let text = name.to_string();
    let (bounds, arguments) = generics(declaration);
    let lengths = &declaration.generics;
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = declaration.parameters.iter().map(|parameter| match &parameter.kind {
        Kind::List(_) => {
            let number = parameter.number_type();
            syn::parse_quote!(::std::vec::Vec<#number>)
        }
        Kind::Number | Kind::Function(_) => declaration.parameter_type(parameter),
    });
    let plain = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Kind::Number => quote!(self.#name),
            Kind::List(_) => quote!(self.#name.to_vec()),
            Kind::Function(_) => quote!(::core::clone::Clone::clone(&self.#name)),
        }
    });
    let arrays = declaration.parameters.iter().filter_map(|parameter| {
        let Entries::Known(length) = &declaration.lengths[parameter.length()?] else { return None };
        let (name, number) = (&parameter.name, parameter.number_type());
        let format = format!("`{name}` must have {{}} entries, not {{}}");
        Some(quote! {
            let #name = <[#number; #length]>::try_from(#name).map_err(|list| {
                <__D::Error as __p::serde::de::Error>::custom(::std::format!(#format, #length, list.len()))
            })?;
        })
    });
    let extends = declaration.options.extend.is_some();
    let inversion = extends.then(|| quote!(inversion));
    let field = extends.then(|| quote!(#[serde(default)] inversion: ::piola::Inversion,));
    let own_inversion = extends.then(|| quote!(inversion: self.inversion,));
    let extended = extends.then(|| quote!(.and_then(|material| material.with_inversion(inversion))));
    quote! {
        #[allow(non_snake_case)]
        const _: () = {
            use ::piola::__private as __p;

            #[derive(__p::serde::Serialize, __p::serde::Deserialize)]
            #[serde(crate = "::piola::__private::serde", rename = #text, deny_unknown_fields)]
            struct __Parameters {
                #(#names: #types,)*
                #field
            }

            impl #bounds __p::serde::Serialize for #name #arguments {
                fn serialize<__S: __p::serde::Serializer>(&self, serializer: __S) -> ::core::result::Result<__S::Ok, __S::Error> {
                    let parameters = __Parameters { #(#names: #plain,)* #own_inversion };
                    __p::serde::Serialize::serialize(&parameters, serializer)
                }
            }

            impl<'de, #(const #lengths: usize),*> __p::serde::Deserialize<'de> for #name #arguments {
                fn deserialize<__D: __p::serde::Deserializer<'de>>(
                    deserializer: __D,
                ) -> ::core::result::Result<Self, __D::Error> {
                    let __Parameters { #(#names,)* #inversion } = __p::serde::Deserialize::deserialize(deserializer)?;
                    #(#arrays)*
                    Self::new(#(#names),*)#extended.map_err(<__D::Error as __p::serde::de::Error>::custom)
                }
            }
        };
    }
}
