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
//! and ∂D/∂F has the entry λ1² + λ3² ≥ I1/3 in the principal frames. P takes both its first terms at once, as
//! F (2 W1 I + 2 W2 (I1 I − FᵀF)).
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
use crate::material::{Curvature, Response, ResponseKind};

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
    /// Invariants that a response by invariants depends on.
    #[inline(always)]
    pub(crate) fn of(response: ResponseKind, has_second: bool, curvature: Curvature) -> Self {
        match (has_second, curvature) {
            (false, _) => Self::WithoutSecond,
            (true, Curvature::First) if response != ResponseKind::EnergyByInvariants => Self::First,
            (true, _) => Self::All,
        }
    }
}

/// Evaluates an expression with `$name` as a constant: with a variable, loops of two kernels take 12 % more
/// instructions.
#[cfg(feature = "batch")]
macro_rules! with_needed {
    ($needed:expr, $name:ident => $value:expr) => {{
        macro_rules! value {
            ($constant:ident) => {{
                let $name = Needed::$constant;
                $value
            }};
        }
        match $needed {
            Needed::First => value!(First),
            Needed::WithoutSecond => value!(WithoutSecond),
            Needed::All => value!(All),
        }
    }};
}
#[cfg(feature = "batch")]
pub(crate) use with_needed;

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

/// The invariants that a response of a material depends on, as [`invariants`] returns them.
#[inline(always)]
pub(crate) fn invariants_for<R: Real>(
    response: ResponseKind,
    material: &(impl Response<R> + ?Sized),
    F: &Matrix3<R>,
) -> ([R; 3], R::Mask) {
    let (has_second, curvature) = (material.has_second_invariant(), material.curvature_by_invariants());
    invariants(F, Needed::of(response, has_second, curvature))
}

/// P, Pa, of an energy of the invariants, with a mask of the lanes for which it is valid.
#[inline(always)]
pub(crate) fn stress_by_invariants<R: Real>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix3<R>,
) -> (R::Mask, Matrix3<R>) {
    let (has_second, curvature) = (material.has_second_invariant(), material.curvature_by_invariants());
    let needed = Needed::of(ResponseKind::GradientByInvariants, has_second, curvature);
    let (invariants, is_in_range) = invariants(F, needed);
    let gradient = material.gradient_by_invariants(invariants);
    let is_valid = is_in_range & material.admits_invariants(invariants) & gradient_is_in_range(gradient);
    (is_valid, stress_of_gradient(F, gradient, needed))
}

/// P = 2 W1 F + 2 W2 D + WJ C, Pa; without derivatives that are not needed.
#[inline(always)]
pub(crate) fn stress_of_gradient<R: Real>(F: &Matrix3<R>, W: [R; 3], needed: Needed) -> Matrix3<R> {
    let F = *F;
    let (name, has_second, has_volume) = match needed {
        Needed::First => ("stress_by_invariants_without_J", true, false),
        Needed::WithoutSecond => ("stress_by_invariants_without_I2", false, true),
        Needed::All => ("stress_by_invariants", true, true),
    };
    stage!(R, name, (F, W) => {
        let [W1, W2, WJ] = W;
        stress_of_terms(&F, [W1 + W1, W2 + W2, WJ], has_second, has_volume)
    })
}

/// True if P by these derivatives is finite whenever the invariants are in range: entries of F, C and D are
/// then below the powers 1/8, 2/8 and 3/8 of the largest finite number, except for small factors, and the
/// derivatives below its root.
#[inline(always)]
pub(crate) fn gradient_is_in_range<R: Real>([W1, W2, WJ]: [R; 3]) -> R::Mask {
    (W1.abs() + W2.abs() + WJ.abs()).less(R::splat(R::min_positive().powf(-0.5)))
}

/// F (p1 I + p2 (I1 I − FᵀF)) + `along_C` C, without the terms with p2 or C as said.
#[inline(always)]
fn stress_of_terms<R: Real>(
    F: &Matrix3<R>,
    [p1, p2, along_C]: [R; 3],
    has_second: bool,
    has_volume: bool,
) -> Matrix3<R> {
    let C = if has_volume { cofactor(F) } else { *F };
    if !has_second {
        return three!(i => three!(j => p1.mul_add(F[i][j], along_C * C[i][j])));
    }
    let (squares, mixed) = metric(F);
    let on_diagonal = three!(x => p2.mul_add(squares[(x + 1) % 3] + squares[(x + 2) % 3], p1));
    let mixed = three!(x => p2 * mixed[x]);
    three!(i => three!(x => {
        let P = along_axis(&F[i], x, on_diagonal[x], mixed);
        if has_volume { along_C.mul_add(C[i][x], P) } else { P }
    }))
}

/// Cofactors of F: the matrix of signed minors, J F⁻ᵀ where that exists.
#[inline(always)]
fn cofactor<R: Real>(F: &Matrix3<R>) -> Matrix3<R> {
    three!(i => cofactor_row(F, i))
}

/// Row i of the cofactors of F.
#[inline(always)]
fn cofactor_row<R: Real>(F: &Matrix3<R>, i: usize) -> [R; 3] {
    three!(j => {
        let (k, l, m, n) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        F[k][m].mul_add(F[l][n], -(F[k][n] * F[l][m]))
    })
}

/// D = F (I1 I − FᵀF), half of dI2/dF.
#[inline(always)]
fn half_derivative_of_I2<R: Real>(F: &Matrix3<R>) -> Matrix3<R> {
    let (squares, mixed) = metric(F);
    three!(i => three!(x => along_axis(&F[i], x, squares[(x + 1) % 3] + squares[(x + 2) % 3], mixed)))
}

/// Entries of FᵀF: those on the diagonal, and the others, each at the axis that it does not belong to.
#[inline(always)]
fn metric<R: Real>(F: &Matrix3<R>) -> ([R; 3], [R; 3]) {
    let metric = |x: usize, y: usize| dot([F[0][x], F[1][x], F[2][x]], [F[0][y], F[1][y], F[2][y]]);
    (three!(x => metric(x, x)), three!(x => metric((x + 1) % 3, (x + 2) % 3)))
}

/// Entry x of a row times the matrix with an entry on its diagonal, and minus `mixed` beside it.
#[inline(always)]
fn along_axis<R: Real>(row: &[R; 3], x: usize, on_diagonal: R, mixed: [R; 3]) -> R {
    let (y, z) = ((x + 1) % 3, (x + 2) % 3);
    // Not fused with each other, so that axes with equal entries have equal ones in the product.
    row[x].mul_add(on_diagonal, -(row[y] * mixed[z] + row[z] * mixed[y]))
}
