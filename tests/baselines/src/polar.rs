//! P and dP/dF of the rotated linear energy by the polar decomposition F = R S, without singular values.
//!
//! With Ω = Rᵀ dR, which is antisymmetric, differentiation of F = R S and of S = Sᵀ gives
//!
//! ```text
//! Ω S + S Ω = Rᵀ dF − dFᵀ R        or, for the axial vectors ω and w,        (tr S 1 − S) ω = w
//! ```
//!
//! For dF = ek ⊗ el the axial vector is wkl = el × rk, where rk is row k of R, so that
//!
//! ```text
//! ∂Rij/∂Fkl = wij · (tr S 1 − S)⁻¹ wkl
//! P         = 2 μ (F − R) + λ (tr S − 3) R
//! ∂Pij/∂Fkl = 2 μ δik δjl + λ Rij Rkl + (λ (tr S − 3) − 2 μ) ∂Rij/∂Fkl
//! ```
//!
//! R comes from Newton's iteration X ← ½ (γ X + X⁻ᵀ/γ), scaled by γ² = |X⁻¹|/|X| \[Higham86\]. It has the
//! sign of det F, so that points turned inside out get another R than a rotation, and singular F get none.
//!
//! \[Higham86\] Higham, *Computing the polar decomposition, with applications*, 1986.

#![expect(non_snake_case, reason = "F, P, R, S, M, w as above")]

use piola::Real;
use piola::lanes::Mask;
use piola::point::Matrix3;
use piola_materials::RotatedLinear;

use crate::matrix::{cofactor, cross, dot, multiply, transpose};

/// P and dP/dF, Pa, of μ |S − 1|² + λ/2 (tr S − 3)²; row 3i+j for entry (i, j) of P, column 3k+l for entry
/// (k, l) of F, exactly symmetric.
#[inline(always)]
#[must_use]
pub fn evaluate<R: Real>(material: &RotatedLinear, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
    let rotation = rotation(F);
    let S = multiply(&transpose(&rotation), F);
    let trace = S[0][0] + S[1][1] + S[2][2];
    let (twice_mu, lambda) = (R::splat(2.0 * material.mu()), R::splat(material.lambda()));
    let pressure = lambda * (trace - R::splat(3.0));

    let mut M = S;
    for i in 0..3 {
        for j in 0..3 {
            let symmetric = R::splat(0.5) * (S[i][j] + S[j][i]);
            M[i][j] = if i == j { trace - symmetric } else { -symmetric };
        }
    }
    let mut inverse = cofactor(&M);
    let factor = (pressure - twice_mu) / dot(M[0], inverse[0]);
    for row in &mut inverse {
        for entry in row {
            *entry = *entry * factor;
        }
    }

    let mut P = *F;
    let mut axes = [[R::splat(0.0); 3]; 9];
    let mut turned = axes;
    for i in 0..3 {
        for j in 0..3 {
            P[i][j] = twice_mu.mul_add(F[i][j] - rotation[i][j], pressure * rotation[i][j]);
            let mut axis = [R::splat(0.0); 3];
            axis[j] = R::splat(1.0);
            axes[3 * i + j] = cross(axis, rotation[i]);
            let w = axes[3 * i + j];
            turned[3 * i + j] = [dot(inverse[0], w), dot(inverse[1], w), dot(inverse[2], w)];
        }
    }
    let mut dP_dF = [[R::splat(0.0); 9]; 9];
    for row in 0..9 {
        for column in row..9 {
            let stretched = lambda * rotation[row / 3][row % 3];
            let mut entry =
                stretched.mul_add(rotation[column / 3][column % 3], dot(axes[row], turned[column]));
            if row == column {
                entry = entry + twice_mu;
            }
            dP_dF[row][column] = entry;
            dP_dF[column][row] = entry;
        }
    }
    (P, dP_dF)
}

/// R of F = R S; NaN where F is singular.
#[inline(always)]
fn rotation<R: Real>(F: &Matrix3<R>) -> Matrix3<R> {
    const MOST: usize = 20;
    let mut X = *F;
    for _ in 0..MOST {
        let cof = cofactor(&X);
        let det = dot(X[0], cof[0]);
        // |X⁻¹|/|X| = |cof X|/(|det X| |X|).
        let scale = (square(&cof) / (det * det * square(&X))).sqrt().sqrt();
        let (of_X, of_inverse) = (R::splat(0.5) * scale, R::splat(0.5) / (scale * det));
        let before = X;
        let mut change = R::splat(0.0);
        for i in 0..3 {
            for j in 0..3 {
                X[i][j] = of_X.mul_add(X[i][j], of_inverse * cof[i][j]);
                change = change.max((X[i][j] - before[i][j]).abs());
            }
        }
        // It converges quadratically: the next one would be below rounding.
        if !(!change.less(R::splat((R::UNIT_ROUNDOFF).sqrt()))).any() {
            break;
        }
    }
    X
}

/// |A|².
#[inline(always)]
fn square<R: Real>(A: &Matrix3<R>) -> R {
    dot(A[0], A[0]) + dot(A[1], A[1]) + dot(A[2], A[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{SHEARED, error, exact};

    /// Inside out, the orthogonal factor is not a rotation.
    #[test]
    fn points_inside_out_have_another_factor() {
        let material = RotatedLinear::new(1.0, 1.5).expect("admissible parameters");
        let inverted = SHEARED.map(|[x, y, z]| [x, y, -z]);
        let (_, exact_K) = exact(&material, &inverted);
        assert!(error(&evaluate(&material, &inverted).1, &exact_K) > 0.01);
    }
}
