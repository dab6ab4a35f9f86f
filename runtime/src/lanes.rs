//! The real numbers that every kernel and every generated material computes with.
//!
//! A kernel is written once over [`Real`] and instantiated for `f64` and `f32` here, for batches of them side by
//! side, and for multiprecision types in tests. So a `Real` may be many numbers at once: there is no comparison
//! that yields a `bool`, only masks, and no branch on a value, only [`Real::select`].
//!
//! This module knows numbers only: no matrices, no materials.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

mod scalar;

/// A real number, or several that are computed with side by side.
///
/// Operations are those of IEEE 754 arithmetic with round-to-nearest; the elementary functions are accurate to
/// 1.5 units in the last place and give NaN outside their domain.
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

    /// Unit roundoff u: 2⁻⁵³ for `f64`, 2⁻²⁴ for `f32`.
    const UNIT_ROUNDOFF: f64;

    /// The smallest positive normal number.
    const MIN_POSITIVE: f64;

    /// The number nearest to `value`.
    fn splat(value: f64) -> Self;

    /// self · factor + addend, with one rounding where the hardware has such an instruction, else with two.
    ///
    /// Without the instruction a fused operation is a library call, an order of magnitude slower.
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// √self.
    #[must_use]
    fn sqrt(self) -> Self;
    /// ∛self.
    #[must_use]
    fn cbrt(self) -> Self;
    /// ln self.
    #[must_use]
    fn ln(self) -> Self;
    /// e^self.
    #[must_use]
    fn exp(self) -> Self;
    /// self^exponent for self > 0.
    #[must_use]
    fn powf(self, exponent: Self) -> Self;

    /// |self|.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of the two; the other one where one is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of the two; the other one where one is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// |self| with the sign of `sign`, that of zeros included.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;

    /// self < other; false where one is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> Self::Mask;
    /// `yes` where the mask is set, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The product as a pair: its rounded value and the exact rounding error.
    ///
    /// Exact while neither factor exceeds 2⁹⁹⁶ (`f32`: 2¹¹⁶) and the error does not underflow.
    fn two_product(self, other: Self) -> (Self, Self);

    /// Powers of two (s, 1/s) that bring a magnitude into [1, 2): `self.abs() * s`, undone exactly by `1/s`.
    ///
    /// (1, 1) for zero and for what is not finite; subnormal numbers are brought as far as s stays finite.
    fn power_of_two_scale(self) -> (Self, Self);
}

/// The result of comparing [`Real`]s: one truth value for each number.
pub trait Mask:
    Copy + Debug + Send + Sync + 'static + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// The same truth value for each number.
    fn splat(value: bool) -> Self;
    /// Whether it holds for one of them.
    fn any(self) -> bool;
}
