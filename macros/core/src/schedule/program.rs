//! Programs: operations in order, and loops over lists.

use crate::algebra::expr::{Elementary, Length, ParameterIndex, Stretch};

/// The result of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Value(pub usize);

/// One operation on values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op {
    /// The bits of an `f64`.
    Literal(u64),
    /// λ1, λ2 or λ3.
    Stretch(Stretch),
    /// The strain λ − 1 of one of them.
    Strain(Stretch),
    /// A scalar parameter.
    Parameter(ParameterIndex),
    /// The current entry of a list.
    Entry(ParameterIndex),
    /// The threshold ε of the extension.
    Epsilon,
    /// Smallest denominator of a quotient at a pole.
    PoleFloor,
    /// −a.
    Neg(Value),
    /// First + second.
    Add(Value, Value),
    /// First − second.
    Sub(Value, Value),
    /// First · second.
    Mul(Value, Value),
    /// First / second.
    Div(Value, Value),
    /// First · second + third.
    MulAdd(Value, Value, Value),
    /// Third − first · second.
    NegMulAdd(Value, Value, Value),
    /// First · second − third.
    MulSub(Value, Value, Value),
    /// Square root.
    Sqrt(Value),
    /// Cube root.
    Cbrt(Value),
    /// Natural logarithm.
    Ln(Value),
    /// Exponential function.
    Exp(Value),
    /// The logarithm from which all powers of a value are computed.
    Logarithm(Value),
    /// A power from such a logarithm and the exponent.
    Power(Value, Value),
    /// The logarithm of a product of three values.
    LnProduct([Value; 3]),
    /// An elementary function.
    Elementary(Elementary, Value),
    /// Divided difference of an elementary function.
    ElementaryQuotient(Elementary, Value, Value),
    /// Derivative of the given order of a function that is a parameter.
    Function(ParameterIndex, u8, Value),
    /// Divided difference of such a derivative.
    FunctionQuotient(ParameterIndex, u8, Value, Value),
    /// Derivative of the given order of a power: the base, and the whole exponent, which is read as such.
    WholePower(Value, Value, u8),
    /// Divided difference of such a derivative.
    WholePowerQuotient([Value; 2], Value, u8),
    /// The larger of two values.
    Max(Value, Value),
    /// The value, or the smallest positive number if that is larger.
    AboveZero(Value),
    /// min(first − second, 0).
    Below(Value, Value),
    /// The second value if the first is negative, else the third.
    WhereNegative(Value, Value, Value),
    /// Fraction of the interval between the first two that lies above the third.
    ShareAbove(Value, Value, Value),
    /// Fraction of the interval between the first two that lies below the third.
    ShareBelow(Value, Value, Value),
    /// The common part of the divided differences of logarithms and powers of two values a, b.
    Pair {
        /// a, b.
        values: [Value; 2],
        /// 1/a, 1/b.
        reciprocals: [Value; 2],
        /// The [`Logarithm`](Self::Logarithm)s of a and b.
        logarithms: [Value; 2],
    },
    /// The divided difference (ln a − ln b) / (a − b), from their pair.
    LnQuotient(Value),
    /// The divided difference (a^r − b^r) / (a − b).
    PowerQuotient {
        /// The pair of a and b.
        pair: Value,
        /// a^r, b^r.
        powers: [Value; 2],
        /// r.
        exponent: Value,
    },
    /// The divided difference (eᵃ − eᵇ) / (a − b).
    ExpQuotient {
        /// a, b.
        values: [Value; 2],
        /// eᵃ, eᵇ.
        exponentials: [Value; 2],
    },
}

impl Op {
    /// The values that the operation reads.
    #[must_use]
    pub fn operands(mut self) -> Vec<Value> {
        let mut all = Vec::new();
        self.each_operand(|value| all.push(*value));
        all
    }

    /// Calls a function for each value that the operation reads, to count or replace it.
    pub(super) fn each_operand(&mut self, mut show: impl FnMut(&mut Value)) {
        match self {
            Self::Literal(_)
            | Self::Stretch(_)
            | Self::Strain(_)
            | Self::Parameter(_)
            | Self::Entry(_)
            | Self::Epsilon
            | Self::PoleFloor => {}
            Self::Neg(a)
            | Self::Sqrt(a)
            | Self::Cbrt(a)
            | Self::Ln(a)
            | Self::Logarithm(a)
            | Self::Exp(a)
            | Self::LnQuotient(a)
            | Self::AboveZero(a)
            | Self::Elementary(_, a)
            | Self::Function(.., a) => show(a),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Power(a, b)
            | Self::Max(a, b)
            | Self::Below(a, b)
            | Self::WholePower(a, b, _)
            | Self::ElementaryQuotient(_, a, b)
            | Self::FunctionQuotient(.., a, b) => [a, b].into_iter().for_each(show),
            Self::WholePowerQuotient([a, b], c, _)
            | Self::LnProduct([a, b, c])
            | Self::MulAdd(a, b, c)
            | Self::NegMulAdd(a, b, c)
            | Self::MulSub(a, b, c)
            | Self::WhereNegative(a, b, c)
            | Self::ShareAbove(a, b, c)
            | Self::ShareBelow(a, b, c) => [a, b, c].into_iter().for_each(show),
            Self::Pair { values, reciprocals, logarithms } => {
                [values, reciprocals, logarithms].into_iter().flatten().for_each(show);
            }
            Self::PowerQuotient { pair, powers: [a, b], exponent } => {
                [pair, a, b, exponent].into_iter().for_each(show);
            }
            Self::ExpQuotient { values, exponentials } => {
                [values, exponentials].into_iter().flatten().for_each(show);
            }
        }
    }
}

/// A step of a program.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// The name of the result of an operation.
    Let(Value, Op),
    /// A loop over the entries of the lists of one length.
    Loop {
        /// The length of the lists.
        length: Length,
        /// Operations for each entry.
        body: Vec<(Value, Op)>,
        /// Totals with the value that is added for each entry.
        totals: Vec<(Value, Value)>,
    },
}

/// Operations in order, with the values of the roots.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Statements in the order of execution.
    pub statements: Vec<Statement>,
    /// One value for each root.
    pub outputs: Vec<Value>,
}

impl Program {
    /// All operations in order, those of loops among them.
    pub fn operations(&self) -> impl Iterator<Item = (Value, Op)> {
        self.statements.iter().flat_map(|statement| {
            let (one, body) = match statement {
                Statement::Let(value, op) => (Some((*value, *op)), &[][..]),
                Statement::Loop { body, .. } => (None, &body[..]),
            };
            one.into_iter().chain(body.iter().copied())
        })
    }

    /// Calls a function for each value that operations and totals read, and for each output.
    pub(crate) fn each_read(&self, mut show: impl FnMut(Value)) {
        for (_, mut op) in self.operations() {
            op.each_operand(|value| show(*value));
        }
        for statement in &self.statements {
            if let Statement::Loop { totals, .. } = statement {
                totals.iter().for_each(|&(_, term)| show(term));
            }
        }
        self.outputs.iter().copied().for_each(show);
    }
}
