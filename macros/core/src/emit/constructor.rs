//! The inherent methods of a material: `new`, which checks its parameters, the choice of an extension, and
//! getters of the parameters.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::{Expr, Ident};

use super::condition::{Condition, Term, named};
use super::declared::{option, text};
use super::writer::{Writer, free_name};
use super::{condition_text, doc, generics, naming};
use crate::model::Model;
use crate::read::parse::{Declaration, Entries, Kind, Parameter};

pub(super) fn constructor(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let new = new(declaration, model);
    let conditions = declaration.options.extend.as_ref();
    let with_inversion = conditions.map(|conditions| with_inversion(declaration, conditions));
    let getters = declaration.parameters.iter().map(|parameter| getter(declaration, parameter));
    let replacements = declaration.parameters.iter().map(|parameter| replacement(declaration, parameter));
    quote! {
        #naming
        #[allow(clippy::too_many_arguments)]
        impl #bounds #name #arguments {
            #new

            #with_inversion

            #(#getters)*

            #(#replacements)*
        }
    }
}

fn new(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let Declaration { visibility, options, .. } = declaration;
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = declaration.parameters.iter().map(|parameter| declaration.parameter_type(parameter));
    let documented =
        declaration.parameters.iter().map(|parameter| format!("* `{}`: {}", parameter.name, parameter.doc));
    let lengths = declaration.parameters.iter().filter_map(|parameter| same_length(declaration, parameter));
    let lengths: Vec<_> = lengths.collect();
    let new_doc = format!(
        "The material with these parameters.\n\n{}\n\n# Errors\nIf a parameter is not finite or not admissible{}{}.",
        documented.collect::<Vec<_>>().join("\n"),
        if model.bounds_at_rest.is_empty() { "" } else { ", or rest is outside of the domain" },
        if lengths.is_empty() { "" } else { ", or the lists of one sum are not equally long" },
    );
    let new_doc = doc(&new_doc);
    let has_numbers = declaration.parameters.iter().any(|parameter| !parameter.is_function());
    let checked = (has_numbers || !options.admissible.is_empty()).then(|| {
        let (parameters, numbers) = (parameters(), numbers(declaration, None));
        let admissible = conditions(declaration, &options.admissible);
        quote!(__p::check_parameters(#parameters, #numbers, #admissible)?;)
    });
    let inversion = options.extend.is_some().then(|| quote!(inversion: __p::Inversion::Refuse,));
    let material = quote!(Self { #(#names,)* #inversion });
    let made = free_name(declaration, &["material", "made"]);
    let inside = inside_at_rest(declaration, model, &made);
    let (inside, material) = match inside {
        None => (None, material),
        Some(inside) => (Some(quote!(let #made = #material; #inside)), made.into_token_stream()),
    };
    let (is_prestressed, has_functions) = (options.prestressed, declaration.has_functions());
    quote! {
        #new_doc
        #visibility fn new(#(#names: #types),*) -> __p::Result<Self, __p::MaterialError> {
            #(#lengths)*
            #checked
            #inside
            __p::at_rest(#material, #is_prestressed, #has_functions)
        }
    }
}

/// Returns an error unless rest is inside the domain of the material of this name, if that depends on
/// parameters.
fn inside_at_rest(declaration: &Declaration, model: &mut Model, material: &Ident) -> Option<TokenStream> {
    let (places, values): (Vec<_>, Vec<_>) = model.bounds_at_rest.iter().copied().unzip();
    if values.is_empty() {
        return None;
    }
    let program = model.program(&values);
    let writer = Writer { material: material.clone(), ..Writer::new(declaration) };
    let (statements, outputs) = writer.program(&program);
    let conditions: Vec<_> = declaration.bounds().collect();
    let (parameters, numbers) = (parameters(), numbers(declaration, Some(material)));
    let checks = places.into_iter().zip(outputs).filter_map(|(k, value)| {
        let condition = conditions.get(k)?;
        let (text, names) = (condition_text(condition), named(declaration, condition));
        let names = names.into_iter().map(Literal::usize_unsuffixed);
        Some(quote!(__p::inside_at_rest(#parameters, #numbers, #value, #text, &[#(#names),*])?;))
    });
    Some(quote! {
        #[allow(unused_imports, clippy::all)]
        {
            use ::piola::Real;
            type R = f64;
            #statements
            #(#checks)*
        }
    })
}

/// Returns an error unless a vector has as many entries as the first of those that are read with it.
fn same_length(declaration: &Declaration, parameter: &Parameter) -> Option<TokenStream> {
    let Entries::AtRunTime(first) = &declaration.lengths[parameter.length()?] else { return None };
    let name = &parameter.name;
    let texts = [name, first].map(Ident::to_string);
    let [name_text, first_text] = &texts;
    (name != first)
        .then(|| quote!(__p::same_length((#name_text, #name.len()), (#first_text, #first.len()))?;))
}

/// The choice of an extension, which restores only under the given conditions.
fn with_inversion(declaration: &Declaration, conditions: &[Expr]) -> TokenStream {
    let visibility = &declaration.visibility;
    let arguments = match conditions {
        [] => quote!(&[], &[], inversion, &[]),
        conditions => {
            let (parameters, numbers) = (parameters(), numbers(declaration, Some(&format_ident!("self"))));
            let conditions = self::conditions(declaration, conditions);
            quote!(#parameters, #numbers, inversion, #conditions)
        }
    };
    quote! {
        /// Replaces the behaviour outside the domain.
        ///
        /// # Errors
        /// Where the extension would not restore, or its threshold is outside 0 < ε < 1.
        #visibility fn with_inversion(
            mut self,
            inversion: __p::Inversion,
        ) -> __p::Result<Self, __p::MaterialError> {
            __p::extends(#arguments)?;
            self.inversion = inversion;
            Ok(self)
        }
    }
}

fn parameters() -> TokenStream {
    quote!(&<Self as __p::Declared>::DESCRIPTION.parameters)
}

/// The numbers of each parameter as a slice, which is empty for a function: those of a material, or variables
/// of their names.
fn numbers(declaration: &Declaration, material: Option<&Ident>) -> TokenStream {
    let of = material.map(|material| quote!(#material.));
    let numbers = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Kind::Number if parameter.is_whole => quote!(&[f64::from(#of #name)]),
            Kind::Number => quote!(&[#of #name]),
            Kind::List(_) if parameter.is_whole => {
                quote!(&#of #name.iter().copied().map(f64::from).collect::<__p::Vec<_>>())
            }
            Kind::List(_) => quote!(&#of #name),
            Kind::Function(_) => quote!(&[]),
        }
    });
    quote!(&[#(#numbers),*])
}

/// Conditions as data.
fn conditions(declaration: &Declaration, conditions: &[Expr]) -> TokenStream {
    if conditions.is_empty() {
        return quote!(&[]);
    }
    let conditions = conditions.iter().map(|condition| {
        let Condition { text: condition, sides, comparison, list, names } =
            Condition::new(declaration, condition, &term);
        let names = names.into_iter().map(Literal::usize_unsuffixed);
        let [text, names] = [text(condition), text(quote!(&[#(#names),*]))];
        let list = option(list.map(Literal::usize_unsuffixed).map(Literal::into_token_stream));
        quote! {
            __p::Condition {
                text: #text,
                sides: [#(#sides),*],
                comparison: #comparison,
                list: #list,
                names: #names,
            }
        }
    });
    quote!(const { &[#(#conditions),*] })
}

fn term(term: Term<TokenStream>) -> TokenStream {
    match term {
        Term::Number(number) if number.is_finite() => {
            let number = Literal::f64_unsuffixed(number);
            quote!(__p::Term::Number(#number))
        }
        Term::Number(_) => quote!(__p::Term::Number(::core::primitive::f64::NAN)),
        Term::Parameter(k) => {
            let k = Literal::usize_unsuffixed(k);
            quote!(__p::Term::Parameter(#k))
        }
        Term::Call(name, operands) => {
            let [name, operands] = [text(name), text(quote!(&[#(#operands),*]))];
            quote!(__p::Term::Call(#name, #operands))
        }
    }
}

/// The material with another value of one parameter.
fn replacement(declaration: &Declaration, parameter: &Parameter) -> TokenStream {
    let visibility = &declaration.visibility;
    let ty = declaration.parameter_type(parameter);
    let name = &parameter.name;
    let method = format_ident!("with_{name}");
    let values = declaration.parameters.iter().map(|other| {
        let other = &other.name;
        if other == name { quote!(#name) } else { quote!(self.#other) }
    });
    let inversion = declaration.options.extend.is_some().then(|| quote!(?.with_inversion(self.inversion)));
    let documentation = doc(&format!(
        "Replaces `{name}`.\n\n# Errors\nIf the parameters are not admissible together, as for `new`."
    ));
    quote! {
        #documentation
        #[allow(dead_code)]
        #visibility fn #method(self, #name: #ty) -> __p::Result<Self, __p::MaterialError> {
            Self::new(#(#values),*)#inversion
        }
    }
}

fn getter(declaration: &Declaration, parameter: &Parameter) -> TokenStream {
    let visibility = &declaration.visibility;
    let ty = declaration.parameter_type(parameter);
    let (name, attributes) = (&parameter.name, &parameter.attributes);
    let is_documented = !parameter.doc.is_empty();
    let doc = (!is_documented).then(|| quote!(#[doc = "A parameter."]));
    let (ty, value) = if parameter.is_function() {
        (quote!(&#ty), quote!(&self.#name))
    } else if declaration.is_vector(parameter) {
        let number = parameter.number_type();
        (quote!(&[#number]), quote!(&self.#name))
    } else {
        (quote!(#ty), quote!(self.#name))
    };
    quote! {
        #(#attributes)*
        #doc
        #[must_use]
        #visibility fn #name(&self) -> #ty {
            #value
        }
    }
}
