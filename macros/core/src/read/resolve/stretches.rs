//! Sums over the three stretches, `sum(|l| …)`, and over their three pairs, `sum(|a, b| …)`.
//!
//! The body is read once for each stretch or pair, with the names of the closure bound to them, so that the
//! graph holds what would be there if the terms had been written out.

use syn::{Expr, ExprCall, ExprClosure, Ident, Pat};

use super::{Resolver, Scope};
use crate::algebra::expr::{Id, Node, Stretch};
use crate::algebra::simplify::join_sums;
use crate::read::parse::{identifiers, indexed_lists};
use crate::read::spelling::taken;
use quote::ToTokens;

/// The pairs of stretches, in the order in which papers write I2.
pub(super) const PAIRS: [[Stretch; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

/// The closure of a sum, `|l| …`, with its names.
pub(super) struct Summand<'a> {
    pub(super) names: Vec<&'a Ident>,
    pub(super) body: &'a Expr,
}

impl<'a> Summand<'a> {
    /// The only argument of a call, if it is a closure of plain names.
    pub(super) fn of(call: &'a ExprCall) -> Option<Self> {
        let Some(Expr::Closure(ExprClosure { inputs, body, .. })) = call.args.first() else { return None };
        let name = |pattern: &'a Pat| match pattern {
            Pat::Ident(name) => Some(&name.ident),
            _ => None,
        };
        let names = inputs.iter().map(name).collect::<Option<Vec<_>>>()?;
        (call.args.len() == 1).then_some(Self { names, body })
    }

    /// True if the name stands for stretches: it is read as a number and never inside the brackets of a list.
    pub(super) fn is_over_stretches(&self) -> bool {
        let [name] = self.names[..] else { return false };
        let body = self.body.to_token_stream();
        identifiers(body.clone()).contains(name)
            && !indexed_lists(body).iter().any(|(list, index)| index == name || list == name)
    }
}

impl Resolver<'_> {
    /// Σ f(λi), or Σ f(λi, λj) with two names; each term has its own stretches.
    pub(super) fn sum_over<const N: usize>(
        &mut self,
        names: [&Ident; N],
        body: &Expr,
        places: [[Stretch; N]; 3],
    ) -> Id {
        for (k, name) in names.iter().enumerate() {
            let is_read = identifiers(body.to_token_stream()).contains(name);
            if self.is_taken(name) || names[..k].contains(name) {
                return self.mistake(name, &taken(name));
            }
            if !is_read {
                return self.mistake(name, &format!("`{name}` is not used: remove it"));
            }
        }
        // The first term reports the mistakes of all, and a message about the sum shows its part.
        let first = self.term(&names, body, &places[0]);
        if self.is_unknown(first) {
            return first;
        }
        let nodes = std::mem::take(&mut self.nodes);
        let others = [&places[1], &places[2]].map(|at| self.term(&names, body, at));
        self.nodes = nodes;
        let sum = self.graph.sum_of(&[first, others[0], others[1]]);
        join_sums(self.graph, sum)
    }

    /// A stretch; by invariants, its replacement.
    pub(super) fn stretch(&mut self, i: Stretch) -> Id {
        match self.scope {
            Scope::Invariants => self.graph.leaf(Node::Strain(i)),
            _ => self.graph.stretch(i),
        }
    }

    /// The body with its names bound to stretches.
    fn term(&mut self, names: &[&Ident], body: &Expr, at: &[Stretch]) -> Id {
        for (name, &i) in names.iter().zip(at) {
            let stretch = self.stretch(i);
            self.bindings.insert(name.to_string(), stretch);
        }
        let value = self.expression(body);
        for name in names {
            self.bindings.remove(&name.to_string());
        }
        value
    }
}
