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
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::{self, Logarithm};
use super::primitive::Primitive;
use super::real::{Mask, Real};
use program::{
    Binary, Function, Id, Recordable, RecordedOperation, RecordedProgram, Recording, Unary,
    UnrecordedParameter, calls,
};
use tape::Tape;

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

/// Bits of a signalling NaN, and of the quiet NaN that an operation makes of it.
const PARAMETERS: u64 = 0x7ff4_9101_0000_0000;
const QUIET: u64 = 0x7ffc_9101_0000_0000;

/// Records a computation from arguments to numbers and truth values.
///
/// # Errors
/// [`UnrecordedParameter`] if the computation has used a [`parameter`] other than as a number of the program.
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

/// Results of a function, which is recorded when it is first called. The second is valid only if the function
/// [is a pair](Function::is_pair).
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
    // `two_product`, the only one that depends on it, is a function of the program.
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
