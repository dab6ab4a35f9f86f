//! Arguments that must not vanish: denominators, and those of logarithms, roots and real powers.

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};

/// An expression that must not be zero for another one to have a value.
#[derive(Clone, Copy)]
pub(crate) struct Argument {
    pub(crate) of: Id,
    /// `None` for a logarithm.
    pub(crate) exponent: Option<Exponent>,
}

impl Argument {
    /// The arguments in an expression that depend on the stretches.
    pub(crate) fn all(graph: &Graph, id: Id) -> Vec<Self> {
        let mut found = Vec::new();
        for id in graph.reachable(&[id]) {
            match graph.node(id) {
                Node::Apply(Function::Ln, of) => found.push(Self { of: *of, exponent: None }),
                Node::Product(factors) => found.extend(
                    factors
                        .iter()
                        .filter(|(_, exponent)| exponent.as_integer().is_none_or(|n| n < 0))
                        .map(|&(of, exponent)| Self { of, exponent: Some(exponent) }),
                ),
                _ => {}
            }
        }
        found.retain(|argument| graph.contains(argument.of, |node| matches!(node, Node::Stretch(_))));
        found
    }

    /// True if an expression is an argument in a part.
    pub(crate) fn is_in(graph: &Graph, part: Id, of: Id) -> bool {
        Self::all(graph, part).iter().any(|argument| argument.of == of)
    }

    /// The exponent of a power that is not whole, such as a root.
    pub(crate) fn real_exponent(&self) -> Option<Exponent> {
        self.exponent.filter(|exponent| exponent.as_integer().is_none())
    }
}
