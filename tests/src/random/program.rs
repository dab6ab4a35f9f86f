//! Scheduled programs, run as they are: the operations of generated code, in its order, with its kernels.
//!
//! What the emitter writes as Rust is done here one operation at a time. So the results have the bits of
//! generated code, which `tests/random.rs` proves for the catalogue.

use piola::__private::{
    self as kernels, Pair, above_zero, exp_quotient, ln_product, pole_floor, share_above, share_below,
};
use piola::Real;
use piola_codegen::algebra::expr::Elementary;
use piola_codegen::read::parse::Declaration;
use piola_codegen::schedule::{Op, Program, Statement, Value};

/// Values of everything that a program reads.
#[derive(Clone, Debug)]
pub struct Inputs<R> {
    /// λ1, λ2, λ3.
    pub stretches: [R; 3],
    /// λk − 1, for programs by strains.
    pub strains: [R; 3],
    /// The threshold of an extension.
    pub epsilon: f64,
}

/// Values of the parameters of a declaration, which must all be numbers or lists of numbers.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    /// Entries of each parameter; one entry for a scalar.
    pub values: Vec<Vec<f64>>,
    /// Number of entries of each length.
    pub lengths: Vec<usize>,
}

impl Parameters {
    /// The values in the order of the declaration.
    #[must_use]
    pub fn new(declaration: &Declaration, values: &[&[f64]]) -> Self {
        let mut lengths = vec![0; declaration.lengths.len()];
        for (parameter, list) in declaration.parameters.iter().zip(values) {
            if let Some(length) = parameter.length() {
                lengths[length] = list.len();
            }
        }
        Self { values: values.iter().map(|list| list.to_vec()).collect(), lengths }
    }
}

/// The outputs of a program.
#[must_use]
pub fn run<R: Real>(program: &Program, parameters: &Parameters, inputs: &Inputs<R>) -> Vec<R> {
    let mut machine = Machine { parameters, inputs, entry: 0, values: Vec::new() };
    for statement in &program.statements {
        match statement {
            Statement::Let(value, op) => machine.compute(*value, op),
            Statement::Loop { length, body, totals } => {
                let mut sums = vec![R::splat(0.0); totals.len()];
                for entry in 0..parameters.lengths[*length] {
                    machine.entry = entry;
                    body.iter().for_each(|(value, op)| machine.compute(*value, op));
                    for (sum, (_, term)) in sums.iter_mut().zip(totals) {
                        *sum = *sum + machine.number(*term);
                    }
                }
                for (sum, (total, _)) in sums.into_iter().zip(totals) {
                    machine.keep(*total, Kept::Number(sum));
                }
            }
        }
    }
    program.outputs.iter().map(|&output| machine.number(output)).collect()
}

/// The result of an operation.
#[derive(Clone, Copy)]
enum Kept<R: Real> {
    Nothing,
    Number(R),
    Logarithm(R::Logarithm),
    Pair(Pair<R>),
}

struct Machine<'a, R: Real> {
    parameters: &'a Parameters,
    inputs: &'a Inputs<R>,
    /// The current entry of a loop.
    entry: usize,
    values: Vec<Kept<R>>,
}

impl<R: Real> Machine<'_, R> {
    fn keep(&mut self, Value(place): Value, kept: Kept<R>) {
        if place >= self.values.len() {
            self.values.resize(place + 1, Kept::Nothing);
        }
        self.values[place] = kept;
    }

    fn number(&self, value: Value) -> R {
        match self.values[value.0] {
            Kept::Number(number) => number,
            _ => unreachable!("{value:?} is read as a number"),
        }
    }

    fn logarithm(&self, value: Value) -> R::Logarithm {
        match self.values[value.0] {
            Kept::Logarithm(logarithm) => logarithm,
            _ => unreachable!("{value:?} is read as a logarithm"),
        }
    }

    fn pair(&self, value: Value) -> Pair<R> {
        match self.values[value.0] {
            Kept::Pair(pair) => pair,
            _ => unreachable!("{value:?} is read as a pair"),
        }
    }

    fn compute(&mut self, value: Value, op: &Op) {
        let kept = match *op {
            Op::Logarithm(a) => Kept::Logarithm(self.number(a).logarithm()),
            Op::Pair { values, reciprocals, logarithms } => Kept::Pair(Pair::new(
                values.map(|value| self.number(value)),
                reciprocals.map(|value| self.number(value)),
                logarithms.map(|value| self.logarithm(value)),
            )),
            ref op => Kept::Number(self.operation(op)),
        };
        self.keep(value, kept);
    }

    fn operation(&self, op: &Op) -> R {
        let n = |value: Value| self.number(value);
        match *op {
            Op::Literal(bits) => R::splat(f64::from_bits(bits)),
            Op::Stretch(i) => self.inputs.stretches[i],
            Op::Strain(i) => self.inputs.strains[i],
            Op::Parameter(k) => R::splat(self.parameters.values[k][0]),
            Op::Entry(k) => R::splat(self.parameters.values[k][self.entry]),
            Op::Epsilon => R::splat(self.inputs.epsilon),
            Op::PoleFloor => pole_floor(self.inputs.stretches),
            Op::Neg(a) => -n(a),
            Op::Add(a, b) => n(a) + n(b),
            Op::Sub(a, b) => n(a) - n(b),
            Op::Mul(a, b) => n(a) * n(b),
            Op::Div(a, b) => n(a) / n(b),
            Op::MulAdd(a, b, c) => n(a).mul_add(n(b), n(c)),
            Op::NegMulAdd(a, b, c) => (-n(a)).mul_add(n(b), n(c)),
            Op::MulSub(a, b, c) => n(a).mul_add(n(b), -n(c)),
            Op::Sqrt(a) => n(a).sqrt(),
            Op::Cbrt(a) => n(a).cbrt(),
            Op::Ln(a) => n(a).ln(),
            Op::Exp(a) => n(a).exp(),
            Op::Power(logarithm, exponent) => R::power(self.logarithm(logarithm), n(exponent)),
            Op::LnProduct(factors) => ln_product(factors.map(n)),
            Op::Elementary(function, a) => value(function, n(a)),
            Op::ElementaryQuotient(function, a, b) => quotient(function, n(a), n(b)),
            Op::Max(a, b) => n(a).max(n(b)),
            Op::AboveZero(a) => above_zero(n(a)),
            Op::Below(a, b) => (n(a) - n(b)).min(R::splat(0.0)),
            Op::WhereNegative(condition, a, b) => R::select(n(condition).less(R::splat(0.0)), n(a), n(b)),
            Op::ShareAbove(a, b, epsilon) => share_above(n(a), n(b), n(epsilon)),
            Op::ShareBelow(a, b, epsilon) => share_below(n(a), n(b), n(epsilon)),
            Op::LnQuotient(pair) => self.pair(pair).ln_quotient(),
            Op::PowerQuotient { pair, powers, exponent } => {
                self.pair(pair).power_quotient(powers.map(n), n(exponent))
            }
            Op::ExpQuotient { values: [a, b], exponentials: [a_exp, b_exp] } => {
                exp_quotient([n(a), n(a_exp)], [n(b), n(b_exp)])
            }
            Op::Logarithm(_)
            | Op::Pair { .. }
            | Op::Function(..)
            | Op::FunctionQuotient(..)
            | Op::WholePower(..)
            | Op::WholePowerQuotient(..) => {
                unreachable!(
                    "{op:?} is not a number, or belongs to a function or an exponent that is a parameter"
                )
            }
        }
    }
}

fn value<R: Real>(function: Elementary, x: R) -> R {
    match function {
        Elementary::Asinh => x.asinh(),
        Elementary::Atan => x.atan(),
        Elementary::Cos => x.cos(),
        Elementary::Cosh => x.cosh(),
        Elementary::Erf => x.erf(),
        Elementary::ExpM1 => x.exp_m1(),
        Elementary::Ln1p => x.ln_1p(),
        Elementary::Sigmoid => x.sigmoid(),
        Elementary::Sin => x.sin(),
        Elementary::Sinh => x.sinh(),
        Elementary::Softplus => x.softplus(),
        Elementary::Tanh => x.tanh(),
    }
}

fn quotient<R: Real>(function: Elementary, a: R, b: R) -> R {
    match function {
        Elementary::Asinh => kernels::asinh_quotient(a, b),
        Elementary::Atan => kernels::atan_quotient(a, b),
        Elementary::Cos => kernels::cos_quotient(a, b),
        Elementary::Cosh => kernels::cosh_quotient(a, b),
        Elementary::Erf => kernels::erf_quotient(a, b),
        Elementary::ExpM1 => kernels::exp_m1_quotient(a, b),
        Elementary::Ln1p => kernels::ln_1p_quotient(a, b),
        Elementary::Sigmoid => kernels::sigmoid_quotient(a, b),
        Elementary::Sin => kernels::sin_quotient(a, b),
        Elementary::Sinh => kernels::sinh_quotient(a, b),
        Elementary::Softplus => kernels::softplus_quotient(a, b),
        Elementary::Tanh => kernels::tanh_quotient(a, b),
    }
}
