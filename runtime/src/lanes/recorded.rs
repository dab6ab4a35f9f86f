//! Real number that records the operations on it, so that any computation over [`Real`] becomes a
//! straight-line program, for back ends that print it in another language.
//!
//! A computation runs once. There is no branch on a value to miss, since a `Real` has none; where code tests
//! whether *any* lane of a mask is set, the answer is yes unless the mask is known, so that both ways are
//! recorded. The test itself is kept: operations that only one way needs stand behind a condition again in
//! the printed program ([`RecordedProgram::guards`]).
//!
//! Equal operations exist once, arithmetic with literals is done at once, and no rule changes a bit. Stages
//! and elementary functions are programs of their own, which are called by name.

pub(crate) mod program;
mod tape;

use std::cell::RefCell;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::{self, Logarithm};
use super::primitive::Primitive;
use super::real::{Mask, Numbers, Real, Replace};
use program::{Binary, Id, RecordedFunction, RecordedOperation, Unary};
use tape::Tape;

#[derive(Default)]
struct Recorder {
    /// True if the programs have numbers of 32 bits, false if they have 64.
    is_single: bool,
    /// The programs that are being recorded, each called by the one before.
    tapes: Vec<Tape>,
    /// Programs that are complete, after those that they call.
    functions: Vec<RecordedFunction>,
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

/// Records functions in `f32` or `f64`, each after those that it calls, twice if its name has two programs;
/// `None` if a [`parameter`] was used as a plain number, so that the record is not a program of it.
#[must_use]
pub fn record(is_single: bool, definitions: impl FnOnce()) -> Option<Vec<RecordedFunction>> {
    let tapes = vec![Tape::default()];
    let recorder = Recorder { is_single, tapes, ..Recorder::default() };
    let before = RECORDER.replace(recorder);
    definitions();
    let Recorder { functions, has_lost_parameter, .. } = RECORDER.replace(before);
    (!has_lost_parameter).then_some(functions)
}

/// The value for `f32` or for `f64`, that of the program that is being recorded.
fn of_format(single: f64, double: f64) -> f64 {
    if RECORDER.with_borrow(|recorder| recorder.is_single) { single } else { double }
}

/// Records a function from its inputs to its results, and calls it.
///
/// A call runs the body again because the shape of its results is needed.
pub fn define<I: Numbers<Recorded>, O: Numbers<Recorded>>(
    name: &'static str,
    inputs: I,
    body: impl FnOnce(I) -> O,
) -> O {
    let mut arguments = Vec::new();
    let inputs = inputs.map(&mut Renamed(|id| {
        arguments.push(id);
        id
    }));
    RECORDER.with_borrow_mut(|recorder| recorder.tapes.push(Tape::default()));
    let mut count = 0;
    let inputs = inputs.map(&mut Renamed(|_| {
        count += 1;
        Recorded::of(RecordedOperation::Argument(count - 1)).0
    }));
    let mut results = Vec::new();
    let outputs = body(inputs).map(&mut Renamed(|id| {
        results.push(id);
        id
    }));
    let known = RECORDER.with_borrow_mut(|recorder| {
        let tape = recorder.tapes.pop().unwrap_or_default();
        let truths: Vec<_> = results.iter().map(|&id| tape.truth(id)).collect();
        let function = (name, tape.into_program(results));
        if !recorder.functions.contains(&function) {
            recorder.functions.push(function);
        }
        truths
    });
    let call = Recorded::of(RecordedOperation::Call(name, arguments.into())).0;
    let mut parts = known.into_iter().enumerate();
    outputs.map(&mut Renamed(|_| match parts.next() {
        Some((_, Some(truth))) => RecordedMask::splat(truth).0,
        Some((k, None)) => Recorded::of(RecordedOperation::Part(call, k)).0,
        None => call,
    }))
}

/// Other operations in place of numbers and truth values.
struct Renamed<F>(F);

impl<F: FnMut(Id) -> Id> Replace<Recorded> for Renamed<F> {
    fn number(&mut self, number: Recorded) -> Recorded {
        Recorded((self.0)(number.0))
    }

    fn truth(&mut self, truth: RecordedMask) -> RecordedMask {
        RecordedMask((self.0)(truth.0))
    }
}

impl Numbers<Recorded> for Logarithm<Recorded> {
    fn map(self, to: &mut impl Replace<Recorded>) -> Self {
        Self { high: to.number(self.high), low: to.number(self.low) }
    }
}

impl Recorded {
    fn of(operation: RecordedOperation) -> Self {
        let id = RECORDER.with_borrow_mut(|recorder| match recorder.tapes.last_mut() {
            Some(tape) => tape.simplified(recorder.is_single, operation),
            None => 0,
        });
        Self(id)
    }

    /// The first result of a function without a program, which printers have in each language.
    fn primitive<const N: usize>(name: &'static str, arguments: [Self; N]) -> Self {
        let call = Self::of(RecordedOperation::Call(name, arguments.map(|number| number.0).into()));
        Self::of(RecordedOperation::Part(call.0, 0))
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

/// Methods that call an elementary function.
macro_rules! elementary_stages {
    ($($method:ident)*) => {$(
        fn $method(self) -> Self {
            define(stringify!($method), self, elementary::$method)
        }
    )*};
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
        of_format(f32::UNIT_ROUNDOFF, f64::UNIT_ROUNDOFF)
    }

    fn min_positive() -> f64 {
        of_format(f32::MIN_POSITIVE.into(), f64::MIN_POSITIVE)
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
        Self::of(RecordedOperation::Literal(of_format((value as f32).into(), value).to_bits()))
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

    const IS_RECORDED: bool = true;

    /// A stage of known numbers is computed at once.
    fn stage<I: Numbers<Self>, O: Numbers<Self>>(
        name: &'static str,
        inputs: I,
        body: impl FnOnce(I) -> O,
    ) -> O {
        let mut is_known = true;
        let inputs = inputs.map(&mut Renamed(|id| {
            let tape =
                |recorder: &Recorder| recorder.tapes.last().is_some_and(|tape| tape.literal(id).is_some());
            is_known &= RECORDER.with_borrow(tape);
            id
        }));
        if is_known { body(inputs) } else { define(name, inputs, body) }
    }

    elementary_stages! { cbrt ln exp ln_1p exp_m1 sinh cosh tanh asinh sin cos atan erf softplus sigmoid }

    fn logarithm(self) -> Self::Logarithm {
        define("logarithm", self, elementary::logarithm)
    }

    fn power(logarithm: Self::Logarithm, exponent: Self) -> Self {
        define("power", (logarithm, exponent), |(logarithm, exponent)| elementary::power(logarithm, exponent))
    }

    fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self {
        define("logarithm_of_ratio", (a, b), |(a, b)| elementary::logarithm_of_ratio(a, b))
    }

    fn abs(self) -> Self {
        self.unary(Unary::Absolute)
    }

    fn max(self, other: Self) -> Self {
        define("max", (self, other), |(a, b)| Self::select(b.less(a), a, b))
    }

    fn min(self, other: Self) -> Self {
        define("min", (self, other), |(a, b)| Self::select(a.less(b), a, b))
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
        (self * other, Self::primitive("product_error", [self, other]))
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        define("power_of_two_scale", self, elementary::power_of_two_scale)
    }
}

impl Primitive for Recorded {
    // `two_product`, the only one that depends on it, is a function of the program.
    const IS_FUSED: bool = false;

    fn is_zero(self) -> RecordedMask {
        RecordedMask::of(RecordedOperation::IsZero(self.0))
    }

    fn split(self) -> (Self, Self) {
        let call = RecordedOperation::Call("split", [self.0].into());
        let [mantissa, exponent] = [0, 1].map(|k| RecordedOperation::Part(Self::of(call.clone()).0, k));
        (Self::of(mantissa), Self::of(exponent))
    }

    fn scale(self, exponent: Self) -> Self {
        Self::primitive("scale", [self, exponent])
    }

    fn leading_power(self) -> Self {
        Self::primitive("leading_power", [self])
    }

    fn reciprocal_of_power(self) -> Self {
        Self::primitive("reciprocal_of_power", [self])
    }
}
