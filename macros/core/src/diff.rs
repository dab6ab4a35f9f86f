//! Partial derivatives with respect to a stretch.

use std::collections::HashMap;

use crate::expr::{Exponent, Graph, Id, Node, Stretch};
use crate::rational::Rational;

/// Derivatives, each computed once.
#[derive(Debug, Default)]
pub struct Differentiator {
    memo: HashMap<(Id, Stretch), Id>,
}

impl Differentiator {
    /// ∂e/∂λi.
    pub fn derivative(&mut self, graph: &mut Graph, e: Id, i: Stretch) -> Id {
        if let Some(&done) = self.memo.get(&(e, i)) {
            return done;
        }
        let result = self.rule(graph, e, i);
        self.memo.insert((e, i), result);
        result
    }

    fn rule(&mut self, graph: &mut Graph, e: Id, i: Stretch) -> Id {
        match graph.node(e).clone() {
            Node::Stretch(j) => graph.integer(i64::from(i == j)),
            Node::Linear { terms, .. } => {
                let terms: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.derivative(graph, term, i), c)).collect();
                graph.linear(Rational::ZERO, &terms)
            }
            // (Π bᵢ^eᵢ)′ = Σ eᵢ bᵢ^(eᵢ−1) bᵢ′ Π bⱼ^eⱼ. For other than whole exponents bᵢ^eᵢ is kept and divided by bᵢ,
            // which cancels against bᵢ′ where that is a product.
            Node::Product(factors) => {
                let mut terms = Vec::new();
                for (k, &(base, exponent)) in factors.iter().enumerate() {
                    let inner = self.derivative(graph, base, i);
                    if graph.is_zero(inner) {
                        continue;
                    }
                    let mut term = factors.clone();
                    match exponent.as_integer() {
                        Some(n) => term[k].1 = Exponent::integer(n - 1),
                        None => term.push((base, Exponent::integer(-1))),
                    }
                    term.extend([(graph.exponent_value(exponent), Exponent::ONE), (inner, Exponent::ONE)]);
                    terms.push(graph.product(&term));
                }
                graph.sum_of(&terms)
            }
            Node::Ln(a) => {
                let inner = self.derivative(graph, a, i);
                graph.div(inner, a)
            }
            Node::Exp(a) => {
                let inner = self.derivative(graph, a, i);
                graph.mul(e, inner)
            }
            Node::Function(f, order, a) => {
                let inner = self.derivative(graph, a, i);
                let outer = graph.leaf(Node::Function(f, order + 1, a));
                graph.mul(outer, inner)
            }
            Node::Sum(length, body) => {
                let inner = self.derivative(graph, body, i);
                graph.sum(length, inner)
            }
            Node::Extended(function, order, j) if i == j => {
                graph.leaf(Node::Extended(function, order + 1, j))
            }
            Node::Extended(..)
            | Node::Parameter(_)
            | Node::Entry(_)
            | Node::Float(_)
            | Node::Epsilon
            // What follows only arises after differentiation, in quotients, increments and lowered extensions.
            | Node::Strain(_)
            | Node::Above(_)
            | Node::Below(_)
            | Node::ShareAbove(..)
            | Node::ShareBelow(..)
            | Node::WhereNegative(..)
            | Node::LnQuotient(..)
            | Node::ExpQuotient(..)
            | Node::FunctionQuotient(..)
            | Node::PowerQuotient(..)
            | Node::PoleQuotient(..) => graph.integer(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpret::{Point, Value, evaluate};
    use crate::testing::expressions;

    /// The slope of finite differences: their error must fall as h².
    #[test]
    fn every_rule_is_the_slope_of_its_function() {
        for (name, mut graph, e) in expressions() {
            let derivative = Differentiator::default().derivative(&mut graph, e, 1);
            let at = |y: f64| Point { stretches: [1.3, y, 0.6], ..Point::default() };
            let value = |id, y| {
                let Value { value, .. } = evaluate(&graph, id, &at(y));
                value
            };
            let exact = value(derivative, 0.9);
            let error = |h: f64| ((value(e, 0.9 + h) - value(e, 0.9 - h)) / (2.0 * h) - exact).abs();
            let (coarse, fine) = (error(1e-2), error(1e-3));
            let is_slope = fine < 1e-12 || (80.0..120.0).contains(&(coarse / fine));
            assert!(is_slope, "{name}: {coarse:e} then {fine:e}");
        }
    }
}
