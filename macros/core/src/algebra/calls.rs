//! Calls f(x) of functions that are parameters: an energy is defined where each f is at its x.

use crate::algebra::expr::{Function, Graph, Id, Node, ParameterIndex};

/// A call of a function that is a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call {
    /// The function.
    pub function: ParameterIndex,
    /// Its argument.
    pub argument: Id,
    /// A list whose entries, one by one, make the argument: it stands in a sum.
    pub list: Option<ParameterIndex>,
}

/// The calls in an expression, each once.
pub fn calls(graph: &Graph, e: Id) -> Vec<Call> {
    let order = graph.reachable(&[e]);
    let lists = graph.lists(&order);
    let call = |id: Id| match *graph.node(id) {
        Node::Apply(Function::Given(function, 0), argument) => {
            Some(Call { function, argument, list: lists[&id] })
        }
        _ => None,
    };
    order.into_iter().filter_map(call).collect()
}

#[cfg(test)]
mod tests {
    use proc_macro2::TokenStream;
    use quote::quote;

    use super::calls;
    use crate::analyse;

    /// The function and the list of each call, by their places among the parameters m, f, g.
    fn found(body: TokenStream) -> Vec<(usize, Option<usize>)> {
        let item = quote!(fn E<const N: usize>([x, y, z]: [f64; 3], m: [f64; N], f: Curve, g: Curve) -> f64 { #body });
        let (_, model) = analyse(quote!(prestressed), item).expect("an energy");
        calls(&model.graph, model.energy).into_iter().map(|call| (call.function, call.list)).collect()
    }

    #[test]
    fn calls_are_found_in_arguments_and_in_sums() {
        let body = quote!(f(g(I1)) + sum(|p| m[p] * f(m[p] * J)) + sum(|p| m[p]) * g(sum(|p| m[p]) * J));
        let mut found = found(body);
        found.sort_unstable();
        assert_eq!(found, [(1, None), (1, Some(0)), (2, None), (2, None)]);
    }
}
