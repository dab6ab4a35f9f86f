//! 3×3 matrices over any real type, without closures, which lanes would call instead of inlining.

#![expect(non_snake_case, reason = "A as in the formulas")]

pub(crate) use piola::__private::matrix::{dot, multiply, multiply_transposed, to_world, transpose};
use piola::Real;
use piola::point::Matrix3;

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
