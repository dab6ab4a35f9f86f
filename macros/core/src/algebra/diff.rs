//! Partial derivatives.
//!
//! The variable is a stretch, a parameter, the current entry of a list, or a whole sum over lists: everything
//! else is constant. An entry belongs to the sum around it, so one outside a sum is not a variable of the
//! expressions inside one: see [`crate::algebra::by_parameters`].

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node, Stretch};
use crate::algebra::rational::Rational;
use crate::algebra::simplify::simplify;

/// Derivatives, each computed once.
#[derive(Debug, Default)]
pub struct Differentiator {
    memo: FxHashMap<(Id, Id), Id>,
    /// The only expressions that may depend on the variable, if that is known.
    within: Option<FxHashSet<Id>>,
}

impl Differentiator {
    /// Derivatives by variables on which only these expressions may depend: others are skipped.
    #[must_use]
    pub fn within(expressions: FxHashSet<Id>) -> Self {
        Self { memo: FxHashMap::default(), within: Some(expressions) }
    }

    fn may_depend(&self, e: Id) -> bool {
        self.within.as_ref().is_none_or(|within| within.contains(&e))
    }

    /// The derivative ∂e/∂v.
    pub fn derivative(&mut self, graph: &mut Graph, e: Id, v: Id) -> Id {
        if !self.may_depend(e) || graph.is_full() {
            return graph.integer(0);
        }
        once!(self.memo, (e, v), if e == v { graph.integer(1) } else { self.rule(graph, e, v) })
    }

    /// The derivative ∂e/∂λi.
    pub fn by_stretch(&mut self, graph: &mut Graph, e: Id, i: Stretch) -> Id {
        let stretch = graph.stretch(i);
        self.derivative(graph, e, stretch)
    }

    fn rule(&mut self, graph: &mut Graph, e: Id, v: Id) -> Id {
        match graph.node(e).clone() {
            Node::Linear { terms, .. } => {
                let terms: Vec<_> = terms.into_iter().filter(|&(term, _)| self.may_depend(term)).collect();
                let terms: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.derivative(graph, term, v), c)).collect();
                graph.linear(Rational::ZERO, &terms)
            }
            // (Π bᵢ^eᵢ)′ = Σ (eᵢ bᵢ^(eᵢ−1) bᵢ′ + bᵢ^eᵢ ln bᵢ eᵢ′) Π bⱼ^eⱼ. Unless its exponent is whole,
            // bᵢ^eᵢ is kept and divided by bᵢ, which cancels against bᵢ′ where that is a product.
            Node::Product(factors) => {
                let mut terms = Vec::new();
                for (k, &(base, exponent)) in factors.iter().enumerate() {
                    let inner = self.derivative(graph, base, v);
                    if !graph.is_zero(inner) {
                        let mut term = factors.clone();
                        match exponent.as_integer() {
                            Some(n) => term[k].1 = Exponent::integer(n - 1),
                            None => term.push((base, Exponent::integer(-1))),
                        }
                        term.extend([
                            (graph.exponent_value(exponent), Exponent::ONE),
                            (inner, Exponent::ONE),
                        ]);
                        terms.push(graph.product(&term));
                    }
                    if let Some(real) = exponent.real {
                        let slope = self.derivative(graph, real, v);
                        if !graph.is_zero(slope) {
                            let ln = ln_beside_power(graph, base);
                            terms.push(graph.product_of(&[e, ln, slope]));
                        }
                    }
                }
                graph.sum_of(&terms)
            }
            // (ln Π bᵢ^eᵢ)′ = Σ (ln bᵢ^eᵢ)′: a product may leave the range of numbers where its parts do not.
            Node::Apply(Function::Ln, a) => match graph.node(a).clone() {
                Node::Product(factors) if factors.len() > 1 => {
                    let terms = factors.into_iter().map(|(base, exponent)| {
                        let factor = graph.power(base, exponent);
                        let inner = self.derivative(graph, factor, v);
                        graph.div(inner, factor)
                    });
                    let terms: Vec<_> = terms.collect();
                    graph.sum_of(&terms)
                }
                _ => {
                    let inner = self.derivative(graph, a, v);
                    graph.div(inner, a)
                }
            },
            Node::Apply(Function::Exp, a) => self.chain_rule(graph, a, v, |_| e),
            Node::Excess(squares, _) => self.derivative(graph, squares, v),
            Node::Accurate(_, written) => self.derivative(graph, written, v),
            Node::Apply(Function::Elementary(function), a) => {
                self.chain_rule(graph, a, v, |graph| function.derivative(graph, a))
            }
            Node::Apply(Function::Given(f, order), a) => {
                let inner = self.derivative(graph, a, v);
                let outer = graph.apply(Function::Given(f, order + 1), a);
                graph.mul(outer, inner)
            }
            Node::Apply(Function::WholePower(n, order), base) => {
                self.chain_rule(graph, base, v, |graph| graph.apply(Function::WholePower(n, order + 1), base))
            }
            // An entry in the body differs from one outside.
            Node::Sum(..) if matches!(graph.node(v), Node::Entry(_)) => graph.integer(0),
            Node::Sum(length, body) => {
                let inner = self.derivative(graph, body, v);
                graph.sum(length, inner)
            }
            Node::Extended(function, order, i) => match *graph.node(v) {
                Node::Stretch(j) if i == j => graph.leaf(Node::Extended(function, order + 1, i)),
                Node::Stretch(_) => graph.integer(0),
                // Extended powers are never differentiated by their exponents; NaN would be noticed.
                _ if matches!(function, Function::Power(Exponent { real: Some(_), .. })) => {
                    graph.leaf(Node::Float(f64::NAN.to_bits()))
                }
                _ => graph.integer(0),
            },
            Node::Stretch(_)
            | Node::Parameter(_)
            | Node::Entry(_)
            | Node::Float(_)
            | Node::Epsilon
            // Powers are factors of products. The nodes below only arise after differentiation, in quotients,
            // increments and lowered extensions.
            | Node::Apply(Function::Power(_), _)
            | Node::Strain(_)
            | Node::Above(_)
            | Node::Below(_)
            | Node::ShareAbove(..)
            | Node::ShareBelow(..)
            | Node::WhereNegative(..)
            | Node::Quotient(..)
            | Node::PoleQuotient(..) => graph.integer(0),
        }
    }

    fn chain_rule(&mut self, graph: &mut Graph, a: Id, v: Id, outer: impl FnOnce(&mut Graph) -> Id) -> Id {
        let inner = self.derivative(graph, a, v);
        if graph.is_zero(inner) {
            return inner;
        }
        let outer = outer(graph);
        graph.mul(outer, inner)
    }
}

/// ψ1, ψ2, ψ3 and ψ11, ψ22, ψ33, ψ12, ψ13, ψ23 of an energy, simplified.
pub fn derivatives(graph: &mut Graph, energy: Id) -> ([Id; 3], [Id; 6]) {
    let mut d = Differentiator::default();
    let mut derivative = |of, k| {
        let derivative = d.by_stretch(graph, of, k);
        simplify(graph, derivative)
    };
    let gradient = [0, 1, 2].map(|k| derivative(energy, k));
    let hessian = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| derivative(gradient[i], j));
    (gradient, hessian)
}

/// The factor ln b of b^r. Where b vanishes, as I1 − 3 does at rest, b^r ln b is 0 for r > 0, not 0 · (−∞).
fn ln_beside_power(graph: &mut Graph, base: Id) -> Id {
    if !may_vanish(graph, base) {
        return graph.ln(base);
    }
    let smallest = graph.leaf(Node::Float(f64::MIN_POSITIVE.to_bits()));
    let above = graph.sub(base, smallest);
    let positive = graph.leaf(Node::WhereNegative(above, smallest, base));
    graph.ln(positive)
}

/// True if a base of real powers, which is never negative, may be zero inside a domain: only sums may.
fn may_vanish(graph: &Graph, base: Id) -> bool {
    match graph.node(base) {
        Node::Product(factors) => factors.iter().any(|&(factor, _)| may_vanish(graph, factor)),
        Node::Linear { terms, .. } => !terms.is_empty(),
        Node::Stretch(_) | Node::Parameter(_) | Node::Entry(_) | Node::Float(_) => false,
        Node::Apply(Function::Exp, _) | Node::Excess(..) => false,
        _ => true,
    }
}
