//! Real number that records the operations on it, so that any computation over [`Real`] becomes a
//! straight-line program, for back ends that print it in another language.
//!
//! A computation runs once. There is no branch on a value to miss, since a `Real` has none; where code tests
//! whether *any* lane of a mask is set, the answer is yes unless the mask is known, so that both ways are
//! recorded. The test itself is kept: operations that only one way needs stand behind a condition again in
//! the printed program ([`RecordedProgram::guards`]).
//!
//! Equal operations exist once, arithmetic with literals is done at once, and no rule changes a bit. The
//! elementary functions are recorded as well, each once, and called.

pub(crate) mod program;
mod tape;

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::{self, Logarithm};
use super::primitive::Primitive;
use super::real::{Mask, Real};
use program::{Binary, Format, Function, Id, RecordedOperation, RecordedProgram, Recording, Unary, calls};
use tape::Tape;

#[derive(Default)]
struct Recorder {
    format: Format,
    /// The program, and above it the functions that are being recorded.
    tapes: Vec<Tape>,
    functions: BTreeMap<Function, RecordedProgram>,
    has_lost_parameter: bool,
}

thread_local!(static RECORDER: RefCell<Recorder> = RefCell::default());

/// A number of a program, in the format that [`record`] was given: the code that records is compiled once for
/// all formats.
#[derive(Clone, Copy, Debug)]
pub struct Recorded(Id);

/// A truth value of a program.
#[derive(Clone, Copy, Debug)]
pub struct RecordedMask(Id);

/// The value that stands for a parameter: a signalling NaN, so that arithmetic in Rust would show.
#[must_use]
pub fn parameter(k: u32) -> f64 {
    f64::from_bits(PARAMETERS | u64::from(k))
}

/// Bits of a signalling NaN, and of the quiet NaN that an operation makes of it.
const PARAMETERS: u64 = 0x7ff4_9101_0000_0000;
const QUIET: u64 = 0x7ffc_9101_0000_0000;

/// Records a computation from arguments to numbers and truth values in a format; `None` if it has used a
/// [`parameter`] as a plain number, so that the record is not a program of the parameter.
#[must_use]
pub fn record(
    format: Format,
    arguments: usize,
    computation: impl FnOnce(&[Recorded]) -> (Vec<Recorded>, Vec<RecordedMask>),
) -> Option<Recording> {
    let before = RECORDER.replace(Recorder { format, ..Recorder::default() });
    let program = recorded(arguments, |arguments| {
        let (numbers, masks) = computation(arguments);
        numbers.iter().map(|number| number.0).chain(masks.iter().map(|mask| mask.0)).collect()
    });
    let Recorder { functions, has_lost_parameter, .. } = RECORDER.replace(before);
    (!has_lost_parameter).then_some(Recording { program, functions })
}

/// The program of a computation on a tape of its own.
fn recorded(count: usize, computation: impl FnOnce(&[Recorded]) -> Vec<Id>) -> RecordedProgram {
    RECORDER.with_borrow_mut(|recorder| recorder.tapes.push(Tape::default()));
    let arguments: Vec<_> = (0..count as u32).map(|k| Recorded::of(RecordedOperation::Argument(k))).collect();
    let results = computation(&arguments);
    let tape = RECORDER.with_borrow_mut(|recorder| recorder.tapes.pop()).unwrap_or_default();
    RecordedProgram { arguments: count, ..tape.into_program(results) }
}

/// First result of a function, which is recorded when it is first called.
fn call<const N: usize>(
    function: Function,
    arguments: [Recorded; N],
    body: impl FnOnce([Recorded; N]) -> Vec<Recorded>,
) -> Recorded {
    if !RECORDER.with_borrow(|recorder| recorder.functions.contains_key(&function)) {
        let program = recorded(N, |arguments| {
            let results = body(std::array::from_fn(|k| arguments[k]));
            results.into_iter().map(|result| result.0).collect()
        });
        RECORDER.with_borrow_mut(|recorder| recorder.functions.insert(function, program));
    }
    Recorded::of(RecordedOperation::Call(
        function,
        std::array::from_fn(|k| arguments.get(k).map(|argument| argument.0)),
    ))
}

impl Format {
    /// The format of the program that is being recorded.
    fn current() -> Self {
        RECORDER.with_borrow(|recorder| recorder.format)
    }
}

impl Recorded {
    fn of(operation: RecordedOperation) -> Self {
        let id = RECORDER.with_borrow_mut(|recorder| match recorder.tapes.last_mut() {
            Some(tape) => tape.simplified(recorder.format, operation),
            None => 0,
        });
        Self(id)
    }

    /// The second result of a call.
    fn second(self) -> Self {
        Self::of(RecordedOperation::Second(self.0))
    }

    fn unary(self, operator: Unary) -> Self {
        Self::of(RecordedOperation::Unary(operator, self.0))
    }

    fn binary(self, operator: Binary, other: Self) -> Self {
        Self::of(RecordedOperation::Binary(operator, self.0, other.0))
    }
}

impl RecordedMask {
    fn of(operation: RecordedOperation) -> Self {
        Self(Recorded::of(operation).0)
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
    ($($Type:ident: $Trait:ident $method:ident |$a:ident, $b:ident| $operation:expr,)*) => {$(
        impl $Trait for $Type {
            type Output = Self;

            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self.0, other.0);
                Self::of($operation)
            }
        }
    )*};
}

operators! {
    Recorded: Add add |a, b| RecordedOperation::Binary(Binary::Add, a, b),
    Recorded: Sub sub |a, b| RecordedOperation::Binary(Binary::Subtract, a, b),
    Recorded: Mul mul |a, b| RecordedOperation::Binary(Binary::Multiply, a, b),
    Recorded: Div div |a, b| RecordedOperation::Binary(Binary::Divide, a, b),
    RecordedMask: BitAnd bitand |a, b| RecordedOperation::And(a, b),
    RecordedMask: BitOr bitor |a, b| RecordedOperation::Or(a, b),
}

impl Neg for Recorded {
    type Output = Self;

    fn neg(self) -> Self {
        self.unary(Unary::Negate)
    }
}

impl Real for Recorded {
    type Mask = RecordedMask;
    type Logarithm = Logarithm<Self>;
    // Known at run time only: whoever reads these instead of the functions gets NaN.
    const UNIT_ROUNDOFF: f64 = f64::NAN;
    const MIN_POSITIVE: f64 = f64::NAN;

    fn unit_roundoff() -> f64 {
        Format::current().unit_roundoff()
    }

    fn min_positive() -> f64 {
        Format::current().min_positive()
    }

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
        Self::of(RecordedOperation::Literal(Format::current().rounded(value).to_bits()))
    }

    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        Self::splat(value(0))
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        Self::of(RecordedOperation::MulAdd(self.0, factor.0, addend.0))
    }

    fn sqrt(self) -> Self {
        self.unary(Unary::SquareRoot)
    }

    calls!();

    fn logarithm(self) -> Self::Logarithm {
        let high = call(Function::Logarithm, [self], |[x]| {
            let Logarithm { high, low } = elementary::logarithm(x);
            vec![high, low]
        });
        Logarithm { high, low: high.second() }
    }

    fn power(Logarithm { high, low }: Self::Logarithm, exponent: Self) -> Self {
        call(Function::Power, [high, low, exponent], |[high, low, exponent]| {
            vec![elementary::power(Logarithm { high, low }, exponent)]
        })
    }

    fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self {
        call(Function::LogarithmOfRatio, [a.high, a.low, b.high, b.low], |[a, a_low, b, b_low]| {
            let [a, b] = [(a, a_low), (b, b_low)].map(|(high, low)| Logarithm { high, low });
            vec![elementary::logarithm_of_ratio(a, b)]
        })
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
        RecordedMask::of(RecordedOperation::Less(self.0, other.0))
    }

    fn is_finite(self) -> RecordedMask {
        elementary::is_finite(self)
    }

    fn select(mask: RecordedMask, yes: Self, no: Self) -> Self {
        Self::of(RecordedOperation::Select(mask.0, yes.0, no.0))
    }

    fn two_product(self, other: Self) -> (Self, Self) {
        let operation =
            RecordedOperation::Call(Function::ProductError, [Some(self.0), Some(other.0), None, None]);
        (self * other, Self::of(operation))
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        elementary::power_of_two_scale(self)
    }
}

impl Primitive for Recorded {
    // `two_product`, the only one that depends on it, is a function of the program.
    const IS_FUSED: bool = false;

    fn is_zero(self) -> RecordedMask {
        RecordedMask::of(RecordedOperation::IsZero(self.0))
    }

    fn split(self) -> (Self, Self) {
        let called = Self::of(RecordedOperation::Call(Function::Split, [Some(self.0), None, None, None]));
        (called, called.second())
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
