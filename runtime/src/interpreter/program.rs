//! Programs as data: operations on registers, in order, and loops over lists.

use piola_codegen::schedule::Op;

/// A register: its place among those of its kind, numbers, logarithms, pairs or whole exponents.
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
    /// Registers that hold an argument: its place among the arguments.
    pub arguments: Vec<(Register, usize)>,
    /// Constants that are filled before the first operation: a literal, a parameter, the entry of a list that
    /// the caller names, or the threshold ε of an extension.
    pub filled: Vec<(Register, Op<Register>)>,
    /// Whole exponents, and lists of them, by their registers: the place in the declaration.
    pub exponents: Vec<usize>,
    /// The registers of the three stretches, if an operation reads them without naming them.
    pub stretches: [Register; 3],
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

/// A step of a program. The register of a result comes first, then those of the operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The begin of a loop, by its place among the loops.
    Begin(usize),
    /// The end of the loop that has begun.
    End(usize),
    /// An operation of the compiler that reads values: the others fill registers before the first.
    One(Register, Op<Register>),
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
}
