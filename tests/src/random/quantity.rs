//! Quantities with what may be asked of their digits.
//!
//! In addition to the Taylor polynomial of degree 2 in 256 bits there are two estimates in `f64`: a
//! polynomial of degree 3, for how sensitive second derivatives are; and the errors that the value and its
//! derivatives would have if the formula as printed, and its derivatives by the rules of calculus, were
//! evaluated with each operation rounded, in units of u. Nothing that evaluates a formula as it is printed
//! can do better where it subtracts what it has rounded.

use std::ops::{Add, Mul};

use piola::Real;

use super::polynomial::{CUBIC, Polynomial, QUADRATIC, real_power, whole_power};
use crate::multiprecision::Multiprecision;

/// 256 bits.
pub type Number = Multiprecision<4>;

/// A quantity with its estimates.
#[derive(Clone, Copy)]
pub struct Quantity {
    /// Its Taylor polynomial.
    pub exact: Polynomial<Number, QUADRATIC>,
    /// An estimate of it to degree 3, for how sensitive second derivatives are.
    pub rough: Polynomial<f64, CUBIC>,
    /// Errors of the coefficients in units of u.
    pub error: Polynomial<f64, QUADRATIC>,
    /// The largest magnitude of a value on the way, or the reciprocal of the smallest one.
    pub range: f64,
}

impl Quantity {
    fn exact(exact: Polynomial<Number, QUADRATIC>) -> Self {
        let rough =
            Polynomial(std::array::from_fn(|k| if k < QUADRATIC { exact.0[k].to_f64() } else { 0.0 }));
        Self { exact, rough, error: Polynomial::constant(0.0), range: 1.0 }
    }

    /// λk.
    pub(super) fn stretch(k: usize, value: Number) -> Self {
        Self::exact(Polynomial::stretch(k, value))
    }

    /// A number that is exact in `f64`.
    pub(super) fn constant(value: f64) -> Self {
        Self::exact(Polynomial::constant(Number::splat(value)))
    }

    /// A fraction, which `f64` may round.
    pub(super) fn fraction(numerator: f64, denominator: f64) -> Self {
        let value = Number::splat(numerator) / Number::splat(denominator);
        Self::exact(Polynomial::constant(value)).rounded()
    }

    /// A result of an operation, with its own rounding errors, and estimates that do not drift.
    pub(super) fn rounded(mut self) -> Self {
        for k in 0..QUADRATIC {
            self.rough.0[k] = self.exact.0[k].to_f64();
        }
        self.error = self.error + self.magnitudes();
        let size = self.rough.0[0].abs();
        self.range = self.range.max(size);
        if Number::splat(0.0).less(self.exact.0[0].abs()) {
            self.range = self.range.max(1.0 / size);
        }
        self
    }

    /// Magnitudes of the coefficients as they would be computed, errors included: what cancels altogether
    /// leaves its error, and a power of it that of the error.
    fn magnitudes(&self) -> Polynomial<f64, QUADRATIC> {
        Polynomial(std::array::from_fn(|k| self.rough.0[k].abs() + f64::UNIT_ROUNDOFF * self.error.0[k]))
    }

    /// φ of the quantity. An error of its value moves all coefficients, which are those of φ′ for this
    /// purpose.
    pub(super) fn function(self, taylor: [Number; 4]) -> Self {
        let [t0, t1, t2, t3] = taylor.map(|coefficient| coefficient.to_f64().abs());
        let e = f64::UNIT_ROUNDOFF * self.error.0[0];
        // Magnitudes of φ and of φ′ anywhere within the error of the value.
        let near =
            [t0 + e * (t1 + e * (t2 + e * t3)), t1 + e * (2.0 * t2 + e * 3.0 * t3), t2 + e * 3.0 * t3, t3];
        self.with_magnitudes(taylor, near)
    }

    fn with_magnitudes(self, taylor: [Number; 4], near: [f64; 4]) -> Self {
        let slope = [near[1], 2.0 * near[2], 3.0 * near[3], 0.0];
        let error = self.magnitudes().compose(slope) * self.error;
        let terms = self.magnitudes().compose(near);
        let rough = self.rough.compose(taylor.map(Number::to_f64));
        Self { exact: self.exact.compose(taylor), rough, error: error + terms, range: self.range }.rounded()
    }

    pub(super) fn power(self, n: i32) -> Self {
        let taylor = whole_power(self.exact.0[0], n);
        if n < 0 {
            return self.function(taylor);
        }
        // Of a value that cancels altogether even the third derivative may be zero, and the error's is not.
        self.with_magnitudes(taylor, whole_power(self.magnitudes().0[0], n).map(f64::abs))
    }

    pub(super) fn real_power(self, exponent: Self) -> Self {
        let taylor = real_power(self.exact.0[0], exponent.exact.0[0]);
        let mut power = self.function(taylor);
        // xʳ changes by ln x times a change of r, and its derivatives about as much.
        let change = exponent.error.0[0] * self.exact.0[0].ln().to_f64().abs();
        let terms = self.magnitudes().compose(taylor.map(|x| x.to_f64().abs()));
        power.error = power.error + terms * Polynomial::constant(change);
        power
    }
}

impl Add for Quantity {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            exact: self.exact + other.exact,
            rough: self.rough + other.rough,
            error: self.error + other.error,
            range: self.range.max(other.range),
        }
        .rounded()
    }
}

impl Mul for Quantity {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let [a, b] = [self.magnitudes(), other.magnitudes()];
        Self {
            exact: self.exact * other.exact,
            rough: self.rough * other.rough,
            error: a * other.error + self.error * b + a * b,
            range: self.range.max(other.range),
        }
        .rounded()
    }
}
