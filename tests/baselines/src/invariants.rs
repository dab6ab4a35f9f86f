//! P and dP/dF through the invariants I = tr C, II = C:C, III = det C of C = FᵀF, in the frame where F is
//! diagonal \[TSIF05\].
//!
//! With F = U Σ Vᵀ and the derivatives of ψ(I, II, III) the stress there is
//!
//! ```text
//! P̂ = 2 ψ_I Σ + 4 ψ_II Σ³ + 2 ψ_III III Σ⁻¹
//! ```
//!
//! and ∂P̂/∂F̂ falls into a 3×3 block A of the diagonal entries and 2×2 blocks B of the pairs (ij, ji):
//!
//! ```text
//! αij = 2 ψ_I + 4 (σi² + σj²) ψ_II
//! βij = 4 σiσj ψ_II − 2 III ψ_III / (σiσj)
//! γij = gᵢᵀ H gⱼ + 4 III ψ_III / (σiσj),   gᵢ = (2σi, 4σi³, 2 III/σi),   H = ∂²ψ/∂(I, II, III)²
//!
//! Aij = γij + δij (αii + βii)        Bij = ⎡α β⎤
//!                                          ⎣β α⎦ij
//! ```
//!
//! For each of the nine dF, δP = U (∂P̂/∂F̂ : Uᵀ δF V) Vᵀ. III/σi and III/(σiσj) are products of the
//! stretches, and nothing divides by one.
//!
//! There is no quotient in it, so no gap is special, and derivatives are by hand for every energy; those that
//! are not functions of the invariants, Ogden's and all with the stretches themselves, are out. III is of
//! degree six in the stretches: its square, which the logarithm's second derivative divides by, is the first
//! number to leave the range of a format. And it has forgotten the sign of det F.
//!
//! \[TSIF05\] Teran, Sifakis, Irving, Fedkiw, *Robust quasistatic finite elements and flesh simulation*,
//! 2005.

#![expect(non_snake_case, reason = "U, V, P, dF, A, α, β, γ, I, II, III as in the paper")]

use piola::Real;
use piola::material::PAIRS;
use piola::point::{Matrix3, Svd, stress};
use piola_materials::{NeoHookean, StVenantKirchhoff};

use crate::matrix::{dot, to_world};

/// An energy by the derivatives of ψ(I, II, III).
pub trait InvariantEnergy {
    /// First and second derivatives at \[I, II, III\].
    fn derivatives<R: Real>(&self, invariants: [R; 3]) -> Derivatives<R>;
}

/// Derivatives of ψ(I, II, III), Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives<R> {
    /// ψ_I, ψ_II, ψ_III.
    pub gradient: [R; 3],
    /// Second derivatives, symmetric.
    pub hessian: Matrix3<R>,
}

/// ψ = μ/4 (II − 2 I + 3) + λ/8 (I − 3)².
impl InvariantEnergy for StVenantKirchhoff {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [I, _, _]: [R; 3]) -> Derivatives<R> {
        let zero = R::splat(0.0);
        let psi_I = (I - R::splat(3.0)).mul_add(R::splat(self.lambda() / 4.0), R::splat(-self.mu() / 2.0));
        Derivatives {
            gradient: [psi_I, R::splat(self.mu() / 4.0), zero],
            hessian: [[R::splat(self.lambda() / 4.0), zero, zero], [zero; 3], [zero; 3]],
        }
    }
}

/// ψ = μ/2 (I − 3) − μ/2 ln III + λ/8 (ln III)².
impl InvariantEnergy for NeoHookean {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [_, _, III]: [R; 3]) -> Derivatives<R> {
        let zero = R::splat(0.0);
        let quarter = R::splat(self.lambda() / 4.0);
        let inverse = R::splat(1.0) / III;
        // III ψ_III.
        let slope = III.ln().mul_add(quarter, R::splat(-self.mu() / 2.0));
        let psi_III_III = (quarter - slope) * (inverse * inverse);
        Derivatives {
            gradient: [R::splat(self.mu() / 2.0), zero, slope * inverse],
            hessian: [[zero; 3], [zero; 3], [zero, zero, psi_III_III]],
        }
    }
}

/// P and dP/dF, Pa; row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F, symmetric up to
/// rounding.
#[inline(always)]
#[must_use]
pub fn evaluate<R: Real>(energy: &impl InvariantEnergy, svd: &Svd<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
    let Svd { U, V, .. } = svd;
    let principal = Principal::new(energy, svd.stretches);
    let mut dP_dF = [[R::splat(0.0); 9]; 9];
    for k in 0..3 {
        for l in 0..3 {
            // dF has a single 1 at (k, l).
            let mut dF = *U;
            for a in 0..3 {
                for b in 0..3 {
                    dF[a][b] = U[k][a] * V[l][b];
                }
            }
            let dP = to_world(U, &principal.apply(&dF), V);
            for i in 0..3 {
                for j in 0..3 {
                    dP_dF[3 * i + j][3 * k + l] = dP[i][j];
                }
            }
        }
    }
    (stress(svd, principal.stress), dP_dF)
}

/// P̂ and ∂P̂/∂F̂.
struct Principal<R> {
    stress: [R; 3],
    A: Matrix3<R>,
    alpha: [R; 3],
    beta: [R; 3],
}

impl<R: Real> Principal<R> {
    #[inline(always)]
    fn new(energy: &impl InvariantEnergy, stretches: [R; 3]) -> Self {
        let [s1, s2, s3] = stretches;
        let squares = [s1 * s1, s2 * s2, s3 * s3];
        let J = s1 * s2 * s3;
        let III = J * J;
        // III/σi = J σj σk.
        let without = [J * (s2 * s3), J * (s1 * s3), J * (s1 * s2)];
        let invariants = [squares[0] + squares[1] + squares[2], dot(squares, squares), III];
        let Derivatives { gradient: [psi_I, psi_II, psi_III], hessian: H } = energy.derivatives(invariants);
        let (two, four) = (R::splat(2.0), R::splat(4.0));
        let (twice_I, four_II, twice_III) = (two * psi_I, four * psi_II, two * psi_III);

        let mut g = [stretches; 3];
        let mut stress = stretches;
        for i in 0..3 {
            g[i] = [two * stretches[i], four * (squares[i] * stretches[i]), two * without[i]];
            stress[i] = dot([psi_I, psi_II, psi_III], g[i]);
        }
        let mut A = H;
        for i in 0..3 {
            let Hg = [dot(H[0], g[i]), dot(H[1], g[i]), dot(H[2], g[i])];
            for j in 0..3 {
                A[i][j] = dot(g[j], Hg);
            }
            // αii + βii + 4 III ψ_III/σi², where III/σi² is the square of the two other stretches' product.
            let others = stretches[(i + 1) % 3] * stretches[(i + 2) % 3];
            let curvature = twice_III.mul_add(others * others, twice_I);
            A[i][i] = A[i][i] + (R::splat(3.0) * four_II).mul_add(squares[i], curvature);
        }
        let (mut alpha, mut beta) = (stretches, stretches);
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            // III/(σiσj) = σiσjσk².
            let product = stretches[i] * stretches[j];
            let shared = twice_III * (product * squares[3 - i - j]);
            A[i][j] = A[i][j] + (shared + shared);
            A[j][i] = A[i][j];
            alpha[pair] = four_II.mul_add(squares[i] + squares[j], twice_I);
            beta[pair] = four_II.mul_add(product, -shared);
        }
        Self { stress, A, alpha, beta }
    }

    /// ∂P̂/∂F̂ : dF̂.
    #[inline(always)]
    fn apply(&self, dF: &Matrix3<R>) -> Matrix3<R> {
        let Self { A, alpha, beta, .. } = self;
        let mut dP = *dF;
        for i in 0..3 {
            dP[i][i] = dot(A[i], [dF[0][0], dF[1][1], dF[2][2]]);
        }
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            dP[i][j] = alpha[pair].mul_add(dF[i][j], beta[pair] * dF[j][i]);
            dP[j][i] = alpha[pair].mul_add(dF[j][i], beta[pair] * dF[i][j]);
        }
        dP
    }
}

#[cfg(test)]
mod tests {
    use piola::point::svd;

    use super::*;
    use crate::testing::{convert, exact};

    /// III is of degree six: at stretches of 10⁻⁷ its square is below the smallest `f32`, where those of the
    /// stretches are not.
    #[test]
    fn the_third_invariant_leaves_the_range_first() {
        let F = convert::<f32>(&[[1e-7, 0.0, 0.0], [0.0, 1e-7, 0.0], [0.0, 0.0, 1e-7]]);
        let material = NeoHookean::new(1.0, 1.5).expect("admissible parameters");
        let (_, K) = evaluate(&material, &svd(&F));
        let (_, exact_K) = exact(&material, &F);
        assert!(!K[0][0].is_finite() && exact_K[0][0].is_finite(), "{} {}", K[0][0], exact_K[0][0]);
    }
}
