//! Common parts of sums: partial sums from which a sum starts, and common coefficients.
//!
//! ```text
//! 2μ + λ − 2μ ln x − λ ln J = (2μ + λ) − (2μ ln x + λ ln J)
//! ```
//!
//! The last sum is x times the first derivative of the same energy. Sums are flat in the expression graph, so
//! shared partial sums are introduced here, during scheduling; so is the form
//!
//! ```text
//! a − c s − c t = a − c (s + t)
//! ```
//!
//! which saves a multiplication unless another sum needs c s or c t.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::rational::Rational;

/// A sum as a constant and terms with their coefficients.
pub(super) type Linear = (Rational, Vec<(Id, Rational)>);

/// The sums of a program.
pub(super) struct Parts {
    /// The sums, the longest first.
    sums: Vec<(Id, Linear)>,
    /// The places of the sums there, by their first terms.
    by_first: FxHashMap<Id, Vec<usize>>,
    /// The number of sums in which a term has a coefficient of this magnitude.
    multiples: FxHashMap<(Id, Rational), usize>,
}

impl Parts {
    /// The sums among these nodes.
    pub(super) fn of(graph: &Graph, reachable: &[Id]) -> Self {
        let sum = |&id: &Id| match graph.node(id) {
            Node::Linear { constant, terms } if terms.len() > 1 => Some((id, (*constant, terms.clone()))),
            _ => None,
        };
        let mut sums: Vec<_> = reachable.iter().filter_map(sum).collect();
        sums.sort_by_key(|(_, (_, terms))| std::cmp::Reverse(terms.len()));
        let mut multiples = FxHashMap::default();
        for &(term, c) in sums.iter().flat_map(|(_, (_, terms))| terms) {
            *multiples.entry((term, c.magnitude())).or_default() += 1;
        }
        let mut by_first: FxHashMap<Id, Vec<usize>> = FxHashMap::default();
        for (place, (_, (_, terms))) in sums.iter().enumerate() {
            by_first.entry(terms[0].0).or_default().push(place);
        }
        Self { sums, by_first, multiples }
    }

    /// The terms in groups whose coefficients differ only by their signs.
    pub(super) fn groups(&self, (constant, terms): &Linear) -> Vec<Vec<(Id, Rational)>> {
        let is_shared = |&&(id, c): &&(Id, Rational)| {
            self.multiples.get(&(id, c.magnitude())).is_some_and(|&sums| sums > 1)
        };
        let are_alike =
            |a: Rational, b: Rational| a.magnitude() == b.magnitude() && a.magnitude() != Rational::ONE;
        // A single multiple that other sums need too does not justify a second multiplication here.
        let all_alike = constant.is_zero() && terms.iter().all(|&(_, c)| are_alike(c, terms[0].1));
        let one_group = all_alike && terms.iter().filter(is_shared).count() <= 1;
        let mut groups: Vec<Vec<(Id, Rational)>> = Vec::new();
        for term in terms {
            let is_alone = !one_group && (term.1.magnitude() == Rational::ONE || is_shared(&term));
            let with_term = |group: &&mut Vec<(Id, Rational)>| {
                one_group || are_alike(group[0].1, term.1) && !is_shared(&&group[0])
            };
            let group = if is_alone { None } else { groups.iter_mut().find(with_term) };
            match group {
                Some(group) => group.push(*term),
                None => groups.push(vec![*term]),
            }
        }
        groups
    }

    /// The sum with the longest of its parts as one term.
    pub(super) fn regrouped(&self, constant: Rational, terms: &[(Id, Rational)]) -> Linear {
        let coefficients: FxHashMap<Id, Rational> = terms.iter().copied().collect();
        let coefficient = |asked: Id| coefficients.get(&asked).copied();
        let mut places: Vec<_> = terms.iter().filter_map(|(id, _)| self.by_first.get(id)).flatten().collect();
        places.sort_unstable();
        let mut sums = places.into_iter().map(|&place| &self.sums[place]);
        let regrouped = sums.find_map(|(id, (part_constant, part))| {
            if part.len() >= terms.len() {
                return None;
            }
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
            let parts: FxHashSet<Id> = part.iter().map(|&(id, _)| id).collect();
            let others = terms.iter().filter(|(term, _)| !parts.contains(term));
            Some((left, others.copied().chain([(*id, sign)]).collect()))
        });
        regrouped.unwrap_or_else(|| (constant, terms.to_vec()))
    }
}
