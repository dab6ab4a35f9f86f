//! Logarithms and powers of the volume J, and of other products of stretches, by the stretches themselves.
//!
//! J leaves the range of a number format long before the stretches do: at stretches of 10¹³ in `f32`. J^r need not, nor
//! need its derivatives J^r/λi, so
//!
//! ```text
//! (Π λi^e)^r = Π λi^(e r)        ln Π λi^e = Σ e ln λi
//! ```
//!
//! for positive stretches. Differentiating λi^r lowers its exponent instead of dividing the whole by λi afterwards.

use std::collections::HashMap;

use crate::expr::{Exponent, Graph, Id, Node, Stretch};
use crate::rational::Rational;

/// What becomes of the logarithm of a product of stretches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Logarithms {
    /// A multiple of ln J stays one, to be computed by a single logarithm wherever J is in range.
    OfVolume,
    /// Σ e ln λi.
    OfStretches,
}

/// The expression with real powers of products of stretches separated, and their logarithms as said.
pub fn separate(graph: &mut Graph, e: Id, logarithms: Logarithms) -> Id {
    rewrite(graph, e, &mut HashMap::new(), &|graph, id| match graph.node(id).clone() {
        Node::Ln(a) => logarithm(graph, &monomial(graph, a)?, logarithms),
        Node::Product(factors) => {
            let mut separated = Vec::new();
            for (base, exponent) in factors {
                match monomial(graph, base) {
                    Some(monomial) => {
                        for (stretch, inner) in monomial {
                            let stretch = graph.stretch(stretch);
                            separated.push((stretch, multiply(graph, inner, exponent)));
                        }
                    }
                    None => separated.push((separate(graph, base, logarithms), exponent)),
                }
            }
            Some(graph.product(&separated))
        }
        _ => None,
    })
}

fn logarithm(graph: &mut Graph, monomial: &[(Stretch, Exponent)], logarithms: Logarithms) -> Option<Id> {
    let all_equal = monomial.iter().all(|factor| factor.1 == monomial[0].1);
    if logarithms == Logarithms::OfVolume && monomial.len() == 3 && all_equal {
        let stretches = [0, 1, 2].map(|i| graph.stretch(i));
        let volume = graph.product_of(&stretches);
        let (factor, ln) = (graph.exponent_value(monomial[0].1), graph.ln(volume));
        return Some(graph.mul(factor, ln));
    }
    let mut terms = Vec::new();
    for &(stretch, exponent) in monomial {
        let stretch = graph.stretch(stretch);
        let (factor, ln) = (graph.exponent_value(exponent), graph.ln(stretch));
        terms.push(graph.mul(factor, ln));
    }
    Some(graph.sum_of(&terms))
}

/// The factors of a product of powers of stretches, without coefficient; `None` for anything else.
fn monomial(graph: &Graph, id: Id) -> Option<Vec<(Stretch, Exponent)>> {
    let (coefficient, factors) = graph.factors(id);
    if coefficient != Rational::ONE {
        return None;
    }
    factors
        .into_iter()
        .map(|(base, exponent)| match graph.node(base) {
            Node::Stretch(i) => Some((*i, exponent)),
            _ => None,
        })
        .collect()
}

fn multiply(graph: &mut Graph, a: Exponent, b: Exponent) -> Exponent {
    let (a, b) = (graph.exponent_value(a), graph.exponent_value(b));
    let product = graph.mul(a, b);
    graph.exponent(product)
}

/// The expression with the rule applied from the top down: what a rule answers is not looked into.
pub fn rewrite(
    graph: &mut Graph,
    id: Id,
    memo: &mut HashMap<Id, Id>,
    rule: &impl Fn(&mut Graph, Id) -> Option<Id>,
) -> Id {
    if let Some(&done) = memo.get(&id) {
        return done;
    }
    let result = match rule(graph, id) {
        Some(replaced) => replaced,
        None => graph.map_children(id, &mut |graph, child| rewrite(graph, child, memo, rule)),
    };
    memo.insert(id, result);
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_separated_and_logarithms_as_said() {
        let mut g = Graph::default();
        let [x, y, z] = [0, 1, 2].map(|i| g.stretch(i));
        let volume = g.product_of(&[x, y, z]);
        let two_thirds = Exponent::rational(Rational::new(2, 3).unwrap());
        let power = g.power(volume, two_thirds);
        let separated = separate(&mut g, power, Logarithms::OfVolume);
        assert_eq!(separated, g.product(&[x, y, z].map(|stretch| (stretch, two_thirds))));

        let square = g.powi(volume, 2);
        let ln_square = g.ln(square);
        let ln = g.ln(volume);
        let twice = g.scale(ln, Rational::integer(2));
        assert_eq!(separate(&mut g, ln_square, Logarithms::OfVolume), twice);
        let lns = [x, y, z].map(|stretch| g.ln(stretch));
        assert_eq!(separate(&mut g, ln, Logarithms::OfStretches), g.sum_of(&lns));
    }
}
