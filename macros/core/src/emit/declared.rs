//! The implementation of `Declared`: the description of a material, its construction from plain values and
//! its moduli.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::{Texts, condition_text, generics, naming};
use crate::read::parse::{Declaration, Kind, Typical};
use crate::read::unit::Unit;

/// `impl Declared`.
pub(super) fn declared(declaration: &Declaration, units: &[Option<Unit>], texts: &Texts) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let Texts { formula, domain, defined, moduli, summary } = texts;
    let domain = [domain.as_str(), defined].join(" ");
    let domain = domain.trim_end();
    let [type_name, summary, formula, domain] = [&name.to_string(), summary, formula, domain].map(text);
    let moduli = moduli.each_ref().map(text);
    let parameters = declaration.parameters.iter().zip(units).map(|(parameter, unit)| {
        let (name, doc) = (parameter.name.to_string(), &parameter.doc);
        let unit = option(unit.map(|unit| format_ident!("{unit:?}")).map(|unit| quote!(__p::Unit::#unit)));
        let form = match &parameter.kind {
            Kind::Number if parameter.is_whole => quote!(__p::Form::Exponent),
            Kind::List(_) if parameter.is_whole => quote!(__p::Form::Exponents),
            Kind::Number => quote!(__p::Form::Number),
            Kind::List(_) => quote!(__p::Form::List),
            Kind::Function(ty) => quote!(<#ty as ::piola::Univariate>::FORM),
        };
        let (name, doc) = (text(name), text(doc));
        quote!(__p::Parameter { name: #name, doc: #doc, unit: #unit, form: #form })
    });
    let typical = option(declaration.options.typical.as_ref().map(typical));
    let extends = declaration.options.extend.is_some();
    let refusal = option(declaration.options.refusal().map(text));
    let admissible = declaration.options.admissible.iter().map(|condition| text(condition_text(condition)));

    let values = read(declaration);
    let binding = (!declaration.parameters.is_empty()).then(|| quote!(let mut values =));
    let material = quote!(Self::new(#(#values),*)?);
    let material = if extends {
        quote!(#material.with_inversion(inversion))
    } else {
        quote!(__p::unextended(#material, inversion))
    };

    quote! {
        #naming
        impl #bounds __p::Declared for #name #arguments {
            const DESCRIPTION: __p::Description = __p::Description {
                name: #type_name,
                summary: #summary,
                formula: #formula,
                parameters: __p::Borrowed(&[#(#parameters),*]),
                domain: #domain,
                extends: #extends,
                refusal: #refusal,
                admissible: __p::Borrowed(&[#(#admissible),*]),
                moduli: [#(#moduli),*],
                typical: #typical,
            };

            fn from_values(
                values: &[&[f64]],
                inversion: __p::Inversion,
            ) -> __p::Result<Self, __p::MaterialError> {
                #binding __p::Values::of::<Self>(values)?;
                #material
            }
        }
    }
}

/// Each parameter as `values` has it.
fn read(declaration: &Declaration) -> Vec<TokenStream> {
    let values = declaration.parameters.iter().map(|parameter| {
        let is_vector = declaration.is_vector(parameter);
        match &parameter.kind {
            Kind::Number if parameter.is_whole => quote!(values.whole_number()?),
            Kind::Number => quote!(values.number()?),
            Kind::List(_) if parameter.is_whole && is_vector => quote!(values.whole_numbers()?),
            Kind::List(_) if parameter.is_whole => quote!(values.whole_list()?),
            Kind::List(_) if is_vector => quote!(values.slice().to_vec()),
            Kind::List(_) => quote!(values.list()?),
            Kind::Function(ty) => quote!(<#ty as ::piola::Univariate>::from_values(values.slice())?),
        }
    });
    values.collect()
}

fn typical(typical: &Typical) -> TokenStream {
    let lists = typical.values.iter().map(|(_, values)| {
        let numbers = values.numbers.iter().map(|&number| {
            let magnitude = Literal::f64_unsuffixed(number.abs());
            if number.is_sign_negative() { quote!(-#magnitude) } else { quote!(#magnitude) }
        });
        quote!(__p::Borrowed(&[#(#numbers),*]))
    });
    let source = text(&typical.source);
    quote!(__p::Typical { values: __p::Borrowed(&[#(#lists),*]), source: #source })
}

/// A text or a list of the description.
pub(super) fn text(text: impl ToTokens) -> TokenStream {
    quote!(__p::Borrowed(#text))
}

pub(super) fn option(value: Option<TokenStream>) -> TokenStream {
    match value {
        Some(value) => quote!(Some(#value)),
        None => quote!(None),
    }
}
