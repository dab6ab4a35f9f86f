//! Derivatives of the stress by the parameters, which a fit of these to measurements follows.
//!
//! A number is a variable like a stretch. The entry q of a list m occurs in sums T = Σₚ b(mₚ, …), wherever these stand, and
//! sums may stand in the terms of others. With ∂e/∂T the derivative by the whole sum as one variable, and b differentiated with
//! whole sums inside it constant,
//!
//! ```text
//! ∂e/∂m_q = Σ_T ∂e/∂T · ∂b/∂m (m_q, …)     over all sums T in e
//! ```
//!
//! The factor on the right has an entry outside any sum: [`Node::Entry`] there is entry q, for whichever q is asked. The factor
//! on the left has none, so that an entry inside a sum is never mistaken for one outside.

use crate::diff::Differentiator;
use crate::expr::{Graph, Id, Node};
use crate::parse::{Declaration, Kind};
use crate::simplify::simplify;

/// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each parameter p, from ψ1, ψ2, ψ3; of a list for its entry q.
pub fn by_parameters(graph: &mut Graph, declaration: &Declaration, gradient: [Id; 3]) -> Vec<[Id; 3]> {
    let mut d = Differentiator::default();
    let mut all = Vec::new();
    for (k, parameter) in declaration.parameters.iter().enumerate() {
        all.push(gradient.map(|stress| {
            let derivative = match parameter.kind {
                Kind::List(_) => by_entry(&mut d, graph, stress, k),
                Kind::Number | Kind::Function(_) => {
                    let number = graph.leaf(Node::Parameter(k));
                    d.derivative(graph, stress, number)
                }
            };
            simplify(graph, derivative)
        }));
    }
    all
}

/// ∂e/∂m_q of a list m.
fn by_entry(d: &mut Differentiator, graph: &mut Graph, e: Id, list: usize) -> Id {
    let entry = graph.leaf(Node::Entry(list));
    let mut terms = Vec::new();
    for sum in graph.reachable(&[e]) {
        let Node::Sum(_, body) = *graph.node(sum) else { continue };
        let inner = d.derivative(graph, body, entry);
        if !graph.is_zero(inner) {
            let outer = d.derivative(graph, e, sum);
            terms.push(graph.mul(outer, inner));
        }
    }
    graph.sum_of(&terms)
}
