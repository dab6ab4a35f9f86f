//! The implementation of `Declared`: the description of a material, its construction from plain values and
//! its moduli.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::{Texts, condition_text, generics, naming};
use crate::read::parse::{Declaration, Kind, Typical};
use crate::read::unit::Unit;

/// `impl Declared`.
pub(super) fn declared(declaration: &Declaration, texts: &Texts) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let Texts { formula, domain, moduli, summary } = texts;
    let type_name = name.to_string();
    let parameters = declaration.parameters.iter().map(|parameter| {
        let (name, doc) = (parameter.name.to_string(), &parameter.doc);
        let unit = option(parameter.unit().map(|unit| match unit {
            Unit::Pascal => quote!(::piola::material::Unit::Pascal),
            Unit::PerPascal => quote!(::piola::material::Unit::PerPascal),
            Unit::Dimensionless => quote!(::piola::material::Unit::Dimensionless),
        }));
        let form = match &parameter.kind {
            Kind::Number => quote!(::piola::material::Form::Number),
            Kind::List(_) => quote!(::piola::material::Form::List),
            Kind::Function(ty) => quote!(<#ty as ::piola::Univariate>::FORM),
        };
        quote!(::piola::material::Parameter { name: #name, doc: #doc, unit: #unit, form: #form })
    });
    let typical = option(declaration.options.typical.as_ref().map(typical));
    let extends = declaration.options.extend.is_some();
    let refusal = option(match &declaration.options.refuse {
        Some(reason) => Some(quote!(#reason)),
        None if declaration.options.domain.is_empty() => {
            Some(quote!("it is defined for every deformation gradient already"))
        }
        None => None,
    });
    let admissible = declaration.options.admissible.iter().map(condition_text);

    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let expected = format!(
        "{} parameters are expected: {}",
        names.len(),
        names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    );
    let conversions = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        let (pattern, length, shape) = match &parameter.kind {
            Kind::Number => {
                let message = format!("`{name}` must be one number");
                (quote!([#name]), quote!(1), quote!(#message.to_owned()))
            }
            Kind::List(length) => {
                let length = &declaration.lengths[*length];
                let format = format!("`{name}` must have {{}} entries");
                (quote!(#name), quote!(#length), quote!(::std::format!(#format, #length)))
            }
            Kind::Function(ty) => {
                return quote!(let #name = <#ty as ::piola::Univariate>::from_values(#name)?;);
            }
        };
        quote! {
            let Ok(#pattern) = <[f64; #length]>::try_from(#name) else {
                return Err(::piola::material::Inadmissible::Shape { expected: #shape });
            };
        }
    });
    let finish = if extends {
        quote!(Self::new(#(#names),*)?.with_inversion(inversion))
    } else {
        quote! {
            let material = Self::new(#(#names),*)?;
            match inversion {
                ::piola::Inversion::Refuse => Ok(material),
                ::piola::Inversion::Extend { .. } => {
                    Err(::piola::material::Inadmissible::NoExtension {
                        material: #type_name,
                        reason: <Self as ::piola::material::Declared>::DESCRIPTION.refusal,
                    })
                }
            }
        }
    };

    quote! {
        #naming
        impl #bounds ::piola::material::Declared for #name #arguments {
            const DESCRIPTION: ::piola::material::Description = ::piola::material::Description {
                name: #type_name,
                summary: #summary,
                formula: #formula,
                parameters: &[#(#parameters),*],
                domain: #domain,
                extends: #extends,
                refusal: #refusal,
                admissible: &[#(#admissible),*],
                moduli: [#(#moduli),*],
                typical: #typical,
            };

            fn from_values(
                values: &[&[f64]],
                inversion: ::piola::Inversion,
            ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
                let &[#(#names),*] = values else {
                    return Err(::piola::material::Inadmissible::Shape { expected: #expected.to_owned() });
                };
                #(#conversions)*
                #finish
            }
        }
    }
}

/// Parameters of some real material.
fn typical(typical: &Typical) -> TokenStream {
    let lists = typical.values.iter().map(|(_, values)| {
        let numbers = values.numbers.iter().map(|&number| {
            let magnitude = Literal::f64_unsuffixed(number.abs());
            if number.is_sign_negative() { quote!(-#magnitude) } else { quote!(#magnitude) }
        });
        quote!(&[#(#numbers),*])
    });
    let source = &typical.source;
    quote!(::piola::material::Typical { values: &[#(#lists),*], source: #source })
}

fn option(value: Option<TokenStream>) -> TokenStream {
    match value {
        Some(value) => quote!(::core::option::Option::Some(#value)),
        None => quote!(::core::option::Option::None),
    }
}
