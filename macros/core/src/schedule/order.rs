//! In which order the factors of a product are multiplied: such that no part of it leaves the range of the numbers when the
//! product does not.
//!
//! The degree of an expression is its exponent t^n when all stretches are scaled by t. A product of high degree leaves the
//! range soonest, so factors are taken such that the degree of what has been multiplied stays near zero. With I1 y^(−2/3)
//! z^(−2/3) x^(−8/3), of degree −2, the powers of stretches alone would be of degree −4.

use std::collections::HashMap;

use crate::expr::{Exponent, Graph, Id, Node};
use crate::rational::Rational;

/// Degrees for t → 0 and for t → ∞.
type Degrees = [f64; 2];

/// Degrees of expressions, each found once.
#[derive(Default)]
pub(super) struct Order {
    memo: HashMap<Id, Degrees>,
}

impl Order {
    /// The factors in the order of multiplication, parameters first.
    pub(super) fn balanced(&mut self, graph: &Graph, factors: &[(Id, Exponent)]) -> Vec<(Id, Exponent)> {
        let mut left: Vec<(Degrees, (Id, Exponent))> = Vec::new();
        for &(base, exponent) in factors {
            for part in parts(exponent) {
                left.push((power(self.degrees(graph, base), part), (base, part)));
            }
        }
        let mut order = Vec::new();
        let mut total = [0.0; 2];
        while !left.is_empty() {
            let size = |[low, high]: Degrees| (total[0] + low).abs() + (total[1] + high).abs();
            // The first of the smallest.
            let mut best = 0;
            for k in 1..left.len() {
                if size(left[k].0) < size(left[best].0) {
                    best = k;
                }
            }
            let (degrees, factor) = left.remove(best);
            total = sum(total, degrees);
            order.push(factor);
        }
        order
    }

    fn degrees(&mut self, graph: &Graph, id: Id) -> Degrees {
        if let Some(&done) = self.memo.get(&id) {
            return done;
        }
        let result = self.rule(graph, id);
        self.memo.insert(id, result);
        result
    }

    fn rule(&mut self, graph: &Graph, id: Id) -> Degrees {
        match graph.node(id) {
            Node::Stretch(_) => [1.0, 1.0],
            Node::Linear { constant, terms } => {
                let start = if constant.is_zero() { [f64::INFINITY, f64::NEG_INFINITY] } else { [0.0; 2] };
                let degrees = terms.iter().fold(start, |[low, high], &(term, _)| {
                    let [term_low, term_high] = self.degrees(graph, term);
                    [low.min(term_low), high.max(term_high)]
                });
                if degrees[0] <= degrees[1] { degrees } else { [0.0; 2] }
            }
            Node::Product(factors) => factors
                .iter()
                .map(|&(base, exponent)| power(self.degrees(graph, base), exponent))
                .fold([0.0; 2], sum),
            Node::Sum(_, body) => self.degrees(graph, *body),
            Node::LnQuotient(a, _) => power(self.degrees(graph, *a), Exponent::integer(-1)),
            Node::PowerQuotient(a, _, exponent) => {
                let [a, power] = [Exponent::integer(1), *exponent].map(|e| power(self.degrees(graph, *a), e));
                [power[0] - a[0], power[1] - a[1]]
            }
            Node::PoleQuotient(a, b) => {
                let [a, b] = [*a, *b].map(|id| self.degrees(graph, id));
                [a[0] - b[0], a[1] - b[1]]
            }
            // max(λ, ε) and powers of it.
            Node::Above(_) => [0.0, 1.0],
            // Logarithms, exponentials, parameters, and what of a stretch is bounded.
            _ => [0.0; 2],
        }
    }
}

/// x^(−7/3) may leave the range where x^(−1/3) and x^(−1) do not.
fn parts(exponent: Exponent) -> Vec<Exponent> {
    let Exponent { real, rational } = exponent;
    let Ok(mut whole) = i64::try_from(rational.numerator() / rational.denominator()) else {
        return vec![exponent];
    };
    let fraction = rational.checked_add(Rational::integer(-whole));
    let (None, Some(fraction)) = (real, fraction) else { return vec![exponent] };
    let mut parts = Vec::new();
    if !fraction.is_zero() {
        parts.push(Exponent::rational(fraction));
    }
    while whole != 0 {
        let part = whole.signum();
        parts.push(Exponent::integer(part));
        whole -= part;
    }
    parts
}

/// A real exponent is unknown here and counts by its rational part.
fn power(degrees: Degrees, exponent: Exponent) -> Degrees {
    degrees.map(|degree| degree * exponent.rational.to_f64())
}

fn sum(a: Degrees, b: Degrees) -> Degrees {
    [a[0] + b[0], a[1] + b[1]]
}
