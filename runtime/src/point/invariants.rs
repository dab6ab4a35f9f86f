//! Stress without a singular value decomposition, for energies of the invariants I1 = |F|², I2 = |cof F|², J
//! = det F.
//!
//! ```text
//! ∂I1/∂F = 2 F,   ∂I2/∂F = 2 (I1 F − F Fᵀ F),   ∂J/∂F = cof F
//! ```
//!
//! What floating point does here. I1 and I2 are sums of squares, and J comes from a determinant in twice the
//! working precision, so that each is as good as F determines it: within a few u of its sensitivity to
//! relative changes of F by 1. So is P.

#![expect(non_snake_case, reason = "F, P, I1, I2, J as in the text above")]

use super::matrix::{dot, multiply_transposed, three};
use super::svd::determinant;
use super::{Matrix3, entries_are_finite};
use crate::lanes::Real;

/// I1, I2, J; and whether all of them, and what is computed from them, stay in range.
#[inline(always)]
pub(crate) fn invariants<R: Real>(F: &Matrix3<R>) -> ([R; 3], R::Mask) {
    let rows: [R; 3] = three!(i => F[i][0].abs().max(F[i][1].abs()).max(F[i][2].abs()));
    let largest = rows[0].max(rows[1]).max(rows[2]);
    // The eighth root of the range: I2 and the error terms of the determinant are of degree 4 and 6.
    let (low, high) = (R::splat(R::MIN_POSITIVE.powf(0.125)), R::splat(R::MIN_POSITIVE.powf(-0.125)));
    let is_in_range = low.less(largest) & largest.less(high) & entries_are_finite(F);

    ([square(F), square(&cofactor(F)), determinant(F)], is_in_range)
}

/// Squared Frobenius norm |A|².
#[inline(always)]
fn square<R: Real>(A: &Matrix3<R>) -> R {
    dot(A[0], A[0]) + dot(A[1], A[1]) + dot(A[2], A[2])
}

/// P = 2 W1 F + 2 W2 (I1 F − F Fᵀ F) + WJ cof F, Pa.
#[inline(always)]
pub(crate) fn stress_by_invariants<R: Real>(F: &Matrix3<R>, I1: R, [W1, W2, WJ]: [R; 3]) -> Matrix3<R> {
    let b = multiply_transposed(F, F);
    let cofactor = cofactor(F);
    let (twice_W1, twice_W2) = (W1 + W1, W2 + W2);
    let along_F = twice_W2.mul_add(I1, twice_W1);
    three!(i => three!(j => {
        let cubed = dot(b[i], [F[0][j], F[1][j], F[2][j]]);
        along_F.mul_add(F[i][j], (-twice_W2).mul_add(cubed, WJ * cofactor[i][j]))
    }))
}

/// Cofactors of F: the matrix of signed minors, J F⁻ᵀ where that exists.
#[inline(always)]
fn cofactor<R: Real>(F: &Matrix3<R>) -> Matrix3<R> {
    three!(i => three!(j => {
        let (k, l, m, n) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        F[k][m].mul_add(F[l][n], -(F[k][n] * F[l][m]))
    }))
}
