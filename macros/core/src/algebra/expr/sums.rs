//! Sums with rational coefficients: their constructors and their normal form.

use super::{Graph, Id, Node};
use crate::algebra::rational::Rational;

impl Graph {
    /// The sum a + b.
    pub fn add(&mut self, a: Id, b: Id) -> Id {
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// The difference a − b.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.linear(Rational::ZERO, &[(a, Rational::ONE), (b, Rational::integer(-1))])
    }

    /// The negative −a.
    pub fn neg(&mut self, a: Id) -> Id {
        self.scale(a, Rational::integer(-1))
    }

    /// The multiple factor · a.
    pub fn scale(&mut self, a: Id, factor: Rational) -> Id {
        self.linear(Rational::ZERO, &[(a, factor)])
    }

    /// The sum of several expressions.
    pub fn sum_of(&mut self, terms: &[Id]) -> Id {
        let terms: Vec<_> = terms.iter().map(|&term| (term, Rational::ONE)).collect();
        self.linear(Rational::ZERO, &terms)
    }

    /// The sum constant + Σ coefficient · term in normal form.
    pub fn linear(&mut self, constant: Rational, terms: &[(Id, Rational)]) -> Id {
        self.work(terms.len());
        let mut total = constant;
        let mut collected = Vec::with_capacity(terms.len());
        for &(term, factor) in terms {
            self.collect(term, factor, &mut total, &mut collected);
        }
        collected.retain(|(_, coefficient)| !coefficient.is_zero());
        match collected[..] {
            [(term, Rational::ONE)] if total.is_zero() => term,
            _ => self.leaf(Node::Linear { constant: total, terms: collected }),
        }
    }

    fn collect(&mut self, term: Id, factor: Rational, total: &mut Rational, into: &mut Vec<(Id, Rational)>) {
        if let Node::Linear { constant, terms } = self.node(term).clone() {
            let is_plain_multiple = constant.is_zero() && terms.len() == 1;
            let is_unit = factor == Rational::ONE || factor == Rational::integer(-1);
            if terms.is_empty() || is_plain_multiple || is_unit {
                let shift = self.exact(constant.checked_mul(factor));
                *total = self.exact(total.checked_add(shift));
                for (inner, coefficient) in terms {
                    let coefficient = self.exact(coefficient.checked_mul(factor));
                    if is_plain_multiple {
                        self.collect(inner, coefficient, total, into);
                    } else {
                        self.collect_one(inner, coefficient, into);
                    }
                }
                return;
            }
        }
        self.collect_one(term, factor, into);
    }

    /// Terms are kept in order.
    fn collect_one(&mut self, term: Id, coefficient: Rational, into: &mut Vec<(Id, Rational)>) {
        match into.binary_search_by_key(&term, |part| part.0) {
            Ok(k) => into[k].1 = self.exact(into[k].1.checked_add(coefficient)),
            Err(k) => into.insert(k, (term, coefficient)),
        }
    }
}
