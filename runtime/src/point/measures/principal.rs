//! Principal Cauchy stresses, their directions, and von Mises' equivalent stress.
//!
//! The Cauchy stress is U diag(σi) Uᵀ with σi = ψi/(λj λk), so that its principal values and directions need
//! no eigensolver. The stretches are in order, but the stresses need not be: a solid that is not stable may
//! have the larger stress along the smaller stretch, and three equal stretches leave it to rounding.
//!
//! **Differences.** Where a large pressure acts, the σi agree in their first digits. The differences come
//! from the pairs instead, whose number a = (D⁻ + D⁺)/2 satisfies ψj = a λj − b λi:
//!
//! ```text
//! J (σi − σj) = λi ψi − λj ψj = a (λi² − λj²) = a (λi − λj)(λi + λj).
//! ```
//!
//! A pressure p adds p/λ to D⁻ and takes it from D⁺, and what it leaves of rounding, u p, is multiplied by
//! the difference of the stretches: von Mises' stress errs by u p times the strain, not by u p.

#![expect(non_snake_case, reason = "U as in the literature")]

use super::areas;
use crate::lanes::Real;
use crate::material::{Blocks, PAIRS};
use crate::point::Matrix3;
use crate::point::matrix::three;
use crate::point::svd::Svd;

/// Principal values of a stress, and their directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrincipalStress<R> {
    /// σ1 ≥ σ2 ≥ σ3, Pa; positive in tension.
    pub values: [R; 3],
    /// A rotation whose column k is the direction of value k.
    pub directions: Matrix3<R>,
}

/// The principal Cauchy stresses in descending order, with their directions in the deformed body, for the
/// gradient ψ1, ψ2, ψ3.
///
/// ```
/// use piola::point::measures::{principal_cauchy, von_mises};
/// use piola::point::{Filter, evaluate};
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln()
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let rubber = Rubber::new(1e6)?;
/// // Pulled to twice its length along the second axis: σ = μ (λ² − 1)/J.
/// let F = [[1.0f64, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]];
/// let point = evaluate(&rubber, &F, Filter::None);
/// let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
/// let principal = principal_cauchy(&svd, blocks.gradient);
/// assert!((principal.values[0] - 1.5e6).abs() < 1e-9);
/// assert_eq!(principal.directions[1][0].abs(), 1.0);
/// assert!((von_mises(&svd, blocks) - 1.5e6).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
#[inline(always)]
#[must_use]
pub fn principal_cauchy<R: Real>(svd: &Svd<R>, gradient: [R; 3]) -> PrincipalStress<R> {
    let areas = areas(svd.stretches);
    let mut stress = PrincipalStress { values: three!(i => gradient[i] / areas[i]), directions: svd.U };
    stress = exchanged(stress, 0, 1);
    stress = exchanged(stress, 1, 2);
    exchanged(stress, 0, 1)
}

/// Values i and j in descending order; a column that changes places with another changes its sign, so that
/// they stay a rotation.
#[inline(always)]
fn exchanged<R: Real>(stress: PrincipalStress<R>, i: usize, j: usize) -> PrincipalStress<R> {
    let PrincipalStress { values, directions: U } = stress;
    let mut sorted = stress;
    let is_ascending = values[i].less(values[j]);
    sorted.values[i] = R::select(is_ascending, values[j], values[i]);
    sorted.values[j] = R::select(is_ascending, values[i], values[j]);
    for row in 0..3 {
        sorted.directions[row][i] = R::select(is_ascending, U[row][j], U[row][i]);
        sorted.directions[row][j] = R::select(is_ascending, -U[row][i], U[row][j]);
    }
    sorted
}

/// Von Mises' equivalent Cauchy stress √(½ Σ (σi − σj)²), Pa, for unfiltered blocks.
///
/// In uniaxial tension it is the stress. It keeps its digits beside a large pressure: see the text of the
/// file.
#[inline(always)]
#[must_use]
pub fn von_mises<R: Real>(svd: &Svd<R>, blocks: &Blocks<R>) -> R {
    let l = svd.stretches;
    let volume = l[0] * l[1] * l[2];
    let differences = three!(pair => {
        let (i, j) = PAIRS[pair];
        blocks.pair_block(pair).0 * (l[i] - l[j]) * (l[i] + l[j]) / volume
    });
    // Squares neither overflow nor underflow.
    let largest = differences[0].abs().max(differences[1].abs()).max(differences[2].abs());
    let (scale, back) = largest.power_of_two_scale();
    let [x, y, z] = three!(pair => differences[pair] * scale);
    (R::splat(0.5) * x.mul_add(x, y.mul_add(y, z * z))).sqrt() * back
}
