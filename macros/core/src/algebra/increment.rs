//! Differences from rest without cancellation, for strains far below one.
//!
//! With the principal strains sk = λk − 1 and e₁ the value of e at λ1 = λ2 = λ3 = 1, let Δe = e − e₁:
//!
//! | e     | Δe                                        |
//! |-------|-------------------------------------------|
//! | λk    | sk                                        |
//! | f + g | Δf + Δg                                   |
//! | f g   | Δf g + f₁ Δg                              |
//! | φ(f)  | φ[f, f₁] Δf, φ\[a, b\] as in [`quotient`] |
//!
//! and zero for expressions without stretches. A product with a factor that vanishes at rest is its own
//! difference, in which that factor, and what else vanishes there, is written as one. No rule subtracts, so
//! each term of Δψi is as accurate, relative to itself, as the strains are. At a rest state free of stress ψi
//! is Δψi: the constants that cancel there have dropped out.
//!
//! It is the sum over k of sk times the quotient of e in λk and 1, with the stretches before k already at 1.
//!
//! [`quotient`]: crate::algebra::quotient

use rustc_hash::FxHashMap;

use crate::algebra::divided;
use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// Differences from rest, each computed once.
#[derive(Debug, Default)]
pub struct Increments {
    memo: FxHashMap<Id, Id>,
    /// Expressions whose parts that vanish at rest are differences.
    accurate: FxHashMap<Id, Id>,
}

impl Increments {
    /// The difference Δe of an expression before its extensions are written out.
    pub fn increment(&mut self, graph: &mut Graph, e: Id) -> Id {
        once!(self.memo, e, self.rule(graph, e))
    }

    fn rule(&mut self, graph: &mut Graph, e: Id) -> Id {
        match graph.node(e).clone() {
            Node::Stretch(k) => graph.leaf(Node::Strain(k)),
            Node::Linear { terms, .. } => {
                let terms: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.increment(graph, term), c)).collect();
                graph.linear(Rational::ZERO, &terms)
            }
            Node::Sum(length, body) => {
                let inner = self.increment(graph, body);
                graph.sum(length, inner)
            }
            Node::Excess(squares, _) => {
                let squares = self.increment(graph, squares);
                graph.excess(squares, squares)
            }
            Node::Accurate(value, _) => self.increment(graph, value),
            Node::Product(factors) => self.product_rule(graph, &factors),
            Node::Apply(function, a) => {
                let is_whole_power = matches!(function, Function::WholePower(..));
                let accurate = if is_whole_power { self.accurate(graph, a) } else { a };
                self.chain_rule(graph, function, a, accurate)
            }
            Node::Parameter(_) | Node::Entry(_) | Node::Float(_) => graph.integer(0),
            // No other nodes arise from differentiation inside the domain; NaN would be noticed.
            _ => graph.leaf(Node::Float(f64::NAN.to_bits())),
        }
    }

    fn product_rule(&mut self, graph: &mut Graph, factors: &[(Id, Exponent)]) -> Id {
        // A product with a factor that vanishes at rest is its own difference, and so is a power of what
        // does. Of real powers, only positive ones are taken of what vanishes.
        let vanishes = factors.iter().any(|&(base, exponent)| {
            exponent.as_integer().is_none_or(|n| n > 0) && is_zero_at_rest(graph, base)
        });
        if vanishes {
            let factors: Vec<_> = factors.iter().map(|&(base, e)| (self.accurate(graph, base), e)).collect();
            return graph.product(&factors);
        }
        match *factors {
            [] => graph.integer(0),
            [(base, exponent)] => self.chain_rule(graph, Function::Power(exponent), base, base),
            [(base, exponent), ref others @ ..] => {
                let (f, g) = (graph.power(base, exponent), graph.product(others));
                let (df, dg) = (self.increment(graph, f), self.increment(graph, g));
                let f_at_rest = substitute_rest(graph, f);
                // Only its exponent decides whether a whole power vanishes at rest.
                let is_whole_power = |node: &Node| matches!(node, Node::Apply(Function::WholePower(..), _));
                let has_whole_powers = graph.contains(g, is_whole_power);
                let g = if has_whole_powers { self.accurate(graph, g) } else { g };
                let (left, right) = (graph.mul(df, g), graph.mul(f_at_rest, dg));
                graph.add(left, right)
            }
        }
    }

    /// An expression with its parts that vanish at rest written as differences.
    fn accurate(&mut self, graph: &mut Graph, e: Id) -> Id {
        if is_zero_at_rest(graph, e) {
            return self.increment(graph, e);
        }
        once!(self.accurate, e, graph.map_children(e, &mut |graph, child| self.accurate(graph, child)))
    }

    /// φ\[a, a₁\] Δa, with an accurate form of a in the divided difference.
    fn chain_rule(&mut self, graph: &mut Graph, function: Function, a: Id, accurate: Id) -> Id {
        let inner = self.increment(graph, a);
        if graph.is_zero(inner) {
            return inner;
        }
        let b = substitute_rest(graph, a);
        let outer = divided::quotient(graph, function, accurate, b);
        graph.mul(outer, inner)
    }
}

/// True if an expression that depends on the stretches is zero at rest by its form.
fn is_zero_at_rest(graph: &mut Graph, e: Id) -> bool {
    let at_rest = substitute_rest(graph, e);
    at_rest != e && graph.is_zero(at_rest)
}

/// The value e₁ at rest.
pub fn substitute_rest(graph: &mut Graph, e: Id) -> Id {
    let one = graph.integer(1);
    graph.substitute(e, [one; 3])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::interpret::{Point, evaluate};

    #[test]
    fn powers_of_what_vanishes_at_rest_have_no_factor_of_stretches() {
        // (√x − √y)² and (√x − √y)^(3/2): strains of 2⁻⁴⁰ are exact, and √x − √y by stretches is not.
        let mut graph = Graph::default();
        let of_two = |n: i128| Exponent::rational(Rational::new(n, 2).unwrap());
        let [x, y] = [0, 1].map(|k| graph.stretch(k)).map(|x| graph.power(x, of_two(1)));
        let difference = graph.sub(x, y);
        let s = 2f64.powi(-40);
        for exponent in [4, 3] {
            let power = graph.power(difference, of_two(exponent));
            let increment = Increments::default().increment(&mut graph, power);
            let point = Point { stretches: [1.0 + s, 1.0 - s, 1.0], ..Point::default() };
            let found = evaluate(&graph, increment, &point).value;
            // √(1 + s) − √(1 − s) = s + s³/8 + …
            let expected = s.powf(exponent as f64 / 2.0);
            assert!((found / expected - 1.0).abs() <= 8.0 * f64::EPSILON, "{found:e} for {expected:e}");
        }
    }
}
