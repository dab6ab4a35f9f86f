//! From a [`Model`] to Rust: the type, its constructor, its documentation and its implementations.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{Expr, Ident};

use crate::expr::{Graph, Id};
use crate::formula::formula;
use crate::model::{Model, Variant, Volume, indexed_lists};
use crate::parse::{Declaration, Kind, documentation};
use crate::schedule::schedule;
use writer::Writer;

mod writer;

/// The whole expansion.
#[must_use]
pub fn emit(declaration: &Declaration, mut model: Model) -> TokenStream {
    let texts = Texts::of(declaration, &mut model);
    let structure = structure(declaration, &texts);
    let constructor = constructor(declaration);
    let material = material(declaration, &mut model);
    let declared = declared(declaration, &mut model, &texts);
    quote!(#structure #constructor #material #declared)
}

/// What documentation and description say.
struct Texts {
    formula: String,
    domain: String,
    moduli: [String; 2],
    summary: String,
}

impl Texts {
    fn of(declaration: &Declaration, model: &mut Model) -> Self {
        let mut print = |id| formula(&mut model.graph, declaration, id);
        let formula = print(model.energy);
        let moduli = model.moduli.map(&mut print);
        let domain = match &declaration.options.domain[..] {
            [] => "every deformation".to_owned(),
            conditions => conditions.iter().map(condition_text).collect::<Vec<_>>().join(", "),
        };
        let summary = documentation(&declaration.attributes);
        let summary = summary.lines().next().unwrap_or_default().to_owned();
        Self { formula, domain, moduli, summary }
    }
}

/// A condition as people write it: `mu[p] * alpha[p] > 0`.
fn condition_text(condition: &Expr) -> String {
    let text = condition.to_token_stream().to_string();
    text.replace(" [", "[")
        .replace("[ ", "[")
        .replace(" ]", "]")
        .replace(".0 ", " ")
        .trim_end_matches(".0")
        .to_owned()
}

fn generics(declaration: &Declaration) -> (TokenStream, TokenStream) {
    let names = &declaration.generics;
    if names.is_empty() {
        (quote!(), quote!())
    } else {
        (quote!(<#(const #names: usize),*>), quote!(<#(#names),*>))
    }
}

fn parameter_types(declaration: &Declaration) -> Vec<syn::Type> {
    declaration.parameters.iter().map(|parameter| declaration.parameter_type(parameter)).collect()
}

fn structure(declaration: &Declaration, texts: &Texts) -> TokenStream {
    let Declaration { attributes, visibility, name, .. } = declaration;
    let (bounds, _) = generics(declaration);
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = parameter_types(declaration);
    let inversion = declaration.options.extend.is_some().then(|| quote!(inversion: ::piola::Inversion,));
    let copy = (!declaration.has_functions()).then(|| quote!(#[derive(Copy)]));
    let doc = format!(
        "\n```text\nψ = {}\n```\n\nDomain: {}. Small strain: μ = {}, λ = {}.",
        texts.formula, texts.domain, texts.moduli[0], texts.moduli[1]
    );
    quote! {
        #(#attributes)*
        #[doc = #doc]
        #[derive(Clone, Debug, PartialEq)]
        #copy
        #visibility struct #name #bounds {
            #(#names: #types,)*
            #inversion
        }
    }
}

fn constructor(declaration: &Declaration) -> TokenStream {
    let Declaration { visibility, name, options, .. } = declaration;
    let (bounds, arguments) = generics(declaration);
    let names: Vec<_> = declaration.parameters.iter().map(|parameter| &parameter.name).collect();
    let types = parameter_types(declaration);
    let documented =
        declaration.parameters.iter().map(|parameter| format!("* `{}`: {}", parameter.name, parameter.doc));
    let new_doc = format!(
        "The material with these parameters.\n\n{}\n\n# Errors\nWhere a parameter is not finite or not admissible.",
        documented.collect::<Vec<_>>().join("\n")
    );
    let numbers = declaration.parameters.iter().filter(|parameter| !parameter.is_function());
    let finite = numbers.map(|parameter| {
        let (name, text) = (&parameter.name, parameter.name.to_string());
        let values = if parameter.length().is_some() { quote!(#name) } else { quote!([#name]) };
        quote! {
            for value in #values {
                if !value.is_finite() {
                    return Err(::piola::material::Inadmissible::NotFinite { parameter: #text, value });
                }
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
    let getters = declaration.parameters.iter().zip(&types).map(|(parameter, ty)| {
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
    });
    let with_inversion = options.extend.as_ref().map(|conditions| {
        let restores =
            conditions.iter().map(|condition| check(declaration, condition, &quote!(DoesNotRestore)));
        quote! {
            /// The same material with another way to meet what lies outside its domain.
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
    });
    quote! {
        impl #bounds #name #arguments {
            #[doc = #new_doc]
            #[allow(clippy::too_many_arguments)]
            #visibility fn new(#(#names: #types),*) -> ::core::result::Result<Self, ::piola::material::Inadmissible> {
                #(#finite)*
                #(#admissible)*
                let material = Self { #(#names,)* #inversion };
                #stable_rest
                #stress_free_rest
                Ok(material)
            }

            #with_inversion

            #(#getters)*
        }
    }
}

/// Returns an error unless a condition holds, for every entry if it is written for one.
fn check(declaration: &Declaration, condition: &Expr, error: &TokenStream) -> TokenStream {
    let text = condition_text(condition);
    let lists = indexed_lists(condition);
    let index = lists.first().map(|(_, index)| index.clone());
    let given = declaration.parameters.iter().filter(|parameter| mentions(condition, &parameter.name)).map(
        |parameter| {
            let name = &parameter.name;
            match &index {
                Some(index) if parameter.length().is_some() => {
                    let format = format!("{name}[{{}}] = {{}}");
                    quote!(::std::format!(#format, #index, #name[#index]))
                }
                _ => {
                    let format = format!("{name} = {{}}");
                    quote!(::std::format!(#format, #name))
                }
            }
        },
    );
    let test = quote! {
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN violates")]
        if !(#condition) {
            return Err(::piola::material::Inadmissible::#error {
                condition: #text,
                given: [#(#given),*].join(", "),
            });
        }
    };
    match lists.first() {
        Some((list, index)) => quote!(for #index in 0..#list.len() { #test }),
        None => test,
    }
}

fn mentions(expression: &Expr, name: &Ident) -> bool {
    fn search(tokens: TokenStream, name: &Ident) -> bool {
        tokens.into_iter().any(|token| match token {
            proc_macro2::TokenTree::Ident(ident) => ident == *name,
            proc_macro2::TokenTree::Group(group) => search(group.stream(), name),
            _ => false,
        })
    }
    search(expression.to_token_stream(), name)
}

fn material(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let writer = Writer::new(declaration);
    let stretches = &declaration.stretches;
    let threshold = &writer.threshold;

    let mut bodies = |select: &dyn Fn(&Variant) -> Vec<Id>,
                      result: &dyn Fn(&[TokenStream]) -> TokenStream| {
        let body = |graph: &mut Graph, variant: &Variant| {
            let program = schedule(graph, &select(variant));
            let (statements, outputs) = writer.program(&program);
            let result = result(&outputs);
            quote!(#(#statements)* #result)
        };
        let plain = body(&mut model.graph, &model.plain);
        match &model.extended {
            None => plain,
            Some(extended) => {
                let extended = body(&mut model.graph, extended);
                quote! {
                    match self.inversion {
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
    let blocks = bodies(
        &|variant| [&variant.gradient[..], &variant.hessian, &variant.flip, &variant.twist].concat(),
        &|outputs| {
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
        },
    );

    let at_strains = at_strains(model, &writer, stretches);
    let admits = admits(model, &writer, stretches);
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
    let [l1, l2, l3] = stretches;
    let strains = &writer.strains;
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl #bounds ::piola::Material for #name #arguments {
            #[inline]
            fn energy<R: ::piola::Real>(&self, [#l1, #l2, #l3]: [R; 3]) -> R {
                #energy
            }

            #[inline]
            fn gradient<R: ::piola::Real>(&self, [#l1, #l2, #l3]: [R; 3]) -> [R; 3] {
                #gradient
            }

            #[inline]
            fn blocks<R: ::piola::Real>(&self, [#l1, #l2, #l3]: [R; 3]) -> ::piola::material::Blocks<R> {
                #blocks
            }

            #[inline]
            fn gradient_at_strains<R: ::piola::Real>(&self, #strains: [R; 3]) -> [R; 3] {
                #at_strains
            }

            #[inline]
            fn admits<R: ::piola::Real>(&self, [#l1, #l2, #l3]: [R; 3]) -> R::Mask {
                #admits
            }

            #[inline]
            fn has_pole(&self) -> bool {
                #has_pole
            }

            #[inline]
            fn ends_at_zero_volume(&self) -> bool {
                #ends
            }
        }
    }
}

/// Below the threshold of an extension strains are not small, and the gradient by stretches is as good.
fn at_strains(model: &mut Model, writer: &Writer<'_>, [l1, l2, l3]: &[Ident; 3]) -> TokenStream {
    let program = schedule(&mut model.graph, &model.at_strains);
    let (statements, outputs) = writer.program(&program);
    let (strains, threshold) = (&writer.strains, &writer.threshold);
    let stretches = quote!(#strains.map(|strain| R::splat(1.0) + strain));
    let inside = quote! {
        let [#l1, #l2, #l3] = #stretches;
        #(#statements)*
    };
    if model.extended.is_none() {
        return quote!(#inside [#(#outputs),*]);
    }
    quote! {
        #inside
        let inside = [#(#outputs),*];
        if let ::piola::Inversion::Extend { epsilon: #threshold } = self.inversion {
            let below = #strains[2].less(R::splat(#threshold - 1.0));
            if ::piola::lanes::Mask::any(below) {
                let extended = self.gradient(#stretches);
                return ::core::array::from_fn(|k| R::select(below, extended[k], inside[k]));
            }
        }
        inside
    }
}

/// J > 0 is λ3 > 0 and J ≠ 0 is |λ3| > 0, the last stretch being the smallest and carrying the sign; the other bounds are
/// positive expressions.
fn admits(model: &mut Model, writer: &Writer<'_>, stretches: &[Ident; 3]) -> TokenStream {
    let program = schedule(&mut model.graph, &model.bounds);
    let (statements, outputs) = writer.program(&program);
    let bounds = outputs.iter().map(|bound| quote!(R::splat(0.0).less(#bound)));
    let mut conditions: Vec<TokenStream> = bounds.collect();
    let smallest = &stretches[2];
    let inside = match model.volume {
        Volume::Any => None,
        Volume::Positive => Some(quote!(R::splat(0.0).less(#smallest))),
        Volume::Nonzero => Some(quote!(R::splat(0.0).less(#smallest.abs()))),
    };
    conditions.extend(inside.map(|inside| match &model.extended {
        None => inside,
        Some(_) => quote! {
            match self.inversion {
                ::piola::Inversion::Refuse => #inside,
                ::piola::Inversion::Extend { .. } => <R::Mask as ::piola::lanes::Mask>::splat(true),
            }
        },
    }));
    let all = conditions.into_iter().reduce(|a, b| quote!(#a & #b));
    let all = all.unwrap_or_else(|| quote!(<R::Mask as ::piola::lanes::Mask>::splat(true)));
    quote!(#(#statements)* #all)
}

fn declared(declaration: &Declaration, model: &mut Model, texts: &Texts) -> TokenStream {
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let Texts { formula, domain, moduli, summary } = texts;
    let type_name = name.to_string();
    let parameters = declaration.parameters.iter().map(|parameter| {
        let (name, doc) = (parameter.name.to_string(), &parameter.doc);
        let is_list = !matches!(parameter.kind, Kind::Number);
        quote!(::piola::material::Parameter { name: #name, doc: #doc, is_list: #is_list })
    });
    let extends = declaration.options.extend.is_some();
    let refusal = match &declaration.options.refuse {
        Some(reason) => quote!(::core::option::Option::Some(#reason)),
        None if declaration.options.domain.is_empty() => {
            quote!(::core::option::Option::Some("it is defined for every deformation gradient already"))
        }
        None => quote!(::core::option::Option::None),
    };
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

    let program = schedule(&mut model.graph, &model.moduli);
    let (statements, outputs) = Writer::new(declaration).program(&program);
    let (mu, lambda) = (&outputs[0], &outputs[1]);
    quote! {
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

            #[allow(unused_imports, clippy::all)]
            fn moduli(&self) -> ::piola::material::Moduli {
                use ::piola::Real;
                type R = f64;
                #(#statements)*
                ::piola::material::Moduli { mu: #mu, lambda: #lambda }
            }
        }
    }
}
