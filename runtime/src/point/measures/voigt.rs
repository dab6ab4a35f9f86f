//! Voigt notation: symmetric tensors as six components, tangents between them as 6×6 matrices.
//!
//! **Order.** 11, 22, 33, 23, 13, 12, the order of Voigt and of most textbooks: the shears by the missing
//! direction. Project Chrono and Ferrite's Tensors.jl use it as well. Abaqus/Standard has 11, 22, 33, 12, 13,
//! 23: its number I is our number `[0, 1, 2, 5, 4, 3][I]` and the other way round, in rows and columns of a
//! tangent too.
//!
//! **Factor.** A stress is stored by its components. A strain has *engineering* shears, twice its components:
//! 11, 22, 33, 2·23, 2·13, 2·12. The scalar product of the two is then the double contraction, which is work,
//! and a tangent that is stored by its components maps strains to stresses.
//!
//! This module is independent of stretches and blocks.

#![expect(non_snake_case, reason = "C, Q as in the literature")]

use crate::lanes::Real;
use crate::material::PAIRS;
use crate::point::Matrix3;

/// Tangent as its rows: `C[I][J]` maps component J of a strain to component I of a stress.
pub type Matrix6<R> = [[R; 6]; 6];

/// Row and column, counted from zero, of each of the six components: 11, 22, 33, 23, 13, 12.
pub const ORDER: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)];

/// The place of entry (i, j) in the [`ORDER`]: component ijkl of a tangent C is
/// `C[INDEX[i][j]][INDEX[k][l]]`.
pub const INDEX: [[usize; 3]; 3] = [[0, 5, 4], [5, 1, 3], [4, 3, 2]];

/// The stress with these six components.
#[inline(always)]
#[must_use]
pub fn to_stress<R: Real>(numbers: &[R; 6]) -> Matrix3<R> {
    let [s11, s22, s33, s23, s13, s12] = *numbers;
    [[s11, s12, s13], [s12, s22, s23], [s13, s23, s33]]
}

/// The six components of a strain, shears doubled; if the matrix is not quite symmetric, of its symmetric
/// part.
#[inline(always)]
#[must_use]
pub fn from_strain<R: Real>(strain: &Matrix3<R>) -> [R; 6] {
    let twice = |i: usize, j: usize| strain[i][j] + strain[j][i];
    [strain[0][0], strain[1][1], strain[2][2], twice(1, 2), twice(0, 2), twice(0, 1)]
}

/// A tangent in the principal frame of an isotropic body: entries that are not listed are zero or follow by
/// symmetry.
#[derive(Clone, Copy)]
pub(super) struct Principal<R> {
    /// Components iiii.
    pub(super) diagonal: [R; 3],
    /// Components iijj of the [`PAIRS`].
    pub(super) mixed: [R; 3],
    /// Components ijij of the [`PAIRS`].
    pub(super) shear: [R; 3],
}

impl<R: Real> Principal<R> {
    /// The tangent in the world, for a frame whose directions are the columns of Q; exactly symmetric.
    ///
    /// With mi = qi qiᵀ and nij = qi qjᵀ + qj qiᵀ as six numbers each, stored as stresses, it is
    /// Σ_ij C_iijj mi mjᵀ + Σ_i<j C_ijij nij nijᵀ. About 400 multiplications and additions.
    #[inline(always)]
    pub(super) fn to_world(self, Q: &Matrix3<R>) -> Matrix6<R> {
        let mut dyads = [[R::splat(0.0); 6]; 6];
        for index in 0..6 {
            let (x, y) = ORDER[index];
            for k in 0..3 {
                let (i, j) = PAIRS[k];
                dyads[index][k] = Q[x][k] * Q[y][k];
                dyads[index][3 + k] = Q[x][i].mul_add(Q[y][j], Q[x][j] * Q[y][i]);
            }
        }
        let ([c11, c22, c33], [c12, c13, c23]) = (self.diagonal, self.mixed);
        let mut C = [[R::splat(0.0); 6]; 6];
        for row in 0..6 {
            let [m1, m2, m3, n12, n13, n23] = dyads[row];
            let weighted = [
                c11.mul_add(m1, c12.mul_add(m2, c13 * m3)),
                c12.mul_add(m1, c22.mul_add(m2, c23 * m3)),
                c13.mul_add(m1, c23.mul_add(m2, c33 * m3)),
                self.shear[0] * n12,
                self.shear[1] * n13,
                self.shear[2] * n23,
            ];
            for column in row..6 {
                let dyad = dyads[column];
                let mut sum = weighted[0] * dyad[0];
                for k in 1..6 {
                    sum = weighted[k].mul_add(dyad[k], sum);
                }
                C[row][column] = sum;
                C[column][row] = sum;
            }
        }
        C
    }
}
