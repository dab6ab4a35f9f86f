//! Multiplication of sums in products and whole powers, and of factors that a Σₚ does not run over.
//!
//! Expressions keep the shape in which they are written, because that loses no digits. The moduli at rest
//! contain no stretch, and read best as a sum of products:
//!
//! ```text
//! 1/2 (4 c10 + 4 c01) = 2 c10 + 2 c01
//! Σₚ (−1/3 αₚ μₚ) = −1/3 Σₚ αₚ μₚ
//! 3ⁿ + 3^(n − 1) = 4/3 3ⁿ
//! ```
//!
//! For the last, powers of numbers have exponents without whole part.

use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// Largest number of terms of a sum that reads better than a product.
const MOST_TERMS: usize = 24;

/// Highest power of a sum that is multiplied out; higher ones have more terms in any case.
const HIGHEST_POWER: i64 = 8;

/// A product and its coefficient.
type Term = (Id, Rational);

/// The expression multiplied out, or unchanged if the result is too long or leaves the range of fractions.
pub fn expand_products(graph: &mut Graph, e: Id) -> Id {
    let earlier = graph.overflowed();
    let expanded = terms(graph, e).map(|terms| graph.linear(Rational::ZERO, &terms));
    match expanded {
        Some(expanded) if graph.overflowed() == earlier => expanded,
        _ => e,
    }
}

/// An expression as the terms of a sum.
fn terms(graph: &mut Graph, e: Id) -> Option<Vec<Term>> {
    let one = (graph.integer(1), Rational::ONE);
    let mut all = Vec::new();
    match graph.node(e).clone() {
        Node::Linear { constant, terms: parts } => {
            all.push((one.0, constant));
            for (part, coefficient) in parts {
                let part = terms(graph, part)?;
                all.extend(multiplied(graph, &part, &[(one.0, coefficient)])?);
            }
        }
        Node::Product(factors) => {
            all.push(one);
            for (base, exponent) in factors {
                let factor = power(graph, base, exponent)?;
                all = multiplied(graph, &all, &factor)?;
            }
        }
        Node::Excess(..) | Node::Accurate(..) => all.push((e, Rational::ONE)),
        Node::Sum(length, body) => {
            for (term, coefficient) in terms(graph, body)? {
                let (number, factors) = graph.factors(term);
                let (inside, outside): (Vec<_>, Vec<_>) =
                    factors.into_iter().partition(|&factor| has_entries(graph, factor));
                let [inside, outside] = [inside, outside].map(|factors| graph.product(&factors));
                let sum = graph.sum(length, inside);
                all.push((graph.mul(outside, sum), coefficient.checked_mul(number)?));
            }
        }
        _ => all.push((graph.map_children(e, &mut expand_products), Rational::ONE)),
    }
    (all.len() <= MOST_TERMS).then_some(all)
}

/// A power as the terms of a sum: whole powers of sums are multiplied out, all others are kept.
fn power(graph: &mut Graph, base: Id, exponent: Exponent) -> Option<Vec<Term>> {
    let sum = terms(graph, base)?;
    match exponent.as_integer() {
        Some(n @ 1..=HIGHEST_POWER) if sum.len() > 1 => {
            let mut product = sum.clone();
            for _ in 1..n {
                product = multiplied(graph, &product, &sum)?;
            }
            Some(product)
        }
        _ => {
            let base = graph.linear(Rational::ZERO, &sum);
            let (exponent, coefficient) = match graph.as_constant(base) {
                Some(number) if !number.is_zero() => without_whole_part(number, exponent)?,
                _ => (exponent, Rational::ONE),
            };
            Some(vec![(graph.power(base, exponent), coefficient)])
        }
    }
}

/// The parts e and b^k of b^(e + k) = b^k b^e, with a whole number k and 0 ≤ e < 1, parameters apart.
fn without_whole_part(number: Rational, exponent: Exponent) -> Option<(Exponent, Rational)> {
    let Exponent { real, rational } = exponent;
    let whole = i64::try_from(rational.numerator().div_euclid(rational.denominator())).ok()?;
    let rational = rational.checked_add(Rational::integer(whole).negated())?;
    Some((Exponent { real, rational }, number.checked_powi(whole)?))
}

fn multiplied(graph: &mut Graph, a: &[Term], b: &[Term]) -> Option<Vec<Term>> {
    let mut product = Vec::with_capacity(a.len() * b.len());
    for &(x, c) in a {
        for &(y, d) in b {
            product.push((graph.mul(x, y), c.checked_mul(d)?));
        }
    }
    (product.len() <= MOST_TERMS).then_some(product)
}

/// True if a power changes from entry to entry of a list.
fn has_entries(graph: &Graph, (base, exponent): (Id, Exponent)) -> bool {
    let roots: Vec<_> = [Some(base), exponent.real].into_iter().flatten().collect();
    graph.reachable(&roots).into_iter().any(|id| matches!(graph.node(id), Node::Entry(_)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_numbers_gather() {
        let mut g = Graph::default();
        let (n, three) = (g.leaf(Node::Parameter(0)), g.integer(3));
        let power = |g: &mut Graph, shift: Rational| {
            let exponent = g.linear(shift, &[(n, Rational::ONE)]);
            let exponent = g.exponent(exponent);
            g.power(three, exponent)
        };
        let [plain, half, lowered, raised] = [(0, 1), (1, 2), (-1, 1), (5, 2)]
            .map(|(numerator, denominator)| power(&mut g, Rational::new(numerator, denominator).unwrap()));
        let sum = g.sum_of(&[plain, lowered, raised]);
        let terms = [(plain, Rational::new(4, 3).unwrap()), (half, Rational::integer(9))];
        let expected = g.linear(Rational::ZERO, &terms);
        assert_eq!(expand_products(&mut g, sum), expected);
    }

    #[test]
    fn too_long_sums_stay() {
        let mut g = Graph::default();
        let stretches = [0, 1, 2].map(|i| g.stretch(i));
        let sum = g.sum_of(&stretches);
        let power = g.powi(sum, HIGHEST_POWER);
        assert_eq!(expand_products(&mut g, power), power);
    }
}
