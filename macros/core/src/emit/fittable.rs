//! The implementation of `Fittable`: the values of the parameters, and the derivatives of the gradient by them.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::writer::{Writer, free_name};
use super::{generics, naming};
use crate::algebra::expr::Length;
use crate::model::Model;
use crate::read::parse::{Declaration, Kind};

/// `impl Fittable`, where it is asked for.
pub(super) fn fittable(declaration: &Declaration, model: &mut Model) -> TokenStream {
    let Some(by_parameters) = model.by_parameters.clone() else { return TokenStream::new() };
    let name = &declaration.name;
    let (bounds, arguments) = generics(declaration);
    let naming = naming(declaration);
    let values = declaration.parameters.iter().map(|parameter| {
        let name = &parameter.name;
        match parameter.kind {
            Kind::List(_) => quote!(self.#name.to_vec()),
            Kind::Number | Kind::Function(_) => quote!(::std::vec![self.#name]),
        }
    });

    let writer = Writer::new(declaration);
    let derivatives = free_name(declaration, &["derivatives", "by_parameters"]);
    // Numbers together, and lists of one length together: each has a program of its own.
    let mut program = |length: Option<Length>| {
        let members: Vec<usize> =
            (0..by_parameters.len()).filter(|&k| declaration.parameters[k].length() == length).collect();
        let roots: Vec<_> = members.iter().flat_map(|&k| by_parameters[k]).collect();
        let (statements, outputs) = writer.program(&model.program(&roots));
        let triples = members.iter().zip(outputs.chunks(3)).map(|(&k, triple)| {
            let k = Literal::usize_unsuffixed(k);
            quote!(#derivatives[#k].push([#(#triple),*]);)
        });
        quote!(#statements #(#triples)*)
    };
    let numbers = program(None);
    // A program reads entry q of a list outside its sums, and sums have an index of their own.
    let lists = (0..declaration.lengths.len()).map(|length| {
        let entries = program(Some(length));
        let (index, length) = (&writer.index, &declaration.lengths[length]);
        quote!(for #index in 0..#length { #entries })
    });
    let lists: Vec<_> = lists.collect();
    let [l1, l2, l3] = &declaration.stretches;
    let count = Literal::usize_unsuffixed(by_parameters.len());
    quote! {
        #naming
        impl #bounds ::piola::material::Fittable for #name #arguments {
            fn values(&self) -> ::std::vec::Vec<::std::vec::Vec<f64>> {
                ::std::vec![#(#values),*]
            }

            #[allow(unused_imports, unused_mut, unused_variables, clippy::all)]
            fn gradient_by_parameters(&self, [#l1, #l2, #l3]: [f64; 3]) -> ::std::vec::Vec<[f64; 3]> {
                use ::piola::Real;
                type R = f64;
                let mut #derivatives: [::std::vec::Vec<[f64; 3]>; #count] = [const { ::std::vec::Vec::new() }; #count];
                #numbers
                #(#lists)*
                #derivatives.concat()
            }
        }
    }
}
