//! Rules that join terms which differentiation separates.
//!
//! With a number c, a denominator β + s, β a number and s a sum without constant:
//!
//! ```text
//! w − βw/(β + s) = s w/(β + s)
//! w − s w/(β + s) = βw/(β + s)
//! w s + c w = w (s + c)
//! Σₚ a + c Σₚ b = Σₚ (a + c b)
//! (p s + p t)/p = s + t
//! cosh x/sinh x = 1/tanh x
//! ```
//!
//! the last but one for a parameter p.
//!
//! The first two remove cancellation: each left side subtracts nearly equal terms where s is small or large.
//! They arise from the logarithm of a shifted sum: μ(1 − 1/(I1 + 1)) is the stiffness of a stable neo-Hookean
//! solid near collapse, where I1 is tiny and the left side has no correct digit. The last one keeps the
//! quotient, near 1, where both functions overflow. The others save operations.

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Elementary, Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::algebra::volume::rebuild;

/// The expression with the rules applied everywhere.
pub fn simplify(graph: &mut Graph, e: Id) -> Id {
    rebuild(graph, e, &mut FxHashMap::default(), &mut |graph, mut result| {
        while !graph.is_full()
            && let Some(simpler) = cancel_against_denominator(graph, result)
                .or_else(|| collect_into_factor(graph, result))
                .or_else(|| join_two_sums(graph, result))
                .or_else(|| cancel_parameter(graph, result))
                .or_else(|| join_hyperbolic(graph, result))
        {
            result = simpler;
        }
        result
    })
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
            // The coefficient of w, w itself, and the term that replaces both.
            let w = graph.mul(fraction, denominator);
            let w_over_s = graph.div(w, s);
            let rules = [(over_beta.negated(), w, s), (coefficient.negated(), w_over_s, beta_id)];
            for (c, w, factor) in rules {
                if coefficient_of(&terms, w) != Some(c) {
                    continue;
                }
                let factors = [(w, 1), (factor, 1), (denominator, -1)];
                let combined = graph.product(&factors.map(|(base, n)| (base, Exponent::integer(n))));
                return Some(replace(graph, constant, &terms, [fraction, w], (combined, c)));
            }
        }
    }
    None
}

/// w s + c w = w (s + c)
fn collect_into_factor(graph: &mut Graph, e: Id) -> Option<Id> {
    let Node::Linear { constant, terms } = graph.node(e).clone() else { return None };
    for &(product, coefficient) in &terms {
        let Node::Product(factors) = graph.node(product).clone() else { continue };
        for (sum, exponent) in factors {
            if exponent != Exponent::ONE || !matches!(graph.node(sum), Node::Linear { .. }) {
                continue;
            }
            let w = graph.div(product, sum);
            let Some(other) = coefficient_of(&terms, w) else { continue };
            let shift = other.checked_mul(coefficient.checked_powi(-1)?)?;
            let shifted = graph.linear(shift, &[(sum, Rational::ONE)]);
            let collected = graph.mul(w, shifted);
            return Some(replace(graph, constant, &terms, [product, w], (collected, coefficient)));
        }
    }
    None
}

/// The sum with its terms that are sums over lists of one length joined.
pub fn join_sums(graph: &mut Graph, mut e: Id) -> Id {
    while let Some(joined) = join_two_sums(graph, e) {
        e = joined;
    }
    e
}

/// Σₚ a + c Σₚ b = Σₚ (a + c b)
fn join_two_sums(graph: &mut Graph, e: Id) -> Option<Id> {
    let Node::Linear { constant, terms } = graph.node(e).clone() else { return None };
    let as_sum = |&(term, c): &(Id, Rational)| match *graph.node(term) {
        Node::Sum(length, body) => Some((length, term, body, c)),
        _ => None,
    };
    let sums: Vec<_> = terms.iter().filter_map(as_sum).collect();
    for (k, &(length, first, a, c)) in sums.iter().enumerate() {
        if let Some(&(_, second, b, d)) = sums[k + 1..].iter().find(|other| other.0 == length) {
            let body = graph.linear(Rational::ZERO, &[(a, c), (b, d)]);
            let body = simplify(graph, body);
            let joined = graph.sum(length, body);
            return Some(replace(graph, constant, &terms, [first, second], (joined, Rational::ONE)));
        }
    }
    None
}

/// (p s + p t)/p = s + t
fn cancel_parameter(graph: &mut Graph, e: Id) -> Option<Id> {
    let Node::Product(factors) = graph.node(e).clone() else { return None };
    let is_below = |&&(base, exponent): &&(Id, Exponent)| {
        matches!(graph.node(base), Node::Parameter(_) | Node::Entry(_))
            && exponent.as_integer().is_some_and(|n| n < 0)
    };
    for &(parameter, _) in factors.iter().filter(is_below) {
        let is_above = |&(term, _): &(Id, Rational)| {
            let (_, factors) = graph.factors(term);
            let exponent = factors.iter().find(|factor| factor.0 == parameter).and_then(|f| f.1.as_integer());
            exponent.is_some_and(|n| n > 0)
        };
        for &(sum, exponent) in &factors {
            let Node::Linear { constant, terms } = graph.node(sum).clone() else { continue };
            if exponent != Exponent::ONE || !constant.is_zero() || !terms.iter().all(is_above) {
                continue;
            }
            let terms: Vec<_> = terms.iter().map(|&(term, c)| (graph.div(term, parameter), c)).collect();
            let others = graph.div(e, sum);
            let divided = graph.linear(Rational::ZERO, &terms);
            return Some(graph.product_of(&[others, parameter, divided]));
        }
    }
    None
}

/// cosh x/sinh x = 1/tanh x, and its inverse
fn join_hyperbolic(graph: &mut Graph, e: Id) -> Option<Id> {
    let Node::Product(factors) = graph.node(e).clone() else { return None };
    for &(cosh, exponent) in &factors {
        let Node::Apply(Function::Elementary(Elementary::Cosh), a) = *graph.node(cosh) else { continue };
        let sinh = graph.elementary(Elementary::Sinh, a);
        let Some(n) = exponent.as_integer() else { continue };
        if !factors.contains(&(sinh, Exponent::integer(-n))) {
            continue;
        }
        let others = factors.iter().copied().filter(|(base, _)| ![cosh, sinh].contains(base));
        let others: Vec<_> = others.collect();
        let tanh = graph.elementary(Elementary::Tanh, a);
        let (others, power) = (graph.product(&others), graph.powi(tanh, -n));
        return Some(graph.mul(others, power));
    }
    None
}

/// The coefficient of a term, given all terms in their order.
fn coefficient_of(terms: &[(Id, Rational)], asked: Id) -> Option<Rational> {
    terms.binary_search_by_key(&asked, |&(term, _)| term).ok().map(|k| terms[k].1)
}

/// The sum with two of its terms replaced by one.
fn replace(
    graph: &mut Graph,
    constant: Rational,
    terms: &[(Id, Rational)],
    old: [Id; 2],
    new: (Id, Rational),
) -> Id {
    let mut kept: Vec<_> = terms.iter().copied().filter(|(term, _)| !old.contains(term)).collect();
    kept.push(new);
    graph.linear(constant, &kept)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::diff::Differentiator;

    #[test]
    fn hyperbolic_functions_do_not_overflow_where_their_quotient_is_near_one() {
        let mut g = Graph::default();
        let x = g.stretch(0);
        let [sinh, cosh, tanh] =
            [Elementary::Sinh, Elementary::Cosh, Elementary::Tanh].map(|function| g.elementary(function, x));
        let quotient = g.div(x, sinh);
        let logarithm = g.ln(quotient);
        // (ln(x/sinh x))′ = 1/x − 1/tanh x
        let slope = Differentiator::default().by_stretch(&mut g, logarithm, 0);
        let [over_x, over_tanh] = [x, tanh].map(|base| g.powi(base, -1));
        let expected = g.sub(over_x, over_tanh);
        assert_eq!(simplify(&mut g, slope), expected);
        let square =
            g.product(&[(cosh, Exponent::integer(-2)), (sinh, Exponent::integer(2)), (x, Exponent::ONE)]);
        let expected = g.product(&[(tanh, Exponent::integer(2)), (x, Exponent::ONE)]);
        assert_eq!(simplify(&mut g, square), expected);
    }
}
