//! The inherent methods of a material: `new`, which checks its parameters, the constructor from a stiffness,
//! the choice of an extension, and getters of the parameters.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};
use syn::Expr;

use super::young_poisson::from_young_poisson;
use super::{condition_text, doc, generics, naming};
use crate::model::Model;
use crate::read::literals::typed;
use crate::read::parse::{Declaration, Parameter, identifiers, indexed_list};

/// The inherent methods.
pub(super) fn constructor(declaration: &Declaration, model: &Model) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let new = new(declaration);
    let determined = model.from_young_poisson.as_ref();
    let from_young_poisson = determined.map(|determined| from_young_poisson(declaration, determined));
    let conditions = declaration.options.extend.as_ref();
    let with_inversion = conditions.map(|conditions| with_inversion(declaration, conditions));
    let getters = declaration.parameters.iter().map(|parameter| getter(declaration, parameter));
    let replacements = declaration.parameters.iter().map(|parameter| replacement(declaration, parameter));
    quote! {
        #naming
        impl #bounds #name #arguments {
            #new

            #from_young_poisson

            #with_inversion

            #(#getters)*

            #(#replacements)*
        }
    }
}

fn new(declaration: &Declaration) -> TokenStream {
    let Declaration { visibility, options, .. } = declaration;
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = declaration.parameters.iter().map(|parameter| declaration.parameter_type(parameter));
    let documented =
        declaration.parameters.iter().map(|parameter| format!("* `{}`: {}", parameter.name, parameter.doc));
    let new_doc = format!(
        "The material with these parameters.\n\n{}\n\n# Errors\nWhere a parameter is not finite or not admissible.",
        documented.collect::<Vec<_>>().join("\n")
    );
    let new_doc = doc(&new_doc);
    let numbers = declaration.parameters.iter().filter(|parameter| !parameter.is_function());
    let finite = numbers.map(|parameter| {
        let (name, text) = (&parameter.name, parameter.name.to_string());
        let check = |value: TokenStream, given: TokenStream| {
            quote! {
                if !#value.is_finite() {
                    return Err(::piola::material::Inadmissible::NotFinite { given: ::piola::material::Given::#given });
                }
            }
        };
        if parameter.length().is_none() {
            return check(quote!(#name), quote!(scalar(#text, #name)));
        }
        let check = check(quote!(value), quote!(entry(#text, index, value)));
        quote! {
            for (index, value) in #name.into_iter().enumerate() {
                #check
            }
        }
    });
    let admissible =
        options.admissible.iter().map(|condition| check(declaration, condition, &quote!(Violated)));
    let inversion = options.extend.is_some().then(|| quote!(inversion: ::piola::Inversion::Refuse,));
    let stable_rest = (!options.prestressed).then(|| {
        quote! {
            let moduli = ::piola::material::Declared::moduli(&material);
            if !(moduli.mu > 0.0 && moduli.bulk() >= 0.0 && moduli.bulk().is_finite()) {
                return Err(::piola::material::Inadmissible::UnstableRest { moduli });
            }
        }
    });
    let stress_free_rest = (declaration.has_functions() && !options.prestressed).then(|| {
        quote! {
            let [stress, ..] = ::piola::Material::gradient(&material, [1.0f64; 3]);
            if !(stress.abs() <= 1e-9 * (2.0 * moduli.mu + moduli.lambda.abs())) {
                return Err(::piola::material::Inadmissible::StressedRest { stress });
            }
        }
    });
    quote! {
        #new_doc
        #[allow(clippy::too_many_arguments)]
        #visibility fn new(#(#names: #types),*) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
            #(#finite)*
            #(#admissible)*
            let material = Self { #(#names,)* #inversion };
            #stable_rest
            #stress_free_rest
            Ok(material)
        }
    }
}

/// The choice of an extension, which restores only under the given conditions.
fn with_inversion(declaration: &Declaration, conditions: &[Expr]) -> TokenStream {
    let visibility = &declaration.visibility;
    let names = declaration.parameters.iter().map(|parameter| &parameter.name);
    let restores = conditions.iter().map(|condition| check(declaration, condition, &quote!(DoesNotRestore)));
    quote! {
        /// Replaces what the material does outside its domain.
        ///
        /// # Errors
        /// Where the extension would not restore, or its threshold is outside 0 < ε < 1.
        #visibility fn with_inversion(
            mut self,
            inversion: ::piola::Inversion,
        ) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
            if let ::piola::Inversion::Extend { epsilon } = inversion {
                if !(epsilon > 0.0 && epsilon < 1.0) {
                    return Err(::piola::material::Inadmissible::Threshold { epsilon });
                }
                #[allow(unused_variables)]
                let Self { #(#names,)* .. } = self;
                #(#restores)*
            }
            self.inversion = inversion;
            Ok(self)
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
        "Replaces `{name}`.\n\n# Errors\nIf the parameters are not admissible together, as of `new`."
    ));
    quote! {
        #documentation
        #[allow(dead_code)]
        #visibility fn #method(self, #name: #ty) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
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

/// Returns an error unless a condition holds, for every entry if it is written for one.
fn check(declaration: &Declaration, condition: &Expr, error: &TokenStream) -> TokenStream {
    let text = condition_text(condition);
    let list = indexed_list(condition);
    let names = identifiers(condition.to_token_stream());
    let given =
        declaration.parameters.iter().filter(|parameter| names.contains(&parameter.name)).map(|parameter| {
            let (name, text) = (&parameter.name, parameter.name.to_string());
            match &list {
                Some((_, index)) if parameter.length().is_some() => {
                    quote!(::piola::material::Given::entry(#text, #index, #name[#index]))
                }
                _ => quote!(::piola::material::Given::scalar(#text, #name)),
            }
        });
    let test = typed(condition);
    let test = quote! {
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(#test) {
            return Err(::piola::material::Inadmissible::#error {
                condition: #text,
                given: ::std::vec![#(#given),*],
            });
        }
    };
    match &list {
        Some((list, index)) => quote!(for #index in 0..#list.len() { #test }),
        None => test,
    }
}
