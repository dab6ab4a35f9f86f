//! The expansion: from a [`Model`] to Rust, the type, its constructor, its documentation and its
//! implementations.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};
use syn::Ident;

use crate::model::Model;
use crate::printer::formula;
pub use crate::read::notation::{condition_text, spaced};
use crate::read::parse::{Declaration, Kind, documentation};
use constructor::constructor;
use declared::declared;
use material::material;
use serde::serde;

pub mod condition;
mod constructor;
mod declared;
pub mod documentation;
mod domain;
mod functions;
mod invariants;
mod material;
mod serde;
pub mod stub;
mod writer;

/// The whole expansion.
#[must_use]
pub fn emit(declaration: &Declaration, mut model: Model) -> TokenStream {
    let texts = Texts::of(declaration, &mut model);
    let documentation = documentation::page(declaration, &mut model, &texts);
    let structure = structure(declaration, &documentation);
    let constructor = constructor(declaration, &mut model);
    let material = material(declaration, &mut model);
    let declared = declared(declaration, &model.units, &texts);
    let serde = serde(declaration);
    quote! {
        #structure
        const _: () = {
            use ::piola::__private as __p;
            #constructor
            #material
            #declared
            #serde
        };
    }
}

/// Texts that documentation and description share.
#[derive(Clone, Debug)]
pub struct Texts {
    /// ψ as a formula in one line.
    pub formula: String,
    /// The conditions of the domain.
    pub domain: String,
    /// Functions that narrow it, as in `where f is defined`; empty without functions.
    pub defined: String,
    /// Small-strain μ and λ as formulas.
    pub moduli: [String; 2],
    /// First paragraph of the documentation.
    pub summary: String,
}

impl Texts {
    /// The texts of a declaration.
    pub fn of(declaration: &Declaration, model: &mut Model) -> Self {
        let mut print = |id| formula(&mut model.graph, declaration, id);
        let formula = print(model.energy);
        let moduli = model.moduli.map(&mut print);
        let domain = match &declaration.options.domain[..] {
            [] => "every deformation".to_owned(),
            conditions => conditions.iter().map(condition_text).collect::<Vec<_>>().join(", "),
        };
        let defined = functions::documentation(declaration);
        let summary = documentation(&declaration.attributes);
        let summary = summary.lines().next().unwrap_or_default().to_owned();
        Self { formula, domain, defined, moduli, summary }
    }
}

/// Text as documentation, one line at a time in the usual format.
fn doc(text: &str) -> TokenStream {
    let lines = text.lines().map(|line| if line.is_empty() { String::new() } else { format!(" {line}") });
    quote!(#(#[doc = #lines])*)
}

/// A method that is compiled for the instructions of the function which calls it.
fn inlined(signature: TokenStream, body: TokenStream) -> TokenStream {
    quote!(#[inline(always)] #signature { #body })
}

/// The generics after `impl`, and those after the name.
fn generics(declaration: &Declaration) -> (TokenStream, TokenStream) {
    let names = &declaration.generics;
    if names.is_empty() {
        (quote!(), quote!())
    } else {
        (quote!(<#(const #names: usize),*>), quote!(<#(#names),*>))
    }
}

/// The type parameter of a material for the representation of its parameters, if these are only numbers.
fn value_parameter(declaration: &Declaration) -> Option<Ident> {
    if !declaration.is_plain() || declaration.parameters.is_empty() {
        return None;
    }
    let is_free = |name: &Ident| !declaration.generics.contains(name) && declaration.name != *name;
    let names = ["P", "V", "Value"].map(|name| format_ident!("{name}"));
    names.into_iter().find(is_free).or_else(|| Some(format_ident!("ParameterValue")))
}

/// The attribute that allows names of papers, such as `K`, despite the lint on their case.
fn naming(declaration: &Declaration) -> Option<TokenStream> {
    let parameters = declaration.parameters.iter().map(|parameter| &parameter.name);
    let mut names = parameters.chain(&declaration.stretches).map(ToString::to_string);
    names
        .any(|name| name.contains(char::is_uppercase) || name.contains("__"))
        .then(|| quote!(#[allow(non_snake_case)]))
}

fn structure(declaration: &Declaration, documentation: &str) -> TokenStream {
    let Declaration { attributes, visibility, name, .. } = declaration;
    let (documentation, naming) = (doc(documentation), naming(declaration));
    let lengths = &declaration.generics;
    let value = value_parameter(declaration);
    let kept_as = value.as_ref().map_or(quote!(f64), |value| quote!(#value));
    let value = value.map(|value| quote!(#value = f64));
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = declaration.parameters.iter().map(|parameter| match &parameter.kind {
        Kind::Number if !parameter.is_whole => kept_as.clone(),
        Kind::List(length) if !parameter.is_whole && !declaration.is_vector(parameter) => {
            let length = declaration.lengths[*length].of_self();
            quote!([#kept_as; #length])
        }
        _ => declaration.parameter_type(parameter).into_token_stream(),
    });
    let inversion = declaration.options.extend.is_some().then(|| quote!(inversion: ::piola::Inversion,));
    let copy = declaration.is_plain().then(|| quote!(#[derive(Copy)]));
    quote! {
        #(#attributes)*
        #documentation
        #[derive(Clone, Debug, PartialEq)]
        #copy
        #naming
        #visibility struct #name<#(const #lengths: usize,)* #value> {
            #(#names: #types,)*
            #inversion
        }
    }
}
