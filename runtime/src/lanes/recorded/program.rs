//! Recorded programs as data.

use std::collections::HashSet;

/// The place of an operation in its program.
pub type Id = u32;

/// An operation of a program, on results of operations before it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum RecordedOperation {
    /// An argument of the program.
    Argument(u32),
    /// A number among the parameters of the material, in the order in which they are declared.
    Parameter(u32),
    /// A literal: the bits of its value in `f64`, which is exact in the format of the program.
    Literal(u64),
    /// A truth value that is known.
    Truth(bool),
    /// A number from a number.
    Unary(Unary, Id),
    /// A number from two.
    Binary(Binary, Id, Id),
    /// a b + c, with one rounding or two.
    MulAdd(Id, Id, Id),
    /// The truth of a < b.
    Less(Id, Id),
    /// True if a number is ±0.
    IsZero(Id),
    /// The negation of a truth value.
    Not(Id),
    /// True if two truth values hold.
    And(Id, Id),
    /// True if one of two truth values holds.
    Or(Id, Id),
    /// The second value where the first holds, else the third.
    Select(Id, Id, Id),
    /// A call of a function; its results are parts of it.
    Call(&'static str, Box<[Id]>),
    /// A result of a call, a number or a truth value.
    Part(Id, usize),
}

/// Operations with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// −a.
    Negate,
    /// |a|.
    Absolute,
    /// √a.
    SquareRoot,
}

/// Operations with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// a + b.
    Add,
    /// a − b.
    Subtract,
    /// a b.
    Multiply,
    /// a / b.
    Divide,
    /// |a| with the sign of b.
    CopySign,
}

/// A straight-line program.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedProgram {
    /// Operations in an order in which they can be executed; all are needed.
    pub operations: Vec<RecordedOperation>,
    /// The results.
    pub results: Vec<Id>,
    /// Masks that the computation has tested for any lane that is set: a selection by one of them is a
    /// branch, which contains the operations that only one of its values needs.
    pub guards: HashSet<Id>,
}

/// A name and a program, which others call by it.
pub type RecordedFunction = (&'static str, RecordedProgram);

impl RecordedOperation {
    /// The operation on other operands.
    #[must_use]
    pub(super) fn with_operands(&self, mut map: impl FnMut(Id) -> Id) -> Self {
        match *self {
            Self::Argument(_) | Self::Parameter(_) | Self::Literal(_) | Self::Truth(_) => self.clone(),
            Self::Unary(operator, a) => Self::Unary(operator, map(a)),
            Self::Binary(operator, a, b) => Self::Binary(operator, map(a), map(b)),
            Self::MulAdd(a, b, c) => Self::MulAdd(map(a), map(b), map(c)),
            Self::Less(a, b) => Self::Less(map(a), map(b)),
            Self::IsZero(a) => Self::IsZero(map(a)),
            Self::Not(a) => Self::Not(map(a)),
            Self::And(a, b) => Self::And(map(a), map(b)),
            Self::Or(a, b) => Self::Or(map(a), map(b)),
            Self::Select(mask, yes, no) => Self::Select(map(mask), map(yes), map(no)),
            Self::Call(name, ref arguments) => {
                Self::Call(name, arguments.iter().map(|&argument| map(argument)).collect())
            }
            Self::Part(call, k) => Self::Part(map(call), k),
        }
    }

    /// Calls a function for each operand.
    pub fn for_each_operand(&self, mut each: impl FnMut(Id)) {
        let _ = self.with_operands(|id| {
            each(id);
            id
        });
    }
}
