//! Sums that are parts of other sums, so that these start from them.
//!
//! ```text
//! 2μ + λ − 2μ ln x − λ ln J = (2μ + λ) − (2μ ln x + λ ln J)
//! ```
//!
//! The last is x times the first derivative of the same energy. An expression graph has no sums of sums, so this is said while
//! its operations are put in order.

use crate::expr::{Graph, Id, Node};
use crate::rational::Rational;

/// A sum as a constant and terms with their coefficients.
pub(super) type Linear = (Rational, Vec<(Id, Rational)>);

/// The sums of a program.
pub(super) struct Parts(Vec<(Id, Linear)>);

impl Parts {
    /// Those among these nodes, the longest first.
    pub(super) fn of(graph: &Graph, reachable: &[Id]) -> Self {
        let sum = |&id: &Id| match graph.node(id) {
            Node::Linear { constant, terms } if terms.len() > 1 => Some((id, (*constant, terms.clone()))),
            _ => None,
        };
        let mut sums: Vec<_> = reachable.iter().filter_map(sum).collect();
        sums.sort_by_key(|(_, (_, terms))| std::cmp::Reverse(terms.len()));
        Self(sums)
    }

    /// The sum with the longest of its parts as one term.
    pub(super) fn regrouped(&self, constant: Rational, terms: &[(Id, Rational)]) -> Linear {
        let regrouped = self.0.iter().find_map(|(id, (part_constant, part))| {
            if part.len() >= terms.len() {
                return None;
            }
            let coefficient = |asked: Id| terms.iter().find(|(id, _)| *id == asked).map(|&(_, c)| c);
            let sign = match coefficient(part[0].0)? {
                c if c == part[0].1 => Rational::ONE,
                c if c == part[0].1.negated() => Rational::ONE.negated(),
                _ => return None,
            };
            let is_part = part.iter().all(|&(id, c)| coefficient(id) == c.checked_mul(sign));
            let left = constant.checked_add(part_constant.checked_mul(sign)?.negated())?;
            if !is_part || !(part_constant.is_zero() || left.is_zero()) {
                return None;
            }
            let others = terms.iter().filter(|(term, _)| part.iter().all(|(id, _)| id != term));
            Some((left, others.copied().chain([(*id, sign)]).collect()))
        });
        regrouped.unwrap_or_else(|| (constant, terms.to_vec()))
    }
}
