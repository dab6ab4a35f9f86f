//! Removes cancellation that the user's formula implies.
//!
//! One rule: a + … − βa/(β + s) = … + a s/(β + s). The derivative of a logarithm of a shifted sum produces the left
//! side, which loses all digits where s is small: μ(1 − 1/(I1 + 1)) is the stiffness of a stable neo-Hookean solid near
//! collapse, with I1 tiny.

use std::collections::HashMap;

use crate::expr::{Exponent, Graph, Id, Node};
use crate::rational::Rational;

/// The expression with the rule applied everywhere.
pub fn simplify(graph: &mut Graph, e: Id) -> Id {
    rewrite(graph, e, &mut HashMap::new())
}

fn rewrite(graph: &mut Graph, e: Id, memo: &mut HashMap<Id, Id>) -> Id {
    if let Some(&done) = memo.get(&e) {
        return done;
    }
    let mut result = graph.map_children(e, &mut |graph, child| rewrite(graph, child, memo));
    while let Some(simpler) = cancel_against_denominator(graph, result) {
        result = simpler;
    }
    memo.insert(e, result);
    result
}

fn cancel_against_denominator(graph: &mut Graph, e: Id) -> Option<Id> {
    let Node::Linear { constant, terms } = graph.node(e).clone() else { return None };
    for &(fraction, c) in &terms {
        let Node::Product(factors) = graph.node(fraction).clone() else { continue };
        for (denominator, exponent) in factors {
            let Node::Linear { constant: shift, terms: sum } = graph.node(denominator).clone() else {
                continue;
            };
            if shift.is_zero() || exponent.as_integer().is_none_or(|n| n >= 0) {
                continue;
            }
            let whole = graph.mul(fraction, denominator);
            let Some(&(_, coefficient)) = terms.iter().find(|&&(term, _)| term == whole) else { continue };
            // coefficient · whole + c · whole/(shift + sum), c = −coefficient · shift
            if coefficient.checked_mul(shift) != Some(c.negated()) {
                continue;
            }
            let sum = graph.linear(Rational::ZERO, &sum);
            let combined = graph.product(&[(fraction, Exponent::ONE), (sum, Exponent::ONE)]);
            let mut kept: Vec<_> =
                terms.iter().copied().filter(|&(term, _)| term != fraction && term != whole).collect();
            kept.push((combined, coefficient));
            return Some(graph.linear(constant, &kept));
        }
    }
    None
}
