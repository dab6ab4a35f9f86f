//! Removes cancellation that the user's formula implies.
//!
//! With a denominator β + s, β a number and s a sum without constant, each left side subtracts what is nearly equal where
//! s is small or large:
//!
//! ```text
//! w − βw/(β + s) = s w/(β + s)
//! w − s w/(β + s) = βw/(β + s)
//! ```
//!
//! The first arises from the logarithm of a shifted sum: μ(1 − 1/(I1 + 1)) is the stiffness of a stable neo-Hookean solid
//! near collapse, where I1 is tiny and the left side has no correct digit.

use std::collections::HashMap;

use crate::expr::{Exponent, Graph, Id, Node};
use crate::rational::Rational;

/// The expression with the rules applied everywhere.
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
    for &(fraction, coefficient) in &terms {
        let Node::Product(factors) = graph.node(fraction).clone() else { continue };
        for (denominator, exponent) in factors {
            let Node::Linear { constant: beta, terms: sum } = graph.node(denominator).clone() else {
                continue;
            };
            if beta.is_zero() || sum.is_empty() || exponent.as_integer().is_none_or(|n| n >= 0) {
                continue;
            }
            let s = graph.linear(Rational::ZERO, &sum);
            let beta_id = graph.constant(beta);
            let over_beta = coefficient.checked_mul(beta.checked_powi(-1)?)?;
            // The coefficient of w, w itself, and what takes the place of both.
            let w = graph.mul(fraction, denominator);
            let w_over_s = graph.div(w, s);
            let rules = [(over_beta.negated(), w, s), (coefficient.negated(), w_over_s, beta_id)];
            for (c, w, factor) in rules {
                if !terms.contains(&(w, c)) {
                    continue;
                }
                let factors = [(w, 1), (factor, 1), (denominator, -1)];
                let combined = graph.product(&factors.map(|(base, n)| (base, Exponent::integer(n))));
                let mut kept: Vec<_> =
                    terms.iter().copied().filter(|&(term, _)| term != fraction && term != w).collect();
                kept.push((combined, c));
                return Some(graph.linear(constant, &kept));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_against_a_denominator_are_carried_out() {
        let mut g = Graph::default();
        let (x, two) = (g.stretch(0), g.integer(2));
        let s = g.powi(x, 2);
        let denominator = g.add(two, s);
        // x − 2x/(2 + x²) = x³/(2 + x²)
        let fraction = g.div(x, denominator);
        let twice = g.mul(two, fraction);
        let difference = g.sub(x, twice);
        let cube = g.powi(x, 3);
        let expected = g.div(cube, denominator);
        assert_eq!(simplify(&mut g, difference), expected);
        // x − x³/(2 + x²) = 2x/(2 + x²)
        let difference = g.sub(x, expected);
        assert_eq!(simplify(&mut g, difference), twice);
    }
}
