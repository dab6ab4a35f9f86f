//! The implementation of `Fittable`: the values of the parameters, the derivatives of the gradient with
//! respect to them, and the conditions that keep them admissible.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::Ident;

use super::declared::read;
use super::writer::{Writer, free_name};
use super::{generics, naming};
use crate::algebra::expr::Id;
use crate::model::{Constraint, Group, Limit, Model, Slopes};
use crate::read::parse::{Declaration, Kind, Parameter};

/// `impl Fittable`, if it is requested.
pub(super) fn fittable(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let Some(by_parameters) = model.by_parameters.clone() else { return TokenStream::new() };
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let values = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Kind::List(_) if parameter.is_whole => {
                quote!(self.#name.iter().map(|&value| f64::from(value)).collect())
            }
            _ if parameter.is_whole => quote!(::std::vec![f64::from(self.#name)]),
            Kind::List(_) => quote!(self.#name.to_vec()),
            Kind::Number => quote!(::std::vec![self.#name]),
            Kind::Function(_) => quote!(::piola::Univariate::values(&self.#name)),
        }
    });
    let with_values = declaration.has_functions().then(|| with_values(declaration));

    let by_parameters: Vec<_> = by_parameters.iter().map(|triple| triple.to_vec()).collect();
    let [l1, l2, l3] = &declaration.stretches;
    let derivatives = derivatives(
        declaration,
        model,
        &by_parameters,
        &|material| quote!(::piola::Material::gradient(#material, [#l1, #l2, #l3])),
    );
    let of_parameters = constraints(declaration, model, &model.constraints.clone());
    let of_domain = model.domain_constraints.clone();
    let of_domain = (!of_domain.is_empty()).then(|| {
        let constraints = constraints(declaration, model, &of_domain);
        quote! {
            #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
            fn domain_constraints(
                &self,
                [#l1, #l2, #l3]: [f64; 3],
            ) -> __p::Vec<__p::Constraint> {
                #constraints
            }
        }
    });
    quote! {
        #naming
        impl #bounds __p::Fittable for #name #arguments {
            fn values(&self) -> __p::Vec<__p::Vec<f64>> {
                ::std::vec![#(#values),*]
            }

            #with_values

            #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
            fn gradient_by_parameters(&self, [#l1, #l2, #l3]: [f64; 3]) -> __p::Vec<[f64; 3]> {
                use ::piola::Real;
                type R = f64;
                #derivatives
            }

            #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
            fn constraints(&self) -> __p::Vec<__p::Constraint> {
                #of_parameters
            }

            #of_domain
        }
    }
}

/// The method that rebuilds the material around functions with other values.
fn with_values(declaration: &Declaration) -> TokenStream {
    let values =
        read(declaration, &|name, _| quote!(::piola::Univariate::with_values(&self.#name, values.slice())?));
    quote! {
        fn with_values(&self, values: &[&[f64]]) -> __p::Result<Self, __p::MaterialError> {
            let mut values = __p::Values::of::<Self>(values)?;
            Self::new(#(#values),*)
        }
    }
}

/// Arrays of the expressions that belong to the parameter of each number among the parameters.
///
/// `of` writes the values whose derivatives these are, for a material. By the values of functions, and where
/// a formula would need φ‴, they are differences of such values.
fn derivatives(
    declaration: &Declaration,
    model: &mut Model,
    by_parameters: &[Vec<Id>],
    of: &dyn Fn(&Ident) -> TokenStream,
) -> TokenStream {
    let Slopes { groups, differences } = Slopes::new(&model.graph, declaration, by_parameters);
    let writer = Writer::new(declaration);
    let width = by_parameters.first().map_or(1, Vec::len);
    let mut program = |group: &Group| {
        let (statements, outputs) = writer.program(&model.program(&group.roots));
        let arrays: Vec<_> = outputs.chunks(width).map(|array| quote!([#(#array),*])).collect();
        (statements, arrays)
    };
    if let ([numbers @ Group { length: None, .. }], []) = (&groups[..], &differences[..]) {
        let (statements, arrays) = program(numbers);
        return quote!(#statements ::std::vec![#(#arrays),*]);
    }
    let derivatives = free_name(declaration, &["derivatives", "by_parameters"]);
    let groups = groups.iter().map(|group| {
        let (statements, arrays) = program(group);
        let places = group.parameters.iter().map(|&k| Literal::usize_unsuffixed(k));
        let pushed = quote!(#statements #(#derivatives[#places].push(#arrays);)*);
        // A program reads entry q of a list outside its sums, and sums have an index of their own.
        group.length.map_or(pushed.clone(), |length| {
            let (index, length) = (&writer.index, declaration.lengths[length].of_self());
            quote!(for #index in 0..#length { #pushed })
        })
    });
    let groups: Vec<_> = groups.collect();
    let differences = differences.iter().map(|&k| {
        let array = self::differences(declaration, &declaration.parameters[k], of);
        let k = Literal::usize_unsuffixed(k);
        quote!(#derivatives[#k] = #array;)
    });
    let [width, count] = [width, by_parameters.len()].map(Literal::usize_unsuffixed);
    quote! {
        let mut #derivatives: [__p::Vec<[f64; #width]>; #count] = [const { __p::Vec::new() }; #count];
        #(#groups)*
        #(#differences)*
        #derivatives.concat()
    }
}

/// The derivatives by each value of a parameter as differences.
fn differences(
    declaration: &Declaration,
    parameter: &Parameter,
    of: &dyn Fn(&Ident) -> TokenStream,
) -> TokenStream {
    let Parameter { name, kind, .. } = parameter;
    let values = free_name(declaration, &["values", "moved_values"]);
    let (begin, moved) = match kind {
        Kind::Number => (quote!(&[self.#name]), quote!(#values[0])),
        Kind::List(_) if declaration.is_vector(parameter) => (quote!(&self.#name), quote!(#values.to_vec())),
        Kind::List(_) => (quote!(&self.#name), quote!(::core::array::from_fn(|entry| #values[entry]))),
        Kind::Function(_) => (
            quote!(&::piola::Univariate::values(&self.#name)),
            quote!(::piola::Univariate::with_values(&self.#name, #values).ok()?),
        ),
    };
    let inversion = declaration.options.extend.is_some().then(|| quote!(inversion: __p::Inversion::Refuse,));
    let material = free_name(declaration, &["material", "moved_material"]);
    let results = of(&material);
    quote! {
        __p::by_values(#begin, |#values| {
            let #material = &Self { #name: #moved, #inversion ..::core::clone::Clone::clone(self) };
            Some(#results)
        })
    }
}

/// The constraints, one for each entry if they are on entries.
fn constraints(declaration: &Declaration, model: &mut Model, constraints: &[Constraint]) -> TokenStream {
    let (of_entries, of_numbers): (Vec<_>, Vec<_>) =
        constraints.iter().partition(|constraint| constraint.length.is_some());
    let writer = Writer::new(declaration);
    let of_numbers = if of_numbers.is_empty() {
        quote!(__p::Vec::new())
    } else {
        let limits = of_numbers.iter().map(|constraint| limit(&constraint.limit));
        let roots: Vec<_> = of_numbers.iter().map(|constraint| constraint.value).collect();
        let by_parameters = (0..declaration.parameters.len())
            .map(|k| of_numbers.iter().map(|constraint| constraint.by_parameters[k]).collect());
        let by_parameters: Vec<_> = by_parameters.collect();
        let program = model.program(&roots);
        let derivatives = derivatives(declaration, model, &by_parameters, &|material| {
            let (statements, outputs) = writer.with_material(material.clone()).program(&program);
            quote!({ #statements [#(#outputs),*] })
        });
        let (statements, outputs) = writer.program(&program);
        quote! {
            __p::Constraint::all([#(#limits),*], { #statements [#(#outputs),*] }, { #derivatives })
        }
    };
    let of_entries = of_entries.iter().map(|constraint| {
        let parameters: Vec<_> = (0..declaration.parameters.len())
            .filter(|&k| !model.graph.is_zero(constraint.by_parameters[k]))
            .collect();
        let slopes = parameters.iter().map(|&k| constraint.by_parameters[k]);
        let roots: Vec<_> = std::iter::once(constraint.value).chain(slopes).collect();
        let (statements, outputs) = writer.program(&model.program(&roots));
        let index = &writer.index;
        let slopes = parameters.iter().zip(&outputs[1..]).map(|(&k, slope)| {
            let is_list = declaration.parameters[k].length().is_some();
            let (k, entry) = (Literal::usize_unsuffixed(k), if is_list { quote!(#index) } else { quote!(0) });
            quote!((#k, #entry, #slope))
        });
        let (limit, value) = (limit(&constraint.limit), &outputs[0]);
        let length = constraint.length.map(|length| declaration.lengths[length].of_self());
        quote! {
            for #index in 0..#length {
                #statements
                constraints.push(__p::Constraint::of_entry(
                    #limit,
                    #value,
                    __p::Fittable::values(self),
                    &[#(#slopes),*],
                ));
            }
        }
    });
    let of_entries: Vec<_> = of_entries.collect();
    let uses_reals = (!constraints.is_empty()).then(|| {
        quote!(
            use ::piola::Real;
            type R = f64;
        )
    });
    if of_entries.is_empty() {
        return quote!(#uses_reals #of_numbers);
    }
    quote! {
        #uses_reals
        let mut constraints = #of_numbers;
        #(#of_entries)*
        constraints
    }
}

fn limit(limit: &Limit) -> TokenStream {
    match limit {
        Limit::Admissible(text) => quote!(__p::Limit::Admissible(__p::Borrowed(#text))),
        Limit::ShearModulus => quote!(__p::Limit::ShearModulus),
        Limit::BulkModulus => quote!(__p::Limit::BulkModulus),
        Limit::Domain(text) => quote!(__p::Limit::Domain(__p::Borrowed(#text))),
    }
}
