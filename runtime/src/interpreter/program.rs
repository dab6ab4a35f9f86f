//! Programs as data: operations on registers, in order, and loops over lists.

/// A register: its place among those of its kind, numbers, logarithms or pairs.
///
/// The first registers for numbers are constants: the same at every point, unless parameters differ between
/// the points. Only the first group of a constant is written and read, so that it takes one place in the
/// innermost cache. What the operations of arithmetic compute of constants alone is a constant, too.
pub type Register = u16;

/// Operations in order, the registers that they begin with, and those that hold the results.
///
/// A register may hold several values one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Constants that the declaration writes as numbers.
    pub literals: Vec<(Register, f64)>,
    /// Registers that hold an argument: its place among the arguments.
    pub arguments: Vec<(Register, usize)>,
    /// Constants that are a parameter: its place in the declaration.
    pub parameters: Vec<(Register, usize)>,
    /// Constants that are the entry of a list which the caller names: the list's place in the declaration.
    pub entries: Vec<(Register, usize)>,
    /// The constant that is the threshold ε of an extension.
    pub epsilon: Option<Register>,
    /// The operations, in order.
    pub operations: Vec<Operation>,
    /// Number of operations at the start that compute constants: once for all tiles that follow each other.
    pub preparations: usize,
    /// The loops among them.
    pub loops: Vec<Loop>,
    /// The registers of the results.
    pub results: Vec<Register>,
    /// Registers of numbers that are positive inside the domain of the energy, for a response of a tile.
    pub bounds: Vec<Register>,
    /// Numbers of registers.
    pub sizes: Sizes,
}

/// Number of registers of each kind that a program needs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Registers for real numbers, constants among them.
    pub numbers: usize,
    /// Registers for constants, which come first.
    pub constants: usize,
    /// Registers for logarithms with extra digits, from which powers are made.
    pub logarithms: usize,
    /// Registers for the common parts of the divided differences of two values.
    pub pairs: usize,
}

/// A loop over the entries of lists of one length.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// A list of that length: its place in the declaration.
    pub list: usize,
    /// Constants that are the current entry of a list: its place in the declaration.
    pub entries: Vec<(Register, usize)>,
    /// Registers of totals, which begin with zero, each with the register that is added to it for every
    /// entry.
    pub totals: Vec<(Register, Register)>,
    /// Number of operations between the begin of the loop and its end, for each entry.
    pub length: usize,
}

/// A whole exponent, read from the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exponent {
    /// A parameter, by its place in the declaration.
    Parameter(usize),
    /// The current entry of a list, by its place in the declaration.
    Entry(usize),
}

/// An operation: the register of the result comes first, then those of its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The begin of a loop, by its place among the loops.
    Begin(usize),
    /// The end of the loop that has begun.
    End(usize),
    /// −a.
    Neg(Register, Register),
    /// a + b.
    Add(Register, Register, Register),
    /// a − b.
    Sub(Register, Register, Register),
    /// a b.
    Mul(Register, Register, Register),
    /// a/b.
    Div(Register, Register, Register),
    /// a b + c.
    MulAdd(Register, [Register; 3]),
    /// c − a b.
    NegMulAdd(Register, [Register; 3]),
    /// a b − c.
    MulSub(Register, [Register; 3]),
    /// (a b) c. This and the next six are two or three operations in one: no other operation reads the
    /// results between them, which need no register.
    MulMul(Register, [Register; 3]),
    /// ((a b) c) d.
    MulMulMul(Register, [Register; 4]),
    /// (a b) c + d.
    MulMulAdd(Register, [Register; 4]),
    /// d − (a b) c.
    NegMulMulAdd(Register, [Register; 4]),
    /// (a b + c) d.
    MulAddMul(Register, [Register; 4]),
    /// (c − a b) d.
    NegMulAddMul(Register, [Register; 4]),
    /// −(a b).
    NegMul(Register, Register, Register),
    /// √a.
    Sqrt(Register, Register),
    /// ∛a.
    Cbrt(Register, Register),
    /// ln a.
    Ln(Register, Register),
    /// eᵃ.
    Exp(Register, Register),
    /// The larger of a and b.
    Max(Register, Register, Register),
    /// min(a − b, 0).
    Below(Register, Register, Register),
    /// a, kept from zero.
    AboveZero(Register, Register),
    /// b where a is negative, else c.
    WhereNegative(Register, [Register; 3]),
    /// Fraction of the interval between a and b that lies above c.
    ShareAbove(Register, [Register; 3]),
    /// Fraction of the interval between a and b that lies below c.
    ShareBelow(Register, [Register; 3]),
    /// Smallest denominator of a quotient at a pole, from the three stretches.
    PoleFloor(Register, [Register; 3]),
    /// ln (a b c).
    LnProduct(Register, [Register; 3]),
    /// φ(a).
    Elementary(Elementary, Register, Register),
    /// φ\[a, b\].
    ElementaryQuotient(Elementary, Register, Register, Register),
    /// The logarithm of a number, into a register for logarithms.
    Logarithm(Register, Register),
    /// The power from the register of a logarithm and an exponent.
    Power(Register, Register, Register),
    /// The common part of the divided differences of a and b, into a register for pairs.
    Pair {
        /// The register for pairs.
        to: Register,
        /// a, b.
        values: [Register; 2],
        /// 1/a, 1/b.
        reciprocals: [Register; 2],
        /// Registers of the logarithms of a and b.
        logarithms: [Register; 2],
    },
    /// (ln a − ln b)/(a − b), from the register of their pair.
    LnQuotient(Register, Register),
    /// (aʳ − bʳ)/(a − b).
    PowerQuotient {
        /// The register of the result.
        to: Register,
        /// The register of the pair.
        pair: Register,
        /// aʳ, bʳ.
        powers: [Register; 2],
        /// r.
        exponent: Register,
    },
    /// (eᵃ − eᵇ)/(a − b), from a, eᵃ and b, e^b.
    ExpQuotient(Register, [Register; 2], [Register; 2]),
    /// The derivative of the given order of xⁿ.
    WholePower(Register, Register, Exponent, u8),
    /// The divided difference of such a derivative.
    WholePowerQuotient(Register, [Register; 2], Exponent, u8),
    /// The derivative of the given order of a function that is a parameter, by its place in the declaration.
    Function(Register, usize, u8, Register),
    /// The divided difference of such a derivative.
    FunctionQuotient(Register, usize, u8, [Register; 2]),
}

/// An elementary function with a divided difference of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is named like the method of `Real`")]
pub enum Elementary {
    Asinh,
    Atan,
    Cos,
    Cosh,
    Erf,
    ExpM1,
    Ln1p,
    Sigmoid,
    Sin,
    Sinh,
    Softplus,
    Tanh,
}
