//! Energies beyond their domain: ln λ and real or negative powers of a stretch continue below ε as
//! polynomials.
//!
//! The rewriting happens before differentiation: ln J becomes Σ ln λi and J^r becomes Π λi^r, then each φ(λ)
//! becomes [`Node::Extended`]. With w = max(λ, ε) and d = λ − w, which is zero above ε and exact below,
//!
//! ```text
//! φ(w) + φ′(w) d + ½ φ″(w) d²     and its derivatives     φ′(w) + φ″(w) d,     φ″(w)
//! ```
//!
//! are the function and its polynomial in one formula without a branch: [`lower`] puts it in place of
//! `Extended` when all derivatives and quotients have been taken.
//!
//! A function of J itself is never extended: F = 0 would become a stable minimum.

use rustc_hash::FxHashMap;

use crate::algebra::divided::quotient;
use crate::algebra::expr::{Exponent, Function, Graph, Id, Node, Stretch};
use crate::algebra::rational::Rational;
use crate::algebra::volume::{Purpose, rewrite, separate};

/// The energy with its logarithms and real or negative powers of stretches extended.
pub fn extend(graph: &mut Graph, energy: Id) -> Id {
    let separated = separate(graph, energy, Purpose::Extension);
    rewrite(graph, separated, &mut FxHashMap::default(), &extend_node)
}

/// The expression with its extended functions written out; `memo` keeps the results for the same graph.
pub fn lower(graph: &mut Graph, e: Id, memo: &mut FxHashMap<Id, Id>) -> Id {
    rewrite(graph, e, memo, &|graph, id| match *graph.node(id) {
        Node::Extended(function, order, i) => Some(polynomial(graph, function, order, i)),
        _ => None,
    })
}

fn extend_node(graph: &mut Graph, id: Id) -> Option<Id> {
    match graph.node(id).clone() {
        Node::Apply(Function::Ln, a) => match *graph.node(a) {
            Node::Stretch(i) => Some(graph.leaf(Node::Extended(Function::Ln, 0, i))),
            _ => None,
        },
        Node::Product(factors) => {
            let mut product = Vec::new();
            for (base, exponent) in factors {
                product.push(match *graph.node(base) {
                    Node::Stretch(i) if exponent.as_integer().is_none_or(|n| n < 0) => {
                        (graph.leaf(Node::Extended(Function::Power(exponent), 0, i)), Exponent::ONE)
                    }
                    _ => (rewrite(graph, base, &mut FxHashMap::default(), &extend_node), exponent),
                });
            }
            Some(graph.product(&product))
        }
        _ => None,
    }
}

fn polynomial(graph: &mut Graph, function: Function, order: u8, i: Stretch) -> Id {
    let (w, d) = (graph.leaf(Node::Above(i)), graph.leaf(Node::Below(i)));
    let mut sum = derivative(graph, function, order, w);
    let mut factor = Rational::ONE;
    for k in 1..=2u8.saturating_sub(order) {
        let slope = derivative(graph, function, order + k, w);
        let power = graph.powi(d, i64::from(k));
        let term = graph.mul(slope, power);
        factor = factor.checked_mul(Rational::new(1, i128::from(k)).unwrap_or(factor)).unwrap_or(factor);
        sum = graph.linear(Rational::ZERO, &[(sum, Rational::ONE), (term, factor)]);
    }
    sum
}

/// The value of φ, φ′, φ″ … at any argument.
pub fn derivative(graph: &mut Graph, function: Function, order: u8, at: Id) -> Id {
    rule(graph, function, order, |graph, function| graph.apply(function, at))
}

/// Divided difference of φ, φ′ or φ″ between a and b.
pub fn derivative_quotient(graph: &mut Graph, function: Function, order: u8, a: Id, b: Id) -> Id {
    rule(graph, function, order, |graph, function| quotient(graph, function, a, b))
}

/// A derivative of φ, or its divided difference, from the value or the divided difference of ln x and x^r.
fn rule(graph: &mut Graph, function: Function, order: u8, of: impl FnOnce(&mut Graph, Function) -> Id) -> Id {
    let (exponent, order) = match function {
        Function::Power(exponent) => (exponent, order),
        _ if order == 0 => return of(graph, Function::Ln),
        // ln′ x = x⁻¹
        _ => (Exponent::integer(-1), order - 1),
    };
    let coefficient = falling(graph, exponent, order);
    let lowered = graph.add_exponents(exponent, Exponent::integer(-i64::from(order)));
    let power = of(graph, Function::Power(lowered));
    graph.mul(coefficient, power)
}

/// The falling factorial r (r − 1) … (r − k + 1).
fn falling(graph: &mut Graph, exponent: Exponent, order: u8) -> Id {
    let r = graph.exponent_value(exponent);
    let factors: Vec<_> = (0..i64::from(order))
        .map(|k| {
            let k = graph.integer(k);
            graph.sub(r, k)
        })
        .collect();
    graph.product_of(&factors)
}
