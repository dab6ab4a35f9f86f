//! Expressions of random energies: the text of each, and what it must be.

use std::rc::Rc;

use super::polynomial::{Function, Polynomial};
use super::quantity::Quantity;

/// An invariant by its name in declarations.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(missing_docs, reason = "each is named as in declarations")]
pub enum Invariant {
    I1,
    I2,
    J,
    I1b,
    I2b,
}

/// What an expression depends on.
#[derive(Clone, Copy)]
pub struct Scope {
    /// λ1, λ2, λ3.
    pub stretches: [Quantity; 3],
    /// The stretches that the names of a closure stand for.
    bound: [usize; 2],
    /// The current entry of a sum over lists.
    entry: usize,
}

impl Scope {
    /// That of a whole energy.
    pub fn new(stretches: [Quantity; 3]) -> Self {
        Self { stretches, bound: [0; 2], entry: 0 }
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

/// An expression, as it is printed and as it is evaluated.
#[derive(Clone)]
pub struct Expression {
    /// Its text in a declaration.
    pub text: String,
    value: Rc<dyn Fn(&Scope) -> Quantity>,
}

impl Expression {
    fn new(text: String, value: impl Fn(&Scope) -> Quantity + 'static) -> Self {
        Self { text, value: Rc::new(value) }
    }

    /// What it must be.
    pub fn at(&self, scope: &Scope) -> Quantity {
        (self.value)(scope)
    }
}

/// A number that is exact in decimal digits.
pub(super) fn number((numerator, denominator): (i32, i32)) -> Expression {
    let [numerator, denominator] = [numerator, denominator].map(f64::from);
    let value = move |_: &Scope| Quantity::fraction(numerator, denominator);
    Expression::new(format!("{:?}", numerator / denominator), value)
}

pub(super) fn parameter(name: &str, value: f64) -> Expression {
    Expression::new(name.to_owned(), move |_| Quantity::constant(value))
}

/// The current entry of a parameter that is a list, inside of a sum over it.
pub(super) fn entry(name: &str, values: Vec<f64>) -> Expression {
    Expression::new(format!("{name}[p]"), move |scope| Quantity::constant(values[scope.entry]))
}

/// An invariant.
pub fn invariant(invariant: Invariant) -> Expression {
    Expression::new(format!("{invariant:?}"), move |scope| scope.invariant(invariant))
}

/// I1b − 3 or I2b − 3 as the base of a real power: a sum of squares, which is known as well as the stretches
/// are, though it is printed as a difference.
pub(super) fn excess(invariant: Invariant) -> Expression {
    Expression::new(format!("({invariant:?} - 3.0)"), move |scope| {
        let value = scope.invariant(invariant) + Quantity::constant(-3.0);
        Quantity { error: Polynomial::constant(0.0), ..value }.rounded()
    })
}

/// A stretch of the sum around: the first name of its closure, or the second.
pub(super) fn stretch(k: usize) -> Expression {
    Expression::new(["a", "b"][k].to_owned(), move |scope| scope.stretches[scope.bound[k]])
}

fn binary(
    operator: char,
    a: Expression,
    b: Expression,
    value: fn(Quantity, Quantity) -> Quantity,
) -> Expression {
    Expression::new(format!("({} {operator} {})", a.text, b.text), move |scope| {
        value(a.at(scope), b.at(scope))
    })
}

pub(super) fn add(a: Expression, b: Expression) -> Expression {
    binary('+', a, b, |a, b| a + b)
}

pub(super) fn sub(a: Expression, b: Expression) -> Expression {
    binary('-', a, b, |a, b| a + b * Quantity::constant(-1.0))
}

pub(super) fn mul(a: Expression, b: Expression) -> Expression {
    binary('*', a, b, |a, b| a * b)
}

pub(super) fn div(a: Expression, b: Expression) -> Expression {
    binary('/', a, b, |a, b| a * b.power(-1))
}

/// A whole power.
pub fn whole(a: Expression, n: i32) -> Expression {
    Expression::new(format!("{}.powi({n})", a.text), move |scope| a.at(scope).power(n))
}

/// A real power, whose exponent is made of numbers and parameters.
pub(super) fn real(a: Expression, exponent: Expression) -> Expression {
    Expression::new(format!("{}.powf({})", a.text, exponent.text), move |scope| {
        a.at(scope).real_power(exponent.at(scope))
    })
}

pub(super) fn of(function: Function, a: Expression) -> Expression {
    Expression::new(format!("{}.{}()", a.text, function.name()), move |scope| {
        let a = a.at(scope);
        a.function(function.taylor(a.exact.0[0]))
    })
}

/// Σ over the three stretches.
pub(super) fn over_stretches(body: Expression) -> Expression {
    over("a", body, &[[0, 0], [1, 1], [2, 2]])
}

/// Σ over the pairs of stretches.
pub(super) fn over_pairs(body: Expression) -> Expression {
    over("a, b", body, &[[0, 1], [1, 2], [2, 0]])
}

fn over(names: &str, body: Expression, places: &'static [[usize; 2]; 3]) -> Expression {
    Expression::new(format!("sum(|{names}| {})", body.text), move |scope| {
        let terms = places.iter().map(|&bound| body.at(&Scope { bound, ..*scope }));
        terms.fold(Quantity::constant(0.0), |total, term| total + term)
    })
}

/// Σ over the two entries of lists.
pub(super) fn over_lists(body: Expression) -> Expression {
    Expression::new(format!("sum(|p| {})", body.text), move |scope| {
        body.at(&Scope { entry: 0, ..*scope }) + body.at(&Scope { entry: 1, ..*scope })
    })
}
