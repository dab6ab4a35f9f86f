//! Divided differences of functions that are rational in eˣ.
//!
//! Each is a product of positive factors, of which one has the gap: g(d) = (1 − e⁻ᵈ)/d for d = |a − b|, the
//! mean of e⁻ᵗ over 0 … d. The largest exponential is taken out, and multiplied in two halves, because a
//! quotient may be finite where the function itself is not: sinh[720, −720] is 10³⁰⁹/10³.

use super::cardinal::exp_m1c;
use crate::lanes::Real;

/// g(d) = (1 − e⁻ᵈ)/d for d = |a − b|.
#[inline(always)]
fn mean_decay<R: Real>(a: R, b: R) -> R {
    exp_m1c(-(a - b).abs())
}

/// e^x `factor`, which may be finite though e^x is not.
#[inline(always)]
fn times_exponential<R: Real>(x: R, factor: R) -> R {
    let root = (R::splat(0.5) * x).exp();
    (root * factor) * root
}

/// (eᵃ − eᵇ)/(a − b) = e^max(a, b) g(|a − b|), the divided difference of eˣ − 1 too.
#[inline(always)]
pub fn exp_m1_quotient<R: Real>(a: R, b: R) -> R {
    times_exponential(a.max(b), mean_decay(a, b))
}

/// (sinh a − sinh b)/(a − b) = ½ e^max(|a|, |b|) (1 + e^−|a+b|) g(|a − b|).
///
/// It is cosh((a + b)/2) sinh((a − b)/2)/((a − b)/2), and the magnitudes of these arguments add up to the
/// larger one of |a| and |b|.
#[inline(always)]
pub fn sinh_quotient<R: Real>(a: R, b: R) -> R {
    let mean = R::splat(0.5) * (R::splat(1.0) + (-(a + b).abs()).exp());
    times_exponential(a.abs().max(b.abs()), mean * mean_decay(a, b))
}

/// (cosh a − cosh b)/(a − b) = ±½ e^max(|a|, |b|) (1 − e^−|a+b|) g(|a − b|), with the sign of a + b.
///
/// It is sinh((a + b)/2) sinh((a − b)/2)/((a − b)/2), and has the digits of a + b where that is small.
#[inline(always)]
pub fn cosh_quotient<R: Real>(a: R, b: R) -> R {
    let sum = a + b;
    let mean = R::splat(-0.5) * (-sum.abs()).exp_m1();
    times_exponential(a.abs().max(b.abs()), mean * mean_decay(a, b)).copysign(sum)
}

/// (tanh a − tanh b)/(a − b), for tanh x = 2 sigmoid 2x − 1.
#[inline(always)]
pub fn tanh_quotient<R: Real>(a: R, b: R) -> R {
    R::splat(4.0) * sigmoid_quotient(a + a, b + b)
}

/// (σ(a) − σ(b))/(a − b) = e⁻ᵐ g(|a − b|)/((1 + e^−|a|)(1 + e^−|b|)) for the sigmoid σ.
///
/// m is the distance of 0 from the interval between a and b: σ[a, b] is
/// sinh(d/2)/(d/2) / (4 cosh(a/2) cosh(b/2)), and |a| + |b| = d + 2m.
#[inline(always)]
pub fn sigmoid_quotient<R: Real>(a: R, b: R) -> R {
    let one = R::splat(1.0);
    let distance = a.min(b).max(-a.max(b)).max(R::splat(0.0));
    let denominator = (one + (-a.abs()).exp()) * (one + (-b.abs()).exp());
    (-distance).exp() * mean_decay(a, b) / denominator
}
