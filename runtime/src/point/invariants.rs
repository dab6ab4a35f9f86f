//! Stress and tangent without a singular value decomposition, for energies W of the invariants I1 = |F|²,
//! I2 = |cof F|², J = det F.
//!
//! The cross product of two matrices \[BGO15\], (A × B)ij = εikm εjln Akl Bmn, is bilinear and symmetric,
//! with A : (B × X) = (A × B) : X. Since cof F = ½ F × F, it differentiates cofactors. With C = cof F and D
//! = C × F,
//!
//! ```text
//! dI1 = 2 F : dF,   dI2 = 2 C : (F × dF) = 2 D : dF,   dJ = C : dF
//! P   = 2 W1 F + 2 W2 D + WJ C,                                             W1 = ∂W/∂I1, …
//! ```
//!
//! D is F (I1 I − FᵀF), with sums of two squares on the diagonal of the bracket. Its error is a few u I1 |F|,
//! and ∂D/∂F has the entry λ1² + λ3² ≥ I1/3 in the principal frames.
//!
//! What floating point does here. I1 and I2 are sums of squares, and J is a sum of three entries times minors
//! that are within 2u of themselves, so that each is as good as F determines it: within a few u of its
//! sensitivity to relative changes of F by 1. So is P. A determinant in twice the working precision, from
//! which a decomposition takes the sign of a tiny λ3, is not needed where that sum keeps its first digits.
//! Entries of F that a plane of symmetry makes zero make the same entries of P exactly zero.
//!
//! \[BGO15\] Bonet, Gil, Ortigosa, *A computational framework for polyconvex large strain elasticity*, 2015.

#![expect(non_snake_case, reason = "F, C, D, P, I1, I2, J as in the text above")]

use super::Matrix3;
use super::matrix::{dot, three};
use crate::lanes::{Real, Truth, stage};
use crate::material::Curvature;

pub(crate) mod tangent;

/// Invariants that an energy's derivatives depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Needed {
    /// I1, of f(I1) + d I2: [`Curvature::First`].
    First,
    /// I1 and J.
    WithoutSecond,
    /// I1, I2 and J.
    All,
}

impl Needed {
    /// Invariants that ψ depends on.
    #[inline(always)]
    pub(crate) fn for_energy(has_second: bool) -> Self {
        if has_second { Self::All } else { Self::WithoutSecond }
    }

    /// Invariants that the derivatives of ψ depend on.
    #[inline(always)]
    pub(crate) fn for_derivatives(has_second: bool, curvature: Curvature) -> Self {
        if has_second && curvature == Curvature::First { Self::First } else { Self::for_energy(has_second) }
    }
}

/// Invariants I1, I2, J, with a mask of whether they and the results computed from them stay in range. Those
/// that are not needed are zero.
#[inline(always)]
pub(crate) fn invariants<R: Real>(F: &Matrix3<R>, needed: Needed) -> ([R; 3], R::Mask) {
    let F = *F;
    let name = match needed {
        Needed::First => "first_invariant",
        Needed::WithoutSecond => "invariants_without_I2",
        Needed::All => "invariants",
    };
    let (invariants, Truth(is_in_range)) = stage!(R, name, (F) => in_range(&F, needed));
    (invariants, is_in_range)
}

#[inline(always)]
fn in_range<R: Real>(F: &Matrix3<R>, needed: Needed) -> ([R; 3], Truth<R::Mask>) {
    // The eighth root of the range of entries: I2 and N below are of degree 4 and 6.
    let (low, high) = (R::splat(R::min_positive().powf(0.25)), R::splat(R::min_positive().powf(-0.25)));
    let (zero, I1) = (R::splat(0.0), square(F));
    let room = (I1 - low).min(high - I1);
    if needed == Needed::First {
        return ([I1, zero, zero], Truth(zero.less(room)));
    }
    let normal = exact_minors(F);
    let terms = three!(j => F[0][j] * normal[j]);
    let J = F[0][0].mul_add(normal[0], F[0][1].mul_add(normal[1], terms[2]));
    let I2 = if needed == Needed::All {
        let [_, second, third] = cofactor(F);
        dot(normal, normal) + dot(second, second) + dot(third, third)
    } else {
        zero
    };

    // Nearer to zero, products of entries underflow, here or relative to the largest one, or J is less than
    // 2¹⁰ times what rounding does to its terms, so that neither its digits nor its sign are sure. There a
    // point is decomposed, and it is the decomposition that refuses.
    let threshold = R::splat(R::min_positive() / R::unit_roundoff());
    let size = terms[0].abs() + terms[1].abs() + terms[2].abs();
    let smallest = R::splat(1024.0 * R::unit_roundoff()).mul_add(size, threshold.mul_add(I1 * I1, threshold));
    ([I1, I2, J], Truth(zero.less(room.min(J.abs() - smallest))))
}

/// Minors of the first row of F, each within 2u of itself if no product underflows.
#[inline(always)]
fn exact_minors<R: Real>(F: &Matrix3<R>) -> [R; 3] {
    three!(j => {
        let (k, l) = ((j + 1) % 3, (j + 2) % 3);
        let ((left, left_error), (right, right_error)) =
            (F[1][k].two_product(F[2][l]), F[1][l].two_product(F[2][k]));
        (left - right) + (left_error - right_error)
    })
}

/// Squared Frobenius norm |A|².
#[inline(always)]
fn square<R: Real>(A: &Matrix3<R>) -> R {
    dot(A[0], A[0]) + dot(A[1], A[1]) + dot(A[2], A[2])
}

/// P = 2 W1 F + 2 W2 D + WJ C, Pa; without `HAS_SECOND` W2 counts as zero.
#[inline(always)]
pub(crate) fn stress_by_invariants<R: Real, const HAS_SECOND: bool, const HAS_VOLUME: bool>(
    F: &Matrix3<R>,
    W: [R; 3],
) -> Matrix3<R> {
    let F = *F;
    let name = match (HAS_SECOND, HAS_VOLUME) {
        (true, true) => "stress_by_invariants",
        (false, _) => "stress_by_invariants_without_I2",
        (true, false) => "stress_by_invariants_without_J",
    };
    stage!(R, name, (F, W) => {
        let C = if HAS_VOLUME { cofactor(&F) } else { F };
        let D = if HAS_SECOND { half_derivative_of_I2(&F) } else { C };
        let [W1, W2, WJ] = W;
        stress_of_terms::<R, HAS_SECOND, HAS_VOLUME>([&F, &D, &C], [W1 + W1, W2 + W2, WJ])
    })
}

/// True if P by these derivatives is finite whenever the invariants are in range: entries of F, C and D are
/// then below the powers 1/8, 2/8 and 3/8 of the largest finite number, except for small factors, and the
/// derivatives below its root.
#[inline(always)]
pub(crate) fn gradient_is_in_range<R: Real>([W1, W2, WJ]: [R; 3]) -> R::Mask {
    (W1.abs() + W2.abs() + WJ.abs()).less(R::splat(R::min_positive().powf(-0.5)))
}

/// The sum of F, D and C times a factor each.
#[inline(always)]
fn stress_of_terms<R: Real, const HAS_SECOND: bool, const HAS_VOLUME: bool>(
    [F, D, C]: [&Matrix3<R>; 3],
    [along_F, along_D, along_C]: [R; 3],
) -> Matrix3<R> {
    three!(i => three!(j => match (HAS_SECOND, HAS_VOLUME) {
        (true, true) => along_D.mul_add(D[i][j], along_F.mul_add(F[i][j], along_C * C[i][j])),
        (true, false) => along_D.mul_add(D[i][j], along_F * F[i][j]),
        (false, _) => along_F.mul_add(F[i][j], along_C * C[i][j]),
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

/// D = F (I1 I − FᵀF), half of dI2/dF.
#[inline(always)]
fn half_derivative_of_I2<R: Real>(F: &Matrix3<R>) -> Matrix3<R> {
    let metric = |x: usize, y: usize| dot([F[0][x], F[1][x], F[2][x]], [F[0][y], F[1][y], F[2][y]]);
    let squares = three!(x => metric(x, x));
    let mixed = three!(x => metric((x + 1) % 3, (x + 2) % 3));
    three!(i => three!(x => {
        let (y, z) = ((x + 1) % 3, (x + 2) % 3);
        // Not fused, so that axes with equal entries have equal ones in it.
        F[i][x] * (squares[y] + squares[z]) - (F[i][y] * mixed[z] + F[i][z] * mixed[y])
    }))
}
