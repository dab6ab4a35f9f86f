//! eˣ, eˣ − 1, and powers from a logarithm.
//!
//! x = k ln 2 + r with an integer k and |r| ≤ ½ ln 2, and eˣ = 2ᵏ (1 + r + r² (½ + r/6 + …)).

use super::arithmetic::{is_single, ln_2, nearest_integer_to_product, polynomial, quick_two_sum, residual};
use super::logarithm::Logarithm;
use crate::lanes::primitive::Primitive;

/// (eʳ − 1 − r)/r² = even + r odd, both parts as polynomials in r², for |r| ≤ ½ ln 2.
///
/// To sum even and odd powers apart halves the time to the result, and e⁻ʳ comes with eʳ.
///
/// r² times the error is below 2⁻⁵⁷ eʳ (`f32`: 2⁻²⁸ eʳ).
#[inline(always)]
pub(super) fn exponential_tails<P: Primitive>(square: P) -> (P, P) {
    const SINGLE_EVEN: [f64; 3] = [0.5, 0.041_667_238, 0.001_386_372_6];
    const SINGLE_ODD: [f64; 2] = [0.166_665_35, 0.008_367_430_4];
    const DOUBLE_EVEN: [f64; 5] = [
        0.5,
        0.041_666_666_666_603_97,
        0.001_388_888_892_678_785_5,
        0.000_024_801_508_696_071_14,
        2.762_518_042_932_846e-7,
    ];
    const DOUBLE_ODD: [f64; 5] = [
        0.166_666_666_666_664_33,
        0.008_333_333_333_500_44,
        0.000_198_412_694_654_273_96,
        2.755_764_154_459_307e-6,
        2.497_816_533_961_576_6e-8,
    ];
    (polynomial(square, &SINGLE_EVEN, &DOUBLE_EVEN), polynomial(square, &SINGLE_ODD, &DOUBLE_ODD))
}

#[inline(always)]
fn exponential_tail<P: Primitive>(r: P, square: P) -> P {
    let (even, odd) = exponential_tails(square);
    odd.mul_add(r, even)
}

/// 2ᵏ eʳ.
#[inline(always)]
fn exponential<P: Primitive>(k: P, r: P) -> P {
    let square = r * r;
    (P::splat(1.0) + square.mul_add(exponential_tail(r, square), r)).scale(k)
}

/// x within bounds, and the integer nearest to x / ln 2.
#[inline(always)]
fn reduce<P: Primitive>(x: P) -> (P, P) {
    // Outside of the bounds, by 1 and more, the result is 0 or ∞. NaN passes through as the second operand.
    let (bottom, top) = if is_single::<P>() { (-106.0, 90.0) } else { (-748.0, 711.0) };
    let bounded = P::splat(bottom).max(P::splat(top).min(x));
    (bounded, nearest_integer_to_product(bounded, P::splat(std::f64::consts::LOG2_E)))
}

/// e^x.
#[inline(always)]
pub(in super::super) fn exp<P: Primitive>(x: P) -> P {
    let (x, k) = reduce(x);
    let (ln_2, ln_2_low) = ln_2::<P>();
    let r = k.mul_add(-ln_2_low, k.mul_add(-ln_2, x)); // the inner difference is exact
    exponential(k, r)
}

/// x = k ln 2 + r + r_low, with r_low below the last bit of r.
pub(super) struct Remainder<P> {
    pub(super) k: P,
    pub(super) r: P,
    pub(super) r_low: P,
}

/// The remainder of x, with additional digits where 1 cancels most of eˣ.
#[inline(always)]
pub(super) fn remainder<P: Primitive>(x: P) -> Remainder<P> {
    let (x, k) = reduce(x);
    let (ln_2, ln_2_low) = ln_2::<P>();
    let high = k.mul_add(-ln_2, x); // exact
    let r = k.mul_add(-ln_2_low, high);
    Remainder { k, r, r_low: k.mul_add(-ln_2_low, high - r) }
}

/// e^x − 1 = 2ᵏ ((1 − 2⁻ᵏ) + r + r² (½ + r/6 + …)).
///
/// 1 − 2⁻ᵏ is 0 or at least ½, and cancels r by no more than a third of itself, exactly.
#[inline(always)]
pub(in super::super) fn exp_m1<P: Primitive>(x: P) -> P {
    // Below −40 (`f32`: −20) the result rounds to −1, and 2⁻ᵏ stays in range.
    let bottom = P::splat(if is_single::<P>() { -20.0 } else { -40.0 });
    let Remainder { k, r, r_low } = remainder(bottom.max(x));
    let one = P::splat(1.0);
    let square = r * r;
    let (sum, error) = quick_two_sum(one - one.scale(-k), r);
    let rest = square.mul_add(exponential_tail(r, square), r_low);
    (sum + (error + rest)).scale(k).copysign(x)
}

/// x^exponent from the logarithm of x.
#[inline(always)]
pub(in super::super) fn power<P: Primitive>(logarithm: Logarithm<P>, exponent: P) -> P {
    let (high, k) = reduce(logarithm.high * exponent);
    let low = logarithm.low.mul_add(exponent, residual(logarithm.high, exponent, -high));
    // If the product is out of bounds, `low` is large with the product's sign, or NaN, which `max` replaces
    // as its first operand. Below the bounds the polynomial of a large −r would lift the result from 0, hence
    // the limit; above them any value but NaN gives ∞.
    let low = low.max(P::splat(-1.0));
    let (ln_2, ln_2_low) = ln_2::<P>();
    let r = k.mul_add(-ln_2, high) + k.mul_add(-ln_2_low, low);
    let is_one = logarithm.high.is_zero() | exponent.is_zero();
    P::select(is_one, P::splat(1.0), exponential(k, r))
}
