//! A real number that records what is done to it, so that any computation over [`Real`] becomes a
//! straight-line program, for back ends that print it in another language.
//!
//! A computation runs once. There is no branch on a value to miss, since a `Real` has none; where code asks
//! whether *any* lane of a mask is set, the answer is yes unless the mask is known, so that both ways are
//! recorded. The question itself is kept: what only one way needs stands behind a condition again, once the
//! program is printed ([`RecordedProgram::guards`]).
//!
//! Equal operations exist once, arithmetic with literals is done at once, and no rule changes a bit. The
//! elementary functions are recorded as well, each once, and called.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::{self, Logarithm};
use super::primitive::Primitive;
use super::real::{Mask, Real};
use super::vector::Scalar;

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
    /// Whether a number is ±0.
    IsZero(Id),
    /// The negation of a truth value.
    Not(Id),
    /// Whether two truth values hold.
    And(Id, Id),
    /// Whether one of two truth values holds.
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

            /// Whether there is a second result.
            #[must_use]
            pub fn is_pair(self) -> bool {
                matches!(self, Self::Logarithm | Self::Split)
            }
        }

        /// Methods that call a function of one argument.
        macro_rules! calls {
            () => {$(
                fn $method(self) -> Self {
                    let [first, _] = call(Function::$Function, &[self], |arguments| {
                        [elementary::$method(arguments[0]), arguments[0]]
                    });
                    first
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

/// A straight-line program.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedProgram {
    /// Number of arguments, those that no operation reads included.
    pub arguments: usize,
    /// In an order in which they can be executed; all are needed.
    pub operations: Vec<RecordedOperation>,
    /// The results.
    pub results: Vec<Id>,
    /// Masks of which the computation asked whether any lane is set: a selection by one of them is a branch,
    /// in which stands what only one of its values needs.
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

/// A computation has used a parameter as a number of Rust, so that it is no program of the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnrecordedParameter;

impl fmt::Display for UnrecordedParameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a parameter of the energy decides on its program: write its value into the energy")
    }
}

impl std::error::Error for UnrecordedParameter {}

/// Operations under construction.
#[derive(Default)]
struct Tape {
    operations: Vec<RecordedOperation>,
    places: HashMap<RecordedOperation, Id>,
    guards: HashSet<Id>,
}

#[derive(Default)]
struct Recorder {
    /// The program, and above it the functions that are being recorded.
    tapes: Vec<Tape>,
    functions: BTreeMap<Function, RecordedProgram>,
    has_lost_parameter: bool,
}

thread_local!(static RECORDER: RefCell<Recorder> = RefCell::default());

/// A number of a program in the format E.
pub struct Recorded<E> {
    id: Id,
    format: PhantomData<E>,
}

impl<E> Clone for Recorded<E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Recorded<E> {}

impl<E> fmt::Debug for Recorded<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "operation {}", self.id)
    }
}

/// A truth value of a program.
#[derive(Clone, Copy, Debug)]
pub struct RecordedMask(Id);

/// The value that stands for a parameter: a signalling NaN, so that arithmetic in Rust would show.
#[must_use]
pub fn parameter(k: u32) -> f64 {
    f64::from_bits(PARAMETERS | u64::from(k))
}

/// Bits of a signalling NaN, and those of a quiet one that has been made of it.
const PARAMETERS: u64 = 0x7ff4_9101_0000_0000;
const QUIET: u64 = 0x7ffc_9101_0000_0000;

/// Records a computation from arguments to numbers and truth values.
///
/// # Errors
/// [`UnrecordedParameter`] if the computation has used a [`parameter`] otherwise than as a number of the
/// program.
pub fn record<E: Recordable>(
    arguments: usize,
    computation: impl FnOnce(&[Recorded<E>]) -> (Vec<Recorded<E>>, Vec<RecordedMask>),
) -> Result<Recording, UnrecordedParameter> {
    let before = RECORDER.take();
    let program = recorded(arguments, |arguments| {
        let (numbers, masks) = computation(arguments);
        numbers.iter().map(|number| number.id).chain(masks.iter().map(|mask| mask.0)).collect()
    });
    let Recorder { functions, has_lost_parameter, .. } = RECORDER.replace(before);
    if has_lost_parameter { Err(UnrecordedParameter) } else { Ok(Recording { program, functions }) }
}

/// The program of a computation on a tape of its own.
fn recorded<E: Recordable>(
    count: usize,
    computation: impl FnOnce(&[Recorded<E>]) -> Vec<Id>,
) -> RecordedProgram {
    RECORDER.with_borrow_mut(|recorder| recorder.tapes.push(Tape::default()));
    let arguments: Vec<_> = (0..count as u32).map(|k| Recorded::of(RecordedOperation::Argument(k))).collect();
    let results = computation(&arguments);
    let tape = RECORDER.with_borrow_mut(|recorder| recorder.tapes.pop()).unwrap_or_default();
    RecordedProgram { arguments: count, ..tape.into_program(results) }
}

/// The results of a function, which is recorded when it is first called. The second means something if the
/// function [is a pair](Function::is_pair).
fn call<E: Recordable>(
    function: Function,
    arguments: &[Recorded<E>],
    body: impl FnOnce(&[Recorded<E>]) -> [Recorded<E>; 2],
) -> [Recorded<E>; 2] {
    if !RECORDER.with_borrow(|recorder| recorder.functions.contains_key(&function)) {
        let program = recorded(arguments.len(), |arguments: &[Recorded<E>]| {
            let results = body(arguments).map(|result| result.id);
            results[..if function.is_pair() { 2 } else { 1 }].to_vec()
        });
        RECORDER.with_borrow_mut(|recorder| recorder.functions.insert(function, program));
    }
    let called = Recorded::of(RecordedOperation::Call(
        function,
        std::array::from_fn(|k| arguments.get(k).map(|argument| argument.id)),
    ));
    [called, if function.is_pair() { Recorded::of(RecordedOperation::Second(called.id)) } else { called }]
}

impl Tape {
    fn push(&mut self, operation: RecordedOperation) -> Id {
        let Self { operations, places, .. } = self;
        *places.entry(operation).or_insert_with(|| {
            operations.push(operation);
            operations.len() as Id - 1
        })
    }

    fn literal(&self, id: Id) -> Option<f64> {
        match self.operations[id as usize] {
            RecordedOperation::Literal(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn truth(&self, id: Id) -> Option<bool> {
        match self.operations[id as usize] {
            RecordedOperation::Truth(truth) => Some(truth),
            _ => None,
        }
    }

    /// The guard of which a truth value is the negation.
    fn guard_of_negation(&self, id: Id) -> Option<Id> {
        match self.operations[id as usize] {
            RecordedOperation::Not(guard) if self.guards.contains(&guard) => Some(guard),
            _ => None,
        }
    }

    /// A truth value where a guard does not hold, false where it does.
    fn unless(&mut self, guard: Id, truth: Id) -> Id {
        let never = self.push(RecordedOperation::Truth(false));
        self.push(RecordedOperation::Select(guard, never, truth))
    }

    /// The operation, or what has the same bits and is simpler.
    fn simplified<E: Recordable>(&mut self, operation: RecordedOperation) -> Id {
        use RecordedOperation::{And, Binary, Less, Literal, Not, Or, Select, Truth, Unary};
        let computed = match operation {
            Unary(self::Unary::Negate, a) => self.literal(a).map(|a| -a),
            Binary(operator, a, b) => match (self.literal(a), self.literal(b)) {
                (Some(a), Some(b)) => E::compute(operator, a, b),
                // Exact, whatever the other operand.
                (_, Some(1.0)) if matches!(operator, self::Binary::Multiply | self::Binary::Divide) => {
                    return a;
                }
                (Some(1.0), _) if operator == self::Binary::Multiply => return b,
                _ => None,
            },
            Less(a, b) => match (self.literal(a), self.literal(b)) {
                (Some(a), Some(b)) => return self.push(Truth(a < b)),
                _ => None,
            },
            Not(a) => match self.operations[a as usize] {
                Truth(truth) => return self.push(Truth(!truth)),
                Not(a) => return a,
                _ => None,
            },
            And(a, b) | Or(a, b) => {
                let decides = matches!(operation, Or(..));
                match (self.truth(a), self.truth(b)) {
                    (Some(truth), _) => return if truth == decides { a } else { b },
                    (_, Some(truth)) => return if truth == decides { b } else { a },
                    _ if a == b => return a,
                    // What is asked where a guard does not hold needs no answer where it does.
                    _ if !decides => match (self.guard_of_negation(a), self.guard_of_negation(b)) {
                        (Some(guard), _) => return self.unless(guard, b),
                        (_, Some(guard)) => return self.unless(guard, a),
                        _ => None,
                    },
                    _ => None,
                }
            }
            Select(_, yes, no) if yes == no => return yes,
            Select(mask, yes, no) => match self.operations[mask as usize] {
                Truth(truth) => return if truth { yes } else { no },
                Not(mask) => return self.push(Select(mask, no, yes)),
                Select(guard, never, inner) if self.truth(never) == Some(false) => {
                    let selected = self.simplified::<E>(Select(inner, yes, no));
                    return self.push(Select(guard, no, selected));
                }
                _ => None,
            },
            _ => None,
        };
        self.push(computed.map_or(operation, |value| Literal(value.to_bits())))
    }

    /// The operations that the results need, in order.
    fn into_program(self, results: Vec<Id>) -> RecordedProgram {
        let mut is_needed = vec![false; self.operations.len()];
        for &result in &results {
            is_needed[result as usize] = true;
        }
        for (k, operation) in self.operations.iter().enumerate().rev() {
            if is_needed[k] {
                operation.for_each_operand(|id| is_needed[id as usize] = true);
            }
        }
        let mut places = vec![0; self.operations.len()];
        let mut operations = Vec::new();
        for (k, operation) in self.operations.into_iter().enumerate().filter(|&(k, _)| is_needed[k]) {
            places[k] = operations.len() as Id;
            operations.push(operation.with_operands(|id| places[id as usize]));
        }
        let moved = |id: Id| places[id as usize];
        RecordedProgram {
            arguments: 0,
            operations,
            results: results.into_iter().map(moved).collect(),
            guards: self.guards.into_iter().filter(|&id| is_needed[id as usize]).map(moved).collect(),
        }
    }
}

impl RecordedOperation {
    /// The operation on other operands.
    #[must_use]
    pub fn with_operands(self, mut map: impl FnMut(Id) -> Id) -> Self {
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

/// Formats in which programs are recorded: `f64` and `f32`.
pub trait Recordable: Scalar + Into<f64> {
    /// The result of an operation on literals, if it is one of arithmetic.
    fn compute(operator: Binary, a: f64, b: f64) -> Option<f64> {
        let (a, b) = (Self::splat(a), Self::splat(b));
        let result = match operator {
            Binary::Add => a + b,
            Binary::Subtract => a - b,
            Binary::Multiply => a * b,
            Binary::Divide => a / b,
            Binary::CopySign | Binary::Scale => return None,
        };
        Some(result.into())
    }
}

impl Recordable for f64 {}
impl Recordable for f32 {}

impl<E: Recordable> Recorded<E> {
    fn of(operation: RecordedOperation) -> Self {
        let id = RECORDER.with_borrow_mut(|recorder| match recorder.tapes.last_mut() {
            Some(tape) => tape.simplified::<E>(operation),
            None => 0,
        });
        Self { id, format: PhantomData }
    }

    fn unary(self, operator: Unary) -> Self {
        Self::of(RecordedOperation::Unary(operator, self.id))
    }

    fn binary(self, operator: Binary, other: Self) -> Self {
        Self::of(RecordedOperation::Binary(operator, self.id, other.id))
    }
}

impl RecordedMask {
    fn of(operation: RecordedOperation) -> Self {
        // No operation on truth values depends on the format.
        Self(Recorded::<f64>::of(operation).id)
    }
}

impl BitAnd for RecordedMask {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        Self::of(RecordedOperation::And(self.0, other.0))
    }
}

impl BitOr for RecordedMask {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self::of(RecordedOperation::Or(self.0, other.0))
    }
}

impl Not for RecordedMask {
    type Output = Self;

    fn not(self) -> Self {
        Self::of(RecordedOperation::Not(self.0))
    }
}

impl Mask for RecordedMask {
    fn splat(value: bool) -> Self {
        Self::of(RecordedOperation::Truth(value))
    }

    fn any(self) -> bool {
        RECORDER.with_borrow_mut(|recorder| {
            let Some(tape) = recorder.tapes.last_mut() else { return true };
            match tape.operations[self.0 as usize] {
                RecordedOperation::Truth(truth) => return truth,
                // Selections are by masks that are not negations.
                RecordedOperation::Not(mask) => tape.guards.insert(mask),
                _ => tape.guards.insert(self.0),
            };
            true
        })
    }
}

macro_rules! operators {
    ($($Trait:ident $method:ident),*) => {$(
        impl<E: Recordable> $Trait for Recorded<E> {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                self.binary(operators!(@ $Trait), other)
            }
        }
    )*};
    (@ Add) => { Binary::Add };
    (@ Sub) => { Binary::Subtract };
    (@ Mul) => { Binary::Multiply };
    (@ Div) => { Binary::Divide };
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl<E: Recordable> Neg for Recorded<E> {
    type Output = Self;

    fn neg(self) -> Self {
        self.unary(Unary::Negate)
    }
}

impl<E: Recordable> Real for Recorded<E> {
    type Mask = RecordedMask;
    type Logarithm = Logarithm<Self>;
    const UNIT_ROUNDOFF: f64 = E::UNIT_ROUNDOFF;
    const MIN_POSITIVE: f64 = E::MIN_POSITIVE;

    fn splat(value: f64) -> Self {
        const SIGN: u64 = 1 << 63;
        let bits = value.to_bits();
        match bits & !0xffff_ffff {
            PARAMETERS => return Self::of(RecordedOperation::Parameter(bits as u32)),
            marked if [PARAMETERS, QUIET].contains(&(marked & !SIGN)) => {
                RECORDER.with_borrow_mut(|recorder| recorder.has_lost_parameter = true);
            }
            _ => {}
        }
        let rounded: f64 = E::splat(value).into();
        Self::of(RecordedOperation::Literal(rounded.to_bits()))
    }

    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        Self::splat(value(0))
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self::of(RecordedOperation::MulAdd(self.id, factor.id, addend.id))
    }

    fn sqrt(self) -> Self {
        self.unary(Unary::SquareRoot)
    }

    calls!();

    fn logarithm(self) -> Self::Logarithm {
        let [high, low] = call(Function::Logarithm, &[self], |arguments| {
            let Logarithm { high, low } = elementary::logarithm(arguments[0]);
            [high, low]
        });
        Logarithm { high, low }
    }

    fn power(Logarithm { high, low }: Self::Logarithm, exponent: Self) -> Self {
        let [power, _] = call(Function::Power, &[high, low, exponent], |arguments| {
            let &[high, low, exponent] = arguments else { return [arguments[0]; 2] };
            [elementary::power(Logarithm { high, low }, exponent); 2]
        });
        power
    }

    fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self {
        let [ratio, _] = call(Function::LogarithmOfRatio, &[a.high, a.low, b.high, b.low], |arguments| {
            let &[a, a_low, b, b_low] = arguments else { return [arguments[0]; 2] };
            let [a, b] = [(a, a_low), (b, b_low)].map(|(high, low)| Logarithm { high, low });
            [elementary::logarithm_of_ratio(a, b); 2]
        });
        ratio
    }

    fn abs(self) -> Self {
        self.unary(Unary::Absolute)
    }

    fn max(self, other: Self) -> Self {
        Self::select(other.less(self), self, other)
    }

    fn min(self, other: Self) -> Self {
        Self::select(self.less(other), self, other)
    }

    fn copysign(self, sign: Self) -> Self {
        self.binary(Binary::CopySign, sign)
    }

    fn less(self, other: Self) -> RecordedMask {
        RecordedMask::of(RecordedOperation::Less(self.id, other.id))
    }

    fn is_finite(self) -> RecordedMask {
        elementary::is_finite(self)
    }

    fn select(mask: RecordedMask, yes: Self, no: Self) -> Self {
        Self::of(RecordedOperation::Select(mask.0, yes.id, no.id))
    }

    fn two_product(self, other: Self) -> (Self, Self) {
        let operation =
            RecordedOperation::Call(Function::ProductError, [Some(self.id), Some(other.id), None, None]);
        (self * other, Self::of(operation))
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        elementary::power_of_two_scale(self)
    }
}

impl<E: Recordable> Primitive for Recorded<E> {
    // `two_product`, which alone needs to know, is a function of the program.
    const IS_FUSED: bool = false;

    fn is_zero(self) -> RecordedMask {
        RecordedMask::of(RecordedOperation::IsZero(self.id))
    }

    fn split(self) -> (Self, Self) {
        let called = Self::of(RecordedOperation::Call(Function::Split, [Some(self.id), None, None, None]));
        (called, Self::of(RecordedOperation::Second(called.id)))
    }

    fn scale(self, exponent: Self) -> Self {
        self.binary(Binary::Scale, exponent)
    }

    fn leading_power(self) -> Self {
        self.unary(Unary::LeadingPower)
    }

    fn reciprocal_of_power(self) -> Self {
        self.unary(Unary::ReciprocalOfPower)
    }
}
