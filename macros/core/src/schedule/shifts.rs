//! Whole powers taken out of sums over lists, if every term shares them.
//!
//! ```text
//! Σₚ μₚ (αₚ − 1) x^(αₚ−2) = x⁻¹ Σₚ (αₚ − 1) (μₚ x^(αₚ−1))
//! ```
//!
//! Only one of the powers x^(αₚ+k) is computed; each other one is that one times a power of x, which is the
//! same for all p and then is multiplied once, not for every entry; and so is a whole power of a stretch
//! itself. The terms that remain in the sum have been computed already for other sums.

use rustc_hash::FxHashMap;

use super::powers::{Evaluation, Powers};
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::algebra::volume::rewrite;
use crate::schedule::{Sorted, entry};

/// Bases with the whole exponents to which they are factors.
type Shifts = Sorted<Id, i64>;

/// The roots with shared powers before their sums.
pub(super) fn take_out(graph: &mut Graph, powers: &Powers, roots: &[Id]) -> Vec<Id> {
    let rule = |graph: &mut Graph, id: Id| {
        let Node::Sum(length, body) = *graph.node(id) else { return None };
        let (shifts, rest) = split(graph, powers, body);
        let sum = graph.sum(length, rest);
        Some(times(graph, sum, &shifts))
    };
    let mut memo = FxHashMap::default();
    roots.iter().map(|&root| rewrite(graph, root, &mut memo, &rule)).collect()
}

/// The shifts of all terms and the expression without them.
fn split(graph: &mut Graph, powers: &Powers, id: Id) -> (Shifts, Id) {
    match graph.node(id).clone() {
        Node::Product(factors) => {
            let (mut shifts, mut left) = (Shifts::new(), Vec::new());
            for (base, exponent) in factors {
                if let (Node::Stretch(_), Some(n)) = (graph.node(base), exponent.as_integer()) {
                    *entry(&mut shifts, base) += n;
                    continue;
                }
                if exponent == Exponent::ONE {
                    let (inner, rest) = split(graph, powers, base);
                    inner.into_iter().for_each(|(base, n)| *entry(&mut shifts, base) += n);
                    left.push((rest, Exponent::ONE));
                    continue;
                }
                let rational = match powers.evaluation(base, exponent) {
                    // A base that may differ from entry to entry stays in its sum.
                    Evaluation::Real(computed) if !graph.contains(base, |e| matches!(e, Node::Entry(_))) => {
                        computed
                    }
                    Evaluation::Real(_) | Evaluation::Root(_) => exponent.rational,
                };
                let shift = exponent.rational.checked_add(rational.negated());
                match shift.and_then(Rational::as_integer) {
                    Some(n) if n != 0 && exponent.real.is_some() => {
                        *entry(&mut shifts, base) += n;
                        left.push((base, Exponent { rational, ..exponent }));
                    }
                    _ => left.push((base, exponent)),
                }
            }
            (shifts, graph.product(&left))
        }
        Node::Linear { constant, terms } if constant.is_zero() => {
            let split: Vec<_> = terms.iter().map(|&(term, c)| (split(graph, powers, term), c)).collect();
            let mut shared = split.first().map(|((shifts, _), _)| shifts.clone()).unwrap_or_default();
            shared.retain(|shift| split.iter().all(|((shifts, _), _)| shifts.contains(shift)));
            let terms: Vec<_> = split
                .into_iter()
                .map(|((mut shifts, rest), c)| {
                    shifts.retain(|shift| !shared.contains(shift));
                    (times(graph, rest, &shifts), c)
                })
                .collect();
            (shared, graph.linear(Rational::ZERO, &terms))
        }
        _ => (Shifts::new(), id),
    }
}

fn times(graph: &mut Graph, id: Id, shifts: &Shifts) -> Id {
    let mut factors = vec![(id, Exponent::ONE)];
    factors.extend(shifts.iter().map(|&(base, n)| (base, Exponent::integer(n))));
    graph.product(&factors)
}
