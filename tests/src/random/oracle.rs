//! Reference values of an energy and its derivatives, from the generator's expression as it is printed.
//!
//! Taylor polynomials of degree 2 in 256 bits give ψ, ψi and ψij; flips and twists are their definition, (ψi
//! ∓ ψj)/(λi ∓ λj), at stretches that are moved by 2⁻⁷⁰ of themselves, so that no gap is zero. This changes a
//! value by 2⁻¹⁷ u times its sensitivity, and leaves the definition about 100 bits after it has divided by
//! the gap twice.
//!
//! In addition there are two estimates in `f64`: polynomials of degree 3, for how sensitive ψij is; and the
//! errors that ψ, ψi and ψij would have if the formula as printed, and its derivatives by the rules of
//! calculus, were evaluated with each operation rounded, in units of u. Nothing that evaluates a formula as
//! it is printed can do better where it subtracts what it has rounded.

use std::ops::{Add, Mul};

use piola::Real;
use piola::material::PAIRS;

use super::generator::{Declaration, Expression, Invariant};
use super::polynomial::{CUBIC, Function, Polynomial, QUADRATIC, real_power, whole_power};
use crate::multiprecision::Multiprecision;

/// 256 bits.
pub type Number = Multiprecision<4>;

/// A reference value, and how exactly it can be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// The value.
    pub value: Number,
    /// |value| + Σ|λk ∂value/∂λk|; for quotients with |ψii| + |ψij|, of which they are a mean. For values by
    /// strains, changes are relative to those.
    pub scale: f64,
    /// The error of the formula as printed, in units of u.
    pub printed: f64,
}

/// Everything at one point.
#[derive(Clone, Debug)]
pub struct Point {
    /// The largest magnitude of a part of the formula, or the reciprocal of the smallest one.
    pub range: f64,
    /// ψ.
    pub energy: Expected,
    /// ψ1, ψ2, ψ3.
    pub gradient: [Expected; 3],
    /// ψ11, ψ22, ψ33, ψ12, ψ13, ψ23.
    pub hessian: [Expected; 6],
    /// D⁻ of the pairs.
    pub flip: [Expected; 3],
    /// D⁺ of the pairs.
    pub twist: [Expected; 3],
}

/// Relative distance by which stretches are moved apart.
const NUDGE: f64 = 1.0 / (1u128 << 70) as f64;

/// Quotients whose denominator is a larger share of the stretches than this may be computed as they are
/// defined.
const WIDE: f64 = 0.1;

/// All values at stretches, none of which is zero.
#[must_use]
pub fn at_stretches(declaration: &Declaration, stretches: [f64; 3]) -> Point {
    let moved: [Number; 3] = std::array::from_fn(|k| {
        let factor = Number::splat(1.0) + Number::splat([2.0, -1.0, 0.5][k] * NUDGE);
        Number::splat(stretches[k]) * factor
    });
    let psi = energy(declaration, moved);
    let relative = |slopes: [f64; 3]| (0..3).map(|k| (stretches[k] * slopes[k]).abs()).sum::<f64>();
    let value_of = |by: &[usize], slopes: [f64; 3]| {
        let value = psi.exact.derivative(by);
        Expected { value, scale: value.to_f64().abs() + relative(slopes), printed: psi.error.derivative(by) }
    };
    let first = |i: usize| psi.exact.derivative(&[i]);
    let second = |i: usize, j: usize| psi.exact.derivative(&[i, j]);
    let gradient = [0, 1, 2].map(|i| value_of(&[i], [0, 1, 2].map(|k| second(i, k).to_f64())));
    let hessian = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        .map(|(i, j)| value_of(&[i, j], [0, 1, 2].map(|k| psi.rough.derivative(&[i, j, k]))));
    let quotient = |(i, j): (usize, usize), sign: f64| {
        let signed = Number::splat(sign);
        let denominator = moved[i] + signed * moved[j];
        let value = (first(i) + signed * first(j)) / denominator;
        let slopes = [0, 1, 2].map(|k| {
            let change =
                if k == i { Number::splat(1.0) } else { Number::splat(if k == j { sign } else { 0.0 }) };
            ((second(i, k) + signed * second(j, k) - value * change) / denominator).to_f64()
        });
        let mean = second(i, i).abs().to_f64() + second(i, j).abs().to_f64();
        let error = |by: &[usize]| psi.error.derivative(by);
        let mut printed = error(&[i, i]) + error(&[j, j]) + error(&[i, j]);
        let gap = denominator.abs().to_f64();
        if gap > WIDE * stretches[i].abs().max(stretches[j].abs()) {
            printed += (error(&[i]) + error(&[j])) / gap;
        }
        Expected { value, scale: value.to_f64().abs().max(mean) + relative(slopes), printed }
    };
    Point {
        range: psi.range,
        energy: value_of(&[], [0, 1, 2].map(|k| first(k).to_f64())),
        gradient,
        hessian,
        flip: PAIRS.map(|pair| quotient(pair, -1.0)),
        twist: PAIRS.map(|pair| quotient(pair, 1.0)),
    }
}

/// ψ1, ψ2, ψ3 at principal strains, which are exact and may be far below u.
#[must_use]
pub fn at_strains(declaration: &Declaration, strains: [f64; 3]) -> [Expected; 3] {
    let is_stressed = declaration.words.contains(&"prestressed");
    let psi = energy(declaration, strains.map(|strain| Number::splat(1.0) + Number::splat(strain)));
    [0, 1, 2].map(|i| {
        let value = psi.exact.derivative(&[i]);
        let sum = |of: &dyn Fn(usize) -> f64| (0..3).map(|k| (strains[k] * of(k)).abs()).sum::<f64>();
        let sensitivity = sum(&|k| psi.exact.derivative(&[i, k]).to_f64());
        let at_rest = if is_stressed { psi.error.derivative(&[i]) } else { 0.0 };
        let printed = at_rest + sum(&|k| psi.error.derivative(&[i, k]));
        Expected { value, scale: value.to_f64().abs() + sensitivity, printed }
    })
}

/// A quantity with its estimates.
#[derive(Clone, Copy)]
struct Quantity {
    exact: Polynomial<Number, QUADRATIC>,
    /// An estimate of it to degree 3.
    rough: Polynomial<f64, CUBIC>,
    /// Errors of the coefficients in units of u.
    error: Polynomial<f64, QUADRATIC>,
    /// The largest magnitude of a value on the way, or the reciprocal of the smallest one.
    range: f64,
}

impl Quantity {
    fn exact(exact: Polynomial<Number, QUADRATIC>) -> Self {
        let rough =
            Polynomial(std::array::from_fn(|k| if k < QUADRATIC { exact.0[k].to_f64() } else { 0.0 }));
        Self { exact, rough, error: Polynomial::constant(0.0), range: 1.0 }
    }

    fn constant(value: Number) -> Self {
        Self::exact(Polynomial::constant(value))
    }

    /// A result of an operation, with its own rounding errors, and estimates that do not drift.
    fn rounded(mut self) -> Self {
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
    fn function(self, taylor: [Number; 4]) -> Self {
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

    fn times(self, factor: f64) -> Self {
        self * Self::constant(Number::splat(factor))
    }

    fn power(self, n: i32) -> Self {
        let taylor = whole_power(self.exact.0[0], n);
        if n < 0 {
            return self.function(taylor);
        }
        // Of a value that cancels altogether even the third derivative may be zero, and the error's is not.
        self.with_magnitudes(taylor, whole_power(self.magnitudes().0[0], n).map(f64::abs))
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

fn energy(declaration: &Declaration, stretches: [Number; 3]) -> Quantity {
    let stretches = [0, 1, 2].map(|k| Quantity::exact(Polynomial::stretch(k, stretches[k])));
    let mut evaluator = Evaluator { declaration, stretches, bound: Vec::new(), entry: 0 };
    let terms: Vec<_> = declaration.terms.iter().map(|term| evaluator.value(term)).collect();
    terms.into_iter().reduce(Add::add).unwrap_or(Quantity::constant(Number::splat(0.0)))
}

struct Evaluator<'a> {
    declaration: &'a Declaration,
    stretches: [Quantity; 3],
    /// The stretches that the names of a closure stand for.
    bound: Vec<usize>,
    /// The current entry of a sum over lists.
    entry: usize,
}

impl Evaluator<'_> {
    fn value(&mut self, expression: &Expression) -> Quantity {
        use Expression as E;
        let parameter = |name: &str, entry: usize| {
            let found = self.declaration.parameters.iter().find(|parameter| parameter.name == name);
            Quantity::constant(Number::splat(found.map_or(f64::NAN, |parameter| parameter.values[entry])))
        };
        match expression {
            E::Number(numerator, denominator) => {
                let [numerator, denominator] = [numerator, denominator].map(|&n| Number::splat(f64::from(n)));
                Quantity::constant(numerator / denominator).rounded()
            }
            E::Parameter(name) => parameter(name, 0),
            E::Entry(name) => parameter(name, self.entry),
            E::Invariant(invariant) => self.invariant(*invariant),
            E::Excess(invariant) => {
                let value = self.invariant(*invariant) + Quantity::constant(Number::splat(-3.0));
                // A sum of squares, which is known as well as the stretches are.
                Quantity { error: Polynomial::constant(0.0), ..value }.rounded()
            }
            E::Stretch(k) => self.stretches[self.bound[*k]],
            E::Add(a, b) => self.value(a) + self.value(b),
            E::Sub(a, b) => self.value(a) + self.value(b).times(-1.0),
            E::Mul(a, b) => self.value(a) * self.value(b),
            E::Div(a, b) => self.value(a) * self.value(b).power(-1),
            E::Whole(a, n) => self.value(a).power(*n),
            E::Real(a, exponent) => {
                let exponent = self.value(exponent);
                let base = self.value(a);
                let taylor = real_power(base.exact.0[0], exponent.exact.0[0]);
                let mut power = base.function(taylor);
                // xʳ changes by ln x times a change of r, and its derivatives about as much.
                let change = exponent.error.0[0] * base.exact.0[0].ln().to_f64().abs();
                let terms = base.magnitudes().compose(taylor.map(|x| x.to_f64().abs()));
                power.error = power.error + terms * Polynomial::constant(change);
                power
            }
            E::Of(function, a) => {
                let a = self.value(a);
                a.function(function.taylor(a.exact.0[0]))
            }
            E::OverStretches(body) => self.sum_over(body, &[&[0], &[1], &[2]]),
            E::OverPairs(body) => self.sum_over(body, &[&[0, 1], &[1, 2], &[2, 0]]),
            E::OverLists(body) => {
                let entries = (0..2).map(|entry| {
                    self.entry = entry;
                    self.value(body)
                });
                let entries: Vec<_> = entries.collect();
                entries.into_iter().reduce(Add::add).unwrap_or(Quantity::constant(Number::splat(0.0)))
            }
        }
    }

    fn sum_over(&mut self, body: &Expression, places: &[&[usize]]) -> Quantity {
        let mut total = Quantity::constant(Number::splat(0.0));
        for place in places {
            self.bound = place.to_vec();
            total = total + self.value(body);
        }
        total
    }

    fn invariant(&self, invariant: Invariant) -> Quantity {
        let [a, b, c] = self.stretches;
        let isochoric =
            |volume: Quantity, n: i32| volume.function(Function::Cbrt.taylor(volume.exact.0[0])).power(n);
        match invariant {
            Invariant::I1 => a * a + b * b + c * c,
            Invariant::I2 => a * a * b * b + b * b * c * c + c * c * a * a,
            Invariant::J => a * b * c,
            Invariant::I1b => isochoric(a * b * c, -2) * self.invariant(Invariant::I1),
            Invariant::I2b => isochoric(a * b * c, -4) * self.invariant(Invariant::I2),
        }
    }
}
