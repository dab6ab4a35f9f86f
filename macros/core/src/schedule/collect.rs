//! Common factors taken out of sums.
//!
//! ```text
//! 2μ/x² − 2μ ln x/x² + λ/x² − λ ln J/x² = (2μ − 2μ ln x + λ − λ ln J)/x²
//! ```
//!
//! Only powers of stretches are taken out, and only of terms that are of degree zero without them: the
//! remaining sum then stays within the range of the number format wherever parameters and logarithms do.

use rustc_hash::FxHashMap;

use super::degrees::Degrees;
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::algebra::volume::rebuild;

/// Expressions with common factors taken out, each found once for all programs of a graph.
#[derive(Debug, Default)]
pub struct Collector {
    pub(super) degrees: Degrees,
    memo: FxHashMap<Id, Id>,
}

impl Collector {
    /// The roots with common factors taken out.
    pub(super) fn collect(&mut self, graph: &mut Graph, roots: &[Id]) -> Vec<Id> {
        let Self { degrees, memo } = self;
        let mut rule = |graph: &mut Graph, id: Id| match graph.node(id).clone() {
            Node::Linear { constant, terms } => collected(graph, degrees, constant, &terms),
            _ => id,
        };
        roots.iter().map(|&root| rebuild(graph, root, memo, &mut rule)).collect()
    }
}

/// A sum whose terms share factors.
fn collected(graph: &mut Graph, degrees: &mut Degrees, constant: Rational, terms: &[(Id, Rational)]) -> Id {
    // In the order of the terms, so that the result is always the same.
    let mut groups: Vec<(Id, Vec<(Id, Rational)>)> = Vec::new();
    let mut places: FxHashMap<Id, usize> = FxHashMap::default();
    let one = graph.integer(1);
    for &(term, c) in terms {
        let (monomial, rest) = split(graph, term);
        let is_bounded = degrees.of(graph, rest) == [0.0; 2];
        let (monomial, rest) = if is_bounded && monomial != one { (monomial, rest) } else { (term, one) };
        let place = *places.entry(monomial).or_insert(groups.len());
        match groups.get_mut(place) {
            Some((_, rests)) => rests.push((rest, c)),
            None => groups.push((monomial, vec![(rest, c)])),
        }
    }
    let terms: Vec<_> = groups
        .into_iter()
        .map(|(monomial, rests)| match rests[..] {
            [(rest, c)] => (graph.mul(monomial, rest), c),
            _ => {
                let sum = flat(graph, &rests);
                (graph.mul(monomial, sum), Rational::ONE)
            }
        })
        .collect();
    graph.linear(constant, &terms)
}

/// A sum of sums as a single sum.
fn flat(graph: &mut Graph, terms: &[(Id, Rational)]) -> Id {
    let mut constant = Rational::ZERO;
    let mut all: Vec<(Id, Rational)> = Vec::new();
    for &(term, c) in terms {
        let inner = match graph.node(term) {
            Node::Linear { constant, terms } => Some((*constant, terms.clone())),
            _ => None,
        };
        let scaled = inner.and_then(|(inner_constant, inner)| {
            let inner: Option<Vec<_>> =
                inner.into_iter().map(|(term, d)| Some((term, d.checked_mul(c)?))).collect();
            Some((constant.checked_add(inner_constant.checked_mul(c)?)?, inner?))
        });
        match scaled {
            Some((sum, inner)) => {
                constant = sum;
                all.extend(inner);
            }
            None => all.push((term, c)),
        }
    }
    graph.linear(constant, &all)
}

/// The powers of stretches that are factors of a term, and the other factors.
fn split(graph: &mut Graph, term: Id) -> (Id, Id) {
    let (_, factors) = graph.factors(term);
    let is_stretch =
        |&(base, _): &(Id, Exponent)| matches!(graph.node(base), Node::Stretch(_) | Node::Above(_));
    let (powers, others): (Vec<_>, Vec<_>) = factors.into_iter().partition(is_stretch);
    (graph.product(&powers), graph.product(&others))
}
