//! Products with exponents: their constructors and their normal form.

use super::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;

impl Graph {
    /// The product a · b.
    pub fn mul(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, Exponent::ONE), (b, Exponent::ONE)])
    }

    /// I1 = Σ λ², I2 = λ1²λ2² + λ2²λ3² + λ3²λ1² and J = λ1 λ2 λ3.
    pub fn invariants(&mut self) -> [Id; 3] {
        let stretches = [0, 1, 2].map(|i| self.stretch(i));
        let squares = stretches.map(|stretch| self.powi(stretch, 2));
        let pairs = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| self.mul(squares[a], squares[b]));
        [self.sum_of(&squares), self.sum_of(&pairs), self.product_of(&stretches)]
    }

    /// The product of several expressions.
    pub fn product_of(&mut self, factors: &[Id]) -> Id {
        let factors: Vec<_> = factors.iter().map(|&factor| (factor, Exponent::ONE)).collect();
        self.product(&factors)
    }

    /// The quotient a / b.
    pub fn div(&mut self, a: Id, b: Id) -> Id {
        self.product(&[(a, Exponent::ONE), (b, Exponent::integer(-1))])
    }

    /// The power a^exponent.
    pub fn power(&mut self, a: Id, exponent: Exponent) -> Id {
        self.product(&[(a, exponent)])
    }

    /// The whole power a^n.
    pub fn powi(&mut self, a: Id, n: i64) -> Id {
        self.power(a, Exponent::integer(n))
    }

    /// The product Π base^exponent in normal form.
    pub fn product(&mut self, factors: &[(Id, Exponent)]) -> Id {
        self.work(factors.len());
        let mut coefficient = Rational::ONE;
        let mut collected = Vec::with_capacity(factors.len());
        for &(base, exponent) in factors {
            self.gather(base, exponent, &mut coefficient, &mut collected);
        }
        collected.retain(|(_, exponent)| !exponent.is_zero());
        let product = match collected[..] {
            [] => return self.constant(coefficient),
            [(base, Exponent::ONE)] => base,
            _ => self.leaf(Node::Product(collected)),
        };
        if coefficient == Rational::ONE { product } else { self.scale(product, coefficient) }
    }

    fn gather(
        &mut self,
        base: Id,
        exponent: Exponent,
        coefficient: &mut Rational,
        into: &mut Vec<(Id, Exponent)>,
    ) {
        match self.node(base).clone() {
            // Numbers: 0 and 1 have every power, others the whole ones.
            Node::Linear { constant, terms } if terms.is_empty() => {
                if let Some(n) = exponent.as_integer() {
                    let power = self.exact(constant.checked_powi(n));
                    *coefficient = self.exact(coefficient.checked_mul(power));
                    return;
                }
                if constant == Rational::ONE {
                    return;
                }
                // Only positive real powers are taken of zero: those of an excess at rest.
                if constant.is_zero() {
                    *coefficient = Rational::ZERO;
                    return;
                }
            }
            // c·t and Π have whole powers factor by factor; real ones only where every factor is known
            // positive.
            Node::Linear { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                let (term, factor) = terms[0];
                // A cube root keeps the sign: (−t)^(4/3) = t^(4/3).
                if factor == Rational::ONE.negated() && exponent.is_of_cube_root() {
                    if exponent.rational.numerator() % 2 != 0 {
                        *coefficient = coefficient.negated();
                    }
                    self.gather(term, exponent, coefficient, into);
                    return;
                }
                if let Some(n) = exponent.as_integer() {
                    let power = self.exact(factor.checked_powi(n));
                    *coefficient = self.exact(coefficient.checked_mul(power));
                    self.gather(term, exponent, coefficient, into);
                    return;
                }
            }
            // (b − a)² = (a − b)²
            Node::Linear { constant, terms }
                if constant.is_zero() && exponent.as_integer().is_some_and(|n| n > 0 && n % 2 == 0) =>
            {
                if let [(b, first), (a, Rational::ONE)] = terms[..]
                    && first == Rational::ONE.negated()
                {
                    let difference = self.sub(b, a);
                    self.gather_one(difference, exponent, into);
                    return;
                }
            }
            // A compound such as J^(−2/3) I1 is of moderate size where its factors are not: its powers are
            // kept whole.
            Node::Product(factors) => {
                let is_compound =
                    factors.iter().any(|&(factor, _)| matches!(self.node(factor), Node::Linear { .. }));
                if let Some(n) = exponent.as_integer()
                    && (n <= 1 || !is_compound)
                {
                    for (factor, inner) in factors {
                        let power = self.scale_exponent(inner, n);
                        self.gather_one(factor, power, into);
                    }
                    return;
                }
            }
            _ => {}
        }
        self.gather_one(base, exponent, into);
    }

    /// Bases are kept in order.
    fn gather_one(&mut self, base: Id, exponent: Exponent, into: &mut Vec<(Id, Exponent)>) {
        match into.binary_search_by_key(&base, |factor| factor.0) {
            Ok(k) => into[k].1 = self.add_exponents(into[k].1, exponent),
            Err(k) => into.insert(k, (base, exponent)),
        }
    }

    /// The factors of a node, itself if it is not a product; without its rational coefficient, which comes
    /// first.
    #[must_use]
    pub fn factors(&self, id: Id) -> (Rational, Vec<(Id, Exponent)>) {
        match self.node(id) {
            Node::Product(factors) => (Rational::ONE, factors.clone()),
            Node::Linear { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                let (term, coefficient) = terms[0];
                let (_, factors) = self.factors(term);
                (coefficient, factors)
            }
            _ => (Rational::ONE, vec![(id, Exponent::ONE)]),
        }
    }
}
