//! The part of the domain of an energy that functions among the parameters decide.

use proc_macro2::TokenStream;
use quote::quote;

use super::writer::{Writer, free_name};
use crate::algebra::calls::{Call, calls};
use crate::algebra::expr::Id;
use crate::model::Model;
use crate::read::parse::Declaration;

/// The functions that narrow the domain, as in `where f and g are defined`; empty without functions.
pub(super) fn documentation(declaration: &Declaration) -> String {
    let functions = declaration.parameters.iter().filter(|parameter| parameter.is_function());
    let names: Vec<_> = functions.map(|parameter| parameter.name.to_string()).collect();
    match &names[..] {
        [] => String::new(),
        [name] => format!("where {name} is defined"),
        [names @ .., last] => format!("where {} and {last} are defined", names.join(", ")),
    }
}

/// A block that evaluates to true if every function in an energy is defined at its argument; `None` without
/// functions.
pub(super) fn defined(
    declaration: &Declaration,
    model: &mut Model,
    writer: &Writer<'_>,
    energy: Id,
) -> Option<TokenStream> {
    let calls = calls(&model.graph, energy);
    let length = |call: &Call| call.list.and_then(|k| declaration.parameters[k].length());
    let mut of = |calls: Vec<&Call>| {
        let arguments: Vec<_> = calls.iter().map(|call| call.argument).collect();
        let (statements, arguments) = writer.program(&model.program(&arguments));
        let admitted = calls.iter().zip(arguments).map(|(call, argument)| {
            let name = &declaration.parameters[call.function].name;
            quote!(::piola::Univariate::admits(&self.#name, #argument))
        });
        (statements, admitted.reduce(|a, b| quote!(#a & #b)))
    };
    let (statements, outside) = of(calls.iter().filter(|call| length(call).is_none()).collect());
    let all = free_name(declaration, &["all", "all_defined"]);
    let loops = (0..declaration.lengths.len()).filter_map(|k| {
        let (statements, entries) = of(calls.iter().filter(|call| length(call) == Some(k)).collect());
        let (index, length) = (&writer.index, declaration.lengths[k].of_self());
        entries.map(|entries| {
            quote! {
                for #index in 0..#length {
                    #statements
                    #all = #all & #entries;
                }
            }
        })
    });
    let loops: Vec<_> = loops.collect();
    if loops.is_empty() {
        return outside.map(|outside| quote!({ #statements #outside }));
    }
    let outside = outside.unwrap_or_else(|| quote!(__p::Mask::splat(true)));
    Some(quote!({
        #statements
        let mut #all: R::Mask = #outside;
        #(#loops)*
        #all
    }))
}
