//! Evaluation of expressions as they are defined, without schedule or emission.
//!
//! The values of a parameter that is a function are not known here: another function stands for it.
//!
//! Three users: the parity decisions of [`crate::algebra::quotient`], the checks of `judge`, and
//! tests, as an oracle for the emitted code.

use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};

/// A point: values of everything that an expression may name.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// λ1, λ2, λ3.
    pub stretches: [f64; 3],
    /// Entries of each parameter; one entry for a scalar. Points that differ in their stretches share them.
    pub parameters: Rc<Vec<Vec<f64>>>,
    /// Number of entries of each length.
    pub lengths: Vec<usize>,
    /// Threshold of the extension.
    pub epsilon: f64,
}

/// A value with the magnitude that bounds its rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// The value with every subtraction replaced by an addition of magnitudes: rounding errors are a few u of
    /// it.
    pub magnitude: f64,
}

/// Evaluates a node at a point.
#[must_use]
pub fn evaluate(graph: &Graph, id: Id, point: &Point) -> Estimate {
    evaluate_with(graph, id, point, &mut Memo::default())
}

/// Values of nodes at one point.
#[derive(Debug, Default)]
pub struct Memo {
    values: FxHashMap<Id, Estimate>,
    /// Values in the bodies of sums over lists, for each entry.
    entries: Vec<Memo>,
}

impl Memo {
    /// The value of one node, taken for given.
    pub fn of(id: Id, value: Estimate) -> Self {
        Self { values: FxHashMap::from_iter([(id, value)]), entries: Vec::new() }
    }
}

/// Evaluates one of several nodes at a point: `memo` keeps the values of all nodes evaluated there.
pub fn evaluate_with(graph: &Graph, id: Id, point: &Point, memo: &mut Memo) -> Estimate {
    Interpreter { graph, point, entry: 0, memo }.value(id)
}

struct Interpreter<'a> {
    graph: &'a Graph,
    point: &'a Point,
    entry: usize,
    memo: &'a mut Memo,
}

impl Interpreter<'_> {
    fn value(&mut self, id: Id) -> Estimate {
        once!(self.memo.values, id, self.rule(id))
    }

    fn rule(&mut self, id: Id) -> Estimate {
        let exact = |value: f64| Estimate { value, magnitude: value.abs() };
        let Point { stretches, epsilon, .. } = *self.point;
        match self.graph.node(id) {
            Node::Stretch(i) => exact(stretches[*i]),
            Node::Strain(i) => exact(stretches[*i] - 1.0),
            Node::Parameter(k) => exact(self.point.parameters[*k][0]),
            Node::Entry(k) => exact(self.point.parameters[*k][self.entry]),
            Node::Float(bits) => exact(f64::from_bits(*bits)),
            Node::Epsilon => exact(epsilon),
            Node::Linear { constant, terms } => {
                let mut sum = exact(constant.to_f64());
                for &(term, coefficient) in terms {
                    let Estimate { value, magnitude } = self.value(term);
                    sum.value += coefficient.to_f64() * value;
                    sum.magnitude += coefficient.to_f64().abs() * magnitude;
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = exact(1.0);
                for &(base, exponent) in factors {
                    let Estimate { value, magnitude } = self.power(base, exponent);
                    product.value *= value;
                    product.magnitude *= magnitude;
                }
                product
            }
            Node::Excess(squares, _) => exact(self.value(*squares).value.max(0.0)),
            Node::Accurate(value, _) => self.value(*value),
            Node::Apply(function, a) => self.apply(*function, *a),
            Node::Quotient(function, a, b) => self.quotient(*function, *a, *b),
            Node::Sum(length, body) => {
                let mut sum = exact(0.0);
                let (graph, point, entries) = (self.graph, self.point, &mut self.memo.entries);
                let length = point.lengths[*length];
                entries.resize_with(entries.len().max(length), Memo::default);
                for (entry, memo) in entries[..length].iter_mut().enumerate() {
                    let Estimate { value, magnitude } =
                        Interpreter { graph, point, entry, memo }.value(*body);
                    sum.value += value;
                    sum.magnitude += magnitude;
                }
                sum
            }
            Node::Extended(function, order, i) => {
                let above = stretches[*i].max(epsilon);
                let below = stretches[*i] - above;
                let mut derivative = |k| self.plain_derivative(*function, k, above);
                let value = match order {
                    0 => derivative(0) + derivative(1) * below + derivative(2) * below * below / 2.0,
                    1 => derivative(1) + derivative(2) * below,
                    2 => derivative(2),
                    _ => 0.0,
                };
                exact(value)
            }
            Node::Above(i) => exact(stretches[*i].max(epsilon)),
            Node::Below(i) => exact((stretches[*i] - epsilon).min(0.0)),
            Node::ShareAbove(i, j) => exact(share_above(stretches[*i], stretches[*j], epsilon)),
            Node::ShareBelow(i, j) => exact(1.0 - share_above(stretches[*i], stretches[*j], epsilon)),
            Node::WhereNegative(condition, a, b) => {
                let is_negative = self.value(*condition).value < 0.0;
                self.value(if is_negative { *a } else { *b })
            }
            Node::PoleQuotient(a, b) => {
                let Estimate { value, magnitude } = self.value(*a);
                let denominator = self.value(*b).value;
                Estimate { value: value / denominator, magnitude: (magnitude / denominator).abs() }
            }
        }
    }

    fn apply(&mut self, function: Function, a: Id) -> Estimate {
        let Estimate { value, magnitude } = self.value(a);
        match function {
            Function::Ln => {
                Estimate { value: value.ln(), magnitude: value.ln().abs() + (magnitude / value).abs() }
            }
            Function::Exp => Estimate { value: value.exp(), magnitude: value.exp() * (1.0 + magnitude) },
            Function::Elementary(function) => {
                let (found, slope) = (function.value(value), function.slope(value));
                Estimate { value: found, magnitude: found.abs() + (slope * magnitude).abs() }
            }
            Function::Power(exponent) => self.power(a, exponent),
            Function::WholePower(n, order) => {
                let n = self.value(n).value;
                let factor = falling(n, order);
                let power = (n - f64::from(order)).max(0.0) as i32;
                Estimate { value: factor * value.powi(power), magnitude: factor * magnitude.powi(power) }
            }
            Function::Given(k, order) => {
                Estimate { value: stand_in(k, order, value), magnitude: 4.0 * (1.0 + magnitude) }
            }
        }
    }

    /// A divided difference, without rounding errors of its arguments unless the function is a whole power.
    fn quotient(&mut self, function: Function, a: Id, b: Id) -> Estimate {
        let (a, b) = (self.value(a), self.value(b));
        let value = match function {
            Function::Ln => ln_quotient(a.value, b.value),
            Function::Exp => exp_quotient(a.value, b.value),
            Function::Elementary(function) => function.quotient_value(a.value, b.value),
            Function::Power(exponent) => power_quotient(a.value, b.value, self.exponent(exponent)),
            Function::WholePower(n, order) => {
                let n = self.value(n).value;
                let terms = (n - f64::from(order)).max(0.0) as i32;
                let sum =
                    |a: f64, b: f64| -> f64 { (0..terms).map(|k| a.powi(terms - 1 - k) * b.powi(k)).sum() };
                let factor = falling(n, order);
                return Estimate {
                    value: factor * sum(a.value, b.value),
                    magnitude: factor * sum(a.magnitude, b.magnitude),
                };
            }
            Function::Given(k, order) => stand_in_quotient(k, order, a.value, b.value),
        };
        Estimate { value, magnitude: value.abs() }
    }

    fn exponent(&mut self, exponent: Exponent) -> f64 {
        exponent.rational.to_f64() + exponent.real.map_or(0.0, |real| self.value(real).value)
    }

    fn power(&mut self, base: Id, exponent: Exponent) -> Estimate {
        let Estimate { value, magnitude } = self.value(base);
        // Whole positive powers are products of bases that may have cancelled; for others, a relative error
        // of the base is multiplied by the exponent.
        if let Some(n @ 0..) = exponent.as_integer() {
            return Estimate { value: value.powi(n as i32), magnitude: magnitude.powi(n as i32) };
        }
        let r = self.exponent(exponent);
        let power = match exponent {
            // A negative number has such powers by its real cube root: J^(−2/3) is even in each stretch.
            exponent if exponent.is_of_cube_root() => value.cbrt().powi(exponent.rational.numerator() as i32),
            _ if r.fract() == 0.0 => value.powi(r as i32),
            _ => value.powf(r),
        };
        // A base that has cancelled altogether has no relative error.
        if value == 0.0 {
            return Estimate { value: power, magnitude: magnitude.powf(r) };
        }
        Estimate {
            value: power,
            magnitude: power.abs() * (1.0 + (r * (magnitude / value.abs() - 1.0)).abs()),
        }
    }

    fn plain_derivative(&mut self, function: Function, order: u8, x: f64) -> f64 {
        match function {
            Function::Power(exponent) => {
                let r = self.exponent(exponent);
                falling(r, order) * x.powf(r - f64::from(order))
            }
            _ => match order {
                0 => x.ln(),
                1 => 1.0 / x,
                _ => -1.0 / (x * x),
            },
        }
    }
}

/// r (r − 1) … (r − order + 1).
fn falling(r: f64, order: u8) -> f64 {
    (0..order).map(|k| r - f64::from(k)).product()
}

/// Derivative of the function that stands for a parameter: neither even nor odd, and different for each
/// parameter.
fn stand_in(parameter: usize, order: u8, x: f64) -> f64 {
    stand_in_scale(order) * (FREQUENCY * x + stand_in_phase(parameter, order)).sin()
}

/// Divided difference of [`stand_in`]: sin x − sin y = 2 cos((x + y)/2) sin((x − y)/2).
fn stand_in_quotient(parameter: usize, order: u8, a: f64, b: f64) -> f64 {
    let (middle, half) = (FREQUENCY * 0.5 * (a + b), FREQUENCY * 0.5 * (a - b));
    let shrunk = if half == 0.0 { 1.0 } else { half.sin() / half };
    FREQUENCY * stand_in_scale(order) * (middle + stand_in_phase(parameter, order)).cos() * shrunk
}

const FREQUENCY: f64 = 1.3;

fn stand_in_scale(order: u8) -> f64 {
    FREQUENCY.powi(i32::from(order))
}

fn stand_in_phase(parameter: usize, order: u8) -> f64 {
    0.7 + parameter as f64 + f64::from(order) * std::f64::consts::FRAC_PI_2
}

// Divided differences to a few u at every gap, by the functions of the standard library that are made for
// small arguments, and not by the series of the runtime, which are judged with them.

/// (ln a − ln b)/(a − b).
fn ln_quotient(a: f64, b: f64) -> f64 {
    if a == b { 1.0 / a } else { ln_ratio(a, b) / (a - b) }
}

/// ln(a/b); NaN unless both have a logarithm.
fn ln_ratio(a: f64, b: f64) -> f64 {
    let gap = (a - b) / b;
    match a > 0.0 && b > 0.0 {
        true if gap.abs() < 0.5 => gap.ln_1p(),
        true => (a / b).ln(),
        false => f64::NAN,
    }
}

/// (eᵃ − eᵇ)/(a − b).
fn exp_quotient(a: f64, b: f64) -> f64 {
    if a == b {
        return a.exp();
    }
    // From the larger one, so that nothing overflows but the result.
    let gap = (a - b).abs();
    -a.max(b).exp() * (-gap).exp_m1() / gap
}

/// (aʳ − bʳ)/(a − b).
fn power_quotient(a: f64, b: f64, r: f64) -> f64 {
    if a == b {
        return r * a.powf(r - 1.0);
    }
    if !(a > 0.0 && b > 0.0) {
        return (a.powf(r) - b.powf(r)) / (a - b);
    }
    // From the larger power.
    let (large, small) = if (a > b) == (r > 0.0) { (a, b) } else { (b, a) };
    -large.powf(r) * (r * ln_ratio(small, large)).exp_m1() / (large - small)
}

fn share_above(a: f64, b: f64, epsilon: f64) -> f64 {
    if a == b { f64::from(u8::from(a >= epsilon)) } else { (a.max(epsilon) - b.max(epsilon)) / (a - b) }
}
