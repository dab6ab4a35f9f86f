//! Products of 3×3 matrices over any real type, without closures, which lanes would call instead of inlining.

#![expect(non_snake_case, reason = "A, B, U, V as in the formulas")]

use piola::Real;
use piola::point::Matrix3;

/// x·y.
#[inline(always)]
pub(crate) fn dot<R: Real>(x: [R; 3], y: [R; 3]) -> R {
    x[0].mul_add(y[0], x[1].mul_add(y[1], x[2] * y[2]))
}

/// Aᵀ.
#[inline(always)]
pub(crate) fn transpose<R: Real>([a, b, c]: &Matrix3<R>) -> Matrix3<R> {
    [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]]
}

/// A B.
#[inline(always)]
pub(crate) fn multiply<R: Real>(A: &Matrix3<R>, B: &Matrix3<R>) -> Matrix3<R> {
    multiply_transposed(A, &transpose(B))
}

/// A Bᵀ.
#[inline(always)]
pub(crate) fn multiply_transposed<R: Real>(A: &Matrix3<R>, B: &Matrix3<R>) -> Matrix3<R> {
    let mut product = *A;
    for i in 0..3 {
        for j in 0..3 {
            product[i][j] = dot(A[i], B[j]);
        }
    }
    product
}

/// A diag(d).
#[inline(always)]
pub(crate) fn scale_columns<R: Real>(A: &Matrix3<R>, d: [R; 3]) -> Matrix3<R> {
    let mut scaled = *A;
    for i in 0..3 {
        for k in 0..3 {
            scaled[i][k] = A[i][k] * d[k];
        }
    }
    scaled
}

/// U A Vᵀ: from the principal frames to the world.
#[inline(always)]
pub(crate) fn to_world<R: Real>(U: &Matrix3<R>, A: &Matrix3<R>, V: &Matrix3<R>) -> Matrix3<R> {
    multiply_transposed(&multiply(U, A), V)
}

/// cof A: the matrix of signed minors, det A · A⁻ᵀ where that exists.
#[inline(always)]
pub(crate) fn cofactor<R: Real>([a, b, c]: &Matrix3<R>) -> Matrix3<R> {
    [cross(*b, *c), cross(*c, *a), cross(*a, *b)]
}

/// x × y.
#[inline(always)]
pub(crate) fn cross<R: Real>(x: [R; 3], y: [R; 3]) -> [R; 3] {
    [
        x[1].mul_add(y[2], -(x[2] * y[1])),
        x[2].mul_add(y[0], -(x[0] * y[2])),
        x[0].mul_add(y[1], -(x[1] * y[0])),
    ]
}
