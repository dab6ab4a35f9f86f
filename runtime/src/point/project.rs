//! Filters that make a tangent positive semidefinite, exactly and eigenvalue by eigenvalue.
//!
//! In the basis of the diagonal entries and (ij ± ji)/√2 the tangent is diagonal but for one 3×3 block (see
//! [`tangent`](super::tangent)): its nine eigenvalues are the flips, the twists and those of the Hessian ψij.
//! Filtering them is filtering dP/dF, because the frames are orthogonal. Applied to an element, the filtered dP/dF
//! is pulled back: that is not the same as filtering the 12×12 stiffness, which some codes do, unless the element
//! is regular.
//!
//! What floating point does here. A filtered eigenvalue is zero up to u ‖dP/dF‖ of either sign; where nothing is
//! negative beyond doubt, the block comes back bit for bit.
//!
//! \[CLLZJ24\] Chen, Liu, Levin, Zheng, Jacobson, *Stabler Neo-Hookean Simulation: Absolute Eigenvalue Filtering for
//! Projected Newton*, 2024.

#![expect(non_snake_case, reason = "A, L, Q as in linear algebra")]

use super::svd::sweeps;
use crate::lanes::{Mask, Real};
use crate::material::{Blocks, PAIRS};

/// What becomes of the negative eigenvalues of dP/dF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// They stay: the exact derivative of the stress.
    #[default]
    None,
    /// They become zero: the semidefinite matrix nearest in the Frobenius norm.
    Clamp,
    /// They change sign \[CLLZJ24\]: directions of negative curvature are stiff instead of free.
    Absolute,
}

impl Filter {
    /// `self` of an eigenvalue, less the eigenvalue.
    #[inline(always)]
    fn correction<R: Real>(self, eigenvalue: R) -> R {
        let below = R::splat(0.0).max(-eigenvalue);
        match self {
            Self::None => R::splat(0.0),
            Self::Clamp => below,
            Self::Absolute => below + below,
        }
    }

    #[inline(always)]
    fn of<R: Real>(self, eigenvalue: R) -> R {
        match self {
            Self::None => eigenvalue,
            // Not `max`, which would turn NaN into a plausible zero.
            Self::Clamp => {
                let zero = R::splat(0.0);
                R::select(eigenvalue.less(zero), zero, eigenvalue)
            }
            Self::Absolute => eigenvalue.abs(),
        }
    }
}

/// The filtered map, and whether an eigenvalue was negative by more than the rounding of the largest one.
#[inline(always)]
#[must_use]
pub fn project<R: Real>(blocks: &Blocks<R>, filter: Filter) -> (Blocks<R>, R::Mask) {
    if filter == Filter::None {
        return (*blocks, R::Mask::splat(false));
    }
    let (hessian, smallest) = project_symmetric(blocks.hessian, filter);
    let quotients = || blocks.flip.into_iter().chain(blocks.twist);
    let smallest = quotients().fold(smallest, |smallest, x| x.min(smallest));
    let largest = blocks.hessian.into_iter().chain(quotients()).fold(R::splat(0.0), |m, x| x.abs().max(m));
    let filtered = smallest.less(R::splat(-16.0 * R::UNIT_ROUNDOFF) * largest);
    let projected = Blocks {
        gradient: blocks.gradient,
        hessian,
        flip: blocks.flip.map(|flip| filter.of(flip)),
        twist: blocks.twist.map(|twist| filter.of(twist)),
    };
    (projected, filtered)
}

/// The filtered symmetric matrix, stored as 11, 22, 33, 12, 13, 23, and its smallest eigenvalue or, where it is
/// positive beyond doubt, zero.
#[inline(always)]
fn project_symmetric<R: Real>(A: [R; 6], filter: Filter) -> ([R; 6], R) {
    let largest = A.into_iter().fold(R::splat(0.0), |m, x| x.abs().max(m));
    let (scale, back) = largest.power_of_two_scale();
    let scaled = A.map(|x| x * scale);

    // Both answers are defined for each number of a batch by itself; only the work for the second one is skipped,
    // and only if none needs it. So a number's result never depends on its neighbours.
    let definite = surely_definite(scaled);
    if !(!definite).any() {
        return (A, R::splat(0.0));
    }
    let (eigenvalues, Q) = eigen(scaled);
    let zero = R::splat(0.0);
    let smallest = eigenvalues.into_iter().fold(zero, |smallest, x| x.min(smallest));
    let indefinite = !definite & smallest.less(zero);

    // Σ f(e) q qᵀ and A + Σ (f(e) − e) q qᵀ are the same; the one with the smaller sum rounds less.
    let below = eigenvalues.map(|e| filter.correction(e));
    let kept = eigenvalues.map(|e| filter.of(e));
    let sum = |x: [R; 3]| x[0] + x[1] + x[2];
    let from_nothing = sum(kept).less(sum(below));
    let weights: [R; 3] = std::array::from_fn(|k| R::select(from_nothing, kept[k], below[k]));
    let entries = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
    let projected = std::array::from_fn(|entry| {
        let (i, j) = entries[entry];
        let start = R::select(from_nothing, zero, scaled[entry]);
        let value = (0..3).fold(start, |sum, k| (weights[k] * Q[i][k]).mul_add(Q[j][k], sum));
        R::select(indefinite, value * back, A[entry])
    });
    (projected, R::select(indefinite, smallest * back, zero))
}

/// Whether every eigenvalue is positive whatever rounding did: LDLᵀ of A − 64 u I has positive pivots.
///
/// The computed factors of that matrix are exact for one that differs by a few u times its entries, which are below
/// 4 here; the shift outweighs it [Rump 2006, *Verification of positive definiteness*].
#[inline(always)]
fn surely_definite<R: Real>(A: [R; 6]) -> R::Mask {
    let zero = R::splat(0.0);
    let shift = R::splat(64.0 * R::UNIT_ROUNDOFF);
    let [a11, a22, a33, a12, a13, a23] = A;
    let d1 = a11 - shift;
    let (l21, l31) = (a12 / d1, a13 / d1);
    let d2 = (a22 - shift) - l21 * a12;
    let c32 = a23 - l31 * a12;
    let d3 = ((a33 - shift) - l31 * a13) - c32 / d2 * c32;
    zero.less(d1) & zero.less(d2) & zero.less(d3)
}

/// Eigenvalues, and eigenvectors as the columns of Q, of a symmetric matrix of magnitude 1 to 2, by cyclic Jacobi
/// rotations.
#[inline(always)]
pub(super) fn eigen<R: Real>(A: [R; 6]) -> ([R; 3], [[R; 3]; 3]) {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let [a11, a22, a33, a12, a13, a23] = A;
    let mut A = [[a11, a12, a13], [a12, a22, a23], [a13, a23, a33]];
    let mut Q = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
    // Keeps the quotient finite for a diagonal matrix with equal entries, where any angle is right; too small to
    // matter elsewhere.
    let floor = R::splat(R::MIN_POSITIVE.sqrt());
    for _ in 0..sweeps(R::UNIT_ROUNDOFF) {
        for (p, q) in PAIRS {
            let r = 3 - p - q;
            // The smaller root t = tan θ of t² + 2 t (aqq − app)/(2 apq) − 1 = 0, without cancellation [Golub, Van
            // Loan, 8.5].
            let d = A[q][q] - A[p][p];
            let g = A[p][q] + A[p][q];
            let magnitude = g / (d.abs() + d.mul_add(d, g * g).sqrt() + floor);
            let t = R::select(d.less(zero), -magnitude, magnitude);
            let c = one / t.mul_add(t, one).sqrt();
            let s = t * c;
            let apq = A[p][q];
            A[p][p] = A[p][p] - t * apq;
            A[q][q] = t.mul_add(apq, A[q][q]);
            A[p][q] = zero;
            let (arp, arq) = (A[r.min(p)][r.max(p)], A[r.min(q)][r.max(q)]);
            A[r.min(p)][r.max(p)] = c.mul_add(arp, -(s * arq));
            A[r.min(q)][r.max(q)] = s.mul_add(arp, c * arq);
            for row in &mut Q {
                let (vp, vq) = (row[p], row[q]);
                row[p] = c.mul_add(vp, -(s * vq));
                row[q] = s.mul_add(vp, c * vq);
            }
        }
    }
    ([A[0][0], A[1][1], A[2][2]], Q)
}
