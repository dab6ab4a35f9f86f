//! Programs: operations in order, and loops over lists.

use crate::algebra::expr::{Elementary, Length, ParameterIndex, Stretch};

/// The result of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Value(pub usize);

/// One operation on values, or on the registers that an interpreter keeps them in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Op<V = Value> {
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
    Neg(V),
    /// First + second.
    Add(V, V),
    /// First − second.
    Sub(V, V),
    /// First · second.
    Mul(V, V),
    /// First / second.
    Div(V, V),
    /// First · second + third.
    MulAdd(V, V, V),
    /// Third − first · second.
    NegMulAdd(V, V, V),
    /// First · second − third.
    MulSub(V, V, V),
    /// Square root.
    Sqrt(V),
    /// Cube root.
    Cbrt(V),
    /// Natural logarithm.
    Ln(V),
    /// Exponential function.
    Exp(V),
    /// The logarithm from which all powers of a value are computed.
    Logarithm(V),
    /// A power from such a logarithm and the exponent.
    Power(V, V),
    /// The logarithm of a product of three values.
    LnProduct([V; 3]),
    /// An elementary function.
    Elementary(Elementary, V),
    /// Divided difference of an elementary function.
    ElementaryQuotient(Elementary, V, V),
    /// Derivative of the given order of a function that is a parameter.
    Function(ParameterIndex, u8, V),
    /// Divided difference of such a derivative.
    FunctionQuotient(ParameterIndex, u8, V, V),
    /// Derivative of the given order of a power: the base, and the whole exponent, which is read as such.
    WholePower(V, V, u8),
    /// Divided difference of such a derivative.
    WholePowerQuotient([V; 2], V, u8),
    /// The larger of two values.
    Max(V, V),
    /// The value, or the smallest positive number if that is larger.
    AboveZero(V),
    /// min(first − second, 0).
    Below(V, V),
    /// The second value if the first is negative, else the third.
    WhereNegative(V, V, V),
    /// Fraction of the interval between the first two that lies above the third.
    ShareAbove(V, V, V),
    /// Fraction of the interval between the first two that lies below the third.
    ShareBelow(V, V, V),
    /// The common part of the divided differences of logarithms and powers of two values a, b.
    Pair {
        /// a, b.
        values: [V; 2],
        /// 1/a, 1/b.
        reciprocals: [V; 2],
        /// The [`Logarithm`](Self::Logarithm)s of a and b.
        logarithms: [V; 2],
    },
    /// The divided difference (ln a − ln b) / (a − b), from their pair.
    LnQuotient(V),
    /// The divided difference (a^r − b^r) / (a − b).
    PowerQuotient {
        /// The pair of a and b.
        pair: V,
        /// a^r, b^r.
        powers: [V; 2],
        /// r.
        exponent: V,
    },
    /// The divided difference (eᵃ − eᵇ) / (a − b).
    ExpQuotient {
        /// a, b.
        values: [V; 2],
        /// eᵃ, eᵇ.
        exponentials: [V; 2],
    },
}

impl<V> Op<V> {
    /// The same operation on what a function returns for each operand, in their order.
    pub fn map<W>(self, mut to: impl FnMut(V) -> W) -> Op<W> {
        match self {
            Self::Literal(bits) => Op::Literal(bits),
            Self::Stretch(i) => Op::Stretch(i),
            Self::Strain(i) => Op::Strain(i),
            Self::Parameter(k) => Op::Parameter(k),
            Self::Entry(k) => Op::Entry(k),
            Self::Epsilon => Op::Epsilon,
            Self::PoleFloor => Op::PoleFloor,
            Self::Neg(a) => Op::Neg(to(a)),
            Self::Add(a, b) => Op::Add(to(a), to(b)),
            Self::Sub(a, b) => Op::Sub(to(a), to(b)),
            Self::Mul(a, b) => Op::Mul(to(a), to(b)),
            Self::Div(a, b) => Op::Div(to(a), to(b)),
            Self::MulAdd(a, b, c) => Op::MulAdd(to(a), to(b), to(c)),
            Self::NegMulAdd(a, b, c) => Op::NegMulAdd(to(a), to(b), to(c)),
            Self::MulSub(a, b, c) => Op::MulSub(to(a), to(b), to(c)),
            Self::Sqrt(a) => Op::Sqrt(to(a)),
            Self::Cbrt(a) => Op::Cbrt(to(a)),
            Self::Ln(a) => Op::Ln(to(a)),
            Self::Exp(a) => Op::Exp(to(a)),
            Self::Logarithm(a) => Op::Logarithm(to(a)),
            Self::Power(a, b) => Op::Power(to(a), to(b)),
            Self::LnProduct(factors) => Op::LnProduct(factors.map(to)),
            Self::Elementary(function, a) => Op::Elementary(function, to(a)),
            Self::ElementaryQuotient(function, a, b) => Op::ElementaryQuotient(function, to(a), to(b)),
            Self::Function(k, order, a) => Op::Function(k, order, to(a)),
            Self::FunctionQuotient(k, order, a, b) => Op::FunctionQuotient(k, order, to(a), to(b)),
            Self::WholePower(a, n, order) => Op::WholePower(to(a), to(n), order),
            Self::WholePowerQuotient(bases, n, order) => {
                Op::WholePowerQuotient(bases.map(&mut to), to(n), order)
            }
            Self::Max(a, b) => Op::Max(to(a), to(b)),
            Self::AboveZero(a) => Op::AboveZero(to(a)),
            Self::Below(a, b) => Op::Below(to(a), to(b)),
            Self::WhereNegative(a, b, c) => Op::WhereNegative(to(a), to(b), to(c)),
            Self::ShareAbove(a, b, c) => Op::ShareAbove(to(a), to(b), to(c)),
            Self::ShareBelow(a, b, c) => Op::ShareBelow(to(a), to(b), to(c)),
            Self::Pair { values, reciprocals, logarithms } => Op::Pair {
                values: values.map(&mut to),
                reciprocals: reciprocals.map(&mut to),
                logarithms: logarithms.map(to),
            },
            Self::LnQuotient(pair) => Op::LnQuotient(to(pair)),
            Self::PowerQuotient { pair, powers, exponent } => {
                Op::PowerQuotient { pair: to(pair), powers: powers.map(&mut to), exponent: to(exponent) }
            }
            Self::ExpQuotient { values, exponentials } => {
                Op::ExpQuotient { values: values.map(&mut to), exponentials: exponentials.map(to) }
            }
        }
    }

    /// The values that the operation reads.
    #[must_use]
    pub fn operands(self) -> Vec<V> {
        let mut all = Vec::new();
        self.map(|value| all.push(value));
        all
    }
}

/// Operations that are done once, or for each entry of the lists of one length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block {
    /// The length of the lists; `None` for operations that are done once.
    pub length: Option<Length>,
    /// Operations, with the names of their results.
    pub body: Vec<(Value, Op)>,
    /// Totals with the value that is added for each entry.
    pub totals: Vec<(Value, Value)>,
}

/// Operations in order, with the values of the roots.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// Blocks in the order of execution.
    pub blocks: Vec<Block>,
    /// One value for each root.
    pub outputs: Vec<Value>,
}

impl Program {
    /// All operations in order, those of loops among them.
    pub fn operations(&self) -> impl Iterator<Item = (Value, Op)> {
        self.blocks.iter().flat_map(|block| block.body.iter().copied())
    }

    /// Replaces each value by what a function returns for it.
    pub fn rename(&mut self, new: impl Fn(Value) -> Value) {
        for Block { body, totals, .. } in &mut self.blocks {
            for (value, op) in body {
                (*value, *op) = (new(*value), op.map(&new));
            }
            for (total, term) in totals {
                (*total, *term) = (new(*total), new(*term));
            }
        }
        self.outputs.iter_mut().for_each(|output| *output = new(*output));
    }

    /// Calls a function for each value that operations and totals read, and for each output.
    pub(crate) fn each_read(&self, mut show: impl FnMut(Value)) {
        for (_, op) in self.operations() {
            op.map(&mut show);
        }
        self.blocks.iter().flat_map(|block| &block.totals).for_each(|&(_, term)| show(term));
        self.outputs.iter().copied().for_each(show);
    }
}
