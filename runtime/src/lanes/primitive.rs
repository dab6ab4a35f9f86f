//! Operations on exponent and mantissa, from which the elementary functions are made.

use super::real::Real;

/// A [`Real`] in hardware: operations that differ from one set of instructions to the next.
pub trait Primitive: Real {
    /// True if [`Real::mul_add`] rounds once.
    const IS_FUSED: bool;

    /// ¾/u. Adding and subtracting it rounds |x| ≤ 2⁵⁰ (`f32`: 2²¹) to the nearest integer.
    const ROUNDING: f64 = 0.75 / Self::UNIT_ROUNDOFF;

    /// Binary digits of the significand: u is 2 to the power of minus their number.
    #[inline(always)]
    fn digits() -> u32 {
        1023 - (Self::unit_roundoff().to_bits() >> 52) as u32
    }

    /// [`ROUNDING`](Self::ROUNDING) of the numbers that are computed with.
    #[inline(always)]
    fn rounding() -> f64 {
        0.75 / Self::unit_roundoff()
    }

    /// self = ±0.
    fn is_zero(self) -> Self::Mask;

    /// (m, e) with self = m 2ᵉ and √½ ≤ m < √2, both rounded, for a finite self > 0.
    ///
    /// (1, −∞) for ±0 and (1, ∞) for ∞; for NaN and negative numbers m or e is NaN.
    fn split(self) -> (Self, Self);
    /// self · 2ᵉ, rounded once, for ½ ≤ self < 2 and an integer e between −2 bias and 2 bias.
    #[must_use]
    fn scale(self, exponent: Self) -> Self;
    /// The power of two in |self|: 0 for zero and subnormal numbers, ∞ for ∞ and NaN.
    #[must_use]
    fn leading_power(self) -> Self;
    /// 1/self for a power of two if both are normal.
    #[must_use]
    fn reciprocal_of_power(self) -> Self;
}

/// x > 0 times a power of two that makes subnormal numbers normal, and the exponent of that power.
#[inline(always)]
pub(super) fn lift<P: Primitive>(x: P) -> (P, P) {
    // 1/u is 2 to the number of digits.
    let (power, exponent) = (1.0 / P::unit_roundoff(), f64::from(P::digits()));
    let is_tiny = x.less(P::splat(P::min_positive()));
    (P::select(is_tiny, x * P::splat(power), x), P::select(is_tiny, P::splat(exponent), P::splat(0.0)))
}

/// `exponent` if x is finite and positive, else the exponent that [`Primitive::split`] promises for x.
#[inline(always)]
pub(super) fn exponent_or_limit<P: Primitive>(x: P, exponent: P) -> P {
    let zero = P::splat(0.0);
    let limit = P::select(x.less(zero), P::splat(f64::NAN), P::splat(f64::NEG_INFINITY));
    let exponent = P::select(zero.less(x), exponent, limit);
    // Where the comparison fails, x itself is the exponent: ∞ or NaN.
    P::select(x.less(P::splat(f64::INFINITY)), exponent, x)
}
