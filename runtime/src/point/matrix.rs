//! Products of 3×3 matrices over any real type, written out so that lanes keep them in registers.

#![expect(non_snake_case, reason = "the letters of the formulas: A, B, U, V")]

use super::Matrix3;
use crate::lanes::Real;

/// `three!(i => x)` is `[x, x, x]` with i = 0, 1, 2.
///
/// What `std::array::from_fn` makes, without a closure. Lanes must be computed with inside one function that
/// is compiled for their instructions; a long closure is a function of its own unless the compiler finds it
/// worth inlining, and then costs a call for every operation in it.
macro_rules! three {
    ($i:ident => $value:expr) => {
        three!($i => $value; 0, 1, 2)
    };
    ($i:ident => $value:expr; $($index:literal),*) => {
        [$({
            let $i: usize = $index;
            $value
        }),*]
    };
}

/// `symmetric!(i, j => x)` is the matrix of `x` for i ≤ j, computed once for each pair, and its mirror image.
macro_rules! symmetric {
    ($i:ident, $j:ident => $value:expr) => {{
        let [a, b, c, d, e, f] = symmetric!($i, $j => $value; 0 0, 0 1, 0 2, 1 1, 1 2, 2 2);
        [[a, b, c], [b, d, e], [c, e, f]]
    }};
    ($i:ident, $j:ident => $value:expr; $($row:literal $column:literal),*) => {
        [$({
            let ($i, $j) = ($row, $column);
            $value
        }),*]
    };
}

/// `thrice!(i => { … })` does it with i = 0, 1, 2: a loop that needs no unrolling, so that every index is a
/// constant from the beginning.
#[cfg(feature = "batch")]
macro_rules! thrice {
    ($i:ident => $body:block) => {
        thrice!($i => $body; 0, 1, 2)
    };
    ($i:ident => $body:block; $($index:literal),*) => {{
        $({
            let $i: usize = $index;
            $body
        })*
    }};
}

#[cfg(feature = "batch")]
pub(crate) use thrice;
pub(crate) use {symmetric, three};

/// The scalar product x·y.
#[inline(always)]
pub fn dot<R: Real>(x: [R; 3], y: [R; 3]) -> R {
    x[0].mul_add(y[0], x[1].mul_add(y[1], x[2] * y[2]))
}

/// A x for the symmetric A with the entries a11, a22, a33, a12, a13, a23.
#[inline(always)]
pub(crate) fn multiply_symmetric<R: Real>([a11, a22, a33, a12, a13, a23]: [R; 6], x: [R; 3]) -> [R; 3] {
    [dot([a11, a12, a13], x), dot([a12, a22, a23], x), dot([a13, a23, a33], x)]
}

/// Column `j` of A.
#[inline(always)]
pub(crate) fn column<R: Real>(A: &Matrix3<R>, j: usize) -> [R; 3] {
    [A[0][j], A[1][j], A[2][j]]
}

/// The transpose Aᵀ.
#[inline(always)]
pub fn transpose<R: Real>(A: &Matrix3<R>) -> Matrix3<R> {
    [column(A, 0), column(A, 1), column(A, 2)]
}

/// The product A B.
#[inline(always)]
pub fn multiply<R: Real>(A: &Matrix3<R>, B: &Matrix3<R>) -> Matrix3<R> {
    let Bt = transpose(B);
    multiply_transposed(A, &Bt)
}

/// The product A Bᵀ.
#[inline(always)]
pub fn multiply_transposed<R: Real>(A: &Matrix3<R>, B: &Matrix3<R>) -> Matrix3<R> {
    three!(i => three!(j => dot(A[i], B[j])))
}

/// U A Vᵀ: from the principal frames to the world.
#[inline(always)]
pub fn to_world<R: Real>(U: &Matrix3<R>, A: &Matrix3<R>, V: &Matrix3<R>) -> Matrix3<R> {
    multiply_transposed(&multiply(U, A), V)
}

/// Uᵀ A V: from the world to the principal frames.
#[inline(always)]
pub(crate) fn to_principal<R: Real>(U: &Matrix3<R>, A: &Matrix3<R>, V: &Matrix3<R>) -> Matrix3<R> {
    multiply(&multiply(&transpose(U), A), V)
}

/// The matrix with these entries, row by row.
#[cfg(feature = "batch")]
#[inline(always)]
pub(crate) fn to_matrix<R: Copy>([a, b, c, d, e, f, g, h, i]: [R; 9]) -> Matrix3<R> {
    [[a, b, c], [d, e, f], [g, h, i]]
}

/// The entries of a matrix, row by row.
#[cfg(feature = "batch")]
#[inline(always)]
pub(crate) fn to_row_major<R: Copy>([[a, b, c], [d, e, f], [g, h, i]]: Matrix3<R>) -> [R; 9] {
    [a, b, c, d, e, f, g, h, i]
}
