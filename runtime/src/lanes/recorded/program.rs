//! Recorded programs as data.

use std::collections::{BTreeMap, HashSet};

use crate::lanes::real::Real;

/// The place of an operation in its program.
pub type Id = u32;

/// An operation of a program, on results of operations before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
    /// The results of a function, at most four arguments.
    Call(Function, [Option<Id>; 4]),
    /// The second result of a call; the call itself stands for the first.
    Second(Id),
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
    /// The power of two in |a|, 0 for numbers below the normal ones.
    LeadingPower,
    /// 1/a for a power of two.
    ReciprocalOfPower,
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
    /// a 2ᵇ, rounded once.
    Scale,
}

macro_rules! functions {
    ($($Function:ident $method:ident $name:literal),* $(,)?) => {
        /// Functions of a program: the elementary ones, and two that they are made of.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Function {
            $(
                #[doc = concat!("[`Real::", stringify!($method), "`].")]
                $Function,
            )*
            /// [`Real::logarithm`], of which both parts are results.
            Logarithm,
            /// [`Real::power`], from both parts of the logarithm and the exponent.
            Power,
            /// [`Real::logarithm_of_ratio`], from both parts of both logarithms.
            LogarithmOfRatio,
            /// The rounding error of a product: [`Real::two_product`]. It has no program.
            ProductError,
            /// Mantissa between √½ and √2, and exponent of two. It has no program.
            Split,
        }

        impl Function {
            /// A name in lower case.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$Function => $name,)*
                    Self::Logarithm => "logarithm",
                    Self::Power => "power",
                    Self::LogarithmOfRatio => "logarithm_of_ratio",
                    Self::ProductError => "product_error",
                    Self::Split => "split",
                }
            }

            /// True if there is a second result.
            #[must_use]
            pub fn is_pair(self) -> bool {
                matches!(self, Self::Logarithm | Self::Split)
            }
        }

        /// Methods that call a function of one argument.
        macro_rules! calls {
            () => {$(
                fn $method(self) -> Self {
                    call(Function::$Function, [self], |[x]| vec![elementary::$method(x)])
                }
            )*};
        }
    };
}
functions! {
    Cbrt cbrt "cbrt", Ln ln "ln", Exp exp "exp", Ln1p ln_1p "ln_1p", ExpM1 exp_m1 "exp_m1", Sinh sinh "sinh",
    Cosh cosh "cosh", Tanh tanh "tanh", Asinh asinh "asinh", Sin sin "sin", Cos cos "cos", Atan atan "atan",
    Erf erf "erf", Softplus softplus "softplus", Sigmoid sigmoid "sigmoid",
}
pub(super) use calls;

/// A straight-line program.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedProgram {
    /// Number of arguments, those that no operation reads included.
    pub arguments: usize,
    /// Operations in an order in which they can be executed; all are needed.
    pub operations: Vec<RecordedOperation>,
    /// The results.
    pub results: Vec<Id>,
    /// Masks that the computation has tested for any lane that is set: a selection by one of them is a
    /// branch, which contains the operations that only one of its values needs.
    pub guards: HashSet<Id>,
}

/// A program and the functions that it calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// The program.
    pub program: RecordedProgram,
    /// Programs of the functions that it calls, and of those that they call.
    pub functions: BTreeMap<Function, RecordedProgram>,
}

impl RecordedOperation {
    /// The operation on other operands.
    #[must_use]
    pub(super) fn with_operands(self, mut map: impl FnMut(Id) -> Id) -> Self {
        match self {
            Self::Argument(_) | Self::Parameter(_) | Self::Literal(_) | Self::Truth(_) => self,
            Self::Unary(operator, a) => Self::Unary(operator, map(a)),
            Self::Binary(operator, a, b) => Self::Binary(operator, map(a), map(b)),
            Self::MulAdd(a, b, c) => Self::MulAdd(map(a), map(b), map(c)),
            Self::Less(a, b) => Self::Less(map(a), map(b)),
            Self::IsZero(a) => Self::IsZero(map(a)),
            Self::Not(a) => Self::Not(map(a)),
            Self::And(a, b) => Self::And(map(a), map(b)),
            Self::Or(a, b) => Self::Or(map(a), map(b)),
            Self::Select(mask, yes, no) => Self::Select(map(mask), map(yes), map(no)),
            Self::Call(function, arguments) => {
                Self::Call(function, arguments.map(|argument| argument.map(&mut map)))
            }
            Self::Second(call) => Self::Second(map(call)),
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

/// Formats of the numbers of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// 32 bits.
    F32,
    /// 64 bits.
    #[default]
    F64,
}

impl Format {
    pub(super) fn unit_roundoff(self) -> f64 {
        match self {
            Self::F32 => <f32 as Real>::UNIT_ROUNDOFF,
            Self::F64 => <f64 as Real>::UNIT_ROUNDOFF,
        }
    }

    pub(super) fn min_positive(self) -> f64 {
        match self {
            Self::F32 => <f32 as Real>::MIN_POSITIVE,
            Self::F64 => <f64 as Real>::MIN_POSITIVE,
        }
    }

    /// The nearest number of the format.
    pub(super) fn rounded(self, value: f64) -> f64 {
        match self {
            Self::F32 => f64::from(value as f32),
            Self::F64 => value,
        }
    }

    /// The result of an operation on literals, if it is one of arithmetic.
    pub(super) fn compute(self, operator: Binary, a: f64, b: f64) -> Option<f64> {
        fn result<R: Real>(operator: Binary, a: f64, b: f64) -> Option<R> {
            let (a, b) = (R::splat(a), R::splat(b));
            match operator {
                Binary::Add => Some(a + b),
                Binary::Subtract => Some(a - b),
                Binary::Multiply => Some(a * b),
                Binary::Divide => Some(a / b),
                Binary::CopySign | Binary::Scale => None,
            }
        }
        match self {
            Self::F32 => result::<f32>(operator, a, b).map(f64::from),
            Self::F64 => result::<f64>(operator, a, b),
        }
    }
}
