//! The operations of a real number, and the truth values that its comparisons give.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A real number, or several side by side in the lanes of a register.
///
/// Operations are those of IEEE 754 arithmetic with round-to-nearest; the elementary functions are accurate
/// to 1.5 units in the last place, exact at 0 and ∞, and give NaN outside their domain.
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The result of a comparison.
    type Mask: Mask;

    /// A logarithm with enough digits to make any power from it; see [`Real::logarithm`].
    #[doc(hidden)] // for generated code
    type Logarithm: Copy + Debug + Send + Sync + 'static;

    /// Unit roundoff u: 2⁻⁵³ for `f64`, 2⁻²⁴ for `f32`.
    const UNIT_ROUNDOFF: f64;

    /// The smallest positive normal number.
    const MIN_POSITIVE: f64;

    /// True if 32 registers hold such numbers, and not 16 or fewer.
    #[doc(hidden)] // for the order of operations
    const HAS_MANY_REGISTERS: bool = false;

    /// True for the number that records what is computed with it.
    #[doc(hidden)]
    const IS_RECORDED: bool = false;

    /// A part of a computation with a name, from its inputs alone: see `stage!`.
    #[doc(hidden)]
    #[inline(always)]
    fn stage<I: Numbers<Self>, O: Numbers<Self>>(
        name: &'static str,
        inputs: I,
        body: impl FnOnce(I) -> O,
    ) -> O {
        let _ = name;
        body(inputs)
    }

    /// [`UNIT_ROUNDOFF`](Self::UNIT_ROUNDOFF) of the numbers that are computed with: a type may have its
    /// format at run time.
    #[doc(hidden)]
    #[inline(always)]
    fn unit_roundoff() -> f64 {
        Self::UNIT_ROUNDOFF
    }

    /// [`MIN_POSITIVE`](Self::MIN_POSITIVE), likewise.
    #[doc(hidden)]
    #[inline(always)]
    fn min_positive() -> f64 {
        Self::MIN_POSITIVE
    }

    /// `value` in every lane, rounded to the number format.
    fn splat(value: f64) -> Self;

    /// `value(lane)` in each lane, rounded to the number format. A scalar is lane 0.
    #[doc(hidden)] // for parameters that differ between lanes
    fn from_fn(value: impl Fn(usize) -> f64) -> Self;

    /// self · factor + addend, with one rounding where the hardware has such an instruction, else with two.
    ///
    /// Without the instruction a fused operation is a library call, an order of magnitude slower.
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// √self.
    #[must_use]
    fn sqrt(self) -> Self;
    /// 1/√self to two units in the last place for a normal self > 0.
    #[doc(hidden)] // for rotations
    #[must_use]
    #[inline(always)]
    fn reciprocal_sqrt(self) -> Self {
        Self::splat(1.0) / self.sqrt()
    }
    /// ∛self.
    #[must_use]
    fn cbrt(self) -> Self;
    /// ln self.
    #[must_use]
    fn ln(self) -> Self;
    /// e^self.
    #[must_use]
    fn exp(self) -> Self;
    /// ln(1 + self), also where 1 takes all digits of self.
    #[must_use]
    fn ln_1p(self) -> Self;
    /// e^self − 1, also where 1 takes all digits of the exponential.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// sinh self.
    #[must_use]
    fn sinh(self) -> Self;
    /// cosh self.
    #[must_use]
    fn cosh(self) -> Self;
    /// tanh self.
    #[must_use]
    fn tanh(self) -> Self;
    /// The inverse of sinh, ln(self + √(1 + self²)).
    #[must_use]
    fn asinh(self) -> Self;
    /// sin self, NaN for ±∞.
    ///
    /// The accuracy is promised for |self| ≤ 1.6·10⁶ (`f32`: 1600). Beyond, up to 2⁵⁰ (`f32`: 2²¹), it is the
    /// sine of an argument within 4u |self| of self, and for larger ones some value between −1 and 1.
    #[must_use]
    fn sin(self) -> Self;
    /// cos self, NaN for ±∞, as accurate as [`Real::sin`].
    #[must_use]
    fn cos(self) -> Self;
    /// The inverse of tan, between −π/2 and π/2.
    #[must_use]
    fn atan(self) -> Self;
    /// The error function 2/√π ∫ e^(−t²) dt from 0 to self.
    #[must_use]
    fn erf(self) -> Self;
    /// ln(1 + e^self), smooth between 0 and self.
    #[must_use]
    fn softplus(self) -> Self;
    /// 1/(1 + e^−self), the derivative of [`Real::softplus`].
    #[must_use]
    fn sigmoid(self) -> Self;
    /// self^exponent for self ≥ 0; NaN for self < 0.
    #[must_use]
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        Self::power(self.logarithm(), exponent)
    }

    /// ln self with extra digits, from which each power costs one exponential.
    #[doc(hidden)] // for generated code
    fn logarithm(self) -> Self::Logarithm;
    /// x^exponent from the logarithm of x.
    #[doc(hidden)] // for generated code
    #[must_use]
    fn power(logarithm: Self::Logarithm, exponent: Self) -> Self;
    /// ln (a/b) from the logarithms of a and b.
    ///
    /// The relative error is 2u unless a/b is within u² |ln a| of 1.
    #[doc(hidden)] // for quotients of generated code
    #[must_use]
    fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self;

    /// |self|.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of two numbers: self > other ? self : other, hence `other` if either is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of two numbers: self < other ? self : other, hence `other` if either is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// |self| with the sign bit of `sign`, also if `sign` is zero.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;

    /// self < other; false if either is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// True if self is neither infinite nor NaN.
    fn is_finite(self) -> Self::Mask;
    /// `yes` where the mask is set, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// A product as a pair: its rounded value and the exact rounding error.
    ///
    /// Exact while neither factor exceeds 2⁹⁹⁶ (`f32`: 2¹¹⁶) and the error does not underflow.
    #[doc(hidden)] // for decompositions and invariants
    fn two_product(self, other: Self) -> (Self, Self);

    /// Powers of two (s, 1/s) that bring |self| into [1, 2): multiply by s, undo exactly by 1/s.
    ///
    /// (1, 1) for zero, ∞ and NaN; subnormal numbers are scaled up by the largest s that is finite.
    #[doc(hidden)] // for decompositions
    fn power_of_two_scale(self) -> (Self, Self);
}

/// The result of comparing [`Real`]s: one truth value for each lane.
pub trait Mask:
    Copy + Debug + Send + Sync + 'static + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// `value` in every lane.
    fn splat(value: bool) -> Self;
    /// True if any lane is set.
    fn any(self) -> bool;
}

/// Numbers and truth values in a fixed order, which go into a stage or come out of it.
pub trait Numbers<R: Real>: Sized {
    /// The same with every number and truth value replaced, in their order.
    #[must_use]
    fn map(self, to: &mut impl Replace<R>) -> Self;
}

/// Replaces numbers and truth values.
pub trait Replace<R: Real> {
    /// In place of a number.
    fn number(&mut self, number: R) -> R;
    /// In place of a truth value.
    fn truth(&mut self, truth: R::Mask) -> R::Mask;
}

impl<R: Real> Numbers<R> for R {
    fn map(self, to: &mut impl Replace<R>) -> Self {
        to.number(self)
    }
}

/// A truth value that comes out of a stage.
pub struct Truth<M>(pub M);

impl<R: Real> Numbers<R> for Truth<R::Mask> {
    fn map(self, to: &mut impl Replace<R>) -> Self {
        Self(to.truth(self.0))
    }
}

impl<R: Real, T: Numbers<R>, const N: usize> Numbers<R> for [T; N] {
    fn map(self, to: &mut impl Replace<R>) -> Self {
        self.map(|one| one.map(to))
    }
}

macro_rules! numbers {
    ($($($name:ident)*;)*) => {$(
        impl<R: Real, $($name: Numbers<R>),*> Numbers<R> for ($($name,)*) {
            #[expect(non_snake_case, reason = "a value and its type have one name")]
            fn map(self, to: &mut impl Replace<R>) -> Self {
                let ($($name,)*) = self;
                ($($name.map(to),)*)
            }
        }
    )*};
}
numbers! { A; A B; A B C; A B C D; A B C D E; A B C D E F; }

/// `stage!(R, "name", (inputs) => body)`: a part of a computation that has a name. Numbers compute it in
/// place; the one that records writes it down once as a function and then calls it. The body uses these
/// variables and what is the same in all its calls, but no other number.
///
/// A macro, because the body must be in the function itself: as a closure, it would not have the instructions
/// of a kernel.
macro_rules! stage {
    ($R:ty, $name:expr, ($($input:ident),*) => $body:expr) => {
        if <$R as $crate::lanes::Real>::IS_RECORDED {
            <$R as $crate::lanes::Real>::stage($name, ($($input,)*), |($($input,)*)| $body)
        } else {
            $body
        }
    };
}
pub(crate) use stage;
