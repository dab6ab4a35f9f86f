//! Degrees of expressions: the exponent n of the growth t^n when all stretches are scaled by t.

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};

/// The degree for t → 0 and for t → ∞.
pub(super) type Degree = [f64; 2];

/// Degrees of expressions, each found once.
#[derive(Debug, Default)]
pub(super) struct Degrees {
    memo: FxHashMap<Id, Degree>,
}

impl Degrees {
    pub(super) fn of(&mut self, graph: &Graph, id: Id) -> Degree {
        once!(self.memo, id, self.rule(graph, id))
    }

    fn rule(&mut self, graph: &Graph, id: Id) -> Degree {
        match graph.node(id) {
            Node::Stretch(_) => [1.0, 1.0],
            Node::Linear { constant, terms } => {
                let start = if constant.is_zero() { [f64::INFINITY, f64::NEG_INFINITY] } else { [0.0; 2] };
                let degrees = terms.iter().fold(start, |[low, high], &(term, _)| {
                    let [term_low, term_high] = self.of(graph, term);
                    [low.min(term_low), high.max(term_high)]
                });
                if degrees[0] <= degrees[1] { degrees } else { [0.0; 2] }
            }
            Node::Product(factors) => factors
                .iter()
                .map(|&(base, exponent)| power(self.of(graph, base), exponent))
                .fold([0.0; 2], sum),
            Node::Sum(_, body) => self.of(graph, *body),
            Node::Quotient(Function::Ln, a, _) => power(self.of(graph, *a), Exponent::integer(-1)),
            Node::Quotient(Function::Power(exponent), a, _) => {
                let degree = self.of(graph, *a);
                sum(power(degree, *exponent), power(degree, Exponent::integer(-1)))
            }
            Node::PoleQuotient(a, b) => {
                sum(self.of(graph, *a), power(self.of(graph, *b), Exponent::integer(-1)))
            }
            Node::Apply(Function::WholePower(_, order), base) => {
                power(self.of(graph, *base), Exponent::integer(-i64::from(*order)))
            }
            Node::Quotient(Function::WholePower(_, order), base, _) => {
                power(self.of(graph, *base), Exponent::integer(-1 - i64::from(*order)))
            }
            // max(λ, ε) and powers of it.
            Node::Above(_) => [0.0, 1.0],
            // Logarithms, exponentials, parameters, and bounded functions of a stretch.
            _ => [0.0; 2],
        }
    }
}

/// The degree of a power. An exponent that is a parameter is unknown here, and counts by its rational part.
pub(super) fn power(degrees: Degree, exponent: Exponent) -> Degree {
    degrees.map(|degree| degree * exponent.rational.to_f64())
}

pub(super) fn sum(a: Degree, b: Degree) -> Degree {
    [a[0] + b[0], a[1] + b[1]]
}
