//! P and dP/dF of functions of I1, I2 and J straight from F, without a decomposition.
//!
//! With C = FᵀF, B = F Fᵀ, I1 = tr C, I2 = |cof F|², J = det F,
//!
//! ```text
//! ∂I1/∂F = 2 F        ∂I2/∂F = 2 (I1 F − B F)        ∂J/∂F = cof F
//! ```
//!
//! and for ψ = f(I1) + W2 I2 + h(J), with W2 constant, W1 = f′, W11 = f″, WJ = h′ and WJJ = h″,
//!
//! ```text
//! Pij       = c Fij + b (F C)ij + WJ cofij
//! ∂Pij/∂Fkl = a Fij Fkl + b Fil Fkj + δik δjl c + b (δik Cjl + δjl Bik) + WJ ∂cofij/∂Fkl + WJJ cofij cofkl
//!
//! a = 4 (W11 + W2)        b = −2 W2        c = 2 (W1 + W2 I1)
//! ```
//!
//! (∂cof/∂F holds 36 entries of F with signs.) Of the 45 distinct entries only those terms are computed that
//! an energy has: with about 200 operations for Saint Venant–Kirchhoff, and 120 and a logarithm for
//! neo-Hookean, a fused one counting once. But nothing is known of the eigenvalues, so that a filter costs a
//! 9×9 eigenproblem.
//!
//! What floating point does here: cofactors are known to u λ1² and J to u λ1³, which may be all of it where
//! λ1 λ2 λ3 is much smaller.

#![expect(non_snake_case, reason = "F, P, B, C, W, I1, I2, J as above")]

use piola::Real;
use piola::point::Matrix3;
use piola_materials::{NeoHookean, StVenantKirchhoff};

use crate::matrix::{cofactor, dot, multiply, multiply_transposed, scale_columns, transpose};

/// An energy f(I1) + W2 I2 + h(J) by its derivatives.
pub trait DirectEnergy {
    /// Derivatives at \[I1, J\].
    fn derivatives<R: Real>(&self, invariants: [R; 2]) -> Derivatives<R>;
}

/// Derivatives by I1, I2 and J, Pa; `None` where both vanish everywhere, so that their terms cost nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivatives<R> {
    /// W1.
    pub linear: R,
    /// W2, W11.
    pub quadratic: Option<[R; 2]>,
    /// WJ, WJJ.
    pub volumetric: Option<[R; 2]>,
}

/// μ/4 (I1² − 2 I2 − 2 I1 + 3) + λ/8 (I1 − 3)².
impl DirectEnergy for StVenantKirchhoff {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [I1, _]: [R; 2]) -> Derivatives<R> {
        let W11 = R::splat(self.mu() / 2.0 + self.lambda() / 4.0);
        let at_zero = R::splat(-(self.mu() / 2.0 + 0.75 * self.lambda()));
        Derivatives {
            linear: I1.mul_add(W11, at_zero),
            quadratic: Some([R::splat(-self.mu() / 2.0), W11]),
            volumetric: None,
        }
    }
}

/// μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
impl DirectEnergy for NeoHookean {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [_, J]: [R; 2]) -> Derivatives<R> {
        let inverse = R::splat(1.0) / J;
        let lambda = R::splat(self.lambda());
        let slope = J.ln().mul_add(lambda, R::splat(-self.mu()));
        Derivatives {
            linear: R::splat(self.mu() / 2.0),
            quadratic: None,
            volumetric: Some([slope * inverse, (lambda - slope) * (inverse * inverse)]),
        }
    }
}

/// The pairs of rows i ≤ k of F.
const ROWS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// P and dP/dF, Pa; row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F, exactly symmetric.
#[inline(always)]
#[must_use]
pub fn evaluate<R: Real>(energy: &impl DirectEnergy, F: &Matrix3<R>) -> (Matrix3<R>, [[R; 9]; 9]) {
    let (B, cof) = (multiply_transposed(F, F), cofactor(F));
    let I1 = B[0][0] + B[1][1] + B[2][2];
    let Derivatives { linear, quadratic, volumetric } = energy.derivatives([I1, dot(F[0], cof[0])]);

    let (mut P, mut blocks) = match quadratic {
        None => linear_part(linear + linear, F),
        Some([W2, W11]) => {
            let c = (W2 + W2).mul_add(I1, linear + linear);
            quadratic_part(R::splat(4.0) * (W11 + W2), -(W2 + W2), c, F, &B)
        }
    };
    if let Some([WJ, WJJ]) = volumetric {
        add_volumetric(WJ, WJJ, F, &cof, &mut P, &mut blocks);
    }
    (P, assembled(&blocks))
}

/// c F and c δik δjl.
#[inline(always)]
fn linear_part<R: Real>(c: R, F: &Matrix3<R>) -> (Matrix3<R>, [Matrix3<R>; 6]) {
    let zero = R::splat(0.0);
    let diagonal = [[c, zero, zero], [zero, c, zero], [zero, zero, c]];
    let mut blocks = [[[zero; 3]; 3]; 6];
    (blocks[0], blocks[1], blocks[2]) = (diagonal, diagonal, diagonal);
    (scale_columns(F, [c; 3]), blocks)
}

/// F S with S = c I + b C, and a Fij Fkl + b (Fil Fkj + δjl Bik) + δik Sjl.
#[inline(always)]
fn quadratic_part<R: Real>(
    a: R,
    b: R,
    c: R,
    F: &Matrix3<R>,
    B: &Matrix3<R>,
) -> (Matrix3<R>, [Matrix3<R>; 6]) {
    let Ft = transpose(F);
    let mut S = multiply_transposed(&Ft, &Ft);
    for (j, l) in ROWS {
        S[j][l] = if j == l { b.mul_add(S[j][l], c) } else { b * S[j][l] };
        S[l][j] = S[j][l];
    }
    let both = a + b;
    let mut blocks = [S; 6];
    for (block, (i, k)) in blocks.iter_mut().zip(ROWS) {
        let (x, y) = (F[i], F[k]);
        let shift = b * B[i][k];
        for j in 0..3 {
            let start = if i == k { S[j][j] + shift } else { shift };
            block[j][j] = both.mul_add(x[j] * y[j], start);
        }
        for (j, l) in [(0, 1), (0, 2), (1, 2)] {
            let (up, down) = (x[j] * y[l], x[l] * y[j]);
            if i == k {
                // Below the diagonal such a block is not read.
                block[j][l] = both.mul_add(up, S[j][l]);
            } else {
                block[j][l] = a.mul_add(up, b * down);
                block[l][j] = a.mul_add(down, b * up);
            }
        }
    }
    (multiply(F, &S), blocks)
}

/// Adds WJ cof to P and WJ ∂cofij/∂Fkl + WJJ cofij cofkl to dP/dF.
#[inline(always)]
fn add_volumetric<R: Real>(
    WJ: R,
    WJJ: R,
    F: &Matrix3<R>,
    cof: &Matrix3<R>,
    P: &mut Matrix3<R>,
    blocks: &mut [Matrix3<R>; 6],
) {
    let mut scaled = *cof;
    for i in 0..3 {
        for j in 0..3 {
            P[i][j] = WJ.mul_add(cof[i][j], P[i][j]);
            scaled[i][j] = WJJ * cof[i][j];
        }
    }
    for (block, (i, k)) in blocks.iter_mut().zip(ROWS) {
        for j in 0..3 {
            for l in (if i == k { j } else { 0 })..3 {
                block[j][l] = scaled[i][j].mul_add(cof[k][l], block[j][l]);
            }
        }
    }
    // Row i of the cofactors is the vector product of the two others, in cyclic order.
    for (block, row) in [(3, 2), (4, 1), (5, 0)] {
        let W = if row == 1 { -WJ } else { WJ };
        let block = &mut blocks[block];
        for (j, l, n) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            block[j][l] = W.mul_add(F[row][n], block[j][l]);
            block[l][j] = (-W).mul_add(F[row][n], block[l][j]);
        }
    }
}

/// The 9×9 matrix of blocks between the [`ROWS`], of which those on the diagonal are given above their own.
#[inline(always)]
fn assembled<R: Real>(blocks: &[Matrix3<R>; 6]) -> [[R; 9]; 9] {
    let mut dP_dF = [[R::splat(0.0); 9]; 9];
    for (block, (i, k)) in blocks.iter().zip(ROWS) {
        for j in 0..3 {
            for l in (if i == k { j } else { 0 })..3 {
                dP_dF[3 * i + j][3 * k + l] = block[j][l];
                dP_dF[3 * k + l][3 * i + j] = block[j][l];
            }
        }
    }
    dP_dF
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::errors_of;

    /// Stretches 10³, 1 and 10⁻³ in general directions: J is the difference of products of 10⁹.
    #[test]
    fn the_determinant_loses_what_cancels() {
        let axes = [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]].map(|row| row.map(|x| x / 3.0));
        let F = crate::matrix::to_world(
            &axes,
            &[[1e3, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1e-3]],
            &transpose(&axes),
        );
        let material = NeoHookean::new(1.0, 1.5).expect("admissible parameters");
        let [_, tangent] = errors_of::<f64>(|F| evaluate(&material, F), &material, &F);
        assert!(tangent >= 1e6, "{tangent:e}");
    }
}
