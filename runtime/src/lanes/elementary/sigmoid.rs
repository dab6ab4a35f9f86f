//! The sigmoid 1/(1 + e⁻ˣ), and its integral softplus ln(1 + eˣ).
//!
//! Both are made of e^(−|x|), which never overflows, with digits to spare, so that they have a relative error
//! where they vanish with eˣ, and none of their own where 1 or x outweighs it.

use super::arithmetic::{quick_two_sum, quotient_of_sums};
use super::exponential::{Remainder, exponential_tails, remainder};
use super::logarithm::ln_of_sum;
use crate::lanes::primitive::Primitive;

/// e^(−|x|) = 2ᵏ (high + low).
struct Exponential<P> {
    k: P,
    high: P,
    low: P,
}

#[inline(always)]
fn exponential_of_minus_magnitude<P: Primitive>(x: P) -> Exponential<P> {
    let Remainder { k, r, r_low } = remainder(-x.abs());
    let square = r * r;
    let (even, odd) = exponential_tails(square);
    let (sum, error) = quick_two_sum(P::splat(1.0), r);
    let (high, low) = quick_two_sum(sum, square.mul_add(odd.mul_add(r, even), error + r_low));
    Exponential { k, high, low }
}

/// 1 + 2ᵏ (high + low), as a sum again.
#[inline(always)]
fn one_more<P: Primitive>(&Exponential { k, high, low }: &Exponential<P>) -> (P, P) {
    let (sum, error) = quick_two_sum(P::splat(1.0), high.scale(k));
    (sum, error + low.scale(k))
}

/// 1/(1 + e⁻ˣ), for x < 0 as eˣ/(1 + eˣ).
#[inline(always)]
pub(in super::super) fn sigmoid<P: Primitive>(x: P) -> P {
    let exponential = exponential_of_minus_magnitude(x);
    let denominator = one_more(&exponential);
    let Exponential { k, high, low } = exponential;
    let (zero, one) = (P::splat(0.0), P::splat(1.0));
    let is_negative = x.less(zero);
    let numerator = (P::select(is_negative, high, one), P::select(is_negative, low, zero));
    quotient_of_sums(numerator, denominator).scale(P::select(is_negative, k, zero))
}

/// ln(1 + e^x) = max(x, 0) + ln(1 + e^(−|x|)).
#[inline(always)]
pub(in super::super) fn softplus<P: Primitive>(x: P) -> P {
    let (high, low) = one_more(&exponential_of_minus_magnitude(x));
    let zero = P::splat(0.0);
    x.max(zero) + ln_of_sum(high, low, zero)
}
