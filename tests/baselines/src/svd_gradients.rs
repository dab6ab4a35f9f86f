//! dP/dF by differentiating U, λ and V \[SZLSB11\], one entry of F after the other.
//!
//! The equations are the paper's with its misprints mended (`point/tangent.rs` of the runtime names them),
//! otherwise literal: for each of the nine entries of F and each pair of stretches a 2×2 system gives the
//! derivatives of U and V,
//!
//! ```text
//! ⎡λl λk⎤ ⎡Ωkl⎤   ⎡ u_ik v_jl⎤
//! ⎣λk λl⎦ ⎣Θkl⎦ = ⎣−u_il v_jk⎦                                              (eq. 6)
//! ```
//!
//! with determinant λl² − λk². Where that is close to zero the paper regularises after Tikhonov: (AᵀA + εI) x
//! = Aᵀb. It sets the threshold to 10⁻⁶ and is silent about ε; here ε is the square of the threshold, about
//! the smallest that still does its work. The system is then solved for something else: at equal stretches
//! the part of A that vanishes takes the shear stiffness with it.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

#![expect(non_snake_case, reason = "U, V, P, dF as in the paper")]

use piola::Real;
use piola::material::{Blocks, PAIRS, Response};
use piola::point::Svd;

use crate::matrix::{dot, multiply, scale_columns, transpose};

/// Systems with |λl² − λk²| below it are regularised.
pub const THRESHOLD: f64 = 1e-6;

/// dP/dF, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F. Symmetric up to rounding.
/// `epsilon` is the ε of AᵀA + εI.
#[inline(always)]
#[must_use]
pub fn tangent<R: Real<Mask = bool>>(
    material: &(impl Response<R> + ?Sized),
    svd: &Svd<R>,
    epsilon: f64,
) -> [[R; 9]; 9] {
    let Svd { U, stretches, V } = svd;
    // The compiler drops the quotients of `blocks`, which nobody reads.
    let Blocks { gradient, hessian: [h11, h22, h33, h12, h13, h23], .. } = material.blocks(*stretches);
    let hessian = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]];
    let inverses = PAIRS.map(|(k, l)| Inverse::new(stretches[k], stretches[l], epsilon));
    let zero = R::splat(0.0);
    let mut dP_dF = [[zero; 9]; 9];
    for i in 0..3 {
        for j in 0..3 {
            // dF has a single 1 at (i, j).
            let dstretches: [R; 3] = std::array::from_fn(|k| U[i][k] * V[j][k]);
            let (mut omega, mut theta) = ([[zero; 3]; 3], [[zero; 3]; 3]);
            for (pair, (k, l)) in PAIRS.into_iter().enumerate() {
                let [u, v] = inverses[pair].solve([U[i][k] * V[j][l], -(U[i][l] * V[j][k])]);
                (omega[k][l], omega[l][k]) = (u, -u);
                (theta[k][l], theta[l][k]) = (v, -v);
            }
            let dU = multiply(U, &omega);
            let Vt = transpose(V);
            let dVt = multiply(&theta, &Vt);
            // dP = dU P̂ Vᵀ + U dP̂ Vᵀ + U P̂ dVᵀ (eq. 3), with dP̂k = Σe ψke dλe (eq. 5).
            let dprincipal = hessian.map(|row| dot(row, dstretches));
            let mut left = scale_columns(&dU, gradient);
            let turned = scale_columns(U, dprincipal);
            for a in 0..3 {
                for k in 0..3 {
                    left[a][k] = left[a][k] + turned[a][k];
                }
            }
            let (first, second) = (multiply(&left, &Vt), multiply(&scale_columns(U, gradient), &dVt));
            for a in 0..3 {
                for b in 0..3 {
                    dP_dF[3 * a + b][3 * i + j] = first[a][b] + second[a][b];
                }
            }
        }
    }
    dP_dF
}

/// The inverse of A = [[λl, λk], [λk, λl]], or (AᵀA + εI)⁻¹ Aᵀ: of the same form, as A is symmetric.
#[derive(Clone, Copy)]
struct Inverse<R> {
    diagonal: R,
    off_diagonal: R,
}

impl<R: Real<Mask = bool>> Inverse<R> {
    #[inline(always)]
    fn new(lk: R, ll: R, epsilon: f64) -> Self {
        let (difference, sum) = (ll - lk, ll + lk);
        let determinant = difference * sum;
        if !determinant.abs().less(R::splat(THRESHOLD)) {
            return Self { diagonal: ll / determinant, off_diagonal: -(lk / determinant) };
        }
        // AᵀA + εI has the eigenvalues (λl ∓ λk)² + ε.
        let epsilon = R::splat(epsilon);
        let regularized = (difference * difference + epsilon) * (sum * sum + epsilon);
        Self {
            diagonal: ll * (epsilon + determinant) / regularized,
            off_diagonal: lk * (epsilon - determinant) / regularized,
        }
    }

    #[inline(always)]
    fn solve(self, [b1, b2]: [R; 2]) -> [R; 2] {
        let Self { diagonal, off_diagonal } = self;
        [diagonal * b1 + off_diagonal * b2, off_diagonal * b1 + diagonal * b2]
    }
}
