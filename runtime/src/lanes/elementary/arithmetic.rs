//! Roundings, and sums and products with their rounding errors.

pub(super) use crate::lanes::polynomial::{is_single, polynomial};
use crate::lanes::primitive::Primitive;

/// `value` minus its nearest neighbour in the format, if that is `f32`; else `low`, what `f64` takes from it.
#[inline(always)]
pub(super) fn below_the_last_bit<P: Primitive>(value: f64, low: f64) -> P {
    P::splat(if is_single::<P>() { value - (value as f32) as f64 } else { low })
}

/// 2ⁿ for n < 64.
pub(super) const fn power_of_two(n: u32) -> f64 {
    (1u64 << n) as f64
}

/// ln 2 = high + low, and high times an exponent is exact [CW80].
#[inline(always)]
pub(super) fn ln_2<P: Primitive>() -> (P, P) {
    let (high, low) = if is_single::<P>() {
        (0.693_145_751_953_125, 1.428_606_820_309_417_3e-6)
    } else {
        (0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10)
    };
    (P::splat(high), P::splat(low))
}

/// The integer nearest to a b, for |a b| ≤ 2⁵⁰ (`f32`: 2²¹).
#[inline(always)]
pub(super) fn nearest_integer_to_product<P: Primitive>(a: P, b: P) -> P {
    let rounding = P::splat(P::rounding());
    a.mul_add(b, rounding) - rounding
}

/// a + b as a rounded value and its error, for |a| ≥ |b| or a = 0 [Dekker71].
#[inline(always)]
pub(super) fn quick_two_sum<P: Primitive>(a: P, b: P) -> (P, P) {
    let sum = a + b;
    (sum, (a - sum) + b)
}

/// a + b as a rounded value and its error, whichever is larger \[Knuth97\] 4.2.2.
#[inline(always)]
pub(super) fn two_sum<P: Primitive>(a: P, b: P) -> (P, P) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// A quotient of unevaluated sums, high + low each, to little more than its last rounding.
///
/// q = high/high, and the remainder n − q d, of which the high parts cancel, gives the next digits.
#[inline(always)]
pub(super) fn quotient_of_sums<P: Primitive>(
    (numerator, numerator_low): (P, P),
    (denominator, denominator_low): (P, P),
) -> P {
    let (quotient, correction) = divide((numerator, numerator_low), (denominator, denominator_low));
    quotient + correction
}

/// The quotient of [`quotient_of_sums`] before its last sum.
#[inline(always)]
pub(super) fn divide<P: Primitive>(
    (numerator, numerator_low): (P, P),
    (denominator, denominator_low): (P, P),
) -> (P, P) {
    let reciprocal = P::splat(1.0) / denominator;
    let quotient = numerator * reciprocal;
    let remainder = residual(quotient, -denominator, numerator) + numerator_low;
    (quotient, quotient.mul_add(-denominator_low, remainder) * reciprocal)
}

/// a b as a rounded value and its error; see [`Real::two_product`](crate::lanes::Real::two_product).
#[inline(always)]
pub(in super::super) fn two_product<P: Primitive>(a: P, b: P) -> (P, P) {
    let product = a * b;
    if P::IS_FUSED {
        return (product, a.mul_add(b, -product));
    }
    // Veltkamp's splitting and Dekker's product: each half has few enough bits for exact products.
    let split = |x: P| {
        let big = P::splat(power_of_two(P::digits().div_ceil(2)) + 1.0) * x;
        let high = big - (big - x);
        (high, x - high)
    };
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, al * bl - (((product - ah * bh) - al * bh) - ah * bl))
}

/// a b + c if c cancels the product except for a few bits: with all digits, whether or not products are
/// fused.
#[inline(always)]
pub(super) fn residual<P: Primitive>(a: P, b: P, c: P) -> P {
    if P::IS_FUSED {
        return a.mul_add(b, c);
    }
    let (high, low) = a.two_product(b);
    (high + c) + low
}

#[inline(always)]
pub(in super::super) fn is_finite<P: Primitive>(x: P) -> P::Mask {
    x.abs().less(P::splat(f64::INFINITY))
}

/// See [`Real::power_of_two_scale`](crate::lanes::Real::power_of_two_scale).
#[inline(always)]
pub(in super::super) fn power_of_two_scale<P: Primitive>(x: P) -> (P, P) {
    let smallest = P::splat(P::min_positive());
    // Both 2⁻ᵉ and 2ᵉ are normal numbers for |e| ≤ bias − 1.
    let largest = P::splat(1.0 / P::min_positive());
    let power = x.leading_power();
    let zero = P::splat(0.0);
    let is_ordinary = zero.less(x.abs()) & power.less(P::splat(f64::INFINITY));
    let back = P::select(is_ordinary, power.max(smallest).min(largest), P::splat(1.0));
    (back.reciprocal_of_power(), back)
}
