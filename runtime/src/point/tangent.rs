//! Tangent dP/dF of a point as a block-diagonal map, with a derivation that eliminates the derivatives of the
//! singular vectors.
//!
//! # From the singular value decomposition to fifteen numbers
//!
//! \[SZLSB11\] differentiates P through the derivatives of U, λ and V. A 2×2 system for each pair of
//! stretches and each of the nine entries of F gives those, and where two stretches meet these systems are
//! singular. This derivation follows the same equations up to that point and then leaves out the systems:
//! what they would be solved for cancels. The numbers of the paper's equations stand next to ours; where
//! these differ, the paper has a misprint.
//!
//! With F̂ = Λ = diag(λ) and P̂ = diag(ψ1, ψ2, ψ3), where ψi = ∂ψ/∂λi,
//!
//! ```text
//! F = U Λ Vᵀ,   P = U P̂ Vᵀ                                    (eq. 2)
//! ```
//!
//! **Differentiate both** along any dF:
//!
//! ```text
//! dF = dU Λ Vᵀ + U dΛ Vᵀ + U Λ dVᵀ                            (eq. 4, which lacks the last U)
//! dP = dU P̂ Vᵀ + U dP̂ Vᵀ + U P̂ dVᵀ                            (eq. 3, in whose last term Vᵀ varies)
//! ```
//!
//! **Look at them in the principal frames.** Write dF̂ = Uᵀ dF V for the increment seen from there (not the
//! increment of F̂), likewise Uᵀ dP V, and Ω = Uᵀ dU, Θ = dVᵀ V. As U and V remain rotations, Ω and Θ are
//! antisymmetric.
//!
//! ```text
//! Uᵀ dF V = Ω Λ + dΛ + Λ Θ
//! Uᵀ dP V = Ω P̂ + dP̂ + P̂ Θ
//! ```
//!
//! **The diagonal.** Ω and Θ vanish there, so dλi = dF̂ii, and by the chain rule
//!
//! ```text
//! (Uᵀ dP V)ii = Σj ψij dF̂jj                  (eq. 5, which needs the whole row, not ψii alone)
//! ```
//!
//! **A pair i < j.** Two entries of dF̂ depend on the two unknowns Ωij and Θij, and the same unknowns give
//! two entries of the result:
//!
//! ```text
//! dF̂ij =  Ωij λj + λi Θij         (Uᵀ dP V)ij =  Ωij ψj + ψi Θij
//! dF̂ji = −Ωij λi − λj Θij         (Uᵀ dP V)ji = −Ωij ψi − ψj Θij          (eq. 6)
//! ```
//!
//! (For a dF with a single 1 at (i, j), dF̂kl = u_ik v_jl: the right sides of eq. 6 are that and −u_il v_jk.)
//!
//! The system on the left has the determinant λi² − λj²; solving it is where the paper regularises. Take sums
//! and differences instead, and each line contains only one unknown:
//!
//! ```text
//! dF̂ij + dF̂ji = (λj − λi)(Ωij − Θij)       (Uᵀ dP V)ij + (Uᵀ dP V)ji = (ψj − ψi)(Ωij − Θij)
//! dF̂ij − dF̂ji = (λi + λj)(Ωij + Θij)       (Uᵀ dP V)ij − (Uᵀ dP V)ji = (ψi + ψj)(Ωij + Θij)
//! ```
//!
//! so that the sum is multiplied by the *flip* D⁻ij = (ψi − ψj)/(λi − λj) and the difference by the *twist*
//! D⁺ij = (ψi + ψj)/(λi + λj). Ω and Θ are gone, and with them every division: that both quotients are smooth
//! functions of the stretches (the twist only for energies even in two stretches at once) is a matter of the
//! energy, and its [`Material::blocks`](crate::Material::blocks) computes them without ever forming the gap.
//! A pair of equal stretches, where U and V are arbitrary, is nothing special.
//!
//! **Together**, with a = (D⁻ + D⁺)/2 and b = (D⁻ − D⁺)/2:
//!
//! ```text
//! ⎡11⎤   ⎡ψ11 ψ12 ψ13⎤ ⎡11⎤         ⎡ij⎤   ⎡a b⎤ ⎡ij⎤
//! ⎢22⎥ ← ⎢ψ12 ψ22 ψ23⎥ ⎢22⎥         ⎣ji⎦ ← ⎣b a⎦ ⎣ji⎦     for ij = 12, 13, 23
//! ⎣33⎦   ⎣ψ13 ψ23 ψ33⎦ ⎣33⎦
//! ```
//!
//! In the orthonormal basis of the diagonal entries and (ij ± ji)/√2 the pairs are diagonal too: D⁻ belongs
//! to the plus sign, a change of shape, and equals 2μ at rest; D⁺ belongs to the minus sign, an infinitesimal
//! rotation, and is 0 at rest. The map has 9 + 6 = 15 non-zeros, of which 12 are distinct: the content of
//! [`Blocks`]. Its eigenvalues are those of dP/dF, since dF ↦ Uᵀ dF V is an orthogonal change of the nine
//! coordinates; so [`project`](mod@super::project) works on it instead.
//!
//! # From fifteen numbers to matrices
//!
//! With αii = ψii, αij = a, βij = b, the entry of dP/dF between (row, column) of P and of F is a sum of
//! products of two entries of U and two of V:
//!
//! ```text
//! ∂Pax/∂Fcy = Σ_lm αlm (Ual Ucl)(Vxm Vym) + Σ_i<j  Uai Ucj (ψij Vxi Vyj + bij Vxj Vyi)
//!                                                + Uaj Uci (ψij Vxj Vyi + bij Vxi Vyj)
//! ```
//!
//! With the sums and differences S, D of UaiUcj and UajUci, s, d those of VxiVyj and VxjVyi, a pair's share
//! is
//!
//! ```text
//! ½ (ψij + bij) S s + ½ (ψij − bij) D d.
//! ```
//!
//! The first term is symmetric in x and y, the second one antisymmetric, and it vanishes for a = c.
//! [`assemble_blocks`] evaluates both once for each x ≤ y, with the products of V shared among all (a, c) and
//! those of U among all (x, y). Nothing in it requires V to be orthogonal, nor to belong to columns of F:
//! with √volume·Dm⁻ᵀ-transformed rows in place of V it gives an element's stiffness, whose product of 9×12,
//! 9×9 and 12×9 matrices is thereby never formed.
//!
//! This module is independent of materials and meshes.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

#![expect(non_snake_case, reason = "U, V, W, dF, dP as in the essay above")]

use super::Matrix3;
use super::matrix::{dot, three, to_principal, to_world};
use crate::lanes::{Real, stage};
use crate::material::{Blocks, PAIRS};

/// dP/dF at a point, as frames and the numbers between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<R> {
    /// Left rotation of F.
    pub U: Matrix3<R>,
    /// Right rotation of F.
    pub V: Matrix3<R>,
    /// The map between the principal frames, Pa.
    pub blocks: Blocks<R>,
}

impl<R: Real> Tangent<R> {
    /// The product dP = (dP/dF) dF: two changes of frame and 15 multiplications between them.
    #[inline(always)]
    #[must_use]
    pub fn apply(&self, dF: &Matrix3<R>) -> Matrix3<R> {
        let Self { U, V, blocks } = self;
        let increment = to_principal(U, dF, V);
        to_world(U, &blocks.apply(&increment), V)
    }

    /// dP/dF as a 9×9 matrix, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F.
    ///
    /// Exactly symmetric: 45 entries are computed and the others copied.
    #[inline(always)]
    #[must_use]
    pub fn to_matrix(&self) -> [[R; 9]; 9] {
        let Self { U, V, blocks: Blocks { hessian, flip, twist, .. } } = *self;
        stage!(R, "tangent_in_frames", (U, V, hessian, flip, twist) => {
            let mut dP_dF = [[R::splat(0.0); 9]; 9];
            let blocks = Blocks { gradient: [R::splat(0.0); 3], hessian, flip, twist };
            assemble_blocks(&U, &V, &blocks, &mut dP_dF);
            dP_dF
        })
    }
}

impl<R: Real> Assemble<R> for [[R; 9]; 9] {
    #[inline(always)]
    fn block(&mut self, a: usize, c: usize, block: &Matrix3<R>) {
        for x in 0..3 {
            for y in 0..3 {
                self[3 * a + x][3 * c + y] = block[x][y];
                self[3 * c + y][3 * a + x] = block[x][y];
            }
        }
    }
}

impl<R: Real> Blocks<R> {
    /// The map between the principal frames: dF̂ = Uᵀ dF V to Uᵀ dP V.
    #[inline(always)]
    #[must_use]
    pub fn apply(&self, increment: &Matrix3<R>) -> Matrix3<R> {
        let [h11, h22, h33, h12, h13, h23] = self.hessian;
        let [[d1, ..], [_, d2, _], [.., d3]] = *increment;
        let [[up12, down12], [up13, down13], [up23, down23]] = three!(pair => {
            let (i, j) = PAIRS[pair];
            let (a, b) = self.pair_block(pair);
            let (up, down) = (increment[i][j], increment[j][i]);
            [a.mul_add(up, b * down), a.mul_add(down, b * up)]
        });
        [
            [h11.mul_add(d1, h12.mul_add(d2, h13 * d3)), up12, up13],
            [down12, h12.mul_add(d1, h22.mul_add(d2, h23 * d3)), up23],
            [down13, down23, h13.mul_add(d1, h23.mul_add(d2, h33 * d3))],
        ]
    }

    /// a = (D⁻ + D⁺)/2 and b = (D⁻ − D⁺)/2, Pa, of a pair: its place in [`PAIRS`].
    ///
    /// # Panics
    /// If there is no such place.
    #[doc(hidden)] // for criteria of stability
    #[inline(always)]
    #[must_use]
    pub fn pair_block(&self, pair: usize) -> (R, R) {
        let half = R::splat(0.5);
        let (flip, twist) = (half * self.flip[pair], half * self.twist[pair]);
        (flip + twist, flip - twist)
    }
}

/// Takes the 3×3 blocks of a symmetric matrix from [`assemble_blocks`].
///
/// A trait instead of a closure, because lanes need everything inlined, which nothing can force for a
/// closure.
pub(crate) trait Assemble<R> {
    /// Takes K between (a, x) and (c, y) as `block[x][y]`, a ≤ c.
    fn block(&mut self, a: usize, c: usize, block: &Matrix3<R>);
}

/// The symmetric matrix K = (U ⊗ W) A (U ⊗ W)ᵀ of the [`Blocks`] A, passed on as 3×3 blocks.
///
/// `to` takes the blocks of the six a ≤ c with `block[x][y]` = K between (a, x) and (c, y), where a and c
/// are coordinates of the deformed space and x and y rows of W. Each block with a = c is exactly symmetric; K
/// between (c, y) and (a, x) is the same number as between (a, x) and (c, y).
///
/// With W = V, K is dP/dF. With `W[n]` = √volume · Vᵀ∇Nn for the gradients of three shape functions over the
/// rest shape, K is the stiffness between three nodes of a tetrahedron; the fourth node's rows are minus
/// their sum. About 560 multiplications and additions.
#[inline(always)]
pub(crate) fn assemble_blocks<R: Real>(
    U: &Matrix3<R>,
    W: &Matrix3<R>,
    blocks: &Blocks<R>,
    to: &mut impl Assemble<R>,
) {
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let [(a12, b12), (a13, b13), (a23, b23)] = three!(pair => blocks.pair_block(pair));
    let alpha = [[h11, a12, a13], [a12, h22, a23], [a13, a23, h33]];
    let half = R::splat(0.5);
    let even = [half * (h12 + b12), half * (h13 + b13), half * (h23 + b23)];
    let odd = [half * (h12 - b12), half * (h13 - b13), half * (h23 - b23)];

    let right = [
        Products::new(W[0], W[0]),
        Products::new(W[1], W[1]),
        Products::new(W[2], W[2]),
        Products::new(W[0], W[1]),
        Products::new(W[0], W[2]),
        Products::new(W[1], W[2]),
    ];
    // A loop that stays one: unrolled, it would move the numbers above between registers and memory many
    // times over.
    for (a, c) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
        let left = Products::new(U[a], U[c]);
        let squares = three!(l => dot(left.straight, alpha[l]));
        let sums = three!(pair => even[pair] * left.sums[pair]);
        let differences = three!(pair => odd[pair] * left.differences[pair]);
        let [s11, s22, s33] = three!(k => right[k].contract(squares, sums));
        let [s12, s13, s23] = three!(k => right[3 + k].contract(squares, sums));
        // For a = c the differences are zero.
        let [d12, d13, d23] = three!(k => dot(differences, right[3 + k].differences));
        let block = [[s11, s12 + d12, s13 + d13], [s12 - d12, s22, s23 + d23], [s13 - d13, s23 - d23, s33]];
        to.block(a, c, &block);
    }
}

/// Products of the entries of two rows: xm ym, and for each pair xi yj ± xj yi.
struct Products<R> {
    straight: [R; 3],
    sums: [R; 3],
    differences: [R; 3],
}

impl<R: Real> Products<R> {
    #[inline(always)]
    fn new(x: [R; 3], y: [R; 3]) -> Self {
        let crossed = three!(pair => {
            let (i, j) = PAIRS[pair];
            (x[i] * y[j], x[j] * y[i])
        });
        Self {
            straight: three!(m => x[m] * y[m]),
            sums: three!(pair => crossed[pair].0 + crossed[pair].1),
            differences: three!(pair => crossed[pair].0 - crossed[pair].1),
        }
    }

    #[inline(always)]
    fn contract(&self, squares: [R; 3], sums: [R; 3]) -> R {
        let [s12, s13, s23] = self.sums;
        let start = dot(squares, self.straight);
        sums[0].mul_add(s12, sums[1].mul_add(s13, sums[2].mul_add(s23, start)))
    }
}
