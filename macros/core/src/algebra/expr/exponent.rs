//! Exponents of powers, and how products add them.

use super::{Graph, Id, Node};
use crate::algebra::rational::Rational;

/// An exponent: a fraction, plus an expression in parameters if it is real.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Exponent {
    /// The expression in parameters, without rational part.
    pub real: Option<Id>,
    /// The rational part.
    pub rational: Rational,
}

impl Exponent {
    /// The exponent 1.
    pub const ONE: Self = Self::rational(Rational::ONE);

    /// A fraction.
    #[must_use]
    pub const fn rational(rational: Rational) -> Self {
        Self { real: None, rational }
    }

    /// A whole number.
    #[must_use]
    pub const fn integer(value: i64) -> Self {
        Self::rational(Rational::integer(value))
    }

    /// The exponent as a whole number, if it is one.
    pub(crate) fn as_integer(self) -> Option<i64> {
        if self.real.is_some() { None } else { self.rational.as_integer() }
    }

    /// True if it is n/3: negative numbers have cube roots, by [`cbrt`](f64::cbrt).
    pub(crate) fn is_of_cube_root(self) -> bool {
        self.real.is_none() && self.rational.denominator() == 3
    }

    pub(super) fn is_zero(self) -> bool {
        self.real.is_none() && self.rational.is_zero()
    }
}

impl Graph {
    /// Sum of two exponents.
    pub fn add_exponents(&mut self, a: Exponent, b: Exponent) -> Exponent {
        let real = match (a.real, b.real) {
            (Some(a), Some(b)) => Some(self.add(a, b)).filter(|&sum| !self.is_zero(sum)),
            (real, None) | (None, real) => real,
        };
        Exponent { real, rational: self.exact(a.rational.checked_add(b.rational)) }
    }

    pub(super) fn scale_exponent(&mut self, exponent: Exponent, n: i64) -> Exponent {
        let factor = Rational::integer(n);
        Exponent {
            real: exponent.real.filter(|_| n != 0).map(|real| self.scale(real, factor)),
            rational: self.exact(exponent.rational.checked_mul(factor)),
        }
    }

    /// An exponent whose expression in parameters has been replaced, without rational part in that.
    pub(super) fn normal_exponent(&mut self, exponent: Exponent) -> Exponent {
        let Some(real) = exponent.real else { return exponent };
        let shift = self.exponent(real);
        self.add_exponents(Exponent::rational(exponent.rational), shift)
    }

    /// An expression in parameters as an exponent.
    pub fn exponent(&mut self, id: Id) -> Exponent {
        if let Node::Linear { constant, terms } = self.node(id).clone() {
            let real = (!terms.is_empty()).then(|| self.linear(Rational::ZERO, &terms));
            return Exponent { real, rational: constant };
        }
        Exponent { real: Some(id), rational: Rational::ZERO }
    }

    /// An exponent as an expression.
    pub fn exponent_value(&mut self, exponent: Exponent) -> Id {
        let terms: Vec<_> = exponent.real.iter().map(|&real| (real, Rational::ONE)).collect();
        self.linear(exponent.rational, &terms)
    }
}
