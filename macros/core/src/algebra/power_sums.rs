//! Sums over the stretches of a polynomial in their squares, as functions of I1, I2 and J.
//!
//! With ti = λi² − 1, k = I1 − 3 and m = I2 − 3, Newton's identities read
//!
//! ```text
//! Σ ti = k,   Σ ti² = k² + 4k − 2m
//! ```
//!
//! so that Saint Venant–Kirchhoff's energy, in Σ (λi² − 1)², is one of invariants. Its derivatives by them
//! keep their digits. The sum itself is of second order in the strains where its terms are of the first:
//! near rest it loses digits that the squares keep.

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Graph, Id, Node, Stretch};
use crate::algebra::rational::Rational;

/// c0 + c1 t + c2 t² with t = λ² − 1.
type Polynomial = [Rational; 3];

/// An expression of I1, I2, J, which replace the stretches, and of stretches, which are represented by
/// strains: without the latter, if they occur in such sums only.
pub fn without_stretches(graph: &mut Graph, e: Id) -> Option<Id> {
    let rewritten = with_invariants(graph, e, &mut FxHashMap::default());
    let has_stretch = graph.contains(rewritten, |node| matches!(node, Node::Strain(_)));
    (!has_stretch).then_some(rewritten)
}

fn with_invariants(graph: &mut Graph, e: Id, done: &mut FxHashMap<Id, Id>) -> Id {
    once!(done, e, {
        let joined = match graph.node(e).clone() {
            Node::Linear { constant, terms } => joined(graph, constant, &terms).unwrap_or(e),
            _ => e,
        };
        graph.map_children(joined, &mut |graph, child| with_invariants(graph, child, done))
    })
}

/// A sum with its terms in single stretches joined, if they are the same polynomial of each.
fn joined(graph: &mut Graph, constant: Rational, terms: &[(Id, Rational)]) -> Option<Id> {
    let mut others = Vec::new();
    let mut sums = [[Rational::ZERO; 3]; 3];
    for &(term, coefficient) in terms {
        match polynomial(graph, term) {
            Some((Some(i), polynomial)) => {
                sums[i] = plus(sums[i], times(polynomial, [coefficient, Rational::ZERO, Rational::ZERO])?)?
            }
            _ => others.push((term, coefficient)),
        }
    }
    let [[c0, c1, c2], ..] = sums;
    if others.len() == terms.len() || sums[1] != sums[0] || sums[2] != sums[0] {
        return None;
    }
    let three = Rational::integer(3);
    let [k, m] = [0, 1].map(|invariant| {
        let invariant = graph.stretch(invariant);
        graph.linear(three.negated(), &[(invariant, Rational::ONE)])
    });
    let constant = constant.checked_add(c0.checked_mul(three)?)?;
    let squared = graph.powi(k, 2);
    let of_k = c1.checked_add(c2.checked_mul(Rational::integer(4))?)?;
    others.extend([(squared, c2), (k, of_k), (m, c2.checked_mul(Rational::integer(-2))?)]);
    Some(graph.linear(constant, &others))
}

/// An expression as a polynomial, and the stretch that it is one of, unless it is a number.
fn polynomial(graph: &Graph, e: Id) -> Option<(Option<Stretch>, Polynomial)> {
    let [zero, one] = [Rational::ZERO, Rational::ONE];
    match graph.node(e) {
        Node::Linear { constant, terms } => {
            let mut sum = (None, [*constant, zero, zero]);
            for &(term, coefficient) in terms {
                let (stretch, polynomial) = polynomial(graph, term)?;
                sum = (same(sum.0, stretch)?, plus(sum.1, times(polynomial, [coefficient, zero, zero])?)?);
            }
            Some(sum)
        }
        Node::Product(factors) => {
            let mut product = (None, [one, zero, zero]);
            for &(base, exponent) in factors {
                let exponent = exponent.as_integer()?;
                let (stretch, base, count) = match graph.node(base) {
                    // λ² = 1 + t.
                    Node::Strain(i) if exponent % 2 == 0 => (Some(*i), [one, one, zero], exponent / 2),
                    _ => {
                        let (stretch, base) = polynomial(graph, base)?;
                        (stretch, base, exponent)
                    }
                };
                if !(0..=2).contains(&count) {
                    return None;
                }
                product.0 = same(product.0, stretch)?;
                for _ in 0..count {
                    product.1 = times(product.1, base)?;
                }
            }
            Some(product)
        }
        _ => None,
    }
}

/// The common stretch of two expressions, unless they have two.
fn same(a: Option<Stretch>, b: Option<Stretch>) -> Option<Option<Stretch>> {
    (a.is_none() || b.is_none() || a == b).then_some(a.or(b))
}

fn plus(a: Polynomial, b: Polynomial) -> Option<Polynomial> {
    Some([a[0].checked_add(b[0])?, a[1].checked_add(b[1])?, a[2].checked_add(b[2])?])
}

/// The product, if it is of the second degree at most.
fn times(a: Polynomial, b: Polynomial) -> Option<Polynomial> {
    let mut product = [Rational::ZERO; 5];
    for (i, x) in a.into_iter().enumerate() {
        for (j, y) in b.into_iter().enumerate() {
            product[i + j] = product[i + j].checked_add(x.checked_mul(y)?)?;
        }
    }
    let [c0, c1, c2, c3, c4] = product;
    (c3.is_zero() && c4.is_zero()).then_some([c0, c1, c2])
}
