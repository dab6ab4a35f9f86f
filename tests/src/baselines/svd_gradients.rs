//! dP/dF by differentiating U, λ and V \[SZLSB11\], one entry of F after the other.
//!
//! The equations are the paper's with its misprints mended (they are named in [`piola::point::tangent`]), otherwise
//! literal: for each of the nine entries of F and each pair of stretches a 2×2 system gives the derivatives of U and V,
//!
//! ```text
//! ⎡λl λk⎤ ⎡Ωkl⎤   ⎡ u_ik v_jl⎤
//! ⎣λk λl⎦ ⎣Θkl⎦ = ⎣−u_il v_jk⎦                                              (eq. 6)
//! ```
//!
//! with determinant λl² − λk². Where that is close to zero the paper regularises after Tikhonov: (AᵀA + εI) x = Aᵀb. It
//! sets the threshold to 10⁻⁶ and is silent about ε; here ε is the square of the threshold, about the smallest that
//! still does its work. The system is then solved for something else: at equal stretches the part of A that vanishes
//! takes the shear stiffness with it.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*, 2011.

#![expect(non_snake_case, reason = "U, V, P, dF as in the paper")]

use piola::material::{Blocks, PAIRS};
use piola::point::{Matrix3, Svd};
use piola::{Material, Real};

/// Of |λl² − λk²|.
const THRESHOLD: f64 = 1e-6;

/// The ε of AᵀA + εI.
const REGULARIZATION: f64 = THRESHOLD * THRESHOLD;

/// dP/dF, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F. Symmetric up to rounding.
#[inline(always)]
#[must_use]
pub fn tangent<R: Real<Mask = bool>>(material: &impl Material, svd: &Svd<R>) -> [[R; 9]; 9] {
    let Svd { U, stretches, V } = svd;
    // The compiler drops the quotients of `blocks`, which nobody reads.
    let Blocks { gradient, hessian: [h11, h22, h33, h12, h13, h23], .. } = material.blocks(*stretches);
    let hessian = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]];
    let inverses = PAIRS.map(|(k, l)| Inverse::new(stretches[k], stretches[l]));
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
    fn new(lk: R, ll: R) -> Self {
        let (difference, sum) = (ll - lk, ll + lk);
        let determinant = difference * sum;
        if !determinant.abs().less(R::splat(THRESHOLD)) {
            return Self { diagonal: ll / determinant, off_diagonal: -(lk / determinant) };
        }
        // AᵀA + εI has the eigenvalues (λl ∓ λk)² + ε.
        let epsilon = R::splat(REGULARIZATION);
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

#[inline(always)]
fn dot<R: Real>(x: [R; 3], y: [R; 3]) -> R {
    x[0].mul_add(y[0], x[1].mul_add(y[1], x[2] * y[2]))
}

#[inline(always)]
fn transpose<R: Real>(A: &Matrix3<R>) -> Matrix3<R> {
    std::array::from_fn(|i| std::array::from_fn(|j| A[j][i]))
}

#[inline(always)]
fn multiply<R: Real>(A: &Matrix3<R>, B: &Matrix3<R>) -> Matrix3<R> {
    let Bt = transpose(B);
    A.map(|row| Bt.map(|column| dot(row, column)))
}

/// A diag(d).
#[inline(always)]
fn scale_columns<R: Real>(A: &Matrix3<R>, d: [R; 3]) -> Matrix3<R> {
    A.map(|row| std::array::from_fn(|k| row[k] * d[k]))
}

#[cfg(test)]
mod tests {
    use piola::point::{Filter, evaluate, svd};
    use piola_materials::Ogden;

    use super::*;

    const SHEARED: Matrix3<f64> = [[1.3, 0.2, -0.1], [0.0, 0.8, 0.3], [0.4, -0.2, 1.1]];

    fn rubber() -> Ogden<2> {
        Ogden::new([2.0, 1.0], [1.5, 4.0], 3.0).expect("admissible parameters")
    }

    #[track_caller]
    fn compare(F: &Matrix3<f64>) -> f64 {
        let exact = evaluate(&rubber(), F, Filter::None).tangent.to_matrix();
        let found = tangent(&rubber(), &svd(F));
        let pairs = || exact.iter().flatten().zip(found.iter().flatten());
        let norm = pairs().map(|(x, _)| x * x).sum::<f64>().sqrt();
        pairs().map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt() / norm
    }

    /// The equations are those of the paper: where nothing is regularised, they give dP/dF.
    #[test]
    fn distant_stretches_give_the_exact_tangent() {
        let error = compare(&SHEARED);
        // The smallest determinant is about a tenth of λ1²; a hundred operations.
        assert!(error <= 1000.0 * f64::UNIT_ROUNDOFF, "{error:e}");
    }

    /// At rest the regularised systems lose the shear stiffness: three eigenvalues 2μ of nine.
    #[test]
    fn equal_stretches_lose_the_shear_stiffness() {
        let error = compare(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert!((0.1..1.0).contains(&error), "{error:e}");
    }
}
