//! Polynomials with coefficients for each number format.

use super::real::Real;

pub(super) fn is_single<R: Real>() -> bool {
    R::unit_roundoff() > 1e-10
}

/// Σ cₖ xᵏ by Horner's rule, with the coefficients that were fitted for the number format.
#[inline(always)]
pub(super) fn polynomial<R: Real>(x: R, single: &[f64], double: &[f64]) -> R {
    let coefficients = if is_single::<R>() { single } else { double };
    let degree = coefficients.len() - 1;
    let mut sum = R::splat(coefficients[degree]);
    for k in (0..degree).rev() {
        sum = sum.mul_add(x, R::splat(coefficients[k]));
    }
    sum
}
